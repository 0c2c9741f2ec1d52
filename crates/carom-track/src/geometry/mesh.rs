//! A triangulated wall, met from either side.
//!
//! A sphere touches a triangle on its face, an edge or a corner: the centre's path is tested against the plane one radius
//! off, the cylinders around the edges and the spheres around the corners, and the earliest contact counts. The path's
//! control points bound it, so only triangles near their box are looked at, found through a tree of boxes.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::contact::{bounded_contact, first_contact};
use super::{Bernstein, Bounds, Meeting, Path};
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::{Mask, mask};
use crate::vector::{Vec3, add, cross, dot, norm, scale, sub, unit};

/// A triangle by its corners, m.
pub type Triangle = [Vec3; 3];

/// Triangles and the tree that finds them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// In the order of the leaves.
    triangles: Vec<Triangle>,
    /// Where each was in the list given.
    numbers: Vec<u32>,
    nodes: Vec<Node>,
    /// The block that it is the surface of, if it is one.
    solid: Option<Bounds>,
}

/// A box with a run of triangles (a leaf) or two boxes: the next node and the one named.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    bounds: Bounds,
    first: usize,
    count: usize,
    second: usize,
}

/// Triangles in a leaf.
const LEAF: usize = 4;

impl Mesh {
    /// A wall of triangles; those without area are left out. `None` if none is left.
    pub fn new(triangles: Vec<Triangle>) -> Option<Self> {
        let area = |t: &Triangle| norm(cross(sub(t[1], t[0]), sub(t[2], t[0])));
        let mut numbered: Vec<(Triangle, u32)> = triangles.into_iter().zip(0..).collect();
        numbered.retain(|(t, _)| area(t) > 0.0 && area(t).is_finite());
        let mut nodes = Vec::new();
        let all = numbered.len();
        grow(&mut numbered, 0, all, &mut nodes);
        let (triangles, numbers): (Vec<_>, Vec<_>) = numbered.into_iter().unzip();
        (!triangles.is_empty()).then_some(Self { triangles, numbers, nodes, solid: None })
    }

    /// The outside of a block along the axes: twelve triangles.
    pub fn block(min: Vec3, max: Vec3) -> Option<Self> {
        const FACES: [[usize; 4]; 6] =
            [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        let v = |i: usize| [0, 1, 2].map(|c| if i >> c & 1 == 0 { min[c] } else { max[c] });
        let halves = |q: &[usize; 4]| [[v(q[0]), v(q[1]), v(q[2])], [v(q[0]), v(q[2]), v(q[3])]];
        let surface = Self::new(FACES.iter().flat_map(halves).collect())?;
        Some(Self { solid: Some(Bounds { min, max }), ..surface })
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::NONE, |n| n.bounds)
    }

    /// Which of `W` paths come near the box around it.
    #[inline(always)]
    pub(super) fn may_meet<const W: usize>(
        &self,
        start: &Lanes3<W>,
        path: &[Lanes3<W>; 5],
        clearance: &Lanes<W>,
        margin: &Lanes<W>,
    ) -> Mask<W> {
        let bounds = self.bounds();
        let mut may = [u64::MAX; W];
        for c in 0..3 {
            for l in 0..W {
                let (mut low, mut high) = (0.0, 0.0);
                for p in path {
                    low = if p[c][l] < low { p[c][l] } else { low };
                    high = if p[c][l] > high { p[c][l] } else { high };
                }
                let reach = clearance[l] + margin[l];
                may[l] &= !mask(start[c][l] + low > bounds.max[c] + reach);
                may[l] &= !mask(start[c][l] + high < bounds.min[c] - reach);
            }
        }
        may
    }

    /// Tells the number, the normal and the gap (m) of the triangles within `slack` of contact with a sphere at `x`.
    pub(super) fn touched(&self, x: Vec3, clearance: f64, slack: f64, tell: &mut impl FnMut(u32, Vec3, f64)) {
        let reach = Bounds::around([x]).wider(clearance + slack);
        let mut stack = vec![0];
        while let Some((index, node)) = stack.pop().and_then(|i| self.nodes.get(i).map(|n| (i, n))) {
            if !node.bounds.meets(&reach) {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.second, index + 1]);
            }
            for i in node.first..node.first + node.count {
                let away = sub(x, nearest(&self.triangles[i], x));
                let gap = norm(away) - clearance;
                if gap <= slack
                    && let Some(normal) = unit(away)
                {
                    tell(self.numbers[i], normal, gap);
                }
            }
        }
    }

    /// How many triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Never: a wall has triangles.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Distance of a point from the nearest triangle, m; negative in a block.
    pub fn distance(&self, x: Vec3) -> f64 {
        let inside = self.solid.is_some_and(|s| (0..3).all(|c| x[c] > s.min[c] && x[c] < s.max[c]));
        if inside { -self.away(x) } else { self.away(x) }
    }

    fn away(&self, x: Vec3) -> f64 {
        let mut best = f64::INFINITY;
        let mut stack = vec![0];
        while let Some(node) = stack.pop().and_then(|i| self.nodes.get(i).map(|n| (i, n))) {
            let (index, node) = node;
            if node.bounds.distance(x) >= best {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.second, index + 1]);
            }
            for t in self.triangles.iter().skip(node.first).take(node.count) {
                best = best.min(distance(t, x));
            }
        }
        best
    }

    /// Where a path first comes within `clearance` of a triangle.
    pub fn meet(&self, path: &Path, clearance: f64, slack: f64) -> Option<(Meeting, u32)> {
        let region = Bounds::of_path(path).wider(clearance + slack);
        let mut best: Option<(Meeting, u32)> = None;
        let mut stack = vec![0];
        while let Some((index, node)) = stack.pop().and_then(|i| self.nodes.get(i).map(|n| (i, n))) {
            if !node.bounds.meets(&region) {
                continue;
            }
            if node.count == 0 {
                stack.extend([node.second, index + 1]);
            }
            for i in node.first..node.first + node.count {
                if let Some(m) = touch(&self.triangles[i], path, clearance, slack)
                    && best.is_none_or(|(b, _)| m.theta < b.theta)
                {
                    best = Some((m, self.numbers[i]));
                }
            }
        }
        best
    }
}

/// Splits a run of triangles by the middle of its longest side until few are left.
fn grow(triangles: &mut [(Triangle, u32)], first: usize, count: usize, nodes: &mut Vec<Node>) {
    let Some(run) = triangles.get_mut(first..first + count) else { return };
    let bounds = Bounds::around(run.iter().flat_map(|(t, _)| *t));
    let here = nodes.len();
    if count <= LEAF {
        nodes.push(Node { bounds, first, count, second: 0 });
        return;
    }
    let side = |c: usize| bounds.max[c] - bounds.min[c];
    let axis = (1..3).fold(0, |a, c| if side(c) > side(a) { c } else { a });
    let middle = |(t, _): &(Triangle, u32)| t[0][axis] + t[1][axis] + t[2][axis];
    run.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
    nodes.push(Node { bounds, first, count: 0, second: 0 });
    grow(triangles, first, count / 2, nodes);
    let second = nodes.len();
    if let Some(node) = nodes.get_mut(here) {
        node.second = second;
    }
    grow(triangles, first + count / 2, count - count / 2, nodes);
}

/// The first contact with one triangle.
fn touch(t: &Triangle, path: &Path, clearance: f64, slack: f64) -> Option<Meeting> {
    let mut best = face(t, path, clearance, slack);
    if clearance <= 0.0 {
        // a point has no width to touch an edge with
        return best;
    }
    for i in 0..3 {
        let theta = edge(t[i], t[(i + 1) % 3], path, clearance, slack);
        let theta = [theta, corner(t[i], path, clearance, slack)].into_iter().flatten().fold(f64::INFINITY, f64::min);
        if theta.is_finite() && best.is_none_or(|b| theta < b.theta) {
            let x = path.at(theta);
            let foot = nearest(t, x);
            // from the nearest point of the triangle to the centre: across the edge or the corner
            if let Some(normal) = unit(sub(x, foot)) {
                best = Some(Meeting { theta, position: add(foot, scale(normal, clearance)), normal });
            }
        }
    }
    best
}

/// Contact with the face, on the side the sphere is on or on the other, which it may reach around an edge.
fn face(t: &Triangle, path: &Path, clearance: f64, slack: f64) -> Option<Meeting> {
    let n = unit(cross(sub(t[1], t[0]), sub(t[2], t[0])))?;
    let height = dot(n, sub(path.start, t[0]));
    // a point that touches is on the side it moves to
    let side = if height.abs() > slack { height } else { dot(n, path.points[0]) };
    let near = if side < 0.0 { scale(n, -1.0) } else { n };
    let first = face_from(t, near, path, clearance, slack, false);
    let second = face_from(t, scale(near, -1.0), path, clearance, slack, true);
    match (first, second) {
        (Some(a), Some(b)) => Some(if b.theta < a.theta { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// Contact on the side that `n` points to; `far` if the path starts on the other.
fn face_from(t: &Triangle, n: Vec3, path: &Path, clearance: f64, slack: f64, far: bool) -> Option<Meeting> {
    let gap = dot(n, sub(path.start, t[0])) - clearance;
    let turn = winding(t, n);
    let over = |theta: f64| {
        let x = path.at(theta);
        (0..3).all(|i| dot(cross(sub(t[(i + 1) % 3], t[i]), sub(x, t[i])), n) * turn >= 0.0)
    };
    let along = path.along(n);
    let theta = if far {
        along.scaled(1.0, gap.min(-f64::MIN_POSITIVE)).first_descent(over)?
    } else {
        bounded_contact(gap, &along, slack, over)?
    };
    let x = path.at(theta);
    let off = dot(n, sub(x, t[0])) - clearance;
    Some(Meeting { theta, position: sub(x, scale(n, off)), normal: n })
}

/// +1 where the corners go round `n` to the left.
fn winding(t: &Triangle, n: Vec3) -> f64 {
    dot(cross(sub(t[1], t[0]), sub(t[2], t[0])), n).signum()
}

fn edge(a: Vec3, b: Vec3, path: &Path, clearance: f64, slack: f64) -> Option<f64> {
    let along = sub(b, a);
    let length = norm(along);
    let e = unit(along)?;
    let across = |x: Vec3| sub(x, scale(e, dot(x, e)));
    let beside = |theta: f64| {
        let s = dot(e, sub(path.at(theta), a));
        s >= 0.0 && s <= length
    };
    let (gap, change) = square(across(sub(path.start, a)), &path.points.map(across), clearance);
    bounded_contact(gap, &change, 2.0 * clearance * slack, beside)
}

fn corner(a: Vec3, path: &Path, clearance: f64, slack: f64) -> Option<f64> {
    let (gap, change) = square(sub(path.start, a), &path.points, clearance);
    first_contact(gap, &change, 2.0 * clearance * slack, |_| true)
}

/// |r₀ + p(θ)|² − c² at the start, and how it changes.
fn square(r0: Vec3, points: &[Vec3; 5], clearance: f64) -> (f64, Bernstein<11>) {
    let rho = norm(r0);
    let mut change = Bernstein([0.0; 11]);
    for c in 0..3 {
        let p = Bernstein([0.0, points[0][c], points[1][c], points[2][c], points[3][c], points[4][c]]);
        change = change.plus(&p.times(&p.scaled(1.0, 2.0 * r0[c])));
    }
    ((rho - clearance) * (rho + clearance), change)
}

fn distance(t: &Triangle, x: Vec3) -> f64 {
    norm(sub(x, nearest(t, x)))
}

/// The point of a triangle nearest to `x` (Ericson 2005, *Real-Time Collision Detection*, section 5.1.5).
fn nearest(t: &Triangle, x: Vec3) -> Vec3 {
    let [a, b, c] = *t;
    let (ab, ac, ax) = (sub(b, a), sub(c, a), sub(x, a));
    let (d1, d2) = (dot(ab, ax), dot(ac, ax));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bx = sub(x, b);
    let (d3, d4) = (dot(ab, bx), dot(ac, bx));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return add(a, scale(ab, d1 / (d1 - d3)));
    }
    let cx = sub(x, c);
    let (d5, d6) = (dot(ab, cx), dot(ac, cx));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return add(a, scale(ac, d2 / (d2 - d6)));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return add(b, scale(sub(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6))));
    }
    let all = va + vb + vc;
    add(a, add(scale(ab, vb / all), scale(ac, vc / all)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FLAT: Triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];

    fn fly(t: Triangle, from: Vec3, by: Vec3) -> Option<Meeting> {
        Mesh::new(vec![t]).unwrap().meet(&Path::straight(from, by), 0.1, 1e-12).map(|(m, _)| m)
    }

    #[test]
    fn face_edge_and_corner_from_both_sides() {
        for s in [1.0, -1.0] {
            let m = fly(FLAT, [0.2, s, 0.2], [0.0, -2.0 * s, 0.0]).unwrap();
            assert!((m.theta - 0.45).abs() < 1e-14 && (m.position[1] - 0.1 * s).abs() < 1e-15);
            assert_eq!(m.normal, [0.0, s, 0.0]);
            // 0.06 beyond the edge along x: the sphere is met 0.08 above it
            let m = fly(FLAT, [0.5, s, -0.06], [0.0, -2.0 * s, 0.0]).unwrap();
            assert!((m.position[1] - 0.08 * s).abs() < 1e-14, "{m:?}");
            assert!((m.normal[2] + 0.6).abs() < 1e-13 && (m.normal[1] - 0.8 * s).abs() < 1e-13);
            // beyond a corner, and too far beyond it
            let m = fly(FLAT, [-0.048, s, -0.036], [0.0, -2.0 * s, 0.0]).unwrap();
            assert!((m.position[1] - 0.08 * s).abs() < 1e-14, "{m:?}");
            assert!(fly(FLAT, [-0.08, s, -0.07], [0.0, -2.0 * s, 0.0]).is_none());
        }
    }

    #[test]
    fn a_sphere_level_with_the_plane_meets_the_edge_not_the_face() {
        let m = fly(FLAT, [0.4, 0.05, -1.0], [0.0, 0.0, 2.0]).unwrap();
        assert!((m.position[2] + (0.01f64 - 0.0025).sqrt()).abs() < 1e-13, "{m:?}");
    }

    #[test]
    fn a_path_around_an_edge_meets_the_far_side() {
        // from above, past the edge, under the triangle and up against its lower side
        let points = [[0.0, -0.4, -2.64], [0.0, -2.6, -3.3], [0.0, -4.0, -1.3], [0.0, -3.2, 1.36], [0.0, 0.0, 0.0]];
        let path = Path { start: [0.2, 1.0, 0.3], points };
        let m = Mesh::new(vec![FLAT]).unwrap().meet(&path, 0.1, 1e-12).unwrap().0;
        assert_eq!(m.normal, [0.0, -1.0, 0.0], "{m:?}");
        assert!((m.position[1] + 0.1).abs() < 1e-15);
    }

    #[test]
    fn a_block_is_hit_on_its_rounded_corner() {
        let block = Mesh::block([0.0; 3], [1.0; 3]).unwrap();
        // straight at the corner at the origin, from outside along the diagonal
        let m = block.meet(&Path::straight([-1.0; 3], [1.0; 3]), 0.1, 1e-12).unwrap().0;
        assert!(
            (norm(m.position) - 0.1).abs() < 1e-14 && m.normal.iter().all(|c| (c + 1.0 / 3f64.sqrt()).abs() < 1e-13)
        );
    }

    #[test]
    fn a_box_of_triangles_is_the_room() {
        let room = super::super::Room { min: [0.0; 3], max: [1.0, 2.0, 3.0] };
        let mesh = Mesh { solid: None, ..Mesh::block(room.min, room.max).unwrap() };
        assert_eq!(mesh.len(), 12);
        proptest!(|(x in prop::array::uniform3(0.15f64..0.85), by in prop::array::uniform3(-4.0f64..4.0))| {
            let path = Path::straight(x, by);
            let (a, b) = (mesh.meet(&path, 0.1, 1e-12).map(|(m, _)| m), room.meet(&path, 0.1, 1e-12));
            prop_assert_eq!(a.is_some(), b.is_some());
            if let (Some(a), Some(b)) = (a, b) {
                prop_assert!((a.theta - b.theta).abs() < 1e-12, "{:?} {:?}", a, b);
                prop_assert!(norm(sub(a.position, b.position)) < 1e-12);
            }
            prop_assert!((mesh.distance(x) - room.distance(x)).abs() < 1e-12);
        });
    }
}
