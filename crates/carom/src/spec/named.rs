//! One law of a text with several, or with other tables: the rest is passed over, so a mistake in it does no harm here.

use super::{LawSpec, parse_law};
use crate::error::{SpecError, did_you_mean};
use serde::de::{self, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;

/// The laws of a text, none of them read yet.
#[derive(serde::Deserialize)]
struct Names {
    #[serde(default)]
    law: BTreeMap<String, IgnoredAny>,
}

/// Reads the law `name` from a text with `[law.NAME]` tables (a law file or a whole case file). Other tables are left alone, and so
/// are other laws.
///
/// # Errors
/// A text that is no TOML, a bad law, an unknown name (with the nearest known one).
///
/// ```
/// let text = "[law.glass]\nnormal = \"constant\"\nrestitution = 0.9\nfriction = 0.1\n[law.later]\nnormal = \"?\"\n";
/// assert!(carom::spec::parse_named_law(text, "glass").is_ok());
/// assert!(carom::spec::parse_named_law(text, "glas").unwrap_err().to_string().contains("did you mean glass?"));
/// ```
pub fn parse_named_law(text: &str, name: &str) -> Result<LawSpec, SpecError> {
    let found: Names = toml::from_str(text)?;
    let unknown = || {
        let names: Vec<&str> = found.law.keys().map(String::as_str).collect();
        let near = did_you_mean(name, names.iter().copied()).unwrap_or_default();
        let known = if names.is_empty() {
            "the text has no [law.NAME] table".to_owned()
        } else {
            format!("known are {}", names.join(", "))
        };
        SpecError::new(format!("no law '{name}'")).help(format!("{near} {known}").trim().to_owned())
    };
    if !found.law.contains_key(name) {
        return Err(unknown());
    }
    let path: &[&str] = &["law", name];
    In(path).deserialize(toml::Deserializer::parse(text)?)?.ok_or_else(unknown)
}

/// Reads the one law of a text: its only `[law.NAME]` table or, in a text without such tables, the keys of a law without a header.
///
/// # Errors
/// A text that cannot be read, a bad law, more than one law.
///
/// ```
/// use carom::spec::{parse_law, parse_only_law};
/// let keys = "normal = \"constant\"\nrestitution = 0.9\nfriction = 0.1\n";
/// assert!(parse_only_law(keys).is_ok() && parse_only_law(&format!("[law.glass]\n{keys}")).is_ok());
/// assert!(parse_only_law(&format!("[law.a]\n{keys}[law.b]\n{keys}")).unwrap_err().to_string().contains("a, b"));
/// ```
pub fn parse_only_law(text: &str) -> Result<LawSpec, SpecError> {
    let found: Names = toml::from_str(text)?;
    let names: Vec<&String> = found.law.keys().collect();
    match names.as_slice() {
        [] => parse_law(text),
        [name] => parse_named_law(text, name),
        several => {
            let known = several.iter().map(|n| n.as_str()).collect::<Vec<_>>().join(", ");
            Err(SpecError::new("the text holds more than one law").help(format!("name one of {known}")))
        }
    }
}

/// The law at the end of a path of keys, read in place so that errors keep theirs.
struct In<'a>(&'a [&'a str]);

impl<'de> DeserializeSeed<'de> for In<'_> {
    type Value = Option<LawSpec>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        match self.0 {
            [] => de::Deserialize::deserialize(deserializer).map(Some),
            _ => deserializer.deserialize_map(self),
        }
    }
}

impl<'de> Visitor<'de> for In<'_> {
    type Value = Option<LawSpec>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table with laws")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut found = None;
        while let Some(key) = map.next_key::<String>()? {
            match self.0 {
                [first, rest @ ..] if *first == key => found = map.next_value_seed(In(rest))?,
                _ => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(found)
    }
}
