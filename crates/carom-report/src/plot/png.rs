//! A picture as PNG bytes: its elements by tiny-skia, its text as outlines of the crate's own font.

use tiny_skia::{
    Color as Rgba, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke as Line, StrokeDash,
    Transform,
};

use super::canvas::{Anchor, Canvas, Element, Fill, Point};
use super::font;
use crate::ReportError;

/// Pixels for each CSS pixel.
const SCALE: f32 = 2.0;

/// # Errors
/// A picture too large for memory, or what the PNG encoder says.
pub(super) fn encode(canvas: &Canvas) -> Result<Vec<u8>, ReportError> {
    let pixels = |length: u32| (length as f32 * SCALE).ceil() as u32;
    let mut pixmap = Pixmap::new(pixels(canvas.size.0), pixels(canvas.size.1))
        .ok_or_else(|| ReportError::draw("PNG", "the picture is too large"))?;
    for element in &canvas.elements {
        draw(&mut pixmap, element);
    }
    pixmap.encode_png().map_err(|e| ReportError::draw("PNG", e))
}

/// Draws one element; one without extent leaves no mark.
fn draw(pixmap: &mut Pixmap, element: &Element) {
    let fill = |pixmap: &mut Pixmap, path: Option<Path>, fill: Fill, transform: Transform| {
        if let Some(path) = path {
            pixmap.fill_path(&path, &paint(fill), FillRule::Winding, transform, None);
        }
    };
    let scale = Transform::from_scale(SCALE, SCALE);
    let opaque = |color| Fill { color, opacity: 1.0 };
    match element {
        Element::Line { points, stroke, dashes } => {
            let line = Line {
                width: stroke.width as f32,
                line_cap: LineCap::Round,
                line_join: LineJoin::Round,
                dash: dashes.and_then(|d| StrokeDash::new(d.map(|l| l as f32).to_vec(), 0.0)),
                ..Line::default()
            };
            if let Some(path) = polyline(points, false) {
                pixmap.stroke_path(&path, &paint(opaque(stroke.color)), &line, scale, None);
            }
        }
        Element::Polygon { points, fill: how } => fill(pixmap, polyline(points, true), *how, scale),
        Element::Rectangle { from, to, fill: how } => {
            if let Some(rect) = Rect::from_ltrb(from[0] as f32, from[1] as f32, to[0] as f32, to[1] as f32) {
                pixmap.fill_rect(rect, &paint(*how), scale, None);
            }
        }
        Element::Disc { center, radius, color } => {
            let disc = PathBuilder::from_circle(center[0] as f32, center[1] as f32, *radius as f32);
            fill(pixmap, disc, opaque(*color), scale);
        }
        Element::Text { at, text, size, color, anchor, upright } => {
            let share = match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
            let letters = outline(text, *size, share * font::width(text, *size));
            let turn = if *upright { -90.0 } else { 0.0 };
            let placed = scale.pre_translate(at[0] as f32, at[1] as f32).pre_rotate(turn);
            fill(pixmap, letters, opaque(*color), placed);
        }
    }
}

fn paint(fill: Fill) -> Paint<'static> {
    let Fill { color, opacity } = fill;
    let mut paint = Paint::default();
    let alpha = (opacity.clamp(0.0, 1.0) * 255.0).round() as u8;
    paint.set_color(Rgba::from_rgba8(color.0, color.1, color.2, alpha));
    paint
}

fn polyline(points: &[Point], close: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (i, [x, y]) in points.iter().map(|p| p.map(|c| c as f32)).enumerate() {
        if i == 0 {
            path.move_to(x, y);
        } else {
            path.line_to(x, y);
        }
    }
    if close {
        path.close();
    }
    path.finish()
}

/// The outlines of a line of text that begins `back` CSS pixels left of the origin, with its baseline through it.
fn outline(text: &str, size: f64, back: f64) -> Option<Path> {
    let face = font::FACE.as_ref()?;
    let scale = font::scale(face, size);
    let mut pen = Pen { path: PathBuilder::new(), scale: scale as f32, x: 0.0 };
    let mut before = 0.0;
    for (glyph, advance) in font::glyphs(face, text) {
        pen.x = (scale * before - back) as f32;
        face.outline_glyph(glyph, &mut pen);
        before += advance;
    }
    pen.path.finish()
}

/// Turns outlines in the font's units, y upwards, into a path in CSS pixels, y downwards.
struct Pen {
    path: PathBuilder,
    scale: f32,
    /// Where the letter begins.
    x: f32,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + self.scale * x, -self.scale * y)
    }
}

impl ttf_parser::OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.move_to(x, y);
    }
    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.line_to(x, y);
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }
    fn close(&mut self) {
        self.path.close();
    }
}
