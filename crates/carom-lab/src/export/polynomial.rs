//! Polynomials with the least largest deviation, kept within bounds.
//!
//! Least squares in Chebyshev polynomials (QR), then Lawson's iteration: each round weighs a point by its deviation, which moves the
//! fit towards the one whose largest deviation is least (Lawson 1961, thesis, UCLA; Rice & Usow 1968, Math. Comp. 22, 118-127,
//! <https://doi.org/10.1090/S0025-5718-1968-0227661-8>). The best round is kept, so the result is never worse than least squares.

use super::rounded;
use nalgebra::{DMatrix, DVector};

/// Rounds of Lawson's iteration.
const ROUNDS: usize = 40;

/// Σ cⱼ xʲ, lowest power first.
pub fn value(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum.mul_add(x, *c))
}

/// Points to fit.
pub(super) struct Points<'a> {
    pub x: &'a [f64],
    pub y: &'a [f64],
    /// How much a deviation matters.
    pub weight: &'a [f64],
}

/// The polynomial of `degree`, less where there are too few points; without a constant where it is to pass through zero.
pub(super) fn fit(points: &Points, degree: usize, through_zero: bool) -> Vec<f64> {
    let lowest = usize::from(through_zero);
    let ends = points.x.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
    if points.x.len() <= lowest {
        return vec![0.0];
    }
    let degree = if ends.0 < ends.1 { degree.min(points.x.len() - 1 + lowest).max(lowest) } else { lowest };
    let columns: Vec<Vec<f64>> = (0..=degree - lowest).map(|n| chebyshev(n, ends, lowest)).collect();
    let matrix = DMatrix::from_fn(points.x.len(), columns.len(), |i, j| value(&columns[j], points.x[i]));
    let mut sum = vec![0.0; degree + 1];
    for (column, factor) in columns.iter().zip(lawson(&matrix, points)) {
        for (place, c) in column.iter().enumerate() {
            sum[place] += factor * c;
        }
    }
    sum
}

/// xˡᵒʷᵉˢᵗ Tₙ(t) in powers of x, with t from −1 to 1 as x runs between the ends.
fn chebyshev(n: usize, (from, to): (f64, f64), lowest: usize) -> Vec<f64> {
    let half = if to > from { 0.5 * (to - from) } else { 1.0 };
    let t = [-0.5 * (from + to) / half, 1.0 / half];
    let (mut before, mut now) = (vec![0.0], vec![1.0]);
    for i in 0..n {
        // T₁ = t T₀, then Tₙ₊₁ = 2t Tₙ − Tₙ₋₁
        let factor = if i == 0 { 1.0 } else { 2.0 };
        let mut next = vec![0.0; now.len() + 1];
        for (place, c) in now.iter().enumerate() {
            next[place] += factor * t[0] * c;
            next[place + 1] += factor * t[1] * c;
        }
        for (place, c) in before.iter().enumerate() {
            next[place] -= c;
        }
        (before, now) = (now, next);
    }
    std::iter::repeat_n(0.0, lowest).chain(now).collect()
}

fn lawson(matrix: &DMatrix<f64>, points: &Points) -> Vec<f64> {
    let wanted = DVector::from_column_slice(points.y);
    let mut square: Vec<f64> = points.weight.iter().map(|w| w * w).collect();
    let (mut best, mut least) = (vec![0.0; matrix.ncols()], f64::INFINITY);
    for _ in 0..ROUNDS {
        let Some(found) = least_squares(matrix, &wanted, &square) else { break };
        let apart = matrix * &found - &wanted;
        let deviations: Vec<f64> = apart.iter().zip(points.weight).map(|(r, w)| r.abs() * w).collect();
        let largest = deviations.iter().fold(0.0, |a: f64, b| a.max(*b));
        if largest < least {
            (best, least) = (found.as_slice().to_vec(), largest);
        }
        if largest <= 1e-13 {
            break;
        }
        square.iter_mut().zip(&deviations).for_each(|(s, d)| *s *= d / largest);
    }
    best
}

/// Least squares with the given weights of the squares; `None` where they leave too few points.
fn least_squares(matrix: &DMatrix<f64>, wanted: &DVector<f64>, square: &[f64]) -> Option<DVector<f64>> {
    let roots = DVector::from_iterator(square.len(), square.iter().map(|s| s.sqrt()));
    let mut weighted = matrix.clone();
    weighted.column_iter_mut().for_each(|mut column| column.component_mul_assign(&roots));
    let qr = weighted.qr();
    let mut right = wanted.component_mul(&roots);
    qr.q_tr_mul(&mut right);
    let right = right.rows(0, matrix.ncols()).into_owned();
    qr.r().solve_upper_triangular(&right).filter(|c| c.iter().all(|v| v.is_finite()))
}

/// The polynomial of at most `degree` with the least largest deviation from the points that stays between `low` and `high` all over
/// `check`, its coefficients rounded as they are written. Of those that are as good the one of lowest degree.
pub(super) fn bounded(x: &[f64], y: &[f64], degree: usize, check: (f64, f64), (low, high): (f64, f64)) -> Vec<f64> {
    let points = Points { x, y, weight: &vec![1.0; x.len()] };
    let candidates: Vec<(Vec<f64>, f64)> = (0..=degree)
        .map(|degree| {
            let mut c = fit(&points, degree, false);
            press(&mut c, check, low, high);
            c.iter_mut().for_each(|v| *v = rounded(*v));
            let largest = x.iter().zip(y).map(|(x, y)| (value(&c, *x) - y).abs()).fold(0.0, f64::max);
            (c, largest)
        })
        .collect();
    let least = candidates.iter().map(|c| c.1).fold(f64::INFINITY, f64::min);
    candidates.into_iter().find(|c| c.1 <= 1.01 * least + 1e-9).map_or_else(|| vec![0.0], |c| c.0)
}

/// Shrinks a polynomial that leaves [low, high] between the ends into it, by a straight map of its values.
fn press(coefficients: &mut [f64], ends: (f64, f64), low: f64, high: f64) {
    let (least, most) = extremes(coefficients, ends);
    let (low, high) = (least.clamp(low, high), most.clamp(low, high));
    if (low, high) == (least, most) {
        return;
    }
    let scale = if most > least { (high - low) / (most - least) } else { 0.0 };
    coefficients.iter_mut().for_each(|c| *c *= scale);
    if let Some(constant) = coefficients.first_mut() {
        *constant += low - scale * least;
    }
}

/// Least and greatest value between the ends, from fine steps and the vertices of parabolas through three of them.
fn extremes(coefficients: &[f64], (from, to): (f64, f64)) -> (f64, f64) {
    const STEPS: u32 = 720;
    let at = |i: u32| value(coefficients, from + (to - from) * f64::from(i) / f64::from(STEPS));
    let values: Vec<f64> = (0..=STEPS).map(at).collect();
    let vertices = values.windows(3).filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0).map(|w| {
        let bend = w[0] - 2.0 * w[1] + w[2];
        w[1] - (w[0] - w[2]).powi(2) / (8.0 * bend)
    });
    values.iter().copied().chain(vertices).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(from: f64, to: f64, f: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        (0..=400).map(|i| from + (to - from) * f64::from(i) / 400.0).map(|x| (x, f(x))).unzip()
    }

    #[test]
    fn a_polynomial_is_found_again() {
        let wanted = [0.993, -1.76, 1.56, -0.49];
        let (x, y) = grid(0.1, 1.5, |x| value(&wanted, x));
        let found = bounded(&x, &y, 7, (0.0, 1.5), (0.0, 1.0));
        assert_eq!(found.len(), 4, "no higher power than it has");
        assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?}");
    }

    #[test]
    fn the_largest_deviation_is_nearly_the_least_there_is() {
        // the best line for x² on [0, 1] is x − 1/8, off by 1/8; least squares gives x − 1/6, off by 1/6
        let (x, y) = grid(0.0, 1.0, |x| x * x);
        let line = fit(&Points { x: &x, y: &y, weight: &[1.0; 401] }, 1, false);
        assert!((line[0] + 0.125).abs() < 4e-3 && (line[1] - 1.0).abs() < 4e-3, "{line:?}");
        // and the best cubic for |x| on [−1, 1], which is the best quadratic: x² + 1/8
        let (x, y) = grid(-1.0, 1.0, f64::abs);
        let cubic = fit(&Points { x: &x, y: &y, weight: &[1.0; 401] }, 3, false);
        assert!((cubic[0] - 0.125).abs() < 4e-3 && (cubic[2] - 1.0).abs() < 1e-2, "{cubic:?}");
    }

    #[test]
    fn through_zero_has_no_constant() {
        let (x, y) = grid(-1.0, 0.0, |x| -x - 0.25 * x * x);
        let found = fit(&Points { x: &x, y: &y, weight: &[1.0; 401] }, 3, true);
        assert_eq!(found[0], 0.0);
        assert!((found[1] + 1.0).abs() < 1e-12 && (found[2] + 0.25).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn a_polynomial_stays_within_its_bounds() {
        // steep at the end and constant before: any power overshoots
        let (x, y) = grid(5.0, 90.0, |x| if x < 30.0 { 0.03 * x } else { 0.99 });
        for degree in 0..8 {
            let found = bounded(&x, &y, degree, (0.0, 90.0), (0.0, 1.0));
            let (_, values) = grid(0.0, 90.0, |x| value(&found, x));
            assert!(values.iter().all(|v| (-1e-9..=1.0 + 1e-9).contains(v)), "{degree}: {found:?}");
        }
    }
}
