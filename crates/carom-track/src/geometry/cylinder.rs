//! A round wall: the inside of a pipe or the outside of a rod.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::contact::{first_contact, misses};
use super::{Bernstein, Meeting, Path};
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::{Mask, mask};
use crate::vector::{Vec3, add, dot, scale, sub};

/// An endless circular cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// A point of the axis, m.
    pub point: Vec3,
    /// Unit direction of the axis.
    pub axis: Vec3,
    /// Radius, m.
    pub radius: f64,
    /// Whether the fluid is inside (a pipe) or outside (a rod).
    pub inside: bool,
}

impl Cylinder {
    fn across(&self, x: Vec3) -> Vec3 {
        sub(x, scale(self.axis, dot(x, self.axis)))
    }

    fn offset(&self, x: Vec3) -> Vec3 {
        self.across(sub(x, self.point))
    }

    /// Signed distance of a point, m; positive in the fluid.
    pub fn distance(&self, x: Vec3) -> f64 {
        let r = self.offset(x);
        let rho = dot(r, r).sqrt();
        if self.inside { self.radius - rho } else { rho - self.radius }
    }

    /// Unit normal of the wall nearest to a point, into the fluid.
    pub fn normal(&self, x: Vec3) -> Vec3 {
        let r = self.offset(x);
        let rho = dot(r, r).sqrt();
        scale(r, if self.inside { -1.0 } else { 1.0 } / rho)
    }

    /// Where a path first comes within `clearance`: a root of the squared distance from the axis, of degree ten.
    pub fn meet(&self, path: &Path, clearance: f64, slack: f64) -> Option<Meeting> {
        let sign: f64 = if self.inside { -1.0 } else { 1.0 };
        let limit = self.radius + sign * clearance;
        let r0 = self.offset(path.start);
        if self.inside && self.all_within(path, r0, limit - slack) {
            return None;
        }
        let rho0 = dot(r0, r0).sqrt();
        let gap = sign * (rho0 - limit);
        let points = path.points.map(|p| self.across(p));
        let mut change = Bernstein([0.0; 11]);
        for c in 0..3 {
            let p = Bernstein([0.0, points[0][c], points[1][c], points[2][c], points[3][c], points[4][c]]);
            let shifted = p.scaled(1.0, 2.0 * r0[c]);
            change = change.plus(&p.times(&shifted));
        }
        let change = change.scaled(sign, 0.0);
        let sum = rho0 + limit;
        let theta = first_contact(gap * sum, &change, slack * sum, |_| true)?;
        let x = path.at(theta);
        let normal = self.normal(x);
        let off = self.distance(x) - clearance;
        Some(Meeting { theta, position: add(x, scale(normal, -off)), normal })
    }

    /// Which of `W` paths may come within their clearances: all that are not surely clear of it.
    #[inline(always)]
    pub(super) fn may_meet<const W: usize>(
        &self,
        start: &Lanes3<W>,
        path: &[Lanes3<W>; 5],
        clearance: &Lanes<W>,
        margin: &Lanes<W>,
    ) -> Mask<W> {
        let mut from = *start;
        for c in 0..3 {
            for l in 0..W {
                from[c][l] -= self.point[c];
            }
        }
        let r0 = self.across_lanes(&from);
        let points = [0, 1, 2, 3, 4].map(|i| self.across_lanes(&path[i]));
        let mut may = [0; W];
        if self.inside {
            // the disc is convex: a path whose control points are inside stays inside
            let mut farthest = [0.0; W];
            for l in 0..W {
                farthest[l] = r0[0][l] * r0[0][l] + r0[1][l] * r0[1][l] + r0[2][l] * r0[2][l];
            }
            for p in &points {
                for l in 0..W {
                    let x = [r0[0][l] + p[0][l], r0[1][l] + p[1][l], r0[2][l] + p[2][l]];
                    let square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
                    farthest[l] = if square > farthest[l] { square } else { farthest[l] };
                }
            }
            for l in 0..W {
                let limit = self.radius - clearance[l] - margin[l];
                may[l] = !(mask(limit > 0.0) & mask(farthest[l] < limit * limit));
            }
        } else {
            // the rod lies behind the plane that touches it below the start
            for l in 0..W {
                let rho = (r0[0][l] * r0[0][l] + r0[1][l] * r0[1][l] + r0[2][l] * r0[2][l]).sqrt();
                let n = [r0[0][l] / rho, r0[1][l] / rho, r0[2][l] / rho];
                let mut lowest = f64::INFINITY;
                for p in &points {
                    let along = n[0] * p[0][l] + n[1] * p[1][l] + n[2] * p[2][l];
                    lowest = if along < lowest { along } else { lowest };
                }
                may[l] = mask(!misses(rho - self.radius - clearance[l], lowest, margin[l]));
            }
        }
        may
    }

    #[inline(always)]
    fn across_lanes<const W: usize>(&self, x: &Lanes3<W>) -> Lanes3<W> {
        let mut out = *x;
        for l in 0..W {
            let along = x[0][l] * self.axis[0] + x[1][l] * self.axis[1] + x[2][l] * self.axis[2];
            for c in 0..3 {
                out[c][l] -= along * self.axis[c];
            }
        }
        out
    }

    /// A disc is convex: a path whose control points are all inside stays inside.
    fn all_within(&self, path: &Path, r0: Vec3, limit: f64) -> bool {
        let inside = |r: Vec3| dot(r, r) < limit * limit;
        limit > 0.0 && inside(r0) && path.points.iter().all(|p| inside(add(r0, self.across(*p))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIPE: Cylinder = Cylinder { point: [0.0, 0.0, 0.0], axis: [1.0, 0.0, 0.0], radius: 0.01, inside: true };

    #[test]
    fn a_straight_chord_meets_the_pipe_where_geometry_says() {
        let path = Path::straight([0.0, 0.002, 0.0], [0.03, 0.0, 0.02]);
        let m = PIPE.meet(&path, 1e-3, 1e-12).unwrap();
        // ρ² = 0.002² + (0.02 θ)² = 0.009²
        let theta = (0.009f64.powi(2) - 0.002f64.powi(2)).sqrt() / 0.02;
        assert!((m.theta - theta).abs() < 1e-14, "{} {theta}", m.theta);
        assert!((PIPE.distance(m.position) - 1e-3).abs() < 1e-17);
        // a second chord from there, inwards, meets the far side after the whole chord
        let back = Path { start: m.position, ..Path::straight([0.0; 3], [0.0, -0.02, 0.0]) };
        let n = PIPE.meet(&back, 1e-3, 1e-12).unwrap();
        assert!((n.theta - 2.0 * m.position[1] / 0.02).abs() < 1e-13);
    }

    #[test]
    fn a_rod_is_hit_in_front_and_passed_at_the_side() {
        let rod = Cylinder { inside: false, ..PIPE };
        let hit = rod.meet(&Path::straight([0.0, 0.005, -0.1], [0.0, 0.0, 0.2]), 1e-3, 1e-12).unwrap();
        let z = -(0.011f64.powi(2) - 0.005f64.powi(2)).sqrt();
        assert!((hit.position[2] - z).abs() < 1e-15 && hit.normal[2] < 0.0);
        assert!(rod.meet(&Path::straight([0.0, 0.0111, -0.1], [0.0, 0.0, 0.2]), 1e-3, 1e-12).is_none());
    }
}
