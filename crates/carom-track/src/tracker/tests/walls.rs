//! What walls of each kind do.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays")]

use super::*;

#[test]
fn a_sphere_at_rest_on_the_floor_settles_at_once_and_one_against_a_side_wall_falls() {
    let walls = vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0]), plane("side", [0.0; 3], [1.0, 0.0, 0.0])];
    let domain = AnyDomain::new(Flow::Still, walls);
    let behaviors = [bounce(0.5), bounce(0.5)];
    let r = 45e-6;
    let at_rest = sphere(0, [0.1, r, 0.0], [0.0; 3]);
    let beside = sphere(1, [r, 0.01, 0.0], [0.0; 3]);
    let corner = sphere(2, [r + 0.01, r + 0.01, 0.0], [-0.5, -0.5, 0.0]);
    let log = track(&domain, &dynamics(Drag::None), &behaviors, settings(), &[at_rest, beside, corner]);
    let first = |n| log.impacts.iter().find(|i: &&ImpactRecord| i.particle == n).unwrap();
    assert_eq!((first(0).time, first(0).event), (0.0, Event::Settle));
    assert_eq!(first(1).wall, 0);
    assert!((first(1).time - (2.0 * (0.01 - r) / G).sqrt()).abs() < 1e-12);
    // off the side wall one slides on: nothing rubs
    let fate = |n: u64| log.ends.iter().find(|e| e.particle.number == n).unwrap().fate;
    assert_eq!([fate(0), fate(1), fate(2)], [ParticleFate::Settled, ParticleFate::Settled, ParticleFate::Sliding]);
    for e in &log.ends {
        assert!((e.position[1] - r).abs() < 1e-12 && e.position[0] >= r * (1.0 - 1e-9), "{e:?}");
    }
}

#[test]
fn a_sphere_driven_into_a_corner_by_the_flow_stays_there() {
    // two walls at 60 degrees, the wind along their bisector into the wedge
    let (s, c) = 30f64.to_radians().sin_cos();
    let walls = vec![plane("low", [0.0; 3], [s, c, 0.0]), plane("high", [0.0; 3], [s, -c, 0.0])];
    let domain = AnyDomain::new(Flow::Uniform { velocity: [-3.0, 0.0, 0.0] }, walls);
    let mut f = dynamics(Drag::Stokes);
    f.forces.gravity = [0.0; 3];
    let p = sphere(0, [0.01, 0.002, 0.0], [0.0, 0.3, 0.0]);
    let log = track(&domain, &f, &[bounce(0.6), bounce(0.6)], settings(), &[p]);
    assert_eq!(log.ends[0].fate, ParticleFate::Settled, "{:?}", log.ends[0]);
    let x = log.ends[0].position;
    let gap = |wall: usize| domain.walls()[wall].shape.distance(x) - 45e-6;
    assert!(gap(0) > -1e-12 && gap(1) > -1e-12, "{} {}", gap(0), gap(1));
}

#[test]
fn no_force_no_end_but_the_time() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let mut f = dynamics(Drag::None);
    f.forces.gravity = [0.0; 3];
    // along the wall, touching it: nothing presses, so it glides on
    let p = sphere(0, [0.0, 45e-6, 0.0], [1.0, 0.0, 0.0]);
    let log = track(&domain, &f, &[bounce(0.5)], settings(), &[p]);
    assert_eq!(log.ends[0].fate, ParticleFate::Airborne);
    assert_eq!(log.ends[0].position, [10.0, 45e-6, 0.0]);
}

#[test]
fn contact_at_the_centre_comes_one_radius_later() {
    let mut wall = plane("floor", [0.0; 3], [0.0, 1.0, 0.0]);
    wall.contact_at = ContactAt::Center;
    let domain = AnyDomain::new(Flow::Still, vec![wall]);
    let p = sphere(0, [0.0, 0.01, 0.0], [0.0; 3]);
    let log = track(&domain, &dynamics(Drag::None), &[Behavior::Escape], settings(), &[p]);
    assert!((log.impacts[0].time - (2.0 * 0.01 / G).sqrt()).abs() < 1e-12);
    assert_eq!(log.ends[0].fate, ParticleFate::Escaped);
    assert_eq!(log.impacts[0].normal_speed_out, log.impacts[0].normal_speed_in);
}

#[test]
fn elastic_spheres_in_a_pipe_keep_energy_and_stay_inside() {
    let pipe = Cylinder { point: [0.0; 3], axis: [1.0, 0.0, 0.0], radius: 0.005, inside: true };
    let wall = Wall {
        name: "pipe".into(),
        shape: Shape::Cylinder(pipe),
        contact_at: ContactAt::Surface,
        velocity: [0.0; 3],
        patch: None,
    };
    let domain = AnyDomain::new(Flow::Still, vec![wall]);
    let f = dynamics(Drag::None);
    let p = sphere(0, [0.0, 0.001, 0.002], [0.1, 0.7, -0.4]);
    let log = track(&domain, &f, &[bounce(1.0)], Settings { until: 1.0, ..settings() }, &[p]);
    assert!(log.impacts.len() > 50);
    let energy = |y: f64, v: f64| G * y + 0.5 * v * v;
    let v0 = (0.1f64.powi(2) + 0.7f64.powi(2) + 0.4f64.powi(2)).sqrt();
    for i in &log.impacts {
        let v = i.normal_speed_in.hypot(i.tangential_speed_in);
        assert!((energy(i.position[1], v) / energy(0.001, v0) - 1.0).abs() < 1e-10);
        assert!((pipe.distance(i.position) - 45e-6).abs() < 1e-15);
    }
}

#[test]
fn a_moving_wall_is_a_resting_one_seen_from_it() {
    let belt = [1.5, 0.0, -0.5];
    let law = "normal = \"constant\"\nrestitution = 0.7\ntangential = \"rolling\"\nfriction = 0.3\n";
    let law = carom::spec::parse_law(law).unwrap().compile(carom::material::Library::builtin()).unwrap();
    let behaviors = [Behavior::Law(vec![law])];
    let run = |wall: Vec3, v: Vec3| {
        let wall = Wall { velocity: wall, ..plane("belt", [0.0; 3], [0.0, 1.0, 0.0]) };
        let domain = AnyDomain::new(Flow::Still, vec![wall]);
        let p = sphere(0, [0.0, 0.01, 0.0], v);
        track(&domain, &dynamics(Drag::None), &behaviors, Settings { until: 0.3, ..settings() }, &[p])
    };
    let (moving, resting) = (run(belt, [1.0, 0.0, 0.0]), run([0.0; 3], [-0.5, 0.0, 0.5]));
    assert_eq!(moving.impacts.len(), resting.impacts.len());
    assert!(moving.impacts.len() > 3);
    for (a, b) in moving.impacts.iter().zip(&resting.impacts) {
        assert!((a.time - b.time).abs() < 1e-12);
        assert!((a.tangential_speed_out - b.tangential_speed_out).abs() < 1e-12);
        assert!((a.spin_out - b.spin_out).abs() < 1e-9 * b.spin_out.abs().max(1.0));
        for c in 0..3 {
            assert!((a.position[c] - belt[c] * a.time - b.position[c]).abs() < 1e-12);
        }
    }
}
