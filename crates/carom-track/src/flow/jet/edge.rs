//! Where a path crosses the surface of a slot jet.
//!
//! What tells inside from outside rises with |x| and with y, so its values at two corners of a box bound it in the box: a stretch of
//! the path whose box lies on one side surely does not cross. Nor does one whose ends lie further on this side than the second
//! derivative can bring it over between them: paths along the surface need no tiny boxes then. Others are halved.

use super::surface;
use crate::geometry::Path;
use carom::math::exp;
use std::f64::consts::PI;

/// One coordinate's control points of a stretch of the path.
type Points = [f64; 6];

/// Halvings after which a stretch is a point.
const DEEPEST: u32 = 50;

/// Values on the surface by rounding count as on it: this much of the two widths' product.
const THIN: f64 = 1e-13;

/// The first θ at which the path crosses the surface of a jet of that width, coming from inside or outside.
pub(super) fn crossing(path: &Path, width: f64, inside: bool) -> Option<f64> {
    let column = |c: usize| {
        let mut p = [path.start[c] / width; 6];
        for (p, q) in p.iter_mut().skip(1).zip(&path.points) {
            *p += q[c] / width;
        }
        p
    };
    let search = Search { x: column(0), y: column(1), inside };
    // a path that starts on the other side, by rounding, and goes on there has crossed already
    if search.value(0.0) > 0.0 && search.value(1e-6) > THIN {
        return Some(0.0);
    }
    search.first(&search.x, &search.y, 0.0, 1.0, DEEPEST)
}

struct Search {
    x: Points,
    y: Points,
    inside: bool,
}

impl Search {
    /// Below zero on the side the path comes from.
    fn side(&self, x: f64, y: f64) -> f64 {
        let f = surface(x.abs(), y.max(0.0));
        if self.inside { f } else { -f }
    }

    fn value(&self, theta: f64) -> f64 {
        self.side(at(&self.x, theta), at(&self.y, theta))
    }

    fn first(&self, x: &Points, y: &Points, low: f64, high: f64, depth: u32) -> Option<f64> {
        let (a, b) = (range(x), range(y));
        let (far, near) =
            (a[0].abs().max(a[1].abs()), if a[0] <= 0.0 && a[1] >= 0.0 { 0.0 } else { a[0].abs().min(a[1].abs()) });
        // the box's corner that lies furthest over on the other side
        let worst = if self.inside { self.side(far, b[1]) } else { self.side(near, b[0]) };
        if worst <= THIN {
            return None;
        }
        let small = far - near < 0.1 && b[1] - b[0] < 0.1;
        let (start, end) = (self.side(x[0], y[0]), self.side(x[5], y[5]));
        let crosses = start <= THIN && end > THIN;
        if depth == 0 || (small && crosses) {
            return crosses.then(|| self.root(low, high));
        }
        if small && start.max(end) + bend(x, y, far, b[1].max(0.0)) / 8.0 <= THIN {
            return None;
        }
        let middle = 0.5 * (low + high);
        let ((x1, x2), (y1, y2)) = (split(x), split(y));
        self.first(&x1, &y1, low, middle, depth - 1).or_else(|| self.first(&x2, &y2, middle, high, depth - 1))
    }

    /// The crossing between a θ on the near side and one beyond: the Illinois method, closed in on by halving.
    fn root(&self, low: f64, high: f64) -> f64 {
        let (mut low, mut high) = (low, high);
        let (mut below, mut above) = (self.value(low), self.value(high));
        let mut last = 0;
        for round in 0..80 {
            let secant = low + (high - low) * (below / (below - above));
            let theta = if round % 4 == 3 || !(secant > low && secant < high) { 0.5 * (low + high) } else { secant };
            if theta <= low || theta >= high || high - low < 1e-15 * high {
                break;
            }
            let value = self.value(theta);
            if value <= 0.0 {
                (low, below) = (theta, value);
                above *= if last == -1 { 0.5 } else { 1.0 };
                last = -1;
            } else {
                (high, above) = (theta, value);
                below *= if last == 1 { 0.5 } else { 1.0 };
                last = 1;
            }
        }
        high
    }
}

/// Largest second derivative of (X − 1)(Y − 1) over a stretch that reaches to `far` and `high`, for a parameter from 0 to 1.
fn bend(x: &Points, y: &Points, far: f64, high: f64) -> f64 {
    let first = |p: &Points| (0..5).fold(0.0f64, |m, i| m.max((p[i + 1] - p[i]).abs())) * 5.0 * PI;
    let second = |p: &Points| (0..4).fold(0.0f64, |m, i| m.max((p[i] - 2.0 * p[i + 1] + p[i + 2]).abs())) * 20.0 * PI;
    let power = |s: f64| exp(PI * (s.min(60.0) - 0.5));
    let (px, py) = (power(far), power(high));
    let (vx, vy) = (first(x), first(y));
    px * py.max(1.0) * (vx * vx + second(x)) + py * px.max(1.0) * (vy * vy + second(y)) + 2.0 * px * py * vx * vy
}

fn at(p: &Points, theta: f64) -> f64 {
    let mut c = *p;
    for top in (1..6).rev() {
        for i in 0..top {
            c[i] += theta * (c[i + 1] - c[i]);
        }
    }
    c[0]
}

fn range(p: &Points) -> [f64; 2] {
    p.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], c| [a.min(*c), b.max(*c)])
}

fn split(p: &Points) -> (Points, Points) {
    let (mut left, mut right, mut c) = (*p, *p, *p);
    for k in 0..6 {
        left[k] = c[0];
        right[5 - k] = c[5 - k];
        for i in 0..5 - k {
            c[i] = 0.5 * (c[i] + c[i + 1]);
        }
    }
    (left, right)
}
