//! The header of a file: how its numbers are written, and what it holds.

use super::dictionary::Dict;
use super::error::{Fault, fault};
use super::scan::Scan;

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Format {
    pub(super) binary: bool,
    /// Bytes of a whole number.
    pub(super) label: usize,
    /// Bytes of a number.
    pub(super) scalar: usize,
}

/// A file's header.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) class: String,
    /// Where what follows begins.
    pub(super) end: usize,
}

impl Header {
    /// Reads the header that a file begins with; none where it begins otherwise.
    pub(super) fn read(bytes: &[u8]) -> Result<Option<Self>, Fault> {
        let mut scan = Scan::new(bytes);
        scan.space();
        if !scan.rest().starts_with(b"FoamFile") {
            return Ok(None);
        }
        scan.at += 8;
        scan.expect(b'{')?;
        let start = scan.at;
        let ascii = Format { binary: false, label: 4, scalar: 8 };
        let dict = Dict::within(&mut scan, ascii)?;
        let text = |key: &str| dict.text(key).map(|t| t.into_owned());
        // of files in blocks, what the blocks hold is said by names of their own since v2012
        let format = text("format").or_else(|| text("data.format"));
        let mut format = match format.as_deref() {
            None | Some("ascii") => ascii,
            Some("binary") => Format { binary: true, ..ascii },
            Some(other) => return Err(fault(start, format!("the format `{other}` is neither ascii nor binary"))),
        };
        if let Some(arch) = text("arch") {
            for part in arch.split(';') {
                match part.split_once('=') {
                    None if part == "MSB" && format.binary => {
                        return Err(fault(start, "its numbers have their high bytes first (MSB), which is not read"));
                    }
                    Some(("label", "32")) => format.label = 4,
                    Some(("label", "64")) => format.label = 8,
                    Some(("scalar", "32")) => format.scalar = 4,
                    Some(("scalar", "64")) => format.scalar = 8,
                    Some((what @ ("label" | "scalar"), bits)) => {
                        return Err(fault(start, format!("a {what} of {bits} bits is not read")));
                    }
                    _ => {}
                }
            }
        }
        Ok(Some(Self { format, class: text("class").unwrap_or_default(), end: scan.at }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_says_how_numbers_are_written() {
        let text = b"/* x */\nFoamFile\n{ version 2.0; format binary; class volScalarField; arch \"LSB;label=64;scalar=32\"; }\n//\n3";
        let h = Header::read(text).unwrap().unwrap();
        assert_eq!(h.format, Format { binary: true, label: 8, scalar: 4 });
        assert_eq!(h.class, "volScalarField");
        assert_eq!(&text[h.end..], b"\n//\n3");
        assert!(Header::read(b"3((0 0 0))").unwrap().is_none());
    }

    #[test]
    fn what_is_not_read_is_refused() {
        for arch in ["MSB;label=32;scalar=64", "LSB;label=16;scalar=64", "LSB;label=32;scalar=128"] {
            let text = format!("FoamFile {{ format binary; arch \"{arch}\"; }}");
            assert!(Header::read(text.as_bytes()).is_err(), "{arch}");
        }
        assert!(Header::read(b"FoamFile { format hex; }").is_err());
        assert!(Header::read(b"FoamFile { format ascii;").is_err());
    }
}
