//! What may be fitted: how a law holds it, where it may lie, where a search begins.

use carom::error::did_you_mean;
use carom::material::Library;
use carom::spec::LawSpec;
use carom::units::{InverseSpeed, Number, Pressure, SurfaceEnergy, UnitError};
use carom::{SpecError, WallLaw};
use serde::Serialize;
use std::ops::RangeInclusive;

/// A parameter of a wall law that a fit may find, by its key in the law's text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// C_A, s/m.
    AdhesionDamping,
    /// C_H, s/m.
    HertzDamping,
    /// C_R.
    RoughnessFactor,
    /// w, J/m².
    WorkOfAdhesion,
    /// k, Pa.
    PlasticConstant,
    /// f.
    Friction,
}

impl Parameter {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::AdhesionDamping,
        Self::HertzDamping,
        Self::RoughnessFactor,
        Self::WorkOfAdhesion,
        Self::PlasticConstant,
        Self::Friction,
    ];

    /// Its key in a law's text.
    pub fn name(self) -> &'static str {
        match self {
            Self::AdhesionDamping => "adhesion_damping",
            Self::HertzDamping => "hertz_damping",
            Self::RoughnessFactor => "roughness_factor",
            Self::WorkOfAdhesion => "work_of_adhesion",
            Self::PlasticConstant => "plastic_constant",
            Self::Friction => "friction",
        }
    }

    /// Its letter.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::AdhesionDamping => "C_A",
            Self::HertzDamping => "C_H",
            Self::RoughnessFactor => "C_R",
            Self::WorkOfAdhesion => "w",
            Self::PlasticConstant => "k",
            Self::Friction => "f",
        }
    }

    /// SI unit, empty for a number.
    pub fn unit(self) -> &'static str {
        match self {
            Self::AdhesionDamping | Self::HertzDamping => InverseSpeed::SI,
            Self::RoughnessFactor | Self::Friction => "",
            Self::WorkOfAdhesion => SurfaceEnergy::SI,
            Self::PlasticConstant => Pressure::SI,
        }
    }

    /// Where it may lie by its nature.
    pub fn natural_bounds(self) -> RangeInclusive<f64> {
        if self == Self::RoughnessFactor { 0.0..=1.0 } else { 0.0..=f64::INFINITY }
    }

    /// What a law needs where its own range leaves zero out.
    fn least(self) -> f64 {
        match self {
            Self::RoughnessFactor => 1e-9,
            Self::PlasticConstant => 1.0,
            _ => 0.0,
        }
    }

    /// Puts a value into a law.
    pub fn set(self, law: &mut LawSpec, value: f64) {
        let value = value.max(self.least());
        match self {
            Self::AdhesionDamping => law.adhesion_damping = Some(InverseSpeed(value).into()),
            Self::HertzDamping => law.hertz_damping = Some(InverseSpeed(value).into()),
            Self::RoughnessFactor => {
                (law.roughness, law.roughness_model, law.asperity_radius) = (None, None, None);
                law.roughness_factor = Some(Number(value).into());
            }
            Self::WorkOfAdhesion => law.work_of_adhesion = Some(SurfaceEnergy(value).into()),
            Self::PlasticConstant => law.plastic_constant = Some(Pressure(value).into()),
            Self::Friction => law.friction = Some(Number(value).into()),
        }
    }

    /// Reads a value with a unit, or a bare SI number.
    ///
    /// # Errors
    /// Where the text goes wrong.
    pub fn read(self, text: &str) -> Result<f64, UnitError> {
        Ok(match self {
            Self::AdhesionDamping | Self::HertzDamping => text.parse::<InverseSpeed>()?.0,
            Self::RoughnessFactor | Self::Friction => text.parse::<Number>()?.0,
            Self::WorkOfAdhesion => text.parse::<SurfaceEnergy>()?.0,
            Self::PlasticConstant => text.parse::<Pressure>()?.0,
        })
    }

    /// What the law says of it: its own key, or what its materials and roughness give; else a usual value.
    pub fn start(self, law: &LawSpec, library: &Library) -> f64 {
        let compiled = || law.compile(library).ok();
        let pair = |get: fn(&carom::pair::Pair) -> Result<f64, SpecError>| {
            compiled().and_then(|w| w.pair().and_then(|p| get(p).ok()))
        };
        match self {
            Self::AdhesionDamping => law.adhesion_damping.as_ref().map_or(0.1, |v| v.value.0),
            Self::HertzDamping => law.hertz_damping.as_ref().map_or(0.001, |v| v.value.0),
            Self::RoughnessFactor => law
                .roughness_factor
                .as_ref()
                .map(|v| v.value.0)
                .or_else(|| compiled().filter(|_| law.roughness.is_some()).map(|w| w.roughness_factor()))
                .unwrap_or(0.5),
            Self::WorkOfAdhesion => law
                .work_of_adhesion
                .as_ref()
                .map(|v| v.value.0)
                .or_else(|| pair(|p| p.work_of_adhesion()))
                .unwrap_or(0.1),
            Self::PlasticConstant => law
                .plastic_constant
                .as_ref()
                .map(|v| v.value.0)
                .or_else(|| pair(|p| p.plastic_constant()))
                .unwrap_or(100e6),
            Self::Friction => law.friction.as_ref().map(|v| v.value.0).filter(|f| *f > 0.0).unwrap_or(0.2),
        }
    }

    /// Where a search begins besides `start`.
    pub(super) fn grid(self, start: f64) -> Vec<f64> {
        match self {
            Self::AdhesionDamping => vec![0.0, 0.3, 3.0],
            Self::HertzDamping => vec![0.0, 0.003, 0.03],
            Self::RoughnessFactor => vec![0.03, 0.15, 0.5, 1.0],
            Self::WorkOfAdhesion | Self::PlasticConstant => [0.1, 0.3, 1.0, 3.0, 10.0].map(|s| s * start).into(),
            Self::Friction => vec![0.05, 0.15, 0.4],
        }
    }

    /// A size by which steps and differences are measured.
    pub(super) fn scale(self, start: f64) -> f64 {
        match self {
            Self::AdhesionDamping => 1.0,
            Self::HertzDamping => 0.01,
            Self::RoughnessFactor | Self::Friction => 0.2,
            Self::WorkOfAdhesion => start.max(1e-3),
            Self::PlasticConstant => start.max(1e6),
        }
    }

    /// Does it change what `law` answers?
    ///
    /// # Errors
    /// The law does not take it, or lacks something else.
    pub fn acts(self, law: &LawSpec, library: &Library) -> Result<bool, SpecError> {
        let start = self.start(law, library).max(self.scale(1.0).min(0.1));
        let [one, other]: [WallLaw; 2] = {
            let with = |value: f64| {
                let mut law = law.clone();
                self.set(&mut law, value);
                law.compile(library)
            };
            [with(start)?, with(0.5 * start)?]
        };
        Ok(one.normal() != other.normal() || one.tangential() != other.tangential())
    }
}

impl std::str::FromStr for Parameter {
    type Err = SpecError;
    fn from_str(text: &str) -> Result<Self, SpecError> {
        let wanted = text.trim().replace('-', "_");
        let found = Self::ALL.into_iter().find(|p| p.name() == wanted || p.symbol() == wanted);
        found.ok_or_else(|| {
            let names = Self::ALL.map(Self::name);
            let near = did_you_mean(&wanted, names).map_or(String::new(), |n| format!("{n} "));
            SpecError::new(format!("unknown parameter '{text}'")).help(format!("{near}known are {}", names.join(", ")))
        })
    }
}

impl std::fmt::Display for Parameter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}
