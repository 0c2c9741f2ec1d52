//! What happens when a small particle hits a wall: does it stick or bounce, how fast, at what angle, with what spin.
//!
//! A **wall law** is a pair of materials × a normal law × a tangential law × roughness. It is read from one text form
//! ([`spec`]), compiled once, and then answers impacts: a pure function, without files, allocation, global state or panics.
//!
//! ```
//! use carom::{Impact, material::Library, spec::parse_law};
//! let law = parse_law(r#"
//!     sphere = "copper"
//!     surface = "aluminium"
//!     normal = "ea"
//!     friction = 0.2
//!     roughness_factor = 0.8
//! "#)?;
//! let wall = law.compile(Library::builtin())?;
//! let out = wall.impact(&Impact::new(90e-6, [2.0, -0.5, 0.0], [0.0, 1.0, 0.0])).expect("it approaches the wall");
//! println!("{}: e = {:.3}, leaves at {:?} m/s", out.fate.name(), out.restitution, out.velocity);
//! # Ok::<(), carom::LawError>(())
//! ```
//!
//! Where to look: one file per mechanism in [`normal`] and [`tangential`]; the equation of motion in [`resolved`]; materials and their
//! sources in [`material`]; rough walls that scatter in
//! [`scatter`]; curved ones in [`curvature`]; what removes a captured sphere in [`removal`]; what impacts take away of the wall in [`erosion`]; what a result's doubts mean in [`validity`]. SI units throughout; angles from the surface.
//!
//! # How do I ...
//!
//! | ... | look at |
//! |---|---|
//! | ask about one impact | [`WallLaw::impact`], [`Impact`], [`Outcome`] |
//! | ask about many | [`batch`] |
//! | build a law from typed values | [`WallLaw::builder`] |
//! | read a law from text | [`spec`] |
//! | word an error for my own users | [`LawError`]: kind, key, value and place as data |
//! | draw values from distributions, find a sticking probability | [`study`] |
//! | add a material, or see where a value comes from | [`material`] |
//! | find the capture velocity, the critical angle, the yield velocity | [`WallLaw::window`], [`WallLaw::critical_angle`], [`WallLaw::yield_velocity`] |
//! | know what a result's warnings mean | [`validity`] |
//! | add adhesion's roughness factor from measured roughness | [`roughness`] |
//! | treat a rough wall that scatters | [`scatter`] |
//! | know what takes a captured sphere off again | [`removal`] |
//! | know what an impact takes away of the wall | [`erosion`] |
//! | see force and overlap during the contact | [`resolved`] |
//! | add a loss | [`normal`], and the recipe in the repository's guide for contributors |
//!
//! # Features
//!
//! | feature | default | what it brings |
//! |---|---|---|
//! | `toml` | yes | laws and materials from text, the library of materials; with it `serde` and `std` |
//! | `serde` | by `toml` | laws from and into any serde format, outcomes into one; with it `std` |
//! | `std` | by `toml` | the processor's instructions asked while running, the nearest name in messages |
//!
//! Without features the crate is `no_std` (with `alloc`) and needs `libm` alone; laws are then built by [`WallLaw::builder`].

#![cfg_attr(not(feature = "std"), no_std)]
// what depends on the platform is on no way to a result (clippy.toml)
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

#[macro_use]
extern crate alloc;

pub mod batch;
pub mod curvature;
pub mod erosion;
pub mod error;
pub mod impact;
pub mod instructions;
pub mod kernel;
pub mod material;
pub mod math;
pub mod normal;
pub mod pair;
pub mod plane;
pub mod random;
pub mod removal;
pub mod resolved;
pub mod roughness;
pub mod scatter;
pub mod spec;
pub mod study;
pub mod tangential;
pub mod units;
pub mod validity;
mod vector;
pub mod wall;

pub use error::LawError;
pub use impact::{Energy, Fate, Impact, ImpactError, Outcome, Vec3};
pub use normal::Window;
pub use tangential::Contact;
pub use validity::Validity;
pub use wall::{AboveYield, WallLaw};

/// The examples of the crate's README are run as tests.
#[cfg(all(doctest, feature = "toml"))]
#[doc = include_str!("../README.md")]
struct Readme;
