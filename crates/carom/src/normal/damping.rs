//! Hertzian (material) damping, `hertz-damping`, and adhesion damping, `adhesion-damping`.
//!
//! Kim & Dunn (2007), Eqs 22–24, J. Aerosol Sci. 38, 532–549, <https://doi.org/10.1016/j.jaerosci.2007.03.006>:
//!
//! - Hertzian damping takes Ψ_H C_H with Ψ_H = (5/2)(2/3)^{5/2} v (Eqs 20, 22 and 23; it needs neither size nor stiffness);
//! - adhesion damping takes Ψ_A C_A v, with Ψ_A of [`super::adhesion`].
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | v | normal approach speed | m/s |
//! | C_H, C_A | damping coefficients, fitted to one diameter of a pair and reused for the others | s/m |
//!
//! Both are crude quadratures of the damping forces: resolved in time ([`crate::resolved`]) the first-order Hertzian loss is
//! (4/3)C_H v instead of 0.907 C_H v, and the adhesion damping of a separation-only contact 0.757 Ψ_A C_A v instead of Ψ_A C_A v.
//! At high speed damping alone reaches 1: the end of the model's domain, reported as `damping-exhausted`.
//!
//! ```
//! let psi_h = carom::normal::damping::HERTZ * 1.0;
//! assert!((psi_h - 0.907218423253029).abs() < 1e-15);
//! ```

use super::Size;
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use crate::error::LawError;
use crate::math::Fma;
use crate::spec::Key;
use crate::validity::Validity;

/// (5/2)(2/3)^{5/2} = (10/9)√(2/3).
pub const HERTZ: f64 = 0.907_218_423_253_029;

/// Hertzian damping: Ψ_H C_H.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzDamping {
    /// C_H, s/m.
    pub coefficient: f64,
}

impl HertzDamping {
    pub(crate) const NONE: Self = Self { coefficient: 0.0 };

    /// Fraction of the normal kinetic energy lost at approach speed `v` (m/s).
    #[inline(always)]
    pub fn fraction(&self, v: f64) -> f64 {
        HERTZ * self.coefficient * v
    }
}

impl Mechanism for HertzDamping {
    const NAME: &'static str = "hertz-damping";
    const KIND: &'static str = "Hertzian damping";
    const ABOUT: &'static str = "damping in the bodies, Ψ_H C_H = 0.907 C_H v (Kim & Dunn 2007, Eq. 23)";
    const STAGE: Stage = Stage::Bulk;
    const KEYS: &'static [Key] = &[Key::HertzDamping];

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        let coefficient = law.needed(Key::HertzDamping)?;
        Ok(Self { coefficient })
    }

    #[inline(always)]
    fn take<F: Fma>(&self, _: F, v: f64, _: &Size, account: &mut Account) {
        let fraction = self.fraction(v);
        account.losses.hertz_damping += fraction;
        account.bulk += fraction;
    }

    fn is_idle(&self) -> bool {
        self.coefficient == 0.0
    }

    #[inline(always)]
    fn is_damping(&self) -> bool {
        true
    }

    fn exhaustion(&self, _: &Size) -> Option<(f64, Validity)> {
        Some((1.0 / (HERTZ * self.coefficient), Validity::DAMPING_EXHAUSTED))
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_constant_is_the_papers() {
        assert!((super::HERTZ - 2.5 * (2.0f64 / 3.0).powf(2.5)).abs() < 1e-15);
    }
}
