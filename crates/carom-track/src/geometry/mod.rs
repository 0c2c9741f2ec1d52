//! Walls and where a path meets them.
//!
//! A wall's shape says how far a point is from it and where the path of a sphere's centre first comes within a
//! clearance: one radius where contact is the surface's, zero where it is the centre's (as CFD codes that reflect at the
//! centre of mass do).

pub mod bernstein;
mod contact;
mod cylinder;
mod faces;
mod mesh;
mod path;
mod plane;
mod room;

pub use bernstein::Bernstein;
pub(crate) use contact::first_contact;
pub use cylinder::Cylinder;
pub use faces::Ahead;
pub(crate) use faces::Face;
pub use mesh::{Mesh, Triangle};
pub use path::{Path, evaluate};
pub use plane::Plane;
pub use room::Room;

use crate::vector::Vec3;

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

    /// Where a path first comes within `clearance` of the shape. `slack` is the distance that counts as touching.
    #[inline(always)]
    pub fn meet(&self, path: &Path, clearance: f64, slack: f64) -> Option<Meeting> {
        match self {
            Self::Plane(p) => p.meet(path, clearance, slack),
            Self::Cylinder(c) => c.meet(path, clearance, slack),
            Self::Room(r) => r.meet(path, clearance, slack),
            Self::Mesh(m) => m.meet(path, clearance, slack),
        }
    }
}
