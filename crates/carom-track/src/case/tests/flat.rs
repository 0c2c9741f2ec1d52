//! Results of VTK whose cells are polygons of a plane, against what they are of.

use super::*;
use crate::record::{End, ParticleFate};
use crate::vector::{norm, sub};
use std::fmt::Write as _;

/// How the spheres of a case end, by their numbers.
fn ends(text: &str, file: &std::path::Path) -> Vec<End> {
    let case = Case::from_toml(text, file, Library::builtin()).unwrap();
    let mut ends = Ends::default();
    let mut all = (0..).map_while(|n| case.particle(n));
    case.tracker().run(&mut all, &mut ends).expect("a run");
    ends.0.sort_by_key(|e| e.particle.number);
    ends.0
}

/// A legacy file of quadrangles over (0, 0) to (length, height), with a velocity at its points.
fn quads(n: [usize; 2], size: [f64; 2], velocity: impl Fn([f64; 2]) -> [f64; 3]) -> String {
    let at = |i: usize, j: usize| [size[0] * i as f64 / n[0] as f64, size[1] * j as f64 / n[1] as f64];
    let points: Vec<[f64; 2]> = (0..=n[1]).flat_map(|j| (0..=n[0]).map(move |i| at(i, j))).collect();
    let mut cells: Vec<(u8, Vec<usize>, usize)> = Vec::new();
    let id = |i: usize, j: usize| j * (n[0] + 1) + i;
    for j in 0..n[1] {
        cells.extend((0..n[0]).map(|i| (9, vec![id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)], 0)));
    }
    cells.extend((0..n[0]).map(|i| (3, vec![id(i, 0), id(i + 1, 0)], 1)));
    cells.extend((0..n[0]).map(|i| (3, vec![id(i, n[1]), id(i + 1, n[1])], 2)));
    cells.extend((0..n[1]).flat_map(|j| [0, n[0]].map(|i| (3, vec![id(i, j), id(i, j + 1)], 3))));
    let numbers: usize = cells.iter().map(|c| c.1.len() + 1).sum();
    let mut text =
        format!("# vtk DataFile Version 3.0\nq\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n", points.len());
    points.iter().for_each(|[x, y]| writeln!(text, "{x} {y} 0").unwrap());
    writeln!(text, "CELLS {} {numbers}", cells.len()).unwrap();
    for (_, corners, _) in &cells {
        let corners: Vec<String> = corners.iter().map(usize::to_string).collect();
        writeln!(text, "{} {}", corners.len(), corners.join(" ")).unwrap();
    }
    writeln!(text, "CELL_TYPES {}", cells.len()).unwrap();
    cells.iter().for_each(|(kind, ..)| writeln!(text, "{kind}").unwrap());
    writeln!(text, "CELL_DATA {}\nSCALARS side int 1\nLOOKUP_TABLE default", cells.len()).unwrap();
    cells.iter().for_each(|(_, _, side)| writeln!(text, "{side}").unwrap());
    writeln!(text, "POINT_DATA {}\nVECTORS U double", points.len()).unwrap();
    points.iter().map(|x| velocity(*x)).for_each(|[u, v, w]| writeln!(text, "{u} {v} {w}").unwrap());
    text
}

#[test]
fn spheres_settle_in_a_plane_result_as_in_the_same_wind() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("duct.vtk"), quads([30, 4], [0.3, 0.01], |_| [0.2, 0.0, 0.0])).unwrap();
    // some go across the plane, for which nothing changes
    let rest = r#"
[forces]
gravity = [0, -9.81, 0]
[[injection]]
density = 1000
diameter = "12 um"
count = 200
position = { box = [[1e-3, 0.5e-3, -1e-5], [2e-3, 9.5e-3, 1e-5]] }
velocity = [0.3, 0.1, 0.5]
[run]
until = "20 s"
tolerance = 1e-7
"#;
    let of_mesh = r#"
[flow]
kind = "vtk"
file = "duct.vtk"
patches = "side"
[[wall]]
patch = "1"
name = "floor"
law = "trap"
[[wall]]
patch = "2"
name = "ceiling"
law = "reflect"
restitution = 0.9
tangential_restitution = 0.8
[[wall]]
patch = "3"
name = "outlet"
law = "escape"
contact_at = "center"
"#;
    let of_planes = r#"
[flow]
kind = "uniform"
velocity = [0.2, 0, 0]
[[wall]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 1, 0] }
law = "trap"
[[wall]]
name = "ceiling"
plane = { point = [0, 0.01, 0], normal = [0, -1, 0] }
law = "reflect"
restitution = 0.9
tangential_restitution = 0.8
[[wall]]
name = "outlet"
plane = { point = [0.3, 0, 0], normal = [-1, 0, 0] }
law = "escape"
contact_at = "center"
"#;
    let at = folder.path().join("case.toml");
    let (got, want) = (ends(&format!("{of_mesh}{rest}"), &at), ends(&format!("{of_planes}{rest}"), &at));
    let trapped = want.iter().filter(|e| e.fate == ParticleFate::Trapped).count();
    assert!((20..180).contains(&trapped), "{trapped}");
    for (got, want) in got.iter().zip(&want) {
        assert_eq!((got.fate, got.wall), (want.fate, want.wall), "{got:?} {want:?}");
        assert!(norm(sub(got.position, want.position)) < 1e-6, "{got:?} {want:?}");
    }
}

#[test]
fn an_axisymmetric_result_is_the_pipe() {
    let folder = tempfile::tempdir().unwrap();
    let (radius, mean) = (5e-3, 1.0);
    let laminar = |x: [f64; 2]| [2.0 * mean * (1.0 - x[1] * x[1] / (radius * radius)), 0.0, 0.0];
    std::fs::write(folder.path().join("pipe.vtk"), quads([40, 50], [0.2, radius], laminar)).unwrap();
    // thrown to the wall, some through the axis, and from beside it round it
    let rest = r#"
[[injection]]
density = 2000
diameter = "60 um"
count = 100
position = { box = [[5e-3, 0, 0], [6e-3, 4e-3, 0]] }
velocity = [1, -1.5, 0]
[[injection]]
density = 2000
diameter = "60 um"
count = 100
position = { box = [[5e-3, 1e-3, 0], [6e-3, 4e-3, 0]] }
velocity = [1, 0.3, 1]
[run]
until = "20 s"
tolerance = 1e-6
"#;
    let of_mesh = r#"
[flow]
kind = "vtk"
file = "pipe.vtk"
patches = "side"
axisymmetric = "x"
[[wall]]
patch = "2"
name = "pipe"
law = "trap"
[[wall]]
patch = "3"
name = "ends"
law = "escape"
"#;
    let of_pipe = r#"
[flow]
kind = "pipe"
profile = "laminar"
point = [0, 0, 0]
axis = [1, 0, 0]
radius = 5e-3
mean_speed = 1
[[wall]]
name = "pipe"
cylinder = { point = [0, 0, 0], axis = [1, 0, 0], radius = 5e-3 }
law = "trap"
[[wall]]
name = "ends"
plane = { point = [0.2, 0, 0], normal = [-1, 0, 0] }
law = "escape"
"#;
    let at = folder.path().join("case.toml");
    let (got, want) = (ends(&format!("{of_mesh}{rest}"), &at), ends(&format!("{of_pipe}{rest}"), &at));
    let trapped = want.iter().filter(|e| e.fate == ParticleFate::Trapped).count();
    assert!(trapped > 20, "{trapped}");
    let mut worst = 0.0f64;
    for (got, want) in got.iter().zip(&want) {
        assert_eq!((got.fate, got.wall), (want.fate, want.wall), "{got:?} {want:?}");
        let place = |e: &End| [e.position[0], e.position[1].hypot(e.position[2])];
        let (a, b) = (place(got), place(want));
        worst = worst.max((a[0] - b[0]).abs() / b[0]).max((a[1] - b[1]).abs() / radius);
    }
    // a wedge of 5 degrees has flat walls, which are 1/cos 2.5° − 1 = 9.5e-4 further off at its sides
    assert!(worst < 1e-3, "{worst}");
}
