use super::*;
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
    assert!(
        (norm(m.position) - 0.1).abs() < 1e-14 && m.normal.iter().all(|c| (c + 1.0 / 3f64.sqrt()).abs() < 1e-13)
    );
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
