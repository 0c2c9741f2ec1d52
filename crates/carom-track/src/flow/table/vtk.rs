//! Tables as legacy VTK (The VTK User's Guide, "VTK File Formats": simple legacy formats, versions 2 to 5).
//!
//! Read here rather than by a library: the one there is for Rust (vtkio 0.6) rests on releases of its parsers that the
//! compiler announces it will reject.

use super::{Node, Table, TableError};

pub(super) fn read(file: &[u8]) -> Result<Table, TableError> {
    let mut reader = Reader { file, at: 0, binary: false };
    let axes = reader.geometry()?;
    let size = axes.each_ref().map(Vec::len);
    let arrays = reader.point_data(size[0] * size[1] * size[2])?;
    table(axes, &arrays).map_err(|what| reader.error(what))
}

/// Point data.
pub(super) struct Array {
    pub name: String,
    pub components: usize,
    pub values: Vec<f64>,
}

/// Puts axes and arrays together: each array has a tuple for every node, x running fastest.
pub(super) fn table(axes: [Vec<f64>; 3], arrays: &[Array]) -> Result<Table, String> {
    let size = axes.each_ref().map(Vec::len);
    let pick = |names: &[&str]| arrays.iter().find(|a| names.iter().any(|n| a.name.eq_ignore_ascii_case(n)));
    let vectors: Vec<&Array> = arrays.iter().filter(|a| a.components == 3).collect();
    let velocity = match (pick(&["velocity", "u"]).filter(|a| a.components == 3), vectors.as_slice()) {
        (Some(named), _) => named,
        (None, [only]) => only,
        _ => return Err("no point vectors named velocity or U".to_owned()),
    };
    let scalar = |name| pick(&[name]).filter(|a| a.components == 1);
    let (k, epsilon) = (scalar("k"), scalar("epsilon"));
    if k.is_some() != epsilon.is_some() {
        return Err("k and epsilon must both be there, or neither".to_owned());
    }
    if let Some(bad) = [k, epsilon].into_iter().flatten().find(|a| a.values.iter().any(|v| *v < 0.0)) {
        return Err(format!("{} is negative somewhere", bad.name));
    }
    let mut nodes: Vec<Node> = Vec::with_capacity(velocity.values.len() / 3);
    for i in 0..size[0] {
        for j in 0..size[1] {
            for l in 0..size[2] {
                let n = i + size[0] * (j + size[1] * l);
                let of = |a: Option<&Array>| a.map_or(0.0, |a| a.values[n]);
                let [u, v, w] = [0, 1, 2].map(|c| velocity.values[3 * n + c]);
                nodes.push([u, v, w, of(k), of(epsilon)]);
            }
        }
    }
    Ok(Table::new(axes, nodes, k.is_some()))
}

/// Coordinates that do not rise are refused.
pub(super) fn rising(axes: &[Vec<f64>; 3]) -> Result<(), String> {
    match axes.iter().flat_map(|a| a.windows(2)).find(|w| w[0] >= w[1]) {
        Some(w) => Err(format!("coordinates must rise, but {} follows {}", w[1], w[0])),
        None => Ok(()),
    }
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
            _ => Err(self.error(format!("\"{}\" where {keyword} should be", words.join(" ")))),
        }
    }

    fn parse<T: std::str::FromStr>(&self, word: &str) -> Result<T, TableError> {
        word.parse().map_err(|_| self.error(format!("\"{word}\" is not a number")))
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
            _ => return Err(self.error(format!("{kind} is not a rectilinear grid"))),
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
            axes[i] = self.values(count, words[1])?;
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

    /// Every array of the point data; cell data before it is refused, after it ignored.
    fn point_data(&mut self, nodes: usize) -> Result<Vec<Array>, TableError> {
        self.skip_metadata();
        let words = self.expect("POINT_DATA", 1)?;
        if self.parse::<usize>(words[0])? != nodes {
            return Err(self.error(format!("POINT_DATA for {} points on a grid of {nodes}", words[0])));
        }
        let mut arrays = Vec::new();
        while let Some(words) = self.words() {
            match (words[0].to_ascii_uppercase().as_str(), words.get(1..).unwrap_or_default()) {
                ("VECTORS" | "NORMALS", [name, kind]) => arrays.push(self.array(name, 3, nodes, kind)?),
                ("SCALARS", [name, kind, rest @ ..]) => {
                    let components = rest.first().map_or(Ok(1), |n| self.parse(n))?;
                    self.expect("LOOKUP_TABLE", 1)?;
                    arrays.push(self.array(name, components, nodes, kind)?);
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
                ("METADATA", _) => while self.line().is_some_and(|l| !l.is_empty()) {},
                ("CELL_DATA", _) => break,
                (other, _) => return Err(self.error(format!("\"{other}\" is not known in point data"))),
            }
        }
        arrays.retain(|a| a.values.len() == nodes * a.components);
        Ok(arrays)
    }

    fn array(&mut self, name: &str, components: usize, tuples: usize, kind: &str) -> Result<Array, TableError> {
        let count = components.checked_mul(tuples).ok_or_else(|| self.error("an array too large"))?;
        Ok(Array { name: name.to_owned(), components, values: self.values(count, kind)? })
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

    /// `count` finite numbers of a VTK type; binary ones are big-endian.
    fn values(&mut self, count: usize, kind: &str) -> Result<Vec<f64>, TableError> {
        if count > self.file.len() - self.at {
            return Err(self.error(format!("the file ends before {count} values")));
        }
        let values = if self.binary { self.binary_values(count, kind)? } else { self.ascii_values(count)? };
        match values.iter().find(|v| !v.is_finite()) {
            Some(v) => Err(self.error(format!("{v} among the values"))),
            None => Ok(values),
        }
    }

    fn ascii_values(&mut self, count: usize) -> Result<Vec<f64>, TableError> {
        let mut values = Vec::with_capacity(count);
        while values.len() < count {
            let Some(words) = self.words() else {
                return Err(self.error(format!("the file ends after {} of {count} values", values.len())));
            };
            for word in words {
                values.push(self.parse(word)?);
            }
        }
        if values.len() > count {
            return Err(self.error(format!("more than {count} values")));
        }
        Ok(values)
    }

    fn binary_values(&mut self, count: usize, kind: &str) -> Result<Vec<f64>, TableError> {
        fn take<const N: usize>(bytes: &[u8], f: fn([u8; N]) -> f64) -> Vec<f64> {
            bytes.as_chunks::<N>().0.iter().map(|c| f(*c)).collect()
        }
        let width = match kind {
            "float" | "int" => 4,
            "double" => 8,
            _ => return Err(self.error(format!("binary values of type {kind}; float, double and int are read"))),
        };
        let end = count.checked_mul(width).and_then(|n| n.checked_add(self.at));
        let Some(bytes) = end.and_then(|end| self.file.get(self.at..end)) else {
            return Err(self.error(format!("the file ends before {count} values")));
        };
        self.at += bytes.len();
        Ok(match kind {
            "float" => take(bytes, |b| f64::from(f32::from_be_bytes(b))),
            "int" => take(bytes, |b| f64::from(i32::from_be_bytes(b))),
            _ => take(bytes, f64::from_be_bytes),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const HEAD: &str = "# vtk DataFile Version 3.0\na channel\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 3 1\n\
                        X_COORDINATES 2 float\n0 1\nY_COORDINATES 3 float\n0 1\n4\nZ_COORDINATES 1 float\n0\n";
    const DATA: &str = "POINT_DATA 6\nVECTORS U float\n0 0 0  1 0 0\n10 1 0 11 1 0 40 4 0 41 4 0\n\
                        FIELD FieldData 2\nk 1 6 float\n1 1 1 1 1 1\nepsilon 1 6 double\n2 2 2 2 2 2\n\
                        SCALARS p float 1\nLOOKUP_TABLE default\n0 0 0 0 0 0\n";

    #[test]
    fn ascii() {
        let table = Table::from_vtk(format!("{HEAD}{DATA}").as_bytes()).unwrap();
        assert_eq!(table.size(), [2, 3, 1]);
        assert_eq!(table.velocity([0.5, 2.5, 0.0]), [25.5, 2.5, 0.0]);
        let local = table.sample([0.5, 2.5, 0.0]);
        assert_eq!((local.k, local.epsilon), (1.0, 2.0));
    }

    #[test]
    fn binary_with_metadata_on_even_points() {
        let mut file = b"# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET STRUCTURED_POINTS\n".to_vec();
        file.extend(b"DIMENSIONS 2 1 2\nSPACING 0.5 1 2\nORIGIN 1 0 0\nPOINT_DATA 4\nVECTORS velocity double\n");
        for n in 0..4 {
            for c in [f64::from(n), 0.0, 7.5] {
                file.extend(c.to_be_bytes());
            }
        }
        file.extend(b"\nMETADATA\nINFORMATION 0\n\nSCALARS p float 1\nLOOKUP_TABLE default\n");
        file.extend([1.0f32; 4].iter().flat_map(|v| v.to_be_bytes()));
        file.extend(b"\n");
        let table = Table::from_vtk(&file).unwrap();
        assert_eq!(table.bounds(), [[1.0, 0.0, 0.0], [1.5, 0.0, 2.0]]);
        assert_eq!(table.velocity([1.25, 0.0, 1.0]), [1.5, 0.0, 7.5]);
    }

    #[test]
    fn errors_say_what() {
        let fails = |text: String, want: &str| {
            let error = Table::from_vtk(text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(want), "{error}");
        };
        fails("hello".into(), "# vtk DataFile");
        fails(format!("{HEAD}{DATA}").replace("RECTILINEAR_GRID", "POLYDATA"), "POLYDATA is not a rectilinear grid");
        fails(format!("{HEAD}{DATA}").replace("2 3 1", "2 3 4000000000"), "do not fit");
        fails(format!("{HEAD}{DATA}").replace("0 1\n4", "0 1\n1"), "coordinates must rise");
        fails(format!("{HEAD}{DATA}").replace("VECTORS U", "SCALARS U"), "where LOOKUP_TABLE should be");
        fails(format!("{HEAD}{DATA}").replace("epsilon 1", "dissipation 1"), "k and epsilon");
        fails(format!("{HEAD}{DATA}").replace("41 4 0", "41 4 x"), "\"x\" is not a number");
        fails(format!("{HEAD}{DATA}").replace("41 4 0", "41 4 nan"), "NaN among");
        fails(HEAD.into(), "where POINT_DATA should be");
        fails(format!("{HEAD}POINT_DATA 6\n"), "no point vectors");
        fails(format!("{HEAD}POINT_DATA 6\nVECTORS U float\n0 0 0"), "the file ends");
    }

    proptest! {
        #[test]
        fn bytes_never_panic(cut in 0usize..400, at in 0usize..400, byte: u8) {
            let mut file = format!("{HEAD}{DATA}").into_bytes();
            let n = file.len();
            file[at % n] = byte;
            file.truncate(n - cut % n);
            let _ = Table::from_vtk(&file);
            let binary = String::from_utf8_lossy(&file).replace("ASCII", "BINARY");
            let _ = Table::from_vtk(binary.as_bytes());
        }
    }
}
