//! Whether the flow takes a sphere off again that would stay at a wall.
//!
//! The flow is steady, so a sphere does not stay where the friction velocity exceeds its critical one ([`carom::removal`]): it is taken
//! off at once. Its track ends there, or, with `follow`, goes on as contact motion where rolling sets in first and there is friction to
//! roll on (`contact/adhered.rs`). It is not put back into flight: at rest at the wall it would be caught again in the next instant.

use super::contact::{Adhered, Contact};
use super::crew::Crew;
use super::meeting::{After, law_of};
use super::{Behavior, Walk};
use crate::domain::{Domain, Hit, Pieces};
use carom::removal::{Fluid, Mode, Removal};

/// What takes spheres off a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reentrainment {
    /// The one way that counts; all three where absent.
    pub mode: Option<Mode>,
    /// Friction velocity at the wall, m/s; where absent, the flow's own at the sphere.
    pub friction_velocity: Option<f64>,
    /// Whether a sphere that rolls off is followed along the wall.
    pub follow: bool,
}

impl<D: Domain> Walk<'_, D> {
    /// How the flow takes off a sphere that an impact would leave where it hit, if it does.
    pub(super) fn removes<const W: usize>(&self, crew: &Crew<W, D::Many<W>>, l: usize, hit: &Hit) -> Option<Mode> {
        let Behavior::Removal(_, removal) = self.behaviors.get(hit.wall)? else { return None };
        let held = self.held(crew, l, hit)?;
        let flow = || self.domain.fluid(crew.here.get(l), crew.time[l], hit.meeting.position).friction_velocity;
        let speed = removal.friction_velocity.unwrap_or_else(flow);
        match removal.mode {
            Some(mode) => held.mode([mode], speed),
            None => held.mode(Mode::ALL, speed),
        }
    }

    /// The contact motion in which it leaves, if it is to be followed and rolls.
    pub(super) fn rolls_off<'b, const W: usize>(
        &'b self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        after: &After,
        mode: Mode,
    ) -> Option<Contact<'b, D>> {
        let behavior = self.behaviors.get(hit.wall)?;
        let Behavior::Removal(_, removal) = behavior else { return None };
        let friction = law_of(behavior, crew.lanes[l].particle.injection)?.tangential().friction();
        if !removal.follow || mode != Mode::Rolling || friction.is_none_or(|f| f <= 0.0) {
            return None;
        }
        let held = self.held(crew, l, hit)?;
        let fluid = self.properties(crew.here.get(l), crew.time[l], hit.meeting.position);
        let body = (crew.bodies.sphere[l].mass(), crew.bodies.radius[l]);
        let adhered = Adhered::new(hit.wall, removal.friction_velocity, &held, body, fluid.mean_free_path);
        let mut contact = self.contact(crew, l, hit, after).rolling_off(adhered);
        contact.begin().is_none().then_some(contact)
    }

    /// What holds a sphere where it hit.
    fn held<const W: usize>(&self, crew: &Crew<W, D::Many<W>>, l: usize, hit: &Hit) -> Option<Removal> {
        let particle = &crew.lanes[l].particle;
        let here = self.properties(crew.here.get(l), crew.time[l], hit.meeting.position);
        let fluid = Fluid { density: here.density, viscosity: here.viscosity };
        law_of(self.behaviors.get(hit.wall)?, particle.injection)?.removal(particle.diameter, &fluid).ok()?
    }
}
