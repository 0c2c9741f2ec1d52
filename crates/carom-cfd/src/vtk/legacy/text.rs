//! Arrays of texts in legacy files. In ASCII each has a line and is written as in addresses of the web; in binary files each follows its length.

use super::{Array, Problem, Reader};

impl Array<'_> {
    /// Whether it is of texts.
    pub fn is_text(&self) -> bool {
        is_text(self.kind)
    }
}

/// Whether values of that type are texts.
pub(super) fn is_text(kind: &str) -> bool {
    kind.eq_ignore_ascii_case("string") || kind.eq_ignore_ascii_case("utf8_string")
}

impl<'a> Reader<'a> {
    /// Texts of cells.
    pub fn text_arrays(&self) -> &[Array<'a>] {
        &self.texts
    }

    /// The texts of an array.
    pub fn texts(&mut self, array: &Array) -> Result<Vec<String>, Problem> {
        self.at = array.at;
        (0..array.count).map(|_| self.text().map(|t| if self.binary { lossy(t) } else { decoded(t) })).collect()
    }

    /// The next text, as it is written.
    pub(super) fn text(&mut self) -> Result<&'a [u8], Problem> {
        let text = if self.binary { self.with_length() } else { self.raw_line().map(<[u8]>::trim_ascii) };
        text.ok_or_else(|| self.error("the file ends within an array of texts"))
    }

    /// The first two bits tell how many bytes the length has, which the rest of them are.
    fn with_length(&mut self) -> Option<&'a [u8]> {
        let width = match self.file.get(self.at)? >> 6 {
            0 => 8,
            1 => 4,
            2 => 2,
            _ => 1,
        };
        let number = self.take(width)?.iter().fold(0, |n: u64, b| n << 8 | u64::from(*b));
        let length = number & (u64::MAX >> (66 - 8 * width));
        self.take(usize::try_from(length).ok()?)
    }
}

fn lossy(text: &[u8]) -> String {
    String::from_utf8_lossy(text).into_owned()
}

/// A name or text as it was: in these files what is not plain is written as in addresses of the web.
pub(in crate::vtk) fn decoded(text: &[u8]) -> String {
    let mut bytes = Vec::new();
    let mut rest = text;
    while let Some((first, after)) = rest.split_first() {
        let hex = after.get(..2).filter(|_| *first == b'%').and_then(|h| std::str::from_utf8(h).ok());
        match hex.and_then(|h| u8::from_str_radix(h, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    lossy(&bytes)
}
