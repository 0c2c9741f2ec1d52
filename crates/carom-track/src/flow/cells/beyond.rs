//! What lies behind the boundary of a mesh: how plane and axisymmetric cases, planes of symmetry and cyclic patches go on.

use crate::vector::{Vec3, add, cross, dot, norm, scale, sub, unit};
use carom::math;
use carom_cfd::{Carry, Mesh, PatchKind};

/// A plane case: nothing changes along a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// The direction, of length 1.
    pub across: Vec3,
    /// Where along it the fields are taken, m.
    pub level: f64,
}

impl Plane {
    /// The plane that the fields are taken in, of a mesh with empty sides.
    pub fn of(mesh: &Mesh, areas: &[Vec3]) -> Option<Self> {
        let faces = || mesh.patches.iter().filter(|p| p.kind == PatchKind::Empty).flat_map(|p| p.faces.clone());
        let first = unit(areas[faces().next()?])?;
        let sum = faces().fold([0.0; 3], |sum, f| {
            let a = areas[f];
            add(sum, scale(a, if dot(a, first) < 0.0 { -1.0 } else { 1.0 }))
        });
        let across = unit(sum)?;
        let (low, high) = mesh.points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            let s = dot(*x, across);
            (low.min(s), high.max(s))
        });
        Some(Self { across, level: 0.5 * (low + high) })
    }

    /// A point put into the plane.
    pub fn put(&self, x: Vec3) -> Vec3 {
        add(x, scale(self.across, self.level - dot(x, self.across)))
    }

    /// A vector less what leads across.
    pub fn along(&self, v: Vec3) -> Vec3 {
        sub(v, scale(self.across, dot(v, self.across)))
    }
}

/// An axisymmetric case: a wedge of it, that goes on round the axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wedge {
    point: Vec3,
    axis: Vec3,
    /// From the axis into the middle of the wedge, and across it.
    middle: Vec3,
    side: Vec3,
    /// Its angle.
    pub angle: f64,
    /// A distance from the axis that is none, m.
    least: f64,
}

impl Wedge {
    /// The wedge between two plane patches.
    pub fn of(mesh: &Mesh, areas: &[Vec3]) -> Option<Self> {
        let sides: Vec<_> = mesh.patches.iter().filter(|p| p.kind == PatchKind::Wedge).collect();
        let [a, b] = sides[..] else { return None };
        let plane = |p: &carom_cfd::Patch| {
            let normal = unit(p.faces.clone().fold([0.0; 3], |sum, f| add(sum, areas[f])))?;
            let point = mesh.points[mesh.faces.get(p.faces.start)[0] as usize];
            Some((normal, dot(normal, point)))
        };
        let ((n, c), (m, d)) = (plane(a)?, plane(b)?);
        let turn = cross(n, m);
        let axis = unit(turn)?;
        let middle = unit(scale(add(n, m), -1.0))?;
        let square = dot(turn, turn);
        // where the planes n·x = c and m·x = d meet
        let point = scale(add(scale(cross(m, turn), c), scale(cross(turn, n), d)), 1.0 / square);
        let size = mesh.points.iter().map(|x| norm(sub(*x, point))).fold(0.0, f64::max);
        let angle = math::atan2(norm(turn), -dot(n, m));
        Some(Self { point, axis, middle, side: cross(axis, middle), angle, least: 1e-8 * size })
    }

    /// The rotation by some angle round the axis.
    pub fn turn(&self, angle: f64) -> Carry {
        let (s, c) = math::sin_cos(angle);
        let k = self.axis;
        let columns = [0, 1, 2].map(|i| {
            let mut e = [0.0; 3];
            e[i] = 1.0;
            add(add(scale(e, c), scale(cross(k, e), s)), scale(k, k[i] * (1.0 - c)))
        });
        let rotation = [0, 1, 2].map(|i| [columns[0][i], columns[1][i], columns[2][i]]);
        let moved = rotation.map(|row| dot(row, self.point));
        Carry { rotation, translation: sub(self.point, moved) }
    }

    fn place(&self, y: Vec3) -> (f64, f64) {
        let (a, b) = (dot(y, self.middle), dot(y, self.side));
        (math::atan2(b, a), (a * a + b * b).sqrt())
    }

    /// The rotation, by whole wedges, of what leaves at `x` towards `v`, into the wedge.
    pub fn back(&self, x: Vec3, v: Vec3) -> Carry {
        let (angle, distance) = self.place(sub(x, self.point));
        if distance > self.least {
            // on a side: on to the other one
            let over = angle / self.angle;
            let whole = over.round();
            return self.turn(-self.angle * if whole == 0.0 { over.signum() } else { whole });
        }
        // through the axis: put onto it, so that it goes on inside whichever way it comes
        let turn = self.turn(-self.angle * (self.place(v).0 / self.angle).round());
        let along = dot(sub(x, self.point), self.axis);
        let onto = sub(add(self.point, scale(self.axis, along)), turn.point(x));
        Carry { translation: add(turn.translation, onto), ..turn }
    }

    /// Velocities at points on the sides, which were taken in the middle, turned there.
    pub fn turn_sides(&self, mesh: &Mesh, velocity: &mut [Vec3]) {
        let mut seen = vec![false; mesh.points.len()];
        for patch in mesh.patches.iter().filter(|p| p.kind == PatchKind::Wedge) {
            for point in patch.faces.clone().flat_map(|f| mesh.faces.get(f)) {
                let point = *point as usize;
                let (angle, distance) = self.place(sub(mesh.points[point], self.point));
                if !std::mem::replace(&mut seen[point], true) && distance > self.least {
                    velocity[point] = self.turn(angle).vector(velocity[point]);
                }
            }
        }
    }
}

/// A vector that turns with a frame but not with a mirror, such as a spin.
pub fn carry_spin(carry: &Carry, spin: Vec3) -> Vec3 {
    let [a, b, c] = carry.rotation;
    let mirrors = dot(a, cross(b, c)) < 0.0;
    scale(carry.vector(spin), if mirrors { -1.0 } else { 1.0 })
}

/// The mirror in a plane through `point` across `normal`.
pub(super) fn mirror(point: Vec3, normal: Vec3) -> Carry {
    let rotation = [0, 1, 2].map(|i| [0, 1, 2].map(|j| if i == j { 1.0 } else { 0.0 } - 2.0 * normal[i] * normal[j]));
    Carry { rotation, translation: scale(normal, 2.0 * dot(point, normal)) }
}

/// Points of cyclic patches and their partners: corner by corner, faces in order, each pair once.
pub(super) fn pairs(mesh: &Mesh) -> Vec<(u32, u32, Carry)> {
    let mut pairs = Vec::new();
    for (index, patch) in mesh.patches.iter().enumerate() {
        let PatchKind::Cyclic { partner, carry } = &patch.kind else { continue };
        let Some(other) = mesh.patches.get(*partner).filter(|_| index < *partner) else { continue };
        let mut seen = std::collections::BTreeSet::<u32>::new();
        for (from, to) in patch.faces.clone().zip(other.faces.clone()) {
            for point in mesh.faces.get(from).iter().filter(|p| !seen.contains(*p)) {
                let there = carry.point(mesh.points[*point as usize]);
                let nearest = mesh.faces.get(to).iter().min_by(|a, b| {
                    let far = |p: &u32| norm(sub(mesh.points[*p as usize], there));
                    far(a).total_cmp(&far(b))
                });
                if let Some(nearest) = nearest {
                    pairs.push((*point, *nearest, *carry));
                }
            }
            seen.extend(mesh.faces.get(from));
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_and_its_spin() {
        let carry = mirror([0.0, 2.0, 0.0], [0.0, 1.0, 0.0]);
        assert_eq!(carry.point([1.0, 5.0, 3.0]), [1.0, -1.0, 3.0]);
        // a spin across the mirror stays, one along it turns round
        assert_eq!(carry_spin(&carry, [0.0, 4.0, 0.0]), [0.0, 4.0, 0.0]);
        assert_eq!(carry_spin(&carry, [4.0, 0.0, 0.0]), [-4.0, 0.0, 0.0]);
    }
}
