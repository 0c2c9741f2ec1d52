//! What changes at random in flight: the eddy a sphere is in.
//!
//! An eddy drifts and ages with the place: a step is taken with the drift of the place that it starts from, and after it the eddy has the mean of
//! both ends'; the sphere gets what it would have of the difference, so that it need not relax to it.

use super::Walk;
use super::crew::{Crew, motion_of};
use super::lane::Lane;
use crate::domain::{Carry, Domain, Pieces};
use crate::flow::{Fluid, Local};
use crate::force::random_walk::Around;
use crate::force::{Eddy, Model, RandomWalk, Sphere, Surroundings};
use crate::random::{Purpose, Stream};
use crate::vector::{Vec3, add, norm, sub};
use carom::instructions::{Work, run_scalar};
use carom::math::{Fma, exp};

/// The present eddy and how many there were.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chance {
    /// The eddy at the lane's time.
    eddy: Eddy,
    /// What the lane's place does to it.
    place: Surroundings,
    /// When the sphere has crossed the eddy, s.
    crossed: f64,
    /// When the eddy must be looked at again, s.
    look: f64,
    eddies: u32,
}

impl Chance {
    /// Nothing drawn yet.
    pub const NONE: Self = Self {
        eddy: Eddy::NONE,
        place: Surroundings::CALM,
        crossed: f64::NEG_INFINITY,
        look: f64::NEG_INFINITY,
        eddies: 0,
    };

    /// The eddy in the middle of a step.
    pub fn midway(&self, step: f64) -> Eddy {
        self.eddy.middle(&self.place, step)
    }

    /// Turns what is drawn with the space.
    pub fn carry(&mut self, carry: &Carry) {
        self.eddy.deviates = carry.vector(self.eddy.deviates);
        self.place.drift = carry.vector(self.place.drift);
    }

    /// The next change, s.
    #[inline(always)]
    pub fn next(&self) -> f64 {
        self.look
    }
}

impl<D: Domain> Walk<'_, D> {
    /// Whether anything changes at random in flight.
    #[inline(always)]
    pub(super) fn has_chance(&self) -> bool {
        self.dynamics.random_walk.is_some() || self.dynamics.brownian
    }

    /// The fluid's properties at a place: the run's, unless the flow gives its state there.
    #[inline(always)]
    pub(super) fn properties(&self, here: D::Here, time: f64, x: Vec3) -> Fluid {
        if self.domain.varies_gas() {
            self.dynamics.fluid_at(&self.domain.fluid(here, time, x))
        } else {
            self.dynamics.fluid
        }
    }

    /// Whether eddies change during their lives.
    #[inline(always)]
    pub(super) fn drifts(&self) -> bool {
        self.dynamics.random_walk.is_some_and(|walk| walk.drift)
    }

    /// Whether they do so within a step. Steps of spheres that molecules kick take the eddy of their middle.
    #[inline(always)]
    pub(super) fn leans(&self) -> bool {
        self.drifts() && !self.dynamics.brownian
    }

    /// Lets a lane's deviates drift with the time from here on: a fluctuation that jumped from step to step would hold the steps down to
    /// what the drag allows.
    pub(super) fn lean<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize) {
        let chance = &crew.lanes[l].chance;
        (crew.bodies.eddy[l], crew.bodies.since[l]) = (Some(chance.eddy), crew.time[l]);
        for c in 0..3 {
            crew.bodies.drift[c][l] = chance.place.drift[c];
        }
        crew.stale[l] = true;
    }

    /// As [`Walk::renew`] after a step in flight. The drift is now known to differ by the end of the step from what the step took it for: the
    /// sphere gets what it would have of that, and has that much less to relax.
    pub(super) fn renew_in_flight<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, step: f64) {
        let Some(walk) = self.dynamics.random_walk.as_ref().filter(|_| self.leans()) else {
            self.renew(crew, l, step);
            return;
        };
        let age = crew.time[l] - crew.bodies.since[l];
        let taken = crew.bodies.eddy[l].unwrap_or(Eddy::NONE).deviates;
        let taken = [0, 1, 2].map(|c| crew.bodies.drift[c][l].mul_add(age, taken[c]));
        if self.renew(crew, l, step) {
            return;
        }
        let missing = sub(crew.lanes[l].chance.eddy.deviates, taken);
        let z = step * crew.rates.drag[l];
        // the drift changed evenly over the step, what is missing grew with the square of the time: v' = β (u − v) of that
        let share = if z > 0.01 { 1.0 - 2.0 / z + 2.0 * (1.0 - exp(-z)) / (z * z) } else { z / 3.0 - z * z / 12.0 };
        let (x, _, _) = motion_of(&crew.motion, l);
        let nu = self.properties(crew.here.get(l), crew.time[l], x).kinematic_viscosity();
        let fluid = Near { domain: self.domain, piece: crew.here.get(l), time: crew.time[l] };
        let (_, change) = run_scalar(Fluctuation { walk, fluid, x, nu, deviates: missing });
        for (v, change) in crew.motion.v.iter_mut().zip(change) {
            v[l] = share.mul_add(change, v[l]);
        }
    }

    /// Brings chance up to a lane's time and place, `step` after it last was, draws what is due, and says when to stop next. Whether
    /// another eddy was met.
    pub(super) fn renew<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, step: f64) -> bool {
        let mut changed = false;
        match &self.dynamics.random_walk {
            Some(walk) => {
                let (x, v, _) = motion_of(&crew.motion, l);
                let place = (crew.here.get(l), crew.time[l], x);
                changed = self.renew_eddy(walk, &mut crew.lanes[l], place, v, step);
                if changed {
                    crew.bodies.eddy[l] = Some(crew.lanes[l].chance.eddy);
                }
            }
            None => crew.lanes[l].chance.look = f64::INFINITY,
        }
        crew.stale[l] |= changed;
        if changed {
            self.begin_anew(crew, l);
        }
        if self.leans() {
            self.lean(crew, l);
        }
        let (time, next) = (crew.time[l], crew.lanes[l].chance.next());
        crew.stop[l] = if next > time { self.settings.until.min(next) } else { self.settings.until };
        changed
    }

    /// Ages the eddy of a sphere that is at a place with velocity `v` (m/s), after a step (s); whether another one was met.
    fn renew_eddy(
        &self,
        walk: &RandomWalk,
        lane: &mut Lane,
        (piece, time, x): (D::Here, f64, Vec3),
        v: Vec3,
        step: f64,
    ) -> bool {
        let properties = self.properties(piece, time, x);
        let nu = properties.kinematic_viscosity();
        let sphere = Sphere { diameter: lane.particle.diameter, density: lane.particle.density };
        let tau = self.dynamics.relaxation_time_in(&properties, &sphere);
        let fluid = Near { domain: self.domain, piece, time };
        let here = || run_scalar(Surround { walk, fluid, x, nu, tau });
        let (number, chance) = (lane.particle.number, &mut lane.chance);
        // a plain walk's eddy lives as long as where it was met, once there is turbulence
        let place = if walk.drift || chance.place == Surroundings::CALM { here() } else { chance.place };
        chance.eddy = chance.eddy.after(&chance.place, &place, step);
        chance.place = place;
        let crossed = chance.crossed <= time;
        let over = crossed || chance.eddy.is_over();
        if over {
            if !walk.drift {
                chance.place = here();
            }
            let age = if crossed { 0.0 } else { chance.eddy.overdue() };
            let last = chance.eddy;
            chance.eddy = walk.next_eddy(&last, age, || {
                let mut draws = Stream::new(self.settings.seed, number, Purpose::Eddy, chance.eddies);
                chance.eddies = chance.eddies.wrapping_add(1);
                (chance.eddies == 1, draws.normals(), draws.open_uniform())
            });
            chance.crossed = f64::INFINITY;
            if walk.model == Model::Eddies {
                let (mean, gust) = run_scalar(Fluctuation { walk, fluid, x, nu, deviates: chance.eddy.deviates });
                chance.crossed = time + walk.crossing(chance.place.length, tau, norm(sub(add(mean, gust), v)));
            }
        }
        let longest =
            if walk.drift { chance.eddy.longest_step(&chance.place) } else { chance.eddy.rest(&chance.place) };
        chance.look = chance.crossed.min(time + longest);
        over
    }
}

/// The fluid of a domain at a time, in a piece of it.
struct Near<'a, D: Domain> {
    domain: &'a D,
    piece: D::Here,
    time: f64,
}

impl<D: Domain> Copy for Near<'_, D> {}

impl<D: Domain> Clone for Near<'_, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<D: Domain> Around for Near<'_, D> {
    #[inline(always)]
    fn at(&self, x: Vec3) -> Local {
        self.domain.fluid(self.piece, self.time, x)
    }
}

/// What a place does to an eddy; like the forces, compiled with and without a fused multiply-add.
struct Surround<'a, D: Domain> {
    walk: &'a RandomWalk,
    fluid: Near<'a, D>,
    x: Vec3,
    nu: f64,
    tau: f64,
}

impl<D: Domain> Work for Surround<'_, D> {
    type Output = Surroundings;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) -> Surroundings {
        self.walk.surroundings(self.fluid, self.x, self.nu, self.tau)
    }
}

/// The mean velocity and the fluctuation at a place.
struct Fluctuation<'a, D: Domain> {
    walk: &'a RandomWalk,
    fluid: Near<'a, D>,
    x: Vec3,
    nu: f64,
    deviates: Vec3,
}

impl<D: Domain> Work for Fluctuation<'_, D> {
    type Output = (Vec3, Vec3);

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) -> (Vec3, Vec3) {
        let local = self.fluid.at(self.x);
        (local.velocity, self.walk.fluctuation(self.deviates, &local, self.nu))
    }
}
