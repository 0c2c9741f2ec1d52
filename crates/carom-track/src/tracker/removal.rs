//! Whether the flow takes a sphere off again that would stay at a wall.
//!
//! The flow is steady, so a sphere does not stay where the friction velocity exceeds its critical one ([`carom::removal`]): it is taken
//! off at once, and its track ends there. It is not put back into flight. At rest at the wall it would be caught again in the next
//! instant, and how far it rolls, and whether it is lifted out of the boundary layer, no criterion of incipient motion says.

use super::crew::Crew;
use super::meeting::law_of;
use super::{Behavior, Walk};
use crate::domain::{Domain, Hit};
use carom::removal::{Fluid, Mode};

/// What takes spheres off a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reentrainment {
    /// The one way that counts; all three where absent.
    pub mode: Option<Mode>,
    /// Friction velocity at the wall, m/s; where absent, the flow's own at the sphere.
    pub friction_velocity: Option<f64>,
}

impl<D: Domain> Walk<'_, D> {
    /// How the flow takes off a sphere that was to stay where it hit, if it does.
    pub(super) fn removes<const W: usize>(&self, crew: &Crew<W, D::Here>, l: usize, hit: &Hit) -> Option<Mode> {
        let behavior = self.behaviors.get(hit.wall)?;
        let Behavior::Removal(_, removal) = behavior else { return None };
        let particle = &crew.lanes[l].particle;
        let here = self.properties(crew.here[l], crew.time[l], hit.meeting.position);
        let fluid = Fluid { density: here.density, viscosity: here.viscosity };
        let held = law_of(behavior, particle.injection)?.removal(particle.diameter, &fluid).ok()??;
        let flow = || self.domain.fluid(crew.here[l], crew.time[l], hit.meeting.position).friction_velocity;
        let speed = removal.friction_velocity.unwrap_or_else(flow);
        match removal.mode {
            Some(mode) => held.mode([mode], speed),
            None => held.mode(Mode::ALL, speed),
        }
    }
}
