//! The tolerance is kept: halving it moves no first impact by more than it.

use super::*;
use crate::flow::{Channel, Pipe, Profile, Stagnation, Symmetry};
use crate::geometry::Cylinder;

/// A case: name, flow, walls, speed of the start against the 4 m/s of `scattered`, spin of the start in rad/s, whether every
/// force acts or drag, gravity and buoyancy alone.
struct Case {
    name: &'static str,
    flow: Flow,
    walls: Vec<Wall>,
    speed: f64,
    spin: f64,
    every_force: bool,
}

fn cases() -> Vec<Case> {
    let fluid = Fluid::default();
    let flat = |name, flow, speed| {
        let walls = channel().walls().to_vec();
        Case { name, flow, walls, speed, spin: 0.0, every_force: false }
    };
    let wind = || Flow::Uniform { velocity: [1.0, 0.2, 0.0] };
    let sheared = || Flow::Channel(Channel::new(Profile::Laminar, 0.02, 3.0, &fluid).unwrap());
    let stagnation =
        || Flow::Stagnation(Stagnation::new(Symmetry::Axisymmetric, [0.0; 3], [0.0, 1.0, 0.0], 100.0).unwrap());
    let (centre, along) = ([0.0, 0.01, 0.0], [1.0, 0.0, 0.0]);
    let pipe = Flow::Pipe(Pipe::new(Profile::Laminar, centre, along, 0.01, 3.0, &fluid).unwrap());
    let inside = Cylinder { point: centre, axis: along, radius: 0.01, inside: true };
    let round = Wall { shape: Shape::Cylinder(inside), ..plane("pipe", [0.0; 3], [0.0, 1.0, 0.0]) };
    vec![
        flat("wind", wind(), 1.0),
        flat("still", Flow::Still, 1.0),
        flat("slow", Flow::Still, 0.05),
        flat("from rest", Flow::Still, 0.0),
        flat("sheared", sheared(), 1.0),
        flat("sheared, from rest", sheared(), 0.0),
        flat("stagnation", stagnation(), 1.0),
        Case { walls: vec![round], ..flat("pipe", pipe, 1.0) },
        Case { every_force: true, ..flat("sheared, every force", sheared(), 1.0) },
        Case { every_force: true, spin: -2000.0, ..flat("sheared, every force, spinning", sheared(), 1.0) },
        Case { every_force: true, spin: 2000.0, ..flat("wind, every force, spinning", wind(), 1.0) },
    ]
}

impl Case {
    fn dynamics(&self) -> Dynamics {
        let mut dynamics = dynamics(Drag::SchillerNaumann);
        let forces = &mut dynamics.forces;
        for force in [
            &mut forces.saffman,
            &mut forces.magnus,
            &mut forces.rotational_drag,
            &mut forces.pressure_gradient,
            &mut forces.added_mass,
        ] {
            *force = self.every_force;
        }
        dynamics
    }

    /// Times of the first impacts, on walls that trap.
    fn firsts(&self, tolerance: f64, particles: &[Particle]) -> Vec<f64> {
        let domain = AnyDomain::new(self.flow.clone(), self.walls.clone());
        let behaviors = vec![Behavior::Trap; domain.walls().len()];
        let log = track(&domain, &self.dynamics(), &behaviors, Settings { tolerance, ..settings() }, particles);
        let first = |p: &Particle| log.impacts.iter().find(|i| i.particle == p.number).map(|i| i.time);
        particles
            .iter()
            .map(|p| first(p).unwrap_or_else(|| panic!("{}: {} meets no wall", self.name, p.number)))
            .collect()
    }
}

#[test]
fn halving_the_tolerance_moves_no_first_impact_by_more_than_the_tolerance() {
    for case in cases() {
        let particles: Vec<_> = (0..100)
            .map(scattered)
            .map(|p| Particle { velocity: p.velocity.map(|v| case.speed * v), spin: [0.0, 0.0, case.spin], ..p })
            .collect();
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8] {
            let (whole, half) = (case.firsts(tolerance, &particles), case.firsts(tolerance / 2.0, &particles));
            for (n, (a, b)) in whole.iter().zip(half).enumerate() {
                assert!((a / b - 1.0).abs() <= tolerance, "{}, {n} at {tolerance}: {a} {b}", case.name);
            }
        }
    }
}
