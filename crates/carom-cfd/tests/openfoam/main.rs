//! Cases that OpenFOAM v1912 wrote, and the same cases written otherwise.

mod fields;
mod layouts;
mod meshes;
mod refusals;
mod writer;

use std::fs;
use std::path::{Path, PathBuf};

use carom_cfd::openfoam::{Options, read};
use carom_cfd::{Error, Field, Snapshot};

/// A stored case.
fn stored(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases").join(name)
}

fn latest(case: &Path) -> Snapshot {
    read(case, &Options::default()).unwrap()
}

fn refusal(case: &Path) -> String {
    message(read(case, &Options::default()), case)
}

fn message(result: Result<Snapshot, Error>, case: &Path) -> String {
    result.unwrap_err().to_string().replace(case.to_str().unwrap(), "CASE")
}

/// A folder of its own with a copy of a stored case.
fn copied(name: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case");
    copy(&stored(name), &case, &|bytes| bytes);
    (folder, case)
}

/// Copies a folder, every file changed.
fn copy(from: &Path, to: &Path, change: &dyn Fn(Vec<u8>) -> Vec<u8>) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let (path, name) = entry.map(|e| (e.path(), e.file_name())).unwrap();
        if path.is_dir() {
            copy(&path, &to.join(name), change);
        } else {
            fs::write(to.join(name), change(fs::read(path).unwrap())).unwrap();
        }
    }
}

/// Replaces a piece of a file's text, which must be there.
fn edit(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).unwrap();
    assert!(text.contains(from), "{} has no {from:?}", file.display());
    fs::write(file, text.replacen(from, to, 1)).unwrap();
}

fn values<const N: usize>(field: Option<&Field<N>>) -> (&[[f64; N]], &[[f64; N]]) {
    match field.unwrap() {
        Field::Cells { cells, boundary } => (cells, boundary),
        Field::Points(_) => panic!("by points"),
    }
}

/// The numbers of an ASCII field's cells, read in a way of their own.
fn plain_numbers(file: &Path) -> Vec<f64> {
    let text = fs::read_to_string(file).unwrap();
    let list = text.split("internalField").nth(1).unwrap().split(';').next().unwrap();
    let list = &list[list.find('(').unwrap()..];
    list.split(|c: char| c.is_whitespace() || "()".contains(c))
        .filter(|w| !w.is_empty())
        .map(|w| w.parse().unwrap())
        .collect()
}

/// Mesh and fields are the same, and the time; not what there is to say.
fn same(a: &Snapshot, b: &Snapshot) {
    assert_eq!(a.mesh, b.mesh);
    assert_eq!(a.fields.scalars(), b.fields.scalars());
    assert_eq!(a.fields.velocity, b.fields.velocity);
    assert_eq!(a.time, b.time);
}
