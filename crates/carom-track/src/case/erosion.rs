//! `erosion` of a `[[wall]]`: which law, with which numbers.

use super::check::wrong;
use super::text::WallText;
use crate::tracker::Behavior;
use carom::LawError;
use carom::erosion::Erosion;
use carom::spec::At;
use carom::units::{Density, Length, Number, Pressure, Speed};
use std::ops::Range;

/// A law's name, a material of its source, and numbers.
#[derive(Debug, Clone, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ErosionText {
    law: At<String>,
    material: Option<At<String>>,
    density: Option<At<Density>>,
    flow_stress: Option<At<Pressure>>,
    chip_ratio: Option<At<Number>>,
    force_ratio: Option<At<Number>>,
    constant: Option<At<Number>>,
    exponent: Option<At<Number>>,
    brinell: Option<At<Number>>,
    sharpness: Option<At<Number>>,
    reference_ratio: Option<At<Number>>,
    hardness: Option<At<Pressure>>,
    n1: Option<At<Number>>,
    n2: Option<At<Number>>,
    speed_exponent: Option<At<Number>>,
    diameter_exponent: Option<At<Number>>,
    reference_speed: Option<At<Speed>>,
    reference_diameter: Option<At<Length>>,
}

/// A number that is given, and where.
type Given = (&'static str, f64, Option<Range<usize>>);

impl ErosionText {
    fn numbers(&self) -> Vec<Given> {
        macro_rules! given {
            ($($key:ident),*) => {
                [$(self.$key.as_ref().map(|at| (stringify!($key), at.value.0, at.span.clone()))),*]
            };
        }
        let all = given!(
            density,
            flow_stress,
            chip_ratio,
            force_ratio,
            constant,
            exponent,
            brinell,
            sharpness,
            reference_ratio,
            hardness,
            n1,
            n2,
            speed_exponent,
            diameter_exponent,
            reference_speed,
            reference_diameter
        );
        all.into_iter().flatten().collect()
    }
}

/// What impacts take away of a wall, if the case asks.
pub(super) fn of(text: &WallText, behavior: &Behavior) -> Result<Option<Erosion>, LawError> {
    let Some(at) = &text.erosion else { return Ok(None) };
    if matches!(behavior, Behavior::Escape) {
        return Err(wrong(at, "erosion of an opening")
            .help("nothing hits it: leave erosion out of a wall with law = \"escape\""));
    }
    let numbers = at.value.numbers();
    let plain: Vec<(&'static str, f64)> = numbers.iter().map(|(name, value, _)| (*name, *value)).collect();
    let material = at.value.material.as_ref();
    Erosion::new(&at.value.law.value, material.map(|m| m.value.as_str()), &plain).map(Some).map_err(|e| {
        let key = e.key().and_then(|key| numbers.iter().find(|n| n.0 == key)).and_then(|n| n.2.clone());
        let about_material = matches!(e, carom::erosion::ErosionError::Material { .. });
        let material = material.filter(|_| about_material).and_then(|m| m.span.clone());
        let law = matches!(e, carom::erosion::ErosionError::Law).then(|| at.value.law.span.clone()).flatten();
        LawError::new(e.to_string()).at(key.or(material).or(law).or(at.span.clone()))
    })
}
