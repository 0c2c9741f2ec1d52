//! What is wrong is said with its place.

use super::*;

#[test]
fn no_case_no_mesh_no_fields() {
    let folder = tempfile::tempdir().unwrap();
    let none = "CASE: no OpenFOAM case: there is no constant/polyMesh, whole or in processors' folders";
    assert_eq!(refusal(folder.path()), none);
    fs::create_dir_all(folder.path().join("constant/fluid/polyMesh")).unwrap();
    assert_eq!(refusal(folder.path()), format!("{none}; there are regions, which are not read: fluid"));
    assert!(refusal(&folder.path().join("nowhere")).starts_with("CASE: "));
    let (_folder, case) = copied("block");
    fs::remove_dir_all(case.join("1")).unwrap();
    fs::remove_dir_all(case.join("2")).unwrap();
    let s = latest(&case);
    assert!(s.fields.velocity.is_none() && s.time.is_none());
    assert_eq!(s.notes, ["there is no time folder: the mesh alone is read"]);
    fs::remove_file(case.join("constant/polyMesh/owner")).unwrap();
    assert_eq!(refusal(&case), "CASE/constant/polyMesh/owner: is not there");
}

#[test]
fn broken_meshes() {
    let mesh = |file: &str, from: &str, to: &str| {
        let (_folder, case) = copied("block");
        edit(&case.join("constant/polyMesh").join(file), from, to);
        refusal(&case)
    };
    let e = mesh("faces", "4(1 5 17 13)", "4(1 5 17 36)");
    assert_eq!(e, "the mesh cannot be used: face 0 names point 36, and there are 36 (numbers start at 0)");
    let e = mesh("faces", "4(1 5 17 13)", "4(1 17 5 13)");
    assert_eq!(e, "the mesh cannot be used: 2 cells are not closed by their faces: 0, 1");
    let e = mesh("faces", "4(1 5 17 13)", "3(1 5 17 13)");
    assert_eq!(e, "CASE/constant/polyMesh/faces:21: a face has not as many corners as it says");
    let e = mesh("owner", "52\n(\n0\n", "52\n(\n99\n");
    assert!(e.starts_with("the mesh cannot be used: face 0 names cell 99"), "{e}");
    let e = mesh("points", "(0 0 0)", "(0 nan 0)");
    assert_eq!(e, "the mesh cannot be used: point 0 is not finite: [0.0, NaN, 0.0]");
    let e = mesh("points", "36\n", "37\n");
    assert_eq!(e, "CASE/constant/polyMesh/points:20: a list of 37 ends after 36");
    let e = mesh("boundary", "nFaces          6;", "nFaces          5;");
    assert!(e.ends_with("boundary: patch `upper` has the faces 34..40 where 33 is the next of 52"), "{e}");
    let e = mesh("boundary", "neighbourPatch  left", "neighbourPatch  leftmost");
    assert_eq!(e, "CASE: patch `right`: its neighbourPatch `leftmost` is not there");
    let e = mesh("boundary", "neighbourPatch  left", "neighbourPatch  upper");
    assert!(e.contains("patch `right`: its faces do not lie on its other side's"), "{e}");
    let e = mesh("boundary", "type            patch", "type            cyclicACMI");
    assert_eq!(e, "CASE: patch `inlet`: patches of type cyclicACMI are not read");
    let e = mesh("faces", "FoamFile", "foamfile");
    assert!(e.contains("it does not begin with a header"), "{e}");
}

#[test]
fn broken_fields() {
    let field = |file: &str, from: &str, to: &str| {
        let (_folder, case) = copied("block");
        edit(&case.join("2").join(file), from, to);
        refusal(&case)
    };
    let e = field("k", "12\n(\n0.019429073\n", "11\n(\n");
    assert_eq!(e, "CASE/2/k:21: k has 11 values for 12 cells: it belongs to another mesh");
    let e = field("k", "0.019429073", "inf");
    assert_eq!(e, "the mesh cannot be used: field k is not finite in cell 0: inf");
    let e = field("k", "List<scalar> 4(0.033976933 ", "List<scalar> 3(");
    assert!(e.ends_with("patch `outlet` has 3 values for 4 faces: the field belongs to another mesh"), "{e}");
    let e = field("k", "    inlet\n", "    outlets\n");
    assert!(e.ends_with("no entry in boundaryField for patch `inlet`"), "{e}");
    let e = field("U", "value           uniform (1 0.1 0);", "value #calc \"1+1\";");
    assert!(e.contains("values that OpenFOAM works out are not read"), "{e}");
    let e = field("U", "boundaryField", "#include \"other\"\nboundaryField");
    assert!(e.contains("2/U:39: `#include` is not read: write the file out"), "{e}");
    let e = field("U", "volVectorField", "surfaceVectorField");
    assert_eq!(e, "CASE/2/U: is a surfaceVectorField where a volVectorField was expected");
}
