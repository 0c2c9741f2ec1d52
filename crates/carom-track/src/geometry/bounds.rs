//! Boxes along the axes.

use super::Path;
use crate::vector::{Vec3, add, norm};

/// A box along the axes; infinite where something has no end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower corner, m.
    pub min: Vec3,
    /// Upper corner, m.
    pub max: Vec3,
}

impl Bounds {
    /// Around nothing.
    pub const NONE: Self = Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
    /// Around everything.
    pub const ALL: Self = Self { min: [f64::NEG_INFINITY; 3], max: [f64::INFINITY; 3] };

    /// The smallest box around points.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::NONE, Self::with)
    }

    /// The box around the control points of a path, and so around the path.
    pub fn of_path(path: &Path) -> Self {
        path.points.iter().fold(Self::NONE.with(path.start), |b, p| b.with(add(path.start, *p)))
    }

    /// With a point more.
    #[must_use]
    #[inline(always)]
    pub fn with(self, x: Vec3) -> Self {
        Self { min: [0, 1, 2].map(|c| self.min[c].min(x[c])), max: [0, 1, 2].map(|c| self.max[c].max(x[c])) }
    }

    /// The box around both.
    #[must_use]
    #[inline(always)]
    pub fn union(self, other: &Self) -> Self {
        self.with(other.min).with(other.max)
    }

    /// Wider by a length on every side, m.
    #[must_use]
    #[inline(always)]
    pub fn wider(self, by: f64) -> Self {
        Self { min: self.min.map(|c| c - by), max: self.max.map(|c| c + by) }
    }

    /// Whether two boxes have a point in common.
    #[inline(always)]
    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|c| self.min[c] <= other.max[c] && self.max[c] >= other.min[c])
    }

    /// Distance of a point from the box, m; zero inside.
    #[inline(always)]
    pub fn distance(&self, x: Vec3) -> f64 {
        norm([0, 1, 2].map(|c| (self.min[c] - x[c]).max(x[c] - self.max[c]).max(0.0)))
    }
}
