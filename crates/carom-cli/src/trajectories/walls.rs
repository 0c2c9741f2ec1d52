//! Walls as they are seen along z.

use carom_track::About;
use carom_track::about::{AboutCylinder, AboutPlane};

type Line = [[f64; 2]; 2];

/// What is drawn of the walls within the corners.
pub fn lines(about: &About, low: [f64; 2], high: [f64; 2]) -> Vec<Line> {
    // as far as the air about the corners goes
    let air = [0, 1].map(|axis| 0.04 * (high[axis] - low[axis]));
    let (low, high) = ([low[0] - air[0], low[1] - air[1]], [high[0] + air[0], high[1] + air[1]]);
    let planes = about.planes.iter().filter_map(|plane| edge(plane, low, high));
    let round = about.cylinders.iter().flat_map(|cylinder| sides(cylinder, low, high));
    let outlines = about.outlines.iter().flat_map(|outline| outline.lines.iter().copied());
    planes.chain(round).chain(outlines).collect()
}

/// Chords of a circle.
const CHORDS: usize = 180;

/// A cylinder as it is seen: a circle from its end, else its two sides.
fn sides(cylinder: &AboutCylinder, low: [f64; 2], high: [f64; 2]) -> Vec<Line> {
    let [ax, ay, _] = cylinder.axis;
    let [x, y, _] = cylinder.point;
    let length = ax.hypot(ay);
    if length < 1e-6 {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * (i % CHORDS) as f64 / CHORDS as f64;
            [x + cylinder.radius * angle.cos(), y + cylinder.radius * angle.sin()]
        };
        return (0..CHORDS).map(|i| [at(i), at(i + 1)]).collect();
    }
    let normal = [-ay / length, ax / length];
    let side = |sign: f64| {
        let point = [x + sign * cylinder.radius * normal[0], y + sign * cylinder.radius * normal[1], 0.0];
        edge(&AboutPlane { name: String::new(), point, normal: [normal[0], normal[1], 0.0] }, low, high)
    };
    [1.0, -1.0].into_iter().filter_map(side).collect()
}

/// Corners of what has some: outlines, circles, and of the sides of a tube along an axis the distance between them.
fn bounds(about: &About) -> Vec<Line> {
    let points = |outline: &[Line]| {
        let none = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        outline.iter().flatten().fold(none, |[low, high], p| {
            [[0, 1].map(|axis| low[axis].min(p[axis])), [0, 1].map(|axis| high[axis].max(p[axis]))]
        })
    };
    let outlines = about.outlines.iter().filter(|o| !o.lines.is_empty()).map(|o| points(&o.lines));
    let round = about.cylinders.iter().filter_map(|c| {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let reach = [0, 1].map(|axis| {
            // nothing of it ends along its axis
            let across = c.axis[axis].abs() < 1e-6;
            if across { [c.point[axis] - c.radius, c.point[axis] + c.radius] } else { none }
        });
        let any = reach.iter().any(|r| r[0] <= r[1]);
        any.then(|| [[reach[0][0], reach[1][0]], [reach[0][1], reach[1][1]]])
    });
    outlines.chain(round).collect()
}

/// The corners with the walls beside the paths that lie nearly across an axis, and never a span of zero.
pub fn with_walls(about: &About, mut low: [f64; 2], mut high: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let spans = [high[0] - low[0], high[1] - low[1]];
    for plane in &about.planes {
        for axis in 0..2 {
            let (at, near) = (plane.point[axis], 0.5 * spans[axis]);
            if plane.normal[axis].abs() > 0.999 && at > low[axis] - near && at < high[axis] + near {
                low[axis] = low[axis].min(at);
                high[axis] = high[axis].max(at);
            }
        }
    }
    for [from, to] in bounds(about) {
        for axis in 0..2 {
            // a wall far beyond the paths would make them a point
            let near = 1.5 * spans[0].max(spans[1]);
            low[axis] = low[axis].min(from[axis].max(low[axis] - near));
            high[axis] = high[axis].max(to[axis].min(high[axis] + near));
        }
    }
    for axis in 0..2 {
        if high[axis] <= low[axis] {
            let margin = 0.5 * spans[1 - axis].max(1e-6);
            low[axis] -= margin;
            high[axis] += margin;
        }
    }
    (low, high)
}

/// The part of a plane's trace within the corners; none for a plane that does not stand on edge.
fn edge(plane: &AboutPlane, low: [f64; 2], high: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let [nx, ny, nz] = plane.normal;
    if nz.abs() > 1e-9 {
        return None;
    }
    let along = [-ny, nx];
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..2 {
        // a hair of slack: a wall on the very edge is within
        let slack = 1e-9 * (high[axis] - low[axis]);
        let [a, b] = [low[axis] - slack - plane.point[axis], high[axis] + slack - plane.point[axis]];
        if along[axis].abs() < 1e-12 {
            if a > 0.0 || b < 0.0 {
                return None;
            }
            continue;
        }
        let [s, t] = [a / along[axis], b / along[axis]];
        from = from.max(s.min(t));
        to = to.min(s.max(t));
    }
    let at = |s: f64| [plane.point[0] + s * along[0], plane.point[1] + s * along[1]];
    (from < to && from.is_finite() && to.is_finite()).then(|| [at(from), at(to)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_is_cut_to_the_picture() {
        let name = String::new();
        let floor = AboutPlane { name, point: [5.0, 0.0, 0.0], normal: [0.0, 1.0, 0.0] };
        let mut ends = edge(&floor, [0.0, 0.0], [1.0, 2.0]).expect("it stands on edge");
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert!(ends[0][0].abs() < 1e-8 && (ends[1][0] - 1.0).abs() < 1e-8 && ends[0][1] == 0.0);
        let far = AboutPlane { point: [0.0, -3.0, 0.0], ..floor.clone() };
        assert_eq!(edge(&far, [0.0, 0.0], [1.0, 2.0]), None);
        let facing = AboutPlane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], ..floor };
        assert_eq!(edge(&facing, [0.0, 0.0], [1.0, 2.0]), None);
    }

    #[test]
    fn a_tube_is_a_circle_from_its_end_and_two_lines_from_its_side() {
        let name = String::new();
        let tube = AboutCylinder { name, point: [1.0, 2.0, 0.0], axis: [0.0, 0.0, 1.0], radius: 0.5 };
        let circle = sides(&tube, [0.0; 2], [3.0; 2]);
        assert_eq!(circle.len(), CHORDS);
        assert!(circle.iter().flatten().all(|p| ((p[0] - 1.0).hypot(p[1] - 2.0) - 0.5).abs() < 1e-12));
        let lying = AboutCylinder { axis: [1.0, 0.0, 0.0], ..tube };
        let mut heights: Vec<f64> = sides(&lying, [0.0; 2], [3.0; 2]).iter().map(|l| l[0][1]).collect();
        heights.sort_by(f64::total_cmp);
        assert_eq!(heights, [1.5, 2.5]);
        let about = About { cylinders: vec![lying], ..About::default() };
        assert_eq!(with_walls(&about, [0.0, 1.9], [3.0, 2.1]), ([0.0, 1.5], [3.0, 2.5]));
    }
}
