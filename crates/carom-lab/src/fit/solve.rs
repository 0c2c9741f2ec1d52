//! Bounded least squares: Levenberg & Marquardt's method as in MINPACK (Moré, Garbow & Hillstrom 1980, ANL-80-74), by the crate
//! `levenberg-marquardt`, which knows no bounds. They come from outside: a parameter that a descent leaves beyond a bound is held there, the
//! others go on, and it is let go again where the objective falls towards the inside. With six parameters at most this is cheap.
//!
//! Several starts, since restitution is flat where the law captures: the law's own values and the best of a coarse grid, each first
//! brought near in the [`Form::Energy`], which has no flat parts.

use super::problem::{Form, Problem};
use crate::error::LabError;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};

/// Starts taken from the grid.
const FROM_GRID: usize = 3;

/// Where a descent ended.
#[derive(Clone, Debug)]
pub(super) struct Minimum {
    pub values: Vec<f64>,
    /// Which are held at a bound.
    pub held: Vec<bool>,
    /// Σ ((measured − model)/σ)².
    pub objective: f64,
}

/// The best of several descents.
pub(super) fn solve(problem: &Problem<'_>, measured: &[f64]) -> Result<Minimum, LabError> {
    let mut near: Vec<Minimum> = Vec::new();
    for start in starts(problem, measured) {
        let Ok(minimum) = descend(problem, Form::Energy, measured, &start) else { continue };
        if !near.iter().any(|n| same(problem, n, &minimum)) {
            near.push(minimum);
        }
    }
    let own = problem.starts.clone();
    let from = near.into_iter().map(|n| n.values).chain([own]);
    let mut best: Option<Minimum> = None;
    for start in from {
        let Ok(minimum) = descend(problem, Form::Restitution, measured, &start) else { continue };
        if best.as_ref().is_none_or(|b| minimum.objective < b.objective) {
            best = Some(minimum);
        }
    }
    best.ok_or_else(|| LabError::Model("no start of the fit led anywhere: the law refuses them all".into()))
}

/// Two minima at one place.
fn same(problem: &Problem<'_>, a: &Minimum, b: &Minimum) -> bool {
    let pairs = a.values.iter().zip(&b.values).zip(&problem.scales);
    pairs.into_iter().all(|((a, b), scale)| (a - b).abs() <= 1e-4 * (a.abs() + 0.1 * scale))
}

/// The law's own values, and the best of a grid.
fn starts(problem: &Problem<'_>, measured: &[f64]) -> Vec<Vec<f64>> {
    let mut grid: Vec<Vec<f64>> = vec![Vec::new()];
    for (n, free) in problem.free.iter().enumerate() {
        let values = super::parameter::grid(free.parameter, problem.starts[n]);
        let longer = |g: &Vec<f64>| {
            let inside = values.iter().map(|v| problem.inside(n, *v));
            inside.map(|v| g.iter().copied().chain([v]).collect::<Vec<_>>()).collect::<Vec<_>>()
        };
        grid = grid.iter().flat_map(longer).collect();
    }
    let mut rated: Vec<(f64, Vec<f64>)> = grid
        .into_iter()
        .filter_map(|g| problem.residuals(Form::Energy, measured, &g).ok().map(|r| (sum_of_squares(&r), g)))
        .filter(|(objective, _)| objective.is_finite())
        .collect();
    rated.sort_by(|a, b| a.0.total_cmp(&b.0));
    let best = rated.into_iter().take(FROM_GRID).map(|(_, g)| g);
    [problem.starts.clone()].into_iter().chain(best).collect()
}

/// Descends from `start`, holding at their bounds those parameters that press against them.
pub(super) fn descend(problem: &Problem<'_>, form: Form, measured: &[f64], start: &[f64]) -> Result<Minimum, LabError> {
    let count = problem.free.len();
    let mut best = Minimum { values: start.to_vec(), held: vec![false; count], objective: f64::INFINITY };
    let (mut values, mut held) = (best.values.clone(), best.held.clone());
    for _ in 0..3 * count + 2 {
        let columns: Vec<usize> = (0..count).filter(|n| !held[*n]).collect();
        let outside = inner(problem, form, measured, &mut values, &columns);
        outside.iter().for_each(|n| held[*n] = true);
        if !outside.is_empty() {
            continue;
        }
        let residuals = problem.residuals(form, measured, &values)?;
        let objective = sum_of_squares(&residuals);
        let better = objective < best.objective * (1.0 - 1e-10);
        if better || !best.objective.is_finite() {
            best = Minimum { values: values.clone(), held: held.clone(), objective };
        }
        let Some(n) = pulled_inside(problem, form, measured, &values, &held, &residuals)?.filter(|_| better) else {
            break;
        };
        held[n] = false;
        let inward = if values[n] <= *problem.free[n].bounds.start() { 1.0 } else { -1.0 };
        values[n] = problem.inside(n, values[n] + 1e-3 * inward * problem.scales[n]);
    }
    if best.objective.is_finite() { Ok(best) } else { Err(LabError::Model("the fit does not settle".into())) }
}

/// The parameter at a bound that the objective would most gain from letting go.
fn pulled_inside(
    problem: &Problem<'_>,
    form: Form,
    measured: &[f64],
    values: &[f64],
    held: &[bool],
    residuals: &[f64],
) -> Result<Option<usize>, LabError> {
    let columns: Vec<usize> = (0..held.len()).filter(|n| held[*n]).collect();
    let jacobian = problem.jacobian(form, measured, values, &columns)?;
    let gradient = jacobian.tr_mul(&DVector::from_column_slice(residuals));
    let size = sum_of_squares(residuals).max(f64::MIN_POSITIVE);
    let gains = columns.iter().zip(gradient.iter()).map(|(&n, g)| {
        let inward = if values[n] <= *problem.free[n].bounds.start() { -g } else { *g };
        (n, inward * problem.scales[n] / size)
    });
    let most = gains.filter(|(_, gain)| *gain > 1e-8).max_by(|a, b| a.1.total_cmp(&b.1));
    Ok(most.map(|(n, _)| n))
}

/// A descent in the parameters of `columns` alone; those that end at or beyond a bound are put on it and named.
fn inner(problem: &Problem<'_>, form: Form, measured: &[f64], values: &mut [f64], columns: &[usize]) -> Vec<usize> {
    if columns.is_empty() {
        return Vec::new();
    }
    let x = DVector::from_iterator(columns.len(), columns.iter().map(|n| values[*n] / problem.scales[*n]));
    let descent = Descent { problem, form, measured, columns, values: values.to_vec(), x };
    let method = LevenbergMarquardt::new().with_stepbound(10.0).with_patience(60).with_tol(1e-8);
    let (end, _) = method.minimize(descent);
    let mut outside = Vec::new();
    for (n, x) in columns.iter().zip(end.x.iter()) {
        let value = x * problem.scales[*n];
        values[*n] = problem.inside(*n, value);
        let bounds = &problem.free[*n].bounds;
        if value <= *bounds.start() || value >= *bounds.end() {
            outside.push(*n);
        }
    }
    outside
}

/// The problem as the method sees it: scaled parameters, beyond a bound the same as on it.
struct Descent<'p> {
    problem: &'p Problem<'p>,
    form: Form,
    measured: &'p [f64],
    columns: &'p [usize],
    values: Vec<f64>,
    x: DVector<f64>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Descent<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
        for (n, x) in self.columns.iter().zip(x.iter()) {
            self.values[*n] = self.problem.inside(*n, x * self.problem.scales[*n]);
        }
    }

    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let residuals = self.problem.residuals(self.form, self.measured, &self.values).ok()?;
        Some(DVector::from_vec(residuals))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let mut matrix = self.problem.jacobian(self.form, self.measured, &self.values, self.columns).ok()?;
        for (column, n) in self.columns.iter().enumerate() {
            let (value, bounds) = (self.x[column] * self.problem.scales[*n], &self.problem.free[*n].bounds);
            // beyond a bound nothing changes
            let slope = if bounds.contains(&value) { self.problem.scales[*n] } else { 0.0 };
            matrix.column_mut(column).scale_mut(slope);
        }
        Some(matrix)
    }
}

pub(super) fn sum_of_squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r * r).sum()
}
