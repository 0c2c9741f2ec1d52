//! Nothing passes between triangles that share an edge or a corner.

use super::*;
use crate::random::{Purpose, Stream};
use crate::vector::{dot, scale, unit};

/// A sphere of radius 1 as triangles: an icosahedron's, each divided into four `times` times.
fn icosphere(times: u32) -> Vec<Triangle> {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let mut corners = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        corners.extend([[0.0, a, b], [a, b, 0.0], [b, 0.0, a]]);
    }
    let near = |a: Vec3, b: Vec3| norm(sub(a, b)) < 2.0 + 1e-9;
    let mut all: Vec<Triangle> = Vec::new();
    for i in 0..12 {
        for j in 0..i {
            for k in 0..j {
                let t = [corners[i], corners[j], corners[k]];
                if near(t[0], t[1]) && near(t[1], t[2]) && near(t[0], t[2]) {
                    all.push(t.map(|x| unit(x).unwrap()));
                }
            }
        }
    }
    assert_eq!(all.len(), 20);
    for _ in 0..times {
        let middle = |a: Vec3, b: Vec3| unit(add(a, b)).unwrap();
        all = all
            .iter()
            .flat_map(|[a, b, c]| {
                let [d, e, f] = [middle(*a, *b), middle(*b, *c), middle(*c, *a)];
                [[*a, d, f], [d, *b, e], [f, e, *c], [d, e, f]]
            })
            .collect();
    }
    all
}

/// Control points that bend a path between its ends, but not at 0.5, where its aim is.
fn bow(start: Vec3, aim: Vec3, bend: Vec3) -> Path {
    let by = scale(sub(aim, start), 2.0);
    // 5 (1 − θ)⁴ θ and 5 (1 − θ) θ⁴ are equal in the middle
    bent(start, by, [bend, [0.0; 3], [0.0; 3], scale(bend, -1.0)])
}

#[test]
fn aimed_at_edges_and_corners_from_both_sides_no_point_passes() {
    let sphere = icosphere(2);
    let mesh = Mesh::new(&sphere).unwrap();
    let mut draws = Stream::new(7, 0, Purpose::Injection, 0);
    let mut aims = 0;
    for t in &sphere {
        for i in 0..3 {
            let (a, b) = (t[i], t[(i + 1) % 3]);
            for share in [0.0, 0.5, draws.uniform(), draws.uniform()] {
                let aim = add(a, scale(sub(b, a), share));
                for out in [0.3, 2.5] {
                    let from = [draws.uniform(), draws.uniform(), draws.uniform()].map(|u| u - 0.5);
                    let from = add(scale(aim, out), scale(from, 0.3));
                    for bend in [0.0, 0.1] {
                        let bend = [draws.uniform(), draws.uniform(), draws.uniform()].map(|u| bend * (u - 0.5));
                        let path = bow(from, aim, bend);
                        let met = mesh.meet(&path, 0.0, 1e-15);
                        // a bowed path may meet a neighbour first
                        let near = met.is_some_and(|(m, _)| m.theta < 0.5 + 1e-9);
                        assert!(near, "{from:?} {aim:?} {bend:?} {met:?}");
                        aims += 1;
                    }
                }
            }
        }
    }
    assert!(aims > 15_000);
}

/// Elastic flights in a closed vessel, with gravity: none gets out, by edges and corners neither.
fn flights(mesh: &Mesh, clearance: f64, seed: u64, steps: usize, inside: impl Fn(Vec3) -> bool) {
    let mut draws = Stream::new(seed, 0, Purpose::Injection, 0);
    let mut x = [0.0, 0.0, 0.0];
    let mut v = [draws.uniform() - 0.5, draws.uniform() - 0.5, draws.uniform() - 0.5];
    let corners: Vec<Vec3> = mesh.triangles().iter().flat_map(|(_, t)| *t).collect();
    let mut standing = 0;
    for step in 0..steps {
        let h = 0.5 * draws.uniform();
        let g = [0.0, -0.1, 0.0];
        let at = |s: f64| [0, 1, 2].map(|c| h * s * v[c] + 0.5 * h * h * g[c] * s * (5.0 * s - 1.0) / 4.0);
        let path = Path { start: x, points: [0.2, 0.4, 0.6, 0.8, 1.0].map(at) };
        let slack = 1e-15 + 1e-9 * clearance;
        let theta = match mesh.meet(&path, clearance, slack) {
            Some((m, _)) => {
                let now = [0, 1, 2].map(|c| v[c] + g[c] * h * m.theta);
                v = sub(now, scale(m.normal, 2.0 * dot(now, m.normal).min(0.0)));
                x = m.position;
                m.theta
            }
            None => {
                x = path.at(1.0);
                v = [0, 1, 2].map(|c| v[c] + g[c] * h);
                1.0
            }
        };
        standing = if theta > 0.0 { 0 } else { standing + 1 };
        // wedged, or now and then: off again, at a corner or the middle of an edge
        if standing > 20 || step % 50 == 0 {
            let i = (draws.uniform() * corners.len() as f64) as usize;
            let aim = if step % 100 == 0 {
                corners[i]
            } else {
                scale(add(corners[i], corners[i - i % 3 + (i + 1) % 3]), 0.5)
            };
            (v, standing) = (sub(aim, x), 0);
        }
        assert!(inside(x), "seed {seed}, step {step}: {x:?}");
    }
}

#[test]
fn no_flight_leaves_a_vessel_of_triangles() {
    let ball = Mesh::new(&icosphere(1)).unwrap();
    for (seed, clearance) in [(1, 0.0), (2, 1e-6), (3, 1e-2), (4, 0.0)] {
        flights(&ball, clearance, seed, 20_000, |x| norm(x) < 1.0);
    }
    let cube = Mesh { solid: None, ..Mesh::block([-0.5; 3], [0.5; 3]).unwrap() };
    for (seed, clearance) in [(5, 0.0), (6, 1e-2)] {
        flights(&cube, clearance, seed, 20_000, |x| x.iter().all(|c| c.abs() <= 0.5 - clearance + 1e-13));
    }
}

#[test]
fn the_diagonal_of_a_flat_quadrilateral_lets_no_point_through() {
    let mesh = Mesh::new(&[
        [[0.0; 3], [3e-3, 1e-3, 0.0], [3e-3, 1e-3, 4e-3]],
        [[0.0; 3], [3e-3, 1e-3, 4e-3], [0.0, 0.0, 4e-3]],
    ])
    .unwrap();
    let mut draws = Stream::new(11, 0, Purpose::Injection, 0);
    for _ in 0..4000 {
        let aim = scale([3e-3, 1e-3, 4e-3], 0.05 + 0.9 * draws.uniform());
        let from = [draws.uniform(), 4.0, draws.uniform()].map(|u| 1e-3 * (u - 0.5));
        for side in [1.0, -1.0] {
            let path = Path::straight(add(aim, scale(from, side)), scale(from, -2.0 * side));
            assert!(mesh.meet(&path, 0.0, 1e-15).is_some(), "{aim:?} {from:?}");
        }
    }
}
