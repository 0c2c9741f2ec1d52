//! Rows that would take too much memory, put aside on disk until the turn of their particles comes.
//!
//! Events of particles that are tracked side by side interleave, and one particle may have any number of them. Rows are put
//! aside sorted by particle, as much at a time as memory is allowed; what is where is kept, and in the end each particle's
//! rows are read together. The file has no name: it is gone when the run is.

use crate::record::columns::Columns;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// Rows on disk.
#[derive(Debug)]
pub(crate) struct Spill {
    file: File,
    rows: u64,
    pieces: Vec<Piece>,
    empty: Columns,
}

/// Rows of one particle that lie together.
#[derive(Clone, Copy, Debug)]
struct Piece {
    particle: u64,
    start: u64,
    rows: u64,
}

impl Spill {
    /// Nothing yet, in a file in that folder.
    pub fn new(folder: &Path, empty: Columns) -> io::Result<Self> {
        Ok(Self { file: tempfile::tempfile_in(folder)?, rows: 0, pieces: Vec::new(), empty })
    }

    /// Puts rows aside, later ones of a particle after earlier ones.
    pub fn add(&mut self, columns: Columns) -> io::Result<()> {
        let columns = columns.by_particle();
        let mut bytes = Vec::new();
        columns.to_bytes(&mut bytes);
        self.file.write_all(&bytes)?;
        for run in columns.particles().chunk_by(|a, b| a == b) {
            let rows = run.len() as u64;
            self.pieces.push(Piece { particle: run[0], start: self.rows, rows });
            self.rows += rows;
        }
        Ok(())
    }

    /// Hands out all rows by particle, at most so many at a time.
    pub fn read<E: From<io::Error>>(
        mut self,
        most: usize,
        mut each: impl FnMut(Columns) -> Result<(), E>,
    ) -> Result<(), E> {
        self.pieces.sort_by_key(|p| p.particle);
        let width = self.empty.row_bytes();
        let (mut columns, mut bytes) = (self.empty.empty_like(), Vec::new());
        for Piece { mut start, mut rows, .. } in self.pieces {
            while rows > 0 {
                let now = rows.min((most - columns.rows()) as u64);
                bytes.resize(now as usize * width, 0);
                self.file.seek(SeekFrom::Start(start * width as u64))?;
                self.file.read_exact(&mut bytes)?;
                columns.extend_from_bytes(&bytes);
                (start, rows) = (start + now, rows - now);
                if columns.rows() == most {
                    each(std::mem::replace(&mut columns, self.empty.empty_like()))?;
                }
            }
        }
        if columns.rows() > 0 { each(columns) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::columns::Kind;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_come_back_as_one_stable_sort_would_have_them(
            events in prop::collection::vec((0u64..20, 0u32..1000), 0..300),
            at_a_time in 1usize..50,
            most in 1usize..70,
        ) {
            let folder = tempfile::tempdir().unwrap();
            let empty = Columns::new([Kind::Count, Kind::Word]);
            let mut all = empty.clone();
            let mut spill = Spill::new(folder.path(), empty.clone()).unwrap();
            for some in events.chunks(at_a_time) {
                let mut columns = empty.clone();
                for (particle, value) in some {
                    all.row().count(*particle).word(*value).end();
                    columns.row().count(*particle).word(*value).end();
                }
                spill.add(columns).unwrap();
            }
            let (mut wanted, mut got) = (Vec::new(), Vec::new());
            all.by_particle().to_bytes(&mut wanted);
            spill.read::<io::Error>(most, |columns| {
                assert!(columns.rows() <= most);
                columns.to_bytes(&mut got);
                Ok(())
            }).unwrap();
            prop_assert_eq!(got, wanted);
        }
    }
}
