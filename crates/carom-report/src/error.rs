//! What can go wrong between a plot or report and its file.

use carom_table::TableError;

/// An error in drawing a plot or writing a report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The table or the file behind it.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The drawing could not be rendered.
    #[error("cannot draw {what}: {reason}")]
    Draw {
        /// What was being drawn.
        what: String,
        /// Why it failed.
        reason: String,
    },
}

#[cfg(feature = "png")]
impl ReportError {
    pub(crate) fn draw(what: &str, reason: impl ToString) -> Self {
        Self::Draw { what: what.to_owned(), reason: reason.to_string() }
    }
}
