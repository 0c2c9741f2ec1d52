//! The window of rebound: the speeds at which a ledger leaves anything, found from what its losses say of themselves.

use super::registry::Term;
use super::{Ledger, Size};
use crate::math::root::{peak, sign_change};
use crate::validity::Validity;

/// Speeds at which a sphere rebounds, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Capture velocity: at and below it the sphere is captured. 0 if nothing captures.
    pub capture_velocity: f64,
    /// Above this, damping alone takes everything and the model's domain ends, or Bons' plastic loss leaves less than adhesion takes;
    /// infinite otherwise.
    pub exhausted_velocity: f64,
}

impl Window {
    /// Nothing captures.
    pub const ALL: Self = Self { capture_velocity: 0.0, exhausted_velocity: f64::INFINITY };
}

/// Speeds searched for a rebound, m/s, and for its end.
const FASTEST: f64 = 1e6;
const SLOWEST: f64 = 1e-12;
const END: f64 = 1e9;

impl Ledger {
    /// The window of rebound for a size; `None` if there is no speed of rebound at all.
    ///
    /// Without a loss that grows at high speed e² rises through zero once, at or above the speed at which the adhesion alone captures.
    /// With one (damping; Bons' loss above yield) e² has one maximum, hence two roots or none.
    ///
    /// ```
    /// use carom::normal::{Ledger, Size, Term, adhesion::{AdhesionDamping, Work}, damping::HertzDamping};
    /// let work = Work::new(127.8e9, 3.03, 0.15, 8000.0);
    /// let terms = [
    ///     Term::AdhesionWork(work),
    ///     Term::AdhesionDamping(AdhesionDamping::new(work, 1.3)),
    ///     Term::HertzDamping(HertzDamping { coefficient: 0.007 }),
    /// ];
    /// let window = Ledger::new(terms).expect("of three kinds").window(&Size::flat(35e-6)).expect("it rebounds somewhere");
    /// assert!((window.capture_velocity - 0.0269).abs() < 1e-4 && (window.exhausted_velocity - 128.3).abs() < 0.1);
    /// ```
    pub fn window(&self, size: &Size) -> Option<Window> {
        let left = |v: f64| self.left(v, size);
        let captures = self.captures_at(size);
        let start = slowest(captures);
        // where nothing else takes anything, the adhesion's own capture velocity is the law's
        let alone = !self.is_damped() && self.account(start, size).bulk == 0.0;
        let Some(summit) = self.ends_at(size) else {
            return match captures {
                None => (left(FASTEST) > 0.0).then_some(Window::ALL),
                Some(capture_velocity) if alone => Some(Window { capture_velocity, ..Window::ALL }),
                Some(_) => rising_root(start, left).map(|capture_velocity| Window { capture_velocity, ..Window::ALL }),
            };
        };
        let best = self.best_speed(start, summit, size)?;
        let capture_velocity = match captures {
            Some(v) if alone => v,
            Some(v) if v > 0.0 || left(start) <= 0.0 => sign_change(start * (1.0 - 1e-9), best, left),
            _ => 0.0,
        };
        let exhausted_velocity = if left(END) > 0.0 { f64::INFINITY } else { sign_change(best, END, left) };
        Some(Window { capture_velocity, exhausted_velocity })
    }

    /// Capture velocity of the adhesion alone, m/s.
    fn captures_at(&self, size: &Size) -> Option<f64> {
        self.terms().filter_map(|t| t.capture_velocity(size)).reduce(f64::max)
    }

    /// The speed from which on ever more is lost until nothing is left, m/s, if there is one.
    fn ends_at(&self, size: &Size) -> Option<f64> {
        self.terms().filter_map(|t| t.exhaustion(size)).map(|(speed, _)| speed.min(FASTEST)).reduce(f64::min)
    }

    /// The speed at which most is left, m/s, if anything is.
    fn best_speed(&self, start: f64, summit: f64, size: &Size) -> Option<f64> {
        let left = |v: f64| self.left(v, size);
        (start < summit).then(|| peak(start, summit, left)).filter(|best| left(*best) > 0.0)
    }

    /// The warnings about a sphere captured at `v`: below the window (none), above it, or by a ledger without one.
    #[cold]
    pub(crate) fn why_captured(&self, v: f64, size: &Size) -> Validity {
        let Some(summit) = self.ends_at(size) else { return Validity::NONE };
        // rebounds at a higher speed, so below the window: the common case, told without searching for the window
        let faster = |doublings: i32| v * f64::from(1 << doublings);
        if (1..=12).any(|n| self.left(faster(n), size) > 0.0) {
            return Validity::NONE;
        }
        match self.best_speed(slowest(self.captures_at(size)), summit, size) {
            None => Validity::NO_REBOUND_WINDOW,
            Some(best) if v < best => Validity::NONE,
            Some(_) => self.exhausted_by(v, size),
        }
    }

    /// Why a sphere was captured at a speed above the window, as far as the losses tell.
    fn exhausted_by(&self, v: f64, size: &Size) -> Validity {
        let above_yield = v * v > self.yield_squared(size);
        let named = |term: &Term| term.exhaustion(size).map(|(_, warning)| warning);
        let plastic = self.terms().filter_map(named).find(|w| *w == Validity::PLASTIC_EXHAUSTED);
        plastic.filter(|_| above_yield).unwrap_or(Validity::DAMPING_EXHAUSTED)
    }
}

/// The root of a function that rises through zero once, at `start` or above; `None` where it stays below zero.
fn rising_root(start: f64, left: impl Fn(f64) -> f64) -> Option<f64> {
    let (mut low, mut high) = (start * (1.0 - 1e-9), start * 2.0);
    while left(high) <= 0.0 {
        (low, high) = (high, high * 2.0);
        if high > FASTEST {
            return None;
        }
    }
    Some(sign_change(low, high, left))
}

/// The lowest speed at which anything can be left beside an adhesion that captures up to some speed, m/s.
fn slowest(captures: Option<f64>) -> f64 {
    captures.filter(|v| *v > 0.0).unwrap_or(SLOWEST)
}
