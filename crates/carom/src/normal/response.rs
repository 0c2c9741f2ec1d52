//! A normal law, compiled, and what it answers.

use super::empirical::{Lookup, Piece};
use super::mechanism::{Account, Losses};
use super::{Ledger, Size, Term};
use crate::math::{self, Fma};
use crate::resolved::Resolved;

/// A normal law, compiled: plain numbers. A curve's pieces stand in the kernel's tables.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NormalLaw {
    /// A list of losses.
    Ledger(Ledger),
    /// Restitution as a constant or by angle.
    Table(Lookup),
    /// The resolved contact equation.
    Resolved(Resolved),
}

/// What a normal law answers.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NormalResponse {
    pub e: f64,
    pub losses: Losses,
    /// Hertz impulse over (1 + e)v_n, by which the resolved law's friction is larger; 1 otherwise.
    pub friction_share: f64,
}

impl NormalResponse {
    #[inline(always)]
    pub fn of_account(account: &Account) -> Self {
        Self { e: account.restitution(), losses: account.losses, friction_share: 1.0 }
    }

    #[inline(always)]
    pub fn of_restitution(e: f64) -> Self {
        Self { e, losses: Losses { other: 1.0 - e * e, ..Losses::default() }, friction_share: 1.0 }
    }

    /// Fraction of the normal kinetic energy lost, above 1 for a capture.
    #[inline(always)]
    pub fn lost(&self) -> f64 {
        self.losses.total()
    }
}

impl NormalLaw {
    /// Does it take the bodies to stay elastic? A curve by angle says nothing of them.
    pub(crate) fn is_elastic(&self) -> bool {
        match self {
            Self::Ledger(ledger) => ledger.terms().all(Term::is_elastic),
            Self::Table(_) => false,
            Self::Resolved(_) => true,
        }
    }

    /// The factor on the work of adhesion that its adhesive contact has, C_R or 1; 0 without one.
    pub(crate) fn adhesive_contact(&self, roughness_factor: f64) -> f64 {
        match self {
            Self::Ledger(ledger) => ledger
                .terms()
                .filter(|t| t.is_adhesive_contact())
                .map(|t| if t.loss().uses_roughness() { roughness_factor } else { 1.0 })
                .fold(0.0, f64::max),
            Self::Table(_) => 0.0,
            Self::Resolved(_) => roughness_factor,
        }
    }

    /// `tangent2` is the square of the tangential speed, `pieces` those of the law's curves.
    #[inline(always)]
    pub(crate) fn respond<F: Fma>(
        &self,
        f: F,
        pieces: &[Piece],
        v_n: f64,
        tangent2: f64,
        size: &Size,
    ) -> NormalResponse {
        match self {
            Self::Ledger(ledger) => NormalResponse::of_account(&ledger.balance(f, v_n, size)),
            Self::Table(curve) => {
                NormalResponse::of_restitution(curve.at(f, pieces, v_n, math::sqrt(tangent2), 0.0, 1.0))
            }
            Self::Resolved(resolved) => resolved.respond(v_n, size),
        }
    }

    /// Does adhesion that roughness lessens stand in it?
    pub(crate) fn uses_roughness(&self) -> bool {
        match self {
            Self::Ledger(ledger) => ledger.terms().any(|t| t.loss().uses_roughness()),
            Self::Table(_) => false,
            Self::Resolved(_) => true,
        }
    }
}
