//! The files of a run, and the checkpoint that makes it resumable.
//!
//! After each block its rows are appended and then `checkpoint.json` is replaced in one stroke: it holds the lengths up to
//! which the files are whole, so that rows of a block that was cut short are dropped on resuming.

use super::{RunError, Shard};
use crate::block::{Block, IMPACTS_HEADER, SIZE, TRAJECTORIES_HEADER, empty};
use crate::case::Case;
use crate::deposition::Bins;
use crate::summary::Summary;
use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

pub(super) const CHECKPOINT: &str = "checkpoint.json";
pub(super) const SUMMARY: &str = "summary.json";
pub(super) const IMPACTS: &str = "impacts.csv";
pub(super) const TRAJECTORIES: &str = "trajectories.csv";
pub(super) const DEPOSITION: &str = "deposition.csv";

/// How far a run is.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct State {
    /// Of the form of this file.
    pub version: u32,
    /// Of the case's text.
    pub fingerprint: u64,
    pub shard: Shard,
    pub block_size: u64,
    /// Blocks of this shard.
    pub blocks: Range<u64>,
    /// The first block not yet written.
    pub next: u64,
    /// Whole bytes of each table.
    pub impacts: u64,
    pub trajectories: u64,
    pub bins: Bins,
    pub vtk: bool,
    pub summary: Summary,
}

impl State {
    pub fn new(case: &Case, shard: Shard, blocks: Range<u64>) -> Self {
        Self {
            version: 1,
            fingerprint: case.fingerprint,
            shard,
            block_size: SIZE,
            next: blocks.start,
            blocks,
            impacts: 0,
            trajectories: 0,
            bins: case.bins.clone(),
            vtk: case.vtk,
            summary: empty(case),
        }
    }

    /// Reads a checkpoint; `None` where there is none.
    pub fn read(folder: &Path) -> Result<Option<Self>, RunError> {
        let path = folder.join(CHECKPOINT);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(RunError::io(&path)(e)),
        };
        serde_json::from_str(&text)
            .map(Some)
            .map_err(|e| RunError::Foreign { path, message: format!("not a checkpoint of this program ({e})") })
    }

    fn write(&self, folder: &Path) -> Result<(), RunError> {
        replace(folder, CHECKPOINT, &serde_json::to_string(self).unwrap_or_default())
    }
}

/// The open files of a run.
pub(super) struct Output {
    folder: PathBuf,
    impacts: Option<File>,
    trajectories: Option<File>,
    pub state: State,
}

impl Output {
    /// Starts a run in a folder, or goes on with the one there.
    pub fn open(folder: &Path, case: &Case, fresh: State, resume: bool) -> Result<Self, RunError> {
        std::fs::create_dir_all(folder).map_err(RunError::io(folder))?;
        let found = if resume { State::read(folder)? } else { None };
        let state = match found {
            None => None,
            Some(old) => Some(same_run(old, &fresh, folder)?),
        };
        let summary = folder.join(SUMMARY);
        match std::fs::remove_file(&summary) {
            Err(e) if e.kind() != std::io::ErrorKind::NotFound => return Err(RunError::io(&summary)(e)),
            _ => {}
        }
        let lengths = state.as_ref().map(|s| (s.impacts, s.trajectories));
        let mut state = state.unwrap_or(fresh);
        let impacts = table(folder, IMPACTS, case.impacts, IMPACTS_HEADER, lengths.map(|l| l.0), &mut state.impacts)?;
        let wanted = case.trajectories > 0;
        let trajectories =
            table(folder, TRAJECTORIES, wanted, TRAJECTORIES_HEADER, lengths.map(|l| l.1), &mut state.trajectories)?;
        state.write(folder)?;
        Ok(Self { folder: folder.to_owned(), impacts, trajectories, state })
    }

    /// Writes a block's rows, then that they are there.
    pub fn append(&mut self, number: u64, block: &Block) -> Result<(), RunError> {
        let parts = [
            (&mut self.impacts, IMPACTS, &block.impacts, &mut self.state.impacts),
            (&mut self.trajectories, TRAJECTORIES, &block.trajectories, &mut self.state.trajectories),
        ];
        for (file, name, rows, length) in parts {
            if let Some(file) = file {
                file.write_all(rows).map_err(RunError::io(&self.folder.join(name)))?;
                *length += rows.len() as u64;
            }
        }
        self.state.summary.merge(&block.summary);
        self.state.next = number + 1;
        self.state.write(&self.folder)
    }

    /// The run is complete.
    pub fn finish(self, case: &Case) -> Result<(), RunError> {
        if case.vtk {
            super::vtk::write(&self.folder)?;
        }
        write_results(&self.folder, &self.state.summary, &self.state.bins)
    }
}

/// `deposition.csv`, and last of all `summary.json`: where it is, the run is complete.
pub(super) fn write_results(folder: &Path, summary: &Summary, bins: &Bins) -> Result<(), RunError> {
    let walls: Vec<String> = summary.walls.iter().map(|w| w.name.clone()).collect();
    replace(folder, DEPOSITION, &summary.deposition.to_csv(bins, &walls))?;
    replace(folder, SUMMARY, &summary.to_json())
}

/// Puts a whole file in place in one stroke.
fn replace(folder: &Path, name: &str, text: &str) -> Result<(), RunError> {
    let path = folder.join(name);
    let fresh = folder.join(format!("{name}.new"));
    std::fs::write(&fresh, text).map_err(RunError::io(&fresh))?;
    std::fs::rename(&fresh, &path).map_err(RunError::io(&path))
}

fn same_run(old: State, fresh: &State, folder: &Path) -> Result<State, RunError> {
    let path = folder.join(CHECKPOINT);
    let foreign = |message: &str| Err(RunError::Foreign { path: path.clone(), message: message.to_owned() });
    if old.version != fresh.version || old.block_size != fresh.block_size {
        return foreign("written by another version: run again without --resume");
    }
    if old.fingerprint != fresh.fingerprint {
        return foreign("the case file was changed since: run again without --resume");
    }
    if old.shard != fresh.shard || old.blocks != fresh.blocks {
        return foreign("belongs to another shard: give the same --shard");
    }
    Ok(old)
}

/// Opens a table for appending after its whole rows; a new one gets its header.
fn table(
    folder: &Path,
    name: &str,
    wanted: bool,
    header: &str,
    length: Option<u64>,
    whole: &mut u64,
) -> Result<Option<File>, RunError> {
    let path = folder.join(name);
    let error = RunError::io(&path);
    if !wanted {
        match std::fs::remove_file(&path) {
            Err(e) if e.kind() != std::io::ErrorKind::NotFound => return Err(error(e)),
            _ => return Ok(None),
        }
    }
    let mut file =
        OpenOptions::new().create(true).write(true).truncate(length.is_none()).open(&path).map_err(&error)?;
    match length {
        None => {
            file.write_all(header.as_bytes()).map_err(&error)?;
            *whole = header.len() as u64;
        }
        Some(length) => {
            if file.metadata().map_err(&error)?.len() < length {
                let message = "shorter than the checkpoint says: run again without --resume".to_owned();
                return Err(RunError::Foreign { path: path.clone(), message });
            }
            file.set_len(length).map_err(&error)?;
            file.seek(SeekFrom::End(0)).map_err(&error)?;
        }
    }
    Ok(Some(file))
}
