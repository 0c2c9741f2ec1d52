//! What a column is called, and its unit.

use std::ops::Range;

/// A column's name and unit.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Heading {
    /// As written, without quotes.
    pub written: String,
    /// Without its unit, in lower case, with `_` for what is neither letter nor digit.
    pub name: String,
    /// As written; none where there is none, and none where a dash stands for it.
    pub unit: Option<String>,
    /// Its bytes in the text.
    pub place: Range<usize>,
}

impl Heading {
    /// Of what is written in a field.
    pub(super) fn new(written: &str, place: Range<usize>) -> Self {
        let written = written.trim();
        let (name, unit) = apart(written);
        Self { written: written.to_owned(), name: plain(name), unit: unit.and_then(self::unit), place }
    }

    /// Of a name as a person gives it.
    pub fn of(written: &str) -> Self {
        Self::new(written, 0..0)
    }
}

/// A unit without brackets; none for a dash.
pub(super) fn unit(written: &str) -> Option<String> {
    let bare = written.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim();
    (!matches!(bare, "" | "-" | "–" | "—" | "1" | "none")).then(|| bare.to_owned())
}

/// Lower case, with `_` for what is neither letter nor digit.
fn plain(name: &str) -> String {
    let mut plain = String::with_capacity(name.len());
    for c in name.chars() {
        if c.is_alphanumeric() {
            plain.extend(c.to_lowercase());
        } else if !plain.ends_with('_') {
            plain.push('_');
        }
    }
    plain.trim_matches('_').to_owned()
}

/// The name and the unit of a heading, if it has one.
fn apart(written: &str) -> (&str, Option<&str>) {
    for (open, close) in [('[', ']'), ('(', ')')] {
        let Some(at) = written.strip_suffix(close).and_then(|inside| opening(inside, open, close)) else { continue };
        let (name, inside) = (written[..at].trim_end(), written[at + 1..written.len() - 1].trim());
        if !name.is_empty() && !is_component(inside) {
            return (name, Some(&written[at..]));
        }
    }
    for part in [" / ", " in ", ", ", "/"] {
        if let Some((name, unit)) = written.rsplit_once(part).filter(|(_, unit)| is_unit(unit)) {
            return (name, Some(unit));
        }
    }
    // "v / m/s"
    match written.split_once(" / ").filter(|(_, unit)| is_unit(unit)) {
        Some((name, unit)) => (name, Some(unit)),
        None => (written, None),
    }
}

/// Where the bracket opens that the end of the text closes.
fn opening(inside: &str, open: char, close: char) -> Option<usize> {
    let mut depth = 1;
    for (at, c) in inside.char_indices().rev() {
        depth += i32::from(c == close) - i32::from(c == open);
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

/// The component of a vector, as in `Velocity[i] (m/s)`; a capital K is the kelvin.
fn is_component(inside: &str) -> bool {
    inside != "K" && matches!(inside.to_ascii_lowercase().as_str(), "i" | "j" | "k" | "x" | "y" | "z" | "0" | "1" | "2")
}

const UNITS: [&str; 34] = [
    "m", "mm", "cm", "km", "dm", "um", "µm", "μm", "nm", "in", "ft", "s", "ms", "us", "µs", "μs", "min", "h", "kg",
    "g", "mg", "N", "Pa", "kPa", "MPa", "J", "kJ", "K", "deg", "°", "rad", "degrees", "%", "Hz",
];

/// Whether a text reads as a unit: in brackets, or a product of the usual ones.
pub(super) fn is_unit(text: &str) -> bool {
    let text = text.trim();
    if text.len() > 40 {
        return false;
    }
    let bare = text.strip_prefix(['[', '(']).and_then(|t| t.strip_suffix([']', ')'])).unwrap_or(text);
    let parts = bare.split(|c: char| c.is_whitespace() || "/*·.^".contains(c)).filter(|p| !p.is_empty());
    let power = |c: char| c.is_ascii_digit() || "-+⁻⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c);
    let mut named = false;
    for part in parts {
        let name = part.trim_end_matches(power);
        if !name.is_empty() && !UNITS.contains(&name) {
            return false;
        }
        named |= !name.is_empty();
    }
    named
}
