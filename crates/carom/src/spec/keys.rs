//! The registry of a law's keys. Everything that knows keys follows from it: the law file and its range checks, the builder, the
//! command's flags and their help, fit parameters, distributions, and the table in `docs/wall-law.md`.
//!
//! An entry is `Variant name: what is written => what the builder takes`, its meaning as a doc comment, and:
//!
//! | field | what |
//! |---|---|
//! | `symbol` | in equations; empty where there is none |
//! | `noun` | "the law needs …" |
//! | `example` | a value as it would be written |
//! | `default` | what holds where the key is absent; empty where nothing does |
//! | `group` | heading in a front's help |
//! | `range` | of a number, SI units |
//! | `draw` | number of its stream of random draws, if it may be a distribution; never changed and never used twice |
//! | `search` | where a fit looks, if it may be fitted |
//!
//! Which laws read a key is declared in [`crate::spec::uses`].

use super::range::Range;
use super::values::{At, CurvatureRadius};
use super::written::{Built, Written};
use super::{CurveSpec, NormalSpec, TangentialKind};
use crate::error::LawError;
use crate::material::{Library, Material, MaterialRef};
use crate::normal::empirical::Curve;
use crate::resolved::AdhesionMode;
use crate::roughness::RoughnessModel;
use crate::scatter;
use crate::units::{Angle, Energy, InverseSpeed, Length, Number, Pressure, Speed, SurfaceEnergy};

/// What the registry says of a key.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct KeyInfo {
    /// As written in a law's text.
    pub name: &'static str,
    /// In equations.
    pub symbol: &'static str,
    /// SI unit, empty for a pure number and for what is not a number.
    pub unit: &'static str,
    /// What is written, in a word: `LENGTH`, `MATERIAL`.
    pub word: &'static str,
    /// "The law needs …"
    pub noun: &'static str,
    /// What it means, in a line.
    pub meaning: &'static str,
    /// A value as it would be written.
    pub example: &'static str,
    /// What holds where it is absent.
    pub default: &'static str,
    /// The part of a law it belongs to.
    pub group: &'static str,
    /// Of a number.
    pub range: Range,
    /// Number of its stream of random draws, if it may be a distribution.
    pub draw: Option<u32>,
    /// Where a fit looks, if it may be fitted.
    pub search: Option<Search>,
}

impl KeyInfo {
    const NONE: Self = Self {
        name: "",
        symbol: "",
        unit: "",
        word: "",
        noun: "",
        meaning: "",
        example: "",
        default: "",
        group: "",
        range: Range::ANY,
        draw: None,
        search: None,
    };
}

/// Where a fit looks for a number, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Where it begins if the law says nothing.
    pub start: f64,
    /// A size by which steps and differences are measured; at least this, and as large as the start where `relative`.
    pub scale: f64,
    /// Where it begins besides, times the start where `relative`.
    pub grid: &'static [f64],
    /// Whether the start sets the scale.
    pub relative: bool,
    /// The least value that a law takes.
    pub least: f64,
}

const MATERIALS: &str = "Materials";
const NORMAL: &str = "Normal law";
const TANGENTIAL: &str = "Tangential law";
const SURFACES: &str = "Surfaces";
const INSTEAD: &str = "Instead of what the materials give";

const NOT_NEGATIVE: Range = Range::from(0.0, "zero or more is wanted");
const DAMPING: Range = Range::from(0.0, "zero or more is wanted, in s/m");
const POSITIVE_PRESSURE: Range = Range::above(0.0, "a positive pressure is wanted");
const TENTHS_TO_TEN: &[f64] = &[0.1, 0.3, 1.0, 3.0, 10.0];
const LENGTHS_OF_ATOMS: Range =
    Range::between(1e-11, 1e-8, "it is a distance between atoms, above 0.01 nm and below 10 nm");

macro_rules! law_keys {
    ($($(#[doc = $doc:literal])+ $variant:ident $field:ident: $written:ty => $built:ty { $($info:tt)* })*) => {
        /// A key of a wall law.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Key { $($(#[doc = $doc])+ $variant),* }

        impl Key {
            /// All of them, in the order of the documentation.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];
            /// Their names, likewise.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];

            /// What the registry says of it.
            pub const fn info(self) -> &'static KeyInfo {
                match self {
                    $(Self::$variant => {
                        const INFO: KeyInfo = KeyInfo {
                            name: stringify!($field),
                            unit: <$written as Written>::UNIT,
                            word: <$written as Written>::WORD,
                            meaning: concat!($($doc),+),
                            $($info)*
                            ..KeyInfo::NONE
                        };
                        &INFO
                    })*
                }
            }
        }

        /// A wall law as written. Everything but `normal` may be absent; what a law needs and lacks is reported by [`LawSpec::compile`].
        #[derive(Clone, Debug, Default, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        pub struct LawSpec {
            $(
                $(#[doc = $doc])+
                #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
                pub $field: Option<At<$written>>,
            )*
        }

        impl LawSpec {
            /// Is the key given?
            pub fn is_given(&self, key: Key) -> bool {
                match key { $(Key::$variant => self.$field.is_some()),* }
            }

            /// Where the key's value stands in the text the law was read from.
            pub fn span(&self, key: Key) -> Option<core::ops::Range<usize>> {
                match key { $(Key::$variant => self.$field.as_ref()?.span.clone()),* }
            }

            /// The key's value in SI units, if it is given and a number.
            pub fn number(&self, key: Key) -> Option<f64> {
                match key { $(Key::$variant => Written::number(&self.$field.as_ref()?.value)),* }
            }

            /// Gives the key a number in SI units; `false` for a key that takes none.
            pub fn set_number(&mut self, key: Key, value: f64) -> bool {
                match key {
                    $(Key::$variant => {
                        let written = <$written as Written>::of_number(value);
                        let takes = written.is_some();
                        self.$field = written.map(At::from).or(self.$field.take());
                        takes
                    }),*
                }
            }

            /// Leaves the key out.
            pub fn remove(&mut self, key: Key) {
                match key { $(Key::$variant => self.$field = None),* }
            }

            /// Takes over what `other` gives.
            pub fn overlay(&mut self, other: &Self) {
                $(if other.$field.is_some() {
                    self.$field.clone_from(&other.$field);
                })*
            }

            /// Reads a key's value.
            pub(super) fn set(&mut self, key: Key, value: &At<super::value::Value>) -> Result<(), LawError> {
                let place = |e: LawError| e.at(value.span.clone());
                match key {
                    $(Key::$variant => {
                        let read = <$written as Written>::read(key, &value.value).map_err(place)?;
                        self.$field = Some(At { value: read, span: value.span.clone() });
                    })*
                }
                Ok(())
            }

            /// The builder with all that is given; names are looked up.
            pub(super) fn to_builder(&self, library: &Library) -> Result<LawBuilder, LawError> {
                let mut builder = LawBuilder::default();
                $(if let Some(at) = &self.$field {
                    builder.$field = Some(at.value.build(Key::$variant, library).map_err(|e| e.at(at.span.clone()))?);
                })*
                Ok(builder)
            }
        }

        /// A wall law in the making, SI units throughout. See [`crate::WallLaw::builder`].
        #[derive(Clone, Debug, Default)]
        #[must_use]
        pub struct LawBuilder {
            $(pub(super) $field: Option<$built>,)*
        }

        impl LawBuilder {
            $(
                $(#[doc = $doc])+
                pub fn $field(mut self, value: impl Into<$built>) -> Self {
                    self.$field = Some(value.into());
                    self
                }
            )*

            /// Is the key given?
            pub fn is_given(&self, key: Key) -> bool {
                match key { $(Key::$variant => self.$field.is_some()),* }
            }

            /// The key's value in SI units, if it is given and a number.
            pub fn number(&self, key: Key) -> Option<f64> {
                match key { $(Key::$variant => self.$field.as_ref().and_then(Built::number)),* }
            }
        }
    };
}

law_keys! {
    /// the sphere's material: a name, or its properties
    Sphere sphere: MaterialRef => Material {
        noun: "a sphere", example: "copper", group: MATERIALS,
    }
    /// the surface's material, likewise
    Surface surface: MaterialRef => Material {
        noun: "a surface", example: "glass", group: MATERIALS,
    }
    /// the normal law by name, or a list of losses
    Normal normal: NormalSpec => NormalSpec {
        noun: "a normal law", example: "ea", group: NORMAL,
    }
    /// when adhesion acts: on separation only, or reversibly
    Adhesion adhesion: AdhesionMode => AdhesionMode {
        noun: "a reading of adhesion", example: "reversible", default: "separation-only", group: NORMAL,
    }
    /// the tangential law
    Tangential tangential: TangentialKind => TangentialKind {
        noun: "a tangential law", example: "rolling", default: "rolling", group: TANGENTIAL,
    }
    /// Coulomb friction coefficient; needed where an impact is oblique or spins
    Friction friction: Number => f64 {
        symbol: "f", noun: "a friction coefficient", example: "0.2", group: TANGENTIAL, range: NOT_NEGATIVE, draw: Some(4),
        search: Some(Search { start: 0.2, scale: 0.2, grid: &[0.05, 0.15, 0.4], relative: false, least: 0.0 }),
    }
    /// Walton's coefficient of the slip's reversal, from 0 (rolling) to 1 (reversed)
    WaltonBeta walton_beta: Number => f64 {
        symbol: "β₀", noun: "Walton's beta", example: "0.4", group: TANGENTIAL,
        range: Range::within(0.0, 1.0, "it lies between 0 (rolling) and 1 (slip reversed)"), draw: Some(7),
    }
    /// factor on the adhesion force, above 0 and up to 1
    RoughnessFactor roughness_factor: Number => f64 {
        symbol: "C_R", noun: "a roughness factor", example: "0.8", default: "1", group: SURFACES,
        range: Range::above_to(0.0, 1.0, "C_R lies above 0 and up to 1"), draw: Some(1),
        search: Some(Search { start: 0.5, scale: 0.2, grid: &[0.03, 0.15, 0.5, 1.0], relative: false, least: 1e-9 }),
    }
    /// standard deviation of the heights under the contact, nanometres, from which C_R follows
    Roughness roughness: Length => f64 {
        symbol: "σ_r", noun: "a roughness", example: "1 nm", group: SURFACES,
        range: Range::within(0.0, 1e-7, ROUGHNESS_RIGHT), draw: Some(2),
    }
    /// how C_R follows from the roughness: rabinovich, C_R = 1/(1 + 1.485 σ_r/z₀)², or fuller-tabor
    RoughnessModel roughness_model: RoughnessModel => RoughnessModel {
        noun: "a roughness model", example: "fuller-tabor", default: "rabinovich", group: SURFACES,
    }
    /// radius of the asperities, for fuller-tabor
    AsperityRadius asperity_radius: Length => f64 {
        symbol: "β", noun: "the asperities' radius", example: "100 nm", group: SURFACES,
        range: Range::above(0.0, "a positive length is wanted"), draw: Some(8),
    }
    /// standard deviation of the roughness angle, up to 30 deg: each impact meets a facet tilted at random
    RoughnessAngle roughness_angle: Angle => f64 {
        symbol: "Δγ", noun: "a roughness angle", example: "5 deg", default: "0, smooth", group: SURFACES,
        range: Range::within(0.0, scatter::LARGEST, "the standard deviation lies between 0 and 30 deg, such as 5 deg"),
    }
    /// damping of the adhesion force
    AdhesionDamping adhesion_damping: InverseSpeed => f64 {
        symbol: "C_A", noun: "a coefficient for adhesion-damping", example: "1.3 s/m", group: NORMAL, range: DAMPING, draw: Some(5),
        search: Some(Search { start: 0.1, scale: 1.0, grid: &[0.0, 0.3, 3.0], relative: false, least: 0.0 }),
    }
    /// damping of the Hertz force
    HertzDamping hertz_damping: InverseSpeed => f64 {
        symbol: "C_H", noun: "a coefficient for hertz-damping", example: "0.007 s/m", group: NORMAL, range: DAMPING, draw: Some(6),
        search: Some(Search { start: 0.001, scale: 0.01, grid: &[0.0, 0.003, 0.03], relative: false, least: 0.0 }),
    }
    /// radius of curvature of the surface: inf is flat, negative is concave
    SurfaceCurvature surface_curvature: CurvatureRadius => f64 {
        symbol: "r_s", noun: "a radius of curvature", example: "5 mm", default: "inf", group: SURFACES,
        range: Range::all_but(0.0, "a radius of curvature, inf for a flat surface, negative for a concave one"),
    }
    /// restitution: a number, a curve by angle of incidence, or the name of one (grant-tabakoff)
    Restitution restitution: CurveSpec => Curve {
        symbol: "e", noun: "a restitution", example: "0.7", group: NORMAL,
    }
    /// tangential restitution of the sphere's centre, likewise; the spin stays
    TangentialRestitution tangential_restitution: CurveSpec => Curve {
        symbol: "e_t", noun: "a tangential restitution", example: "0.9", group: TANGENTIAL,
    }
    /// Tabor's fitted yield velocity
    YieldVelocity yield_velocity: Speed => f64 {
        symbol: "V_y", noun: "a fitted yield velocity", example: "0.09 m/s", group: NORMAL,
        range: Range::above(0.0, "a positive speed is wanted"), draw: Some(9),
    }
    /// Meyer's index
    MeyerIndex meyer_index: Number => f64 {
        symbol: "n", noun: "Meyer's index", example: "2.29", group: NORMAL,
        range: Range::between(0.5, 3.0, "Meyer's index lies between 0.5 and 3 (2 without, 2.5 with full work hardening)"),
        draw: Some(10),
    }
    /// Thornton and Ning's limiting contact pressure
    LimitingPressure limiting_pressure: Pressure => f64 {
        symbol: "p_y", noun: "a limiting pressure", example: "500 MPa", default: "1.6 yield strengths", group: NORMAL,
        range: POSITIVE_PRESSURE, draw: Some(11),
    }
    /// interfacial parameter in w = 2Φ√(γ₁γ₂)
    InterfacialParameter interfacial_parameter: Number => f64 {
        symbol: "Φ", noun: "an interfacial parameter", example: "1", default: "1", group: SURFACES,
        range: Range::above(0.0, "a positive number, about 1"), draw: Some(12),
    }
    /// equilibrium spacing of the surfaces (the default makes C_R = 0.05 at 0.5 nm)
    EquilibriumSpacing equilibrium_spacing: Length => f64 {
        symbol: "z₀", noun: "an equilibrium spacing", example: "0.2 nm", default: "0.2138 nm", group: SURFACES,
        range: LENGTHS_OF_ATOMS, draw: Some(13),
    }
    /// work of adhesion
    WorkOfAdhesion work_of_adhesion: SurfaceEnergy => f64 {
        symbol: "w", noun: "a work of adhesion", example: "1.65 J/m2", group: INSTEAD,
        range: Range::from(0.0, "zero or more is wanted, in J/m2"), draw: Some(3),
        search: Some(Search { start: 0.1, scale: 1e-3, grid: TENTHS_TO_TEN, relative: true, least: 0.0 }),
    }
    /// Hertzian stiffness
    Stiffness stiffness: Pressure => f64 {
        symbol: "K", noun: "a stiffness", example: "65.4 GPa", group: INSTEAD, range: POSITIVE_PRESSURE, draw: Some(14),
    }
    /// plastic constant, half the yield strength of the softer body
    PlasticConstant plastic_constant: Pressure => f64 {
        symbol: "k", noun: "a plastic constant", example: "145 MPa", group: INSTEAD, range: POSITIVE_PRESSURE, draw: Some(15),
        search: Some(Search { start: 100e6, scale: 1e6, grid: TENTHS_TO_TEN, relative: true, least: 1.0 }),
    }
    /// factor on the plastic constant for strain rate and size: an impact is faster, and its contact smaller, than a test of strength
    DynamicStrengthFactor dynamic_strength_factor: Number => f64 {
        noun: "a dynamic strength factor", example: "2", default: "1", group: INSTEAD,
        range: Range::above(0.0, "a positive number, 1 or a few"), draw: Some(19),
    }
    /// depth of the adhesion well on the way in
    WellDepth well_depth: Energy => f64 {
        symbol: "E_in", noun: "the depth of the adhesion well, or a Hamaker constant", example: "1e-15 J", group: NORMAL,
        range: Range::from(0.0, "zero or more is wanted, in J"), draw: Some(16),
    }
    /// depth of the adhesion well on the way out, not below that on the way in
    WellDepthOut well_depth_out: Energy => f64 {
        symbol: "E_out", noun: "the depth of the adhesion well on the way out", example: "2e-15 J",
        default: "well_depth", group: NORMAL, range: Range::from(0.0, "zero or more is wanted, in J"), draw: Some(17),
    }
    /// Hamaker constant, from which the well's depth follows with the equilibrium spacing
    HamakerConstant hamaker_constant: Energy => f64 {
        symbol: "A", noun: "a Hamaker constant", example: "1e-19 J", group: NORMAL,
        range: Range::within(0.0, 1e-17, "it lies between 0 and 1e-17 J; 50 zJ to 500 zJ are usual"), draw: Some(18),
    }
}

const ROUGHNESS_RIGHT: &str = "C_R knows asperities of nanometres, finer than the contact, up to 100 nm: not the Ra of a machined surface, whose waviness is given as roughness_angle";
