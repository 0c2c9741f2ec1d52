//! Polynomials on [0, 1] in Bernstein form, and their first downward root.
//!
//! The coefficients bound the polynomial: where all are positive there is no root, so a crossing can be ruled out (or
//! isolated by halving) without sampling, and two crossings within one step are never missed. See Farin, *Curves and
//! Surfaces for CAGD* (2002), chapter 5; Mourrain & Pavone 2009, doi:10.1016/j.jsc.2008.04.016, for the root isolation.

/// A polynomial of degree N − 1 on [0, 1] by its Bernstein coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bernstein<const N: usize>(pub [f64; N]);

/// Where a polynomial goes from positive to zero or below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Descents {
    /// Nowhere in (0, 1].
    None,
    /// There alone.
    One(f64),
    /// Perhaps at more than one place: [`Bernstein::first_descent`] finds them.
    Many,
}

/// Halvings after which an interval is a point: 2⁻⁵² of the step.
const DEEPEST: u32 = 52;

impl<const N: usize> Bernstein<N> {
    /// Value and derivative by de Casteljau's recurrence.
    #[inline]
    pub fn value_and_slope(&self, theta: f64) -> (f64, f64) {
        let mut c = self.0;
        let mut slope = 0.0;
        for top in (1..N).rev() {
            if top == 1 {
                slope = (c[1] - c[0]) * (N - 1) as f64;
            }
            for i in 0..top {
                c[i] += theta * (c[i + 1] - c[i]);
            }
        }
        (c[0], slope)
    }

    /// Value.
    pub fn value(&self, theta: f64) -> f64 {
        self.value_and_slope(theta).0
    }

    /// The least and the greatest coefficient but the first: with that, bounds.
    #[inline(always)]
    pub fn range_ahead(&self) -> (f64, f64) {
        self.0.iter().skip(1).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| {
            (if *c < low { *c } else { low }, if *c > high { *c } else { high })
        })
    }

    /// The polynomial q with p(θ) = p(0) + θ q(θ).
    ///
    /// It is written with as many coefficients as p, one degree higher than it needs.
    #[must_use]
    #[inline(always)]
    pub fn deflated(&self) -> Self {
        let degree = (N - 1) as f64;
        // q of degree N − 2, then raised by one degree
        let low = |i: usize| (self.0[i + 1] - self.0[0]) * (degree / (i + 1) as f64);
        let mut q = [0.0; N];
        for (i, q) in q.iter_mut().enumerate() {
            let share = i as f64 / degree;
            let before = if i > 0 { share * low(i - 1) } else { 0.0 };
            let here = if i + 1 < N { (1.0 - share) * low(i) } else { 0.0 };
            *q = before + here;
        }
        Self(q)
    }

    /// The sum of two polynomials.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        sum.0.iter_mut().zip(other.0).for_each(|(s, o)| *s += o);
        sum
    }

    /// The polynomial times a number, plus another number.
    #[must_use]
    #[inline(always)]
    pub fn scaled(&self, factor: f64, shift: f64) -> Self {
        Self(self.0.map(|c| c * factor + shift))
    }

    /// Both halves.
    pub fn split(&self) -> (Self, Self) {
        let (mut left, mut right) = (*self, *self);
        let mut c = self.0;
        for k in 0..N {
            left.0[k] = c[0];
            right.0[N - 1 - k] = c[N - 1 - k];
            for i in 0..N - 1 - k {
                c[i] = 0.5 * (c[i] + c[i + 1]);
            }
        }
        (left, right)
    }

    #[inline(always)]
    fn sign_changes(&self) -> u32 {
        (1..N).map(|i| u32::from((self.0[i - 1] > 0.0) != (self.0[i] > 0.0))).sum()
    }

    /// Whether the polynomial falls below zero right after θ = 0, where it is zero or starts.
    #[inline(always)]
    pub fn leads_down(&self) -> bool {
        self.0.iter().find(|c| **c != 0.0).is_some_and(|c| *c < 0.0)
    }

    /// All descents, where that is plain.
    #[inline(always)]
    pub fn descents(&self) -> Descents {
        match self.sign_changes() {
            0 => Descents::None,
            1 if self.0[0] > 0.0 => Descents::One(self.refine(0.0, 1.0)),
            1 => Descents::None,
            _ => Descents::Many,
        }
    }

    /// The first θ in (0, 1] where the polynomial goes from positive to zero or below, and which `accept` takes.
    #[inline(always)]
    pub fn first_descent(&self, mut accept: impl FnMut(f64) -> bool) -> Option<f64> {
        // the usual cases, without the recursion
        match self.descents() {
            Descents::None => None,
            Descents::One(theta) => accept(theta).then_some(theta),
            Descents::Many => self.descend(*self, 0.0, 1.0, DEEPEST, &mut accept),
        }
    }

    fn descend(&self, part: Self, low: f64, high: f64, depth: u32, accept: &mut dyn FnMut(f64) -> bool) -> Option<f64> {
        match part.sign_changes() {
            0 => None,
            1 => {
                let theta = if part.0[0] > 0.0 { self.refine(low, high) } else { return None };
                accept(theta).then_some(theta)
            }
            _ if depth == 0 => {
                let descends = part.0[0] > 0.0 && part.0[N - 1] <= 0.0;
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

    /// Coefficients of the powers of θ.
    #[inline(always)]
    fn powers(&self) -> [f64; N] {
        let mut m = self.0;
        for k in 1..N {
            // the k-th differences, of which the first stays at m[k]
            for i in (k..N).rev() {
                m[i] -= m[i - 1];
            }
        }
        let mut binomial = 1.0;
        for (k, m) in m.iter_mut().enumerate().skip(1) {
            binomial *= (N - k) as f64 / k as f64;
            *m *= binomial;
        }
        m
    }

    /// The root in a bracket that holds exactly one, positive at `low`: Halley's method kept inside the bracket.
    #[inline(always)]
    fn refine(&self, mut low: f64, mut high: f64) -> f64 {
        // where the chord between the ends crosses: close for the gentle curves of a step
        let (at_low, at_high) =
            if low == 0.0 && high == 1.0 { (self.0[0], self.0[N - 1]) } else { (self.value(low), self.value(high)) };
        let m = self.powers();
        let chord = low + (high - low) * at_low / (at_low - at_high);
        let mut theta = if chord > low && chord < high { chord } else { 0.5 * (low + high) };
        for _ in 0..100 {
            let [value, slope, bend] = taylor(&m, theta);
            if value > 0.0 {
                low = theta;
            } else {
                high = theta;
            }
            let halley = theta - value * slope / slope.mul_add(slope, -(value * bend));
            if halley >= low && halley <= high {
                // Halley's method cubes what is left: 1e-6 of θ becomes rounding
                if (halley - theta).abs() <= 1e-6 * theta {
                    return halley;
                }
                theta = halley;
            } else {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    return high;
                }
                theta = middle;
            }
        }
        theta
    }
}

/// Value, slope and half the second derivative of a polynomial by its powers.
#[inline(always)]
fn taylor<const N: usize>(m: &[f64; N], x: f64) -> [f64; 3] {
    let (mut value, mut slope, mut bend) = (m[N - 1], 0.0f64, 0.0f64);
    for c in m.iter().rev().skip(1) {
        bend = bend.mul_add(x, slope);
        slope = slope.mul_add(x, value);
        value = value.mul_add(x, *c);
    }
    [value, slope, bend]
}

impl Bernstein<6> {
    /// The product of two quintics.
    #[must_use]
    pub fn times(&self, other: &Self) -> Bernstein<11> {
        const FIVE: [f64; 6] = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
        const TEN: [f64; 11] = [1.0, 10.0, 45.0, 120.0, 210.0, 252.0, 210.0, 120.0, 45.0, 10.0, 1.0];
        let mut product = [0.0; 11];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += FIVE[i] * FIVE[j] / TEN[i + j] * a * b;
            }
        }
        Bernstein(product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn binomial(n: usize, k: usize) -> f64 {
        (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64)
    }

    /// Bernstein coefficients of Σ mᵢ θⁱ.
    fn from_monomials<const N: usize>(m: &[f64; N]) -> Bernstein<N> {
        Bernstein(std::array::from_fn(|i| (0..=i).map(|k| m[k] * binomial(i, k) / binomial(N - 1, k)).sum()))
    }

    #[test]
    fn first_of_two_descents_within_one_step_is_found() {
        // (θ − 0.2)(θ − 0.3)(θ − 0.7)(θ − 0.9): down at 0.2, up at 0.3, down at 0.7, up at 0.9
        let p = from_monomials(&[0.0378, -0.411, 1.49, -2.1, 1.0]);
        let mut all = Vec::new();
        let none = p.first_descent(|t| {
            all.push(t);
            false
        });
        assert!(none.is_none());
        assert_eq!(all.len(), 2, "{all:?}");
        assert!((all[0] - 0.2).abs() < 1e-12 && (all[1] - 0.7).abs() < 1e-12, "{all:?}");
    }

    #[test]
    fn product_and_deflation_keep_values() {
        let p = from_monomials(&[0.0, 2.0, -1.0, 0.5, 0.25, -0.125]);
        let q = from_monomials(&[1.0, -3.0, 1.5, 0.0, 2.0, 0.5]);
        for i in 1..=20 {
            let t = f64::from(i) / 20.0;
            assert!((p.times(&q).value(t) - p.value(t) * q.value(t)).abs() < 1e-13);
            assert!((t * p.deflated().value(t) - p.value(t)).abs() < 1e-14);
            assert!((q.0[0] + t * q.deflated().value(t) - q.value(t)).abs() < 1e-14);
        }
    }

    proptest! {
        #[test]
        fn agrees_with_dense_sampling(c in prop::array::uniform6(-1.0f64..1.0), first in 0.01f64..1.0) {
            let mut c = c;
            c[0] = first;
            let p = Bernstein(c);
            let found = p.first_descent(|_| true);
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
