//! A law from a text: its keys alone, one table of several, or all of them. A mistake in another table does no harm here.

use super::keys::{Key, LawSpec};
#[cfg(feature = "serde")]
use super::value::Entry;
use super::value::Value;
use super::values::At;
use crate::error::LawError;
#[cfg(feature = "serde")]
use crate::error::Problem;
use alloc::borrow::ToOwned;

impl LawSpec {
    /// From the keys of a table, in any format.
    #[cfg(feature = "serde")]
    pub(crate) fn from_entries(entries: &[Entry]) -> Result<Self, LawError> {
        let mut law = Self::default();
        for (name, value) in entries {
            let key = Key::by_name(&name.value).ok_or_else(|| {
                let unknown = Problem::UnknownKey { what: "key", key: name.value.clone(), known: Key::NAMES.to_vec() };
                LawError::from(unknown).at(name.span.clone())
            })?;
            law.set(key, value)?;
        }
        Ok(law)
    }

    /// Gives a key the value that a text states, as the value would stand in a law's text, without quotation marks: `90 um`, `ea`,
    /// `{ polynomial = [0.9] }`.
    ///
    /// # Errors
    /// A value that the key does not take. Ranges are checked when the law is compiled.
    ///
    /// ```
    /// use carom::spec::{Key, LawSpec};
    /// let mut law = LawSpec::default();
    /// law.set_text(Key::HertzDamping, "7 ms/m")?;
    /// assert_eq!(law.number(Key::HertzDamping), Some(0.007));
    /// # Ok::<(), carom::LawError>(())
    /// ```
    pub fn set_text(&mut self, key: Key, text: &str) -> Result<(), LawError> {
        self.set(key, &At::from(value(text)?)).map_err(LawError::without_place)
    }
}

#[cfg(feature = "toml")]
fn value(text: &str) -> Result<Value, LawError> {
    let structured = text.trim_start().starts_with(['{', '[']);
    if structured { super::value::inline(text) } else { Ok(Value::Text(text.to_owned())) }
}

#[cfg(not(feature = "toml"))]
fn value(text: &str) -> Result<Value, LawError> {
    Ok(Value::Text(text.to_owned()))
}

#[cfg(feature = "toml")]
pub use toml::{parse_law, parse_laws, parse_named_law, parse_only_law};

#[cfg(feature = "toml")]
mod toml {
    use super::{At, Entry, LawError, LawSpec, Problem, Value};
    use crate::spec::document;
    use std::collections::BTreeMap;

    /// Reads one wall law: the keys of a `[law.NAME]` table, without the header.
    ///
    /// # Errors
    /// What is wrong, with its place in `text`.
    pub fn parse_law(text: &str) -> Result<LawSpec, LawError> {
        LawSpec::from_entries(&document(text)?)
    }

    /// Reads the law `name` from a text with `[law.NAME]` tables (a law file or a whole case file). Other tables are left alone, and so
    /// are other laws.
    ///
    /// # Errors
    /// A text that is not TOML, a bad law, an unknown name (with the nearest known one).
    ///
    /// ```
    /// let text = "[law.glass]\nnormal = \"constant\"\nrestitution = 0.9\nfriction = 0.1\n[law.later]\nnormal = \"?\"\n";
    /// assert!(carom::spec::parse_named_law(text, "glass").is_ok());
    /// assert!(carom::spec::parse_named_law(text, "glas").unwrap_err().to_string().contains("did you mean glass?"));
    /// ```
    pub fn parse_named_law(text: &str, name: &str) -> Result<LawSpec, LawError> {
        let laws = laws(text)?;
        match laws.iter().find(|(key, _)| key.value == name) {
            Some(found) => law(found),
            None => {
                let mut names: Vec<String> = laws.into_iter().map(|(key, _)| key.value).collect();
                names.sort();
                Err(no_law(name, names))
            }
        }
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
    pub fn parse_only_law(text: &str) -> Result<LawSpec, LawError> {
        match laws(text)?.as_slice() {
            [] => parse_law(text),
            [one] => law(one),
            several => {
                let mut known: Vec<&str> = several.iter().map(|(key, _)| key.value.as_str()).collect();
                known.sort_unstable();
                let known = known.join(", ");
                Err(LawError::new("the text holds more than one law").help(format!("name one of {known}")))
            }
        }
    }

    /// Reads every law of a text, with the place of its table.
    ///
    /// # Errors
    /// A text that is not TOML, a bad law.
    pub fn parse_laws(text: &str) -> Result<BTreeMap<String, At<LawSpec>>, LawError> {
        laws(text)?
            .iter()
            .map(|entry| Ok((entry.0.value.clone(), At { value: law(entry)?, span: entry.1.span.clone() })))
            .collect()
    }

    /// The laws of a text, none of them read yet.
    fn laws(text: &str) -> Result<Vec<Entry>, LawError> {
        let Some((_, at)) = document(text)?.into_iter().find(|(key, _)| key.value == "law") else {
            return Ok(Vec::new());
        };
        match at.value {
            Value::Table(entries) => Ok(entries),
            other => Err(other.unfit("law", "tables [law.NAME]").at(at.span)),
        }
    }

    fn law((name, at): &Entry) -> Result<LawSpec, LawError> {
        match &at.value {
            Value::Table(entries) => LawSpec::from_entries(entries).map_err(|e| e.at(at.span.clone())),
            other => Err(other.unfit(&name.value, "a table of a law's keys").at(at.span.clone())),
        }
    }

    fn no_law(name: &str, names: Vec<String>) -> LawError {
        if names.is_empty() {
            return LawError::new(format!("no law '{name}'")).help("the text has no [law.NAME] table");
        }
        Problem::UnknownName { what: "law", name: name.to_owned(), known: names }.into()
    }
}
