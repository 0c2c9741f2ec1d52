//! Lagrangian tracking of spheres through a flow, with carom's wall laws at the walls.
//!
//! SI units throughout. [`flow`] says what the fluid does at a point, [`force`] what that does to a sphere,
//! [`injection`] where spheres start, [`random`] where chance comes from.

pub mod flow;
pub mod force;
pub mod injection;
pub mod random;
pub(crate) mod vector;
