//! Random triangulations of shapes against the shapes.

use super::super::super::{Cylinder, Plane, Room};
use super::*;
use crate::random::{Purpose, Stream};
use crate::vector::{dot, frame, scale, unit};

/// A patch of (u, v) in [0, 1]² as triangles: `n` × `n` quadrilaterals whose inner corners are moved at random, with either
/// diagonal and either winding.
pub(super) fn patch(n: usize, seed: u64, point: impl Fn(f64, f64) -> Vec3) -> Vec<Triangle> {
    let mut draws = Stream::new(seed, 0, Purpose::Injection, 0);
    let mut ticks: Vec<f64> = (0..=n).map(|i| i as f64 / n as f64).collect();
    for t in &mut ticks[1..n] {
        *t += (draws.uniform() - 0.5) * 0.6 / n as f64;
    }
    let mut corners = vec![vec![[0.0; 3]; n + 1]; n + 1];
    for i in 0..=n {
        for j in 0..=n {
            let inner = (1..n).contains(&i) && (1..n).contains(&j);
            let shift = |u: f64| if inner { (u - 0.5) * 0.3 / n as f64 } else { 0.0 };
            let (u, v) = (shift(draws.uniform()), shift(draws.uniform()));
            corners[i][j] = point(ticks[i] + u, ticks[j] + v);
        }
    }
    let mut all = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let [a, b, c, d] = [corners[i][j], corners[i + 1][j], corners[i + 1][j + 1], corners[i][j + 1]];
            let two = if draws.uniform() < 0.5 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            all.extend(two.map(|[a, b, c]| if draws.uniform() < 0.5 { [a, b, c] } else { [c, b, a] }));
        }
    }
    all
}

/// The six sides of a room, each a patch.
fn room_of_triangles(room: &Room, n: usize, seed: u64) -> Vec<Triangle> {
    let mut all = Vec::new();
    for axis in 0..3 {
        for level in [room.min[axis], room.max[axis]] {
            all.extend(patch(n, seed, |u, v| {
                let mut x = [level; 3];
                for (c, s) in [((axis + 1) % 3, u), ((axis + 2) % 3, v)] {
                    x[c] = if s == 1.0 { room.max[c] } else { room.min[c] + s * (room.max[c] - room.min[c]) };
                }
                x
            }));
        }
    }
    all
}

#[test]
fn a_room_of_random_triangles_is_the_room() {
    let room = Room { min: [-0.3, 0.0, 1.0], max: [0.7, 2.0, 4.0] };
    for (n, seed) in [(1, 1), (3, 2), (10, 3)] {
        let mesh = Mesh::new(&room_of_triangles(&room, n, seed)).unwrap();
        assert_eq!((mesh.len(), mesh.surface.flats.len()), (12 * n * n, 6));
        let inside = (-0.19f64..0.59, 0.11f64..1.89, 1.11f64..3.89).prop_map(|(x, y, z)| [x, y, z]);
        let by = prop::array::uniform3(-4.0f64..4.0);
        let bend = prop::array::uniform4(prop::array::uniform3(-0.5f64..0.5));
        proptest!(ProptestConfig::with_cases(500), |(x in inside, by in by, bend in bend, point in any::<bool>())| {
            let path = bent(x, by, bend);
            let clearance: f64 = if point { 0.0 } else { 0.1 };
            let reach = clearance.max(mesh.skin);
            let (a, b) = (mesh.meet(&path, clearance, 1e-14).map(|(m, _)| m), room.meet(&path, reach, 1e-14));
            prop_assert_eq!(a.is_some(), b.is_some(), "{:?} {:?}", a, b);
            if let (Some(a), Some(b)) = (a, b) {
                prop_assert!((a.theta - b.theta).abs() < 1e-10, "{:?} {:?}", a, b);
                prop_assert!(norm(sub(a.position, b.position)) < 1e-10);
                // two sides at once are met in either order
                prop_assert!(a.normal == b.normal || (a.theta - b.theta).abs() < 1e-13, "{:?} {:?}", a, b);
            }
            let touched = mesh.distance(x) - room.distance(x);
            prop_assert!(touched.abs() < 1e-12);
        });
    }
}

/// A sphere glides over a flat wall of triangles, however it is turned and rounded, and meets nothing.
#[test]
fn nothing_is_met_along_a_flat_wall() {
    let r = 0.01;
    proptest!(ProptestConfig::with_cases(60), |(
        n in prop::array::uniform3(-1.0f64..1.0), origin in prop::array::uniform3(-1.0f64..1.0), turned in any::<bool>(),
        rounded in any::<bool>(), seed in any::<u64>(), ends in prop::collection::vec(0.02f64..0.98, 16),
    )| {
        let n = if turned { unit(n).unwrap_or([0.0, 1.0, 0.0]) } else { [0.0, 1.0, 0.0] };
        let (t, b) = frame(n);
        let on = |u: f64, v: f64| add(origin, add(scale(t, u), scale(b, v)));
        let round = |x: Vec3| if rounded { x.map(|c| f64::from(c as f32)) } else { x };
        let all = patch(8, seed, |u, v| round(on(u, v)));
        let mesh = Mesh::with_precision(&all, if rounded { 2.5e-7 } else { 0.0 }).unwrap();
        // turned in double precision it is flat but for the last digits
        prop_assert_eq!(mesh.surface.flats.len(), 1);
        prop_assert!(mesh.triangles().iter().zip(&all).all(|((_, a), b)| (0..3).all(|i| norm(sub(a[i], b[i])) < 1e-6)));
        let flat = mesh.surface.flats[0];
        let up = scale(flat.normal, dot(flat.normal, n).signum());
        for ends in ends.chunks_exact(4) {
            let over = |u: f64, v: f64| { let x = on(u, v); add(x, scale(up, r - dot(up, sub(x, flat.point)))) };
            let (from, to) = (over(ends[0], ends[1]), over(ends[2], ends[3]));
            // along the plane and up by what rounding may not hide
            let by = add(sub(to, from), scale(up, 1e-14));
            let path = Path::straight(from, by);
            prop_assert_eq!(mesh.meet(&path, r, 1e-9 * r), None);
            // all its seams are passed as the plane is: pressed down, it is in contact at once, with the plane's normal
            let pressed = Path::straight(from, add(sub(to, from), scale(up, -1e-3)));
            let (m, _) = mesh.meet(&pressed, r, 1e-9 * r).unwrap();
            prop_assert!(m.theta == 0.0 && m.normal == up, "{:?}", m);
            let plane = Plane { point: flat.point, normal: up };
            let falling = bent(add(from, scale(up, 0.1)), add(sub(to, from), scale(up, -0.3)), [scale(up, 0.01); 4]);
            let (a, b) = (mesh.meet(&falling, r, 1e-9 * r).unwrap().0, plane.meet(&falling, r, 1e-9 * r).unwrap());
            prop_assert!((a.theta - b.theta).abs() < 1e-13 && norm(sub(a.position, b.position)) < 1e-14 && a.normal == b.normal);
        }
    });
}

#[test]
fn hanging_corners_make_no_seam() {
    // two rows of triangles on one floor whose corners do not match along z = 0
    let mut all = Vec::new();
    for i in 0..10 {
        let x = f64::from(i);
        all.extend([
            [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 0.0, 1.0]],
            [[x + 1.0, 0.0, 0.0], [x + 1.0, 0.0, 1.0], [x, 0.0, 1.0]],
        ]);
        let w = 0.7 * x;
        all.extend([
            [[w, 0.0, 0.0], [w + 0.7, 0.0, 0.0], [w, 0.0, -1.0]],
            [[w + 0.7, 0.0, 0.0], [w + 0.7, 0.0, -1.0], [w, 0.0, -1.0]],
        ]);
    }
    let mesh = Mesh::new(&all).unwrap();
    let r = 0.05;
    for sink in [0.0, 1e-17, 1e-16, 3e-16, -1e-16] {
        for by in [[5.0, 0.0, 0.9], [0.3, 0.0, 0.9], [0.0, 0.0, 0.9], [6.0, 0.0, 1e-3]] {
            let path = Path::straight([0.1, r - sink, -0.5 * by[2]], by);
            assert_eq!(mesh.meet(&path, r, 1e-15 + 1e-9 * r), None, "{sink} {by:?}");
            let (m, _) = mesh
                .meet(
                    &Path { start: [0.1, 0.3, -0.5 * by[2]], ..Path::straight([0.0; 3], [by[0], -0.3, by[2]]) },
                    r,
                    1e-12,
                )
                .unwrap();
            assert_eq!(m.normal, [0.0, 1.0, 0.0]);
        }
    }
    // pressed into the corner that hangs, it stands on the floor
    let touched: Vec<_> = {
        let mut list = Vec::new();
        mesh.touched([0.7, r, 0.0], r, 1e-9 * r, &mut |_, n, _| list.push(n));
        list
    };
    assert!(!touched.is_empty() && touched.iter().all(|n| *n == [0.0, 1.0, 0.0]), "{touched:?}");
}

#[test]
fn a_pipe_of_triangles_is_the_pipe_to_its_facets() {
    let (radius, n) = (0.01, 96);
    let pipe = Cylinder { point: [0.0; 3], axis: [1.0, 0.0, 0.0], radius, inside: true };
    let mut all = Vec::new();
    let at = |i: usize, x: f64| {
        let (s, c) = (2.0 * std::f64::consts::PI * (i % n) as f64 / n as f64).sin_cos();
        [x, radius * c, radius * s]
    };
    for k in 0..20 {
        let (x, y) = (0.002 * f64::from(k) - 0.02, 0.002 * f64::from(k) - 0.018);
        for i in 0..n {
            all.extend([[at(i, x), at(i + 1, x), at(i, y)], [at(i + 1, y), at(i + 1, x), at(i, y)]]);
        }
    }
    let mesh = Mesh::new(&all).unwrap();
    let sagitta = radius * (1.0 - (std::f64::consts::PI / n as f64).cos());
    proptest!(ProptestConfig::with_cases(1000), |(
        x in (-0.005f64..0.005, -0.006f64..0.006, -0.006f64..0.006), by in prop::array::uniform3(-0.02f64..0.02), point in any::<bool>(),
    )| {
        let path = Path::straight([x.0, x.1, x.2], [0.3 * by[0], by[1], by[2]]);
        let clearance = if point { 0.0 } else { 2e-4 };
        let (a, b) = (mesh.meet(&path, clearance, 1e-13).map(|(m, _)| m), pipe.meet(&path, clearance, 1e-13));
        if let Some(m) = a {
            let gap = pipe.distance(m.position) - clearance;
            prop_assert!(gap > -1e-12 && gap < sagitta + 1e-12, "{}", gap);
            prop_assert!(dot(m.normal, pipe.normal(m.position)) > (2.0 * std::f64::consts::PI / n as f64).cos());
        }
        prop_assert!(a.is_some() || b.is_none_or(|b| b.theta > 0.9), "{:?} {:?}", a, b);
    });
}
