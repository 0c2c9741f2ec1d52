//! The registry of material properties, and one property: value, range, source, alternatives.

use super::Material;
use crate::error::{LawError, Problem};
use crate::spec::{Range, out_of_range};
use crate::units::{Density, Number, Pressure, Quantity, SurfaceEnergy, UnitError};
use alloc::string::String;
use alloc::vec::Vec;

macro_rules! properties {
    ($($(#[doc = $doc:literal])+ $variant:ident $field:ident $symbol:literal: $quantity:ty { $noun:literal, $range:expr })*) => {
        /// The properties a material may have.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum PropertyKind { $($(#[doc = $doc])+ $variant),* }

        impl PropertyKind {
            /// All of them, in the order of the documentation.
            pub const ALL: [Self; [$(stringify!($variant)),*].len()] = [$(Self::$variant),*];
            /// Their keys and symbols.
            pub(crate) const NAMES: &'static [&'static str] = &[$(stringify!($field), $symbol),*];
            /// Their symbols.
            pub(crate) const SYMBOLS: &'static [&'static str] = &[$($symbol),*];

            /// The key in a material file.
            pub fn key(self) -> &'static str {
                match self { $(Self::$variant => stringify!($field)),* }
            }

            /// The short key of an inline material: `rho`, `E`, `nu`, `gamma`, `sigma`, `H`, `sigma_t`.
            pub fn symbol(self) -> &'static str {
                match self { $(Self::$variant => $symbol),* }
            }

            /// Its name in words.
            pub fn noun(self) -> &'static str {
                match self { $(Self::$variant => $noun),* }
            }

            /// The SI unit, empty for a number.
            pub fn unit(self) -> &'static str {
                match self { $(Self::$variant => <$quantity>::SI),* }
            }

            /// What a value may be, SI units.
            pub fn range(self) -> Range {
                match self { $(Self::$variant => $range),* }
            }

            /// Reads a value with its unit.
            pub(crate) fn parse(self, text: &str) -> Result<f64, UnitError> {
                Ok(match self { $(Self::$variant => text.parse::<$quantity>()?.si()),* })
            }

            /// The value in SI units.
            pub(super) fn read(self, value: &crate::spec::Value) -> Result<f64, LawError> {
                Ok(match self { $(Self::$variant => value.quantity::<$quantity>(self.key())?.si()),* })
            }
        }

        impl Material {
            /// The property's nominal value in SI units, if known.
            pub fn value(&self, kind: PropertyKind) -> Option<f64> {
                match kind { $(PropertyKind::$variant => self.$field),* }
            }

            pub(super) fn slot(&mut self, kind: PropertyKind) -> &mut Option<f64> {
                match kind { $(PropertyKind::$variant => &mut self.$field),* }
            }
        }
    };
}

properties! {
    /// Density, kg/m³.
    Density density "rho": Density {
        "density", Range::within(50.0, 3e4, "a solid's density lies between 50 and 30000 kg/m3; a bare number is in kg/m3, 2.5 g/cm3 is written with its unit")
    }
    /// Young's modulus, Pa.
    YoungModulus young_modulus "E": Pressure {
        "Young's modulus", Range::within(1e6, 2e12, "a Young's modulus lies between 1 MPa (soft rubber) and 2 TPa (diamond has 1.1); a bare number is in Pa, 70 GPa is written with its unit")
    }
    /// Poisson's ratio.
    PoissonRatio poisson_ratio "nu": Number {
        "Poisson's ratio", Range::between(-1.0, 0.5, "Poisson's ratio of a compressible solid lies between -1 and 0.5")
    }
    /// Surface free energy, J/m².
    SurfaceEnergy surface_energy "gamma": SurfaceEnergy {
        "surface energy", Range::within(0.0, 20.0, "a surface energy lies between 0 and 20 J/m2; a bare number is in J/m2, 40 mJ/m2 is written with its unit")
    }
    /// Yield strength of a body that flows before it breaks, Pa.
    YieldStrength yield_strength "sigma": Pressure {
        "yield strength", Range::above(0.0, "a positive value is wanted")
    }
    /// Indentation hardness: mean pressure over the projected area of an indent, Pa.
    Hardness hardness "H": Pressure {
        "hardness", Range::above(0.0, "a positive value is wanted")
    }
    /// Stress at which a body that does not flow breaks in tension or bending, Pa. No law reads it.
    TensileStrength tensile_strength "sigma_t": Pressure {
        "tensile strength", Range::above(0.0, "a positive value is wanted")
    }
}

impl PropertyKind {
    /// The property of that key or symbol.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|k| k.key() == name || k.symbol() == name)
    }

    /// A value within its range.
    pub(super) fn check_value(self, value: f64) -> Result<(), LawError> {
        let range = self.range();
        if range.contains(value) { Ok(()) } else { Err(out_of_range(self.key(), value, self.unit(), &range)) }
    }

    /// Refuses impossible values: the value itself and both ends of its range.
    pub(super) fn check(self, property: &Property) -> Result<(), LawError> {
        for v in [Some(property.value), property.low, property.high].into_iter().flatten() {
            self.check_value(v)?;
        }
        let (value, low, high) =
            (property.value, property.low.unwrap_or(property.value), property.high.unwrap_or(property.value));
        if low > value || high < value {
            return Err(Problem::OutsideItsRange { key: self.key(), value, low, high }.into());
        }
        Ok(())
    }
}

/// A value with its range and where it comes from, SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Property {
    /// Nominal value.
    pub value: f64,
    /// Lower end of a printed range.
    pub low: Option<f64>,
    /// Upper end of a printed range.
    pub high: Option<f64>,
    /// Where the value comes from.
    pub source: Option<String>,
    /// What a usual value without a citable source rests on, in place of the source.
    pub typical: Option<String>,
    /// Why it was corrected, or how the nominal value was chosen.
    pub note: Option<String>,
    /// The value as printed in the source, where that is a misprint.
    pub printed: Option<String>,
    /// Other values found, with their sources.
    pub alternatives: Vec<Alternative>,
}

/// Another value of the same property.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Alternative {
    /// Value, or the middle of its range.
    pub value: Option<f64>,
    /// Lower end of a printed range.
    pub low: Option<f64>,
    /// Upper end of a printed range.
    pub high: Option<f64>,
    /// Where it comes from.
    pub source: Option<String>,
    /// A remark.
    pub note: Option<String>,
}
