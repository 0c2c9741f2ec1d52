//! Values of flags that need more than a type's own reading.

use crate::uncertain::{self, Given};
use carom::material::MaterialRef;
use carom::normal::Loss;
use carom::scatter;
use carom::spec::{CurvatureRadius, CurveSpec, NormalSpec};
use carom::units::{Angle, AngularVelocity, InverseSpeed, Length, Number, Speed, SurfaceEnergy};
use std::path::PathBuf;

/// A material's name, or `rho=...,E=...`.
pub fn material(text: &str) -> Result<MaterialRef, String> {
    if text.trim().is_empty() {
        return Err("nothing here; a material's name is wanted, such as copper".into());
    }
    text.parse().map_err(|e: carom::SpecError| e.to_string())
}

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
        [one] if Loss::ALL.iter().all(|l| l.name() != *one) => {
            one.parse().map_err(|e: carom::SpecError| format!("{e}, or losses separated by commas"))
        }
        losses => {
            let losses: Result<Vec<Loss>, carom::SpecError> = losses.iter().map(|l| l.parse()).collect();
            losses.map(NormalSpec::Losses).map_err(|e| e.to_string())
        }
    }
}

#[derive(serde::Deserialize)]
struct Inline {
    curve: CurveSpec,
}

/// A number, the name of a curve, or a curve in the law file's form.
fn curve(text: &str) -> Result<CurveSpec, String> {
    let text = text.trim();
    if text.starts_with('{') {
        let read: Result<Inline, _> = toml::from_str(&format!("curve = {text}"));
        return read.map(|r| r.curve).map_err(|e| e.message().to_owned());
    }
    if text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) || text.parse::<f64>().is_ok() {
        return text.parse::<Number>().map(|n| CurveSpec::Constant(n.0)).map_err(|e| e.to_string());
    }
    Ok(CurveSpec::Named(text.to_owned()))
}

/// The normal restitution: a number from 0 to 1, or a curve.
pub fn restitution(text: &str) -> Result<CurveSpec, String> {
    curve_within(text, 0.0)
}

/// The tangential restitution: a number from -1 to 1, or a curve.
pub fn tangential_restitution(text: &str) -> Result<CurveSpec, String> {
    curve_within(text, -1.0)
}

fn curve_within(text: &str, low: f64) -> Result<CurveSpec, String> {
    match curve(text)? {
        CurveSpec::Constant(value) if !(low..=1.0).contains(&value) => {
            Err(format!("{text} is out of range; it lies between {low} and 1"))
        }
        curve => Ok(curve),
    }
}

/// A radius of curvature.
pub fn curvature(text: &str) -> Result<CurvatureRadius, String> {
    text.parse().map_err(|e: carom::units::UnitError| e.to_string())
}

/// A speed of approach, m/s.
pub fn speed(text: &str) -> Result<f64, String> {
    let Speed(value) = text.parse().map_err(|e: carom::units::UnitError| e.to_string())?;
    within(text, value, value > 0.0 && value < 1e9, "a speed lies above 0 and below 1e9 m/s")
}

/// A diameter, m.
pub fn diameter(text: &str) -> Result<f64, String> {
    let Length(value) = text.parse().map_err(|e: carom::units::UnitError| e.to_string())?;
    within(text, value, (1e-10..=10.0).contains(&value), "a diameter lies between 1e-10 m and 10 m, such as 90um")
}

/// A diameter, m, or a distribution of it.
pub fn diameters(text: &str) -> Result<Given, String> {
    if text.contains('(') {
        uncertain::read(text, |l: Length| l.0, (1e-10, 10.0))
    } else {
        diameter(text).map(Given::One)
    }
}

/// C_R, or a distribution of it.
pub fn roughness_factor(text: &str) -> Result<Given, String> {
    uncertain::read(text, |n: Number| n.0, (1e-9, 1.0))
}

/// A length that is not negative, or a distribution of it.
pub fn roughness(text: &str) -> Result<Given, String> {
    uncertain::read(text, |l: Length| l.0, NOT_NEGATIVE)
}

/// A work of adhesion, or a distribution of it.
pub fn work_of_adhesion(text: &str) -> Result<Given, String> {
    uncertain::read(text, |w: SurfaceEnergy| w.0, NOT_NEGATIVE)
}

/// A damping coefficient, or a distribution of it.
pub fn damping(text: &str) -> Result<Given, String> {
    uncertain::read(text, |c: InverseSpeed| c.0, NOT_NEGATIVE)
}

/// A friction coefficient, or a distribution of it.
pub fn friction(text: &str) -> Result<Given, String> {
    uncertain::read(text, |f: Number| f.0, NOT_NEGATIVE)
}

const NOT_NEGATIVE: (f64, f64) = (0.0, f64::INFINITY);

/// The deviation of a wall's facets: degrees, unless a unit is written.
pub fn roughness_angle(text: &str) -> Result<Angle, String> {
    let angle = match text.trim().parse::<f64>() {
        Ok(degrees) => degrees.to_radians(),
        Err(_) => text.parse::<Angle>().map_err(|e| e.to_string())?.0,
    };
    let fits = (0.0..=scatter::LARGEST).contains(&angle);
    within(text, angle, fits, "the standard deviation of a roughness angle lies between 0 and 30 degrees").map(Angle)
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
        assert!(normal_law("eaa").is_err_and(|e| e.contains("did you mean ea")));
        assert!(normal_law("adhesion-work,ea").is_err());
    }

    #[test]
    fn curves_are_numbers_names_or_tables() {
        assert_eq!(curve("0.7"), Ok(CurveSpec::Constant(0.7)));
        assert_eq!(curve("grant-tabakoff"), Ok(CurveSpec::Named("grant-tabakoff".into())));
        assert!(matches!(curve("{ polynomial = [0.9, -0.1] }"), Ok(CurveSpec::ByAngle(_))));
        for wrong in ["nan", "inf", "0.7 m", "{ polynomial = }"] {
            assert!(curve(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_law_in_a_file_has_a_name() {
        assert_eq!(law_place("C:/a.toml:glass"), Ok(("C:/a.toml".into(), "glass".into())));
        assert!(law_place("a.toml").is_err());
        assert!(law_place("a.toml:").is_err());
    }
}
