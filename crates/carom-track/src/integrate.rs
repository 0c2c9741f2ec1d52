//! One step of the equations of motion x″ = a(x, v, ω), ω′ = α(x, v, ω), with its error and its dense output.
//!
//! Dormand & Prince's embedded pair of orders 5 and 4 (1980, doi:10.1016/0771-050X(80)90013-3) with Shampine's
//! fourth-order interpolant as given by Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I* (1993),
//! II.6. Positions are eliminated from the stages (x′ = v), so a constant acceleration is integrated exactly whatever
//! the step. Everything is written for `W` particles side by side, each with its own step; no operation mixes two of
//! them, so a particle's bits do not depend on W or on its neighbours.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

/// One number per particle.
pub type Lanes<const W: usize> = [f64; W];
/// A vector per particle, component by component.
pub type Lanes3<const W: usize> = [[f64; W]; 3];

/// A particle's motion: position (m), velocity (m/s) and spin (rad/s) for `W` particles.
#[derive(Clone, Copy, Debug)]
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
pub struct Rates<const W: usize> {
    /// Acceleration, m/s².
    pub a: Lanes3<W>,
    /// Angular acceleration, rad/s².
    pub alpha: Lanes3<W>,
}

impl<const W: usize> Motion<W> {
    /// At the origin, at rest.
    pub const ZERO: Self = Self { x: [[0.0; W]; 3], v: [[0.0; W]; 3], spin: [[0.0; W]; 3] };
}

impl<const W: usize> Rates<W> {
    /// No change.
    pub const ZERO: Self = Self { a: [[0.0; W]; 3], alpha: [[0.0; W]; 3] };
}

/// The result of one trial step. The control points are offsets from the start, in Bernstein form of degree 4 over
/// the step: their first is zero and their last the whole change.
#[derive(Clone, Copy, Debug)]
pub struct Step<const W: usize> {
    /// Motion at the end.
    pub end: Motion<W>,
    /// Rates at the end: the first stage of the next step.
    pub rates: Rates<W>,
    /// Control points 1 to 4 of the position.
    pub path: [Lanes3<W>; 4],
    /// Control points 1 to 4 of the velocity.
    pub speed: [Lanes3<W>; 4],
    /// Control points 1 to 4 of the spin (only where it changes).
    pub twist: [Lanes3<W>; 4],
    /// Estimated error over the tolerated one: at most 1 to be accepted.
    pub error: Lanes<W>,
}

impl<const W: usize> Step<W> {
    /// Nothing yet.
    pub const ZERO: Self = Self {
        end: Motion::ZERO,
        rates: Rates::ZERO,
        path: [[[0.0; W]; 3]; 4],
        speed: [[[0.0; W]; 3]; 4],
        twist: [[[0.0; W]; 3]; 4],
        error: [0.0; W],
    };
}

const STAGES: usize = 7;

/// Dormand–Prince coefficients; the last row is the fifth-order weights.
const A: [[f64; 6]; STAGES] = [
    [0.0; 6],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

const C: [f64; STAGES] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];

/// Fifth- minus fourth-order weights.
const E: [f64; STAGES] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Weights of the interpolant's quartic term.
const D: [f64; STAGES] = [
    -12715105075.0 / 11282082432.0,
    0.0,
    87487479700.0 / 32700410799.0,
    -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0,
    -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0,
];

/// Σᵢ wᵢ aᵢⱼ: what a sum over stage velocities weighs the accelerations with.
const fn through(w: &[f64; STAGES]) -> [f64; 6] {
    let mut out = [0.0; 6];
    let mut j = 0;
    while j < 6 {
        let mut i = 0;
        while i < STAGES {
            out[j] += w[i] * A[i][j];
            i += 1;
        }
        j += 1;
    }
    out
}

const fn widen(row: &[f64; 6]) -> [f64; STAGES] {
    [row[0], row[1], row[2], row[3], row[4], row[5], 0.0]
}

/// Weights of the accelerations in each stage's position.
const AA: [[f64; 6]; STAGES] = {
    let mut out = [[0.0; 6]; STAGES];
    let mut i = 0;
    while i < STAGES {
        out[i] = through(&widen(&A[i]));
        i += 1;
    }
    out
};
const EA: [f64; 6] = through(&E);
const DA: [f64; 6] = through(&D);

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
fn minus<const W: usize>(a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = a[l] - b[l];
    }
    out
}

#[inline(always)]
fn larger<const W: usize>(a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = a[l].max(b[l].abs());
    }
    out
}

/// Σⱼ wⱼ kⱼ, skipping weights that are zero. With constant weights nothing of the loop is left.
#[inline(always)]
fn weigh<const W: usize>(w: &[f64], k: &[Lanes3<W>; STAGES], component: usize) -> Lanes<W> {
    let mut sum = [0.0; W];
    for (w, k) in w.iter().zip(k) {
        if *w != 0.0 {
            sum = fma([*w; W], k[component], sum);
        }
    }
    sum
}

/// The right-hand side of the equations of motion.
///
/// A trait rather than a closure, so that it can be inlined for certain into code compiled for wider instructions.
pub trait Derivative<const W: usize> {
    /// Fills in accelerations, and angular ones if [`Control::spins`], for a motion.
    fn rates(&self, motion: &Motion<W>, out: &mut Rates<W>);
}

impl<const W: usize, F: Fn(&Motion<W>, &mut Rates<W>)> Derivative<W> for F {
    #[inline(always)]
    fn rates(&self, motion: &Motion<W>, out: &mut Rates<W>) {
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

/// Tries a step of length `h` (s, one per particle) from `start`, whose rates are `first`.
#[inline(always)]
pub fn step<const W: usize>(
    start: &Motion<W>,
    first: &Rates<W>,
    h: &Lanes<W>,
    control: Control,
    derivative: &impl Derivative<W>,
    out: &mut Step<W>,
) {
    let mut trial =
        Trial { start, h, control, k: [[[0.0; W]; 3]; STAGES], kk: [[[0.0; W]; 3]; STAGES], at: *start, now: *first };
    trial.k[0] = first.a;
    trial.kk[0] = first.alpha;
    trial.stage::<1>(derivative);
    trial.stage::<2>(derivative);
    trial.stage::<3>(derivative);
    trial.stage::<4>(derivative);
    trial.stage::<5>(derivative);
    trial.stage::<6>(derivative);
    let Trial { k, kk, at, now, .. } = trial;
    out.end = at;
    out.rates = now;
    controls(start, first, h, control, &k, &kk, out);
    out.error = error(start, h, control, &k, &kk, out);
}

/// A step under way.
struct Trial<'a, const W: usize> {
    start: &'a Motion<W>,
    h: &'a Lanes<W>,
    control: Control,
    k: [Lanes3<W>; STAGES],
    kk: [Lanes3<W>; STAGES],
    at: Motion<W>,
    now: Rates<W>,
}

impl<const W: usize> Trial<'_, W> {
    /// One stage; a constant, so that its weights are.
    #[inline(always)]
    fn stage<const S: usize>(&mut self, derivative: &impl Derivative<W>) {
        let (h, start) = (*self.h, self.start);
        // the last stage is the end of the step: its place is wanted in any case
        let place = self.control.place || S == STAGES - 1;
        for c in 0..3 {
            self.at.v[c] = fma(h, weigh(&A[S][..S], &self.k, c), start.v[c]);
            if place {
                let inner = fma(h, weigh(&AA[S][..S], &self.k, c), times(C[S], start.v[c]));
                self.at.x[c] = fma(h, inner, start.x[c]);
            }
            if self.control.spins {
                self.at.spin[c] = fma(h, weigh(&A[S][..S], &self.kk, c), start.spin[c]);
            }
        }
        derivative.rates(&self.at, &mut self.now);
        self.k[S] = self.now.a;
        self.kk[S] = self.now.alpha;
    }
}

/// The control points of position, velocity and spin.
#[inline(always)]
fn controls<const W: usize>(
    start: &Motion<W>,
    first: &Rates<W>,
    h: &Lanes<W>,
    control: Control,
    k: &[Lanes3<W>; STAGES],
    kk: &[Lanes3<W>; STAGES],
    out: &mut Step<W>,
) {
    let h = *h;
    for c in 0..3 {
        let (v0, v1) = (start.v[c], out.end.v[c]);
        let dx = product(h, fma(h, weigh(&AA[6], k, c), v0));
        set(&mut out.path, c, quartic(h, v0, v1, dx, product(h, weigh(&DA, k, c))));
        let dv = product(h, weigh(&A[6], k, c));
        set(&mut out.speed, c, quartic(h, first.a[c], out.rates.a[c], dv, weigh(&D, k, c)));
        if control.spins {
            let dw = product(h, weigh(&A[6], kk, c));
            set(&mut out.twist, c, quartic(h, first.alpha[c], out.rates.alpha[c], dw, weigh(&D, kk, c)));
        }
    }
}

/// Control points 1 to 4 of a quantity whose rate is `r0` and `r1` at the ends, that changes by `change`, and whose
/// interpolant has the quartic term `bend`, all for a step `h`.
#[inline(always)]
fn quartic<const W: usize>(h: Lanes<W>, r0: Lanes<W>, r1: Lanes<W>, change: Lanes<W>, bend: Lanes<W>) -> [Lanes<W>; 4] {
    let mut swing = minus(r0, r1);
    for l in 0..W {
        swing[l] += bend[l];
    }
    let first = product(times(0.25, h), r0);
    let second = fma(times(1.0 / 6.0, h), swing, times(0.5, change));
    let third = fma(times(-0.25, h), r1, change);
    [first, second, third, change]
}

#[inline(always)]
fn product<const W: usize>(a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = a[l] * b[l];
    }
    out
}

/// One component of four control points.
#[inline(always)]
fn set<const W: usize>(points: &mut [Lanes3<W>; 4], c: usize, q: [Lanes<W>; 4]) {
    points[0][c] = q[0];
    points[1][c] = q[1];
    points[2][c] = q[2];
    points[3][c] = q[3];
}

/// Largest error of a component over what is tolerated: of the velocity, `tolerance` times the speed and its change;
/// of the position, `tolerance` times the distance that speed covers.
#[inline(always)]
fn error<const W: usize>(
    start: &Motion<W>,
    h: &Lanes<W>,
    control: Control,
    k: &[Lanes3<W>; STAGES],
    kk: &[Lanes3<W>; STAGES],
    out: &Step<W>,
) -> Lanes<W> {
    let h = *h;
    let mut off = [0.0f64; W];
    let mut size = [f64::MIN_POSITIVE; W];
    for c in 0..3 {
        off = larger(off, product(h, weigh(&E, k, c)));
        off = larger(off, product(h, weigh(&EA, k, c)));
        size = larger(size, start.v[c]);
        size = larger(size, out.end.v[c]);
        size = larger(size, product(h, k[0][c]));
    }
    let mut error = over(off, size, control.tolerance);
    if control.spins {
        let mut off = [0.0f64; W];
        let mut size = [f64::MIN_POSITIVE; W];
        for c in 0..3 {
            off = larger(off, product(h, weigh(&E, kk, c)));
            size = larger(size, start.spin[c]);
            size = larger(size, out.end.spin[c]);
            size = larger(size, product(h, kk[0][c]));
        }
        error = larger(error, over(off, size, control.tolerance));
    }
    error
}

#[inline(always)]
fn over<const W: usize>(off: Lanes<W>, size: Lanes<W>, tolerance: f64) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = off[l] / (tolerance * size[l]);
    }
    out
}

/// The factor by which the next step may be longer (or must be shorter), for an error over the tolerated one.
#[inline(always)]
pub fn growth(error: f64) -> f64 {
    // the error of the position, relative to the distance of the step, goes with its fourth power; what is not a number
    // counts as large
    let error = if error > 1e-4 { error } else { 1e-4 };
    let error = if error < 1e4 { error } else { 1e4 };
    // 0.9 error^(−1/4)
    let factor = 0.9 / error.sqrt().sqrt();
    factor.clamp(0.2, 5.0)
}

#[cfg(test)]
mod tests;
