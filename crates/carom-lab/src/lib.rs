//! Experiments as data, and how far the models are from them.
//!
//! An [`experiment`] is a text file: spheres, surface, wall laws, the plots it is shown in, and measured or stated values, each
//! with where it comes from. [`points`] adds a CSV file of measurements that lies beside it. [`compare`] holds every curve
//! against every value; [`validate()`] does so for all experiments and writes a report. Nothing is fitted here.
//!
//! SI units; angles in degrees from the surface.

pub mod compare;
pub mod error;
pub mod experiment;
pub mod export;
pub mod fit;
pub mod identities;
mod library;
pub mod plots;
pub mod points;
mod report;
pub mod resolved;
pub mod table_2;
pub mod tunnel;
pub mod validate;

pub use error::LabError;
pub use experiment::Experiment;
pub use library::{builtin, from_folder};
pub use validate::{Validation, validate};
