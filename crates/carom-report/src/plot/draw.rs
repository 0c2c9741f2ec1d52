//! Drawing a plot: settle the axes, lay out, draw from the back to the front.

use super::canvas::{self, Anchor, Canvas, Label, Point, Stroke};
use super::clip::Rect;
use super::frame::{Frame, TICK};
use super::scaled::{Margin, Scaled};
use super::{Color, Legend, Marker, Plot, Reference, Series, Shape, font, legend};
use crate::ReportError;

/// Opacity of a band.
pub(super) const BAND: f64 = 0.22;
/// Opacity of bars.
pub(super) const BAR: f64 = 0.6;
const WALL: Color = Color(70, 70, 70);

pub(super) fn plot(plot: &Plot) -> Result<String, ReportError> {
    plot.series.iter().try_for_each(Series::check)?;
    let series = colored(&plot.series);
    let legend_size = legend::size(&series).filter(|_| plot.legend != Legend::Hidden);

    let mut frame = frame(plot, 0.0);
    let mut labels = reference_labels(plot, &frame);
    let mut legend_at = None;
    if let Some(size) = legend_size {
        let boxes: Vec<Rect> = labels.iter().map(|(_, rect)| *rect).collect();
        legend_at = legend::place(
            plot.legend,
            size,
            &frame.rect,
            &occupied(plot, &frame),
            &boxes,
        );
        if legend_at.is_none() {
            frame = self::frame(plot, size.0 + 36.0);
            labels = reference_labels(plot, &frame);
            let (left, top) = (frame.rect.right + 18.0, frame.rect.top);
            legend_at = Some(Rect {
                left,
                top,
                right: left + size.0,
                bottom: top + size.1,
            });
            frame.size.1 = frame.size.1.max((top + size.1).ceil() as u32 + 8);
        }
    }

    canvas::document(frame.size, |canvas| {
        frame.grid(canvas)?;
        // Areas first: they would wash out what lies under them.
        let area = |s: &Series| matches!(s.shape, Shape::Band { .. } | Shape::Bars { .. });
        for (series, color) in series.iter().filter(|(s, _)| area(s)) {
            draw_area(canvas, &frame, series, *color)?;
        }
        draw_references(canvas, &frame, &labels)?;
        for (series, color) in series.iter().filter(|(s, _)| !area(s)) {
            draw_series(canvas, &frame, series, *color)?;
        }
        frame.axes(canvas, &plot.title, &plot.x, &plot.y)?;
        for [from, to] in &plot.walls {
            for piece in frame
                .rect
                .polyline([frame.point(from[0], from[1]), frame.point(to[0], to[1])])
            {
                canvas.line(&piece, Stroke::new(WALL, 4.0))?;
            }
        }
        for (reference, rect) in labels.iter().filter(|(r, _)| !r.label.is_empty()) {
            canvas.rectangle(
                [rect.left, rect.top],
                [rect.right, rect.bottom],
                Color(255, 255, 255),
                0.8,
            )?;
            let label = Label {
                color: Color::GREY,
                ..Label::new(&reference.label, TICK, Anchor::Start)
            };
            canvas.text([rect.left + 3.0, rect.bottom - 5.0], label)?;
        }
        legend_at.map_or(Ok(()), |rect| legend::draw(canvas, &series, &rect))
    })
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
    let scaled = (
        Scaled::new(&plot.x, x, Margin::Air),
        Scaled::new(&plot.y, y, Margin::Air),
    );
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

/// A series' outline in pixels: what may not be covered, and what is drawn.
fn outline(frame: &Frame, x: &[f64], y: &[f64]) -> Vec<Option<Point>> {
    x.iter().zip(y).map(|(x, y)| frame.point(*x, *y)).collect()
}

/// Points a few pixels apart all over what the series cover.
fn occupied(plot: &Plot, frame: &Frame) -> Vec<Point> {
    let mut taken = Vec::new();
    let mut along = |a: Point, b: Point| {
        let steps = ((b[0] - a[0]).hypot(b[1] - a[1]) / 5.0)
            .ceil()
            .clamp(1.0, 2000.0);
        for i in 0..=steps as usize {
            let t = i as f64 / steps;
            taken.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
        }
    };
    for series in &plot.series {
        match &series.shape {
            Shape::Line { x, y, .. } => {
                for piece in frame.rect.polyline(outline(frame, x, y)) {
                    piece.windows(2).for_each(|pair| along(pair[0], pair[1]));
                }
            }
            Shape::Points { x, y, interval, .. } => {
                outline(frame, x, y)
                    .into_iter()
                    .flatten()
                    .for_each(|p| along(p, p));
                for (x, (low, high)) in x.iter().zip(interval) {
                    if let (Some(a), Some(b)) = (frame.point(*x, *low), frame.point(*x, *high)) {
                        along(frame.rect.clamp(a), frame.rect.clamp(b));
                    }
                }
            }
            Shape::Band { .. } | Shape::Bars { .. } => {
                for polygon in areas(frame, &series.shape) {
                    // Hatching from the outline to its bounding box's foot is coarse but covers bars and bands alike.
                    let n = polygon.len();
                    for i in 0..n {
                        along(polygon[i], polygon[(i + 1) % n]);
                        along(polygon[i], polygon[n - 1 - i]);
                    }
                }
            }
        }
    }
    for [from, to] in &plot.walls {
        if let (Some(a), Some(b)) = (frame.point(from[0], from[1]), frame.point(to[0], to[1])) {
            along(frame.rect.clamp(a), frame.rect.clamp(b));
        }
    }
    taken
}

/// The polygons of a band (one for each run without gaps) or of bars.
fn areas(frame: &Frame, shape: &Shape) -> Vec<Vec<Point>> {
    let mut polygons = Vec::new();
    match shape {
        Shape::Band { x, low, high } => {
            let (mut there, mut back) = (Vec::new(), Vec::new());
            let edges = x.iter().zip(low).zip(high).map(|((x, low), high)| {
                let [low, high] = [low, high].map(|y| frame.y.share_or_low(*y));
                Some((
                    frame.place(frame.x.share(*x)?, low?),
                    frame.place(frame.x.share(*x)?, high?),
                ))
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
                    Some(
                        [(left, foot), (left, top), (right, top), (right, foot)]
                            .map(|(x, y)| frame.place(x, y)),
                    )
                })();
                polygons.extend(corners.map(|c| frame.rect.polygon(&c)));
            }
        }
        _ => {}
    }
    polygons.retain(|p| p.len() > 2);
    polygons
}

fn draw_area(
    canvas: &Canvas<'_>,
    frame: &Frame,
    series: &Series,
    color: Color,
) -> Result<(), ReportError> {
    let bars = matches!(series.shape, Shape::Bars { .. });
    for mut polygon in areas(frame, &series.shape) {
        canvas.polygon(&polygon, color, if bars { BAR } else { BAND })?;
        if bars {
            polygon.push(polygon[0]);
            canvas.line(&polygon, Stroke::new(color, 1.0))?;
        }
    }
    Ok(())
}

fn draw_series(
    canvas: &Canvas<'_>,
    frame: &Frame,
    series: &Series,
    color: Color,
) -> Result<(), ReportError> {
    match &series.shape {
        Shape::Line { x, y, dash } => {
            for piece in frame.rect.polyline(outline(frame, x, y)) {
                canvas.dashed(&piece, Stroke::new(color, 2.0), *dash)?;
            }
        }
        Shape::Points {
            x,
            y,
            interval,
            marker,
        } => {
            for (x, (low, high)) in x.iter().zip(interval) {
                draw_error_bar(canvas, frame, *x, (*low, *high), color)?;
            }
            draw_markers(canvas, frame, &outline(frame, x, y), *marker, color)?;
        }
        Shape::Band { .. } | Shape::Bars { .. } => {}
    }
    Ok(())
}

fn draw_markers(
    canvas: &Canvas<'_>,
    frame: &Frame,
    points: &[Option<Point>],
    marker: Marker,
    color: Color,
) -> Result<(), ReportError> {
    let radius = match points.len() {
        0..=100 => 4.0,
        101..=1000 => 3.0,
        _ => 2.0,
    };
    let inside = |p: &&Point| frame.rect.grown(0.5).contains(**p);
    points
        .iter()
        .flatten()
        .filter(inside)
        .try_for_each(|p| canvas.marker(*p, marker, radius, color))
}

fn draw_error_bar(
    canvas: &Canvas<'_>,
    frame: &Frame,
    x: f64,
    (low, high): (f64, f64),
    color: Color,
) -> Result<(), ReportError> {
    let (Some(x), Some(low), Some(high)) = (
        frame.x.share(x),
        frame.y.share_or_low(low),
        frame.y.share_or_low(high),
    ) else {
        return Ok(());
    };
    let stroke = Stroke::new(color, 1.2);
    let (low, high) = (frame.place(x, low), frame.place(x, high));
    for piece in frame.rect.polyline([Some(low), Some(high)]) {
        canvas.line(&piece, stroke)?;
    }
    for end in [low, high] {
        if frame.rect.contains(end) {
            canvas.line(&[[end[0] - 4.0, end[1]], [end[0] + 4.0, end[1]]], stroke)?;
        }
    }
    Ok(())
}

/// The references inside the frame with the rectangles of their labels, moved down or left until they are free of each other.
fn reference_labels<'p>(plot: &'p Plot, frame: &Frame) -> Vec<(&'p Reference, Rect)> {
    let mut placed: Vec<(&Reference, Rect)> = Vec::new();
    for reference in &plot.references {
        let axis = if reference.vertical {
            &frame.x
        } else {
            &frame.y
        };
        let Some(share) = axis
            .share(reference.value)
            .filter(|s| (0.0..=1.0).contains(s))
        else {
            continue;
        };
        let (width, height) = (font::width(&reference.label, TICK) + 6.0, TICK + 5.0);
        let at = frame.place(share, share);
        let (mut left, mut top) = if reference.vertical {
            let right_side = at[0] + 4.0 + width < frame.rect.right;
            (
                if right_side {
                    at[0] + 4.0
                } else {
                    at[0] - 4.0 - width
                },
                frame.rect.top + 5.0,
            )
        } else {
            let above = at[1] - height - 2.0 > frame.rect.top;
            (
                frame.rect.right - width - 6.0,
                if above {
                    at[1] - height - 2.0
                } else {
                    at[1] + 3.0
                },
            )
        };
        let rect = |left: f64, top: f64| Rect {
            left,
            top,
            right: left + width,
            bottom: top + height,
        };
        while !reference.label.is_empty()
            && placed
                .iter()
                .any(|(r, other)| !r.label.is_empty() && other.overlaps(&rect(left, top)))
            && top + 2.0 * height < frame.rect.bottom
            && left > frame.rect.left
        {
            if reference.vertical {
                top += height + 2.0
            } else {
                left -= 20.0
            }
        }
        placed.push((reference, rect(left, top)));
    }
    placed
}

fn draw_references(
    canvas: &Canvas<'_>,
    frame: &Frame,
    references: &[(&Reference, Rect)],
) -> Result<(), ReportError> {
    for (reference, _) in references {
        let axis = if reference.vertical {
            &frame.x
        } else {
            &frame.y
        };
        let Some(share) = axis.share(reference.value) else {
            continue;
        };
        let (from, to) = if reference.vertical {
            (frame.place(share, 0.0), frame.place(share, 1.0))
        } else {
            (frame.place(0.0, share), frame.place(1.0, share))
        };
        canvas.dashed(
            &[from, to],
            Stroke::new(Color::GREY, 1.2),
            super::Dash::Dashed,
        )?;
    }
    Ok(())
}
