//! `--over`: what runs, and between which ends.

use crate::values;
use carom::error::did_you_mean;
use carom::math;

/// What can be swept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swept {
    Speed,
    Diameter,
    Angle,
}

impl Swept {
    /// All that can run.
    pub const ALL: [Self; 3] = [Self::Speed, Self::Diameter, Self::Angle];

    /// Its flag.
    pub fn flag(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Diameter => "diameter",
            Self::Angle => "angle",
        }
    }

    /// Reads a value of it, in SI units (degrees for the angle).
    pub fn read(self, text: &str) -> Result<f64, String> {
        match self {
            Self::Speed => values::speed(text),
            Self::Diameter => values::diameter(text),
            Self::Angle => values::angle(text),
        }
    }

    /// Column name and unit.
    pub fn column(self) -> (&'static str, &'static str) {
        match self {
            Self::Speed => ("speed", "m/s"),
            Self::Diameter => ("diameter", "m"),
            Self::Angle => ("angle_deg", ""),
        }
    }
}

/// `speed=0.1m/s..30m/s`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over {
    /// What runs.
    pub quantity: Swept,
    /// The smaller end.
    pub from: f64,
    /// The larger end.
    pub to: f64,
    /// The unit of length it was given in.
    pub unit: Option<LengthUnit>,
}

/// A unit of length, and what it is in metres.
pub type LengthUnit = (&'static str, f64);

/// The unit of length that a text ends in; none for a bare number, or a unit that nobody gives diameters in.
pub fn length_unit(text: &str) -> Option<LengthUnit> {
    const UNITS: [LengthUnit; 7] =
        [("nm", 1e-9), ("um", 1e-6), ("µm", 1e-6), ("μm", 1e-6), ("mm", 1e-3), ("cm", 1e-2), ("m", 1.0)];
    let given = text.trim();
    UNITS.into_iter().find(|(unit, _)| given.strip_suffix(unit).is_some_and(|n| n.trim().parse::<f64>().is_ok()))
}

impl std::str::FromStr for Over {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let form = "a range is wanted, such as speed=0.1m/s..30m/s";
        let (name, range) = text.split_once('=').ok_or(form)?;
        let names = Swept::ALL.map(Swept::flag);
        let quantity = Swept::ALL.into_iter().find(|q| q.flag() == name.trim()).ok_or_else(|| {
            let near = did_you_mean(name, names).map_or(String::new(), |n| format!("{n} "));
            format!("unknown quantity '{name}'; {near}known are {}", names.join(", "))
        })?;
        let (from, to) = range.split_once("..").ok_or(form)?;
        let unit = length_unit(&with_unit(from, to)).filter(|_| quantity == Swept::Diameter);
        let (from, to) = (quantity.read(&with_unit(from, to))?, quantity.read(to)?);
        if from < to {
            Ok(Self { quantity, from, to, unit })
        } else {
            Err(format!("the range '{range}' does not rise; {form}"))
        }
    }
}

/// A bare number before one with a unit shares it: in `1..100um` both are micrometres.
pub fn with_unit(text: &str, next: &str) -> String {
    let text = text.trim();
    if text.parse::<f64>().is_err() {
        return text.to_owned();
    }
    let next = next.trim();
    let digits = (1..=next.len()).rev().find(|n| next.get(..*n).is_some_and(|t| t.parse::<f64>().is_ok())).unwrap_or(0);
    format!("{text}{}", &next[digits..])
}

impl Over {
    /// The points: equal ratios, or equal steps; both ends exact.
    pub fn points(&self, count: usize, linear: bool) -> Vec<f64> {
        let last = count - 1;
        let between = |i: usize| {
            let share = i as f64 / last as f64;
            if linear {
                self.from + share * (self.to - self.from)
            } else {
                self.from * math::pow(self.to / self.from, share)
            }
        };
        (0..count)
            .map(|i| match i {
                0 => self.from,
                i if i == last => self.to,
                i => between(i),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_share_their_unit_and_keep_their_ends() {
        let over: Over = "diameter=1..100um".parse().expect("a range");
        let points = over.points(3, false);
        assert_eq!((points[0], points[2]), (1e-6, 1e-4));
        assert!((points[1] / 1e-5 - 1.0).abs() < 1e-12);
        let over: Over = "speed=1e-3..30".parse().expect("a range");
        assert_eq!(over.points(2, true), [1e-3, 30.0]);
    }

    #[test]
    fn ranges_that_are_none_are_refused() {
        for (text, part) in [
            ("sped=1..2", "did you mean speed?"),
            ("speed", "a range is wanted"),
            ("speed=1", "a range is wanted"),
            ("speed=2..1", "does not rise"),
            ("speed=1..1", "does not rise"),
            ("speed=0..1", "above 0"),
            ("speed=1..NaN", "finite"),
            ("angle=10..91", "up to 90"),
            ("diameter=1um..1kg", "no unit of length"),
        ] {
            let error = text.parse::<Over>().expect_err(text);
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
