//! How far what was written is from the law.

use super::sample::{Sample, components};
use carom_report::significant;

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
