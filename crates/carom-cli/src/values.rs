//! Values of flags that need more than a type's own reading.

use crate::law::Words;
use carom::LawError;
use carom::normal::Loss;
use carom::plane;
pub use carom::plane::{angle, diameter, speed, spin};
use carom::spec::NormalSpec;
use carom::study::{self, Given};
use carom::units::{Angle, Length};
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

/// A diameter, m, or a distribution of it.
pub fn diameters(text: &str) -> Result<Given, String> {
    if text.contains('(') {
        study::read::<Length>(text, plane::DIAMETERS)
    } else {
        plane::diameter(text).map(Given::One)
    }
}

/// The deviation of a wall's facets: degrees, unless a unit is written. Its range is the core's.
pub fn degrees(text: &str) -> Result<Angle, String> {
    match text.trim().parse::<f64>() {
        Ok(degrees) => Ok(Angle(degrees.to_radians())),
        Err(_) => text.parse::<Angle>().map_err(|e| e.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
