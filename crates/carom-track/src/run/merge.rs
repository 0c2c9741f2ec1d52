//! Shards put together again.

use super::files::{SUMMARY, State, clear, remove};
use super::{RunError, Shard};
use crate::about::About;
use crate::summary::Summary;
use crate::tables::{LAYOUTS, Layout, TableFormat};
use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A shard's checkpoint, which it is, and its folder.
type Part<'a> = (State, Shard, &'a Path);

/// Merges the folders of all shards of a run into one: the same files, to the bit, that the whole run would have written.
///
/// # Errors
/// A folder that cannot be read, is not finished, belongs to another run or twice to this one; a shard that is missing;
/// shards to be overwritten by the result.
pub fn merge(shards: &[PathBuf], out: &Path) -> Result<(Summary, About), RunError> {
    let parts = parts(shards)?;
    let ([(first, _, _), ..], Some((last, _, _))) = (&parts[..], parts.last()) else {
        return Err(RunError::foreign(out, "nothing to merge: name the folders of all shards"));
    };
    std::fs::create_dir_all(out).map_err(RunError::io(out))?;
    let place = out.canonicalize().map_err(RunError::io(out))?;
    if let Some((_, _, folder)) = parts.iter().find(|(_, _, f)| f.canonicalize().is_ok_and(|f| f == place)) {
        return Err(RunError::foreign(
            folder,
            "a shard's folder, to be merged into itself: name another for the whole",
        ));
    }
    remove(&out.join(SUMMARY))?;
    let mut whole = State { shard: None, blocks: first.blocks.start..last.blocks.end, ..first.clone() };
    whole.next = whole.blocks.end;
    clear(out, &whole)?;
    parts.iter().skip(1).for_each(|(s, _, _)| whole.summary.merge(&s.summary));
    for (i, layout) in LAYOUTS.iter().enumerate() {
        if whole.formats[i].is_some() {
            whole.lengths[i] = join(&parts, i, layout, out)?;
        }
    }
    whole.write(out)?;
    whole.finish(out)?;
    Ok((whole.summary, whole.about))
}

/// All shards of one run, finished, in order.
fn parts(shards: &[PathBuf]) -> Result<Vec<Part<'_>>, RunError> {
    let mut parts: Vec<Part> = Vec::new();
    for folder in shards {
        let state = State::read(folder)?
            .ok_or_else(|| RunError::foreign(folder, "no checkpoint.json in it: not the output of a shard"))?;
        if !state.complete() {
            return Err(RunError::foreign(folder, "this shard is not finished: go on with it with --resume"));
        }
        let Some(shard) = state.shard else {
            return Err(RunError::foreign(folder, "a whole run, not a shard: there is nothing to merge"));
        };
        if let Some((first, first_shard, other)) = parts.first() {
            let (of, other) = (first_shard.of, other.display());
            if state.fingerprint != first.fingerprint || state.block_size != first.block_size {
                return Err(RunError::foreign(
                    folder,
                    format!("a shard of another case than {other}, or of other materials or files"),
                ));
            }
            if shard.of != of {
                let message = format!("one of {} shards, {other} is one of {of}: they are of two runs", shard.of);
                return Err(RunError::foreign(folder, message));
            }
        }
        parts.push((state, shard, folder));
    }
    parts.sort_by_key(|(_, shard, _)| shard.index);
    let mut wanted = 1;
    for (i, (_, Shard { index, of }, folder)) in parts.iter().enumerate() {
        let (index, of) = (*index, *of);
        if index < wanted {
            let other = i.checked_sub(1).and_then(|i| parts.get(i)).map_or(*folder, |(_, _, other)| other);
            let message = format!("shard {index}/{of} a second time: {} is it too", other.display());
            return Err(RunError::foreign(folder, message));
        }
        if index > wanted {
            return Err(missing(wanted, of));
        }
        wanted += 1;
    }
    match parts.last() {
        Some((_, last, _)) if last.index < last.of => Err(missing(wanted, last.of)),
        _ => Ok(parts),
    }
}

fn missing(index: u64, of: u64) -> RunError {
    RunError::Missing { index, of }
}

/// One table after the other, with one header; gives the length as CSV.
fn join(parts: &[Part], i: usize, layout: &Layout, out: &Path) -> Result<u64, RunError> {
    let (csv, header) = (layout.file(TableFormat::Csv), layout.header());
    let path = out.join(&csv);
    let error = RunError::io(&path);
    let mut joined = File::create(&path).map_err(&error)?;
    joined.write_all(header.as_bytes()).map_err(&error)?;
    let mut length = header.len() as u64;
    for (state, _, folder) in parts {
        let path = folder.join(&csv);
        let mut part = File::open(&path).map_err(RunError::io(&path))?;
        part.seek(SeekFrom::Start(header.len() as u64)).map_err(RunError::io(&path))?;
        let rows = state.lengths[i].saturating_sub(header.len() as u64);
        if std::io::copy(&mut part.take(rows), &mut joined).map_err(RunError::io(&path))? < rows {
            return Err(RunError::foreign(path, "shorter than its checkpoint says: run this shard again"));
        }
        length += rows;
    }
    Ok(length)
}
