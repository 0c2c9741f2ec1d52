//! Where data are on the picture, so that labels and legend can keep clear.

use super::canvas::Point;
use super::clip::Rect;
use super::draw::{areas, outline};
use super::frame::Frame;
use super::{Plot, Shape};

/// Size of a cell in CSS pixels.
const CELL: f64 = 4.0;

/// The frame in cells, each free or covered, so that a question costs the same for any amount of data.
pub(super) struct Occupied {
    frame: Rect,
    columns: usize,
    rows: usize,
    lines: Vec<bool>,
    areas: Vec<bool>,
}

impl Occupied {
    pub(super) fn new(plot: &Plot, frame: &Frame) -> Self {
        let rect = frame.rect;
        let (columns, rows) = ((rect.width() / CELL).ceil() as usize, (rect.height() / CELL).ceil() as usize);
        let free = || vec![false; columns * rows];
        let mut occupied = Self { frame: rect, columns, rows, lines: free(), areas: free() };
        for series in &plot.series {
            match &series.shape {
                Shape::Line { x, y, .. } => occupied.polyline(outline(frame, x, y)),
                Shape::Points { x, y, interval, .. } => {
                    outline(frame, x, y).into_iter().flatten().for_each(|p| occupied.segment(p, p));
                    for (x, (low, high)) in x.iter().zip(interval) {
                        occupied.polyline([*low, *high].map(|y| frame.point(*x, y)));
                    }
                }
                Shape::Band { .. } | Shape::Bars { .. } => {
                    areas(frame, &series.shape).iter().for_each(|polygon| occupied.area(polygon));
                }
            }
        }
        for [from, to] in &plot.walls {
            occupied.polyline([from, to].map(|[x, y]| frame.point(*x, *y)));
        }
        occupied
    }

    fn cell(&self, [x, y]: Point) -> Option<usize> {
        let (column, row) = ((x - self.frame.left) / CELL, (y - self.frame.top) / CELL);
        let inside = column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64;
        inside.then(|| row as usize * self.columns + column as usize)
    }

    fn polyline(&mut self, points: impl IntoIterator<Item = Option<Point>>) {
        for piece in self.frame.polyline(points) {
            piece.windows(2).for_each(|pair| self.segment(pair[0], pair[1]));
        }
    }

    fn segment(&mut self, a: Point, b: Point) {
        let steps = ((b[0] - a[0]).hypot(b[1] - a[1]) / CELL).ceil().clamp(1.0, 10_000.0);
        for step in 0..=steps as usize {
            let t = step as f64 / steps;
            if let Some(cell) = self.cell([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]) {
                self.lines[cell] = true;
            }
        }
    }

    /// Covers the cells whose middles lie in a polygon: between its crossings with each column's middle, pair by pair.
    fn area(&mut self, polygon: &[Point]) {
        for column in 0..self.columns {
            let x = self.frame.left + (column as f64 + 0.5) * CELL;
            let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
            let mut crossings: Vec<f64> = edges
                .filter(|(a, b)| (a[0] <= x) != (b[0] <= x))
                .map(|(a, b)| a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]))
                .collect();
            crossings.sort_by(f64::total_cmp);
            for pair in crossings.chunks_exact(2) {
                let row = |y: f64| (((y - self.frame.top) / CELL).round().max(0.0) as usize).min(self.rows);
                for row in row(pair[0])..row(pair[1]) {
                    self.areas[row * self.columns + column] = true;
                }
            }
        }
    }

    /// Numbers of cells in a rectangle that lines or marks cover, and that areas cover.
    pub(super) fn count(&self, rect: &Rect) -> (usize, usize) {
        let index = |at: f64, from: f64, end: usize| (((at - from) / CELL).max(0.0) as usize).min(end);
        let columns =
            index(rect.left, self.frame.left, self.columns)..index(rect.right + CELL, self.frame.left, self.columns);
        let rows = index(rect.top, self.frame.top, self.rows)..index(rect.bottom + CELL, self.frame.top, self.rows);
        let (mut lines, mut areas) = (0, 0);
        for row in rows {
            for cell in columns.clone().map(|column| row * self.columns + column) {
                lines += usize::from(self.lines[cell]);
                areas += usize::from(self.areas[cell]);
            }
        }
        (lines, areas)
    }
}
