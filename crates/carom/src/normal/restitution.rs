//! A given restitution as a loss, `given-restitution`: what deformation takes, as one measured or assumed number.
//!
//! ε = 1 − e², at every speed. In Dahneke's model (law `dahneke`) e is what the bodies' deformation leaves, and adhesion is a well
//! beside it ([`super::well`]); for a wall whose whole restitution is known, the table law `constant` says the same with fewer words.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | e | restitution without adhesion, 0 to 1 | – |
//!
//! Range: far below yield and above capture, where measured restitution is flat. Source: Dahneke (1971), J. Colloid Interface Sci. 37,
//! 342–353, <https://doi.org/10.1016/0021-9797(71)90302-X> (not re-read here: the form is derived from the balance of energy).
//!
//! ```
//! use carom::normal::{Ledger, Size, Term, restitution::GivenRestitution};
//! let ledger = Ledger::new([Term::GivenRestitution(GivenRestitution::new(0.9))]).expect("one loss");
//! assert!((ledger.restitution(3.0, &Size::flat(1e-6)) - 0.9).abs() < 1e-15);
//! ```

use super::Size;
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use crate::error::LawError;
use crate::math::Fma;
use crate::spec::Key;

/// A given restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GivenRestitution {
    /// 1 − e².
    lost: f64,
}

impl GivenRestitution {
    /// From e, 0 to 1.
    pub fn new(restitution: f64) -> Self {
        debug_assert!((0.0..=1.0).contains(&restitution));
        Self { lost: 1.0 - restitution * restitution }
    }
}

impl Mechanism for GivenRestitution {
    const NAME: &'static str = "given-restitution";
    const KIND: &'static str = "given restitution";
    const ABOUT: &'static str = "one number for what deformation takes, 1 - e^2 (Dahneke 1971)";
    const STAGE: Stage = Stage::Bulk;
    const ELASTIC: bool = false;
    const KEYS: &'static [Key] = &[Key::Restitution];

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        law.needed(Key::Restitution).map(Self::new)
    }

    #[inline(always)]
    fn take<F: Fma>(&self, _: F, _: f64, _: &Size, account: &mut Account) {
        account.losses.other += self.lost;
        account.bulk += self.lost;
    }

    fn is_idle(&self) -> bool {
        self.lost == 0.0
    }
}
