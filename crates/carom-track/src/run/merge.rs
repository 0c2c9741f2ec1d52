//! Shards put together again.

use super::RunError;
use super::files::{IMPACTS, State, TRAJECTORIES, write_results};
use crate::block::{IMPACTS_HEADER, TRAJECTORIES_HEADER};
use crate::summary::Summary;
use std::fs::File;
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Merges the folders of all shards of a run into one: the same files, to the bit, that the whole run would have written.
///
/// # Errors
/// A folder that cannot be read, is not finished, belongs to another run or twice to this one; a shard that is missing.
pub fn merge(shards: &[PathBuf], out: &Path) -> Result<Summary, RunError> {
    let mut parts = Vec::new();
    for folder in shards {
        let state =
            State::read(folder)?.ok_or_else(|| foreign(folder, "no checkpoint.json: not the output of a shard"))?;
        if state.next < state.blocks.end {
            return Err(foreign(folder, "this shard is not finished: go on with it with --resume"));
        }
        parts.push((state, folder));
    }
    parts.sort_by_key(|(s, _)| s.shard.index);
    let Some((first, _)) = parts.first().cloned() else {
        return Err(foreign(out, "nothing to merge: name the folders of all shards"));
    };
    let of = first.shard.of;
    for (i, (state, folder)) in parts.iter().enumerate() {
        if state.fingerprint != first.fingerprint || state.shard.of != of {
            return Err(foreign(folder, "belongs to another run than the first"));
        }
        let wanted = i as u64 + 1;
        if state.shard.index != wanted {
            let twice = state.shard.index < wanted;
            let message = if twice {
                format!("shard {}/{of} twice", state.shard.index)
            } else {
                format!("shard {wanted}/{of} is missing")
            };
            return Err(foreign(folder, &message));
        }
    }
    if parts.len() as u64 != of {
        return Err(foreign(out, &format!("shard {}/{of} is missing", parts.len() + 1)));
    }
    std::fs::create_dir_all(out).map_err(RunError::io(out))?;
    join(&parts, out, IMPACTS, IMPACTS_HEADER, |s| s.impacts)?;
    join(&parts, out, TRAJECTORIES, TRAJECTORIES_HEADER, |s| s.trajectories)?;
    let mut summary = first.summary.clone();
    parts.iter().skip(1).for_each(|(s, _)| summary.merge(&s.summary));
    if first.vtk {
        super::vtk::write(out)?;
    }
    write_results(out, &summary, &first.bins)?;
    Ok(summary)
}

fn foreign(path: &Path, message: &str) -> RunError {
    RunError::Foreign { path: path.to_owned(), message: message.to_owned() }
}

/// One table after the other, with one header.
fn join(
    parts: &[(State, &PathBuf)],
    out: &Path,
    name: &str,
    header: &str,
    length: impl Fn(&State) -> u64,
) -> Result<(), RunError> {
    if parts.iter().all(|(s, _)| length(s) == 0) {
        return Ok(());
    }
    let path = out.join(name);
    let mut joined = File::create(&path).map_err(RunError::io(&path))?;
    joined.write_all(header.as_bytes()).map_err(RunError::io(&path))?;
    for (_, folder) in parts {
        let path = folder.join(name);
        let mut part = File::open(&path).map_err(RunError::io(&path))?;
        part.seek(SeekFrom::Start(header.len() as u64)).map_err(RunError::io(&path))?;
        std::io::copy(&mut part, &mut joined).map_err(RunError::io(&path))?;
    }
    Ok(())
}
