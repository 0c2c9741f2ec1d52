//! What of a triangulated wall is near a point.

use super::super::Bounds;
use super::Mesh;
use super::Triangle;
use super::rim::{self, Reach};
use super::surface::Face;
use super::tree::STACK;
use crate::vector::{Vec3, add, dot, norm, scale, sub, unit};
use arrayvec::ArrayVec;

/// The part of a triangle that a point is nearest to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Face,
    /// From that corner to the next.
    Edge(usize),
    Corner(usize),
}

impl Mesh {
    /// The nearest point of all, and its face.
    pub(in crate::geometry) fn nearest(&self, x: Vec3) -> Option<(u32, Vec3)> {
        self.nearest_within(x, f64::INFINITY)
    }

    /// The nearest triangle's place in the list given, and its distance, m; `None` if that is at least `far`.
    pub(crate) fn nearest_face(&self, x: Vec3, far: f64) -> Option<(u32, f64)> {
        let (face, foot) = self.nearest_within(x, far)?;
        Some((self.number(&self.surface.faces[face as usize]), norm(sub(x, foot))))
    }

    /// Distance of a point from the nearest triangle, on whichever side, m; `None` if it is at least `far`.
    pub(in super::super) fn distance_within(&self, x: Vec3, far: f64) -> Option<f64> {
        self.nearest_within(x, far).map(|(_, foot)| norm(sub(x, foot)))
    }

    fn nearest_within(&self, x: Vec3, far: f64) -> Option<(u32, Vec3)> {
        let (mut best, mut found) = (far, None);
        let mut stack = ArrayVec::<(f64, u32), STACK>::new();
        stack.push((0.0, 0));
        while let Some((distance, node)) = stack.pop() {
            if distance >= best {
                continue;
            }
            let begin = stack.len();
            for (bounds, child) in self.tree.nodes[node as usize].children() {
                for i in child.first..child.first + child.count {
                    let foot = nearest(&self.surface.triangle(&self.surface.faces[i as usize]), x).0;
                    let distance = norm(sub(x, foot));
                    if distance < best {
                        (best, found) = (distance, Some((i, foot)));
                    }
                }
                if child.count == 0 {
                    stack.push((bounds.distance(x), child.first));
                }
            }
            stack[begin..].sort_by(|a, b| b.0.total_cmp(&a.0));
        }
        found
    }

    /// Calls `visit` with all triangles whose boxes are within a distance of a point, until it says stop.
    fn around(&self, x: Vec3, far: f64, visit: &mut impl FnMut(u32, &Face) -> bool) {
        let region = Bounds::around([x]).wider(far);
        let mut stack = ArrayVec::<u32, STACK>::new();
        stack.push(0);
        while let Some(node) = stack.pop() {
            for (_, child) in self.tree.nodes[node as usize].children().filter(|(b, _)| b.meets(&region)) {
                for i in child.first..child.first + child.count {
                    if visit(i, &self.surface.faces[i as usize]) {
                        return;
                    }
                }
                if child.count == 0 {
                    stack.push(child.first);
                }
            }
        }
    }

    /// Whether a sphere at `x` that touches an edge at `foot` lies on a face there, to within rounding: then the edge is a seam
    /// that its neighbours' corners do not share.
    pub(super) fn is_on_a_face(&self, x: Vec3, foot: Vec3, reach: Reach) -> bool {
        let Some(away) = unit(sub(x, foot)) else { return false };
        let mut found = false;
        let far = reach.clearance + reach.slack;
        self.around(x, far, &mut |_, face| {
            let flat = &self.surface.flats[face.flat as usize];
            let height = flat.height(x);
            found = height.abs() <= far
                && height.signum() * dot(flat.normal, away) > 1.0 - 1e-8
                && self.surface.is_over(face, x, reach.beside());
            found
        });
        found
    }

    /// Tells the triangle, the normal and the gap (m) of each contact of a sphere at `x` that is within `slack`.
    pub(in super::super) fn touched(&self, x: Vec3, clearance: f64, slack: f64, tell: &mut impl FnMut(u32, Vec3, f64)) {
        let reach = self.reach(clearance, slack);
        let far = reach.clearance + slack.max(reach.slack);
        self.around(x, far, &mut |_, face| {
            let flat = &self.surface.flats[face.flat as usize];
            let height = flat.height(x);
            if height.abs() > far {
                return false;
            }
            if self.surface.is_over(face, x, reach.beside()) {
                tell(self.number(face), scale(flat.normal, height.signum()), height.abs() - reach.clearance);
                return false;
            }
            let (foot, part) = nearest(&self.surface.triangle(face), x);
            let gap = norm(sub(x, foot)) - reach.clearance;
            if gap <= far - reach.clearance
                && let Some(away) = unit(sub(x, foot))
                && self.leads_away(face, part, foot, away, reach)
                && !self.is_on_a_face(x, foot, reach)
            {
                tell(self.number(face), away, gap);
            }
            false
        });
    }

    /// Whether a direction belongs to a part of a triangle, and not to a neighbour.
    fn leads_away(&self, face: &Face, part: Part, foot: Vec3, away: Vec3, reach: Reach) -> bool {
        let surface = &self.surface;
        match part {
            Part::Face => true,
            Part::Corner(i) => surface.fan(face.corners[i] as usize).all(|d| dot(d, away) < -reach.tilt()),
            Part::Edge(i) => {
                let (a, b) = (face.corners[i], face.corners[(i + 1) % 3]);
                let [p, q] = [a, b].map(|c| surface.corners[c as usize]);
                let mut all = true;
                self.around(foot, reach.slack, &mut |_, f| {
                    if f.corners.contains(&a) && f.corners.contains(&b) {
                        let c = f.corners.iter().find(|c| **c != a && **c != b);
                        let u = c.and_then(|c| rim::across(p, q, surface.corners[*c as usize]));
                        all &= u.is_none_or(|u| dot(u, away) < -reach.tilt());
                    }
                    !all
                });
                all
            }
        }
    }
}

/// The point of a triangle nearest to `x`.
pub(crate) fn nearest_point(t: &Triangle, x: Vec3) -> Vec3 {
    nearest(t, x).0
}

/// The point of a triangle nearest to `x`, and the part that it is on (Ericson 2005, *Real-Time Collision Detection*, section
/// 5.1.5).
pub(super) fn nearest(t: &Triangle, x: Vec3) -> (Vec3, Part) {
    let [a, b, c] = *t;
    let (ab, ac, ax) = (sub(b, a), sub(c, a), sub(x, a));
    let (d1, d2) = (dot(ab, ax), dot(ac, ax));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, Part::Corner(0));
    }
    let bx = sub(x, b);
    let (d3, d4) = (dot(ab, bx), dot(ac, bx));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, Part::Corner(1));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (add(a, scale(ab, d1 / (d1 - d3))), Part::Edge(0));
    }
    let cx = sub(x, c);
    let (d5, d6) = (dot(ab, cx), dot(ac, cx));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, Part::Corner(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (add(a, scale(ac, d2 / (d2 - d6))), Part::Edge(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return (add(b, scale(sub(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)))), Part::Edge(1));
    }
    let all = va + vb + vc;
    (add(a, add(scale(ab, vb / all), scale(ac, vc / all))), Part::Face)
}
