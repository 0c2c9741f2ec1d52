//! Files, compressed or not.

use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::header::{Format, Header};
use super::scan::Scan;
use crate::Error;

/// A file's bytes, unpacked.
pub(super) struct Loaded {
    pub(super) path: PathBuf,
    pub(super) bytes: Vec<u8>,
}

/// Reads `path`, or `path.gz`; nothing where there is neither.
pub(super) fn load(path: &Path) -> Result<Option<Loaded>, Error> {
    let packed = with_gz(path);
    for path in [path, &packed] {
        match std::fs::read(path) {
            Ok(bytes) => return unpacked(path.to_owned(), bytes).map(Some),
            Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {}
            Err(e) => return Err(Error::io(path, e)),
        }
    }
    Ok(None)
}

/// Whether there is `path`, or `path.gz`.
pub(super) fn is_there(path: &Path) -> bool {
    path.is_file() || with_gz(path).is_file()
}

/// The first bytes of a file, unpacked: enough for a header.
pub(super) fn beginning(path: &Path) -> Option<Vec<u8>> {
    let mut raw = Vec::new();
    let mut file = std::fs::File::open(path).ok()?;
    file.by_ref().take(4096).read_to_end(&mut raw).ok()?;
    if !raw.starts_with(&[0x1f, 0x8b]) {
        return Some(raw);
    }
    let mut text = vec![0; 4096];
    let mut unpacker = flate2::read::MultiGzDecoder::new(raw.as_slice());
    let mut len = 0;
    while let Ok(n @ 1..) = unpacker.read(&mut text[len..]) {
        len += n;
    }
    text.truncate(len);
    Some(text)
}

fn with_gz(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".gz");
    name.into()
}

fn unpacked(path: PathBuf, bytes: Vec<u8>) -> Result<Loaded, Error> {
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok(Loaded { path, bytes });
    }
    let mut out = Vec::new();
    match flate2::read::MultiGzDecoder::new(bytes.as_slice()).read_to_end(&mut out) {
        Ok(_) => Ok(Loaded { path, bytes: out }),
        Err(e) => Err(Error::io(&path, e)),
    }
}

/// A file of one part of a case: what its header says, and what follows it.
pub(super) struct Contents<'a> {
    pub(super) path: &'a Path,
    /// The part's number, where there are several in a file.
    pub(super) block: Option<usize>,
    pub(super) bytes: &'a [u8],
    pub(super) start: usize,
    pub(super) format: Format,
    pub(super) class: &'a str,
}

impl<'a> Contents<'a> {
    /// Reads from behind the header, and says in which file a fault is.
    pub(super) fn read<T>(
        &self,
        read: impl FnOnce(&mut Scan<'a>) -> Result<T, super::error::Fault>,
    ) -> Result<T, Error> {
        let mut scan = Scan::new(self.bytes);
        scan.at = self.start;
        read(&mut scan).map_err(|fault| self.error(fault))
    }

    pub(super) fn error(&self, mut fault: super::error::Fault) -> Error {
        if let Some(block) = self.block {
            fault.what = format!("processor {block}: {}", fault.what);
        }
        Scan::error(self.bytes, self.path, fault)
    }
}

/// The header of a file, which must have one.
pub(super) fn header(path: &Path, bytes: &[u8]) -> Result<Header, Error> {
    let header = Header::read(bytes).map_err(|fault| Scan::error(bytes, path, fault))?;
    header.ok_or_else(|| Error::file(path, "no OpenFOAM file: it does not begin with a header `FoamFile { … }`"))
}

/// The parts of a file in blocks (`decomposedBlockData`).
pub(super) fn blocks(file: &Loaded) -> Result<Vec<&[u8]>, Error> {
    let outer = header(&file.path, &file.bytes)?;
    if outer.class != "decomposedBlockData" {
        let what = format!("a {} where blocks of several processors were expected", outer.class);
        return Err(Error::file(&file.path, what));
    }
    let mut scan = Scan::new(&file.bytes);
    scan.at = outer.end;
    let mut found = Vec::new();
    while scan.peek().is_some() {
        let block = scan
            .count()
            .and_then(|len| if len == 0 { Ok([].as_slice()) } else { super::list::block(&mut scan, Some(len)) });
        found.push(block.map_err(|fault| Scan::error(&file.bytes, &file.path, fault))?);
    }
    Ok(found)
}

/// The class of what a file holds, by its first bytes; of a file in blocks, of the first block.
pub(super) fn class(bytes: &[u8]) -> Option<String> {
    let outer = Header::read(bytes).ok()??;
    if outer.class != "decomposedBlockData" {
        return Some(outer.class);
    }
    let rest = &bytes[outer.end..];
    let inner = rest.windows(8).position(|w| w == b"FoamFile")?;
    Header::read(&rest[inner..]).ok()?.map(|h| h.class)
}
