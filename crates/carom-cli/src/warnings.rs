//! The warnings about one answer: one line per code, with the numbers where there are some.

use crate::failure::Failure;
use crate::text::Lines;
use carom::validity::CODES;
use carom::{AboveYield, Impact, Validity, WallLaw};

/// The warnings about one impact, with the numbers of `above-yield`.
#[derive(Clone, Debug, Default)]
pub struct Warnings {
    validity: Validity,
    above_yield: Option<AboveYield>,
}

/// The numbers of `above-yield` in JSON.
#[derive(serde::Serialize)]
pub struct Yielding {
    yield_velocity: f64,
    plastic_constant: f64,
    material: Option<String>,
    restitution: f64,
    capture_velocity: Option<f64>,
}

impl Warnings {
    /// Of an impact's outcome, at its normal speed (m/s) and diameter (m).
    pub fn new(law: &WallLaw, validity: Validity, speed: f64, diameter: f64) -> Self {
        let judged = validity.contains(Validity::ABOVE_YIELD);
        let above_yield = if judged { law.above_yield(speed, diameter, None).ok().flatten() } else { None };
        Self { validity, above_yield }
    }

    /// Of a head-on impact.
    pub fn at(law: &WallLaw, speed: f64, diameter: f64) -> Result<Self, Failure> {
        let impact = Impact::new(diameter, [0.0, -speed, 0.0], [0.0, 1.0, 0.0]);
        let outcome = law.impact(&impact).map_err(|e| Failure::input(e.to_string()))?;
        Ok(Self::new(law, outcome.validity, speed, diameter))
    }

    /// The codes.
    pub fn codes(&self) -> Vec<&'static str> {
        self.validity.codes().collect()
    }

    /// The numbers of `above-yield`, if it is among the codes.
    pub fn yielding(&self) -> Option<Yielding> {
        self.above_yield.as_ref().map(|a| Yielding {
            yield_velocity: a.yield_velocity,
            plastic_constant: a.strength.plastic_constant,
            material: a.material.clone(),
            restitution: a.restitution,
            capture_velocity: a.capture_velocity,
        })
    }

    /// Adds a line for each.
    pub fn tell(&self, lines: &mut Lines) {
        for (code, bit, meaning) in CODES {
            if !self.validity.contains(bit) {
                continue;
            }
            match &self.above_yield {
                Some(numbers) if bit == Validity::ABOVE_YIELD => {
                    lines.add("warning", format!("{code}: the law has no plastic loss, but {numbers}"));
                }
                _ => lines.add("warning", format!("{code}: {meaning}")),
            }
        }
    }
}
