//! Steps of Brownian spheres: their motion without noise, and on it the noise of the whole step, exact in distribution (`force/brownian.rs`).
//!
//! **Without noise.** A small sphere has forgotten its velocity long before the flow around it changes. `glide.rs` follows it through the
//! velocity w that the drag draws it to, in steps that do not know the relaxation time. A sphere that is thrown, spins up or has a drag that
//! is not linear takes the steps of all others (`thrown.rs`). Both keep to the run's tolerance by an error estimate of the motion without
//! noise, made before anything is drawn: a step refused for what was drawn would favour some draws.
//!
//! **Noise in a flow that differs from place to place.** The noise X of the place, of variance σ² a component, leads through w of other places
//! during the step: the way gains (2/3) h (w(x + ¾X + (√3/4) σζ) − w(x)), ζ three more standard normal deviates. That has the mean that
//! the curvature of w gives it, and in an even shear the exact variance and covariance (the nodes of Rößler's method SRA1: 2010, SIAM J. Numer. Anal.
//! 48, 922, doi:10.1137/09076636X), however long the step.
//!
//! **Walls.** A step is so short that a wall is touched by chance during it in one of two million at most ([`SIGMAS`] standard deviations), or else
//! shorter than half a relaxation time, where the path is smooth enough to be searched for its first contact like any other. Within half a stopping distance
//! λ = √(k_B T/m)/β of a wall, steps are a fifth of the gap over the thermal speed, down to τ/50: impacts happen at the sphere's
//! own velocity, and the wall's law decides. What a step that long leaves out, the turns within the last fiftieth of a relaxation time, takes
//! less than a hundredth off the mean square of the speed of impact. A long step that does end behind a wall is drawn again, shorter.
//!
//! **Edges of the flow.** A glide ends about at the edge that its drift leads to, and by chance spreads over half a piece at most; it begins
//! again in the piece it has come to. Noise sees the fluid on whichever side of an edge it leads to. Thrown spheres stop exactly at edges.
//! Where the space goes on elsewhere, beyond mirrors and cyclic patches, so does the step (`across.rs`).

mod across;
mod glide;
mod thrown;

use super::Walk;
use super::crew::{Crew, column, motion_of};
use super::lane;
use super::walk::{LEAST_SHARE, finish, least_step, lose};
use crate::domain::{BEYOND, Carry, Domain, Pieces};
use crate::dynamics::Bodies;
use crate::force::brownian::{Relaxation, Spread, thermal_speed};
use crate::force::{Drag, reynolds};
use crate::geometry::{Hit, Nearness, Path, Wandering};
use crate::random::{Purpose, Stream};
use crate::record::{ParticleFate, Sink};
use crate::vector::{Vec3, add, dot, norm, scale, sub};

/// Standard deviations of the noise that a long step stays off all walls by.
const SIGMAS: f64 = 5.0;
/// Steps over the relaxation time below which the path within one is smooth.
const SMOOTH: f64 = 0.5;
/// Shortest steps at a wall, over the relaxation time.
const SHORTEST: f64 = 0.02;
/// Share of the gap that the thermal speed covers in a short step near a wall.
const APPROACH: f64 = 0.2;
/// Velocities that chance gives, over the thermal speed: beyond, the sphere was thrown.
const THROWN: f64 = 8.0;
/// Longest step, s.
const LONGEST: f64 = 1e6;

/// How a lane's sphere diffuses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Diffusion {
    /// Rate of the drag on its slow motion, β, 1/s.
    rate: f64,
    /// √(k_B T/m), m/s.
    thermal: f64,
    /// What the drag last drew it to, m/s.
    slow: Vec3,
    /// What of its velocity is by chance, m/s.
    jitter: Vec3,
    /// The glide to try next, s.
    next: f64,
    /// How often it drew.
    draws: u32,
    /// Whether its drag is linear and its spin of no account.
    glides: bool,
}

impl Diffusion {
    /// Of no sphere.
    pub const NONE: Self =
        Self { rate: 1.0, thermal: 0.0, slow: [0.0; 3], jitter: [0.0; 3], next: 0.0, draws: 0, glides: false };

    /// D, m²/s.
    fn diffusivity(&self) -> f64 {
        self.thermal * self.thermal / self.rate
    }
}

/// A step under way: without noise first, then with it.
struct Leg<H> {
    h: f64,
    relaxation: Relaxation,
    path: Path,
    v: Vec3,
    /// Control points of the change of spin.
    twist: [Vec3; 4],
    /// The piece that it ends in or at the edge of, where that is known.
    into: Option<H>,
    /// How it goes on elsewhere from its end.
    carry: Option<Carry>,
    /// Whether the path is what the sphere goes along, and not only its ends are.
    smooth: bool,
}

impl<D: Domain> Walk<'_, D> {
    /// How a sphere diffuses.
    pub(super) fn diffusion<const W: usize>(&self, crew: &Crew<W, D::Many<W>>, l: usize) -> Diffusion {
        let body = crew.bodies.one(l);
        let forces = &self.dynamics.forces;
        let sphere = body.sphere[0];
        let fluid = &self.dynamics.fluid;
        let weight = norm(column(&body.weight, 0));
        // the drag where weight and drag are in balance
        let balance = |f: f64| forces.drag.factor(reynolds(fluid, sphere.diameter, weight / (f * body.drag_rate[0])));
        let factor = (0..8).fold(1.0, |f, _| balance(f));
        // the fluid that goes along
        let mass = if forces.added_mass { 1.0 + 0.5 * fluid.density / sphere.density } else { 1.0 };
        let rate = body.drag_rate[0] * factor / mass;
        let slow = self.domain.fluid(crew.here.get(l), crew.time[l], motion_of(&crew.motion, l).0).velocity;
        let thermal = if forces.drag == Drag::None { 0.0 } else { thermal_speed(fluid, &sphere) / mass.sqrt() };
        let glides = factor < LINEAR && thermal > 0.0 && !self.dynamics.spins();
        Diffusion { rate, thermal, slow, jitter: [0.0; 3], next: 1.0 / rate, draws: 0, glides }
    }

    /// One trial step of a lane.
    pub(super) fn diffuse<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, sink: &mut dyn Sink) {
        crew.steps[l] += 1;
        if crew.steps[l] > self.settings.max_steps {
            sink.stalled();
            finish(crew, l, ParticleFate::Airborne, None, sink);
            return;
        }
        let body = crew.bodies.one(l);
        let v = column(&crew.motion.v, l);
        let diffusion = crew.lanes[l].diffusion;
        let drift = if diffusion.glides { self.drift_here(crew, l, &body) } else { [0.0; 3] };
        let glides = diffusion.glides && norm(sub(v, drift)) <= THROWN * diffusion.thermal;
        let (tried, gap) = if glides {
            let way =
                Wandering { offset: scale(sub(v, drift), 1.0 / diffusion.rate), drift, ..self.scatter(&diffusion) };
            let (h, gap) = self.length(crew, l, (diffusion.next, drift), way);
            (self.glide(crew, l, &body, drift, h), gap)
        } else {
            // its own motion may lead to a wall that chance does not: always looked for
            let (h, _) = self.length(crew, l, (crew.next[l], v), self.scatter(&diffusion));
            (self.fly(crew, l, &body, h), 0.0)
        };
        if let Some(mut leg) = tried {
            self.agitate(crew, l, &body, &mut leg);
            if self.domain.goes_on() && leg.into.is_none() {
                return self.unfold(crew, l, leg, sink);
            }
            let way = leg.path.points.iter().fold(0.0f64, |m, p| m.max(dot(*p, *p)));
            let hit = if way < gap * gap { None } else { self.domain.walls().first(&leg.path, body.radius[0]) };
            self.end_leg(crew, l, leg, hit, sink);
        }
    }

    fn scatter(&self, diffusion: &Diffusion) -> Wandering {
        let spread = SIGMAS * (2.0 * diffusion.diffusivity()).sqrt();
        Wandering { offset: [0.0; 3], drift: [0.0; 3], spread, longest: f64::INFINITY }
    }

    /// How long a step may be that the tolerance allows `next` (s) and whose mean motion is at `mean` (m/s); how near the walls are, m.
    fn length<const W: usize>(
        &self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        (next, mean): (f64, Vec3),
        way: Wandering,
    ) -> (f64, f64) {
        let (x, here) = (column(&crew.motion.x, l), crew.here.get(l));
        let diffusion = &crew.lanes[l].diffusion;
        let tau = 1.0 / diffusion.rate;
        let mut longest = next.min(crew.stop[l] - crew.time[l]);
        let least = least_step(crew.time[l]);
        if !self.domain.is_one_piece() {
            let room = 0.5 * self.domain.room(here, x);
            let spreads = (room * room / (2.0 * diffusion.diffusivity())).max(SHORTEST * tau);
            let edge = self.domain.longest(here, x, mean) / BEYOND;
            longest = longest.min(edge.max(least.max(LEAST_SHARE * next))).min(spreads);
        }
        if diffusion.thermal == 0.0 {
            return (longest.max(least), 0.0);
        }
        let near = self.nearness(x, crew.bodies.radius[l], Wandering { longest, ..way });
        if near.clear >= SMOOTH * tau || near.clear >= longest {
            return (longest.min(near.clear).max(least), near.gap);
        }
        let short = (APPROACH * near.gap * diffusion.rate / diffusion.thermal).clamp(SHORTEST, SMOOTH);
        (longest.min(short * tau).max(least), near.gap)
    }

    /// What is near, on this side and behind cyclic patches.
    fn nearness(&self, x: Vec3, radius: f64, way: Wandering) -> Nearness {
        let walls = self.domain.walls();
        let mut near = walls.nearness(x, radius, &way);
        for shift in self.domain.shifts() {
            let way = Wandering { offset: shift.vector(way.offset), drift: shift.vector(way.drift), ..way };
            let there = walls.nearness(shift.point(x), radius, &way);
            near = Nearness { gap: near.gap.min(there.gap), clear: near.clear.min(there.clear) };
        }
        near
    }

    /// Adds the noise of a step to its motion without.
    fn agitate<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        body: &Bodies<1>,
        leg: &mut Leg<D::Here>,
    ) {
        let number = crew.lanes[l].particle.number;
        let diffusion = &mut crew.lanes[l].diffusion;
        if diffusion.thermal == 0.0 {
            return;
        }
        let (rate, thermal) = (diffusion.rate, diffusion.thermal);
        diffusion.jitter = scale(diffusion.jitter, leg.relaxation.decay);
        let mut draws = Stream::new(self.settings.seed, number, Purpose::Brownian, diffusion.draws);
        diffusion.draws = diffusion.draws.wrapping_add(1);
        let spread = Spread::of(&leg.relaxation);
        let (mut place, mut velocity) = ([0.0; 3], [0.0; 3]);
        for c in 0..3 {
            let (x, v) = spread.draw(draws.normal(), draws.normal());
            (place[c], velocity[c]) = (x * thermal / rate, v * thermal);
        }
        if leg.smooth {
            // the cubic that has both
            let kick = scale(velocity, leg.h);
            let (square, cube) = (sub(scale(place, 3.0), kick), sub(kick, scale(place, 2.0)));
            for (i, p) in leg.path.points.iter_mut().enumerate() {
                const SHARES: [(f64, f64); 5] = [(0.0, 0.0), (0.1, 0.0), (0.3, 0.1), (0.6, 0.4), (1.0, 1.0)];
                *p = add(*p, add(scale(square, SHARES[i].0), scale(cube, SHARES[i].1)));
            }
        } else {
            let [.., end] = leg.path.points;
            let sigma = 0.25 * 3f64.sqrt() * spread.total() * thermal / rate;
            let aside = [0, 1, 2].map(|c| 0.75 * place[c] + sigma * draws.normal());
            let change = self.change_of_drift(crew, l, body, end, aside);
            let Relaxation { z, phi: [_, second, third, _], .. } = leg.relaxation;
            leg.v = add(leg.v, scale(change, z * second));
            place = add(place, scale(change, 4.0 / 3.0 * z * third * leg.h));
            leg.path = Path::straight(leg.path.start, add(end, place));
        }
        leg.v = add(leg.v, velocity);
        let diffusion = &mut crew.lanes[l].diffusion;
        diffusion.jitter = add(diffusion.jitter, velocity);
    }

    /// Ends a step where it hits a wall, or takes all of it.
    fn end_leg<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        leg: Leg<D::Here>,
        hit: Option<Hit>,
        sink: &mut dyn Sink,
    ) {
        if hit.is_some() && !leg.smooth {
            // chance went through a wall: not in one of two million such steps
            crew.lanes[l].diffusion.next = leg.h / 8.0;
            return;
        }
        let (x, _, spin) = motion_of(&crew.motion, l);
        lay(crew, l, &leg);
        match hit {
            Some(hit) => {
                let v = scale(leg.path.slope(hit.meeting.theta), 1.0 / leg.h);
                self.reenter(crew, l, crew.time[l] + hit.meeting.theta * leg.h, hit.meeting.position, sink);
                self.meet(crew, l, &hit, v, sink);
                let v = column(&crew.motion.v, l);
                let diffusion = &mut crew.lanes[l].diffusion;
                let jitter = sub(v, diffusion.slow);
                let thrown = norm(jitter) > THROWN * diffusion.thermal;
                diffusion.jitter = if thrown { [0.0; 3] } else { jitter };
            }
            None => {
                let end = [add(x, leg.path.points[4]), leg.v, add(spin, leg.twist[3])];
                self.take_leg(crew, l, end, (leg.into, leg.carry), sink);
            }
        }
    }

    /// Takes the whole of a step, to position, velocity and spin at its end, and into a piece that may lie elsewhere.
    fn take_leg<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        [x, v, spin]: [Vec3; 3],
        (into, carry): (Option<D::Here>, Option<Carry>),
        sink: &mut dyn Sink,
    ) {
        let h = crew.h[l];
        if crew.lanes[l].trace {
            lane::trace(crew, l, 1.0, sink);
        }
        let (before, stop) = (crew.time[l], crew.stop[l]);
        let stopped = h >= stop - before;
        crew.time[l] = if stopped { stop } else { before + h };
        let lane = &mut crew.lanes[l];
        lane.standing = 0;
        lane.edges = if into.is_some() && crew.time[l] == before { lane.edges + 1 } else { 0 };
        super::meeting::put(crew, l, x, v, spin);
        if let Some(carry) = carry {
            self.carry(crew, l, &carry);
        }
        let left = crew.here.get(l);
        match into.filter(|piece| !self.domain.is_lost(*piece)) {
            Some(piece) => {
                crew.here.set(l, piece);
                self.stray(crew, l, sink);
            }
            None => self.reenter(crew, l, crew.time[l], column(&crew.motion.x, l), sink),
        }
        if self.domain.is_lost(crew.here.get(l)) {
            return lose(crew, l, self.domain.cell(left), sink);
        }
        if stopped && stop >= self.settings.until {
            finish(crew, l, ParticleFate::Airborne, None, sink);
        } else if self.dynamics.random_walk.is_some() {
            self.renew(crew, l, h);
        }
    }

    /// Puts a lane that glides into the piece it has come to.
    fn reenter<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        time: f64,
        x: Vec3,
        sink: &mut dyn Sink,
    ) {
        if !self.domain.is_one_piece() {
            crew.here.set(l, self.domain.enter(time, x));
            self.stray(crew, l, sink);
        }
    }
}

/// Makes a leg the step of a lane.
fn lay<const W: usize, P, H>(crew: &mut Crew<W, P>, l: usize, leg: &Leg<H>) {
    crew.h[l] = leg.h;
    for c in 0..3 {
        for (to, from) in crew.step.path.iter_mut().zip(&leg.path.points) {
            to[c][l] = from[c];
        }
        for (to, from) in crew.step.twist.iter_mut().zip(&leg.twist) {
            to[c][l] = from[c];
        }
    }
}

/// Largest drag factor f at rest in the balance of weight and drag that counts as linear.
const LINEAR: f64 = 1.05;
