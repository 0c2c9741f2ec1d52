//! The inside of a box along the axes.

use super::contact::first_contact;
use super::{Bernstein, Meeting, Path};
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

    /// Where a path first comes within `clearance` of a face: the earliest, the first face where two coincide.
    pub fn meet(&self, path: &Path, clearance: f64, slack: f64) -> Option<Meeting> {
        let mut first: Option<(f64, usize, f64)> = None;
        for c in 0..3 {
            let p = [path.points[0][c], path.points[1][c], path.points[2][c], path.points[3][c]];
            for (sign, gap) in [(1.0, path.start[c] - self.min[c]), (-1.0, self.max[c] - path.start[c])] {
                let gap = gap - clearance;
                let along = Bernstein([0.0, sign * p[0], sign * p[1], sign * p[2], sign * p[3]]);
                if gap > slack && gap + along.lower_bound() > 0.0 {
                    continue;
                }
                if let Some(theta) = first_contact(gap, &along, slack, |_| true)
                    && first.is_none_or(|f| theta < f.0)
                {
                    first = Some((theta, c, sign));
                }
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
