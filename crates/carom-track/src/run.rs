//! A run: blocks of particles over threads, rows in order to disk, a checkpoint after each block.
//!
//! The results are the same bits for any number of threads, any division into shards that are merged again, and any number
//! of interruptions: blocks are tracked independently, written in the order of their numbers, and masses are summed
//! without rounding.

mod files;
mod merge;
mod pool;
mod vtk;

pub use merge::merge;

use crate::block;
use crate::case::Case;
use crate::summary::Summary;
use files::{Output, State};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// How to run a case.
#[derive(Clone, Debug, Default)]
pub struct RunOptions {
    /// Threads; 0 for as many as the machine has.
    pub threads: usize,
    /// Where to put `summary.json`, the tables of impacts, fates, deposition and trajectories, and VTK files; nothing is
    /// written without.
    pub out: Option<PathBuf>,
    /// Go on where an interrupted run in `out` stopped.
    pub resume: bool,
    /// Only a part of the run.
    pub shard: Option<Shard>,
}

/// The part `index` (from 1) of `of` parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Shard {
    /// From 1 to `of`.
    pub index: u64,
    /// Number of parts.
    pub of: u64,
}

impl Shard {
    /// The blocks of this part: as even as whole blocks allow, each part following on the last.
    fn blocks(self, all: u64) -> Range<u64> {
        let edge = |i: u64| (u128::from(all) * u128::from(i) / u128::from(self.of)) as u64;
        edge(self.index - 1)..edge(self.index)
    }
}

impl std::str::FromStr for Shard {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let error = || format!("'{text}' is no shard: write i/n with 1 <= i <= n, such as 2/8");
        let (index, of) = text.split_once('/').ok_or_else(error)?;
        let shard =
            Self { index: index.trim().parse().map_err(|_| error())?, of: of.trim().parse().map_err(|_| error())? };
        if shard.index >= 1 && shard.index <= shard.of { Ok(shard) } else { Err(error()) }
    }
}

/// Hears how far a run is.
pub trait Progress: Sync {
    /// So many particles of so many have ended.
    fn particles(&self, done: u64, all: u64);
}

/// Listens to nothing.
#[derive(Clone, Copy, Debug)]
pub struct Silent;

impl Progress for Silent {
    fn particles(&self, _: u64, _: u64) {}
}

/// A run that could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// A file could not be read or written.
    #[error("{path}: {source}")]
    Io {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// What is in the folder does not belong to this run.
    #[error("{path}: {message}")]
    Foreign {
        /// Which file.
        path: PathBuf,
        /// What is wrong, and what would be right.
        message: String,
    },
    /// Resuming needs a folder.
    #[error("nothing to resume: an interrupted run is found by its output folder, give --out")]
    NoFolder,
    /// What a table holds could not be turned into Parquet.
    #[error(transparent)]
    Table(#[from] carom_table::TableError),
    /// A part that is not among those to be merged.
    #[error("shard {index}/{of} is missing: all {of} are needed, finished")]
    Missing {
        /// Index.
        index: u64,
        /// Parts.
        of: u64,
    },
    /// A part that is none.
    #[error("shard {index}/{of}: the first is 1/{of}, the last {of}/{of}")]
    Shard {
        /// Index.
        index: u64,
        /// Parts.
        of: u64,
    },
}

impl RunError {
    fn io(path: &Path) -> impl Fn(std::io::Error) -> Self + '_ {
        move |source| Self::Io { path: path.to_owned(), source }
    }

    fn foreign(path: impl Into<PathBuf>, message: impl Into<String>) -> Self {
        Self::Foreign { path: path.into(), message: message.into() }
    }
}

/// Runs a case to its end.
///
/// # Errors
/// What could not be read or written, and resuming a run that is not this one.
pub fn run(case: &Case, options: &RunOptions, progress: &dyn Progress) -> Result<Summary, RunError> {
    let shard = options.shard.unwrap_or(Shard { index: 1, of: 1 });
    if shard.index < 1 || shard.index > shard.of {
        return Err(RunError::Shard { index: shard.index, of: shard.of });
    }
    if options.resume && options.out.is_none() {
        return Err(RunError::NoFolder);
    }
    let count = case.count();
    let blocks = shard.blocks(count.div_ceil(block::SIZE));
    let fresh = State::new(case, options.shard, blocks.clone());
    let mut output = match &options.out {
        Some(folder) => Some(Output::open(folder, fresh.clone(), options.resume)?),
        None => None,
    };
    let wanted = output.as_ref().map_or_else(Default::default, |o| o.state.wanted());
    let mut summary = output.as_ref().map_or(fresh.summary, |o| o.state.summary.clone());
    let next = output.as_ref().map_or(blocks.start, |o| o.state.next);
    let numbers = |b: u64| b * block::SIZE..((b + 1) * block::SIZE).min(count);
    let first = blocks.start * block::SIZE;
    let all = (blocks.end * block::SIZE).min(count).saturating_sub(first);
    progress.particles((next * block::SIZE).min(count) - first.min(count), all);
    pool::in_order(
        threads(options.threads),
        next..blocks.end,
        |b| block::track(case, numbers(b), wanted),
        |b, done| {
            summary.merge(&done.summary);
            if let Some(output) = &mut output {
                output.append(b, &done)?;
            }
            progress.particles(numbers(b).end - first, all);
            Ok(())
        },
    )?;
    if let Some(output) = output {
        output.finish()?;
    }
    Ok(summary)
}

fn threads(asked: usize) -> usize {
    if asked > 0 { asked } else { std::thread::available_parallelism().map_or(1, std::num::NonZero::get) }
}

#[cfg(test)]
mod tests;
