//! A run: blocks of particles over threads, rows in order to disk, a checkpoint every few seconds.
//!
//! The results are the same bits for any number of threads, any division into shards that are merged again, and any number
//! of interruptions: blocks are tracked independently, written in the order of their numbers, and masses are summed
//! without rounding.

mod checkpoint;
mod disk;
mod groups;
mod merge;
mod output;
mod pool;
pub(crate) mod spill;
mod stream;
mod vtp;

pub use vtp::{DepositFace, deposit_faces};

pub use merge::merge;

use crate::block::{self, Recording};
use crate::case::Case;
use crate::summary::Summary;
use checkpoint::State;
use disk::{Disk, Machine};
use output::{Found, Output};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How to run a case.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// Threads; 0 for as many as the machine has.
    pub threads: usize,
    /// Where to put `summary.json`, the tables of impacts, fates, deposition and trajectories, and VTK files; nothing is
    /// written without. A run that is there already is left alone.
    pub out: Option<PathBuf>,
    /// Go on where an interrupted run in `out` stopped; from the beginning where nothing was written yet.
    pub resume: bool,
    /// Take away a run that is in `out`.
    pub force: bool,
    /// Only a part of the run.
    pub shard: Option<Shard>,
    /// How much time an interruption may cost: what is written is put on disk as often, or less often where that would take
    /// more than a twentieth of the time.
    pub checkpoint_every: Duration,
}

impl Default for RunOptions {
    fn default() -> Self {
        Self {
            threads: 0,
            out: None,
            resume: false,
            force: false,
            shard: None,
            checkpoint_every: Duration::from_secs(3),
        }
    }
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

    /// Something to know about the run.
    fn note(&self, _: &str) {}

    /// Whether to stop here; asked after [`Progress::particles`]. What is on disk can be resumed.
    fn stops(&self) -> bool {
        false
    }
}

/// Listens to nothing.
#[derive(Clone, Copy, Debug)]
pub struct Silent;

impl Progress for Silent {
    fn particles(&self, _: u64, _: u64) {}
}

/// What to do about a folder that holds something else: each front says it in its own words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Go on with it.
    Resume,
    /// Start anew in its place.
    Force,
    /// Start anew in its place, or put back the case and the files that it names.
    ForceOrPutBack,
    /// Give the same shard as before.
    SameShard,
}

impl Remedy {
    fn in_flags(self) -> &'static str {
        match self {
            Self::Resume => ": go on with it with --resume",
            Self::Force => ": start anew with --force",
            Self::ForceOrPutBack => ": start anew with --force, or put back what was there",
            Self::SameShard => ": give the same --shard",
        }
    }
}

/// A run that could not be made. Its text speaks to the command's users.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// A file could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// What is in the folder does not belong to this run.
    #[error("{}: {message}{}", path.display(), remedy.map_or("", Remedy::in_flags))]
    Foreign {
        /// Which file.
        path: PathBuf,
        /// What is wrong.
        message: String,
        /// What would be right, where an option of the run would be.
        remedy: Option<Remedy>,
    },
    /// A stream could not be read or written.
    #[error(transparent)]
    Stream(#[from] std::io::Error),
    /// The case's walls, behaviors and injections do not match.
    #[error(transparent)]
    Tracker(#[from] crate::tracker::TrackerError),
    /// Another run is at work in the folder.
    #[error("{}: another run is at work in it: wait for its end, or name another folder", folder.display())]
    Busy {
        /// Which.
        folder: PathBuf,
    },
    /// There are results in the folder.
    #[error("{}: holds {what}: go on with it with --resume, replace it with --force, or name another folder", folder.display())]
    Occupied {
        /// Which.
        folder: PathBuf,
        /// What is there.
        what: String,
    },
    /// A file was taken away, or another put in its place, while the run was writing it.
    #[error("{}: removed or replaced while the run was writing it", path.display())]
    Gone {
        /// Which.
        path: PathBuf,
    },
    /// [`Progress::stops`] said so.
    #[error("stopped before its end; it can be resumed")]
    Stopped,
    /// The program failed: a fault in it.
    #[error("a fault in carom, at particles {} to {}: {message}", .particles.start, .particles.end.saturating_sub(1))]
    Panic {
        /// What was being tracked.
        particles: Range<u64>,
        /// What it said.
        message: String,
    },
    /// JSON could not be written.
    #[error("JSON: {0}")]
    Json(serde_json::Error),
    /// CSV could not be written.
    #[error("CSV: {0}")]
    Csv(csv::Error),
    /// Resuming needs a folder.
    #[error("nothing to resume: an interrupted run is found by its output folder, give --out")]
    NoFolder,
    /// A table could not be read or written.
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
    pub(crate) fn io(path: &Path) -> impl Fn(std::io::Error) -> Self + '_ {
        move |source| Self::Io { path: path.to_owned(), source }
    }

    pub(crate) fn foreign(path: impl Into<PathBuf>, message: impl Into<String>) -> Self {
        Self::Foreign { path: path.into(), message: message.into(), remedy: None }
    }

    pub(crate) fn foreign_but(path: impl Into<PathBuf>, message: impl Into<String>, remedy: Remedy) -> Self {
        Self::Foreign { path: path.into(), message: message.into(), remedy: Some(remedy) }
    }
}

/// Bytes of rows that all blocks under way may hold together, about; beyond, rows are put aside on disk until their turn.
const HELD: usize = 256 << 20;

/// Runs a case to its end.
///
/// Memory stays below 1 GiB whatever the particles do, besides the case itself.
///
/// # Errors
/// What could not be read or written, a folder that holds a run or in which one is at work, and resuming a run that is not
/// this one.
pub fn run(case: &Case, options: &RunOptions, progress: &dyn Progress) -> Result<Summary, RunError> {
    run_on(case, options, progress, &Machine, HELD)
}

fn run_on(
    case: &Case,
    options: &RunOptions,
    progress: &dyn Progress,
    disk: &dyn Disk,
    held: usize,
) -> Result<Summary, RunError> {
    let shard = options.shard.unwrap_or(Shard { index: 1, of: 1 });
    if shard.index < 1 || shard.index > shard.of {
        return Err(RunError::Shard { index: shard.index, of: shard.of });
    }
    if options.resume && options.out.is_none() {
        return Err(RunError::NoFolder);
    }
    let count = case.count();
    let blocks = shard.blocks(count.div_ceil(block::SIZE));
    let particles = (blocks.start * block::SIZE).min(count)..blocks.end.saturating_mul(block::SIZE).min(count);
    let fresh = State::new(case, options.shard, particles.clone());
    let found = match (options.resume, options.force) {
        (true, _) => Found::Resume,
        (false, true) => Found::Replace,
        (false, false) => Found::Keep,
    };
    let mut summary = fresh.summary.clone();
    let threads = threads(options.threads);
    let open = |folder: &PathBuf| {
        let note = |text: &str| progress.note(text);
        Ok::<_, RunError>(Output::open(folder, fresh, found, options.checkpoint_every, &note, disk)?.over(threads))
    };
    let mut output = options.out.as_ref().map(open).transpose()?;
    if let Some(output) = &output {
        output.write_triangles(case.domain.walls())?;
    }
    let next = output.as_ref().map_or(particles.start, |o| o.state.next);
    let forms = output.as_ref().map_or_else(Default::default, |o| output::forms(&o.state));
    let most = (held / (pool::AHEAD * threads)).max(1 << 16);
    let recording = Recording::new(case, forms, options.out.clone().unwrap_or_default(), most);
    let all = particles.end - particles.start;
    progress.particles(next - particles.start, all);
    pool::in_order(
        threads,
        next..particles.end,
        |numbers| recording.track(numbers),
        |numbers, done| {
            match &mut output {
                Some(output) => output.append(numbers.end, done, &recording)?,
                None => summary.merge(&done.summary),
            }
            progress.particles(numbers.end - particles.start, all);
            if progress.stops() && numbers.end < particles.end { Err(RunError::Stopped) } else { Ok(()) }
        },
    )?;
    if let Some(output) = output {
        summary = output.state.summary.clone();
        output.finish()?;
    }
    Ok(summary)
}

pub(crate) fn threads(asked: usize) -> usize {
    if asked > 0 { asked } else { std::thread::available_parallelism().map_or(1, std::num::NonZero::get) }
}

#[cfg(test)]
mod tests;
