//! What can be said of a sphere where it starts.

use super::*;
use crate::geometry::Mesh;

fn free() -> Dynamics {
    let mut d = dynamics(Drag::None);
    d.forces.gravity = [0.0; 3];
    d
}

#[test]
fn what_can_never_meet_a_wall_takes_one_step() {
    let floor = || plane("w", [0.0; 3], [0.0, 1.0, 0.0]);
    let block = Wall { shape: Shape::Mesh(Mesh::block([0.0; 3], [1.0; 3]).unwrap()), ..floor() };
    let p = sphere(0, [0.5, 2.0, 0.5], [0.3, 1.0, 0.0]);
    for wall in [floor(), block] {
        let domain = AnyDomain::new(Flow::Still, vec![wall]);
        let run = |until| track(&domain, &free(), &[Behavior::Trap], Settings { until, ..settings() }, &[p]).ends[0];
        let (never, later) = (run(f64::INFINITY), run(1e6));
        assert_eq!((never.fate, never.position, never.steps), (ParticleFate::Airborne, p.position, 0));
        assert_eq!((later.fate, later.time, later.steps), (ParticleFate::Airborne, 1e6, 0));
        assert!((later.position[1] - 1_000_002.0).abs() < 1e-6);
    }
}

#[test]
fn one_that_is_thrown_up_and_held_down_is_no_such_sphere() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("w", [0.0; 3], [0.0, 1.0, 0.0])]);
    let p = sphere(0, [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
    let settings = Settings { until: f64::INFINITY, ..settings() };
    let log = track(&domain, &dynamics(Drag::None), &[Behavior::Trap], settings, &[p]);
    assert_eq!(log.ends[0].fate, ParticleFate::Trapped);
}

#[test]
fn after_a_rebound_into_nothing_it_ends_too() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("w", [0.0; 3], [0.0, 1.0, 0.0])]);
    let p = sphere(0, [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]);
    let settings = Settings { until: f64::INFINITY, ..settings() };
    let log = track(&domain, &free(), &[bounce(0.5)], settings, &[p]);
    assert!(log.ends[0].fate == ParticleFate::Airborne && log.ends[0].steps < 300, "{:?}", log.ends[0]);
}

#[test]
fn drag_stops_it_before_the_wall_and_it_is_where_it_stopped() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("w", [0.0; 3], [0.0, 1.0, 0.0])]);
    let mut d = dynamics(Drag::Stokes);
    d.forces.gravity = [0.0; 3];
    let p = Particle { diameter: 1e-6, ..sphere(0, [0.0, 1e-3, 0.0], [0.0, -1.0, 0.0]) };
    let tau = d.relaxation_time(&crate::force::Sphere { diameter: 1e-6, density: p.density });
    let log = track(&domain, &d, &[Behavior::Trap], Settings { until: 3600.0, ..settings() }, &[p]);
    let end = log.ends[0];
    assert!(end.steps < 500 && (end.position[1] / (1e-3 - tau) - 1.0).abs() < 1e-6, "{end:?} {tau}");
}

#[test]
fn what_cannot_move_ends_at_once_and_what_barely_moves_does_not_stand_still() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("w", [0.0; 3], [0.0, 1.0, 0.0])]);
    let rest = sphere(0, [0.0, 1e-3, 0.0], [0.0; 3]);
    let log = track(&domain, &free(), &[Behavior::Trap], settings(), &[rest]);
    assert_eq!((log.ends[0].fate, log.ends[0].time, log.ends[0].steps), (ParticleFate::Airborne, 10.0, 0));
    let falls = Particle { velocity: [0.0, -5e-324, 0.0], ..rest };
    let log = track(&domain, &dynamics(Drag::SchillerNaumann), &[Behavior::Trap], settings(), &[falls]);
    assert!(log.ends[0].fate == ParticleFate::Trapped && log.ends[0].steps < 500, "{:?}", log.ends[0]);
}

#[test]
fn a_sphere_that_starts_where_a_wall_is_is_not_followed() {
    let rod = crate::geometry::Cylinder { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: 0.01, inside: false };
    let walls = vec![Wall { shape: Shape::Cylinder(rod), ..plane("rod", [0.0; 3], [0.0, 1.0, 0.0]) }];
    let domain = AnyDomain::new(Flow::Still, walls);
    let starts = [[0.005, 0.0, 0.0], [0.01, 0.0, 0.0], [0.0101, 0.0, 0.0]];
    let particles: Vec<_> = starts.iter().enumerate().map(|(n, x)| sphere(n as u64, *x, [0.0; 3])).collect();
    let log = track(&domain, &dynamics(Drag::None), &[Behavior::Trap], settings(), &particles);
    let fate = |n: u64| log.ends.iter().find(|e| e.particle.number == n).unwrap().fate;
    assert_eq!(
        [fate(0), fate(1), fate(2)],
        [ParticleFate::Overlapping, ParticleFate::Overlapping, ParticleFate::Airborne]
    );
}

#[test]
fn walls_without_a_behavior_and_injections_without_a_law_are_refused() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let (d, settings) = (dynamics(Drag::None), settings());
    let run = |behaviors: &[Behavior], injections: &[usize]| {
        let mut log = Log::default();
        let tracker = Tracker { domain: &domain, dynamics: &d, behaviors, settings };
        let mut particles =
            (0..).zip(injections).map(|(n, i)| Particle { injection: *i, ..sphere(n, [0.0, 1e-3, 0.0], [0.0; 3]) });
        (tracker.run(&mut particles, &mut log), log.ends.len())
    };
    assert_eq!(run(&[], &[0]), (Err(TrackerError::Behaviors { walls: 1, behaviors: 0 }), 0));
    assert_eq!(run(&[Behavior::Law(vec![])], &[0]), (Err(TrackerError::NoLaw { wall: "floor".into() }), 0));
    let Behavior::Law(laws) = bounce(0.5) else { unreachable!() };
    // one law is for all injections, two are for two
    assert_eq!(run(&[Behavior::Law(laws.clone())], &[0, 7, 3]), (Ok(()), 3));
    let two = Behavior::Law([laws.clone(), laws].concat());
    let unknown = TrackerError::Injection { particle: 2, injection: 2, laws: 2 };
    assert_eq!(run(&[two], &[0, 1, 2, 0]), (Err(unknown), 2));
}
