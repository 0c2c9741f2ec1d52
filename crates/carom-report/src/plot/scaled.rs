//! An axis with its ends settled: from data to a share of its length.

use super::ticks::{self, Tick};
use super::{Axis, Scale};

/// How the ends of an axis are chosen where its range does not say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Margin {
    /// A little air about the data; from zero where the data start near it.
    Air,
    /// Exactly the data.
    None,
    /// Symmetric about zero (a linear axis).
    Symmetric,
}

/// An axis from `low` to `high`, both as shown and through a logarithm on a logarithmic axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scaled {
    log: bool,
    factor: f64,
    pub low: f64,
    pub high: f64,
}

impl Scaled {
    pub(super) fn new(axis: &Axis, data: impl IntoIterator<Item = f64>, margin: Margin) -> Self {
        let log = axis.scale == Scale::Log;
        let mut scaled = Self { log, factor: axis.factor, low: f64::INFINITY, high: f64::NEG_INFINITY };
        for value in data {
            let Some(value) = scaled.inner(value) else {
                continue;
            };
            scaled.low = scaled.low.min(value);
            scaled.high = scaled.high.max(value);
        }
        if scaled.low > scaled.high {
            (scaled.low, scaled.high) = if log { (-1.0, 1.0) } else { (0.0, 1.0) };
        }
        scaled.widen_flat();
        match margin {
            Margin::None => {}
            Margin::Air => scaled.air(),
            Margin::Symmetric if !log => {
                let end = scaled.low.abs().max(scaled.high.abs());
                (scaled.low, scaled.high) = (-end, end);
            }
            Margin::Symmetric => {}
        }
        if let Some((from, to)) = axis.range {
            scaled.low = scaled.inner(from).unwrap_or(scaled.low);
            scaled.high = scaled.inner(to).unwrap_or(scaled.high);
            if scaled.low > scaled.high {
                // A lower end that a logarithmic axis cannot have, with data above the upper one.
                scaled.low = scaled.high - 2.0;
            }
            scaled.widen_flat();
        }
        scaled
    }

    fn widen_flat(&mut self) {
        let middle = 0.5 * (self.low + self.high);
        if self.high - self.low <= 1e-12 * middle.abs() {
            let half = match (self.log, middle == 0.0) {
                (true, _) => 0.5,
                (false, true) => 1.0,
                (false, false) => 0.1 * middle.abs(),
            };
            (self.low, self.high) = (middle - half, middle + half);
        }
    }

    fn air(&mut self) {
        let (low, high) = (self.low, self.high);
        let pad = 0.05 * (high - low);
        self.low = if !self.log && low >= 0.0 && low < 0.3 * high { 0.0 } else { low - pad };
        self.high = if !self.log && high <= 0.0 && high > 0.3 * low { 0.0 } else { high + pad };
    }

    /// Shown value, through the logarithm; none where the axis has no place for it.
    fn inner(&self, data: f64) -> Option<f64> {
        let shown = data * self.factor;
        let inner = if self.log { shown.log10() } else { shown };
        inner.is_finite().then_some(inner)
    }

    /// Place of a data value: 0 at the lower end, 1 at the upper; none for what cannot be placed.
    pub(super) fn share(&self, data: f64) -> Option<f64> {
        self.inner(data).map(|v| (v - self.low) / (self.high - self.low))
    }

    /// As [`Scaled::share`], with what is too low for a logarithmic axis at its lower end.
    pub(super) fn share_or_low(&self, data: f64) -> Option<f64> {
        let below = self.log && data * self.factor <= 0.0;
        self.share(data).or(below.then_some(0.0))
    }

    /// Divisions with their places, about `count` of them labelled.
    pub(super) fn ticks(&self, count: usize) -> Vec<(f64, Tick)> {
        let ticks = if self.log {
            ticks::log(10_f64.powf(self.low), 10_f64.powf(self.high), count)
        } else {
            ticks::linear(self.low, self.high, count)
        };
        let place = |v: f64| ((if self.log { v.log10() } else { v }) - self.low) / (self.high - self.low);
        ticks.into_iter().map(|t| (place(t.value).clamp(0.0, 1.0), t)).collect()
    }

    /// Length of the axis in the data's unit, for equal aspect: what is shown may be in another unit on the other axis.
    pub(super) fn span(&self) -> f64 {
        (self.high - self.low) / self.factor
    }

    /// Whether equal steps are equal lengths.
    pub(super) fn is_linear(&self) -> bool {
        !self.log
    }

    /// Widens the axis about its middle to a length in the data's unit.
    pub(super) fn widen_to(&mut self, span: f64) {
        let middle = 0.5 * (self.low + self.high);
        let half = 0.5 * span * self.factor;
        (self.low, self.high) = (middle - half, middle + half);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_suit_the_data() {
        let linear = Axis::new("", "");
        let ends = |axis: &Axis, data: &[f64], margin| {
            let s = Scaled::new(axis, data.iter().copied(), margin);
            (s.low, s.high)
        };
        assert_eq!(ends(&linear, &[], Margin::Air), (0.0, 1.05));
        assert_eq!(ends(&linear, &[1.0, 10.0], Margin::None), (1.0, 10.0));
        assert_eq!(ends(&linear, &[2.0, 2.0], Margin::None), (1.8, 2.2));
        assert_eq!(ends(&linear, &[-1.0, 3.0], Margin::Symmetric), (-3.0, 3.0));
        assert_eq!(ends(&linear.clone().range(0.0, 1.0), &[5.0], Margin::Air), (0.0, 1.0));
        assert_eq!(ends(&linear.clone().log(), &[-1.0, 0.0, f64::NAN, 0.1, 10.0], Margin::None), (-1.0, 1.0));
        let (low, high) = ends(&linear.log().range(-1.0, 0.1), &[5.0], Margin::Air);
        assert!(low < high && high == -1.0, "{low} {high}");
    }

    #[test]
    fn scaled_axis_shows_the_scaled_value() {
        let axis = Axis::scaled("diameter", "µm", 1e6);
        let scaled = Scaled::new(&axis, [0.0, 1e-4], Margin::None);
        assert_eq!(scaled.high.round(), 100.0);
        assert!((scaled.share(5e-5).unwrap() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_placed_has_no_share() {
        let linear = Scaled::new(&Axis::new("", ""), [0.0, 2.0], Margin::None);
        assert_eq!(linear.share_or_low(1.0), Some(0.5));
        assert_eq!(linear.share_or_low(f64::INFINITY), None);
        let log = Scaled::new(&Axis::new("", "").log(), [1.0, 100.0], Margin::None);
        assert_eq!(log.share(0.0), None);
        assert_eq!(log.share(10.0), Some(0.5));
        let low = [0.0, -1.0, f64::NAN, f64::INFINITY].map(|v| log.share_or_low(v));
        assert_eq!(low, [Some(0.0), Some(0.0), None, None]);
    }
}
