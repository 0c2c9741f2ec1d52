//! Wavefront OBJ files, as Blender, MeshLab and CAD programs write them: vertices (`v`), faces (`f`) of three or more corners, counted
//! from the first vertex or back from the last one, objects and groups (`o`, `g`). Colours, normals, textures and materials are skipped,
//! and so are points and lines, which are no walls.
//!
//! Read here and not by `tobj`, which gives no line for a mistake, skips lines it does not know, so that a free-form surface is a hole,
//! and splits a face that is not convex into triangles outside it.

use super::{Rounding, Solid, Triangles, TrianglesError, fan, name, quoted};

/// Reads a file's bytes.
///
/// # Errors
/// What is wrong, and where.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles, TrianglesError> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut obj =
        Obj { rounding: Rounding::new(), vertices: Vec::new(), solid: String::new(), read: Triangles::default() };
    let mut lines = text.split(|b| *b == b'\n').zip(1..);
    while let Some((line, number)) = lines.next() {
        let mut line = std::borrow::Cow::Borrowed(line);
        // a line goes on after a backslash
        while let Some(before) = line.trim_ascii_end().strip_suffix(b"\\") {
            let Some((next, _)) = lines.next() else { break };
            line = [before, b" ", next].concat().into();
        }
        obj.line(&line).map_err(|what| TrianglesError::Text { line: number, what })?;
    }
    obj.begin(String::new());
    obj.read.precision = obj.rounding.share();
    Ok(obj.read)
}

struct Obj {
    rounding: Rounding,
    vertices: Vec<[f64; 3]>,
    /// The name of the solid under way.
    solid: String,
    read: Triangles,
}

impl Obj {
    fn line(&mut self, line: &[u8]) -> Result<(), String> {
        let line = line.split(|b| *b == b'#').next().unwrap_or_default().trim_ascii();
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let (key, rest) = line.split_at(end);
        let words = rest.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty());
        match key {
            b"v" => self.vertex(words),
            b"f" | b"fo" => self.face(words),
            b"o" | b"g" => {
                self.begin(name(rest));
                Ok(())
            }
            b"" | b"vn" | b"vt" | b"vp" | b"p" | b"l" | b"s" | b"mg" | b"mtllib" | b"usemtl" | b"maplib"
            | b"usemap" | b"bevel" | b"c_interp" | b"d_interp" | b"lod" | b"shadow_obj" | b"trace_obj" => Ok(()),
            b"cstype" | b"deg" | b"curv" | b"curv2" | b"surf" => {
                Err("a free-form curve or surface is not read: export triangles".to_owned())
            }
            _ => Err(format!("{} begins no line of an OBJ file that is read", quoted(key))),
        }
    }

    fn vertex<'a>(&mut self, mut words: impl Iterator<Item = &'a [u8]>) -> Result<(), String> {
        let mut vertex = [0.0; 3];
        for c in &mut vertex {
            let word = words.next().ok_or("a vertex has three coordinates")?;
            *c = self.rounding.number(word).ok_or_else(|| format!("expected a number, not {}", quoted(word)))?;
            if !c.is_finite() {
                return Err(format!("a corner that is not finite: {}", quoted(word)));
            }
        }
        // a weight or a colour may follow
        self.vertices.push(vertex);
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>) -> Result<(), String> {
        let corners = words.map(|word| self.corner(word)).collect::<Result<Vec<_>, _>>()?;
        if corners.len() < 3 {
            return Err(format!("a face of {} corners", corners.len()));
        }
        let triangles = fan(&corners)
            .ok_or_else(|| format!("a face of {} corners that is not convex: export triangles", corners.len()))?;
        self.read.triangles.extend(triangles);
        Ok(())
    }

    /// The vertex that a corner `v`, `v/vt`, `v//vn` or `v/vt/vn` names.
    fn corner(&self, word: &[u8]) -> Result<[f64; 3], String> {
        let index = word.split(|b| *b == b'/').next().unwrap_or_default();
        let number: Option<i64> = std::str::from_utf8(index).ok().and_then(|i| i.parse().ok());
        let count = self.vertices.len();
        let place = match number {
            Some(n) if n > 0 => usize::try_from(n - 1).ok(),
            Some(n) if n < 0 => usize::try_from(n.unsigned_abs()).ok().and_then(|back| count.checked_sub(back)),
            _ => return Err(format!("expected a vertex's number, not {}", quoted(word))),
        };
        let vertex = place.and_then(|place| self.vertices.get(place));
        vertex.copied().ok_or_else(|| format!("vertex {} of {count} so far", String::from_utf8_lossy(index)))
    }

    /// Ends the solid under way, if it has triangles, and begins another.
    fn begin(&mut self, name: String) {
        let first = self.read.solids.last().map_or(0, |s| s.triangles.end);
        let solid =
            Solid { name: std::mem::replace(&mut self.solid, name), triangles: first..self.read.triangles.len() };
        if !solid.triangles.is_empty() {
            self.read.solids.push(solid);
        }
    }
}
