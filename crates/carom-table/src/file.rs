//! Files that appear whole or not at all.

use std::ffi::OsStr;
use std::io::{self, BufWriter, Read, Write};
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

/// What is in a regular file of at most `largest` bytes: a device or a pipe may never end, and a pipe may never begin.
///
/// # Errors
/// What cannot be read, is no regular file, or is larger.
pub fn read_regular(path: &Path, largest: u64) -> io::Result<Vec<u8>> {
    let about = std::fs::metadata(path)?;
    let unfit = |what: String| io::Error::new(io::ErrorKind::InvalidInput, what);
    if about.is_dir() {
        return Err(unfit("a folder; name a file".to_owned()));
    }
    if !about.is_file() {
        return Err(unfit("not a regular file, but a device or a pipe; save it to a file first".to_owned()));
    }
    let mut bytes = Vec::new();
    // it may grow meanwhile
    std::fs::File::open(path)?.take(largest.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > largest {
        return Err(io::Error::other(format!(
            "larger than {} MiB, the most that is read of such a file",
            largest >> 20
        )));
    }
    Ok(bytes)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_are_read_and_no_more_of_them_than_asked() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.csv");
        std::fs::write(&file, "12345").unwrap();
        assert_eq!(read_regular(&file, 5).unwrap(), b"12345");
        let refused = |path: &Path, largest| read_regular(path, largest).unwrap_err().to_string();
        assert!(refused(&file, 4).contains("larger than"));
        assert!(refused(folder.path(), 5).contains("a folder"));
        #[cfg(unix)]
        {
            assert!(refused(Path::new("/dev/zero"), 5).contains("not a regular file"));
            let pipe = folder.path().join("pipe");
            let made = std::process::Command::new("mkfifo").arg(&pipe).status();
            if made.is_ok_and(|s| s.success()) {
                assert!(refused(&pipe, 5).contains("not a regular file"));
            }
        }
    }
}
