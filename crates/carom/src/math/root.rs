//! Roots and maxima of a function of one positive variable, by bisection and golden section of its logarithm.

use super::{exp, ln, sqrt};

/// The sign change of `f` on [low, high], both positive, to the last bit; `f(low) ≤ 0 < f(high)` or the reverse. Answers with the end
/// of the last interval at which `f` is not positive.
pub fn sign_change(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let positive_at_high = f(high) > 0.0;
    for _ in 0..200 {
        let middle = sqrt(low) * sqrt(high);
        if middle <= low || middle >= high {
            break;
        }
        if (f(middle) > 0.0) == positive_at_high { high = middle } else { low = middle }
    }
    if positive_at_high { low } else { high }
}

/// Where a function with one maximum on [low, high], both positive, is greatest: to a relative 1e-8 or so, as flat as a maximum is.
pub fn peak(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut a, mut b) = (ln(low), ln(high));
    let at = |x: f64| (x, f(exp(x)));
    let (mut c, mut d) = (at(b - GOLDEN * (b - a)), at(a + GOLDEN * (b - a)));
    while b - a > 1e-10 {
        if c.1 > d.1 {
            (b, d) = (d.0, c);
            c = at(b - GOLDEN * (b - a));
        } else {
            (a, c) = (c.0, d);
            d = at(a + GOLDEN * (b - a));
        }
    }
    exp(0.5 * (a + b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_change_to_the_last_bit_from_either_side() {
        let up = sign_change(1e-6, 1e6, |x| x * x - 2.0);
        assert!(up * up <= 2.0 && up.next_up().powi(2) > 2.0);
        let down = sign_change(1e-6, 1e6, |x| 2.0 - x * x);
        assert!(2.0 - down * down <= 0.0 && 2.0 - down.next_down().powi(2) > 0.0);
    }

    #[test]
    fn peaks_are_found_over_many_decades() {
        for at in [3e-9, 0.7, 5e4] {
            let found = peak(1e-12, 1e6, |x| -(ln(x / at) * ln(x / at)));
            assert!((found / at - 1.0).abs() < 1e-7, "{found} {at}");
        }
    }
}
