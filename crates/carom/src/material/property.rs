//! One property of a material: value, range, source, alternatives; and the ranges each may have.

use crate::error::SpecError;
use crate::units::{Density, Number, Pressure, SurfaceEnergy};
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor, value};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

/// The properties a material may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PropertyKind {
    /// Density, kg/m³.
    Density,
    /// Young's modulus, Pa.
    YoungModulus,
    /// Poisson's ratio.
    PoissonRatio,
    /// Surface free energy, J/m².
    SurfaceEnergy,
    /// Yield strength of a body that flows before it breaks, Pa.
    YieldStrength,
    /// Indentation hardness: mean pressure over the projected area of an indent, Pa.
    Hardness,
    /// Stress at which a body that does not flow breaks in tension or bending, Pa. No law reads it.
    TensileStrength,
}

impl PropertyKind {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Self; 7] = [
        Self::Density,
        Self::YoungModulus,
        Self::PoissonRatio,
        Self::SurfaceEnergy,
        Self::YieldStrength,
        Self::Hardness,
        Self::TensileStrength,
    ];

    /// The key in a material file.
    pub fn key(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::YoungModulus => "young_modulus",
            Self::PoissonRatio => "poisson_ratio",
            Self::SurfaceEnergy => "surface_energy",
            Self::YieldStrength => "yield_strength",
            Self::Hardness => "hardness",
            Self::TensileStrength => "tensile_strength",
        }
    }

    /// The short key of an inline material.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Density => "rho",
            Self::YoungModulus => "E",
            Self::PoissonRatio => "nu",
            Self::SurfaceEnergy => "gamma",
            Self::YieldStrength => "sigma",
            Self::Hardness => "H",
            Self::TensileStrength => "sigma_t",
        }
    }

    /// The SI unit, empty for a number.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Density => Density::SI,
            Self::PoissonRatio => "",
            Self::SurfaceEnergy => SurfaceEnergy::SI,
            _ => Pressure::SI,
        }
    }

    /// Refuses impossible values: the value itself and both ends of its range.
    pub(super) fn check(self, property: &Property) -> Result<(), SpecError> {
        let numbers = [Some(property.value), property.low, property.high];
        for v in numbers.into_iter().flatten() {
            let (fine, right) = match self {
                Self::SurfaceEnergy => (v >= 0.0, "zero or more is wanted"),
                Self::PoissonRatio => {
                    (v > -1.0 && v < 0.5, "Poisson's ratio of a compressible solid lies between -1 and 0.5")
                }
                _ => (v > 0.0, "a positive value is wanted"),
            };
            if !(fine && v.is_finite()) {
                let unit = if self.unit().is_empty() { String::new() } else { format!(" {}", self.unit()) };
                return Err(SpecError::new(format!("{} = {v}{unit} is out of range", self.key())).help(right));
            }
        }
        let (low, high) = (property.low.unwrap_or(property.value), property.high.unwrap_or(property.value));
        if low > property.value || high < property.value {
            return Err(SpecError::new(format!(
                "{}: {} is outside its range {low} to {high}",
                self.key(),
                property.value
            ))
            .help("the nominal value lies between both ends"));
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

/// A property as written: a bare quantity or a table.
#[derive(Debug)]
pub(super) struct Written<Q> {
    value: Q,
    low: Option<Q>,
    high: Option<Q>,
    source: Option<String>,
    note: Option<String>,
    printed: Option<String>,
    alternatives: Vec<WrittenAlternative<Q>>,
    pub(super) span: Option<Range<usize>>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenAlternative<Q> {
    value: Option<Q>,
    low: Option<Q>,
    high: Option<Q>,
    source: Option<String>,
    note: Option<String>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenTable<Q> {
    value: toml::Spanned<Q>,
    low: Option<Q>,
    high: Option<Q>,
    source: Option<String>,
    note: Option<String>,
    printed: Option<String>,
    #[serde(default = "Vec::new")]
    alternatives: Vec<WrittenAlternative<Q>>,
}

impl<Q> Written<Q> {
    fn bare(value: Q) -> Self {
        Self {
            value,
            low: None,
            high: None,
            source: None,
            note: None,
            printed: None,
            alternatives: Vec::new(),
            span: None,
        }
    }

    pub(super) fn map<T>(self, f: impl Fn(Q) -> T) -> Written<T> {
        let alternatives = self
            .alternatives
            .into_iter()
            .map(|a| WrittenAlternative {
                value: a.value.map(&f),
                low: a.low.map(&f),
                high: a.high.map(&f),
                source: a.source,
                note: a.note,
            })
            .collect();
        Written {
            value: f(self.value),
            low: self.low.map(&f),
            high: self.high.map(&f),
            source: self.source,
            note: self.note,
            printed: self.printed,
            alternatives,
            span: self.span,
        }
    }
}

impl From<Written<f64>> for Property {
    fn from(w: Written<f64>) -> Self {
        let alternatives = w
            .alternatives
            .into_iter()
            .map(|a| Alternative { value: a.value, low: a.low, high: a.high, source: a.source, note: a.note })
            .collect();
        Self {
            value: w.value,
            low: w.low,
            high: w.high,
            source: w.source,
            note: w.note,
            printed: w.printed,
            alternatives,
        }
    }
}

impl<'de, Q: Deserialize<'de>> Deserialize<'de> for Written<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct QuantityOrTable<Q>(PhantomData<Q>);
        impl<'de, Q: Deserialize<'de>> Visitor<'de> for QuantityOrTable<Q> {
            type Value = Written<Q>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a quantity, or a table { value, low, high, source, note }")
            }
            fn visit_str<E: serde::de::Error>(self, v: &str) -> Result<Self::Value, E> {
                Q::deserialize(value::StrDeserializer::new(v)).map(Written::bare)
            }
            fn visit_f64<E: serde::de::Error>(self, v: f64) -> Result<Self::Value, E> {
                Q::deserialize(value::F64Deserializer::new(v)).map(Written::bare)
            }
            fn visit_i64<E: serde::de::Error>(self, v: i64) -> Result<Self::Value, E> {
                Q::deserialize(value::I64Deserializer::new(v)).map(Written::bare)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let t = WrittenTable::<Q>::deserialize(value::MapAccessDeserializer::new(map))?;
                let span = t.value.span();
                Ok(Written {
                    value: t.value.into_inner(),
                    low: t.low,
                    high: t.high,
                    source: t.source,
                    note: t.note,
                    printed: t.printed,
                    alternatives: t.alternatives,
                    span: Some(span),
                })
            }
        }
        deserializer.deserialize_any(QuantityOrTable(PhantomData))
    }
}

/// A property, a bare value checked in its place; a table knows the place of its value and is checked later.
fn checked<'de, D: Deserializer<'de>, Q: Deserialize<'de> + Copy>(
    kind: PropertyKind,
    si: impl Fn(Q) -> f64,
    deserializer: D,
) -> Result<Option<Written<Q>>, D::Error> {
    let written = Written::<Q>::deserialize(deserializer)?;
    if written.span.is_none() {
        kind.check(&Property { value: si(written.value), ..Property::default() }).map_err(serde::de::Error::custom)?;
    }
    Ok(Some(written))
}

macro_rules! checked_by_kind {
    ($($name:ident: $quantity:ty = $kind:ident),* $(,)?) => {$(
        fn $name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Written<$quantity>>, D::Error> {
            checked(PropertyKind::$kind, |q: $quantity| q.0, deserializer)
        }
    )*};
}

checked_by_kind! {
    density: Density = Density, young_modulus: Pressure = YoungModulus, poisson_ratio: Number = PoissonRatio,
    surface_energy: SurfaceEnergy = SurfaceEnergy, yield_strength: Pressure = YieldStrength,
    hardness: Pressure = Hardness, tensile_strength: Pressure = TensileStrength,
}

/// The keys of a material table; the short symbols of the command line are accepted too.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Fields {
    pub description: Option<String>,
    #[serde(default)]
    pub aliases: Vec<String>,
    pub note: Option<String>,
    #[serde(default, alias = "rho", deserialize_with = "density")]
    pub density: Option<Written<Density>>,
    #[serde(default, alias = "E", deserialize_with = "young_modulus")]
    pub young_modulus: Option<Written<Pressure>>,
    #[serde(default, alias = "nu", deserialize_with = "poisson_ratio")]
    pub poisson_ratio: Option<Written<Number>>,
    #[serde(default, alias = "gamma", deserialize_with = "surface_energy")]
    pub surface_energy: Option<Written<SurfaceEnergy>>,
    #[serde(default, alias = "sigma", deserialize_with = "yield_strength")]
    pub yield_strength: Option<Written<Pressure>>,
    #[serde(default, alias = "H", deserialize_with = "hardness")]
    pub hardness: Option<Written<Pressure>>,
    #[serde(default, alias = "sigma_t", deserialize_with = "tensile_strength")]
    pub tensile_strength: Option<Written<Pressure>>,
}
