//! One step of the same equations of motion that does not know the relaxation time: for spheres that follow the fluid.
//!
//! An explicit step stays below about three relaxation times 1/β however slowly the flow changes. Here the rate β of the drag
//! is taken from the start of the step and its part of the acceleration solved exactly: with v′ = −βv + N, N = a + βv, and z = βh,
//!
//! v(ch) = v₀ + c φ₁(cz) h a₀ + h Σₖ k! cᵏ⁺¹ φₖ₊₁(cz) nₖ,
//! x(ch) = x₀ + c h v₀ + c² φ₂(cz) h² a₀ + h² Σₖ k! cᵏ⁺² φₖ₊₂(cz) nₖ,  N(ch) − N₀ = Σₖ nₖ cᵏ, φₖ those of −cz,
//!
//! so a constant N (even flow, Stokes drag, any weight) has no error at any step. For z → 0 the weights are those of a polynomial
//! acceleration, for z → ∞ those of the drift velocity, v = u + g′/β − (Du/Dt)/β + …; they come without cancellation and overflow
//! at either end (`phi.rs`).
//!
//! N is interpolated, in rising order: constant through the start; linear through the start and what that gives at the end; then
//! through three, four and five points in time, each time where the order before leads to. Written for positions alone the kernel,
//! x = x₀ + v₀ (1 − E)/β + ∫(1 − e^{−β(t − s)}) N(s)/β ds, lies between 0 and 1, and N/β changes with the place as the fluid's velocity
//! does: each round wins one power of h|∇u| with a constant that does not know β, and the result has order five in the position
//! and at least four in the velocity, uniformly. This asks for nothing but stage order: the conditions of exponential Runge–Kutta methods
//! (Hochbruck & Ostermann 2010, Acta Numerica 19, 209–286, doi:10.1017/S0962492910000048) hold term by term, and no two errors
//! have to cancel. Each round has a point at the end of the step, so that what is left of the drag in N (its dependence on the speed,
//! lifts) is contracted for z → ∞ and not extrapolated: by ε = 0.1 Re^0.687 a round for Schiller and Naumann's, of the change of the
//! fluid's velocity over the step. That ε⁴ is no power of h: at the Reynolds numbers at which such spheres drift (below 0.1) it is lost
//! below the tolerance, above it shortens steps. Ten evaluations are new in a step and one more is its end's, against Dormand–Prince's
//! six; implicit methods (Rosenbrock, Radau) would need the derivatives of all forces, which a flow does not always have.
//!
//! The error is the difference of the last two rounds, of orders five and four, as it is with Dormand and Prince. The path is
//! the quintic with the positions at 0, ¼, ¾ and 1 and the velocities of both ends; its distance from the position at ½, which is
//! known, counts as an error too. So a velocity that is not yet the fluid's (after an injection, a rebound) is followed with steps
//! that show it. Where that error is too large the path may instead pass through the position at ½ and start with the velocity that leads
//! there, w: then its distance from the position at ⅛ counts and, as |w − v₀| (1 − E)/β, the way that the drag takes to make w of v₀. That
//! forgets what no longer shows, as the small changes that drifting eddies make from step to step. Spins have their own rate, and
//! the quartic through their values at 0, ¼, ½, ¾ and 1, held against the value at ⅛.

mod phi;

use super::{Control, Derivative, Lanes, Lanes3, Motion, Rates, Step, UNIFORM, fma, over, plus, product, set, times};
use crate::lanes::{choose, mask};
use phi::{Moments, moments};

/// Points in time within a step besides its start.
const NODES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
const END: usize = 3;
/// Where paths that start with another velocity, and spins, are held against what is right.
const EARLY: f64 = 0.125;

/// Rounds: the points that each leads to with the polynomial through those of the round before.
const ROUNDS: [&[usize]; 4] = [&[END], &[1, END], &[0, 2, END], &[0, 1, 2, END]];

/// Coefficients of c, c², c³, c⁴ of the polynomials that are 0 at the start and pass through the values at the points of a
/// round: one row for each point of [`NODES`].
const THROUGH: [[[f64; 4]; 4]; 5] = [
    [[0.0; 4]; 4],
    [[0.0; 4], [0.0; 4], [0.0; 4], [1.0, 0.0, 0.0, 0.0]],
    [[0.0; 4], [4.0, -4.0, 0.0, 0.0], [0.0; 4], [-1.0, 2.0, 0.0, 0.0]],
    [
        [8.0, -56.0 / 3.0, 32.0 / 3.0, 0.0],
        [0.0; 4],
        [-8.0 / 3.0, 40.0 / 3.0, -32.0 / 3.0, 0.0],
        [1.0, -16.0 / 3.0, 16.0 / 3.0, 0.0],
    ],
    QUARTIC,
];
const QUARTIC: [[f64; 4]; 4] = [
    [16.0, -208.0 / 3.0, 96.0, -128.0 / 3.0],
    [-12.0, 76.0, -128.0, 64.0],
    [16.0 / 3.0, -112.0 / 3.0, 224.0 / 3.0, -128.0 / 3.0],
    [-1.0, 22.0 / 3.0, -16.0, 32.0 / 3.0],
];

/// Tries a step of length `h` (s, one per particle) from `start` at `time`, whose rates are `first`: as [`super::step`].
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
    let mut trial = Trial::new(start, first, h, control.spins);
    let (mut before, mut way) = (*start, [[0.0; W]; 3]);
    for (degree, points) in ROUNDS.iter().enumerate() {
        trial.bend(degree);
        for node in *points {
            let (at, offset) = trial.at(*node);
            let mut now = Rates::ZERO;
            derivative.rates(&fma([NODES[*node]; W], *h, *time), &at, &mut now);
            trial.keep(*node, &at, &now);
            (before, way) = (at, offset);
        }
    }
    trial.bend(ROUNDS.len());
    let ((first_quarter, early), (middle, half)) = (trial.at(0), trial.at(1));
    let ((last_quarter, late), (end, change)) = (trial.at(2), trial.at(END));
    derivative.rates(&plus(*time, *h), &end, &mut out.rates);
    for c in 0..3 {
        set(&mut out.path, c, quintic(*h, [start.v[c], end.v[c]], [early[c], late[c], change[c]]));
    }
    let scale = trial.tolerated(&end, control.tolerance);
    let mut off = trial.miss(&MIDDLE, &half, &out.path);
    if trial.is_missed(&off, &scale) {
        trial.start_over(&half, &scale, &mut off, &mut out.path);
    }
    out.error_squared =
        product(plus(trial.miss_of_rounds([&before, &end], [&way, &change], control.place), off), scale);
    if control.spins {
        trial.twist([&first_quarter.spin, &middle.spin, &last_quarter.spin, &end.spin], out);
        out.error_squared = plus(out.error_squared, trial.spin_error(&before, &end, out, control.tolerance));
    }
    out.end = end;
}

/// A step under way.
struct Trial<'a, const W: usize> {
    start: &'a Motion<W>,
    h: Lanes<W>,
    spins: bool,
    /// βh of the velocity and of the spin.
    z: [Lanes<W>; 2],
    /// The change that the rates of the start would make over the step.
    kick: Lanes3<W>,
    turn: Lanes3<W>,
    /// Weights of a polynomial's powers, point by point.
    moments: [Moments<W>; 4],
    spin_moments: [Moments<W>; 4],
    /// h (N − N₀) at the points, and as a polynomial.
    kicks: [Lanes3<W>; 4],
    turns: [Lanes3<W>; 4],
    bends: [Lanes3<W>; 4],
    twists: [Lanes3<W>; 4],
}

impl<'a, const W: usize> Trial<'a, W> {
    #[inline(always)]
    fn new(start: &'a Motion<W>, first: &Rates<W>, h: &Lanes<W>, spins: bool) -> Self {
        let nothing = [[[0.0; W]; 3]; 4];
        let z = [product(*h, first.drag), product(*h, first.torque)];
        let (mut kick, mut turn) = ([[0.0; W]; 3], [[0.0; W]; 3]);
        for c in 0..3 {
            kick[c] = product(*h, first.a[c]);
            turn[c] = product(*h, first.alpha[c]);
        }
        let mut all = [[[0.0; W]; 6]; 4];
        let mut spin_moments = all;
        for (node, c) in NODES.iter().enumerate() {
            moments(*c, &z[0], &mut all[node]);
            if spins {
                moments(*c, &z[1], &mut spin_moments[node]);
            }
        }
        Self {
            start,
            h: *h,
            spins,
            z,
            kick,
            turn,
            moments: all,
            spin_moments,
            kicks: nothing,
            turns: nothing,
            bends: nothing,
            twists: nothing,
        }
    }

    /// The polynomial through the points of the round before.
    #[inline(always)]
    fn bend(&mut self, degree: usize) {
        polynomial(&THROUGH[degree], &self.kicks, &mut self.bends);
        if self.spins {
            polynomial(&THROUGH[degree], &self.turns, &mut self.twists);
        }
    }

    /// The motion at a point, and how far it is from the start.
    #[inline(always)]
    fn at(&self, node: usize) -> (Motion<W>, Lanes3<W>) {
        let mut at = *self.start;
        let mut offset = [[0.0; W]; 3];
        let g = &self.moments[node];
        for c in 0..3 {
            let mut kick = product(g[0], self.kick[c]);
            for k in 0..4 {
                kick = fma(g[k + 1], self.bends[k][c], kick);
            }
            at.v[c] = plus(self.start.v[c], kick);
            offset[c] = self.way(NODES[node], g, c);
            at.x[c] = plus(self.start.x[c], offset[c]);
            if self.spins {
                at.spin[c] = plus(self.start.spin[c], self.turned(&self.spin_moments[node], c));
            }
        }
        (at, offset)
    }

    /// How far it comes along an axis until a point in time, m.
    #[inline(always)]
    fn way(&self, node: f64, g: &Moments<W>, c: usize) -> Lanes<W> {
        let mut way = product(g[1], self.kick[c]);
        for k in 0..4 {
            way = fma(times(OVER[k + 2], g[k + 2]), self.bends[k][c], way);
        }
        product(self.h, fma([node; W], self.start.v[c], way))
    }

    /// The change of the spin, by its moments.
    #[inline(always)]
    fn turned(&self, g: &Moments<W>, c: usize) -> Lanes<W> {
        let mut turn = product(g[0], self.turn[c]);
        for k in 0..4 {
            turn = fma(g[k + 1], self.twists[k][c], turn);
        }
        turn
    }

    #[inline(always)]
    fn keep(&mut self, node: usize, at: &Motion<W>, now: &Rates<W>) {
        for c in 0..3 {
            let (v, spin) = (&self.start.v[c], &self.start.spin[c]);
            for l in 0..W {
                let change = self.h[l].mul_add(now.a[c][l], -self.kick[c][l]);
                self.kicks[node][c][l] = self.z[0][l].mul_add(at.v[c][l] - v[l], change);
            }
            if self.spins {
                for l in 0..W {
                    let change = self.h[l].mul_add(now.alpha[c][l], -self.turn[c][l]);
                    self.turns[node][c][l] = self.z[1][l].mul_add(at.spin[c][l] - spin[l], change);
                }
            }
        }
    }

    /// 1 over the square of the tolerated error, s²/m².
    #[inline(always)]
    fn tolerated(&self, end: &Motion<W>, tolerance: f64) -> Lanes<W> {
        let mut relaxed = [[0.0; W]; 3];
        for c in 0..3 {
            relaxed[c] = product(self.moments[END][0], self.kick[c]);
        }
        over([1.0; W], [&self.start.v, &end.v, &relaxed], tolerance)
    }

    /// Square of the difference of the last two rounds in velocity, and in position over the step, m²/s².
    #[inline(always)]
    fn miss_of_rounds(&self, ends: [&Motion<W>; 2], ways: [&Lanes3<W>; 2], place: bool) -> Lanes<W> {
        let share = if place { 1.0 } else { UNIFORM };
        let mut sum = [0.0; W];
        for c in 0..3 {
            for l in 0..W {
                let v = ends[1].v[c][l] - ends[0].v[c][l];
                let x = share * (ways[1][c][l] - ways[0][c][l]) * self.rate(l);
                sum[l] = v.mul_add(v, x.mul_add(x, sum[l]));
            }
        }
        sum
    }

    /// 1/h, or 1 where there is no step.
    #[inline(always)]
    fn rate(&self, l: usize) -> f64 {
        1.0 / if self.h[l] > 0.0 { self.h[l] } else { 1.0 }
    }

    /// Square of how far a path is from a point, over the step, m²/s²; `shares` of its control points make the point on it.
    #[inline(always)]
    fn miss(&self, shares: &[f64; 5], point: &Lanes3<W>, path: &[Lanes3<W>; 5]) -> Lanes<W> {
        let mut sum = [0.0; W];
        for c in 0..3 {
            let lack = lack(shares, point, path, c);
            for l in 0..W {
                let off = lack[l] * self.rate(l);
                sum[l] = off.mul_add(off, sum[l]);
            }
        }
        sum
    }

    #[inline(always)]
    fn is_missed(&self, off: &Lanes<W>, scale: &Lanes<W>) -> bool {
        let mut any = false;
        for l in 0..W {
            any |= off[l] * scale[l] > MISSED;
        }
        any
    }

    /// Gives the paths that miss their middle by too much the velocity at the start that leads through it, where that is nearer.
    #[inline(always)]
    fn start_over(&self, half: &Lanes3<W>, scale: &Lanes<W>, off: &mut Lanes<W>, path: &mut [Lanes3<W>; 5]) {
        let mut g = [[0.0; W]; 6];
        moments(EARLY, &self.z[0], &mut g);
        let (mut early, mut changed) = ([[0.0; W]; 3], [0.0; W]);
        let mut other = *path;
        for c in 0..3 {
            // what a start faster by 1 adds is −1/24 in the middle
            let faster = times(24.0, lack(&MIDDLE, half, path, c));
            for (control, share) in other.iter_mut().zip(FASTER) {
                control[c] = fma([share; W], faster, control[c]);
            }
            for l in 0..W {
                let way = faster[l] * self.rate(l) * self.moments[END][0][l];
                changed[l] = way.mul_add(way, changed[l]);
            }
            early[c] = self.way(EARLY, &g, c);
        }
        let miss = plus(self.miss(&NEAR_START, &early, &other), changed);
        let mut better = [0; W];
        for l in 0..W {
            better[l] = mask((off[l] * scale[l] > MISSED) & (miss[l] < off[l]));
        }
        choose(off, &miss, &better);
        for (old, new) in path.iter_mut().zip(&other) {
            for c in 0..3 {
                choose(&mut old[c], &new[c], &better);
            }
        }
    }

    /// Control points of the spin, from its values at the points.
    #[inline(always)]
    fn twist(&self, spins: [&Lanes3<W>; 4], out: &mut Step<W>) {
        let mut turned = [[[0.0; W]; 3]; 4];
        for node in 0..4 {
            for c in 0..3 {
                for l in 0..W {
                    turned[node][c][l] = spins[node][c][l] - self.start.spin[c][l];
                }
            }
        }
        let mut powers = [[[0.0; W]; 3]; 4];
        polynomial(&QUARTIC, &turned, &mut powers);
        for c in 0..3 {
            let [one, two, three] = [powers[0][c], powers[1][c], powers[2][c]];
            let second = fma([1.0 / 6.0; W], two, times(0.5, one));
            let third = fma([0.25; W], three, fma([0.5; W], two, times(0.75, one)));
            set(&mut out.twist, c, [times(0.25, one), second, third, turned[3][c]]);
        }
    }

    #[inline(always)]
    fn spin_error(&self, before: &Motion<W>, end: &Motion<W>, out: &Step<W>, tolerance: f64) -> Lanes<W> {
        let mut g = [[0.0; W]; 6];
        moments(EARLY, &self.z[1], &mut g);
        let mut relaxed = [[0.0; W]; 3];
        let mut sum = [0.0; W];
        // Bernstein's polynomials of degree four at ⅛
        const SHARES: [f64; 4] = [1372.0 / 4096.0, 294.0 / 4096.0, 28.0 / 4096.0, 1.0 / 4096.0];
        for c in 0..3 {
            relaxed[c] = product(self.spin_moments[END][0], self.turn[c]);
            let mut shown = [0.0; W];
            for (share, point) in SHARES.iter().zip(&out.twist) {
                shown = fma([*share; W], point[c], shown);
            }
            let turned = self.turned(&g, c);
            for l in 0..W {
                let (round, path) = (end.spin[c][l] - before.spin[c][l], shown[l] - turned[l]);
                sum[l] = round.mul_add(round, path.mul_add(path, sum[l]));
            }
        }
        over(sum, [&self.start.spin, &end.spin, &relaxed], tolerance)
    }
}

/// A polynomial's power cᵏ⁻¹ has the weight gₖ/k in the position.
const OVER: [f64; 6] = [0.0, 1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0];

/// Coefficients of the polynomial through values at the points.
#[inline(always)]
fn polynomial<const W: usize>(through: &[[f64; 4]; 4], values: &[Lanes3<W>; 4], out: &mut [Lanes3<W>; 4]) {
    for c in 0..3 {
        for k in 0..4 {
            let mut sum = [0.0; W];
            for node in 0..4 {
                sum = fma([through[node][k]; W], values[node][c], sum);
            }
            out[k][c] = sum;
        }
    }
}

/// Control points 1 to 5 of a path with velocities `v` at the ends that is `[early, late, change]` from its start at ¼, ¾ and 1.
#[inline(always)]
fn quintic<const W: usize>(h: Lanes<W>, v: [Lanes<W>; 2], [early, late, change]: [Lanes<W>; 3]) -> [Lanes<W>; 5] {
    let first = product(times(0.2, h), v[0]);
    let fourth = fma(times(-0.2, h), v[1], change);
    let (mut second, mut third) = ([0.0; W], [0.0; W]);
    for l in 0..W {
        // 1024 times what Bernstein's polynomials leave at ¼ and ¾ for the two in the middle
        let near = 405.0f64.mul_add(first[l], 15.0f64.mul_add(fourth[l], change[l]));
        let far = 15.0f64.mul_add(first[l], 405.0f64.mul_add(fourth[l], 243.0 * change[l]));
        let (near, far) = (1024.0f64.mul_add(early[l], -near), 1024.0f64.mul_add(late[l], -far));
        second[l] = 3.0f64.mul_add(near, -far) * (1.0 / 720.0);
        third[l] = 3.0f64.mul_add(far, -near) * (1.0 / 720.0);
    }
    [first, second, third, fourth, change]
}

/// One component of how far a path is from a point.
#[inline(always)]
fn lack<const W: usize>(shares: &[f64; 5], point: &Lanes3<W>, path: &[Lanes3<W>; 5], c: usize) -> Lanes<W> {
    let mut there = times(-1.0, point[c]);
    for (share, control) in shares.iter().zip(path) {
        there = fma([*share; W], control[c], there);
    }
    there
}

/// Bernstein's polynomials of degree five, 1 to 5, at ½ and at ⅛.
const MIDDLE: [f64; 5] = [5.0 / 32.0, 10.0 / 32.0, 10.0 / 32.0, 5.0 / 32.0, 1.0 / 32.0];
const NEAR_START: [f64; 5] = [12005.0 / 32768.0, 3430.0 / 32768.0, 490.0 / 32768.0, 35.0 / 32768.0, 1.0 / 32768.0];
/// The quintic that starts with slope 1, is 0 at 0, ¼, ¾ and 1, and level there.
const FASTER: [f64; 5] = [1.0 / 5.0, -1.0 / 3.0, 1.0 / 10.0, 0.0, 0.0];
/// Square of the part of the tolerated error above which a path is one that misses its middle.
const MISSED: f64 = 0.25;

#[cfg(test)]
mod tests;
