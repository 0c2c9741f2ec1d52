//! How far a run is: `checkpoint.json`.

use super::disk::{Disk, replace};
use super::{Remedy, RunError, Shard};
use crate::about::About;
use crate::block::empty;
use crate::case::{Case, Fingerprint};
use crate::deposition::Bins;
use crate::summary::Summary;
use crate::tables::{FATES, IMPACTS, TRAJECTORIES, TableFormat};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::Path;

pub(super) const CHECKPOINT: &str = "checkpoint.json";

/// How far a run is.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct State {
    /// Of the form of this file.
    pub version: u32,
    /// The program's version: others may compute other bits.
    pub program: String,
    /// Of the case: see [`Case::fingerprint`].
    pub fingerprint: u64,
    /// The part of the run that it is, where it is no whole run.
    pub shard: Option<Shard>,
    /// Particles of this shard.
    pub particles: Range<u64>,
    /// The first particle whose rows are not yet on disk.
    pub next: u64,
    /// All files are there.
    pub finished: bool,
    /// How each table is wanted.
    pub formats: [Option<TableFormat>; 3],
    /// Bytes up to which each file is whole.
    pub files: BTreeMap<String, u64>,
    /// Rows of Parquet tables that wait for a row group to fill, by table: the file they are in.
    pub rests: BTreeMap<String, String>,
    pub bins: Bins,
    pub vtk: bool,
    pub about: About,
    pub summary: Summary,
}

/// The form of checkpoints.
const VERSION: u32 = 5;
const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// What stands between a checkpoint and its checksum, at the end of the file.
const CHECKSUM: &str = ",\"checksum\":\"";

impl State {
    pub fn new(case: &Case, shard: Option<Shard>, particles: Range<u64>) -> Self {
        let mut formats = [None; 3];
        formats[IMPACTS] = case.impacts;
        formats[FATES] = case.fates;
        formats[TRAJECTORIES] = (case.trajectories > 0).then_some(TableFormat::Csv);
        Self {
            version: VERSION,
            program: PROGRAM.to_owned(),
            fingerprint: case.fingerprint,
            shard,
            next: particles.start,
            particles,
            finished: false,
            formats,
            files: BTreeMap::new(),
            rests: BTreeMap::new(),
            bins: case.bins.clone(),
            vtk: case.vtk,
            about: About::of(case),
            summary: empty(case),
        }
    }

    /// Reads a checkpoint and holds it against itself; `None` where there is none.
    pub fn read(folder: &Path) -> Result<Option<Self>, RunError> {
        /// What every form begins with.
        #[derive(serde::Deserialize)]
        struct Form {
            version: u32,
            #[serde(default)]
            program: String,
        }
        let path = folder.join(CHECKPOINT);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(e) if e.kind() == ErrorKind::InvalidData => return Err(damaged(&path, "it is no text")),
            Err(e) => return Err(RunError::io(&path)(e)),
        };
        if let Ok(form) = serde_json::from_str::<Form>(&text)
            && (form.version != VERSION || form.program != PROGRAM)
        {
            return Err(RunError::foreign_but(path, "written by another version of carom", Remedy::Force));
        }
        let body = sealed(&text).ok_or_else(|| damaged(&path, "its checksum is not that of what it says"))?;
        let state: Self = serde_json::from_str(&body)
            .map_err(|e| RunError::foreign(&path, format!("not a checkpoint of this program ({e})")))?;
        state.check().map_err(|why| damaged(&path, &why))?;
        Ok(Some(state))
    }

    /// The file's text.
    pub fn text(&self) -> Result<String, RunError> {
        let mut text = serde_json::to_string(self).map_err(RunError::Json)?;
        let sum = Fingerprint::of(&text).number();
        text.pop();
        Ok(format!("{text}{CHECKSUM}{sum:016x}\"}}"))
    }

    pub fn write(&self, disk: &dyn Disk, folder: &Path) -> Result<(), RunError> {
        replace(disk, folder, CHECKPOINT, self.text()?.as_bytes())
    }

    /// What must be so, whatever was computed.
    fn check(&self) -> Result<(), String> {
        let (Range { start, end }, next, summary) = (&self.particles, self.next, &self.summary);
        if !(*start <= next && next <= *end) {
            return Err(format!("particle {next} is not one of {start} to {end}"));
        }
        if summary.injected.count != next - start {
            return Err(format!("{} particles counted of {}", summary.injected.count, next - start));
        }
        let mut sum = crate::summary::Amount::default();
        summary.fates.iter().for_each(|fate| sum.merge(fate));
        if sum != summary.injected {
            return Err("the fates do not add up to what was injected".to_owned());
        }
        let sizes = summary.deposition.injected.iter().map(|a| a.count).sum::<u64>();
        if sizes != summary.injected.count || !summary.deposition.fits(&self.bins, summary.walls.len()) {
            return Err("the deposition is not of this run".to_owned());
        }
        if self.finished && next < *end {
            return Err("finished before its last particle".to_owned());
        }
        Ok(())
    }

    /// Whether this state is one of a run as another begins; what is wrong if not.
    pub fn is_of(&self, fresh: &Self, folder: &Path) -> Result<(), RunError> {
        let foreign = |message: &str, remedy| Err(RunError::foreign_but(folder.join(CHECKPOINT), message, remedy));
        if self.fingerprint != fresh.fingerprint {
            let message = "the case, its materials or a file it names was changed since";
            return foreign(message, Remedy::ForceOrPutBack);
        }
        if self.shard != fresh.shard || self.particles != fresh.particles {
            return foreign("belongs to another shard", Remedy::SameShard);
        }
        let names = |s: &Summary| s.walls.iter().map(|w| w.name.clone()).collect::<Vec<_>>();
        if names(&self.summary) != names(&fresh.summary) || self.formats != fresh.formats || self.bins != fresh.bins {
            return Err(damaged(&folder.join(CHECKPOINT), "its walls, tables or bins are not those of the case"));
        }
        Ok(())
    }

    /// Whether every file is as long as it should be.
    pub fn check_lengths(&self, folder: &Path) -> Result<(), RunError> {
        for (name, length) in &self.files {
            let path = folder.join(name);
            match std::fs::metadata(&path) {
                Ok(m) if m.is_file() && m.len() == *length => {}
                Ok(m) => {
                    let message = format!("{} bytes where the checkpoint says {length}", m.len());
                    return Err(RunError::foreign(path, message));
                }
                Err(e) => return Err(RunError::io(&path)(e)),
            }
        }
        Ok(())
    }

    /// The names of the walls, in order.
    pub fn walls(&self) -> Vec<String> {
        self.summary.walls.iter().map(|w| w.name.clone()).collect()
    }
}

fn damaged(path: &Path, why: &str) -> RunError {
    RunError::foreign_but(path, format!("damaged ({why})"), Remedy::Force)
}

/// The text that a checksum at its end is of, if it is.
fn sealed(text: &str) -> Option<String> {
    let (body, sum) = text.rsplit_once(CHECKSUM)?;
    let body = format!("{body}}}");
    (sum == format!("{:016x}\"}}", Fingerprint::of(&body).number())).then_some(body)
}
