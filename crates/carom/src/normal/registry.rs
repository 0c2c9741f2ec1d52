//! The registry of losses: one line a loss, in the order in which the surface losses take their shares.
//!
//! From a line come the name and its help, the kind, the compiled term, its place in scalar impacts and batches, its energy column,
//! and what it says of yield, capture and exhaustion.

use super::Size;
use super::adhesion::{AdhesionDamping, Jkr, Work};
use super::bons::Bons;
use super::damping::HertzDamping;
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use super::plastic::Kadomtsev;
use super::restitution::GivenRestitution;
use super::tabor::Tabor;
use super::thornton_ning::ThorntonNing;
use super::well::AdhesionWell;
use crate::error::LawError;
use crate::math::Fma;
use crate::spec::Key;
use crate::validity::Validity;

macro_rules! losses {
    ($($loss:ident: $mechanism:ident,)*) => {
        /// One loss mechanism, by its name in a law file.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Loss {
            $(#[doc = concat!("See [`", stringify!($mechanism), "`].")] $loss,)*
        }

        impl Loss {
            /// Every loss, in the order of the documentation.
            pub const ALL: &'static [Self] = &[$(Self::$loss,)*];

            /// Its name in a law file.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$loss => $mechanism::NAME,)* }
            }

            /// What it is an instance of: two losses of a kind cannot share a law.
            pub const fn kind(self) -> &'static str {
                match self { $(Self::$loss => $mechanism::KIND,)* }
            }

            /// One line for help and documentation.
            pub const fn about(self) -> &'static str {
                match self { $(Self::$loss => $mechanism::ABOUT,)* }
            }

            /// The keys of a law that it reads of its own; [`Loss::keys`] has all.
            pub(crate) const fn own_keys(self) -> &'static [Key] {
                match self { $(Self::$loss => $mechanism::KEYS,)* }
            }

            /// Does it scale with the roughness factor C_R?
            pub const fn uses_roughness(self) -> bool {
                match self { $(Self::$loss => $mechanism::ROUGHNESS,)* }
            }

            /// The mechanism for one law.
            ///
            /// # Errors
            /// What it needs and the law lacks.
            pub(crate) fn compile(self, law: &Inputs) -> Result<Term, LawError> {
                Ok(match self { $(Self::$loss => Term::$loss($mechanism::from_law(law)?),)* })
            }
        }

        /// A loss compiled for one law.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Term {
            $(#[doc = concat!("See [`", stringify!($mechanism), "`].")] $loss($mechanism),)*
        }

        impl Term {
            /// Which loss it is.
            pub const fn loss(&self) -> Loss {
                match self { $(Self::$loss(_) => Loss::$loss,)* }
            }

            pub(crate) const fn stage(&self) -> Stage {
                match self { $(Self::$loss(_) => $mechanism::STAGE,)* }
            }

            #[inline(always)]
            pub(crate) fn is_damping(&self) -> bool {
                match self { $(Self::$loss(m) => m.is_damping(),)* }
            }

            #[inline(always)]
            pub(crate) fn take<F: Fma>(&self, f: F, v: f64, size: &Size, account: &mut Account) {
                match self { $(Self::$loss(m) => m.take(f, v, size, account),)* }
            }

            #[inline(always)]
            pub(crate) fn yield_squared(&self, size: &Size) -> f64 {
                match self { $(Self::$loss(m) => Mechanism::yield_squared(m, size),)* }
            }

            pub(crate) fn is_elastic(&self) -> bool {
                match self { $(Self::$loss(_) => $mechanism::ELASTIC,)* }
            }

            pub(crate) fn is_adhesive_contact(&self) -> bool {
                match self { $(Self::$loss(_) => $mechanism::ADHESIVE_CONTACT,)* }
            }

            pub(crate) fn hold_squared(&self, size: &Size) -> Option<f64> {
                match self { $(Self::$loss(m) => m.hold_squared(size),)* }
            }

            pub(crate) fn is_idle(&self) -> bool {
                match self { $(Self::$loss(m) => m.is_idle(),)* }
            }

            pub(crate) fn capture_velocity(&self, size: &Size) -> Option<f64> {
                match self { $(Self::$loss(m) => Mechanism::capture_velocity(m, size),)* }
            }

            pub(crate) fn exhaustion(&self, size: &Size) -> Option<(f64, Validity)> {
                match self { $(Self::$loss(m) => m.exhaustion(size),)* }
            }

            pub(crate) fn join(&self, other: &Self) -> Option<Self> {
                match self { $(Self::$loss(m) => m.join(other),)* }
            }

            /// Runs `loops` for this term's own type, so that its loop holds no branch on the kind of loss.
            #[inline(always)]
            pub(crate) fn with<L: Loops>(&self, loops: &mut L) {
                match self { $(Self::$loss(m) => loops.of(m),)* }
            }
        }
    };
}

/// What is done with a loss whose type is known.
pub(crate) trait Loops {
    fn of<M: Mechanism>(&mut self, mechanism: &M);
}

losses! {
    AdhesionWork: Work,
    AdhesionJkr: Jkr,
    AdhesionWell: AdhesionWell,
    AdhesionDamping: AdhesionDamping,
    HertzDamping: HertzDamping,
    PlasticKadomtsev: Kadomtsev,
    PlasticThorntonNing: ThorntonNing,
    PlasticTabor: Tabor,
    PlasticBons: Bons,
    GivenRestitution: GivenRestitution,
}
