//! VTK's XML: its elements, and the numbers of its arrays, ASCII, or binary inline or appended, raw or base64, plain or compressed with
//! zlib or LZ4, in either byte order.
//!
//! XML, base64 and zlib are those of roxmltree, base64 and flate2, which the program holds for its pictures anyway, and LZ4 that of
//! lz4_flex; vtkio, the library for VTK, would bring second ones. LZMA, which no program chooses unasked, is refused.

use super::number::{Number, Stored};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use carom_table::{clipped, quoted};
use memchr::memmem;
use std::borrow::Cow;
use std::io::Read as _;

pub use roxmltree::{Document, Node};

/// Appended data, if there is any, and whether it is base64.
type Appended<'a> = Option<(&'a [u8], bool)>;

/// A file in two parts: its XML, and the appended data, which need not be XML.
#[derive(Debug)]
pub struct Parts<'a> {
    text: Cow<'a, str>,
    appended: Appended<'a>,
}

impl<'a> Parts<'a> {
    /// Takes a file apart.
    pub fn of(file: &'a [u8]) -> Result<Self, String> {
        const BEGIN: &[u8] = b"<AppendedData";
        let utf8 = |bytes: &'a [u8]| std::str::from_utf8(bytes).map_err(|e| format!("not XML: {e}"));
        let Some(begin) = memmem::find(file, BEGIN) else {
            return Ok(Self { text: Cow::Borrowed(utf8(file)?), appended: None });
        };
        let tail = &file[begin..];
        let (tag, data) = match (memchr::memchr(b'>', tail), memchr::memchr(b'_', tail)) {
            (Some(end), Some(data)) if end < data => (utf8(&tail[..end])?, &tail[data + 1..]),
            _ => return Err("AppendedData without its _".to_owned()),
        };
        let encoded = !tag.contains("raw");
        Ok(Self { text: Cow::Owned(format!("{}</VTKFile>", utf8(&file[..begin])?)), appended: Some((data, encoded)) })
    }

    /// The XML.
    pub fn document(&self) -> Result<Document<'_>, String> {
        few_attributes(&self.text)?;
        Document::parse(&self.text).map_err(|e| clipped(&e.to_string()).into_owned())
    }
}

/// Refuses elements of so many attributes that looking for doubled ones takes long.
fn few_attributes(text: &str) -> Result<(), String> {
    const MOST: usize = 200;
    let many = |tag: &str| tag.split('>').next().unwrap_or_default().matches('=').count() > MOST;
    if text.split('<').any(many) { Err(format!("an element with more than {MOST} attributes")) } else { Ok(()) }
}

/// An array's name.
pub fn name<'a>(array: Node<'a, '_>) -> &'a str {
    array.attribute("Name").unwrap_or_default()
}

/// How many numbers an array has for each point or cell.
pub fn components(array: Node) -> Result<usize, String> {
    let written = array.attribute("NumberOfComponents").unwrap_or("1");
    written.trim().parse().map_err(|_| format!("NumberOfComponents of {}?", quoted(name(array))))
}

/// The first child of that name.
pub fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|n| n.has_tag_name(name))
}

/// The arrays of numbers in an element.
pub fn arrays<'a, 'b>(node: Node<'a, 'b>) -> impl Iterator<Item = Node<'a, 'b>> {
    node.children().filter(|n| n.has_tag_name("DataArray") && n.attribute("type") != Some("String"))
}

/// The numbers in an attribute.
pub fn numbers<T: std::str::FromStr>(node: Node, name: &str) -> Result<Vec<T>, String> {
    let text = node.attribute(name).ok_or_else(|| format!("no {name}"))?;
    let all = text.split_whitespace().map(str::parse).collect::<Result<_, _>>();
    all.map_err(|_| format!("{name} is {}", quoted(text)))
}

/// How a file holds its numbers.
#[derive(Debug)]
pub struct Form<'a> {
    appended: Appended<'a>,
    /// Sizes have 8 bytes instead of 4.
    wide: bool,
    big_endian: bool,
    /// Or why what is compressed is not read.
    compressor: Result<Option<Compressor>, String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Compressor {
    Zlib,
    Lz4,
}

/// No compression makes more bytes than so many of one: a size beyond is a mistake, not a reason to allocate.
pub const MOST_PACKED: usize = 1032;

impl<'a> Form<'a> {
    /// Of a file with that root element.
    pub fn of(root: Node, parts: &Parts<'a>) -> Result<Self, String> {
        // ASCII files may name one too, and have nothing that is compressed
        let compressor = match root.attribute("compressor") {
            None | Some("") => Ok(None),
            Some("vtkZLibDataCompressor") => Ok(Some(Compressor::Zlib)),
            Some("vtkLZ4DataCompressor") => Ok(Some(Compressor::Lz4)),
            Some(other) => Err(format!(
                "compressed by {}, which is not read: choose ZLib, LZ4 or None as its compression when saving (in ParaView's \
                 Save Data: Compressor Type), or save it as legacy VTK (.vtk)",
                clipped(other)
            )),
        };
        let wide = root.attribute("header_type") == Some("UInt64");
        let big_endian = root.attribute("byte_order") == Some("BigEndian");
        Ok(Self { appended: parts.appended, wide, big_endian, compressor })
    }

    /// The values of an array, of which so many are wanted.
    pub fn values<T: Number>(&self, array: Node, count: usize) -> Result<Vec<T>, String> {
        let values = self.all(array, Some(count))?;
        if values.len() == count {
            Ok(values)
        } else {
            Err(format!("array {}: {} values where {count} are wanted", quoted(name(array)), values.len()))
        }
    }

    /// The values of an array, as many as there are.
    pub fn every<T: Number>(&self, array: Node) -> Result<Vec<T>, String> {
        self.all(array, None)
    }

    fn all<T: Number>(&self, array: Node, count: Option<usize>) -> Result<Vec<T>, String> {
        let text = array.text().unwrap_or_default();
        match array.attribute("format") {
            Some("appended") => self.appended(array).and_then(|stretch| self.binary(stretch, count, array)),
            Some("binary") => {
                let text = unwrapped(text.trim());
                self.binary(Stretch { rest: text.as_bytes(), encoded: true }, count, array)
            }
            _ => text
                .split_whitespace()
                .map(|w| T::parsed(w).ok_or_else(|| format!("{} is not a number", quoted(w))))
                .collect(),
        }
        .map_err(|what| format!("array {}: {what}", quoted(name(array))))
    }

    fn appended(&self, array: Node) -> Result<Stretch<'a>, String> {
        let (data, encoded) = self.appended.ok_or("no AppendedData")?;
        let offset = array.attribute("offset").and_then(|o| o.trim().parse::<usize>().ok());
        let rest = offset.and_then(|o| data.get(o..)).ok_or("offset beyond the file")?;
        Ok(Stretch { rest, encoded })
    }

    fn binary<T: Number>(&self, mut stretch: Stretch, count: Option<usize>, array: Node) -> Result<Vec<T>, String> {
        let kind = array.attribute("type").unwrap_or_default();
        // the characters of texts
        let stored = if kind == "String" { Some(Stored::U8) } else { Stored::xml(kind) };
        let stored = stored.ok_or_else(|| format!("type {} is not known", quoted(kind)))?;
        let wanted = match count {
            Some(count) => Some(count.checked_mul(stored.width()).ok_or("too many values")?),
            None => None,
        };
        let bytes = match self.compressor.clone()? {
            Some(compressor) => Cow::Owned(self.unpack(compressor, &mut stretch, wanted)?),
            None => self.plain(&mut stretch, wanted)?,
        };
        match wanted {
            Some(wanted) if bytes.len() != wanted => Err(format!("{} bytes where {wanted} are wanted", bytes.len())),
            _ => Ok(stored.decode(&bytes, self.big_endian)),
        }
    }

    fn width(&self) -> usize {
        if self.wide { 8 } else { 4 }
    }

    fn sizes(&self, bytes: &[u8]) -> Vec<usize> {
        let size = |chunk: &[u8]| {
            let one = |n: usize, b: &u8| n << 8 | usize::from(*b);
            if self.big_endian { chunk.iter().fold(0, one) } else { chunk.iter().rev().fold(0, one) }
        };
        bytes.chunks_exact(self.width()).map(size).collect()
    }

    /// A length, then as many bytes, encoded together or each by itself.
    fn plain<'b>(&self, stretch: &mut Stretch<'b>, wanted: Option<usize>) -> Result<Cow<'b, [u8]>, String> {
        let width = self.width();
        let length = self.sizes(&stretch.clone().part(width)?).first().copied().unwrap_or_default();
        promised(length, wanted)?;
        if stretch.encoded && !stretch.ends_within(width) {
            let whole = length.checked_add(width).ok_or("cut short")?;
            return Ok(Cow::Owned(stretch.part(whole)?.into_owned().split_off(width)));
        }
        stretch.part(width)?;
        stretch.part(length)
    }

    /// Numbers and sizes of blocks, then the blocks.
    fn unpack(&self, compressor: Compressor, stretch: &mut Stretch, wanted: Option<usize>) -> Result<Vec<u8>, String> {
        let width = self.width();
        let blocks = self.sizes(&stretch.clone().part(width)?).first().copied().unwrap_or_default();
        let header = blocks.checked_add(3).and_then(|n| n.checked_mul(width)).ok_or("cut short")?;
        let mut first = self.sizes(&stretch.part(header)?);
        let sizes = first.split_off(3);
        // full blocks, and one that is shorter
        let full = if first[2] == 0 { blocks } else { blocks.saturating_sub(1) };
        let length = full.checked_mul(first[1]).and_then(|n| n.checked_add(if blocks == 0 { 0 } else { first[2] }));
        let length = length.unwrap_or(usize::MAX);
        promised(length, wanted)?;
        let all = sizes.iter().try_fold(0usize, |n, m| n.checked_add(*m)).ok_or("cut short")?;
        let packed = stretch.part(all)?;
        let (mut bytes, mut rest) = (Vec::new(), packed.as_ref());
        for size in sizes {
            let (block, after) = rest.split_at_checked(size).ok_or("cut short")?;
            rest = after;
            // one byte more than wanted tells that there is too much
            let room = length.saturating_add(1).saturating_sub(bytes.len());
            let room = room.min(block.len().saturating_mul(MOST_PACKED));
            match compressor {
                Compressor::Zlib => {
                    flate2::read::ZlibDecoder::new(block)
                        .take(room as u64)
                        .read_to_end(&mut bytes)
                        .map_err(|e| e.to_string())?;
                }
                Compressor::Lz4 => {
                    let begin = bytes.len();
                    bytes.resize(begin + room.min(first[1]).min(length - begin), 0);
                    let room = bytes.get_mut(begin..).unwrap_or_default();
                    let length = lz4_flex::block::decompress_into(block, room).map_err(|e| format!("LZ4: {e}"))?;
                    bytes.truncate(begin + length);
                }
            }
        }
        Ok(bytes)
    }
}

/// Base64 without the ends of lines and spaces that it may have been broken by.
fn unwrapped(text: &str) -> Cow<'_, str> {
    if text.bytes().any(|b| b.is_ascii_whitespace()) {
        Cow::Owned(text.split_ascii_whitespace().collect())
    } else {
        Cow::Borrowed(text)
    }
}

/// Refuses, before anything is unpacked, another number of bytes than is wanted.
fn promised(length: usize, wanted: Option<usize>) -> Result<(), String> {
    match wanted {
        Some(wanted) if length != wanted => Err(format!("{length} bytes where {wanted} are wanted")),
        _ => Ok(()),
    }
}

/// Bytes on their way: raw, or base64 in parts each encoded by itself.
#[derive(Clone)]
struct Stretch<'a> {
    rest: &'a [u8],
    encoded: bool,
}

impl<'a> Stretch<'a> {
    /// The next bytes, which were encoded together.
    fn part(&mut self, bytes: usize) -> Result<Cow<'a, [u8]>, String> {
        let long = if self.encoded { bytes.div_ceil(3).checked_mul(4).ok_or("cut short")? } else { bytes };
        let (part, rest) = self.rest.split_at_checked(long).ok_or("cut short")?;
        self.rest = rest;
        if !self.encoded {
            return Ok(Cow::Borrowed(part));
        }
        let mut decoded = STANDARD.decode(part).map_err(|e| format!("base64: {e}"))?;
        if decoded.len() < bytes {
            return Err("cut short".to_owned());
        }
        decoded.truncate(bytes);
        Ok(Cow::Owned(decoded))
    }

    /// Whether so many bytes were encoded by themselves: they then end in padding.
    fn ends_within(&self, bytes: usize) -> bool {
        let long = bytes.div_ceil(3) * 4;
        self.rest.get(long.saturating_sub(1)) == Some(&b'=')
    }
}
