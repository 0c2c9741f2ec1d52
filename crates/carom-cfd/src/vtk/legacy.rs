//! Legacy VTK files (The VTK User's Guide, "VTK File Formats": simple legacy formats, versions 2 to 5): words, numbers, and where the
//! arrays of points and cells are.
//!
//! Read here rather than by a library: the one there is for Rust (vtkio 0.6) rests on releases of its parsers that the
//! compiler announces it will reject.

mod text;

pub(super) use text::decoded;

use super::number::{Number, Stored};
use carom_table::{clipped, quoted};
use std::str::FromStr;
use text::is_text;

/// Colours: bytes, which ASCII has as fractions of 255. VTK writes any scalars so that are unsigned char.
const COLOR: &str = "COLOR_SCALARS";

/// What is wrong with a file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// How far the file was read.
    pub byte: usize,
    /// What is wrong there.
    pub what: String,
}

/// Where an array of the file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Array<'a> {
    /// Its name.
    pub name: &'a str,
    /// Numbers for each point or cell.
    pub components: usize,
    /// Numbers in all.
    pub count: usize,
    kind: &'a str,
    at: usize,
}

/// Reads a file from its first byte to its last.
#[derive(Debug)]
pub struct Reader<'a> {
    file: &'a [u8],
    at: usize,
    binary: bool,
    major: u32,
    texts: Vec<Array<'a>>,
}

impl<'a> Reader<'a> {
    /// Begins with the first three lines.
    pub fn new(file: &'a [u8]) -> Result<Self, Problem> {
        let mut reader = Self { file, at: 0, binary: false, major: 0, texts: Vec::new() };
        let version = reader.line().ok().flatten().and_then(|l| l.strip_prefix("# vtk DataFile"));
        let Some(version) = version else {
            return Err(reader.error("not a legacy VTK file: it must begin with \"# vtk DataFile\""));
        };
        let number = version.trim().trim_start_matches("Version").trim().split('.').next();
        reader.major = number.and_then(|n| n.parse().ok()).unwrap_or_default();
        // the title, in any encoding
        reader.raw_line();
        reader.binary = match reader.line()? {
            Some(l) if l.eq_ignore_ascii_case("ascii") => false,
            Some(l) if l.eq_ignore_ascii_case("binary") => true,
            _ => return Err(reader.error("the third line must be ASCII or BINARY")),
        };
        Ok(reader)
    }

    /// The first number of the format's version, 0 where it names none.
    pub fn major(&self) -> u32 {
        self.major
    }

    /// How many bytes the file has.
    pub fn size(&self) -> usize {
        self.file.len()
    }

    /// What is wrong here.
    pub fn error(&self, what: impl Into<String>) -> Problem {
        Problem { byte: self.at, what: what.into() }
    }

    /// The rest of the line; `None` at the end of the file.
    fn raw_line(&mut self) -> Option<&'a [u8]> {
        let rest = self.file.get(self.at..).filter(|r| !r.is_empty())?;
        let end = memchr::memchr(b'\n', rest).unwrap_or(rest.len());
        self.at += (end + 1).min(rest.len());
        Some(&rest[..end])
    }

    /// The rest of the line, trimmed; `None` at the end of the file. What is no text is an error: it is met where an array
    /// was longer than its type says, and passing over it would lose the arrays after it.
    fn line(&mut self) -> Result<Option<&'a str>, Problem> {
        let begin = self.at;
        let Some(line) = self.raw_line() else { return Ok(None) };
        match std::str::from_utf8(line) {
            Ok(text) => Ok(Some(text.trim())),
            Err(e) => {
                let what = "a byte that is no UTF-8 text, where a keyword or a number should be".to_owned();
                Err(Problem { byte: begin + e.valid_up_to(), what })
            }
        }
    }

    /// The words of the next line that is not empty; none at the end of the file.
    pub fn words(&mut self) -> Result<Vec<&'a str>, Problem> {
        while let Some(line) = self.line()? {
            if !line.is_empty() {
                return Ok(line.split_whitespace().collect());
            }
        }
        Ok(Vec::new())
    }

    /// The words of the next line that is not empty, which is not passed over.
    pub fn peek(&mut self) -> Vec<&'a str> {
        let here = self.at;
        let words = self.words().unwrap_or_default();
        self.at = here;
        words
    }

    /// The next line's words after `keyword`.
    pub fn expect(&mut self, keyword: &str, count: usize) -> Result<Vec<&'a str>, Problem> {
        let words = self.words()?;
        match words.split_first() {
            Some((first, rest)) if first.eq_ignore_ascii_case(keyword) && rest.len() >= count => Ok(rest.to_vec()),
            _ => Err(self.error(format!("{} where {keyword} should be", quoted(&words.join(" "))))),
        }
    }

    /// A number in a word.
    pub fn parse<T: FromStr>(&self, word: &str) -> Result<T, Problem> {
        word.parse().map_err(|_| self.error(format!("{} is not a number", quoted(word))))
    }

    /// Where every array of numbers of the points and of the cells is.
    pub fn data(&mut self, nodes: usize, cells: usize) -> Result<[Vec<Array<'a>>; 2], Problem> {
        self.data_if_any(nodes, cells)?.ok_or_else(|| self.error("the file ends where POINT_DATA should be"))
    }

    /// The same; `None` where the file has no data.
    pub fn data_if_any(&mut self, nodes: usize, cells: usize) -> Result<Option<[Vec<Array<'a>>; 2]>, Problem> {
        self.skip_metadata();
        let (mut found, mut which) = ([Vec::new(), Vec::new()], None);
        loop {
            let words = self.words()?;
            let Some((first, rest)) = words.split_first() else { break };
            let keyword = first.to_ascii_uppercase();
            match (keyword.as_str(), rest) {
                ("POINT_DATA" | "CELL_DATA", [count, ..]) => {
                    let of_cells = keyword == "CELL_DATA";
                    let (what, wanted) = if of_cells { ("cells", cells) } else { ("points", nodes) };
                    if self.parse::<usize>(count)? != wanted {
                        let count = clipped(count);
                        return Err(self.error(format!("{keyword} for {count} {what} on a grid of {wanted}")));
                    }
                    which = Some((usize::from(of_cells), wanted));
                    continue;
                }
                ("METADATA", _) => {
                    self.pass_block();
                    continue;
                }
                _ => {}
            }
            // a field before any data is of the file as a whole
            let (place, tuples) = match (which, keyword.as_str()) {
                (Some(which), _) => which,
                (None, "FIELD") => (2, 0),
                (None, _) => {
                    return Err(self.error(format!("{} where POINT_DATA should be", quoted(&words.join(" ")))));
                }
            };
            let mut arrays = self.arrays(&keyword, rest, tuples)?;
            arrays.retain(|a| tuples.checked_mul(a.components) == Some(a.count));
            let (texts, arrays): (Vec<_>, Vec<_>) = arrays.into_iter().partition(Array::is_text);
            if let Some(found) = found.get_mut(place) {
                found.extend(arrays);
            }
            if place == 1 {
                self.texts.extend(texts);
            }
        }
        Ok(which.map(|_| found))
    }

    /// The arrays that a line announces.
    fn arrays(&mut self, keyword: &str, rest: &[&'a str], tuples: usize) -> Result<Vec<Array<'a>>, Problem> {
        Ok(match (keyword, rest) {
            ("VECTORS" | "NORMALS", [name, kind]) => vec![self.array(name, 3, tuples, kind)?],
            ("TENSORS", [name, kind]) => vec![self.array(name, 9, tuples, kind)?],
            ("TENSORS6", [name, kind]) => vec![self.array(name, 6, tuples, kind)?],
            (COLOR, [name, components]) => {
                let components = self.parse(components)?;
                vec![self.array(name, components, tuples, if self.binary { "unsigned_char" } else { COLOR })?]
            }
            // the colours of a table that scalars named: no values of anything
            ("LOOKUP_TABLE", [name, count]) => {
                let count = self.parse(count)?;
                self.array(name, 4, count, "unsigned_char")?;
                Vec::new()
            }
            ("GLOBAL_IDS" | "PEDIGREE_IDS", [name, kind]) => vec![self.array(name, 1, tuples, kind)?],
            ("TEXTURE_COORDINATES", [name, components, kind]) => {
                let components = self.parse(components)?;
                vec![self.array(name, components, tuples, kind)?]
            }
            ("SCALARS", [name, kind, rest @ ..]) => {
                let components = rest.first().map_or(Ok(1), |n| self.parse(n))?;
                self.expect("LOOKUP_TABLE", 1)?;
                vec![self.array(name, components, tuples, kind)?]
            }
            ("FIELD", [_, count]) => self.field(count)?,
            (other, _) => return Err(self.error(format!("{} is not known in point data", quoted(other)))),
        })
    }

    /// The arrays of a field.
    pub fn field(&mut self, count: &str) -> Result<Vec<Array<'a>>, Problem> {
        let mut arrays = Vec::new();
        for _ in 0..self.parse::<usize>(count)? {
            self.skip_metadata();
            let words = self.words()?;
            let [name, components, tuples, kind] = words[..] else {
                return Err(self.error("a field array needs a name, components, tuples and a type"));
            };
            let (components, tuples) = (self.parse(components)?, self.parse(tuples)?);
            arrays.push(self.array(name, components, tuples, kind)?);
        }
        self.skip_metadata();
        Ok(arrays)
    }

    /// An array from here on, passed over.
    fn array(&mut self, name: &'a str, components: usize, tuples: usize, kind: &'a str) -> Result<Array<'a>, Problem> {
        let count = components.checked_mul(tuples).ok_or_else(|| self.error("an array too large"))?;
        let array = Array { name, components, count, kind, at: self.at };
        self.pass(count, kind)?;
        Ok(array)
    }

    /// The values of an array.
    pub fn decoded<T: Number>(&mut self, array: &Array) -> Result<Vec<T>, Problem> {
        self.at = array.at;
        self.values(array.count, array.kind)
    }

    /// The values of an array that was passed over, from where the reader comes back to where it is.
    pub fn again<T: Number>(&mut self, array: &Array) -> Result<Vec<T>, Problem> {
        let here = self.at;
        let values = self.decoded(array);
        self.at = here;
        values
    }

    /// Passes over blocks that newer versions put after arrays, up to an empty line.
    pub fn skip_metadata(&mut self) {
        loop {
            let here = self.at;
            if self.words().unwrap_or_default().first() != Some(&"METADATA") {
                self.at = here;
                return;
            }
            self.pass_block();
        }
    }

    /// Passes over lines up to an empty one.
    fn pass_block(&mut self) {
        while self.raw_line().is_some_and(|l| !l.trim_ascii().is_empty()) {}
    }

    /// So many numbers of a VTK type; binary ones are big-endian.
    pub fn values<T: Number>(&mut self, count: usize, kind: &str) -> Result<Vec<T>, Problem> {
        self.at_least(count)?;
        if self.binary {
            let (stored, bytes) = self.binary(count, kind)?;
            return Ok(match stored {
                Some(stored) => stored.decode(bytes, true),
                None => bits(bytes).take(count).collect(),
            });
        }
        let parsed =
            if kind == COLOR { |w: &str| f64::parsed(w).map(|x| T::real((255.0 * x).round())) } else { T::parsed };
        let mut values = Vec::new();
        let all = self.ascii(count, |reader, word| {
            let value = parsed(word).ok_or_else(|| reader.error(format!("{} is not a number", quoted(word))))?;
            values.push(value);
            Ok(())
        });
        all.map(|()| values)
    }

    /// Passes over so many numbers of a VTK type.
    fn pass(&mut self, count: usize, kind: &str) -> Result<(), Problem> {
        self.at_least(count)?;
        if is_text(kind) {
            return (0..count).try_for_each(|_| self.text().map(drop));
        }
        if self.binary { self.binary(count, kind).map(drop) } else { self.ascii(count, |_, _| Ok(())) }
    }

    fn at_least(&self, count: usize) -> Result<(), Problem> {
        // in binary files, eight bits may be a byte
        if count / 8 > self.file.len().saturating_sub(self.at) {
            return Err(self.error(format!("the file ends before {count} values")));
        }
        Ok(())
    }

    fn ascii(&mut self, count: usize, mut take: impl FnMut(&Self, &str) -> Result<(), Problem>) -> Result<(), Problem> {
        let mut met = 0;
        while met < count {
            let Some(line) = self.line()? else {
                return Err(self.error(format!("the file ends after {met} of {count} values")));
            };
            for word in line.split_ascii_whitespace() {
                met += 1;
                take(self, word)?;
            }
        }
        if met > count { Err(self.error(format!("more than {count} values"))) } else { Ok(()) }
    }

    /// The bytes of so many numbers, and how they are stored; bits in no way of their own.
    fn binary(&mut self, count: usize, kind: &str) -> Result<(Option<Stored>, &'a [u8]), Problem> {
        let (stored, bytes) = match Stored::legacy(kind) {
            Some(stored) => (Some(stored), count.checked_mul(stored.width())),
            None if kind.eq_ignore_ascii_case("bit") => (None, Some(count.div_ceil(8))),
            None => return Err(self.error(format!("binary values of type {}, which is not read", quoted(kind)))),
        };
        let Some(bytes) = bytes.and_then(|n| self.take(n)) else {
            return Err(self.error(format!("the file ends before {count} values")));
        };
        Ok((stored, bytes))
    }

    /// The next bytes, if there are so many.
    fn take(&mut self, bytes: usize) -> Option<&'a [u8]> {
        let taken = self.file.get(self.at..)?.get(..bytes)?;
        self.at += bytes;
        Some(taken)
    }
}

/// Bits as numbers, the highest of each byte first.
fn bits<T: Number>(bytes: &[u8]) -> impl Iterator<Item = T> {
    bytes.iter().flat_map(|b| (0..8).rev().map(move |i| T::whole(i64::from(b >> i & 1))))
}
