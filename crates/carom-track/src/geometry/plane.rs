//! A plane wall.

use super::contact::{first_contact, misses};
use super::{Meeting, Path};
use crate::vector::{Vec3, add, dot, scale, sub};

/// A plane with the fluid on the side its normal points to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of it, m.
    pub point: Vec3,
    /// Unit normal, out of the wall into the fluid.
    pub normal: Vec3,
}

impl Plane {
    /// Signed distance of a point, m; positive in the fluid.
    pub fn distance(&self, x: Vec3) -> f64 {
        dot(self.normal, sub(x, self.point))
    }

    /// Where a path first comes within `clearance`.
    #[inline(always)]
    pub fn meet(&self, path: &Path, clearance: f64, slack: f64) -> Option<Meeting> {
        let gap = self.distance(path.start) - clearance;
        let along = path.along(self.normal);
        if misses(gap, along.range_ahead().0, slack) {
            return None;
        }
        let theta = first_contact(gap, &along, slack, |_| true)?;
        let x = path.at(theta);
        let off = self.distance(x) - clearance;
        Some(Meeting { theta, position: add(x, scale(self.normal, -off)), normal: self.normal })
    }
}
