//! Intervals from data drawn again: percentiles of fits to resampled data.
//!
//! Of *residuals* (the default): each point's speed, angle and diameter stay, its value is the fit's plus a residual drawn from all of
//! them, in units of its σ, each first divided by √(1 − leverage) and centred (Davison & Hinkley 1997, Bootstrap methods and
//! their application, §6.2, doi:10.1017/CBO9780511802843). Spheres that stayed, or that the law captures, have no scatter to draw from and
//! stay as measured. Of *pairs*: whole points are drawn with replacement, which asks nothing of the scatter and needs more points.

use super::problem::{Form, Problem};
use super::solve::{Minimum, descend};
use crate::error::LabError;
use carom::random::{Purpose, Stream};
use serde::Serialize;

/// What is drawn again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Resampling {
    /// Residuals, about the fit.
    #[default]
    Residuals,
    /// Whole points.
    Pairs,
}

/// How to draw again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BootstrapOptions {
    /// How often; 0 for not at all.
    pub resamples: u32,
    /// Of the draws.
    pub seed: u64,
    /// What is drawn.
    pub resampling: Resampling,
}

impl Default for BootstrapOptions {
    fn default() -> Self {
        Self { resamples: 1000, seed: 1, resampling: Resampling::Residuals }
    }
}

/// What came of it.
#[derive(Clone, Debug, Serialize)]
pub struct Bootstrap {
    /// What was drawn.
    pub resampling: Resampling,
    /// How often.
    pub resamples: u32,
    /// Of the draws.
    pub seed: u64,
    /// Fits that did not settle and are left out.
    pub failed: u32,
    /// The parameters of each fit.
    #[serde(skip)]
    pub samples: Vec<Vec<f64>>,
}

impl Bootstrap {
    /// The 2.5 and 97.5 % quantiles of parameter `n`.
    pub fn interval(&self, n: usize) -> Option<(f64, f64)> {
        let mut values: Vec<f64> = self.samples.iter().map(|s| s[n]).collect();
        values.sort_by(f64::total_cmp);
        Some((quantile(&values, 0.025)?, quantile(&values, 0.975)?))
    }
}

/// Of sorted values, by the rank share·(N + 1), straight between them.
pub(super) fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)? as f64;
    let place = (share * (last + 2.0) - 1.0).clamp(0.0, last);
    let (low, rest) = (place.floor() as usize, place.fract());
    let high = sorted.get(low + 1).unwrap_or(&sorted[low]);
    Some(sorted[low] + rest * (high - sorted[low]))
}

pub(super) fn bootstrap(
    problem: &Problem<'_>,
    minimum: &Minimum,
    leverage: &[f64],
    options: &BootstrapOptions,
) -> Result<Bootstrap, LabError> {
    let measured = problem.measured();
    let model = problem.model(&minimum.values)?;
    let pool = pool(problem, &measured, &model, leverage);
    let mut samples = Vec::with_capacity(options.resamples as usize);
    for number in 0..options.resamples {
        let mut draws = Stream::new(options.seed, u64::from(number), Purpose::Resampling, 0);
        let fitted = match options.resampling {
            Resampling::Residuals => {
                let again = again(problem, &measured, &model, &pool, &mut draws);
                descend(problem, Form::Restitution, &again, &minimum.values)
            }
            Resampling::Pairs => {
                let all = &problem.observations;
                let observations: Vec<_> = all.iter().map(|_| all[index(all.len(), &mut draws)]).collect();
                let drawn = problem.observing(observations);
                descend(&drawn, Form::Restitution, &drawn.measured(), &minimum.values)
            }
        };
        samples.extend(fitted.ok().map(|f| f.values));
    }
    let failed = options.resamples - u32::try_from(samples.len()).unwrap_or(options.resamples);
    Ok(Bootstrap { resampling: options.resampling, resamples: options.resamples, seed: options.seed, failed, samples })
}

fn index(length: usize, draws: &mut Stream) -> usize {
    ((draws.uniform() * length as f64) as usize).min(length.saturating_sub(1))
}

/// Whether an observation scatters about the law.
fn scatters(measured: f64, model: f64) -> bool {
    measured != 0.0 && model != 0.0
}

/// The residuals to draw from, in σ.
fn pool(problem: &Problem<'_>, measured: &[f64], model: &[f64], leverage: &[f64]) -> Vec<f64> {
    let all = problem.observations.iter().zip(measured).zip(model).zip(leverage);
    let mut pool: Vec<f64> = all
        .filter(|(((_, m), g), _)| scatters(**m, **g))
        .map(|(((o, m), g), h)| (m - g) / o.sigma / (1.0 - h).max(0.05).sqrt())
        .collect();
    let mean = pool.iter().sum::<f64>() / pool.len().max(1) as f64;
    pool.iter_mut().for_each(|r| *r -= mean);
    pool
}

fn again(problem: &Problem<'_>, measured: &[f64], model: &[f64], pool: &[f64], draws: &mut Stream) -> Vec<f64> {
    let all = problem.observations.iter().zip(measured).zip(model);
    all.map(
        |((o, m), g)| {
            if scatters(*m, *g) && !pool.is_empty() { g + o.sigma * pool[index(pool.len(), draws)] } else { *m }
        },
    )
    .collect()
}
