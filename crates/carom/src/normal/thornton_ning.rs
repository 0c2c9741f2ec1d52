//! Plastic loss after Thornton & Ning, `plastic-thornton-ning`: elastic, perfectly plastic spheres.
//!
//! Thornton & Ning (1998), Powder Technol. 99, 154–162, <https://doi.org/10.1016/S0032-5910(98)00099-0>; Kim & Dunn (2007), Eq. 44.
//! With q = V_y/v ≤ 1:
//!
//! e² = (6√3/5) [1 − q²/6] [q/(q + 2√(6/5 − q²/5))]^{1/2},  V_y² = (π⁵/30) p_y⁵ r³/(E*⁴ m)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | p_y | limiting *peak* Hertz pressure (1.6 σ; Kadomtsev's λk = 2.85 σ is a mean pressure) | Pa |
//! | E* | effective modulus | Pa |
//! | V_y | yield velocity, of this model alone; 1.5605 (p_y⁵/(E*⁴ρ))^{1/2} on a flat wall | m/s |
//!
//! e(V_y) = 1 exactly and smoothly (zero slope); below yield the loss is zero, where the formula itself would fail.
//!
//! ```
//! use carom::normal::thornton_ning::restitution_squared;
//! assert_eq!(restitution_squared(1.0), 1.0);
//! assert_eq!(restitution_squared(0.5), 1.0); // below yield
//! ```

use super::Size;
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use super::plastic::PLASTIC_LOSS;
use crate::error::LawError;
use crate::math::{self, BEST, Fma};
use crate::spec::Key;
use core::f64::consts::PI;

/// p_y/σ when the law names no limiting pressure.
pub const PRESSURE_OVER_STRENGTH: f64 = 1.6;

/// Thornton and Ning's plastic loss for one pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThorntonNing {
    /// V_y² on a flat wall at the law's density, m²/s².
    pub yield_squared: f64,
}

impl ThorntonNing {
    /// From E* (Pa), limiting peak pressure p_y (Pa) and sphere density (kg/m³).
    pub fn new(effective_modulus: f64, limiting_pressure: f64, density: f64) -> Self {
        let ratio = limiting_pressure / effective_modulus;
        let ratio2 = ratio * ratio;
        let pi4 = PI * PI * PI * PI;
        Self { yield_squared: pi4 / 40.0 * (ratio2 * ratio2) * limiting_pressure / density }
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
        1.0 - restitution_squared_on(f, v * v / self.yield_squared(size))
    }
}

impl Mechanism for ThorntonNing {
    const NAME: &'static str = "plastic-thornton-ning";
    const KIND: &'static str = PLASTIC_LOSS;
    const ABOUT: &'static str = "elastic, perfectly plastic spheres (Thornton & Ning 1998; Kim & Dunn 2007, Eq. 44)";
    const STAGE: Stage = Stage::Bulk;
    const ELASTIC: bool = false;
    const KEYS: &'static [Key] = &[Key::LimitingPressure, Key::PlasticConstant, Key::DynamicStrengthFactor];

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        let pair = law.pair()?;
        let pressure = match law.number(Key::LimitingPressure) {
            Some(given) => given,
            None => 2.0 * pair.plastic_constant()? * PRESSURE_OVER_STRENGTH,
        };
        Ok(Self::new(pair.effective_modulus()?, pressure, pair.density()?))
    }

    #[inline(always)]
    fn take<F: Fma>(&self, f: F, v: f64, size: &Size, account: &mut Account) {
        let fraction = self.fraction_on(f, v, size);
        account.losses.plastic += fraction;
        account.bulk += fraction;
    }

    #[inline(always)]
    fn yield_squared(&self, size: &Size) -> f64 {
        ThorntonNing::yield_squared(self, size)
    }
}

/// e² at s² = (v/V_y)².
pub fn restitution_squared(s2: f64) -> f64 {
    restitution_squared_on(BEST, s2)
}

#[inline(always)]
fn restitution_squared_on<F: Fma>(f: F, s2: f64) -> f64 {
    let yielding = s2 > 1.0;
    let q2 = if yielding { 1.0 / s2 } else { 1.0 };
    let q = math::sqrt(q2);
    let tail = q / f.fma(2.0, math::sqrt(f.fma(q2, -0.2, 1.2)), q);
    let e2 = SCALE * f.fma(q2, -1.0 / 6.0, 1.0) * math::sqrt(tail);
    if yielding { e2.min(1.0) } else { 1.0 }
}

/// 6√3/5.
const SCALE: f64 = 2.078_460_969_082_652_5;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_and_yield() {
        assert!((SCALE - 6.0 * 3f64.sqrt() / 5.0).abs() < 1e-15);
        // the bare formula at q = 1 is 1: (6√3/5)(5/6)(1/3)^{1/2}
        assert!((restitution_squared(1.0 + 1e-12) - 1.0).abs() < 1e-11);
        let t = ThorntonNing::new(1.0, 1.0, 1.0);
        assert!((t.yield_squared.sqrt() - 1.5605).abs() < 5e-5);
    }

    #[test]
    fn falls_as_the_fourth_root_far_above_yield() {
        let e = restitution_squared(1e16).sqrt();
        let expected = (SCALE * (1e-8 / (2.0 * 1.2f64.sqrt())).sqrt()).sqrt();
        assert!((e / expected - 1.0).abs() < 1e-6);
    }
}
