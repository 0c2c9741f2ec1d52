//! The path of a sphere's centre over one step: a quartic curve in Bernstein form.

use super::bernstein::Bernstein;
use crate::vector::{Vec3, add, dot};

/// A step's path, x(θ) for θ in [0, 1], by its control points relative to the start (the first is zero).
///
/// The curve stays inside the convex hull of its control points: what holds for all of them holds for the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Where the step starts, m.
    pub start: Vec3,
    /// Control points 1 to 4 relative to the start, m. The first points along the velocity.
    pub points: [Vec3; 4],
}

impl Path {
    /// A straight path at constant velocity.
    pub fn straight(start: Vec3, change: Vec3) -> Self {
        Self { start, points: [0.25, 0.5, 0.75, 1.0].map(|s| change.map(|c| s * c)) }
    }

    /// Position at θ, m.
    pub fn at(&self, theta: f64) -> Vec3 {
        add(self.start, evaluate(&self.points, theta))
    }

    /// Displacement along a direction, as a polynomial whose first coefficient is zero.
    #[inline]
    pub fn along(&self, n: Vec3) -> Bernstein<5> {
        let p = &self.points;
        Bernstein([0.0, dot(n, p[0]), dot(n, p[1]), dot(n, p[2]), dot(n, p[3])])
    }
}

/// A quartic from zero with control points 1 to 4, at θ.
#[inline]
pub fn evaluate(points: &[Vec3; 4], theta: f64) -> Vec3 {
    let mut out = [0.0; 3];
    for (c, out) in out.iter_mut().enumerate() {
        let mut p = [0.0, points[0][c], points[1][c], points[2][c], points[3][c]];
        for top in (1..5).rev() {
            for i in 0..top {
                p[i] += theta * (p[i + 1] - p[i]);
            }
        }
        *out = p[0];
    }
    out
}
