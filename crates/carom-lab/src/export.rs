//! A wall law as the built-in wall conditions of flow solvers can hold it, for those who may not load a library.
//!
//! | target | what it can know | file |
//! |---|---|---|
//! | Ansys Fluent, `reflect` | restitutions as polynomials of the impact angle | [`fluent`] |
//! | OpenFOAM, `localInteraction` | constants by patch | [`openfoam`] |
//! | Simcenter STAR-CCM+ | field functions of speed, angle and diameter | [`star_ccm`] |
//! | COMSOL Multiphysics | expressions of velocity, normal and diameter | [`comsol`] |
//!
//! Each is fitted to impacts of the law all over a [`Cell`], and the [`Deviation`] of what was written, rounded as it was written,
//! stands beside it. Spheres come without spin, which these conditions do not carry.
//!
//! ```
//! use carom_lab::export::{Range, Request, Span, Target, export};
//! let law = carom::spec::parse_law("normal = \"constant\"\nrestitution = 0.7\ntangential_restitution = 0.9\n")?;
//! let wall = law.compile(carom::material::Library::builtin())?;
//! let range = Range { diameters: Span::new(1e-5, 1e-4), speeds: Span::new(0.1, 30.0), angles: Span::new(5.0, 90.0) };
//! let request = Request { law: &wall, title: "constant", range, bins: 1, speed_bins: 1 };
//! let text = export(&request, &Target::OpenFoam { patch: "walls" }).expect("it answers");
//! assert!(text.contains("e    0.7;") && text.contains("mu   0.1;"));
//! # Ok::<(), carom::LawError>(())
//! ```

pub mod comsol;
mod deviation;
mod expressions;
pub mod fluent;
pub mod formula;
pub mod openfoam;
mod polynomial;
mod sample;
pub mod star_ccm;

pub use deviation::{Deviation, Spread};
pub use polynomial::value as polynomial_value;
pub use sample::{Cell, Sample, Span};

use crate::error::LabError;
use carom::WallLaw;
use carom_report::significant;
use std::fmt::Write as _;

/// Most coefficients of a polynomial, as in Fluent's panels.
pub const MAX_COEFFICIENTS: usize = 8;

/// Digits of every number written.
const DIGITS: usize = 10;

/// Where the law is to hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Diameters, m.
    pub diameters: Span,
    /// Speeds, m/s.
    pub speeds: Span,
    /// Angles from the surface, degrees.
    pub angles: Span,
}

/// What is to be exported.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The law.
    pub law: &'a WallLaw,
    /// The law in a few words.
    pub title: &'a str,
    /// Where it is to hold.
    pub range: Range,
    /// Size bins of equal ratios.
    pub bins: usize,
    /// Speed bins of equal ratios; 1 for the targets to which the speed is a variable.
    pub speed_bins: usize,
}

/// For which program.
#[derive(Clone, Copy, Debug)]
pub enum Target<'a> {
    /// Ansys Fluent.
    Fluent {
        /// Greatest power of the angle.
        degree: usize,
        /// Unit of the angle in the polynomials.
        unit: fluent::AngleUnit,
    },
    /// OpenFOAM.
    OpenFoam {
        /// The patch or patches, as a word or a quoted regular expression.
        patch: &'a str,
    },
    /// Simcenter STAR-CCM+.
    StarCcm {
        /// Greatest power in every polynomial.
        degree: usize,
    },
    /// COMSOL Multiphysics.
    Comsol {
        /// Greatest power in every polynomial.
        degree: usize,
    },
}

/// The text for the program, with how far it is from the law.
///
/// # Errors
/// A range that the law refuses: a diameter beyond its limits, or too large for a concave surface. A law that scatters: these
/// conditions draw nothing.
pub fn export(request: &Request, target: &Target) -> Result<String, LabError> {
    if request.law.scatter().is_some() {
        let message = "the law scatters (roughness_angle), and none of these conditions draws its facets; export the smooth wall with \
                       --roughness-angle 0";
        return Err(LabError::Model(message.to_owned()));
    }
    match *target {
        Target::Fluent { degree, unit } => fluent::write(request, degree, unit),
        Target::OpenFoam { patch } => openfoam::write(request, patch),
        Target::StarCcm { degree } => star_ccm::write(request, degree),
        Target::Comsol { degree } => comsol::write(request, degree),
    }
}

impl Request<'_> {
    /// The cells: size bins, each with its speed bins.
    pub fn cells(&self) -> Vec<Cell> {
        let Range { diameters, speeds, angles } = self.range;
        let speeds = speeds.bins(self.speed_bins);
        let cell = |diameters, speeds| Cell { diameters, speeds, angles };
        diameters.bins(self.bins).into_iter().flat_map(|d| speeds.iter().map(move |v| cell(d, *v))).collect()
    }

    /// What every file says at its top, a comment.
    fn heading(&self, comment: &str, lines: &[&str]) -> String {
        let Range { diameters, speeds, angles } = self.range;
        let mut text = format!("{comment} {}\n", self.title);
        let _ = writeln!(
            text,
            "{comment} diameter {}, speed {}, angle from the surface {}; spheres without spin",
            diameters.told_in(1e6, "um"),
            speeds.told("m/s"),
            angles.told("deg")
        );
        for line in lines {
            let _ = writeln!(text, "{comment} {line}");
        }
        let fastest = speeds.to * angles.to.to_radians().sin();
        if let Ok(Some(warning)) = self.law.above_yield(fastest, diameters.middle(), None) {
            let _ = writeln!(
                text,
                "{comment} above-yield: the law has no plastic loss, but {warning} at the fastest impacts"
            );
        }
        text
    }
}

/// A number as it is written.
fn number(value: f64) -> String {
    significant(value, DIGITS)
}

/// The value that a reader of [`number`] has.
fn rounded(value: f64) -> f64 {
    number(value).parse().unwrap_or(value)
}
