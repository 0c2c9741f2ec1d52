//! The inside of a box along the axes.

use super::contact::{first_contact, misses};
use super::{Meeting, Path};
use crate::vector::Vec3;

/// Six walls that look inwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Lower corner, m.
    pub min: Vec3,
    /// Upper corner, m.
    pub max: Vec3,
}

impl Room {
    /// Signed distance of a point from the nearest face, m; positive inside.
    pub fn distance(&self, x: Vec3) -> f64 {
        (0..3).fold(f64::INFINITY, |d, c| d.min(x[c] - self.min[c]).min(self.max[c] - x[c]))
    }

    /// The faces as planes.
    pub fn faces(&self) -> [super::Plane; 6] {
        let face = |axis: usize, point: Vec3, sign: f64| {
            let mut normal = [0.0; 3];
            normal[axis] = sign;
            super::Plane { point, normal }
        };
        let (a, b) = (self.min, self.max);
        [face(0, a, 1.0), face(0, b, -1.0), face(1, a, 1.0), face(1, b, -1.0), face(2, a, 1.0), face(2, b, -1.0)]
    }

    /// How far a point is from contact with the lower and the upper face across an axis, m.
    #[inline(always)]
    fn gaps(&self, x: Vec3, clearance: f64, axis: usize) -> [f64; 2] {
        [x[axis] - self.min[axis] - clearance, self.max[axis] - x[axis] - clearance]
    }

    /// Where a path first comes within `clearance` of a face: the earliest, the first face where two coincide.
    #[inline(always)]
    pub fn meet(&self, path: &Path, clearance: f64, slack: f64) -> Option<Meeting> {
        // which faces may be met, lower and upper ones in turn: mostly one, or none
        let mut faces = 0u32;
        for c in 0..3 {
            let [below, above] = self.gaps(path.start, clearance, c);
            let (lowest, highest) = path.component(c).range_ahead();
            faces |= u32::from(!misses(below, lowest, slack)) << (2 * c);
            faces |= u32::from(!misses(above, -highest, slack)) << (2 * c + 1);
        }
        let mut first: Option<(f64, usize, f64)> = None;
        while faces != 0 {
            let face = faces.trailing_zeros() as usize;
            faces &= faces - 1;
            let (c, upper) = (face / 2, face % 2);
            let sign = if upper == 0 { 1.0 } else { -1.0 };
            let gap = self.gaps(path.start, clearance, c)[upper];
            if let Some(theta) = first_contact(gap, &path.component(c).scaled(sign, 0.0), slack, |_| true)
                && first.is_none_or(|f| theta < f.0)
            {
                first = Some((theta, c, sign));
            }
        }
        let (theta, axis, sign) = first?;
        let mut position = path.at(theta);
        let mut normal = [0.0; 3];
        normal[axis] = sign;
        position[axis] = if sign > 0.0 { self.min[axis] + clearance } else { self.max[axis] - clearance };
        Some(Meeting { theta, position, normal })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_face_on_the_way_is_met() {
        let room = Room { min: [0.0; 3], max: [1.0; 3] };
        let path = Path::straight([0.5, 0.5, 0.5], [0.2, -1.0, 2.0]);
        let m = room.meet(&path, 0.1, 1e-12).unwrap();
        assert!((m.theta - 0.2).abs() < 1e-15 && m.normal == [0.0, 0.0, -1.0] && m.position[2] == 0.9);
        for (face, want) in room.faces().iter().zip([0.5; 6]) {
            assert_eq!(face.distance([0.5; 3]), want);
        }
    }
}
