//! The dimensionless contact, followed in σ (x = s², dt = 2s dσ): s and U = dx/dt, and the integrals that ride along.

use super::coefficients::{A, B, E3, E5, STAGES};
use crate::math::{self, Fma};

/// Relative tolerance of a step.
const TOLERANCE: f64 = 2e-9;
/// No contact needs nearly as many steps; more means numbers far outside any impact.
const MOST_STEPS: usize = 4000;

/// Dimensionless parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Equation {
    pub adhesion: f64,
    pub adhesion_damping: f64,
    pub hertz_damping: f64,
    pub reversible: bool,
}

/// What the contact came to, in units of m, v and L: ½ is the incident energy.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    /// Greatest s.
    pub deepest: f64,
    /// Turned back before leaving.
    pub captured: bool,
    /// At the end.
    pub end: State,
}

/// A moment of the contact.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct State {
    pub s: f64,
    pub u: f64,
    pub rides: Rides,
}

/// Integrals along the motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rides {
    pub time: f64,
    /// ∫ X^{3/2} dτ.
    pub impulse: f64,
    /// Work of Hertzian damping.
    pub hertz_work: f64,
    /// Work of adhesion damping.
    pub adhesion_work: f64,
}

/// What a step runs in: σ itself, or U or s, which then lands exactly on a wanted value (Hénon's change of variable).
#[derive(Clone, Copy, PartialEq)]
enum Along {
    Sigma,
    Speed,
    Depth,
}

struct Step {
    to: State,
    /// Error over tolerance.
    error: f64,
}

impl Equation {
    /// dU/dσ = 2s²(−s²(1 + C_H U) + A(1 − C_A U)).
    #[inline(always)]
    fn force<F: Fma>(&self, f: F, s: f64, u: f64, a: f64) -> f64 {
        let x = s * s;
        let hertz = x * f.fma(self.hertz_damping, u, 1.0);
        let adhesive = a * f.fma(-self.adhesion_damping, u, 1.0);
        2.0 * x * (adhesive - hertz)
    }

    /// Rates of (s, U) and of σ itself per unit of the running variable.
    #[inline(always)]
    fn rates<F: Fma>(&self, f: F, s: f64, u: f64, a: f64, along: Along) -> (f64, f64, f64) {
        let force = self.force(f, s, u, a);
        match along {
            Along::Sigma => (u, force, 1.0),
            Along::Speed => (u / force, 1.0, 1.0 / force),
            Along::Depth => (1.0, force / u, 1.0 / u),
        }
    }

    #[inline(always)]
    fn step<F: Fma>(&self, f: F, from: &State, h: f64, a: f64, along: Along) -> Step {
        let (mut ks, mut ku) = ([0.0f64; STAGES], [0.0f64; STAGES]);
        let (mut ss, mut us, mut pace) = ([0.0f64; STAGES], [0.0f64; STAGES], [0.0f64; STAGES]);
        for i in 0..STAGES {
            let (mut ds, mut du) = (0.0f64, 0.0f64);
            for j in 0..i {
                if A[i][j] != 0.0 {
                    ds = f.fma(A[i][j], ks[j], ds);
                    du = f.fma(A[i][j], ku[j], du);
                }
            }
            (ss[i], us[i]) = (f.fma(h, ds, from.s), f.fma(h, du, from.u));
            (ks[i], ku[i], pace[i]) = self.rates(f, ss[i], us[i], a, along);
        }
        let sum = |w: &[f64; STAGES], k: &[f64; STAGES]| (0..STAGES).fold(0.0, |t: f64, i| f.fma(w[i], k[i], t));
        let to_s = f.fma(h, sum(&B, &ks), from.s);
        let to_u = f.fma(h, sum(&B, &ku), from.u);
        let scale_s = TOLERANCE * from.s.abs().max(to_s.abs()).max(1.0);
        let scale_u = TOLERANCE * from.u.abs().max(to_u.abs()).max(1.0);
        let square = |x: f64, scale: f64| (x / scale) * (x / scale);
        let five = square(sum(&E5, &ks), scale_s) + square(sum(&E5, &ku), scale_u);
        let three = square(sum(&E3, &ks), scale_s) + square(sum(&E3, &ku), scale_u);
        let spread = f.fma(0.01, three, five);
        // a spread that is not a number must not pass for none
        let error = if spread == 0.0 { 0.0 } else { h.abs() * five / math::sqrt(2.0 * spread) };
        let mut rides = from.rides;
        for i in 0..STAGES {
            let weight = h * B[i] * 2.0 * pace[i];
            let (x, square_u) = (ss[i] * ss[i], us[i] * us[i]);
            rides.time = f.fma(weight, ss[i], rides.time);
            rides.impulse = f.fma(weight, x * x, rides.impulse);
            rides.hertz_work = f.fma(weight * self.hertz_damping, x * x * square_u, rides.hertz_work);
            rides.adhesion_work = f.fma(weight * a * self.adhesion_damping, x * square_u, rides.adhesion_work);
        }
        Step { to: State { s: to_s, u: to_u, rides }, error }
    }

    /// Follows the contact to its end; `watch` sees every accepted moment and whether adhesion acts there.
    #[inline(always)]
    pub(super) fn solve<F: Fma>(&self, f: F, longest: f64, watch: &mut impl FnMut(&State, bool)) -> Motion {
        let mut state = State { s: 0.0, u: 1.0, rides: Rides::default() };
        let mut motion = Motion { captured: true, ..Motion::default() };
        let mut separating = false;
        let mut h = longest.min(0.3);
        watch(&state, self.reversible);
        for _ in 0..MOST_STEPS {
            let a = if self.reversible || separating { self.adhesion } else { 0.0 };
            let mut step = self.step(f, &state, h, a, Along::Sigma);
            let wanted = h * growth(step.error);
            if refused(step.error) {
                h = wanted;
                continue;
            }
            let turns = !separating && step.to.u <= 0.0;
            let leaves = separating && step.to.s <= 0.0;
            if turns || leaves {
                let (along, length) = if turns { (Along::Speed, -state.u) } else { (Along::Depth, -state.s) };
                let landing = self.step(f, &state, length, a, along);
                if !refused(landing.error) {
                    step = landing;
                } else if h > 1e-9 {
                    // come closer first: the last stretch must be smooth in the new variable
                    h *= 0.5;
                    continue;
                }
                // else the stretch is shorter than the rounding, and σ's own step ends it as well
            } else if separating && step.to.u >= 0.0 {
                motion.end = step.to;
                watch(&step.to, true);
                return motion;
            }
            state = step.to;
            watch(&state, self.reversible || separating);
            if leaves {
                return Motion { captured: false, end: state, ..motion };
            }
            if turns {
                state.u = 0.0;
                motion.deepest = state.s;
                separating = true;
                if self.adhesion >= state.s * state.s {
                    // the net force points inward where it turns: it never separates
                    motion.end = state;
                    return motion;
                }
                h = h.min(wanted);
            } else {
                h = wanted.min(longest);
            }
        }
        motion.end = state;
        motion
    }
}

/// A step whose error, in tolerances, is too large or not a number.
#[inline(always)]
fn refused(error: f64) -> bool {
    error > 1.0 || error.is_nan()
}

/// Factor on the step from error over tolerance: its eighth root, with care.
#[inline(always)]
fn growth(error: f64) -> f64 {
    if error.is_nan() || error > 1e30 {
        return 0.1;
    }
    (0.85 / math::sqrt(math::sqrt(math::sqrt(error.max(1e-12))))).clamp(0.2, 5.0)
}
