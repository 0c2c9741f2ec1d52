//! Values that are not known exactly, and what follows: distributions, samples, sticking probability.
//!
//! A [`Distribution`] is truncated to what its quantity can be and renormalised. A [`Sampling`] draws from it by counting
//! ([`crate::random`]): sample number and stream of a quantity decide, so that every point and every curve of a study sees the same
//! draws (common random numbers) and a result does not depend on threads or order. [`sampled`] turns a law per sample and a motion per
//! point into the probability of sticking with its sampling error, and bands of whatever the impacts come to.
//!
//! ```
//! use carom::study::{Distribution, Sampling, sampled};
//! use carom::{Impact, Fate, material::Library, spec::parse_law};
//! use std::borrow::Cow;
//! let law = parse_law("sphere = \"copper\"\nsurface = \"glass\"\nnormal = \"ea\"\nfriction = 0.2\n")?;
//! let law = law.compile(Library::builtin())?;
//! let diameter = Distribution::lognormal(10e-6, 1.5, (1e-7, 1e-3)).expect("most of it in range");
//! let sampling = Sampling { samples: 400, seed: 1 };
//! // one point, 0.8 m/s head-on
//! let study = sampled(&sampling, 1, |_| Ok::<_, carom::ImpactError>(Cow::Borrowed(&law)), |law, sample, _| {
//!     let d = diameter.quantile(sampling.draw(sample, 0));
//!     let out = law.impact(&Impact::new(d, [0.0, -0.8, 0.0], [0.0, 1.0, 0.0]))?;
//!     Ok((out.fate == Fate::Capture, [out.restitution]))
//! }).expect("all of them impacts");
//! let sticking = study.sticking[0];
//! assert!(sticking.low < sticking.value && sticking.value < sticking.high);
//! # Ok::<(), carom::LawError>(())
//! ```

mod distribution;
mod points;
mod sampling;

pub use distribution::{Distribution, DistributionError, Given, Problem, read, read_distribution};
pub use points::{ratios, steps};
pub use sampling::{Band, Sampled, Sampling, Share, sampled, wilson};
