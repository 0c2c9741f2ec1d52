//! The walk of `W` spheres side by side through a domain, step by step.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::ahead::Met;
use super::crew::{Crew, motion_of};
use super::lane;
use super::{Behavior, Particle, Settings};
use crate::domain::{Domain, Edges, Next, Pieces};
use crate::dynamics::{Bodies, Dynamics};
use crate::force::Sphere;
use crate::geometry::evaluate;
use crate::integrate::{Control, Derivative, Lanes, Motion, Rates, growth};
use crate::lanes::{bits, mask, take_lowest};
use crate::record::{End, ParticleFate, Sink};
use crate::vector::{Vec3, add};
use carom::instructions::InstructionSet;

/// All that stays the same during a run in one kind of domain.
#[derive(Debug)]
pub(super) struct Walk<'a, D> {
    pub domain: &'a D,
    pub dynamics: &'a Dynamics,
    pub behaviors: &'a [Behavior],
    pub settings: Settings,
    /// What this is compiled for.
    pub set: InstructionSet,
}

impl<D> Copy for Walk<'_, D> {}

impl<D> Clone for Walk<'_, D> {
    fn clone(&self) -> Self {
        *self
    }
}

/// Steps after which a sphere that goes on undisturbed is looked at again: it may never meet anything any more.
const LOOK: u64 = 64;
/// Share of the step that the tolerance allows which is always worth trying.
pub(super) const LEAST_SHARE: f64 = 1.0 / 64.0;

/// The forces on the spheres of all lanes.
pub(super) struct Acting<'a, const W: usize, D: Domain> {
    pub dynamics: &'a Dynamics,
    pub domain: &'a D,
    pub here: &'a D::Many<W>,
    /// Whose forces are asked for.
    pub wanted: &'a [bool; W],
    pub bodies: &'a Bodies<W>,
}

impl<const W: usize, D: Domain> Derivative<W> for Acting<'_, W, D> {
    #[inline(always)]
    fn rates(&self, time: &Lanes<W>, motion: &Motion<W>, out: &mut Rates<W>) {
        self.dynamics.rates(self.domain, self.here, self.wanted, time, self.bodies, motion, out);
    }
}

impl<D: Domain> Walk<'_, D> {
    #[inline(always)]
    pub(super) fn run_lanes<const W: usize>(&self, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        if self.dynamics.brownian {
            return self.run_diffusing(particles, sink);
        }
        let mut crew = Crew::<W, D::Many<W>>::idle(D::Many::all(D::NOWHERE));
        let place = self.dynamics.need_place(self.domain);
        let control = Control { tolerance: self.per_step(), spins: self.dynamics.spins(), place };
        let mut met = [Met::NOTHING; W];
        loop {
            let mut working = false;
            for l in 0..W {
                while !crew.busy[l] {
                    let Some(particle) = particles.next() else { break };
                    self.begin(&mut crew, l, particle, sink);
                }
                working |= crew.busy[l];
            }
            if !working {
                return;
            }
            self.choose_gaits(&mut crew);
            if !self.domain.is_one_piece() {
                self.limit(&mut crew);
            }
            crew.set_steps();
            if self.leans() {
                for l in 0..W {
                    if crew.busy[l] {
                        self.lean(&mut crew, l);
                    }
                }
            }
            self.refresh(&mut crew);
            self.try_steps(&mut crew, control);
            self.forgive_rounding(&mut crew, control);
            let mut edges = Edges::NONE;
            let ahead = self.domain.look(&crew.here, &crew.motion.x, &crew.step.path, &crew.bodies.radius, &mut edges);
            let mut factor = [0.0; W];
            for l in 0..W {
                factor[l] = growth(crew.step.error_squared[l], control.place);
            }
            let goes = crew.go_on(&ahead, &factor, &self.settings, control.spins);
            let mut rest = [0; W];
            for l in 0..W {
                rest[l] = mask(crew.busy[l]) & !goes[l];
            }
            let mut due = [0; W];
            for l in 0..W {
                due[l] = mask(crew.steps[l] % LOOK == 0) & goes[l];
            }
            let mut due = bits(&due);
            while let Some(l) = take_lowest(&mut due) {
                self.is_done(&mut crew, l, sink);
            }
            if D::SIDE_BY_SIDE {
                let crossed = self.cross_together(&mut crew, &edges, &rest, &factor);
                for l in 0..W {
                    rest[l] &= !crossed[l];
                }
            }
            let found = self.find_first(&crew, &ahead, &rest, &mut met);
            let mut rest = bits(&rest);
            while let Some(l) = take_lowest(&mut rest) {
                let met = if found >> l & 1 == 1 { &met[l] } else { &Met::NOTHING };
                self.advance(&mut crew, l, met, factor[l], sink);
            }
        }
    }

    /// Spheres that diffuse go one by one: nearly each step has a length of its own, and draws.
    #[inline(never)]
    fn run_diffusing(&self, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        let mut crew = Crew::<1, D::Many<1>>::idle(D::Many::all(D::NOWHERE));
        for particle in particles {
            self.begin(&mut crew, 0, particle, sink);
            crew.lanes[0].diffusion = self.diffusion(&crew, 0);
            while crew.busy[0] {
                self.diffuse(&mut crew, 0, sink);
            }
        }
    }

    /// Puts a particle into a lane; one that has no time to fly ends at once.
    #[inline(always)]
    fn begin<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, particle: Particle, sink: &mut dyn Sink) {
        let sphere = Sphere { diameter: particle.diameter, density: particle.density };
        self.dynamics.body(l, sphere, &mut crew.bodies);
        crew.follows[l] = self.dynamics.follows(&sphere);
        for c in 0..3 {
            crew.motion.x[c][l] = particle.position[c];
            crew.motion.v[c][l] = particle.velocity[c];
            crew.motion.spin[c][l] = particle.spin[c];
        }
        let trace = sink.start(&particle);
        crew.lanes[l].begin(particle, trace, self.has_chance());
        crew.here.set(l, self.domain.enter(particle.time, particle.position));
        self.stray(crew, l, sink);
        let outside = self.domain.is_lost(crew.here.get(l));
        (crew.time[l], crew.stop[l], crew.steps[l]) = (particle.time, self.settings.until, 0);
        (crew.busy[l], crew.quiet[l]) = (true, mask(!trace && !self.has_chance()));
        if particle.time >= self.settings.until {
            finish(crew, l, ParticleFate::Airborne, None, sink);
            return;
        }
        if outside {
            finish(crew, l, ParticleFate::Stuck, None, sink);
            return;
        }
        if let Some(overlap) = self.domain.walls().overlap(particle.position, crew.bodies.radius[l]) {
            finish(crew, l, ParticleFate::Overlapping, Some(overlap.wall), sink);
            return;
        }
        self.refresh_one(crew, l);
        if self.is_done(crew, l, sink) {
            return;
        }
        crew.next[l] = self.first_step(crew, l);
        if self.has_chance() {
            self.renew(crew, l, 0.0);
        }
        // all lanes at once cost little more than one
        crew.stale[l] = true;
    }

    /// Tells once of a sphere that is where nothing is known of the fluid.
    pub(super) fn stray<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, sink: &mut dyn Sink) {
        if !crew.lanes[l].strayed && self.domain.is_beyond(crew.here.get(l)) {
            crew.lanes[l].strayed = true;
            sink.strayed();
        }
    }

    pub(super) fn per_step(&self) -> f64 {
        self.settings.per_step(self.dynamics.need_place(self.domain), !self.domain.is_one_piece())
    }

    /// A first trial step, s: what the tolerance is likely to allow where forces change over the time in which they
    /// change the speed.
    #[inline(always)]
    pub(super) fn first_step<const W: usize>(&self, crew: &Crew<W, D::Many<W>>, l: usize) -> f64 {
        let (mut speed, mut change) = (0.0f64, 0.0f64);
        for c in 0..3 {
            speed = speed.max(crew.motion.v[c][l].abs());
            change = change.max(crew.rates.a[c][l].abs());
        }
        let share = (self.per_step() * 1e3).sqrt().sqrt();
        let relaxation = 1.0 / crew.bodies.drag_rate[l];
        let slow = if relaxation.is_finite() { relaxation } else { 1.0 };
        // next to rest the speed says nothing
        let time = if speed > 0.0 && change > 0.0 { (speed / change).max(1e-9 * slow) } else { relaxation };
        if time.is_finite() { share * time } else { 1.0 }
    }

    /// After a blow or a new gust the drag of a sphere that follows the fluid must be seen to act first: shortens the next step.
    #[inline(always)]
    pub(super) fn begin_anew<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize) {
        if crew.follows[l] {
            let share = 4.0 * (self.per_step() * 1e3).sqrt().sqrt();
            let short = share / crew.bodies.drag_rate[l];
            crew.next[l] = if crew.next[l] < short { crew.next[l] } else { short };
        }
    }

    /// Rates of the lanes whose motion was changed. Where all come in one go, the others get the bits they have.
    #[inline(always)]
    fn refresh<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>) {
        if !crew.stale.contains(&true) {
            return;
        }
        if self.dynamics.is_plain(self.domain) {
            let Crew { here, busy, time, bodies, motion, rates, .. } = crew;
            self.dynamics.rates(self.domain, here, busy, time, bodies, motion, rates);
        } else {
            for l in 0..W {
                if crew.stale[l] {
                    self.refresh_one(crew, l);
                }
            }
        }
        crew.stale = [false; W];
    }

    #[inline(always)]
    fn refresh_one<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize) {
        let (x, v, spin) = motion_of(&crew.motion, l);
        let rates = self.rates_at((crew.here.get(l), crew.time[l]), &crew.bodies.one(l), x, v, spin);
        for c in 0..3 {
            crew.rates.a[c][l] = rates.a[c][0];
            crew.rates.alpha[c][l] = rates.alpha[c][0];
        }
        (crew.rates.drag[l], crew.rates.torque[l]) = (rates.drag[0], rates.torque[0]);
    }

    #[inline(always)]
    pub(super) fn rates_at(
        &self,
        (here, time): (D::Here, f64),
        body: &Bodies<1>,
        x: Vec3,
        v: Vec3,
        spin: Vec3,
    ) -> Rates<1> {
        let column = |v: Vec3| [[v[0]], [v[1]], [v[2]]];
        let one = Motion::<1> { x: column(x), v: column(v), spin: column(spin) };
        let mut rates = Rates::ZERO;
        self.dynamics.rates(self.domain, &D::Many::all(here), &[true], &[time], body, &one, &mut rates);
        rates
    }

    /// The longest steps worth trying, where the flow has pieces.
    #[inline(always)]
    fn limit<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>) {
        crew.longest = self.domain.longest_all(&crew.here, &crew.motion.x, &crew.motion.v);
        for l in 0..W {
            // next to an edge that it hardly approaches a straight path says nothing: the step finds where it crosses
            let least = least_step(crew.time[l]).max(LEAST_SHARE * crew.next[l]);
            crew.longest[l] = crew.longest[l].max(least);
        }
    }

    /// Takes a trial step of one lane: refuses it, accepts it, or ends it at a wall or an edge.
    #[inline(always)]
    fn advance<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        met: &Met<D::Here>,
        factor: f64,
        sink: &mut dyn Sink,
    ) {
        let h = crew.h[l];
        let good = crew.step.error_squared[l] <= 1.0;
        if crew.steps[l] > self.settings.max_steps || (!good && crew.time[l] + h == crew.time[l]) {
            sink.stalled();
            finish(crew, l, ParticleFate::Airborne, None, sink);
        } else if !good {
            crew.next[l] = h * factor.min(0.9);
        } else {
            match &met.next {
                // too short a step to count against the time: again with one that does
                Next::Clear if crew.time[l] + h == crew.time[l] && h < crew.stop[l] - crew.time[l] => {
                    crew.next[l] = least_step(crew.time[l]);
                }
                Next::Clear => self.accept(crew, l, factor, sink),
                Next::Longest(share) => crew.next[l] = h * share,
                Next::Edge { theta, into } => self.cross(crew, l, (*theta, *into, None), met, factor, sink),
                Next::Carried { theta, into, carry } => {
                    self.cross(crew, l, (*theta, *into, Some(carry)), met, factor, sink);
                }
                Next::Wall(hit) => {
                    let theta = hit.meeting.theta;
                    if theta > 0.0 && theta < 1e-3 && !crew.lanes[l].fitted {
                        // far down a long step the root keeps too few digits: look again with a step that fits
                        crew.next[l] = 2.0 * theta * h;
                        crew.lanes[l].fitted = true;
                    } else {
                        self.meet(crew, l, hit, met.velocity, sink);
                    }
                    crew.quiet[l] = mask(crew.lanes[l].is_quiet() && !self.has_chance());
                }
            }
        }
    }

    /// The spin at θ of a lane's step, rad/s.
    #[inline(always)]
    pub(super) fn spin_at<const W: usize>(&self, crew: &Crew<W, D::Many<W>>, l: usize, theta: f64) -> Vec3 {
        let spin = motion_of(&crew.motion, l).2;
        if self.dynamics.spins() { add(spin, evaluate(&lane::points(&crew.step.twist, l), theta)) } else { spin }
    }

    /// Takes the whole step of one lane.
    #[inline(always)]
    fn accept<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, factor: f64, sink: &mut dyn Sink) {
        let h = crew.h[l];
        if crew.lanes[l].trace {
            lane::trace(crew, l, 1.0, sink);
        }
        let stop = crew.stop[l];
        let stopped = h >= stop - crew.time[l];
        crew.time[l] = if stopped { stop } else { crew.time[l] + h };
        // a step cut short by a stop says little of the next
        if !stopped || factor < 1.0 {
            crew.next[l] = crew.after(l, factor);
        }
        let lane = &mut crew.lanes[l];
        (lane.fitted, lane.standing, lane.edges) = (false, 0, 0);
        crew.quiet[l] = mask(lane.is_quiet() && !self.has_chance());
        for c in 0..3 {
            crew.motion.x[c][l] = crew.step.end.x[c][l];
            crew.motion.v[c][l] = crew.step.end.v[c][l];
            crew.motion.spin[c][l] = crew.step.end.spin[c][l];
            crew.rates.a[c][l] = crew.step.rates.a[c][l];
            crew.rates.alpha[c][l] = crew.step.rates.alpha[c][l];
        }
        (crew.rates.drag[l], crew.rates.torque[l]) = (crew.step.rates.drag[l], crew.step.rates.torque[l]);
        if stopped && stop >= self.settings.until {
            finish(crew, l, ParticleFate::Airborne, None, sink);
        } else if self.has_chance() {
            self.renew_in_flight(crew, l, h);
        }
    }
}

/// A step that moves the time on, s.
pub(super) fn least_step(time: f64) -> f64 {
    (1e-14 * time.abs()).max(1e-30)
}

/// Ends a lane's particle whose place was lost beyond a cell of a mesh.
pub(super) fn lose<const W: usize, P>(crew: &mut Crew<W, P>, l: usize, cell: Option<u32>, sink: &mut dyn Sink) {
    crew.lanes[l].lost_from = cell;
    finish(crew, l, ParticleFate::Stuck, None, sink);
}

/// Tells the sink how a lane's particle ended; the lane is free then.
#[inline(always)]
pub(super) fn finish<const W: usize, P>(
    crew: &mut Crew<W, P>,
    l: usize,
    fate: ParticleFate,
    wall: Option<usize>,
    sink: &mut dyn Sink,
) {
    (crew.busy[l], crew.quiet[l]) = (false, 0);
    let lane = &crew.lanes[l];
    let (position, velocity, spin) = motion_of(&crew.motion, l);
    if lane.trace {
        sink.point(lane.particle.number, crew.time[l], position, velocity, spin);
    }
    sink.end(&End {
        particle: lane.particle,
        fate,
        wall,
        time: crew.time[l],
        position,
        velocity,
        spin,
        steps: crew.steps[l],
        cell: lane.lost_from,
    });
}
