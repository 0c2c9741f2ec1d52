//! Parquet, read a row group at a time.

use std::fs::File;
use std::sync::Arc;

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::file::reader::{FileReader, SerializedFileReader};

use crate::TableError;
use crate::{Field, Table, Values};

pub(crate) struct ParquetDecoder {
    inner: SerializedFileReader<File>,
    places: Vec<usize>,
    next: usize,
}

impl ParquetDecoder {
    pub(crate) fn new(file: File, schema: &[Field]) -> Result<Self, TableError> {
        let inner = SerializedFileReader::new(file)?;
        let columns = inner.metadata().file_metadata().schema_descr().columns();
        let place = |field: &Field| {
            columns
                .iter()
                .position(|c| c.name() == field.name)
                .ok_or_else(|| TableError::Mismatch(format!("there is no column \"{}\"", field.name)))
        };
        let places = schema.iter().map(place).collect::<Result<_, _>>()?;
        Ok(Self { inner, places, next: 0 })
    }

    /// The next row group that has rows.
    pub(crate) fn read(&mut self, batch: &mut Table) -> Result<(), TableError> {
        while batch.rows() == 0 && self.next < self.inner.num_row_groups() {
            let group = self.inner.get_row_group(self.next)?;
            let rows = usize::try_from(group.metadata().num_rows()).unwrap_or_default();
            for (column, place) in batch.columns.iter_mut().zip(&self.places) {
                fill(group.get_column_reader(*place)?, rows, &mut column.values)
                    .map_err(|e| other_kind(e, &column.name))?;
                if column.values.len() != rows {
                    return Err(TableError::Mismatch(format!("column \"{}\" is cut short", column.name)));
                }
            }
            self.next += 1;
        }
        Ok(())
    }
}

enum Problem {
    Kind,
    Parquet(parquet::errors::ParquetError),
}

impl From<parquet::errors::ParquetError> for Problem {
    fn from(error: parquet::errors::ParquetError) -> Self {
        Self::Parquet(error)
    }
}

fn other_kind(problem: Problem, name: &str) -> TableError {
    match problem {
        Problem::Kind => TableError::Mismatch(format!("column \"{name}\" is of another kind")),
        Problem::Parquet(e) => e.into(),
    }
}

fn fill(reader: ColumnReader, rows: usize, values: &mut Values) -> Result<(), Problem> {
    match (reader, values) {
        (ColumnReader::DoubleColumnReader(r), Values::Float(v)) => {
            column(r, rows, |x| v.push(x.copied().unwrap_or(f64::NAN)))
        }
        (ColumnReader::Int64ColumnReader(r), Values::Integer(v)) => column(r, rows, |i| v.push(i.copied())),
        (ColumnReader::Int64ColumnReader(r), Values::Count(v)) => {
            column(r, rows, |n| v.push(n.map(|n| n.cast_unsigned())))
        }
        (ColumnReader::ByteArrayColumnReader(r), Values::Text(v)) => {
            let mut last: Option<Arc<str>> = None;
            column(r, rows, |bytes| {
                let text = bytes.map(|b| String::from_utf8_lossy(b.data()));
                // a run of one name shares its text
                if last.as_deref() != text.as_deref() {
                    last = text.map(|t| Arc::from(&*t));
                }
                v.push(last.clone());
            })
        }
        _ => Err(Problem::Kind),
    }
}

/// Hands on a column's values, absent ones too, in order.
fn column<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    mut each: impl FnMut(Option<&T::T>),
) -> Result<(), Problem> {
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    let mut done = 0;
    while done < rows {
        levels.clear();
        values.clear();
        let (read, _, _) = reader.read_records(rows - done, Some(&mut levels), None, &mut values)?;
        if read == 0 {
            break;
        }
        let mut present = values.iter();
        levels.iter().for_each(|level| each(if *level > 0 { present.next() } else { None }));
        done += read;
    }
    Ok(())
}
