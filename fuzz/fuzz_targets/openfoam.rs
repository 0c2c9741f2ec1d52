//! Any bytes as one file of a case of OpenFOAM, the others being sound: it is read or refused, never a panic. `cargo fuzz run openfoam`
#![no_main]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use carom_cfd::openfoam::{Options, read};
use libfuzzer_sys::fuzz_target;

const FILES: [&str; 11] = [
    "constant/polyMesh/boundary",
    "constant/polyMesh/faces",
    "constant/polyMesh/neighbour",
    "constant/polyMesh/owner",
    "constant/polyMesh/points",
    "2/U",
    "2/k",
    "constant/polyMesh/cellProcAddressing",
    "constant/polyMesh/faceProcAddressing",
    "constant/polyMesh/pointProcAddressing",
    "constant/polyMesh/boundaryProcAddressing",
];

/// Cases as stored, copied to where they can be changed.
static CASES: LazyLock<[PathBuf; 3]> = LazyLock::new(|| {
    ["block", "block-binary", "block-collated"].map(|name| {
        let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/carom-cfd/tests/cases").join(name);
        let to = std::env::temp_dir().join(format!("carom-fuzz-{}", std::process::id())).join(name);
        copy(&from, &to);
        to
    })
});

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let (path, name) = entry.map(|e| (e.path(), e.file_name())).unwrap();
        if path.is_dir() {
            copy(&path, &to.join(name));
        } else {
            fs::copy(path, to.join(name)).unwrap();
        }
    }
}

fuzz_target!(|input: (u8, &[u8])| {
    let (choice, bytes) = (usize::from(input.0), input.1);
    let (case, file) = (&CASES[choice % 3], FILES[choice / 3 % FILES.len()]);
    let parts = case.join("processors4");
    let file = if parts.exists() { parts.join(file) } else { case.join(file) };
    let sound = fs::read(&file).ok();
    fs::write(&file, bytes).unwrap();
    let result = read(case, &Options::default());
    match sound {
        Some(sound) => fs::write(&file, sound).unwrap(),
        None => fs::remove_file(&file).unwrap(),
    }
    if let Ok(result) = result {
        // what is read can be used
        assert_eq!(carom_cfd::check::snapshot(&result), Ok(()));
    }
});
