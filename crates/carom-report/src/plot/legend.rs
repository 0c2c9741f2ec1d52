//! The legend: what it says, and where it covers no data.

use super::canvas::{Anchor, Canvas, Label, Point, Stroke};
use super::clip::Rect;
use super::frame::TICK;
use super::occupied::Occupied;
use super::{Color, Legend, Series, Shape, font};

const ROW: f64 = 21.0;
const SWATCH: f64 = 30.0;
const PAD: f64 = 9.0;
/// Distance from the frame's edges.
const INSET: f64 = 10.0;

/// Width and height of the legend, or none where no series has a name.
pub(super) fn size(series: &[(&Series, Color)]) -> Option<(f64, f64)> {
    let named = series.iter().filter(|(s, _)| !s.label.is_empty());
    let rows = named.clone().count();
    let widest = named.map(|(s, _)| font::width(&s.label, TICK)).fold(0.0, f64::max);
    (rows > 0).then_some((PAD + SWATCH + 8.0 + widest + PAD, 2.0 * PAD + ROW * rows as f64 - 3.0))
}

/// The rectangle for a legend of that size inside the frame; none where it belongs outside.
pub(super) fn place(legend: Legend, size: (f64, f64), frame: &Rect, taken: &Occupied, labels: &[Rect]) -> Option<Rect> {
    let (width, height) = size;
    let corner = |right: bool, low: bool| {
        let left = if right { frame.right - INSET - width } else { frame.left + INSET };
        let top = if low { frame.bottom - INSET - height } else { frame.top + INSET };
        Rect { left, top, right: left + width, bottom: top + height }
    };
    let corners = [corner(true, false), corner(false, false), corner(true, true), corner(false, true)];
    match legend {
        Legend::UpperRight => Some(corners[0]),
        Legend::UpperLeft => Some(corners[1]),
        Legend::LowerRight => Some(corners[2]),
        Legend::LowerLeft => Some(corners[3]),
        Legend::Auto => corners.into_iter().find(|rect| {
            let room = rect.grown(6.0);
            rect.left > frame.left
                && rect.top > frame.top
                && rect.bottom < frame.bottom
                && taken.count(&room) == (0, 0)
                && !labels.iter().any(|l| room.overlaps(l))
        }),
        Legend::Outside | Legend::Hidden => None,
    }
}

pub(super) fn draw(canvas: &mut Canvas, series: &[(&Series, Color)], rect: &Rect) {
    let Rect { left, top, right, bottom } = *rect;
    canvas.rectangle([left, top], [right, bottom], Color(255, 255, 255), 0.88);
    let edge = [[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
    canvas.line(&edge, Stroke::new(Color(205, 205, 210), 1.0));
    for (row, (series, color)) in series.iter().filter(|(s, _)| !s.label.is_empty()).enumerate() {
        let middle = top + PAD + ROW * row as f64 + 0.5 * ROW - 1.5;
        swatch(canvas, series, *color, [left + PAD, middle]);
        let at = [left + PAD + SWATCH + 8.0, middle + 0.36 * TICK];
        canvas.text(at, Label::new(&series.label, TICK, Anchor::Start));
    }
}

fn swatch(canvas: &mut Canvas, series: &Series, color: Color, at: Point) {
    let [left, y] = at;
    let (middle, right) = (left + 0.5 * SWATCH, left + SWATCH);
    match &series.shape {
        Shape::Line { dash, .. } => {
            let width = series.line_width().max(1.5);
            canvas.dashed(&[[left, y], [right, y]], Stroke::new(color, width), *dash);
        }
        Shape::Points { marker, interval, .. } => {
            if !interval.is_empty() {
                canvas.line(&[[middle, y - 8.0], [middle, y + 8.0]], Stroke::new(color, 1.2));
            }
            canvas.marker([middle, y], *marker, 4.0, color);
        }
        Shape::Band { .. } => canvas.rectangle([left, y - 6.0], [right, y + 6.0], color, super::draw::BAND),
        Shape::Bars { .. } => canvas.rectangle([left, y - 6.0], [right, y + 6.0], color, super::draw::BAR),
    }
}
