//! Plastic loss after Bons, `plastic-bons`: what a bar can store elastically is what a rebound keeps.
//!
//! Bons, Prenter & Whitaker (2017), J. Turbomach. 139, 081009, <https://doi.org/10.1115/1.4036012> (the "OSU" model of deposition),
//! take the particle for an elastic cylinder. Codes in circulation write its yield velocity with different factors of π and start
//! above e = 1, so it is derived here from the cylinder alone, not copied. At yield the whole cylinder, of volume Ω, holds
//!
//! ½ (σ²/E) Ω = ½ ρ Ω V_y²,  so  V_y = σ/√(ρE),
//!
//! and above it no more than that comes back: e = min(1, V_y/v), continuous, and never above 1. ε = 1 − (V_y/v)² above yield.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | σ = 2k | yield strength of the body that yields first (k its plastic constant) | Pa |
//! | E = E* | effective modulus of the pair: both bodies are compressed. On a rigid wall E/(1 − ν²) of the sphere | Pa |
//! | ρ | density of the sphere | kg/m³ |
//! | V_y | yield velocity, of this model alone; of neither size nor curvature | m/s |
//!
//! Range: a bar yields all at once, a sphere at a point first, so V_y is much larger than Kadomtsev's (58 times for alumina on
//! aluminium) and the fall beyond it much steeper (1/v against v^{−1/4}). With adhesion, which falls only as v^{−4/5}, the rebound
//! therefore ends at a second root, above which the sphere is captured again: V_y (V_y/v_c)^{2/3}, v_c being adhesion's own capture
//! velocity (`plastic-exhausted`).
//!
//! ```
//! use carom::normal::{Size, bons::Bons};
//! let bons = Bons::new(70e9, 280e6, 2500.0);
//! let v_y = bons.yield_squared(&Size::flat(1e-5)).sqrt();
//! assert!((v_y - 21.166).abs() < 1e-3); // 280e6/√(2500 · 70e9)
//! assert!((1.0 - bons.fraction(2.0 * v_y, &Size::flat(1e-5)) - 0.25).abs() < 1e-15); // e = 1/2
//! assert_eq!(bons.fraction(0.9 * v_y, &Size::flat(1e-5)), 0.0);
//! ```

use super::Size;
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use super::plastic::PLASTIC_LOSS;
use crate::error::LawError;
use crate::math::{self, Fma};
use crate::spec::Key;
use crate::validity::Validity;

/// Bons' plastic loss for one pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bons {
    /// V_y² at the law's density, m²/s².
    pub yield_squared: f64,
}

impl Bons {
    /// From E* (Pa), yield strength σ (Pa) and sphere density (kg/m³).
    pub fn new(effective_modulus: f64, yield_strength: f64, density: f64) -> Self {
        Self { yield_squared: (yield_strength / effective_modulus) * (yield_strength / density) }
    }

    /// V_y² for this size, m²/s²: ∝ 1/ρ.
    #[inline(always)]
    pub fn yield_squared(&self, size: &Size) -> f64 {
        self.yield_squared / size.density_ratio
    }

    /// Fraction of the normal kinetic energy lost at approach speed `v`.
    #[inline(always)]
    pub fn fraction(&self, v: f64, size: &Size) -> f64 {
        (1.0 - self.yield_squared(size) / (v * v)).max(0.0)
    }
}

impl Mechanism for Bons {
    const NAME: &'static str = "plastic-bons";
    const KIND: &'static str = PLASTIC_LOSS;
    const ABOUT: &'static str =
        "energy an elastic bar can store at yield, e = V_y/v above it (Bons et al. 2017, as derived here)";
    const STAGE: Stage = Stage::Bulk;
    const ELASTIC: bool = false;
    const KEYS: &'static [Key] = &[Key::PlasticConstant, Key::DynamicStrengthFactor];

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        let pair = law.pair()?;
        let strength = 2.0 * pair.plastic_constant()?;
        Ok(Self::new(pair.effective_modulus()?, strength, pair.density()?))
    }

    #[inline(always)]
    fn take<F: Fma>(&self, _: F, v: f64, size: &Size, account: &mut Account) {
        let fraction = self.fraction(v, size);
        account.losses.plastic += fraction;
        account.bulk += fraction;
    }

    #[inline(always)]
    fn yield_squared(&self, size: &Size) -> f64 {
        Bons::yield_squared(self, size)
    }

    fn exhaustion(&self, size: &Size) -> Option<(f64, Validity)> {
        Some((math::sqrt(Bons::yield_squared(self, size)), Validity::PLASTIC_EXHAUSTED))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::normal::adhesion::{AdhesionDamping, Jkr, Work};
    use crate::normal::damping::HertzDamping;
    use crate::normal::{Ledger, Term};

    const SIZE: Size = Size { radius: 5e-6, kappa: 1.0, density_ratio: 1.0 };

    /// Bons' loss with an adhesion and damping coefficients C_A, C_H.
    fn ledger(adhesion: Option<Term>, w: f64, c_a: f64, c_h: f64) -> Ledger {
        let work = Work::new(127.8e9, w, 0.5, 8000.0);
        let bons = Term::PlasticBons(Bons::new(95.85e9, 310e6, 8000.0));
        let damping = [
            Term::AdhesionDamping(AdhesionDamping::new(work, c_a)),
            Term::HertzDamping(HertzDamping { coefficient: c_h }),
        ];
        Ledger::new([bons].into_iter().chain(adhesion).chain(damping)).expect("one of each kind")
    }

    fn work(w: f64) -> Work {
        Work::new(127.8e9, w, 0.5, 8000.0)
    }

    #[test]
    fn keeps_the_energy_of_yield_and_no_more() {
        let bons = Bons::new(95.85e9, 310e6, 8000.0);
        let v_y = 310e6 / (8000.0f64 * 95.85e9).sqrt();
        assert!((bons.yield_squared.sqrt() / v_y - 1.0).abs() < 1e-15);
        let mut last = 1.0;
        for i in 0..400 {
            let v = v_y * 10f64.powf(f64::from(i - 100) / 100.0);
            let kept = 1.0 - bons.fraction(v, &SIZE);
            assert!(kept <= last && kept > 0.0, "{v}");
            assert!((kept * v * v - v.min(v_y).powi(2)).abs() < 1e-12 * v * v);
            last = kept;
        }
        assert!(bons.fraction(v_y * (1.0 + 1e-9), &SIZE) < 3e-9);
        assert_eq!(bons.fraction(1e-200, &SIZE), 0.0);
    }

    #[test]
    fn adhesion_brings_a_second_root_at_high_speed() {
        let ledger = ledger(Some(Term::AdhesionWork(work(1.0))), 1.0, 0.0, 0.0);
        let window = ledger.window(&SIZE).expect("it rebounds");
        assert_eq!(window.capture_velocity, work(1.0).capture_velocity(&SIZE));
        for (v, open_above) in [(window.capture_velocity, true), (window.exhausted_velocity, false)] {
            let [below, above] = [1.0 - 1e-9, 1.0 + 1e-9].map(|f| ledger.left(v * f, &SIZE) > 0.0);
            assert_eq!([below, above], [!open_above, open_above], "{window:?}");
        }
        assert_eq!(ledger.restitution(1e3 * window.exhausted_velocity, &SIZE), 0.0);
    }

    /// The window against a plain search over speeds, damped and not.
    #[test]
    fn windows_hold_every_speed_of_rebound() {
        let mut closed = 0;
        for adhesion in 0..3 {
            for (a, h) in [(0.0, 0.0), (0.05, 0.0), (0.0, 0.01), (1.3, 0.007), (200.0, 0.0), (0.0, 5.0)] {
                for w in [0.05, 1.0, 300.0] {
                    let jkr = Term::AdhesionJkr(Jkr::new(95.85e9, 1.0, 8000.0));
                    let term = [None, Some(Term::AdhesionWork(work(w))), Some(jkr)][adhesion];
                    let ledger = ledger(term, w, a, h);
                    let window = ledger.window(&SIZE);
                    closed += u32::from(window.is_none());
                    for i in 0..3000 {
                        let v = 10f64.powf(f64::from(i) / 300.0 - 4.0);
                        let inside = window.is_some_and(|w| v > w.capture_velocity && v < w.exhausted_velocity);
                        let rebounds = ledger.left(v, &SIZE) > 0.0;
                        assert_eq!(rebounds, inside, "{ledger:?} at {v}: {window:?}");
                    }
                }
            }
        }
        assert!(closed > 0, "some of these never rebound");
    }
}
