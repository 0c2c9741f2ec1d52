//! DejaVu Sans from inside the crate: how wide text is, and the font that PNG text is drawn with.

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};

/// Families for SVG text; Verdana is about as wide where DejaVu Sans is not installed.
pub(super) const FAMILY: &str = "DejaVu Sans, Verdana, sans-serif";

pub(super) fn bytes() -> &'static [u8] {
    dejavu::sans::regular()
}

/// Width of one line of text at a font size, both in CSS pixels.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let Ok(font) = FontRef::new(bytes()) else {
        return 0.6 * size * text.chars().count() as f64;
    };
    let metrics = font.glyph_metrics(Size::new(size as f32), LocationRef::default());
    let map = font.charmap();
    let advance = |c| metrics.advance_width(map.map(c).unwrap_or_default()).unwrap_or_default();
    text.chars().map(advance).sum::<f32>().into()
}
