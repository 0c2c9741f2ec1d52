//! What goes on where bounces have died down.

use super::*;
use crate::geometry::{Mesh, Room};
use crate::vector::{dot, norm, unit};

fn weight(gravity: Vec3) -> Dynamics {
    let mut d = dynamics(Drag::None);
    d.forces.gravity = gravity;
    d
}

fn rough(restitution: f64, friction: f64) -> Behavior {
    Behavior::Law(vec![law(&format!(
        "normal = \"constant\"\nrestitution = {restitution}\ntangential = \"rolling\"\nfriction = {friction}\n"
    ))])
}

fn small(position: Vec3, velocity: Vec3) -> Particle {
    Particle { diameter: 1e-4, density: 1000.0, ..sphere(0, position, velocity) }
}

fn one(walls: Vec<Wall>, behavior: &Behavior, d: &Dynamics, until: f64, p: Particle) -> Log {
    let behaviors = vec![behavior.clone(); walls.len()];
    track(&AnyDomain::new(Flow::Still, walls), d, &behaviors, Settings { until, ..settings() }, &[p])
}

#[test]
fn down_a_slope_without_friction_as_in_free_fall_along_it() {
    let angle = 89f64.to_radians();
    let n = [angle.sin(), angle.cos(), 0.0];
    let start = n.map(|c| 1e-3 * c);
    let log = one(vec![plane("w", [0.0; 3], n)], &bounce(0.5), &weight([0.0, -G, 0.0]), 1.0, small(start, [0.0; 3]));
    let end = log.ends[0];
    let s = norm([0, 1, 2].map(|c| end.position[c] - start[c]));
    assert_eq!((end.fate, end.time), (ParticleFate::Sliding, 1.0));
    assert!((s / (0.5 * G * angle.sin()) - 1.0).abs() < 1e-6, "{s}");
    assert!((dot(end.position, n) - 5e-5).abs() < 1e-13);
}

#[test]
fn along_a_floor_without_friction_at_the_same_speed() {
    let p = small([0.0, 6e-5, 0.0], [10.0, 0.0, 0.0]);
    let log = one(vec![plane("w", [0.0; 3], [0.0, 1.0, 0.0])], &bounce(0.1), &weight([0.0, -G, 0.0]), 1.0, p);
    let end = log.ends[0];
    assert_eq!(end.fate, ParticleFate::Sliding);
    assert!((end.position[0] / 10.0 - 1.0).abs() < 1e-9 && end.steps < 200, "{end:?}");
}

#[test]
fn in_a_groove_the_only_rest_is_its_bottom() {
    let n = |s: f64| unit([s, 1.0, 0.0]).unwrap();
    let walls = vec![plane("L", [0.0; 3], n(1.0)), plane("R", [0.0; 3], n(-1.0))];
    let log = one(walls, &bounce(0.3), &weight([0.0, -G, 0.0]), 2.0, small([5e-4, 2e-3, 0.0], [0.0; 3]));
    let end = log.ends[0];
    assert_eq!(end.fate, ParticleFate::Settled, "{end:?}");
    assert!(end.position[0].abs() < 1e-7 && (end.position[1] / (5e-5 * 2f64.sqrt()) - 1.0).abs() < 1e-3, "{end:?}");
    assert_eq!(log.impacts.iter().filter(|i| i.event == Event::Settle).count(), 1);
}

#[test]
fn no_restitution_takes_the_motion_across_and_no_more() {
    let d = weight([0.0; 3]);
    let p = small([0.0, 1e-3, 0.0], [1.0, -1.0, 0.0]);
    let floor = || vec![plane("w", [0.0; 3], [0.0, 1.0, 0.0])];
    let end = one(floor(), &bounce(0.0), &d, 0.01, p).ends[0];
    assert!((end.position[0] - 0.01).abs() < 1e-12 && (end.position[1] - 5e-5).abs() < 1e-15, "{end:?}");
    assert_eq!(end.velocity, [1.0, 0.0, 0.0]);
    // friction takes its share of the motion along, as of any impact
    let hit = one(floor(), &rough(0.0, 0.1), &d, 0.01, p).impacts[0];
    assert!((hit.tangential_speed_out - 0.9).abs() < 1e-12, "{hit:?}");
    let shares: f64 = hit.energy.named().iter().map(|(_, share)| share).sum();
    assert!((shares - 1.0).abs() < 1e-12, "{:?}", hit.energy);
}

#[test]
fn friction_ends_sliding_in_rolling_with_five_sevenths_of_the_speed() {
    let (f, v) = (0.2, 0.5);
    let p = small([0.0, 5e-5, 0.0], [v, 0.0, 0.0]);
    let log = one(vec![plane("w", [0.0; 3], [0.0, 1.0, 0.0])], &rough(0.5, f), &weight([0.0, -G, 0.0]), 1.0, p);
    let end = log.ends[0];
    assert_eq!(end.fate, ParticleFate::Sliding, "{end:?}");
    let rolling = 5.0 / 7.0 * v;
    let time = 2.0 / 7.0 * v / (f * G);
    let x = v * time - 0.5 * f * G * time * time + rolling * (1.0 - time);
    assert!((end.velocity[0] / rolling - 1.0).abs() < 1e-9, "{end:?}");
    assert!((end.position[0] / x - 1.0).abs() < 1e-6, "{} {x}", end.position[0]);
    assert!((end.spin[2] * -5e-5 / rolling - 1.0).abs() < 1e-9, "{end:?}");
}

#[test]
fn a_rolling_sphere_knocked_off_by_another_wall_rolled_till_then() {
    // its spin drags it up the wall ahead, off the floor
    let walls = vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0]), plane("ahead", [0.2, 0.0, 0.0], [-1.0, 0.0, 0.0])];
    let v = 0.5;
    let p = small([0.0, 5e-5, 0.0], [v, 0.0, 0.0]);
    let log = one(walls, &rough(0.5, 0.2), &weight([0.0, -G, 0.0]), 1.0, p);
    let end = log.impacts.iter().find(|i| matches!(i.event, Event::RollOff | Event::SlideOff)).unwrap();
    assert_eq!((end.event, end.wall), (Event::RollOff, 0), "{:?}", log.impacts);
    let rolling = 5.0 / 7.0 * v;
    assert!((end.tangential_speed_out / rolling - 1.0).abs() < 1e-9, "{end:?}");
    assert!((end.spin_out * 5e-5 / rolling - 1.0).abs() < 1e-9 && end.normal_speed_out == 0.0, "{end:?}");
    assert!((end.energy.friction - 2.0 / 7.0).abs() < 1e-6, "{:?}", end.energy);
    let blow = log.impacts.iter().find(|i| i.wall == 1).unwrap();
    assert!((blow.normal_speed_in / rolling - 1.0).abs() < 1e-9 && blow.time == end.time, "{blow:?}");
}

#[test]
fn a_sphere_rolls_down_a_slope_and_slides_down_a_steep_one() {
    let run = |degrees: f64, f: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        let start = [s * 5e-5, c * 5e-5, 0.0];
        let log = one(
            vec![plane("w", [0.0; 3], [s, c, 0.0])],
            &rough(0.5, f),
            &weight([0.0, -G, 0.0]),
            0.5,
            small(start, [0.0; 3]),
        );
        let end = log.ends[0];
        assert_eq!(end.fate, ParticleFate::Sliding);
        norm(end.velocity) / 0.5
    };
    let sine = |d: f64| d.to_radians().sin();
    assert!((run(20.0, 0.3) / (5.0 / 7.0 * G * sine(20.0)) - 1.0).abs() < 1e-6);
    let steep = G * (sine(60.0) - 0.1 * 60f64.to_radians().cos());
    assert!((run(60.0, 0.1) / steep - 1.0).abs() < 1e-6, "{} {steep}", run(60.0, 0.1));
}

#[test]
fn friction_brings_a_sphere_off_the_edge_of_a_block_with_its_rows() {
    let block = Shape::Mesh(Mesh::block([0.0, -1e-3, -5e-3], [2e-3, 0.0, 5e-3]).unwrap());
    let walls = vec![Wall { shape: block, ..plane("block", [0.0; 3], [0.0, 1.0, 0.0]) }];
    let p = small([1e-3, 5e-5, 1e-4], [0.05, 0.0, 0.0]);
    let log = one(walls, &rough(0.3, 0.2), &weight([0.0, -G, 0.0]), 0.06, p);
    let (begin, end) = (log.impacts[0], log.impacts[1]);
    assert_eq!((begin.event, end.event), (Event::Rebound, Event::RollOff), "{:?}", log.impacts);
    assert!((end.position[0] - 2e-3).abs() < 1e-5, "{end:?}");
    assert!((end.tangential_speed_out / (0.05 * 5.0 / 7.0) - 1.0).abs() < 1e-6, "{end:?}");
    // of the motion's energy friction took two sevenths
    assert!((end.energy.friction - 2.0 / 7.0).abs() < 1e-6, "{:?}", end.energy);
    assert!((end.energy.friction + end.energy.kept - 1.0).abs() < 1e-12);
    // and then it falls
    assert!(log.ends[0].fate == ParticleFate::Airborne && log.ends[0].position[1] < -1e-3, "{:?}", log.ends[0]);
}

#[test]
fn an_updraught_lifts_a_sphere_off_its_floor() {
    // in a table the air begins to rise at x = 10 mm
    let text = "x,u,v\n0,1,0\n0.01,1,0\n0.02,1,5\n0.03,1,5\n";
    let flow = Flow::Table(crate::flow::Table::from_csv(text.as_bytes()).unwrap());
    let domain = AnyDomain::new(flow, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let p = small([5e-3, 5e-5, 0.0], [1.0, 0.0, 0.0]);
    let settings = Settings { until: 0.03, ..settings() };
    let log = track(&domain, &dynamics(Drag::SchillerNaumann), &[bounce(0.5)], settings, &[p]);
    let off = log.impacts.iter().find(|i| i.event == Event::LiftOff).unwrap();
    assert!(off.position[0] > 0.01 && off.position[0] < 0.012, "{off:?}");
    assert!(log.ends[0].fate == ParticleFate::Airborne && log.ends[0].position[1] > 1e-4, "{:?}", log.ends[0]);
}

#[test]
fn kicks_and_eddies_hold_nothing_on_an_elastic_wall() {
    let room = Shape::Room(Room { min: [-2e-7; 3], max: [2e-7; 3] });
    let domain = AnyDomain::new(Flow::Still, vec![Wall { shape: room, ..plane("room", [0.0; 3], [0.0, 1.0, 0.0]) }]);
    let mut d = dynamics(Drag::Stokes);
    d.forces.slip = crate::force::Slip::Davies;
    d.brownian = true;
    // without weight nothing presses; with a great one no height that counts as none is free of the molecules' kicks
    for gravity in [0.0, -8000.0] {
        d.forces.gravity = [0.0, gravity, 0.0];
        let particles: Vec<_> =
            (0..40).map(|n| Particle { diameter: 1e-7, density: 1000.0, ..sphere(n, [0.0; 3], [0.0; 3]) }).collect();
        let settings = Settings { until: 3e-4, tolerance: 1e-3, ..settings() };
        let log = track(&domain, &d, &[bounce(1.0)], settings, &particles);
        assert!(log.impacts.len() > 200, "{}", log.impacts.len());
        let other: Vec<_> = log.ends.iter().filter(|e| e.fate != ParticleFate::Airborne).collect();
        assert!(other.is_empty(), "{gravity}: {other:?}");
    }
}

#[test]
fn without_a_settle_height_endless_bounces_still_end() {
    let p = small([0.0, 1e-3, 0.0], [0.3, 0.0, 0.0]);
    let settings = Settings { until: 1.0, settle_height: SettleHeight::Length(0.0), ..settings() };
    let domain = AnyDomain::new(Flow::Still, vec![plane("w", [0.0; 3], [0.0, 1.0, 0.0])]);
    let log = track(&domain, &weight([0.0, -G, 0.0]), &[bounce(0.5)], settings, &[p]);
    assert_eq!(log.ends[0].fate, ParticleFate::Sliding);
    assert!((log.ends[0].position[0] - 0.3).abs() < 1e-9, "{:?}", log.ends[0]);
}
