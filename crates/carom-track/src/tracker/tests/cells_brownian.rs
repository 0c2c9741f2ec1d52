//! Brownian spheres in meshes whose space goes on elsewhere: as in the whole body, and as theory has it. The seeds are fixed; bounds are four
//! standard errors.

use super::cells::domain;
use super::cells_beyond::{sides, wedge};
use super::*;
use crate::domain::Carry;
use crate::flow::cells::tests::{Dice, with_cell_velocity, with_velocity};
use crate::force::{Slip, Sphere, brownian};
use crate::geometry::Mesh;
use carom_cfd::PatchKind;
use std::f64::consts::PI;

/// Size of the boxes, m.
const SIZE: f64 = 20e-6;
const DIAMETER: f64 = 10e-9;

fn air() -> Dynamics {
    let forces = Forces { slip: Slip::Davies, drag: Drag::Stokes, ..Forces::default() };
    Dynamics { forces: Forces { gravity: [0.0; 3], ..forces }, brownian: true, ..Dynamics::default() }
}

/// D, m²/s.
fn diffusivity(d: &Dynamics) -> f64 {
    let sphere = Sphere { diameter: DIAMETER, density: 1000.0 };
    let thermal = brownian::thermal_speed(&d.fluid, &sphere);
    thermal * thermal * d.relaxation_time(&sphere)
}

/// Between walls that keep what comes.
fn fly(domain: &AnyDomain, until: f64, starts: &[Particle]) -> Log {
    let (d, behaviors) = (air(), vec![Behavior::Trap; domain.walls().len()]);
    let tracker = Tracker { domain, dynamics: &d, behaviors: &behaviors, settings: Settings { until, ..settings() } };
    let mut log = Log::default();
    tracker.run(&mut starts.iter().copied(), &mut log).unwrap();
    assert!(log.stalled == 0 && log.ends.len() == starts.len());
    // of very many some start touching a wall
    let known = [ParticleFate::Airborne, ParticleFate::Trapped, ParticleFate::Overlapping];
    assert!(log.ends.iter().all(|e| known.contains(&e.fate)));
    log
}

/// Spheres spread evenly over `from` to `to`.
fn spread(count: u64, seed: u64, from: Vec3, to: Vec3) -> Vec<Particle> {
    let mut dice = Dice::new(seed);
    let place = |r: Vec3| [0, 1, 2].map(|c| SIZE * (from[c] + r[c] * (to[c] - from[c])));
    (0..count).map(|i| Particle::sphere(i, DIAMETER, 1000.0, place(dice.point()), [0.0; 3])).collect()
}

fn airborne(log: &Log) -> f64 {
    log.ends.iter().filter(|e| e.fate == ParticleFate::Airborne).count() as f64 / log.ends.len() as f64
}

fn is_about(got: f64, want: f64, count: f64, what: &str) {
    let bound = 4.0 * (want * (1.0 - want) / count).sqrt() + 0.004;
    println!("{what}: {got} for {want} ± {bound}");
    assert!((got - want).abs() < bound, "{what}: {got} for {want} ± {bound}");
}

/// What is left of spheres spread evenly between plates `width` apart that keep them.
fn between_plates(width: f64, d_t: f64) -> f64 {
    let term = |n: f64| 8.0 / (n * PI).powi(2) * (-(n * PI / width).powi(2) * d_t).exp();
    (0..40).map(|i| term(2.0 * f64::from(i) + 1.0)).sum()
}

#[test]
fn beside_a_mirror_they_go_as_in_the_whole_body() {
    // the left side keeps them, and its image across the mirror on the right: plates two boxes apart. All other sides are mirrors too
    let kinds = |name: &str| if name == "left" { PatchKind::Wall } else { PatchKind::Symmetry };
    let mesh = sides([3, 2, 2], kinds, |x| x.map(|c| SIZE * c));
    let half = domain(&with_velocity(mesh, |_| [0.0; 3]));
    let count = if cfg!(debug_assertions) { 150 } else { 20_000 };
    let time = 0.3 * SIZE * SIZE / diffusivity(&air());
    let log = fly(&half, time, &spread(count, 1, [0.0; 3], [1.0; 3]));
    is_about(airborne(&log), between_plates(2.0 * SIZE, 0.3 * SIZE * SIZE), count as f64, "airborne");
}

#[test]
fn through_cyclic_patches_they_spread_evenly_and_are_lost_as_between_plates() {
    let kinds = |name: &str| match name {
        "left" => PatchKind::Cyclic { partner: 1, carry: Carry::by([SIZE, 0.0, 0.0]) },
        "right" => PatchKind::Cyclic { partner: 0, carry: Carry::by([-SIZE, 0.0, 0.0]) },
        "bottom" | "top" => PatchKind::Wall,
        _ => PatchKind::Symmetry,
    };
    let time = 0.1 * SIZE * SIZE / diffusivity(&air());
    let mesh = sides([2, 3, 2], kinds, |x| x.map(|c| SIZE * c));
    // carried on through three boxes meanwhile
    let round = domain(&with_velocity(mesh, |_| [3.0 * SIZE / time, 0.0, 0.0]));
    let count = if cfg!(debug_assertions) { 150 } else { 20_000 };
    let log = fly(&round, time, &spread(count, 2, [0.5, 0.0, 0.0], [0.5, 1.0, 1.0]));
    is_about(airborne(&log), between_plates(SIZE, 0.1 * SIZE * SIZE), count as f64, "airborne");
    // where they are along the way: about the middle again, spread by √(2Dt) and folded
    let places = log.ends.iter().filter(|e| e.fate == ParticleFate::Airborne).map(|e| e.position[0] / SIZE);
    let (mut sum, mut n) = (0.0, 0.0);
    for x in places {
        assert!((0.0..=1.0).contains(&x), "{x}");
        sum += (2.0 * PI * x).cos();
        n += 1.0;
    }
    let want = -(-(2.0 * PI).powi(2) * 0.1f64).exp();
    assert!((sum / n - want).abs() < 4.0 * (0.5f64 / n).sqrt(), "{} for {want}", sum / n);
}

#[test]
fn a_wall_behind_a_cyclic_patch_is_near() {
    // a block stands at the left side; spheres start at the right one, from where it is next door
    let kinds = |round: bool| {
        move |name: &str| match name {
            "left" if round => PatchKind::Cyclic { partner: 1, carry: Carry::by([SIZE, 0.0, 0.0]) },
            "right" if round => PatchKind::Cyclic { partner: 0, carry: Carry::by([-SIZE, 0.0, 0.0]) },
            _ => PatchKind::Symmetry,
        }
    };
    let with_block = |round: bool, n: usize, from: f64| {
        let length = n as f64 / 3.0;
        let place = move |x: Vec3| [SIZE * (length * x[0]), SIZE * x[1], SIZE * x[2]];
        let snapshot = with_velocity(sides([n, 2, 2], kinds(round), place), |_| [0.0; 3]);
        let AnyDomain::Meshed(meshed) = domain(&snapshot) else { unreachable!("cells") };
        let mut walls = meshed.walls().list().to_vec();
        let (low, high) = ([SIZE * from, -SIZE, -SIZE], [SIZE * (from + 0.2), 2.0 * SIZE, 2.0 * SIZE]);
        walls.push(Wall::new("block", Shape::Mesh(Mesh::block(low, high).unwrap())));
        AnyDomain::new(Flow::Cells(meshed.cells().clone()), walls)
    };
    let (round, long) = (with_block(true, 3, 0.0), with_block(false, 6, 1.0));
    let count = if cfg!(debug_assertions) { 60 } else { 10_000 };
    let starts = spread(count, 3, [0.9, 0.0, 0.0], [0.97, 1.0, 1.0]);
    let time = 0.02 * SIZE * SIZE / diffusivity(&air());
    let [got, want] = [round, long].map(|domain| airborne(&fly(&domain, time, &starts)));
    is_about(got, want, 0.5 * count as f64, "airborne");
}

#[test]
fn in_a_wedge_they_are_lost_as_in_the_whole_pipe() {
    let half = 5f64.to_radians();
    let kinds = |name: &str| match name {
        "back" | "front" => PatchKind::Wedge,
        "left" | "right" => PatchKind::Symmetry,
        _ => PatchKind::Wall,
    };
    let mesh = wedge([1, 3, 1], kinds, [SIZE, SIZE], half);
    let pipe = domain(&with_cell_velocity(mesh, |_| [0.0; 3]));
    let count = if cfg!(debug_assertions) { 150 } else { 4_000 };
    let mut dice = Dice::new(4);
    let starts: Vec<Particle> = (0..count)
        .map(|i| {
            let r = SIZE * dice.roll().sqrt() * half.cos();
            let (s, c) = carom::math::sin_cos((2.0 * dice.roll() - 1.0) * 0.99 * half);
            Particle::sphere(i, DIAMETER, 1000.0, [0.5 * SIZE, r * c, r * s], [0.0; 3])
        })
        .collect();
    let time = 0.1 * SIZE * SIZE / diffusivity(&air());
    let log = fly(&pipe, time, &starts);
    // zeros of J₀
    let zeros: [f64; 4] = [2.404_825_557_695_773, 5.520_078_110_286_311, 8.653_727_912_911_013, 11.791_534_439_014_281];
    let want: f64 = zeros.iter().map(|j| 4.0 / (j * j) * (-j * j * 0.1f64).exp()).sum();
    is_about(airborne(&log), want, count as f64, "airborne");
}

#[test]
fn what_is_thrown_at_a_mirror_flies_as_in_the_whole_body() {
    let half = sides([4, 3, 2], |name| if name == "right" { PatchKind::Symmetry } else { PatchKind::Wall }, |x| x);
    let whole = sides([8, 3, 2], |_| PatchKind::Wall, |x| [2.0 * x[0], x[1], x[2]]);
    // linear, and so alike on both meshes
    let u = |x: Vec3| [1.0 - x[0], 0.3 * x[1], 0.1];
    let mut dice = Dice::new(5);
    // too large for the molecules to move them by more than a micrometre; spinning, so that they do not glide
    let starts: Vec<Particle> = (0..12)
        .map(|i| {
            let (x, v) = (dice.point().map(|c| 0.2 + 0.6 * c), dice.point().map(|c| 8.0 * c - 4.0));
            Particle { spin: dice.point().map(|c| 100.0 * c), ..Particle::sphere(i, 400e-6, 8000.0, x, v) }
        })
        .collect();
    let mut d = Dynamics { brownian: true, ..Dynamics::default() };
    (d.forces.gravity, d.forces.magnus) = ([0.0; 3], true);
    let ends = |snapshot| {
        let domain = domain(&snapshot);
        let behaviors = vec![Behavior::Trap; domain.walls().len()];
        let tracker = Tracker {
            domain: &domain,
            dynamics: &d,
            behaviors: &behaviors,
            settings: Settings { until: 0.5, ..settings() },
        };
        let mut log = Log::default();
        tracker.run(&mut starts.iter().copied(), &mut log).unwrap();
        log.ends.sort_by_key(|e| e.particle.number);
        log.ends
    };
    let (half, whole) = (ends(with_velocity(half, u)), ends(with_velocity(whole, u)));
    let mut crossed = 0;
    for (got, want) in half.iter().zip(&whole) {
        let [x, y, z] = want.position;
        crossed += usize::from(x > 1.0);
        let off = crate::vector::norm(crate::vector::sub(got.position, [if x > 1.0 { 2.0 - x } else { x }, y, z]));
        assert!(got.fate == want.fate && off < 1e-6, "{}: {off:e} {:?}", got.particle.number, want.fate);
        let spin = if x > 1.0 { [want.spin[0], -want.spin[1], -want.spin[2]] } else { want.spin };
        let turned = crate::vector::norm(crate::vector::sub(got.spin, spin));
        assert!(turned < 1e-3 * crate::vector::norm(spin).max(1.0), "{:?} {spin:?}", got.spin);
    }
    assert!(crossed > 2, "{crossed}");
}
