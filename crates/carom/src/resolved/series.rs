//! The dimensionless contact as a Taylor series in σ: s (x = s²), U = dx/dt, and the integrals that ride along.

/// Order of the series.
pub(super) const ORDER: usize = 20;
/// Relative size of what a step may leave out.
const TOLERANCE: f64 = 1e-11;
/// No contact needs nearly as many; more means numbers far outside any impact.
const MOST_STEPS: usize = 400;

/// Dimensionless parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
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
    /// ∫ X^{3/2} dτ.
    pub hertz_impulse: f64,
    /// Work of Hertzian damping.
    pub hertz_work: f64,
    /// Work of adhesion damping.
    pub adhesion_work: f64,
    /// Speed at the end (negative: leaving), a check on the energy balance.
    #[cfg_attr(not(test), allow(dead_code))]
    pub end_speed: f64,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct State {
    pub s: f64,
    pub u: f64,
    pub time: f64,
    pub impulse: f64,
    pub hertz_work: f64,
    pub adhesion_work: f64,
}

type Series = [f64; ORDER + 1];

/// Coefficients of one step, in powers of σ from the step's beginning.
pub(super) struct Expansion {
    pub s: Series,
    pub u: Series,
    time: Series,
    impulse: Series,
    hertz_work: Series,
    adhesion_work: Series,
}

#[inline(always)]
fn horner(c: &Series, x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum: f64, &a| sum.mul_add(x, a))
}

#[inline(always)]
fn slope(c: &Series, x: f64) -> f64 {
    let mut sum = 0.0f64;
    for k in (1..=ORDER).rev() {
        sum = sum.mul_add(x, k as f64 * c[k]);
    }
    sum
}

/// A series with its mirror image, so that the sum of a product runs along both in the same direction, four at a time.
struct Mirrored {
    forward: [f64; PADDED],
    backward: [f64; 2 * PADDED],
}

const PADDED: usize = (ORDER + 1).next_multiple_of(4);

impl Mirrored {
    #[inline(always)]
    fn new() -> Self {
        Self { forward: [0.0; PADDED], backward: [0.0; 2 * PADDED] }
    }

    #[inline(always)]
    fn set(&mut self, k: usize, value: f64) {
        self.forward[k] = value;
        self.backward[PADDED - k] = value;
    }

    /// k-th coefficient of the product with `other`; later coefficients of both are still zero.
    #[inline(always)]
    fn times(&self, other: &Self, k: usize) -> f64 {
        let start = PADDED - k;
        let mut sums = [0.0f64; 4];
        for j in (0..=k).step_by(4) {
            for lane in 0..4 {
                sums[lane] = self.forward[j + lane].mul_add(other.backward[start + j + lane], sums[lane]);
            }
        }
        (sums[0] + sums[2]) + (sums[1] + sums[3])
    }
}

impl Expansion {
    #[inline(always)]
    fn new(from: &State, contact: &Contact, adhesive: bool) -> Self {
        let zero = [0.0; ORDER + 1];
        let mut e = Self { s: zero, u: zero, time: zero, impulse: zero, hertz_work: zero, adhesion_work: zero };
        (e.time[0], e.impulse[0]) = (from.time, from.impulse);
        (e.hertz_work[0], e.adhesion_work[0]) = (from.hertz_work, from.adhesion_work);
        let (mut s, mut u) = (Mirrored::new(), Mirrored::new());
        // p = x, q = x², and both times the speed
        let (mut p, mut q, mut pu, mut qu) = (Mirrored::new(), Mirrored::new(), Mirrored::new(), Mirrored::new());
        s.set(0, from.s);
        u.set(0, from.u);
        let a = if adhesive { contact.adhesion } else { 0.0 };
        let (ch, aca) = (contact.hertz_damping, a * contact.adhesion_damping);
        for k in 0..ORDER {
            let next = RECIPROCAL[k];
            p.set(k, s.times(&s, k));
            q.set(k, p.times(&p, k));
            let mut force = a.mul_add(p.forward[k], -q.forward[k]);
            if ch != 0.0 {
                qu.set(k, q.times(&u, k));
                force = (-ch).mul_add(qu.forward[k], force);
                e.hertz_work[k + 1] = 2.0 * ch * qu.times(&u, k) * next;
            }
            if aca != 0.0 {
                pu.set(k, p.times(&u, k));
                force = (-aca).mul_add(pu.forward[k], force);
                e.adhesion_work[k + 1] = 2.0 * aca * pu.times(&u, k) * next;
            }
            s.set(k + 1, u.forward[k] * next);
            u.set(k + 1, 2.0 * force * next);
            e.time[k + 1] = 2.0 * s.forward[k] * next;
            e.impulse[k + 1] = 2.0 * q.forward[k] * next;
        }
        e.s.copy_from_slice(&s.forward[..=ORDER]);
        e.u.copy_from_slice(&u.forward[..=ORDER]);
        e
    }

    /// Step that leaves out less than the tolerance, from the last two coefficients.
    #[inline(always)]
    fn step(&self) -> f64 {
        // U and s move on the scale of their greatest values nearby
        let u = self.u[0].abs().max(self.u[1].abs() * 0.25).max(f64::MIN_POSITIVE);
        let s = self.s[0].abs().max(self.s[1].abs() * 0.25).max(f64::MIN_POSITIVE);
        let size = |k: usize| (self.u[k].abs() / u).max(self.s[k].abs() / s).max(f64::MIN_POSITIVE);
        let root = |x: f64, n: f64| crate::math::exp(crate::math::ln(TOLERANCE / x) / n);
        0.9 * root(size(ORDER), ORDER as f64).min(root(size(ORDER - 1), (ORDER - 1) as f64))
    }

    #[inline(always)]
    pub fn at(&self, x: f64) -> State {
        State {
            s: horner(&self.s, x),
            u: horner(&self.u, x),
            time: horner(&self.time, x),
            impulse: horner(&self.impulse, x),
            hertz_work: horner(&self.hertz_work, x),
            adhesion_work: horner(&self.adhesion_work, x),
        }
    }
}

/// 1/(k + 1).
const RECIPROCAL: [f64; ORDER] = {
    let mut table = [0.0; ORDER];
    let mut k = 0;
    while k < ORDER {
        table[k] = 1.0 / (k + 1) as f64;
        k += 1;
    }
    table
};

/// Where a series that has another sign at `h` than at 0 crosses zero: Newton's iteration kept inside a shrinking bracket.
#[inline(always)]
fn crossing(c: &Series, h: f64) -> f64 {
    let (mut low, mut high) = (0.0, h);
    let end = horner(c, h);
    let mut x = h * c[0] / (c[0] - end);
    for _ in 0..60 {
        let f = horner(c, x);
        if (f > 0.0) == (end > 0.0) {
            high = x
        } else {
            low = x
        }
        let newton = x - f / slope(c, x);
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 2.0 * f64::EPSILON * h {
            return next;
        }
        x = next;
    }
    x
}

impl Contact {
    /// Follows the contact to its end; `watch` sees every step's expansion and length.
    #[inline(always)]
    pub(super) fn solve(&self, watch: &mut impl FnMut(&Expansion, f64)) -> Motion {
        let mut state = State { s: 0.0, u: 1.0, time: 0.0, impulse: 0.0, hertz_work: 0.0, adhesion_work: 0.0 };
        let mut motion = Motion::default();
        let mut separating = false;
        for _ in 0..MOST_STEPS {
            let expansion = Expansion::new(&state, self, self.reversible || separating);
            let h = expansion.step();
            let end = expansion.at(h);
            if !separating {
                if end.u > 0.0 {
                    watch(&expansion, h);
                    state = end;
                    continue;
                }
                let x = crossing(&expansion.u, h);
                watch(&expansion, x);
                state = State { u: 0.0, ..expansion.at(x) };
                motion.deepest = state.s;
                separating = true;
                // net force inward where it turns: it never separates
                if self.adhesion >= state.s * state.s {
                    return self.finish(motion, &state, true);
                }
                continue;
            }
            // leaving (s = 0) and turning back (U = 0 again) may both lie in the step: the first one counts
            let leave = if end.s <= 0.0 { crossing(&expansion.s, h) } else { f64::INFINITY };
            let limit = leave.min(h);
            let turned = horner(&expansion.u, limit) >= 0.0;
            if turned {
                // U starts at or below zero and falls first (the net force is outward at the start of the step)
                watch(&expansion, limit);
                return self.finish(motion, &expansion.at(limit), true);
            }
            watch(&expansion, limit);
            if leave <= h {
                return self.finish(motion, &expansion.at(leave), false);
            }
            state = end;
        }
        self.finish(motion, &state, true)
    }

    #[inline(always)]
    fn finish(&self, motion: Motion, at: &State, captured: bool) -> Motion {
        Motion {
            captured,
            hertz_impulse: at.impulse,
            hertz_work: at.hertz_work,
            adhesion_work: at.adhesion_work,
            end_speed: at.u,
            ..motion
        }
    }
}
