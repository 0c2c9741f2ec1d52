//! `restitution = 0.7`, `"grant-tabakoff"`, `{ polynomial = [...] }`, `{ angle_deg = [...], value = [...] }` or `{ pieces = [...] }`.

use super::keys::Key;
use super::value::{Entry, Value};
use super::values::unknown_name;
use crate::error::{LawError, Problem};
use crate::normal::empirical::{AngleTable, Curve};
use crate::units::Number;
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::string::ToString;
use alloc::vec::Vec;

/// A restitution as written: a number or a curve by angle of incidence, already checked for its form.
#[derive(Clone, Debug, PartialEq)]
pub enum CurveSpec {
    /// A number.
    Constant(f64),
    /// A curve.
    ByAngle(AngleTable),
    /// The name of a curve that comes with carom.
    Named(String),
}

impl From<f64> for Curve {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

impl From<AngleTable> for Curve {
    fn from(table: AngleTable) -> Self {
        Self::ByAngle(table)
    }
}

const FORMS: &str = "write { polynomial = [...] } (angle from the surface, radians), { angle_deg = [...], value = [...] } or { pieces = [{ from_deg, to_deg, polynomial }] }";
const KEYS: [&str; 4] = ["polynomial", "angle_deg", "value", "pieces"];
const PIECE_KEYS: [&str; 3] = ["from_deg", "to_deg", "polynomial"];

/// The keys of a table, each known.
fn known(entries: &[Entry], known: &[&'static str]) -> Result<(), LawError> {
    match entries.iter().find(|(key, _)| !known.contains(&key.value.as_str())) {
        None => Ok(()),
        Some((key, _)) => {
            let problem = Problem::UnknownKey { what: "key of a curve", key: key.value.clone(), known: known.to_vec() };
            Err(LawError::from(problem).at(key.span.clone()))
        }
    }
}

fn get<'a>(entries: &'a [Entry], key: &str) -> Option<&'a super::At<Value>> {
    entries.iter().find(|(k, _)| k.value == key).map(|(_, v)| v)
}

fn table(entries: &[Entry]) -> Result<AngleTable, LawError> {
    known(entries, &KEYS)?;
    let numbers =
        |key: &str| get(entries, key).map(|at| at.value.numbers(key).map_err(|e| e.at(at.span.clone()))).transpose();
    match KEYS.map(|k| get(entries, k).is_some()) {
        [true, false, false, false] => AngleTable::polynomial(&numbers("polynomial")?.unwrap_or_default()),
        [false, true, true, false] => AngleTable::piecewise_linear(
            &numbers("angle_deg")?.unwrap_or_default(),
            &numbers("value")?.unwrap_or_default(),
        ),
        [false, false, false, true] => AngleTable::piecewise_polynomial(&pieces(entries)?),
        _ => Err(LawError::new("a curve takes exactly one form").help(FORMS)),
    }
}

fn pieces(entries: &[Entry]) -> Result<Vec<(f64, f64, Vec<f64>)>, LawError> {
    let Some(super::At { value: Value::List(items), .. }) = get(entries, "pieces") else {
        return Err(LawError::new("pieces is not a list").help(FORMS));
    };
    let piece = |item: &super::At<Value>| {
        let Value::Table(entries) = &item.value else {
            return Err(item.value.unfit("pieces", "a table for each piece"));
        };
        known(entries, &PIECE_KEYS)?;
        let lacks = |key: &str| LawError::new(format!("a piece without {key}")).help(FORMS);
        let degrees = |key: &str| {
            let at = get(entries, key).ok_or_else(|| lacks(key))?;
            at.value.number().ok_or_else(|| at.value.unfit(key, "an angle in degrees").at(at.span.clone()))
        };
        let polynomial = get(entries, "polynomial").ok_or_else(|| lacks("polynomial"))?.value.numbers("polynomial")?;
        Ok((degrees("from_deg")?, degrees("to_deg")?, polynomial))
    };
    items.iter().map(|i| piece(i).map_err(|e| e.at(i.span.clone()))).collect()
}

impl CurveSpec {
    pub(super) fn from_value(key: Key, value: &Value) -> Result<Self, LawError> {
        match (value, value.number()) {
            (Value::Text(text), _) => match text.parse::<Number>() {
                Ok(number) => Ok(Self::Constant(number.0)),
                Err(error) if is_numeric(text) => Err(Problem::WrongUnit { key: key.name().to_owned(), error }.into()),
                Err(_) => Ok(Self::Named(text.trim().to_owned())),
            },
            (_, Some(number)) => Ok(Self::Constant(number)),
            (Value::Table(entries), _) => table(entries).map(Self::ByAngle),
            _ => {
                Err(value
                    .unfit(key.name(), format!("a number between 0 and 1, the name of a curve, or a curve ({FORMS})")))
            }
        }
    }

    /// The curve itself.
    pub(super) fn resolve(&self, key: Key) -> Result<Curve, LawError> {
        match self {
            Self::Constant(value) => Ok(Curve::Constant(*value)),
            Self::ByAngle(table) => Ok(Curve::ByAngle(table.clone())),
            Self::Named(name) => named(name, key),
        }
    }
}

/// Is it meant to be a number?
fn is_numeric(text: &str) -> bool {
    text.trim().starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) || text.trim().parse::<f64>().is_ok()
}

/// A curve's values, within what a restitution may be: e in [0, 1], e_t in [−1, 1].
pub(super) fn check(key: Key, curve: &Curve) -> Result<(), LawError> {
    let low = if key == Key::Restitution { 0.0 } else { -1.0 };
    match curve {
        Curve::Constant(value) if *value >= low && *value <= 1.0 => Ok(()),
        Curve::Constant(value) => Err(Problem::OutOfRange {
            key: key.name().to_owned(),
            value: value.to_string(),
            unit: "",
            right: format!("it lies between {low} and 1"),
        }
        .into()),
        Curve::ByAngle(table) => table
            .check_range(low, 1.0)
            .map_err(|e| Problem::Curve { key, message: e.message(), help: e.remedy() }.into()),
    }
}

/// Curves that come with carom: name, file.
#[cfg(feature = "toml")]
const BUILTIN: &[(&str, &str)] = &[("grant-tabakoff", include_str!("../../data/curves/grant-tabakoff-1975.toml"))];
#[cfg(not(feature = "toml"))]
const BUILTIN: &[(&str, &str)] = &[];

/// The curve of that name, for the normal or the tangential restitution.
fn named(name: &str, key: Key) -> Result<Curve, LawError> {
    let Some((_, text)) = BUILTIN.iter().find(|b| b.0 == name) else {
        let names: Vec<&str> = BUILTIN.iter().map(|b| b.0).collect();
        return Err(unknown_name("curve", name, &names));
    };
    let part = if key == Key::Restitution { "normal" } else { "tangential" };
    read_part(text, part, key)
}

#[cfg(feature = "toml")]
fn read_part(text: &str, part: &str, key: Key) -> Result<Curve, LawError> {
    let entries = super::value::document(text)?;
    let value = get(&entries, part).ok_or_else(|| LawError::new(format!("the curve has no {part} part")))?;
    CurveSpec::from_value(key, &value.value)?.resolve(key)
}

#[cfg(not(feature = "toml"))]
fn read_part(_: &str, part: &str, _: Key) -> Result<Curve, LawError> {
    Err(LawError::new(format!("the curve has no {part} part")))
}
