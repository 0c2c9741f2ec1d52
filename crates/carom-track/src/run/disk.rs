//! What a run asks of the file system beyond reading and writing: the points at which things must be on disk. One layer, so
//! that a test can cut the power between any two of them.

use super::RunError;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The operations that tell what a power cut would leave.
pub(crate) trait Disk: Sync {
    /// Appends bytes to an open file.
    fn append(&self, file: &mut File, path: &Path, bytes: &[u8]) -> io::Result<()>;
    /// What was written to a file stays.
    fn sync(&self, file: &File, path: &Path) -> io::Result<()>;
    /// What was created, renamed and removed in a folder stays so.
    fn sync_folder(&self, folder: &Path) -> io::Result<()>;
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;
    fn remove(&self, path: &Path) -> io::Result<()>;
}

/// The machine's own.
pub(crate) struct Machine;

impl Disk for Machine {
    fn append(&self, file: &mut File, _: &Path, bytes: &[u8]) -> io::Result<()> {
        file.write_all(bytes)
    }

    fn sync(&self, file: &File, _: &Path) -> io::Result<()> {
        file.sync_all()
    }

    fn sync_folder(&self, folder: &Path) -> io::Result<()> {
        // elsewhere a folder cannot be opened, and renaming is journalled
        if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        std::fs::rename(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        std::fs::remove_file(path)
    }
}

/// What a file that is not yet in place is called.
pub(super) const UNFINISHED: &str = "new";

/// Puts a whole file in place in one stroke, on disk when this returns.
pub(super) fn replace(disk: &dyn Disk, folder: &Path, name: &str, bytes: &[u8]) -> Result<(), RunError> {
    let (path, fresh) = (folder.join(name), folder.join(format!("{name}.{UNFINISHED}")));
    create(disk, &fresh, bytes)?;
    disk.rename(&fresh, &path).and_then(|()| disk.sync_folder(folder)).map_err(RunError::io(&path))
}

/// Writes a file, on disk when this returns but for its name.
pub(super) fn create(disk: &dyn Disk, path: &Path, bytes: &[u8]) -> Result<(), RunError> {
    let mut file = File::create(path).map_err(RunError::io(path))?;
    disk.append(&mut file, path, bytes).and_then(|()| disk.sync(&file, path)).map_err(RunError::io(path))
}

/// Removes a file that may not be there.
pub(super) fn remove(disk: &dyn Disk, path: &Path) -> Result<(), RunError> {
    match disk.remove(path) {
        Err(e) if e.kind() != ErrorKind::NotFound => Err(RunError::io(path)(e)),
        _ => Ok(()),
    }
}

/// Whether a path still names an open file.
pub(super) fn same_file(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt as _;
        let id = |m: std::fs::Metadata| (m.dev(), m.ino());
        matches!((file.metadata().map(id), std::fs::metadata(path).map(id)), (Ok(a), Ok(b)) if a == b)
    }
    #[cfg(not(unix))]
    {
        matches!((file.metadata(), std::fs::metadata(path)), (Ok(a), Ok(b)) if a.len() == b.len())
    }
}

/// The file by which a run tells others that a folder is taken.
const LOCK: &str = ".carom-lock";

/// A folder that belongs to one run until this is dropped.
#[derive(Debug)]
pub(super) struct Lock {
    _file: File,
    path: PathBuf,
}

impl Lock {
    /// Takes a folder; says so where the file system has no locks.
    pub fn take(folder: &Path, note: &dyn Fn(&str)) -> Result<Self, RunError> {
        let path = folder.join(LOCK);
        loop {
            let error = |e| RunError::io(&path)(e);
            let mut options = OpenOptions::new();
            let file = options.create(true).truncate(false).write(true).open(&path).map_err(error)?;
            match file.try_lock() {
                // one that was just removed is no lock
                Ok(()) if same_file(&file, &path) => return Ok(Self { _file: file, path }),
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Err(RunError::Busy { folder: folder.to_owned() }),
                Err(TryLockError::Error(e)) if e.kind() == ErrorKind::Unsupported => {
                    note(&format!("{}: this file system has no locks; start no second run into it", folder.display()));
                    return Ok(Self { _file: file, path });
                }
                Err(TryLockError::Error(e)) => return Err(error(e)),
            }
        }
    }

    /// Whether a run has a folder.
    pub fn is_taken(folder: &Path) -> bool {
        let file = File::open(folder.join(LOCK));
        file.is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // while it is still held; where it cannot be removed, the next run takes it as it is
        let _ = std::fs::remove_file(&self.path);
    }
}
