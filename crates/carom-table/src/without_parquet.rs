//! A build without the feature `parquet`: the same types without a value, so that each way to one is refused by name.

use std::convert::Infallible;
use std::fs::File;
use std::io::Write;
use std::marker::PhantomData;
use std::path::PathBuf;

use crate::{Field, Schema, Table, TableError};

fn refused<T>() -> Result<T, TableError> {
    Err(TableError::Feature { path: PathBuf::from("a table"), format: "Parquet", feature: "parquet" })
}

pub(crate) struct ParquetEncoder<W> {
    none: Infallible,
    stream: PhantomData<W>,
}

impl<W: Write + Send> ParquetEncoder<W> {
    pub(crate) fn new(_: W, _: &[Field]) -> Result<Self, TableError> {
        refused()
    }
    pub(crate) fn write(&mut self, _: &Table) -> Result<(), TableError> {
        match self.none {}
    }
    pub(crate) fn finish(self) -> Result<W, TableError> {
        match self.none {}
    }
}

pub(crate) struct ParquetDecoder(Infallible);

impl ParquetDecoder {
    pub(crate) fn new(_: File, _: &[Field]) -> Result<Self, TableError> {
        refused()
    }
    pub(crate) fn read(&mut self, _: &mut Table) -> Result<(), TableError> {
        match self.0 {}
    }
}

/// A Parquet file that grows by row groups: this build writes none, so there is no value of this type.
#[derive(Debug)]
pub struct RowGroups(Infallible);

#[expect(missing_docs, reason = "as with the feature")]
#[expect(clippy::missing_errors_doc, reason = "each is refused")]
impl RowGroups {
    pub fn new(_: Schema, _: usize) -> Result<Self, TableError> {
        refused()
    }
    #[must_use]
    pub fn over(self, _: usize) -> Self {
        match self.0 {}
    }
    pub fn header(&self) -> Vec<u8> {
        match self.0 {}
    }
    pub fn take_up(_: Schema, _: usize, _: &mut File, _: u64, _: Option<Table>) -> Result<Self, TableError> {
        refused()
    }
    pub fn write(&mut self, _: &Table) -> Result<Vec<u8>, TableError> {
        match self.0 {}
    }
    pub fn pending(&self) -> &Table {
        match self.0 {}
    }
    pub fn length(&self) -> u64 {
        match self.0 {}
    }
    pub fn finish(&self) -> Result<Vec<u8>, TableError> {
        match self.0 {}
    }
}

/// A table as a whole Parquet file in memory.
///
/// # Errors
/// [`TableError::Feature`]: this build writes no Parquet.
pub fn to_parquet(_: &Table) -> Result<Vec<u8>, TableError> {
    refused()
}
