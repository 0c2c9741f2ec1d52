//! Tangential laws: what an oblique impact does to the sliding speed and the spin.
//!
//! A friction law answers with an impulse per mass against the slip of the contact point, v_s = v_t + ω × (−Rû); from it follow
//! (Kim & Dunn 2007, §3.2, J. Aerosol Sci. 38, 532–549, <https://doi.org/10.1016/j.jaerosci.2007.03.006>)
//!
//! Δv_t = −P v̂_s,  Δω = (5/2)(P/R)(û × v̂_s),  impulse ratio μ = P/((1 + e)v_n).
//!
//! The impulse opposes the slip, never a coordinate axis, so nothing changes when the wall is rotated. The other kind gives the
//! rebound's tangential speed of the centre outright ([`constant`]) and leaves the spin alone.

pub mod constant;
pub mod micro_slip;
pub mod rolling;
pub mod walton;

use crate::math::Fma;
use crate::normal::NormalResponse;
use crate::normal::empirical::Lookup;
use micro_slip::{PartialSlip, Shape};

/// How the contact ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
pub enum Contact {
    /// Sliding to the end of contact.
    Sliding,
    /// Rolling (no slip) at the end of contact.
    Rolling,
    /// Partial slip of an elastic contact.
    MicroSlip,
    /// No tangential contact force: no slip, a law that gives e_t outright, or a capture.
    #[default]
    None,
}

impl Contact {
    /// The word in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sliding => "sliding",
            Self::Rolling => "rolling",
            Self::MicroSlip => "micro-slip",
            Self::None => "none",
        }
    }
}

/// A tangential law, compiled: plain numbers. The shape of a micro-slip law and the pieces of a curve stand in the kernel's tables.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Tangential {
    /// Coulomb friction f, and a contact point that rebounds with β₀ times its slip: 0 is the paper's rolling.
    Friction {
        /// Coulomb friction coefficient f.
        friction: f64,
        /// Walton's β₀, 0 for rigid-body rolling.
        beta: f64,
    },
    /// Partial slip of an elastic contact.
    MicroSlip(PartialSlip),
    /// e_t of the centre, constant or by angle; the spin stays.
    Restitution(Lookup),
    /// No friction was given: enough for impacts without slip, an error for others.
    NotGiven,
}

impl Tangential {
    /// Coulomb friction coefficient f; `None` for laws that give the rebound outright or were given none.
    pub fn friction(&self) -> Option<f64> {
        match self {
            Self::Friction { friction, .. } => Some(*friction),
            Self::MicroSlip(law) => Some(law.friction()),
            Self::Restitution(_) | Self::NotGiven => None,
        }
    }
}

/// A law of friction, as a type of its own so that a batch's loop holds no branch on its kind.
pub(crate) trait FrictionLaw {
    /// How a contact ends that does not slide to the end.
    const HELD: Contact;
    /// Impulse per mass against a slip speed, m/s: (P, sliding to the end?). `normal_impulse` is (1 + e)v_n.
    fn impulse<F: Fma>(&self, f: F, slip: f64, normal_impulse: f64, response: &NormalResponse) -> (f64, bool);
}

/// Rolling and Walton's law.
#[derive(Clone, Copy)]
pub(crate) struct Coulomb {
    pub friction: f64,
    pub beta: f64,
}

impl FrictionLaw for Coulomb {
    const HELD: Contact = Contact::Rolling;

    #[inline(always)]
    fn impulse<F: Fma>(&self, _: F, slip: f64, normal_impulse: f64, response: &NormalResponse) -> (f64, bool) {
        let stick = walton::stick_impulse(self.beta, slip);
        let cap = self.friction * response.friction_share * normal_impulse;
        (if cap < stick { cap } else { stick }, cap < stick)
    }
}

/// Micro-slip with the shape of its curve.
pub(crate) struct Shaped<'a> {
    pub slip: PartialSlip,
    pub shape: &'a Shape,
}

impl FrictionLaw for Shaped<'_> {
    const HELD: Contact = Contact::MicroSlip;

    #[inline(always)]
    fn impulse<F: Fma>(&self, f: F, slip: f64, normal_impulse: f64, response: &NormalResponse) -> (f64, bool) {
        let cap = self.slip.friction() * response.friction_share * normal_impulse;
        let u = slip / self.slip.sliding_slip(f, cap, response.e);
        // no friction gives no number where there is no slip either
        let u = if u < 1.0 { u } else { 1.0 };
        (cap * self.shape.fraction(f, u, response.e), u >= 1.0)
    }
}
