//! Experiments as data, how far carom's models are from them, parameters from measurements, and laws for other programs.
//!
//! An [`experiment`] is a text file: spheres, surface, wall laws, the plots it is shown in, and measured or stated values, each
//! with where it comes from. [`points`] adds a CSV file of measurements that lies beside it. [`compare`] compares every curve
//! with every value; [`validate()`] does so for all experiments and writes a report. Only [`fit`] changes a law.
//!
//! SI units; angles in degrees from the surface.
//!
//! # How do I ...
//!
//! | ... | look at |
//! |---|---|
//! | compare the models with the experiments that come along | [`validate()`], [`builtin`] |
//! | add an experiment or measured points | [`from_folder`], [`points`] |
//! | find parameters of a law from measured restitution | [`fit`] |
//! | do so for several surfaces | [`fit::survey`] |
//! | use a law in Fluent, OpenFOAM, STAR-CCM+ or COMSOL without a library | [`export`] |

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
