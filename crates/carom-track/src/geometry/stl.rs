//! STL files: triangles as text or binary.
//!
//! Written for what programs write: any number of solids, with names or without, in any case and encoding, facet normals that
//! are nothing, a header of a binary file that begins with "solid". What would be a hole in the wall is refused: a length that
//! is not that of the triangles announced, a corner that is not finite, a text that ends early. (The crate `stl_io` reads the
//! first solid only, stops at the number announced, and refuses several of the others.)

use super::Triangle;

/// The triangles of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stl {
    /// Corners as written, without a unit.
    pub triangles: Vec<Triangle>,
    /// Its solids in order; a binary file is one without a name.
    pub solids: Vec<Solid>,
    /// What the corners were rounded to, as a share of the largest coordinate.
    pub precision: f64,
}

/// A run of triangles with a name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Solid {
    /// Empty where there is none.
    pub name: String,
    /// Its triangles in the list.
    pub triangles: std::ops::Range<usize>,
}

/// Why a file is refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StlError {
    /// Neither text nor binary.
    #[error("no STL: it neither begins with 'solid' nor has the 84 bytes of a binary one's header")]
    Neither,
    /// A binary file with more or less than it says.
    #[error("its header counts {count} triangles, {} bytes, but it has {length} bytes", 84 + 50 * u64::from(*.count))]
    Length {
        /// Triangles counted by the header.
        count: u32,
        /// Bytes there are.
        length: u64,
    },
    /// A binary triangle with a corner that is not finite.
    #[error("triangle {0} has a corner that is not finite")]
    NotFinite(usize),
    /// Something in a line of text.
    #[error("line {line}: {what}")]
    Text {
        /// The line, from 1.
        line: usize,
        /// What is wrong there.
        what: String,
    },
    /// No triangles.
    #[error("no triangles in it")]
    Empty,
    /// More triangles than can be numbered.
    #[error("more than 4 billion triangles")]
    TooMany,
}

/// Single precision, with what computing in it leaves.
const SINGLE: f64 = 2.5e-7;
/// The least precision that a text of few digits is taken for.
const COARSE: f64 = 1e-6;

/// Reads a file's bytes.
///
/// # Errors
/// What is wrong, and where.
pub fn read(bytes: &[u8]) -> Result<Stl, StlError> {
    let stl = match count(bytes) {
        Some(count) if bytes.len() as u64 == 84 + 50 * u64::from(count) => binary(&bytes[84..])?,
        count => {
            let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
            match count {
                _ if is_text(text) => Text::new(text).read()?,
                Some(count) => return Err(StlError::Length { count, length: bytes.len() as u64 }),
                None => return Err(StlError::Neither),
            }
        }
    };
    match stl.triangles.len() {
        0 => Err(StlError::Empty),
        n if u32::try_from(n).is_err() => Err(StlError::TooMany),
        _ => Ok(stl),
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

fn binary(bytes: &[u8]) -> Result<Stl, StlError> {
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
            return Err(StlError::NotFinite(number + 1));
        }
        triangles.push(triangle);
    }
    let solids = vec![Solid { name: String::new(), triangles: 0..triangles.len() }];
    Ok(Stl { triangles, solids, precision: SINGLE })
}

/// Words of a text, with the line that each is in.
struct Text<'a> {
    rest: &'a [u8],
    line: usize,
    stl: Stl,
    /// Whether all numbers are of single precision, and the most digits of one.
    single: bool,
    digits: usize,
}

impl<'a> Text<'a> {
    fn new(text: &'a [u8]) -> Self {
        Self { rest: text, line: 1, stl: Stl::default(), single: true, digits: 0 }
    }

    fn read(mut self) -> Result<Stl, StlError> {
        while let Some(word) = self.word() {
            if !word.eq_ignore_ascii_case(b"solid") {
                return Err(self.wrong(word, "'solid'"));
            }
            self.solid()?;
        }
        let decimal: f64 = format!("5e-{}", self.digits).parse().unwrap_or(COARSE);
        self.stl.precision = if self.single { SINGLE } else { decimal.clamp(1e-15, COARSE) };
        Ok(self.stl)
    }

    /// A solid after that word.
    fn solid(&mut self) -> Result<(), StlError> {
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
    fn facet(&mut self) -> Result<(), StlError> {
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

    fn expect(&mut self, what: &str) -> Result<(), StlError> {
        let word = self.word().ok_or_else(|| self.early())?;
        if word.eq_ignore_ascii_case(what.as_bytes()) { Ok(()) } else { Err(self.wrong(word, &format!("'{what}'"))) }
    }

    fn number(&mut self) -> Result<f64, StlError> {
        let word = self.word().ok_or_else(|| self.early())?;
        let text = std::str::from_utf8(word).unwrap_or_default();
        // Fortran writes 1.0D+00
        let number = text.parse().or_else(|_| text.replace(['d', 'D'], "e").parse::<f64>());
        let number = number.map_err(|_| self.wrong(word, "a number"))?;
        if !number.is_finite() {
            return Err(self.error(&format!("a corner that is not finite: {}", quoted(word))));
        }
        if self.single && f64::from(number as f32) != number {
            self.single = false;
        }
        let mantissa = word.split(|b| b.is_ascii_alphabetic()).next().unwrap_or_default();
        let digits = mantissa.iter().filter(|b| b.is_ascii_digit()).skip_while(|b| **b == b'0').count();
        self.digits = self.digits.max(digits);
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
        let name = self.rest[..end].trim_ascii();
        self.rest = &self.rest[end..];
        match std::str::from_utf8(name) {
            Ok(name) => name.to_owned(),
            Err(_) => name.iter().map(|b| char::from(*b)).collect(),
        }
    }

    fn error(&self, what: &str) -> StlError {
        StlError::Text { line: self.line, what: what.to_owned() }
    }

    fn wrong(&self, word: &[u8], expected: &str) -> StlError {
        self.error(&format!("expected {expected}, not {}", quoted(word)))
    }

    fn early(&self) -> StlError {
        self.error("the file ends before 'endsolid'")
    }
}

/// A word for a message, however long and in whatever encoding.
fn quoted(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned();
    if word.len() > 40 { format!("'{text}…'") } else { format!("'{text}'") }
}

#[cfg(test)]
mod tests;
