//! Cutting lines and areas at the edge of the plot.

use super::canvas::Point;

/// A rectangle from its upper left to its lower right, in CSS pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Rect {
    pub(super) fn contains(&self, [x, y]: Point) -> bool {
        x >= self.left && x <= self.right && y >= self.top && y <= self.bottom
    }

    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(super) fn grown(&self, by: f64) -> Self {
        Self { left: self.left - by, top: self.top - by, right: self.right + by, bottom: self.bottom + by }
    }

    pub(super) fn clamp(&self, [x, y]: Point) -> Point {
        [x.clamp(self.left, self.right), y.clamp(self.top, self.bottom)]
    }

    /// The part of a segment inside (Liang & Barsky 1984), if any.
    fn segment(&self, a: Point, b: Point) -> Option<(Point, Point)> {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (toward, room) in
            [(-dx, a[0] - self.left), (dx, self.right - a[0]), (-dy, a[1] - self.top), (dy, self.bottom - a[1])]
        {
            if toward == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if toward < 0.0 {
                enter = enter.max(room / toward);
            } else {
                leave = leave.min(room / toward);
            }
        }
        let at = |t: f64| [a[0] + t * dx, a[1] + t * dy];
        (enter <= leave).then(|| (if enter > 0.0 { at(enter) } else { a }, if leave < 1.0 { at(leave) } else { b }))
    }

    /// The pieces inside of a line through `points`, which is broken at each `None`.
    pub(super) fn polyline(&self, points: impl IntoIterator<Item = Option<Point>>) -> Vec<Vec<Point>> {
        let mut pieces: Vec<Vec<Point>> = Vec::new();
        let mut previous: Option<Point> = None;
        for point in points {
            if let (Some(a), Some(b)) = (previous, point)
                && let Some((from, to)) = self.segment(a, b)
            {
                match pieces.last_mut() {
                    Some(piece) if piece.last() == Some(&from) => piece.push(to),
                    _ => pieces.push(vec![from, to]),
                }
            }
            previous = point;
        }
        pieces
    }

    /// The part of a polygon inside (Sutherland & Hodgman 1974).
    pub(super) fn polygon(&self, points: &[Point]) -> Vec<Point> {
        let mut kept = points.to_vec();
        for (axis, limit, sign) in
            [(0, self.left, 1.0), (0, self.right, -1.0), (1, self.top, 1.0), (1, self.bottom, -1.0)]
        {
            let inside = |p: &Point| sign * (p[axis] - limit) >= 0.0;
            let whole = std::mem::take(&mut kept);
            let Some(mut previous) = whole.last().copied() else {
                return kept;
            };
            for point in whole {
                if inside(&point) != inside(&previous) {
                    let t = (limit - previous[axis]) / (point[axis] - previous[axis]);
                    let mut cut =
                        [previous[0] + t * (point[0] - previous[0]), previous[1] + t * (point[1] - previous[1])];
                    cut[axis] = limit;
                    kept.push(cut);
                }
                if inside(&point) {
                    kept.push(point);
                }
                previous = point;
            }
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Rect = Rect { left: 0.0, top: 0.0, right: 1.0, bottom: 1.0 };

    #[test]
    fn a_line_is_cut_at_the_edges_and_broken_at_gaps() {
        let line = [Some([-1.0, 0.5]), Some([0.5, 0.5]), Some([0.5, 3.0]), None, Some([0.2, 0.2]), Some([0.4, 0.2])];
        let pieces = UNIT.polyline(line);
        assert_eq!(pieces, [vec![[0.0, 0.5], [0.5, 0.5], [0.5, 1.0]], vec![[0.2, 0.2], [0.4, 0.2]]]);
        assert!(UNIT.polyline([Some([2.0, 2.0]), Some([3.0, 2.0])]).is_empty());
    }

    #[test]
    fn a_polygon_is_cut_to_the_rectangle() {
        let area = |p: &[Point]| {
            (0..p.len()).map(|i| (p[i], p[(i + 1) % p.len()])).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
                / 2.0
        };
        let cut = UNIT.polygon(&[[0.5, 0.5], [2.0, 0.5], [2.0, 2.0], [0.5, 2.0]]);
        assert!((area(&cut) - 0.25).abs() < 1e-12, "{cut:?}");
        assert!(UNIT.polygon(&[[2.0, 2.0], [3.0, 2.0], [3.0, 3.0]]).is_empty());
    }
}
