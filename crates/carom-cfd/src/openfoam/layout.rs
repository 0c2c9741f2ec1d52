//! Where a case keeps its files: in one piece, or in a part for each processor.

use std::path::{Path, PathBuf};

use super::files::{self, Contents, Loaded};
use super::header::Header;
use super::scan::Scan;
use crate::Error;

/// One way in which a case is stored.
#[derive(Debug)]
pub(super) struct Layout {
    pub(super) store: Store,
    /// Its time folders, by time.
    pub(super) times: Vec<Time>,
}

#[derive(Debug)]
pub(super) enum Store {
    /// In one piece.
    Whole(PathBuf),
    /// A folder for each processor.
    Folders(Vec<PathBuf>),
    /// Folders whose files hold blocks of several processors.
    Blocks(Vec<PathBuf>),
}

/// A time folder.
#[derive(Clone, Debug)]
pub(super) struct Time {
    pub(super) name: String,
    pub(super) value: f64,
}

impl Layout {
    /// All ways in which a case is stored.
    pub(super) fn all(case: &Path) -> Result<Vec<Self>, Error> {
        let (mut folders, mut blocks) = (Vec::new(), Vec::new());
        for name in names(case)? {
            let path = case.join(&name);
            if let Some(n) = name.strip_prefix("processors") {
                let (total, part) = n.split_once('_').unwrap_or((n, "0-"));
                let first = part.split('-').next().and_then(|n| n.parse::<usize>().ok());
                if let (Ok(total), Some(first)) = (total.parse::<usize>(), first) {
                    blocks.push((total, first, path));
                }
            } else if let Some(n) = name.strip_prefix("processor").and_then(|n| n.parse::<usize>().ok()) {
                folders.push((n, path));
            }
        }
        let mut found = vec![Self::new(Store::Whole(case.to_owned()))?];
        folders.sort();
        if !folders.is_empty() {
            if let Some(missing) = (0..folders.len()).find(|i| folders[*i].0 != *i) {
                let what = format!("there are folders of {} processors, and none of processor{missing}", folders.len());
                return Err(Error::file(case, what));
            }
            found.push(Self::new(Store::Folders(folders.into_iter().map(|f| f.1).collect()))?);
        }
        blocks.sort();
        for group in blocks.chunk_by(|a, b| a.0 == b.0) {
            found.push(Self::new(Store::Blocks(group.iter().map(|b| b.2.clone()).collect()))?);
        }
        Ok(found)
    }

    fn new(store: Store) -> Result<Self, Error> {
        let mut times: Vec<_> = names(store.first())?.into_iter().filter_map(Time::of).collect();
        times.sort_by(|a, b| a.value.total_cmp(&b.value).then_with(|| a.name.cmp(&b.name)));
        Ok(Self { store, times })
    }

    /// Whether there is a mesh.
    pub(super) fn has_mesh(&self) -> bool {
        let mesh = |folder: &str| files::is_there(&self.store.first().join(folder).join("polyMesh/faces"));
        mesh("constant") || self.times.iter().any(|t| mesh(&t.name))
    }

    /// The folder, seen from a part's, of the newest file of a mesh up to a time.
    pub(super) fn newest(&self, file: &str, until: Option<f64>) -> String {
        let root = self.store.first();
        let before = self.times.iter().rev().filter(|t| until.is_none_or(|u| t.value <= u));
        let found =
            before.map(|t| t.name.as_str()).find(|t| files::is_there(&root.join(t).join("polyMesh").join(file)));
        format!("{}/polyMesh", found.unwrap_or("constant"))
    }

    /// Reads a file of every part, in order. Says whether there was one; where only some parts have it, that is an error.
    pub(super) fn each(
        &self,
        file: &str,
        mut read: impl FnMut(usize, &Contents<'_>) -> Result<(), Error>,
    ) -> Result<bool, Error> {
        match &self.store {
            Store::Whole(case) => match files::load(&case.join(file))? {
                Some(loaded) => whole(&loaded, |contents| read(0, contents)).map(|()| true),
                None => Ok(false),
            },
            Store::Folders(folders) => {
                for (i, folder) in folders.iter().enumerate() {
                    match files::load(&folder.join(file))? {
                        Some(loaded) => whole(&loaded, |contents| read(i, contents))?,
                        None if i == 0 => return Ok(false),
                        None => {
                            return Err(Error::file(&folder.join(file), "is not there, and other processors have it"));
                        }
                    }
                }
                Ok(true)
            }
            Store::Blocks(folders) => {
                let mut part = 0;
                for folder in folders {
                    let Some(loaded) = files::load(&folder.join(file))? else {
                        if part == 0 {
                            return Ok(false);
                        }
                        return Err(Error::file(&folder.join(file), "is not there, and other processors have it"));
                    };
                    in_blocks(&loaded, &mut part, &mut read)?;
                }
                Ok(true)
            }
        }
    }
}

impl Store {
    /// The folder that shows what there is.
    pub(super) fn first(&self) -> &Path {
        match self {
            Self::Whole(folder) => folder,
            Self::Folders(folders) | Self::Blocks(folders) => &folders[0],
        }
    }
}

impl Time {
    fn of(name: String) -> Option<Self> {
        let number = name.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
        let value = name.parse().ok().filter(|v: &f64| number && v.is_finite())?;
        Some(Self { name, value })
    }
}

/// Names of what lies in a folder.
pub(super) fn names(folder: &Path) -> Result<Vec<String>, Error> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(|e| Error::io(folder, e))? {
        let entry = entry.map_err(|e| Error::io(folder, e))?;
        names.extend(entry.file_name().into_string());
    }
    names.sort();
    Ok(names)
}

fn whole(file: &Loaded, read: impl FnOnce(&Contents<'_>) -> Result<(), Error>) -> Result<(), Error> {
    let header = files::header(&file.path, &file.bytes)?;
    read(&Contents {
        path: &file.path,
        block: None,
        bytes: &file.bytes,
        start: header.end,
        format: header.format,
        class: &header.class,
    })
}

fn in_blocks(
    file: &Loaded,
    part: &mut usize,
    read: &mut impl FnMut(usize, &Contents<'_>) -> Result<(), Error>,
) -> Result<(), Error> {
    // the first block says for all how they are written
    let mut common: Option<Header> = None;
    for bytes in files::blocks(file)? {
        let own = Header::read(bytes).map_err(|fault| Scan::error(bytes, &file.path, fault))?;
        let start = own.as_ref().map_or(0, |h| h.end);
        let header = own.or(common.take()).ok_or_else(|| Error::file(&file.path, "its first block has no header"))?;
        let (format, class) = (header.format, header.class.as_str());
        read(*part, &Contents { path: &file.path, block: Some(*part), bytes, start, format, class })?;
        common = Some(header);
        *part += 1;
    }
    Ok(())
}
