//! The window of rebound: the speeds at which a ledger leaves anything, found from what its losses say of themselves.

use super::registry::Term;
use super::{Ledger, Size};
use crate::math::BEST;
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
        let captures = self.terms().filter_map(|t| t.capture_velocity(size)).reduce(f64::max);
        let start = captures.filter(|v| *v > 0.0).unwrap_or(SLOWEST);
        // where nothing else takes anything, the adhesion's own capture velocity is the law's
        let alone = !self.is_damped() && self.balance(BEST, start, size).bulk == 0.0;
        let ends = self.terms().filter_map(|t| t.exhaustion(size));
        let Some(summit) = ends.map(|(speed, _)| speed.min(FASTEST)).reduce(f64::min) else {
            return match captures {
                None => (left(FASTEST) > 0.0).then_some(Window::ALL),
                Some(capture_velocity) if alone => Some(Window { capture_velocity, ..Window::ALL }),
                Some(_) => rising_root(start, left).map(|capture_velocity| Window { capture_velocity, ..Window::ALL }),
            };
        };
        if start >= summit {
            return None;
        }
        let best = peak(start, summit, left);
        if left(best) <= 0.0 {
            return None;
        }
        let capture_velocity = match captures {
            Some(v) if alone => v,
            Some(v) if v > 0.0 || left(start) <= 0.0 => sign_change(start * (1.0 - 1e-9), best, left),
            _ => 0.0,
        };
        let exhausted_velocity = if left(END) > 0.0 { f64::INFINITY } else { sign_change(best, END, left) };
        Some(Window { capture_velocity, exhausted_velocity })
    }

    /// Why a sphere was captured at a speed above the window, as far as the losses tell.
    pub(crate) fn exhausted_by(&self, v: f64, size: &Size) -> Validity {
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
