use super::*;
use crate::vector::add;
use proptest::prelude::*;

const FLAT: Triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];

fn fly(t: Triangle, from: Vec3, by: Vec3) -> Option<Meeting> {
    Mesh::new(&[t]).unwrap().meet(&Path::straight(from, by), 0.1, 1e-12).map(|(m, _)| m)
}

#[test]
fn face_edge_and_corner_from_both_sides() {
    for s in [1.0, -1.0] {
        let m = fly(FLAT, [0.2, s, 0.2], [0.0, -2.0 * s, 0.0]).unwrap();
        assert!((m.theta - 0.45).abs() < 1e-14 && (m.position[1] - 0.1 * s).abs() < 1e-15);
        assert_eq!(m.normal, [0.0, s, 0.0]);
        // 0.06 beyond the edge along x: the sphere is met 0.08 above it
        let m = fly(FLAT, [0.5, s, -0.06], [0.0, -2.0 * s, 0.0]).unwrap();
        assert!((m.position[1] - 0.08 * s).abs() < 1e-14, "{m:?}");
        assert!((m.normal[2] + 0.6).abs() < 1e-13 && (m.normal[1] - 0.8 * s).abs() < 1e-13);
        // beyond a corner, and too far beyond it
        let m = fly(FLAT, [-0.048, s, -0.036], [0.0, -2.0 * s, 0.0]).unwrap();
        assert!((m.position[1] - 0.08 * s).abs() < 1e-14, "{m:?}");
        assert!(fly(FLAT, [-0.08, s, -0.07], [0.0, -2.0 * s, 0.0]).is_none());
    }
}

#[test]
fn a_sphere_level_with_the_plane_meets_the_edge_not_the_face() {
    let m = fly(FLAT, [0.4, 0.05, -1.0], [0.0, 0.0, 2.0]).unwrap();
    assert!((m.position[2] + (0.01f64 - 0.0025).sqrt()).abs() < 1e-13, "{m:?}");
}

#[test]
fn a_path_around_an_edge_meets_the_far_side() {
    // from above, past the edge, under the triangle and up against its lower side
    let points = [[0.0, -0.4, -2.64], [0.0, -2.6, -3.3], [0.0, -4.0, -1.3], [0.0, -3.2, 1.36], [0.0, 0.0, 0.0]];
    let path = Path { start: [0.2, 1.0, 0.3], points };
    let m = Mesh::new(&[FLAT]).unwrap().meet(&path, 0.1, 1e-12).unwrap().0;
    assert_eq!(m.normal, [0.0, -1.0, 0.0], "{m:?}");
    assert!((m.position[1] + 0.1).abs() < 1e-15);
}

#[test]
fn a_block_is_hit_on_its_rounded_corner() {
    let block = Mesh::block([0.0; 3], [1.0; 3]).unwrap();
    // straight at the corner at the origin, from outside along the diagonal
    let m = block.meet(&Path::straight([-1.0; 3], [1.0; 3]), 0.1, 1e-12).unwrap().0;
    assert!((norm(m.position) - 0.1).abs() < 1e-14 && m.normal.iter().all(|c| (c + 1.0 / 3f64.sqrt()).abs() < 1e-13));
}

#[test]
fn a_box_of_triangles_is_the_room() {
    let room = super::super::Room { min: [0.0; 3], max: [1.0, 2.0, 3.0] };
    let mesh = Mesh { solid: None, ..Mesh::block(room.min, room.max).unwrap() };
    assert_eq!(mesh.len(), 12);
    proptest!(|(x in prop::array::uniform3(0.15f64..0.85), by in prop::array::uniform3(-4.0f64..4.0))| {
        let path = Path::straight(x, by);
        let (a, b) = (mesh.meet(&path, 0.1, 1e-12).map(|(m, _)| m), room.meet(&path, 0.1, 1e-12));
        prop_assert_eq!(a.is_some(), b.is_some());
        if let (Some(a), Some(b)) = (a, b) {
            prop_assert!((a.theta - b.theta).abs() < 1e-12, "{:?} {:?}", a, b);
            prop_assert!(norm(sub(a.position, b.position)) < 1e-12);
        }
        prop_assert!((mesh.distance(x) - room.distance(x)).abs() < 1e-12);
    });
}

mod shapes;
mod watertight;

/// A quintic path of about that size.
fn bent(start: Vec3, by: Vec3, bend: [Vec3; 4]) -> Path {
    let mut path = Path::straight(start, by);
    for (p, b) in path.points.iter_mut().zip(bend) {
        *p = crate::vector::add(*p, b);
    }
    path
}

#[test]
fn the_hierarchy_finds_what_a_look_at_every_triangle_does() {
    let small = || prop::array::uniform3(-0.1f64..0.1);
    let place = || prop::array::uniform3(-1.0f64..1.0);
    let side = || prop::array::uniform3(-0.4f64..0.4);
    let triangle = (place(), side(), side()).prop_map(|(a, b, c)| [a, add(a, b), add(a, c)]);
    let hits = std::cell::Cell::new(0);
    proptest!(ProptestConfig::with_cases(400), |(
        all in prop::collection::vec(triangle, 1..200), start in place(), by in place(),
        bend in prop::array::uniform4(small()), clearance in prop::sample::select(vec![0.0, 1e-3, 0.05]),
    )| {
        let path = bent(start, by, bend);
        let one = |(i, t): (usize, &Triangle)| {
            let met = Mesh::new(&[*t])?.meet(&path, clearance, 1e-12);
            met.map(|(m, _)| (m.theta, i as u32))
        };
        let least = all.iter().enumerate().filter_map(one).min_by(|a, b| a.0.total_cmp(&b.0));
        let met = Mesh::new(&all).and_then(|m| m.meet(&path, clearance, 1e-12)).map(|(m, face)| (m.theta, face));
        hits.set(hits.get() + u32::from(met.is_some()));
        match (met, least) {
            // a point's skin depends on the coordinates of all
            (Some(a), Some(b)) => prop_assert!((a.0 - b.0).abs() < 1e-9 && (a.1 == b.1 || clearance > 0.0), "{:?} {:?}", a, b),
            (a, b) => prop_assert!(a.is_none() && b.is_none(), "{:?} {:?}", a, b),
        }
    });
    assert!(hits.get() > 50, "{}", hits.get());
}

#[test]
fn the_nearest_point_is_that_of_every_triangle() {
    let place = || prop::array::uniform3(-1.0f64..1.0);
    proptest!(ProptestConfig::with_cases(200), |(all in prop::collection::vec(prop::array::uniform3(place()), 1..60), x in place())| {
        let mesh = Mesh::new(&all).unwrap();
        let least = all.iter().map(|t| norm(sub(x, nearest::nearest(t, x).0))).fold(f64::INFINITY, f64::min);
        prop_assert!((mesh.distance(x) - least).abs() < 1e-14);
    });
}

#[test]
fn what_has_no_area_is_counted() {
    let line = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let mesh = Mesh::new(&[line, FLAT, [[0.0; 3], [0.0; 3], [1.0; 3]], [[f64::NAN; 3], [0.0; 3], [1.0; 3]]]).unwrap();
    assert_eq!((mesh.len(), mesh.left_out(), mesh.triangles()), (1, 3, vec![(1, FLAT)]));
    assert!(Mesh::new(&[line]).is_none() && Mesh::new(&[]).is_none());
}
