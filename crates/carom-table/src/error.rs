//! What can go wrong between a table and its file.

use std::io;
use std::path::{Path, PathBuf};

/// An error in building, reading or writing a table.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The path's extension names no format known for this kind of file.
    #[error("{path}: cannot tell the format from the extension; known are {known}", path = .path.display())]
    UnknownExtension {
        /// The path as given.
        path: PathBuf,
        /// The known extensions, for the message.
        known: &'static str,
    },
    /// The format is known, but this build was made without it.
    #[error("{path}: this build writes no {format}; build it with the feature `{feature}`", path = .path.display())]
    Feature {
        /// The path as given.
        path: PathBuf,
        /// The format.
        format: &'static str,
        /// The feature that brings it.
        feature: &'static str,
    },
    /// The file could not be created, written or renamed.
    #[error("{path}: {source}", path = .path.display())]
    File {
        /// The target path.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// Writing to a stream failed.
    #[error(transparent)]
    Stream(#[from] io::Error),
    /// The CSV encoder failed.
    #[error("CSV: {0}")]
    Csv(#[from] csv::Error),
    /// The JSON encoder failed.
    #[error("JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// The Parquet encoder failed.
    #[cfg(feature = "parquet")]
    #[error("Parquet: {0}")]
    Parquet(#[from] parquet::errors::ParquetError),
    /// Columns, rows or arrays that belong together do not match in length, name or kind.
    #[error("{0}")]
    Mismatch(String),
}

impl TableError {
    /// Puts the target's path on an error that came from writing to it.
    #[must_use]
    pub fn at(self, path: &Path) -> Self {
        let source = match self {
            Self::Stream(source) => source,
            Self::Csv(e) if e.is_io_error() => e.into(),
            Self::Json(e) if e.is_io() => e.into(),
            #[cfg(feature = "parquet")]
            Self::Parquet(e) => io::Error::other(e),
            other => return other,
        };
        Self::File { path: path.to_path_buf(), source }
    }
}
