//! How far what was written is from the law.

use super::sample::{Cell, Sample, components};
use crate::error::LabError;
use carom_report::significant;

/// How far what is written may be from the law; beyond, it is refused.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Share of the impacts that may have the wrong fate.
    wrong_fate: f64,
    /// Greatest root mean square error of the outgoing velocity, as a fraction of the speed.
    velocity: f64,
    /// What would help.
    help: &'static str,
}

/// A formula knows speed, size and angle.
pub const FORMULA: Bounds = Bounds {
    wrong_fate: 0.05,
    velocity: 0.2,
    help: "more size bins, a narrower range of diameters or speeds, or a greater degree would help",
};

/// A condition that does not know the speed can do no better than the fate of most; the error of its velocity is told, not bounded.
pub const FATE_OF_MOST: Bounds = Bounds {
    wrong_fate: 0.5,
    velocity: f64::INFINITY,
    help: "more bins of size and speed, or a narrower range of them, would help",
};

/// The largest and the root mean square of a difference.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Largest.
    pub largest: f64,
    /// Root of the mean square.
    pub rms: f64,
}

/// Differences over the impacts of a cell, equal weight for equal ratios of size and speed and equal steps of angle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Of the normal restitution, over all impacts; a capture counts as 0.
    pub restitution: Spread,
    /// Of the tangential restitution, over the oblique impacts that rebound in both.
    pub tangential: Spread,
    /// Of the outgoing velocity, as a fraction of the incoming speed, over all impacts; a capture leaves with 0.
    pub velocity: Spread,
    /// Share of the impacts with the wrong fate.
    pub wrong_fate: f64,
}

#[derive(Default)]
struct Sum {
    largest: f64,
    squares: f64,
    weight: f64,
}

impl Sum {
    fn add(&mut self, difference: f64, weight: f64) {
        self.largest = self.largest.max(difference.abs());
        self.squares += weight * difference * difference;
        self.weight += weight;
    }

    fn spread(&self) -> Spread {
        let rms = if self.weight > 0.0 { (self.squares / self.weight).sqrt() } else { 0.0 };
        Spread { largest: self.largest, rms }
    }
}

impl Deviation {
    /// Of `written`, which gives e and e_t of a rebound or `None` for a capture.
    pub fn of(samples: &[Sample], written: impl Fn(&Sample) -> Option<(f64, f64)>) -> Self {
        let [mut restitution, mut tangential, mut velocity] = [Sum::default(), Sum::default(), Sum::default()];
        let mut wrong_fate = 0.0;
        for sample in samples {
            let (law, got) = (sample.rebound, written(sample));
            if law.is_some() != got.is_some() {
                wrong_fate += sample.weight;
            }
            let (v_n, v_t) = components(1.0, sample.angle);
            // head-on there is no tangential speed, and a capture leaves with none
            let leaves = |(e, e_t): (f64, f64)| (e * v_n, if v_t == 0.0 { 0.0 } else { e_t * v_t });
            let [a, b] = [law, got].map(|r| r.map_or((0.0, 0.0), leaves));
            velocity.add((a.0 - b.0).hypot(a.1 - b.1), sample.weight);
            restitution.add(law.map_or(0.0, |r| r.0) - got.map_or(0.0, |r| r.0), sample.weight);
            if let (Some(law), Some(got), true) = (law, got, v_t != 0.0) {
                tangential.add(law.1 - got.1, sample.weight);
            }
        }
        Self {
            restitution: restitution.spread(),
            tangential: tangential.spread(),
            velocity: velocity.spread(),
            wrong_fate,
        }
    }

    /// Refuses what is further from the law than it may be.
    ///
    /// # Errors
    /// The bound that is missed, where, and what would help.
    pub fn within(&self, bounds: &Bounds, cell: &Cell) -> Result<(), LabError> {
        let percent = |share: f64| significant(100.0 * share, 3);
        let missed = |what: String| {
            let range = format!("diameter {}, speed {}", cell.diameters.told_in(1e6, "um"), cell.speeds.told("m/s"));
            Err(LabError::Model(format!("{range}: {what}, so nothing is written; {}", bounds.help)))
        };
        // a comparison that NaN fails
        let keeps = |value: f64, bound: f64| value <= bound;
        if !keeps(self.wrong_fate, bounds.wrong_fate) {
            let (got, most) = (percent(self.wrong_fate), percent(bounds.wrong_fate));
            return missed(format!("wrong fate: {got} % of the impacts, where {most} % is the bound"));
        }
        if !keeps(self.velocity.rms, bounds.velocity) {
            let (got, most) = (percent(self.velocity.rms), percent(bounds.velocity));
            return missed(format!(
                "the outgoing velocity is off by {got} % of the speed (rms), where {most} % is the bound"
            ));
        }
        Ok(())
    }

    /// In lines, beside the share of impacts that the law captures.
    pub(super) fn lines(&self, captured: f64) -> [String; 3] {
        let of = |get: fn(&Spread) -> f64| {
            let number = |s: &Spread| told(get(s));
            format!(
                "e {}, e_t {}, outgoing velocity {} of the speed",
                number(&self.restitution),
                number(&self.tangential),
                number(&self.velocity)
            )
        };
        [
            format!("largest error: {}", of(|s| s.largest)),
            format!("rms error: {}", of(|s| s.rms)),
            format!(
                "wrong fate: {} % of the impacts; the law captures {} %",
                significant(100.0 * self.wrong_fate, 3),
                significant(100.0 * captured, 3)
            ),
        ]
    }
}

/// An error as it is told: what is nothing but rounding is not told in digits, which differ from machine to machine.
fn told(error: f64) -> String {
    if error > 0.0 && error < ROUNDING { "below 1e-7".to_owned() } else { significant(error, 3) }
}

/// Errors that ten digits of a coefficient leave.
const ROUNDING: f64 = 1e-7;

#[cfg(test)]
mod tests {
    use super::super::Span;
    use super::*;

    #[test]
    fn what_misses_its_bounds_is_refused_with_what_would_help() {
        let cell =
            Cell { diameters: Span::new(5e-5, 5e-5), speeds: Span::new(10.0, 200.0), angles: Span::new(5.0, 90.0) };
        let wrong = |wrong_fate| Deviation { wrong_fate, ..Deviation::default() };
        assert!(wrong(0.05).within(&FORMULA, &cell).is_ok() && wrong(0.5).within(&FATE_OF_MOST, &cell).is_ok());
        let told = wrong(1.0).within(&FORMULA, &cell).unwrap_err().to_string();
        assert!(
            told.starts_with("diameter 50 um, speed 10 to 200 m/s: wrong fate: 100 % of the impacts, where 5 %"),
            "{told}"
        );
        assert!(told.ends_with("would help"), "{told}");
        assert!(wrong(f64::NAN).within(&FATE_OF_MOST, &cell).is_err());
        let off = Deviation { velocity: Spread { largest: 1.0, rms: 0.3 }, ..Deviation::default() };
        assert!(off.within(&FORMULA, &cell).unwrap_err().to_string().contains("off by 30 % of the speed"));
        assert!(off.within(&FATE_OF_MOST, &cell).is_ok());
    }
}
