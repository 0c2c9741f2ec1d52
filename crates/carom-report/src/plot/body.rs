//! A body of triangles seen from aside, coloured by a value.
//!
//! The nearest are drawn last (the painter's algorithm). Of more triangles than a page bears, the picture is drawn in cells, each with
//! the nearest triangle behind its middle.

use super::canvas::{Anchor, Canvas, Label, Point, Stroke};
use super::font;
use super::frame::{LABEL, TICK, vertical_ticks, widest};
use super::heat_map::{BAR_WIDTH, MISSING, color_bar};
#[cfg(feature = "png")]
use super::png;
use super::scaled::{Margin, Scaled};
use super::{Axis, Color, ColorMap, ImageFormat, svg, write_image};
use crate::ReportError;
use std::path::Path;

/// Corners of a triangle.
pub type Triangle = [[f64; 3]; 3];

/// Triangles drawn one by one.
const FEW: usize = 8000;
/// Cells along the picture's width where there are more.
const CELLS: usize = 220;
/// Colours there: neighbours that look alike are drawn as one.
const SHADES: f64 = 48.0;

/// A picture of a body, with a colour bar.
///
/// ```
/// use carom_report::{Axis, Body};
///
/// let corner = [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]];
/// let body = Body::new(Axis::new("mass", "kg"), corner.into_iter().zip([1.0, f64::NAN])); // no value: grey
/// assert!(body.svg()?.contains("mass (kg)"));
/// # Ok::<(), carom_report::ReportError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The value: its name, unit, scale and range, shown beside the colour bar.
    pub value: Axis,
    /// Triangles with their values; NaN is none (grey).
    pub triangles: Vec<(Triangle, f64)>,
    /// Where it is seen from, as a direction out of the picture.
    pub from: [f64; 3],
    /// What points upwards in the picture.
    pub up: [f64; 3],
    /// Width and height in CSS pixels.
    pub size: (u32, u32),
}

/// A triangle in the picture: its corners, how near it is at each, and its colour.
struct Seen {
    corners: [Point; 3],
    near: [f64; 3],
    color: Color,
}

impl Body {
    /// Triangles with their values, seen from the front, above and the right.
    pub fn new(value: Axis, triangles: impl IntoIterator<Item = (Triangle, f64)>) -> Self {
        let triangles = triangles.into_iter().collect();
        Self { value, triangles, from: [0.45, 0.5, 1.0], up: [0.0, 1.0, 0.0], size: (900, 520) }
    }

    /// The picture as an SVG document.
    ///
    /// # Errors
    /// None now.
    pub fn svg(&self) -> Result<String, ReportError> {
        Ok(svg::document(&self.drawn()))
    }

    /// The picture as PNG bytes, two pixels for each CSS pixel.
    ///
    /// # Errors
    /// What the encoder says.
    #[cfg(feature = "png")]
    pub fn png(&self) -> Result<Vec<u8>, ReportError> {
        png::encode(&self.drawn())
    }

    /// Writes the picture to `path` as SVG or PNG, told by its extension.
    ///
    /// # Errors
    /// An unknown extension, or what the file system says.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), ReportError> {
        let path = path.as_ref();
        let format = ImageFormat::from_path(path)?;
        write_image(path, format, &self.drawn())
    }

    fn drawn(&self) -> Canvas {
        let mut canvas = Canvas::new(self.size);
        let value = Scaled::new(&self.value, self.triangles.iter().map(|t| t.1), Margin::None);
        let [width, height] = [self.size.0, self.size.1].map(f64::from);
        let ticks = vertical_ticks(&value, height - 80.0);
        let heading = if self.value.heading().is_empty() { 14.0 } else { 38.0 };
        let left = width - 9.0 - BAR_WIDTH - widest(&ticks) - heading;
        let eye = Eye::new(self);
        let mut seen = self.seen(&eye, &value, [left - 24.0, height]);
        if seen.len() > FEW {
            cells(&mut canvas, &seen, [left - 24.0, height]);
        } else {
            seen.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
            for triangle in &seen {
                canvas.polygon(&grown(&triangle.corners), triangle.color, 1.0);
            }
        }
        color_bar(&mut canvas, [left, 40.0, height - 40.0], ColorMap::Viridis, &ticks, &self.value.heading());
        eye.axes(&mut canvas, [46.0, height - 46.0]);
        canvas
    }

    /// All triangles with an extent, fitted into the picture.
    fn seen(&self, eye: &Eye, value: &Scaled, [width, height]: [f64; 2]) -> Vec<Seen> {
        let placed: Vec<([[f64; 3]; 3], Color)> = self
            .triangles
            .iter()
            .filter(|(corners, _)| corners.as_flattened().iter().all(|x| x.is_finite()))
            .map(|(corners, data)| {
                let color = value.share_or_low(*data).map_or(MISSING, |share| ColorMap::Viridis.at(share));
                (corners.map(|x| eye.see(x)), color.mix(Color::BLACK, 0.45 * (1.0 - eye.facing(corners))))
            })
            .collect();
        let ends = |c: usize| {
            let all = placed.iter().flat_map(|p| p.0.iter().map(move |x| x[c]));
            all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)])
        };
        let reach = [ends(0), ends(1)];
        let span = reach.map(|[a, b]| b - a);
        let scale = ((width - 40.0) / span[0]).min((height - 40.0) / span[1]);
        if !(scale > 0.0 && scale.is_finite()) {
            return Vec::new();
        }
        let middle = reach.map(|[a, b]| 0.5 * (a + b));
        let place = |x: [f64; 3]| [0.5 * width + scale * (x[0] - middle[0]), 0.5 * height - scale * (x[1] - middle[1])];
        placed.into_iter().map(|(x, color)| Seen { corners: x.map(place), near: x.map(|c| c[2]), color }).collect()
    }
}

fn depth(triangle: &Seen) -> f64 {
    triangle.near.iter().sum()
}

/// A little beyond its edges, so that no seam shows.
fn grown(corners: &[Point; 3]) -> [Point; 3] {
    let middle = [0, 1].map(|c| corners.iter().map(|p| p[c]).sum::<f64>() / 3.0);
    corners.map(|p| {
        let away = [p[0] - middle[0], p[1] - middle[1]];
        let length = away[0].hypot(away[1]);
        let by = if length > 0.0 { 0.5 / length } else { 0.0 };
        [p[0] + by * away[0], p[1] + by * away[1]]
    })
}

/// Draws what is nearest in each cell.
fn cells(canvas: &mut Canvas, seen: &[Seen], [width, height]: [f64; 2]) {
    let cell = width / CELLS as f64;
    let rows = (height / cell).ceil().max(1.0) as usize;
    let mut nearest = vec![(f64::NEG_INFINITY, None); CELLS * rows];
    for triangle in seen {
        let range = |c: usize, count: usize| {
            let all = || triangle.corners.iter().map(|p| p[c] / cell - 0.5);
            let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
            (low.ceil().max(0.0) as usize)..((high.floor() + 1.0).clamp(0.0, count as f64) as usize)
        };
        for row in range(1, rows) {
            for column in range(0, CELLS) {
                let at = [(column as f64 + 0.5) * cell, (row as f64 + 0.5) * cell];
                if let Some(near) = within(triangle, at)
                    && near > nearest[row * CELLS + column].0
                {
                    nearest[row * CELLS + column] = (near, Some(shade(triangle.color)));
                }
            }
        }
    }
    for (row, colors) in nearest.chunks(CELLS).enumerate() {
        let mut column = 0;
        for run in colors.chunk_by(|a, b| a.1 == b.1) {
            if let Some(color) = run[0].1 {
                let from = [column as f64 * cell, row as f64 * cell];
                let to = [from[0] + run.len() as f64 * cell + 0.5, from[1] + cell + 0.5];
                canvas.rectangle(from, to, color, 1.0);
            }
            column += run.len();
        }
    }
}

fn shade(color: Color) -> Color {
    let step = |c: u8| ((f64::from(c) * SHADES / 255.0).round() * 255.0 / SHADES) as u8;
    Color(step(color.0), step(color.1), step(color.2))
}

/// How near a triangle is behind a point of the picture, if it is there.
fn within(triangle: &Seen, at: Point) -> Option<f64> {
    let [a, b, c] = triangle.corners;
    let cross = |p: Point, q: Point| (p[0] - at[0]) * (q[1] - at[1]) - (p[1] - at[1]) * (q[0] - at[0]);
    let parts = [cross(b, c), cross(c, a), cross(a, b)];
    let all: f64 = parts.iter().sum();
    let inside = parts.iter().all(|p| *p >= 0.0) || parts.iter().all(|p| *p <= 0.0);
    (inside && all != 0.0).then(|| parts.iter().zip(triangle.near).map(|(p, near)| p / all * near).sum())
}

/// Where the body is seen from.
struct Eye {
    /// Directions to the right, upwards and towards the eye.
    axes: [[f64; 3]; 3],
}

impl Eye {
    fn new(body: &Body) -> Self {
        let towards = unit(body.from).unwrap_or([0.0, 0.0, 1.0]);
        let right = unit(cross(body.up, towards)).unwrap_or([1.0, 0.0, 0.0]);
        Self { axes: [right, cross(towards, right), towards] }
    }

    fn see(&self, x: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| dot(axis, x))
    }

    /// 1 for a triangle that faces the eye, from either side, 0 for one seen edge on.
    fn facing(&self, corners: &Triangle) -> f64 {
        let edge = |i: usize| [0, 1, 2].map(|c| corners[i][c] - corners[0][c]);
        unit(cross(edge(1), edge(2))).map_or(1.0, |n| dot(n, self.axes[2]).abs())
    }

    /// The directions of x, y and z.
    fn axes(&self, canvas: &mut Canvas, at: Point) {
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let way = [self.axes[0][axis], -self.axes[1][axis]];
            let end = |length: f64| [at[0] + length * way[0], at[1] + length * way[1]];
            canvas.line(&[at, end(26.0)], Stroke::new(Color(70, 70, 70), 1.3));
            let [x, y] = end(35.0);
            let width = font::width(name, TICK);
            canvas.text([x - 0.5 * width, y + 0.36 * TICK], Label::new(name, LABEL.min(TICK), Anchor::Start));
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(a, a).sqrt();
    (length > 0.0 && length.is_finite()).then(|| a.map(|c| c / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(triangles: Vec<(Triangle, f64)>) -> Body {
        Body { from: [0.0, 0.0, 1.0], ..Body::new(Axis::new("value", ""), triangles) }
    }

    /// A square of two triangles at a height.
    fn square(side: f64, z: f64, value: f64) -> Vec<(Triangle, f64)> {
        let at = |x: f64, y: f64| [x * side, y * side, z];
        vec![
            ([at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0)], value),
            ([at(-1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)], value),
        ]
    }

    #[test]
    fn the_nearest_is_drawn_last_and_hides_the_others() {
        let near = [square(0.5, 1.0, 7.0), square(1.0, 0.0, 1.0)].concat();
        let eye = Eye::new(&body(near.clone()));
        let value = Scaled::new(&Axis::new("value", ""), [1.0, 7.0], Margin::None);
        let mut seen = body(near.clone()).seen(&eye, &value, [800.0, 500.0]);
        seen.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        assert_eq!(seen.last().map(|t| t.color), Some(ColorMap::Viridis.at(1.0)));
        // fitted: the large square is as high as the picture less its margins
        let heights = seen.iter().flat_map(|t| t.corners.map(|p| p[1]));
        let (low, high) = heights.fold((f64::INFINITY, 0.0f64), |(a, b), y| (a.min(y), b.max(y)));
        assert!((low - 20.0).abs() < 1e-9 && (high - 480.0).abs() < 1e-9);
        // in cells: the middle is the near one's, the rim the far one's
        let mut canvas = Canvas::new((800, 500));
        cells(&mut canvas, &seen, [800.0, 500.0]);
        let color_at = |x: f64, y: f64| {
            canvas.elements.iter().rev().find_map(|e| match e {
                super::super::canvas::Element::Rectangle { from, to, fill }
                    if (from[0]..to[0]).contains(&x) && (from[1]..to[1]).contains(&y) =>
                {
                    Some(fill.color)
                }
                _ => None,
            })
        };
        assert_eq!(color_at(400.0, 250.0), Some(shade(ColorMap::Viridis.at(1.0))));
        assert_eq!(color_at(190.0, 250.0), Some(shade(ColorMap::Viridis.at(0.0))));
        assert_eq!(color_at(60.0, 250.0), Some(Color(255, 255, 255)));
    }

    #[test]
    fn nothing_and_what_has_no_extent_make_a_picture() {
        assert!(body(Vec::new()).svg().is_ok_and(|s| s.contains("<svg")));
        let point = [[0.0; 3]; 3];
        assert!(body(vec![(point, 1.0), ([[f64::NAN; 3]; 3], 1.0)]).svg().is_ok_and(|s| !s.contains("NaN")));
    }

    #[test]
    fn many_triangles_make_no_large_file() {
        // a field of 100 × 100 small squares, two triangles each
        let small = |i: u32| {
            let by = [f64::from(i % 100), f64::from(i / 100), 0.0];
            let shifted = move |x: [f64; 3]| [0, 1, 2].map(|c| x[c] + by[c]);
            square(0.5, 0.0, f64::from(i % 7)).into_iter().map(move |(t, value)| (t.map(shifted), value))
        };
        let many: Vec<_> = (0..10_000).flat_map(small).collect();
        assert!(many.len() > FEW);
        assert!(body(many).svg().is_ok_and(|s| s.len() < 2_000_000));
    }
}
