//! STL files: triangles as text or binary.
//!
//! Written for what programs write: any number of solids, with names or without, in any case and encoding, facet normals that
//! are nothing, a header of a binary file that begins with "solid". What would be a hole in the wall is refused: a length that
//! is not that of the triangles announced, a corner that is not finite, a text that ends early. (The crate `stl_io` reads the
//! first solid only, stops at the number announced, and refuses several of the others.)

use super::{Rounding, SINGLE, Solid, Triangles, TrianglesError, name, quoted};
use crate::geometry::Triangle;

/// Reads a file's bytes.
///
/// # Errors
/// What is wrong, and where.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles, TrianglesError> {
    match count(bytes) {
        Some(count) if bytes.len() as u64 == 84 + 50 * u64::from(count) => binary(&bytes[84..]),
        count => {
            let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
            match count {
                _ if is_text(text) => Text::new(text).read(),
                Some(count) => Err(TrianglesError::Length { count, length: bytes.len() as u64 }),
                None => Err(TrianglesError::Neither),
            }
        }
    }
}

/// The number of triangles that a binary file announces.
fn count(bytes: &[u8]) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(80..84)?.try_into().ok()?))
}

/// Begins with "solid", and nothing that text never has follows soon.
fn is_text(bytes: &[u8]) -> bool {
    let begin = bytes.trim_ascii_start();
    let head = begin.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    head && !begin.iter().take(1024).any(|b| *b == 0)
}

fn binary(bytes: &[u8]) -> Result<Triangles, TrianglesError> {
    let mut triangles = Vec::with_capacity(bytes.len() / 50);
    for (number, facet) in bytes.chunks_exact(50).enumerate() {
        // twelve bytes of a normal that many leave empty
        let number_at = |i: usize| {
            let at = 12 + 4 * i;
            f64::from(f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]]))
        };
        let corner = |i: usize| [number_at(3 * i), number_at(3 * i + 1), number_at(3 * i + 2)];
        let triangle = [corner(0), corner(1), corner(2)];
        if !triangle.iter().flatten().all(|c| c.is_finite()) {
            return Err(TrianglesError::NotFinite(number + 1));
        }
        triangles.push(triangle);
    }
    let solids = vec![Solid { name: String::new(), triangles: 0..triangles.len() }];
    Ok(Triangles { triangles, solids, precision: SINGLE })
}

/// Words of a text, with the line that each is in.
struct Text<'a> {
    rest: &'a [u8],
    line: usize,
    stl: Triangles,
    rounding: Rounding,
}

impl<'a> Text<'a> {
    fn new(text: &'a [u8]) -> Self {
        Self { rest: text, line: 1, stl: Triangles::default(), rounding: Rounding::new() }
    }

    fn read(mut self) -> Result<Triangles, TrianglesError> {
        while let Some(word) = self.word() {
            if !word.eq_ignore_ascii_case(b"solid") {
                return Err(self.wrong(word, "'solid'"));
            }
            self.solid()?;
        }
        self.stl.precision = self.rounding.share();
        Ok(self.stl)
    }

    /// A solid after that word.
    fn solid(&mut self) -> Result<(), TrianglesError> {
        let (name, first) = (self.name(), self.stl.triangles.len());
        loop {
            match self.word() {
                Some(word) if word.eq_ignore_ascii_case(b"facet") => self.facet()?,
                Some(word) if word.eq_ignore_ascii_case(b"endsolid") => break,
                Some(word) => return Err(self.wrong(word, "'facet' or 'endsolid'")),
                None => return Err(self.early()),
            }
        }
        self.name();
        self.stl.solids.push(Solid { name, triangles: first..self.stl.triangles.len() });
        Ok(())
    }

    /// A facet after that word. What stands for a normal is not looked at: corners tell it.
    fn facet(&mut self) -> Result<(), TrianglesError> {
        let line = self.line;
        while !self.word().ok_or_else(|| self.early())?.eq_ignore_ascii_case(b"outer") {
            if self.line > line + 1 {
                return Err(self.error("expected 'outer loop' after the facet's normal"));
            }
        }
        self.expect("loop")?;
        let mut triangle = Triangle::default();
        for corner in &mut triangle {
            self.expect("vertex")?;
            for c in corner {
                *c = self.number()?;
            }
        }
        self.expect("endloop")?;
        self.expect("endfacet")?;
        self.stl.triangles.push(triangle);
        Ok(())
    }

    fn expect(&mut self, what: &str) -> Result<(), TrianglesError> {
        let word = self.word().ok_or_else(|| self.early())?;
        if word.eq_ignore_ascii_case(what.as_bytes()) { Ok(()) } else { Err(self.wrong(word, &format!("'{what}'"))) }
    }

    fn number(&mut self) -> Result<f64, TrianglesError> {
        let word = self.word().ok_or_else(|| self.early())?;
        let number = self.rounding.number(word).ok_or_else(|| self.wrong(word, "a number"))?;
        if !number.is_finite() {
            return Err(self.error(&format!("a corner that is not finite: {}", quoted(word))));
        }
        Ok(number)
    }

    fn word(&mut self) -> Option<&'a [u8]> {
        let begin = self.rest.iter().position(|b| !b.is_ascii_whitespace())?;
        self.line += self.rest[..begin].iter().filter(|b| **b == b'\n').count();
        let rest = &self.rest[begin..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.rest = &rest[end..];
        Some(&rest[..end])
    }

    /// The rest of the line, in whatever encoding.
    fn name(&mut self) -> String {
        let end = self.rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(self.rest.len());
        let of = &self.rest[..end];
        self.rest = &self.rest[end..];
        name(of)
    }

    fn error(&self, what: &str) -> TrianglesError {
        TrianglesError::Text { line: self.line, what: what.to_owned() }
    }

    fn wrong(&self, word: &[u8], expected: &str) -> TrianglesError {
        self.error(&format!("expected {expected}, not {}", quoted(word)))
    }

    fn early(&self) -> TrianglesError {
        self.error("the file ends before 'endsolid'")
    }
}

#[cfg(test)]
mod tests;
