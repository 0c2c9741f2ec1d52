//! Polynomials on [0, 1] in Bernstein form, and their first downward root.
//!
//! The coefficients bound the polynomial: where all are positive there is no root, so a crossing can be ruled out (or
//! isolated by halving) without sampling, and two crossings within one step are never missed. See Farin, *Curves and
//! Surfaces for CAGD* (2002), chapter 5; Mourrain & Pavone 2009, doi:10.1016/j.jsc.2008.04.016, for the root isolation.

/// Largest number of coefficients: the square of a quartic path has nine.
pub const MAX: usize = 9;

/// A polynomial of degree `len − 1` on [0, 1] by its Bernstein coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Bernstein {
    coefficients: [f64; MAX],
    len: usize,
}

/// Halvings after which an interval is a point: 2⁻⁵² of the step.
const DEEPEST: u32 = 52;

impl Bernstein {
    /// From coefficients; at most [`MAX`] are kept.
    pub fn new(values: &[f64]) -> Self {
        let len = values.len().clamp(1, MAX);
        let mut coefficients = [0.0; MAX];
        for (c, v) in coefficients.iter_mut().zip(values) {
            *c = *v;
        }
        Self { coefficients, len }
    }

    /// A constant, written with a degree.
    pub fn constant(value: f64, degree: usize) -> Self {
        let len = degree.min(MAX - 1) + 1;
        let mut coefficients = [0.0; MAX];
        coefficients.iter_mut().take(len).for_each(|c| *c = value);
        Self { coefficients, len }
    }

    fn slice(&self) -> &[f64] {
        self.coefficients.get(..self.len).unwrap_or(&[])
    }

    /// Value and derivative by de Casteljau's recurrence.
    pub fn value_and_slope(&self, theta: f64) -> (f64, f64) {
        let mut c = self.coefficients;
        let mut slope = 0.0;
        for top in (1..self.len).rev() {
            if top == 1 {
                slope = (c[1] - c[0]) * (self.len - 1) as f64;
            }
            for i in 0..top {
                c[i] = theta.mul_add(c[i + 1] - c[i], c[i]);
            }
        }
        (c[0], slope)
    }

    /// Value.
    pub fn value(&self, theta: f64) -> f64 {
        self.value_and_slope(theta).0
    }

    /// The lower bound that the coefficients give.
    pub fn lower_bound(&self) -> f64 {
        self.slice().iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// q with p(θ) = θ q(θ), for a polynomial whose first coefficient is zero (or is to be read as zero).
    #[must_use]
    pub fn deflated(&self) -> Self {
        let degree = (self.len - 1) as f64;
        let mut q = Self { coefficients: [0.0; MAX], len: (self.len - 1).max(1) };
        for i in 0..self.len - 1 {
            q.coefficients[i] = self.coefficients[i + 1] * (degree / (i + 1) as f64);
        }
        q
    }

    /// The product of two polynomials, if its degree fits.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let (m, n) = (self.len - 1, other.len - 1);
        let mut product = Self { coefficients: [0.0; MAX], len: (m + n + 1).min(MAX) };
        for (i, a) in self.slice().iter().enumerate() {
            for (j, b) in other.slice().iter().enumerate() {
                if let Some(c) = product.coefficients.get_mut(i + j) {
                    *c += binomial(m, i) * binomial(n, j) / binomial(m + n, i + j) * a * b;
                }
            }
        }
        product
    }

    /// The sum of two polynomials of equal degree.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        for (s, o) in sum.coefficients.iter_mut().zip(other.coefficients) {
            *s += o;
        }
        sum
    }

    /// The polynomial times a number, plus another number.
    #[must_use]
    pub fn scaled(&self, factor: f64, shift: f64) -> Self {
        let mut scaled = *self;
        for c in scaled.coefficients.iter_mut().take(self.len) {
            *c = c.mul_add(factor, shift);
        }
        scaled
    }

    fn split(&self) -> (Self, Self) {
        let mut left = *self;
        let mut right = *self;
        let mut c = self.coefficients;
        for k in 0..self.len {
            left.coefficients[k] = c[0];
            right.coefficients[self.len - 1 - k] = c[self.len - 1 - k];
            for i in 0..self.len - 1 - k {
                c[i] = 0.5 * (c[i] + c[i + 1]);
            }
        }
        (left, right)
    }

    fn sign_changes(&self) -> u32 {
        let s = self.slice();
        s.iter().zip(s.iter().skip(1)).map(|(a, b)| u32::from((*a > 0.0) != (*b > 0.0))).sum()
    }

    /// Whether the polynomial falls below zero right after θ = 0.
    pub fn leads_down(&self) -> bool {
        self.slice().iter().find(|c| **c != 0.0).is_some_and(|c| *c < 0.0)
    }

    /// The first θ in (0, 1] where the polynomial goes from positive to zero or below, and which `accept` takes.
    pub fn first_descent(&self, accept: &mut dyn FnMut(f64) -> bool) -> Option<f64> {
        if self.lower_bound() > 0.0 {
            return None;
        }
        self.descend(*self, 0.0, 1.0, DEEPEST, accept)
    }

    fn descend(&self, part: Self, low: f64, high: f64, depth: u32, accept: &mut dyn FnMut(f64) -> bool) -> Option<f64> {
        match part.sign_changes() {
            0 => None,
            1 => {
                let descends = part.coefficients[0] > 0.0;
                let theta = if descends { self.refine(low, high) } else { return None };
                accept(theta).then_some(theta)
            }
            _ if depth == 0 => {
                let descends = part.coefficients[0] > 0.0 && part.coefficients[self.len - 1] <= 0.0;
                (descends && accept(high)).then_some(high)
            }
            _ => {
                let (left, right) = part.split();
                let middle = 0.5 * (low + high);
                self.descend(left, low, middle, depth - 1, accept)
                    .or_else(|| self.descend(right, middle, high, depth - 1, accept))
            }
        }
    }

    /// The root in a bracket that holds exactly one, positive at `low`: Newton's method kept inside the bracket.
    fn refine(&self, mut low: f64, mut high: f64) -> f64 {
        let mut theta = 0.5 * (low + high);
        for _ in 0..100 {
            let (value, slope) = self.value_and_slope(theta);
            if value > 0.0 {
                low = theta;
            } else {
                high = theta;
            }
            let newton = theta - value / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - theta).abs() <= 2.0 * f64::EPSILON * theta || next == theta {
                return next;
            }
            theta = next;
        }
        theta
    }
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Bernstein coefficients of Σ mᵢ θⁱ.
    fn from_monomials(m: &[f64]) -> Bernstein {
        let n = m.len() - 1;
        let c: Vec<f64> = (0..=n)
            .map(|i| (0..=i).map(|k| m[k] * binomial(i, k) / binomial(n, k)).sum())
            .collect();
        Bernstein::new(&c)
    }

    #[test]
    fn first_of_two_descents_within_one_step_is_found() {
        // (θ − 0.2)(θ − 0.3)(θ − 0.7)(θ − 0.9): down at 0.2, up at 0.3, down at 0.7, up at 0.9
        let p = from_monomials(&[0.0378, -0.411, 1.49, -2.1, 1.0]);
        let mut all = Vec::new();
        let none = p.first_descent(&mut |t| {
            all.push(t);
            false
        });
        assert!(none.is_none());
        assert_eq!(all.len(), 2, "{all:?}");
        assert!((all[0] - 0.2).abs() < 1e-12 && (all[1] - 0.7).abs() < 1e-12, "{all:?}");
    }

    #[test]
    fn product_and_deflation_keep_values() {
        let p = from_monomials(&[0.0, 2.0, -1.0, 0.5, 0.25]);
        let q = from_monomials(&[1.0, -3.0, 1.5, 0.0, 2.0]);
        for i in 1..=20 {
            let t = f64::from(i) / 20.0;
            assert!((p.times(&q).value(t) - p.value(t) * q.value(t)).abs() < 1e-13);
            assert!((t * p.deflated().value(t) - p.value(t)).abs() < 1e-14);
        }
    }

    proptest! {
        #[test]
        fn agrees_with_dense_sampling(c in prop::array::uniform5(-1.0f64..1.0), first in 0.01f64..1.0) {
            let mut c = c;
            c[0] = first;
            let p = Bernstein::new(&c);
            let found = p.first_descent(&mut |_| true);
            let sampled = (1..=4000).map(|i| f64::from(i) / 4000.0).find(|t| p.value(*t) < -1e-9);
            match (found, sampled) {
                (Some(t), Some(s)) => prop_assert!(t <= s + 1e-9 && p.value(t).abs() < 1e-9),
                (None, Some(s)) => prop_assert!(false, "missed the crossing before {s}"),
                (Some(t), None) => prop_assert!(p.value(t).abs() < 1e-9),
                (None, None) => {}
            }
        }
    }
}
