//! Reading a table's file as a stream of batches, for the columns that are wanted.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::parquet_reader::ParquetDecoder;
use super::{Cell, Field, Format, Kind, Schema, Table};
use crate::ReportError;

/// Reads some columns of a CSV or Parquet file, a batch of rows at a time; memory stays flat.
///
/// ```
/// use carom_report::{Column, Field, Table, TableReader, Values};
///
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("impacts.parquet");
/// let speeds = Column::float("speed", "m/s", [0.5, f64::NAN, 2.0]);
/// Table::new([Column::count("particle", [0, 1, 2]), speeds])?.write(&path)?;
/// let mut reader = TableReader::open(&path, vec![Field::float("speed", "m/s")])?;
/// let mut rows = 0;
/// while let Some(batch) = reader.next_batch()? {
///     let Values::Float(speeds) = &batch.columns()[0].values else { unreachable!() };
///     rows += speeds.len();
/// }
/// assert_eq!(rows, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct TableReader {
    path: PathBuf,
    batch: Table,
    decoder: Decoder,
}

enum Decoder {
    Csv(Box<CsvDecoder>),
    Parquet(Box<ParquetDecoder>),
}

/// Rows of a batch of CSV.
const ROWS: usize = 1 << 12;

impl TableReader {
    /// Opens a file whose format its extension tells, for the columns of `schema`, told by their names.
    ///
    /// # Errors
    /// [`ReportError::UnknownExtension`] (JSON is not read), [`ReportError::File`], and [`ReportError::Mismatch`] for a
    /// column that the file lacks or that is of another kind.
    pub fn open(path: impl AsRef<Path>, schema: Schema) -> Result<Self, ReportError> {
        let path = path.as_ref();
        let format = Format::from_path(path)?;
        let file = File::open(path).map_err(|e| ReportError::Stream(e).at(path))?;
        let decoder = match format {
            Format::Csv => CsvDecoder::new(file, &schema).map(|d| Decoder::Csv(Box::new(d))),
            Format::Parquet => ParquetDecoder::new(file, &schema).map(|d| Decoder::Parquet(Box::new(d))),
            Format::Json => Err(ReportError::UnknownExtension { path: path.to_path_buf(), known: ".csv and .parquet" }),
        };
        let decoder = decoder.map_err(|e| named(e, path))?;
        Ok(Self { path: path.to_path_buf(), batch: Table::with_schema(&schema)?, decoder })
    }

    /// The next rows, in the order of the file; `None` after the last.
    ///
    /// # Errors
    /// [`ReportError::File`], and [`ReportError::Mismatch`] for a cell that is not of its column's kind.
    pub fn next_batch(&mut self) -> Result<Option<&Table>, ReportError> {
        self.batch.clear();
        let read = match &mut self.decoder {
            Decoder::Csv(d) => d.read(&mut self.batch),
            Decoder::Parquet(d) => d.read(&mut self.batch),
        };
        read.map_err(|e| named(e, &self.path))?;
        Ok((self.batch.rows() > 0).then_some(&self.batch))
    }
}

/// Says which file an error is about.
fn named(error: ReportError, path: &Path) -> ReportError {
    match error.at(path) {
        ReportError::Mismatch(message) => ReportError::Mismatch(format!("{}: {message}", path.display())),
        error => error,
    }
}

struct CsvDecoder {
    inner: csv::Reader<BufReader<File>>,
    /// Where each wanted column stands.
    places: Vec<usize>,
    row: csv::ByteRecord,
    /// Texts met so far, shared by their cells: names of walls and fates repeat.
    texts: Vec<Arc<str>>,
}

/// Texts kept for sharing; a column of more than these is not one of names.
const TEXTS: usize = 256;

impl CsvDecoder {
    fn new(file: File, schema: &[Field]) -> Result<Self, ReportError> {
        let mut inner = csv::Reader::from_reader(BufReader::with_capacity(1 << 16, file));
        let header = inner.headers()?;
        let place = |field: &Field| {
            header
                .iter()
                .position(|name| name == field.name)
                .ok_or_else(|| ReportError::Mismatch(format!("there is no column \"{}\"", field.name)))
        };
        let places = schema.iter().map(place).collect::<Result<_, _>>()?;
        Ok(Self { inner, places, row: csv::ByteRecord::new(), texts: Vec::new() })
    }

    fn read(&mut self, batch: &mut Table) -> Result<(), ReportError> {
        for _ in 0..ROWS {
            if !self.inner.read_byte_record(&mut self.row)? {
                break;
            }
            for (column, place) in batch.columns.iter_mut().zip(&self.places) {
                let text = self.row.get(*place).unwrap_or_default();
                let cell = cell(text, column.values.kind(), &mut self.texts);
                if cell.and_then(|cell| column.values.push(cell).ok()).is_none() {
                    let line = self.row.position().map_or(0, csv::Position::line);
                    let text = String::from_utf8_lossy(text);
                    return Err(ReportError::Mismatch(format!("line {line}: '{text}' in column \"{}\"", column.name)));
                }
            }
        }
        Ok(())
    }
}

fn cell(text: &[u8], kind: Kind, texts: &mut Vec<Arc<str>>) -> Option<Cell> {
    if text.is_empty() {
        return Some(Cell::Missing);
    }
    let text = std::str::from_utf8(text).ok()?;
    match kind {
        Kind::Float => text.parse().ok().map(Cell::Float),
        Kind::Integer => text.parse().ok().map(Cell::Integer),
        Kind::Count => text.parse().ok().map(Cell::Count),
        Kind::Text => Some(Cell::Text(shared(text, texts))),
    }
}

fn shared(text: &str, texts: &mut Vec<Arc<str>>) -> Arc<str> {
    if let Some(known) = texts.iter().find(|t| &***t == text) {
        return Arc::clone(known);
    }
    let fresh: Arc<str> = text.into();
    if texts.len() < TEXTS {
        texts.push(Arc::clone(&fresh));
    }
    fresh
}
