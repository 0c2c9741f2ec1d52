//! Small checks shared by the parts of a case.

use carom::LawError;
use carom::error::did_you_mean;
use carom::spec::At;
use std::fmt::Display;

/// An error at a place.
pub(super) fn wrong<T>(at: &At<T>, message: impl Into<String>) -> LawError {
    LawError::new(message).at(at.span.clone())
}

/// The value of a word among the known ones.
pub(super) fn word<T: Copy>(text: &At<String>, what: &str, known: &[(&str, T)]) -> Result<T, LawError> {
    known
        .iter()
        .find(|(name, _)| *name == text.value)
        .map(|(_, value)| *value)
        .ok_or_else(|| unknown(text, what, known.iter().map(|k| k.0)))
}

/// An unknown name, with the nearest known one.
pub(super) fn unknown<'a>(text: &At<String>, what: &str, known: impl Iterator<Item = &'a str>) -> LawError {
    let names: Vec<&str> = known.collect();
    let near = did_you_mean(&text.value, names.iter().copied()).map_or(String::new(), |n| format!("{n} "));
    wrong(text, format!("unknown {what} '{}'", text.value)).help(format!("{near}known are {}", names.join(", ")))
}

/// The value of a key that must be there.
pub(super) fn needed<'a, T, P>(
    given: &'a Option<At<T>>,
    table: &At<P>,
    key: &str,
    whose: &str,
) -> Result<&'a At<T>, LawError> {
    given.as_ref().ok_or_else(|| wrong(table, format!("{whose} needs {key}")))
}

/// A positive, finite number.
pub(super) fn positive<T>(at: &At<T>, key: &str, value: f64) -> Result<f64, LawError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(wrong(at, format!("{key} is {value}")).help("it must be positive"))
    }
}

/// Puts an error of a part at the place of its table.
pub(super) fn placed<P>(table: &At<P>, error: impl Display) -> LawError {
    wrong(table, error.to_string())
}
