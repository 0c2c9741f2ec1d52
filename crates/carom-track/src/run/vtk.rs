//! Trajectories and deposits as VTK XML poly data, for ParaView and its like.
//!
//! Made from the finished tables, a pass for each array, so that memory stays flat.

use super::RunError;
use crate::tables::{IMPACTS, LAYOUTS, TRAJECTORIES, TableFormat};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

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

/// A table that is read several times.
struct Source<'a> {
    path: PathBuf,
    wanted: &'a dyn Fn(&csv::StringRecord) -> bool,
}

impl Source<'_> {
    /// Calls `each` with every wanted row.
    fn rows(&self, mut each: impl FnMut(&csv::StringRecord) -> std::io::Result<()>) -> Result<(), RunError> {
        let io = RunError::io(&self.path);
        let mut reader = csv::Reader::from_path(&self.path).map_err(|e| io(e.into()))?;
        let mut row = csv::StringRecord::new();
        while reader.read_record(&mut row).map_err(|e| io(e.into()))? {
            if (self.wanted)(&row) {
                each(&row).map_err(&io)?;
            }
        }
        Ok(())
    }
}

/// A VTK file under way.
struct Writer {
    path: PathBuf,
    file: BufWriter<File>,
}

impl Writer {
    fn create(path: PathBuf) -> Result<Self, RunError> {
        let file = File::create(&path).map_err(RunError::io(&path))?;
        Ok(Self { path, file: BufWriter::new(file) })
    }

    fn text(&mut self, text: &str) -> Result<(), RunError> {
        self.file.write_all(text.as_bytes()).map_err(RunError::io(&self.path))
    }

    /// An array made of some columns of a table.
    fn array(&mut self, name: &str, source: &Source, columns: &[usize], kind: &str) -> Result<(), RunError> {
        let n = columns.len();
        self.text(&format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{n}\" format=\"ascii\">\n"
        ))?;
        let file = &mut self.file;
        source.rows(|row| {
            let fields: Vec<&str> = columns.iter().map(|c| row.get(*c).unwrap_or("0")).collect();
            writeln!(file, "{}", fields.join(" "))
        })?;
        self.text("</DataArray>\n")
    }

    /// An array of whole numbers.
    fn integers(&mut self, name: &str, values: impl Iterator<Item = u64>) -> Result<(), RunError> {
        self.text(&format!("<DataArray type=\"Int64\" Name=\"{name}\" format=\"ascii\">\n"))?;
        for value in values {
            self.text(&format!("{value}\n"))?;
        }
        self.text("</DataArray>\n")
    }

    fn finish(mut self) -> Result<(), RunError> {
        self.text("</Piece>\n</PolyData>\n</VTKFile>\n")?;
        self.file.flush().map_err(RunError::io(&self.path))
    }
}

const HEAD: &str =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n";

fn trajectories(folder: &Path) -> Result<(), RunError> {
    let source = Source { path: table(folder, TRAJECTORIES), wanted: &|_| true };
    // particle numbers and where their points end
    let mut lines: Vec<(u64, u64)> = Vec::new();
    let mut points = 0;
    source.rows(|row| {
        let particle = row.get(0).and_then(|p| p.parse().ok()).unwrap_or(0);
        points += 1;
        match lines.last_mut() {
            Some(last) if last.0 == particle => last.1 = points,
            _ => lines.push((particle, points)),
        }
        Ok(())
    })?;
    let mut out = Writer::create(folder.join("trajectories.vtp"))?;
    out.text(HEAD)?;
    out.text(&format!("<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n", lines.len()))?;
    out.text("<PointData>\n")?;
    out.array("time", &source, &[1], "Float64")?;
    out.array("velocity", &source, &[5, 6, 7], "Float64")?;
    out.array("spin", &source, &[8, 9, 10], "Float64")?;
    out.text("</PointData>\n<CellData>\n")?;
    out.integers("particle", lines.iter().map(|l| l.0))?;
    out.text("</CellData>\n<Points>\n")?;
    out.array("points", &source, &[2, 3, 4], "Float64")?;
    out.text("</Points>\n<Lines>\n")?;
    out.integers("connectivity", 0..points)?;
    out.integers("offsets", lines.iter().map(|l| l.1))?;
    out.text("</Lines>\n")?;
    out.finish()
}

fn deposit(folder: &Path) -> Result<(), RunError> {
    const FATE: usize = 12;
    let kept = |row: &csv::StringRecord| matches!(row.get(FATE), Some("capture" | "settle" | "trap"));
    let source = Source { path: table(folder, IMPACTS), wanted: &kept };
    let mut points = 0u64;
    source.rows(|_| {
        points += 1;
        Ok(())
    })?;
    let mut out = Writer::create(folder.join("deposit.vtp"))?;
    out.text(HEAD)?;
    out.text(&format!("<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{points}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"))?;
    out.text("<PointData>\n")?;
    out.array("particle", &source, &[0], "Int64")?;
    out.array("time", &source, &[1], "Float64")?;
    out.array("diameter", &source, &[6], "Float64")?;
    out.array("normal_speed_in", &source, &[7], "Float64")?;
    out.array("tangential_speed_in", &source, &[8], "Float64")?;
    out.array("weight", &source, &[16], "Float64")?;
    out.text("</PointData>\n<Points>\n")?;
    out.array("points", &source, &[2, 3, 4], "Float64")?;
    out.text("</Points>\n<Verts>\n")?;
    out.integers("connectivity", 0..points)?;
    out.integers("offsets", 1..=points)?;
    out.text("</Verts>\n")?;
    out.finish()
}
