//! In flows: diffusion to the wall of a pipe, spreading along a shear, and spheres that diffusion does not matter to.

use super::*;
use carom_track::flow::{Channel, Flow, Fluid, Pipe, Profile, Stagnation, Symmetry};
use carom_track::geometry::Cylinder;
use carom_track::random::{Purpose, Stream};
use carom_track::record::ParticleFate;

/// Penetration of a laminar pipe (Gormley & Kennedy 1949, Proc. R. Ir. Acad. 52A, 163–169).
fn gormley_kennedy(mu: f64) -> f64 {
    if mu < 0.02 {
        let root = mu.cbrt();
        return 1.0 - 2.5638 * root * root + 1.2 * mu + 0.1767 * mu * root;
    }
    let terms: [(f64, f64); 4] = [(0.81905, 3.6568), (0.09753, 22.305), (0.0325, 56.961), (0.01544, 107.62)];
    terms.iter().map(|(c, k)| c * (-k * mu).exp()).sum()
}

/// Penetration of a pipe of radius 0.5 mm and length 0.1 m by spheres of even concentration at its inlet.
fn penetration(mu: f64, spheres: u64, seed: u64) -> f64 {
    let d = air();
    let diameter = 2e-8;
    let s = scales(&d, diameter);
    let (radius, length, along) = (5e-4, 0.1, [1.0, 0.0, 0.0]);
    let speed = s.diffusivity * length / (radius * radius * mu);
    let flow = Flow::Pipe(Pipe::new(Profile::Laminar, [0.0; 3], along, radius, speed, &Fluid::default()).unwrap());
    let pipe = Cylinder { point: [0.0; 3], axis: along, radius, inside: true };
    let walls = vec![
        Wall { contact_at: ContactAt::Center, ..Wall::new("pipe", Shape::Cylinder(pipe)) },
        plane("outlet", [length, 0.0, 0.0], [-1.0, 0.0, 0.0]),
    ];
    let start = |i| {
        let [q, turn]: [f64; 2] = Stream::new(seed, i, Purpose::Injection, 0).uniforms();
        // the flux within s radii is 2s² − s⁴
        let r = radius * (1.0 - (1.0 - q).sqrt()).sqrt();
        let (sin, cos) = (2.0 * std::f64::consts::PI * turn).sin_cos();
        sphere(i, diameter, [0.0, r * cos, r * sin])
    };
    let domain = AnyDomain::new(flow, walls);
    let log = track(&domain, &d, &[Behavior::Trap, Behavior::Escape], (f64::INFINITY, seed), (0..spheres).map(start));
    let escaped = log.ends.iter().filter(|e| e.fate == ParticleFate::Escaped).count();
    let steps: u64 = log.ends.iter().map(|e| e.steps).sum();
    let got = escaped as f64 / spheres as f64;
    println!("µ {mu}, seed {seed}: {got:.4}, Gormley & Kennedy {:.4}, {} steps", gormley_kennedy(mu), steps / spheres);
    got
}

fn is_gormley_kennedys(mu: f64, spheres: u64, seed: u64) {
    let (got, want) = (penetration(mu, spheres, seed), gormley_kennedy(mu));
    assert!((got - want).abs() < 4.0 * (want * (1.0 - want) / spheres as f64).sqrt(), "{got} {want}");
}

#[test]
fn a_laminar_pipe_loses_what_gormley_and_kennedy_say() {
    is_gormley_kennedys(0.01, 400, 31);
    is_gormley_kennedys(0.1, 400, 32);
}

#[test]
#[ignore = "long: ten thousand spheres for each of seven pipes"]
fn laminar_pipes_from_0_003_to_0_3() {
    for (mu, seed) in [0.003, 0.01, 0.0135, 0.03, 0.1, 0.2, 0.3].into_iter().zip(41..) {
        is_gormley_kennedys(mu, 10_000, seed);
    }
}

/// In an even shear u = G y the mean of x² is 2Dt (1 + G²t²/3) and that of xy is G D t² (Foister & van de Ven 1980, J. Fluid Mech. 96, 105),
/// however long the steps.
#[test]
fn a_shear_spreads_spheres_along_itself() {
    let d = air();
    let s = scales(&d, 1e-7);
    let text = "x,y,u\n-1,-1,-10\n-1,1,10\n1,-1,-10\n1,1,10\n";
    let flow = Flow::Table(carom_track::flow::Table::from_csv(text.as_bytes()).unwrap());
    let domain = AnyDomain::new(flow, vec![]);
    let (time, n) = (0.3, 3_000);
    let g = 10.0;
    let log = track(&domain, &d, &[], (time, 33), (0..n).map(|i| sphere(i, 1e-7, [0.0; 3])));
    let along = mean_square(log.ends.iter().map(|e| e.position[0])) / (2.0 * s.diffusivity * time);
    let cross = log.ends.iter().map(|e| e.position[0] * e.position[1]).sum::<f64>() / n as f64;
    let cross = cross / (s.diffusivity * time);
    let steps = log.ends.iter().map(|e| e.steps).max();
    let gt = g * time;
    println!("seed 33: {along:.3} (4), {cross:.3} (3), {steps:?} steps");
    let error = 4.0 * (2.0 / n as f64).sqrt();
    assert!((along / (1.0 + gt * gt / 3.0) - 1.0).abs() < error);
    assert!((cross / gt - 1.0).abs() < error * 1.5);
}

#[test]
fn large_spheres_go_as_without_molecules() {
    // 5 and 40 µm into a stagnation flow, and through a channel with weight: noise moves them by far less than the tolerance here
    let air_flow = Fluid::default();
    let stagnation =
        Flow::Stagnation(Stagnation::new(Symmetry::Axisymmetric, [0.0; 3], [0.0, 1.0, 0.0], 30.0).unwrap());
    let channel = Flow::Channel(Channel::new(Profile::Laminar, 0.02, 1.0, &air_flow).unwrap());
    for (flow, x) in [(stagnation, [1e-3, 0.01, 0.0]), (channel, [0.0, 0.015, 0.0])] {
        for diameter in [5e-6, 4e-5] {
            let domain = AnyDomain::new(flow.clone(), vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
            let mut with = air();
            with.forces.drag = Drag::SchillerNaumann;
            with.forces.gravity = [0.0, -9.81, 0.0];
            let without = Dynamics { brownian: false, ..with };
            let until = 0.05;
            let end = |d: &Dynamics| {
                let velocity = domain.fluid(0.0, x).velocity;
                let p = Particle { velocity, ..sphere(1, diameter, x) };
                track(&domain, d, &[Behavior::Trap], (until, 34), [p]).ends[0]
            };
            let (a, b) = (end(&with), end(&without));
            assert_eq!(a.fate, b.fate);
            let spread = 6.0 * (2.0 * scales(&with, diameter).diffusivity * until).sqrt();
            let way = (0..3).map(|c| (b.position[c] - x[c]).powi(2)).sum::<f64>().sqrt();
            let off = (0..3).map(|c| (a.position[c] - b.position[c]).powi(2)).sum::<f64>().sqrt();
            println!("{diameter:e}: {off:e} of {way:e}, {spread:e} by chance; {} steps, {} without", a.steps, b.steps);
            // chance is stretched by the flow
            assert!(off < 10.0 * spread + 1e-5 * way, "{off:e} {spread:e} {way:e}");
        }
    }
}

#[test]
fn what_is_thrown_meets_walls_where_it_does_without_molecules() {
    // from 5 µm, some relaxation times on the way, to 0.5 mm that hardly slows down; in a corner, so that walls are met one after the other
    let corner = [plane("floor", [0.0; 3], [0.0, 1.0, 0.0]), plane("side", [0.0; 3], [1.0, 0.0, 0.0])];
    let domain = AnyDomain::new(Flow::Still, corner.to_vec());
    let law = "normal = \"constant\"\nrestitution = 0.8\ntangential_restitution = 0.9\n";
    let law = carom::spec::parse_law(law).unwrap().compile(carom::material::Library::builtin()).unwrap();
    for (diameter, speed, way) in [(5e-6, 1.0, 5e-5), (5e-6, 20.0, 1e-3), (4e-5, 1.0, 2e-3), (5e-4, 2.0, 0.3)] {
        for behavior in [Behavior::Trap, Behavior::Law(vec![law.clone()])] {
            let mut with = air();
            with.forces.drag = Drag::SchillerNaumann;
            let without = Dynamics { brownian: false, ..with };
            let x = [0.7 * way, 0.5 * way, 0.0];
            let p = Particle { velocity: [-speed, -speed, 0.1 * speed], ..sphere(1, diameter, x) };
            let until = 20.0 * way / speed;
            let run = |d: &Dynamics| track(&domain, d, &[behavior.clone(), behavior.clone()], (until, 35), [p]);
            let (a, b) = (run(&with), run(&without));
            assert!(!b.impacts.is_empty() && a.ends[0].fate == b.ends[0].fate, "{:?} {:?}", a.ends, b.ends);
            let spread = 10.0 * (2.0 * scales(&with, diameter).diffusivity * until).sqrt();
            for (a, b) in a.impacts.iter().zip(&b.impacts).take(2) {
                let off = (0..3).map(|c| (a.position[c] - b.position[c]).powi(2)).sum::<f64>().sqrt();
                println!("{diameter:e} m, {speed} m/s: {off:e} of {way:e}, {spread:e} by chance");
                assert!(off < spread + 1e-4 * way, "{off:e} {spread:e} {way:e}");
            }
        }
    }
}
