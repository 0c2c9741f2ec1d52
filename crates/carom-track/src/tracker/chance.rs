//! What changes at random in flight: the eddy a sphere is in, and the molecules' present kick.
//!
//! Both are constant for a while; the tracker steps exactly to the moment they change.

use super::{Crew, Tracker, motion_of};
use crate::domain::Domain;
use crate::force::brownian_amplitude;
use crate::random::{Purpose, Stream};
use crate::vector::{add, norm, sub};

/// When the present eddy and kick end, s, and how many there were.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chance {
    eddy_end: f64,
    kick_end: f64,
    eddies: u32,
    kicks: u32,
}

impl Chance {
    /// Nothing drawn yet.
    pub const NONE: Self = Self { eddy_end: f64::NEG_INFINITY, kick_end: f64::NEG_INFINITY, eddies: 0, kicks: 0 };

    /// The next change, s.
    #[inline(always)]
    pub fn next(&self) -> f64 {
        self.eddy_end.min(self.kick_end)
    }
}

/// Shortest life of an eddy in relaxation times: shorter ones a sphere does not feel, and they would take for ever.
const SHORTEST: f64 = 1e-3;

impl<D: Domain> Tracker<'_, D> {
    /// Whether anything changes at random in flight.
    #[inline(always)]
    pub(super) fn has_chance(&self) -> bool {
        self.dynamics.random_walk.is_some() || self.dynamics.brownian
    }

    /// Draws what is due at a lane's time, and says when to stop next.
    pub(super) fn renew<const W: usize>(&self, crew: &mut Crew<W>, l: usize) {
        let time = crew.time[l];
        if crew.lanes[l].chance.eddy_end <= time {
            self.renew_eddy(crew, l);
        }
        if crew.lanes[l].chance.kick_end <= time {
            self.renew_kick(crew, l);
        }
        let next = crew.lanes[l].chance.next();
        crew.stop[l] = if next > time { self.settings.until.min(next) } else { self.settings.until };
    }

    fn renew_eddy<const W: usize>(&self, crew: &mut Crew<W>, l: usize) {
        let (time, number) = (crew.time[l], crew.lanes[l].particle.number);
        let chance = &mut crew.lanes[l].chance;
        let Some(walk) = &self.dynamics.random_walk else {
            chance.eddy_end = f64::INFINITY;
            return;
        };
        let (x, v, _) = motion_of(&crew.motion, l);
        let local = self.domain.fluid(x);
        if !(local.k > 0.0 && local.epsilon > 0.0) {
            // nothing to draw here, but perhaps further on: ask again in a while
            crew.bodies.eddy[l] = None;
            chance.eddy_end = time + crew.next[l];
            return;
        }
        let mut draws = Stream::new(self.settings.seed, number, Purpose::Eddy, chance.eddies);
        chance.eddies = chance.eddies.wrapping_add(1);
        let nu = self.dynamics.fluid.kinematic_viscosity();
        let eddy = walk.eddy(&local, nu, draws.normals(), draws.open_uniform());
        let gust = add(local.velocity, walk.fluctuation(&eddy, &local, nu));
        let tau = self.dynamics.relaxation_time(&crew.bodies.sphere[l]);
        let stay = walk.residence(&eddy, tau, norm(sub(gust, v)));
        crew.bodies.eddy[l] = Some(eddy);
        chance.eddy_end = time + stay.max(SHORTEST * tau);
    }

    fn renew_kick<const W: usize>(&self, crew: &mut Crew<W>, l: usize) {
        let (time, number) = (crew.time[l], crew.lanes[l].particle.number);
        let chance = &mut crew.lanes[l].chance;
        if !self.dynamics.brownian {
            chance.kick_end = f64::INFINITY;
            return;
        }
        let sphere = &crew.bodies.sphere[l];
        // constant over one relaxation time: displacements then spread as Einstein's diffusivity says
        let interval = self.dynamics.relaxation_time(sphere);
        let size = brownian_amplitude(&self.dynamics.fluid, sphere, self.dynamics.slip(sphere), interval);
        let mut draws = Stream::new(self.settings.seed, number, Purpose::Brownian, chance.kicks);
        chance.kicks = chance.kicks.wrapping_add(1);
        for c in 0..3 {
            crew.bodies.kick[c][l] = size * draws.normal();
        }
        chance.kick_end = time + interval;
    }
}
