use super::*;
use crate::geometry::{cell_centres_and_volumes, face_centres_and_areas};
use crate::{Field, Mesh, PatchKind};
use std::path::PathBuf;

mod broken;
mod flat;
mod legacy;

/// Written by the vtk package and by foamToVTK: see tests/vtk/make.py and tests/vtk/foam/foam.sh.
fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vtk").join(name)
}

fn told(patches: Option<&str>) -> Options {
    Options { patches: patches.map(str::to_owned), ..Options::default() }
}

fn named(change: impl FnOnce(&mut Names)) -> Options {
    let mut options = Options::default();
    change(&mut options.names);
    options
}

fn get(name: &str) -> Snapshot {
    get_with(name, &Options::default())
}

fn get_with(name: &str, options: &Options) -> Snapshot {
    read(&path(name), options).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn refused(name: &str, options: &Options) -> String {
    read(&path(name), options).expect_err(name).to_string()
}

fn volumes(mesh: &Mesh) -> Vec<f64> {
    let (centres, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
    cell_centres_and_volumes(mesh, &centres, &areas).1
}

/// The volumes are these, within rounding; of points in single precision within that.
fn has_volumes(name: &str, mesh: &Mesh, wanted: &[f64]) {
    let found = volumes(mesh);
    assert_eq!(found.len(), wanted.len(), "{name}");
    assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 2e-6), "{name}: {found:?}");
}

fn points<const N: usize>(field: &Option<Field<N>>) -> &[[f64; N]] {
    match field {
        Some(Field::Points(values)) => values,
        other => panic!("not of points: {other:?}"),
    }
}

fn cells<const N: usize>(field: &Option<Field<N>>) -> (&[[f64; N]], &[[f64; N]]) {
    match field {
        Some(Field::Cells { cells, boundary }) => (cells, boundary),
        other => panic!("not of cells: {other:?}"),
    }
}

/// Names of patches, and how many faces each has.
fn patches(mesh: &Mesh) -> Vec<(&str, usize)> {
    assert!(mesh.patches.iter().all(|p| p.kind == PatchKind::Plain));
    mesh.patches.iter().map(|p| (p.name.as_str(), p.faces.len())).collect()
}

/// Hexahedron, voxel, polyhedron, wedge, pyramid, tetrahedron, and prisms of five and six sides.
/// The tetrahedron has corners (1 0 1), (1 1 1), (1/2 1/2 2), (2 1/2 2): 6 V = 3/2.
const MIXED: [f64; 8] = [1.0, 1.0, 1.0, 0.25, 1.0 / 3.0, 0.25, 2.5, 3.0];

#[test]
fn every_solid_in_every_form_is_the_same() {
    let wanted = get("ascii.vtu");
    has_volumes("ascii.vtu", &wanted.mesh, &MIXED);
    // six cells face to face in a tree: five faces between them
    assert_eq!((wanted.mesh.inner_faces(), patches(&wanted.mesh)), (5, vec![("boundary", 48 - 10)]));
    let note = "the temperature is of cells, and the file gives it no values on boundary: there the cells' own hold";
    assert_eq!(wanted.notes, [note]);
    assert_eq!(wanted.fields.others, Vec::<String>::new());
    assert_eq!(wanted.time, None);
    let at = |n: usize| wanted.mesh.points[n];
    for (n, u) in points(&wanted.fields.velocity).iter().enumerate() {
        let [x, y, z] = at(n);
        assert_eq!(*u, [1.0 + 2.0 * x + 3.0 * y - z, 0.25 * x, -z]);
        assert_eq!(points(&wanted.fields.pressure)[n], [x - y]);
        assert_eq!(points(&wanted.fields.k)[n], [8.0 + x]);
    }
    // T is of cells alone: at the hexahedron's middle y = 1/2
    let (t, boundary) = cells(&wanted.fields.temperature);
    assert_eq!((t[0], t.len(), boundary.len()), ([300.5], 8, 38));
    for name in [
        "inline.vtu",
        "inline-zlib.vtu",
        "raw.vtu",
        "raw-zlib-blocks.vtu",
        "base64.vtu",
        "base64-zlib-big.vtu",
        "lz4.vtu",
        "old-polyhedra.vtu",
        "ascii-42.vtk",
        "ascii-51.vtk",
        "binary-42.vtk",
        "binary-51.vtk",
    ] {
        let found = get(name);
        assert_eq!(found.mesh.points, wanted.mesh.points, "{name}");
        assert_eq!(found.mesh.faces, wanted.mesh.faces, "{name}");
        assert_eq!((&found.mesh.owner, &found.mesh.neighbour), (&wanted.mesh.owner, &wanted.mesh.neighbour), "{name}");
        assert_eq!((&found.mesh.patches, &found.notes), (&wanted.mesh.patches, &wanted.notes), "{name}");
        assert_eq!(found.fields.velocity, wanted.fields.velocity, "{name}");
        assert_eq!(found.fields.pressure, wanted.fields.pressure, "{name}");
        assert_eq!(found.fields.k, wanted.fields.k, "{name}");
        // legacy ASCII has 11 digits
        let close = |(a, b): (&[f64; 1], &[f64; 1])| (a[0] - b[0]).abs() < 1e-8;
        assert!(cells(&found.fields.temperature).0.iter().zip(t).all(close), "{name}");
    }
}

#[test]
fn the_faces_of_neighbours_lie_between_their_middles() {
    let mesh = get("ascii.vtu").mesh;
    let (centres, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
    let (middles, _) = cell_centres_and_volumes(&mesh, &centres, &areas);
    for f in 0..mesh.faces.len() {
        let out =
            |to: [f64; 3]| (0..3).map(|c| areas[f][c] * (to[c] - middles[mesh.owner[f] as usize][c])).sum::<f64>();
        assert!(out(centres[f]) > 0.0, "{f}");
        if let Some(&other) = mesh.neighbour.get(f) {
            assert!(other > mesh.owner[f] && out(middles[other as usize]) > 0.0, "{f}");
        }
    }
    // the pairs: hexahedron with voxel, polyhedron, wedge, pyramid; pyramid with tetrahedron
    let pairs: Vec<_> = mesh.owner.iter().zip(&mesh.neighbour).collect();
    assert_eq!(pairs, [(&0, &1), (&0, &2), (&0, &3), (&0, &4), (&4, &5)]);
}

#[test]
fn solids_of_higher_order_are_taken_by_their_corners() {
    let snapshot = get("curved.vtu");
    let (tetrahedron, hexahedron, wedge, pyramid) = (1.0 / 6.0, 1.0, 0.5, 1.0 / 3.0);
    // VTK's triquadratic pyramid is half as high in its coordinates
    let first = [tetrahedron, hexahedron, wedge, pyramid, hexahedron, hexahedron, wedge, wedge, 0.5 * pyramid];
    let second = [tetrahedron, hexahedron, wedge, tetrahedron, hexahedron];
    has_volumes("curved.vtu", &snapshot.mesh, &[&first[..], &second].concat());
    assert_eq!(snapshot.notes[0], "14 cells of higher order are taken by their corners: their sides are straight");
    // the points between are gone, and values are still those of their points
    assert_eq!(snapshot.mesh.points.len(), (4 + 8 + 6 + 5 + 8 + 8 + 6 + 6 + 5) + (4 + 8 + 6 + 4 + 8));
    for (x, u) in snapshot.mesh.points.iter().zip(points(&snapshot.fields.velocity)) {
        assert_eq!(u[1], 0.25 * x[0]);
    }
}

#[test]
fn pieces_are_one_mesh_without_ghosts() {
    let (whole, pieces) = (get("row.vtu"), get("pieces.pvtu"));
    assert_eq!(pieces.notes[0], "2 cells are copies of another piece's (vtkGhostType): they are left out");
    assert_eq!(pieces.notes[1..], whole.notes);
    assert_eq!(pieces.mesh.points.len(), whole.mesh.points.len());
    assert_eq!((pieces.mesh.cells, &pieces.mesh.owner), (4, &whole.mesh.owner));
    assert_eq!((&pieces.mesh.neighbour, patches(&pieces.mesh)), (&vec![1, 2, 3], vec![("boundary", 18)]));
    has_volumes("pieces.pvtu", &pieces.mesh, &[1.0; 4]);
    for (x, u) in pieces.mesh.points.iter().zip(points(&pieces.fields.velocity)) {
        assert_eq!(*u, [1.0 + 2.0 * x[0] + 3.0 * x[1] - x[2], 0.25 * x[0], -x[2]]);
    }
    assert_eq!(cells(&pieces.fields.temperature).0, [[300.5]; 4]);
}

#[test]
fn polygons_beside_solids_name_patches_by_numbers_or_texts() {
    for name in ["sides.vtu", "sides-zlib.vtu"] {
        let snapshot = get_with(name, &told(Some("names")));
        let wanted = [("inlet", 1), ("lower wall", 1), ("outlet", 1), ("boundary", 7)];
        assert_eq!(patches(&snapshot.mesh), wanted);
        assert_eq!(
            snapshot.notes[..2],
            [
                "all 1 boundary cells of \"inside\" lie inside the mesh: they are left out; the first of them begins at (1, 0, 0)",
                "7 outer faces are in no block and on no boundary cell: they are patch `boundary`"
            ]
        );
        has_volumes(name, &snapshot.mesh, &[1.0; 2]);
        // T of the polygons themselves, which lie at y = 1/2 or 0
        let (_, boundary) = cells(&snapshot.fields.temperature);
        assert_eq!(boundary[..3], [[300.5], [300.0], [300.5]]);
    }
    let numbers = get_with("sides.vtu", &told(Some("zone")));
    assert_eq!(patches(&numbers.mesh), [("3", 1), ("7", 1), ("4", 1), ("boundary", 7)]);
    assert_eq!(numbers.fields.others, ["names"]);
    let without = get("sides.vtu");
    assert_eq!(patches(&without.mesh), [("boundary", 10)]);
    assert!(without.notes[0].starts_with("4 boundary cells lie beside the others: patches ="), "{:?}", without.notes);
    let missing = refused("sides.vtu", &told(Some("patch")));
    assert!(missing.ends_with("no cell array `patch`; there are names, zone"), "{missing}");
    let none = refused("ascii.vtu", &told(Some("T")));
    assert!(none.contains("no boundary cells lie beside"), "{none}");
}

#[test]
fn blocks_name_patches_and_have_the_values_there() {
    for name in ["blocks.vtm", "parts.vtpc"] {
        let snapshot = get(name);
        assert_eq!(patches(&snapshot.mesh), [("inlet", 1), ("lower", 4), ("boundary", 13)]);
        has_volumes(name, &snapshot.mesh, &[1.0; 4]);
        let (u, boundary) = cells(&snapshot.fields.velocity);
        // 1 + 2x + 3/2 - 1/2 in the middles
        assert_eq!(u.iter().map(|u| u[0]).collect::<Vec<_>>(), [3.0, 5.0, 7.0, 9.0]);
        let given: Vec<f64> = boundary.iter().map(|u| u[0]).collect();
        assert_eq!(given[..5], [5.0, 5.0, 6.0, 7.0, 8.0]);
        // the rest has the cells' own
        assert!(given[5..].iter().all(|v| [3.0, 5.0, 7.0, 9.0].contains(v)));
        assert_eq!(
            snapshot.notes,
            [
                "13 outer faces are in no block and on no boundary cell: they are patch `boundary`",
                "the velocity is of cells, and the file gives it no values on boundary: there the cells' own hold, and the fluid slips along walls"
            ]
        );
    }
}

#[test]
fn what_foam_to_vtk_writes_is_read() {
    for form in ["ascii", "binary"] {
        let name = format!("foam/plane-{form}/plane_0.vtm");
        let plane = get(&name);
        let wanted = [("inlet", 2), ("outlet", 2), ("lower", 2), ("upper", 2), ("boundary", 8)];
        assert_eq!((plane.mesh.inner_faces(), patches(&plane.mesh)), (4, wanted.to_vec()));
        assert_eq!((plane.mesh.points.len(), plane.mesh.faces.len()), (18, 20));
        has_volumes(&name, &plane.mesh, &[0.5; 4]);
        assert_eq!(plane.time.as_deref(), Some("0"));
        // the inlet's value where it meets no wall
        let middle = plane.mesh.points.iter().position(|x| *x == [0.0, 0.5, 0.0]).unwrap();
        assert_eq!(points(&plane.fields.velocity)[middle], [1.5, 0.0, 0.0]);
        let name = format!("foam/poly-{form}/poly_0.vtm");
        let poly = get(&name);
        // as checkMesh counts them
        assert_eq!((poly.mesh.points.len(), poly.mesh.faces.len(), poly.mesh.inner_faces()), (100, 132, 54));
        let names: Vec<&str> = poly.mesh.patches.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["inlet", "outlet", "lower", "upper", "sides"]);
        assert_eq!(poly.notes, Vec::<String>::new());
        let all = volumes(&poly.mesh);
        assert!((all.iter().sum::<f64>() - 2.0).abs() < 1e-12);
        assert_eq!((all.iter().copied().fold(9.0, f64::min), all.iter().copied().fold(0.0, f64::max)), (0.03125, 0.25));
    }
    let plane = get("foam/plane-cells/plane_0.vtm");
    let (u, boundary) = cells(&plane.fields.velocity);
    assert_eq!(u.iter().map(|u| u[0]).collect::<Vec<_>>(), [1.0, 2.0, 3.0, 4.0]);
    // inlet, outlet, two walls, and what is empty in OpenFOAM, where the cells' own hold
    let wanted = [1.5, 1.5, 2.0, 4.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0];
    assert_eq!(boundary.iter().map(|u| u[0]).collect::<Vec<_>>(), wanted);
    has_volumes("plane.vtk", &get("foam/plane.vtk").mesh, &[0.5; 4]);
    let poly = get("foam/poly.vtk");
    assert_eq!((poly.mesh.points.len(), poly.mesh.faces.len(), poly.mesh.inner_faces()), (100, 132, 54));
    assert!((volumes(&poly.mesh).iter().sum::<f64>() - 2.0).abs() < 1e-12);
}

#[test]
fn fields_are_named_or_listed() {
    let text = |t: &str| Some(t.to_owned());
    let options = named(|n| (n.velocity, n.density, n.omega) = (text("U"), text("p"), text("T")));
    let fields = get_with("ascii.vtu", &options).fields;
    assert_eq!(fields.density, get("ascii.vtu").fields.pressure);
    assert!(fields.omega.is_some() && fields.pressure.is_none() && fields.temperature.is_none());
    let missing = refused("ascii.vtu", &named(|n| n.velocity = text("UMean")));
    assert!(missing.ends_with("no field `UMean`; there are T, U (3), k, p"), "{missing}");
    let none = refused("foam/plane-cells/plane_0/boundary/inlet.vtp", &Options::default());
    assert!(none.contains("2 polygons and no solid cells: their velocity leads out of their plane"), "{none}");
}

#[test]
fn a_case_is_the_same_as_openfoams_and_as_vtks() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/block");
    let foam = crate::openfoam::read(&case, &crate::openfoam::Options::default()).unwrap();
    let vtk = get("foam/block/block_0.vtm");
    assert_eq!((vtk.time.as_deref(), foam.time.as_deref()), (Some("2"), Some("2")));
    // foamToVTK writes single precision
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-6 * b.abs().max(1e-3));
    let (a, b) = (volumes(&vtk.mesh), volumes(&foam.mesh));
    assert!(a.len() == b.len() && near(&a, &b), "{a:?} {b:?}");
    let mut pairs =
        [&vtk.mesh, &foam.mesh].map(|m| m.owner.iter().copied().zip(m.neighbour.clone()).collect::<Vec<_>>());
    pairs.iter_mut().for_each(|p| p.sort_unstable());
    assert_eq!(pairs[0], pairs[1]);
    let names = |m: &Mesh| m.patches.iter().map(|p| (p.name.clone(), p.faces.len())).collect::<Vec<_>>();
    assert_eq!(names(&vtk.mesh), names(&foam.mesh));
    let values = |s: &Snapshot| {
        let (u, on) = cells(&s.fields.velocity);
        let scalars = [&s.fields.pressure, &s.fields.k, &s.fields.epsilon].map(|f| {
            let (cells, on) = cells(f);
            (cells.as_flattened().to_vec(), on.as_flattened().to_vec())
        });
        (u.as_flattened().to_vec(), on.to_vec(), scalars)
    };
    let (vtk_values, foam_values) = (values(&vtk), values(&foam));
    assert!(near(&vtk_values.0, &foam_values.0));
    for (a, b) in vtk_values.2.iter().zip(&foam_values.2) {
        assert!(near(&a.0, &b.0));
    }
    // of inlet, outlet and the wall, whose values both write; faces of a patch by their owners
    let by_owner = |s: &Snapshot, on: &[[f64; 3]], patch: usize| {
        let inner = s.mesh.inner_faces();
        let mut all: Vec<(u32, [f64; 3])> =
            s.mesh.patches[patch].faces.clone().map(|f| (s.mesh.owner[f], on[f - inner])).collect();
        all.sort_by_key(|a| a.0);
        all
    };
    for patch in 0..3 {
        let [a, b] = [by_owner(&vtk, &vtk_values.1, patch), by_owner(&foam, &foam_values.1, patch)];
        assert!(a.iter().zip(&b).all(|(a, b)| a.0 == b.0 && near(&a.1, &b.1)), "{a:?} {b:?}");
    }
}
