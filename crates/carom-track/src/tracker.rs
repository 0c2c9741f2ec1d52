//! From injection to fate: particles finished one by one, `W` side by side.
//!
//! Each of the `W` lanes holds one particle with its own time and step; a lane that is done takes the next particle.
//! No operation mixes two lanes, so a particle's history has the same bits in any company.

mod ahead;
mod chance;
mod contact;
mod crew;
mod cross;
mod diffusion;
mod gait;
mod kinds;
mod lane;
mod meeting;
mod removal;
mod rounding;
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
pub use removal::Reentrainment;
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
    /// A single particle of the first injection, at time zero and without spin: diameter in m, density in kg/m³, position of the centre in
    /// m, velocity in m/s.
    pub fn sphere(number: u64, diameter: f64, density: f64, position: Vec3, velocity: Vec3) -> Self {
        let (injection, weight, time, spin) = (0, 1.0, 0.0, [0.0; 3]);
        Self { number, injection, diameter, density, weight, time, position, velocity, spin }
    }

    /// A particle of a run from its injection's.
    pub fn new(number: u64, injection: usize, start: &crate::injection::Injected) -> Self {
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
    Removal(Vec<carom::WallLaw>, Reentrainment),
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
    ///
    /// # Errors
    /// Walls and behaviors that do not match: nothing is tracked. A particle of an injection for which a wall has no law: those before it
    /// are tracked to their ends, it and those after it are not.
    pub fn run(&self, particles: &mut dyn Iterator<Item = Particle>, sink: &mut dyn Sink) -> Result<(), TrackerError> {
        self.run_on(InstructionSet::best(), particles, sink)
    }

    /// As [`Tracker::run`], with the same bits, on a given set of instructions.
    ///
    /// # Errors
    /// As [`Tracker::run`].
    pub fn run_on(
        &self,
        set: InstructionSet,
        particles: &mut dyn Iterator<Item = Particle>,
        sink: &mut dyn Sink,
    ) -> Result<(), TrackerError> {
        let injections = self.injections()?;
        let mut refused = None;
        let taken = particles.map_while(|p| {
            if p.injection >= injections {
                refused =
                    Some(TrackerError::Injection { particle: p.number, injection: p.injection, laws: injections });
                return None;
            }
            Some(p)
        });
        // lanes ask again after the end
        let mut known = taken.fuse();
        match self.domain {
            AnyDomain::Analytic(domain) => {
                set.run(Flight { walk: self.walk(domain, set), particles: &mut known, sink })
            }
            AnyDomain::Meshed(domain) => set.run(Flight { walk: self.walk(domain, set), particles: &mut known, sink }),
        }
        refused.map_or(Ok(()), Err)
    }

    /// The same bits with one lane and no special instructions.
    ///
    /// # Errors
    /// As [`Tracker::run`].
    pub fn run_plain(
        &self,
        particles: &mut dyn Iterator<Item = Particle>,
        sink: &mut dyn Sink,
    ) -> Result<(), TrackerError> {
        self.run_on(InstructionSet::Portable, particles, sink)
    }

    /// Injections for which every wall has a law.
    fn injections(&self) -> Result<usize, TrackerError> {
        let walls = self.domain.walls();
        if walls.len() != self.behaviors.len() {
            return Err(TrackerError::Behaviors { walls: walls.len(), behaviors: self.behaviors.len() });
        }
        let mut injections = usize::MAX;
        for (wall, behavior) in walls.iter().zip(self.behaviors) {
            match behavior.laws().map(<[_]>::len) {
                Some(0) => return Err(TrackerError::NoLaw { wall: wall.name.clone() }),
                // one law is for all
                Some(1) | None => {}
                Some(laws) => injections = injections.min(laws),
            }
        }
        Ok(injections)
    }

    fn walk<'b, D>(&'b self, domain: &'b D, set: InstructionSet) -> Walk<'b, D> {
        Walk { domain, dynamics: self.dynamics, behaviors: self.behaviors, settings: self.settings, set }
    }
}

/// What a [`Tracker`] cannot start with.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackerError {
    /// Not one behavior for each wall.
    #[error("{walls} walls and {behaviors} behaviors: each wall needs one, in the order of the walls")]
    Behaviors {
        /// Walls of the domain.
        walls: usize,
        /// Behaviors given.
        behaviors: usize,
    },
    /// A list of laws with nothing in it.
    #[error("wall `{wall}` has an empty list of laws: one for all injections, or one for each")]
    NoLaw {
        /// Name of the wall.
        wall: String,
    },
    /// A particle of an injection for which a wall has no law.
    #[error(
        "particle {particle} is of injection {injection}, counted from 0, but a wall has laws for {laws} injections only"
    )]
    Injection {
        /// Number of the particle.
        particle: u64,
        /// Index of its injection.
        injection: usize,
        /// How many injections the wall with the fewest laws has one for.
        laws: usize,
    },
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
