//! Shards put together again: everything is looked at first, the whole is made beside its place, and then moved there.

use super::checkpoint::State;
use super::disk::{Disk, Lock, Machine};
use super::output::{Found, Output, SUMMARY, cells_file, clear, forms, ours, refuse_occupied};
use super::{Remedy, RunError, Shard, vtp};
use crate::about::About;
use crate::summary::Summary;
use crate::tables::{LAYOUTS, TableFormat};
use carom_table::TableReader;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A shard's checkpoint, which it is, and its folder.
type Part<'a> = (State, Shard, &'a Path);

/// Merges the folders of all shards of a run into one: the same files, to the bit, that the whole run would have written. A run
/// in `out` is replaced only where `force` says so.
///
/// # Errors
/// A folder that cannot be read, is not finished, is damaged, belongs to another run or twice to this one; a shard that is
/// missing; shards or another run to be overwritten by the result. Nothing is written then.
pub fn merge(shards: &[PathBuf], out: &Path, force: bool) -> Result<(Summary, About), RunError> {
    let parts = parts(shards)?;
    let ([(first, _, _), ..], Some((last, _, _))) = (&parts[..], parts.last()) else {
        return Err(RunError::foreign(out, "nothing to merge: name the folders of all shards"));
    };
    if let Ok(place) = out.canonicalize() {
        if let Some((_, _, folder)) = parts.iter().find(|(_, _, f)| f.canonicalize().is_ok_and(|f| f == place)) {
            let message = "a shard's folder, to be merged into itself: name another for the whole";
            return Err(RunError::foreign(folder, message));
        }
        if !force {
            refuse_occupied(out)?;
        }
    }
    let mut whole = State { shard: None, particles: first.particles.start..last.particles.end, ..first.clone() };
    (whole.next, whole.finished) = (whole.particles.start, false);
    whole.files.clear();
    let beside = beside(out)?;
    let folder = beside.path().join("whole");
    let quiet = |_: &str| {};
    let mut output =
        Output::open(&folder, whole, Found::Keep, Duration::MAX, &quiet, &Machine)?.over(super::threads(0));
    output.state.summary = first.summary.clone();
    parts.iter().skip(1).for_each(|(s, _, _)| output.state.summary.merge(&s.summary));
    output.state.next = output.state.particles.end;
    join(&parts, &mut output)?;
    let (summary, about) = (output.state.summary.clone(), output.state.about.clone());
    output.finish()?;
    put_in_place(&folder, out, &Machine)?;
    Ok((summary, about))
}

/// A folder beside another, gone when it is dropped.
fn beside(out: &Path) -> Result<tempfile::TempDir, RunError> {
    let parent = match out.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(parent).map_err(RunError::io(parent))?;
    tempfile::Builder::new().prefix(".carom-merge-").tempdir_in(parent).map_err(RunError::io(parent))
}

/// Moves the files of a finished folder to their place, the one that says it is complete last.
fn put_in_place(from: &Path, out: &Path, disk: &dyn Disk) -> Result<(), RunError> {
    std::fs::create_dir_all(out).map_err(RunError::io(out))?;
    let _lock = Lock::take(out, &|_| {})?;
    clear(out, disk)?;
    let mut files = ours(from)?;
    files.sort_by_key(|path| path.ends_with(SUMMARY));
    for path in files {
        let place = out.join(path.file_name().unwrap_or_default());
        disk.rename(&path, &place).map_err(RunError::io(&place))?;
    }
    disk.sync_folder(out).map_err(RunError::io(out))
}

/// All shards of one run, finished and whole, in order.
fn parts(shards: &[PathBuf]) -> Result<Vec<Part<'_>>, RunError> {
    let mut parts: Vec<Part> = Vec::new();
    for folder in shards {
        let state = State::read(folder)?
            .ok_or_else(|| RunError::foreign(folder, "no checkpoint.json in it: not the output of a shard"))?;
        if Lock::is_taken(folder) {
            return Err(RunError::Busy { folder: folder.clone() });
        }
        if !state.finished {
            return Err(RunError::foreign_but(folder, "this shard is not finished", Remedy::Resume));
        }
        let Some(shard) = state.shard else {
            return Err(RunError::foreign(folder, "a whole run, not a shard: there is nothing to merge"));
        };
        if let Some((first, first_shard, other)) = parts.first() {
            let (of, other) = (first_shard.of, other.display());
            let walls = state.walls() == first.walls() && state.bins == first.bins && state.formats == first.formats;
            if state.fingerprint != first.fingerprint || !walls {
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
        state.check_lengths(folder)?;
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
    if let Some((_, last, _)) = parts.last()
        && last.index < last.of
    {
        return Err(missing(wanted, last.of));
    }
    for pair in parts.windows(2) {
        if let [(a, ..), (b, _, folder)] = pair
            && a.particles.end != b.particles.start
        {
            let message = "begins at another particle than the shard before ends";
            return Err(RunError::foreign(*folder, message));
        }
    }
    Ok(parts)
}

fn missing(index: u64, of: u64) -> RunError {
    RunError::Missing { index, of }
}

/// The tables of all parts, one after the other.
fn join(parts: &[Part], output: &mut Output) -> Result<(), RunError> {
    for (t, forms) in forms(&output.state).into_iter().enumerate() {
        let layout = &LAYOUTS[t];
        for (_, _, folder) in parts {
            if forms.text {
                let path = folder.join(layout.file(TableFormat::Csv));
                copy(&path, layout.header().len() as u64, |bytes| output.put_text(t, bytes))?;
            }
            if forms.cells {
                copy(&folder.join(cells_file(t)), 0, |bytes| output.put_cells(t, bytes))?;
            }
            if forms.columns {
                let mut rows = TableReader::open(folder.join(layout.file(TableFormat::Parquet)), layout.schema())?;
                while let Some(batch) = rows.next_batch()? {
                    output.put_table(t, batch)?;
                }
            }
        }
    }
    // every shard has the same ones
    if let Some((_, _, folder)) = parts.first() {
        let triangles = folder.join(vtp::TRIANGLES);
        if triangles.exists() {
            output.copy_triangles(&triangles)?;
        }
    }
    Ok(())
}

/// Hands on a file's bytes from a place on.
fn copy(path: &Path, from: u64, mut each: impl FnMut(&[u8]) -> Result<(), RunError>) -> Result<(), RunError> {
    let error = RunError::io(path);
    let mut file = File::open(path).map_err(&error)?;
    file.seek(SeekFrom::Start(from)).map_err(&error)?;
    let mut bytes = vec![0; 1 << 20];
    loop {
        match file.read(&mut bytes).map_err(&error)? {
            0 => return Ok(()),
            read => each(&bytes[..read])?,
        }
    }
}
