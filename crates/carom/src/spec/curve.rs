//! `restitution = 0.7`, `"grant-tabakoff"`, `{ polynomial = [...] }`, `{ angle_deg = [...], value = [...] }` or `{ pieces = [...] }`.

use crate::error::SpecError;
use crate::normal::empirical::{AngleTable, Curve};
use crate::units::Number;
use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor, value};
use std::fmt;

/// A restitution as written: a number or a curve by angle of incidence, already checked for its form.
#[derive(Clone, Debug, PartialEq)]
pub enum CurveSpec {
    /// A number.
    Constant(f64),
    /// A curve.
    ByAngle(AngleTable),
    /// The name of a curve that comes with carom.
    Named(String),
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    polynomial: Option<Vec<f64>>,
    angle_deg: Option<Vec<f64>>,
    value: Option<Vec<f64>>,
    pieces: Option<Vec<PieceSpec>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct PieceSpec {
    from_deg: f64,
    to_deg: f64,
    polynomial: Vec<f64>,
}

const FORMS: &str = "write { polynomial = [...] } (angle from the surface, radians), { angle_deg = [...], value = [...] } or { pieces = [{ from_deg, to_deg, polynomial }] }";

impl Table {
    fn read(self) -> Result<AngleTable, SpecError> {
        match (self.polynomial, self.angle_deg, self.value, self.pieces) {
            (Some(c), None, None, None) => AngleTable::polynomial(&c),
            (None, Some(a), Some(v), None) => AngleTable::piecewise_linear(&a, &v),
            (None, None, None, Some(p)) => {
                let pieces: Vec<_> = p.into_iter().map(|p| (p.from_deg, p.to_deg, p.polynomial)).collect();
                AngleTable::piecewise_polynomial(&pieces)
            }
            _ => Err(SpecError::new("a curve takes exactly one form").help(FORMS)),
        }
    }
}

impl<'de> Deserialize<'de> for CurveSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberOrCurve;
        impl<'de> Visitor<'de> for NumberOrCurve {
            type Value = CurveSpec;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a number between 0 and 1, the name of a curve, or a curve: {FORMS}")
            }
            fn visit_str<E: de::Error>(self, v: &str) -> Result<CurveSpec, E> {
                Ok(v.parse::<Number>().map_or_else(|_| CurveSpec::Named(v.to_owned()), |n| CurveSpec::Constant(n.0)))
            }
            fn visit_f64<E: de::Error>(self, v: f64) -> Result<CurveSpec, E> {
                Ok(CurveSpec::Constant(v))
            }
            fn visit_i64<E: de::Error>(self, v: i64) -> Result<CurveSpec, E> {
                Ok(CurveSpec::Constant(v as f64))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<CurveSpec, A::Error> {
                Table::deserialize(value::MapAccessDeserializer::new(map))?
                    .read()
                    .map(CurveSpec::ByAngle)
                    .map_err(de::Error::custom)
            }
        }
        deserializer.deserialize_any(NumberOrCurve)
    }
}

/// Curves that come with carom: name, file.
const BUILTIN: &[(&str, &str)] = &[("grant-tabakoff", include_str!("../../data/curves/grant-tabakoff-1975.toml"))];

#[derive(serde::Deserialize)]
struct CurveFile {
    normal: CurveSpec,
    tangential: CurveSpec,
}

/// Which of a named pair of curves is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Which {
    Normal,
    Tangential,
}

impl CurveSpec {
    /// The curve, with its values checked: e in [0, 1], e_t in [−1, 1].
    pub(super) fn resolve(&self, which: Which) -> Result<Curve, SpecError> {
        let low = if which == Which::Normal { 0.0 } else { -1.0 };
        let curve = match self {
            Self::Constant(value) => {
                if !(*value >= low && *value <= 1.0) {
                    return Err(
                        SpecError::new(format!("restitution {value}")).help(format!("it lies between {low} and 1"))
                    );
                }
                Curve::Constant(*value)
            }
            Self::ByAngle(table) => Curve::ByAngle(table.clone()),
            Self::Named(name) => return named(name)?.pick(which).resolve(which),
        };
        if let Curve::ByAngle(table) = &curve {
            table.check_range(low, 1.0)?;
        }
        Ok(curve)
    }

    pub(super) fn is_constant(&self) -> bool {
        matches!(self, Self::Constant(_))
    }
}

impl CurveFile {
    fn pick(self, which: Which) -> CurveSpec {
        if which == Which::Normal { self.normal } else { self.tangential }
    }
}

fn named(name: &str) -> Result<CurveFile, SpecError> {
    let names: Vec<&str> = BUILTIN.iter().map(|b| b.0).collect();
    match BUILTIN.iter().find(|b| b.0 == name) {
        Some((_, text)) => toml::from_str(text).map_err(SpecError::from),
        None => Err(super::values::unknown_name("curve", name, &names)),
    }
}
