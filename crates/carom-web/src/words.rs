//! Words for who sits before the page: its fields, what is wrong with a field, what an answer warns of.

use crate::answers::Motion;
use crate::json;
use carom::error::Wording;
use carom::spec::{Key, parse_law};
use carom::units::{Angle, AngularVelocity, Length, Speed, UnitError};
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

/// A diameter (0), a speed (1), an angle (2), a spin (3), read as the command reads its flags.
pub fn quantity(kind: u32, text: &str) -> Result<f64, String> {
    let said = |e: UnitError| e.to_string();
    let text = text.trim();
    let (value, fits, right) = match kind {
        0 => {
            let v = text.parse::<Length>().map_err(said)?.0;
            (
                v,
                (1e-10..=1.0).contains(&v),
                "a diameter lies between 0.1 nm and 1 m, such as 90 um; a bare number is in metres",
            )
        }
        1 => {
            let v = text.parse::<Speed>().map_err(said)?.0;
            (v, v > 0.0 && v < 1e9, "a speed lies above 0 and below 1e9 m/s")
        }
        2 => {
            // by hand, so that 30deg is 30 to the last bit
            let bare = text.trim_end_matches("deg").trim_end_matches('°').trim_end();
            let v = match bare.parse::<f64>() {
                Ok(v) => v,
                Err(_) => text.parse::<Angle>().map_err(said)?.0.to_degrees(),
            };
            (v, v > 0.0 && v <= 90.0, "an angle is measured from the surface, above 0 and up to 90 degrees (head-on)")
        }
        _ => {
            let v = text.parse::<AngularVelocity>().map_err(said)?.0;
            (v, v.abs() < 1e100, "a spin lies below 1e100 rad/s")
        }
    };
    if fits { Ok(value) } else { Err(format!("{text} is out of range; {right}")) }
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
