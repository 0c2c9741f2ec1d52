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
//! Quantities are strings with units or bare SI numbers. Unknown keys, wrong dimensions, impossible values and combinations that make no
//! sense are errors that point at the place and say what would be right.
//!
//! ```
//! let error = carom::spec::parse_law("normal = \"ea\"\nfrictoin = 0.2\n").unwrap_err();
//! assert_eq!(error.line_column("normal = \"ea\"\nfrictoin = 0.2\n"), Some((2, 1)));
//! ```

mod check;
mod compile;
mod curve;
mod named;
mod normal;
mod roughness;
mod tangential;
mod values;
mod write;

pub use curve::CurveSpec;
pub use named::{parse_named_law, parse_only_law};
pub use normal::{NormalKind, NormalSpec};
pub use values::{At, CurvatureRadius};

use crate::error::SpecError;
use crate::material::MaterialRef;
use crate::resolved::AdhesionMode;
use crate::roughness::RoughnessModel;
use crate::units::{Angle, InverseSpeed, Length, Number, Pressure, Speed, SurfaceEnergy};

/// A wall law as written. Everything but `normal` may be absent; what a law needs and lacks is reported by [`LawSpec::compile`].
#[derive(Clone, Debug, Default, PartialEq, serde::Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct LawSpec {
    /// The sphere's material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sphere: Option<At<MaterialRef>>,
    /// The surface's material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<At<MaterialRef>>,
    /// Normal law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<At<NormalSpec>>,
    /// Resolved only: when adhesion acts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adhesion: Option<At<AdhesionMode>>,
    /// Tangential law; `rolling` when absent, `constant` or `by-angle` when a tangential restitution is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangential: Option<At<TangentialKind>>,
    /// Coulomb friction coefficient f.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<At<Number>>,
    /// Walton's β₀.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub walton_beta: Option<At<Number>>,
    /// C_R.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness_factor: Option<At<Number>>,
    /// σ_r.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness: Option<At<Length>>,
    /// How C_R follows from σ_r; `rabinovich` when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness_model: Option<At<RoughnessModel>>,
    /// Radius β of the asperities, for `fuller-tabor`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asperity_radius: Option<At<Length>>,
    /// Δγ, standard deviation of the roughness angle: the wall scatters.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness_angle: Option<At<Angle>>,
    /// C_A.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub adhesion_damping: Option<At<InverseSpeed>>,
    /// C_H.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hertz_damping: Option<At<InverseSpeed>>,
    /// Radius of curvature r_s of the surface: `"inf"` for flat, negative for concave.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface_curvature: Option<At<values::CurvatureRadius>>,
    /// Normal restitution of the constant and by-angle laws.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<At<CurveSpec>>,
    /// Tangential restitution e_t.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tangential_restitution: Option<At<CurveSpec>>,
    /// Tabor's fitted yield velocity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yield_velocity: Option<At<Speed>>,
    /// Meyer's index n.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meyer_index: Option<At<Number>>,
    /// Thornton–Ning's limiting peak pressure p_y.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limiting_pressure: Option<At<Pressure>>,
    /// Interfacial parameter Φ.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interfacial_parameter: Option<At<Number>>,
    /// Equilibrium spacing z₀.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equilibrium_spacing: Option<At<Length>>,
    /// Override of the work of adhesion w.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub work_of_adhesion: Option<At<SurfaceEnergy>>,
    /// Override of the stiffness K.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<At<Pressure>>,
    /// Override of the plastic constant k.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plastic_constant: Option<At<Pressure>>,
}

/// Tangential laws by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// Reads one wall law: the keys of a `[law.NAME]` table, without the header.
///
/// # Errors
/// What is wrong, with its place in `text`.
pub fn parse_law(text: &str) -> Result<LawSpec, SpecError> {
    toml::from_str(text).map_err(SpecError::from)
}

#[cfg(test)]
mod tests;
