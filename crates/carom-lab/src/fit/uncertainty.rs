//! How well the data tell the parameters: standard errors, correlations, intervals, goodness of fit.
//!
//! Of the weighted derivatives J at the minimum, the covariance is s²(JᵀJ)⁻¹: s = 1 where the data have their own σ, and otherwise
//! s² = Σr²/(n − p), the scatter about the fit. A 95 % interval is ± z or ± t(n − p) standard errors. A parameter held at a bound has
//! neither, and counts as known for the others. A sphere that stayed where the law captures it has no scatter and does not count in n.

use super::problem::{Form, Problem};
use super::solve::Minimum;
use crate::error::LabError;
use crate::experiment::Quantity;
use nalgebra::{DMatrix, SVD};
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF as _, StudentsT};

/// Singular values of the scaled derivatives below this, against the largest, are zero: differences have about nine digits.
const SINGULAR: f64 = 1e-6;

/// The share of a direction without information from which a parameter is in it.
const TAKES_PART: f64 = 0.05;

/// How the fit meets the data.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Goodness {
    /// Values that tell something: all but spheres that stayed where the law captures.
    pub informative: usize,
    /// Those less the parameters found.
    pub freedom: usize,
    /// Σ((measured − model)/σ)²/freedom, where the data have σ.
    pub reduced_chi_square: Option<f64>,
    /// Chance of a larger χ² if the law is right and σ too.
    pub probability: Option<f64>,
    /// Standard deviation about the fit, where the data have no σ.
    pub scatter: Option<f64>,
}

/// What the derivatives at the minimum say.
pub(super) struct Uncertainty {
    pub goodness: Goodness,
    /// Of each parameter, where there is one.
    pub standard_errors: Vec<Option<f64>>,
    /// Half widths of 95 % intervals in standard errors.
    pub quantile: f64,
    /// Between each two, 0 where one has no error.
    pub correlation: Vec<Vec<f64>>,
    /// Those that change nothing where the data are.
    pub idle: Vec<usize>,
    /// Those that only a combination of is known.
    pub entangled: Vec<usize>,
    /// Share of each observation in its own model value.
    pub leverage: Vec<f64>,
}

pub(super) fn uncertainty(problem: &Problem<'_>, minimum: &Minimum) -> Result<Uncertainty, LabError> {
    let measured = problem.measured();
    let model = problem.model(&minimum.values)?;
    let count = problem.free.len();
    let open: Vec<usize> = (0..count).filter(|n| !minimum.held[*n]).collect();
    let all = problem.jacobian(Form::Restitution, &measured, &minimum.values, &open)?;
    let norms: Vec<f64> = all.column_iter().map(|c| c.norm()).collect();
    let (used, idle): (Vec<usize>, Vec<usize>) =
        (0..open.len()).partition(|n| norms[*n] * problem.scales[open[*n]] > 1e-9);
    let silent = |n: &usize| {
        let o = &problem.observations[*n];
        o.quantity == Quantity::Restitution && o.value <= 0.0 && model[*n] <= 0.0
    };
    let informative = (0..measured.len()).filter(|n| !silent(n)).count();
    let freedom = informative.saturating_sub(used.len());
    let goodness = goodness(problem.has_sigma, minimum.objective, informative, freedom);
    let columns: Vec<_> = used.iter().map(|n| all.column(*n) / norms[*n]).collect();
    let scaled = if columns.is_empty() { DMatrix::zeros(measured.len(), 0) } else { DMatrix::from_columns(&columns) };
    let known = known(&scaled);
    let s2 = goodness.scatter.map_or(1.0, |s| s * s);
    let enough = problem.has_sigma || freedom > 0;
    let mut standard_errors = vec![None; count];
    let mut correlation = vec![vec![0.0; count]; count];
    let mut entangled = Vec::new();
    for (a, &n) in used.iter().enumerate() {
        if known.entangled[a] {
            entangled.push(open[n]);
        } else if enough {
            standard_errors[open[n]] = Some((s2 * known.inverse[(a, a)]).sqrt() / norms[n]);
        }
        for (b, &m) in used.iter().enumerate().filter(|(b, _)| !known.entangled[a] && !known.entangled[*b]) {
            let product = (known.inverse[(a, a)] * known.inverse[(b, b)]).sqrt();
            correlation[open[n]][open[m]] = if a == b { 1.0 } else { known.inverse[(a, b)] / product };
        }
    }
    Ok(Uncertainty {
        quantile: quantile(problem.has_sigma, freedom),
        standard_errors,
        correlation,
        idle: idle.into_iter().map(|n| open[n]).collect(),
        entangled,
        leverage: known.leverage,
        goodness,
    })
}

fn goodness(has_sigma: bool, objective: f64, informative: usize, freedom: usize) -> Goodness {
    let degrees = freedom as f64;
    let chi = (has_sigma && freedom > 0).then_some(objective);
    Goodness {
        informative,
        freedom,
        reduced_chi_square: chi.map(|c| c / degrees),
        probability: chi.and_then(|c| ChiSquared::new(degrees).ok().map(|d| d.sf(c))),
        scatter: (!has_sigma && freedom > 0).then(|| (objective / degrees).sqrt()),
    }
}

/// Of 95 % on both sides together.
fn quantile(has_sigma: bool, freedom: usize) -> f64 {
    let normal = carom::random::normal_quantile(0.975);
    if has_sigma {
        return normal;
    }
    StudentsT::new(0.0, 1.0, freedom as f64).map_or(f64::NAN, |t| t.inverse_cdf(0.975))
}

struct Known {
    /// (JᵀJ)⁻¹ of columns of length 1, without the directions that nothing is known of.
    inverse: DMatrix<f64>,
    entangled: Vec<bool>,
    leverage: Vec<f64>,
}

fn known(scaled: &DMatrix<f64>) -> Known {
    let (rows, count) = scaled.shape();
    let mut found =
        Known { inverse: DMatrix::zeros(count, count), entangled: vec![false; count], leverage: vec![0.0; rows] };
    if count == 0 {
        return found;
    }
    let svd = SVD::new(scaled.clone(), true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else { return found };
    let largest = svd.singular_values.max();
    for (n, &value) in svd.singular_values.iter().enumerate() {
        let direction = v_t.row(n);
        if value <= SINGULAR * largest {
            for (entangled, share) in found.entangled.iter_mut().zip(direction.iter()) {
                *entangled |= share.abs() > TAKES_PART;
            }
            continue;
        }
        found.inverse += direction.transpose() * direction / (value * value);
        for (leverage, share) in found.leverage.iter_mut().zip(u.column(n).iter()) {
            *leverage += share * share;
        }
    }
    found
}
