//! Materials: density, Young's modulus, Poisson's ratio, surface energy, yield strength and hardness, each with its source.
//!
//! A [`Library`] holds materials by name and alias; the built-in one is embedded from `data/materials/*.toml`, and users
//! add their own in the same form. A property is a value with its unit, or a table that also says where it comes from:
//!
//! ```
//! use carom::material::Library;
//! let mut library = Library::builtin().clone();
//! library.extend_from_toml(r#"
//!     [material.my-steel]
//!     density = "7850 kg/m3"
//!     young_modulus = { value = "210 GPa", source = "data sheet" }
//!     poisson_ratio = 0.3
//! "#)?;
//! assert_eq!(library.get("my-steel")?.density, Some(7850.0));
//! assert!(library.get("my-steal").is_err_and(|e| e.to_string().contains("did you mean my-steel?")));
//! # Ok::<(), carom::LawError>(())
//! ```

mod inline;
mod library;
mod property;
mod read;

use alloc::borrow::ToOwned;
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
pub use library::Library;
pub use property::{Alternative, Property, PropertyKind};

use crate::error::LawError;

/// A material. Values in SI units; what is not known is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// Name in the library, or `inline`.
    pub name: String,
    /// Density, kg/m³.
    pub density: Option<f64>,
    /// Young's modulus, Pa.
    pub young_modulus: Option<f64>,
    /// Poisson's ratio.
    pub poisson_ratio: Option<f64>,
    /// Surface free energy, J/m².
    pub surface_energy: Option<f64>,
    /// Yield strength of a body that flows before it breaks, Pa.
    pub yield_strength: Option<f64>,
    /// Indentation hardness: mean pressure over the projected area of an indent, Pa.
    pub hardness: Option<f64>,
    /// Stress at which a body that does not flow breaks in tension or bending, Pa. No law reads it.
    pub tensile_strength: Option<f64>,
    /// What it is, in a line.
    pub description: String,
    /// Other names it answers to.
    pub aliases: Vec<String>,
    /// A remark on the whole entry.
    pub note: Option<String>,
    /// Everything known about each property: range, source, alternatives.
    pub properties: Vec<(PropertyKind, Property)>,
}

impl Material {
    /// Reads `rho=8000,E=190GPa,nu=0.27,gamma=1.62,sigma=310MPa`; what a law does not use may be left out.
    ///
    /// # Errors
    /// An unknown key, a wrong unit or an impossible value, named.
    ///
    /// ```
    /// let steel = carom::material::Material::from_inline("rho=8000,E=190GPa,nu=0.27")?;
    /// assert_eq!(steel.young_modulus, Some(190e9));
    /// # Ok::<(), carom::LawError>(())
    /// ```
    pub fn from_inline(text: &str) -> Result<Self, LawError> {
        inline::parse(text)
    }

    /// Everything known about a property: range, source, alternatives.
    pub fn property(&self, kind: PropertyKind) -> Option<&Property> {
        self.properties.iter().find(|(k, _)| *k == kind).map(|(_, p)| p)
    }

    /// A material of which nothing is known yet.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), ..Self::default() }
    }

    /// Adds a property in SI units; [`crate::spec::LawBuilder::build`] checks its range.
    #[must_use]
    pub fn with(mut self, kind: PropertyKind, value: f64) -> Self {
        self.properties.retain(|(k, _)| *k != kind);
        self.set(kind, Property { value, ..Property::default() });
        self
    }

    /// Each known value within its range.
    pub(crate) fn check(&self) -> Result<(), LawError> {
        PropertyKind::ALL.iter().filter_map(|k| Some((k, self.value(*k)?))).try_for_each(|(k, v)| k.check_value(v))
    }

    fn set(&mut self, kind: PropertyKind, property: Property) {
        *self.slot(kind) = Some(property.value);
        self.properties.push((kind, property));
    }
}

/// A material named in a law file: a library name (or the inline text of the command line), or an inline table.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialRef {
    /// A name, or `rho=...,E=...`.
    Name(String),
    /// Properties given on the spot.
    Inline(Box<Material>),
}

impl MaterialRef {
    /// The material itself.
    ///
    /// # Errors
    /// An unknown name, with the nearest known one; a bad inline text.
    pub fn resolve(&self, library: &Library) -> Result<Material, LawError> {
        match self {
            Self::Inline(material) => Ok((**material).clone()),
            Self::Name(text) if text.contains('=') => Material::from_inline(text),
            Self::Name(name) => library.get(name).cloned(),
        }
    }
}

impl core::str::FromStr for MaterialRef {
    type Err = LawError;
    fn from_str(text: &str) -> Result<Self, LawError> {
        if text.contains('=') {
            Material::from_inline(text).map(|m| Self::Inline(Box::new(m)))
        } else {
            Ok(Self::Name(text.to_owned()))
        }
    }
}

#[cfg(all(test, feature = "toml"))]
mod tests;
