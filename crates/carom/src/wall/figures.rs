//! Figures of a wall law: the window of rebound (capture velocity), yield velocity, critical angle, adhesion numbers.

use super::{NormalLaw, WallLaw};
use crate::impact::ImpactError;
use crate::math;
use crate::normal::ledger::{Adhesion, Ledger, Plastic};
use crate::normal::{Size, damping};
use crate::roughness::{AdhesionNumbers, adhesion_numbers};
use crate::tangential::{Tangential, walton};
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

/// Speeds searched, m/s.
const FASTEST: f64 = 1e6;
const SLOWEST: f64 = 1e-12;

/// The sign change of `f` on [low, high] by bisection of the logarithm, to the last bit; `f(low) ≤ 0 < f(high)` or the reverse.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let positive_at_high = f(high) > 0.0;
    for _ in 0..200 {
        let middle = low.sqrt() * high.sqrt();
        if middle <= low || middle >= high {
            break;
        }
        if (f(middle) > 0.0) == positive_at_high { high = middle } else { low = middle }
    }
    if positive_at_high { low } else { high }
}

/// The greatest value of a function with one maximum on [low, high], by golden section of the logarithm.
fn peak(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut a, mut b) = (math::ln(low), math::ln(high));
    for _ in 0..120 {
        let (c, d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
        if f(math::exp(c)) > f(math::exp(d)) { b = d } else { a = c }
    }
    math::exp(0.5 * (a + b))
}

impl Ledger {
    /// The window of rebound for a size; `None` if there is no speed of rebound at all.
    ///
    /// Without damping e² rises through zero once (v^{4/5} e_pl² is monotone for every plastic loss but Bons'), so the only root is the
    /// capture velocity; adhesion work alone has it in closed form. With damping e² has one maximum, hence two roots or none. With Bons'
    /// loss v^{4/5} e² falls above yield, damped or not: its maximum lies at yield or below, and adhesion work brings a second root.
    ///
    /// ```
    /// use carom::normal::{Ledger, Size, adhesion::Work, damping::Damping, ledger::Adhesion};
    /// let ledger = Ledger {
    ///     adhesion: Adhesion::Work,
    ///     work: Work::new(127.8e9, 3.03, 0.15, 8000.0),
    ///     damping: Damping { adhesion: 1.3, hertz: 0.007 },
    ///     ..Ledger::lossless()
    /// };
    /// let window = ledger.window(&Size::flat(35e-6)).expect("it rebounds somewhere");
    /// assert!((window.capture_velocity - 0.0269).abs() < 1e-4 && (window.exhausted_velocity - 128.3).abs() < 0.1);
    /// ```
    pub fn window(&self, size: &Size) -> Option<Window> {
        let left = |v: f64| self.balance(v, size).left;
        let adhesive = match &self.adhesion {
            Adhesion::None => 0.0,
            Adhesion::Work => self.work.capture_velocity(size),
            Adhesion::Jkr(jkr) => jkr.sticking_velocity_squared(size).sqrt(),
        };
        if self.damping.is_none() {
            if adhesive == 0.0 || matches!(self.plastic, Plastic::None) {
                return Some(Window { capture_velocity: adhesive, exhausted_velocity: f64::INFINITY });
            }
            if let Plastic::Bons(bons) = &self.plastic {
                let v_y = bons.yield_squared(size).sqrt();
                let exhausted_velocity = match &self.adhesion {
                    // V_y²/v² = (v_c/v)^{4/5}
                    Adhesion::Work => v_y * math::pow(v_y / adhesive, 2.0 / 3.0),
                    _ => f64::INFINITY,
                };
                return (adhesive < v_y).then_some(Window { capture_velocity: adhesive, exhausted_velocity });
            }
            // e ≤ adhesion's own, so the root is not below adhesion's alone
            let (mut low, mut high) = (adhesive * (1.0 - 1e-9), adhesive * 2.0);
            while left(high) <= 0.0 {
                (low, high) = (high, high * 2.0);
                if high > FASTEST {
                    return None;
                }
            }
            return Some(Window { capture_velocity: root(low, high, left), exhausted_velocity: f64::INFINITY });
        }
        let start = if adhesive > 0.0 { adhesive } else { SLOWEST };
        let hertz = damping::HERTZ * self.damping.hertz;
        let end = if hertz > 0.0 { (1.0 / hertz).min(FASTEST) } else { FASTEST };
        let summit = match &self.plastic {
            Plastic::Bons(bons) => end.min(bons.yield_squared(size).sqrt()),
            _ => end,
        };
        if start >= summit {
            return None;
        }
        let best = peak(start, summit, left);
        if left(best) <= 0.0 {
            return None;
        }
        let capture_velocity = if left(start) > 0.0 { 0.0 } else { root(start * (1.0 - 1e-9), best, left) };
        let above = end * (1.0 + 1e-9);
        let exhausted_velocity = if left(above) > 0.0 { f64::INFINITY } else { root(best, above, left) };
        Some(Window { capture_velocity, exhausted_velocity })
    }
}

impl WallLaw {
    /// The share of the normal kinetic energy that a head-on impact at `speed` (m/s) leaves, 1 − Σ ε(v): e² where the sphere
    /// rebounds, and below zero where the losses of a ledger ask for more than there is. So it tells how far a capture is from a rebound.
    ///
    /// # Errors
    /// A diameter out of range.
    pub fn energy_left(&self, speed: f64, diameter: f64) -> Result<f64, ImpactError> {
        let size = self.size(diameter, None)?;
        Ok(1.0 - self.normal.respond(speed, 0.0, &size).lost())
    }

    /// The window of rebound for a sphere of diameter `diameter` (m): `Ok(None)` when it never rebounds. Table laws have none and
    /// answer with the whole range of speeds.
    ///
    /// # Errors
    /// A diameter or density out of range.
    pub fn window(&self, diameter: f64, density: Option<f64>) -> Result<Option<Window>, ImpactError> {
        let size = self.size(diameter, density)?;
        Ok(match &self.normal {
            NormalLaw::Ledger(ledger) => ledger.window(&size),
            NormalLaw::Table(_) => Some(Window { capture_velocity: 0.0, exhausted_velocity: f64::INFINITY }),
            NormalLaw::Resolved(resolved) => resolved.window(&size),
        })
    }

    /// Yield velocity of the law's own plastic loss, m/s; `None` for a law without one.
    ///
    /// # Errors
    /// A diameter or density out of range.
    pub fn yield_velocity(&self, diameter: f64, density: Option<f64>) -> Result<Option<f64>, ImpactError> {
        let size = self.size(diameter, density)?;
        Ok(match &self.normal {
            NormalLaw::Ledger(ledger) => ledger.yield_velocity(&size),
            _ => None,
        })
    }

    /// The capture velocity that user-defined functions of flow solvers compute for this pair, m/s, for comparison: it knows nothing of
    /// the pair's adhesion, see [`crate::normal::el_batsh`]. `None` without a stiffness and a density.
    pub fn el_batsh_capture_velocity(&self, diameter: f64) -> Option<f64> {
        let pair = self.pair.as_ref()?;
        Some(crate::normal::el_batsh::capture_velocity(diameter, pair.stiffness().ok()?, pair.density().ok()?))
    }

    /// Critical angle from the surface (rad) at a given speed (m/s), for a sphere without spin: below it the sphere slides to the end.
    /// The restitution is the law's own at that angle's normal speed. `None` for tangential laws without friction.
    ///
    /// # Errors
    /// A diameter or density out of range.
    pub fn critical_angle(&self, diameter: f64, density: Option<f64>, speed: f64) -> Result<Option<f64>, ImpactError> {
        let size = self.size(diameter, density)?;
        let Some(friction) = self.tangential.friction() else { return Ok(None) };
        if friction <= 0.0 {
            return Ok(Some(std::f64::consts::FRAC_PI_2));
        }
        // sliding to the end ⇔ f(1 + e)v_n < (2/7)(1 + β₀)v_t
        let excess = |angle: f64| {
            let (s, c) = math::sin_cos(angle);
            let response = self.normal.respond(speed * s, (speed * c) * (speed * c), &size);
            let cap = friction * response.friction_share * (1.0 + response.e) * s;
            match &self.tangential {
                Tangential::Friction { beta, .. } => cap - walton::stick_impulse(*beta, c),
                Tangential::MicroSlip(law) => law.sliding_slip(cap, response.e) - c,
                Tangential::Restitution(_) => 0.0,
            }
        };
        Ok(Some(root(1e-9, std::f64::consts::FRAC_PI_2, excess)))
    }

    /// Tabor's parameter, its verdict and the adhesion parameter; `None` without materials that have a work of adhesion.
    ///
    /// # Errors
    /// A diameter out of range.
    pub fn adhesion_numbers(&self, diameter: f64) -> Result<Option<AdhesionNumbers>, ImpactError> {
        let size = self.size(diameter, None)?;
        let Some(pair) = &self.pair else { return Ok(None) };
        let (Ok(w), Ok(e_star)) = (pair.work_of_adhesion(), pair.effective_modulus()) else { return Ok(None) };
        Ok((w > 0.0).then(|| adhesion_numbers(size.radius * size.kappa, w, e_star, self.spacing, self.roughness)))
    }

    /// C_R in force.
    pub fn roughness_factor(&self) -> f64 {
        self.roughness_factor
    }

    /// A ledger left nothing: below the window (capture, no doubt), above it, or without one.
    #[cold]
    pub(super) fn why_captured(&self, v: f64, size: &Size) -> Validity {
        let NormalLaw::Ledger(ledger) = &self.normal else { return Validity::NONE };
        // rebounds at a higher speed, so below the window: the common case, told without searching for the window's ends
        let faster = |doublings: i32| v * f64::from(1 << doublings);
        if (1..=12).any(|n| ledger.balance(faster(n), size).left > 0.0) {
            return Validity::NONE;
        }
        let bons = ledger.plastic_can_exhaust();
        match ledger.window(size) {
            None => Validity::NO_REBOUND_WINDOW,
            Some(window) if v <= window.capture_velocity => Validity::NONE,
            Some(_) if bons && v * v > ledger.yield_squared(size) => Validity::PLASTIC_EXHAUSTED,
            Some(_) => Validity::DAMPING_EXHAUSTED,
        }
    }
}
