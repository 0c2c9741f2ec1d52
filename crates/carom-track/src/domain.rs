//! What the tracker asks of the space it tracks in: what the fluid is like, and where a path next meets a wall.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use crate::flow::{Flow, Local};
use crate::geometry::{Meeting, Path, Plane, Room, Shape};
use crate::integrate::{Lanes, Lanes3};
use crate::vector::{Vec3, dot};

/// A space with a fluid and walls. A CFD mesh can be one too.
pub trait Domain: Sync {
    /// Everything known of the fluid at a point.
    fn fluid(&self, x: Vec3) -> Local;

    /// The fluid's velocity at `W` points, m/s.
    fn velocities<const W: usize>(&self, x: &Lanes3<W>) -> Lanes3<W>;

    /// Whether the fluid moves alike everywhere.
    fn is_uniform(&self) -> bool {
        false
    }

    /// Where the centre of a sphere of that radius, on that path, first touches a wall.
    fn next_wall(&self, path: &Path, radius: f64) -> Option<Hit>;

    /// For `W` paths (starts and control points 1 to 4 relative to them): `true` where surely no wall is met.
    ///
    /// A quick test that may say `false` too often.
    #[inline(always)]
    fn clear<const W: usize>(&self, _start: &Lanes3<W>, _path: &[Lanes3<W>; 4], _radius: &Lanes<W>) -> [bool; W] {
        [false; W]
    }
}

/// A path meets a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the wall.
    pub wall: usize,
    /// Where on the path, and the normal there.
    pub meeting: Meeting,
    /// Velocity of the wall at the contact point, m/s.
    pub wall_velocity: Vec3,
}

/// What must reach the wall for contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactAt {
    /// The sphere's surface, one radius before its centre.
    #[default]
    Surface,
    /// The sphere's centre.
    Center,
}

/// A wall's geometry.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Its name in results.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
    /// What must reach it for contact.
    pub contact_at: ContactAt,
    /// Velocity of the wall along itself, m/s.
    pub velocity: Vec3,
}

impl Wall {
    /// Distance at which a sphere of that radius is in contact, m.
    #[inline(always)]
    pub fn clearance(&self, radius: f64) -> f64 {
        match self.contact_at {
            ContactAt::Surface => radius,
            ContactAt::Center => 0.0,
        }
    }
}

/// An analytic flow with walls of simple shapes.
#[derive(Debug)]
pub struct Analytic {
    flow: Flow,
    walls: Vec<Wall>,
    /// Planes and rooms of the walls, each with whether a radius counts: for the quick test.
    planes: Vec<(Plane, f64)>,
    rooms: Vec<(Room, f64)>,
    only_flat: bool,
}

/// Whether a path surely misses a flat wall: it starts clear of it and its lowest control point is, or it touches and
/// every control point leads away.
#[inline(always)]
fn misses(gap: f64, lowest: f64, margin: f64) -> bool {
    (lowest > 0.0) | ((gap > margin) & (gap + lowest > margin))
}

/// The distance that counts as touching: far below anything measured, above the rounding of positions.
#[inline(always)]
fn slack(x: Vec3, radius: f64) -> f64 {
    1e-15 * x[0].abs().max(x[1].abs()).max(x[2].abs()) + 1e-9 * radius
}

impl Analytic {
    /// A flow and its walls.
    pub fn new(flow: Flow, walls: Vec<Wall>) -> Self {
        let (mut planes, mut rooms) = (Vec::new(), Vec::new());
        let mut only_flat = true;
        for wall in &walls {
            let share = wall.clearance(1.0);
            match &wall.shape {
                Shape::Plane(p) => planes.push((*p, share)),
                Shape::Room(r) => rooms.push((*r, share)),
                Shape::Cylinder(_) | Shape::Mesh(_) => only_flat = false,
            }
        }
        Self { flow, walls, planes, rooms, only_flat }
    }

    /// The walls, in the order of their indices.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }
}

impl Domain for Analytic {
    fn fluid(&self, x: Vec3) -> Local {
        self.flow.sample(x)
    }

    #[inline(always)]
    fn velocities<const W: usize>(&self, x: &Lanes3<W>) -> Lanes3<W> {
        self.flow.velocities(x)
    }

    fn is_uniform(&self) -> bool {
        matches!(self.flow, Flow::Still | Flow::Uniform { .. })
    }

    fn next_wall(&self, path: &Path, radius: f64) -> Option<Hit> {
        let slack = slack(path.start, radius);
        let mut first: Option<Hit> = None;
        for (index, wall) in self.walls.iter().enumerate() {
            let met = wall.shape.meet(path, wall.clearance(radius), slack);
            if let Some(m) = met.filter(|m| first.is_none_or(|f| m.theta < f.meeting.theta)) {
                first = Some(Hit { wall: index, meeting: m, wall_velocity: wall.velocity });
            }
        }
        first
    }

    #[inline(always)]
    fn clear<const W: usize>(&self, start: &Lanes3<W>, path: &[Lanes3<W>; 4], radius: &Lanes<W>) -> [bool; W] {
        let mut clear = [self.only_flat; W];
        let mut margin = [0.0; W];
        for l in 0..W {
            margin[l] = 2.0 * slack([start[0][l], start[1][l], start[2][l]], radius[l]);
        }
        for (plane, share) in &self.planes {
            let n = plane.normal;
            let level = dot(n, plane.point);
            for l in 0..W {
                let along = |p: &Lanes3<W>| n[0] * p[0][l] + n[1] * p[1][l] + n[2] * p[2][l];
                let lowest = along(&path[0]).min(along(&path[1])).min(along(&path[2]).min(along(&path[3])));
                clear[l] &= misses(along(start) - level - share * radius[l], lowest, margin[l]);
            }
        }
        for (room, share) in &self.rooms {
            for c in 0..3 {
                for l in 0..W {
                    let [p, q, r, s] = [path[0][c][l], path[1][c][l], path[2][c][l], path[3][c][l]];
                    let lowest = p.min(q).min(r.min(s));
                    let highest = p.max(q).max(r.max(s));
                    let reach = share * radius[l];
                    clear[l] &= misses(start[c][l] - room.min[c] - reach, lowest, margin[l])
                        & misses(room.max[c] - start[c][l] - reach, -highest, margin[l]);
                }
            }
        }
        clear
    }
}
