//! Patches and geometry, against what OpenFOAM says of the same meshes.

use carom_cfd::geometry::{cell_centres_and_volumes, face_centres_and_areas};
use carom_cfd::quality::quality;
use carom_cfd::{Carry, PatchKind};

use super::*;

#[test]
fn centres_and_volumes_are_those_that_openfoam_writes() {
    for (name, time) in [("block", "2"), ("ring", "0.02"), ("wedge", "0.02"), ("ami", "0.02")] {
        let mesh = latest(&stored(name)).mesh;
        let (fc, fa) = face_centres_and_areas(&mesh.points, &mesh.faces);
        let (cc, cv) = cell_centres_and_volumes(&mesh, &fc, &fa);
        let centres = plain_numbers(&stored(name).join(time).join("C"));
        let volumes = plain_numbers(&stored(name).join(time).join("V"));
        assert_eq!((centres.len(), volumes.len()), (3 * mesh.cells, mesh.cells), "{name}");
        for (x, written) in cc.iter().flatten().chain(&cv).zip(centres.into_iter().chain(volumes)) {
            // half a unit of the last of eight digits, and what rounding leaves of zero
            let unit = 10_f64.powf(written.abs().log10().floor() - 7.0);
            assert!((x - written).abs() <= 0.501 * unit + 1e-17, "{name}: {x} {written}");
        }
    }
}

#[test]
fn patches_of_every_kind() {
    let mesh = latest(&stored("block")).mesh;
    assert_eq!((mesh.cells, mesh.faces.len(), mesh.points.len(), mesh.inner_faces()), (12, 52, 36, 20));
    let names: Vec<_> = mesh.patches.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["inlet", "outlet", "lower", "upper", "left", "right"]);
    assert_eq!(mesh.patches[0].kind, PatchKind::Plain);
    assert_eq!(mesh.patches[2].kind, PatchKind::Wall);
    assert_eq!(mesh.patches[2].groups, ["wall", "solid"]);
    assert_eq!(mesh.patches[2].faces, 28..34);
    assert_eq!(mesh.patches[3].kind, PatchKind::Symmetry);
    let PatchKind::Cyclic { partner: 5, carry } = mesh.patches[4].kind else { panic!("{:?}", mesh.patches[4]) };
    assert_eq!(carry.rotation, Carry::by([0.0; 3]).rotation);
    assert!((carry.translation[2] - 0.1).abs() < 1e-15 && carry.translation[..2] == [0.0; 2], "{carry:?}");

    let wedge = latest(&stored("wedge")).mesh;
    let kinds: Vec<_> = wedge.patches.iter().map(|p| (p.name.as_str(), &p.kind, p.faces.len())).collect();
    assert_eq!(
        kinds[3..],
        [("front", &PatchKind::Wedge, 6), ("back", &PatchKind::Wedge, 6), ("axis", &PatchKind::Empty, 0)]
    );
    let ring = latest(&stored("ring")).mesh;
    assert_eq!((&ring.patches[4].kind, ring.patches[4].faces.len()), (&PatchKind::Empty, 12));

    let ami = latest(&stored("ami")).mesh;
    let carry = |translation| Carry::by(translation);
    assert_eq!(ami.patches[0].kind, PatchKind::CyclicAmi { partner: 1, carry: carry([2.0, 0.0, 0.0]) });
    assert_eq!(ami.patches[1].kind, PatchKind::CyclicAmi { partner: 0, carry: carry([-2.0, 0.0, 0.0]) });
    assert_eq!(ami.patches[2].kind, PatchKind::CyclicAmi { partner: 3, carry: carry([0.0; 3]) });
}

#[test]
fn names_may_hold_brackets_in_pairs() {
    let (_folder, case) = copied("block");
    edit(&case.join("constant/polyMesh/boundary"), "    lower\n", "    lower[1](a)\n");
    edit(&case.join("constant/polyMesh/boundary"), "2(wall solid)", "2(wall solid[2])");
    for field in ["U", "p", "k", "epsilon"] {
        edit(&case.join("2").join(field), "    lower\n", "    lower[1](a)\n");
    }
    let mesh = latest(&case).mesh;
    assert_eq!(
        (mesh.patches[2].name.as_str(), &mesh.patches[2].groups[..]),
        ("lower[1](a)", &["wall".to_owned(), "solid[2]".into()][..])
    );
}

#[test]
fn a_rotation_is_the_same_told_in_every_way_and_not_told() {
    // 60° about (1, 0, z): the ends of its arcs have eleven digits
    let exact = [[0.5, -(0.75_f64.sqrt()), 0.0], [0.75_f64.sqrt(), 0.5, 0.0], [0.0, 0.0, 1.0]];
    let line = "transform       rotational;\n        neighbourPatch  high;\n        rotationAxis    (0 0 1);\n        rotationCentre  (1 0 0);";
    for way in [
        line,
        "transform unknown; neighbourPatch high;",
        "neighbourPatch high; transformType rotational; rotationAxis (0 0 1); rotationCentre (1 0 0); rotationAngle 60;",
        "neighbourPatch high; transform rotational; rotationAxis (0 0 -3); rotationCentre (1 0 7);",
    ] {
        let (_folder, case) = copied("ring");
        edit(&case.join("constant/polyMesh/boundary"), line, way);
        let mesh = latest(&case).mesh;
        let PatchKind::Cyclic { partner: 3, carry } = mesh.patches[2].kind else { panic!("{:?}", mesh.patches[2]) };
        for (x, e) in carry.rotation.iter().flatten().zip(exact.iter().flatten()) {
            assert!((x - e).abs() < 1e-10, "{way}: {carry:?}");
        }
        assert!(carry.point([1.0, 0.0, 5.0]).iter().zip([1.0, 0.0, 5.0]).all(|(x, e)| (x - e).abs() < 1e-10), "{way}");
    }
}

#[test]
fn an_axis_that_does_not_lead_onto_the_other_side_is_refused() {
    let as_ami = |axis: &str| {
        let (_folder, case) = copied("ring");
        let file = case.join("constant/polyMesh/boundary");
        for _ in 0..2 {
            edit(&file, "type            cyclic;", "type cyclicAMI;");
            edit(&file, "rotationAxis    (0 0 1);", axis);
        }
        read(&case, &Options::default())
    };
    let mesh = as_ami("rotationAxis (0 0 -1);").unwrap().mesh;
    let PatchKind::CyclicAmi { carry, .. } = mesh.patches[2].kind else { panic!("{:?}", mesh.patches[2]) };
    assert!((carry.rotation[0][0] - 0.5).abs() < 1e-3, "{carry:?}");
    for axis in ["rotationAxis (0 1 0);", "rotationAxis (1 1 1);", "rotationAxis (0.3 0 1);"] {
        let error = as_ami(axis).unwrap_err().to_string();
        assert!(error.contains("low") && error.contains("rotationAxis and rotationCentre"), "{axis}: {error}");
    }
}

#[test]
fn a_mesh_that_moves_is_the_newest_up_to_the_time() {
    let (_folder, case) = copied("block");
    fs::create_dir_all(case.join("1.5/polyMesh")).unwrap();
    let mut points = fs::read_to_string(case.join("constant/polyMesh/points")).unwrap();
    // a corner, and the corner that lies on it through the periodic sides
    for (from, to) in [("(0 0 0)", "(-1e-2 0 0)"), ("(0 0 0.1)", "(-1e-2 0 0.1)")] {
        assert!(points.contains(from), "{points}");
        points = points.replace(from, to);
    }
    fs::write(case.join("1.5/polyMesh/points"), points).unwrap();
    assert_eq!(latest(&case).mesh.points[0], [-0.01, 0.0, 0.0]);
    let options = Options { time: Some("1".into()), ..Options::default() };
    assert_eq!(read(&case, &options).unwrap().mesh.points[0], [0.0; 3]);
}

#[test]
fn quality_is_what_check_mesh_says() {
    // its least and largest volume, total, non-orthogonality and its mean, skewness, aspect ratio
    for (name, said) in [
        ("block", [0.00019074532, 0.00042635856, 0.0036, 2.8624052, 1.4972271, 0.10329879, 2.623745]),
        ("wedge", [0.003621375, 0.010864125, 0.0434565, 0.0, 0.0, 0.33081006, 1.334668]),
        ("ring", [0.013360162, 0.018704227, 0.096193165, 0.0, 0.0, 0.16489267, 1.158485]),
        ("ami", [0.16666667, 0.25, 2.0, 0.0, 0.0, 0.0, 3.0]),
    ] {
        let q = quality(&latest(&stored(name)).mesh);
        let got = [
            q.smallest.value,
            q.largest.value,
            q.volume,
            q.non_orthogonality.value,
            q.mean_non_orthogonality,
            q.skewness.value,
            q.aspect_ratio.value,
        ];
        for (i, (x, said)) in got.iter().zip(said).enumerate() {
            // eight digits; an angle of zero is known to the root of rounding
            assert!(
                (x - said).abs() <= 6e-8 * said + if i == 3 || i == 4 { 2e-6 } else { 1e-12 },
                "{name} {i}: {x} {said}"
            );
        }
        assert_eq!((q.inverted.count, q.negative.count), (0, 0));
    }
    let kinds = quality(&latest(&stored("wedge")).mesh).kinds;
    assert_eq!((kinds.hexahedra, kinds.prisms), (3, 3));
}
