//! A file that a run appends to.

use super::disk::{Disk, same_file};
use super::{Remedy, RunError};
use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// An open file and its length.
pub(super) struct Stream {
    path: PathBuf,
    file: File,
    length: u64,
    /// Something was written since it was last on disk.
    dirty: bool,
}

impl Stream {
    /// A file that is whole up to a length, what is behind it dropped; a new one, of length 0, gets a header.
    pub fn open(path: &Path, header: &[u8], length: u64, disk: &dyn Disk) -> Result<Self, RunError> {
        let error = RunError::io(path);
        let mut options = OpenOptions::new();
        let fresh = length == 0;
        let file = options.create(fresh).write(true).truncate(fresh).open(path).map_err(&error)?;
        if file.metadata().map_err(&error)?.len() < length {
            return Err(RunError::foreign_but(path, "shorter than the checkpoint says", Remedy::Force));
        }
        file.set_len(length).map_err(&error)?;
        let mut stream = Self { path: path.to_owned(), file, length, dirty: false };
        stream.seek_end()?;
        if fresh {
            stream.append(header, disk)?;
        }
        Ok(stream)
    }

    pub fn seek_end(&mut self) -> Result<(), RunError> {
        self.file.seek(SeekFrom::End(0)).map(|_| ()).map_err(RunError::io(&self.path))
    }

    pub fn append(&mut self, bytes: &[u8], disk: &dyn Disk) -> Result<(), RunError> {
        if !bytes.is_empty() {
            disk.append(&mut self.file, &self.path, bytes).map_err(RunError::io(&self.path))?;
            self.length += bytes.len() as u64;
            self.dirty = true;
        }
        Ok(())
    }

    /// What was written is on disk, in a file that still has its name.
    pub fn sync(&mut self, disk: &dyn Disk) -> Result<(), RunError> {
        if !same_file(&self.file, &self.path) {
            return Err(RunError::Gone { path: self.path.clone() });
        }
        if self.dirty {
            disk.sync(&self.file, &self.path).map_err(RunError::io(&self.path))?;
            self.dirty = false;
        }
        Ok(())
    }

    pub fn length(&self) -> u64 {
        self.length
    }
}
