//! Without walls: Einstein's diffusivity, Maxwell's velocities, and the same bits however they are tracked.

use super::*;
use carom::instructions::InstructionSet;
use carom_track::flow::Flow;

/// Place and velocity spread as those of an Ornstein–Uhlenbeck process that began at rest.
fn spreads(diameter: f64, times: f64, spheres: u64, seed: u64) {
    let (domain, d) = (AnyDomain::new(Flow::Still, vec![]), air());
    let s = scales(&d, diameter);
    let until = times * s.tau;
    let log = track(&domain, &d, &[], (until, seed), (0..spheres).map(|i| sphere(i, diameter, [0.0; 3])));
    let place = mean_square(log.ends.iter().flat_map(|e| e.position));
    let speed = mean_square(log.ends.iter().flat_map(|e| e.velocity));
    let e = (-times).exp();
    let place = place / (s.diffusivity * s.tau * (2.0 * times - 3.0 + 4.0 * e - e * e));
    let heat = speed / (s.thermal * s.thermal * (1.0 - e * e));
    println!("{diameter:e} m, {times} τ, seed {seed}: {place:.4} of 2Dt, {heat:.4} of kT/m");
    let error = 4.0 * (2.0 / (3 * spheres) as f64).sqrt();
    assert!((place - 1.0).abs() < error && (heat - 1.0).abs() < error, "{place} {heat}");
}

#[test]
fn displacements_are_einsteins_and_velocities_maxwells_at_any_time() {
    for (diameter, seed) in [(1e-8, 1), (6e-8, 2), (2e-6, 3)] {
        for times in [0.3, 3.0, 1e3, 1e7] {
            spreads(diameter, times, 1_000, seed);
        }
    }
}

#[test]
#[ignore = "long: a hundred thousand spheres, for one per cent"]
fn diffusivity_and_heat_to_one_per_cent() {
    for (diameter, seed) in [(1e-8, 11), (1e-7, 12), (2e-6, 13)] {
        for times in [3.0, 100.0, 1e6] {
            spreads(diameter, times, 110_000, seed);
        }
    }
}

#[test]
fn heat_is_the_gas_s_at_all_times_of_a_walk() {
    // seen along the way, at times that the steps do not choose
    let (domain, d) = (AnyDomain::new(Flow::Still, vec![]), air());
    let s = scales(&d, 1e-7);
    let n = 27_000;
    let log = track(&domain, &d, &[], (37.3 * s.tau, 4), (0..n).map(|i| sphere(i, 1e-7, [0.0; 3])));
    let heat = mean_square(log.ends.iter().flat_map(|e| e.velocity)) / s.thermal.powi(2);
    println!("seed 4: {heat:.4}");
    assert!((heat - 1.0).abs() < 0.02);
}

#[test]
fn every_set_of_instructions_and_any_company_give_the_same_bits() {
    use carom_track::flow::{Channel, Fluid, Profile};
    let flow = Flow::Channel(Channel::new(Profile::Turbulent, 0.01, 2.0, &Fluid::default()).unwrap());
    let walls = vec![plane("low", [0.0; 3], [0.0, 1.0, 0.0]), plane("high", [0.0, 0.01, 0.0], [0.0, -1.0, 0.0])];
    let domain = AnyDomain::new(flow, walls);
    let mut d = air();
    d.forces.gravity = [0.0, -9.81, 0.0];
    d.forces.saffman = true;
    d.random_walk = Some(carom_track::force::RandomWalk::default());
    let sizes = [1e-8, 6e-8, 1e-6, 3e-5];
    let start = |i: u64| sphere(i, sizes[i as usize % 4], [0.0, 1e-4 + 1e-5 * i as f64, 0.0]);
    let behaviors = [elastic(), Behavior::Trap];
    let settings = Settings { until: 2e-4, seed: 6, ..Settings::default() };
    let tracker = Tracker { domain: &domain, dynamics: &d, behaviors: &behaviors, settings };
    let run = |set, of: &mut dyn Iterator<Item = u64>| {
        let mut log = Log::default();
        tracker.run_on(set, &mut of.map(start), &mut log).unwrap();
        log.ends.sort_by_key(|e| e.particle.number);
        log.ends
    };
    let all = run(InstructionSet::Portable, &mut (0..40));
    for set in InstructionSet::available() {
        assert_eq!(run(set, &mut (0..40)), all, "{set:?}");
    }
    for i in [0, 7, 38] {
        assert_eq!(run(InstructionSet::best(), &mut std::iter::once(i))[0], all[i as usize]);
    }
}
