//! A text's values before they are anything's: what TOML, JSON and other formats have in common, with places where there are any.

use super::values::At;
use crate::error::{LawError, Problem};
use crate::units::Quantity;
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::string::ToString;
use alloc::vec::Vec;

/// A value as some format holds it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Text(String),
    Float(f64),
    Integer(i64),
    List(Vec<At<Value>>),
    Table(Vec<Entry>),
    /// Of a kind that nothing here takes.
    Other(&'static str),
}

/// A key with its value.
pub(crate) type Entry = (At<String>, At<Value>);

impl Value {
    /// What it is, for messages.
    pub fn what(&self) -> &'static str {
        match self {
            Self::Text(_) => "a text",
            Self::Float(_) | Self::Integer(_) => "a number",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
            Self::Other(what) => what,
        }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Float(v) => Some(*v),
            Self::Integer(v) => Some(*v as f64),
            _ => None,
        }
    }

    /// The text.
    pub fn text(&self, key: &str, wanted: &str) -> Result<&str, LawError> {
        match self {
            Self::Text(text) => Ok(text),
            other => Err(other.unfit(key, wanted)),
        }
    }

    /// It is not what is wanted.
    pub fn unfit(&self, key: &str, wanted: impl Into<String>) -> LawError {
        Problem::WrongType { key: key.to_owned(), found: self.what(), wanted: wanted.into() }.into()
    }

    /// The quantity: a text with a unit, or a bare SI number.
    pub fn quantity<Q: Quantity>(&self, key: &str) -> Result<Q, LawError> {
        let unit = if Q::SI.is_empty() { "a number without a unit" } else { Q::SI };
        match (self, self.number()) {
            (Self::Text(text), _) => {
                text.parse().map_err(|error| Problem::WrongUnit { key: key.to_owned(), error }.into())
            }
            (_, Some(number)) if number.is_finite() => Ok(Q::from_si(number)),
            (_, Some(number)) => {
                let right = format!("a finite {} is wanted", Q::WHAT);
                Err(Problem::OutOfRange { key: key.to_owned(), value: number.to_string(), unit: "", right }.into())
            }
            _ => Err(self.unfit(key, format!("a {} such as \"{}\", or a number in {unit},", Q::WHAT, Q::EXAMPLE))),
        }
    }

    /// The numbers of a list.
    pub fn numbers(&self, key: &str) -> Result<Vec<f64>, LawError> {
        let Self::List(items) = self else { return Err(self.unfit(key, "a list of numbers")) };
        items
            .iter()
            .map(|i| i.value.number().ok_or_else(|| i.value.unfit(key, "a list of numbers").at(i.span.clone())))
            .collect()
    }
}

#[cfg(feature = "serde")]
mod any {
    use super::{Entry, Value};
    use core::fmt;
    use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};

    impl<'de> Deserialize<'de> for Value {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            deserializer.deserialize_any(Any)
        }
    }

    struct Any;

    impl<'de> Visitor<'de> for Any {
        type Value = Value;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a text, a number, a list or a table")
        }
        fn visit_str<E: Error>(self, v: &str) -> Result<Value, E> {
            Ok(Value::Text(v.to_owned()))
        }
        fn visit_f64<E: Error>(self, v: f64) -> Result<Value, E> {
            Ok(Value::Float(v))
        }
        fn visit_i64<E: Error>(self, v: i64) -> Result<Value, E> {
            Ok(Value::Integer(v))
        }
        fn visit_u64<E: Error>(self, v: u64) -> Result<Value, E> {
            Ok(Value::Float(v as f64))
        }
        fn visit_bool<E: Error>(self, _: bool) -> Result<Value, E> {
            Ok(Value::Other("true or false"))
        }
        fn visit_unit<E: Error>(self) -> Result<Value, E> {
            Ok(Value::Other("nothing"))
        }
        fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Value, A::Error> {
            let mut items = Vec::new();
            while let Some(item) = seq.next_element::<Value>()? {
                items.push(item.into());
            }
            Ok(Value::List(items))
        }
        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Value, A::Error> {
            let mut entries: Vec<Entry> = Vec::new();
            while let Some((key, value)) = map.next_entry::<String, Value>()? {
                entries.push((key.into(), value.into()));
            }
            Ok(Value::Table(entries))
        }
    }
}

#[cfg(feature = "toml")]
mod located {
    use super::{At, Entry, LawError, Value};
    use toml::Spanned;
    use toml::de::{DeTable, DeValue};

    /// A whole TOML text, with places.
    pub(crate) fn document(text: &str) -> Result<Vec<Entry>, LawError> {
        Ok(entries(DeTable::parse(text)?.into_inner()))
    }

    /// A value as it would stand behind `key = `.
    pub(crate) fn inline(text: &str) -> Result<Value, LawError> {
        Ok(value(DeValue::parse(text)?.into_inner()))
    }

    /// In the order in which they are written.
    fn entries(table: DeTable<'_>) -> Vec<Entry> {
        let mut entries: Vec<Entry> = table
            .into_iter()
            .map(|(key, value)| {
                let span = Some(key.span());
                (At { value: key.into_inner().into_owned(), span }, at(value))
            })
            .collect();
        entries.sort_by_key(|(key, _)| key.span.as_ref().map(|s| s.start));
        entries
    }

    fn at(spanned: Spanned<DeValue<'_>>) -> At<Value> {
        let span = Some(spanned.span());
        At { value: value(spanned.into_inner()), span }
    }

    fn value(value: DeValue<'_>) -> Value {
        match value {
            DeValue::String(text) => Value::Text(text.into_owned()),
            DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix())
                .map_or(Value::Other("an integer beyond 64 bits"), Value::Integer),
            DeValue::Float(number) => {
                number.as_str().parse().map_or(Value::Other("a number that cannot be read"), Value::Float)
            }
            DeValue::Boolean(_) => Value::Other("true or false"),
            DeValue::Datetime(_) => Value::Other("a date"),
            DeValue::Array(items) => Value::List(items.into_iter().map(at).collect()),
            DeValue::Table(table) => Value::Table(entries(table)),
        }
    }
}

#[cfg(feature = "toml")]
pub(crate) use located::{document, inline};
