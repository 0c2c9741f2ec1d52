//! Legacy files as VTK and others write them.

use super::*;

/// A file of one cube up to its arrays.
fn cube(binary: bool) -> Vec<u8> {
    let corners: [[u8; 3]; 8] =
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
    let mut file = Vec::new();
    // in Latin-1, as the title may be
    let form = if binary { "BINARY" } else { "ASCII" };
    file.extend(b"# vtk DataFile Version 4.2\nW\xfcrfel\n");
    file.extend(format!("{form}\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n").bytes());
    let numbers = |file: &mut Vec<u8>, all: &[i32]| {
        for n in all {
            if binary { file.extend(n.to_be_bytes()) } else { file.extend(format!("{n} ").bytes()) }
        }
        file.push(b'\n');
    };
    reals(&mut file, binary, corners.as_flattened().iter().map(|c| f64::from(*c)));
    file.extend(b"CELLS 1 9\n");
    numbers(&mut file, &[8, 0, 1, 2, 3, 4, 5, 6, 7]);
    file.extend(b"CELL_TYPES 1\n");
    numbers(&mut file, &[12]);
    file
}

fn reals(file: &mut Vec<u8>, binary: bool, all: impl IntoIterator<Item = f64>) {
    for x in all {
        if binary { file.extend(x.to_be_bytes()) } else { file.extend(format!("{x} ").bytes()) }
    }
    file.push(b'\n');
}

/// A cube with `before` ahead of a velocity of 1 and a pressure of 5.
fn with(binary: bool, before: &[&[u8]]) -> Vec<u8> {
    let mut file = cube(binary);
    file.extend(b"POINT_DATA 8\n");
    file.extend(before.concat());
    file.extend(b"FIELD FieldData 2\nU 3 8 double\n");
    reals(&mut file, binary, [1.0; 24]);
    file.extend(b"p 1 8 double\n");
    reals(&mut file, binary, [5.0; 8]);
    file
}

fn parsed(file: &[u8]) -> Result<Snapshot, String> {
    from_bytes(file.to_vec(), &Options::default()).map_err(|e| e.to_string())
}

/// The names of the arrays before velocity and pressure, which are read.
fn others(file: &[u8]) -> Vec<String> {
    let fields = parsed(file).unwrap().fields;
    assert_eq!((points(&fields.velocity), points(&fields.pressure)), (&[[1.0; 3]; 8][..], &[[5.0]; 8][..]));
    fields.others
}

#[test]
fn ids_have_four_bytes() {
    let ids: Vec<u8> = (0..8u32).flat_map(|n| (n << 7).to_be_bytes()).collect();
    assert_eq!(others(&with(true, &[b"GLOBAL_IDS gid vtkIdType\n", &ids, b"\n"])), ["gid"]);
    let wide: Vec<u8> = (0..8u64).flat_map(|n| (n << 7).to_be_bytes()).collect();
    assert_eq!(others(&with(true, &[b"SCALARS n vtktypeint64\nLOOKUP_TABLE default\n", &wide, b"\n"])), ["n"]);
}

#[test]
fn what_is_no_text_is_an_error_and_loses_no_arrays() {
    // four bytes more than the type says, before the end of a line
    let file = with(true, &[b"GLOBAL_IDS gid int\n", &[0x81; 36], b"\n"]);
    let begin = memchr::memmem::find(&file, &[0x81; 36]).unwrap();
    let error = parsed(&file).unwrap_err();
    assert!(error.contains(&format!("byte {}: a byte that is no UTF-8 text", begin + 32)), "{error}");
}
