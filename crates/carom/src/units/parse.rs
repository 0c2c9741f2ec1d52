//! Reading `number unit·unit/unit`.

use super::Dimension;
use crate::math;
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

/// A text that is not the wanted quantity. `at` is the character (0-based) where reading stopped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// The text as given.
    pub text: String,
    /// Character index of the trouble.
    pub at: usize,
    /// What is wrong there.
    pub message: String,
    /// The kind of quantity wanted.
    pub what: &'static str,
    /// A text that would be right.
    pub example: &'static str,
}

impl core::error::Error for UnitError {}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { text, at, message, what, example } = self;
        let article = article(what);
        write!(f, "\"{text}\": {message} (character {}); {article} {what} is wanted, such as \"{example}\"", at + 1)
    }
}

/// The article that goes with a kind of quantity.
pub(super) fn article(what: &str) -> &'static str {
    if what.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}

/// What the caller wants to read.
pub(super) struct Wanted {
    pub what: &'static str,
    pub dimension: Dimension,
    pub si: &'static str,
    pub example: &'static str,
}

const NUMBER: Dimension = [0; 4];

/// Named units: SI factor and power of ten, dimension, takes prefixes. A whole match comes first, then one with a prefix.
const UNITS: &[(&str, f64, i32, Dimension, bool)] = &[
    ("m", 1.0, 0, [1, 0, 0, 0], true),
    ("g", 1.0, -3, [0, 1, 0, 0], true),
    ("s", 1.0, 0, [0, 0, 1, 0], true),
    ("K", 1.0, 0, [0, 0, 0, 1], true),
    ("N", 1.0, 0, [1, 1, -2, 0], true),
    ("Pa", 1.0, 0, [-1, 1, -2, 0], true),
    ("J", 1.0, 0, [2, 1, -2, 0], true),
    ("W", 1.0, 0, [2, 1, -3, 0], true),
    ("Hz", 1.0, 0, [0, 0, -1, 0], true),
    ("P", 1.0, -1, [-1, 1, -1, 0], true),
    ("eV", 1.602_176_634, -19, [2, 1, -2, 0], true),
    ("L", 1.0, -3, [3, 0, 0, 0], true),
    ("rad", 1.0, 0, NUMBER, true),
    ("deg", core::f64::consts::PI / 180.0, 0, NUMBER, false),
    ("°", core::f64::consts::PI / 180.0, 0, NUMBER, false),
    ("rpm", core::f64::consts::TAU / 60.0, 0, [0, 0, -1, 0], false),
    ("%", 1.0, -2, NUMBER, false),
    ("min", 60.0, 0, [0, 0, 1, 0], false),
    ("h", 3600.0, 0, [0, 0, 1, 0], false),
    ("day", 86400.0, 0, [0, 0, 1, 0], false),
    ("bar", 1.0, 5, [-1, 1, -2, 0], true),
    ("atm", 101_325.0, 0, [-1, 1, -2, 0], false),
    ("psi", 6_894.757_293_168, 0, [-1, 1, -2, 0], false),
    ("ksi", 6_894.757_293_168, 3, [-1, 1, -2, 0], false),
    ("kpsi", 6_894.757_293_168, 3, [-1, 1, -2, 0], false),
    ("Mpsi", 6_894.757_293_168, 6, [-1, 1, -2, 0], false),
    ("Msi", 6_894.757_293_168, 6, [-1, 1, -2, 0], false),
    ("Torr", 133.322_368_421_052_63, 0, [-1, 1, -2, 0], true),
    ("mmHg", 133.322_387_415, 0, [-1, 1, -2, 0], false),
    ("erg", 1.0, -7, [2, 1, -2, 0], false),
    ("dyn", 1.0, -5, [1, 1, -2, 0], false),
    ("angstrom", 1.0, -10, [1, 0, 0, 0], false),
    ("Å", 1.0, -10, [1, 0, 0, 0], false),
    ("kgf", 9.806_65, 0, [1, 1, -2, 0], false),
    ("lbf", 4.448_221_615_260_5, 0, [1, 1, -2, 0], false),
    ("lb", 0.453_592_37, 0, [0, 1, 0, 0], false),
    ("t", 1.0, 3, [0, 1, 0, 0], false),
    ("micron", 1.0, -6, [1, 0, 0, 0], false),
    ("microns", 1.0, -6, [1, 0, 0, 0], false),
    ("mil", 2.54, -5, [1, 0, 0, 0], false),
    ("mils", 2.54, -5, [1, 0, 0, 0], false),
    ("thou", 2.54, -5, [1, 0, 0, 0], false),
    ("in", 0.0254, 0, [1, 0, 0, 0], false),
    ("inch", 0.0254, 0, [1, 0, 0, 0], false),
    ("inches", 0.0254, 0, [1, 0, 0, 0], false),
    ("ft", 0.3048, 0, [1, 0, 0, 0], false),
    ("foot", 0.3048, 0, [1, 0, 0, 0], false),
    ("feet", 0.3048, 0, [1, 0, 0, 0], false),
    ("cc", 1.0, -6, [3, 0, 0, 0], false),
    ("l", 1.0, -3, [3, 0, 0, 0], true),
    ("mph", 0.447_04, 0, [1, 0, -1, 0], false),
    ("kph", 1000.0 / 3600.0, 0, [1, 0, -1, 0], false),
    ("kmh", 1000.0 / 3600.0, 0, [1, 0, -1, 0], false),
    ("fps", 0.3048, 0, [1, 0, -1, 0], false),
    ("sec", 1.0, 0, [0, 0, 1, 0], false),
    ("hr", 3600.0, 0, [0, 0, 1, 0], false),
    ("rev", core::f64::consts::TAU, 0, NUMBER, false),
    ("RPM", core::f64::consts::TAU / 60.0, 0, [0, 0, -1, 0], false),
    ("degree", core::f64::consts::PI / 180.0, 0, NUMBER, false),
    ("degrees", core::f64::consts::PI / 180.0, 0, NUMBER, false),
    ("dyne", 1.0, -5, [1, 1, -2, 0], false),
];

const PREFIXES: &[(&str, i32)] = &[
    ("z", -21),
    ("a", -18),
    ("f", -15),
    ("p", -12),
    ("n", -9),
    ("u", -6),
    ("µ", -6),
    ("μ", -6),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
];

/// Factor, power of ten, dimension.
fn lookup(name: &str) -> Option<(f64, i32, Dimension)> {
    if let Some(u) = UNITS.iter().find(|u| u.0 == name) {
        return Some((u.1, u.2, u.3));
    }
    PREFIXES.iter().find_map(|(prefix, power)| {
        let rest = name.strip_prefix(prefix)?;
        UNITS.iter().find(|u| u.4 && u.0 == rest).map(|u| (u.1, u.2 + power, u.3))
    })
}

fn superscript(c: char) -> Option<char> {
    "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|s| s == c).and_then(|i| char::from_digit(i as u32, 10)).or((c == '⁻').then_some('-'))
}

/// Reads `text` as the wanted quantity, in SI units.
pub(super) fn parse(text: &str, wanted: &Wanted) -> Result<f64, UnitError> {
    let chars: Vec<char> = text.chars().collect();
    let fail = |at: usize, message: String| UnitError {
        text: text.to_owned(),
        at,
        message,
        what: wanted.what,
        example: wanted.example,
    };
    let start = chars.iter().position(|c| !c.is_whitespace()).ok_or_else(|| fail(0, "nothing here".into()))?;
    let end = number_end(&chars, start);
    let digits: String = chars[start..end].iter().collect();
    let value: f64 = digits.parse().map_err(|_| fail(start, "no number here".into()))?;
    if !value.is_finite() {
        return Err(fail(start, format!("{digits} is not a finite number")));
    }
    let rest: String = chars[end..].iter().collect();
    match rest.trim() {
        "" => return Ok(value),
        "degC" | "°C" | "C" if wanted.dimension == [0, 0, 0, 1] => {
            return kelvin(value + 273.15).ok_or_else(|| fail(start, "below absolute zero".into()));
        }
        "degF" | "°F" | "F" if wanted.dimension == [0, 0, 0, 1] => {
            return kelvin((value + 459.67) / 1.8).ok_or_else(|| fail(start, "below absolute zero".into()));
        }
        _ => {}
    }
    let (factor, power, dimension) = product(&chars, end).map_err(|(at, message)| fail(at, message))?;
    if dimension != wanted.dimension {
        let unit = rest.trim();
        let si = if wanted.si.is_empty() { "no unit".to_owned() } else { format!("a unit like {}", wanted.si) };
        let at = end + chars[end..].iter().take_while(|c| c.is_whitespace()).count();
        return Err(fail(at, format!("'{unit}' is no unit of {}: {si} fits", wanted.what)));
    }
    // the powers of ten go into the literal, so that "0.07 mm" is 7e-5 to the last bit
    let si = shifted(&digits, power).unwrap_or(value * math::powi(10.0, power)) * factor;
    if si.is_finite() && (si != 0.0 || value == 0.0) {
        Ok(si)
    } else {
        Err(fail(start, "too large or too small for a double".into()))
    }
}

fn kelvin(k: f64) -> Option<f64> {
    (k >= 0.0).then_some(k)
}

/// End of the number that begins at `start`: sign, digits, point, exponent, or a word such as `inf` or `NaN`.
fn number_end(chars: &[char], start: usize) -> usize {
    let mut i = start;
    if matches!(chars.get(i), Some('+' | '-')) {
        i += 1;
    }
    let word: String = chars[i..].iter().take_while(|c| c.is_ascii_alphabetic()).collect();
    if ["inf", "infinity", "nan"].contains(&word.to_ascii_lowercase().as_str()) {
        return i + word.len();
    }
    while chars.get(i).is_some_and(|c| c.is_ascii_digit() || *c == '.') {
        i += 1;
    }
    if matches!(chars.get(i), Some('e' | 'E')) {
        let signed = i + 1 + usize::from(matches!(chars.get(i + 1), Some('+' | '-')));
        if chars.get(signed).is_some_and(char::is_ascii_digit) {
            i = signed + chars[signed..].iter().take_while(|c| c.is_ascii_digit()).count();
        }
    }
    i
}

/// The literal with its exponent raised by `power`.
fn shifted(digits: &str, power: i32) -> Option<f64> {
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
    let exponent = exponent.parse::<i32>().ok()?.checked_add(power)?;
    format!("{mantissa}e{exponent}").parse().ok()
}

type Product = (f64, i32, Dimension);

/// A product of units from `i` on: (factor, power of ten, dimension).
fn product(chars: &[char], mut i: usize) -> Result<Product, (usize, String)> {
    let (mut factor, mut power, mut dimension) = (1.0, 0, NUMBER);
    let mut inverse = false;
    while i < chars.len() {
        match chars[i] {
            c if c.is_whitespace() || c == '*' || c == '·' => i += 1,
            '/' if inverse => return Err((i, "two '/' in a row".into())),
            '/' => {
                inverse = true;
                i += 1;
            }
            '1' if chars.get(i + 1) == Some(&'/') => i += 1,
            _ => {
                let (next, name, exponent) = unit(chars, i);
                let (f, p, d) = lookup(&name).ok_or_else(|| (i, unknown(&name)))?;
                let exponent = if inverse { -exponent } else { exponent };
                if exponent == 0 || exponent.abs() > 9 {
                    return Err((i, format!("'{name}' to the power {exponent}")));
                }
                factor *= math::powi(f, exponent);
                power += p * exponent;
                for (total, one) in dimension.iter_mut().zip(d) {
                    *total = total.saturating_add(one.saturating_mul(exponent as i8));
                }
                inverse = false;
                i = next;
            }
        }
    }
    if inverse { Err((chars.len() - 1, "nothing after '/'".into())) } else { Ok((factor, power, dimension)) }
}

fn unknown(name: &str) -> String {
    let near = |u: &&str| (2..40).contains(&name.len()) && distance_is_one(u, name);
    match UNITS.iter().map(|u| u.0).filter(near).min() {
        Some(u) => format!("unknown unit '{name}', did you mean '{u}'?"),
        None => format!("unknown unit '{name}'"),
    }
}

#[cfg(feature = "std")]
fn distance_is_one(a: &str, b: &str) -> bool {
    strsim::damerau_levenshtein(a, b) == 1
}

#[cfg(not(feature = "std"))]
fn distance_is_one(_: &str, _: &str) -> bool {
    false
}

/// One unit with its exponent: `m3`, `m^3`, `m³`, `s-1`.
fn unit(chars: &[char], start: usize) -> (usize, String, i32) {
    let stop = |c: &char| c.is_whitespace() || "*/·^-+".contains(*c) || c.is_ascii_digit() || superscript(*c).is_some();
    let mut i = start + chars[start..].iter().take_while(|c| !stop(c)).count();
    if i == start {
        i += 1;
    }
    let name: String = chars[start..i].iter().collect();
    if chars.get(i) == Some(&'^') {
        i += 1;
    }
    let mut digits = String::new();
    while let Some(c) =
        chars.get(i).and_then(|&c| superscript(c).or((c.is_ascii_digit() || c == '-' || c == '+').then_some(c)))
    {
        digits.push(c);
        i += 1;
    }
    let exponent = if digits.is_empty() { 1 } else { digits.parse().unwrap_or(0) };
    (i, name, exponent)
}
