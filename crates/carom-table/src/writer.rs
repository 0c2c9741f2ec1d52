//! Formats, and writing a table as a stream.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::TableError;
use crate::csv::CsvEncoder;
use crate::file::{self, NewFile};
use crate::json::JsonEncoder;
#[cfg(feature = "parquet")]
use crate::parquet::ParquetEncoder;
#[cfg(not(feature = "parquet"))]
use crate::without_parquet::ParquetEncoder;
use crate::{Schema, Table, check_schema};

/// A file format for tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated: a header of bare names, empty for a missing value.
    Csv,
    /// Apache Parquet: typed and nullable, snappy, units as a JSON object under the file's key `units`.
    Parquet,
    /// JSON: an array of one object a row, null for a missing value.
    Json,
}

impl Format {
    /// Whether this build reads and writes the format.
    #[must_use]
    pub fn is_built(self) -> bool {
        self != Self::Parquet || cfg!(feature = "parquet")
    }

    /// The format told by a path's extension: `.csv`, `.parquet` or `.json`.
    ///
    /// # Errors
    /// [`TableError::UnknownExtension`], naming the known ones; [`TableError::Feature`] where this build has no Parquet.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, TableError> {
        match file::extension(path.as_ref()).as_str() {
            "csv" => Ok(Self::Csv),
            "parquet" if Self::Parquet.is_built() => Ok(Self::Parquet),
            "parquet" => {
                let path = path.as_ref().to_path_buf();
                Err(TableError::Feature { path, format: "Parquet", feature: "parquet" })
            }
            "json" => Ok(Self::Json),
            _ => Err(TableError::UnknownExtension {
                path: path.as_ref().to_path_buf(),
                known: ".csv, .parquet and .json",
            }),
        }
    }
}

enum Encoder<W: Write + Send> {
    Csv(Box<CsvEncoder<W>>),
    Json(JsonEncoder<W>),
    Parquet(Box<ParquetEncoder<W>>),
}

/// Writes tables of one schema one after the other into one file; memory stays flat.
///
/// Nothing is at the target path until [`TableWriter::finish`]; a writer dropped before leaves no file.
///
/// ```
/// use carom_table::{Cell, Field, Table, TableWriter};
///
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("impacts.csv");
/// let schema = vec![Field::count("particle"), Field::float("time", "s"), Field::text("wall")];
/// let mut block = Table::with_schema(&schema)?;
/// let mut writer = TableWriter::create(&path, schema)?;
/// for particle in 0..3_u64 {
///     block.clear();
///     block.push([particle.into(), 0.5.into(), Cell::from("floor")])?;
///     writer.write(&block)?;
/// }
/// writer.finish()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct TableWriter<W: Write + Send = Target> {
    schema: Schema,
    encoder: Encoder<W>,
    /// Where the file will be, for messages.
    path: Option<PathBuf>,
}

/// The file of a [`TableWriter`] made by [`TableWriter::create`].
pub struct Target(NewFile);

impl Write for Target {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.0.flush()
    }
}

impl TableWriter<Target> {
    /// Starts a file in the format told by the path's extension.
    ///
    /// # Errors
    /// [`TableError::UnknownExtension`], [`TableError::Mismatch`] for a name used twice, or what the file system says.
    pub fn create(path: impl AsRef<Path>, schema: Schema) -> Result<Self, TableError> {
        let path = path.as_ref();
        let format = Format::from_path(path)?;
        let mut writer = Self::to_stream(Target(NewFile::create(path)?), format, schema).map_err(|e| e.at(path))?;
        writer.path = Some(path.to_path_buf());
        Ok(writer)
    }

    /// Completes the file and puts it at its path.
    ///
    /// # Errors
    /// What the file system or the encoder says; no file is then left.
    pub fn finish(self) -> Result<(), TableError> {
        self.finish_stream()?.0.commit()
    }
}

impl<W: Write + Send> TableWriter<W> {
    /// Starts a stream (standard output, a buffer) in a given format.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] for a name used twice, or what the encoder says.
    pub fn to_stream(stream: W, format: Format, schema: Schema) -> Result<Self, TableError> {
        Table::with_schema(&schema)?;
        let encoder = match format {
            Format::Csv => Encoder::Csv(Box::new(CsvEncoder::new(stream, &schema)?)),
            Format::Json => Encoder::Json(JsonEncoder::new(stream, &schema)?),
            Format::Parquet => Encoder::Parquet(Box::new(ParquetEncoder::new(stream, &schema)?)),
        };
        Ok(Self { schema, encoder, path: None })
    }

    /// Appends a table's rows.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where the table has another schema, or what the encoder says.
    pub fn write(&mut self, table: &Table) -> Result<(), TableError> {
        check_schema(&self.schema, table)?;
        let written = match &mut self.encoder {
            Encoder::Csv(e) => e.write(table),
            Encoder::Json(e) => e.write(table),
            Encoder::Parquet(e) => e.write(table),
        };
        written.map_err(|e| on_path(e, self.path.as_deref()))
    }

    /// Completes the stream and hands it back.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn finish_stream(self) -> Result<W, TableError> {
        let finished = match self.encoder {
            Encoder::Csv(e) => e.finish(),
            Encoder::Json(e) => e.finish(),
            Encoder::Parquet(e) => e.finish(),
        };
        finished.map_err(|e| on_path(e, self.path.as_deref()))
    }
}

fn on_path(error: TableError, path: Option<&Path>) -> TableError {
    match path {
        Some(path) => error.at(path),
        None => error,
    }
}
