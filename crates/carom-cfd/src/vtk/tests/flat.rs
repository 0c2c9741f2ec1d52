//! Results whose cells are polygons of a plane.

use super::*;

/// A triangle, a quadrangle and a pentagon over [0, 3] × [0, 1], numbered either way round, with lines at the left side and above, and a polyline below; the values of
/// cells are their numbers.
fn row(place: impl Fn(f64, f64) -> [f64; 3], velocity: impl Fn([f64; 3]) -> [f64; 3], patches: bool) -> String {
    let flat =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 1.0], [3.0, 0.0], [3.0, 0.5], [2.5, 1.0], [0.0, 0.5]];
    let points: Vec<[f64; 3]> = flat.iter().map(|[x, y]| place(*x, *y)).collect();
    let mut cells: Vec<(u8, Vec<u32>)> = vec![(7, vec![0, 1, 2, 8]), (9, vec![1, 2, 4, 3]), (7, vec![3, 5, 6, 7, 4])];
    if patches {
        cells.extend([(3, vec![8, 0]), (3, vec![2, 4]), (3, vec![8, 2]), (4, vec![0, 1, 3, 5]), (1, vec![0])]);
    }
    let mut text =
        format!("# vtk DataFile Version 3.0\nrow\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n", points.len());
    points.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
    let numbers: usize = cells.iter().map(|(_, c)| c.len() + 1).sum();
    text += &format!("CELLS {} {numbers}\n", cells.len());
    for (_, corners) in &cells {
        text += &format!("{}", corners.len());
        corners.iter().for_each(|c| text += &format!(" {c}"));
        text += "\n";
    }
    text += &format!("CELL_TYPES {}\n", cells.len());
    cells.iter().for_each(|(kind, _)| text += &format!("{kind}\n"));
    text += &format!("CELL_DATA {}\nSCALARS zone int 1\nLOOKUP_TABLE default\n", cells.len());
    [0, 0, 0, 7, 8, 8, 9, 9][..cells.len()].iter().for_each(|zone| text += &format!("{zone}\n"));
    text += "SCALARS p double 1\nLOOKUP_TABLE default\n";
    (0..cells.len()).for_each(|c| text += &format!("{c}\n"));
    text += &format!("POINT_DATA {}\nVECTORS U double\n", points.len());
    points.iter().map(|x| velocity(*x)).for_each(|[u, v, w]| text += &format!("{u} {v} {w}\n"));
    text
}

fn read_as(text: &str, options: &Options) -> Result<Snapshot, String> {
    from_bytes(text.as_bytes().to_vec(), options).map_err(|e| e.to_string())
}

fn shear(x: [f64; 3]) -> [f64; 3] {
    [1.0 + x[1], 0.0, 0.0]
}

fn kinds(mesh: &Mesh) -> Vec<(&str, &PatchKind, usize)> {
    mesh.patches.iter().map(|p| (p.name.as_str(), &p.kind, p.faces.len())).collect()
}

const AREAS: [f64; 3] = [0.75, 1.0, 0.875];

#[test]
fn a_plane_result_is_a_layer_between_empty_sides() {
    let text = row(|x, y| [x, y, 5.0], shear, true);
    let s = read_as(&text, &told(Some("zone"))).unwrap();
    let thick = 0.01 * 10.0_f64.sqrt();
    has_volumes("row", &s.mesh, &AREAS.map(|a| a * thick));
    let plain = &PatchKind::Plain;
    assert_eq!(
        kinds(&s.mesh),
        [
            ("7", plain, 1),
            ("8", plain, 2),
            ("9", plain, 3),
            ("frontAndBack", &PatchKind::Empty, 6),
            ("boundary", plain, 3)
        ]
    );
    let level = |p: &[f64; 3]| (p[2] - 5.0).abs() - 0.5 * thick;
    assert!(s.mesh.points.len() == 18 && s.mesh.points.iter().all(|p| level(p).abs() < 1e-15));
    for (x, u) in s.mesh.points.iter().zip(points(&s.fields.velocity)) {
        assert_eq!(*u, shear(*x));
    }
    let (inside, boundary) = cells(&s.fields.pressure);
    assert_eq!(inside, [[0.0], [1.0], [2.0]]);
    // the lines' own, patch by patch and cell by cell; the sides and the rest have the cells'
    assert_eq!(boundary[..6], [[3.0], [5.0], [4.0], [6.0], [6.0], [6.0]]);
    assert!(
        s.notes.iter().any(|n| n.starts_with("a plane result: its cells are taken as 3.162e-2 m thick")),
        "{:?}",
        s.notes
    );
    // coordinates of single precision far from the origin lie in a plane to their rounding
    let far = |x: f64, y: f64| {
        [f64::from((x + 1e3) as f32), f64::from(y as f32), f64::from((7e2 + 0.3 * x + 0.2 * y) as f32)]
    };
    let along = |x: [f64; 3]| [1.0, 0.0, 0.3 * if x[0] > 0.0 { 1.0 } else { 0.0 }];
    assert_eq!(read_as(&row(far, along, false), &Options::default()).unwrap().mesh.cells, 3);
    // any plane does, numbered from either side; without lines all is one patch
    for tilt in [0.7, -0.7, 2.5] {
        let (c, d) = (f64::cos(tilt), f64::sin(tilt));
        let s = read_as(&row(|x, y| [x, c * y, d * y], |_| [1.0, 0.0, 0.0], false), &Options::default()).unwrap();
        has_volumes("tilted", &s.mesh, &AREAS.map(|a| a * thick));
        assert_eq!(kinds(&s.mesh)[1..], [("boundary", plain, 9)]);
    }
}

#[test]
fn an_axisymmetric_result_is_a_wedge() {
    // 2 about x; about y the same, with x and y changed
    let swirl = |x: [f64; 3]| [1.0 + x[1], -0.2 * x[1], 0.3 * x[1]];
    let about = |axis, text: &str| read_as(text, &Options { axis: Some(axis), ..told(Some("zone")) }).unwrap();
    let s = about(Axis::X, &row(|x, y| [x, y, 0.0], swirl, true));
    let tan = (2.5_f64).to_radians().tan();
    // ∫ 2 r tan dA
    let moments = [0.5 * (0.25 + 0.5 + 1.0) / 3.0, 0.5, 0.5 - 0.5 * 0.5 * 0.5 * (1.0 - 0.5 / 3.0)];
    has_volumes("wedge", &s.mesh, &moments.map(|m| 2.0 * tan * m));
    let (plain, wedge) = (&PatchKind::Plain, &PatchKind::Wedge);
    // what lies on the axis is no face
    assert_eq!(
        kinds(&s.mesh),
        [("7", plain, 1), ("8", plain, 2), ("front", wedge, 3), ("back", wedge, 3), ("boundary", plain, 3)]
    );
    assert_eq!(s.mesh.points.len(), 2 * 9 - 4);
    for (x, u) in s.mesh.points.iter().zip(points(&s.fields.velocity)) {
        // axial and radial parts, and swirl, as in the plane and as much longer as the radius
        let [a, r, t] = swirl([x[0], x[1], 0.0]);
        let side = x[2].signum() * if x[2] == 0.0 { 0.0 } else { 1.0 };
        let want = [a, r - side * tan * t, t + side * tan * r];
        assert!((x[2] - side * tan * x[1]).abs() < 1e-15, "{x:?}");
        assert!(u.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-15), "{x:?}: {u:?} {want:?}");
    }
    let other = about(Axis::Y, &row(|x, y| [y, x, 0.0], |x| [-0.2 * x[0], 1.0, 0.0], true));
    has_volumes("about y", &other.mesh, &moments.map(|m| 2.0 * tan * m));
}

#[test]
fn polygons_that_are_no_result_are_refused() {
    let fails = |text: &str, axis: Option<Axis>, want: &str| {
        let error = read_as(text, &Options { axis, ..Options::default() }).expect_err(want);
        assert!(error.contains(want), "{error}");
    };
    let plane = |x: f64, y: f64| [x, y, 0.0];
    let bent = |x: f64, y: f64| [x, y, 0.1 * x * x];
    fails(&row(bent, shear, true), None, "3 polygons and no solid cells: they do not lie in a plane");
    fails(
        &row(plane, |_| [1.0, 0.0, 0.1], true),
        None,
        "their velocity leads out of their plane, as on a side of a body",
    );
    fails(&row(plane, |_| [0.0; 3], true), None, "they have no velocity, as a plane result has");
    fails(&row(plane, |_| [0.0; 3], true), Some(Axis::X), "they have no velocity, as an axisymmetric result has");
    fails(&row(plane, shear, true), Some(Axis::Z), "the z axis is not in their plane");
    fails(&row(|x, y| [x, y, 1.0], shear, true), Some(Axis::X), "the x axis is not in their plane");
    fails(&row(|x, y| [x, y - 0.5, 0.0], shear, true), Some(Axis::X), "they lie on both sides of the x axis");
    let solid = std::fs::read_to_string(path("ascii.vtu")).unwrap();
    fails(&solid, Some(Axis::X), "its cells are solid");
    let unnamed = row(plane, shear, true).replace("VECTORS U ", "VECTORS flow ");
    fails(&unnamed, None, "they have no velocity, as a plane result has; there are flow, zone");
    let e = read_as(&unnamed, &named(|n| n.velocity = Some("UMean".into()))).unwrap_err();
    assert!(e.contains("no field `UMean`; there are flow"), "{e}");
    read_as(&unnamed, &named(|n| n.velocity = Some("flow".into()))).unwrap();
}

#[test]
fn velocities_of_two_components_are_in_the_plane() {
    let mut text = row(|x, y| [x, y, 0.0], shear, false);
    text += "FIELD more 1\nU2 2 9 double\n";
    text += &"0.5 0.25\n".repeat(9);
    let s = read_as(&text, &named(|n| n.velocity = Some("U2".into()))).unwrap();
    assert!(points(&s.fields.velocity).iter().all(|u| *u == [0.5, 0.25, 0.0]));
}

#[test]
fn blocks_of_lines_are_patches() {
    let folder = tempfile::tempdir().unwrap();
    let list = |name: &str, kind: &str, width: usize, values: &str| {
        format!("<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{width}\">{values}</DataArray>")
    };
    let inside = format!(
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><CellData>{}</CellData>\
         <Points>{}</Points><Cells>{}{}{}</Cells></Piece></UnstructuredGrid></VTKFile>",
        list("U", "Float64", 3, "1 0 0"),
        list("x", "Float64", 3, "0 0 0 1 0 0 1 1 0 0 1 0"),
        list("connectivity", "Int32", 1, "0 1 2 3"),
        list("offsets", "Int32", 1, "4"),
        list("types", "UInt8", 1, "9"),
    );
    // a point, a line of two pieces; a block that lies elsewhere is told
    let low = |y: f64| {
        format!(
            "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfVerts=\"1\" NumberOfLines=\"1\"><CellData>{}</CellData>\
             <Points>{}</Points><Verts>{}{}</Verts><Lines>{}{}</Lines></Piece></PolyData></VTKFile>",
            list("U", "Float64", 3, "9 9 9 2 0 0"),
            list("x", "Float64", 3, &format!("0 1 0 0 {y} 0 1 {y} 0")),
            list("connectivity", "Int32", 1, "0"),
            list("offsets", "Int32", 1, "1"),
            list("connectivity", "Int32", 1, "0 1 2"),
            list("offsets", "Int32", 1, "3"),
        )
    };
    let blocks = "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet name=\"inside\" file=\"a.vtu\"/>\
                  <DataSet name=\"low\" file=\"b.vtp\"/></vtkMultiBlockDataSet></VTKFile>";
    std::fs::write(folder.path().join("all.vtm"), blocks).unwrap();
    std::fs::write(folder.path().join("a.vtu"), &inside).unwrap();
    std::fs::write(folder.path().join("b.vtp"), low(0.0)).unwrap();
    let all = || read(&folder.path().join("all.vtm"), &Options::default());
    let s = all().unwrap();
    let plain = &PatchKind::Plain;
    assert_eq!(kinds(&s.mesh), [("low", plain, 2), ("frontAndBack", &PatchKind::Empty, 2), ("boundary", plain, 2)]);
    assert_eq!(cells(&s.fields.velocity).1[..2], [[2.0, 0.0, 0.0]; 2]);
    // beside solid cells they are of no use
    std::fs::write(folder.path().join("a.vtu"), std::fs::read(path("ascii.vtu")).unwrap()).unwrap();
    let alone = get("ascii.vtu");
    assert_eq!((&all().unwrap().mesh, all().unwrap().notes), (&alone.mesh, alone.notes.clone()));
    std::fs::write(folder.path().join("a.vtu"), inside).unwrap();
    std::fs::write(folder.path().join("b.vtp"), low(0.5)).unwrap();
    let error = all().unwrap_err().to_string();
    assert!(error.contains("no face of any block lies on an outer face of the mesh"), "{error}");
}
