//! A picture as a list of elements in CSS pixels, for the writers of SVG and PNG.

use super::{Color, Dash, Marker};

/// A point in CSS pixels from the upper left.
pub(super) type Point = [f64; 2];

/// A stroke: colour, width in CSS pixels. Ends and corners are round.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stroke {
    pub color: Color,
    pub width: f64,
}

impl Stroke {
    pub(super) fn new(color: Color, width: f64) -> Self {
        Self { color, width }
    }
}

/// The colour of an area and its opacity from 0 to 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fill {
    pub color: Color,
    pub opacity: f64,
}

/// Which end of a text lies at its point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text.
#[derive(Debug, Clone)]
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

/// What a picture is made of, each above those before it.
#[derive(Debug, Clone)]
pub(super) enum Element {
    /// A line through points, with lengths of dash and gap where it is broken.
    Line {
        points: Vec<Point>,
        stroke: Stroke,
        dashes: Option<[f64; 2]>,
    },
    Polygon {
        points: Vec<Point>,
        fill: Fill,
    },
    /// From the upper left corner to the lower right one.
    Rectangle {
        from: Point,
        to: Point,
        fill: Fill,
    },
    Disc {
        center: Point,
        radius: f64,
        color: Color,
    },
    /// Text with its baseline at the point.
    Text {
        at: Point,
        text: String,
        size: f64,
        color: Color,
        anchor: Anchor,
        upright: bool,
    },
}

/// The picture being drawn, on white ground.
#[derive(Debug)]
pub(super) struct Canvas {
    pub size: (u32, u32),
    pub elements: Vec<Element>,
}

/// A line's points without those closer to the last one than anybody sees.
fn thinned(points: &[Point]) -> Vec<Point> {
    const CLOSE: f64 = 0.4;
    let mut kept: Vec<Point> = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        let end = i + 1 == points.len();
        let far = kept.last().is_none_or(|last| (point[0] - last[0]).hypot(point[1] - last[1]) > CLOSE);
        if far || end {
            kept.push(*point);
        }
    }
    kept
}

impl Canvas {
    /// An empty picture of at least one pixel.
    pub(super) fn new(size: (u32, u32)) -> Self {
        let size = (size.0.max(1), size.1.max(1));
        let mut canvas = Self { size, elements: Vec::new() };
        canvas.rectangle([0.0, 0.0], [f64::from(size.0), f64::from(size.1)], Color(255, 255, 255), 1.0);
        canvas
    }

    pub(super) fn line(&mut self, points: &[Point], stroke: Stroke) {
        self.dashed(points, stroke, Dash::Solid);
    }

    pub(super) fn dashed(&mut self, points: &[Point], stroke: Stroke, dash: Dash) {
        // The ends are round: they add a width to a dash and take it from the gap.
        let dashes = match dash {
            Dash::Solid => None,
            Dash::Dashed => Some([3.2 * stroke.width, 3.6 * stroke.width]),
            Dash::Dotted => Some([0.1, 2.8 * stroke.width]),
        };
        self.elements.push(Element::Line { points: thinned(points), stroke, dashes });
    }

    pub(super) fn polygon(&mut self, points: &[Point], color: Color, opacity: f64) {
        self.elements.push(Element::Polygon { points: points.to_vec(), fill: Fill { color, opacity } });
    }

    /// The rectangle between two opposite corners.
    pub(super) fn rectangle(&mut self, a: Point, b: Point, color: Color, opacity: f64) {
        let (from, to) = ([0, 1].map(|i| a[i].min(b[i])), [0, 1].map(|i| a[i].max(b[i])));
        self.elements.push(Element::Rectangle { from, to, fill: Fill { color, opacity } });
    }

    pub(super) fn marker(&mut self, at: Point, marker: Marker, radius: f64, color: Color) {
        let [x, y] = at;
        let r = radius;
        match marker {
            Marker::Circle => self.elements.push(Element::Disc { center: at, radius, color }),
            Marker::Square => {
                let h = 0.9 * r;
                self.rectangle([x - h, y - h], [x + h, y + h], color, 1.0);
            }
            Marker::Triangle => {
                let (w, h) = (1.2 * r, 0.65 * r);
                self.polygon(&[[x, y - 1.3 * r], [x + w, y + h], [x - w, y + h]], color, 1.0);
            }
            Marker::Cross => {
                let stroke = Stroke::new(color, (0.45 * r).max(1.0));
                self.line(&[[x - r, y - r], [x + r, y + r]], stroke);
                self.line(&[[x - r, y + r], [x + r, y - r]], stroke);
            }
        }
    }

    /// Draws text with its baseline at the point.
    pub(super) fn text(&mut self, at: Point, label: Label<'_>) {
        let Label { text, size, color, anchor, upright } = label;
        if !text.is_empty() {
            self.elements.push(Element::Text { at, text: text.to_owned(), size, color, anchor, upright });
        }
    }
}
