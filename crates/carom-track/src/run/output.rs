//! The files of a run: opened, appended to, and finished.
//!
//! Rows are appended as blocks come. Every few seconds all tables are put on disk and then `checkpoint.json` is replaced in one
//! stroke: it holds the lengths up to which the files are whole, so that rows after the last checkpoint are dropped on
//! resuming. `summary.json` is written last: where it is, the run is complete.

use super::checkpoint::{CHECKPOINT, State};
use super::disk::{Disk, Lock, UNFINISHED, remove, replace};
use super::groups::Groups;
use super::stream::Stream;
use super::{RunError, vtp};
use crate::block::{Block, Encoded, Forms, Recording, Rows};
use crate::domain::Wall;
use crate::geometry::Shape;
use crate::tables::{DEPOSIT, LAYOUTS, TRAJECTORIES, TableFormat};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

pub(super) const SUMMARY: &str = "summary.json";
pub(super) const DEPOSITION: &str = "deposition.csv";
/// What fronts make of a finished run.
const PICTURES: [&str; 2] = ["report.html", "trajectories.svg"];

/// Rows read at a time of those that were put aside.
const AT_A_TIME: usize = 1 << 14;

/// What to do with what is in the folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// Refuse to touch a run.
    Keep,
    /// Go on with it.
    Resume,
    /// Take it away.
    Replace,
}

/// The open files of a run.
pub(super) struct Output<'a> {
    folder: PathBuf,
    disk: &'a dyn Disk,
    _lock: Lock,
    tables: [Table; LAYOUTS.len()],
    pub state: State,
    every: Duration,
    last: Instant,
    /// How long the last checkpoint took.
    took: Duration,
}

/// The open files of a table.
#[derive(Default)]
struct Table {
    text: Option<Stream>,
    cells: Option<Stream>,
    groups: Option<Groups>,
}

/// In which forms a run's tables are wanted.
pub(super) fn forms(state: &State) -> [Forms; LAYOUTS.len()] {
    std::array::from_fn(|table| {
        let format = state.formats.get(table).copied().flatten();
        let shown = table == DEPOSIT || table == TRAJECTORIES && format.is_some();
        Forms {
            text: format == Some(TableFormat::Csv),
            columns: format == Some(TableFormat::Parquet),
            cells: state.vtk && shown,
        }
    })
}

/// The file of a table's cells, from which a VTK file is made.
pub(super) fn cells_file(table: usize) -> String {
    format!("{}.cells", LAYOUTS[table].stem)
}

/// Whether a file's name is one that a run gives.
fn is_ours(name: &str) -> bool {
    let stem_and_rest = LAYOUTS.iter().find_map(|l| name.strip_prefix(l.stem));
    let of_table = stem_and_rest.is_some_and(|rest| {
        matches!(rest, ".csv" | ".parquet" | ".cells" | ".vtp")
            || rest.strip_prefix(".rest-").is_some_and(|rest| rest.ends_with(".parquet"))
    });
    let name = name.strip_suffix(UNFINISHED).and_then(|n| n.strip_suffix('.')).unwrap_or(name);
    of_table
        || [CHECKPOINT, SUMMARY, DEPOSITION, vtp::TRIANGLES].contains(&name)
        || PICTURES.contains(&name)
        || [vtp::PATHS, vtp::DEPOSIT].contains(&name)
}

/// The files of a run in a folder.
pub(super) fn ours(folder: &Path) -> Result<Vec<PathBuf>, RunError> {
    let mut found = Vec::new();
    let entries = match std::fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(found),
        Err(e) => return Err(RunError::io(folder)(e)),
    };
    for entry in entries {
        let entry = entry.map_err(RunError::io(folder))?;
        if entry.file_name().to_str().is_some_and(is_ours) {
            found.push(entry.path());
        }
    }
    found.sort();
    Ok(found)
}

/// Refuses a folder with a run in it.
pub(super) fn refuse_occupied(folder: &Path) -> Result<(), RunError> {
    let files = ours(folder)?;
    let unfinished = |path: &PathBuf| path.extension().is_some_and(|e| e == UNFINISHED);
    let Some(first) = files.iter().find(|path| !unfinished(path)) else { return Ok(()) };
    let what = match State::read(folder) {
        Ok(Some(state)) if state.finished => "a finished run".to_owned(),
        Ok(Some(_)) => "an interrupted run".to_owned(),
        _ => format!("{}, which is not of a run that can be gone on with", first.display()),
    };
    Err(RunError::Occupied { folder: folder.to_owned(), what })
}

/// Takes away all files of a run, the ones that say it is complete first.
pub(super) fn clear(folder: &Path, disk: &dyn Disk) -> Result<(), RunError> {
    for name in [SUMMARY, CHECKPOINT] {
        remove(disk, &folder.join(name))?;
    }
    ours(folder)?.iter().try_for_each(|path| remove(disk, path))?;
    disk.sync_folder(folder).map_err(RunError::io(folder))
}

impl<'a> Output<'a> {
    /// Starts a run in a folder, or goes on with the one there.
    pub fn open(
        folder: &Path,
        fresh: State,
        found: Found,
        every: Duration,
        note: &dyn Fn(&str),
        disk: &'a dyn Disk,
    ) -> Result<Self, RunError> {
        std::fs::create_dir_all(folder).map_err(RunError::io(folder))?;
        let lock = Lock::take(folder, note)?;
        let old = if found == Found::Resume { State::read(folder)? } else { None };
        let state = match old {
            Some(old) => {
                old.is_of(&fresh, folder)?;
                if old.finished {
                    old.check_lengths(folder)?;
                }
                old
            }
            None => {
                match found {
                    Found::Replace => {}
                    Found::Keep => refuse_occupied(folder)?,
                    Found::Resume => {
                        refuse_occupied(folder)?;
                        note("nothing to go on with yet: starting from the beginning");
                    }
                }
                clear(folder, disk)?;
                fresh.write(disk, folder)?;
                fresh
            }
        };
        let mut output = Self {
            folder: folder.to_owned(),
            disk,
            _lock: lock,
            tables: Default::default(),
            state,
            every,
            last: Instant::now(),
            took: Duration::ZERO,
        };
        if !output.state.finished {
            remove(disk, &folder.join(SUMMARY))?;
            output.open_tables()?;
        }
        Ok(output)
    }

    /// Columns of tables are encoded over so many threads.
    pub fn over(mut self, threads: usize) -> Self {
        for table in &mut self.tables {
            table.groups = table.groups.take().map(|groups| groups.over(threads));
        }
        self
    }

    fn open_tables(&mut self) -> Result<(), RunError> {
        for (t, forms) in forms(&self.state).into_iter().enumerate() {
            let layout = &LAYOUTS[t];
            let length = |name: &str| self.state.files.get(name).copied().unwrap_or(0);
            let open =
                |name: &str, header: &[u8]| Stream::open(&self.folder.join(name), header, length(name), self.disk);
            let table = &mut self.tables[t];
            if forms.text {
                table.text = Some(open(&layout.file(TableFormat::Csv), layout.header().as_bytes())?);
            }
            if forms.cells {
                table.cells = Some(open(&cells_file(t), &[])?);
            }
            if forms.columns {
                let name = layout.file(TableFormat::Parquet);
                let rest = self.state.rests.get(layout.stem).map(|name| self.folder.join(name));
                let path = self.folder.join(&name);
                table.groups = Some(Groups::open(layout, &path, length(&name), rest.as_deref(), self.disk)?);
            }
        }
        Ok(())
    }

    /// Writes a block's rows, and now and then that they are there.
    pub fn append(&mut self, next: u64, block: Block, recording: &Recording) -> Result<(), RunError> {
        for (t, rows) in block.tables.into_iter().enumerate() {
            match rows {
                Rows::Held(encoded) => self.put(t, encoded, recording)?,
                Rows::Aside(spill) => {
                    spill.read(AT_A_TIME, |columns| self.put(t, recording.encode(t, columns), recording))?;
                }
            }
        }
        self.state.summary.merge(&block.summary);
        self.state.next = next;
        // a twentieth of the time at most, unless one is wanted after every block
        let wait = if self.every.is_zero() { self.every } else { self.every.max(20 * self.took) };
        if self.last.elapsed() >= wait { self.checkpoint() } else { Ok(()) }
    }

    fn put(&mut self, t: usize, encoded: Encoded, recording: &Recording) -> Result<(), RunError> {
        let table = &mut self.tables[t];
        if let Some(text) = &mut table.text {
            text.append(&encoded.text, self.disk)?;
        }
        if let Some(cells) = &mut table.cells {
            cells.append(&encoded.cells, self.disk)?;
        }
        if let (Some(groups), Some(columns)) = (&mut table.groups, encoded.columns) {
            groups.put(&LAYOUTS[t], &recording.words, columns, self.disk)?;
        }
        Ok(())
    }

    /// Appends to a table's text.
    pub fn put_text(&mut self, t: usize, bytes: &[u8]) -> Result<(), RunError> {
        self.tables[t].text.as_mut().map_or(Ok(()), |text| text.append(bytes, self.disk))
    }

    /// Appends to a table's cells.
    pub fn put_cells(&mut self, t: usize, bytes: &[u8]) -> Result<(), RunError> {
        self.tables[t].cells.as_mut().map_or(Ok(()), |cells| cells.append(bytes, self.disk))
    }

    /// Appends rows to a table's row groups.
    pub fn put_table(&mut self, t: usize, rows: &carom_table::Table) -> Result<(), RunError> {
        self.tables[t].groups.as_mut().map_or(Ok(()), |groups| groups.put_table(rows, self.disk))
    }

    /// Writes down the triangles of walls that are made of them, if `deposit.vtp` is wanted and there are any.
    pub fn write_triangles(&self, walls: &[Wall]) -> Result<(), RunError> {
        let meshes = walls.iter().enumerate().filter_map(|(wall, w)| match &w.shape {
            Shape::Mesh(mesh) if !mesh.is_block() => Some((wall as u64, mesh)),
            _ => None,
        });
        let meshes: Vec<_> = meshes.collect();
        if meshes.is_empty() || !self.state.vtk || self.state.finished {
            return Ok(());
        }
        let (path, fresh) =
            (self.folder.join(vtp::TRIANGLES), self.folder.join(format!("{}.{UNFINISHED}", vtp::TRIANGLES)));
        let error = RunError::io(&fresh);
        let mut out = BufWriter::new(File::create(&fresh).map_err(&error)?);
        for (wall, mesh) in meshes {
            for (face, corners) in mesh.triangles() {
                let whole = [wall, u64::from(face)];
                let cells = whole.into_iter().chain(corners.as_flattened().iter().map(|x| x.to_bits()));
                cells.into_iter().try_for_each(|cell| out.write_all(&cell.to_le_bytes())).map_err(&error)?;
            }
        }
        let file = out.into_inner().map_err(|e| error(e.into_error()))?;
        self.disk.sync(&file, &fresh).and_then(|()| self.disk.rename(&fresh, &path)).map_err(&error)
    }

    /// Takes over the triangles of walls from another folder.
    pub fn copy_triangles(&self, from: &Path) -> Result<(), RunError> {
        std::fs::copy(from, self.folder.join(vtp::TRIANGLES)).map(|_| ()).map_err(RunError::io(from))
    }

    /// Puts all on disk, then says so.
    pub fn checkpoint(&mut self) -> Result<(), RunError> {
        let started = Instant::now();
        let old = std::mem::take(&mut self.state.rests);
        for (t, table) in self.tables.iter_mut().enumerate() {
            for stream in [&mut table.text, &mut table.cells].into_iter().flatten() {
                stream.sync(self.disk)?;
            }
            if let Some(groups) = &mut table.groups {
                let name = format!("{}.rest-{}.parquet", LAYOUTS[t].stem, self.state.next);
                if groups.checkpoint(&self.folder.join(&name), self.disk)? {
                    self.state.rests.insert(LAYOUTS[t].stem.to_owned(), name);
                }
            }
        }
        self.count_lengths();
        // names before what refers to them
        self.disk.sync_folder(&self.folder).map_err(RunError::io(&self.folder))?;
        self.state.write(self.disk, &self.folder)?;
        for name in old.values().filter(|name| !self.state.rests.values().any(|n| n == *name)) {
            remove(self.disk, &self.folder.join(name))?;
        }
        (self.last, self.took) = (Instant::now(), started.elapsed());
        Ok(())
    }

    fn count_lengths(&mut self) {
        for (t, table) in self.tables.iter().enumerate() {
            let layout = &LAYOUTS[t];
            let lengths = [
                (layout.file(TableFormat::Csv), table.text.as_ref().map(Stream::length)),
                (cells_file(t), table.cells.as_ref().map(Stream::length)),
                (layout.file(TableFormat::Parquet), table.groups.as_ref().map(Groups::length)),
            ];
            let known = lengths.into_iter().filter_map(|(name, length)| Some((name, length?)));
            self.state.files.extend(known);
        }
    }

    /// The run is complete: makes what it has besides its rows, `summary.json` last of all.
    pub fn finish(mut self) -> Result<(), RunError> {
        if !self.state.finished {
            self.checkpoint()?;
            self.make_whole()?;
        }
        let summary = self.state.summary.to_json().map_err(RunError::Json)?;
        replace(self.disk, &self.folder, SUMMARY, summary.as_bytes())?;
        // what was needed on the way; a shard's cells are needed once more, by the merging
        for path in ours(&self.folder)? {
            let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
            let spent = name.contains(".rest-") || name.ends_with(&format!(".{UNFINISHED}"));
            let cells = name.ends_with(".cells") || name == vtp::TRIANGLES;
            if spent || cells && self.state.shard.is_none() {
                remove(self.disk, &path)?;
            }
        }
        Ok(())
    }

    fn make_whole(&mut self) -> Result<(), RunError> {
        for groups in self.tables.iter_mut().filter_map(|t| t.groups.as_mut()) {
            groups.finish(self.disk)?;
        }
        self.count_lengths();
        if self.state.shard.is_none() {
            self.state.files.retain(|name, _| !name.ends_with(".cells"));
        }
        if self.state.vtk {
            let made = vtp::write(&self.folder, &self.state, self.disk)?;
            self.state.files.extend(made);
        }
        let text =
            self.state.summary.deposition.to_csv(&self.state.bins, &self.state.walls()).map_err(RunError::Csv)?;
        replace(self.disk, &self.folder, DEPOSITION, text.as_bytes())?;
        self.state.files.insert(DEPOSITION.to_owned(), text.len() as u64);
        for (name, length) in &mut self.state.files {
            // the footers too
            let path = self.folder.join(name);
            *length = std::fs::metadata(&path).map_err(RunError::io(&path))?.len();
        }
        self.state.rests.clear();
        self.state.finished = true;
        self.state.write(self.disk, &self.folder)
    }
}
