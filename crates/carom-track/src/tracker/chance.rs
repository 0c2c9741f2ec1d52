//! What changes at random in flight: the eddy a sphere is in.
//!
//! An eddy drifts and ages with the place: half
//! of a step's drift is added before the step, with the place it starts from, and the whole of it, with both ends, after.

use super::Walk;
use super::crew::{Crew, motion_of};
use super::lane::Lane;
use crate::domain::{Carry, Domain, Pieces};
use crate::flow::{Fluid, Local};
use crate::force::{Eddy, RandomWalk, Sphere, Surroundings};
use crate::random::{Purpose, Stream};
use crate::vector::{Vec3, add, norm, sub};
use carom::instructions::{Work, run_scalar};
use carom::math::Fma;

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

    /// Gives a lane's eddy the deviates of the middle of the step it is about to try, or lets them drift with the time.
    pub(super) fn lean<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize) {
        let chance = &crew.lanes[l].chance;
        if crew.follows[l] {
            // what follows a gust at once must see it change, and not jump from step to step
            crew.bodies.eddy[l] = Some(chance.eddy);
            crew.bodies.since[l] = crew.time[l];
            for c in 0..3 {
                crew.bodies.drift[c][l] = chance.place.drift[c];
            }
        } else {
            crew.bodies.eddy[l] = Some(chance.midway(crew.h[l]));
        }
        crew.stale[l] = true;
    }

    /// Brings chance up to a lane's time and place, `step` after it last was, draws what is due, and says when to stop next.
    pub(super) fn renew<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, step: f64) {
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
        if crew.follows[l] && self.drifts() {
            self.lean(crew, l);
        }
        let (time, next) = (crew.time[l], crew.lanes[l].chance.next());
        crew.stop[l] = if next > time { self.settings.until.min(next) } else { self.settings.until };
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
        let fluid = |x| self.domain.fluid(piece, time, x);
        let here = || run_scalar(Around { walk, fluid, x, nu, tau });
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
            let gust = run_scalar(Gust { walk, fluid, x, nu, deviates: chance.eddy.deviates });
            chance.crossed = time + walk.crossing(chance.place.length, tau, norm(sub(gust, v)));
        }
        let longest =
            if walk.drift { chance.eddy.longest_step(&chance.place) } else { chance.eddy.rest(&chance.place) };
        chance.look = chance.crossed.min(time + longest);
        over
    }
}

/// What a place does to an eddy; like the forces, compiled with and without a fused multiply-add.
struct Around<'a, L> {
    walk: &'a RandomWalk,
    fluid: L,
    x: Vec3,
    nu: f64,
    tau: f64,
}

impl<L: Fn(Vec3) -> Local> Work for Around<'_, L> {
    type Output = Surroundings;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) -> Surroundings {
        self.walk.surroundings(self.fluid, self.x, self.nu, self.tau)
    }
}

/// The fluid's velocity at a place, with an eddy's share.
struct Gust<'a, L> {
    walk: &'a RandomWalk,
    fluid: L,
    x: Vec3,
    nu: f64,
    deviates: Vec3,
}

impl<L: Fn(Vec3) -> Local> Work for Gust<'_, L> {
    type Output = Vec3;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) -> Vec3 {
        let local = (self.fluid)(self.x);
        add(local.velocity, self.walk.fluctuation(self.deviates, &local, self.nu))
    }
}
