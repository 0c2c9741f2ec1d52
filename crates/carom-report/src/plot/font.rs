//! DejaVu Sans from inside the crate: how wide text is, and the letters of PNG text.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId};

/// Families for SVG text; Verdana is about as wide where DejaVu Sans is not installed.
pub(super) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

pub(super) static FACE: LazyLock<Option<Face<'static>>> =
    LazyLock::new(|| Face::parse(dejavu::sans::regular(), 0).ok());

/// Width of one line of text at a font size, both in CSS pixels.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let Some(face) = FACE.as_ref() else {
        return 0.6 * size * text.chars().count() as f64;
    };
    scale(face, size) * glyphs(face, text).map(|(_, advance)| advance).sum::<f64>()
}

/// CSS pixels for each unit of the font.
pub(super) fn scale(face: &Face<'_>, size: f64) -> f64 {
    size / f64::from(face.units_per_em())
}

/// The glyphs of a line of text, each with its width in the font's units. What the font lacks is shown as its empty box, glyph 0.
pub(super) fn glyphs(face: &Face<'_>, text: &str) -> impl Iterator<Item = (GlyphId, f64)> {
    text.chars().map(|c| {
        let glyph = face.glyph_index(c).unwrap_or_default();
        (glyph, face.glyph_hor_advance(glyph).unwrap_or_default().into())
    })
}
