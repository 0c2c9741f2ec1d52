//! CSV: a header of bare names, shortest digits that read back to the same number, empty for missing.

use std::io::Write;

use crate::TableError;
use crate::{Field, Table, Values};

pub(crate) struct CsvEncoder<W: Write> {
    inner: csv::Writer<W>,
    number: String,
}

impl<W: Write> CsvEncoder<W> {
    pub(crate) fn new(stream: W, schema: &[Field]) -> Result<Self, TableError> {
        let mut inner = csv::Writer::from_writer(stream);
        inner.write_record(schema.iter().map(|f| f.name.as_str()))?;
        Ok(Self { inner, number: String::new() })
    }

    pub(crate) fn write(&mut self, table: &Table) -> Result<(), TableError> {
        for row in 0..table.rows() {
            for column in table.columns() {
                self.number.clear();
                let cell = match &column.values {
                    Values::Text(v) => v[row].as_deref().unwrap_or_default(),
                    values => {
                        digits(&mut self.number, values, row);
                        &self.number
                    }
                };
                self.inner.write_field(cell)?;
            }
            self.inner.write_record(None::<&[u8]>)?;
        }
        Ok(())
    }

    pub(crate) fn finish(self) -> Result<W, TableError> {
        self.inner.into_inner().map_err(|e| TableError::Stream(e.into_error()))
    }
}

/// Debug formatting of `f64` is the shortest that reads back, with an exponent for very small and large numbers.
fn digits(out: &mut String, values: &Values, row: usize) {
    let text = match values {
        Values::Float(v) if v[row].is_nan() => return,
        Values::Float(v) => format!("{:?}", v[row]),
        Values::Integer(v) => v[row].map(|i| i.to_string()).unwrap_or_default(),
        Values::Count(v) => v[row].map(|n| n.to_string()).unwrap_or_default(),
        Values::Text(_) => return,
    };
    out.push_str(&text);
}
