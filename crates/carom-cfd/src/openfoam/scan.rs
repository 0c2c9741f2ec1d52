//! Words and numbers of a file, byte by byte, nothing copied.

use std::ops::Range;
use std::path::Path;

use super::error::{Fault, fault};
use crate::Error;

/// A place in a file's bytes.
#[derive(Clone, Copy)]
pub(super) struct Scan<'a> {
    bytes: &'a [u8],
    pub(super) at: usize,
}

fn ends_word(byte: u8) -> bool {
    byte.is_ascii_whitespace() || matches!(byte, b'(' | b')' | b'{' | b'}' | b'[' | b']' | b';' | b'"')
}

impl<'a> Scan<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    pub(super) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    pub(super) fn span(&self, range: Range<usize>) -> &'a [u8] {
        self.bytes.get(range).unwrap_or_default()
    }

    /// Goes to what comes next that is neither space nor comment.
    pub(super) fn space(&mut self) {
        loop {
            while self.bytes.get(self.at).is_some_and(u8::is_ascii_whitespace) {
                self.at += 1;
            }
            let rest = &self.bytes[self.at..];
            if rest.starts_with(b"//") {
                self.at += rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
            } else if rest.starts_with(b"/*") {
                self.at += 2 + rest[2..].windows(2).position(|w| w == b"*/").map_or(rest.len() - 2, |end| end + 2);
            } else {
                return;
            }
        }
    }

    /// The next byte that is neither space nor comment; it stays.
    pub(super) fn peek(&mut self) -> Option<u8> {
        self.space();
        self.bytes.get(self.at).copied()
    }

    /// Takes one byte, if it is the next.
    pub(super) fn take(&mut self, byte: u8) -> bool {
        let next = self.peek() == Some(byte);
        self.at += usize::from(next);
        next
    }

    pub(super) fn expect(&mut self, byte: u8) -> Result<(), Fault> {
        if self.take(byte) {
            Ok(())
        } else {
            Err(self.fault(format!("`{}` expected, found {}", byte as char, self.shown())))
        }
    }

    /// What comes next, for a message.
    pub(super) fn shown(&self) -> String {
        let mut ahead = *self;
        match ahead.peek() {
            None => "the end".into(),
            Some(_) => {
                let rest = ahead.rest();
                let end = rest.iter().take(24).position(u8::is_ascii_whitespace).unwrap_or(rest.len().min(24)).max(1);
                format!("`{}`", String::from_utf8_lossy(&rest[..end]).escape_debug())
            }
        }
    }

    /// The next word; empty where something else comes.
    pub(super) fn word(&mut self) -> &'a [u8] {
        self.space();
        let rest = self.rest();
        let end = rest.iter().position(|b| ends_word(*b)).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    /// A word that may hold brackets in pairs, as `div(phi,U)` and `blade[1]` do: the name of an entry, a patch or a group.
    pub(super) fn name(&mut self) -> &'a [u8] {
        self.space();
        let rest = self.rest();
        let mut depth = 0_usize;
        let end = rest.iter().enumerate().position(|(i, b)| match b {
            b'(' | b'[' if *b == b'(' || i > 0 => {
                depth += 1;
                false
            }
            b')' | b']' if depth > 0 => {
                depth -= 1;
                false
            }
            b => ends_word(*b),
        });
        let end = end.unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    /// A text in quotes, without them; escapes stay as they are.
    pub(super) fn quoted(&mut self) -> Result<&'a [u8], Fault> {
        self.expect(b'"')?;
        let rest = self.rest();
        let mut escaped = false;
        for (i, b) in rest.iter().enumerate() {
            match b {
                b'"' if !escaped => {
                    self.at += i + 1;
                    return Ok(&rest[..i]);
                }
                b => escaped = *b == b'\\' && !escaped,
            }
        }
        Err(self.fault("a text in quotes does not end"))
    }

    pub(super) fn number(&mut self) -> Result<f64, Fault> {
        let word = self.word();
        let number = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok());
        number.ok_or_else(|| {
            self.at -= word.len();
            self.fault(format!("a number expected, found {}", self.shown()))
        })
    }

    pub(super) fn integer(&mut self) -> Result<i64, Fault> {
        let word = self.word();
        let (negative, digits) = match word {
            [b'-', digits @ ..] => (true, digits),
            digits => (false, digits),
        };
        let mut value = Some(0_i64).filter(|_| !digits.is_empty());
        for d in digits {
            value =
                value.filter(|_| d.is_ascii_digit()).and_then(|v| v.checked_mul(10)?.checked_add(i64::from(d - b'0')));
        }
        match value {
            Some(v) => Ok(if negative { -v } else { v }),
            None => {
                self.at -= word.len();
                Err(self.fault(format!("a whole number expected, found {}", self.shown())))
            }
        }
    }

    pub(super) fn count(&mut self) -> Result<usize, Fault> {
        let before = self.at;
        let value = self.integer()?;
        usize::try_from(value).map_err(|_| Self { at: before, ..*self }.fault(format!("{value} is no count")))
    }

    /// Takes so many bytes.
    pub(super) fn raw(&mut self, len: Option<usize>) -> Result<&'a [u8], Fault> {
        let found = len.and_then(|len| self.bytes.get(self.at..self.at.checked_add(len)?));
        let found = found.ok_or_else(|| self.fault("the file ends before its list does"))?;
        self.at += found.len();
        Ok(found)
    }

    pub(super) fn fault(&self, what: impl Into<String>) -> Fault {
        fault(self.at, what)
    }

    /// The error of a file for a fault in it.
    pub(super) fn error(bytes: &[u8], path: &Path, fault: Fault) -> Error {
        let text = bytes.get(..fault.at).unwrap_or(bytes);
        let readable = !text.contains(&0);
        let line = readable.then(|| 1 + text.iter().filter(|b| **b == b'\n').count());
        let what = if readable { fault.what } else { format!("byte {}: {}", fault.at, fault.what) };
        Error::File { path: path.to_owned(), line, what }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_space_are_passed_over() {
        let mut s = Scan::new(b" // one\n /* two\n ** */ word(3.5e-1 -7) /* open");
        assert_eq!(s.word(), b"word");
        assert!(s.take(b'('));
        assert_eq!(s.number().unwrap(), 0.35);
        assert_eq!(s.integer().unwrap(), -7);
        assert!(s.take(b')'));
        assert_eq!(s.peek(), None);
    }

    #[test]
    fn numbers_that_are_none_say_where() {
        let bytes = b"a\nb\n12x";
        let mut s = Scan::new(bytes);
        s.word();
        s.word();
        let e = Scan::error(bytes, Path::new("f"), s.integer().unwrap_err());
        assert_eq!(e.to_string(), "f:3: a whole number expected, found `12x`");
        assert!(Scan::new(b"9223372036854775808").integer().is_err());
        assert!(Scan::new(b"-").integer().is_err());
        assert!(Scan::new(b"").number().is_err());
        assert!(Scan::new(b"-3").count().is_err());
    }

    #[test]
    fn names_and_quotes() {
        let mut s = Scan::new(br#"div(phi,U) "a\"b|c" x"#);
        assert_eq!(s.name(), b"div(phi,U)");
        assert_eq!(s.quoted().unwrap(), br#"a\"b|c"#);
        assert_eq!(s.name(), b"x");
        assert!(Scan::new(b"\"open").quoted().is_err());
    }
}
