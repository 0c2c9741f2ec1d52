//! Tables of named columns with units, and their files: CSV, Parquet and JSON, whole ([`Table::write`]) or as a stream in flat
//! memory ([`TableWriter`], [`TableReader`]), and aligned text for a terminal.
//!
//! Every file is written beside its target under a temporary name and renamed when it is whole, so that an error leaves no
//! half-written file.
//!
//! ```
//! use carom_table::{Column, Table};
//!
//! let table = Table::new([
//!     Column::count("particle", [1, 2, 3]),
//!     Column::float("speed", "m/s", [0.1, 0.25, f64::NAN]),
//!     Column::text("fate", ["capture", "rebound", "rebound"]),
//! ])?;
//! assert_eq!(table.to_csv()?, "particle,speed,fate\n1,0.1,capture\n2,0.25,rebound\n3,,rebound\n");
//! # Ok::<(), carom_table::TableError>(())
//! ```
//!
//! # Features
//!
//! | feature | default | what it brings |
//! |---|---|---|
//! | `parquet` | yes | Parquet files (`parquet`); without it they are refused by name |

use std::path::Path;
use std::sync::Arc;

mod csv;
mod error;
pub mod file;
mod json;
pub mod number;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(feature = "parquet")]
mod parquet_reader;
mod reader;
#[cfg(feature = "parquet")]
mod row_groups;
mod rows;
pub mod sheet;
mod text;
mod values;
#[cfg(not(feature = "parquet"))]
mod without_parquet;
mod writer;

pub use error::TableError;
pub use number::significant;
pub use reader::TableReader;
#[cfg(feature = "parquet")]
pub use row_groups::{RowGroups, to_parquet};
pub use rows::{Row, RowReader};
pub use sheet::{Heading, Sheet, SheetError, SheetProblem};
pub use text::{clipped, column_cells, quoted};
pub use values::{Cell, Kind, Values};
#[cfg(not(feature = "parquet"))]
pub use without_parquet::{RowGroups, to_parquet};
pub use writer::{Format, TableWriter, Target};

/// A column's name, unit and kind, without values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Field {
    /// Bare name: the CSV header and JSON key.
    pub name: String,
    /// SI unit as text ("m/s"), empty for none.
    pub unit: String,
    /// Kind of value.
    pub kind: Kind,
}

impl Field {
    /// A field of the given kind.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, kind: Kind) -> Self {
        Self { name: name.into(), unit: unit.into(), kind }
    }

    /// A real-valued field.
    pub fn float(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self::new(name, unit, Kind::Float)
    }

    /// A field of signed whole numbers, without unit.
    pub fn integer(name: impl Into<String>) -> Self {
        Self::new(name, "", Kind::Integer)
    }

    /// A field of whole numbers from zero, without unit.
    pub fn count(name: impl Into<String>) -> Self {
        Self::new(name, "", Kind::Count)
    }

    /// A text field.
    pub fn text(name: impl Into<String>) -> Self {
        Self::new(name, "", Kind::Text)
    }

    /// The name with its unit, as a person reads it: "speed (m/s)".
    #[must_use]
    pub fn heading(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} ({})", self.name, self.unit) }
    }
}

/// The fields of a table, in order.
pub type Schema = Vec<Field>;

/// A named column with its unit and values.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Bare name: the CSV header and JSON key.
    pub name: String,
    /// SI unit as text ("m/s"), empty for none.
    pub unit: String,
    /// The values, one a row.
    pub values: Values,
}

impl Column {
    /// A column of real numbers, each an `f64` or an `Option<f64>`; NaN counts as missing.
    pub fn float<T: Into<Option<f64>>>(
        name: impl Into<String>,
        unit: impl Into<String>,
        values: impl IntoIterator<Item = T>,
    ) -> Self {
        let values = values.into_iter().map(|v| v.into().unwrap_or(f64::NAN)).collect();
        Self { name: name.into(), unit: unit.into(), values: Values::Float(values) }
    }

    /// A column of signed whole numbers, each an `i64` or an `Option<i64>`.
    pub fn integer<T: Into<Option<i64>>>(name: impl Into<String>, values: impl IntoIterator<Item = T>) -> Self {
        let values = values.into_iter().map(Into::into).collect();
        Self { name: name.into(), unit: String::new(), values: Values::Integer(values) }
    }

    /// A column of whole numbers from zero, each a `u64` or an `Option<u64>`.
    pub fn count<T: Into<Option<u64>>>(name: impl Into<String>, values: impl IntoIterator<Item = T>) -> Self {
        let values = values.into_iter().map(Into::into).collect();
        Self { name: name.into(), unit: String::new(), values: Values::Count(values) }
    }

    /// A column of text.
    pub fn text<T: Into<Arc<str>>>(name: impl Into<String>, values: impl IntoIterator<Item = T>) -> Self {
        Self::optional_text(name, values.into_iter().map(Some))
    }

    /// A column of text in which values may be missing.
    pub fn optional_text<T: Into<Arc<str>>>(
        name: impl Into<String>,
        values: impl IntoIterator<Item = Option<T>>,
    ) -> Self {
        let values = values.into_iter().map(|v| v.map(Into::into)).collect();
        Self { name: name.into(), unit: String::new(), values: Values::Text(values) }
    }

    /// The column's name, unit and kind.
    #[must_use]
    pub fn field(&self) -> Field {
        Field::new(&self.name, &self.unit, self.values.kind())
    }
}

/// Columns of equal length with names of their own.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    columns: Vec<Column>,
}

impl Table {
    /// Puts columns together.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where lengths differ or a name is used twice.
    pub fn new(columns: impl IntoIterator<Item = Column>) -> Result<Self, TableError> {
        let columns: Vec<Column> = columns.into_iter().collect();
        for (i, column) in columns.iter().enumerate() {
            let (first, rows) = (&columns[0], column.values.len());
            if rows != first.values.len() {
                return Err(TableError::Mismatch(format!(
                    "column \"{}\" has {rows} rows, \"{}\" has {}",
                    column.name,
                    first.name,
                    first.values.len()
                )));
            }
            if columns[..i].iter().any(|other| other.name == column.name) {
                return Err(TableError::Mismatch(format!("two columns are named \"{}\"", column.name)));
            }
        }
        Ok(Self { columns })
    }

    /// A table without rows, to be filled by [`Table::push`].
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where a name is used twice.
    pub fn with_schema(schema: &[Field]) -> Result<Self, TableError> {
        Self::new(schema.iter().map(|field| Column {
            name: field.name.clone(),
            unit: field.unit.clone(),
            values: Values::empty(field.kind),
        }))
    }

    /// The columns, in order.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The column of that name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |c| c.values.len())
    }

    /// Names, units and kinds of the columns.
    #[must_use]
    pub fn schema(&self) -> Schema {
        self.columns.iter().map(Column::field).collect()
    }

    /// Appends one row, a cell for each column.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where the number of cells or a cell's kind does not fit; the table is then as before.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) -> Result<(), TableError> {
        let row: Vec<Cell> = row.into_iter().collect();
        if row.len() != self.columns.len() {
            let (got, want) = (row.len(), self.columns.len());
            return Err(TableError::Mismatch(format!("a row of {got} cells for {want} columns")));
        }
        let before = self.rows();
        for (i, cell) in row.into_iter().enumerate() {
            if let Err(cell) = self.columns[i].values.push(cell) {
                let field = self.columns[i].field();
                self.truncate(before);
                return Err(TableError::Mismatch(format!(
                    "column \"{}\" is {:?}, not {cell:?}",
                    field.name, field.kind
                )));
            }
        }
        Ok(())
    }

    /// Appends another table's rows.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where the schemas differ.
    pub fn append(&mut self, other: &Self) -> Result<(), TableError> {
        self.append_rows(other, 0..other.rows())
    }

    /// Appends some of another table's rows, those that it has of a range.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where the schemas differ.
    pub fn append_rows(&mut self, other: &Self, rows: std::ops::Range<usize>) -> Result<(), TableError> {
        check_schema(&self.schema(), other)?;
        let rows = rows.start.min(other.rows())..rows.end.min(other.rows());
        for (column, more) in self.columns.iter_mut().zip(&other.columns) {
            column.values.extend(&more.values, rows.clone());
        }
        Ok(())
    }

    /// Removes the rows, keeps the columns (and their memory).
    pub fn clear(&mut self) {
        self.columns.iter_mut().for_each(|c| c.values.truncate(0));
    }

    /// Keeps the rows of which `keep` holds, told by their places.
    fn retain(&mut self, keep: impl Fn(usize) -> bool) {
        let kept: Vec<bool> = (0..self.rows()).map(keep).collect();
        self.columns.iter_mut().for_each(|c| c.values.retain(&kept));
    }

    fn truncate(&mut self, rows: usize) {
        self.columns.iter_mut().for_each(|c| c.values.truncate(rows));
    }

    /// Writes the table to `path` as CSV, Parquet or JSON, told by its extension.
    ///
    /// # Errors
    /// [`TableError::UnknownExtension`], or what the file system or the encoder says.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), TableError> {
        let mut writer = TableWriter::create(path, self.schema())?;
        writer.write(self)?;
        writer.finish()
    }

    /// The table with units in its columns' names, `speed (m/s)`, for a file that says its units itself.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where two names are the same then.
    pub fn headed(&self) -> Result<Self, TableError> {
        let columns = self.columns.iter().map(|column| {
            let mut column = column.clone();
            (column.name, column.unit) = (column.field().heading(), String::new());
            column
        });
        Self::new(columns)
    }

    /// The table as CSV text: one header line of bare names, then a line for each row.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn to_csv(&self) -> Result<String, TableError> {
        self.to_string_as(Format::Csv)
    }

    /// The table as JSON: an array of one object a row, values in the columns' (SI) units, missing and infinite ones null.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn to_json(&self) -> Result<String, TableError> {
        self.to_string_as(Format::Json)
    }

    fn to_string_as(&self, format: Format) -> Result<String, TableError> {
        let mut writer = TableWriter::to_stream(Vec::new(), format, self.schema())?;
        writer.write(self)?;
        let bytes = writer.finish_stream()?;
        String::from_utf8(bytes).map_err(|e| TableError::Mismatch(e.to_string()))
    }

    /// The table as aligned text for a terminal: headings with units, numbers to six digits, at the right.
    #[must_use]
    pub fn to_text(&self) -> String {
        text::render(self)
    }
}

/// Fails unless `table` has exactly the columns of `schema`.
fn check_schema(schema: &[Field], table: &Table) -> Result<(), TableError> {
    if table.columns.len() != schema.len() {
        let (got, want) = (table.columns.len(), schema.len());
        return Err(TableError::Mismatch(format!("a table of {got} columns where {want} were announced")));
    }
    for (field, column) in schema.iter().zip(&table.columns) {
        let got = column.field();
        if got != *field {
            return Err(TableError::Mismatch(format!(
                "column \"{}\" ({:?}, unit \"{}\") where \"{}\" ({:?}, unit \"{}\") was announced",
                got.name, got.kind, got.unit, field.name, field.kind, field.unit
            )));
        }
    }
    Ok(())
}
