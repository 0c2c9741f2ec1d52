//! Drawing in CSS pixels on plotters' SVG backend.
//!
//! The backend's coordinates are whole numbers, which would make curves visibly ragged, so everything is drawn on a
//! grid of [`FINE`] steps a pixel, and the document's `viewBox` scales it back.

use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, DashedPathElement, Drawable, PathElement, PointCollection, Polygon, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color as _, FontDesc, FontFamily, FontStyle, FontTransform, RGBColor, ShapeStyle, TextStyle};

use super::{Color, Dash, Marker, font};
use crate::ReportError;

/// Grid steps a CSS pixel.
const FINE: f64 = 10.0;

/// Ratio of plotters' font size to the one its SVG backend writes.
const FONT_RATIO: f64 = 1.24;

/// A point in CSS pixels from the upper left.
pub(super) type Point = [f64; 2];

/// A stroke: colour, width in CSS pixels, opacity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stroke {
    pub color: Color,
    pub width: f64,
    pub opacity: f64,
}

impl Stroke {
    pub(super) fn new(color: Color, width: f64) -> Self {
        Self { color, width, opacity: 1.0 }
    }

    fn style(self) -> ShapeStyle {
        RGBColor::from(self.color).mix(self.opacity).stroke_width((self.width * FINE).round() as u32)
    }
}

/// Which end of a text lies at its point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Label<'t> {
    pub text: &'t str,
    pub size: f64,
    pub color: Color,
    pub anchor: Anchor,
    /// Turned a quarter, reading upwards.
    pub upright: bool,
}

impl<'t> Label<'t> {
    pub(super) fn new(text: &'t str, size: f64, anchor: Anchor) -> Self {
        Self { text, size, color: Color(38, 38, 38), anchor, upright: false }
    }
}

fn fine(value: f64) -> i32 {
    // `as` saturates, and callers have clipped to the picture.
    (value * FINE).round() as i32
}

fn grid(point: &Point) -> (i32, i32) {
    (fine(point[0]), fine(point[1]))
}

/// The points of a line on the grid, without those closer to the last one than anybody sees.
fn thinned(points: &[Point]) -> Vec<(i32, i32)> {
    const CLOSE: f64 = 0.4;
    let mut kept: Vec<Point> = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        let end = i + 1 == points.len();
        let far = kept.last().is_none_or(|last| (point[0] - last[0]).hypot(point[1] - last[1]) > CLOSE);
        if far || end {
            kept.push(*point);
        }
    }
    kept.iter().map(grid).collect()
}

/// The picture being drawn.
pub(super) struct Canvas<'b> {
    area: DrawingArea<SVGBackend<'b>, Shift>,
}

/// Draws a picture of the given size and returns the SVG document.
pub(super) fn document(
    size: (u32, u32),
    draw: impl FnOnce(&Canvas<'_>) -> Result<(), ReportError>,
) -> Result<String, ReportError> {
    let (width, height) = (size.0.max(1), size.1.max(1));
    let grid = (width.saturating_mul(FINE as u32), height.saturating_mul(FINE as u32));
    let mut svg = String::new();
    {
        let canvas = Canvas { area: SVGBackend::with_string(&mut svg, grid).into_drawing_area() };
        canvas.rectangle([0.0, 0.0], [f64::from(width), f64::from(height)], Color(255, 255, 255), 1.0)?;
        draw(&canvas)?;
        canvas.area.present().map_err(|e| ReportError::draw("SVG", e))?;
    }
    let from = format!("<svg width=\"{}\" height=\"{}\"", grid.0, grid.1);
    let to = format!("<svg width=\"{width}\" height=\"{height}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"");
    Ok(svg.replacen(&from, &to, 1))
}

impl<'b> Canvas<'b> {
    fn put<'e, E>(&self, element: &'e E) -> Result<(), ReportError>
    where
        &'e E: PointCollection<'e, (i32, i32)>,
        E: Drawable<SVGBackend<'b>>,
    {
        self.area.draw(element).map_err(|e| ReportError::draw("SVG", e))
    }

    pub(super) fn line(&self, points: &[Point], stroke: Stroke) -> Result<(), ReportError> {
        let path = thinned(points);
        self.put(&PathElement::new(path, stroke.style()))
    }

    pub(super) fn dashed(&self, points: &[Point], stroke: Stroke, dash: Dash) -> Result<(), ReportError> {
        // The ends are round: they add a width to a dash and take it from the gap.
        let (length, gap) = match dash {
            Dash::Solid => return self.line(points, stroke),
            Dash::Dashed => (fine(3.2 * stroke.width), fine(3.6 * stroke.width)),
            Dash::Dotted => (1, fine(2.4 * stroke.width)),
        };
        let path = thinned(points);
        self.put(&DashedPathElement::new(path, length, gap, stroke.style()))
    }

    pub(super) fn polygon(&self, points: &[Point], color: Color, opacity: f64) -> Result<(), ReportError> {
        let path: Vec<_> = points.iter().map(grid).collect();
        self.put(&Polygon::new(path, RGBColor::from(color).mix(opacity)))
    }

    pub(super) fn rectangle(&self, from: Point, to: Point, color: Color, opacity: f64) -> Result<(), ReportError> {
        self.put(&Rectangle::new([grid(&from), grid(&to)], RGBColor::from(color).mix(opacity).filled()))
    }

    pub(super) fn marker(&self, at: Point, marker: Marker, radius: f64, color: Color) -> Result<(), ReportError> {
        let [x, y] = at;
        let r = radius;
        match marker {
            Marker::Circle => self.put(&Circle::new(grid(&at), fine(r), RGBColor::from(color).filled())),
            Marker::Square => {
                let h = 0.9 * r;
                self.rectangle([x - h, y - h], [x + h, y + h], color, 1.0)
            }
            Marker::Triangle => {
                let (w, h) = (1.2 * r, 0.65 * r);
                self.polygon(&[[x, y - 1.3 * r], [x + w, y + h], [x - w, y + h]], color, 1.0)
            }
            Marker::Cross => {
                let stroke = Stroke::new(color, (0.45 * r).max(1.0));
                self.line(&[[x - r, y - r], [x + r, y + r]], stroke)?;
                self.line(&[[x - r, y + r], [x + r, y - r]], stroke)
            }
        }
    }

    /// Draws text with its baseline at the point.
    pub(super) fn text(&self, at: Point, label: Label<'_>) -> Result<(), ReportError> {
        if label.text.is_empty() {
            return Ok(());
        }
        let h = match label.anchor {
            Anchor::Start => HPos::Left,
            Anchor::Middle => HPos::Center,
            Anchor::End => HPos::Right,
        };
        let font = FontDesc::new(FontFamily::Name(font::FAMILY), label.size * FINE * FONT_RATIO, FontStyle::Normal);
        let font = if label.upright { font.transform(FontTransform::Rotate270) } else { font };
        let color = RGBColor::from(label.color);
        let style = TextStyle::from(font).color(&color).pos(Pos::new(h, VPos::Bottom));
        // The backend lifts such text by half an ex, a quarter of the font size.
        let lift = 0.25 * label.size;
        let at = if label.upright { [at[0] + lift, at[1]] } else { [at[0], at[1] + lift] };
        self.put(&Text::new(label.text, grid(&at), style))
    }
}
