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

#[test]
fn arrays_that_are_not_used_are_passed_over() {
    let scalars = |binary| {
        let mut array = b"SCALARS s double\nLOOKUP_TABLE colours\n".to_vec();
        reals(&mut array, binary, [1.0; 8]);
        array
    };
    let mut six = [b"TENSORS6 stress double\n".to_vec(), b"TENSORS6 stress double\n".to_vec()];
    six.iter_mut().zip([false, true]).for_each(|(six, binary)| reals(six, binary, [1.0; 48]));
    let rgb = "0 0.5 1 ".repeat(8);
    for (binary, before, want) in [
        (false, [b"COLOR_SCALARS rgb 3\n", rgb.as_bytes(), b"\n"], &["rgb"][..]),
        (true, [b"COLOR_SCALARS rgb 3\n", &[0x8a; 24], b"\n"], &["rgb"]),
        (false, [&scalars(false), b"LOOKUP_TABLE colours 2\n0 0 0 1\n1 1 1 1\n", b"\n"], &["s"]),
        (true, [&scalars(true), b"LOOKUP_TABLE colours 2\n", b"\0\0\0\xff\xff\xff\xff\xff\n"], &["s"]),
        (false, [&six[0], b"", b""], &["stress"]),
        (true, [&six[1], b"", b""], &["stress"]),
        (false, [b"SCALARS on bit\nLOOKUP_TABLE default\n", b"0 1 0 1 0 1 0 1\n", b""], &["on"]),
        (true, [b"SCALARS on bit\nLOOKUP_TABLE default\n", b"\xc5\n", b""], &["on"]),
        (true, [b"SCALARS on bit 3\nLOOKUP_TABLE default\n", b"\x80\x81\xc5\n", b""], &["on"]),
        // texts, of which some are empty
        (false, [b"FIELD FieldData 1\nnames 1 8 string\n", b"\na%20b\n\nc\nPOINT_DATA 3\n\ne\n\n", b"\n"], &[]),
    ] {
        assert_eq!(others(&with(binary, &before)), want, "{binary}");
    }
    let long = "\u{e4}".repeat(9000);
    let mut texts = b"FIELD FieldData 1\nnames 1 8 string\n\xc0\xc2ab\xc1\n\xc0".to_vec();
    texts.extend(16_000u16.to_be_bytes().map(|b| b | if b == 62 { 0x80 } else { 0 }));
    texts.extend(&long.as_bytes()[..16_000]);
    texts.extend((18_000u32 | 1 << 30).to_be_bytes());
    texts.extend(long.bytes());
    texts.extend(2u64.to_be_bytes());
    texts.extend(b"cd\xc0\n");
    assert_eq!(others(&with(true, &[&texts])), Vec::<String>::new());
    let cut = parsed(&with(true, &[b"FIELD FieldData 1\nnames 1 8 string\n\x3f\xff"])).unwrap_err();
    assert!(cut.ends_with("the file ends within an array of texts"), "{cut}");
}

#[test]
fn bytes_that_are_written_as_colours_mark_ghosts() {
    for (binary, mark) in [(false, &b"0.00392157\n"[..]), (true, b"\x01\n")] {
        let mut file = with(binary, &[]);
        file.extend(b"CELL_DATA 1\nCOLOR_SCALARS vtkGhostType 1\n");
        file.extend(mark);
        let error = parsed(&file).unwrap_err();
        assert!(error.contains("no cells but 1 copies of another piece's"), "{error}");
    }
}

#[test]
fn texts_of_cells_name_patches() {
    for (binary, names) in [(false, &b"lower%20wall\n\n"[..]), (true, b"\xcalower wall\xc0\n")] {
        let mut file = with(binary, &[]);
        file.extend(b"CELL_DATA 2\nFIELD FieldData 1\nnames 1 2 string\n");
        file.extend(names);
        // a square beside the cube
        let replace = |file: Vec<u8>, from: &[u8], to: &[u8]| {
            let at = memchr::memmem::find(&file, from).unwrap();
            [&file[..at], to, &file[at + from.len()..]].concat()
        };
        let number = |all: &[i32]| -> Vec<u8> {
            all.iter()
                .flat_map(|n| if binary { n.to_be_bytes().to_vec() } else { format!("{n} ").into_bytes() })
                .collect()
        };
        file = replace(file, b"CELLS 1 9\n", &[b"CELLS 2 14\n", &number(&[4, 0, 1, 2, 3])[..]].concat());
        let old = [b"CELL_TYPES 1\n", &number(&[12])[..]].concat();
        file = replace(file, &old, &[b"CELL_TYPES 2\n", &number(&[9, 12])[..]].concat());
        let snapshot = from_bytes(file.clone(), &told(Some("names"))).unwrap();
        assert_eq!(patches(&snapshot.mesh), [("lower wall", 1), ("boundary", 5)]);
        assert_eq!(parsed(&file).unwrap().fields.others, ["names"]);
    }
}

#[test]
fn a_file_without_arrays_has_no_velocity() {
    let error = parsed(&cube(false)).unwrap_err();
    assert!(error.ends_with("no field `U`; there are none"), "{error}");
}
