//! Adhesion as a well of energy, `adhesion-well`: Dahneke's model of bouncing.
//!
//! The sphere falls into a well of depth E_i, loses part of the energy it then has, and climbs out of a well of depth E_r. From the
//! balance of energy, with e² what the bulk losses leave,
//!
//! (V/v)² = e² − (E_r − e²E_i)/(½mv²),  captured at and below  v_c² = 2(E_r − e²E_i)/(me²),
//!
//! so as a loss ε = (E_r − e²E_i)/(½mv²). V ≤ v at every speed needs E_r ≥ E_i. The depth is given, or it is that of an undeformed
//! sphere at the equilibrium spacing from a flat wall, E = A r/(6 z₀) with A the Hamaker constant (A d/(12 z₀) for a flat wall).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E_i, E_r | depth of the well on the way in and on the way out (key `well_depth`, `well_depth_out`) | J |
//! | A | Hamaker constant (key `hamaker_constant`) | J |
//! | z₀ | equilibrium spacing, about 0.3 to 0.4 nm (key `equilibrium_spacing`) | m |
//! | r | effective radius | m |
//! | m | mass of the sphere | kg |
//! | e² | what the bulk losses leave of ½mv² | – |
//!
//! Range: adhesion that acts before the bodies deform; a contact that adhesion enlarges belongs to `adhesion-work` or `adhesion-jkr`.
//! Roughness is not in it: the depth is that of the real surface. Source: Dahneke (1971), J. Colloid Interface Sci. 37, 342–353,
//! <https://doi.org/10.1016/0021-9797(71)90302-X>, and (1975), J. Colloid Interface Sci. 51, 58–65,
//! <https://doi.org/10.1016/0021-9797(75)90083-1> (not re-read here: the form is derived above).
//!
//! ```
//! use carom::normal::{Ledger, Size, Term, restitution::GivenRestitution, well::AdhesionWell};
//! // 1 µm polystyrene, e = 0.96, a well of 1e-16 J both ways: v_c² = 2E(1/e² − 1)/m
//! let terms = [
//!     Term::GivenRestitution(GivenRestitution::new(0.96)),
//!     Term::AdhesionWell(AdhesionWell::of_depths(1e-16, 1e-16, 1050.0)),
//! ];
//! let window = Ledger::new(terms).expect("of two kinds").window(&Size::flat(0.5e-6)).expect("it rebounds");
//! let mass = 1050.0 * std::f64::consts::PI / 6.0 * 1e-18;
//! let v_c = (2e-16 * (1.0 / 0.96f64.powi(2) - 1.0) / mass).sqrt();
//! assert!((window.capture_velocity / v_c - 1.0).abs() < 1e-12);
//! ```

use super::Size;
use super::adhesion::{ADHESION_WORK, RADIUS_UNIT};
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use crate::error::{LawError, Problem};
use crate::math::{self, Fma};
use crate::spec::{Choice, Key};
use alloc::borrow::ToOwned;
use alloc::string::ToString;
use core::f64::consts::PI;

/// A well: depths over half the mass of a sphere of the law's density, radii in units of 10 µm, m²/s².
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AdhesionWell {
    /// Given depths, of every size.
    Depths {
        /// On the way in.
        within: f64,
        /// On the way out.
        out: f64,
    },
    /// Hamaker's, in proportion to the effective radius, the same both ways.
    Hamaker(f64),
}

/// 1/(½m) of a sphere of the unit's radius, 1/kg.
fn per_half_mass(density: f64) -> f64 {
    3.0 / (2.0 * PI * density * (RADIUS_UNIT * RADIUS_UNIT * RADIUS_UNIT))
}

impl AdhesionWell {
    /// From the depths on the way in and out (J, out ≥ in ≥ 0) and the sphere's density (kg/m³).
    pub fn of_depths(within: f64, out: f64, density: f64) -> Self {
        debug_assert!(0.0 <= within && within <= out);
        let scale = per_half_mass(density);
        Self::Depths { within: within * scale, out: out * scale }
    }

    /// From the Hamaker constant A (J), the equilibrium spacing z₀ (m) and the sphere's density (kg/m³).
    pub fn of_hamaker(hamaker_constant: f64, spacing: f64, density: f64) -> Self {
        Self::Hamaker(hamaker_constant * RADIUS_UNIT / (6.0 * spacing) * per_half_mass(density))
    }

    /// Depths on the way in and out over half the mass, m²/s².
    #[inline(always)]
    fn depths(&self, size: &Size) -> (f64, f64) {
        let r = size.radius * (1.0 / RADIUS_UNIT);
        match self {
            Self::Depths { within, out } => {
                let mass = size.density_ratio * (r * r * r);
                (within / mass, out / mass)
            }
            Self::Hamaker(depth) => {
                let depth = depth * size.kappa / (size.density_ratio * (r * r));
                (depth, depth)
            }
        }
    }
}

impl Mechanism for AdhesionWell {
    const NAME: &'static str = "adhesion-well";
    const KIND: &'static str = ADHESION_WORK;
    const ABOUT: &'static str =
        "fall into an adhesion well and climb out of it, given by depth or Hamaker constant (Dahneke 1971)";
    const STAGE: Stage = Stage::Surface;
    const KEYS: &'static [Key] = &[Key::WellDepth, Key::WellDepthOut, Key::HamakerConstant, Key::EquilibriumSpacing];

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        let density = law.pair()?.density()?;
        let idle =
            |key, reader| Err(Problem::IdleKey { key, beside: None, readers: vec![Choice::Given(reader)] }.into());
        let [within, out, hamaker] = [Key::WellDepth, Key::WellDepthOut, Key::HamakerConstant].map(|k| law.number(k));
        match (within, out, hamaker) {
            (Some(_), _, None) if law.number(Key::EquilibriumSpacing).is_some() => {
                idle(Key::EquilibriumSpacing, Key::HamakerConstant)
            }
            (Some(within), Some(out), None) if out < within => Err(Problem::OutOfRange {
                key: Key::WellDepthOut.name().to_owned(),
                value: out.to_string(),
                unit: "J",
                right: format!("it is at least well_depth, {within} J: a sphere would else leave faster than it came"),
            }
            .into()),
            (Some(within), out, None) => Ok(Self::of_depths(within, out.unwrap_or(within), density)),
            (None, Some(_), Some(_)) => idle(Key::WellDepthOut, Key::WellDepth),
            (_, _, Some(constant)) => Ok(Self::of_hamaker(constant, law.needed(Key::EquilibriumSpacing)?, density)),
            (None, _, None) => law.needed(Key::WellDepth).map(|depth| Self::of_depths(depth, depth, density)),
        }
    }

    #[inline(always)]
    fn take<F: Fma>(&self, f: F, v: f64, size: &Size, account: &mut Account) {
        let (within, out) = self.depths(size);
        let kept = (1.0 - account.bulk).max(0.0);
        let fraction = f.fma(-kept, within, out) / (v * v).max(f64::MIN_POSITIVE);
        account.losses.adhesion += fraction;
        account.left -= fraction;
    }

    /// Without bulk losses: nothing where the well is as deep on the way in.
    fn capture_velocity(&self, size: &Size) -> Option<f64> {
        let (within, out) = self.depths(size);
        (out > 0.0).then(|| math::sqrt(out - within))
    }

    /// The depth on the way out.
    fn hold_squared(&self, size: &Size) -> Option<f64> {
        Some(self.depths(size).1)
    }

    fn is_idle(&self) -> bool {
        match self {
            Self::Depths { out, .. } => *out == 0.0,
            Self::Hamaker(depth) => *depth == 0.0,
        }
    }
}
