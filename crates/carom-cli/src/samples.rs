//! Many samples instead of one value: how many, from which seed, and what they come to.

use crate::motion::ImpactArgs;
use crate::study::drawn;
use carom::study::Sampling;
use carom_report::significant;

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

/// What was done, in a line.
pub fn note<'a>(sampling: &Sampling, cases: impl Iterator<Item = &'a ImpactArgs>) -> String {
    let mut what: Vec<String> = cases.flat_map(drawn).map(|(flag, d)| format!("{flag} {d}")).collect();
    what.sort();
    what.dedup();
    let of = if what.is_empty() { String::new() } else { format!(" of {}", what.join(", ")) };
    format!(
        "{} samples (seed {}){of}; standard error of a probability at most {}",
        sampling.samples,
        sampling.seed,
        significant(sampling.standard_error(), 2)
    )
}
