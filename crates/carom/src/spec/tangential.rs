//! The tangential part of a law.

use super::check::{checked, form_fits, need, not_negative};
use super::curve::Which;
use super::{LawSpec, TangentialKind};
use crate::error::SpecError;
use crate::pair::Pair;
use crate::wall::Along;

impl LawSpec {
    pub(super) fn tangential_law(&self, pair: Option<&Pair>) -> Result<Along, SpecError> {
        let kind = self.tangential.as_ref().map(|t| t.value).unwrap_or_else(|| match &self.tangential_restitution {
            None => TangentialKind::Rolling,
            Some(at) if at.value.is_constant() => TangentialKind::Constant,
            Some(_) => TangentialKind::ByAngle,
        });
        let place = self.tangential.as_ref().and_then(|t| t.span.clone());
        let friction = || {
            checked(&self.friction, "friction", |f| f.0, not_negative, "zero or more is wanted")?.ok_or_else(|| {
                need("a friction coefficient for oblique impacts", "friction = 0.2, say").at(place.clone())
            })
        };
        if let (Some(at), true) = (
            &self.tangential_restitution,
            matches!(kind, TangentialKind::Rolling | TangentialKind::Walton | TangentialKind::MicroSlip),
        ) {
            return Err(SpecError::new(format!(
                "tangential_restitution has no effect with tangential = \"{}\"",
                kind.name()
            ))
            .help("write tangential = \"constant\" or \"by-angle\", or leave it out")
            .at(at.span.clone()));
        }
        Ok(match kind {
            TangentialKind::Rolling => Along::Friction { friction: friction()?, beta: 0.0 },
            TangentialKind::Walton => {
                let beta = checked(
                    &self.walton_beta,
                    "walton_beta",
                    |b| b.0,
                    |b| (0.0..=1.0).contains(&b),
                    "it lies between 0 (rolling) and 1 (slip reversed)",
                )?
                .ok_or_else(|| need("Walton's beta", "walton_beta = 0.4, say").at(place.clone()))?;
                Along::Friction { friction: friction()?, beta }
            }
            TangentialKind::MicroSlip => {
                let friction = friction()?;
                let ratio = pair
                    .ok_or_else(|| need("a sphere and a surface for micro-slip", "both, with their E and nu"))
                    .and_then(Pair::stiffness_ratio)
                    .map_err(|e| e.at(place))?;
                Along::MicroSlip { friction, stiffness_ratio: ratio }
            }
            TangentialKind::Constant | TangentialKind::ByAngle => {
                let at = self
                    .tangential_restitution
                    .as_ref()
                    .ok_or_else(|| need("a tangential restitution", "tangential_restitution = 0.9, say").at(place))?;
                form_fits(kind == TangentialKind::Constant, at, "tangential")?;
                Along::Curve(at.value.resolve(Which::Tangential).map_err(|e| e.at(at.span.clone()))?)
            }
        })
    }
}
