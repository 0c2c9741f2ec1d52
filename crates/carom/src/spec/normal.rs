//! `normal = "ea"`, or a list of losses.

use super::values;
use crate::error::SpecError;
use crate::normal::Loss;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use std::fmt;

/// Normal laws by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalKind {
    /// `ea`: adhesion work with both dampings.
    Ea,
    /// `eap`: Kadomtsev's plastic loss with adhesion work (and damping, if coefficients are given).
    Eap,
    /// `thornton-ning`: their plastic loss with JKR adhesion.
    ThorntonNing,
    /// `tabor`: Tabor's plastic loss alone.
    Tabor,
    /// `constant`
    Constant,
    /// `by-angle`
    ByAngle,
    /// `resolved`
    Resolved,
}

values::names! {
    NormalKind, "normal law",
    "ea" => Ea, "eap" => Eap, "thornton-ning" => ThorntonNing, "tabor" => Tabor,
    "constant" => Constant, "by-angle" => ByAngle, "resolved" => Resolved,
}

impl std::str::FromStr for Loss {
    type Err = SpecError;
    fn from_str(text: &str) -> Result<Self, SpecError> {
        let names: Vec<&str> = Self::ALL.iter().map(|l| l.name()).collect();
        Self::ALL.iter().copied().find(|l| l.name() == text).ok_or_else(|| values::unknown_name("loss", text, &names))
    }
}

/// A normal law as written.
#[derive(Clone, Debug, PartialEq)]
pub enum NormalSpec {
    /// By name.
    Named(NormalKind),
    /// A list of losses.
    Losses(Vec<Loss>),
}

impl std::str::FromStr for NormalSpec {
    type Err = SpecError;
    fn from_str(text: &str) -> Result<Self, SpecError> {
        if let Ok(loss) = text.parse::<Loss>() {
            return Err(SpecError::new(format!("'{text}' is a loss, not a law"))
                .help(format!("a list of losses is a law: normal = [\"{}\"]", loss.name())));
        }
        text.parse().map(Self::Named)
    }
}

impl<'de> Deserialize<'de> for NormalSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrList;
        impl<'de> Visitor<'de> for NameOrList {
            type Value = NormalSpec;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a normal law ({}) or a list of losses", NormalKind::NAMES.join(", "))
            }
            fn visit_str<E: de::Error>(self, v: &str) -> Result<NormalSpec, E> {
                v.parse().map_err(E::custom)
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<NormalSpec, A::Error> {
                let mut losses = Vec::new();
                while let Some(name) = seq.next_element::<String>()? {
                    losses.push(name.parse().map_err(de::Error::custom)?);
                }
                check(&losses).map_err(de::Error::custom)?;
                Ok(NormalSpec::Losses(losses))
            }
        }
        deserializer.deserialize_any(NameOrList)
    }
}

/// At least one loss, and no two of a kind.
pub(super) fn check(losses: &[Loss]) -> Result<(), SpecError> {
    if losses.is_empty() {
        return Err(SpecError::new("an empty list of losses")
            .help("for a lossless wall write normal = \"constant\", restitution = 1"));
    }
    for (i, loss) in losses.iter().enumerate() {
        if let Some(other) = losses.iter().take(i).find(|o| o.kind() == loss.kind()) {
            return Err(two_of_a_kind(*other, *loss));
        }
    }
    Ok(())
}

/// Two losses that would take the same energy.
pub(super) fn two_of_a_kind(first: Loss, second: Loss) -> SpecError {
    let both = if first == second {
        format!("'{}' twice", first.name())
    } else {
        format!("both '{}' and '{}'", first.name(), second.name())
    };
    SpecError::new(format!("{both}: the same energy would be counted twice")).help(format!("keep one {}", first.kind()))
}
