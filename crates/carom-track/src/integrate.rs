//! One step of the equations of motion x″ = a(x, v, ω), ω′ = α(x, v, ω), with its error and its dense output.
//!
//! Dormand & Prince's embedded pair of orders 5 and 4 (1980, doi:10.1016/0771-050X(80)90013-3) as given by Hairer, Nørsett
//! & Wanner, *Solving Ordinary Differential Equations I* (1993), II.5. The path within a step is the quintic that has the
//! position, velocity and acceleration of both ends (Hermite's interpolation); its error, h⁶ x⁽⁶⁾/46 080 at most, is of
//! higher order than the step's. Spins follow Shampine's fourth-order interpolant (same book, II.6). Positions are
//! eliminated from the stages (x′ = v), so a constant acceleration is integrated exactly whatever the step. Everything is
//! written for `W` particles side by side, each with its own step; no operation mixes two of them, so a particle's bits
//! do not depend on W or on its neighbours.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

pub mod exponential;
mod tableau;

use crate::lanes::{Mask, choose};
use tableau::{A, AA, C, D, E, EA, STAGES};

/// One number per particle.
///
/// What holds such arrays is aligned to 64 bytes, as the widest vectors want it.
pub type Lanes<const W: usize> = [f64; W];
/// A vector per particle, component by component.
pub type Lanes3<const W: usize> = [[f64; W]; 3];

/// A particle's motion: position (m), velocity (m/s) and spin (rad/s) for `W` particles.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Motion<const W: usize> {
    /// Position, m.
    pub x: Lanes3<W>,
    /// Velocity, m/s.
    pub v: Lanes3<W>,
    /// Spin, rad/s.
    pub spin: Lanes3<W>,
}

/// Rates of change: acceleration (m/s²) and, where forces couple to it, angular acceleration (rad/s²).
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Rates<const W: usize> {
    /// Acceleration, m/s².
    pub a: Lanes3<W>,
    /// Angular acceleration, rad/s².
    pub alpha: Lanes3<W>,
    /// Rate at which drag changes the velocity by what it is less than the fluid's, 1/s: what [`exponential::step`] solves exactly. Any
    /// number gives a right step; the nearer to −∂a/∂v, the longer it may be.
    pub drag: Lanes<W>,
    /// Likewise of the spin, 1/s.
    pub torque: Lanes<W>,
}

impl<const W: usize> Motion<W> {
    /// At the origin, at rest.
    pub const ZERO: Self = Self { x: [[0.0; W]; 3], v: [[0.0; W]; 3], spin: [[0.0; W]; 3] };
}

impl<const W: usize> Rates<W> {
    /// No change.
    pub const ZERO: Self = Self { a: [[0.0; W]; 3], alpha: [[0.0; W]; 3], drag: [0.0; W], torque: [0.0; W] };
}

/// The result of one trial step. The control points are offsets from the start, in Bernstein form over the step: their
/// first is zero and their last the whole change.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Step<const W: usize> {
    /// Motion at the end.
    pub end: Motion<W>,
    /// Rates at the end: the first stage of the next step.
    pub rates: Rates<W>,
    /// Control points 1 to 5 of the position.
    pub path: [Lanes3<W>; 5],
    /// Control points 1 to 4 of the spin (only where it changes).
    pub twist: [Lanes3<W>; 4],
    /// Square of the estimated error over the tolerated one: at most 1 to be accepted.
    pub error_squared: Lanes<W>,
    /// Changes of velocity (m/s) and spin (rad/s) that each stage's rates would make over the step.
    kicks: [Lanes3<W>; STAGES],
    turns: [Lanes3<W>; STAGES],
}

impl<const W: usize> Step<W> {
    /// Nothing yet.
    pub const ZERO: Self = Self {
        end: Motion::ZERO,
        rates: Rates::ZERO,
        path: [[[0.0; W]; 3]; 5],
        twist: [[[0.0; W]; 3]; 4],
        error_squared: [0.0; W],
        kicks: [[[0.0; W]; 3]; STAGES],
        turns: [[[0.0; W]; 3]; STAGES],
    };

    /// Takes the result of some lanes from another one.
    #[inline(always)]
    pub(crate) fn take(&mut self, other: &Self, lanes: &Mask<W>) {
        for c in 0..3 {
            choose(&mut self.end.x[c], &other.end.x[c], lanes);
            choose(&mut self.end.v[c], &other.end.v[c], lanes);
            choose(&mut self.end.spin[c], &other.end.spin[c], lanes);
            choose(&mut self.rates.a[c], &other.rates.a[c], lanes);
            choose(&mut self.rates.alpha[c], &other.rates.alpha[c], lanes);
            for (old, new) in self.path.iter_mut().zip(&other.path) {
                choose(&mut old[c], &new[c], lanes);
            }
            for (old, new) in self.twist.iter_mut().zip(&other.twist) {
                choose(&mut old[c], &new[c], lanes);
            }
        }
        choose(&mut self.rates.drag, &other.rates.drag, lanes);
        choose(&mut self.rates.torque, &other.rates.torque, lanes);
        choose(&mut self.error_squared, &other.error_squared, lanes);
    }

    /// How far the path has come at θ in [0, 1], m, and the velocity there (the slope of the path, m/s) for steps of length
    /// `h` > 0.
    #[inline(always)]
    pub fn along(&self, h: &Lanes<W>, theta: &Lanes<W>) -> (Lanes3<W>, Lanes3<W>) {
        let [p, q, r, s, t] = &self.path;
        let (mut offset, mut velocity) = ([[0.0; W]; 3], [[0.0; W]; 3]);
        for c in 0..3 {
            for l in 0..W {
                let mut x = [0.0, p[c][l], q[c][l], r[c][l], s[c][l], t[c][l]];
                for top in (2..6).rev() {
                    for i in 0..top {
                        x[i] += theta[l] * (x[i + 1] - x[i]);
                    }
                }
                offset[c][l] = x[0] + theta[l] * (x[1] - x[0]);
                velocity[c][l] = (x[1] - x[0]) * (5.0 / h[l]);
            }
        }
        (offset, velocity)
    }
}

/// Share of the position's error that counts where forces do not depend on the place. An error across a sheared flow turns
/// into one of the velocity; in a uniform one it only catches the steps across a relative speed near zero, where drag is not
/// smooth and the velocity's estimate may vanish by chance.
const UNIFORM: f64 = 0.25;

/// a b + c, lane by lane. Values in, a value out: the compiler then sees that nothing overlaps and keeps to vectors.
#[inline(always)]
fn fma<const W: usize>(a: Lanes<W>, b: Lanes<W>, c: Lanes<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = a[l].mul_add(b[l], c[l]);
    }
    out
}

/// s a, lane by lane.
#[inline(always)]
fn times<const W: usize>(s: f64, a: Lanes<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = s * a[l];
    }
    out
}

#[inline(always)]
fn plus<const W: usize>(a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = a[l] + b[l];
    }
    out
}

#[inline(always)]
fn product<const W: usize>(a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = a[l] * b[l];
    }
    out
}

/// Σⱼ wⱼ kⱼ, skipping weights that are zero. With constant weights nothing of the loop is left.
#[inline(always)]
fn weigh<const W: usize>(w: &[f64], k: &[Lanes3<W>; STAGES], component: usize) -> Lanes<W> {
    let (mut sum, mut first) = ([0.0; W], true);
    for (w, k) in w.iter().zip(k) {
        if *w != 0.0 {
            sum = if first { times(*w, k[component]) } else { fma([*w; W], k[component], sum) };
            first = false;
        }
    }
    sum
}

/// The right-hand side of the equations of motion.
///
/// A trait rather than a closure, so that it can be inlined for certain into code compiled for wider instructions.
pub trait Derivative<const W: usize> {
    /// Fills in accelerations, and angular ones if [`Control::spins`], for a motion at a time (s).
    fn rates(&self, time: &Lanes<W>, motion: &Motion<W>, out: &mut Rates<W>);
}

impl<const W: usize, F: Fn(&Motion<W>, &mut Rates<W>)> Derivative<W> for F {
    #[inline(always)]
    fn rates(&self, _time: &Lanes<W>, motion: &Motion<W>, out: &mut Rates<W>) {
        self(motion, out);
    }
}

/// What one step needs besides the motion.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// Tolerated error of a step, relative to the speed and to the distance gone.
    pub tolerance: f64,
    /// Whether spin changes in flight.
    pub spins: bool,
    /// Whether the rates depend on the place; if not, stages need none.
    pub place: bool,
}

/// Tries a step of length `h` (s, one per particle) from `start` at `time`, whose rates are `first`.
#[inline(always)]
pub fn step<const W: usize>(
    time: &Lanes<W>,
    start: &Motion<W>,
    first: &Rates<W>,
    h: &Lanes<W>,
    control: Control,
    derivative: &impl Derivative<W>,
    out: &mut Step<W>,
) {
    let trial = Trial { time, start, h: *h, control };
    trial.keep::<0>(first, out);
    trial.stage::<1>(derivative, out);
    trial.stage::<2>(derivative, out);
    trial.stage::<3>(derivative, out);
    trial.stage::<4>(derivative, out);
    trial.stage::<5>(derivative, out);
    (out.end, out.rates) = trial.stage::<6>(derivative, out);
    for c in 0..3 {
        let change = product(*h, plus(start.v[c], weigh(&AA[6], &out.kicks, c)));
        out.end.x[c] = plus(start.x[c], change);
        set(&mut out.path, c, quintic(*h, [start.v[c], out.end.v[c]], [out.kicks[0][c], out.kicks[6][c]], change));
        if control.spins {
            let change = weigh(&A[6], &out.turns, c);
            let bend = weigh(&D, &out.turns, c);
            set(&mut out.twist, c, quartic(out.turns[0][c], out.turns[6][c], change, bend));
        }
    }
    out.error_squared = trial.error(out);
}

/// A step under way.
struct Trial<'a, const W: usize> {
    time: &'a Lanes<W>,
    start: &'a Motion<W>,
    h: Lanes<W>,
    control: Control,
}

impl<const W: usize> Trial<'_, W> {
    /// One stage; a constant, so that its weights are.
    #[inline(always)]
    fn stage<const S: usize>(&self, derivative: &impl Derivative<W>, out: &mut Step<W>) -> (Motion<W>, Rates<W>) {
        let start = self.start;
        let mut at = *start;
        for c in 0..3 {
            at.v[c] = plus(start.v[c], weigh(&A[S][..S], &out.kicks, c));
            if self.control.place {
                let way = plus(times(C[S], start.v[c]), weigh(&AA[S][..S], &out.kicks, c));
                // rounded as the path's last point is
                at.x[c] = plus(start.x[c], product(self.h, way));
            }
            if self.control.spins {
                at.spin[c] = plus(start.spin[c], weigh(&A[S][..S], &out.turns, c));
            }
        }
        let mut now = Rates::ZERO;
        derivative.rates(&fma([C[S]; W], self.h, *self.time), &at, &mut now);
        self.keep::<S>(&now, out);
        (at, now)
    }

    #[inline(always)]
    fn keep<const S: usize>(&self, rates: &Rates<W>, out: &mut Step<W>) {
        for c in 0..3 {
            out.kicks[S][c] = product(self.h, rates.a[c]);
            if self.control.spins {
                out.turns[S][c] = product(self.h, rates.alpha[c]);
            }
        }
    }

    /// Square of the error over the tolerated one: of the velocity, `tolerance` times the speed; of the position (or a share of
    /// that), `tolerance` times the distance that speed covers; of the spin, where it changes, the same as of the velocity.
    /// What is not a number stays none.
    #[inline(always)]
    fn error(&self, out: &Step<W>) -> Lanes<W> {
        let mut off = square(&E, &out.kicks);
        let share = if self.control.place { 1.0 } else { UNIFORM };
        off = plus(off, times(share * share, square(&EA, &out.kicks)));
        let mut error = over(off, [&self.start.v, &out.end.v, &out.kicks[0]], self.control.tolerance);
        if self.control.spins {
            let spins = [&self.start.spin, &out.end.spin, &out.turns[0]];
            error = plus(error, over(square(&E, &out.turns), spins, self.control.tolerance));
        }
        error
    }
}

/// Control points 1 to 5 of a path with velocities `v` at the ends, on which the accelerations there would change the
/// velocity by `kick` over the step `h`, and that ends at `change`.
#[inline(always)]
fn quintic<const W: usize>(h: Lanes<W>, v: [Lanes<W>; 2], kick: [Lanes<W>; 2], change: Lanes<W>) -> [Lanes<W>; 5] {
    let bend = times(0.05, h);
    let away = product(times(0.2, h), v[0]);
    let back = product(times(-0.2, h), v[1]);
    let second = fma(bend, kick[0], times(2.0, away));
    let third = fma(bend, kick[1], fma([2.0; W], back, change));
    [away, second, third, plus(change, back), change]
}

/// Control points 1 to 4 of a quantity whose rates at the ends would change it by `first` and `last`, that changes by
/// `change`, and whose interpolant has the quartic term `bend`.
#[inline(always)]
fn quartic<const W: usize>(first: Lanes<W>, last: Lanes<W>, change: Lanes<W>, bend: Lanes<W>) -> [Lanes<W>; 4] {
    let swing = plus(fma([-1.0; W], last, first), bend);
    let second = fma([1.0 / 6.0; W], swing, times(0.5, change));
    [times(0.25, first), second, fma([-0.25; W], last, change), change]
}

/// One component of control points.
#[inline(always)]
fn set<const W: usize, const N: usize>(points: &mut [Lanes3<W>; N], c: usize, q: [Lanes<W>; N]) {
    for (point, q) in points.iter_mut().zip(q) {
        point[c] = q;
    }
}

/// Σ over components of (Σⱼ wⱼ kⱼ)².
#[inline(always)]
fn square<const W: usize>(w: &[f64], k: &[Lanes3<W>; STAGES]) -> Lanes<W> {
    let mut sum = [0.0; W];
    for c in 0..3 {
        let part = weigh(w, k, c);
        sum = fma(part, part, sum);
    }
    sum
}

/// Square of an error over `tolerance` times the largest of some speeds.
#[inline(always)]
fn over<const W: usize>(error_squared: Lanes<W>, speeds: [&Lanes3<W>; 3], tolerance: f64) -> Lanes<W> {
    // nothing that moves is slower
    let mut largest = [1e-200; W];
    for v in speeds {
        let square = fma(v[0], v[0], fma(v[1], v[1], product(v[2], v[2])));
        for l in 0..W {
            largest[l] = if square[l] > largest[l] { square[l] } else { largest[l] };
        }
    }
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = error_squared[l] / (tolerance * tolerance * largest[l]);
    }
    out
}

/// The factor by which the next step may be longer (or must be shorter), for the square of an error over the tolerated
/// one: the velocity's error goes with the fifth power of the step, the position's with the fourth of it.
#[inline(always)]
pub fn growth(error_squared: f64, place: bool) -> f64 {
    // what is not a number counts as large
    let square = if error_squared < 1e8 { error_squared } else { 1e8 };
    let square = if square > 1e-8 { square } else { 1e-8 };
    let factor = 0.9 * carom::math::pow(square, if place { -0.125 } else { -0.1 });
    let factor = if factor > 0.2 { factor } else { 0.2 };
    if factor < 5.0 { factor } else { 5.0 }
}

#[cfg(test)]
mod tests;
