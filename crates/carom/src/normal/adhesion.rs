//! Adhesion: the work of pulling the surfaces apart, in two forms (a law holds one of them).
//!
//! # `adhesion-work` (Kim & Dunn 2007, Eqs 16–21)
//!
//! The adhesion force is a line force 2πa f₀ C_R on the contact's rim, and its work over the separation is (2/3)(a_m²/r)
//! times that force at the greatest (Hertzian) contact radius a_m:
//!
//! Ψ_A(v) = (8π/3) C_R f₀ (5/4K)^{3/5} (r/m²)^{1/5} v^{−4/5},  f₀ = (9Krw²/2π)^{1/3}
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | C_R | roughness factor | – |
//! | f₀ | tension of the adhesion force | N/m |
//! | K | Hertzian stiffness | Pa |
//! | w | work of adhesion | J/m² |
//! | r, R | effective and sphere radius | m |
//! | m = (4/3)πρR³ | mass | kg |
//! | v | normal approach speed | m/s |
//!
//! With κ = r/R this is B (v¹²R¹⁰κ⁻⁸)^{−1/15}, B holding the materials alone, so one pair serves every diameter with one
//! logarithm and one exponential. Range: elastic contact (the paper keeps the Hertzian a_m above yield too, where the true
//! plastic contact would make the work 1.02, 1.23, 1.32 times larger at 1.1, 5, 20 times the yield velocity).
//! Source: Kim & Dunn (2007), J. Aerosol Sci. 38, 532–549, <https://doi.org/10.1016/j.jaerosci.2007.03.006>.
//!
//! # `adhesion-jkr` (Thornton & Ning 1998)
//!
//! ε = (V_s/v)²,  V_s² = (14.18/m)(w⁵r⁴/E*²)^{1/3}: the energy that tearing a JKR contact takes. There is no roughness
//! factor in it. Source: Thornton & Ning (1998), Powder Technol. 99, 154–162,
//! <https://doi.org/10.1016/S0032-5910(98)00099-0>.
//!
//! ```
//! use carom::normal::{Size, adhesion::Work};
//! // 70 µm stainless steel on silicon: K = 127.8 GPa, w = 3.03 J/m², C_R = 0.15 (Kim & Dunn 2007, Table 2 and Fig. 8)
//! let work = Work::new(127.8e9, 3.03, 0.15, 8000.0);
//! let psi = work.fraction(1.0, &Size::flat(35e-6));
//! assert!((psi - 0.0536).abs() < 1e-4);
//! ```

use super::Size;
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use super::registry::Term;
use crate::error::LawError;
use crate::math::{self, BEST, Fma};
use crate::spec::Key;
use crate::validity::Validity;
use core::f64::consts::PI;

/// Radii are measured in this unit inside the power products, which keeps them far from overflow.
pub(super) const RADIUS_UNIT: f64 = 1e-5;
/// Approach speeds are clamped to this range (m/s) inside the power products; outside it every sphere is captured or none is.
const SPEEDS: (f64, f64) = (1e-18, 1e18);

/// Kind of the losses that are an adhesion work.
pub(super) const ADHESION_WORK: &str = "adhesion work";

/// Constants of Ψ_A, and of the damping that shares it. With B = 0 both vanish.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    scale: f64,
    /// C_A of an adhesion damping that was joined to the work, s/m.
    damping: f64,
}

impl Work {
    /// From stiffness K (Pa), work of adhesion w (J/m²), roughness factor C_R and sphere density ρ (kg/m³).
    pub fn new(stiffness: f64, work_of_adhesion: f64, roughness_factor: f64, density: f64) -> Self {
        if work_of_adhesion <= 0.0 || roughness_factor <= 0.0 {
            return Self::default();
        }
        // one logarithm of everything: no intermediate overflows
        let ln_f0 = (math::ln(9.0 / (2.0 * PI)) + math::ln(stiffness) + 2.0 * math::ln(work_of_adhesion)) / 3.0;
        let ln_rest = 0.6 * (math::ln(1.25) - math::ln(stiffness))
            - 0.4 * (math::ln(4.0 * PI / 3.0) + math::ln(density))
            - (2.0 / 3.0) * math::ln(RADIUS_UNIT);
        Self { scale: (8.0 * PI / 3.0) * roughness_factor * math::exp(ln_f0 + ln_rest), damping: 0.0 }
    }

    /// From a law's materials and C_R.
    ///
    /// # Errors
    /// A material that lacks what the stiffness, the work of adhesion or the mass need.
    pub fn of(law: &Inputs) -> Result<Self, LawError> {
        let pair = law.pair()?;
        Ok(Self::new(pair.stiffness()?, pair.work_of_adhesion()?, law.roughness_factor(), pair.density()?))
    }

    /// (v¹²R¹⁰κ⁻⁸)^{−1/15}, R in units of 10 µm.
    #[inline(always)]
    fn power<F: Fma>(&self, f: F, v: f64, size: &Size) -> f64 {
        let v = v.max(SPEEDS.0).min(SPEEDS.1);
        let v2 = v * v;
        let r = size.radius * (1.0 / RADIUS_UNIT);
        let r2 = r * r;
        // the square root of the product, for a shorter chain and a wider range
        let product = (v2 * v2 * v2) * ((r2 * r2) * r * size_correction(size));
        math::pow_on(f, product, -2.0 / 15.0)
    }

    /// Ψ_A at approach speed `v` (m/s).
    pub fn fraction(&self, v: f64, size: &Size) -> f64 {
        self.fraction_on(BEST, v, size)
    }

    #[inline(always)]
    pub(crate) fn fraction_on<F: Fma>(&self, f: F, v: f64, size: &Size) -> f64 {
        self.scale * self.power(f, v, size)
    }

    /// Takes `counted` (1 or 0) times Ψ_A for the work, and Ψ_A C_A v for its damping, as one product: the fewest operations after the
    /// number that is known last.
    #[inline(always)]
    fn take_shares<F: Fma>(&self, f: F, counted: f64, v: f64, size: &Size, account: &mut Account) {
        let power = self.power(f, v, size);
        let psi = self.scale * power;
        let damped = self.damping * v;
        account.losses.adhesion += counted * psi;
        account.losses.adhesion_damping += psi * damped;
        account.left = f.fma(-power, self.scale * (counted + damped), account.left);
    }

    /// Capture velocity of this loss alone, m/s: Ψ_A(1)^{5/4} exactly.
    pub fn capture_velocity(&self, size: &Size) -> f64 {
        let one = self.fraction(1.0, size);
        one * math::sqrt(math::sqrt(one))
    }
}

impl Mechanism for Work {
    const NAME: &'static str = "adhesion-work";
    const KIND: &'static str = ADHESION_WORK;
    const ABOUT: &'static str =
        "work of adhesion against a Hertz contact, Ψ_A ∝ C_R v^(-4/5) (Kim & Dunn 2007, Eq. 21)";
    const STAGE: Stage = Stage::Surface;
    const KEYS: &'static [Key] = &[
        Key::WorkOfAdhesion,
        Key::InterfacialParameter,
        Key::RoughnessFactor,
        Key::Roughness,
        Key::EquilibriumSpacing,
    ];
    const ROUGHNESS: bool = true;
    const ADHESIVE_CONTACT: bool = true;

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        Self::of(law)
    }

    #[inline(always)]
    fn take<F: Fma>(&self, f: F, v: f64, size: &Size, account: &mut Account) {
        self.take_shares(f, 1.0, v, size, account);
    }

    #[inline(always)]
    fn is_damping(&self) -> bool {
        self.damping > 0.0
    }

    fn capture_velocity(&self, size: &Size) -> Option<f64> {
        Some(Work::capture_velocity(self, size))
    }

    /// The work at the fastest approach that it captures, where it equals the kinetic energy.
    fn hold_squared(&self, size: &Size) -> Option<f64> {
        let v = Work::capture_velocity(self, size);
        Some(v * v)
    }

    fn exhaustion(&self, _: &Size) -> Option<(f64, Validity)> {
        (self.damping > 0.0).then_some((f64::INFINITY, Validity::DAMPING_EXHAUSTED))
    }
}

/// Adhesion damping, Ψ_A C_A v, in a ledger without the adhesion work; beside it, it joins [`Work`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdhesionDamping(Work);

impl AdhesionDamping {
    /// From the constants of Ψ_A and C_A (s/m).
    pub fn new(work: Work, coefficient: f64) -> Self {
        Self(Work { damping: coefficient, ..work })
    }
}

impl Mechanism for AdhesionDamping {
    const NAME: &'static str = "adhesion-damping";
    const KIND: &'static str = "adhesion damping";
    const ABOUT: &'static str = "damping of the adhesion force, Ψ_A C_A v (Kim & Dunn 2007, Eq. 24)";
    const STAGE: Stage = Stage::Surface;
    const KEYS: &'static [Key] = &[
        Key::AdhesionDamping,
        Key::WorkOfAdhesion,
        Key::InterfacialParameter,
        Key::RoughnessFactor,
        Key::Roughness,
        Key::EquilibriumSpacing,
    ];
    const ROUGHNESS: bool = true;
    const ADHESIVE_CONTACT: bool = true;

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        let work = Work::of(law)?;
        let c_a = law.needed(Key::AdhesionDamping)?;
        Ok(Self::new(work, c_a))
    }

    #[inline(always)]
    fn take<F: Fma>(&self, f: F, v: f64, size: &Size, account: &mut Account) {
        self.0.take_shares(f, 0.0, v, size, account);
    }

    fn is_idle(&self) -> bool {
        self.0.damping == 0.0
    }

    #[inline(always)]
    fn is_damping(&self) -> bool {
        true
    }

    fn exhaustion(&self, _: &Size) -> Option<(f64, Validity)> {
        Some((f64::INFINITY, Validity::DAMPING_EXHAUSTED))
    }

    fn join(&self, other: &Term) -> Option<Term> {
        match other {
            Term::AdhesionWork(work) => Some(Term::AdhesionWork(Work { damping: self.0.damping, ..*work })),
            _ => None,
        }
    }
}

/// κ⁻⁴ (ρ/ρ₀)³, exactly 1 on a flat wall with the law's own density.
#[inline(always)]
fn size_correction(size: &Size) -> f64 {
    if size.is_plain() {
        return 1.0;
    }
    let k = 1.0 / size.kappa;
    let k2 = k * k;
    let d = size.density_ratio;
    (k2 * k2) * (d * d * d)
}

/// Constants of the JKR loss (V_s/v)².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jkr {
    scale: f64,
}

impl Jkr {
    /// From E* (Pa), w (J/m²) and sphere density ρ (kg/m³).
    pub fn new(effective_modulus: f64, work_of_adhesion: f64, density: f64) -> Self {
        if work_of_adhesion <= 0.0 {
            return Self { scale: 0.0 };
        }
        let ln = (5.0 * math::ln(work_of_adhesion) - 2.0 * math::ln(effective_modulus)) / 3.0
            - math::ln(4.0 * PI / 3.0)
            - math::ln(density)
            - (5.0 / 3.0) * math::ln(RADIUS_UNIT);
        Self { scale: 14.18 * math::exp(ln) }
    }

    /// V_s², m²/s²: ∝ κ^{4/3} R^{−5/3}.
    pub fn sticking_velocity_squared(&self, size: &Size) -> f64 {
        self.sticking_squared_on(BEST, size)
    }

    #[inline(always)]
    fn sticking_squared_on<F: Fma>(&self, f: F, size: &Size) -> f64 {
        let r = size.radius * (1.0 / RADIUS_UNIT);
        let r2 = r * r;
        let k2 = size.kappa * size.kappa;
        let product = (r2 * r2) * r / (k2 * k2);
        self.scale / size.density_ratio * math::pow_on(f, product, -1.0 / 3.0)
    }

    /// The fraction of the normal kinetic energy that adhesion takes at approach speed `v` (m/s).
    pub fn fraction(&self, v: f64, size: &Size) -> f64 {
        self.fraction_on(BEST, v, size)
    }

    #[inline(always)]
    fn fraction_on<F: Fma>(&self, f: F, v: f64, size: &Size) -> f64 {
        self.sticking_squared_on(f, size) / (v * v).max(f64::MIN_POSITIVE)
    }
}

impl Mechanism for Jkr {
    const NAME: &'static str = "adhesion-jkr";
    const KIND: &'static str = ADHESION_WORK;
    const ABOUT: &'static str =
        "energy that tearing a JKR contact takes, (V_s/v)² (Thornton & Ning 1998); knows no roughness";
    const STAGE: Stage = Stage::Surface;
    const KEYS: &'static [Key] = &[Key::WorkOfAdhesion, Key::InterfacialParameter, Key::EquilibriumSpacing];
    const ADHESIVE_CONTACT: bool = true;

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        let pair = law.pair()?;
        Ok(Self::new(pair.effective_modulus()?, pair.work_of_adhesion()?, pair.density()?))
    }

    #[inline(always)]
    fn take<F: Fma>(&self, f: F, v: f64, size: &Size, account: &mut Account) {
        let fraction = self.fraction_on(f, v, size);
        account.losses.adhesion += fraction;
        account.left -= fraction;
    }

    fn capture_velocity(&self, size: &Size) -> Option<f64> {
        Some(math::sqrt(self.sticking_velocity_squared(size)))
    }

    /// The work of tearing a resting sphere off.
    fn hold_squared(&self, size: &Size) -> Option<f64> {
        Some(self.sticking_velocity_squared(size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The formulas written out with the system's powf.
    fn plain_work(k: f64, w: f64, c_r: f64, rho: f64, v: f64, radius: f64, r: f64) -> f64 {
        let m = 4.0 / 3.0 * PI * rho * radius.powi(3);
        let f0 = (9.0 * k * r * w * w / (2.0 * PI)).powf(1.0 / 3.0);
        8.0 * PI / 3.0 * c_r * f0 * (5.0 / (4.0 * k)).powf(0.6) * (r / (m * m)).powf(0.2) * v.powf(-0.8)
    }

    #[test]
    fn scaled_forms_equal_the_written_ones() {
        for (v, radius, kappa, ratio) in
            [(0.3, 35e-6, 1.0, 1.0), (20.0, 1e-6, 0.8, 1.0), (1e-4, 2.5e-3, 1.3, 0.5), (100.0, 5e-8, 1.0, 2.0)]
        {
            let size = Size { radius, kappa, density_ratio: ratio };
            let work = Work::new(127.8e9, 3.03, 0.15, 8000.0).fraction(v, &size);
            let expected = plain_work(127.8e9, 3.03, 0.15, 8000.0 * ratio, v, radius, kappa * radius);
            assert!((work / expected - 1.0).abs() < 1e-14, "{work} {expected}");
            let jkr = Jkr::new(95e9, 3.03, 8000.0).fraction(v, &size);
            let m = 4.0 / 3.0 * PI * 8000.0 * ratio * radius.powi(3);
            let vs2 = 14.18 / m * (3.03f64.powi(5) * (kappa * radius).powi(4) / 95e9f64.powi(2)).powf(1.0 / 3.0);
            assert!((jkr / (vs2 / (v * v)) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn no_adhesion_no_loss() {
        assert_eq!(Work::new(1e11, 0.0, 1.0, 8000.0).fraction(1e-9, &Size::flat(1e-6)), 0.0);
        assert_eq!(Jkr::new(1e11, 0.0, 8000.0).fraction(1e-9, &Size::flat(1e-6)), 0.0);
    }

    #[test]
    fn capture_velocity_is_where_the_fraction_is_one() {
        let work = Work::new(127.8e9, 3.03, 0.15, 8000.0);
        let size = Size::flat(35e-6);
        assert!((work.fraction(work.capture_velocity(&size), &size) - 1.0).abs() < 1e-14);
    }
}
