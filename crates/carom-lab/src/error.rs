//! What can be wrong with an experiment's files, the data of a fit, or the report's folder.

use carom::LawError;
use carom_report::{ReportError, TableError};
use std::path::PathBuf;

/// Why a validation or a fit stops.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LabError {
    /// An experiment's text is wrong; the text comes along so that the place can be shown.
    #[error("{}", .error.located(.name, .text))]
    Experiment {
        /// Name of the file.
        name: String,
        /// Its text.
        text: String,
        /// What is wrong, where.
        error: LawError,
    },
    /// A computed wind tunnel's walls, laws and injections do not match.
    #[error(transparent)]
    Tunnel(#[from] carom_track::tracker::TrackerError),
    /// A file of points is wrong: the message names file, line and value.
    #[error("{0}")]
    Points(String),
    /// A file of points or of laws is wrong, with the place in its text.
    #[error("{}", .error.located(.name, .text))]
    Data {
        /// Name of the file.
        name: String,
        /// Its text.
        text: String,
        /// What is wrong, where.
        error: Box<LawError>,
    },
    /// What was asked of a fit makes no sense for its law or its data.
    #[error("{0}")]
    Fit(LawError),
    /// A file or folder cannot be read or written.
    #[error("{}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The report could not be drawn or written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A table could not be built or written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A model refused an impact that the lab asked for.
    #[error("{0}")]
    Model(String),
}
