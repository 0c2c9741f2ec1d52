//! The same case stored in every way gives the same.

use std::io::Write;

use carom_cfd::geometry::{cell_centres_and_volumes, face_centres_and_areas};

use super::*;

#[test]
fn binary_collated_and_both_are_as_the_case_in_one_piece() {
    let ascii = latest(&stored("block"));
    for name in ["block-binary", "block-collated", "block-collated-binary"] {
        same(&ascii, &latest(&stored(name)));
    }
    let notes = latest(&stored("block-collated")).notes;
    assert!(notes.iter().any(|n| n == "put together from the processors' collated folders"), "{notes:?}");
}

#[test]
fn compressed_files_are_unpacked() {
    let folder = tempfile::tempdir().unwrap();
    let pack = |bytes: Vec<u8>| {
        let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
        packer.write_all(&bytes).unwrap();
        packer.finish().unwrap()
    };
    for name in ["block", "block-binary", "block-collated"] {
        let case = folder.path().join(name);
        copy(&stored(name), &case, &pack);
        rename(&case);
        same(&latest(&stored("block")), &latest(&case));
        assert_eq!(latest(&case).fields.others, latest(&stored(name)).fields.others);
    }
}

/// Adds `.gz` to every file's name.
fn rename(folder: &Path) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rename(&path);
        } else {
            fs::rename(&path, format!("{}.gz", path.display())).unwrap();
        }
    }
}

/// Splits a collated file into what each processor's own file holds: the first block's header, then its block.
fn split(bytes: &[u8]) -> Vec<Vec<u8>> {
    let (mut rest, mut parts) = (bytes, Vec::new());
    let find = |b: &[u8], what: &[u8]| b.windows(what.len()).position(|w| w == what);
    while let Some(at) = find(rest, b"// Processor") {
        rest = &rest[at..];
        rest = &rest[find(rest, b"\n\n").unwrap() + 2..];
        let open = find(rest, b"\n(").unwrap();
        let len: usize = std::str::from_utf8(&rest[..open]).unwrap().trim().parse().unwrap();
        parts.push(rest[open + 2..open + 2 + len].to_vec());
        rest = &rest[open + 2 + len..];
    }
    let end = find(&parts[0], b"}\n").unwrap() + 2;
    let header = parts[0][..end].to_vec();
    parts[1..].iter_mut().for_each(|p| *p = [&header, p.as_slice()].concat());
    parts
}

/// Writes a decomposed case from a collated one; files whose names hold `without` are left out.
fn decomposed(name: &str, to: &Path, without: &str) {
    for folder in ["constant/polyMesh", "2"] {
        for entry in fs::read_dir(stored(name).join("processors4").join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let file = path.file_name().unwrap().to_str().unwrap();
            if !without.is_empty() && file.contains(without) {
                continue;
            }
            for (i, part) in split(&fs::read(&path).unwrap()).into_iter().enumerate() {
                let out = to.join(format!("processor{i}")).join(folder);
                fs::create_dir_all(&out).unwrap();
                fs::write(out.join(file), part).unwrap();
            }
        }
    }
}

#[test]
fn processors_folders_are_put_together() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["block-collated", "block-collated-binary"] {
        let case = folder.path().join(name);
        decomposed(name, &case, "");
        same(&latest(&stored("block")), &latest(&case));
    }
}

#[test]
fn collated_in_several_folders() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case");
    let from = stored("block-collated").join("processors4");
    for place in ["constant/polyMesh", "2"] {
        for (part, range) in [("0-1", 0..2), ("2-3", 2..4)] {
            let out = case.join(format!("processors4_{part}")).join(place);
            fs::create_dir_all(&out).unwrap();
            for entry in fs::read_dir(from.join(place)).unwrap() {
                let path = entry.unwrap().path();
                let bytes = fs::read(&path).unwrap();
                let mut all = b"FoamFile { format binary; class decomposedBlockData; }\n".to_vec();
                for (i, block) in split(&bytes)[range.clone()].iter().enumerate() {
                    write!(all, "\n// Processor{i}\n\n{}\n(", block.len()).unwrap();
                    all.extend(block);
                    all.extend(b")\n");
                }
                fs::write(out.join(path.file_name().unwrap()), all).unwrap();
            }
        }
    }
    same(&latest(&stored("block")), &latest(&case));
}

/// What does not depend on how cells and faces are numbered.
fn unnumbered(s: &Snapshot) -> (Vec<String>, Vec<String>) {
    let m = &s.mesh;
    let (fc, fa) = face_centres_and_areas(&m.points, &m.faces);
    let (cc, cv) = cell_centres_and_volumes(m, &fc, &fa);
    let (u, on) = values(s.fields.velocity.as_ref());
    let (k, _) = values(s.fields.k.as_ref());
    let show = |x: &[f64]| {
        x.iter().map(|x| format!("{:.6}", x + 0.0)).collect::<Vec<_>>().join(" ").replace("-0.000000", "0.000000")
    };
    let mut cells: Vec<_> =
        (0..m.cells).map(|c| [show(&cc[c]), show(&[cv[c], k[c][0]]), show(&u[c])].join(" ")).collect();
    let mut faces: Vec<_> = m
        .patches
        .iter()
        .flat_map(|p| p.faces.clone().map(|f| (p.name.clone(), f)))
        .collect::<Vec<_>>()
        .into_iter()
        .map(|(name, f)| [name, show(&fc[f]), show(&fa[f]), show(&on[f - m.inner_faces()])].join(" "))
        .collect();
    cells.sort();
    faces.sort();
    (cells, faces)
}

#[test]
fn parts_without_addressing_are_joined_by_their_faces() {
    let folder = tempfile::tempdir().unwrap();
    decomposed("block-collated", folder.path(), "ProcAddressing");
    let (whole, joined) = (latest(&stored("block")), latest(folder.path()));
    assert_eq!(whole.mesh.points.len(), joined.mesh.points.len());
    assert_eq!(whole.mesh.inner_faces(), joined.mesh.inner_faces());
    assert_eq!(unnumbered(&whole), unnumbered(&joined));
    assert!(joined.notes.iter().any(|n| n.contains("joined by their common faces")), "{:?}", joined.notes);
    // with faces of the periodic sides in the same order, or they would not have been carried over
    assert_eq!(whole.mesh.patches[4].kind, joined.mesh.patches[4].kind);
}

#[test]
fn addressing_of_another_mesh_is_not_believed() {
    let folder = tempfile::tempdir().unwrap();
    decomposed("block-collated", folder.path(), "");
    let file = folder.path().join("processor1/constant/polyMesh/cellProcAddressing");
    edit(&file, "3(", "3(7 ");
    let text = fs::read_to_string(&file).unwrap().replacen("3(7 ", "4(7 ", 1);
    fs::write(&file, text).unwrap();
    assert_eq!(unnumbered(&latest(&stored("block"))), unnumbered(&latest(folder.path())));
}

#[test]
fn the_later_of_whole_and_decomposed_is_read_and_the_whole_of_equals() {
    let (_folder, case) = copied("block");
    decomposed("block-collated", &case, "");
    let note = |s: Snapshot| s.notes.iter().any(|n| n.contains("4 processors"));
    assert!(!note(latest(&case)));
    fs::remove_dir_all(case.join("2")).unwrap();
    assert!(note(latest(&case)));
    assert_eq!(latest(&case).time.as_deref(), Some("2"));
}

#[test]
fn a_processor_that_is_missing_is_named() {
    let folder = tempfile::tempdir().unwrap();
    decomposed("block-collated", folder.path(), "");
    let part = refusal(&folder.path().join("processor1"));
    assert!(part.contains("joins it to another processor's part: the case is the folder above"), "{part}");
    fs::remove_file(folder.path().join("processor2/2/k")).unwrap();
    assert_eq!(refusal(folder.path()), "CASE/processor2/2/k: is not there, and other processors have it");
    fs::remove_dir_all(folder.path().join("processor1")).unwrap();
    assert_eq!(refusal(folder.path()), "CASE: there are folders of 3 processors, and none of processor1");
}
