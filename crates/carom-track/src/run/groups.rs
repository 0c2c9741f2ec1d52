//! A Parquet table that grows while the run goes on.

use super::disk::{Disk, create};
use super::stream::Stream;
use super::{Remedy, RunError};
use crate::record::columns::{Column, Columns, NO_WORD};
use crate::tables::{Layout, What, Words};
use carom_table::{RowGroups, Schema, Table, TableReader};
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// Rows of a row group: enough to compress well, few enough to be held; 10⁹ rows make some 7 600 of them. Tests want
/// several in a small table.
const GROUP: usize = if cfg!(test) { 700 } else { 1 << 17 };

/// The file and what is to come into it.
pub(super) struct Groups {
    stream: Stream,
    groups: RowGroups,
    texts: HashMap<(What, u32), Arc<str>>,
}

impl Groups {
    /// Columns are encoded over so many threads.
    pub fn over(self, threads: usize) -> Self {
        Self { groups: self.groups.over(threads), ..self }
    }

    /// A new file, or one that is whole up to a length; then `rest` is the file with the rows that waited.
    pub fn open(
        layout: &Layout,
        path: &Path,
        length: u64,
        rest: Option<&Path>,
        disk: &dyn Disk,
    ) -> Result<Self, RunError> {
        let fresh = RowGroups::new(layout.schema(), GROUP)?;
        let mut stream = Stream::open(path, &fresh.header(), length, disk)?;
        let groups = if length == 0 {
            fresh
        } else {
            let rest = rest.map(|path| read(path, layout.schema())).transpose()?;
            let mut file = std::fs::File::open(path).map_err(RunError::io(path))?;
            let taken = RowGroups::take_up(layout.schema(), GROUP, &mut file, length, rest);
            taken.map_err(|e| RunError::foreign_but(path, e.to_string(), Remedy::Force))?
        };
        stream.seek_end()?;
        Ok(Self { stream, groups, texts: HashMap::new() })
    }

    pub fn put(&mut self, layout: &Layout, words: &Words, columns: Columns, disk: &dyn Disk) -> Result<(), RunError> {
        let table = self.table(layout, words, columns)?;
        self.put_table(&table, disk)
    }

    pub fn put_table(&mut self, table: &Table, disk: &dyn Disk) -> Result<(), RunError> {
        let bytes = self.groups.write(table)?;
        self.stream.append(&bytes, disk)
    }

    /// Records as a table with words.
    fn table(&mut self, layout: &Layout, words: &Words, columns: Columns) -> Result<Table, RunError> {
        let columns =
            columns.into_columns().into_iter().zip(layout.columns).map(|(column, (name, unit, what))| match column {
                Column::Count(v) => carom_table::Column::count(*name, v),
                Column::Float(v) => carom_table::Column::float(*name, *unit, v),
                Column::Word(codes) if *what == What::Cell => {
                    let cell = |code: u32| (code != NO_WORD).then_some(u64::from(code));
                    carom_table::Column::count(*name, codes.into_iter().map(cell))
                }
                Column::Word(codes) => {
                    let word = |code: u32| {
                        let text = self.texts.entry((*what, code)).or_insert_with(|| words.text(*what, code).into());
                        (!text.is_empty()).then(|| Arc::clone(text))
                    };
                    carom_table::Column::optional_text(*name, codes.into_iter().map(word))
                }
            });
        Ok(Table::new(columns.collect::<Vec<_>>())?)
    }

    /// Puts on disk what is written, and the rows that wait for a group into a file of that name; whether there are any.
    pub fn checkpoint(&mut self, rest: &Path, disk: &dyn Disk) -> Result<bool, RunError> {
        self.stream.sync(disk)?;
        let waiting = self.groups.pending().rows() > 0;
        if waiting {
            create(disk, rest, &carom_table::to_parquet(self.groups.pending())?)?;
        }
        Ok(waiting)
    }

    /// Writes the rest.
    pub fn finish(&mut self, disk: &dyn Disk) -> Result<(), RunError> {
        let bytes = self.groups.finish()?;
        self.stream.append(&bytes, disk)?;
        self.stream.sync(disk)
    }

    pub fn length(&self) -> u64 {
        self.stream.length()
    }
}

/// All rows of a Parquet file.
fn read(path: &Path, schema: Schema) -> Result<Table, RunError> {
    let mut all = Table::with_schema(&schema)?;
    let mut reader = TableReader::open(path, schema)?;
    while let Some(batch) = reader.next_batch()? {
        all.append(batch)?;
    }
    Ok(all)
}
