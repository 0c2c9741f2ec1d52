//! Between walls: an even density, the barometric profile, first passages.

use super::*;
use carom_track::flow::Flow;
use carom_track::geometry::Room;
use carom_track::random::{Purpose, Stream};
use carom_track::record::ParticleFate;

fn still(walls: Vec<Wall>) -> AnyDomain {
    AnyDomain::new(Flow::Still, walls)
}

/// Counts of spheres in 20 slices of an elastic box, χ², after a time in which they spread over it.
fn even(spheres: u64, seed: u64, width: f64) {
    let d = air();
    let diameter = 6e-8;
    let s = scales(&d, diameter);
    let (wide, radius) = (width * s.free, 0.5 * diameter);
    let room = Room { min: [-0.5 * wide - radius; 3], max: [0.5 * wide + radius; 3] };
    let domain = still(vec![Wall::new("room", Shape::Room(room))]);
    let until = 0.5 * wide * wide / s.diffusivity;
    let log = track(&domain, &d, &[elastic()], (until, seed), (0..spheres).map(|i| sphere(i, diameter, [0.0; 3])));
    assert!(log.ends.iter().all(|e| e.fate == ParticleFate::Airborne), "some settled");
    let mut bins = [0u32; 20];
    for x in log.ends.iter().flat_map(|e| e.position) {
        bins[(((x / wide + 0.5) * 20.0) as usize).min(19)] += 1;
    }
    let mean = (3 * spheres) as f64 / 20.0;
    let chi: f64 = bins.iter().map(|&c| (f64::from(c) - mean).powi(2) / mean).sum();
    let heat = mean_square(log.ends.iter().flat_map(|e| e.velocity)) / s.thermal.powi(2);
    println!("seed {seed}: χ² {chi:.1} of 19, heat {heat:.3}, {} impacts", log.impacts.len());
    assert!(log.impacts.len() as u64 > 5 * spheres);
    // one in a thousand
    assert!(chi < 43.8, "{bins:?}");
    assert!((heat - 1.0).abs() < 4.0 * (2.0 / (3 * spheres) as f64).sqrt(), "{heat}");
}

#[test]
fn between_elastic_walls_the_density_is_even_and_nothing_settles() {
    even(250, 5, 30.0);
}

#[test]
#[ignore = "long: many spheres, for an even density to a few per cent"]
fn the_density_is_even_to_a_few_per_cent() {
    even(20_000, 15, 30.0);
    even(2_000, 16, 300.0);
}

/// Heights above an elastic floor under a weight that makes the atmosphere `scale` stopping distances high.
fn barometric(spheres: u64, seed: u64, scale: f64) {
    let mut d = air();
    let s = scales(&d, 1e-7);
    let height = scale * s.free;
    // less the buoyancy
    let g = s.thermal.powi(2) / height;
    d.forces.gravity = [0.0, -g / (1.0 - d.fluid.density / 1000.0), 0.0];
    let domain = still(vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let until = 8.0 * height * height / s.diffusivity;
    let starts = (0..spheres).map(|i| sphere(i, 1e-7, [0.0, height, 0.0]));
    let log = track(&domain, &d, &[elastic()], (until, seed), starts);
    assert!(log.ends.iter().all(|e| e.fate == ParticleFate::Airborne), "some settled");
    let mut heights: Vec<_> = log.ends.iter().map(|e| e.position[1] / height).collect();
    let mean = heights.iter().sum::<f64>() / spheres as f64;
    let off = kolmogorov(&mut heights, |h| 1.0 - (-h).exp());
    println!("seed {seed}: mean height {mean:.3} kT/mg, Kolmogorov {off:.2}");
    assert!(off < 1.95 && (mean - 1.0).abs() < 4.0 / (spheres as f64).sqrt());
}

#[test]
fn weight_and_diffusion_make_the_barometric_profile() {
    barometric(150, 7, 20.0);
}

#[test]
#[ignore = "long: thousands of spheres"]
fn the_barometric_profile_of_thousands() {
    barometric(4_000, 17, 5.0);
    barometric(2_000, 18, 50.0);
}

/// The extrapolated end of the density at an absorbing wall: ζ(½) stopping distances behind it (Milne's problem of the Klein–Kramers equation).
const MILNE: f64 = 1.4603;

/// Probability of a standard normal deviate below x.
fn normal(x: f64) -> f64 {
    carom::math::normal::normal_probability(x)
}

/// How many are caught by a floor that they sink to from `from` stopping distances, against Smoluchowski's solution.
fn sinking(spheres: u64, seed: u64, from: f64) {
    let mut d = air();
    let s = scales(&d, 1e-7);
    let height = from * s.free;
    // as much drift as diffusion over the height
    let w = 2.0 * s.diffusivity / height;
    d.forces.gravity = [0.0, -w / s.tau / (1.0 - d.fluid.density / 1000.0), 0.0];
    let domain = still(vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let until = 0.4 * height / w;
    let starts = (0..spheres).map(|i| sphere(i, 1e-7, [0.0, height, 0.0]));
    let log = track(&domain, &d, &[Behavior::Trap], (until, seed), starts);
    let caught = log.impacts.len() as f64 / spheres as f64;
    // from rest, behind time by τ in the drift and 3τ/2 in the spread; absorbed Milne's distance behind the wall
    let far = height + MILNE * s.free;
    let (drift, spread) = (w * (until - s.tau), (2.0 * s.diffusivity * (until - 1.5 * s.tau)).sqrt());
    let want = normal((drift - far) / spread) + (w * far / s.diffusivity).exp() * normal(-(drift + far) / spread);
    let error = (want * (1.0 - want) / spheres as f64).sqrt();
    println!("seed {seed}: {caught:.4} caught, {want:.4} by Smoluchowski, standard error {error:.4}");
    assert!((caught - want).abs() < 4.0 * error);
}

#[test]
fn sedimentation_with_diffusion_to_a_floor() {
    sinking(300, 8, 1e4);
}

#[test]
#[ignore = "long: tens of thousands of spheres"]
fn sedimentation_with_diffusion_to_a_floor_to_half_a_per_cent() {
    sinking(30_000, 18, 1e5);
    sinking(30_000, 19, 200.0);
}

/// The share that has touched neither of two plates, against the series.
fn survival(spheres: u64, seed: u64, width: f64, time: f64) {
    let d = air();
    let s = scales(&d, 6e-8);
    let (wide, behind) = (width * s.free, MILNE * s.free);
    let domain =
        still(vec![plane("low", [0.0; 3], [0.0, 1.0, 0.0]), plane("high", [0.0, wide, 0.0], [0.0, -1.0, 0.0])]);
    let until = time * wide * wide / s.diffusivity;
    let start = |i| Stream::new(seed, i, Purpose::Injection, 0).uniform() * wide;
    let starts = (0..spheres).map(|i| sphere(i, 6e-8, [0.0, start(i), 0.0]));
    let log = track(&domain, &d, &[Behavior::Trap, Behavior::Trap], (until, seed), starts);
    let left = log.ends.iter().filter(|e| e.fate == ParticleFate::Airborne).count() as f64 / spheres as f64;
    let all = wide + 2.0 * behind;
    let t = s.diffusivity * (until - s.tau) / (all * all);
    let pi = std::f64::consts::PI;
    // even between the plates, absorbed behind them
    let want: f64 = (0..40)
        .map(|n| {
            let k = pi * f64::from(2 * n + 1);
            let mean = ((k * behind / all).cos() - (k * (1.0 - behind / all)).cos()) / (k * wide / all);
            4.0 / k * mean * (-k * k * t).exp()
        })
        .sum();
    let error = (want * (1.0 - want) / spheres as f64).sqrt();
    println!("seed {seed}: {left:.4} left, {want:.4} by the series, standard error {error:.4}");
    assert!((left - want).abs() < 4.0 * error);
}

#[test]
fn survival_between_absorbing_plates() {
    survival(400, 9, 1e4, 0.05);
    survival(400, 10, 1e4, 0.2);
}

#[test]
#[ignore = "long: tens of thousands of spheres"]
fn survival_between_absorbing_plates_to_half_a_per_cent() {
    for (seed, width) in [(20, 1e5), (21, 1e3), (22, 100.0)] {
        for time in [0.02, 0.1, 0.3] {
            survival(20_000, seed, width, time);
        }
    }
}

#[test]
fn round_and_triangulated_walls_keep_what_is_between_them() {
    use carom_track::geometry::{Cylinder, Mesh};
    let d = air();
    let s = scales(&d, 6e-8);
    let wide = 100.0 * s.free;
    let pipe = Cylinder { point: [0.0; 3], axis: [1.0, 0.0, 0.0], radius: wide, inside: true };
    let rod = Cylinder { radius: 0.2 * wide, inside: false, ..pipe };
    let block = Mesh::block([-2.0 * wide, -2.0 * wide, -2.0 * wide], [-wide, 2.0 * wide, 2.0 * wide]).unwrap();
    let shapes = [Shape::Cylinder(pipe), Shape::Cylinder(rod), Shape::Mesh(block.clone())];
    let domain = still(shapes.into_iter().map(|shape| Wall::new("w", shape)).collect());
    let starts = (0..60).map(|i| sphere(i, 6e-8, [0.0, 0.6 * wide, 0.0]));
    let log = track(&domain, &d, &[elastic(), elastic(), elastic()], (3000.0 * s.tau, 10), starts);
    for wall in 0..3 {
        assert!(log.impacts.iter().filter(|i| i.wall == wall).count() > 20, "{wall}");
    }
    let (inner, outer) = (0.2 * wide + 3e-8, wide - 3e-8);
    for e in &log.ends {
        let r = e.position[1].hypot(e.position[2]);
        assert!(e.fate == ParticleFate::Airborne && r > inner * 0.999_999 && r < outer * 1.000_001, "{e:?}");
        assert!(e.position[0] > -wide, "{e:?}");
    }
}
