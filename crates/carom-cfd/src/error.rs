//! What can be wrong with a result's files.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a result cannot be read or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file or folder cannot be read.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file does not hold what it should.
    #[error("{}: {what}", Spot(path, *line))]
    File {
        /// Which.
        path: PathBuf,
        /// The line, where there are lines.
        line: Option<usize>,
        /// What is wrong.
        what: String,
    },
    /// Something asked for is not there.
    #[error("{}: no {kind} `{name}`; there {} {}", path.display(), if there.len() == 1 { "is" } else { "are" }, listed(there))]
    Missing {
        /// Where it was looked for.
        path: PathBuf,
        /// What kind of thing: a time, a field.
        kind: &'static str,
        /// What was asked for.
        name: String,
        /// What is there.
        there: Vec<String>,
    },
    /// The mesh cannot be used.
    #[error("the mesh cannot be used: {0}")]
    Mesh(#[from] crate::check::Broken),
}

impl Error {
    /// A file or folder cannot be read.
    pub fn io(path: &Path, source: io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }

    /// A file does not hold what it should.
    pub fn file(path: &Path, what: impl Into<String>) -> Self {
        Self::File { path: path.to_owned(), line: None, what: what.into() }
    }
}

struct Spot<'a>(&'a Path, Option<usize>);

impl fmt::Display for Spot<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0.display())?;
        self.1.map_or(Ok(()), |line| write!(f, ":{line}"))
    }
}

/// Names one after the other; of many, the first and the last.
pub(crate) fn listed(names: &[String]) -> String {
    match names {
        [] => "none".into(),
        all if all.len() <= 24 => all.join(", "),
        all => format!("{} … {}", all[..12].join(", "), all[all.len() - 6..].join(", ")),
    }
}
