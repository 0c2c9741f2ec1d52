//! Files that appear whole or not at all.

use std::ffi::OsStr;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::TableError;

/// A file written under a temporary name beside its target; [`NewFile::commit`] renames it,
/// dropping it before that removes it.
pub(crate) struct NewFile {
    target: PathBuf,
    inner: BufWriter<NamedTempFile>,
}

impl NewFile {
    pub(crate) fn create(target: &Path) -> Result<Self, TableError> {
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".carom-").suffix(".part");
        // tempfile's own default is private to the user; a result is a plain file under the umask.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let file =
            builder.tempfile_in(folder).map_err(|source| TableError::File { path: target.to_path_buf(), source })?;
        Ok(Self { target: target.to_path_buf(), inner: BufWriter::new(file) })
    }

    pub(crate) fn commit(self) -> Result<(), TableError> {
        let Self { target, inner } = self;
        let fail = |source| TableError::File { path: target.clone(), source };
        let file = inner.into_inner().map_err(|e| fail(e.into_error()))?;
        file.persist(&target).map_err(|e| fail(e.error))?;
        Ok(())
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.inner.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

/// Writes `bytes` to `target`, whole or not at all.
///
/// # Errors
/// A place that cannot be written.
pub fn write_whole(target: &Path, bytes: &[u8]) -> Result<(), TableError> {
    let mut file = NewFile::create(target)?;
    file.write_all(bytes).map_err(|e| TableError::from(e).at(target))?;
    file.commit()
}

/// Writes a text file, whole or not at all.
///
/// # Errors
/// A place that cannot be written.
pub fn write_text(target: &Path, text: &str) -> Result<(), TableError> {
    write_whole(target, text.as_bytes())
}

/// The path's extension in lower case, empty when there is none.
pub fn extension(path: &Path) -> String {
    path.extension().and_then(OsStr::to_str).unwrap_or_default().to_ascii_lowercase()
}
