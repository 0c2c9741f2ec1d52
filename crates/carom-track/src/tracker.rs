//! From injection to fate: particles finished one by one, `W` side by side.
//!
//! Each of the `W` lanes holds one particle with its own time and step; a lane that is done takes the next particle.
//! No operation mixes two lanes, so a particle's history has the same bits in any company.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

mod chance;
mod crew;
mod lane;
mod meeting;
mod removal;
mod settings;
mod wall_jet;
mod walls;

use crate::domain::{Domain, Hit};
use crate::dynamics::{Bodies, Dynamics};
use crate::force::Sphere;
use crate::integrate::{Control, Derivative, Motion, Rates, growth, step};
use crate::lanes::{bits, mask, take_lowest};
use crate::record::{End, Fate, Sink};
use crate::vector::Vec3;
use carom::instructions::{InstructionSet, Work};
use carom::math::Fma;
use crew::{Crew, motion_of};
use lane::Lane;
pub use removal::Removal;
pub use settings::{Settings, SettleHeight};

/// A particle as it is injected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Particle {
    /// Its number in the run.
    pub number: u64,
    /// Index of its injection.
    pub injection: usize,
    /// Diameter, m.
    pub diameter: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// How many real particles it stands for.
    pub weight: f64,
    /// Time of injection, s.
    pub time: f64,
    /// Position of its centre, m.
    pub position: Vec3,
    /// Velocity, m/s.
    pub velocity: Vec3,
    /// Spin, rad/s.
    pub spin: Vec3,
}

impl Particle {
    /// A particle of a run from its injection's.
    pub fn new(number: u64, injection: usize, start: &crate::injection::Particle) -> Self {
        Self {
            number,
            injection,
            diameter: start.diameter,
            density: start.density,
            weight: start.weight,
            time: start.time,
            position: start.position,
            velocity: start.velocity,
            spin: start.spin,
        }
    }

    /// Mass of all it stands for, kg.
    pub fn mass(&self) -> f64 {
        // products: the bits of `powi` depend on the platform
        self.weight * self.density * std::f64::consts::PI / 6.0 * (self.diameter * self.diameter * self.diameter)
    }
}

/// What happens where a particle meets a wall.
#[derive(Clone, Debug)]
pub enum Behavior {
    /// A wall law decides: one for each injection's material, or one for all.
    Law(Vec<carom::WallLaw>),
    /// Likewise, and the flow takes spheres that would stay off again where it is strong enough.
    Removal(Vec<carom::WallLaw>, Removal),
    /// It stays, whatever its speed.
    Trap,
    /// It leaves the domain.
    Escape,
    /// It leaves along the wall, as a jet's momentum spreads.
    WallJet,
}

impl Behavior {
    /// The wall laws, if laws decide.
    pub fn laws(&self) -> Option<&[carom::WallLaw]> {
        match self {
            Self::Law(laws) | Self::Removal(laws, _) => Some(laws),
            Self::Trap | Self::Escape | Self::WallJet => None,
        }
    }
}

/// All that stays the same during a run.
#[derive(Clone, Copy, Debug)]
pub struct Tracker<'a, D> {
    /// The space.
    pub domain: &'a D,
    /// What acts on the spheres.
    pub dynamics: &'a Dynamics,
    /// What each wall of the domain does.
    pub behaviors: &'a [Behavior],
    /// How to track.
    pub settings: Settings,
}

/// The forces on the spheres of all lanes.
struct Acting<'a, const W: usize, D> {
    dynamics: &'a Dynamics,
    domain: &'a D,
    bodies: &'a Bodies<W>,
}

impl<const W: usize, D: Domain> Derivative<W> for Acting<'_, W, D> {
    #[inline(always)]
    fn rates(&self, motion: &Motion<W>, out: &mut Rates<W>) {
        self.dynamics.rates(self.domain, self.bodies, motion, out);
    }
}

/// A call of [`Tracker::run`], for each set of instructions. The lanes fill two vectors: one fills the waits of the other's chain of
/// dependent operations.
struct Flight<'a, D> {
    tracker: &'a Tracker<'a, D>,
    particles: &'a mut dyn Iterator<Item = Particle>,
    sink: &'a mut dyn Sink,
}

impl<D: Domain> Work for Flight<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) {
        self.tracker.run_lanes::<LANES>(self.particles, self.sink);
    }
}

impl<D: Domain> Tracker<'_, D> {
    /// Tracks particles to their ends, with the widest instructions the machine has. The sink hears of each particle's
    /// events in order; events of different particles interleave.
    pub fn run(&self, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        self.run_on(InstructionSet::best(), particles, sink);
    }

    /// As [`Tracker::run`], with the same bits, on a given set of instructions.
    pub fn run_on(&self, set: InstructionSet, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        set.run(Flight { tracker: self, particles, sink });
    }

    /// The same bits with one lane and no special instructions.
    pub fn run_plain(&self, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        self.run_on(InstructionSet::Portable, particles, sink);
    }

    #[inline(always)]
    fn run_lanes<const W: usize>(&self, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        let mut crew = Crew::<W>::IDLE;
        let place = self.dynamics.need_place(self.domain);
        let control = Control { tolerance: self.settings.per_step(place), spins: self.dynamics.spins(), place };
        let mut hits = [(walls::NONE, [0.0; 3]); W];
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
            crew.set_steps();
            if self.drifts() {
                for l in 0..W {
                    if crew.busy[l] {
                        self.lean(&mut crew, l);
                    }
                }
            }
            self.refresh(&mut crew);
            let forces = Acting { dynamics: self.dynamics, domain: self.domain, bodies: &crew.bodies };
            step(&crew.motion, &crew.rates, &crew.h, control, &forces, &mut crew.step);
            let ahead = self.domain.ahead(&crew.motion.x, &crew.step.path, &crew.bodies.radius);
            let mut factor = [0.0; W];
            for l in 0..W {
                factor[l] = growth(crew.step.error_squared[l], control.place);
            }
            let goes = crew.go_on(&ahead, &factor, &self.settings, control.spins);
            let mut rest = [0; W];
            for l in 0..W {
                rest[l] = mask(crew.busy[l]) & !goes[l];
            }
            let met = self.find_walls(&crew, &ahead, &rest, &mut hits);
            let mut rest = bits(&rest);
            while let Some(l) = take_lowest(&mut rest) {
                let hit = (met >> l & 1 == 1).then_some(&hits[l]);
                self.advance(&mut crew, l, hit, factor[l], sink);
            }
        }
    }

    /// Puts a particle into a lane; one that has no time to fly ends at once.
    #[inline(always)]
    fn begin<const W: usize>(&self, crew: &mut Crew<W>, l: usize, particle: Particle, sink: &mut dyn Sink) {
        self.dynamics.body(l, Sphere { diameter: particle.diameter, density: particle.density }, &mut crew.bodies);
        for c in 0..3 {
            crew.motion.x[c][l] = particle.position[c];
            crew.motion.v[c][l] = particle.velocity[c];
            crew.motion.spin[c][l] = particle.spin[c];
        }
        let trace = sink.start(&particle);
        crew.lanes[l] = Lane::new(particle, trace);
        (crew.time[l], crew.stop[l], crew.steps[l]) = (particle.time, self.settings.until, 0);
        (crew.busy[l], crew.quiet[l]) = (true, mask(!trace && !self.has_chance()));
        if particle.time >= self.settings.until {
            finish(crew, l, Fate::Airborne, None, sink);
            return;
        }
        self.refresh_one(crew, l);
        crew.next[l] = self.first_step(crew, l);
        if self.has_chance() {
            self.renew(crew, l, 0.0);
        }
        // all lanes at once cost little more than one
        crew.stale[l] = true;
    }

    /// A first trial step, s: what the tolerance is likely to allow where forces change over the time in which they
    /// change the speed.
    #[inline(always)]
    fn first_step<const W: usize>(&self, crew: &Crew<W>, l: usize) -> f64 {
        let (mut speed, mut change) = (0.0f64, 0.0f64);
        for c in 0..3 {
            speed = speed.max(crew.motion.v[c][l].abs());
            change = change.max(crew.rates.a[c][l].abs());
        }
        let place = self.dynamics.need_place(self.domain);
        let share = (self.settings.per_step(place) * 1e3).sqrt().sqrt();
        let time = if speed > 0.0 && change > 0.0 { speed / change } else { 1.0 / crew.bodies.drag_rate[l] };
        if time.is_finite() { share * time } else { 1.0 }
    }

    /// Rates of the lanes whose motion was changed. Where all come in one go, the others get the bits they have.
    #[inline(always)]
    fn refresh<const W: usize>(&self, crew: &mut Crew<W>) {
        if !crew.stale.contains(&true) {
            return;
        }
        if self.dynamics.is_plain() {
            self.dynamics.rates(self.domain, &crew.bodies, &crew.motion, &mut crew.rates);
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
    fn refresh_one<const W: usize>(&self, crew: &mut Crew<W>, l: usize) {
        let (x, v, spin) = motion_of(&crew.motion, l);
        let rates = self.rates_at(&crew.bodies.one(l), x, v, spin);
        for c in 0..3 {
            crew.rates.a[c][l] = rates.a[c][0];
            crew.rates.alpha[c][l] = rates.alpha[c][0];
        }
    }

    #[inline(always)]
    fn rates_at(&self, body: &Bodies<1>, x: Vec3, v: Vec3, spin: Vec3) -> Rates<1> {
        let column = |v: Vec3| [[v[0]], [v[1]], [v[2]]];
        let one = Motion::<1> { x: column(x), v: column(v), spin: column(spin) };
        let mut rates = Rates::ZERO;
        self.dynamics.rates(self.domain, body, &one, &mut rates);
        rates
    }

    /// Takes a trial step of one lane: refuses it, accepts it, or ends it at a wall.
    #[inline(always)]
    fn advance<const W: usize>(
        &self,
        crew: &mut Crew<W>,
        l: usize,
        hit: Option<&(Hit, Vec3)>,
        factor: f64,
        sink: &mut dyn Sink,
    ) {
        let h = crew.h[l];
        let good = crew.step.error_squared[l] <= 1.0;
        if crew.steps[l] > self.settings.max_steps || (!good && crew.time[l] + h == crew.time[l]) {
            sink.stalled();
            finish(crew, l, Fate::Airborne, None, sink);
        } else if !good {
            crew.next[l] = h * factor.min(0.9);
        } else if let Some((hit, velocity)) = hit {
            let theta = hit.meeting.theta;
            if theta > 0.0 && theta < 1e-3 && !crew.lanes[l].fitted {
                // far down a long step the root keeps too few digits: look again with a step that fits
                crew.next[l] = 2.0 * theta * h;
                crew.lanes[l].fitted = true;
            } else {
                self.meet(crew, l, hit, *velocity, sink);
            }
            crew.quiet[l] = mask(crew.lanes[l].is_quiet() && !self.has_chance());
        } else {
            self.accept(crew, l, factor, sink);
        }
    }

    /// Takes the whole step of one lane.
    #[inline(always)]
    fn accept<const W: usize>(&self, crew: &mut Crew<W>, l: usize, factor: f64, sink: &mut dyn Sink) {
        let h = crew.h[l];
        if crew.lanes[l].trace {
            lane::trace(crew, l, 1.0, sink);
        }
        let stop = crew.stop[l];
        let stopped = h >= stop - crew.time[l];
        crew.time[l] = if stopped { stop } else { crew.time[l] + h };
        // a step cut short by a stop says little of the next
        if !stopped || factor < 1.0 {
            crew.next[l] = h * factor;
        }
        let lane = &mut crew.lanes[l];
        (lane.fitted, lane.standing) = (false, 0);
        crew.quiet[l] = mask(lane.is_quiet() && !self.has_chance());
        for c in 0..3 {
            crew.motion.x[c][l] = crew.step.end.x[c][l];
            crew.motion.v[c][l] = crew.step.end.v[c][l];
            crew.motion.spin[c][l] = crew.step.end.spin[c][l];
            crew.rates.a[c][l] = crew.step.rates.a[c][l];
            crew.rates.alpha[c][l] = crew.step.rates.alpha[c][l];
        }
        if stopped && stop >= self.settings.until {
            finish(crew, l, Fate::Airborne, None, sink);
        } else if self.has_chance() {
            self.renew(crew, l, h);
        }
    }
}

/// Tells the sink how a lane's particle ended; the lane is free then.
#[inline(always)]
fn finish<const W: usize>(crew: &mut Crew<W>, l: usize, fate: Fate, wall: Option<usize>, sink: &mut dyn Sink) {
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
    });
}

#[cfg(test)]
mod tests;
