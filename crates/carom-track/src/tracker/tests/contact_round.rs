//! Contact motion on round and moving walls, against mechanics by hand.

use super::*;
use crate::geometry::Cylinder;
use crate::vector::norm;

const RADIUS: f64 = 0.01;
const SMALL: f64 = 5e-5;

fn falls() -> Dynamics {
    dynamics(Drag::None)
}

fn round(inside: bool) -> AnyDomain {
    let shape = Shape::Cylinder(Cylinder { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: RADIUS, inside });
    AnyDomain::new(Flow::Still, vec![Wall { shape, ..plane("round", [0.0; 3], [0.0, 1.0, 0.0]) }])
}

/// At rest on a round wall, an angle (rad) from its lowest or highest point.
fn touching(inside: bool, angle: f64) -> Particle {
    let (circle, down) = if inside { (RADIUS - SMALL, -1.0) } else { (RADIUS + SMALL, 1.0) };
    let place = [circle * angle.sin(), down * circle * angle.cos(), 0.0];
    Particle { diameter: 2.0 * SMALL, density: 1000.0, ..sphere(0, place, [0.0; 3]) }
}

fn sticky(friction: f64) -> Behavior {
    Behavior::Law(vec![law(&format!(
        "normal = \"constant\"\nrestitution = 0.0\ntangential = \"rolling\"\nfriction = {friction}\n"
    ))])
}

fn follow(domain: &AnyDomain, behavior: Behavior, until: f64, p: Particle) -> Log {
    track(domain, &falls(), &[behavior], Settings { until, tolerance: 1e-8, ..settings() }, &[p])
}

#[test]
fn in_a_pipe_it_swings_as_a_pendulum_and_rolling_slows_it() {
    let (length, angle) = (RADIUS - SMALL, 0.5f64);
    // quarter of a period, K(sin φ/2) √(l/g), by the arithmetic-geometric mean
    let (mut a, mut b) = (1.0f64, (0.5 * angle).cos());
    for _ in 0..6 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let quarter = std::f64::consts::FRAC_PI_2 / a * (length / G).sqrt();
    let height = length * (1.0 - angle.cos());
    // a rolling sphere has 7/5 of the inertia
    for (behavior, inertia) in [(bounce(0.0), 1.0f64), (sticky(10.0), 1.4)] {
        let end = follow(&round(true), behavior, quarter * inertia.sqrt(), touching(true, angle)).ends[0];
        assert_eq!(end.fate, ParticleFate::Sliding, "{end:?}");
        let speed = (2.0 * G * height / inertia).sqrt();
        assert!((norm(end.velocity) / speed - 1.0).abs() < 1e-4, "{inertia}: {} {speed}", norm(end.velocity));
        assert!(end.position[0].abs() < 1e-4 * length, "{inertia}: {:?}", end.position);
        assert!((end.position[1] / -length - 1.0).abs() < 1e-8, "{inertia}: {:?}", end.position);
    }
}

#[test]
fn off_a_rod_it_slides_where_the_weight_no_longer_bends_its_path() {
    let angle = 0.3f64;
    let log = follow(&round(false), bounce(0.0), 1.0, touching(false, angle));
    let off = log.impacts.iter().find(|i| i.event == Event::SlideOff).unwrap();
    // m v²/l = m g cos φ with v² = 2 g l (cos φ₀ − cos φ)
    let cosine = off.position[1] / (RADIUS + SMALL);
    assert!((cosine - 2.0 / 3.0 * angle.cos()).abs() < 1e-4, "{cosine} {}", 2.0 / 3.0 * angle.cos());
    assert_eq!(log.ends[0].fate, ParticleFate::Airborne);
}

#[test]
fn a_belt_takes_along_two_sevenths_of_its_speed() {
    for friction in [0.05, 0.4] {
        let belt = Wall { velocity: [0.7, 0.0, 0.0], ..plane("belt", [0.0; 3], [0.0, 1.0, 0.0]) };
        let domain = AnyDomain::new(Flow::Still, vec![belt]);
        let p = Particle { diameter: 2.0 * SMALL, density: 1000.0, ..sphere(0, [0.0, 2.0 * SMALL, 0.0], [0.0; 3]) };
        let end = follow(&domain, sticky(friction), 5.0, p).ends[0];
        assert_eq!(end.fate, ParticleFate::Sliding, "{end:?}");
        assert!((end.velocity[0] - 0.2).abs() < 1e-6, "{friction}: {:?}", end.velocity);
        // the contact point moves with the belt
        let slip = end.velocity[0] + end.spin[2] * SMALL - 0.7;
        assert!(slip.abs() < 1e-6, "{friction}: {slip}");
        // it fell for t₁, and the friction of fall and slide is f g all told: it slid for v/(f g) since the fall began
        let slid = 0.2 / (friction * G);
        let way = 0.5 * 0.2 * slid + 0.2 * (5.0 - slid);
        let fall = (2.0 * SMALL / G).sqrt();
        assert!((end.position[0] - way).abs() < 0.2 * fall, "{friction}: {} {way}", end.position[0]);
    }
}
