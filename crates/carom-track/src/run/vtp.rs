//! Trajectories and deposits as VTK XML poly data, for ParaView and its like.
//!
//! Made from the cells that the run wrote as it went on, each read once: the length of every array is known beforehand, so that
//! its values go straight to their places. Memory stays flat, values keep all their bits.

mod shown;

use super::RunError;
use super::checkpoint::State;
use super::disk::{Disk, UNFINISHED};
use super::output::cells_file;
use crate::record::columns::CELL;
use crate::tables::{DEPOSIT as DEPOSITS, LAYOUTS, TRAJECTORIES};
use std::borrow::Cow;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufReader, BufWriter, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::Path;

pub use shown::{DepositFace, deposit_faces};

/// The files' names.
pub(super) const PATHS: &str = "trajectories.vtp";
pub(super) const DEPOSIT: &str = "deposit.vtp";
/// Triangles of walls as cells: wall, face, and the nine coordinates of its corners.
pub(super) const TRIANGLES: &str = "triangles.cells";
pub(super) const TRIANGLE: usize = 11;

/// A cell of eight bytes.
type Cell = [u8; CELL];
const NAN: Cell = f64::NAN.to_le_bytes();

/// Writes `trajectories.vtp` (a line for each recorded particle) and `deposit.vtp` (a point for each particle a wall kept, and
/// the faces of walls made of triangles); gives their names and lengths.
pub(super) fn write(folder: &Path, state: &State, disk: &dyn Disk) -> Result<Vec<(String, u64)>, RunError> {
    let mut made = Vec::new();
    if state.formats[TRAJECTORIES].is_some() {
        made.push((PATHS.to_owned(), trajectories(folder, disk)?));
    }
    made.push((DEPOSIT.to_owned(), deposit(folder, state, disk)?));
    Ok(made)
}

/// Rows of cells in a file.
struct Cells {
    reader: BufReader<File>,
    row: Vec<Cell>,
    rows: u64,
}

impl Cells {
    /// The rows of a file; none where there is no such file.
    fn open(path: &Path, width: usize) -> Result<Option<Self>, RunError> {
        let file = match File::open(path) {
            Ok(file) => file,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(RunError::io(path)(e)),
        };
        let rows = file.metadata().map_err(RunError::io(path))?.len() / (width * CELL) as u64;
        Ok(Some(Self { reader: BufReader::with_capacity(1 << 16, file), row: vec![[0; CELL]; width], rows }))
    }

    fn of_table(folder: &Path, table: usize) -> Result<Self, RunError> {
        let path = folder.join(cells_file(table));
        let cells = Self::open(&path, LAYOUTS[table].columns.len())?;
        cells.ok_or(RunError::Gone { path })
    }

    fn each(mut self, path: &Path, mut each: impl FnMut(&[Cell]) -> Result<(), RunError>) -> Result<(), RunError> {
        for _ in 0..self.rows {
            self.reader.read_exact(self.row.as_flattened_mut()).map_err(RunError::io(path))?;
            each(&self.row)?;
        }
        Ok(())
    }
}

/// What the XML says of an array, and where its next value goes.
struct Array {
    name: Cow<'static, str>,
    kind: &'static str,
    components: usize,
    /// Values of all rows.
    values: u64,
    at: u64,
    waiting: Vec<u8>,
}

impl Array {
    fn floats<const N: usize>(name: impl Into<Cow<'static, str>>, rows: u64) -> Self {
        Self { name: name.into(), kind: "Float64", components: N, values: rows * N as u64, at: 0, waiting: Vec::new() }
    }

    fn integers(name: impl Into<Cow<'static, str>>, rows: u64) -> Self {
        Self { name: name.into(), kind: "Int64", components: 1, values: rows, at: 0, waiting: Vec::new() }
    }

    fn bytes(&self) -> u64 {
        self.values * CELL as u64
    }
}

/// Bytes of an array that wait for being written together.
const TOGETHER: usize = 1 << 16;

/// A file under way.
struct Vtp {
    file: File,
    arrays: Vec<Array>,
}

impl Vtp {
    /// Writes all but the values.
    fn create(path: &Path, piece: &str, groups: Vec<(&str, Vec<Array>)>) -> Result<Self, RunError> {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n",
        );
        // a string takes every text
        let _ = writeln!(text, "<Piece {piece}>");
        let mut offset = 0;
        for (group, arrays) in &groups {
            let _ = writeln!(text, "<{group}>");
            for array in arrays {
                let Array { name, kind, components, .. } = array;
                let _ = writeln!(
                    text,
                    "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>"
                );
                offset += CELL as u64 + array.bytes();
            }
            let _ = writeln!(text, "</{group}>");
        }
        text += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
        let mut file = BufWriter::new(File::create(path).map_err(RunError::io(path))?);
        let mut arrays: Vec<Array> = groups.into_iter().flat_map(|(_, arrays)| arrays).collect();
        let mut place = text.len() as u64;
        file.write_all(text.as_bytes()).map_err(RunError::io(path))?;
        for array in &mut arrays {
            file.seek(SeekFrom::Start(place)).map_err(RunError::io(path))?;
            file.write_all(&array.bytes().to_le_bytes()).map_err(RunError::io(path))?;
            array.at = place + CELL as u64;
            place = array.at + array.bytes();
        }
        file.seek(SeekFrom::Start(place)).map_err(RunError::io(path))?;
        file.write_all(b"\n</AppendedData>\n</VTKFile>\n").map_err(RunError::io(path))?;
        let file = file.into_inner().map_err(|e| RunError::io(path)(e.into_error()))?;
        Ok(Self { file, arrays })
    }

    /// Appends values to an array.
    fn put(&mut self, array: usize, values: &[Cell]) -> Result<(), std::io::Error> {
        let array = &mut self.arrays[array];
        array.waiting.extend_from_slice(values.as_flattened());
        if array.waiting.len() >= TOGETHER { write_out(&mut self.file, array) } else { Ok(()) }
    }

    /// Puts the file in its place; gives its length.
    fn finish(mut self, folder: &Path, name: &str, disk: &dyn Disk) -> Result<u64, RunError> {
        let (path, fresh) = (folder.join(name), unfinished(folder, name));
        for array in &mut self.arrays {
            write_out(&mut self.file, array).map_err(RunError::io(&fresh))?;
        }
        let length = self.file.metadata().map_err(RunError::io(&fresh))?.len();
        disk.sync(&self.file, &fresh).map_err(RunError::io(&fresh))?;
        disk.rename(&fresh, &path).and_then(|()| disk.sync_folder(folder)).map_err(RunError::io(&path))?;
        Ok(length)
    }
}

fn write_out(file: &mut File, array: &mut Array) -> Result<(), std::io::Error> {
    file.seek(SeekFrom::Start(array.at))?;
    file.write_all(&array.waiting)?;
    array.at += array.waiting.len() as u64;
    array.waiting.clear();
    Ok(())
}

fn unfinished(folder: &Path, name: &str) -> std::path::PathBuf {
    folder.join(format!("{name}.{UNFINISHED}"))
}

fn trajectories(folder: &Path, disk: &dyn Disk) -> Result<u64, RunError> {
    let source = folder.join(cells_file(TRAJECTORIES));
    let (mut lines, mut last) = (0, None);
    Cells::of_table(folder, TRAJECTORIES)?.each(&source, |row| {
        lines += u64::from(last.replace(row[0]) != Some(row[0]));
        Ok(())
    })?;
    let cells = Cells::of_table(folder, TRAJECTORIES)?;
    let points = cells.rows;
    let piece = format!(
        "NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"{lines}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\""
    );
    let groups = vec![
        (
            "PointData",
            vec![
                Array::floats::<1>("time", points),
                Array::floats::<3>("velocity", points),
                Array::floats::<3>("spin", points),
            ],
        ),
        ("CellData", vec![Array::integers("particle", lines)]),
        ("Points", vec![Array::floats::<3>("points", points)]),
        ("Lines", vec![Array::integers("connectivity", points), Array::integers("offsets", lines)]),
    ];
    let path = unfinished(folder, PATHS);
    let mut file = Vtp::create(&path, &piece, groups)?;
    let (mut point, mut last) = (0u64, None);
    cells.each(&source, |row| {
        let fresh = last.replace(row[0]) != Some(row[0]);
        let mut all = || {
            if fresh {
                file.put(3, &row[0..1])?;
                if point > 0 {
                    file.put(6, &[point.to_le_bytes()])?;
                }
            }
            file.put(0, &row[1..2])?;
            file.put(4, &row[2..5])?;
            file.put(1, &row[5..8])?;
            file.put(2, &row[8..11])?;
            file.put(5, &[point.to_le_bytes()])
        };
        all().map_err(RunError::io(&path))?;
        point += 1;
        Ok(())
    })?;
    if point > 0 {
        file.put(6, &[point.to_le_bytes()]).map_err(RunError::io(&path))?;
    }
    file.finish(folder, PATHS, disk)
}

/// Data of points: names and columns of the deposit's table.
const SINGLE: [(&str, usize); 5] =
    [("time", 1), ("diameter", 5), ("normal_speed_in", 6), ("tangential_speed_in", 7), ("weight", 8)];

fn deposit(folder: &Path, state: &State, disk: &dyn Disk) -> Result<u64, RunError> {
    let (source, faces) = (folder.join(cells_file(DEPOSITS)), folder.join(TRIANGLES));
    let kept = Cells::of_table(folder, DEPOSITS)?;
    let triangles = Cells::open(&faces, TRIANGLE)?.filter(|t| t.rows > 0);
    let (verts, polys) = (kept.rows, triangles.as_ref().map_or(0, |t| t.rows));
    let (points, cells) = (verts + 3 * polys, verts + polys);
    let piece = format!(
        "NumberOfPoints=\"{points}\" NumberOfVerts=\"{verts}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{polys}\""
    );
    let mut of_points = vec![Array::integers("particle", points)];
    of_points.extend(SINGLE.map(|(name, _)| Array::floats::<1>(name, points)));
    let mut groups = vec![
        ("PointData", of_points),
        ("Points", vec![Array::floats::<3>("points", points)]),
        ("Verts", vec![Array::integers("connectivity", verts), Array::integers("offsets", verts)]),
    ];
    if triangles.is_some() {
        groups.push(("Polys", vec![Array::integers("connectivity", 3 * polys), Array::integers("offsets", polys)]));
        let integers = ["wall", "face", "number", "impacts"].map(|name| Array::integers(name, cells));
        let floats = ["mass", "mean_impact_speed", "mean_impact_angle"].map(|name| Array::floats::<1>(name, cells));
        let more = maps(state).map(|map| Array::floats::<1>(map.name(state), cells));
        groups.push(("CellData", integers.into_iter().chain(floats).chain(more).collect()));
    }
    let path = unfinished(folder, DEPOSIT);
    let mut file = Vtp::create(&path, &piece, groups)?;
    let mut point = 0u64;
    let none = (-1i64).to_le_bytes();
    kept.each(&source, |row| {
        let mut all = || {
            file.put(0, &row[0..1])?;
            for (i, (_, column)) in SINGLE.iter().enumerate() {
                file.put(1 + i, &row[*column..=*column])?;
            }
            file.put(6, &row[2..5])?;
            file.put(7, &[point.to_le_bytes()])?;
            file.put(8, &[(point + 1).to_le_bytes()])?;
            if polys > 0 {
                // the numbers stand at the faces
                file.put(11, &[none])?;
                file.put(12, &[none])?;
                file.put(13, &[[0; CELL]])?;
                file.put(14, &[[0; CELL]])?;
                file.put(15, &[0f64.to_le_bytes()])?;
                file.put(16, &[NAN])?;
                file.put(17, &[NAN])?;
                for (i, map) in maps(state).enumerate() {
                    file.put(18 + i, &[map.at_points()])?;
                }
            }
            Ok(())
        };
        all().map_err(RunError::io(&path))?;
        point += 1;
        Ok(())
    })?;
    if let Some(triangles) = triangles {
        put_faces(&mut file, triangles, state, &faces, point).map_err(|e| at(e, &path))?;
    }
    file.finish(folder, DEPOSIT, disk)
}

/// What is told of faces where the case asks for it.
#[derive(Clone, Copy, Debug)]
enum Map {
    /// Mass that impacts took away, kg; not a number on walls without a law of erosion.
    Eroded,
    /// Mass kept of a size bin, kg.
    Size(u32),
}

fn maps(state: &State) -> impl Iterator<Item = Map> + use<> {
    let eroded = state.summary.walls.iter().any(|w| w.eroded.is_some()).then_some(Map::Eroded);
    let sizes = if state.bins.by_face { state.bins.sizes.len() as u32 + 1 } else { 0 };
    eroded.into_iter().chain((0..sizes).map(Map::Size))
}

impl Map {
    fn name(self, state: &State) -> Cow<'static, str> {
        let edge = |i: u32| {
            let edge = state.bins.sizes.get(i as usize).map_or(f64::INFINITY, |edge| edge * 1e6);
            carom_table::significant(edge, 6)
        };
        match self {
            Self::Eroded => "eroded_mass".into(),
            Self::Size(0) => format!("mass_below_{}_um", edge(0)).into(),
            Self::Size(i) if i as usize == state.bins.sizes.len() => format!("mass_from_{}_um", edge(i - 1)).into(),
            Self::Size(i) => format!("mass_{}_to_{}_um", edge(i - 1), edge(i)).into(),
        }
    }

    /// At a deposit's point: as at a face without.
    fn at_points(self) -> Cell {
        match self {
            Self::Eroded => NAN,
            Self::Size(_) => 0f64.to_le_bytes(),
        }
    }

    fn of(self, state: &State, wall: usize, tally: &crate::deposition::FaceTally) -> f64 {
        match self {
            Self::Eroded if state.summary.walls.get(wall).is_none_or(|w| w.eroded.is_none()) => f64::NAN,
            Self::Eroded => tally.eroded(),
            Self::Size(size) => tally.kept_of(size).map_or(0.0, |kept| kept.mass.value()),
        }
    }
}

fn at(error: RunError, path: &Path) -> RunError {
    match error {
        RunError::Stream(source) => RunError::io(path)(source),
        other => other,
    }
}

/// Faces with what they kept and the means over the impacts on them.
fn put_faces(file: &mut Vtp, triangles: Cells, state: &State, source: &Path, mut point: u64) -> Result<(), RunError> {
    let mut offset = 0u64;
    let nothing = crate::deposition::FaceTally::default();
    triangles.each(source, |row| {
        let [wall, face] = [row[0], row[1]].map(u64::from_le_bytes);
        let tally = state.summary.faces.get(wall as usize, face as u32).unwrap_or(&nothing);
        for corner in 0..3 {
            file.put(0, &[(-1i64).to_le_bytes()])?;
            for array in 1..6 {
                file.put(array, &[NAN])?;
            }
            file.put(6, &row[2 + 3 * corner..5 + 3 * corner])?;
            file.put(9, &[point.to_le_bytes()])?;
            point += 1;
        }
        offset += 3;
        file.put(10, &[offset.to_le_bytes()])?;
        file.put(11, &row[0..1])?;
        file.put(12, &row[1..2])?;
        file.put(13, &[tally.kept.count.to_le_bytes()])?;
        file.put(14, &[tally.impacts.to_le_bytes()])?;
        file.put(15, &[tally.kept.mass.value().to_le_bytes()])?;
        file.put(16, &[tally.mean_speed().to_le_bytes()])?;
        file.put(17, &[tally.mean_angle().to_degrees().to_le_bytes()])?;
        for (i, map) in maps(state).enumerate() {
            file.put(18 + i, &[map.of(state, wall as usize, tally).to_le_bytes()])?;
        }
        Ok(())
    })
}
