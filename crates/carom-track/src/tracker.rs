//! From injection to fate: particles finished one by one, `W` side by side.
//!
//! Each of the `W` lanes holds one particle with its own time and step; a lane that is done takes the next particle.
//! No operation mixes two lanes, so a particle's history has the same bits in any company.

mod ahead;
mod chance;
mod contact;
mod crew;
mod lane;
mod meeting;
mod removal;
mod settings;
mod staying;
mod undisturbed;
mod walk;
mod wall_jet;

use crate::domain::{AnyDomain, Domain};
use crate::dynamics::Dynamics;
use crate::record::Sink;
use crate::vector::Vec3;
use carom::instructions::{InstructionSet, Work};
use carom::math::Fma;
pub use removal::Removal;
pub use settings::{Settings, SettleHeight};
use walk::Walk;

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
pub struct Tracker<'a> {
    /// The space.
    pub domain: &'a AnyDomain,
    /// What acts on the spheres.
    pub dynamics: &'a Dynamics,
    /// What each wall of the domain does.
    pub behaviors: &'a [Behavior],
    /// How to track.
    pub settings: Settings,
}

impl Tracker<'_> {
    /// Tracks particles to their ends, with the widest instructions the machine has. The sink hears of each particle's
    /// events in order; events of different particles interleave.
    pub fn run(&self, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        self.run_on(InstructionSet::best(), particles, sink);
    }

    /// As [`Tracker::run`], with the same bits, on a given set of instructions.
    pub fn run_on(&self, set: InstructionSet, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        match self.domain {
            AnyDomain::Analytic(domain) => set.run(Flight { walk: self.walk(domain), particles, sink }),
        }
    }

    /// The same bits with one lane and no special instructions.
    pub fn run_plain(&self, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) {
        self.run_on(InstructionSet::Portable, particles, sink);
    }

    fn walk<'b, D>(&'b self, domain: &'b D) -> Walk<'b, D> {
        Walk { domain, dynamics: self.dynamics, behaviors: self.behaviors, settings: self.settings }
    }
}

/// A call of [`Tracker::run`], for each set of instructions. The lanes fill two vectors: one fills the waits of the other's chain of
/// dependent operations.
struct Flight<'a, D> {
    walk: Walk<'a, D>,
    particles: &'a mut dyn Iterator<Item = Particle>,
    sink: &'a mut dyn Sink,
}

impl<D: Domain> Work for Flight<'_, D> {
    type Output = ();

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) {
        self.walk.run_lanes::<LANES>(self.particles, self.sink);
    }
}

#[cfg(test)]
mod tests;
