//! The path of a sphere's centre over one step: a quintic curve in Bernstein form.

use super::bernstein::Bernstein;
use crate::vector::{Vec3, add, dot};

/// A step's path, x(θ) for θ in [0, 1], by its control points relative to the start (the first is zero).
///
/// The curve stays inside the convex hull of its control points: what holds for all of them holds for the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Where the step starts, m.
    pub start: Vec3,
    /// Control points 1 to 5 relative to the start, m. The first points along the velocity.
    pub points: [Vec3; 5],
}

impl Path {
    /// A straight path at constant velocity.
    pub fn straight(start: Vec3, change: Vec3) -> Self {
        Self { start, points: [0.2, 0.4, 0.6, 0.8, 1.0].map(|s| change.map(|c| s * c)) }
    }

    /// Position at θ, m.
    #[inline(always)]
    pub fn at(&self, theta: f64) -> Vec3 {
        add(self.start, evaluate(&self.points, theta))
    }

    /// Displacement along a direction, as a polynomial whose first coefficient is zero.
    #[inline(always)]
    pub fn along(&self, n: Vec3) -> Bernstein<6> {
        let p = &self.points;
        Bernstein([0.0, dot(n, p[0]), dot(n, p[1]), dot(n, p[2]), dot(n, p[3]), dot(n, p[4])])
    }

    /// One component of the displacement.
    #[inline(always)]
    pub fn component(&self, c: usize) -> Bernstein<6> {
        let p = &self.points;
        Bernstein([0.0, p[0][c], p[1][c], p[2][c], p[3][c], p[4][c]])
    }
}

/// A curve from zero with control points 1 to N, at θ.
#[inline(always)]
pub fn evaluate<const N: usize>(points: &[Vec3; N], theta: f64) -> Vec3 {
    let mut out = [0.0; 3];
    for (c, out) in out.iter_mut().enumerate() {
        let mut p = [0.0; N];
        let mut before = 0.0;
        for (p, point) in p.iter_mut().zip(points) {
            *p = before + theta * (point[c] - before);
            before = point[c];
        }
        for top in (1..N).rev() {
            for i in 0..top {
                p[i] += theta * (p[i + 1] - p[i]);
            }
        }
        *out = p[0];
    }
    out
}
