//! Parquet: every column optional, snappy, a row group for every few tens of thousands of rows.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterPropertiesBuilder};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use crate::TableError;
use crate::{Field, Kind, Table, Values};

/// Rows gathered before they become a row group: enough to compress well, about 10 MB for twenty columns.
const GROUP: usize = 1 << 16;

pub(crate) struct ParquetEncoder<W: Write + Send> {
    inner: SerializedFileWriter<W>,
    pending: Table,
}

impl<W: Write + Send> ParquetEncoder<W> {
    pub(crate) fn new(stream: W, schema: &[Field]) -> Result<Self, TableError> {
        let inner = SerializedFileWriter::new(stream, root(schema)?, Arc::new(properties(schema).build()))?;
        Ok(Self { inner, pending: Table::with_schema(schema)? })
    }

    pub(crate) fn write(&mut self, table: &Table) -> Result<(), TableError> {
        self.pending.append(table)?;
        if self.pending.rows() >= GROUP { self.write_group() } else { Ok(()) }
    }

    fn write_group(&mut self) -> Result<(), TableError> {
        let mut group = self.inner.next_row_group()?;
        write_columns(&mut group, &self.pending)?;
        group.close()?;
        self.pending.clear();
        Ok(())
    }

    pub(crate) fn finish(mut self) -> Result<W, TableError> {
        if self.pending.rows() > 0 {
            self.write_group()?;
        }
        Ok(self.inner.into_inner()?)
    }
}

/// The schema as Parquet has it.
pub(crate) fn root(schema: &[Field]) -> Result<Arc<Type>, TableError> {
    let fields = schema.iter().map(|f| parquet_field(f).map(Arc::new)).collect::<Result<_, _>>()?;
    Ok(Arc::new(Type::group_type_builder("schema").with_fields(fields).build()?))
}

pub(crate) const CREATED_BY: &str = concat!("carom ", env!("CARGO_PKG_VERSION"));

/// The units, as the file's metadata tell them.
pub(crate) fn units(schema: &[Field]) -> Vec<KeyValue> {
    let units: serde_json::Map<_, _> =
        schema.iter().filter(|f| !f.unit.is_empty()).map(|f| (f.name.clone(), f.unit.clone().into())).collect();
    vec![KeyValue::new("units".to_owned(), serde_json::Value::Object(units).to_string())]
}

/// How all files are written.
pub(crate) fn properties(schema: &[Field]) -> WriterPropertiesBuilder {
    WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(CREATED_BY.to_owned())
        .set_key_value_metadata(Some(units(schema)))
}

/// Writes all rows of a table as one row group.
pub(crate) fn write_columns<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    table: &Table,
) -> Result<(), TableError> {
    table.columns().iter().try_for_each(|column| write_column(group, &column.values))
}

fn parquet_field(field: &Field) -> Result<Type, TableError> {
    let (physical, logical) = match field.kind {
        Kind::Float => (Physical::DOUBLE, None),
        Kind::Integer => (Physical::INT64, Some(LogicalType::integer(64, true))),
        Kind::Count => (Physical::INT64, Some(LogicalType::integer(64, false))),
        Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    Ok(Type::primitive_type_builder(&field.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()?)
}

fn write_column<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &Values,
) -> Result<(), TableError> {
    let Some(mut column) = group.next_column()? else {
        return Err(TableError::Mismatch("more columns than the Parquet schema has".to_owned()));
    };
    match values {
        Values::Float(v) => {
            let (levels, present) = split(v, |x| (!x.is_nan()).then_some(*x));
            column.typed::<DoubleType>().write_batch(&present, Some(&levels), None)?;
        }
        Values::Integer(v) => {
            let (levels, present) = split(v, |i| *i);
            column.typed::<Int64Type>().write_batch(&present, Some(&levels), None)?;
        }
        Values::Count(v) => {
            // The unsigned logical type stores the same 64 bits.
            let (levels, present) = split(v, |n| n.map(u64::cast_signed));
            column.typed::<Int64Type>().write_batch(&present, Some(&levels), None)?;
        }
        Values::Text(v) => {
            let (levels, present) = split(v, |s| s.as_deref().map(ByteArray::from));
            column.typed::<ByteArrayType>().write_batch(&present, Some(&levels), None)?;
        }
    }
    Ok(column.close()?)
}

/// Definition levels (1 present, 0 null) and the present values.
fn split<T, P>(values: &[T], present: impl Fn(&T) -> Option<P>) -> (Vec<i16>, Vec<P>) {
    let mut levels = Vec::with_capacity(values.len());
    let mut kept = Vec::with_capacity(values.len());
    for value in values {
        let value = present(value);
        levels.push(i16::from(value.is_some()));
        kept.extend(value);
    }
    (levels, kept)
}
