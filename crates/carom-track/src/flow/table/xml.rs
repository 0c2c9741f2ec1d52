//! Tables as VTK XML (`.vtr` rectilinear grids and `.vti` images), as ParaView and the vtk package write them: ASCII, or binary
//! inline or appended, raw or base64, plain or compressed with zlib.
//!
//! XML, base64 and zlib are those of roxmltree, base64 and flate2, which the program holds for its pictures anyway; vtkio, the
//! library for VTK, would bring second ones, and LZ4 and LZMA, of which ParaView's default needs none.

use super::vtk::{Array, rising, table};
use super::{Table, TableError};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use roxmltree::{Document, Node};
use std::io::Read as _;

pub(super) fn read(file: &[u8]) -> Result<Table, TableError> {
    read_or_say(file).map_err(|what| TableError::Xml { what })
}

fn read_or_say(file: &[u8]) -> Result<Table, String> {
    let (text, appended) = apart(file)?;
    let document = Document::parse(&text).map_err(|e| e.to_string())?;
    let root = document.root_element();
    let kind = root.attribute("type").unwrap_or("no type");
    let form = Form::of(root, appended)?;
    let grid = child(root, kind).filter(|_| matches!(kind, "RectilinearGrid" | "ImageData"));
    let grid = grid.ok_or_else(|| format!("a rectilinear grid (.vtr) or an image (.vti) is read, not {kind}"))?;
    let pieces: Vec<Node> = grid.children().filter(|n| n.has_tag_name("Piece")).collect();
    let [piece] = pieces[..] else {
        return Err(format!("{} pieces; one is read", pieces.len()));
    };
    let extent: Vec<i64> = numbers(piece, "Extent")?;
    let [a, b, c, d, e, f] = extent[..] else { return Err("Extent needs six numbers".to_owned()) };
    let size =
        [(a, b), (c, d), (e, f)].map(|(low, high)| high.checked_sub(low).and_then(|n| usize::try_from(n + 1).ok()));
    // zlib makes no more than 1032 bytes of one: a size beyond is a mistake, not a reason to allocate
    let nodes = size.iter().try_fold(1usize, |n, m| n.checked_mul((*m)?)).filter(|n| *n > 0 && n / 1032 <= file.len());
    let ([Some(nx), Some(ny), Some(nz)], Some(nodes)) = (size, nodes) else {
        return Err(format!("the extent {extent:?} does not fit the file"));
    };
    let axes = if kind == "ImageData" {
        evenly(grid, [a, c, e], [nx, ny, nz])?
    } else {
        let coordinates = child(piece, "Coordinates").ok_or("no Coordinates")?;
        let all: Vec<Node> = arrays(coordinates).collect();
        let [x, y, z] = all[..] else { return Err("Coordinates needs three arrays".to_owned()) };
        [form.values(x, nx)?, form.values(y, ny)?, form.values(z, nz)?]
    };
    rising(&axes)?;
    let data = child(piece, "PointData").ok_or("no PointData")?;
    let mut found = Vec::new();
    for array in arrays(data).filter(|a| a.attribute("type") != Some("String")) {
        let components =
            array.attribute("NumberOfComponents").map_or(Ok(1), str::parse).map_err(|_| "NumberOfComponents?")?;
        let name = array.attribute("Name").unwrap_or_default().to_owned();
        // others are not worth reading
        if components == 3 || components == 1 && ["k", "epsilon"].iter().any(|n| name.eq_ignore_ascii_case(n)) {
            let count = nodes.checked_mul(components).ok_or("too many values")?;
            found.push(Array { values: form.values(array, count)?, name, components });
        }
    }
    table(axes, &found)
}

fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|n| n.has_tag_name(name))
}

fn arrays<'a, 'b>(node: Node<'a, 'b>) -> impl Iterator<Item = Node<'a, 'b>> {
    node.children().filter(|n| n.has_tag_name("DataArray"))
}

fn numbers<T: std::str::FromStr>(node: Node, name: &str) -> Result<Vec<T>, String> {
    let text = node.attribute(name).ok_or_else(|| format!("no {name}"))?;
    let all = text.split_whitespace().map(str::parse).collect::<Result<_, _>>();
    all.map_err(|_| format!("{name} is \"{text}\""))
}

/// The axes of an image.
fn evenly(grid: Node, first: [i64; 3], size: [usize; 3]) -> Result<[Vec<f64>; 3], String> {
    if grid.attribute("Direction").is_some()
        && numbers::<f64>(grid, "Direction")? != [1., 0., 0., 0., 1., 0., 0., 0., 1.]
    {
        return Err("an image that is turned (Direction) is not read".to_owned());
    }
    let triple = |name| match numbers::<f64>(grid, name)?[..] {
        [x, y, z] if f64::is_finite(x + y + z) => Ok([x, y, z]),
        _ => Err(format!("{name} needs three numbers")),
    };
    let (origin, spacing) = (triple("Origin")?, triple("Spacing")?);
    Ok([0, 1, 2].map(|i| (0..size[i]).map(|n| origin[i] + (first[i] as f64 + n as f64) * spacing[i]).collect()))
}

/// Appended data, if there is any, and whether it is base64.
type Appended<'a> = Option<(&'a [u8], bool)>;

/// The XML without its appended data, which need not be XML; and that data, behind its `_`, with its encoding.
fn apart(file: &[u8]) -> Result<(String, Appended<'_>), String> {
    const BEGIN: &[u8] = b"<AppendedData";
    let begin = file.windows(BEGIN.len()).position(|w| w == BEGIN);
    let utf8 = |bytes: &[u8]| std::str::from_utf8(bytes).map(str::to_owned).map_err(|e| format!("not XML: {e}"));
    let Some(begin) = begin else { return Ok((utf8(file)?, None)) };
    let tail = &file[begin..];
    let (tag, data) = match (tail.iter().position(|b| *b == b'>'), tail.iter().position(|b| *b == b'_')) {
        (Some(end), Some(data)) if end < data => (utf8(&tail[..end])?, &tail[data + 1..]),
        _ => return Err("AppendedData without its _".to_owned()),
    };
    let encoded = !tag.contains("raw");
    Ok((utf8(&file[..begin])? + "</VTKFile>", Some((data, encoded))))
}

/// How a file holds its numbers.
struct Form<'a> {
    appended: Appended<'a>,
    /// Sizes have 8 bytes instead of 4.
    wide: bool,
    big_endian: bool,
    compressed: bool,
}

impl<'a> Form<'a> {
    fn of(root: Node, appended: Appended<'a>) -> Result<Self, String> {
        let compressed = match root.attribute("compressor") {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                return Err(format!(
                    "compressed by {other}; save it with ZLib compression or none, or as legacy VTK (.vtk)"
                ));
            }
        };
        let wide = root.attribute("header_type") == Some("UInt64");
        Ok(Self { appended, wide, big_endian: root.attribute("byte_order") == Some("BigEndian"), compressed })
    }

    /// The values of an array, of which so many are wanted.
    fn values(&self, array: Node, count: usize) -> Result<Vec<f64>, String> {
        let name = array.attribute("Name").unwrap_or_default();
        let failed = |what: String| format!("array \"{name}\": {what}");
        let kind = array.attribute("type").unwrap_or_default();
        let text = array.text().unwrap_or_default();
        let values = match array.attribute("format") {
            Some("appended") => {
                let (data, encoded) = self.appended.ok_or_else(|| failed("no AppendedData".to_owned()))?;
                let offset = array.attribute("offset").and_then(|o| o.trim().parse::<usize>().ok());
                let rest =
                    offset.and_then(|o| data.get(o..)).ok_or_else(|| failed("offset beyond the file".to_owned()))?;
                self.binary(&mut Stretch { rest, encoded }, count, kind)
            }
            Some("binary") => self.binary(&mut Stretch { rest: text.trim().as_bytes(), encoded: true }, count, kind),
            _ => text.split_whitespace().map(|w| w.parse().map_err(|_| format!("\"{w}\" is not a number"))).collect(),
        }
        .map_err(failed)?;
        match values.iter().any(|v: &f64| !v.is_finite()) {
            _ if values.len() != count => Err(failed(format!("{} values where {count} are wanted", values.len()))),
            true => Err(failed("NaN or infinity among the values".to_owned())),
            false => Ok(values),
        }
    }

    fn binary(&self, stretch: &mut Stretch, count: usize, kind: &str) -> Result<Vec<f64>, String> {
        let (width, read) = reader(kind, self.big_endian)?;
        let wanted = count.checked_mul(width).ok_or("too many values")?;
        let bytes = if self.compressed { self.inflate(stretch, wanted)? } else { self.plain(stretch)? };
        if bytes.len() != wanted {
            return Err(format!("{} bytes where {wanted} are wanted", bytes.len()));
        }
        Ok(bytes.chunks_exact(width).map(read).collect())
    }

    fn sizes(&self, bytes: &[u8]) -> Vec<usize> {
        let width = if self.wide { 8 } else { 4 };
        let size = |chunk: &[u8]| {
            let one = |n: usize, b: &u8| n << 8 | usize::from(*b);
            if self.big_endian { chunk.iter().fold(0, one) } else { chunk.iter().rev().fold(0, one) }
        };
        bytes.chunks_exact(width).map(size).collect()
    }

    /// A length, then as many bytes, encoded together or each by itself.
    fn plain(&self, stretch: &mut Stretch) -> Result<Vec<u8>, String> {
        let width = if self.wide { 8 } else { 4 };
        let length = self.sizes(&stretch.clone().part(width)?).first().copied().unwrap_or_default();
        if stretch.encoded && !stretch.ends_within(width) {
            let whole = length.checked_add(width).ok_or("cut short")?;
            return Ok(stretch.part(whole)?.split_off(width));
        }
        stretch.part(width)?;
        stretch.part(length)
    }

    /// Numbers and sizes of blocks, then the blocks.
    fn inflate(&self, stretch: &mut Stretch, wanted: usize) -> Result<Vec<u8>, String> {
        let width = if self.wide { 8 } else { 4 };
        let blocks = self.sizes(&stretch.clone().part(width)?).first().copied().unwrap_or_default();
        let header = blocks.checked_add(3).and_then(|n| n.checked_mul(width)).ok_or("cut short")?;
        let sizes = self.sizes(&stretch.part(header)?).split_off(3);
        let all = sizes.iter().try_fold(0usize, |n, m| n.checked_add(*m)).ok_or("cut short")?;
        let packed = stretch.part(all)?;
        let (mut bytes, mut rest) = (Vec::new(), packed.as_slice());
        for size in sizes {
            let (block, after) = rest.split_at_checked(size).ok_or("cut short")?;
            rest = after;
            // one byte more than wanted tells that there is too much
            let room = (wanted + 1).saturating_sub(bytes.len()) as u64;
            flate2::read::ZlibDecoder::new(block).take(room).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
        }
        Ok(bytes)
    }
}

/// How wide a number is, and what it is.
type Reader = (usize, fn(&[u8]) -> f64);

fn reader(kind: &str, big_endian: bool) -> Result<Reader, String> {
    macro_rules! readers {
        ($($name:literal $type:ty),*) => {
            match (kind, big_endian) {
                $(
                    ($name, false) => (size_of::<$type>(), |b: &[u8]| b.try_into().map_or(f64::NAN, |b| <$type>::from_le_bytes(b) as f64)),
                    ($name, true) => (size_of::<$type>(), |b: &[u8]| b.try_into().map_or(f64::NAN, |b| <$type>::from_be_bytes(b) as f64)),
                )*
                _ => return Err(format!("type {kind} is not known")),
            }
        };
    }
    let reader: Reader = readers!("Float64" f64, "Float32" f32, "Int64" i64, "UInt64" u64, "Int32" i32, "UInt32" u32,
        "Int16" i16, "UInt16" u16, "Int8" i8, "UInt8" u8);
    Ok(reader)
}

/// Bytes on their way: raw, or base64 in parts each encoded by itself.
#[derive(Clone)]
struct Stretch<'a> {
    rest: &'a [u8],
    encoded: bool,
}

impl Stretch<'_> {
    /// The next bytes, which were encoded together.
    fn part(&mut self, bytes: usize) -> Result<Vec<u8>, String> {
        let long = if self.encoded { bytes.div_ceil(3).checked_mul(4).ok_or("cut short")? } else { bytes };
        let (part, rest) = self.rest.split_at_checked(long).ok_or("cut short")?;
        self.rest = rest;
        if !self.encoded {
            return Ok(part.to_vec());
        }
        let mut decoded = STANDARD.decode(part).map_err(|e| format!("base64: {e}"))?;
        if decoded.len() < bytes {
            return Err("cut short".to_owned());
        }
        decoded.truncate(bytes);
        Ok(decoded)
    }

    /// Whether so many bytes were encoded by themselves: they then end in padding.
    fn ends_within(&self, bytes: usize) -> bool {
        let long = bytes.div_ceil(3) * 4;
        self.rest.get(long.saturating_sub(1)) == Some(&b'=')
    }
}

#[cfg(test)]
mod tests;
