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
//! # Ok::<(), carom::SpecError>(())
//! ```

mod inline;
mod library;
mod property;

pub use library::Library;
pub use property::{Alternative, Property, PropertyKind};

use crate::error::SpecError;
use property::Fields;
use serde::Deserialize as _;

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
    /// # Ok::<(), carom::SpecError>(())
    /// ```
    pub fn from_inline(text: &str) -> Result<Self, SpecError> {
        inline::parse(text)
    }

    /// The nominal value of a property, if known.
    pub fn value(&self, kind: PropertyKind) -> Option<f64> {
        match kind {
            PropertyKind::Density => self.density,
            PropertyKind::YoungModulus => self.young_modulus,
            PropertyKind::PoissonRatio => self.poisson_ratio,
            PropertyKind::SurfaceEnergy => self.surface_energy,
            PropertyKind::YieldStrength => self.yield_strength,
            PropertyKind::Hardness => self.hardness,
            PropertyKind::TensileStrength => self.tensile_strength,
        }
    }

    /// Everything known about a property: range, source, alternatives.
    pub fn property(&self, kind: PropertyKind) -> Option<&Property> {
        self.properties.iter().find(|(k, _)| *k == kind).map(|(_, p)| p)
    }

    fn from_fields(name: &str, fields: Fields) -> Result<Self, SpecError> {
        let mut material = Self {
            name: name.to_owned(),
            description: fields.description.unwrap_or_default(),
            aliases: fields.aliases,
            note: fields.note,
            ..Self::default()
        };
        let read = [
            (PropertyKind::Density, fields.density.map(|p| p.map(|q| q.0))),
            (PropertyKind::YoungModulus, fields.young_modulus.map(|p| p.map(|q| q.0))),
            (PropertyKind::PoissonRatio, fields.poisson_ratio.map(|p| p.map(|q| q.0))),
            (PropertyKind::SurfaceEnergy, fields.surface_energy.map(|p| p.map(|q| q.0))),
            (PropertyKind::YieldStrength, fields.yield_strength.map(|p| p.map(|q| q.0))),
            (PropertyKind::Hardness, fields.hardness.map(|p| p.map(|q| q.0))),
            (PropertyKind::TensileStrength, fields.tensile_strength.map(|p| p.map(|q| q.0))),
        ];
        for (kind, property) in read {
            if let Some(property) = property {
                let span = property.span.clone();
                let property: Property = property.into();
                kind.check(&property).map_err(|e| e.at(span))?;
                material.set(kind, property);
            }
        }
        Ok(material)
    }

    fn set(&mut self, kind: PropertyKind, property: Property) {
        let value = Some(property.value);
        match kind {
            PropertyKind::Density => self.density = value,
            PropertyKind::YoungModulus => self.young_modulus = value,
            PropertyKind::PoissonRatio => self.poisson_ratio = value,
            PropertyKind::SurfaceEnergy => self.surface_energy = value,
            PropertyKind::YieldStrength => self.yield_strength = value,
            PropertyKind::Hardness => self.hardness = value,
            PropertyKind::TensileStrength => self.tensile_strength = value,
        }
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
    pub fn resolve(&self, library: &Library) -> Result<Material, SpecError> {
        match self {
            Self::Inline(material) => Ok((**material).clone()),
            Self::Name(text) if text.contains('=') => Material::from_inline(text),
            Self::Name(name) => library.get(name).cloned(),
        }
    }
}

impl std::str::FromStr for MaterialRef {
    type Err = SpecError;
    fn from_str(text: &str) -> Result<Self, SpecError> {
        if text.contains('=') {
            Material::from_inline(text).map(|m| Self::Inline(Box::new(m)))
        } else {
            Ok(Self::Name(text.to_owned()))
        }
    }
}

impl<'de> serde::Deserialize<'de> for MaterialRef {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;
        impl<'de> serde::de::Visitor<'de> for NameOrTable {
            type Value = MaterialRef;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a material's name, or a table of its properties")
            }
            fn visit_str<E: serde::de::Error>(self, v: &str) -> Result<MaterialRef, E> {
                v.parse().map_err(E::custom)
            }
            fn visit_map<A: serde::de::MapAccess<'de>>(self, map: A) -> Result<MaterialRef, A::Error> {
                let fields = Fields::deserialize(serde::de::value::MapAccessDeserializer::new(map))?;
                Material::from_fields("inline", fields)
                    .map(|m| MaterialRef::Inline(Box::new(m)))
                    .map_err(serde::de::Error::custom)
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}

#[cfg(test)]
mod tests;
