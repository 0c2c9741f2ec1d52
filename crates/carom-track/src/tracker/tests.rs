use super::*;
use crate::domain::{AnyDomain, ContactAt, Wall};
use crate::dynamics::Dynamics;
use crate::flow::{Flow, Fluid};
use crate::force::{Drag, Forces};
use crate::geometry::{Cylinder, Plane, Shape};
use crate::record::{End, Event, ImpactRecord, ParticleFate};

const G: f64 = 9.81;

#[derive(Default)]
struct Log {
    impacts: Vec<ImpactRecord>,
    ends: Vec<End>,
    stalled: u32,
}

impl Sink for Log {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, impact: &ImpactRecord) {
        self.impacts.push(*impact);
    }
    fn contact_ended(&mut self, row: &ImpactRecord) {
        self.impacts.push(*row);
    }
    fn point(&mut self, _: u64, _: f64, _: Vec3, _: Vec3, _: Vec3) {}
    fn end(&mut self, end: &End) {
        self.ends.push(*end);
    }
    fn stalled(&mut self) {
        self.stalled += 1;
    }
}

fn plane(name: &str, point: Vec3, normal: Vec3) -> Wall {
    Wall {
        name: name.into(),
        shape: Shape::Plane(Plane { point, normal }),
        contact_at: ContactAt::Surface,
        velocity: [0.0; 3],
        patch: None,
    }
}

fn law(text: &str) -> carom::WallLaw {
    carom::spec::parse_law(text).unwrap().compile(carom::material::Library::builtin()).unwrap()
}

fn bounce(restitution: f64) -> Behavior {
    rough_bounce(restitution, 0.0)
}

/// On facets of the given deviation, degrees.
fn rough_bounce(restitution: f64, angle: f64) -> Behavior {
    Behavior::Law(vec![law(&format!(
        "normal = \"constant\"\nrestitution = {restitution}\ntangential_restitution = 1.0\nroughness_angle = \"{angle} deg\"\n"
    ))])
}

fn dynamics(drag: Drag) -> Dynamics {
    let forces = Forces { gravity: [0.0, -G, 0.0], buoyancy: drag != Drag::None, drag, ..Forces::default() };
    Dynamics { forces, ..Dynamics::default() }
}

fn settings() -> Settings {
    Settings { tolerance: 1e-6, until: 10.0, settle_height: SettleHeight::DEFAULT, max_steps: 1_000_000, seed: 1 }
}

fn sphere(number: u64, position: Vec3, velocity: Vec3) -> Particle {
    Particle {
        number,
        injection: 0,
        diameter: 90e-6,
        density: 8940.0,
        weight: 1.0,
        time: 0.0,
        position,
        velocity,
        spin: [0.0; 3],
    }
}

fn track(
    domain: &AnyDomain,
    dynamics: &Dynamics,
    behaviors: &[Behavior],
    settings: Settings,
    particles: &[Particle],
) -> Log {
    let mut log = Log::default();
    Tracker { domain, dynamics, behaviors, settings }.run(&mut particles.iter().copied(), &mut log).unwrap();
    assert_eq!(log.ends.len(), particles.len());
    assert_eq!(log.stalled, 0);
    log
}

#[test]
fn fall_and_bounces_in_vacuum_are_analytic_to_1e_9_until_it_settles() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let (e, drop) = (0.8, 0.1);
    let p = sphere(0, [0.0, drop + 45e-6, 0.0], [0.3, 0.0, 0.0]);
    let log = track(&domain, &dynamics(Drag::None), &[bounce(e)], settings(), &[p]);
    let mut time = (2.0 * drop / G).sqrt();
    let mut speed = G * time;
    for (n, hit) in log.impacts.iter().enumerate() {
        assert!((hit.time / time - 1.0).abs() < 1e-9, "{n}: {} {time}", hit.time);
        assert!((hit.normal_speed_in / speed - 1.0).abs() < 1e-9, "{n}: {} {speed}", hit.normal_speed_in);
        assert!((hit.position[0] - 0.3 * time).abs() < 1e-9 * time);
        assert!((hit.position[1] / 45e-6 - 1.0).abs() < 1e-12);
        speed *= e;
        time += 2.0 * speed / G;
    }
    // rises e^{2n} · 0.1 m: below 1e-3 radii after n = 33 impacts
    let expected = (45e-9f64 / drop).ln() / (2.0 * e.ln());
    assert_eq!(log.impacts.len(), expected.ceil() as usize);
    // nothing rubs: it slides on
    assert!(log.impacts.iter().all(|i| i.event == Event::Rebound));
    let end = log.ends[0];
    assert_eq!((end.fate, end.time), (ParticleFate::Sliding, 10.0));
    assert!((end.velocity[0] / 0.3 - 1.0).abs() < 1e-12 && (end.position[0] / 3.0 - 1.0).abs() < 1e-9, "{end:?}");
}

#[test]
fn a_perfect_bouncer_bounces_to_the_end() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let p = sphere(0, [0.0, 0.001 + 45e-6, 0.0], [0.0; 3]);
    let log = track(&domain, &dynamics(Drag::None), &[bounce(1.0)], settings(), &[p]);
    let fall = (2.0 * 0.001 / G).sqrt();
    assert_eq!(log.impacts.len(), ((10.0 / fall + 1.0) / 2.0) as usize);
    for (n, hit) in log.impacts.iter().enumerate() {
        let time = fall * (2 * n + 1) as f64;
        assert!((hit.time / time - 1.0).abs() < 1e-9, "{n}: {} {time}", hit.time);
    }
    assert_eq!(log.ends[0].fate, ParticleFate::Airborne);
    assert_eq!(log.ends[0].time, 10.0);
}

/// First impact by a fourth-order Runge–Kutta method with small fixed steps and the drag law written out again.
fn first_impact_by_small_steps(height: f64, v: [f64; 2], wind: f64) -> (f64, f64) {
    let air = Fluid::default();
    let (d, rho) = (90e-6, 8940.0);
    let rate = |s: &[f64; 4]| {
        let rel = [wind - s[2], -s[3]];
        let re = air.density * d * rel[0].hypot(rel[1]) / air.viscosity;
        let beta = 18.0 * air.viscosity / (rho * d * d) * (1.0 + 0.15 * re.powf(0.687));
        [s[2], s[3], beta * rel[0], beta * rel[1] - G * (1.0 - air.density / rho)]
    };
    let add = |s: &[f64; 4], k: &[f64; 4], h: f64| [0, 1, 2, 3].map(|i| s[i] + h * k[i]);
    let (mut s, mut t, h) = ([0.0, height, v[0], v[1]], 0.0, 1e-5);
    loop {
        let k1 = rate(&s);
        let k2 = rate(&add(&s, &k1, h / 2.0));
        let k3 = rate(&add(&s, &k2, h / 2.0));
        let k4 = rate(&add(&s, &k3, h));
        let next = [0, 1, 2, 3].map(|i| s[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        if next[1] < 45e-6 {
            // the last bit of the way as a parabola: error (1e-5 s)³ times a small jerk
            let (gap, a) = (s[1] - 45e-6, -k1[3]);
            let dt = 2.0 * gap / (-s[3] + (s[3] * s[3] + 2.0 * a * gap).sqrt());
            return (t + dt, -(s[3] - a * dt));
        }
        s = next;
        t += h;
    }
}

#[test]
fn drag_matches_an_independent_integration() {
    let wind = 2.0;
    let domain =
        AnyDomain::new(Flow::Uniform { velocity: [wind, 0.0, 0.0] }, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let p = sphere(0, [0.0, 0.03, 0.0], [0.0, 0.5, 0.0]);
    let log = track(&domain, &dynamics(Drag::SchillerNaumann), &[Behavior::Trap], settings(), &[p]);
    let (time, speed) = first_impact_by_small_steps(0.03, [0.0, 0.5], wind);
    let hit = log.impacts[0];
    assert!((hit.time / time - 1.0).abs() < 1e-7, "{} {time}", hit.time);
    assert!((hit.normal_speed_in / speed - 1.0).abs() < 1e-7, "{} {speed}", hit.normal_speed_in);
    assert_eq!(log.ends[0].fate, ParticleFate::Trapped);
}

fn channel() -> AnyDomain {
    let flow = Flow::Uniform { velocity: [1.0, 0.2, 0.0] };
    AnyDomain::new(
        flow,
        vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0]), plane("ceiling", [0.0, 0.02, 0.0], [0.0, -1.0, 0.0])],
    )
}

fn scattered(n: u64) -> Particle {
    let s = n as f64;
    Particle {
        diameter: (20.0 + (s * 7.0) % 90.0) * 1e-6,
        ..sphere(
            n,
            [0.0, 0.001 + 0.018 * ((s * 0.37) % 1.0), 0.0],
            [(s * 0.71) % 3.0, (s * 1.3) % 4.0 - 2.0, (s * 0.17) % 1.0],
        )
    }
}

#[test]
fn any_company_gives_the_same_bits() {
    let domain = channel();
    let behaviors = [bounce(0.9), bounce(0.7)];
    let dynamics = dynamics(Drag::SchillerNaumann);
    let settings = Settings { until: 0.3, ..settings() };
    let particles: Vec<_> = (0..100).map(scattered).collect();
    let together = track(&domain, &dynamics, &behaviors, settings, &particles);
    for p in &particles {
        let mut log = Log::default();
        let tracker = Tracker { domain: &domain, dynamics: &dynamics, behaviors: &behaviors, settings };
        tracker.run_plain(&mut std::iter::once(*p), &mut log).unwrap();
        let same: Vec<_> = together.impacts.iter().filter(|i| i.particle == p.number).copied().collect();
        assert_eq!(log.impacts, same);
        assert_eq!(together.ends.iter().find(|e| e.particle.number == p.number), log.ends.first());
    }
}

#[test]
fn small_spheres_follow_the_turbulence_of_a_channel_and_one_lane_gives_the_bits_of_eight() {
    use crate::flow::{Channel, Profile};
    use crate::force::RandomWalk;
    let fluid = Fluid::default();
    let flow = Flow::Channel(Channel::new(Profile::Turbulent, 0.02, 10.0, &fluid).unwrap());
    let walls = vec![plane("low", [0.0; 3], [0.0, 1.0, 0.0]), plane("high", [0.0, 0.02, 0.0], [0.0, -1.0, 0.0])];
    let domain = AnyDomain::new(flow, walls);
    let mut d = dynamics(Drag::SchillerNaumann);
    d.forces.gravity = [0.0; 3];
    let behaviors = [Behavior::Trap, Behavior::Trap];
    let particles: Vec<_> = (0..40)
        .map(|i| Particle { diameter: 5e-6, density: 1000.0, ..sphere(i, [0.0, 0.01, 0.0], [10.0, 0.0, 0.0]) })
        .collect();
    let settings = Settings { until: 0.006, tolerance: 1e-3, ..settings() };
    for walk in [RandomWalk::default(), RandomWalk::langevin()] {
        d.random_walk = Some(walk);
        let log = track(&domain, &d, &behaviors, settings, &particles);
        let spread = log.ends.iter().map(|e| (e.position[1] - 0.01).powi(2)).sum::<f64>() / 40.0;
        // Taylor: at most v' t, at least a tenth of it
        let v = (domain.fluid(0.0, [0.0, 0.01, 0.0]).k * 2.0 / 3.0).sqrt();
        assert!(spread.sqrt() < 1.5 * v * 0.006 && spread.sqrt() > 0.1 * v * 0.006, "{} {}", spread.sqrt(), v * 0.006);
        for p in particles.iter().take(8) {
            let mut alone = Log::default();
            let tracker = Tracker { domain: &domain, dynamics: &d, behaviors: &behaviors, settings };
            tracker.run_plain(&mut std::iter::once(*p), &mut alone).unwrap();
            assert_eq!(log.ends.iter().find(|e| e.particle.number == p.number), alone.ends.first());
        }
    }
}

#[test]
fn a_spinning_sphere_is_lifted_and_slows_down() {
    let domain = AnyDomain::new(Flow::Still, vec![]);
    let mut d = dynamics(Drag::SchillerNaumann);
    d.forces.gravity = [0.0; 3];
    d.forces.magnus = true;
    d.forces.rotational_drag = true;
    let p = Particle { spin: [0.0, 0.0, 2e4], ..sphere(0, [0.0; 3], [2.0, 0.0, 0.0]) };
    let log = track(&domain, &d, &[], Settings { until: 0.05, ..settings() }, &[p]);
    let end = log.ends[0];
    // back-spin about +z of a sphere that flies along +x lifts it along +y; spin decays
    assert!(end.position[1] > 1e-5 && end.spin[2] > 0.0 && end.spin[2] < 2e4, "{end:?}");
    let finer = track(&domain, &d, &[], Settings { until: 0.05, tolerance: 1e-9, ..settings() }, &[p]).ends[0];
    assert!((end.position[1] / finer.position[1] - 1.0).abs() < 1e-5);
    assert!((end.spin[2] / finer.spin[2] - 1.0).abs() < 1e-5);
}

mod any_walls;
mod cells;
mod cells_beyond;
mod cells_brownian;
mod cells_walks;
mod contact;
mod contact_round;
mod follows;
mod removal;
mod scatter;
mod starts;
mod structure;
mod tolerance;
mod walls;
