//! Spheres that follow the fluid: the same answers as their equation has, at every size, in few steps.

use super::*;
use crate::flow::{Channel, Profile, Stagnation, Symmetry, Table};
use crate::force::{RandomWalk, Slip, drag};

/// Sizes from 10 nm to 1 mm, m.
const SIZES: [f64; 8] = [1e-8, 3e-8, 1e-7, 1e-6, 3e-6, 5.5e-6, 1e-5, 1e-3];

fn in_air(drag: Drag) -> Dynamics {
    let mut dynamics = dynamics(drag);
    dynamics.forces.slip = Slip::Davies;
    dynamics
}

fn grain(number: u64, diameter: f64, position: Vec3, velocity: Vec3) -> Particle {
    Particle { diameter, density: 1000.0, ..sphere(number, position, velocity) }
}

/// The speed at which a sphere sinks, m/s, by the fixed point of its drag.
fn sinking(dynamics: &Dynamics, p: &Particle) -> f64 {
    let body = crate::force::Sphere { diameter: p.diameter, density: p.density };
    let fluid = &dynamics.fluid;
    let stokes = dynamics.relaxation_time(&body) * G * (1.0 - fluid.density / p.density);
    (0..200).fold(stokes, |w, _| 0.5 * (w + stokes / drag::schiller_naumann(drag::reynolds(fluid, p.diameter, w))))
}

fn endless(tolerance: f64) -> Settings {
    Settings { tolerance, until: f64::INFINITY, ..settings() }
}

fn plates() -> Vec<Wall> {
    channel().walls().to_vec()
}

fn trap() -> [Behavior; 2] {
    [Behavior::Trap, Behavior::Trap]
}

#[test]
fn every_size_sinks_at_its_speed_and_arrives_in_time() {
    let dynamics = in_air(Drag::SchillerNaumann);
    let floor = AnyDomain::new(Flow::Still, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    for d in SIZES {
        // far enough for the drag: 30 relaxation times of fall
        let mut p = grain(0, d, [0.0; 3], [0.0; 3]);
        let w = sinking(&dynamics, &p);
        let tau = w / G;
        let height = (40.0 * w * tau).max(1e-4);
        p.position[1] = height + 0.5 * d;
        let log = track(&floor, &dynamics, &[Behavior::Trap], endless(1e-6), &[p]);
        let hit = &log.impacts[0];
        assert!((hit.normal_speed_in / w - 1.0).abs() < 1e-6, "{d:e}: {} {w}", hit.normal_speed_in);
        // Stokes: y = w (t − τ); with a drag that rises with the speed sooner, by a part of τ
        let lag = hit.time - height / w;
        let tau = dynamics.relaxation_time(&crate::force::Sphere { diameter: d, density: 1000.0 });
        assert!(lag > 0.0 && lag < 1.001 * tau + 1e-6 * hit.time, "{d:e}: {lag:e} {tau:e}");
        if d < 1e-6 {
            assert!((lag - tau).abs() < 1e-6 * hit.time, "{d:e}: {lag:e} {tau:e}");
        }
        assert!(d > 5.5e-6 || log.ends[0].steps < 80, "{d:e}: {} steps", log.ends[0].steps);
    }
}

#[test]
fn a_micron_of_glass_in_water() {
    let fluid = Fluid { density: 998.0, viscosity: 1e-3, temperature: 293.15, mean_free_path: 0.0 };
    let dynamics = Dynamics { fluid, ..dynamics(Drag::Stokes) };
    let floor = AnyDomain::new(Flow::Still, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let p = Particle { density: 2500.0, ..grain(0, 1e-6, [0.0, 1e-4 + 0.5e-6, 0.0], [0.0; 3]) };
    let log = track(&floor, &dynamics, &[Behavior::Trap], endless(1e-5), &[p]);
    // τ = 1.3889e-7 s; w = τ g (1 − 998/2500) = 8.186e-7 m/s; 0.1 mm in 122.2 s
    let tau = 2500.0 * 1e-12 / 18e-3;
    let w = tau * G * (1.0 - 998.0 / 2500.0);
    let hit = &log.impacts[0];
    assert!((hit.time / (1e-4 / w + tau) - 1.0).abs() < 1e-9, "{}", hit.time);
    assert!((hit.normal_speed_in / w - 1.0).abs() < 1e-9 && (w - 8.186e-7).abs() < 1e-10, "{w:e}");
}

#[test]
fn against_a_plate_spheres_arrive_when_their_closed_form_says() {
    // towards a plate v = −k y: y″ = −β(y′ + k y); the slow root of r² + βr + βk, and the fast one for a start with the fluid's velocity
    let k = 100.0;
    let flow = Flow::Stagnation(
        Stagnation::new(Symmetry::Plane { line: [0.0, 0.0, 1.0] }, [0.0; 3], [0.0, 1.0, 0.0], k).unwrap(),
    );
    let domain = AnyDomain::new(flow, vec![plane("plate", [0.0; 3], [0.0, 1.0, 0.0])]);
    let mut dynamics = in_air(Drag::Stokes);
    dynamics.forces.gravity = [0.0; 3];
    for d in [1e-8, 1e-7, 1e-6, 3e-6, 5.5e-6] {
        let y = 0.01;
        let p = grain(0, d, [0.0, y, 0.0], [0.0, -k * y, 0.0]);
        let beta = 1.0 / dynamics.relaxation_time(&crate::force::Sphere { diameter: d, density: 1000.0 });
        let root = (1.0 - 4.0 * k / beta).sqrt();
        let (slow, fast) = (-2.0 * k / (1.0 + root), -0.5 * beta * (1.0 + root));
        let b = (-k * y - slow * y) / (fast - slow);
        let (a, contact) = (y - b, 0.5 * d);
        // long after the fast one: y = a e^{slow t}
        let time = (contact / a).ln() / slow;
        for tolerance in [1e-4, 1e-6, 1e-8] {
            let log = track(&domain, &dynamics, &[Behavior::Trap], endless(tolerance), &[p]);
            let hit = &log.impacts[0];
            assert!((hit.time / time - 1.0).abs() < tolerance, "{d:e} {tolerance:e}: {} {time}", hit.time);
            let speed = -slow * contact;
            assert!(
                (hit.normal_speed_in / speed - 1.0).abs() < tolerance.max(1e-7),
                "{d:e} {tolerance:e}: {} {speed}",
                hit.normal_speed_in
            );
        }
    }
}

/// A fluid that turns as a solid body about z through the middle of the walls, 5 turns a second, on a grid of one cell in the plane.
fn vortex() -> Flow {
    let mut text = String::from("x,y,z,u,v,w\n");
    for y in [-0.03, 0.05] {
        for x in [-0.04, 0.04] {
            text += &format!("{x},{y},0,{},{},0\n", -31.4 * (y - 0.01), 31.4 * x);
        }
    }
    Flow::Table(Table::from_csv(text.as_bytes()).unwrap())
}

fn flows() -> [(&'static str, Flow); 4] {
    let sheared = Flow::Channel(Channel::new(Profile::Laminar, 0.02, 3.0, &Fluid::default()).unwrap());
    let against = Stagnation::new(Symmetry::Axisymmetric, [0.0; 3], [0.0, 1.0, 0.0], 100.0).unwrap();
    [("still", Flow::Still), ("sheared", sheared), ("stagnation", Flow::Stagnation(against)), ("vortex", vortex())]
}

/// Where spheres start, along the walls, m: far enough out for the vortex to take them to one.
const OUT: f64 = 0.0125;

/// Times and speeds of first impacts, and steps.
fn firsts(flow: &Flow, dynamics: &Dynamics, tolerance: f64, particles: &[Particle]) -> (Vec<[f64; 2]>, u64) {
    let domain = AnyDomain::new(flow.clone(), plates());
    let log = track(&domain, dynamics, &trap(), endless(tolerance), particles);
    let mut out = vec![[f64::NAN; 2]; particles.len()];
    for hit in &log.impacts {
        out[hit.particle as usize] = [hit.time, hit.normal_speed_in];
    }
    (out, log.ends.iter().map(|e| e.steps).max().unwrap_or(0))
}

#[test]
fn halving_the_tolerance_moves_no_first_impact_of_any_size_by_more_than_it() {
    let dynamics = in_air(Drag::SchillerNaumann);
    for (name, flow) in flows() {
        for d in [1e-8, 1e-7, 1e-6, 5.5e-6, 1e-3] {
            let particles: Vec<_> = (0..5)
                .map(|n| {
                    let s = n as f64;
                    let at = [OUT + 1e-3 * s, 0.002 + 0.016 * ((s * 0.37) % 1.0), 0.0];
                    grain(n, d, at, if n % 3 == 0 { [0.0; 3] } else { [s % 3.0, 2.0 - (s * 1.3) % 4.0, 0.3] })
                })
                .collect();
            for tolerance in [1e-3, 1e-5, 1e-7] {
                let (whole, _) = firsts(&flow, &dynamics, tolerance, &particles);
                let (half, _) = firsts(&flow, &dynamics, 0.5 * tolerance, &particles);
                for (n, (a, b)) in whole.iter().zip(half).enumerate() {
                    let off = (a[0] / b[0] - 1.0).abs();
                    assert!(off <= tolerance, "{name}, {d:e}, {n} at {tolerance:e}: {a:?} {b:?}");
                }
            }
        }
    }
}

#[test]
fn nothing_shows_where_the_kind_of_step_changes() {
    let dynamics = in_air(Drag::SchillerNaumann);
    let follows = |d: f64| dynamics.follows(&crate::force::Sphere { diameter: d, density: 1000.0 });
    let (mut below, mut above) = (1e-6, 1e-4);
    for _ in 0..40 {
        let middle = 0.5 * (below + above);
        if follows(middle) { below = middle } else { above = middle }
    }
    assert!(follows(below) && !follows(above) && above / below - 1.0 < 1e-9, "{below:e} {above:e}");
    for (name, flow) in flows() {
        let start = |d: f64| -> Vec<_> {
            let aside =
                |p: Particle| Particle { diameter: d, density: 1000.0, position: [OUT, p.position[1], 0.0], ..p };
            (0..8).map(|n| aside(scattered(n))).collect()
        };
        for tolerance in [1e-4, 1e-6] {
            let (left, _) = firsts(&flow, &dynamics, tolerance, &start(below));
            let (right, _) = firsts(&flow, &dynamics, tolerance, &start(above));
            for (n, (a, b)) in left.iter().zip(right).enumerate() {
                for (a, b) in a.iter().zip(b) {
                    assert!((a / b - 1.0).abs() <= tolerance + 1e-8, "{name}, {n} at {tolerance:e}: {a} {b}");
                }
            }
        }
    }
}

#[test]
fn mixed_company_changes_no_bit() {
    let walk = Some(RandomWalk::default());
    for random_walk in [None, walk] {
        let dynamics = Dynamics { random_walk, ..in_air(Drag::SchillerNaumann) };
        let flow = Flow::Channel(Channel::new(Profile::Turbulent, 0.02, 3.0, &Fluid::default()).unwrap());
        let domain = AnyDomain::new(flow, plates());
        let particles: Vec<_> =
            (0..24).map(|n| Particle { diameter: SIZES[n as usize % 7], density: 1000.0, ..scattered(n) }).collect();
        let settings = Settings { until: 0.01, tolerance: 1e-4, ..settings() };
        let told = |mut log: Log| {
            log.ends.sort_by_key(|e| e.particle.number);
            log.ends.iter().map(|e| (e.steps, e.time.to_bits(), e.position.map(f64::to_bits))).collect::<Vec<_>>()
        };
        let behaviors = [bounce(0.7), bounce(0.7)];
        let together = told(track(&domain, &dynamics, &behaviors, settings, &particles));
        let mut alone = Log::default();
        let tracker = Tracker { domain: &domain, dynamics: &dynamics, behaviors: &behaviors, settings };
        for p in particles {
            tracker.run_plain(&mut std::iter::once(p), &mut alone).unwrap();
        }
        assert_eq!(together, told(alone));
    }
}

#[test]
fn eddies_and_not_relaxation_times_limit_steps() {
    let flow = Flow::Channel(Channel::new(Profile::Turbulent, 0.02, 10.0, &Fluid::default()).unwrap());
    let domain = AnyDomain::new(flow, plates());
    for drift in [false, true] {
        let random_walk = Some(RandomWalk { drift, ..RandomWalk::default() });
        let dynamics = Dynamics { random_walk, ..in_air(Drag::SchillerNaumann) };
        let settings = Settings { until: 0.02, tolerance: 1e-5, ..settings() };
        let steps = |d: f64| {
            let particles: Vec<_> =
                (0..8).map(|n| grain(n, d, [0.0, 0.002 + 0.002 * n as f64, 0.0], [10.0, 0.0, 0.0])).collect();
            track(&domain, &dynamics, &trap(), settings, &particles).ends.iter().map(|e| e.steps).sum::<u64>()
        };
        // 10 nm: 2.9 million relaxation times
        let (small, large) = (steps(1e-8), steps(5e-6));
        assert!(small < 3 * large && small < 8 * 1500, "drift {drift}: {small} {large}");
    }
}

#[test]
fn what_slides_and_rolls_follows_the_fluid_too() {
    // pressed to the floor by its weight in a shear, with friction: slides or rolls to the end
    let flow = Flow::Channel(Channel::new(Profile::Laminar, 0.02, 1.0, &Fluid::default()).unwrap());
    let domain = AnyDomain::new(flow, plates());
    let text = "normal = \"constant\"\nrestitution = 0.5\ntangential = \"rolling\"\nfriction = 0.2\n";
    let rubs = [Behavior::Law(vec![law(text)]), Behavior::Trap];
    for torque in [false, true] {
        let mut dynamics = in_air(Drag::SchillerNaumann);
        dynamics.forces.rotational_drag = torque;
        for d in [1e-8, 1e-7, 1e-6, 5e-6] {
            let settings = Settings { until: 100.0 / d * 1e-8 + 1.0, tolerance: 1e-5, max_steps: 20_000, ..settings() };
            let p = grain(0, d, [0.0, 0.6 * d, 0.0], [0.0; 3]);
            let log = track(&domain, &dynamics, &rubs, settings, &[p]);
            let end = log.ends[0];
            assert_eq!(end.fate, ParticleFate::Sliding, "{d:e} {torque}: {end:?}");
            // the fluid's velocity at the centre, less what friction takes of a slider: u = 6 U y/H at the wall
            let u = 6.0 * 1.0 * 0.5 * d / 0.02;
            assert!(
                end.velocity[0] > 0.3 * u && end.velocity[0] < 1.0001 * u,
                "{d:e} {torque}: {} {u}",
                end.velocity[0]
            );
            println!("{d:e} {torque}: {} of {u}, {} steps", end.velocity[0], end.steps);
        }
    }
}
