use super::*;

fn ulps(a: f64, b: f64) -> f64 {
    (a - b).abs() / (b.abs() * f64::EPSILON)
}

#[test]
fn ln_and_exp_agree_with_the_system_to_two_units_in_the_last_place() {
    for i in 0..200_000 {
        let x = 10f64.powf(-300.0 + f64::from(i) * 0.003);
        // near 1 the logarithm's own zero magnifies nothing: the reduced argument m − 1 is exact there
        assert!(x == 1.0 || ulps(ln(x), x.ln()) <= 2.0, "ln {x:e}: {} {}", ln(x), x.ln());
        let y = -700.0 + f64::from(i) * 0.007;
        assert!(ulps(exp(y), y.exp()) <= 2.0, "exp {y}");
        let near = 1.0 + (f64::from(i) - 1e5) * 4e-6;
        if near != 1.0 {
            assert!(ulps(ln(near), near.ln()) <= 3.0, "ln {near}");
        }
    }
}

#[test]
fn pow_agrees_with_the_system() {
    for y in [-1.0 / 15.0, -1.0 / 3.0, 0.4, 0.25, 2.4] {
        for i in 0..20_000 {
            let x = 10f64.powf(-120.0 + f64::from(i) * 0.012);
            let bound = 4.0 + 1.3 * (y * x.log2()).abs();
            assert!(ulps(pow(x, y), x.powf(y)) <= bound, "{x:e}^{y}: {} {}", pow(x, y), x.powf(y));
        }
    }
    assert_eq!(pow(1.0, 0.3), 1.0);
}

#[test]
fn angle_agrees_with_atan2() {
    for i in 0..=9000 {
        let a = (f64::from(i) / 100.0).to_radians();
        let (s, c) = a.sin_cos();
        let got = angle(3.0 * c.max(0.0), 3.0 * s);
        assert!((got - a).abs() <= 1e-15 + 4e-16 * a, "{i}: {got} {a}");
    }
}

#[test]
fn sin_cos_agrees_with_the_system() {
    for i in -6283..=6283 {
        let x = f64::from(i) * 1e-3;
        let (s, c) = sin_cos(x);
        assert!((s - x.sin()).abs() < 3e-16 && (c - x.cos()).abs() < 3e-16, "{x}: {s} {c}");
    }
    assert_eq!(sin_cos(0.0), (0.0, 1.0));
}

/// Numbers of every size and kind, and each with its neighbours.
fn any_numbers() -> Vec<f64> {
    let mut all = vec![0.0, f64::INFINITY, f64::NAN, f64::MAX, f64::MIN_POSITIVE, 5e-324, 1e-310];
    for i in 0..4000 {
        all.push(10f64.powf(-320.0 + 0.157 * f64::from(i)));
        all.push(1.0 + (f64::from(i) - 2000.0) * 1e-4);
        all.push(f64::from(i) * 0.003);
    }
    let near =
        all.clone().into_iter().flat_map(|x| [-1, 1].map(|d| f64::from_bits(x.to_bits().wrapping_add_signed(d))));
    all.extend(near);
    let negative = all.clone().into_iter().map(|x| -x);
    all.extend(negative);
    all
}

#[test]
fn leaves_have_the_same_bits_without_a_fused_multiply_add() {
    fn all<F: Fma>(f: F, x: f64) -> [f64; 9] {
        let (sine, cosine) = sin_cos_on(f, x);
        let (log, power) = (log2_on(f, x), pow_on(f, x, -0.8));
        let quantile = normal::normal_quantile_on(f, x);
        [ln_on(f, x), exp_on(f, x), exp2_on(f, x), log, power, sine, cosine, angle_on(f, 0.7, x), quantile]
    }
    let bits = |values: [f64; 9]| values.map(|v| if v.is_nan() { 0 } else { v.to_bits() });
    for x in any_numbers() {
        let want = bits(all(Fused, x));
        assert_eq!(bits(all(Plain, x)), want, "{x:e}");
        let (found, exact) = watched(|f| all(f, x));
        assert!(!exact || bits(found) == want, "{x:e}");
    }
}

#[test]
fn extremes_are_clamped_not_wrong() {
    assert!(exp(1e9).is_finite() && exp(-1e9) > 0.0);
    assert!(exp(f64::NAN).is_nan());
}
