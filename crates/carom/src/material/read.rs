//! A material's table, of any format.

use super::Material;
use super::property::{Alternative, Property, PropertyKind};
use crate::error::{LawError, Problem};
use crate::spec::{At, Entry, Value};
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;

const ABOUT: [&str; 3] = ["description", "aliases", "note"];
const PROPERTY: [&str; 8] = ["value", "low", "high", "source", "typical", "note", "printed", "alternatives"];
const ALTERNATIVE: [&str; 5] = ["value", "low", "high", "source", "note"];

fn unknown(what: &'static str, key: &At<String>, known: Vec<&'static str>) -> LawError {
    LawError::from(Problem::UnknownKey { what, key: key.value.clone(), known }).at(key.span.clone())
}

fn text(key: &str, at: &At<Value>) -> Result<String, LawError> {
    at.value.text(key, "a text").map(str::to_owned).map_err(|e| e.at(at.span.clone()))
}

impl Material {
    /// From the table `[material.NAME]`, or one in its place.
    pub(crate) fn from_entries(name: &str, entries: &[Entry]) -> Result<Self, LawError> {
        let mut material = Self { name: name.to_owned(), ..Self::default() };
        for (key, at) in entries {
            let place = |e: LawError| e.at(at.span.clone());
            match key.value.as_str() {
                "description" => material.description = text("description", at)?,
                "note" => material.note = Some(text("note", at)?),
                "aliases" => {
                    let Value::List(items) = &at.value else {
                        return Err(place(at.value.unfit("aliases", "a list of names")));
                    };
                    material.aliases = items.iter().map(|i| text("aliases", i)).collect::<Result<_, _>>()?;
                }
                other => {
                    let kind = PropertyKind::by_name(other).ok_or_else(|| {
                        let known = PropertyKind::NAMES.iter().copied().chain(ABOUT).collect();
                        unknown("key of a material", key, known)
                    })?;
                    if material.property(kind).is_some() {
                        let twice = Problem::GivenTwice { what: "property", key: other.to_owned() };
                        return Err(LawError::from(twice).at(key.span.clone()));
                    }
                    let property = property(kind, at)?;
                    let span = value_of(at).span.clone();
                    kind.check(&property).map_err(|e| e.at(span))?;
                    material.set(kind, property);
                }
            }
        }
        // in the order of the registry, however they were written
        material.properties.sort_by_key(|(kind, _)| PropertyKind::ALL.iter().position(|k| k == kind));
        Ok(material)
    }
}

/// The value itself where it stands in a table.
fn value_of(at: &At<Value>) -> &At<Value> {
    match &at.value {
        Value::Table(entries) => entries.iter().find(|(k, _)| k.value == "value").map_or(at, |(_, v)| v),
        _ => at,
    }
}

fn property(kind: PropertyKind, at: &At<Value>) -> Result<Property, LawError> {
    let number = |at: &At<Value>| kind.read(&at.value).map_err(|e| e.at(at.span.clone()));
    let Value::Table(entries) = &at.value else { return Ok(Property { value: number(at)?, ..Property::default() }) };
    let mut property = Property { value: f64::NAN, ..Property::default() };
    for (key, at) in entries {
        match key.value.as_str() {
            "value" => property.value = number(at)?,
            "low" => property.low = Some(number(at)?),
            "high" => property.high = Some(number(at)?),
            "source" => property.source = Some(text("source", at)?),
            "typical" => property.typical = Some(text("typical", at)?),
            "note" => property.note = Some(text("note", at)?),
            "printed" => property.printed = Some(text("printed", at)?),
            "alternatives" => property.alternatives = alternatives(kind, at)?,
            _ => return Err(unknown("key of a property", key, PROPERTY.to_vec())),
        }
    }
    if entries.iter().all(|(k, _)| k.value != "value") {
        return Err(LawError::new(format!("{} without a value", kind.key()))
            .help("give value = ...")
            .at(at.span.clone()));
    }
    Ok(property)
}

fn alternatives(kind: PropertyKind, at: &At<Value>) -> Result<Vec<Alternative>, LawError> {
    let wanted = "a list of tables { value, low, high, source, note }";
    let Value::List(items) = &at.value else { return Err(at.value.unfit("alternatives", wanted).at(at.span.clone())) };
    let one = |item: &At<Value>| {
        let Value::Table(entries) = &item.value else {
            return Err(item.value.unfit("alternatives", wanted).at(item.span.clone()));
        };
        let mut other = Alternative::default();
        for (key, at) in entries {
            let number = || kind.read(&at.value).map(Some).map_err(|e| e.at(at.span.clone()));
            match key.value.as_str() {
                "value" => other.value = number()?,
                "low" => other.low = number()?,
                "high" => other.high = number()?,
                "source" => other.source = Some(text("source", at)?),
                "note" => other.note = Some(text("note", at)?),
                _ => return Err(unknown("key of an alternative", key, ALTERNATIVE.to_vec())),
            }
        }
        Ok(other)
    };
    items.iter().map(one).collect()
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for super::MaterialRef {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read = match Value::deserialize(deserializer)? {
            Value::Text(text) => text.parse(),
            Value::Table(entries) => Material::from_entries("inline", &entries).map(|m| Self::Inline(Box::new(m))),
            other => Err(other.unfit("material", "a material's name, or a table of its properties,")),
        };
        read.map_err(serde::de::Error::custom)
    }
}
