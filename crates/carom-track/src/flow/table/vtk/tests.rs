use super::*;
use proptest::prelude::*;

const HEAD: &str = "# vtk DataFile Version 3.0\na channel\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 3 1\n\
                    X_COORDINATES 2 float\n0 1\nY_COORDINATES 3 float\n0 1\n4\nZ_COORDINATES 1 float\n0\n";
const DATA: &str = "POINT_DATA 6\nVECTORS U float\n0 0 0  1 0 0\n10 1 0 11 1 0 40 4 0 41 4 0\n\
                    FIELD FieldData 2\nk 1 6 float\n1 1 1 1 1 1\nepsilon 1 6 double\n2 2 2 2 2 2\n\
                    SCALARS p float 1\nLOOKUP_TABLE default\n0 0 0 0 0 0\n";

#[test]
fn ascii() {
    let table = Table::from_vtk(format!("{HEAD}{DATA}").as_bytes()).unwrap();
    assert_eq!(table.size(), [2, 3, 1]);
    assert_eq!(table.velocity([0.5, 2.5, 0.0]), [25.5, 2.5, 0.0]);
    let local = table.sample([0.5, 2.5, 0.0]);
    assert_eq!((local.k, local.epsilon), (1.0, 2.0));
}

#[test]
fn binary_with_metadata_on_even_points() {
    let mut file = b"# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET STRUCTURED_POINTS\n".to_vec();
    file.extend(b"DIMENSIONS 2 1 2\nSPACING 0.5 1 2\nORIGIN 1 0 0\nPOINT_DATA 4\nVECTORS velocity double\n");
    for n in 0..4 {
        for c in [f64::from(n), 0.0, 7.5] {
            file.extend(c.to_be_bytes());
        }
    }
    file.extend(b"\nMETADATA\nINFORMATION 0\n\nSCALARS p float 1\nLOOKUP_TABLE default\n");
    file.extend([1.0f32; 4].iter().flat_map(|v| v.to_be_bytes()));
    file.extend(b"\n");
    let table = Table::from_vtk(&file).unwrap();
    assert_eq!(table.bounds(), [[1.0, 0.0, 0.0], [1.5, 0.0, 2.0]]);
    assert_eq!(table.velocity([1.25, 0.0, 1.0]), [1.5, 0.0, 7.5]);
}

#[test]
fn errors_say_what() {
    let fails = |text: String, want: &str| {
        let error = Table::from_vtk(text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(want), "{error}");
    };
    fails("hello".into(), "# vtk DataFile");
    fails(format!("{HEAD}{DATA}").replace("RECTILINEAR_GRID", "POLYDATA"), "POLYDATA is not a rectilinear grid");
    fails(format!("{HEAD}{DATA}").replace("2 3 1", "2 3 4000000000"), "do not fit");
    fails(format!("{HEAD}{DATA}").replace("0 1\n4", "0 1\n1"), "coordinates must rise");
    fails(format!("{HEAD}{DATA}").replace("VECTORS U", "SCALARS U"), "where LOOKUP_TABLE should be");
    fails(format!("{HEAD}{DATA}").replace("41 4 0", "41 4 x"), "\"x\" is not a number");
    fails(format!("{HEAD}{DATA}").replace("41 4 0", "41 4 nan"), "NaN at node (1, 2, 0)");
    fails(HEAD.into(), "where POINT_DATA should be");
    fails(format!("{HEAD}POINT_DATA 6\n"), "no vectors named");
    fails(format!("{HEAD}POINT_DATA 6\nVECTORS U float\n0 0 0"), "the file ends");
}

proptest! {
    #[test]
    fn bytes_never_panic(cut in 0usize..400, at in 0usize..400, byte: u8) {
        let mut file = format!("{HEAD}{DATA}").into_bytes();
        let n = file.len();
        file[at % n] = byte;
        file.truncate(n - cut % n);
        let _ = Table::from_vtk(&file);
        let binary = String::from_utf8_lossy(&file).replace("ASCII", "BINARY");
        let _ = Table::from_vtk(binary.as_bytes());
    }
}

#[test]
fn masks_and_cells() {
    // u = 1 where it is valid; the rest is what a program puts where it has nothing
    let mask = "SCALARS vtkValidPointMask char 1\nLOOKUP_TABLE default\n1 1 1 0 1 1\n";
    let u = "POINT_DATA 6\nVECTORS U float\n1 0 0 1 0 0 1 0 0 nan 0 0 1 0 0 1 0 0\n";
    let table = Table::from_vtk(format!("{HEAD}{u}{mask}").as_bytes()).unwrap();
    assert_eq!(table.velocity([0.9, 1.2, 0.0]), [1.0, 0.0, 0.0]);
    assert!(table.notes().iter().any(|n| n.starts_with("1 of 6 nodes")), "{:?}", table.notes());
    let error = Table::from_vtk(format!("{HEAD}{u}").as_bytes()).unwrap_err().to_string();
    assert!(error.contains("NaN"), "{error}");
    // two cells, each 1 m wide: 1 m/s in the first, 3 m/s in the second, whose middle is 2.5 m
    let cells = "CELL_DATA 2\nVECTORS U float\n1 0 0 3 0 0\n";
    let table = Table::from_vtk(format!("{HEAD}{cells}").as_bytes()).unwrap();
    assert_eq!((table.size(), table.bounds()), ([3, 4, 1], [[0.0; 3], [1.0, 4.0, 0.0]]));
    for (y, u) in [(0.2, 1.0), (1.5, 2.0), (3.5, 3.0)] {
        assert_eq!(table.velocity([0.0, y, 0.0]), [u, 0.0, 0.0]);
    }
    // the second cell is blanked: its outer nodes are no data
    let ghost = "CELL_DATA 2\nSCALARS vtkGhostType unsigned_char 1\nLOOKUP_TABLE default\n0 32\n";
    let u = "POINT_DATA 6\nVECTORS U float\n1 0 0 1 0 0 1 0 0 1 0 0 9 0 0 9 0 0\n";
    let table = Table::from_vtk(format!("{HEAD}{u}{ghost}").as_bytes()).unwrap();
    assert_eq!(table.velocity([0.5, 4.0, 0.0]), [1.0, 0.0, 0.0]);
}
