//! The few transcendental functions used here, in one place, so that one implementation with fixed bits serves them all.

/// Natural logarithm of a positive number.
#[inline(always)]
pub(crate) fn ln(x: f64) -> f64 {
    x.ln()
}

/// Exponential.
#[inline(always)]
pub(crate) fn exp(x: f64) -> f64 {
    x.exp()
}

/// `x` to the power `p`, for `x` ≥ 0; 0 to any positive power is 0 up to 1e-300^p, far below rounding of what uses it.
#[inline(always)]
pub(crate) fn pow(x: f64, p: f64) -> f64 {
    exp(p * ln(x.max(1e-300)))
}

/// Arc tangent.
#[inline(always)]
pub(crate) fn atan(x: f64) -> f64 {
    x.atan()
}

/// Tangent of `x` in [0, π/2]; the end itself gives a large finite number.
///
/// Taylor series of sine and cosine up to π/4, the reciprocal beyond: error below 4 units in the last place.
#[inline(always)]
pub(crate) fn tan(x: f64) -> f64 {
    const QUARTER: f64 = std::f64::consts::FRAC_PI_4;
    // π/2 in two parts, so that the complement of a number near it keeps its digits
    let folded = if x > QUARTER { (std::f64::consts::FRAC_PI_2 - x) + 6.123_233_995_736_766e-17 } else { x };
    let z = folded * folded;
    let series = |first: f64| {
        // Σ (−z)^k first!/(2k + first)!, Horner from the highest term
        (1..=9).rev().fold(1.0, |sum, k| {
            let n = 2.0 * f64::from(k) + first;
            1.0 - z / (n * (n - 1.0)) * sum
        })
    };
    let (sin, cos) = (folded * series(1.0), series(0.0));
    if x > QUARTER { cos / sin } else { sin / cos }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangent() {
        for i in 0..=1000 {
            let x = std::f64::consts::FRAC_PI_2 * f64::from(i) / 1000.0;
            let (got, want) = (tan(x), x.tan());
            assert!((got - want).abs() <= 1e-15 * want, "{x} {got} {want}");
        }
    }

    #[test]
    fn powers() {
        assert_eq!(pow(0.0, 0.687), pow(0.0, 0.687).abs());
        assert!(pow(0.0, 0.687) < 1e-200);
        assert!((pow(800.0, 0.687) / 800.0f64.powf(0.687) - 1.0).abs() < 1e-14);
    }
}
