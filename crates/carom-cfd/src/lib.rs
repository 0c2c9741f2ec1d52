//! Finished CFD results: a mesh of polyhedra and the fields on it at one time. Knows no physics.
//!
//! [`Mesh`] is a mesh as finite volumes hold it: polygons, each between two cells or between a cell and the outside. [`Field`] is a
//! quantity on it, by cells or by points. [`Snapshot`] is both, and what a reader has to say of them.

pub mod block;
pub mod check;
mod error;
mod field;
#[cfg(feature = "fluent")]
pub mod fluent;
pub mod geometry;
mod mesh;
mod names;
pub mod openfoam;
mod points;
pub mod quality;
#[cfg(test)]
mod samples;
pub mod vtk;

pub use error::Error;
pub use field::{Field, Fields};
pub use mesh::{Carry, Mesh, Patch, PatchKind, Polygons};
pub use names::{Names, Wanted};

/// A result at one time.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The mesh.
    pub mesh: Mesh,
    /// The fields on it.
    pub fields: Fields,
    /// Name of the time, where the result has several.
    pub time: Option<String>,
    /// What of the files was left out, filled in or simplified, a sentence each.
    pub notes: Vec<String>,
}
