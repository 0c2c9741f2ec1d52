//! Captured spheres that the flow takes off again.

use super::*;
use crate::flow::{Channel, Profile};
use carom::removal::Mode;

const ADHESIVE: &str = "sphere = \"copper\"\nsurface = \"silicon\"\nnormal = \"ea\"\nfriction = 0.2\n";

fn fall(removal: Option<Reentrainment>) -> Log {
    fall_on(ADHESIVE, removal)
}

/// Spheres of 20 µm that fall slowly onto a plate in a turbulent channel and stay.
fn fall_on(text: &str, removal: Option<Reentrainment>) -> Log {
    let flow = Channel::new(Profile::Turbulent, 0.03, 10.0, &Fluid::default()).unwrap();
    let domain = AnyDomain::new(Flow::Channel(flow), vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let laws = vec![law(text)];
    let behavior = match removal {
        None => Behavior::Law(laws),
        Some(removal) => Behavior::Removal(laws, removal),
    };
    let particles: Vec<_> =
        (0..5).map(|n| Particle { diameter: 20e-6, ..sphere(n, [0.0, 1e-4, 0.0], [0.0; 3]) }).collect();
    track(&domain, &dynamics(Drag::SchillerNaumann), &[behavior], settings(), &particles)
}

fn held(text: &str) -> carom::removal::Removal {
    let air = Fluid::default();
    let fluid = carom::removal::Fluid { density: air.density, viscosity: air.viscosity };
    law(text).removal(20e-6, &fluid).unwrap().unwrap()
}

#[test]
fn a_flow_faster_than_the_critical_one_removes_and_a_slower_one_does_not() {
    assert!(fall(None).ends.iter().all(|e| e.fate == ParticleFate::Captured));
    for (mode, event) in
        [(None, Mode::Rolling), (Some(Mode::Sliding), Mode::Sliding), (Some(Mode::Lifting), Mode::Lifting)]
    {
        let critical = held(ADHESIVE).of(event).unwrap().friction_velocity;
        let at =
            |share: f64| fall(Some(Reentrainment { mode, friction_velocity: Some(share * critical), follow: false }));
        assert!(at(0.999).ends.iter().all(|e| e.fate == ParticleFate::Captured), "{mode:?}");
        let log = at(1.001);
        assert!(log.ends.iter().all(|e| e.fate == ParticleFate::Removed && e.velocity == [0.0; 3]), "{mode:?}");
        assert!(log.impacts.iter().all(|i| i.event == Event::Remove(event)), "{mode:?}");
        // the impact itself is the capture it was
        let (kept, gone) = (fall(None).impacts, log.impacts);
        assert_eq!(
            kept.iter().map(|i| i.energy).collect::<Vec<_>>(),
            gone.iter().map(|i| i.energy).collect::<Vec<_>>()
        );
    }
}

#[test]
fn the_flows_own_friction_velocity_counts_where_none_is_given() {
    let flow = Channel::new(Profile::Turbulent, 0.03, 10.0, &Fluid::default()).unwrap();
    let own = flow.friction_velocity();
    for (factor, fate) in [(1.0, ParticleFate::Captured), (0.002, ParticleFate::Removed)] {
        let text = format!("{ADHESIVE}roughness_factor = {factor}\n");
        assert_eq!(own > held(&text).rolling.friction_velocity, fate == ParticleFate::Removed, "{own}");
        let log = fall_on(&text, Some(Reentrainment::default()));
        assert!(log.ends.iter().all(|e| e.fate == fate), "{factor}: {:?}", log.ends[0]);
    }
}

/// The speed of a rolling sphere in an even shear against its closed form, written out: resistances of Goldman, Cox & Brenner, forces of
/// O'Neill, the moment of adhesion. Then the wall ends.
#[test]
fn a_sphere_that_is_followed_rolls_as_the_closed_form_says_and_leaves_where_the_wall_ends() {
    use std::f64::consts::PI;
    let (air, radius, density) = (Fluid::default(), 1e-5f64, 1000.0);
    let critical = held(ADHESIVE).rolling.friction_velocity;
    let roll = |share: f64, until: f64, wall: Wall| {
        let domain = AnyDomain::new(Flow::Uniform { velocity: [3.0, 0.0, 0.0] }, vec![wall]);
        let removal = Reentrainment { mode: None, friction_velocity: Some(share * critical), follow: true };
        let behavior = Behavior::Removal(vec![law(ADHESIVE)], removal);
        let p = Particle { diameter: 2e-5, density, ..sphere(0, [0.0, 1.2e-5, 0.0], [0.0, -0.01, 0.0]) };
        let settings = Settings { until, tolerance: 1e-8, ..settings() };
        track(&domain, &dynamics(Drag::SchillerNaumann), &[behavior], settings, &[p])
    };
    let floor = || plane("floor", [0.0; 3], [0.0, 1.0, 0.0]);
    assert_eq!(roll(0.999, 0.01, floor()).ends[0].fate, ParticleFate::Captured);
    for share in [1.001, 1.2] {
        let log = roll(share, 0.01, floor());
        let (hit, end) = (log.impacts[0], log.ends[0]);
        assert_eq!((hit.event, hit.normal_speed_out, hit.tangential_speed_out), (Event::Rebound, 0.0, 0.0));
        assert_eq!(end.fate, ParticleFate::Sliding, "{end:?}");
        let (mu, u) = (air.viscosity, share * critical);
        let shear = u * u * air.density / mu;
        let mass = 4.0 / 3.0 * PI * radius.powi(3) * density;
        let log_gap = (radius / air.mean_free_path).ln();
        let resists = PI * mu * radius * radius * (4.8 * log_gap + 11.8372);
        let drives = (6.0 * 1.7009 + 4.0 * 0.944) * PI * mu * radius.powi(3) * shear - held(ADHESIVE).adhesion_moment;
        let (last, tau) = (drives / resists, 1.4 * mass * radius / resists);
        let t = end.time - hit.time;
        let decay = (-t / tau).exp();
        let (v, way) = (last * (1.0 - decay), last * (t - tau * (1.0 - decay)));
        assert!((end.velocity[0] / v - 1.0).abs() < 1e-4, "{end:?} {v}");
        assert!(((end.position[0] - hit.position[0]) / way - 1.0).abs() < 1e-4, "{end:?} {way}");
        assert!((-end.spin[2] * radius / v - 1.0).abs() < 1e-4 && (end.position[1] - radius).abs() < 1e-12, "{end:?}");
    }
    let block = Shape::Mesh(crate::geometry::Mesh::block([-1e-3, -1e-3, -1e-3], [2e-4, 0.0, 1e-3]).unwrap());
    let log = roll(1.2, 0.05, Wall { shape: block, ..floor() });
    let off = log.impacts[1];
    assert_eq!((off.event, log.impacts.len()), (Event::RollOff, 2), "{:?}", log.impacts);
    assert!((off.position[0] - 2e-4).abs() < 2e-6, "{off:?}");
    assert!(log.ends[0].fate == ParticleFate::Airborne && log.ends[0].position[0] > 0.1, "{:?}", log.ends[0]);
}

/// On the floor of a pipe that air crosses, weakly held: it climbs until its weight balances the shear less the moment of adhesion, and
/// no flow at all means that it stays.
#[test]
fn a_sphere_that_is_followed_rests_where_its_weight_holds_it() {
    use crate::geometry::Cylinder;
    use std::f64::consts::PI;
    let (air, radius, density, bore) = (Fluid::default(), 1e-5f64, 1000.0, 5e-3);
    let text = format!("{ADHESIVE}roughness_factor = 1e-4\n");
    let held = held(&text);
    let mass = 4.0 / 3.0 * PI * radius.powi(3) * density;
    // 2.3302 · 6πμR² G = M/R + m g (1 − ρ/ρ_p) sin φ
    let sine = 0.3;
    let weight = mass * G * (1.0 - air.density / density);
    let per_shear = (6.0 * 1.7009 + 4.0 * 0.944) * PI * air.viscosity * radius * radius;
    let shear = (held.adhesion_moment / radius + weight * sine) / per_shear;
    let u = (shear * air.viscosity / air.density).sqrt();
    let run = |velocity: Vec3| {
        let shape = Shape::Cylinder(Cylinder { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: bore, inside: true });
        let wall = Wall { shape, ..plane("pipe", [0.0; 3], [0.0, 1.0, 0.0]) };
        let domain = AnyDomain::new(Flow::Uniform { velocity }, vec![wall]);
        let removal = Reentrainment { mode: None, friction_velocity: Some(u), follow: true };
        let p = Particle { diameter: 2.0 * radius, density, ..sphere(0, [0.0, -bore + 1.01 * radius, 0.0], [0.0; 3]) };
        let behavior = Behavior::Removal(vec![law(&text)], removal);
        track(&domain, &dynamics(Drag::Stokes), &[behavior], Settings { until: 60.0, ..settings() }, &[p]).ends[0]
    };
    let end = run([1e-3, 0.0, 0.0]);
    assert_eq!(end.fate, ParticleFate::Settled, "{end:?}");
    assert!((end.position[0] / ((bore - radius) * sine) - 1.0).abs() < 1e-3, "{end:?}");
    assert_eq!(run([0.0; 3]).fate, ParticleFate::Removed);
}
