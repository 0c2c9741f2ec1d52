//! Walls and where a path meets them.
//!
//! A wall's shape says how far a point is from it and where the path of a sphere's centre first comes within a
//! clearance: one radius where contact is the surface's, zero where it is the centre's (as CFD codes that reflect at the
//! centre of mass do).

pub mod bernstein;
mod bounds;
mod contact;
mod cylinder;
mod faces;
mod mesh;
mod nearness;
mod path;
mod plane;
mod room;
pub mod triangles;
mod walls;

pub use bernstein::Bernstein;
pub use bounds::Bounds;
pub(crate) use contact::first_contact;
pub use cylinder::Cylinder;
pub use faces::Ahead;
pub(crate) use faces::{Face, single_descents};
pub(crate) use mesh::nearest::nearest_point;
pub(crate) use mesh::tree::{Halves, STACK, Tree};
pub use mesh::{Mesh, Triangle};
pub use nearness::{Nearness, Wandering};
pub use path::{Path, evaluate, split};
pub use plane::Plane;
pub use room::Room;
pub use walls::{ContactAt, Hit, Overlap, Support, Supports, Wall, Walls};

use crate::vector::Vec3;
use carom::curvature::Curvature;

/// The first meeting of a path with a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Where on the step, 0 to 1.
    pub theta: f64,
    /// The centre at contact, m, put exactly at the clearance.
    pub position: Vec3,
    /// Unit normal at contact, out of the wall into the fluid.
    pub normal: Vec3,
}

/// The shape of a wall.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A plane.
    Plane(Plane),
    /// The inside of a pipe or the outside of a rod.
    Cylinder(Cylinder),
    /// The inside of a box.
    Room(Room),
    /// A triangulated surface.
    Mesh(Mesh),
}

impl Shape {
    /// Signed distance of a point, m; positive in the fluid.
    pub fn distance(&self, x: Vec3) -> f64 {
        match self {
            Self::Plane(p) => p.distance(x),
            Self::Cylinder(c) => c.distance(x),
            Self::Room(r) => r.distance(x),
            Self::Mesh(m) => m.distance(x),
        }
    }

    /// Its curvature at every contact: that of a cylinder's wall. Triangles are flat.
    pub fn curvature(&self) -> Curvature {
        match self {
            Self::Cylinder(c) => Curvature::cylinder(if c.inside { -c.radius } else { c.radius }),
            Self::Plane(_) | Self::Room(_) | Self::Mesh(_) => Curvature::FLAT,
        }
    }

    /// Distance (m) and unit normal, into the fluid, of its nearest point; none where no normal is known (on a mesh itself).
    #[inline(always)]
    fn nearest(&self, x: Vec3) -> Option<(f64, Vec3)> {
        match self {
            Self::Plane(p) => Some((p.distance(x), p.normal)),
            Self::Cylinder(c) => Some((c.distance(x), c.normal(x))).filter(|(_, n)| n[0].is_finite()),
            Self::Room(r) => {
                r.faces().iter().map(|f| (f.distance(x), f.normal)).reduce(|a, b| if b.0 < a.0 { b } else { a })
            }
            Self::Mesh(m) => {
                let (_, foot) = m.nearest(x)?;
                let away = crate::vector::sub(x, foot);
                let distance = crate::vector::norm(away);
                (distance > 0.0).then(|| (distance, crate::vector::scale(away, 1.0 / distance)))
            }
        }
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Plane(_) | Self::Cylinder(_) => Bounds::ALL,
            Self::Room(r) => Bounds { min: r.min, max: r.max },
            Self::Mesh(m) => m.bounds(),
        }
    }

    /// Where a path first comes within `clearance` of the shape, and on which triangle if it is a mesh. `slack` is the
    /// distance that counts as touching.
    #[inline(always)]
    pub fn meet(&self, path: &Path, clearance: f64, slack: f64) -> Option<(Meeting, Option<u32>)> {
        let smooth = |m| (m, None);
        match self {
            Self::Plane(p) => p.meet(path, clearance, slack).map(smooth),
            Self::Cylinder(c) => c.meet(path, clearance, slack).map(smooth),
            Self::Room(r) => r.meet(path, clearance, slack).map(smooth),
            Self::Mesh(m) => m.meet(path, clearance, slack).map(|(m, face)| (m, Some(face))),
        }
    }

    /// Tells the triangle, the normal and the gap (m) of every contact of a sphere at `x` that is within `slack`.
    fn touched(&self, x: Vec3, clearance: f64, slack: f64, tell: &mut impl FnMut(Option<u32>, Vec3, f64)) {
        let mut smooth = |distance: f64, normal: Vec3| {
            if distance - clearance <= slack {
                tell(None, normal, distance - clearance);
            }
        };
        match self {
            Self::Plane(p) => smooth(p.distance(x), p.normal),
            Self::Cylinder(c) => smooth(c.distance(x), c.normal(x)),
            Self::Room(r) => r.faces().iter().for_each(|f| smooth(f.distance(x), f.normal)),
            Self::Mesh(m) => m.touched(x, clearance, slack, &mut |face, normal, gap| tell(Some(face), normal, gap)),
        }
    }
}
