//! From checked values to a law: each part's constants.

use super::keys::LawBuilder;
use super::uses::Choice;
use super::{Key, NormalKind, NormalSpec, TangentialKind};
use crate::curvature::Curvature;
use crate::error::{LawError, Problem};
use crate::normal::adhesion::Work;
use crate::normal::empirical::Curve;
use crate::normal::ledger::TwoOfAKind;
use crate::normal::{Inputs, Ledger, Loss, NormalLaw};
use crate::pair::Pair;
use crate::resolved::{Damping, Resolved};
use crate::roughness::{self, CALIBRATED_ROUGHNESS, CALIBRATED_SPACING, RoughnessModel, fuller_tabor};
use crate::scatter::Scatter;
use crate::validity::Validity;
use crate::wall::{About, Along, Normal, Parts, WallLaw};
use alloc::vec::Vec;

/// The law of a builder whose values are within their ranges and whose keys are all read.
pub(super) fn law(b: &LawBuilder, spec: &NormalSpec, pair: Option<Pair>) -> Result<WallLaw, LawError> {
    let adheres = !spec.is_table();
    let (factor, extrapolated) = roughness_factor(b, pair.as_ref().filter(|_| adheres))?;
    let normal = normal_law(b, spec, pair.as_ref(), factor).map_err(|e| e.blame(Key::Normal))?;
    let tangential = tangential_law(b, pair.as_ref()).map_err(|e| e.blame(Key::Tangential))?;
    let uses_roughness = matches!(&normal, Normal::Compiled(law) if law.uses_roughness());
    Ok(WallLaw::new(Parts {
        normal,
        tangential,
        curvature: b.surface_curvature.map_or(Curvature::FLAT, Curvature::sphere),
        scatter: b.roughness_angle.filter(|a| *a > 0.0).map(Scatter::new),
        validity: Validity::ROUGHNESS_EXTRAPOLATED.when(extrapolated && uses_roughness),
        about: About {
            pair,
            roughness: b.roughness,
            asperity_radius: match b.roughness_model {
                Some(RoughnessModel::FullerTabor) if b.roughness_factor.is_none() => b.number(Key::AsperityRadius),
                _ => None,
            },
            roughness_factor: factor,
            spacing: b.equilibrium_spacing.unwrap_or(CALIBRATED_SPACING),
        },
    }))
}

/// C_R: given, or from the roughness by its model, or 1; and whether it lies beyond its curve's calibration.
fn roughness_factor(b: &LawBuilder, pair: Option<&Pair>) -> Result<(f64, bool), LawError> {
    let spacing = b.equilibrium_spacing.unwrap_or(CALIBRATED_SPACING);
    match (b.roughness_factor, b.roughness) {
        (Some(factor), _) => Ok((factor, false)),
        (None, None) => Ok((1.0, false)),
        (None, Some(height)) => match b.roughness_model.unwrap_or_default() {
            RoughnessModel::FullerTabor => Ok((fuller_tabor(b, height, pair)?, false)),
            RoughnessModel::Rabinovich => Ok((roughness::factor(height, spacing), height > CALIBRATED_ROUGHNESS)),
        },
    }
}

/// Fuller & Tabor's C_R needs the pair; where there is none, nothing adheres.
fn fuller_tabor(b: &LawBuilder, height: f64, pair: Option<&Pair>) -> Result<f64, LawError> {
    let radius = b.needed(Key::AsperityRadius, Choice::RoughnessModel(RoughnessModel::FullerTabor))?;
    let Some(pair) = pair else { return Ok(1.0) };
    let blame = |e: LawError| e.blame(Key::RoughnessModel);
    let (w, e_star) = (pair.work_of_adhesion().map_err(blame)?, pair.effective_modulus().map_err(blame)?);
    if w <= 0.0 {
        return Ok(1.0);
    }
    Ok(fuller_tabor::factor(fuller_tabor::adhesion_parameter(height, radius, w, e_star)))
}

fn normal_law(b: &LawBuilder, spec: &NormalSpec, pair: Option<&Pair>, factor: f64) -> Result<Normal, LawError> {
    match spec {
        NormalSpec::Named(kind @ (NormalKind::Constant | NormalKind::ByAngle)) => {
            let curve = given_curve(&b.restitution, Key::Restitution, Choice::Normal(*kind))?;
            form_fits(*kind == NormalKind::Constant, &curve, Key::Normal, Key::Restitution)?;
            Ok(Normal::Curve(curve))
        }
        NormalSpec::Named(kind @ NormalKind::Resolved) => {
            let work = Work::of(&Inputs::new(pair, factor, b, Choice::Normal(*kind)))?;
            let damping =
                Damping { adhesion: b.adhesion_damping.unwrap_or(0.0), hertz: b.hertz_damping.unwrap_or(0.0) };
            let resolved = Resolved::new(work, damping, b.adhesion.unwrap_or_default());
            Ok(Normal::Compiled(NormalLaw::Resolved(resolved)))
        }
        _ => ledger(b, spec, pair, factor).map(|ledger| Normal::Compiled(NormalLaw::Ledger(ledger))),
    }
}

fn ledger(b: &LawBuilder, spec: &NormalSpec, pair: Option<&Pair>, factor: f64) -> Result<Ledger, LawError> {
    let compile = |loss: Loss| {
        let reader = match spec {
            NormalSpec::Named(kind) => Choice::Normal(*kind),
            NormalSpec::Losses(_) => Choice::Loss(loss),
        };
        if let (Loss::GivenRestitution, Some(Curve::ByAngle(_))) = (loss, &b.restitution) {
            return Err(Problem::CurveForm { law: Key::Normal, curve: Key::Restitution, reader }.into());
        }
        loss.compile(&Inputs::new(pair, factor, b, reader))
    };
    let terms = spec.losses(b).into_iter().map(compile).collect::<Result<Vec<_>, _>>()?;
    Ledger::new(terms).map_err(|TwoOfAKind(first, second)| Problem::LossesOverlap { first, second }.into())
}

fn tangential_law(b: &LawBuilder, pair: Option<&Pair>) -> Result<Along, LawError> {
    let kind = b.tangential_kind();
    let reader = Choice::Tangential(kind);
    Ok(match (kind, b.friction) {
        (TangentialKind::Rolling, Some(friction)) => Along::Friction { friction, beta: 0.0 },
        (TangentialKind::Walton, friction) => {
            let beta = b.needed(Key::WaltonBeta, reader)?;
            friction.map_or(Along::NotGiven, |friction| Along::Friction { friction, beta })
        }
        (TangentialKind::MicroSlip, friction) => {
            let missing = || Problem::MissingMaterial { sphere: true, surface: true, reader: Some(reader) };
            let stiffness_ratio = pair.ok_or_else(missing)?.stiffness_ratio()?;
            friction.map_or(Along::NotGiven, |friction| Along::MicroSlip { friction, stiffness_ratio })
        }
        // enough for impacts without slip; others are refused when they happen
        (TangentialKind::Rolling, None) => Along::NotGiven,
        (TangentialKind::Constant | TangentialKind::ByAngle, _) => {
            let curve = given_curve(&b.tangential_restitution, Key::TangentialRestitution, reader)?;
            let constant = kind == TangentialKind::Constant;
            form_fits(constant, &curve, Key::Tangential, Key::TangentialRestitution)?;
            Along::Curve(curve)
        }
    })
}

/// A `constant` law takes a number, a `by-angle` law a curve.
fn form_fits(constant: bool, curve: &Curve, law: Key, key: Key) -> Result<(), LawError> {
    if constant == matches!(curve, Curve::Constant(_)) {
        return Ok(());
    }
    let reader = match (law, constant) {
        (Key::Normal, true) => Choice::Normal(NormalKind::Constant),
        (Key::Normal, false) => Choice::Normal(NormalKind::ByAngle),
        (_, true) => Choice::Tangential(TangentialKind::Constant),
        (_, false) => Choice::Tangential(TangentialKind::ByAngle),
    };
    Err(Problem::CurveForm { law, curve: key, reader }.into())
}

fn given_curve(given: &Option<Curve>, key: Key, reader: Choice) -> Result<Curve, LawError> {
    given.clone().ok_or_else(|| Problem::MissingKey { key, reader: Some(reader) }.into())
}
