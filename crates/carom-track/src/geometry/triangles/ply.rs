//! PLY files, text or binary, as scanners and MeshLab write them: the elements `vertex` (with `x`, `y`, `z`) and `face` (with
//! `vertex_indices` or `vertex_index`). Other elements and properties are skipped.

use super::{Rounding, SINGLE, Solid, Triangles, TrianglesError, fan};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult as Taken};

/// Reads a file's bytes.
///
/// # Errors
/// What is wrong, and where.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles, TrianglesError> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Skipped>::new().read_header(&mut reader).map_err(|e| at(&e, "no header of a PLY file"))?;
    let (mut vertices, mut faces): (Vec<Vertex>, Vec<Face>) = (Vec::new(), Vec::new());
    for element in header.elements.values() {
        // each takes a byte at least
        if element.count > bytes.len() {
            return Err(file(format!("its header counts {} of {}", element.count, named(element))));
        }
        match element.name.as_str() {
            "vertex" => vertices = elements(&mut reader, element, &header)?,
            "face" => faces = elements(&mut reader, element, &header)?,
            "tristrips" => return Err(file("strips of triangles are not read: export faces".to_owned())),
            _ => {
                let _: Vec<Skipped> = elements(&mut reader, element, &header)?;
            }
        }
    }
    let mut read = Triangles { precision: rounded_to(&vertices, header.encoding), ..Triangles::default() };
    for (number, face) in (1..).zip(&faces) {
        let corner = |i: &i64| usize::try_from(*i).ok().and_then(|i| vertices.get(i)).map(|v| v.at);
        let corners: Option<Vec<[f64; 3]>> = face.corners.iter().map(corner).collect();
        let corners = corners.ok_or_else(|| file(format!("face {number} names a vertex that is not there")))?;
        if corners.len() < 3 {
            return Err(file(format!("face {number} has {} corners", corners.len())));
        }
        if !corners.iter().flatten().all(|c| c.is_finite()) {
            return Err(file(format!("face {number} has a corner that is not finite")));
        }
        let triangles = fan(&corners).ok_or_else(|| file(format!("face {number} is not convex: export triangles")))?;
        read.triangles.extend(triangles);
    }
    read.solids.push(Solid { name: String::new(), triangles: 0..read.triangles.len() });
    Ok(read)
}

fn elements<E: PropertyAccess>(
    reader: &mut Reader<&[u8]>,
    element: &ElementDef,
    header: &Header,
) -> Result<Vec<E>, TrianglesError> {
    let what = || format!("not {} as the header describes it", named(element));
    Parser::new().read_payload_for_element(reader, element, header).map_err(|e| at(&e, &what()))
}

/// The library's own messages quote whole lines.
fn at(error: &ParseError, what: &str) -> TrianglesError {
    match error.line() {
        Some(line) => TrianglesError::Text { line, what: what.to_owned() },
        None => file(what.to_owned()),
    }
}

fn file(what: String) -> TrianglesError {
    TrianglesError::File(what)
}

fn named(element: &ElementDef) -> String {
    format!("element {}", carom_table::quoted(&element.name))
}

/// What the coordinates were rounded to, as a share of the largest.
fn rounded_to(vertices: &[Vertex], encoding: Encoding) -> f64 {
    if vertices.iter().all(|v| v.single) {
        return SINGLE;
    }
    let mut rounding = Rounding::new();
    for c in vertices.iter().flat_map(|v| v.at) {
        // the shortest digits that give the number are those of a text
        rounding.number(format!("{c:e}").as_bytes());
        if rounding.digits >= 15 {
            break;
        }
    }
    if encoding == Encoding::Ascii || rounding.single { rounding.share() } else { 1e-15 }
}

struct Vertex {
    at: [f64; 3],
    /// Whether no coordinate is of double precision.
    single: bool,
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { at: [f64::NAN; 3], single: true }
    }

    fn set_property(&mut self, name: &str, property: Property) -> Taken {
        let Some(c) = ["x", "y", "z"].iter().position(|axis| *axis == name) else { return Taken::Ignored };
        self.at[c] = match property {
            Property::Float(x) => x.into(),
            Property::Double(x) => {
                self.single = false;
                x
            }
            Property::Char(x) => x.into(),
            Property::UChar(x) => x.into(),
            Property::Short(x) => x.into(),
            Property::UShort(x) => x.into(),
            Property::Int(x) => x.into(),
            Property::UInt(x) => x.into(),
            _ => return Taken::UnsupportedType,
        };
        Taken::Set
    }
}

struct Face {
    corners: Vec<i64>,
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self { corners: Vec::new() }
    }

    fn set_property(&mut self, name: &str, property: Property) -> Taken {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return Taken::Ignored;
        }
        fn all<T: Into<i64>>(list: Vec<T>) -> Vec<i64> {
            list.into_iter().map(Into::into).collect()
        }
        self.corners = match property {
            Property::ListChar(list) => all(list),
            Property::ListUChar(list) => all(list),
            Property::ListShort(list) => all(list),
            Property::ListUShort(list) => all(list),
            Property::ListInt(list) => all(list),
            Property::ListUInt(list) => all(list),
            _ => return Taken::UnsupportedType,
        };
        Taken::Set
    }
}

/// An element that is no part of the surface.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}
