//! Walls that scatter in a run.

use super::*;

/// A channel of copper spheres at 10 m/s between two rough plates, without gravity or drag.
fn between_plates(angle: f64, seed: u64) -> Log {
    let walls = vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0]), plane("ceiling", [0.0, 0.02, 0.0], [0.0, -1.0, 0.0])];
    let domain = AnyDomain::new(Flow::Still, walls);
    let mut d = dynamics(Drag::None);
    d.forces.gravity = [0.0; 3];
    let particles: Vec<_> = (0..40).map(|n| sphere(n, [0.0, 0.01, 0.0], [10.0, -0.5, 0.0])).collect();
    let behaviors = [rough_bounce(0.9, angle), rough_bounce(0.9, angle)];
    let settings = Settings { until: 0.2, seed, ..settings() };
    let log = track(&domain, &d, &behaviors, settings, &particles);
    for p in particles.iter().take(4) {
        let mut alone = Log::default();
        let tracker = Tracker { domain: &domain, dynamics: &d, behaviors: &behaviors, settings };
        tracker.run_plain(&mut std::iter::once(*p), &mut alone).unwrap();
        assert_eq!(log.ends.iter().find(|e| e.particle.number == p.number), alone.ends.first(), "in company and alone");
    }
    log
}

#[test]
fn draws_belong_to_seed_particle_and_impact() {
    let log = between_plates(5.0, 1);
    let restitutions = |log: &Log| {
        let mut all: Vec<_> = log.impacts.iter().map(|i| (i.particle, i.time.to_bits(), i.restitution)).collect();
        all.sort_by_key(|i| (i.0, i.1));
        all.into_iter().map(|i| i.2).collect::<Vec<f64>>()
    };
    let first = restitutions(&log);
    assert_eq!(first, restitutions(&between_plates(5.0, 1)));
    assert_ne!(first, restitutions(&between_plates(5.0, 2)));
    let mut distinct = first.clone();
    distinct.sort_by(f64::total_cmp);
    distinct.dedup();
    assert!(distinct.len() > first.len() / 2 && first.len() > 100, "{} of {}", distinct.len(), first.len());
    assert!(first.iter().any(|e| *e > 1.0) && first.iter().all(|e| *e >= 0.0));
}

/// Smooth plates let a shallow beam glance on; rough ones turn it across the channel (Sommerfeld & Huber 1999).
#[test]
fn rough_plates_turn_a_beam_across_the_channel() {
    let transverse = |log: &Log| {
        let sum: f64 = log.ends.iter().map(|e| e.velocity[1].powi(2)).sum();
        (sum / log.ends.len() as f64).sqrt()
    };
    let (smooth, rough) = (between_plates(0.0, 1), between_plates(5.0, 1));
    assert!(smooth.ends.iter().all(|e| e.velocity[2] == 0.0) && transverse(&smooth) < 0.5);
    assert!(transverse(&rough) > 1.0, "{}", transverse(&rough));
    assert!(rough.ends.iter().any(|e| e.velocity[2].abs() > 0.3));
}

#[test]
fn spheres_come_to_rest_on_a_rough_floor() {
    let domain = AnyDomain::new(Flow::Still, vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let rough = law("normal = \"constant\"\nrestitution = 0.8\nfriction = 0.3\nroughness_angle = \"10 deg\"\n");
    let particles: Vec<_> = (0..20).map(|n| sphere(n, [0.0, 0.01, 0.0], [1.0, 0.0, 0.0])).collect();
    let log = track(&domain, &dynamics(Drag::SchillerNaumann), &[Behavior::Law(vec![rough])], settings(), &particles);
    for end in &log.ends {
        assert_eq!(end.fate, ParticleFate::Settled);
        assert!((end.position[1] - 45e-6).abs() < 1e-13, "{end:?}");
    }
    let most = log.impacts.len() / particles.len();
    assert!(most < 500, "{most} impacts a sphere");
}

#[test]
fn a_rough_wall_of_no_angle_is_the_smooth_one() {
    let (smooth, flat) = (between_plates(0.0, 1), between_plates(0.0, 9));
    assert_eq!(smooth.ends, flat.ends);
}
