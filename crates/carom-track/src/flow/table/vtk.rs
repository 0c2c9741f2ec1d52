//! Tables as legacy VTK (The VTK User's Guide, "VTK File Formats": simple legacy formats, versions 2 to 5).
//!
//! Read here rather than by a library: the one there is for Rust (vtkio 0.6) rests on releases of its parsers that the
//! compiler announces it will reject.

use super::arrays::{Chosen, Described, cells, hidden, rising};
use super::columns::Validity;
use super::{Table, TableError};
use carom_table::{clipped, quoted};

pub(super) fn read(file: &[u8]) -> Result<Table, TableError> {
    let mut reader = Reader { file, at: 0, binary: false };
    let axes = reader.geometry()?;
    let size = axes.each_ref().map(Vec::len);
    let [points, of_cells] = reader.data(size)?;
    let describe = |a: &Array| Described { name: a.name.to_owned(), components: a.components };
    let point_data: Vec<Described> = points.iter().map(describe).collect();
    let cell_data: Vec<Described> = of_cells.iter().map(describe).collect();
    let wrong = |reader: &Reader, what: String| reader.error(what);
    let (chosen, by_cell) = match Chosen::of(&point_data, false) {
        Ok(chosen) => (chosen, false),
        Err(what) => (Chosen::of(&cell_data, true).map_err(|_| wrong(&reader, what))?, true),
    };
    let (described, arrays) = if by_cell { (cell_data, &of_cells) } else { (point_data, &points) };
    let mut values = vec![None; arrays.len()];
    for i in chosen.used() {
        values[i] = Some(reader.decoded(&arrays[i])?);
    }
    let mask = of_cells.iter().filter(|_| !by_cell).find_map(|a| Some((a, Validity::of(a.name, true)?)));
    let hidden = match mask {
        Some((array, kind)) => Some(hidden(size, kind, &reader.decoded(array)?)),
        None => None,
    };
    chosen.table(axes, &described, &values, hidden.as_deref()).map_err(|what| reader.error(what))
}

/// Where an array of the file is.
struct Array<'a> {
    name: &'a str,
    components: usize,
    count: usize,
    kind: &'a str,
    at: usize,
}

struct Reader<'a> {
    file: &'a [u8],
    at: usize,
    binary: bool,
}

impl<'a> Reader<'a> {
    fn error(&self, what: impl Into<String>) -> TableError {
        TableError::Vtk { byte: self.at, what: what.into() }
    }

    /// The rest of the line, trimmed; `None` at the end of the file.
    fn line(&mut self) -> Option<&'a str> {
        let rest = self.file.get(self.at..).filter(|r| !r.is_empty())?;
        let end = rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        self.at += (end + 1).min(rest.len());
        Some(std::str::from_utf8(&rest[..end]).unwrap_or("").trim())
    }

    /// The words of the next line that is not empty.
    fn words(&mut self) -> Option<Vec<&'a str>> {
        loop {
            let line = self.line()?;
            if !line.is_empty() {
                return Some(line.split_whitespace().collect());
            }
        }
    }

    /// The next line's words after `keyword`.
    fn expect(&mut self, keyword: &str, count: usize) -> Result<Vec<&'a str>, TableError> {
        let words = self.words().unwrap_or_default();
        match words.split_first() {
            Some((first, rest)) if first.eq_ignore_ascii_case(keyword) && rest.len() >= count => Ok(rest.to_vec()),
            _ => Err(self.error(format!("{} where {keyword} should be", quoted(&words.join(" "))))),
        }
    }

    fn parse<T: std::str::FromStr>(&self, word: &str) -> Result<T, TableError> {
        word.parse().map_err(|_| self.error(format!("{} is not a number", quoted(word))))
    }

    fn geometry(&mut self) -> Result<[Vec<f64>; 3], TableError> {
        if !self.line().is_some_and(|l| l.starts_with("# vtk DataFile")) {
            return Err(self.error("not a legacy VTK file: it must begin with \"# vtk DataFile\""));
        }
        self.line();
        self.binary = match self.line() {
            Some(l) if l.eq_ignore_ascii_case("ascii") => false,
            Some(l) if l.eq_ignore_ascii_case("binary") => true,
            _ => return Err(self.error("the third line must be ASCII or BINARY")),
        };
        let kind = self.expect("DATASET", 1)?[0].to_ascii_uppercase();
        let words = self.expect("DIMENSIONS", 3)?;
        let mut size = [0usize; 3];
        for (n, word) in size.iter_mut().zip(words) {
            *n = self.parse(word)?;
        }
        let nodes = size.iter().try_fold(1usize, |n, m| n.checked_mul(*m));
        // every node takes some bytes: a size beyond the file's is a mistake, not a reason to allocate
        if nodes.is_none_or(|n| n == 0 || n > self.file.len()) {
            return Err(self.error(format!("dimensions {size:?} do not fit the file")));
        }
        let axes = match kind.as_str() {
            "RECTILINEAR_GRID" => self.coordinates(size)?,
            "STRUCTURED_POINTS" => self.origin_and_spacing(size)?,
            _ => {
                return Err(self.error(format!(
                    "{} is not a rectilinear grid: a mesh is resampled first (ParaView: Resample To Image)",
                    clipped(&kind)
                )));
            }
        };
        rising(&axes).map_err(|what| self.error(what))?;
        Ok(axes)
    }

    fn coordinates(&mut self, size: [usize; 3]) -> Result<[Vec<f64>; 3], TableError> {
        let mut axes = [const { Vec::new() }; 3];
        for (i, keyword) in ["X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES"].into_iter().enumerate() {
            let words = self.expect(keyword, 2)?;
            let count: usize = self.parse(words[0])?;
            if count != size[i] {
                return Err(self.error(format!("{keyword} has {count} values, DIMENSIONS says {}", size[i])));
            }
            axes[i] = self.values(count, words[1], true)?;
            self.skip_metadata();
        }
        Ok(axes)
    }

    fn origin_and_spacing(&mut self, size: [usize; 3]) -> Result<[Vec<f64>; 3], TableError> {
        let mut given = [None; 2];
        while given.contains(&None) {
            let words = self.words().unwrap_or_default();
            let which = match words.first().map(|w| w.to_ascii_uppercase()).as_deref() {
                Some("ORIGIN") => 0,
                Some("SPACING" | "ASPECT_RATIO") => 1,
                _ => return Err(self.error("ORIGIN and SPACING must follow DIMENSIONS")),
            };
            let mut triple = [0.0f64; 3];
            for (i, c) in triple.iter_mut().enumerate() {
                *c = self.parse(words.get(i + 1).copied().unwrap_or(""))?;
            }
            given[which] = Some(triple);
        }
        let [origin, spacing] = given.map(Option::unwrap_or_default);
        if origin.iter().chain(&spacing).any(|c| !c.is_finite()) {
            return Err(self.error("ORIGIN and SPACING must be finite"));
        }
        Ok([0, 1, 2].map(|i| (0..size[i]).map(|n| origin[i] + n as f64 * spacing[i]).collect()))
    }

    /// Where every array of the points and of the cells is.
    fn data(&mut self, size: [usize; 3]) -> Result<[Vec<Array<'a>>; 2], TableError> {
        let [nodes, cells] = [size, cells(size)].map(|s| s.iter().product::<usize>());
        self.skip_metadata();
        let (mut found, mut which) = ([Vec::new(), Vec::new()], None);
        while let Some(words) = self.words() {
            let keyword = words[0].to_ascii_uppercase();
            let rest = words.get(1..).unwrap_or_default();
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
                    while self.line().is_some_and(|l| !l.is_empty()) {}
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
            let mut arrays = Vec::new();
            match (keyword.as_str(), rest) {
                ("VECTORS" | "NORMALS", [name, kind]) => arrays.push(self.array(name, 3, tuples, kind)?),
                ("SCALARS", [name, kind, rest @ ..]) => {
                    let components = rest.first().map_or(Ok(1), |n| self.parse(n))?;
                    self.expect("LOOKUP_TABLE", 1)?;
                    arrays.push(self.array(name, components, tuples, kind)?);
                }
                ("FIELD", [_, count]) => {
                    for _ in 0..self.parse::<usize>(count)? {
                        self.skip_metadata();
                        let words = self.words().unwrap_or_default();
                        let [name, components, tuples, kind] = words[..] else {
                            return Err(self.error("a field array needs a name, components, tuples and a type"));
                        };
                        let (components, tuples) = (self.parse(components)?, self.parse(tuples)?);
                        arrays.push(self.array(name, components, tuples, kind)?);
                    }
                }
                (other, _) => return Err(self.error(format!("{} is not known in point data", quoted(other)))),
            }
            arrays.retain(|a| tuples.checked_mul(a.components) == Some(a.count));
            if let Some(found) = found.get_mut(place) {
                found.extend(arrays);
            }
        }
        if which.is_none() {
            return Err(self.error("the file ends where POINT_DATA should be"));
        }
        Ok(found)
    }

    /// An array from here on, passed over.
    fn array(
        &mut self,
        name: &'a str,
        components: usize,
        tuples: usize,
        kind: &'a str,
    ) -> Result<Array<'a>, TableError> {
        let count = components.checked_mul(tuples).ok_or_else(|| self.error("an array too large"))?;
        let array = Array { name, components, count, kind, at: self.at };
        self.values(count, kind, false)?;
        Ok(array)
    }

    /// The values of an array.
    fn decoded(&mut self, array: &Array) -> Result<Vec<f64>, TableError> {
        self.at = array.at;
        self.values(array.count, array.kind, true)
    }

    /// Blocks that newer versions put after arrays, up to an empty line.
    fn skip_metadata(&mut self) {
        loop {
            let here = self.at;
            match self.words() {
                Some(words) if words[0] == "METADATA" => while self.line().is_some_and(|l| !l.is_empty()) {},
                _ => {
                    self.at = here;
                    return;
                }
            }
        }
    }

    /// `count` numbers of a VTK type, kept or passed over; binary ones are big-endian.
    fn values(&mut self, count: usize, kind: &str, keep: bool) -> Result<Vec<f64>, TableError> {
        // in binary files, eight bits may be a byte
        if count / 8 > self.file.len() - self.at {
            return Err(self.error(format!("the file ends before {count} values")));
        }
        if self.binary { self.binary_values(count, kind, keep) } else { self.ascii_values(count, keep) }
    }

    fn ascii_values(&mut self, count: usize, keep: bool) -> Result<Vec<f64>, TableError> {
        let mut values = Vec::new();
        let mut met = 0;
        while met < count {
            let Some(words) = self.words() else {
                return Err(self.error(format!("the file ends after {met} of {count} values")));
            };
            met += words.len();
            if keep {
                for word in words {
                    values.push(self.parse(word)?);
                }
            }
        }
        if met > count {
            return Err(self.error(format!("more than {count} values")));
        }
        Ok(values)
    }

    fn binary_values(&mut self, count: usize, kind: &str, keep: bool) -> Result<Vec<f64>, TableError> {
        fn take<const N: usize>(bytes: &[u8], f: fn([u8; N]) -> f64) -> Vec<f64> {
            bytes.as_chunks::<N>().0.iter().map(|c| f(*c)).collect()
        }
        type Take = fn(&[u8]) -> Vec<f64>;
        let (width, read): (usize, Take) = match kind.to_ascii_lowercase().as_str() {
            "float" => (4, |b| take(b, |b| f64::from(f32::from_be_bytes(b)))),
            "double" => (8, |b| take(b, f64::from_be_bytes)),
            "char" | "signed_char" => (1, |b| take(b, |b| f64::from(i8::from_be_bytes(b)))),
            "unsigned_char" => (1, |b| take(b, |b| f64::from(u8::from_be_bytes(b)))),
            "short" => (2, |b| take(b, |b| f64::from(i16::from_be_bytes(b)))),
            "unsigned_short" => (2, |b| take(b, |b| f64::from(u16::from_be_bytes(b)))),
            "int" => (4, |b| take(b, |b| f64::from(i32::from_be_bytes(b)))),
            "unsigned_int" => (4, |b| take(b, |b| f64::from(u32::from_be_bytes(b)))),
            "long" | "vtkidtype" | "vtktypeint64" => (8, |b| take(b, |b| i64::from_be_bytes(b) as f64)),
            "unsigned_long" | "vtktypeuint64" => (8, |b| take(b, |b| u64::from_be_bytes(b) as f64)),
            _ => return Err(self.error(format!("binary values of type {}, which is not read", quoted(kind)))),
        };
        let end = count.checked_mul(width).and_then(|n| n.checked_add(self.at));
        let Some(bytes) = end.and_then(|end| self.file.get(self.at..end)) else {
            return Err(self.error(format!("the file ends before {count} values")));
        };
        self.at += bytes.len();
        Ok(if keep { read(bytes) } else { Vec::new() })
    }
}

#[cfg(test)]
mod tests;
