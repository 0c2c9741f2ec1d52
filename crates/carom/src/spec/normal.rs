//! `normal = "ea"`, or a list of losses.

use super::values;
use crate::error::{LawError, Problem};
use crate::normal::Loss;
use alloc::vec::Vec;

/// Normal laws by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NormalKind {
    /// `ea`: adhesion work with both dampings.
    Ea,
    /// `eap`: Kadomtsev's plastic loss with adhesion work (and damping, if coefficients are given).
    Eap,
    /// `thornton-ning`: their plastic loss with JKR adhesion.
    ThorntonNing,
    /// `tabor`: Tabor's plastic loss alone.
    Tabor,
    /// `dahneke`: a given restitution with an adhesion well.
    Dahneke,
    /// `constant`
    Constant,
    /// `by-angle`
    ByAngle,
    /// `resolved`
    Resolved,
}

values::names! {
    NormalKind, "normal law",
    "ea" => Ea, "eap" => Eap, "thornton-ning" => ThorntonNing, "tabor" => Tabor, "dahneke" => Dahneke,
    "constant" => Constant, "by-angle" => ByAngle, "resolved" => Resolved,
}

impl core::str::FromStr for Loss {
    type Err = LawError;
    fn from_str(text: &str) -> Result<Self, LawError> {
        let names: Vec<&str> = Self::ALL.iter().map(|l| l.name()).collect();
        Self::ALL
            .iter()
            .copied()
            .find(|l| l.name().eq_ignore_ascii_case(text))
            .ok_or_else(|| values::unknown_name("loss", text, &names))
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

impl From<NormalKind> for NormalSpec {
    fn from(kind: NormalKind) -> Self {
        Self::Named(kind)
    }
}

impl From<Vec<Loss>> for NormalSpec {
    fn from(losses: Vec<Loss>) -> Self {
        Self::Losses(losses)
    }
}

impl<const N: usize> From<[Loss; N]> for NormalSpec {
    fn from(losses: [Loss; N]) -> Self {
        Self::Losses(losses.into())
    }
}

impl core::str::FromStr for NormalSpec {
    type Err = LawError;
    fn from_str(text: &str) -> Result<Self, LawError> {
        if let Ok(loss) = text.parse::<Loss>() {
            return Err(Problem::LossAlone { loss }.into());
        }
        text.parse().map(Self::Named)
    }
}

/// At least one loss, and no two of a kind.
pub(super) fn check(losses: &[Loss]) -> Result<(), LawError> {
    if losses.is_empty() {
        return Err(Problem::NoLosses.into());
    }
    for (i, loss) in losses.iter().enumerate() {
        if let Some(other) = losses.iter().take(i).find(|o| o.kind() == loss.kind()) {
            return Err(Problem::LossesOverlap { first: *other, second: *loss }.into());
        }
    }
    Ok(())
}
