//! What a linear drag makes of a velocity that it draws to: e^{−z} and the functions φₖ for a step of z relaxation times.
//!
//! φ₁ = (1 − e^{−z})/z and φₖ₊₁ = (1/k! − φₖ)/z, so φₖ(0) = 1/k!. A sphere at v₀ that the drag draws to
//! w(t) = w₀ + a s + b s², s = t/h, arrives with (variation of constants)
//!
//! v = e^{−z} v₀ + zφ₁ w₀ + zφ₂ a + 2zφ₃ b,  x = x₀ + h (φ₁ v₀ + zφ₂ w₀ + zφ₃ a + 2zφ₄ b).
//!
//! Exact for any z; as z → ∞ the motion becomes v = w − w′/β, dx = w dt, and as z → 0 free flight.
//!
//! ```
//! use carom_track::force::brownian::Relaxation;
//! let r = Relaxation::over(2.0);
//! assert!((r.phi[1] - (1.0 + (-2.0f64).exp()) / 4.0).abs() < 1e-16);
//! ```

/// e^{−z} and φ₁ to φ₄.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxation {
    /// The step over the relaxation time.
    pub z: f64,
    /// e^{−z}.
    pub decay: f64,
    /// φ₁ to φ₄.
    pub phi: [f64; 4],
}

/// Below, the series of φ₄, and from it the others downwards; beyond, upwards from e^{−z}. Either way at most two digits are lost.
const SERIES_BELOW: f64 = 1.5;

impl Relaxation {
    /// Of a step of `z` ≥ 0 relaxation times.
    #[inline(always)]
    pub fn over(z: f64) -> Self {
        if z < SERIES_BELOW {
            // Σ (−z)ʲ/(j + 4)!, by Horner
            let mut sum = 1.0;
            for j in (1..=LAST).rev() {
                sum = 1.0 - sum * z * INVERSE[j];
            }
            let fourth = sum / 24.0;
            let third = 1.0 / 6.0 - z * fourth;
            let second = 0.5 - z * third;
            let first = 1.0 - z * second;
            Self { z, decay: 1.0 - z * first, phi: [first, second, third, fourth] }
        } else {
            let decay = if z < 700.0 { carom::math::exp(-z) } else { 0.0 };
            let over = 1.0 / z;
            let first = (1.0 - decay) * over;
            let second = (1.0 - first) * over;
            let third = (0.5 - second) * over;
            Self { z, decay, phi: [first, second, third, (1.0 / 6.0 - third) * over] }
        }
    }
}

/// Terms of the series: at [`SERIES_BELOW`] the last is below 10⁻¹⁶ of the sum.
const LAST: usize = 17;
/// 1/(j + 4).
const INVERSE: [f64; LAST + 1] = {
    let mut all = [0.0; LAST + 1];
    let mut j = 0;
    while j <= LAST {
        all[j] = 1.0 / (j as f64 + 4.0);
        j += 1;
    }
    all
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_branches_are_the_functions() {
        // φₖ = ∫₀¹ e^{−z(1−s)} s^{k−1}/(k−1)! ds by Gauss–Legendre's rule of seven points on 40 pieces
        const NODES: [(f64, f64); 4] = [
            (0.0, 0.417_959_183_673_469_4),
            (0.405_845_151_377_397_2, 0.381_830_050_505_118_9),
            (0.741_531_185_599_394_4, 0.279_705_391_489_276_7),
            (0.949_107_912_342_758_5, 0.129_484_966_168_869_7),
        ];
        for z in [0.0, 1e-12, 1e-3, 0.3, 1.0, 1.4999, 1.5, 1.5001, 4.0, 30.0] {
            let r = Relaxation::over(z);
            for (k, phi) in r.phi.iter().enumerate() {
                let f = |s: f64| (-z * (1.0 - s)).exp() * s.powi(k as i32) / (1..=k).product::<usize>() as f64;
                let piece = |i: usize| {
                    let (m, half) = ((i as f64 + 0.5) / 40.0, 0.5 / 40.0);
                    let pair = |(x, w): &(f64, f64)| {
                        half * w * if *x == 0.0 { f(m) } else { f(m - half * x) + f(m + half * x) }
                    };
                    NODES.iter().map(pair).sum::<f64>()
                };
                let want: f64 = (0..40).map(piece).sum();
                assert!((phi / want - 1.0).abs() < 2e-14, "{z}, {}: {phi} {want}", k + 1);
            }
            assert!((r.decay - (-z).exp()).abs() < 1e-15, "{z}");
        }
        let far = Relaxation::over(1e12);
        assert!(
            far.decay == 0.0 && (far.z * far.phi[1] - 1.0).abs() < 1e-11 && (far.z * far.phi[2] - 0.5).abs() < 1e-11
        );
    }
}
