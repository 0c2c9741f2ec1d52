//! The files of a run, and the checkpoint that makes it resumable.
//!
//! After each block its rows are appended and then `checkpoint.json` is replaced in one stroke: it holds the lengths up to
//! which the files are whole, so that rows of a block that was cut short are dropped on resuming. Rows are CSV while the run
//! is under way; a table that is wanted as Parquet is converted at the end.

use super::{RunError, Shard};
use crate::about::About;
use crate::block::{Block, SIZE, Wanted, empty};
use crate::case::Case;
use crate::deposition::Bins;
use crate::summary::Summary;
use crate::tables::{LAYOUTS, Layout, TableFormat};
use carom_table::{TableReader, TableWriter};
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

pub(super) const CHECKPOINT: &str = "checkpoint.json";
pub(super) const SUMMARY: &str = "summary.json";
pub(super) const DEPOSITION: &str = "deposition.csv";

/// How far a run is.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct State {
    /// Of the form of this file.
    pub version: u32,
    /// Of the case: see [`Case::fingerprint`].
    pub fingerprint: u64,
    /// The part of the run that it is, where it is no whole run.
    pub shard: Option<Shard>,
    pub block_size: u64,
    /// Blocks of this shard.
    pub blocks: Range<u64>,
    /// The first block not yet written.
    pub next: u64,
    /// How each table is wanted in the end.
    pub formats: [Option<TableFormat>; LAYOUTS.len()],
    /// Whole bytes of each table, as CSV.
    pub lengths: [u64; LAYOUTS.len()],
    pub bins: Bins,
    pub vtk: bool,
    pub about: About,
    pub summary: Summary,
}

/// The form of checkpoints.
const VERSION: u32 = 3;

impl State {
    pub fn new(case: &Case, shard: Option<Shard>, blocks: Range<u64>) -> Self {
        let trajectories = (case.trajectories > 0).then_some(TableFormat::Csv);
        Self {
            version: VERSION,
            fingerprint: case.fingerprint,
            shard,
            block_size: SIZE,
            next: blocks.start,
            blocks,
            formats: [case.impacts, case.fates, trajectories],
            lengths: [0; LAYOUTS.len()],
            bins: case.bins.clone(),
            vtk: case.vtk,
            about: About::of(case),
            summary: empty(case),
        }
    }

    /// Reads a checkpoint; `None` where there is none.
    pub fn read(folder: &Path) -> Result<Option<Self>, RunError> {
        /// What every form begins with.
        #[derive(serde::Deserialize)]
        struct Form {
            version: u32,
        }
        let path = folder.join(CHECKPOINT);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(RunError::io(&path)(e)),
        };
        if serde_json::from_str::<Form>(&text).is_ok_and(|form| form.version != VERSION) {
            return Err(RunError::foreign(path, "written by another version: run again without --resume"));
        }
        serde_json::from_str(&text)
            .map(Some)
            .map_err(|e| RunError::foreign(path, format!("not a checkpoint of this program ({e})")))
    }

    pub fn write(&self, folder: &Path) -> Result<(), RunError> {
        replace(folder, CHECKPOINT, &serde_json::to_string(self).unwrap_or_default())
    }

    /// Which tables are written.
    pub fn wanted(&self) -> Wanted {
        self.formats.map(|format| format.is_some())
    }

    /// No block is left.
    pub fn complete(&self) -> bool {
        self.next >= self.blocks.end
    }

    /// Makes what a complete run has besides its rows: VTK and Parquet files, `deposition.csv` and, last of all,
    /// `summary.json`: where it is, the run is complete. A shard's tables stay as they are until it is merged.
    pub fn finish(&self, folder: &Path) -> Result<(), RunError> {
        if self.vtk {
            super::vtk::write(folder)?;
        }
        if self.shard.is_none() {
            for (layout, format) in LAYOUTS.iter().zip(self.formats) {
                if format == Some(TableFormat::Parquet) {
                    convert(folder, layout)?;
                }
            }
        }
        let walls: Vec<String> = self.summary.walls.iter().map(|w| w.name.clone()).collect();
        replace(folder, DEPOSITION, &self.summary.deposition.to_csv(&self.bins, &walls))?;
        replace(folder, SUMMARY, &self.summary.to_json())
    }
}

/// Turns a table into Parquet, a batch of rows at a time. The CSV goes when the Parquet file is whole; where it is gone
/// already, all is done.
fn convert(folder: &Path, layout: &Layout) -> Result<(), RunError> {
    let csv = folder.join(layout.file(TableFormat::Csv));
    if !csv.exists() {
        return Ok(());
    }
    let mut reader = TableReader::open(&csv, layout.schema())?;
    let mut writer = TableWriter::create(folder.join(layout.file(TableFormat::Parquet)), layout.schema())?;
    while let Some(batch) = reader.next_batch()? {
        writer.write(batch)?;
    }
    writer.finish()?;
    remove(&csv)
}

/// The open files of a run.
pub(super) struct Output {
    folder: PathBuf,
    tables: [Option<File>; LAYOUTS.len()],
    pub state: State,
}

impl Output {
    /// Starts a run in a folder, or goes on with the one there.
    pub fn open(folder: &Path, fresh: State, resume: bool) -> Result<Self, RunError> {
        std::fs::create_dir_all(folder).map_err(RunError::io(folder))?;
        let found = if resume { State::read(folder)? } else { None };
        let found = found.map(|old| same_run(old, &fresh, folder)).transpose()?;
        remove(&folder.join(SUMMARY))?;
        let resumed = found.is_some();
        let mut state = found.unwrap_or(fresh);
        if !resumed {
            clear(folder, &state)?;
        }
        let complete = resumed && state.complete();
        let mut tables = [const { None }; LAYOUTS.len()];
        for (i, layout) in LAYOUTS.iter().enumerate() {
            // a complete run has no rows to come, and its CSV may have been turned into Parquet
            if state.formats[i].is_some() && !complete {
                let path = folder.join(layout.file(TableFormat::Csv));
                let whole = resumed.then_some(state.lengths[i]);
                let (file, length) = table(&path, &layout.header(), whole)?;
                tables[i] = Some(file);
                state.lengths[i] = length;
            }
        }
        state.write(folder)?;
        Ok(Self { folder: folder.to_owned(), tables, state })
    }

    /// Writes a block's rows, then that they are there.
    pub fn append(&mut self, number: u64, block: &Block) -> Result<(), RunError> {
        for (i, rows) in block.rows.iter().enumerate() {
            if let Some(file) = &mut self.tables[i] {
                let path = self.folder.join(LAYOUTS[i].file(TableFormat::Csv));
                file.write_all(rows).map_err(RunError::io(&path))?;
                self.state.lengths[i] += rows.len() as u64;
            }
        }
        self.state.summary.merge(&block.summary);
        self.state.next = number + 1;
        self.state.write(&self.folder)
    }

    /// The run is complete.
    pub fn finish(self) -> Result<(), RunError> {
        self.state.finish(&self.folder)
    }
}

/// Takes away the tables of an earlier run that this one will not overwrite.
pub(super) fn clear(folder: &Path, state: &State) -> Result<(), RunError> {
    for (layout, format) in LAYOUTS.iter().zip(state.formats) {
        remove(&folder.join(layout.file(TableFormat::Parquet)))?;
        if format.is_none() {
            remove(&folder.join(layout.file(TableFormat::Csv)))?;
        }
    }
    Ok(())
}

/// Removes a file that may not be there.
pub(super) fn remove(path: &Path) -> Result<(), RunError> {
    match std::fs::remove_file(path) {
        Err(e) if e.kind() != ErrorKind::NotFound => Err(RunError::io(path)(e)),
        _ => Ok(()),
    }
}

/// Puts a whole file in place in one stroke.
fn replace(folder: &Path, name: &str, text: &str) -> Result<(), RunError> {
    let path = folder.join(name);
    let fresh = folder.join(format!("{name}.new"));
    std::fs::write(&fresh, text).map_err(RunError::io(&fresh))?;
    std::fs::rename(&fresh, &path).map_err(RunError::io(&path))
}

fn same_run(old: State, fresh: &State, folder: &Path) -> Result<State, RunError> {
    let foreign = |message: &str| Err(RunError::foreign(folder.join(CHECKPOINT), message));
    if old.block_size != fresh.block_size {
        return foreign("written by another version: run again without --resume");
    }
    if old.fingerprint != fresh.fingerprint {
        return foreign(
            "the case, its materials or a file it names was changed since: run again without --resume, or put back what was there",
        );
    }
    if old.shard != fresh.shard || old.blocks != fresh.blocks {
        return foreign("belongs to another shard: give the same --shard");
    }
    Ok(old)
}

/// Opens a table for appending after its whole rows, and tells their length; a new one gets its header.
fn table(path: &Path, header: &str, whole: Option<u64>) -> Result<(File, u64), RunError> {
    let error = RunError::io(path);
    let mut file = OpenOptions::new().create(true).write(true).truncate(whole.is_none()).open(path).map_err(&error)?;
    let Some(length) = whole else {
        file.write_all(header.as_bytes()).map_err(&error)?;
        return Ok((file, header.len() as u64));
    };
    if file.metadata().map_err(&error)?.len() < length {
        return Err(RunError::foreign(path, "shorter than the checkpoint says: run again without --resume"));
    }
    file.set_len(length).map_err(&error)?;
    file.seek(SeekFrom::End(0)).map_err(&error)?;
    Ok((file, length))
}
