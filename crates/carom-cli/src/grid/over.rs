//! `--over`: what runs, and between which ends.

use crate::{law, values};
use carom::error::did_you_mean;
use carom::spec::{Key, LawSpec};
use carom::study::{ratios, steps};
use carom_report::Axis;

/// What can be swept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swept {
    Speed,
    Diameter,
    Angle,
    Spin,
    /// A number of the law.
    Law(Key),
}

impl Swept {
    /// What an impact has.
    pub const ALL: [Self; 4] = [Self::Speed, Self::Diameter, Self::Angle, Self::Spin];

    /// All that can run: what an impact has, and every number of a law.
    pub fn all() -> impl Iterator<Item = Self> {
        let takes = |key: &Key| LawSpec::default().set_number(*key, 0.5);
        Self::ALL.into_iter().chain(Key::ALL.iter().copied().filter(takes).map(Self::Law))
    }

    /// Its flag.
    pub fn flag(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Diameter => "diameter",
            Self::Angle => "angle",
            Self::Spin => "spin",
            Self::Law(key) => law::flag(key),
        }
    }

    /// Reads a value of it, in SI units (degrees for the angle).
    pub fn read(self, text: &str) -> Result<f64, String> {
        match self {
            Self::Speed => values::speed(text),
            Self::Diameter => values::diameter(text),
            Self::Angle => values::angle(text),
            Self::Spin => values::spin(text),
            Self::Law(key) => law::number(key, text),
        }
    }

    /// Column name and unit.
    pub fn column(self) -> (&'static str, &'static str) {
        match self {
            Self::Speed => ("speed", "m/s"),
            Self::Diameter => ("diameter", "m"),
            Self::Angle => ("angle_deg", ""),
            Self::Spin => ("spin", "rad/s"),
            Self::Law(key) => (key.info().name, key.info().unit),
        }
    }
}

/// `speed=0.1m/s..30m/s`, or `speed=1,2,5m/s`
#[derive(Clone, Debug, PartialEq)]
pub struct Over {
    /// What runs.
    pub quantity: Swept,
    /// The smaller end.
    pub from: f64,
    /// The larger end.
    pub to: f64,
    /// The unit of length it was given in.
    pub unit: Option<LengthUnit>,
    /// The values between the ends and with them, where they were listed.
    list: Option<Vec<f64>>,
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
        let form = "a range or a list is wanted, such as speed=0.1m/s..30m/s or speed=1,2,5m/s";
        let (name, range) = text.split_once('=').ok_or(form)?;
        let name = name.trim().trim_start_matches("--").replace('_', "-");
        let quantity = Swept::all().find(|q| q.flag() == name).ok_or_else(|| {
            let names: Vec<&str> = Swept::all().map(Swept::flag).collect();
            let near = did_you_mean(&name, names.iter().copied()).map_or(String::new(), |n| format!("{n} "));
            format!("unknown quantity '{name}'; {near}known are {}", names.join(", "))
        })?;
        match range.split_once("..") {
            Some((from, to)) => Self::between(quantity, from, to),
            None if range.contains(',') => Self::listed(quantity, range),
            None => Err(form.to_owned()),
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
    /// From one text to another.
    pub fn between(quantity: Swept, from: &str, to: &str) -> Result<Self, String> {
        let (low, high) = (quantity.read(&with_unit(from, to))?, quantity.read(to)?);
        if low < high {
            let unit = length_unit(&with_unit(from, to)).filter(|_| quantity == Swept::Diameter);
            Ok(Self { quantity, from: low, to: high, unit, list: None })
        } else {
            Err(format!("the range '{from}..{to}' does not rise; a range is wanted, such as speed=0.1m/s..30m/s"))
        }
    }

    /// Through the values of a list, which share the unit of the last.
    fn listed(quantity: Swept, text: &str) -> Result<Self, String> {
        let written: Vec<&str> = text.split(',').collect();
        if written.iter().any(|value| value.trim().is_empty()) {
            return Err(format!("the list '{text}' has a comma with no value beside it"));
        }
        let last = written.last().copied().unwrap_or_default();
        let read = |value: &&str| quantity.read(&with_unit(value, last));
        let values = written.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let [from, .., to] = values[..] else { return Err("a list has two values or more".to_owned()) };
        if !values.is_sorted_by(|a, b| a < b) {
            return Err(format!("the list '{text}' does not rise; each value is to be above the one before"));
        }
        let unit = length_unit(last).filter(|_| quantity == Swept::Diameter);
        Ok(Self { quantity, from, to, unit, list: Some(values) })
    }

    /// Whether it runs in equal steps: an angle does, and what has no ratio.
    pub fn is_linear(&self) -> bool {
        self.quantity == Swept::Angle || self.from <= 0.0
    }

    /// Its axis.
    pub fn axis(&self, linear: bool) -> Axis {
        let axis = match self.quantity {
            Swept::Speed => Axis::new("speed", "m/s"),
            Swept::Angle => Axis::new("angle of incidence from the surface", "°"),
            Swept::Spin => Axis::new("spin", "rad/s"),
            Swept::Law(key) => Axis::new(law::flag(key).replace('-', " "), key.info().unit),
            Swept::Diameter => {
                let (unit, factor) = match (self.from * self.to).sqrt() {
                    d if d < 5e-7 => ("nm", 1e9),
                    d if d < 1e-3 => ("µm", 1e6),
                    _ => ("mm", 1e3),
                };
                Axis::scaled("diameter", unit, factor)
            }
        };
        let axis = axis.range(self.from, self.to);
        if linear { axis } else { axis.log() }
    }

    /// The points: those of the list, or equal ratios, or equal steps; both ends exact.
    pub fn points(&self, count: usize, linear: bool) -> Vec<f64> {
        if let Some(list) = &self.list {
            return list.clone();
        }
        if linear { steps(self.from, self.to, count) } else { ratios(self.from, self.to, count) }
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
    fn lists_share_their_unit_and_are_taken_as_they_are() {
        let over: Over = "diameter=1,2,5um".parse().expect("a list");
        assert_eq!(over.points(200, false), [1e-6, 2e-6, 5e-6]);
        assert_eq!((over.from, over.to, over.unit), (1e-6, 5e-6, Some(("um", 1e-6))));
        let over: Over = "speed=1, 200 cm/s, 5 m/s".parse().expect("a list");
        assert_eq!(over.points(2, true), [1.0, 2.0, 5.0]);
    }

    #[test]
    fn ranges_that_are_none_are_refused() {
        for (text, part) in [
            ("sped=1..2", "did you mean speed?"),
            ("speed", "a range or a list is wanted"),
            ("speed=1", "a range or a list is wanted"),
            ("speed=2..1", "does not rise"),
            ("speed=1..1", "does not rise"),
            ("speed=0..1", "above 0"),
            ("speed=1..NaN", "finite"),
            ("angle=10..91", "up to 90"),
            ("diameter=1um..1kg", "no unit of length"),
            ("speed=1,5,2", "does not rise"),
            ("speed=1,1", "does not rise"),
            ("speed=1,", "no value beside it"),
            ("speed=1,,2", "no value beside it"),
            ("diameter=1,2kg", "no unit of length"),
        ] {
            let error = text.parse::<Over>().expect_err(text);
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
