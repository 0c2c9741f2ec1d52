//! Small spheres without their noise: the velocity that the drag draws them to, w = u + g′/β, is sampled along the way, and its effect worked
//! out exactly for any step (`Relaxation`).
//!
//! w is taken at the start, at half the step on the way with w constant, and at its end on the way with w linear in time
//! (Kutta's nodes), then as the parabola through the three: third order in h, at βh ≫ 1 as at βh ≪ 1. The difference from the line
//! through the ends is the error that the tolerance judges.
//!
//! What chance has given the sphere of its velocity, θ, is gone after a relaxation time, and has by then carried it by θ/β. Steps longer than that
//! sample w along the way it is then on: along the true one w would change in no time at their start, which no parabola follows.

use super::{Diffusion, LONGEST, Leg, SMOOTH};
use crate::domain::{Domain, Pieces};
use crate::dynamics::Bodies;
use crate::force::brownian::Relaxation;
use crate::geometry::Path;
use crate::tracker::Walk;
use crate::tracker::crew::{Crew, column};
use crate::vector::{Vec3, add, dot, norm, scale, sub};
use carom::instructions::{Work, run_scalar};
use carom::math::Fma;

/// A sphere, its piece of the flow, and what the drag last drew it to.
pub(super) struct Drawn<'a, 'b, D: Domain> {
    walk: &'a Walk<'b, D>,
    here: D::Here,
    body: &'a Bodies<1>,
    rate: f64,
    slow: Vec3,
}

impl<D: Domain> Copy for Drawn<'_, '_, D> {}

impl<D: Domain> Clone for Drawn<'_, '_, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D: Domain> Drawn<'_, '_, D> {
    /// What the drag draws the sphere to at a time and place, m/s.
    #[inline(always)]
    fn to(&self, time: f64, x: Vec3) -> Vec3 {
        if self.walk.dynamics.is_plain(self.walk.domain) {
            let u = self.walk.domain.velocities(&D::Many::all(self.here), &[time], &x.map(|c| [c]));
            let weight = column(&self.body.weight, 0);
            [0, 1, 2].map(|c| u[c][0] + weight[c] / self.rate)
        } else {
            let a = self.walk.rates_at((self.here, time), self.body, x, self.slow, [0.0; 3]).a;
            [0, 1, 2].map(|c| self.slow[c] + a[c][0] / self.rate)
        }
    }
}

/// A step from `x` at velocity `v`.
struct Glide<'a, 'b, D: Domain> {
    drawn: Drawn<'a, 'b, D>,
    time: f64,
    x: Vec3,
    v: Vec3,
    /// What of `v` is by chance and so short-lived that the way is sampled after it, m/s.
    jitter: Vec3,
    drift: Vec3,
    h: f64,
}

/// Its end: change of place, velocity, what the drag draws to there, and the second difference of that along the way.
struct Glided {
    change: Vec3,
    v: Vec3,
    drift: Vec3,
    bend: Vec3,
    relaxation: Relaxation,
}

impl<D: Domain> Work for Glide<'_, '_, D> {
    type Output = Glided;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) -> Glided {
        let Self { drawn, time, x, v, jitter, drift, h } = self;
        let (x, v) = (add(x, scale(jitter, 1.0 / drawn.rate)), sub(v, jitter));
        // on the way with w = drift + a s + b s²
        let way = |r: &Relaxation, h: f64, a: Vec3, b: Vec3| {
            let [first, second, third, fourth] = r.phi.map(|p| p * h);
            let z = r.z;
            [0, 1, 2].map(|c| first * v[c] + z * (second * drift[c] + third * a[c] + 2.0 * fourth * b[c]))
        };
        let (half, whole) = (Relaxation::over(0.5 * drawn.rate * h), Relaxation::over(drawn.rate * h));
        let middle = drawn.to(time + 0.5 * h, add(x, way(&half, 0.5 * h, [0.0; 3], [0.0; 3])));
        let slope = scale(sub(middle, drift), 4.0);
        let last = drawn.to(time + h, add(x, way(&whole, h, slope, [0.0; 3])));
        let bend = [0, 1, 2].map(|c| 2.0 * drift[c] - 4.0 * middle[c] + 2.0 * last[c]);
        let slope = sub(sub(last, drift), bend);
        let [first, second, third, _] = whole.phi;
        let end = [0, 1, 2].map(|c| {
            whole.decay * (v[c] + jitter[c]) + whole.z * (first * drift[c] + second * slope[c] + 2.0 * third * bend[c])
        });
        let change = add(way(&whole, h, slope, bend), scale(jitter, first * h));
        Glided { change, v: end, drift: last, bend, relaxation: whole }
    }
}

/// What the drag draws to at a place.
struct At<'a, 'b, D: Domain>(Drawn<'a, 'b, D>, f64, Vec3);

impl<D: Domain> Work for At<'_, '_, D> {
    type Output = Vec3;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) -> Vec3 {
        self.0.to(self.1, self.2)
    }
}

impl<D: Domain> Walk<'_, D> {
    fn drawn<'a, const W: usize>(
        &'a self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        body: &'a Bodies<1>,
        slow: Vec3,
    ) -> Drawn<'a, 'a, D> {
        Drawn { walk: self, here: crew.here.get(l), body, rate: crew.lanes[l].diffusion.rate, slow }
    }

    /// What the drag draws a lane's sphere to where its present jitter will have carried it, m/s.
    pub(super) fn drift_here<const W: usize>(&self, crew: &Crew<W, D::Many<W>>, l: usize, body: &Bodies<1>) -> Vec3 {
        let diffusion = &crew.lanes[l].diffusion;
        let x = add(column(&crew.motion.x, l), scale(diffusion.jitter, 1.0 / diffusion.rate));
        let at = |slow| run_scalar(At(self.drawn(crew, l, body, slow), crew.time[l], x));
        let first = at(crew.lanes[l].diffusion.slow);
        // lifts and drag go with the slip: once more with that of here
        if self.dynamics.is_plain(self.domain) { first } else { at(first) }
    }

    /// How that changes over a displacement `by` from the end `change` of a lane's step, m/s.
    pub(super) fn change_of_drift<const W: usize>(
        &self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        body: &Bodies<1>,
        change: Vec3,
        by: Vec3,
    ) -> Vec3 {
        if self.domain.is_uniform() {
            return [0.0; 3];
        }
        let x = add(column(&crew.motion.x, l), change);
        let drawn = self.drawn(crew, l, body, crew.lanes[l].diffusion.slow);
        let time = crew.time[l];
        // on whichever side of an edge they are
        let here = |x| if self.domain.is_one_piece() { drawn.here } else { self.domain.enter(time, x) };
        let at = |x| run_scalar(At(Drawn { here: here(x), ..drawn }, time, x));
        sub(at(add(x, by)), at(x))
    }

    /// A step of `h` (s) of a sphere that the drag draws to `drift`, without noise; `None` if it must be shorter.
    pub(super) fn glide<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        body: &Bodies<1>,
        drift: Vec3,
        h: f64,
    ) -> Option<Leg<D::Here>> {
        let (x, v, time) = (column(&crew.motion.x, l), column(&crew.motion.v, l), crew.time[l]);
        crew.h[l] = h;
        let mut leant = *body;
        if self.drifts() {
            leant.eddy = [Some(crew.lanes[l].chance.midway(h))];
        }
        let drawn = self.drawn(crew, l, &leant, drift);
        let diffusion = &mut crew.lanes[l].diffusion;
        let jitter = if diffusion.rate * h > LASTING { diffusion.jitter } else { [0.0; 3] };
        let begin = add(x, scale(jitter, 1.0 / diffusion.rate));
        let here = self.drifts() || diffusion.rate * h <= LASTING;
        let drift = if here { run_scalar(At(drawn, time, begin)) } else { drift };
        let end = run_scalar(Glide { drawn, time, x, v, jitter, drift, h });
        let factor = growth(self.error_squared(diffusion, v, drift, &end, h));
        if factor < ACCEPTED {
            diffusion.next = h * factor;
            return None;
        }
        let next = (h * factor).min(LONGEST);
        diffusion.next = if next < diffusion.next && factor >= 1.0 { diffusion.next } else { next };
        diffusion.slow = end.drift;
        let smooth = diffusion.rate * h < SMOOTH;
        let path = if smooth {
            let kick = |w: Vec3, v: Vec3| scale(sub(w, v), diffusion.rate * h * h);
            Path { start: x, points: quintic(h, [v, end.v], [kick(drift, v), kick(end.drift, end.v)], end.change) }
        } else {
            Path::straight(x, end.change)
        };
        let relaxation = end.relaxation;
        Some(Leg { h, relaxation, path, v: end.v, twist: [[0.0; 3]; 4], into: None, carry: None, smooth })
    }

    /// Square of the error of a step over the tolerated one: of the place against the way gone, of the velocity against its size, and of
    /// both against a small part of their noise.
    fn error_squared(&self, diffusion: &Diffusion, v: Vec3, drift: Vec3, end: &Glided, h: f64) -> f64 {
        let Relaxation { z, phi: [_, second, third, fourth], .. } = end.relaxation;
        let bend = norm(end.bend);
        let speed = norm(v).max(norm(drift)).max(norm(end.drift));
        let noise = NOISE * diffusion.thermal * (2.0 * z).sqrt();
        let tolerance = self.per_step();
        let spread = noise * z / ((3.0 + z) * diffusion.rate);
        let place = z * h * bend * (third - 2.0 * fourth) / (tolerance * speed * h + spread);
        let velocity = z * bend * (second - 2.0 * third) / (tolerance * speed + noise);
        dot([place, velocity, 0.0], [place, velocity, 0.0])
    }
}

/// Steps over the relaxation time beyond which jitter does not last.
const LASTING: f64 = 1.0;
/// Share of a step's noise that its error may be besides the tolerance: far below what any number of spheres shows.
const NOISE: f64 = 1e-5;
/// Growth below which a step is refused: where the error is the tolerated one.
const ACCEPTED: f64 = 0.9;

/// The factor for the next step: the error goes with the third power of the step.
fn growth(error_squared: f64) -> f64 {
    // what is not a number counts as large
    let square = if error_squared < 1e6 { error_squared.max(1e-6) } else { 1e6 };
    (ACCEPTED * carom::math::pow(square, -1.0 / 6.0)).clamp(0.1, 5.0)
}

/// Control points of the path with these velocities and accelerations times h² at its ends, that ends at `change`.
fn quintic(h: f64, v: [Vec3; 2], kick: [Vec3; 2], change: Vec3) -> [Vec3; 5] {
    let (away, back) = (scale(v[0], 0.2 * h), scale(v[1], 0.2 * h));
    let second = add(scale(away, 2.0), scale(kick[0], 0.05));
    let third = add(sub(change, scale(back, 2.0)), scale(kick[1], 0.05));
    [away, second, third, sub(change, back), change]
}
