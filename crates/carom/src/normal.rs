//! Normal laws: what a rebound keeps of the normal speed.
//!
//! Three kinds: a [`Ledger`] of losses, a [`empirical`] table (constant or by incidence angle), and the resolved
//! contact equation ([`crate::resolved`]). In a ledger every mechanism takes a fraction ε(v) of the normal kinetic
//! energy and the restitution is what they leave: e² = 1 − Σ ε(v). One file per mechanism.

pub mod adhesion;
pub mod bons;
pub mod damping;
pub mod el_batsh;
pub mod empirical;
mod inputs;
pub mod ledger;
mod mechanism;
pub mod plastic;
mod registry;
mod response;
pub mod restitution;
pub mod tabor;
pub mod thornton_ning;
pub mod well;
mod window;

pub use inputs::Inputs;
pub use ledger::Ledger;
pub(crate) use ledger::ShortList;
pub use mechanism::{Account, Losses, Mechanism, Stage};
pub(crate) use registry::Loops;
pub use registry::{Loss, Term};
pub use response::NormalLaw;
pub(crate) use response::NormalResponse;
pub use window::Window;

/// The size of an impact: all that a loss needs beyond the approach speed and the law's constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Sphere radius R, m.
    pub radius: f64,
    /// κ = r/R, effective over geometric radius; 1 on a flat wall.
    pub kappa: f64,
    /// Sphere density over the density the law was compiled for.
    pub density_ratio: f64,
}

impl Size {
    /// A sphere of the law's own density on a flat wall.
    #[inline(always)]
    pub fn flat(radius: f64) -> Self {
        Self { radius, kappa: 1.0, density_ratio: 1.0 }
    }

    /// Flat wall, own density: every correction factor is exactly one.
    #[inline(always)]
    pub(crate) fn is_plain(&self) -> bool {
        self.kappa == 1.0 && self.density_ratio == 1.0
    }
}
