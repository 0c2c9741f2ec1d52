//! Numbers and texts in an HDF5 file.

use crate::Error;
use crate::vtk::{Number, Stored};
use hdf5_reader::{ByteOrder, Datatype, HDF5_MAX_CHUNK_BYTES, OpenOptions};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// No compression makes more bytes than so many of one: a size beyond is a mistake, not a reason to allocate.
const MOST_PACKED: u64 = 1032;

/// What numbers belong to, and these.
pub(super) type Section<T> = (Range<usize>, Vec<T>);

/// An open file.
pub(super) struct Hdf {
    file: hdf5_reader::Hdf5File,
    path: PathBuf,
    size: u64,
}

impl Hdf {
    pub fn open(path: &Path) -> Result<Self, Error> {
        Self::of(carom_table::file::read_regular(path, u64::MAX).map_err(|e| Error::io(path, e))?, path)
    }

    /// What is in a file of that name.
    pub fn of(bytes: Vec<u8>, path: &Path) -> Result<Self, Error> {
        let size = bytes.len() as u64;
        // a list is one chunk in these files, and none is read twice
        let options = OpenOptions::default().with_chunk_cache_bytes(0).with_max_chunk_bytes(HDF5_MAX_CHUNK_BYTES);
        let file = hdf5_reader::Hdf5File::from_vec_with_options(bytes, options);
        let file = file.map_err(|e| Error::file(path, format!("not an HDF5 file that is read: {e}")))?;
        Ok(Self { file, path: path.to_owned(), size })
    }

    pub fn error(&self, what: impl Into<String>) -> Error {
        Error::file(&self.path, what)
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether there is a group at a place.
    pub fn has(&self, group: &str) -> bool {
        self.file.group(group).is_ok()
    }

    /// Names of the groups in a group.
    pub fn groups(&self, group: &str) -> Vec<String> {
        let names = self.file.group(group).and_then(|g| g.member_names());
        names.map(|n| n.0).unwrap_or_default()
    }

    /// A whole number that a group or a list has as an attribute.
    pub fn attribute(&self, at: &str, name: &str) -> Result<u64, Error> {
        let of_group = || self.file.group(at).and_then(|g| g.attribute(name));
        let found = self.file.dataset(at).and_then(|d| d.attribute(name)).or_else(|_| of_group());
        let attribute = found.map_err(|_| self.error(format!("no {name} of {at}")))?;
        let (stored, big) = self.stored(at, &attribute.datatype)?;
        let number = stored.decode::<i64>(&attribute.raw_data, big).first().copied();
        number.and_then(|n| u64::try_from(n).ok()).ok_or_else(|| self.error(format!("{name} of {at} is no number")))
    }

    /// The numbers of a list.
    pub fn numbers<T: Number>(&self, at: &str) -> Result<Vec<T>, Error> {
        let list = self.file.dataset(at).map_err(|_| self.error(format!("no {at}")))?;
        let wrong = |e: hdf5_reader::error::Error| self.error(format!("{at}: {e}"));
        let length = list.raw_byte_len().map_err(wrong)? as u64;
        if length > self.size.saturating_mul(MOST_PACKED) {
            return Err(self.error(format!("{at}: {length} bytes do not fit the file")));
        }
        let (stored, big) = self.stored(at, list.dtype())?;
        Ok(stored.decode(&list.read_raw_bytes().map_err(wrong)?, big))
    }

    /// So many numbers of a list.
    pub fn so_many<T: Number>(&self, at: &str, count: usize) -> Result<Vec<T>, Error> {
        let numbers = self.numbers(at)?;
        if numbers.len() != count {
            return Err(self.error(format!("{at}: {} values where {count} are wanted", numbers.len())));
        }
        Ok(numbers)
    }

    /// Texts between semicolons.
    pub fn texts(&self, at: &str) -> Result<Vec<String>, Error> {
        let list = self.file.dataset(at).map_err(|_| self.error(format!("no {at}")))?;
        let text = list.read_string().map_err(|e| self.error(format!("{at}: {e}")))?;
        Ok(text.split(';').map(|t| t.trim_matches(['\0', ' ']).to_owned()).collect())
    }

    /// The numbers of the sections of a list, each with the range of what they belong to, from 0.
    pub fn sections<T: Number>(&self, at: &str) -> Result<Vec<Section<T>>, Error> {
        let mut all = Vec::new();
        for section in 1..=self.attribute(at, "nSections")? {
            let at = format!("{at}/{section}");
            let range = self.range(&at)?;
            let numbers = self.so_many(&at, range.len())?;
            all.push((range, numbers));
        }
        Ok(all)
    }

    /// What a section belongs to, from 0.
    pub fn range(&self, at: &str) -> Result<Range<usize>, Error> {
        self.span(self.attribute(at, "minId")?, self.attribute(at, "maxId")?)
            .ok_or_else(|| self.error(format!("{at}: minId and maxId are no range")))
    }

    /// A range from 0 that is given from 1, its end included.
    pub fn span(&self, first: u64, last: u64) -> Option<Range<usize>> {
        let (from, to) = (usize::try_from(first).ok()?.checked_sub(1)?, usize::try_from(last).ok()?);
        (from <= to && to < u32::MAX as usize).then_some(from..to)
    }

    fn stored(&self, at: &str, kind: &Datatype) -> Result<(Stored, bool), Error> {
        let (stored, order) = match kind {
            Datatype::FloatingPoint { size: 8, byte_order } => (Stored::F64, byte_order),
            Datatype::FloatingPoint { size: 4, byte_order } => (Stored::F32, byte_order),
            Datatype::FixedPoint { size, signed, byte_order } => {
                let stored = match (size, signed) {
                    (8, true) => Stored::I64,
                    (8, false) => Stored::U64,
                    (4, true) => Stored::I32,
                    (4, false) => Stored::U32,
                    (2, true) => Stored::I16,
                    (2, false) => Stored::U16,
                    (1, true) => Stored::I8,
                    (1, false) => Stored::U8,
                    _ => return Err(self.error(format!("{at}: whole numbers of {size} bytes are not read"))),
                };
                (stored, byte_order)
            }
            _ => return Err(self.error(format!("{at} holds no numbers"))),
        };
        Ok((stored, matches!(order, ByteOrder::BigEndian)))
    }
}
