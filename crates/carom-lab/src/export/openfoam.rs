//! OpenFOAM: constants of `localInteraction` by patch.
//!
//! For `type rebound`, OpenFOAM (v1912 and later of openfoam.com, `LocalInteraction.C`) changes the velocity relative to the wall by
//! U −= (1 + e)Uₙ where it points into the wall, then U −= μU_t: e is the normal restitution and μ the fraction of the tangential
//! velocity that is lost, 1 − e_t, whatever the friction. `type stick` stops every parcel. Every patch of the mesh must be listed, the
//! first that fits counts, and names may be regular expressions: so a last entry lets parcels out through all other patches.
//!
//! e and μ are those of least square error of the outgoing velocity as a fraction of the speed, over the impacts that rebound, in equal
//! weight for equal ratios of size and speed and equal steps of angle: e = Σ sin²α e/Σ sin²α, 1 − μ = Σ cos²α e_t/Σ cos²α. The type is
//! `stick` where the law captures more than half of the impacts.

use super::deviation::{Deviation, FATE_OF_MOST};
use super::sample::{Cell, Sample, captured, components};
use super::{Request, number, rounded};
use crate::error::LabError;
use carom::WallLaw;
use std::fmt::Write as _;

/// The entry of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interaction {
    /// Everything stays.
    Stick,
    /// Everything bounces.
    Rebound {
        /// Normal restitution.
        e: f64,
        /// Fraction of the tangential velocity lost.
        mu: f64,
    },
}

impl Interaction {
    /// e and e_t, `None` for a capture.
    pub fn at(&self) -> Option<(f64, f64)> {
        match *self {
            Self::Stick => None,
            Self::Rebound { e, mu } => Some((e, 1.0 - mu)),
        }
    }
}

/// The entry that serves the impacts of a cell.
pub fn interaction(samples: &[Sample]) -> Interaction {
    if captured(samples) > 0.5 {
        return Interaction::Stick;
    }
    let mean = |get: fn((f64, f64)) -> f64, part: fn((f64, f64)) -> f64, otherwise: f64| {
        let (mut sum, mut weight) = (0.0, 0.0);
        for sample in samples {
            let Some(value) = sample.rebound.map(get).filter(|v| !v.is_nan()) else { continue };
            let share = sample.weight * part(components(1.0, sample.angle)).powi(2);
            sum += share * value;
            weight += share;
        }
        if weight > 0.0 { sum / weight } else { otherwise }
    };
    let e = mean(|r| r.0, |c| c.0, 1.0);
    let e_t = mean(|r| r.1, |c| c.1, 1.0);
    Interaction::Rebound { e: rounded(e), mu: rounded(1.0 - e_t) }
}

/// The entry of a cell, the share that the law captures and the deviation.
///
/// # Errors
/// What the law refuses.
pub fn fit(law: &WallLaw, cell: &Cell) -> Result<(Interaction, f64, Deviation), LabError> {
    let samples = cell.samples(law)?;
    let interaction = interaction(&samples);
    let deviation = Deviation::of(&samples, |_| interaction.at());
    deviation.within(&FATE_OF_MOST, cell)?;
    Ok((interaction, captured(&samples), deviation))
}

pub(super) fn write(request: &Request, patch: &str) -> Result<String, LabError> {
    let cells = request.cells();
    let mut text = request.heading(
        "//",
        &[
            "OpenFOAM, localInteraction: U -= (1 + e)Un, then U -= mu Ut",
            "least squares of the outgoing velocity over the impacts that rebound",
            "parcels leave through the other patches: change the last entry where they should not",
        ],
    );
    if cells.len() > 1 {
        text.push_str("// #include this file at the top of a cloud's properties; in its subModels write $:bin1;\n");
    }
    for (n, cell) in cells.iter().enumerate() {
        let (interaction, stuck, deviation) = fit(request.law, cell)?;
        let _ =
            writeln!(text, "\n// diameter {}, speed {}", cell.diameters.told_in(1e6, "um"), cell.speeds.told("m/s"));
        for line in deviation.lines(stuck) {
            let _ = writeln!(text, "// {line}");
        }
        if cells.len() > 1 {
            let _ = writeln!(text, "bin{}\n{{", n + 1);
            entry(&mut text, patch, &interaction, "    ");
            text.push_str("}\n");
        } else {
            entry(&mut text, patch, &interaction, "");
        }
    }
    Ok(text)
}

fn entry(text: &mut String, patch: &str, interaction: &Interaction, indent: &str) {
    let mut line = |depth: usize, what: &str| {
        let _ = writeln!(text, "{indent}{}{what}", "    ".repeat(depth));
    };
    line(0, "patchInteractionModel localInteraction;");
    line(0, "localInteractionCoeffs");
    line(0, "{");
    line(1, "patches");
    line(1, "(");
    line(2, patch);
    line(2, "{");
    match interaction {
        Interaction::Stick => line(3, "type stick;"),
        Interaction::Rebound { e, mu } => {
            line(3, "type rebound;");
            line(3, &format!("e    {};", number(*e)));
            line(3, &format!("mu   {};", number(*mu)));
        }
    }
    line(2, "}");
    line(2, "\".*\"");
    line(2, "{");
    line(3, "type escape;");
    line(2, "}");
    line(1, ");");
    line(0, "}");
}
