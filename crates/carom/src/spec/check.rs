//! Refusals shared by the parts of a law.

use super::{At, CurveSpec};
use crate::error::SpecError;

pub(super) fn need(what: &str, key: &str) -> SpecError {
    SpecError::new(format!("the law needs {what}")).help(format!("give {key}"))
}

/// The number, if it is given and `fits`.
pub(super) fn checked<T>(
    given: &Option<At<T>>,
    key: &str,
    get: impl Fn(&T) -> f64,
    fits: impl Fn(f64) -> bool,
    right: &str,
) -> Result<Option<f64>, SpecError> {
    let Some(at) = given else { return Ok(None) };
    let value = get(&at.value);
    if fits(value) {
        Ok(Some(value))
    } else {
        Err(SpecError::new(format!("{key} = {value}")).help(right).at(at.span.clone()))
    }
}

pub(super) fn positive(v: f64) -> bool {
    v > 0.0 && v.is_finite()
}

pub(super) fn not_negative(v: f64) -> bool {
    v >= 0.0 && v.is_finite()
}

/// A `constant` law takes a number, a `by-angle` law a curve.
pub(super) fn form_fits(constant: bool, at: &At<CurveSpec>, key: &str) -> Result<(), SpecError> {
    let right = match (constant, at.value.is_constant()) {
        (true, false) => format!("a curve needs {key} = \"by-angle\""),
        (false, true) => format!("a number needs {key} = \"constant\""),
        _ => return Ok(()),
    };
    Err(SpecError::new(format!(
        "{key} = \"{}\" does not fit its restitution",
        if constant { "constant" } else { "by-angle" }
    ))
    .help(right)
    .at(at.span.clone()))
}
