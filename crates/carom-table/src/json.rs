//! JSON: an array of one object a row. JSON has no infinity, so it is null as NaN is.

use std::io::Write;

use crate::TableError;
use crate::{Field, Table, Values};

pub(crate) struct JsonEncoder<W: Write> {
    stream: W,
    keys: Vec<String>,
    rows: u64,
}

impl<W: Write> JsonEncoder<W> {
    pub(crate) fn new(stream: W, schema: &[Field]) -> Result<Self, TableError> {
        let keys = schema.iter().map(|f| serde_json::to_string(&f.name)).collect::<Result<_, _>>()?;
        Ok(Self { stream, keys, rows: 0 })
    }

    pub(crate) fn write(&mut self, table: &Table) -> Result<(), TableError> {
        for row in 0..table.rows() {
            self.stream.write_all(if self.rows == 0 { b"[\n{" } else { b",\n{" })?;
            for (i, (key, column)) in self.keys.iter().zip(table.columns()).enumerate() {
                if i > 0 {
                    self.stream.write_all(b",")?;
                }
                write!(self.stream, "{key}:")?;
                match &column.values {
                    Values::Float(v) => serde_json::to_writer(&mut self.stream, &v[row])?,
                    Values::Integer(v) => serde_json::to_writer(&mut self.stream, &v[row])?,
                    Values::Count(v) => serde_json::to_writer(&mut self.stream, &v[row])?,
                    Values::Text(v) => serde_json::to_writer(&mut self.stream, &v[row].as_deref())?,
                }
            }
            self.stream.write_all(b"}")?;
            self.rows += 1;
        }
        Ok(())
    }

    pub(crate) fn finish(mut self) -> Result<W, TableError> {
        self.stream.write_all(if self.rows == 0 { b"[]\n" } else { b"\n]\n" })?;
        self.stream.flush()?;
        Ok(self.stream)
    }
}
