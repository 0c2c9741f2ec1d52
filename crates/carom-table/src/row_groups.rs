//! A Parquet file that grows by row groups of a fixed number of rows and can be taken up again after an interruption.
//!
//! Readers find the groups of a Parquet file by the footer at its end, which is written last: a file that was cut short has
//! none. Here each group is followed by a footer of its own, that of a file with this group alone, and the footer's length.
//! Readers never look there, and from any place where a group's record ends all groups before it are found again, backwards.
//! Bytes depend on the rows only, not on how they came.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::sync::Arc;

use parquet::file::metadata::{
    FileMetaData, ParquetMetaData, ParquetMetaDataReader, ParquetMetaDataWriter, RowGroupMetaData,
};
use parquet::file::properties::{EnabledStatistics, WriterPropertiesPtr};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{SchemaDescPtr, SchemaDescriptor};

use crate::parquet::{CREATED_BY, properties, root, units, write_columns_over};
use crate::{Schema, Table, TableError};

const MAGIC: &[u8] = b"PAR1";

/// The state of such a file; who owns it appends the bytes.
///
/// ```
/// use carom_table::{Column, RowGroups, Table, TableReader};
/// use std::io::Write;
///
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("speeds.parquet");
/// let table = Table::new([Column::float("speed", "m/s", [0.5, 1.0, 2.0])])?;
/// let mut groups = RowGroups::new(table.schema(), 2)?;
/// let mut file = std::fs::File::create(&path)?;
/// file.write_all(&groups.header())?;
/// file.write_all(&groups.write(&table)?)?;
/// assert_eq!(groups.pending().rows(), 1);
/// file.write_all(&groups.finish()?)?;
/// let mut reader = TableReader::open(&path, table.schema())?;
/// assert_eq!(reader.next_batch()?.map(Table::rows), Some(2));
/// assert_eq!(reader.next_batch()?.map(Table::rows), Some(1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct RowGroups {
    schema: Schema,
    descriptor: SchemaDescPtr,
    properties: WriterPropertiesPtr,
    rows: usize,
    groups: Vec<RowGroupMetaData>,
    length: u64,
    pending: Table,
    threads: usize,
}

impl RowGroups {
    /// An empty file of groups of so many rows.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] for a name used twice.
    pub fn new(schema: Schema, rows: usize) -> Result<Self, TableError> {
        let root = root(&schema)?;
        // of a page, statistics would only swell the memory that the metadata of many groups take
        let properties = properties(&schema).set_statistics_enabled(EnabledStatistics::Chunk).build();
        Ok(Self {
            descriptor: Arc::new(SchemaDescriptor::new(root)),
            properties: Arc::new(properties),
            rows: rows.max(1),
            groups: Vec::new(),
            length: MAGIC.len() as u64,
            pending: Table::with_schema(&schema)?,
            threads: 1,
            schema,
        })
    }

    /// The same, its columns encoded over so many threads; the bytes are the same.
    #[must_use]
    pub fn over(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// What the file begins with.
    pub fn header(&self) -> Vec<u8> {
        MAGIC.to_vec()
    }

    /// Takes up a file of so many bytes, which end with a group or the header, and the rows that no group held yet.
    ///
    /// # Errors
    /// What the file system says, and [`TableError::Mismatch`] where it is no such file.
    pub fn take_up(
        schema: Schema,
        rows: usize,
        file: &mut File,
        length: u64,
        pending: Option<Table>,
    ) -> Result<Self, TableError> {
        let mut this = Self::new(schema, rows)?;
        let damaged = || TableError::Mismatch("the row groups are damaged".to_owned());
        let mut end = length;
        while end > MAGIC.len() as u64 {
            let mut size = [0; 4];
            let at = end.checked_sub(4).ok_or_else(damaged)?;
            file.seek(SeekFrom::Start(at))?;
            file.read_exact(&mut size)?;
            let at = at.checked_sub(u64::from(u32::from_le_bytes(size))).ok_or_else(damaged)?;
            file.seek(SeekFrom::Start(at))?;
            let mut footer = vec![0; u32::from_le_bytes(size) as usize];
            file.read_exact(&mut footer)?;
            let group = only_group(&footer)?;
            let start = group.columns().iter().map(|c| c.byte_range().0).min().ok_or_else(damaged)?;
            if start >= end || group.num_rows() != this.rows as i64 {
                return Err(damaged());
            }
            this.groups.push(group);
            end = start;
        }
        if end != MAGIC.len() as u64 && length != 0 {
            return Err(damaged());
        }
        this.groups.reverse();
        // ordinals count from the file's beginning
        this.length = length;
        if let Some(pending) = pending {
            this.pending.append(&pending)?;
        }
        Ok(this)
    }

    /// Takes rows; what is to be appended to the file for the groups they fill.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where the table has another schema, or what the encoder says.
    pub fn write(&mut self, table: &Table) -> Result<Vec<u8>, TableError> {
        let (mut bytes, mut next) = (Vec::new(), 0);
        loop {
            let room = self.rows - self.pending.rows();
            self.pending.append_rows(table, next..next + room)?;
            next = (next + room).min(table.rows());
            if self.pending.rows() < self.rows {
                return Ok(bytes);
            }
            self.close_group(&mut bytes)?;
        }
    }

    /// The rows that no group holds yet.
    pub fn pending(&self) -> &Table {
        &self.pending
    }

    /// Bytes of the file so far, those handed out included.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The rest of the file: a group of the rows that are left, and the footer. Nothing is changed.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn finish(&self) -> Result<Vec<u8>, TableError> {
        let mut bytes = Vec::new();
        let mut groups = self.groups.clone();
        if self.pending.rows() > 0 {
            let (data, group) = self.encode()?;
            bytes = data;
            groups.push(group);
        }
        bytes.extend(self.footer(groups)?);
        Ok(bytes)
    }

    fn close_group(&mut self, bytes: &mut Vec<u8>) -> Result<(), TableError> {
        let (mut data, group) = self.encode()?;
        let footer = self.footer(vec![group])?;
        let size = u32::try_from(footer.len()).map_err(|_| TableError::Mismatch("a footer too long".to_owned()))?;
        data.extend(&footer);
        data.extend(size.to_le_bytes());
        // as it will be read when the file is taken up: what metadata say may change on the way through a footer
        self.groups.push(only_group(&footer)?);
        self.length += data.len() as u64;
        bytes.extend(data);
        self.pending.clear();
        Ok(())
    }

    /// The pending rows as a group, and its metadata with places in the whole file.
    fn encode(&self) -> Result<(Vec<u8>, RowGroupMetaData), TableError> {
        let mut alone =
            SerializedFileWriter::new(Vec::new(), self.descriptor.root_schema_ptr(), Arc::clone(&self.properties))?;
        let mut group = alone.next_row_group()?;
        write_columns_over(self.threads, (&self.descriptor, &self.properties), &mut group, &self.pending)?;
        group.close()?;
        alone.flush()?;
        let [metadata] = alone.flushed_row_groups() else {
            return Err(TableError::Mismatch("not one row group".to_owned()));
        };
        let metadata = self.moved(metadata)?;
        let data = alone.inner().get(MAGIC.len()..).map(<[u8]>::to_vec).unwrap_or_default();
        Ok((data, metadata))
    }

    /// Metadata of a group that stood right behind a file's header, for one that stands at the end of this file.
    fn moved(&self, group: &RowGroupMetaData) -> Result<RowGroupMetaData, TableError> {
        let by = self.length as i64 - MAGIC.len() as i64;
        let columns = group.columns().iter().map(|column| {
            let dictionary = column.dictionary_page_offset().map(|at| at + by);
            let data = column.data_page_offset() + by;
            column
                .clone()
                .into_builder()
                .set_data_page_offset(data)
                .set_dictionary_page_offset(dictionary)
                .set_column_index_offset(None)
                .set_column_index_length(None)
                .set_offset_index_offset(None)
                .set_offset_index_length(None)
                .build()
        });
        let columns = columns.collect::<Result<Vec<_>, _>>()?;
        let ordinal = i32::try_from(self.groups.len()).unwrap_or(i32::MAX);
        let moved = group.clone().into_builder().set_column_metadata(columns).set_ordinal(ordinal);
        Ok(moved.set_file_offset(self.length as i64).build()?)
    }

    /// The footer of a file of these groups.
    fn footer(&self, groups: Vec<RowGroupMetaData>) -> Result<Vec<u8>, TableError> {
        let rows = groups.iter().map(RowGroupMetaData::num_rows).sum();
        let units = Some(units(&self.schema));
        let file = FileMetaData::new(1, rows, Some(CREATED_BY.to_owned()), units, Arc::clone(&self.descriptor), None);
        let mut bytes = Vec::new();
        ParquetMetaDataWriter::new(&mut bytes, &ParquetMetaData::new(file, groups)).finish()?;
        Ok(bytes)
    }
}

/// The one group that a footer is of.
fn only_group(footer: &[u8]) -> Result<RowGroupMetaData, TableError> {
    // the last eight bytes are the footer's own length and the magic
    let thrift = footer.get(..footer.len().saturating_sub(8)).unwrap_or_default();
    let found = ParquetMetaDataReader::decode_metadata(thrift)?;
    let group = found.row_groups().first().cloned();
    group.ok_or_else(|| TableError::Mismatch("a footer without a row group".to_owned()))
}

/// The rows of a whole Parquet file held in memory: what [`RowGroups::take_up`] is to be given back.
///
/// # Errors
/// What the encoder says.
pub fn to_parquet(table: &Table) -> Result<Vec<u8>, TableError> {
    let groups = RowGroups { pending: table.clone(), ..RowGroups::new(table.schema(), usize::MAX)? };
    Ok([groups.header(), groups.finish()?].concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Column, TableReader, Values};
    use std::io::Write;

    fn table(rows: std::ops::Range<u64>) -> Table {
        let words = ["floor", "ceiling", "a, b"];
        Table::new([
            Column::count("particle", rows.clone()),
            Column::float("speed", "m/s", rows.clone().map(|i| if i % 7 == 0 { f64::NAN } else { i as f64 / 3.0 })),
            Column::text("wall", rows.map(|i| words[i as usize % 3])),
        ])
        .unwrap()
    }

    #[test]
    fn however_rows_come_and_wherever_the_file_is_taken_up_the_bytes_are_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let mut files = Vec::new();
        for (name, step, stop) in [
            ("whole", 1000, None),
            ("bits", 7, None),
            ("again", 7, Some(420)),
            ("edge", 50, Some(500)),
            ("threads", 30, None),
        ] {
            let path = folder.path().join(name).with_extension("parquet");
            let mut file = File::create_new(&path).unwrap();
            let mut groups = RowGroups::new(table(0..0).schema(), 100).unwrap();
            if name == "threads" {
                groups = groups.over(2);
            }
            file.write_all(&groups.header()).unwrap();
            for from in (0..1000).step_by(step as usize) {
                if stop == Some(from) {
                    let pending = groups.pending().clone();
                    let length = groups.length();
                    // half a group more than is known of
                    file.write_all(&[7; 1234]).unwrap();
                    let mut old = File::open(&path).unwrap();
                    groups = RowGroups::take_up(table(0..0).schema(), 100, &mut old, length, Some(pending)).unwrap();
                    file.set_len(length).unwrap();
                    file.seek(SeekFrom::End(0)).unwrap();
                }
                let bytes = groups.write(&table(from..(from + step).min(1000))).unwrap();
                file.write_all(&bytes).unwrap();
                assert!(groups.pending().rows() < 100);
            }
            file.write_all(&groups.finish().unwrap()).unwrap();
            let mut reader = TableReader::open(&path, table(0..0).schema()).unwrap();
            let mut all = table(0..0);
            while let Some(batch) = reader.next_batch().unwrap() {
                all.append(batch).unwrap();
            }
            assert_eq!(all.rows(), 1000);
            let wanted = table(0..1000);
            let bits = |t: &Table| match &t.columns()[1].values {
                Values::Float(v) => v.iter().map(|x| x.to_bits()).collect::<Vec<_>>(),
                other => panic!("{other:?}"),
            };
            assert_eq!(bits(&all), bits(&wanted));
            assert_eq!(all.columns()[2], wanted.columns()[2]);
            files.push(std::fs::read(&path).unwrap());
        }
        assert!(files.iter().all(|f| *f == files[0]));
    }

    #[test]
    fn a_file_that_is_damaged_is_not_taken_up() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("damaged.parquet");
        let mut groups = RowGroups::new(table(0..0).schema(), 10).unwrap();
        let whole = [groups.header(), groups.write(&table(0..30)).unwrap()].concat();
        for (length, flip) in [(whole.len() - 1, None), (3, None), (whole.len(), Some(whole.len() - 3))] {
            let mut bytes = whole[..length].to_vec();
            if let Some(flip) = flip {
                bytes[flip] ^= 0x55;
            }
            std::fs::write(&path, &bytes).unwrap();
            let mut file = File::open(&path).unwrap();
            assert!(RowGroups::take_up(table(0..0).schema(), 10, &mut file, length as u64, None).is_err());
        }
    }
}
