//! How each kind of value is read from a text and what it becomes in the builder.

use super::curve::CurveSpec;
use super::keys::Key;
use super::value::Value;
use super::values::CurvatureRadius;
use super::{NormalKind, NormalSpec, TangentialKind};
use crate::error::{LawError, Problem};
use crate::material::{Library, Material, MaterialRef};
use crate::normal::Loss;
use crate::normal::empirical::Curve;
use crate::resolved::AdhesionMode;
use crate::roughness::RoughnessModel;
use crate::units::Quantity;
use alloc::borrow::ToOwned;
use alloc::boxed::Box;
use alloc::vec::Vec;

/// A value of a law's text.
pub(crate) trait Written: Sized {
    /// What the builder takes.
    type Built;
    /// SI unit; empty without one.
    const UNIT: &'static str = "";
    /// What is written, in a word.
    const WORD: &'static str;

    fn read(key: Key, value: &Value) -> Result<Self, LawError>;

    fn build(&self, key: Key, library: &Library) -> Result<Self::Built, LawError>;

    /// The number in SI units, if it is one.
    fn number(&self) -> Option<f64> {
        None
    }

    /// The value for a number in SI units, if it takes one.
    fn of_number(_: f64) -> Option<Self> {
        None
    }
}

/// A value in the builder.
pub(crate) trait Built {
    fn number(&self) -> Option<f64> {
        None
    }
}

impl Built for f64 {
    fn number(&self) -> Option<f64> {
        Some(*self)
    }
}
impl Built for Material {}
impl Built for NormalSpec {}
impl Built for Curve {
    fn number(&self) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            Self::ByAngle(_) => None,
        }
    }
}

impl<Q: Quantity> Written for Q {
    type Built = f64;
    const UNIT: &'static str = Q::SI;
    const WORD: &'static str = Q::WHAT;

    fn read(key: Key, value: &Value) -> Result<Self, LawError> {
        value.quantity(key.name())
    }
    fn build(&self, _: Key, _: &Library) -> Result<f64, LawError> {
        Ok(self.si())
    }
    fn number(&self) -> Option<f64> {
        Some(self.si())
    }
    fn of_number(value: f64) -> Option<Self> {
        Some(Self::from_si(value))
    }
}

impl Written for CurvatureRadius {
    type Built = f64;
    const UNIT: &'static str = "m";
    const WORD: &'static str = "length";

    fn read(key: Key, value: &Value) -> Result<Self, LawError> {
        let name = key.name();
        match (value, value.number()) {
            (Value::Text(text), _) => {
                text.parse().map_err(|error| Problem::WrongUnit { key: name.to_owned(), error }.into())
            }
            (_, Some(radius)) if !radius.is_nan() => Ok(Self(radius)),
            (_, Some(radius)) => Err(key.check(radius).err().unwrap_or_else(|| LawError::new("not a number"))),
            _ => Err(value.unfit(name, "a radius of curvature such as \"5 mm\", or \"inf\" for a flat surface,")),
        }
    }
    fn build(&self, _: Key, _: &Library) -> Result<f64, LawError> {
        Ok(self.0)
    }
    fn number(&self) -> Option<f64> {
        Some(self.0)
    }
    fn of_number(value: f64) -> Option<Self> {
        Some(Self(value))
    }
}

impl Written for MaterialRef {
    type Built = Material;
    const WORD: &'static str = "material";

    fn read(key: Key, value: &Value) -> Result<Self, LawError> {
        match value {
            Value::Text(text) => text.parse(),
            Value::Table(entries) => Material::from_entries("inline", entries).map(|m| Self::Inline(Box::new(m))),
            other => Err(other.unfit(key.name(), "a material's name, or a table of its properties,")),
        }
    }
    fn build(&self, key: Key, library: &Library) -> Result<Material, LawError> {
        // "inline" names no body: in messages it is the given sphere or surface
        let mut material = self.resolve(library)?;
        if material.name == "inline" {
            material.name = format!("given {}", key.name());
        }
        Ok(material)
    }
}

impl Written for CurveSpec {
    type Built = Curve;
    const WORD: &'static str = "restitution";

    fn read(key: Key, value: &Value) -> Result<Self, LawError> {
        Self::from_value(key, value)
    }
    fn build(&self, key: Key, _: &Library) -> Result<Curve, LawError> {
        self.resolve(key)
    }
    fn number(&self) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            _ => None,
        }
    }
    fn of_number(value: f64) -> Option<Self> {
        Some(Self::Constant(value))
    }
}

impl Written for NormalSpec {
    type Built = Self;
    const WORD: &'static str = "law";

    fn read(key: Key, value: &Value) -> Result<Self, LawError> {
        match value {
            Value::Text(text) => text.parse(),
            Value::List(items) => {
                let loss = |i: &super::At<Value>| {
                    i.value
                        .text(key.name(), "the name of a loss")
                        .and_then(str::parse::<Loss>)
                        .map_err(|e| e.at(i.span.clone()))
                };
                let losses = items.iter().map(loss).collect::<Result<Vec<_>, _>>()?;
                super::normal::check(&losses)?;
                Ok(Self::Losses(losses))
            }
            other => {
                Err(other
                    .unfit(key.name(), format!("a normal law ({}) or a list of losses", NormalKind::NAMES.join(", "))))
            }
        }
    }
    fn build(&self, _: Key, _: &Library) -> Result<Self, LawError> {
        Ok(self.clone())
    }
}

macro_rules! chosen_by_name {
    ($($type:ty: $word:literal),*) => {$(
        impl Built for $type {}

        impl Written for $type {
            type Built = Self;
            const WORD: &'static str = $word;

            fn read(key: Key, value: &Value) -> Result<Self, LawError> {
                value.text(key.name(), &format!("one of {}", Self::NAMES.join(", ")))?.parse()
            }
            fn build(&self, _: Key, _: &Library) -> Result<Self, LawError> {
                Ok(*self)
            }
        }
    )*};
}

chosen_by_name! { AdhesionMode: "mode", TangentialKind: "law", RoughnessModel: "model" }
