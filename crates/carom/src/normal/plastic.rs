//! Plastic loss after Kadomtsev, `plastic-kadomtsev`: the elastic–plastic contact of the paper's EAP model.
//!
//! Kim & Dunn (2007), Eqs 29–36, J. Aerosol Sci. 38, 532–549, <https://doi.org/10.1016/j.jaerosci.2007.03.006>, after
//! Alexandrov, Kadomtsev & Tsaryuk (1984). In y = √(F_max/F₁) and s = v/V_y every material constant cancels:
//!
//! (1−β)/4 · y⁴ + (1+β)/6 · y³ + (5β−1)/60 = (2/5) s²,  e_pl² = y³/s²  for s > 1, and e_pl = 1 for s ≤ 1,
//!
//! V_y = (9/(8√5)) E*⁻² η^{5/2} r^{3/2} m^{−1/2},  η = πλk.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | λ = 5.7, β = 0.33 | constants of the model | – |
//! | k = σ/2 | plastic constant of the body that yields first | Pa |
//! | E* | effective modulus | Pa |
//! | F_max, F₁ | greatest contact force, force at yield | N |
//! | V_y | yield velocity, of this model alone | m/s |
//!
//! The curve is monotone, exactly 1 at yield, and falls as 1.386 s^{−1/4}: it never reaches zero. Range: the contact radius
//! must stay small against R (`large-contact`; the paper names about 25 m/s for steel). β ≤ 0.6 keeps e ≤ 1 above yield.
//! The paper's closed quartic root (Eq. 32) is the same root; here a third-order iteration from an estimate exact at both ends.
//!
//! ```
//! use carom::normal::plastic::universal;
//! assert!((universal(100.0, 0.33).sqrt() - 0.4215800636560269).abs() < 1e-15);
//! ```

use super::Size;
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use crate::error::LawError;
use crate::math::{self, BEST, Fma};
use crate::spec::Key;
use core::f64::consts::PI;

/// Kind of the plastic losses.
pub(super) const PLASTIC_LOSS: &str = "plastic loss";

/// λ of the limiting pressure λk.
pub const LAMBDA: f64 = 5.7;
/// β of the loading curve.
pub const BETA: f64 = 0.33;

/// Kadomtsev's plastic loss for one pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kadomtsev {
    /// V_y² on a flat wall at the law's density, m²/s².
    pub yield_squared: f64,
}

impl Kadomtsev {
    /// From E* (Pa), plastic constant k (Pa) and sphere density (kg/m³).
    pub fn new(effective_modulus: f64, plastic_constant: f64, density: f64) -> Self {
        // with r = R and m = (4/3)πρR³ the radius drops out: V_y² = (81/320) η⁵ / (E*⁴ (4/3)πρ)
        let eta = PI * LAMBDA * plastic_constant;
        let ratio = eta / effective_modulus;
        let ratio2 = ratio * ratio;
        Self { yield_squared: (81.0 / 320.0) * (ratio2 * ratio2) * eta / ((4.0 * PI / 3.0) * density) }
    }

    /// V_y² for this size, m²/s²: ∝ κ³/ρ.
    #[inline(always)]
    pub fn yield_squared(&self, size: &Size) -> f64 {
        self.yield_squared * (size.kappa * size.kappa * size.kappa) / size.density_ratio
    }

    /// Fraction of the normal kinetic energy lost at approach speed `v` (m/s).
    pub fn fraction(&self, v: f64, size: &Size) -> f64 {
        self.fraction_on(BEST, v, size)
    }

    #[inline(always)]
    fn fraction_on<F: Fma>(&self, f: F, v: f64, size: &Size) -> f64 {
        1.0 - universal_of_square(f, v * v / self.yield_squared(size), BETA)
    }
}

impl Mechanism for Kadomtsev {
    const NAME: &'static str = "plastic-kadomtsev";
    const KIND: &'static str = PLASTIC_LOSS;
    const ABOUT: &'static str = "elastic-plastic contact of the EAP model (Kadomtsev; Kim & Dunn 2007, Eqs 29-34)";
    const STAGE: Stage = Stage::Bulk;
    const ELASTIC: bool = false;
    const KEYS: &'static [Key] = &[Key::PlasticConstant, Key::DynamicStrengthFactor];

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        let pair = law.pair()?;
        Ok(Self::new(pair.effective_modulus()?, pair.plastic_constant()?, pair.density()?))
    }

    #[inline(always)]
    fn take<F: Fma>(&self, f: F, v: f64, size: &Size, account: &mut Account) {
        let fraction = self.fraction_on(f, v, size);
        account.losses.plastic += fraction;
        account.bulk += fraction;
    }

    #[inline(always)]
    fn yield_squared(&self, size: &Size) -> f64 {
        Kadomtsev::yield_squared(self, size)
    }
}

/// e_pl² at s = v/V_y, for any s ≥ 0.
pub fn universal(s: f64, beta: f64) -> f64 {
    universal_of_square(BEST, s * s, beta)
}

#[inline(always)]
fn universal_of_square<F: Fma>(f: F, s2: f64, beta: f64) -> f64 {
    let a = (1.0 - beta) / 4.0;
    let b = (1.0 + beta) / 6.0;
    let yielding = s2 > 1.0;
    // far above any impact the curve is followed no further (and s⁴ must not overflow)
    let s2 = if yielding { s2 } else { 1.0 }.min(1e200);
    // q(y) = a y⁴ + b y³ − target, target = a + b at yield
    let target = f.fma(0.4, s2 - 1.0, a + b);
    // a (y + h)⁴ with h = b/4a shares the two leading terms; the constant makes it exact at y = 1
    let h = b / (4.0 * a);
    let h1 = (1.0 + h) * (1.0 + h);
    let mut y = math::sqrt(math::sqrt((0.4 * (s2 - 1.0)) / a + h1 * h1)) - h;
    let quartic = |y: f64| f.fma(f.fma(a, y, b) * (y * y), y, -target);
    let mut inverse_slope = 0.0;
    for _ in 0..2 {
        // Halley's step on q, q′ = y²(4a y + 3b), q″ = y(12a y + 6b)
        let q = quartic(y);
        let d = f.fma(4.0 * a, y, 3.0 * b) * (y * y);
        let dd = f.fma(12.0 * a, y, 6.0 * b) * y;
        inverse_slope = d / f.fma(d, d, -(0.5 * q) * dd);
        y = f.fma(-q, inverse_slope, y);
    }
    // what is left is 1e-13 at most: Newton's steps with the slope at hand
    y = f.fma(-quartic(y), inverse_slope, y);
    y = f.fma(-quartic(y), inverse_slope, y);
    if yielding { (y * y * y / s2).min(1.0) } else { 1.0 }
}

// e stays at or below 1 just above yield
const _: () = assert!(BETA <= 0.6);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reference_values_of_the_universal_curve() {
        for (s, e) in [
            (1.1, 0.9900254376767421),
            (2.0, 0.9168630662015397),
            (10.0, 0.6937264417670767),
            (100.0, 0.4215800636560269),
        ] {
            let got = universal(s, 0.33).sqrt();
            assert!((got / e - 1.0f64).abs() < 2e-15, "{s}: {got} {e}");
        }
        assert_eq!(universal(1.0, 0.33), 1.0);
        assert_eq!(universal(0.2, 0.33), 1.0);
    }

    #[test]
    fn the_root_solves_its_equation_from_yield_to_far_above() {
        for beta in [0.0, 0.2, 0.33, 0.5, 0.6] {
            let mut last = 1.0;
            for i in 0..4000 {
                let s = 10f64.powf(f64::from(i) / 500.0); // 1 to 1e8
                let e2 = universal(s, beta);
                assert!(e2 <= last, "monotone: beta {beta}, s {s}");
                last = e2;
                let y = (e2 * s * s).cbrt();
                let left = (1.0 - beta) / 4.0 * y.powi(4) + (1.0 + beta) / 6.0 * y.powi(3) + (5.0 * beta - 1.0) / 60.0;
                assert!((left / (0.4 * s * s) - 1.0).abs() < 1e-14, "beta {beta}, s {s}");
            }
        }
    }

    #[test]
    fn asymptote() {
        let e = universal(1e12, 0.33).sqrt();
        assert!((e * 1e3 / (1.6f64 / 0.67).powf(0.375) - 1.0).abs() < 1e-3);
        assert!(((1.6f64 / 0.67).powf(0.375) - 1.386).abs() < 1e-3);
    }

    #[test]
    fn alumina_on_aluminium() {
        let e_star = 1.0 / ((1.0 - 0.23f64 * 0.23) / 360e9 + (1.0 - 0.35f64 * 0.35) / 70e9);
        let loss = Kadomtsev::new(e_star, 145e6, 3950.0);
        let size = Size::flat(2.5e-3);
        assert!((loss.yield_squared(&size).sqrt() / 0.3090864456266438 - 1.0).abs() < 1e-14);
        assert!(((1.0 - loss.fraction(1.0, &size)).sqrt() / 0.8511273680121857 - 1.0).abs() < 1e-14);
        assert!(((1.0 - loss.fraction(6.3, &size)).sqrt() / 0.600055619 - 1.0).abs() < 1e-9);
    }
}
