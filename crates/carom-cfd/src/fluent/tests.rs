use super::*;
use crate::geometry::{cell_centres_and_volumes, face_centres_and_areas};
use crate::{Field, PatchKind};

/// Stand-ins in the layout of Fluent 22.2: see tests/fluent/make.py.
fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fluent").join(name)
}

fn with_data(name: &str) -> Options {
    Options { data: Some(path(name)), ..Options::default() }
}

fn refused(name: &str, options: &Options) -> String {
    read(&path(name), options).expect_err(name).to_string()
}

fn cells<const N: usize>(field: &Option<Field<N>>) -> (&[[f64; N]], &[[f64; N]]) {
    match field {
        Some(Field::Cells { cells, boundary }) => (cells, boundary),
        other => panic!("not of cells: {other:?}"),
    }
}

#[test]
fn the_fluid_with_its_zones_and_fields() {
    // old groups and lists in double precision; newer ones in single, with faces listed the other way round
    for name in ["row.cas.h5", "turned.cas.h5"] {
        let Snapshot { mesh, fields, notes, .. } = read(&path(name), &Options::default()).unwrap();
        assert_eq!((mesh.cells, mesh.points.len(), mesh.neighbour.as_slice()), (2, 12, &[1][..]), "{name}");
        let (centres, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
        assert_eq!(cell_centres_and_volumes(&mesh, &centres, &areas).1, [6.0; 2]);
        assert_eq!(areas[0], [6.0, 0.0, 0.0]);
        let patches: Vec<_> = mesh.patches.iter().map(|p| (p.name.as_str(), p.kind.clone(), p.faces.len())).collect();
        let wanted = [
            ("inlet", PatchKind::Plain, 1),
            ("heated", PatchKind::Wall, 1),
            ("mirror", PatchKind::Symmetry, 2),
            ("top", PatchKind::Wall, 2),
            ("ends", PatchKind::Plain, 4),
        ];
        assert_eq!(patches, wanted);
        let (u, boundary) = cells(&fields.velocity);
        assert_eq!(u, [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
        // 10 + the face's number; on `top` the cells' own
        let wanted = [12.0, 13.0, 15.0, 16.0, 1.0, 2.0, 19.0, 20.0, 21.0, 22.0];
        assert_eq!(boundary.iter().map(|u| u[0]).collect::<Vec<_>>(), wanted);
        assert_eq!(cells(&fields.temperature).0, [[300.0], [310.0]]);
        assert_eq!(fields.others, ["SV_MU_T"]);
        assert_eq!(
            notes,
            [
                "solid zones are left out: steel",
                "SV_U has no values on top: there the cells' own hold",
                "SV_T has no values on inlet, heated, mirror, top, ends: there the cells' own hold",
                "SV_P has no values on inlet, heated, mirror, top, ends: there the cells' own hold",
                "the pressure is relative to the operating pressure of the case"
            ]
        );
    }
}

#[test]
fn fields_are_named_or_listed() {
    let named = |velocity: &str| {
        let names = Names { velocity: Some(velocity.to_owned()), ..Names::default() };
        Options { names, ..Options::default() }
    };
    let missing = refused("row.cas.h5", &named("SV_U_MEAN"));
    assert!(missing.ends_with("no field `SV_U_MEAN`; there are SV_MU_T, SV_P, SV_T, SV_U, SV_V, SV_W"), "{missing}");
    assert!(refused("row.cas.h5", &named("SV_T")).contains("named by its first component"));
    let names = Names { k: Some("SV_MU_T".to_owned()), ..Names::default() };
    let snapshot = read(&path("row.cas.h5"), &Options { names, ..Options::default() }).unwrap();
    assert_eq!(cells(&snapshot.fields.k).0, [[0.0], [0.0]]);
}

#[test]
fn what_cannot_be_used_is_refused() {
    let fails = |found: String, wanted: &str| assert!(found.contains(wanted), "{found}");
    fails(refused("row.cas.h5", &with_data("broken.dat.h5")), "SV_P has no value in cell 2");
    fails(refused("row.cas.h5", &with_data("row.cas.h5")), "no results: results/1/phase-1/cells is not there");
    fails(refused("row.cas.h5", &with_data("none.dat.h5")), "none.dat.h5");
    fails(refused("row.dat.h5", &Options::default()), "no dimension of meshes/1");
    fails(refused("make.py", &Options::default()), "not an HDF5 file");
    fails(refused("many.cas.h5", &Options::default()), "4000000003 cells do not have 17 faces alone");
    // a case alone has a mesh alone
    let folder = tempfile::tempdir().unwrap();
    let alone = folder.path().join("alone.cas.h5");
    std::fs::copy(path("row.cas.h5"), &alone).unwrap();
    let snapshot = read(&alone, &Options::default()).unwrap();
    assert!(snapshot.fields.velocity.is_none() && snapshot.notes[1].starts_with("no data: there is no "));
}

#[test]
fn a_case_of_two_dimensions_is_plane_or_a_wedge() {
    let areas = |mesh: &crate::Mesh| {
        let (centres, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
        cell_centres_and_volumes(mesh, &centres, &areas).1
    };
    let kinds = |mesh: &crate::Mesh| {
        mesh.patches.iter().map(|p| (p.name.clone(), p.kind.clone(), p.faces.len())).collect::<Vec<_>>()
    };
    let patch = |name: &str, kind: PatchKind, faces: usize| (name.to_owned(), kind, faces);
    let all =
        [patch("inlet", PatchKind::Plain, 1), patch("axis", PatchKind::Plain, 3), patch("pipe", PatchKind::Wall, 3)];
    // with swirl no case is plane: without it, or without data, this one is
    let swirl = refused("flat.cas.h5", &Options::default());
    assert!(swirl.contains("velocity leads out of their plane"), "{swirl}");
    let folder = tempfile::tempdir().unwrap();
    let alone = folder.path().join("alone.cas.h5");
    std::fs::copy(path("flat.cas.h5"), &alone).unwrap();
    let Snapshot { mesh, .. } = read(&alone, &Options::default()).unwrap();
    assert_eq!(kinds(&mesh), [&all[..], &[patch("frontAndBack", PatchKind::Empty, 6)]].concat());
    let thick = 0.01 * 10.0_f64.sqrt();
    assert!(areas(&mesh).iter().zip([1.0, 1.0, 0.5]).all(|(v, a)| (v - a * thick).abs() < 1e-15), "{:?}", areas(&mesh));

    let about = |axis| Options { axis: Some(axis), ..Options::default() };
    let Snapshot { mesh, fields, notes, .. } = read(&path("flat.cas.h5"), &about(Axis::X)).unwrap();
    // what lies on the axis is no face
    let wedge = [patch("front", PatchKind::Wedge, 3), patch("back", PatchKind::Wedge, 3)];
    assert_eq!(kinds(&mesh), [&all[..1], &all[2..], &wedge].concat());
    let tan = 2.5_f64.to_radians().tan();
    assert!(
        areas(&mesh).iter().zip([1.0, 1.0, 1.0 / 3.0]).all(|(v, m)| (v - m * tan).abs() < 1e-15),
        "{:?}",
        areas(&mesh)
    );
    let (u, boundary) = cells(&fields.velocity);
    assert_eq!(u, [[1.0, -0.1, 101.0], [2.0, -0.2, 102.0], [3.0, -0.3, 103.0]]);
    assert_eq!(boundary[..4].iter().map(|u| u[0]).collect::<Vec<_>>(), [13.0, 17.0, 18.0, 19.0]);
    assert_eq!(cells(&fields.pressure).1[..2], [[8.0], [12.0]]);
    assert_eq!(
        notes,
        [
            "the pressure is relative to the operating pressure of the case",
            "an axisymmetric result: its cells are taken as a wedge of 5 degrees"
        ]
    );
    assert!(refused("row.cas.h5", &about(Axis::X)).contains("a case of three dimensions"));
}

#[test]
fn bytes_by_chance_never_panic() {
    use proptest::prelude::*;
    let files: Vec<Vec<u8>> = ["turned.cas.h5", "turned.dat.h5", "flat.cas.h5", "flat.dat.h5"]
        .iter()
        .map(|f| std::fs::read(path(f)).unwrap())
        .collect();
    let changes = || prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4);
    proptest!(ProptestConfig::with_cases(150), |(of_case in changes(), of_data in changes())| {
        let changed = |file: &[u8], changes: &[(prop::sample::Index, u8)]| {
            let mut bytes = file.to_vec();
            for (place, byte) in changes {
                let place = place.index(bytes.len());
                bytes[place] = *byte;
            }
            bytes
        };
        for pair in files.chunks(2) {
            let (case, data) = (changed(&pair[0], &of_case), changed(&pair[1], &of_data));
            let _ = from_bytes(case, Some(data), &Options { axis: Some(Axis::X), ..Options::default() });
        }
    });
}
