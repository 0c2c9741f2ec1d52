//! The files a case names, and the number that tells a case from others.

use carom::material::{Material, PropertyKind};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::Path;

/// Files that a case names and that are held in memory, by the name that the case gives them.
#[derive(Clone, Debug, Default)]
pub struct Sources(BTreeMap<String, Vec<u8>>);

impl Sources {
    /// These, by name.
    pub fn new(files: BTreeMap<String, Vec<u8>>) -> Self {
        Self(files)
    }
}

/// FNV-1a: enough to tell an edited case from the one that was interrupted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    pub fn of(text: &str) -> Self {
        Self(0xcbf2_9ce4_8422_2325).with(text.as_bytes())
    }

    fn with(self, bytes: &[u8]) -> Self {
        Self(bytes.iter().fold(self.0, |h, b| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3)))
    }

    /// With a material's name and the value of each of its properties, to the last digit.
    pub fn with_material(self, material: &Material) -> Self {
        let named = self.with(material.name.as_bytes()).with(&[0]);
        PropertyKind::ALL
            .iter()
            .filter_map(|kind| Some((kind, material.value(*kind)?)))
            .fold(named, |sum, (kind, value)| sum.with(kind.key().as_bytes()).with(&value.to_bits().to_le_bytes()))
    }

    pub fn number(self) -> u64 {
        self.0
    }
}

/// Largest file read, bytes; one without blocks may claim any size.
pub(crate) const LARGEST: u64 = 8 << 30;

/// Reads the files that a case names, beside it, and takes them into its fingerprint.
pub(super) struct Files<'a> {
    folder: &'a Path,
    sources: &'a Sources,
    fingerprint: Cell<Fingerprint>,
}

impl<'a> Files<'a> {
    /// Of a case with that text.
    pub fn new(case: &'a Path, text: &str, sources: &'a Sources) -> Self {
        Self { folder: case.parent().unwrap_or(Path::new("")), sources, fingerprint: Cell::new(Fingerprint::of(text)) }
    }

    /// What is in a file; not in what may never end, such as a device or a pipe.
    pub fn read(&self, name: &str) -> std::io::Result<Vec<u8>> {
        let bytes = match self.sources.0.get(name) {
            Some(bytes) => bytes.clone(),
            None => carom_table::file::read_regular(&self.folder.join(name), LARGEST)?,
        };
        self.fingerprint.set(self.fingerprint.get().with(&bytes));
        Ok(bytes)
    }

    /// The path of a file or folder beside the case.
    pub fn beside(&self, name: &str) -> std::path::PathBuf {
        self.folder.join(name)
    }

    /// Takes a mesh and its velocities into the fingerprint.
    pub fn take_in(&self, snapshot: &carom_cfd::Snapshot) {
        let mut sum = self.fingerprint.get();
        let mut word = |w: u64| sum = Fingerprint((sum.0 ^ w).wrapping_mul(0x0100_0000_01b3).rotate_left(23));
        snapshot.mesh.points.iter().flatten().for_each(|c| word(c.to_bits()));
        snapshot.mesh.faces.corners.iter().chain(&snapshot.mesh.owner).for_each(|i| word(u64::from(*i)));
        match &snapshot.fields.velocity {
            Some(carom_cfd::Field::Points(values)) => values.iter().flatten().for_each(|c| word(c.to_bits())),
            Some(carom_cfd::Field::Cells { cells, boundary }) => {
                cells.iter().chain(boundary).flatten().for_each(|c| word(c.to_bits()));
            }
            None => {}
        }
        let scalars = [&snapshot.fields.k, &snapshot.fields.epsilon, &snapshot.fields.omega];
        for field in scalars.into_iter().flatten() {
            let (carom_cfd::Field::Points(values) | carom_cfd::Field::Cells { cells: values, .. }) = field;
            values.iter().flatten().for_each(|c| word(c.to_bits()));
        }
        self.fingerprint.set(sum);
    }

    /// Of the text and all files read.
    pub fn fingerprint(&self) -> Fingerprint {
        self.fingerprint.get()
    }
}
