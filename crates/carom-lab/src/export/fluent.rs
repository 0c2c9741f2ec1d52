//! Ansys Fluent: the discrete phase condition `reflect` of a wall, restitutions as polynomials of the impact angle.
//!
//! The panels Normal and Tangent of a wall's DPM tab take a constant, a polynomial of up to 8 coefficients (lowest power first), straight
//! lines or up to three pieces of polynomials, as for temperature-dependent properties (Fluent User's Guide 6.3, §22.13.1 and §8.2;
//! 2024 R2, §24.4.1 and §8.2). Their argument is the angle between the path and the wall. The guides do not print its unit; the settings in
//! use enter Grant & Tabakoff's curve as 0.993 − 0.0307α + 4.75e-4α² − 2.61e-6α³, which is in degrees. Radians can be asked for.
//!
//! Speed and size are unknown to the condition. So each polynomial follows the mean, over the speeds and diameters of its cell in equal
//! ratios, of the restitution of those impacts that rebound; and the type is `trap` where the law captures more than half of them.

use super::deviation::{Deviation, FATE_OF_MOST};
use super::sample::{Cell, Sample, by_angle, captured};
use super::{Request, number, polynomial};
use crate::error::LabError;
use carom::WallLaw;
use std::fmt::Write as _;

/// Unit of the angle in the polynomials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AngleUnit {
    /// Degrees, as in Fluent's panels.
    #[default]
    Degrees,
    /// Radians.
    Radians,
}

impl AngleUnit {
    /// An angle given in degrees.
    pub fn of(self, degrees: f64) -> f64 {
        match self {
            Self::Degrees => degrees,
            Self::Radians => degrees.to_radians(),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Degrees => "degrees",
            Self::Radians => "radians",
        }
    }
}

/// The condition of a wall for one cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// Everything stays.
    Trap,
    /// Everything bounces: e and e_t, lowest power first.
    Reflect {
        /// Normal coefficient of restitution.
        normal: Vec<f64>,
        /// Tangential coefficient of restitution.
        tangent: Vec<f64>,
    },
}

impl Condition {
    /// e and e_t at an angle in degrees, `None` for a capture.
    pub fn at(&self, degrees: f64, unit: AngleUnit) -> Option<(f64, f64)> {
        match self {
            Self::Trap => None,
            Self::Reflect { normal, tangent } => {
                let at = |c: &[f64]| polynomial::value(c, unit.of(degrees));
                Some((at(normal), at(tangent)))
            }
        }
    }
}

/// The condition that serves the impacts of a cell.
pub fn condition(samples: &[Sample], degree: usize, unit: AngleUnit) -> Condition {
    if captured(samples) > 0.5 {
        return Condition::Trap;
    }
    let fitted = |get: fn((f64, f64)) -> f64, low| {
        let (angles, values) = by_angle(samples, get);
        let angles: Vec<f64> = angles.into_iter().map(|a| unit.of(a)).collect();
        polynomial::bounded(&angles, &values, degree, (0.0, unit.of(90.0)), (low, 1.0))
    };
    // a law may send a sphere back, e_t < 0; where none does, no polynomial shall
    let lowest = samples.iter().filter_map(|s| s.rebound).map(|r| r.1).fold(0.0, f64::min);
    Condition::Reflect { normal: fitted(|r| r.0, 0.0), tangent: fitted(|r| r.1, lowest) }
}

/// The condition of a cell, the share that the law captures and the deviation.
///
/// # Errors
/// What the law refuses.
pub fn fit(
    law: &WallLaw,
    cell: &Cell,
    degree: usize,
    unit: AngleUnit,
) -> Result<(Condition, f64, Deviation), LabError> {
    let samples = cell.samples(law)?;
    let condition = condition(&samples, degree, unit);
    let deviation = Deviation::of(&samples, |s| condition.at(s.angle, unit));
    deviation.within(&FATE_OF_MOST, cell)?;
    Ok((condition, captured(&samples), deviation))
}

pub(super) fn write(request: &Request, degree: usize, unit: AngleUnit) -> Result<String, LabError> {
    let mut text = request.heading(
        "#",
        &[
            "Ansys Fluent: wall, DPM tab, Discrete Phase Reflection Coefficients",
            &format!(
                "polynomials of the impact angle in {}, lowest power first, within bounds from 0 to 90 deg",
                unit.name()
            ),
            "they follow the mean over speeds and diameters of the impacts that rebound",
        ],
    );
    for cell in request.cells() {
        let (condition, stuck, deviation) = fit(request.law, &cell, degree, unit)?;
        let _ = writeln!(text, "\n[diameter {}, speed {}]", cell.diameters.told_in(1e6, "um"), cell.speeds.told("m/s"));
        match &condition {
            Condition::Trap => text.push_str("type     trap\n"),
            Condition::Reflect { normal, tangent } => {
                let _ = writeln!(text, "type     reflect\nnormal   {}\ntangent  {}", panel(normal), panel(tangent));
            }
        }
        for line in deviation.lines(stuck) {
            let _ = writeln!(text, "# {line}");
        }
    }
    Ok(text)
}

fn panel(coefficients: &[f64]) -> String {
    let kind = if coefficients.len() == 1 { "constant  " } else { "polynomial" };
    coefficients.iter().fold(kind.to_owned(), |text, c| text + " " + &number(*c))
}
