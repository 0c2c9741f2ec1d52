//! Lagrangian tracking of spheres through a flow, with carom's wall laws at the walls.
//!
//! SI units throughout. [`flow`] says what the fluid does at a point, [`force`] what that does to a sphere,
//! [`injection`] where spheres start, [`random`] where chance comes from; [`domain`] joins flow and walls, [`tracker`]
//! takes each sphere from its injection to its fate.

// what depends on the platform is on no way to a result (clippy.toml)
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod about;
mod block;
pub mod case;
pub mod deposition;
pub mod domain;
pub mod dynamics;
pub mod exact_sum;
pub mod flow;
pub mod force;
pub mod geometry;
pub mod injection;
pub mod integrate;
mod lanes;
pub use carom::random;
pub mod record;
pub mod run;
pub mod summary;
pub mod tables;
pub mod tracker;
pub(crate) mod vector;

pub use about::About;
pub use case::{Case, CaseError};
pub use run::{Progress, RunError, RunOptions, Shard, Silent, merge, run};
pub use summary::Summary;
pub use tables::TableFormat;
