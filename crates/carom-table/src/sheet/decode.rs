//! Bytes to text, and what is no text.

use std::borrow::Cow;

const KNOWN: [(&[u8], &str); 8] = [
    (b"PK\x03\x04", "an Excel workbook or another archive: save it as CSV"),
    (b"\xd0\xcf\x11\xe0", "an old Excel workbook: save it as CSV"),
    (b"\x89HDF", "an HDF5 file (a CGNS or Fluent case): export a table of points from it, as CSV"),
    (b"PAR1", "a Parquet file: give it the ending .parquet, or save it as CSV"),
    (
        b"<?xml",
        "an XML file: of VTK's, .vti and .vtr are read by their endings; save a mesh as one of them after Resample To Image",
    ),
    (
        b"<VTKFile",
        "a VTK file: .vti and .vtr are read by their endings; save a mesh as one of them after Resample To Image",
    ),
    (b"# vtk DataFile", "a VTK file: give it the ending .vtk"),
    (b"\x1f\x8b", "a compressed file: unpack it first"),
];

/// The text of a file: UTF-8, UTF-16 by its mark, else Latin-1.
///
/// # Errors
/// What the file is instead of a text.
pub fn text(bytes: &[u8]) -> Result<Cow<'_, str>, &'static str> {
    if let Some((_, what)) = KNOWN.iter().find(|(mark, _)| bytes.starts_with(mark)) {
        return Err(what);
    }
    let wide = |read: fn([u8; 2]) -> u16, bytes: &[u8]| {
        let units: Vec<u16> = bytes.as_chunks::<2>().0.iter().map(|b| read(*b)).collect();
        Cow::Owned(String::from_utf16_lossy(&units))
    };
    let text = match bytes {
        [0xff, 0xfe, rest @ ..] => wide(u16::from_le_bytes, rest),
        [0xfe, 0xff, rest @ ..] => wide(u16::from_be_bytes, rest),
        _ => {
            let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
            match std::str::from_utf8(bytes) {
                Ok(text) => Cow::Borrowed(text),
                Err(_) => Cow::Owned(bytes.iter().map(|b| char::from(*b)).collect()),
            }
        }
    };
    if text.bytes().take(4096).any(|b| b == 0) {
        return Err("not a text: it has bytes of zero");
    }
    Ok(text)
}
