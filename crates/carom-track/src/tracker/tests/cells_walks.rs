//! Random walks through meshes whose space goes on elsewhere: nothing holds spheres there. Seeds are fixed.

use super::cells::domain;
use super::cells_beyond::{sides, wedge};
use super::*;
use crate::domain::Carry;
use crate::flow::cells::tests::{Dice, shaken, with_velocity};
use crate::force::RandomWalk;
use carom_cfd::block::Kind;
use carom_cfd::{Field, Mesh, PatchKind, Snapshot};

/// Turbulence of 0.08 m/s and 0.15 s.
fn turbulent(mut snapshot: Snapshot) -> AnyDomain {
    let points = snapshot.mesh.points.len();
    snapshot.fields.k = Some(Field::Points(vec![[0.01]; points]));
    snapshot.fields.epsilon = Some(Field::Points(vec![[0.01]; points]));
    domain(&snapshot).with_friction(1.5e-5)
}

/// Spheres of 3 to 30 µm walk between floor and ceiling, which bounce them back.
fn walk(domain: &AnyDomain, from: [Vec3; 2], what: &str) {
    let mut dice = Dice::new(8);
    let mut start = |i: u64| {
        let r = dice.point();
        let x = [0, 1, 2].map(|c| from[0][c] + r[c] * (from[1][c] - from[0][c]));
        Particle::sphere(i, [3e-6, 10e-6, 30e-6][i as usize % 3], 1000.0, x, [0.0; 3])
    };
    let starts: Vec<_> = (0..9).map(&mut start).collect();
    for random_walk in [RandomWalk::default(), RandomWalk::langevin()] {
        let mut d = Dynamics { random_walk: Some(random_walk), ..dynamics(Drag::SchillerNaumann) };
        d.forces.gravity = [0.0; 3];
        let settings = Settings { until: 0.7, max_steps: 20_000, ..settings() };
        let behaviors = vec![bounce(1.0); domain.walls().len()];
        let mut log = Log::default();
        Tracker { domain, dynamics: &d, behaviors: &behaviors, settings }
            .run(&mut starts.iter().copied(), &mut log)
            .unwrap();
        let most = log.ends.iter().map(|e| e.steps).max().unwrap();
        assert!(log.stalled == 0, "{what}, {:?}: {} stalled", random_walk.model, log.stalled);
        assert!(log.ends.iter().all(|e| e.fate == ParticleFate::Airborne), "{what}");
        // where something holds a sphere there is no end to its steps
        assert!(most < 5_000, "{what}, {:?}: {most} steps", random_walk.model);
    }
}

fn block(kinds: impl Fn(&str) -> PatchKind, seed: u64) -> Mesh {
    // what is as near to the floor as to the ceiling is a plane that leads into the sides
    let mut mesh = shaken(Kind::Tetrahedra, [5, 6, 5], 0.2, seed);
    for x in &mut mesh.points {
        *x = x.map(|c| 0.1 * c);
    }
    for patch in &mut mesh.patches {
        patch.kind = kinds(&patch.name);
    }
    mesh
}

#[test]
fn planes_of_symmetry_hold_no_walking_sphere() {
    let kinds = |name: &str| if matches!(name, "bottom" | "top") { PatchKind::Wall } else { PatchKind::Symmetry };
    // point values that lead into the mirrors by a little, as interpolation leaves them
    let flow = |x: Vec3| [0.1 * (x[1] - 0.02), 0.0, 0.003];
    let domain = turbulent(with_velocity(block(kinds, 2), flow));
    walk(&domain, [[0.001; 3], [0.099; 3]], "between mirrors");
}

#[test]
fn cyclic_patches_hold_no_walking_sphere() {
    let kinds = |name: &str| match name {
        "left" => PatchKind::Cyclic { partner: 1, carry: Carry::by([0.1, 0.0, 0.0]) },
        "right" => PatchKind::Cyclic { partner: 0, carry: Carry::by([-0.1, 0.0, 0.0]) },
        "bottom" | "top" => PatchKind::Wall,
        _ => PatchKind::Symmetry,
    };
    // bent alike on both sides, and otherwise on one than on the other inside
    let place = |x: Vec3| {
        let (s, _) = carom::math::sin_cos(std::f64::consts::PI * x[0]);
        [0.1 * (x[0] + 0.1 * s * x[1]), 0.1 * (x[1] + 0.3 * x[1] * (1.0 - x[1]) * x[2]), 0.1 * x[2]]
    };
    let domain = turbulent(with_velocity(sides([6, 7, 5], kinds, place), |_| [0.05, 0.0, 0.0]));
    walk(&domain, [[0.001, 0.001, 0.001], [0.099; 3]], "cyclic");
}

#[test]
fn sides_of_a_wedge_hold_no_walking_sphere() {
    let half = 2.5f64.to_radians();
    let kinds = |name: &str| match name {
        "left" => PatchKind::Cyclic { partner: 1, carry: Carry::by([0.1, 0.0, 0.0]) },
        "right" => PatchKind::Cyclic { partner: 0, carry: Carry::by([-0.1, 0.0, 0.0]) },
        "back" | "front" => PatchKind::Wedge,
        _ => PatchKind::Wall,
    };
    let mesh = wedge([6, 8, 1], kinds, [0.1, 0.1], half);
    let domain = turbulent(with_velocity(mesh, |_| [0.05, 0.0, 0.0]));
    walk(&domain, [[0.01, 0.01, 0.0], [0.09, 0.09, 1e-4]], "wedge");
}
