//! Tangent and arc tangent with the same bits on every machine, for the slot jet.

/// Arc tangent, of either sign.
#[inline(always)]
pub(super) fn atan(x: f64) -> f64 {
    carom::math::angle(1.0, x.abs()).copysign(x)
}

/// Tangent of `x` in [0, π/2]; the end itself gives a large finite number.
///
/// Taylor series of sine and cosine up to π/4, the reciprocal of the complement's beyond: relative error below 1e-15.
#[inline(always)]
pub(super) fn tan(x: f64) -> f64 {
    const QUARTER: f64 = std::f64::consts::FRAC_PI_4;
    // π/2 in two parts, so that the complement of a number near it keeps its digits
    let folded = if x > QUARTER { (std::f64::consts::FRAC_PI_2 - x) + 6.123_233_995_736_766e-17 } else { x };
    let z = folded * folded;
    let series = |first: f64| {
        // 1 − z/(n(n−1)) (1 − …), n = 2k + first: cosine for first = 0, sine over its argument for 1
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
    fn agree_with_the_systems() {
        for i in 0..=1000 {
            let x = std::f64::consts::FRAC_PI_2 * f64::from(i) / 1000.0;
            let (got, want) = (tan(x), x.tan());
            assert!((got - want).abs() <= 1e-15 * want, "{x} {got} {want}");
            let t = f64::from(i) - 500.0;
            assert!((atan(t) - t.atan()).abs() <= 1e-15 * t.atan().abs(), "{t}");
        }
        assert!((atan(tan(std::f64::consts::FRAC_PI_2)) - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    }
}
