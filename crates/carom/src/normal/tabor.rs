//! Plastic loss after Tabor, `plastic-tabor`: indentation with work hardening.
//!
//! Tabor (1948), Proc. R. Soc. A 192, 247–274, <https://doi.org/10.1098/rspa.1948.0008>; Kim & Dunn (2007), Eqs 41–43.
//! The rebound speed V is implicit:
//!
//! V = κ (v² − βV²)^β,  β = (2n − 1)/(2n + 4),  κ = V_y/(V_y² − βV_y²)^β
//!
//! In u = V/V_y and s = v/V_y the constant κ cancels: (1 − β) u^{1/β} + β u² = s², solved here by Newton's iteration from above
//! (the left side is convex, so it falls monotonically on the root).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | V_y | yield velocity, fitted: it belongs to this model alone | m/s |
//! | n | Meyer's index, 0.5 < n < 3 here (e would exceed 1 above yield for n > 3) | – |
//!
//! Below yield the loss is zero (the formula alone would give e > 1).
//!
//! ```
//! use carom::normal::tabor::Tabor;
//! let t = Tabor { yield_velocity: 0.09, meyer_index: 2.29 }; // Kim & Dunn's fit, alumina on aluminium
//! assert!((t.restitution(0.45) - 0.832).abs() < 5e-4);
//! assert!((t.restitution(6.3) - 0.582).abs() < 5e-4);
//! ```

use super::Size;
use super::inputs::Inputs;
use super::mechanism::{Account, Mechanism, Stage};
use super::plastic::PLASTIC_LOSS;
use crate::error::LawError;
use crate::math::{self, BEST, Fma};
use crate::spec::Key;

/// Tabor's plastic loss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tabor {
    /// V_y, m/s.
    pub yield_velocity: f64,
    /// Meyer's index n.
    pub meyer_index: f64,
}

impl Tabor {
    /// β = (2n − 1)/(2n + 4).
    #[inline(always)]
    pub fn beta(&self) -> f64 {
        (2.0 * self.meyer_index - 1.0) / (2.0 * self.meyer_index + 4.0)
    }

    /// e at approach speed `v` (m/s).
    pub fn restitution(&self, v: f64) -> f64 {
        self.restitution_on(BEST, v)
    }

    #[inline(always)]
    fn restitution_on<F: Fma>(&self, f: F, v: f64) -> f64 {
        let s = v / self.yield_velocity;
        if s.is_nan() || s <= 1.0 {
            return 1.0;
        }
        // beyond this the powers would leave the range of a double
        let s = s.min(1e60);
        let beta = self.beta();
        let inverse = 1.0 / beta;
        let s2 = s * s;
        // both terms alone bound the root from above
        let mut u = s.min(math::pow_on(f, s2 / (1.0 - beta), beta));
        for _ in 0..60 {
            let power = (1.0 - beta) * math::pow_on(f, u, inverse);
            let h = f.fma(beta, u * u, power - s2);
            let slope = f.fma(inverse, power / u, 2.0 * beta * u);
            let next = u - h / slope;
            let moved = (next - u).abs();
            u = next;
            if moved <= 2.0 * f64::EPSILON * u {
                break;
            }
        }
        (u / s).min(1.0)
    }

    /// Fraction of the normal kinetic energy lost at approach speed `v` (m/s).
    pub fn fraction(&self, v: f64) -> f64 {
        self.fraction_on(BEST, v)
    }

    #[inline(always)]
    fn fraction_on<F: Fma>(&self, f: F, v: f64) -> f64 {
        let e = self.restitution_on(f, v);
        1.0 - e * e
    }
}

impl Mechanism for Tabor {
    const NAME: &'static str = "plastic-tabor";
    const KIND: &'static str = PLASTIC_LOSS;
    const ABOUT: &'static str = "indentation with work hardening, fitted (Tabor 1948; Kim & Dunn 2007, Eqs 41-43)";
    const STAGE: Stage = Stage::Bulk;
    const ELASTIC: bool = false;
    const KEYS: &'static [Key] = &[Key::YieldVelocity, Key::MeyerIndex];

    fn from_law(law: &Inputs) -> Result<Self, LawError> {
        let yield_velocity = law.needed(Key::YieldVelocity)?;
        let meyer_index = law.needed(Key::MeyerIndex)?;
        Ok(Self { yield_velocity, meyer_index })
    }

    #[inline(always)]
    fn take<F: Fma>(&self, f: F, v: f64, _: &Size, account: &mut Account) {
        let fraction = self.fraction_on(f, v);
        account.losses.plastic += fraction;
        account.bulk += fraction;
    }

    #[inline(always)]
    fn yield_squared(&self, _: &Size) -> f64 {
        self.yield_velocity * self.yield_velocity
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_the_printed_equation() {
        for n in [0.8, 1.57, 2.0, 2.29, 2.5, 2.9] {
            let t = Tabor { yield_velocity: 0.09, meyer_index: n };
            let (b, vy) = (t.beta(), 0.09f64);
            let kappa = vy / (vy * vy - b * vy * vy).powf(b);
            for v in [0.0901, 0.1, 0.45, 6.3, 100.0, 1e4] {
                let rebound = t.restitution(v) * v;
                let right = kappa * (v * v - b * rebound * rebound).powf(b);
                assert!((rebound / right - 1.0).abs() < 1e-12, "n {n} v {v}: {rebound} {right}");
            }
        }
    }

    #[test]
    fn one_at_and_below_yield() {
        let t = Tabor { yield_velocity: 0.09, meyer_index: 2.29 };
        assert_eq!((t.restitution(0.09), t.restitution(0.001)), (1.0, 1.0));
        assert!((t.restitution(0.09 * (1.0 + 1e-9)) - 1.0).abs() < 1e-8);
    }
}
