//! Histograms that need not know their range beforehand, in flat memory and independent of the order of their values.

use std::collections::BTreeMap;

/// Bins of equal ratio, sixteen to an octave, each with an amount of each of several groups.
#[derive(Debug)]
pub struct LogBins {
    groups: usize,
    bins: BTreeMap<i32, Vec<f64>>,
    /// 2^(k/16), k from 0 to 15, by square roots: the same bits everywhere.
    steps: [f64; 16],
}

const PER_OCTAVE: i32 = 16;

/// Edges, one more than bins, and the amounts of each group in each bin.
#[derive(Debug, PartialEq)]
pub struct Bars {
    /// Edges of the bins.
    pub edges: Vec<f64>,
    /// `[group][bin]`.
    pub amounts: Vec<Vec<f64>>,
}

impl LogBins {
    /// Empty bins for so many groups.
    pub fn new(groups: usize) -> Self {
        let roots = [2f64.sqrt(), 2f64.sqrt().sqrt(), 2f64.sqrt().sqrt().sqrt(), 2f64.sqrt().sqrt().sqrt().sqrt()];
        let step = |k: usize| (0..4).filter(|bit| k >> (3 - bit) & 1 == 1).map(|bit| roots[bit]).product();
        Self { groups, bins: BTreeMap::new(), steps: std::array::from_fn(step) }
    }

    /// The number of the bin that holds a value > 0.
    pub fn index(&self, value: f64) -> Option<i32> {
        if !(value >= f64::MIN_POSITIVE && value.is_finite()) {
            return None;
        }
        let bits = value.to_bits();
        let exponent = (bits >> 52) as i32 - 1023;
        let mantissa = f64::from_bits(bits & ((1 << 52) - 1) | 1023 << 52);
        let step = self.steps.partition_point(|s| *s <= mantissa) as i32 - 1;
        Some(exponent * PER_OCTAVE + step)
    }

    /// Adds an amount of a group at a value; what is not positive has no bin.
    pub fn add(&mut self, value: f64, group: usize, amount: f64) {
        let Some(index) = self.index(value) else { return };
        let groups = self.groups;
        if let Some(sum) = self.bins.entry(index).or_insert_with(|| vec![0.0; groups]).get_mut(group) {
            *sum += amount;
        }
    }

    /// The lower edge of a bin.
    fn edge(&self, index: i32) -> f64 {
        self.steps[index.rem_euclid(PER_OCTAVE) as usize] * 2f64.powi(index.div_euclid(PER_OCTAVE))
    }

    /// At most about `most` bins over all values; none where there are none.
    pub fn bars(&self, most: i32) -> Option<Bars> {
        let (first, last) = (*self.bins.first_key_value()?.0, *self.bins.last_key_value()?.0);
        let mut width = 1;
        while last.div_euclid(width) - first.div_euclid(width) >= most {
            width *= 2;
        }
        let (low, high) = (first.div_euclid(width), last.div_euclid(width));
        let mut amounts = vec![vec![0.0; (high - low + 1) as usize]; self.groups];
        for (index, sums) in &self.bins {
            for (group, sum) in sums.iter().enumerate() {
                amounts[group][(index.div_euclid(width) - low) as usize] += sum;
            }
        }
        Some(Bars { edges: (low..=high + 1).map(|i| self.edge(i * width)).collect(), amounts })
    }
}

/// Bins of equal width, a power of two: the least with which fewer than [`LinearBins::MOST`] bins hold all values. It
/// doubles as values come, so what comes out does not depend on their order.
#[derive(Debug, Default)]
pub struct LinearBins {
    bins: BTreeMap<i64, f64>,
    /// The width is 2^exponent.
    exponent: i32,
}

impl LinearBins {
    /// More bins than these are never filled.
    pub const MOST: i64 = 48;
    /// Bits of a value that tell bins apart at most: positions closer together than a 4096th are one place.
    const BITS: i32 = 12;

    /// Adds an amount at a value.
    pub fn add(&mut self, value: f64, amount: f64) {
        if !value.is_finite() {
            return;
        }
        let least = ((value.abs().to_bits() >> 52) as i32 - 1023 - Self::BITS).max(-60);
        if self.bins.is_empty() {
            self.exponent = least;
        }
        while self.exponent < least {
            self.coarsen();
        }
        loop {
            let index = (value / 2f64.powi(self.exponent)).floor() as i64;
            let first = self.bins.first_key_value().map_or(index, |b| *b.0).min(index);
            let last = self.bins.last_key_value().map_or(index, |b| *b.0).max(index);
            if last - first < Self::MOST {
                *self.bins.entry(index).or_default() += amount;
                return;
            }
            self.coarsen();
        }
    }

    fn coarsen(&mut self) {
        self.exponent += 1;
        let mut halved = BTreeMap::new();
        for (index, amount) in &self.bins {
            *halved.entry(index.div_euclid(2)).or_default() += amount;
        }
        self.bins = halved;
    }

    /// Standard deviation of the bins' middles.
    pub fn spread(&self) -> f64 {
        let total: f64 = self.bins.values().sum();
        let middle = |i: &i64| (*i as f64 + 0.5) * 2f64.powi(self.exponent);
        let mean = self.bins.iter().map(|(i, a)| middle(i) * a).sum::<f64>() / total;
        let square = self.bins.iter().map(|(i, a)| (middle(i) - mean).powi(2) * a).sum::<f64>() / total;
        square.sqrt()
    }

    /// The bins with the empty ones between; none where there are none.
    pub fn bars(&self) -> Option<Bars> {
        let (first, last) = (*self.bins.first_key_value()?.0, *self.bins.last_key_value()?.0);
        let edges = (first..=last + 1).map(|i| i as f64 * 2f64.powi(self.exponent)).collect();
        let amounts = (first..=last).map(|i| self.bins.get(&i).copied().unwrap_or_default()).collect();
        Some(Bars { edges, amounts: vec![amounts] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_lies_between_the_edges_of_its_bin() {
        let bins = LogBins::new(1);
        for value in [1.0, 2.0, 1.999_999_999, 0.3, 1e-12, 7.7e8, 2f64.sqrt(), 2f64.powf(0.0625)] {
            let i = bins.index(value).unwrap();
            assert!(bins.edge(i) <= value && value < bins.edge(i + 1), "{value}");
            assert!((bins.edge(i + 1) / bins.edge(i) - 2f64.powf(0.0625)).abs() < 1e-14);
        }
        assert_eq!([0.0, -1.0, f64::NAN].map(|v| bins.index(v)), [None; 3]);
    }

    #[test]
    fn log_bins_keep_every_amount_however_wide_they_are() {
        let mut bins = LogBins::new(2);
        (1..=1000).for_each(|i| bins.add(f64::from(i) * 1e-3, i as usize % 2, 1.0));
        for most in [4, 16, 1000] {
            let bars = bins.bars(most).unwrap();
            assert!(bars.edges.len() as i32 <= most + 1);
            assert_eq!(bars.amounts.iter().map(|a| a.iter().sum::<f64>()).collect::<Vec<_>>(), [500.0, 500.0]);
            assert!(bars.edges[0] <= 1e-3 && *bars.edges.last().unwrap() > 1.0);
        }
        assert_eq!(LogBins::new(1).bars(4), None);
    }

    #[test]
    fn linear_bins_do_not_depend_on_order() {
        let values: Vec<f64> = (0..500).map(|i| f64::from(i * i % 499) * 0.7 - 3.0).collect();
        let fill = |values: &mut dyn Iterator<Item = &f64>| {
            let mut bins = LinearBins::default();
            values.for_each(|v| bins.add(*v, 1.0));
            bins.bars().unwrap()
        };
        let bars = fill(&mut values.iter());
        assert_eq!(bars, fill(&mut values.iter().rev()));
        assert_eq!(bars.amounts[0].iter().sum::<f64>(), 500.0);
        // 0 to 498 times 0.7 in steps of 8: no finer power of two does with 48
        assert_eq!((bars.edges[0], bars.edges[1] - bars.edges[0]), (-8.0, 8.0));
        for (i, amount) in bars.amounts[0].iter().enumerate() {
            let inside = values.iter().filter(|v| **v >= bars.edges[i] && **v < bars.edges[i + 1]).count();
            assert_eq!(inside as f64, *amount);
        }
        let mut one = LinearBins::default();
        one.add(0.0, 2.0);
        one.add(0.0, 1.0);
        assert_eq!(one.bars().unwrap().amounts, [[3.0]]);
        assert_eq!(one.spread(), 0.0);
    }
}
