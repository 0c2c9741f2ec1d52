//! What every loss mechanism answers: the one trait that a new loss implements.

use super::Size;
use super::inputs::Inputs;
use super::registry::Term;
use crate::error::LawError;
use crate::math::Fma;
use crate::spec::Key;
use crate::validity::Validity;

/// Fractions ε_i of the normal kinetic energy, each ≥ 0; the sum may exceed 1 (capture). One column for each way to lose energy, not
/// for each mechanism.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Losses {
    /// Any adhesion work.
    pub adhesion: f64,
    /// Adhesion damping.
    pub adhesion_damping: f64,
    /// Hertzian damping.
    pub hertz_damping: f64,
    /// Any plastic loss.
    pub plastic: f64,
    /// A loss whose mechanism is not named: a given restitution.
    pub other: f64,
}

impl Losses {
    /// Σ ε_i, in a fixed order.
    #[inline(always)]
    pub fn total(&self) -> f64 {
        ((self.plastic + self.hertz_damping) + (self.adhesion + self.adhesion_damping)) + self.other
    }
}

/// Where in the contact a mechanism takes its share, and so the order in which shares are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// From the deformation of the bodies.
    Bulk,
    /// From what the deformation left, as the surfaces part.
    Surface,
}

/// The ledger of one impact while losses are taken from it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Account {
    /// Σ ε of the bulk losses.
    pub bulk: f64,
    /// 1 − Σ ε so far; set from `bulk` once the bulk losses are taken. e² in the end, a capture where it is not above zero.
    pub left: f64,
    /// The shares by column, for the energy of the outcome.
    pub losses: Losses,
}

impl Account {
    /// e.
    #[inline(always)]
    pub fn restitution(&self) -> f64 {
        if self.left > 0.0 { crate::math::sqrt(self.left) } else { 0.0 }
    }
}

/// A loss mechanism, compiled for one pair of materials: plain numbers.
///
/// A new mechanism is one file with a type that implements this, and one line in `registry.rs` beside it.
pub trait Mechanism: Copy {
    /// Its name in a law file.
    const NAME: &'static str;
    /// What it is an instance of: two losses of a kind would count the same energy twice and cannot share a law.
    const KIND: &'static str;
    /// One line for help and documentation.
    const ABOUT: &'static str;
    /// Where it takes its share.
    const STAGE: Stage;
    /// The keys of a law that it reads, those of the pair's constants among them. Stiffness and curvature, by which every loss's contact
    /// is judged, need not be listed.
    const KEYS: &'static [Key];
    /// Does it scale with the roughness factor C_R?
    const ROUGHNESS: bool = false;
    /// Does it take the bodies to stay elastic, or say nothing of it? A plastic loss does not, nor does a measured restitution.
    const ELASTIC: bool = true;
    /// Does it stand for adhesion on a contact that deforms (JKR and its kin)?
    const ADHESIVE_CONTACT: bool = false;

    /// From a law's materials and keys.
    ///
    /// # Errors
    /// What it needs and the law lacks.
    fn from_law(law: &Inputs) -> Result<Self, LawError>;

    /// Takes its share at normal approach speed `v` (m/s): a bulk loss adds to `bulk`, a surface loss takes from `left`; both note it in
    /// `losses`.
    fn take<F: Fma>(&self, f: F, v: f64, size: &Size, account: &mut Account);

    /// Does it take nothing at any speed?
    fn is_idle(&self) -> bool {
        false
    }

    /// Is damping fitted on elastic contacts in it?
    fn is_damping(&self) -> bool {
        false
    }

    /// V_y², m²/s²: below it a plastic loss takes nothing. Infinite for other losses.
    #[inline(always)]
    fn yield_squared(&self, _size: &Size) -> f64 {
        f64::INFINITY
    }

    /// The speed (m/s) at and below which it alone takes everything (or less than that, where it depends on what others leave); `None`
    /// for a loss that never captures at low speed.
    fn capture_velocity(&self, _size: &Size) -> Option<f64> {
        None
    }

    /// For adhesion: the greatest energy with which it holds a captured sphere, over half the sphere's mass, m²/s². `None` for other losses.
    fn hold_squared(&self, _size: &Size) -> Option<f64> {
        None
    }

    /// For a loss that ends the rebound at high speed: the speed (m/s, may be infinite) above which what is left can only fall, and the
    /// warning for a sphere captured there.
    fn exhaustion(&self, _size: &Size) -> Option<(f64, Validity)> {
        None
    }

    /// Itself and a loss already in the ledger as one term, where both share a factor.
    fn join(&self, _other: &Term) -> Option<Term> {
        None
    }
}
