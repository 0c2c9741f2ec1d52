//! carom for C and whatever speaks C: a wall law from its text form, one call per impact.
//!
//! Programs include `carom.h` and link `libcarom`; the header repeats these comments. How to build and install: `docs/c.md`.
//!
//! - A law is opaque, never changes, and may be used from many threads at once.
//! - A call answers with a status, [`Status::Ok`] or what went wrong; [`carom_last_error`] has the message. No panic leaves the library.
//! - The structs begin with their own size, set by the caller, so that they can grow: a program compiled against an older header
//!   goes on working, and what it does not give takes its default.
//! - An impact allocates nothing.
//! - SI units; angles in radians, from the surface.

mod calls;
mod columns;
mod impact;
mod law;
mod names;
mod status;

pub use calls::{carom_capture_velocity, carom_impact, carom_impact_batch};
pub use columns::carom_impact_columns;
pub use impact::{Contact, Energy, Fate, ImpactIn, ImpactOut};
pub use law::{Law, carom_law_density, carom_law_free, carom_law_from_file, carom_law_from_text, carom_law_scatters};
pub use names::{carom_contact_name, carom_fate_name, carom_validity_meaning, carom_validity_name, carom_version};
pub use status::{Status, carom_last_error};
