//! Many samples instead of one value: how many, from which seed, and what they come to.

use crate::motion::ImpactArgs;
use crate::study::drawn;
use carom::random::{Purpose, Stream};
use carom_report::significant;
use carom_track::deposition::wilson;

/// The flags.
#[derive(clap::Args, Clone, Debug)]
pub struct SampleArgs {
    /// Samples where a value is a distribution or the wall scatters [default: 1000 where a value is a distribution]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000), help_heading = "Uncertainty")]
    samples: Option<u32>,
    /// Seed of the samples
    #[arg(long, value_name = "SEED", default_value_t = 1, help_heading = "Uncertainty")]
    seed: u64,
}

impl SampleArgs {
    /// How to sample, if it is wanted or `needed`.
    pub fn sampling(&self, needed: bool) -> Option<Sampling> {
        let samples = self.samples.or(needed.then_some(1000))?;
        Some(Sampling { samples, seed: self.seed })
    }
}

/// How to sample. A sample has the same draws at every point and on every curve (common random numbers): curves are smooth, and
/// differences between them are not noise.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    /// How many.
    pub samples: u32,
    /// From which seed.
    pub seed: u64,
}

impl Sampling {
    /// The uniform draw in (0, 1) of one flag in one sample.
    pub fn draw(&self, sample: u32, flag: u32) -> f64 {
        Stream::new(self.seed, sample.into(), Purpose::Injection, flag).open_uniform()
    }

    /// The draws of an impact on a wall that scatters.
    pub fn impact(&self, sample: u32) -> [f64; 4] {
        Stream::new(self.seed, sample.into(), Purpose::Wall, 0).uniforms()
    }
}

impl Sampling {
    /// What was done, in a line.
    pub fn note<'a>(&self, cases: impl Iterator<Item = &'a ImpactArgs>) -> String {
        let mut what: Vec<String> = cases.flat_map(drawn).map(|(flag, d)| format!("{flag} {d}")).collect();
        what.sort();
        what.dedup();
        let of = if what.is_empty() { String::new() } else { format!(" of {}", what.join(", ")) };
        let error = 0.5 / f64::from(self.samples).sqrt();
        format!(
            "{} samples (seed {}){of}; standard error of a probability at most {}",
            self.samples,
            self.seed,
            significant(error, 2)
        )
    }
}

/// Median and the band from 5 to 95 % of values; those that are NaN do not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    pub median: f64,
    pub low: f64,
    pub high: f64,
}

impl Band {
    /// Of these values, which are sorted.
    pub fn of(values: &mut Vec<f64>) -> Self {
        values.retain(|v| !v.is_nan());
        values.sort_by(f64::total_cmp);
        let at = |p: f64| {
            let Some(last) = values.len().checked_sub(1) else { return f64::NAN };
            let place = p * last as f64;
            let (below, share) = (place as usize, place.fract());
            // infinite ends have no straight line between them
            if share == 0.0 || values[below] == values[below + 1] {
                return values[below];
            }
            values[below] + share * (values[below + 1] - values[below])
        };
        Self { median: at(0.5), low: at(0.05), high: at(0.95) }
    }
}

/// A probability and what the number of samples leaves open: Wilson's 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

impl Share {
    /// `hits` of `n`.
    pub fn of(hits: u32, n: u32) -> Self {
        let (low, high) = wilson(hits.into(), n.into());
        // rounding aside, the ends of none and of all are 0 and 1
        let (low, high) = (if hits == 0 { 0.0 } else { low }, if hits == n { 1.0 } else { high });
        Self { value: f64::from(hits) / f64::from(n), low, high }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_quantiles() {
        let mut values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        values.push(f64::NAN);
        assert_eq!(Band::of(&mut values), Band { median: 50.0, low: 5.0, high: 95.0 });
        let of = Band::of(&mut vec![1.0, f64::INFINITY, f64::INFINITY]);
        assert!(of.median == f64::INFINITY && of.high == f64::INFINITY);
        assert!(Band::of(&mut Vec::new()).median.is_nan());
    }

    #[test]
    fn draws_are_those_of_sample_and_flag() {
        let sampling = Sampling { samples: 10, seed: 3 };
        assert_eq!(sampling.draw(4, 0), sampling.draw(4, 0));
        assert_ne!(sampling.draw(4, 0), sampling.draw(4, 1));
        assert_ne!(sampling.draw(4, 0), sampling.draw(5, 0));
    }
}
