//! Trajectories and deposits as VTK XML poly data, for ParaView and its like.
//!
//! Made from the finished tables, each read once: every array is spooled into a file without a name while the rows go by,
//! and the arrays are then put one after the other as raw binary. Memory stays flat, values keep all their bits.

use super::RunError;
use crate::tables::{IMPACTS, LAYOUTS, TRAJECTORIES, TableFormat};
use carom_table::{Row, RowReader};
use std::borrow::Cow;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Writes `trajectories.vtp` (a line for each recorded particle) and `deposit.vtp` (a point for each particle a wall kept)
/// beside the tables they are made from.
pub(super) fn write(folder: &Path) -> Result<(), RunError> {
    if table(folder, TRAJECTORIES).exists() {
        trajectories(folder)?;
    }
    if table(folder, IMPACTS).exists() {
        deposit(folder)?;
    }
    Ok(())
}

fn table(folder: &Path, index: usize) -> PathBuf {
    folder.join(LAYOUTS[index].file(TableFormat::Csv))
}

/// Calls `each` with every row of a table.
fn rows(folder: &Path, index: usize, mut each: impl FnMut(Row) -> io::Result<()>) -> Result<(), RunError> {
    let path = table(folder, index);
    let error = RunError::io(&path);
    let mut rows = RowReader::new(File::open(&path).map_err(&error)?);
    // the header
    rows.next_row().map_err(&error)?;
    while let Some(row) = rows.next_row().map_err(&error)? {
        each(row).map_err(&error)?;
    }
    Ok(())
}

/// A field as a number; an empty one is `none`.
fn number<T: FromStr>(field: Option<&Field>, none: Option<T>) -> io::Result<T> {
    let text = field.map_or("", |f| std::str::from_utf8(f).unwrap_or("?"));
    let number = if text.is_empty() { none } else { text.parse().ok() };
    number.ok_or_else(|| io::Error::new(io::ErrorKind::InvalidData, format!("'{text}' where a number should be")))
}

type Field<'a> = Cow<'a, [u8]>;

/// The values of one array, on disk until its turn comes.
struct Array {
    name: &'static str,
    kind: &'static str,
    components: usize,
    values: BufWriter<File>,
    bytes: u64,
}

impl Array {
    fn new(folder: &Path, name: &'static str, kind: &'static str, components: usize) -> Result<Self, RunError> {
        let file = tempfile::tempfile_in(folder).map_err(RunError::io(folder))?;
        Ok(Self { name, kind, components, values: BufWriter::with_capacity(1 << 14, file), bytes: 0 })
    }

    fn floats<const N: usize>(folder: &Path, name: &'static str) -> Result<Self, RunError> {
        Self::new(folder, name, "Float64", N)
    }

    fn integers(folder: &Path, name: &'static str) -> Result<Self, RunError> {
        Self::new(folder, name, "Int64", 1)
    }

    fn put(&mut self, value: [u8; 8]) -> io::Result<()> {
        self.bytes += 8;
        self.values.write_all(&value)
    }

    /// Adds a value for each column.
    fn columns(&mut self, row: &[Field], columns: impl IntoIterator<Item = usize>) -> io::Result<()> {
        columns.into_iter().try_for_each(|column| self.put(number(row.get(column), Some(f64::NAN))?.to_le_bytes()))
    }

    fn integer(&mut self, value: u64) -> io::Result<()> {
        self.put(value.to_le_bytes())
    }
}

/// Writes a file: what stands about each array in the XML, then all values.
fn assemble(path: &Path, piece: &str, groups: &mut [(&str, Vec<Array>)]) -> Result<(), RunError> {
    let error = RunError::io(path);
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n",
    );
    // a string takes every text
    let _ = writeln!(text, "<Piece {piece}>");
    let mut offset = 0;
    for (group, arrays) in groups.iter() {
        let _ = writeln!(text, "<{group}>");
        for Array { name, kind, components, bytes, .. } in arrays {
            let _ = writeln!(
                text,
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>"
            );
            offset += 8 + bytes;
        }
        let _ = writeln!(text, "</{group}>");
    }
    text += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    let mut file = File::create(path).map_err(&error)?;
    file.write_all(text.as_bytes()).map_err(&error)?;
    for array in groups.iter_mut().flat_map(|(_, arrays)| arrays) {
        file.write_all(&array.bytes.to_le_bytes()).map_err(&error)?;
        array.values.flush().map_err(&error)?;
        let spool = array.values.get_mut();
        spool.seek(SeekFrom::Start(0)).map_err(&error)?;
        io::copy(spool, &mut file).map_err(&error)?;
    }
    file.write_all(b"\n</AppendedData>\n</VTKFile>\n").map_err(&error)
}

fn trajectories(folder: &Path) -> Result<(), RunError> {
    let mut time = Array::floats::<1>(folder, "time")?;
    let mut velocity = Array::floats::<3>(folder, "velocity")?;
    let mut spin = Array::floats::<3>(folder, "spin")?;
    let mut particle = Array::integers(folder, "particle")?;
    let mut place = Array::floats::<3>(folder, "points")?;
    let mut connectivity = Array::integers(folder, "connectivity")?;
    let mut offsets = Array::integers(folder, "offsets")?;
    let (mut points, mut lines) = (0, 0u64);
    let mut last = None;
    rows(folder, TRAJECTORIES, |row| {
        let row: Vec<Field> = row.fields().collect();
        let this = number(row.first(), None)?;
        if last.is_some_and(|last| last != this) {
            offsets.integer(points)?;
        }
        if last.replace(this) != Some(this) {
            particle.integer(this)?;
            lines += 1;
        }
        time.columns(&row, [1])?;
        place.columns(&row, 2..5)?;
        velocity.columns(&row, 5..8)?;
        spin.columns(&row, 8..11)?;
        connectivity.integer(points)?;
        points += 1;
        Ok(())
    })?;
    let path = folder.join("trajectories.vtp");
    if last.is_some() {
        offsets.integer(points).map_err(RunError::io(&path))?;
    }
    let piece = format!(
        "NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"{lines}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\""
    );
    let groups = &mut [
        ("PointData", vec![time, velocity, spin]),
        ("CellData", vec![particle]),
        ("Points", vec![place]),
        ("Lines", vec![connectivity, offsets]),
    ];
    assemble(&path, &piece, groups)
}

fn deposit(folder: &Path) -> Result<(), RunError> {
    const FATE: usize = 12;
    /// Names and columns of the arrays.
    const SINGLE: [(&str, usize); 5] =
        [("time", 1), ("diameter", 6), ("normal_speed_in", 7), ("tangential_speed_in", 8), ("weight", 16)];
    let mut particle = Array::integers(folder, "particle")?;
    let mut singles =
        SINGLE.iter().map(|(name, _)| Array::floats::<1>(folder, name)).collect::<Result<Vec<_>, RunError>>()?;
    let mut place = Array::floats::<3>(folder, "points")?;
    let mut connectivity = Array::integers(folder, "connectivity")?;
    let mut offsets = Array::integers(folder, "offsets")?;
    let mut points = 0;
    rows(folder, IMPACTS, |row| {
        if !matches!(row.field(FATE).as_deref(), Some(b"capture" | b"settle" | b"trap")) {
            return Ok(());
        }
        let row: Vec<Field> = row.fields().collect();
        particle.integer(number(row.first(), None)?)?;
        for (array, (_, column)) in singles.iter_mut().zip(SINGLE) {
            array.columns(&row, [column])?;
        }
        place.columns(&row, 2..5)?;
        connectivity.integer(points)?;
        points += 1;
        offsets.integer(points)
    })?;
    let piece = format!(
        "NumberOfPoints=\"{points}\" NumberOfVerts=\"{points}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\""
    );
    singles.insert(0, particle);
    let groups = &mut [("PointData", singles), ("Points", vec![place]), ("Verts", vec![connectivity, offsets])];
    assemble(&folder.join("deposit.vtp"), &piece, groups)
}
