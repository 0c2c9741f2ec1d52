//! How near the walls are to a sphere that goes at random, and how long it surely stays off them.

use super::{Cylinder, Plane, Shape, Walls};
use crate::vector::{Vec3, dot, norm, scale, sub};

/// How a sphere goes: after a time t it is at `offset` + `drift` t, and scattered about that by `spread` √t in every direction.
#[derive(Clone, Copy, Debug)]
pub struct Wandering {
    /// What is left of its present motion, m.
    pub offset: Vec3,
    /// Mean velocity, m/s.
    pub drift: Vec3,
    /// As many standard deviations over √t as it may come nearer by chance, m/√s.
    pub spread: f64,
    /// No longer time is asked for, s.
    pub longest: f64,
}

/// What is near.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearness {
    /// Distance from contact with the nearest wall, m; infinite where none matters within the longest time.
    pub gap: f64,
    /// How long the sphere stays off all walls, s.
    pub clear: f64,
}

impl Wandering {
    /// How long a sphere stays off a plane with that normal, `gap` (m) away: `gap` less the offset is drift t + spread √t.
    fn stays(&self, gap: f64, normal: Vec3) -> f64 {
        self.lasts(gap + dot(self.offset, normal).min(0.0), (-dot(self.drift, normal)).max(0.0))
    }

    fn lasts(&self, room: f64, speed: f64) -> f64 {
        if room <= 0.0 {
            return 0.0;
        }
        let sum = self.spread + (self.spread * self.spread + 4.0 * speed * room).sqrt();
        let root = 2.0 * room / sum;
        root * root
    }
}

impl Nearness {
    fn plane(&mut self, plane: &Plane, clearance: f64, x: Vec3, way: &Wandering, far: f64) {
        let gap = plane.distance(x) - clearance;
        self.gap = self.gap.min(gap);
        if gap < far {
            self.clear = self.clear.min(way.stays(gap, plane.normal));
        }
    }

    fn cylinder(&mut self, round: &Cylinder, clearance: f64, x: Vec3, way: &Wandering) {
        let gap = round.distance(x) - clearance;
        self.gap = self.gap.min(gap);
        let clear = if round.inside {
            // hollow: motion sideways leads nearer too
            let across = |v: Vec3| norm(sub(v, scale(round.axis, dot(v, round.axis))));
            way.lasts(gap - across(way.offset), across(way.drift))
        } else {
            // the rod lies behind the plane that touches it here
            way.stays(gap, round.normal(x))
        };
        self.clear = self.clear.min(clear);
    }
}

impl Walls {
    /// How near the walls are to a sphere of that radius at `x`, and how long it stays off them on its way.
    pub fn nearness(&self, x: Vec3, radius: f64, way: &Wandering) -> Nearness {
        let mut near = Nearness { gap: f64::INFINITY, clear: way.longest };
        let (speed, offset) = (norm(way.drift), norm(way.offset));
        let carried = if speed > 0.0 { speed * way.longest } else { 0.0 };
        let far = offset + way.spread * way.longest.sqrt() + carried;
        for wall in self.list() {
            let clearance = wall.clearance(radius);
            match &wall.shape {
                Shape::Plane(p) => near.plane(p, clearance, x, way, far),
                Shape::Room(room) => {
                    for face in room.faces() {
                        near.plane(&face, clearance, x, way, far);
                    }
                }
                Shape::Cylinder(c) => near.cylinder(c, clearance, x, way),
                // from either side, and whichever way it turns
                Shape::Mesh(mesh) => {
                    let far = offset + way.spread * near.clear.sqrt() + speed * near.clear;
                    if let Some(distance) = mesh.distance_within(x, far + clearance) {
                        let gap = distance - clearance;
                        near.gap = near.gap.min(gap);
                        near.clear = near.clear.min(way.lasts(gap - offset, speed));
                    }
                }
            }
        }
        near
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Mesh, Room, Wall};

    const STILL: Wandering = Wandering { offset: [0.0; 3], drift: [0.0; 3], spread: 1.0, longest: 1e9 };

    fn near(shape: Shape, x: Vec3, way: &Wandering) -> Nearness {
        Walls::new(vec![Wall::new("w", shape)]).nearness(x, 0.1, way)
    }

    #[test]
    fn the_nearest_of_every_shape_counts_one_radius_early() {
        let room = || Shape::Room(Room { min: [0.0; 3], max: [4.0, 2.0, 3.0] });
        let close = |n: Nearness, gap: f64| (n.gap - gap).abs() < 1e-14 && (n.clear - gap * gap).abs() < 1e-13;
        assert!(close(near(room(), [1.0, 0.5, 1.5], &STILL), 0.4));
        let round = |inside| Shape::Cylinder(Cylinder { point: [0.0; 3], axis: [0.0, 0.0, 1.0], radius: 1.0, inside });
        assert!(close(near(round(true), [0.3, 0.4, 9.0], &STILL), 0.4));
        assert!(close(near(round(false), [3.0, 4.0, 9.0], &STILL), 3.9));
        let block = || Shape::Mesh(Mesh::block([-1.0; 3], [1.0; 3]).unwrap());
        assert!(close(near(block(), [0.0, 3.0, 0.0], &STILL), 1.9));
        assert!(close(near(block(), [0.0, 0.5, 0.0], &STILL), 0.4));
        // too far to matter
        let short = Wandering { longest: 1.0, ..STILL };
        assert_eq!(near(block(), [0.0, 3.0, 0.0], &short), Nearness { gap: f64::INFINITY, clear: 1.0 });
    }

    #[test]
    fn drift_to_a_wall_shortens_the_time_and_drift_along_it_does_not() {
        let floor = || Shape::Plane(Plane { point: [0.0; 3], normal: [0.0, 1.0, 0.0] });
        let x = [0.0, 1.1, 0.0];
        let drifting = |drift: Vec3| near(floor(), x, &Wandering { drift, ..STILL }).clear;
        assert_eq!(drifting([5.0, 0.0, 0.0]), 1.0);
        let t = drifting([0.0, -2.0, 0.0]);
        assert!((2.0 * t + t.sqrt() - 1.0).abs() < 1e-14);
        let offset = near(floor(), x, &Wandering { offset: [0.0, -0.5, 0.0], ..STILL });
        assert!(offset.gap == 1.0 && (offset.clear - 0.25).abs() < 1e-15);
        assert_eq!(near(floor(), x, &Wandering { offset: [0.0, -1.5, 0.0], ..STILL }).clear, 0.0);
    }
}
