//! Reading a table's file as a stream of batches, for the columns that are wanted.

use std::borrow::Cow;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::TableError;
#[cfg(feature = "parquet")]
use crate::parquet_reader::ParquetDecoder;
use crate::rows::{Row, RowReader};
#[cfg(not(feature = "parquet"))]
use crate::without_parquet::ParquetDecoder;
use crate::{Cell, Field, Format, Kind, Schema, Table};

/// Reads some columns of a CSV or Parquet file, a batch of rows at a time; memory stays flat.
///
/// ```
/// use carom_table::{Column, Field, Table, TableReader, Values};
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
    sample: Sample,
}

/// Which rows are taken: one in so many, told by a hash of their numbers, so that it is the same ones every time and no
/// period of the table shows.
#[derive(Clone, Copy)]
struct Sample {
    one_in: u64,
    /// The number of the next row.
    next: u64,
}

impl Sample {
    /// Whether a row so far ahead is taken.
    fn takes(self, ahead: u64) -> bool {
        self.one_in <= 1 || scrambled(self.next.wrapping_add(ahead)).is_multiple_of(self.one_in)
    }
}

/// SplitMix64's finalizer (Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195).
fn scrambled(n: u64) -> u64 {
    let z = n.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
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
    /// [`TableError::UnknownExtension`] (JSON is not read), [`TableError::File`], and [`TableError::Mismatch`] for a
    /// column that the file lacks or that is of another kind.
    pub fn open(path: impl AsRef<Path>, schema: Schema) -> Result<Self, TableError> {
        let path = path.as_ref();
        let format = Format::from_path(path)?;
        let file = File::open(path).map_err(|e| TableError::Stream(e).at(path))?;
        let decoder = match format {
            Format::Csv => CsvDecoder::new(file, &schema).map(|d| Decoder::Csv(Box::new(d))),
            Format::Parquet => ParquetDecoder::new(file, &schema).map(|d| Decoder::Parquet(Box::new(d))),
            Format::Json => Err(TableError::UnknownExtension { path: path.to_path_buf(), known: ".csv and .parquet" }),
        };
        let decoder = decoder.map_err(|e| named(e, path))?;
        Ok(Self {
            path: path.to_path_buf(),
            batch: Table::with_schema(&schema)?,
            decoder,
            sample: Sample { one_in: 1, next: 0 },
        })
    }

    /// Takes one row in so many only, chosen as if by chance but the same every time.
    #[must_use]
    pub fn one_in(mut self, rows: u64) -> Self {
        self.sample.one_in = rows;
        self
    }

    /// The next rows, in the order of the file; `None` after the last.
    ///
    /// # Errors
    /// [`TableError::File`], and [`TableError::Mismatch`] for a cell that is not of its column's kind.
    pub fn next_batch(&mut self) -> Result<Option<&Table>, TableError> {
        let mut more = true;
        self.batch.clear();
        while more && self.batch.rows() == 0 {
            let read = match &mut self.decoder {
                Decoder::Csv(d) => d.read(&mut self.batch, &mut self.sample).map(|()| false),
                Decoder::Parquet(d) => d.read(&mut self.batch).map(|()| {
                    let (rows, sample) = (self.batch.rows(), self.sample);
                    if sample.one_in > 1 {
                        self.batch.retain(|row| sample.takes(row as u64));
                    }
                    self.sample.next += rows as u64;
                    rows > 0
                }),
            };
            more = read.map_err(|e| named(e, &self.path))?;
        }
        Ok((self.batch.rows() > 0).then_some(&self.batch))
    }
}

/// Says which file an error is about.
fn named(error: TableError, path: &Path) -> TableError {
    match error.at(path) {
        TableError::Mismatch(message) => TableError::Mismatch(format!("{}: {message}", path.display())),
        error => error,
    }
}

struct CsvDecoder {
    rows: RowReader<File>,
    /// For each column of the file, which wanted one it is.
    wanted: Vec<Option<usize>>,
    /// Wanted columns.
    count: usize,
    /// Texts met so far, shared by their cells: names of walls and fates repeat.
    texts: Vec<Arc<str>>,
}

/// Texts kept for sharing; a column of more than these is not one of names.
const TEXTS: usize = 256;

impl CsvDecoder {
    fn new(file: File, schema: &[Field]) -> Result<Self, TableError> {
        let mut rows = RowReader::new(file);
        let header: Vec<Cow<[u8]>> = rows.next_row()?.map_or_else(Vec::new, |row| row.fields().map(owned).collect());
        let mut wanted = vec![None; header.len()];
        for (column, field) in schema.iter().enumerate() {
            let place = header.iter().position(|name| **name == *field.name.as_bytes());
            let place = place.and_then(|p| wanted.get_mut(p));
            *place.ok_or_else(|| TableError::Mismatch(format!("there is no column \"{}\"", field.name)))? =
                Some(column);
        }
        // what stands behind the last wanted column need not be split off
        while wanted.last().is_some_and(Option::is_none) {
            wanted.pop();
        }
        Ok(Self { rows, wanted, count: schema.len(), texts: Vec::new() })
    }

    fn read(&mut self, batch: &mut Table, sample: &mut Sample) -> Result<(), TableError> {
        let mut taken = 0;
        while taken < ROWS {
            let Some(row) = self.rows.next_row()? else { break };
            let takes = sample.takes(0);
            sample.next += 1;
            if !takes {
                continue;
            }
            if let Err(bad) = push(row, &self.wanted, self.count, &mut self.texts, batch) {
                return Err(TableError::Mismatch(format!("line {}: {bad}", self.rows.line())));
            }
            taken += 1;
        }
        Ok(())
    }
}

fn owned(field: Cow<[u8]>) -> Cow<'static, [u8]> {
    Cow::Owned(field.into_owned())
}

/// Appends the wanted cells of a row; says what is wrong with it.
fn push(
    row: Row,
    wanted: &[Option<usize>],
    count: usize,
    texts: &mut Vec<Arc<str>>,
    batch: &mut Table,
) -> Result<(), String> {
    let mut pushed = 0;
    for (text, column) in row.fields().zip(wanted) {
        let Some(column) = column.and_then(|c| batch.columns.get_mut(c)) else { continue };
        let cell = cell(&text, column.values.kind(), texts);
        if cell.and_then(|cell| column.values.push(cell).ok()).is_none() {
            return Err(format!("'{}' in column \"{}\"", String::from_utf8_lossy(&text), column.name));
        }
        pushed += 1;
    }
    if pushed == count { Ok(()) } else { Err("the row is cut short".to_owned()) }
}

fn cell(text: &[u8], kind: Kind, texts: &mut Vec<Arc<str>>) -> Option<Cell> {
    if text.is_empty() {
        return Some(Cell::Missing);
    }
    // much of a table of shares is zero
    if kind == Kind::Float && text == b"0.0" {
        return Some(Cell::Float(0.0));
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
