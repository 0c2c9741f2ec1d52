//! Lagrangian tracking of spheres through a flow, with carom's wall laws at the walls.
//!
//! SI units throughout. [`flow`] says what the fluid does at a point, [`force`] what that does to a sphere,
//! [`injection`] where spheres start, [`random`] where chance comes from; [`domain`] joins flow and walls, [`tracker`]
//! takes each sphere from its injection to its fate.
//!
//! ```
//! use carom::material::Library;
//! use carom_track::{Case, RunOptions, Silent, run};
//! let text = r#"
//!     [flow]
//!     kind = "still"
//!     [forces]
//!     gravity = [0, -9.81, 0]
//!     [[wall]]
//!     name = "floor"
//!     plane = { point = [0, 0, 0], normal = [0, 1, 0] }
//!     law = "steel"
//!     [[injection]]
//!     name = "ball"
//!     material = "glass"
//!     diameter = "100um"
//!     position = [0, "1mm", 0]
//!     velocity = [0, 0, 0]
//!     [law.steel]
//!     sphere = "glass"
//!     surface = "stainless-steel"
//!     normal = "ea"
//!     friction = 0.2
//!     [run]
//!     until = "1 s"
//! "#;
//! let case = Case::from_toml(text, "fall.toml".as_ref(), Library::builtin())?;
//! let summary = run(&case, &RunOptions::default(), &Silent)?; // with `out`, tables and a summary are written
//! assert_eq!(summary.injected.count, 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How do I ...
//!
//! | ... | look at |
//! |---|---|
//! | run a case file | [`Case::from_toml`], [`run()`], [`RunOptions`]; the keys stand in the guide to case files |
//! | see each impact in my own code | [`record::Sink`], [`tracker::Tracker::run`] |
//! | go on after an interruption, or split a run between machines | [`RunOptions::resume`], [`Shard`], [`merge()`] |
//! | give a flow on a grid | [`flow`] |
//! | know what the tables hold | [`tables`] |
//! | know how many stuck, where and how much mass | [`Summary`], [`deposition`] |

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
mod outline;
pub use carom::random;
pub mod record;
pub mod run;
pub mod summary;
pub mod tables;
#[cfg(test)]
mod testing;
pub mod tracker;
pub(crate) mod vector;

pub use about::About;
pub use case::{Case, CaseError};
pub use run::{DepositFace, Progress, Remedy, RunError, RunOptions, Shard, Silent, deposit_faces, merge, run};
pub use summary::Summary;
pub use tables::TableFormat;
