//! Drawing a plot: settle the axes, lay out, draw from the back to the front.

use super::canvas::{Canvas, Point, Stroke};
use super::clip::Rect;
use super::frame::Frame;
use super::occupied::Occupied;
use super::scaled::{Margin, Scaled};
use super::{Color, Legend, Marker, Plot, Series, Shape, apart, legend, reference};
use crate::ReportError;

/// Opacity of a band.
pub(super) const BAND: f64 = 0.22;
/// Opacity of bars.
pub(super) const BAR: f64 = 0.6;
const WALL: Color = Color(70, 70, 70);

pub(super) fn plot(plot: &Plot) -> Result<Canvas, ReportError> {
    plot.series.iter().try_for_each(Series::check)?;
    let mut frame = frame(plot, 0.0);
    let series = apart::styled(&plot.series, &frame);
    let series = colored(&series);
    let legend_size = legend::size(&series).filter(|_| plot.legend != Legend::Hidden);
    let mut taken = Occupied::new(plot, &frame);
    let mut references = reference::place(&plot.references, &frame, &taken);
    let mut legend_at = None;
    if let Some(size) = legend_size {
        let labels: Vec<Rect> = references.iter().filter_map(|r| r.label).collect();
        legend_at = legend::place(plot.legend, size, &frame.rect, &taken, &labels);
        if legend_at.is_none() {
            frame = self::frame(plot, size.0 + 36.0);
            taken = Occupied::new(plot, &frame);
            references = reference::place(&plot.references, &frame, &taken);
            let (left, top) = (frame.rect.right + 18.0, frame.rect.top);
            legend_at = Some(Rect { left, top, right: left + size.0, bottom: top + size.1 });
            frame.size.1 = frame.size.1.max((top + size.1).ceil() as u32 + 8);
        }
    }

    let mut canvas = Canvas::new(frame.size);
    frame.grid(&mut canvas);
    // Areas first: they would wash out what lies under them.
    let area = |s: &Series| matches!(s.shape, Shape::Band { .. } | Shape::Bars { .. });
    for (series, color) in series.iter().filter(|(s, _)| area(s)) {
        draw_area(&mut canvas, &frame, series, *color);
    }
    reference::draw_lines(&mut canvas, &references);
    // under the paths, so that the marks where they end are seen
    for [from, to] in &plot.walls {
        for piece in frame.rect.polyline([frame.point(from[0], from[1]), frame.point(to[0], to[1])]) {
            canvas.line(&piece, Stroke::new(WALL, 3.0));
        }
    }
    for (series, color) in series.iter().filter(|(s, _)| !area(s)) {
        draw_series(&mut canvas, &frame, series, *color);
    }
    frame.axes(&mut canvas, &plot.title, &plot.x, &plot.y);
    reference::draw_labels(&mut canvas, &references);
    if let Some(rect) = legend_at {
        legend::draw(&mut canvas, &series, &rect);
    }
    Ok(canvas)
}

/// The series with their colours; those without one of their own take the palette's in turn.
fn colored(series: &[Series]) -> Vec<(&Series, Color)> {
    let mut next = 0;
    let mut color = |s: &Series| {
        s.color.unwrap_or_else(|| {
            next += 1;
            Color::cycle(next - 1)
        })
    };
    series.iter().map(|s| (s, color(s))).collect()
}

fn frame(plot: &Plot, right: f64) -> Frame {
    let (x, y) = extent(plot);
    let scaled = (Scaled::new(&plot.x, x, Margin::Air), Scaled::new(&plot.y, y, Margin::Air));
    let equal = plot.equal_aspect && scaled.0.is_linear() && scaled.1.is_linear();
    let mut frame = Frame::new(&plot.title, (&plot.x, &plot.y), scaled, plot.size, right);
    if equal {
        frame.equalize(&plot.title);
    }
    frame
}

/// Every abscissa and ordinate that the axes should hold.
fn extent(plot: &Plot) -> (Vec<f64>, Vec<f64>) {
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    for series in &plot.series {
        match &series.shape {
            Shape::Line { x, y, .. } => {
                xs.extend(x);
                ys.extend(y);
            }
            Shape::Points { x, y, interval, .. } => {
                xs.extend(x);
                ys.extend(y);
                ys.extend(interval.iter().flat_map(|(low, high)| [low, high]));
            }
            Shape::Band { x, low, high } => {
                xs.extend(x);
                ys.extend(low);
                ys.extend(high);
            }
            Shape::Bars { edges, heights } => {
                xs.extend(edges);
                ys.extend(heights);
                ys.push(0.0);
            }
        }
    }
    for reference in &plot.references {
        if reference.vertical { &mut xs } else { &mut ys }.push(reference.value);
    }
    for [x, y] in plot.walls.iter().flatten() {
        xs.push(*x);
        ys.push(*y);
    }
    (xs, ys)
}

/// A series' points in pixels.
pub(super) fn outline(frame: &Frame, x: &[f64], y: &[f64]) -> Vec<Option<Point>> {
    x.iter().zip(y).map(|(x, y)| frame.point(*x, *y)).collect()
}

/// The polygons of a band (one for each run without gaps) or of bars.
pub(super) fn areas(frame: &Frame, shape: &Shape) -> Vec<Vec<Point>> {
    let mut polygons = Vec::new();
    match shape {
        Shape::Band { x, low, high } => {
            let (mut there, mut back) = (Vec::new(), Vec::new());
            let edges = x.iter().zip(low).zip(high).map(|((x, low), high)| {
                let [low, high] = [low, high].map(|y| frame.y.share_or_low(*y));
                Some((frame.place(frame.x.share(*x)?, low?), frame.place(frame.x.share(*x)?, high?)))
            });
            for edge in edges.chain([None]) {
                if let Some((low, high)) = edge {
                    there.push(low);
                    back.push(high);
                } else {
                    there.extend(back.drain(..).rev());
                    polygons.push(frame.rect.polygon(&std::mem::take(&mut there)));
                }
            }
        }
        Shape::Bars { edges, heights } => {
            for (edge, height) in edges.windows(2).zip(heights) {
                let corners = (|| {
                    let (left, right) = (frame.x.share(edge[0])?, frame.x.share(edge[1])?);
                    let (foot, top) = (frame.y.share_or_low(0.0)?, frame.y.share_or_low(*height)?);
                    Some([(left, foot), (left, top), (right, top), (right, foot)].map(|(x, y)| frame.place(x, y)))
                })();
                polygons.extend(corners.map(|c| frame.rect.polygon(&c)));
            }
        }
        _ => {}
    }
    polygons.retain(|p| p.len() > 2);
    polygons
}

fn draw_area(canvas: &mut Canvas, frame: &Frame, series: &Series, color: Color) {
    let bars = matches!(series.shape, Shape::Bars { .. });
    for mut polygon in areas(frame, &series.shape) {
        canvas.polygon(&polygon, color, if bars { BAR } else { BAND });
        if bars {
            polygon.push(polygon[0]);
            canvas.line(&polygon, Stroke::new(color, 1.0));
        }
    }
}

fn draw_series(canvas: &mut Canvas, frame: &Frame, series: &Series, color: Color) {
    match &series.shape {
        Shape::Line { x, y, dash } => {
            for piece in frame.rect.polyline(outline(frame, x, y)) {
                canvas.dashed(&piece, Stroke::new(color, series.line_width()), *dash);
            }
        }
        Shape::Points { x, y, interval, marker } => {
            for (x, (low, high)) in x.iter().zip(interval) {
                draw_error_bar(canvas, frame, *x, (*low, *high), color);
            }
            draw_markers(canvas, frame, &outline(frame, x, y), *marker, color);
        }
        Shape::Band { .. } | Shape::Bars { .. } => {}
    }
}

fn draw_markers(canvas: &mut Canvas, frame: &Frame, points: &[Option<Point>], marker: Marker, color: Color) {
    let radius = match points.len() {
        0..=100 => 4.0,
        101..=1000 => 3.0,
        _ => 2.0,
    };
    let inside = |p: &&Point| frame.rect.grown(0.5).contains(**p);
    points.iter().flatten().filter(inside).for_each(|p| canvas.marker(*p, marker, radius, color));
}

fn draw_error_bar(canvas: &mut Canvas, frame: &Frame, x: f64, (low, high): (f64, f64), color: Color) {
    let (Some(x), Some(low), Some(high)) = (frame.x.share(x), frame.y.share_or_low(low), frame.y.share_or_low(high))
    else {
        return;
    };
    let stroke = Stroke::new(color, 1.2);
    let (low, high) = (frame.place(x, low), frame.place(x, high));
    for piece in frame.rect.polyline([Some(low), Some(high)]) {
        canvas.line(&piece, stroke);
    }
    for end in [low, high] {
        if frame.rect.contains(end) {
            canvas.line(&[[end[0] - 4.0, end[1]], [end[0] + 4.0, end[1]]], stroke);
        }
    }
}
