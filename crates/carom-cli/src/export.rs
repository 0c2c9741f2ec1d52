//! `carom export`: a wall law as the built-in wall conditions of a flow solver can hold it, with how far that is from the law.

use crate::failure::{Failure, say};
use crate::grid::{Swept, with_unit};
use crate::law::LawArgs;
use crate::output::{self, check_folder};
use carom_lab::LabError;
use carom_lab::export::fluent::AngleUnit;
use carom_lab::export::{MAX_COEFFICIENTS, Range, Request, Span, Target, export};
use std::path::PathBuf;

/// Greatest power of a polynomial.
const MAX_DEGREE: i64 = MAX_COEFFICIENTS as i64 - 1;

const EXAMPLE: &str = "\
Examples:
  carom export --format openfoam --wall-law walls.toml:glass --diameter 10um..100um --speed 0.1m/s..30m/s
  carom export --format fluent --sphere copper --surface glass --friction 0.2 --diameter 50um --speed 1..5m/s
  carom export --format star-ccm --wall-law walls.toml:glass --diameter 1..100um --speed 0.01..30m/s --out walls.txt

A range may be a single value. Beside each condition stands its largest error against the law, in restitution, tangential
restitution and outgoing velocity, and the share of impacts that stick and should bounce or the other way round.";

/// Write a wall law as built-in wall conditions of a flow solver, without linking to carom
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// For which program
    #[arg(long, value_enum, help_heading = "Export")]
    format: Format,
    /// Diameters, such as 10um..100um
    #[arg(long, value_name = "RANGE", value_parser = |t: &str| span(t, Swept::Diameter), help_heading = "Export")]
    diameter: Span,
    /// Size bins, in equal ratios: the smaller they are, the closer the fits; 4 a decade is a good start
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100), help_heading = "Export")]
    bins: u32,
    /// Speeds, such as 0.1m/s..30m/s
    #[arg(long, value_name = "RANGE", value_parser = |t: &str| span(t, Swept::Speed), help_heading = "Export")]
    speed: Span,
    /// fluent, openfoam: a condition for each of N ranges of speed, in equal ratios [default: 1, for all speeds]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100), help_heading = "Export")]
    speed_bins: Option<u32>,
    /// Angles from the surface, degrees
    #[arg(long, value_name = "RANGE", default_value = "5..90", value_parser = |t: &str| span(t, Swept::Angle), help_heading = "Export")]
    angle: Span,
    /// All but openfoam: greatest power in a polynomial, 0 to 7 [default: 5]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=MAX_DEGREE), help_heading = "Export")]
    degree: Option<u32>,
    /// fluent: unit of the angle in the polynomials [default: degrees]
    #[arg(long, value_enum, value_name = "UNIT", help_heading = "Export")]
    angle_unit: Option<Unit>,
    /// openfoam: the patch, a word or a regular expression in quotes [default: walls]
    #[arg(long, value_name = "NAME", value_parser = patch, help_heading = "Export")]
    patch: Option<String>,
    /// Write to a file instead of standard output
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,
    #[command(flatten)]
    law: LawArgs,
}

/// Programs.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    /// Ansys Fluent: polynomials for the reflect condition
    Fluent,
    /// OpenFOAM: a dictionary for localInteraction
    Openfoam,
    /// Simcenter STAR-CCM+: field functions
    StarCcm,
    /// COMSOL Multiphysics: variables
    Comsol,
}

/// Units of an angle.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Unit {
    Degrees,
    Radians,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    args.refuse_idle()?;
    if let Some(path) = &args.out {
        check_folder(path)?;
    }
    let oblique = args.angle != Span::new(90.0, 90.0);
    let law = args.law.compile(oblique)?;
    let request = Request {
        law: &law.wall,
        title: &law.description(),
        range: Range { diameters: args.diameter, speeds: args.speed, angles: args.angle },
        bins: args.bins as usize,
        speed_bins: args.speed_bins.unwrap_or(1) as usize,
    };
    let text = export(&request, &args.target()).map_err(|e| match e {
        LabError::Model(message) => Failure::input(message),
        other => Failure::Other(other.to_string()),
    })?;
    let Some(path) = &args.out else { return output::print(&text) };
    output::write(path, &text)?;
    say(&format!("wrote {}", path.display()));
    Ok(())
}

impl Args {
    fn target(&self) -> Target<'_> {
        let degree = self.degree.unwrap_or(5) as usize;
        match self.format {
            Format::Fluent => {
                let unit = match self.angle_unit {
                    Some(Unit::Radians) => AngleUnit::Radians,
                    _ => AngleUnit::Degrees,
                };
                Target::Fluent { degree, unit }
            }
            Format::Openfoam => Target::OpenFoam { patch: self.patch.as_deref().unwrap_or("walls") },
            Format::StarCcm => Target::StarCcm { degree },
            Format::Comsol => Target::Comsol { degree },
        }
    }

    /// Flags that would silently do nothing, and bins of a single value.
    fn refuse_idle(&self) -> Result<(), Failure> {
        use Format::{Comsol, Fluent, Openfoam, StarCcm};
        let knows_speed = "the speed is a variable there; leave it out";
        for (given, flag, formats, why) in [
            (self.degree.is_some(), "--degree", &[Openfoam][..], "localInteraction takes constants; leave it out"),
            (self.angle_unit.is_some(), "--angle-unit", &[Openfoam, StarCcm, Comsol], "it is for fluent; leave it out"),
            (self.patch.is_some(), "--patch", &[Fluent, StarCcm, Comsol], "it is for openfoam; leave it out"),
            (self.speed_bins.is_some(), "--speed-bins", &[StarCcm, Comsol], knows_speed),
        ] {
            if given && formats.contains(&self.format) {
                return Err(Failure::input(format!("{flag} has no effect with this --format: {why}")));
            }
        }
        for (count, span, flag, of) in [
            (self.bins, self.diameter, "--bins", "--diameter"),
            (self.speed_bins.unwrap_or(1), self.speed, "--speed-bins", "--speed"),
        ] {
            if count > 1 && span.is_point() {
                return Err(Failure::input(format!("{flag} {count}: {of} is a single value, which has no bins")));
            }
        }
        Ok(())
    }
}

/// `A..B`, or a single value.
fn span(text: &str, quantity: Swept) -> Result<Span, String> {
    let Some((from, to)) = text.split_once("..") else { return quantity.read(text).map(|v| Span::new(v, v)) };
    let (from, to) = (quantity.read(&with_unit(from, to))?, quantity.read(to)?);
    if from < to { Ok(Span::new(from, to)) } else { Err(format!("the range '{text}' does not rise")) }
}

/// A word of OpenFOAM, or a regular expression in double quotes.
fn patch(text: &str) -> Result<String, String> {
    let quoted = text.len() > 2 && text.starts_with('"') && text.ends_with('"');
    let inside = if quoted { &text[1..text.len() - 1] } else { text };
    let bad = |c: char| c.is_whitespace() || c.is_control() || "\"'/;{}".contains(c) || (!quoted && "()$#".contains(c));
    if inside.is_empty() || inside.contains(bad) {
        return Err("a patch's name is wanted, such as walls, or a regular expression in quotes, \"wall.*\"".into());
    }
    Ok(text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_is_a_range_or_a_value() {
        assert_eq!(span("10..100um", Swept::Diameter), Ok(Span::new(1e-5, 1e-4)));
        assert_eq!(span("2m/s", Swept::Speed), Ok(Span::new(2.0, 2.0)));
        assert!(span("90..5", Swept::Angle).is_err_and(|e| e.contains("does not rise")));
        assert!(span("5..95", Swept::Angle).is_err_and(|e| e.contains("up to 90")));
        assert!(span("1..", Swept::Speed).is_err());
    }

    #[test]
    fn patches_are_words_or_expressions() {
        for right in ["walls", "wall_1", "\"wall.*\"", "\"(floor|ceiling)\""] {
            assert_eq!(patch(right), Ok(right.to_owned()));
        }
        for wrong in ["", "two walls", "a;b", "\"\"", "a{", "(floor|ceiling)", "\"a"] {
            assert!(patch(wrong).is_err(), "{wrong}");
        }
    }
}
