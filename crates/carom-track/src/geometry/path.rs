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

    /// How the position changes with θ, m: over a step of length h the velocity times h.
    pub fn slope(&self, theta: f64) -> Vec3 {
        let p = &self.points;
        [0, 1, 2].map(|c| {
            let mut d = [p[0][c], p[1][c] - p[0][c], p[2][c] - p[1][c], p[3][c] - p[2][c], p[4][c] - p[3][c]];
            for top in (1..5).rev() {
                for i in 0..top {
                    d[i] += theta * (d[i + 1] - d[i]);
                }
            }
            5.0 * d[0]
        })
    }

    /// The part of the path up to θ, as a path.
    #[must_use]
    pub fn until(&self, theta: f64) -> Self {
        Self { points: split(&self.points, theta).0, ..*self }
    }

    /// The part of the path from θ on, as a path.
    #[must_use]
    pub fn from(&self, theta: f64) -> Self {
        let (until, points) = split(&self.points, theta);
        Self { start: add(self.start, until[4]), points }
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

/// The parts of a curve from zero with control points 1 to N: up to θ, and from there on relative to where it is then (de Casteljau).
pub fn split<const N: usize>(points: &[Vec3; N], theta: f64) -> ([Vec3; N], [Vec3; N]) {
    let (mut until, mut from) = (*points, *points);
    for c in 0..3 {
        let (mut first, mut rest) = (0.0, points.map(|p| p[c]));
        for left in (0..N).rev() {
            first += theta * (rest[0] - first);
            for i in 0..left {
                rest[i] += theta * (rest[i + 1] - rest[i]);
            }
            until[N - 1 - left][c] = first;
            if left > 0 {
                from[left - 1][c] = rest[left - 1];
            }
        }
        from.iter_mut().for_each(|p| p[c] -= first);
    }
    (until, from)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{norm, scale, sub};

    #[test]
    fn a_part_of_a_path_is_the_path_and_its_slope_the_quotient_of_differences() {
        let points = [[1.0, 0.0, 2.0], [0.5, 3.0, 1.0], [-1.0, 2.0, 0.0], [2.0, 2.0, 5.0], [1.0, -1.0, 3.0]];
        let path = Path { start: [5.0, 6.0, 7.0], points };
        let (part, rest) = (path.until(0.3), path.from(0.3));
        for t in [0.0, 0.2, 0.7, 1.0] {
            assert!(norm(sub(part.at(t), path.at(0.3 * t))) < 1e-14, "{t}");
            assert!(norm(sub(rest.at(t), path.at(0.3 + 0.7 * t))) < 1e-14, "{t}");
            let quotient = scale(sub(path.at(t + 1e-6), path.at(t - 1e-6)), 0.5e6);
            assert!(norm(sub(path.slope(t), quotient)) < 1e-7, "{t}");
        }
    }
}
