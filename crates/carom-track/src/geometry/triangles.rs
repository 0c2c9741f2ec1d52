//! Files of triangles: STL (`triangles/stl.rs`), Wavefront OBJ (`triangles/obj.rs`) and PLY (`triangles/ply.rs`).
//!
//! What would be a hole in the wall is refused: a corner that is not finite or not there, a face of a kind that is not read, a file
//! that ends early.

mod obj;
mod ply;
mod stl;

use super::Triangle;

/// The triangles of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Corners as written, without a unit.
    pub triangles: Vec<Triangle>,
    /// Its solids in order: STL's solids, OBJ's objects and groups. A binary STL file and a PLY file are one without a name.
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
pub enum TrianglesError {
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
    /// A triangle with a corner that is not finite.
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
    /// Something in a file as a whole.
    #[error("{0}")]
    File(String),
    /// No triangles.
    #[error("no triangles in it")]
    Empty,
    /// More triangles than can be numbered.
    #[error("more than 4 billion triangles")]
    TooMany,
}

/// Reads the bytes of a file of that name: OBJ and PLY by their endings, anything else as STL.
///
/// # Errors
/// What is wrong, and where.
pub fn read(name: &str, bytes: &[u8]) -> Result<Triangles, TrianglesError> {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    let read = match ending.as_str() {
        "obj" => obj::read(bytes)?,
        "ply" => ply::read(bytes)?,
        _ => stl::read(bytes)?,
    };
    match read.triangles.len() {
        0 => Err(TrianglesError::Empty),
        n if u32::try_from(n).is_err() => Err(TrianglesError::TooMany),
        _ => Ok(read),
    }
}

/// Single precision, with what computing in it leaves.
const SINGLE: f64 = 2.5e-7;
/// The least precision that a text of few digits is taken for.
const COARSE: f64 = 1e-6;

/// What the numbers of a text were rounded to.
struct Rounding {
    /// Whether all are of single precision.
    single: bool,
    /// The most digits of one.
    digits: usize,
}

impl Rounding {
    fn new() -> Self {
        Self { single: true, digits: 0 }
    }

    /// The number that a word is.
    fn number(&mut self, word: &[u8]) -> Option<f64> {
        let text = std::str::from_utf8(word).ok()?;
        // Fortran writes 1.0D+00
        let number: f64 = text.parse().or_else(|_| text.replace(['d', 'D'], "e").parse()).ok()?;
        if self.single && f64::from(number as f32) != number {
            self.single = false;
        }
        let mantissa = word.split(|b| b.is_ascii_alphabetic()).next().unwrap_or_default();
        let digits = mantissa.iter().filter(|b| b.is_ascii_digit()).skip_while(|b| **b == b'0').count();
        self.digits = self.digits.max(digits);
        Some(number)
    }

    /// As a share of the largest coordinate.
    fn share(&self) -> f64 {
        let decimal: f64 = format!("5e-{}", self.digits).parse().unwrap_or(COARSE);
        if self.single { SINGLE } else { decimal.clamp(1e-15, COARSE) }
    }
}

/// A word for a message, however long and in whatever encoding.
fn quoted(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned();
    if word.len() > 40 { format!("'{text}…'") } else { format!("'{text}'") }
}

/// A name, in whatever encoding.
fn name(bytes: &[u8]) -> String {
    let bytes = bytes.trim_ascii();
    std::str::from_utf8(bytes).map_or_else(|_| bytes.iter().map(|b| char::from(*b)).collect(), str::to_owned)
}

/// The triangles of a flat, convex face, as a fan from its first corner; `None` where a fan would leave the face.
fn fan(corners: &[[f64; 3]]) -> Option<impl Iterator<Item = Triangle> + '_> {
    use crate::vector::{cross, dot, sub};
    let [first, rest @ ..] = corners else { return None };
    let areas = || rest.windows(2).map(|w| cross(sub(w[0], *first), sub(w[1], *first)));
    // a fan inside the face has no triangle that is turned over against the largest
    let largest = areas().max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)))?;
    let slack = 1e-9 * dot(largest, largest);
    let inside = areas().all(|area| dot(area, largest) >= -slack);
    inside.then(|| rest.windows(2).map(|w| [*first, w[0], w[1]]))
}

#[cfg(test)]
mod tests;
