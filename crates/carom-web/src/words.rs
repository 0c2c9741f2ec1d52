//! Words for who sits before the page: its fields, what is wrong with a field, what an answer warns of.

use crate::json;
use carom::error::Wording;
use carom::plane::{self, Motion};
use carom::spec::{Key, parse_law};
use carom::validity::CODES;
use carom::{AboveYield, ImpactError, Validity};

/// The words of the page: keys are its fields.
#[derive(Clone, Copy, Debug)]
pub struct Fields;

impl Wording for Fields {
    fn key(&self, key: &str) -> String {
        format!("the field '{}'", key.replace('_', " "))
    }

    fn value(&self, value: &str) -> String {
        value.to_owned()
    }

    fn setting(&self, key: &str, value: &str) -> String {
        format!("{}: {value}", key.replace('_', " "))
    }

    fn loss(&self, name: &str) -> String {
        format!("the loss {name} in the list")
    }

    fn materials(&self) -> Option<String> {
        Some("the list of the field shows all".to_owned())
    }
}

/// The keys that a law reads, as JSON.
pub fn reads(text: &str) -> Result<String, String> {
    let spec = parse_law(text).map_err(|e| e.said_in(&Fields))?;
    Ok(json::list(Key::ALL.iter().filter(|k| spec.reads(**k)).map(|k| json::text(k.name()))))
}

/// A diameter (0), a speed (1), an angle (2), a spin (3), read as the command reads its flags; from 4 on the number of a law's key, in
/// SI units, from its line in a law file.
pub fn quantity(kind: u32, text: &str) -> Result<f64, String> {
    match kind {
        0 => plane::diameter(text.trim()),
        1 => plane::speed(text.trim()),
        2 => plane::angle(text.trim()),
        3 => plane::spin(text.trim()),
        _ => {
            let key = *Key::ALL.get(kind as usize - 4).ok_or("there is no such key")?;
            let law = parse_law(text).map_err(|e| e.said_in(&Fields))?;
            law.number(key).ok_or_else(|| format!("the field '{}' wants a number", key.name().replace('_', " ")))
        }
    }
}

/// An impact that is none, in terms of the fields.
pub fn refused(error: ImpactError, motion: &Motion) -> String {
    let Motion { diameter, speed, angle, spin } = *motion;
    match error {
        ImpactError::Curvature | ImpactError::Diameter => format!("diameter {diameter} m: {error}"),
        ImpactError::FrictionNotGiven => format!("an oblique impact needs the field 'friction': {error}"),
        _ => format!("speed {speed} m/s, angle {angle} deg, spin {spin} rad/s: {error}"),
    }
}

/// Warnings as JSON: a list of code and words.
pub fn warnings(validity: Validity, yielding: Option<&AboveYield>) -> String {
    let set = CODES.into_iter().filter(|(_, bit, _)| validity.contains(*bit));
    json::list(set.map(|(code, bit, meaning)| {
        let words = match yielding {
            Some(numbers) if bit == Validity::ABOVE_YIELD => format!("the law has no plastic loss, but {numbers}"),
            _ => meaning.to_owned(),
        };
        json::object([("code", json::text(code)), ("words", json::text(&words))])
    }))
}
