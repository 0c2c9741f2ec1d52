//! The energy ledger: a list of losses, and the restitution they leave.
//!
//! e² = 1 − Σ ε_i(v), Kim & Dunn (2007), Eqs 24 and 37, J. Aerosol Sci. 38, 532–549,
//! <https://doi.org/10.1016/j.jaerosci.2007.03.006>. e² ≤ 0 is capture. At most one loss of a kind may stand in a ledger: two would
//! count the same energy twice. Bulk losses come first, since some surface losses depend on what those left.
//!
//! The additive sum is an approximation where losses act on the same contact: adhesion work above yield keeps the elastic
//! contact radius, and damping fitted on elastic contacts beside a plastic loss may count energy twice (`losses-overlap`).

use super::Size;
use super::adhesion::Work;
use super::damping::HertzDamping;
use super::mechanism::{Account, Losses, Stage};
use super::plastic::Kadomtsev;
use super::registry::{Loss, Term};
use crate::instructions::{self, run_scalar};
use crate::math::Fma;

/// Most losses of one law: one of each kind.
pub const MOST_LOSSES: usize = 5;

/// Compiled losses: plain numbers, the bulk losses first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger {
    terms: [Option<Term>; MOST_LOSSES],
    bulk: u8,
    count: u8,
    yields: bool,
}

/// The losses of the paper's two laws.
pub(crate) enum ShortList<'a> {
    /// EA: adhesion work, its damping joined to it, and Hertzian damping.
    Elastic(HertzDamping, &'a Work),
    /// EAP without damping in the bodies.
    ElasticPlastic(&'a Kadomtsev, &'a Work),
}

/// Two losses that cannot share a ledger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TwoOfAKind(pub Loss, pub Loss);

impl Ledger {
    /// From compiled losses, in any order.
    ///
    /// # Errors
    /// Two losses of a kind.
    pub fn new(terms: impl IntoIterator<Item = Term>) -> Result<Self, TwoOfAKind> {
        let mut ledger = Self { terms: [None; MOST_LOSSES], bulk: 0, count: 0, yields: false };
        for term in terms {
            ledger.add(term)?;
        }
        ledger.join_terms();
        Ok(ledger)
    }

    fn add(&mut self, term: Term) -> Result<(), TwoOfAKind> {
        if let Some(other) = self.terms().find(|t| t.loss().kind() == term.loss().kind()) {
            return Err(TwoOfAKind(other.loss(), term.loss()));
        }
        debug_assert!(usize::from(self.count) < MOST_LOSSES, "as many places as there are kinds");
        if term.is_idle() {
            return Ok(());
        }
        let order = |t: &Term| (t.stage(), t.loss() as u8);
        let place = self.terms().take_while(|t| order(t) < order(&term)).count();
        self.terms[place..=usize::from(self.count)].rotate_right(1);
        self.terms[place] = Some(term);
        self.count += 1;
        self.yields |= term.yield_squared(&Size::flat(1e-5)).is_finite();
        self.bulk += u8::from(term.stage() == Stage::Bulk);
        Ok(())
    }

    /// Losses that share a factor become one term, so that the factor is computed once.
    fn join_terms(&mut self) {
        for i in 0..MOST_LOSSES {
            for j in i + 1..MOST_LOSSES {
                let (Some(first), Some(second)) = (self.terms[i], self.terms[j]) else { continue };
                if let Some(both) = second.join(&first) {
                    self.terms[i] = Some(both);
                    self.terms[j..].rotate_left(1);
                    self.terms[MOST_LOSSES - 1] = None;
                    self.count -= 1;
                }
            }
        }
    }

    /// The losses, bulk losses first. Losses that share a factor stand as one.
    #[inline(always)]
    pub fn terms(&self) -> impl Iterator<Item = &Term> {
        self.terms.iter().map_while(Option::as_ref)
    }

    /// The terms that take from the deformation, and those that take from what it leaves.
    #[inline(always)]
    pub(crate) fn stages(&self) -> (&[Option<Term>], &[Option<Term>]) {
        let terms = &self.terms[..usize::from(self.count).min(MOST_LOSSES)];
        terms.split_at(usize::from(self.bulk).min(terms.len()))
    }

    /// What the losses take at normal approach speed `v` (m/s), and what they leave.
    #[inline(always)]
    pub(crate) fn balance<F: Fma>(&self, f: F, v: f64, size: &Size) -> Account {
        let mut account = Account::default();
        let (bulk, surface) = self.stages();
        for term in bulk.iter().flatten() {
            term.take(f, v, size, &mut account);
        }
        account.left = 1.0 - account.bulk;
        for term in surface.iter().flatten() {
            term.take(f, v, size, &mut account);
        }
        account
    }

    /// The same for who has no multiply-add at hand. Whole windows are searched with it: with the C library's multiply-add, five times
    /// slower, a capture above the window took 40 µs.
    pub(crate) fn account(&self, v: f64, size: &Size) -> Account {
        run_scalar(Balance { ledger: self, v, size })
    }

    /// The paper's two laws, whose impacts have paths of their own (`kernel/short.rs`).
    #[inline(always)]
    pub(crate) fn short(&self) -> Option<ShortList<'_>> {
        match self.stages() {
            ([], [Some(Term::AdhesionWork(work))]) => Some(ShortList::Elastic(HertzDamping::NONE, work)),
            ([Some(Term::HertzDamping(damping))], [Some(Term::AdhesionWork(work))]) => {
                Some(ShortList::Elastic(*damping, work))
            }
            ([Some(Term::PlasticKadomtsev(plastic))], [Some(Term::AdhesionWork(work))]) => {
                Some(ShortList::ElasticPlastic(plastic, work))
            }
            _ => None,
        }
    }

    /// What is left of the normal kinetic energy at approach speed `v` (m/s): e² where it is above zero.
    pub fn left(&self, v: f64, size: &Size) -> f64 {
        self.account(v, size).left
    }

    /// The fractions lost at normal approach speed `v` (m/s).
    pub fn losses(&self, v: f64, size: &Size) -> Losses {
        self.account(v, size).losses
    }

    /// Restitution at normal approach speed `v` (m/s).
    ///
    /// ```
    /// use carom::normal::{Ledger, Size, Term, adhesion::Work};
    /// let ledger = Ledger::new([Term::AdhesionWork(Work::new(127.8e9, 3.03, 0.15, 8000.0))]).expect("one loss");
    /// assert!((ledger.restitution(1.0, &Size::flat(35e-6)) - 0.9728).abs() < 1e-4);
    /// ```
    pub fn restitution(&self, v: f64, size: &Size) -> f64 {
        self.account(v, size).restitution()
    }

    /// Yield velocity of the ledger's own plastic loss, m/s; `None` without one.
    pub fn yield_velocity(&self, size: &Size) -> Option<f64> {
        let square = self.yield_squared(size);
        square.is_finite().then(|| crate::math::sqrt(square))
    }

    /// (V_y)², infinite without a plastic loss; cheap enough for every impact.
    #[inline(always)]
    pub(crate) fn yield_squared(&self, size: &Size) -> f64 {
        if !self.yields {
            return f64::INFINITY;
        }
        let (bulk, _) = self.stages();
        bulk.iter().flatten().fold(f64::INFINITY, |least, term| least.min(term.yield_squared(size)))
    }

    /// Does damping fitted on elastic contacts stand in it?
    #[inline(always)]
    pub(crate) fn is_damped(&self) -> bool {
        self.terms().any(Term::is_damping)
    }

    /// Can the rebound end at high speed?
    pub fn can_exhaust(&self) -> bool {
        self.terms().any(|t| t.exhaustion(&Size::flat(1e-5)).is_some())
    }
}

struct Balance<'a> {
    ledger: &'a Ledger,
    v: f64,
    size: &'a Size,
}

impl instructions::Work for Balance<'_> {
    type Output = Account;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, f: F) -> Account {
        self.ledger.balance(f, self.v, self.size)
    }
}
