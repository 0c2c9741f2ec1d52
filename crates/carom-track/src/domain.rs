//! What the tracker asks of the space it tracks in: what the fluid is like, and where a path next meets a wall.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use crate::flow::{Flow, Local};
use crate::geometry::{Ahead, Face, Meeting, Path, Shape};
use crate::integrate::{Lanes, Lanes3};
use crate::vector::Vec3;

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

    /// What lies ahead of `W` paths (starts and control points 1 to 5 relative to them), as far as a look side by side tells.
    #[inline(always)]
    fn ahead<const W: usize>(&self, _start: &Lanes3<W>, _path: &[Lanes3<W>; 5], _radius: &Lanes<W>) -> Ahead<W> {
        Ahead::UNKNOWN
    }

    /// The hit on a face that [`Domain::ahead`] saw, with the centre at `x`, θ along the path.
    fn hit(&self, _face: usize, _theta: f64, _x: Vec3, _radius: f64) -> Option<Hit> {
        None
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
    /// Planes and sides of rooms, for the look side by side; none if there are other walls too.
    faces: Option<Vec<Face>>,
}

/// The distance that counts as touching: far below anything measured, above the rounding of positions.
#[inline(always)]
fn slack(x: Vec3, radius: f64) -> f64 {
    1e-15 * x[0].abs().max(x[1].abs()).max(x[2].abs()) + 1e-9 * radius
}

impl Analytic {
    /// A flow and its walls.
    pub fn new(flow: Flow, walls: Vec<Wall>) -> Self {
        let faces = walls.iter().enumerate().map(|(index, wall)| {
            let face = |plane: &_| Face::new(plane, wall.clearance(1.0), index);
            match &wall.shape {
                Shape::Plane(p) => Some(vec![face(p)]),
                Shape::Room(r) => Some(r.faces().iter().map(face).collect()),
                Shape::Cylinder(_) | Shape::Mesh(_) => None,
            }
        });
        let faces = faces.collect::<Option<Vec<_>>>().map(|f| f.concat());
        Self { flow, walls, faces }
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

    #[inline(always)]
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
    fn ahead<const W: usize>(&self, start: &Lanes3<W>, path: &[Lanes3<W>; 5], radius: &Lanes<W>) -> Ahead<W> {
        let Some(faces) = &self.faces else { return Ahead::UNKNOWN };
        let mut margin = [0.0; W];
        for l in 0..W {
            margin[l] = 2.0 * slack([start[0][l], start[1][l], start[2][l]], radius[l]);
        }
        let mut ahead = Ahead::nothing(margin);
        for (index, face) in faces.iter().enumerate() {
            ahead.look(index, face, start, path, radius);
        }
        ahead
    }

    #[inline(always)]
    fn hit(&self, face: usize, theta: f64, x: Vec3, radius: f64) -> Option<Hit> {
        let face = self.faces.as_ref()?.get(face)?;
        let wall_velocity = self.walls.get(face.wall)?.velocity;
        Some(Hit { wall: face.wall, meeting: face.meeting(theta, x, radius), wall_velocity })
    }
}
