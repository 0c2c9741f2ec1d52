//! One step of the equations of motion x″ = a(x, v, ω), ω′ = α(x, v, ω), with its error and its dense output.
//!
//! Dormand & Prince's embedded pair of orders 5 and 4 (1980, doi:10.1016/0771-050X(80)90013-3) with Shampine's
//! fourth-order interpolant as given by Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I* (1993),
//! II.6. Positions are eliminated from the stages (x′ = v), so a constant acceleration is integrated exactly whatever
//! the step. Everything is written for `W` particles side by side, each with its own step; no operation mixes two of
//! them, so a particle's bits do not depend on W or on its neighbours.

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

/// Σⱼ wⱼ kⱼ, skipping weights that are zero.
#[inline(always)]
fn weigh<const W: usize>(w: &[f64], k: &[Lanes3<W>], component: usize) -> Lanes<W> {
    let mut sum = [0.0; W];
    for (w, k) in w.iter().zip(k) {
        if *w != 0.0 {
            for l in 0..W {
                sum[l] = w.mul_add(k[component][l], sum[l]);
            }
        }
    }
    sum
}

/// What one step needs besides the motion.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// Tolerated error of a step, relative to the speed and to the distance gone.
    pub tolerance: f64,
    /// Whether spin changes in flight.
    pub spins: bool,
}

/// Tries a step of length `h` (s, one per particle) from `start`, whose rates are `first`.
///
/// `rates` fills in accelerations (and angular ones if `control.spins`) for a motion.
#[inline(always)]
pub fn step<const W: usize>(
    start: &Motion<W>,
    first: &Rates<W>,
    h: &Lanes<W>,
    control: Control,
    rates: &impl Fn(&Motion<W>, &mut Rates<W>),
    out: &mut Step<W>,
) {
    let mut k = [[[0.0; W]; 3]; STAGES];
    let mut kk = [[[0.0; W]; 3]; STAGES];
    k[0] = first.a;
    kk[0] = first.alpha;
    let mut at = *start;
    let mut now = *first;
    for stage in 1..STAGES {
        for c in 0..3 {
            let dv = weigh(&A[stage], &k[..stage.min(6)], c);
            let dx = weigh(&AA[stage], &k[..stage.min(6)], c);
            for l in 0..W {
                at.v[c][l] = h[l].mul_add(dv[l], start.v[c][l]);
                let inner = h[l].mul_add(dx[l], C[stage] * start.v[c][l]);
                at.x[c][l] = h[l].mul_add(inner, start.x[c][l]);
            }
            if control.spins {
                let dw = weigh(&A[stage], &kk[..stage.min(6)], c);
                for l in 0..W {
                    at.spin[c][l] = h[l].mul_add(dw[l], start.spin[c][l]);
                }
            }
        }
        rates(&at, &mut now);
        k[stage] = now.a;
        kk[stage] = now.alpha;
    }
    out.end = at;
    out.rates = now;
    controls(start, first, h, control, &k, &kk, out);
    out.error = error(start, h, control, &k, &kk, out);
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
    const SIXTH: f64 = 1.0 / 6.0;
    for c in 0..3 {
        let bend_x = weigh(&DA, &k[..6], c);
        let bend_v = weigh(&D, k, c);
        let whole_x = weigh(&AA[6], &k[..6], c);
        let whole_v = weigh(&A[6], &k[..6], c);
        for l in 0..W {
            let (h, v0, v1) = (h[l], start.v[c][l], out.end.v[c][l]);
            let dx = h * h.mul_add(whole_x[l], v0);
            out.path[0][c][l] = 0.25 * h * v0;
            out.path[1][c][l] = (h * SIXTH).mul_add(h.mul_add(bend_x[l], v0 - v1), 0.5 * dx);
            out.path[2][c][l] = (-0.25 * h).mul_add(v1, dx);
            out.path[3][c][l] = dx;
            let (a0, a1) = (first.a[c][l], out.rates.a[c][l]);
            let dv = h * whole_v[l];
            out.speed[0][c][l] = 0.25 * h * a0;
            out.speed[1][c][l] = (h * SIXTH).mul_add(a0 - a1 + bend_v[l], 0.5 * dv);
            out.speed[2][c][l] = (-0.25 * h).mul_add(a1, dv);
            out.speed[3][c][l] = dv;
        }
        if control.spins {
            let bend = weigh(&D, kk, c);
            let whole = weigh(&A[6], &kk[..6], c);
            for l in 0..W {
                let (h, a0, a1) = (h[l], first.alpha[c][l], out.rates.alpha[c][l]);
                let dw = h * whole[l];
                out.twist[0][c][l] = 0.25 * h * a0;
                out.twist[1][c][l] = (h * SIXTH).mul_add(a0 - a1 + bend[l], 0.5 * dw);
                out.twist[2][c][l] = (-0.25 * h).mul_add(a1, dw);
                out.twist[3][c][l] = dw;
            }
        }
    }
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
    let mut off = [0.0f64; W];
    let mut size = [f64::MIN_POSITIVE; W];
    let mut turn = [0.0f64; W];
    let mut turning = [f64::MIN_POSITIVE; W];
    for c in 0..3 {
        let ev = weigh(&E, k, c);
        let ex = weigh(&EA, &k[..6], c);
        for l in 0..W {
            off[l] = off[l].max((h[l] * ev[l]).abs()).max((h[l] * ex[l]).abs());
            let change = (h[l] * k[0][c][l]).abs();
            size[l] = size[l].max(start.v[c][l].abs().max(out.end.v[c][l].abs())).max(change);
        }
        if control.spins {
            let ew = weigh(&E, kk, c);
            for l in 0..W {
                turn[l] = turn[l].max((h[l] * ew[l]).abs());
                turning[l] = turning[l].max(start.spin[c][l].abs().max(out.end.spin[c][l].abs())).max((h[l] * kk[0][c][l]).abs());
            }
        }
    }
    let mut error = [0.0; W];
    for l in 0..W {
        error[l] = off[l] / (control.tolerance * size[l]);
        if control.spins {
            error[l] = error[l].max(turn[l] / (control.tolerance * turning[l]));
        }
    }
    error
}

/// The factor by which the next step may be longer (or must be shorter), for an error over the tolerated one.
#[inline(always)]
pub fn growth(error: f64) -> f64 {
    // 0.9 error^(−1/5), between a fifth and five
    let error = if error > 1e-4 { error } else { 1e-4 };
    let error = if error < 1e4 { error } else { 1e4 };
    let factor = 0.9 * carom::math::pow(error, -0.2);
    factor.clamp(0.2, 5.0)
}

#[cfg(test)]
mod tests;
