//! Values of flags that need more than a type's own reading.

use crate::law::Words;
use carom::LawError;
use carom::normal::Loss;
use carom::spec::NormalSpec;
use carom::study::{self, Given};
use carom::units::{Angle, AngularVelocity, Length, Speed};
use std::path::PathBuf;

/// `FILE:NAME`.
pub fn law_place(text: &str) -> Result<(PathBuf, String), String> {
    match text.rsplit_once(':') {
        Some((file, name)) if !file.is_empty() && !name.is_empty() => Ok((file.into(), name.to_owned())),
        _ => Err("a file and the name of a law in it are wanted, such as walls.toml:glass".into()),
    }
}

/// A law's name, or losses separated by commas (or `+`).
pub fn normal_law(text: &str) -> Result<NormalSpec, String> {
    let names: Vec<&str> = text.split([',', '+']).map(str::trim).collect();
    match names.as_slice() {
        [one] if Loss::ALL.iter().all(|l| !l.name().eq_ignore_ascii_case(one)) => {
            one.parse().map_err(|e: LawError| format!("{}, or losses separated by commas", e.said_in(&Words)))
        }
        losses => {
            let losses: Result<Vec<Loss>, LawError> = losses.iter().map(|l| l.parse()).collect();
            losses.map(NormalSpec::Losses).map_err(|e| e.said_in(&Words))
        }
    }
}

/// A speed of approach, m/s.
pub fn speed(text: &str) -> Result<f64, String> {
    let Speed(value) = text.parse().map_err(|e: carom::units::UnitError| e.to_string())?;
    within(text, value, value > 0.0 && value < 1e9, "a speed lies above 0 and below 1e9 m/s")
}

/// A diameter, m.
pub fn diameter(text: &str) -> Result<f64, String> {
    let Length(value) = text.parse().map_err(|e: carom::units::UnitError| e.to_string())?;
    within(
        text,
        value,
        (1e-10..=1.0).contains(&value),
        "a diameter lies between 0.1 nm and 1 m, such as 90um; a bare number is in metres",
    )
}

/// A diameter, m, or a distribution of it.
pub fn diameters(text: &str) -> Result<Given, String> {
    if text.contains('(') { study::read::<Length>(text, (1e-10, 1.0)) } else { diameter(text).map(Given::One) }
}

/// The deviation of a wall's facets: degrees, unless a unit is written. Its range is the core's.
pub fn degrees(text: &str) -> Result<Angle, String> {
    match text.trim().parse::<f64>() {
        Ok(degrees) => Ok(Angle(degrees.to_radians())),
        Err(_) => text.parse::<Angle>().map_err(|e| e.to_string()),
    }
}

/// An angle from the surface: degrees, unless a unit is written.
pub fn angle(text: &str) -> Result<f64, String> {
    // by hand, so that 30deg is 30 to the last bit
    let bare = text.trim().trim_end_matches("deg").trim_end_matches('°').trim_end();
    let degrees = match bare.parse::<f64>() {
        Ok(number) => number,
        Err(_) => text.parse::<Angle>().map_err(|e| e.to_string())?.0.to_degrees(),
    };
    within(
        text,
        degrees,
        degrees > 0.0 && degrees <= 90.0,
        "an angle is measured from the surface, above 0 and up to 90 degrees (head-on)",
    )
}

/// A spin, rad/s.
pub fn spin(text: &str) -> Result<f64, String> {
    let AngularVelocity(value) = text.parse().map_err(|e: carom::units::UnitError| e.to_string())?;
    within(text, value, value.abs() < 1e100, "a spin lies below 1e100 rad/s")
}

fn within(text: &str, value: f64, fits: bool, right: &str) -> Result<f64, String> {
    if fits { Ok(value) } else { Err(format!("{text} is out of range; {right}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_degrees_unless_said_otherwise() {
        assert_eq!(angle("30"), Ok(30.0));
        assert_eq!(angle("30 deg").map(f64::round), Ok(30.0));
        assert!((angle("0.5rad").expect("fits") - 28.6479).abs() < 1e-4);
        for wrong in ["0", "-5", "90.0001", "91", "NaN", "inf", "2rad", "30m"] {
            assert!(angle(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn laws_and_lists_of_losses() {
        assert!(matches!(normal_law("ea"), Ok(NormalSpec::Named(_))));
        assert_eq!(normal_law("adhesion-work"), Ok(NormalSpec::Losses(vec![Loss::AdhesionWork])));
        assert_eq!(
            normal_law("adhesion-work, hertz-damping"),
            Ok(NormalSpec::Losses(vec![Loss::AdhesionWork, Loss::HertzDamping]))
        );
        assert!(matches!(normal_law("EAP"), Ok(NormalSpec::Named(carom::spec::NormalKind::Eap))));
        assert!(normal_law("eaa").is_err_and(|e| e.contains("did you mean ea")));
        assert!(normal_law("adhesion-work,ea").is_err());
    }

    #[test]
    fn a_law_in_a_file_has_a_name() {
        assert_eq!(law_place("C:/a.toml:glass"), Ok(("C:/a.toml".into(), "glass".into())));
        assert!(law_place("a.toml").is_err());
        assert!(law_place("a.toml:").is_err());
    }
}
