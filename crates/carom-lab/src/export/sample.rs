//! Impacts of the law all over a cell of sizes, speeds and angles.

use crate::error::LabError;
use carom::{Fate, Impact, WallLaw};
use carom_report::significant;

/// From one value to another; both may be the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The smaller.
    pub from: f64,
    /// The larger.
    pub to: f64,
}

impl Span {
    /// Two positive numbers, in either order.
    pub fn new(from: f64, to: f64) -> Self {
        Self { from: from.min(to), to: from.max(to) }
    }

    /// Is it a single value?
    pub fn is_point(&self) -> bool {
        self.from == self.to
    }

    /// The geometric mean.
    pub fn middle(&self) -> f64 {
        if self.is_point() { self.from } else { self.from * (self.to / self.from).sqrt() }
    }

    /// `count` values in equal ratios, both ends exact; a point is a single value.
    pub fn ratios(&self, count: usize) -> Vec<f64> {
        if self.is_point() { vec![self.from] } else { carom::study::ratios(self.from, self.to, count) }
    }

    /// `count` values in equal steps, both ends exact; a point is a single value.
    pub fn steps(&self, count: usize) -> Vec<f64> {
        if self.is_point() { vec![self.from] } else { carom::study::steps(self.from, self.to, count) }
    }

    /// Parts of equal ratios; a point has one.
    pub fn bins(&self, count: usize) -> Vec<Self> {
        if self.is_point() {
            return vec![*self];
        }
        // the edges within are numbers as they are written, so that a reader's bins are these
        let mut edges = self.ratios(count + 1);
        edges[1..count].iter_mut().for_each(|edge| *edge = super::rounded(*edge));
        edges.windows(2).map(|w| Self { from: w[0], to: w[1] }).collect()
    }

    /// `0.1 to 30 m/s`
    pub fn told(&self, unit: &str) -> String {
        self.told_in(1.0, unit)
    }

    /// `10 to 100 um`: values times a factor.
    pub fn told_in(&self, factor: f64, unit: &str) -> String {
        let number = |v: f64| significant(v * factor, 4);
        if self.is_point() {
            format!("{} {unit}", number(self.from))
        } else {
            format!("{} to {} {unit}", number(self.from), number(self.to))
        }
    }
}

/// Sizes, speeds and angles that one wall condition is to serve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Diameters, m.
    pub diameters: Span,
    /// Speeds, m/s.
    pub speeds: Span,
    /// Angles from the surface, degrees.
    pub angles: Span,
}

/// One impact of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Diameter, m.
    pub diameter: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Angle from the surface, degrees.
    pub angle: f64,
    /// Share of the cell it stands for; all add up to 1.
    pub weight: f64,
    /// e and e_t of a rebound (e_t is NaN head-on); `None` for a capture.
    pub rebound: Option<(f64, f64)>,
}

/// Diameters, speeds and angles looked at in a cell.
const COUNTS: (usize, usize, usize) = (5, 49, 69);

impl Cell {
    /// Impacts in equal ratios of diameter and speed and equal steps of angle, ends included, each weighing what it stands for.
    ///
    /// # Errors
    /// What the law refuses.
    pub fn samples(&self, law: &WallLaw) -> Result<Vec<Sample>, LabError> {
        let (diameters, speeds) = (self.diameters.ratios(COUNTS.0), self.speeds.ratios(COUNTS.1));
        let angles = self.angles.steps(COUNTS.2);
        let mut samples = Vec::with_capacity(diameters.len() * speeds.len() * angles.len());
        for (i, &diameter) in diameters.iter().enumerate() {
            for (j, &speed) in speeds.iter().enumerate() {
                for (k, &angle) in angles.iter().enumerate() {
                    let weight = share(i, diameters.len()) * share(j, speeds.len()) * share(k, angles.len());
                    let rebound = rebound(law, diameter, speed, angle)?;
                    samples.push(Sample { diameter, speed, angle, weight, rebound });
                }
            }
        }
        Ok(samples)
    }
}

/// Weight of a point of the trapezoidal rule.
fn share(place: usize, count: usize) -> f64 {
    match count {
        1 => 1.0,
        _ if place == 0 || place == count - 1 => 0.5 / (count - 1) as f64,
        _ => 1.0 / (count - 1) as f64,
    }
}

/// Normal and tangential part of a speed at an angle in degrees.
pub(super) fn components(speed: f64, angle: f64) -> (f64, f64) {
    // π/2 is no double: head-on has no tangential speed at all
    if angle == 90.0 {
        return (speed, 0.0);
    }
    let (sin, cos) = carom::math::sin_cos(angle.to_radians());
    (speed * sin, speed * cos)
}

/// e and e_t of an impact without spin, `None` for a capture.
pub(super) fn rebound(law: &WallLaw, diameter: f64, speed: f64, angle: f64) -> Result<Option<(f64, f64)>, LabError> {
    let (normal, tangential) = components(speed, angle);
    let impact = Impact::new(diameter, [tangential, -normal, 0.0], [0.0, 1.0, 0.0]);
    let refused = |e| LabError::Model(format!("{diameter} m at {speed} m/s and {angle} deg: {e}"));
    let outcome = law.impact(&impact).map_err(refused)?;
    Ok((outcome.fate == Fate::Rebound).then_some((outcome.restitution, outcome.tangential_restitution)))
}

/// Mean of a value of the rebounds at each angle, where there is any: (degrees, means).
pub(super) fn by_angle(samples: &[Sample], get: impl Fn((f64, f64)) -> f64) -> (Vec<f64>, Vec<f64>) {
    let mut sums: Vec<(f64, f64, f64)> = Vec::new();
    for sample in samples {
        let Some(value) = sample.rebound.map(&get).filter(|v| !v.is_nan()) else { continue };
        let place = sums.partition_point(|s| s.0 < sample.angle);
        if sums.get(place).is_none_or(|s| s.0 != sample.angle) {
            sums.insert(place, (sample.angle, 0.0, 0.0));
        }
        sums[place].1 += sample.weight;
        sums[place].2 += sample.weight * value;
    }
    sums.into_iter().map(|(angle, weight, sum)| (angle, sum / weight)).unzip()
}

/// Share of the impacts that the law captures.
pub(super) fn captured(samples: &[Sample]) -> f64 {
    samples.iter().filter(|s| s.rebound.is_none()).map(|s| s.weight).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_keep_their_ends_and_bins_join() {
        let span = Span::new(1e-5, 1e-4);
        let bins = span.bins(3);
        assert_eq!((bins[0].from, bins[2].to), (1e-5, 1e-4));
        assert!(bins.windows(2).all(|w| w[0].to == w[1].from));
        assert!((span.middle() / 1e-4f64.powf(1.125) - 1.0).abs() < 1e-12);
        assert_eq!(Span::new(2.0, 2.0).bins(3), [Span::new(2.0, 2.0)]);
        assert_eq!(Span::new(5.0, 90.0).steps(3), [5.0, 47.5, 90.0]);
    }

    #[test]
    fn weights_add_up_to_one() {
        for count in [1, 2, 7] {
            assert!(((0..count).map(|i| share(i, count)).sum::<f64>() - 1.0).abs() < 1e-15);
        }
    }
}
