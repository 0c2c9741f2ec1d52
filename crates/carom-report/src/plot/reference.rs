//! Lines at values that matter, and a place for their labels.

use super::canvas::{Anchor, Canvas, Label, Point, Stroke};
use super::clip::Rect;
use super::frame::{Frame, TICK};
use super::occupied::Occupied;
use super::{Color, Dash, font};

/// A straight line across the plot at a value that matters, with a label.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Whether the line stands at an x value; else it lies at a y value.
    pub vertical: bool,
    /// The value, in the axis's data unit.
    pub value: f64,
    /// Label beside the line; may be empty.
    pub label: String,
}

impl Reference {
    /// A vertical line at `x`.
    pub fn vertical(x: f64, label: impl Into<String>) -> Self {
        Self { vertical: true, value: x, label: label.into() }
    }

    /// A horizontal line at `y`.
    pub fn horizontal(y: f64, label: impl Into<String>) -> Self {
        Self { vertical: false, value: y, label: label.into() }
    }
}

/// A reference line that lies inside the frame.
pub(super) struct Placed<'p> {
    text: &'p str,
    line: [Point; 2],
    /// Where its label goes; none without a label.
    pub label: Option<Rect>,
}

/// The reference lines inside the frame, with their labels where they cover the least.
pub(super) fn place<'p>(references: &'p [Reference], frame: &Frame, taken: &Occupied) -> Vec<Placed<'p>> {
    let mut placed: Vec<Placed<'_>> = Vec::new();
    for reference in references {
        let axis = if reference.vertical { &frame.x } else { &frame.y };
        let Some(share) = axis.share(reference.value).filter(|s| (0.0..=1.0).contains(s)) else {
            continue;
        };
        let line = if reference.vertical {
            [frame.place(share, 0.0), frame.place(share, 1.0)]
        } else {
            [frame.place(0.0, share), frame.place(1.0, share)]
        };
        placed.push(Placed { text: &reference.label, line, label: None });
    }
    for index in 0..placed.len() {
        if placed[index].text.is_empty() {
            continue;
        }
        let cost = |rect: &Rect| {
            let room = rect.grown(2.0);
            let (data, areas) = taken.count(&room);
            let labels = placed.iter().filter_map(|p| p.label).filter(|other| room.overlaps(other)).count();
            let crosses = |p: &Placed<'_>| !room.polyline(p.line.map(Some)).is_empty();
            let lines = placed.iter().enumerate().filter(|(i, p)| *i != index && crosses(p)).count();
            1000 * labels + 4 * data + areas + 10 * lines
        };
        // The first of the cheapest: candidates are in order of liking.
        placed[index].label = candidates(&placed[index], &frame.rect).into_iter().min_by_key(cost);
    }
    placed
}

/// Places for a label: down a vertical line on both its sides, or along a horizontal one above and below.
fn candidates(placed: &Placed<'_>, frame: &Rect) -> Vec<Rect> {
    let (width, height) = (font::width(placed.text, TICK) + 6.0, TICK + 5.0);
    let [from, to] = placed.line;
    let vertical = from[0] == to[0];
    let steps = if vertical { frame.height() / (height + 2.0) } else { frame.width() / 20.0 };
    let mut rects = Vec::new();
    for step in 0..steps as usize {
        for first in [true, false] {
            let (left, top) = if vertical {
                let left = if first { from[0] + 4.0 } else { from[0] - 4.0 - width };
                (left, frame.top + 5.0 + step as f64 * (height + 2.0))
            } else {
                let top = if first { from[1] - height - 2.0 } else { from[1] + 3.0 };
                (frame.right - width - 6.0 - 20.0 * step as f64, top)
            };
            let rect = Rect { left, top, right: left + width, bottom: top + height };
            if left > frame.left && rect.right < frame.right && top > frame.top && rect.bottom < frame.bottom {
                rects.push(rect);
            }
        }
    }
    rects
}

pub(super) fn draw_lines(canvas: &mut Canvas, placed: &[Placed<'_>]) {
    let stroke = Stroke::new(Color::GREY, 1.2);
    placed.iter().for_each(|p| canvas.dashed(&p.line, stroke, Dash::Dashed));
}

pub(super) fn draw_labels(canvas: &mut Canvas, placed: &[Placed<'_>]) {
    for (text, rect) in placed.iter().filter_map(|p| Some((p.text, p.label?))) {
        canvas.rectangle([rect.left, rect.top], [rect.right, rect.bottom], Color(255, 255, 255), 0.75);
        let label = Label { color: Color(90, 90, 90), ..Label::new(text, TICK, Anchor::Start) };
        canvas.text([rect.left + 3.0, rect.bottom - 5.0], label);
    }
}
