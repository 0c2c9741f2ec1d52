//! A law into its text form and into any serde format, and back. Quantities are bare SI numbers.

use super::{At, CurvatureRadius, CurveSpec, Key, LawSpec, NormalSpec, Value};
use crate::material::MaterialRef;
use crate::normal::empirical::Form;
use serde::de::{Deserialize, Deserializer, Error as _};
use serde::{Serialize, Serializer};

#[cfg(feature = "toml")]
impl LawSpec {
    /// The law as a text with one table, `[law.NAME]`.
    ///
    /// # Errors
    /// None in practice.
    ///
    /// ```
    /// use carom::spec::{parse_law, parse_named_law};
    /// let law = parse_law("sphere = \"copper\"\nsurface = \"glass\"\nnormal = \"ea\"\nhertz_damping = \"7 ms/m\"\n")?;
    /// let text = law.to_toml("glass")?;
    /// assert!(text.starts_with("[law.glass]\nsphere = \"copper\"\n") && text.contains("hertz_damping = 0.007"));
    /// assert_eq!(parse_named_law(&text, "glass")?.to_toml("glass")?, text);
    /// # Ok::<(), carom::LawError>(())
    /// ```
    pub fn to_toml(&self, name: &str) -> Result<String, crate::LawError> {
        use std::collections::BTreeMap;
        #[derive(Serialize)]
        struct File<'a> {
            law: BTreeMap<&'a str, &'a LawSpec>,
        }
        let file = File { law: BTreeMap::from([(name, self)]) };
        toml::to_string(&file).map_err(|e| crate::LawError::new(format!("law {name}: {e}")))
    }
}

/// From any format; places are known only to [`super::parse_law`] and its like.
impl<'de> Deserialize<'de> for LawSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Value::deserialize(deserializer)? {
            Value::Table(entries) => Self::from_entries(&entries).map_err(D::Error::custom),
            other => Err(D::Error::custom(other.unfit("law", "a table of a law's keys"))),
        }
    }
}

impl<'de> Deserialize<'de> for CurveSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        Self::from_value(Key::Restitution, &value).map_err(D::Error::custom)
    }
}

impl<'de> Deserialize<'de> for CurvatureRadius {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        use super::written::Written as _;
        Self::read(Key::SurfaceCurvature, &Value::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

impl Serialize for Key {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<T: Serialize> Serialize for At<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

impl Serialize for CurvatureRadius {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // not every format has infinity
        if self.0 == f64::INFINITY { serializer.serialize_str("inf") } else { serializer.serialize_f64(self.0) }
    }
}

impl Serialize for NormalSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Named(kind) => serializer.serialize_str(kind.name()),
            Self::Losses(losses) => serializer.collect_seq(losses.iter().map(|l| l.name())),
        }
    }
}

impl Serialize for MaterialRef {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Name(name) => serializer.serialize_str(name),
            Self::Inline(material) => {
                serializer.collect_map(material.properties.iter().map(|(kind, p)| (kind.key(), p.value)))
            }
        }
    }
}

/// A piece of a curve.
#[derive(Serialize)]
struct Piece<'a> {
    from_deg: f64,
    to_deg: f64,
    polynomial: &'a [f64],
}

impl Serialize for CurveSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Constant(value) => serializer.serialize_f64(*value),
            Self::Named(name) => serializer.serialize_str(name),
            Self::ByAngle(table) => match table.form() {
                Form::Polynomial(coefficients) => serializer.collect_map([("polynomial", coefficients)]),
                Form::Linear(degrees, values) => serializer.collect_map([("angle_deg", degrees), ("value", values)]),
                Form::Pieces(pieces) => {
                    let pieces: Vec<Piece<'_>> = pieces
                        .iter()
                        .map(|(from, to, polynomial)| Piece { from_deg: *from, to_deg: *to, polynomial })
                        .collect();
                    serializer.collect_map([("pieces", pieces)])
                }
            },
        }
    }
}
