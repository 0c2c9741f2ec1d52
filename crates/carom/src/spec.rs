//! The text form of a wall law: one TOML table, read here for the command, case files, the C interface and plug-ins alike.
//!
//! ```toml
//! sphere = "copper"              # a material's name, or a table of properties
//! surface = "glass"
//! normal = "ea"                  # ea | eap | thornton-ning | tabor | constant | by-angle | resolved, or a list of losses
//! tangential = "rolling"         # rolling | walton | micro-slip | constant | by-angle
//! friction = 0.2
//! roughness_factor = 0.8         # C_R; or roughness = "1 nm"
//! adhesion_damping = "1.3 s/m"   # C_A
//! hertz_damping = "0.007 s/m"    # C_H
//! ```
//!
//! Quantities are strings with units or bare SI numbers. Unknown keys, wrong dimensions, impossible values, keys that the law does not
//! read and combinations that make no sense are errors that point at the place and say what would be right. The keys are listed once,
//! in the registry [`Key`]; which parts of a law read them, in [`Choice`].
//!
//! ```
//! # #[cfg(feature = "toml")] {
//! let error = carom::spec::parse_law("normal = \"ea\"\nfrictoin = 0.2\n").unwrap_err();
//! assert_eq!(error.line_column("normal = \"ea\"\nfrictoin = 0.2\n"), Some((2, 1)));
//! # }
//! ```

mod builder;
mod compile;
mod curve;
mod key;
mod keys;
mod normal;
mod range;
mod text;
mod uses;
// without serde only single values are read, by `LawSpec::set_text`
#[cfg_attr(not(feature = "serde"), allow(dead_code))]
mod value;
mod values;
#[cfg(feature = "serde")]
mod write;
mod written;

pub use curve::CurveSpec;
pub(crate) use key::out_of_range;
pub use keys::{Key, KeyInfo, LawBuilder, LawSpec, Search};
pub use normal::{NormalKind, NormalSpec};
pub use range::Range;
#[cfg(feature = "toml")]
pub use text::{parse_law, parse_laws, parse_named_law, parse_only_law};
pub use uses::Choice;
#[cfg(feature = "toml")]
pub(crate) use value::document;
pub(crate) use value::{Entry, Value};
pub use values::{At, CurvatureRadius};

use crate::resolved::AdhesionMode;
use crate::roughness::RoughnessModel;

/// Tangential laws by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TangentialKind {
    /// `rolling`
    Rolling,
    /// `walton`
    Walton,
    /// `micro-slip`
    MicroSlip,
    /// `constant`
    Constant,
    /// `by-angle`
    ByAngle,
}

values::names! {
    TangentialKind, "tangential law",
    "rolling" => Rolling, "walton" => Walton, "micro-slip" => MicroSlip, "constant" => Constant, "by-angle" => ByAngle,
}
values::names! {
    RoughnessModel, "roughness model",
    "rabinovich" => Rabinovich, "fuller-tabor" => FullerTabor,
}
values::names! {
    AdhesionMode, "reading of adhesion",
    "separation-only" => SeparationOnly, "reversible" => Reversible,
}

#[cfg(all(test, feature = "toml"))]
mod tests;
