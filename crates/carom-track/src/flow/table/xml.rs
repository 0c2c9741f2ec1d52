//! Tables as VTK XML (`.vtr` rectilinear grids and `.vti` images), as ParaView and the vtk package write them: ASCII, or binary
//! inline or appended, raw or base64, plain or compressed with zlib or LZ4, in one piece or several.
//!
//! XML, base64 and zlib are those of roxmltree, base64 and flate2, which the program holds for its pictures anyway, and LZ4 that of
//! lz4_flex; vtkio, the library for VTK, would bring second ones. LZMA, which no program chooses unasked, is refused.

mod pieces;

use super::arrays::{Chosen, Described, cells, hidden};
use super::columns::Validity;
use super::{Table, TableError};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use carom_table::{clipped, quoted};
use roxmltree::{Document, Node};
use std::io::Read as _;

pub(super) fn read(file: &[u8]) -> Result<Table, TableError> {
    read_or_say(file).map_err(|what| TableError::Xml { what })
}

fn read_or_say(file: &[u8]) -> Result<Table, String> {
    let (text, appended) = apart(file)?;
    few_attributes(&text)?;
    let document = Document::parse(&text).map_err(|e| clipped(&e.to_string()).into_owned())?;
    let root = document.root_element();
    let kind = root.attribute("type").unwrap_or("no type");
    let form = Form::of(root, appended)?;
    let grid = child(root, kind).filter(|_| matches!(kind, "RectilinearGrid" | "ImageData"));
    let grid =
        grid.ok_or_else(|| format!("a rectilinear grid (.vtr) or an image (.vti) is read, not {}", clipped(kind)))?;
    let pieces: Vec<Node> = grid.children().filter(|n| n.has_tag_name("Piece")).collect();
    let whole = match pieces[..] {
        [] => return Err("no Piece".to_owned()),
        [one] => Extent::of(one, "Extent")?,
        _ => Extent::of(grid, "WholeExtent")?,
    };
    // no compression makes more than 1032 bytes of one: a size beyond is a mistake, not a reason to allocate
    if whole.nodes().is_none_or(|n| n / 1032 > file.len()) {
        return Err(format!("the extent {whole} does not fit the file"));
    }
    let mut read = pieces::Pieces::new(whole);
    for piece in &pieces {
        read.add(&form, *piece, grid, kind == "ImageData")?;
    }
    read.table()
}

/// A box of nodes, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Extent {
    first: [i64; 3],
    size: [usize; 3],
}

impl Extent {
    fn of(node: Node, name: &str) -> Result<Self, String> {
        let numbers: Vec<i64> = numbers(node, name)?;
        let [a, b, c, d, e, f] = numbers[..] else { return Err(format!("{name} needs six numbers")) };
        let size = [(a, b), (c, d), (e, f)]
            .map(|(low, high)| high.checked_sub(low).and_then(|n| usize::try_from(n).ok()?.checked_add(1)));
        match size {
            [Some(x), Some(y), Some(z)] => Ok(Self { first: [a, c, e], size: [x, y, z] }),
            _ => Err(format!("the {name} {numbers:?} does not fit the file")),
        }
    }

    fn nodes(&self) -> Option<usize> {
        self.size.iter().try_fold(1usize, |n, m| n.checked_mul(*m))
    }
}

impl std::fmt::Display for Extent {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let last = |c: usize| i128::from(self.first[c]) + self.size[c] as i128 - 1;
        let [a, b, c] = self.first;
        write!(f, "{a} {} {b} {} {c} {}", last(0), last(1), last(2))
    }
}

/// The arrays of a piece, and which are used.
struct Fields<'f, 'a, 'b> {
    form: &'f Form<'f>,
    piece: Node<'a, 'b>,
    arrays: Vec<Node<'a, 'b>>,
    described: Vec<Described>,
    chosen: Chosen,
    /// Nodes.
    size: [usize; 3],
    of_cells: bool,
}

impl<'f, 'a, 'b> Fields<'f, 'a, 'b> {
    /// Point data, or cell data where the points have no velocity.
    fn of(form: &'f Form<'f>, piece: Node<'a, 'b>, size: [usize; 3]) -> Result<Self, String> {
        let fields = |name: &str, of_cells: bool| -> Result<Self, String> {
            let data = child(piece, name).ok_or_else(|| format!("no {name}"))?;
            let arrays: Vec<Node> = arrays(data).filter(|a| a.attribute("type") != Some("String")).collect();
            let described = arrays.iter().map(|a| describe(*a)).collect::<Result<Vec<_>, _>>()?;
            let chosen = Chosen::of(&described, of_cells)?;
            Ok(Self { form, piece, arrays, described, chosen, size, of_cells })
        };
        fields("PointData", false).or_else(|what| fields("CellData", true).map_err(|_| what))
    }

    fn count(&self) -> Result<usize, String> {
        let size = if self.of_cells { cells(self.size) } else { self.size };
        size.iter().try_fold(1usize, |n, m| n.checked_mul(*m)).ok_or_else(|| "too many values".to_owned())
    }

    /// The values of the arrays that are used.
    fn read(&self) -> Result<Vec<Option<Vec<f64>>>, String> {
        let (used, count) = (self.chosen.used(), self.count()?);
        let mut values = vec![None; self.arrays.len()];
        for i in used {
            let all = count.checked_mul(self.described[i].components).ok_or("too many values")?;
            values[i] = Some(self.form.values(self.arrays[i], all)?);
        }
        Ok(values)
    }

    /// The nodes that a mask of the cells hides, where the data are of points.
    fn hidden(&self) -> Result<Option<Vec<bool>>, String> {
        let Some(data) = child(self.piece, "CellData").filter(|_| !self.of_cells) else { return Ok(None) };
        let kind = |a: &Node| Validity::of(a.attribute("Name").unwrap_or_default(), true);
        let Some((array, kind)) = arrays(data).find_map(|a| Some((a, kind(&a)?))) else { return Ok(None) };
        let count = cells(self.size).iter().product();
        Ok(Some(hidden(self.size, kind, &self.form.values(array, count)?)))
    }
}

fn describe(array: Node) -> Result<Described, String> {
    let name = array.attribute("Name").unwrap_or_default().to_owned();
    let components = array.attribute("NumberOfComponents").unwrap_or("1");
    let components = components.parse().map_err(|_| format!("NumberOfComponents of {}?", quoted(&name)))?;
    Ok(Described { name, components })
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
    all.map_err(|_| format!("{name} is {}", quoted(text)))
}

/// The axes of an image.
fn evenly(grid: Node, Extent { first, size }: Extent) -> Result<[Vec<f64>; 3], String> {
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

/// Refuses elements of so many attributes that looking for doubled ones takes long.
fn few_attributes(text: &str) -> Result<(), String> {
    const MOST: usize = 200;
    let many = |tag: &str| tag.split('>').next().unwrap_or_default().matches('=').count() > MOST;
    if text.split('<').any(many) { Err(format!("an element with more than {MOST} attributes")) } else { Ok(()) }
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
    compressor: Option<Compressor>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Compressor {
    Zlib,
    Lz4,
}

impl<'a> Form<'a> {
    fn of(root: Node, appended: Appended<'a>) -> Result<Self, String> {
        let compressor = match root.attribute("compressor") {
            None | Some("") => None,
            Some("vtkZLibDataCompressor") => Some(Compressor::Zlib),
            Some("vtkLZ4DataCompressor") => Some(Compressor::Lz4),
            Some(other) => {
                return Err(format!(
                    "compressed by {}, which is not read: choose ZLib, LZ4 or None as its compression when saving (in ParaView's \
                     Save Data: Compressor Type), or save it as legacy VTK (.vtk)",
                    clipped(other)
                ));
            }
        };
        let wide = root.attribute("header_type") == Some("UInt64");
        Ok(Self { appended, wide, big_endian: root.attribute("byte_order") == Some("BigEndian"), compressor })
    }

    /// The values of an array, of which so many are wanted.
    fn values(&self, array: Node, count: usize) -> Result<Vec<f64>, String> {
        let name = array.attribute("Name").unwrap_or_default();
        let failed = |what: String| format!("array {}: {what}", quoted(name));
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
            _ => text
                .split_whitespace()
                .map(|w| w.parse().map_err(|_| format!("{} is not a number", quoted(w))))
                .collect(),
        }
        .map_err(failed)?;
        if values.len() == count {
            Ok(values)
        } else {
            Err(failed(format!("{} values where {count} are wanted", values.len())))
        }
    }

    fn binary(&self, stretch: &mut Stretch, count: usize, kind: &str) -> Result<Vec<f64>, String> {
        let (width, read) = reader(kind, self.big_endian)?;
        let wanted = count.checked_mul(width).ok_or("too many values")?;
        let bytes = match self.compressor {
            Some(compressor) => self.unpack(compressor, stretch, wanted)?,
            None => self.plain(stretch, wanted)?,
        };
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
    fn plain(&self, stretch: &mut Stretch, wanted: usize) -> Result<Vec<u8>, String> {
        let width = if self.wide { 8 } else { 4 };
        let length = self.sizes(&stretch.clone().part(width)?).first().copied().unwrap_or_default();
        promised(length, wanted)?;
        if stretch.encoded && !stretch.ends_within(width) {
            let whole = length.checked_add(width).ok_or("cut short")?;
            return Ok(stretch.part(whole)?.split_off(width));
        }
        stretch.part(width)?;
        stretch.part(length)
    }

    /// Numbers and sizes of blocks, then the blocks.
    fn unpack(&self, compressor: Compressor, stretch: &mut Stretch, wanted: usize) -> Result<Vec<u8>, String> {
        let width = if self.wide { 8 } else { 4 };
        let blocks = self.sizes(&stretch.clone().part(width)?).first().copied().unwrap_or_default();
        let header = blocks.checked_add(3).and_then(|n| n.checked_mul(width)).ok_or("cut short")?;
        let mut first = self.sizes(&stretch.part(header)?);
        let sizes = first.split_off(3);
        // full blocks, and one that is shorter
        let full = if first[2] == 0 { blocks } else { blocks.saturating_sub(1) };
        let length = full.checked_mul(first[1]).and_then(|n| n.checked_add(if blocks == 0 { 0 } else { first[2] }));
        promised(length.unwrap_or(usize::MAX), wanted)?;
        let all = sizes.iter().try_fold(0usize, |n, m| n.checked_add(*m)).ok_or("cut short")?;
        let packed = stretch.part(all)?;
        let (mut bytes, mut rest) = (Vec::new(), packed.as_slice());
        for size in sizes {
            let (block, after) = rest.split_at_checked(size).ok_or("cut short")?;
            rest = after;
            match compressor {
                Compressor::Zlib => {
                    // one byte more than wanted tells that there is too much
                    let room = (wanted + 1).saturating_sub(bytes.len()) as u64;
                    flate2::read::ZlibDecoder::new(block)
                        .take(room)
                        .read_to_end(&mut bytes)
                        .map_err(|e| e.to_string())?;
                }
                Compressor::Lz4 => {
                    let begin = bytes.len();
                    bytes.resize(wanted.min(begin.saturating_add(first[1])), 0);
                    let room = bytes.get_mut(begin..).unwrap_or_default();
                    let length = lz4_flex::block::decompress_into(block, room).map_err(|e| format!("LZ4: {e}"))?;
                    bytes.truncate(begin + length);
                }
            }
        }
        Ok(bytes)
    }
}

/// Refuses, before anything is unpacked, another number of bytes than is wanted.
fn promised(length: usize, wanted: usize) -> Result<(), String> {
    if length == wanted { Ok(()) } else { Err(format!("{length} bytes where {wanted} are wanted")) }
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
                _ => return Err(format!("type {} is not known", quoted(kind))),
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
