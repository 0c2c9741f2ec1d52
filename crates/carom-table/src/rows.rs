//! Rows of a CSV file, found by their ends and split only where they are wanted.
//!
//! A state machine over every byte, as a general CSV reader is, takes as long as writing the table did; here a row that is
//! passed over costs a search for the end of its line.

use std::borrow::Cow;
use std::io::{self, Read};

/// Reads rows one after the other; memory holds a stretch of the file, or one row where that is longer.
///
/// ```
/// use carom_table::RowReader;
/// let mut rows = RowReader::new("particle,wall\n7,\"floor, left\"\n".as_bytes());
/// assert!(rows.next_row()?.is_some_and(|header| header.fields().eq(["particle", "wall"].map(str::as_bytes))));
/// let row = rows.next_row()?.expect("a row");
/// assert_eq!(row.field(1).as_deref(), Some("floor, left".as_bytes()));
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct RowReader<R> {
    inner: R,
    buffer: Vec<u8>,
    /// What of the buffer is not yet told.
    rest: std::ops::Range<usize>,
    ended: bool,
    line: u64,
    next_line: u64,
}

/// Bytes asked for at a time.
const STRETCH: usize = 1 << 17;

impl<R: Read> RowReader<R> {
    /// Reads from a file or a stream; no buffer is needed between.
    pub fn new(inner: R) -> Self {
        Self { inner, buffer: Vec::new(), rest: 0..0, ended: false, line: 0, next_line: 1 }
    }

    /// The next row that is not empty; `None` after the last.
    ///
    /// # Errors
    /// What the stream says.
    pub fn next_row(&mut self) -> io::Result<Option<Row<'_>>> {
        let (row, quoted) = loop {
            let Some(found) = self.find_row()? else { return Ok(None) };
            if !found.0.is_empty() {
                break found;
            }
        };
        Ok(Some(Row { text: &self.buffer[row], quoted }))
    }

    /// The line of the file, counted from 1, in which the last row begins.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// Where the next row stands in the buffer, without its end, and whether it has quotes.
    fn find_row(&mut self) -> io::Result<Option<(std::ops::Range<usize>, bool)>> {
        let (mut from, mut quotes, mut breaks) = (0, 0usize, 0);
        loop {
            let start = self.rest.start;
            let unseen = &self.buffer[start + from..self.rest.end];
            let mut end = None;
            for at in memchr::memchr2_iter(b'\n', b'"', unseen) {
                if unseen[at] == b'"' {
                    quotes += 1;
                } else if quotes.is_multiple_of(2) {
                    end = Some(start + from + at);
                    break;
                } else {
                    breaks += 1;
                }
            }
            from += unseen.len();
            let (end, next) = match end {
                Some(end) => (end, end + 1),
                None if !self.ended => {
                    self.fill()?;
                    continue;
                }
                None if self.rest.is_empty() => return Ok(None),
                None => (self.rest.end, self.rest.end),
            };
            self.rest.start = next;
            self.line = self.next_line;
            self.next_line += breaks + 1;
            let text = &self.buffer[start..end];
            return Ok(Some((start..start + text.strip_suffix(b"\r").unwrap_or(text).len(), quotes > 0)));
        }
    }

    /// Reads on behind what is not yet told.
    fn fill(&mut self) -> io::Result<()> {
        self.buffer.copy_within(self.rest.clone(), 0);
        self.rest = 0..self.rest.len();
        if self.buffer.len() < self.rest.end + STRETCH {
            self.buffer.resize(self.rest.end + STRETCH, 0);
        }
        let read = self.inner.read(&mut self.buffer[self.rest.end..])?;
        self.ended = read == 0;
        self.rest.end += read;
        Ok(())
    }
}

/// A row of a [`RowReader`].
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    text: &'a [u8],
    quoted: bool,
}

impl<'a> Row<'a> {
    /// Its fields, without their quotes.
    pub fn fields(&self) -> impl Iterator<Item = Cow<'a, [u8]>> + use<'a> {
        Fields { rest: Some(self.text), quoted: self.quoted }
    }

    /// One field, counted from 0.
    pub fn field(&self, place: usize) -> Option<Cow<'a, [u8]>> {
        self.fields().nth(place)
    }
}

struct Fields<'a> {
    rest: Option<&'a [u8]>,
    quoted: bool,
}

impl<'a> Iterator for Fields<'a> {
    type Item = Cow<'a, [u8]>;

    fn next(&mut self) -> Option<Self::Item> {
        let text = self.rest?;
        if !self.quoted || text.first() != Some(&b'"') {
            let end = memchr::memchr(b',', text);
            self.rest = end.map(|end| &text[end + 1..]);
            return Some(Cow::Borrowed(&text[..end.unwrap_or(text.len())]));
        }
        // two quotes within quotes are one; a single one ends the quoted part
        let mut field = Vec::new();
        let mut rest = &text[1..];
        loop {
            let Some(quote) = memchr::memchr(b'"', rest) else {
                field.extend_from_slice(rest);
                self.rest = None;
                break;
            };
            field.extend_from_slice(&rest[..quote]);
            rest = &rest[quote + 1..];
            if let Some(after) = rest.strip_prefix(b"\"") {
                field.push(b'"');
                rest = after;
                continue;
            }
            let end = memchr::memchr(b',', rest);
            field.extend_from_slice(&rest[..end.unwrap_or(rest.len())]);
            self.rest = end.map(|end| &rest[end + 1..]);
            break;
        }
        Some(Cow::Owned(field))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hands out a few bytes at a time.
    struct Drip<'a>(&'a [u8], usize);

    impl Read for Drip<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let n = self.1.min(self.0.len()).min(buffer.len());
            buffer[..n].copy_from_slice(&self.0[..n]);
            self.0 = &self.0[n..];
            Ok(n)
        }
    }

    #[test]
    fn fields_are_those_of_the_csv_crate_however_the_bytes_come() {
        let long = "x".repeat(3 * STRETCH);
        let texts = [
            "a,b\n1,2\n",
            "a,b\r\n1,2\r\n",
            "a,b\n,\n\n1,\"two\"\n",
            "a,b\n\"one, \"\"1\"\"\",\"two\nlines\"\n3,4",
            "a,b\n\"\",x\n\"q\"r,\"\"\"\"\n",
            "",
            "a",
            &format!("a,b\n{long},\"{long}\n{long}\"\nlast,row\n"),
        ];
        for text in texts {
            let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
            let wanted: Vec<csv::ByteRecord> = reader.byte_records().map(Result::unwrap).collect();
            for step in [1, 3, 1 << 20] {
                let mut rows =
                    RowReader::new(Drip(text.as_bytes(), if text.len() > 1000 { step.max(1000) } else { step }));
                for record in &wanted {
                    let row = rows.next_row().unwrap().expect("a row");
                    assert!(row.fields().eq(record.iter()), "{text}");
                }
                assert!(rows.next_row().unwrap().is_none(), "{text}");
            }
        }
        let mut rows = RowReader::new("a\n\nb,\"c\nd\"\ne".as_bytes());
        let mut lines = Vec::new();
        while rows.next_row().unwrap().is_some() {
            lines.push(rows.line());
        }
        assert_eq!(lines, [1, 3, 5]);
    }
}
