//! Parquet: every column optional, snappy, a row group for every few tens of thousands of rows. The columns of a group are encoded side by
//! side where threads are given; the bytes are the same.

use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use bytes::Bytes;
use parquet::column::writer::{ColumnCloseResult, ColumnWriter, get_column_writer};

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::ByteArray;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterPropertiesBuilder, WriterPropertiesPtr};
use parquet::file::writer::{SerializedFileWriter, SerializedPageWriter, SerializedRowGroupWriter, TrackedWrite};
use parquet::schema::types::{ColumnDescPtr, SchemaDescriptor, Type};

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
    for column in table.columns() {
        let Some(mut writer) = group.next_column()? else { return Err(too_many()) };
        write_values(writer.untyped(), &column.values)?;
        writer.close()?;
    }
    Ok(())
}

/// The same, with columns encoded side by side over threads.
pub(crate) fn write_columns_over<W: Write + Send>(
    threads: usize,
    (schema, properties): (&SchemaDescriptor, &WriterPropertiesPtr),
    group: &mut SerializedRowGroupWriter<'_, W>,
    table: &Table,
) -> Result<(), TableError> {
    let columns = table.columns();
    let threads = threads.min(columns.len());
    if threads <= 1 {
        return write_columns(group, table);
    }
    if columns.len() != schema.num_columns() {
        return Err(too_many());
    }
    let next = AtomicUsize::new(0);
    let encode = || {
        let mut done = Vec::new();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(column) = columns.get(i) else { return Ok::<_, TableError>(done) };
            done.push((i, encoded(schema.column(i), properties, &column.values)?));
        }
    };
    let parts = std::thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(encode)).collect();
        let own = encode();
        let join =
            |other: std::thread::ScopedJoinHandle<_>| other.join().unwrap_or_else(|e| std::panic::resume_unwind(e));
        std::iter::once(own).chain(others.into_iter().map(join)).collect::<Result<Vec<_>, _>>()
    })?;
    let mut all: Vec<_> = parts.into_iter().flatten().collect();
    all.sort_unstable_by_key(|(i, _)| *i);
    for (_, (bytes, close)) in all {
        group.append_column(&bytes, close)?;
    }
    Ok(())
}

/// One column as it will stand in the file.
fn encoded(
    column: ColumnDescPtr,
    properties: &WriterPropertiesPtr,
    values: &Values,
) -> Result<(Bytes, ColumnCloseResult), TableError> {
    let mut sink = TrackedWrite::new(Vec::new());
    let pages = Box::new(SerializedPageWriter::new(&mut sink));
    let mut writer = get_column_writer(column, Arc::clone(properties), pages);
    write_values(&mut writer, values)?;
    let close = writer.close()?;
    Ok((sink.into_inner()?.into(), close))
}

fn too_many() -> TableError {
    TableError::Mismatch("more columns than the Parquet schema has".to_owned())
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

fn write_values(column: &mut ColumnWriter<'_>, values: &Values) -> Result<(), TableError> {
    let other = || TableError::Mismatch("a column of another type than the Parquet schema has".to_owned());
    match (values, column) {
        (Values::Float(v), ColumnWriter::DoubleColumnWriter(column)) => {
            let (levels, present) = split(v, |x| (!x.is_nan()).then_some(*x));
            column.write_batch(&present, Some(&levels), None)?;
        }
        (Values::Integer(v), ColumnWriter::Int64ColumnWriter(column)) => {
            let (levels, present) = split(v, |i| *i);
            column.write_batch(&present, Some(&levels), None)?;
        }
        (Values::Count(v), ColumnWriter::Int64ColumnWriter(column)) => {
            // The unsigned logical type stores the same 64 bits.
            let (levels, present) = split(v, |n| n.map(u64::cast_signed));
            column.write_batch(&present, Some(&levels), None)?;
        }
        (Values::Text(v), ColumnWriter::ByteArrayColumnWriter(column)) => {
            let (levels, present) = split(v, |s| s.as_deref().map(ByteArray::from));
            column.write_batch(&present, Some(&levels), None)?;
        }
        _ => return Err(other()),
    }
    Ok(())
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
