//! From checked values to a law: each part's constants.

use super::keys::LawBuilder;
use super::uses::Choice;
use super::{Key, NormalKind, NormalSpec, TangentialKind};
use crate::error::{LawError, Problem};
use crate::normal::Loss;
use crate::normal::adhesion::{Jkr, Work};
use crate::normal::bons::Bons;
use crate::normal::damping::Damping;
use crate::normal::empirical::Curve;
use crate::normal::ledger::{Adhesion, Ledger, Plastic};
use crate::normal::plastic::Kadomtsev;
use crate::normal::tabor::Tabor;
use crate::normal::thornton_ning::{PRESSURE_OVER_STRENGTH, ThorntonNing};
use crate::pair::Pair;
use crate::resolved::Resolved;
use crate::roughness::{self, CALIBRATED_ROUGHNESS, CALIBRATED_SPACING, RoughnessModel, fuller_tabor};
use crate::scatter::Scatter;
use crate::tangential::{Tangential, micro_slip::MicroSlip};
use crate::validity::Validity;
use crate::wall::{NormalLaw, WallLaw};

/// The law of a builder whose values are within their ranges and whose keys are all read.
pub(super) fn law(b: &LawBuilder, normal: &NormalSpec, pair: Option<Pair>) -> Result<WallLaw, LawError> {
    let adheres = !normal.is_table();
    let (factor, extrapolated) = roughness_factor(b, pair.as_ref().filter(|_| adheres))?;
    let law = normal_law(b, normal, pair.as_ref(), factor).map_err(|e| e.blame(Key::Normal))?;
    let tangential = tangential_law(b, pair.as_ref()).map_err(|e| e.blame(Key::Tangential))?;
    let curvature = b.surface_curvature.map_or(0.0, |r| 1.0 / r);
    let mut law = WallLaw::assemble(law, tangential, pair, curvature);
    law.roughness = b.roughness;
    law.roughness_factor = factor;
    law.spacing = b.equilibrium_spacing.unwrap_or(CALIBRATED_SPACING);
    law.scatter = b.roughness_angle.filter(|a| *a > 0.0).map(Scatter::new);
    law.validity = Validity::ROUGHNESS_EXTRAPOLATED.when(extrapolated && uses_roughness(&law.normal));
    Ok(law)
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

fn normal_law(b: &LawBuilder, spec: &NormalSpec, pair: Option<&Pair>, factor: f64) -> Result<NormalLaw, LawError> {
    match spec {
        NormalSpec::Named(kind @ (NormalKind::Constant | NormalKind::ByAngle)) => {
            let reader = Choice::Normal(*kind);
            let curve = given_curve(&b.restitution, Key::Restitution, reader)?;
            form_fits(*kind == NormalKind::Constant, &curve, Key::Normal, Key::Restitution)?;
            Ok(NormalLaw::Table(curve))
        }
        NormalSpec::Named(kind @ NormalKind::Resolved) => {
            let pair = both(pair, Choice::Normal(*kind))?;
            let damping =
                Damping { adhesion: b.adhesion_damping.unwrap_or(0.0), hertz: b.hertz_damping.unwrap_or(0.0) };
            Ok(NormalLaw::Resolved(Resolved::new(work(pair, factor)?, damping, b.adhesion.unwrap_or_default())))
        }
        _ => ledger(b, spec, pair, factor).map(NormalLaw::Ledger),
    }
}

fn ledger(b: &LawBuilder, spec: &NormalSpec, pair: Option<&Pair>, factor: f64) -> Result<Ledger, LawError> {
    let mut ledger = Ledger::lossless();
    for loss in spec.losses(b) {
        let reader = match spec {
            NormalSpec::Named(kind) => Choice::Normal(*kind),
            NormalSpec::Losses(_) => Choice::Loss(loss),
        };
        match loss {
            Loss::AdhesionWork => {
                ledger.adhesion = Adhesion::Work;
                ledger.work = work(both(pair, reader)?, factor)?;
            }
            Loss::AdhesionDamping => {
                ledger.work = work(both(pair, reader)?, factor)?;
                ledger.damping.adhesion = b.needed(Key::AdhesionDamping, reader)?;
            }
            Loss::HertzDamping => ledger.damping.hertz = b.needed(Key::HertzDamping, reader)?,
            Loss::AdhesionJkr => {
                let pair = both(pair, reader)?;
                let jkr = Jkr::new(pair.effective_modulus()?, pair.work_of_adhesion()?, pair.density()?);
                ledger.adhesion = Adhesion::Jkr(jkr);
            }
            Loss::PlasticTabor => {
                ledger.plastic = Plastic::Tabor(Tabor {
                    yield_velocity: b.needed(Key::YieldVelocity, reader)?,
                    meyer_index: b.needed(Key::MeyerIndex, reader)?,
                });
            }
            Loss::PlasticKadomtsev | Loss::PlasticThorntonNing | Loss::PlasticBons => {
                ledger.plastic = plastic(b, loss, both(pair, reader)?)?;
            }
        }
    }
    Ok(ledger)
}

fn plastic(b: &LawBuilder, loss: Loss, pair: &Pair) -> Result<Plastic, LawError> {
    let (modulus, density) = (pair.effective_modulus()?, pair.density()?);
    Ok(match loss {
        Loss::PlasticThorntonNing => {
            let given = b.limiting_pressure;
            let pressure =
                given.map_or_else(|| pair.plastic_constant().map(|k| 2.0 * k * PRESSURE_OVER_STRENGTH), Ok)?;
            Plastic::ThorntonNing(ThorntonNing::new(modulus, pressure, density))
        }
        Loss::PlasticBons => Plastic::Bons(Bons::new(modulus, 2.0 * pair.plastic_constant()?, density)),
        _ => Plastic::Kadomtsev(Kadomtsev::new(modulus, pair.plastic_constant()?, density)),
    })
}

fn tangential_law(b: &LawBuilder, pair: Option<&Pair>) -> Result<Tangential, LawError> {
    let kind = b.tangential_kind();
    let reader = Choice::Tangential(kind);
    let friction = || b.needed(Key::Friction, reader);
    Ok(match kind {
        TangentialKind::Rolling => Tangential::Friction { friction: friction()?, beta: 0.0 },
        TangentialKind::Walton => {
            let beta = b.needed(Key::WaltonBeta, reader)?;
            Tangential::Friction { friction: friction()?, beta }
        }
        TangentialKind::MicroSlip => {
            let ratio = both(pair, reader)?.stiffness_ratio()?;
            Tangential::MicroSlip(Box::new(MicroSlip::new(friction()?, ratio)))
        }
        TangentialKind::Constant | TangentialKind::ByAngle => {
            let curve = given_curve(&b.tangential_restitution, Key::TangentialRestitution, reader)?;
            let constant = kind == TangentialKind::Constant;
            form_fits(constant, &curve, Key::Tangential, Key::TangentialRestitution)?;
            Tangential::Restitution(curve)
        }
    })
}

/// A `constant` law takes a number, a `by-angle` law a curve.
fn form_fits(constant: bool, curve: &Curve, law: Key, key: Key) -> Result<(), LawError> {
    if constant == matches!(curve, Curve::Constant(_)) {
        Ok(())
    } else {
        Err(Problem::CurveForm { law, curve: key, constant }.into())
    }
}

fn given_curve(given: &Option<Curve>, key: Key, reader: Choice) -> Result<Curve, LawError> {
    given.clone().ok_or_else(|| Problem::MissingKey { key, reader: Some(reader) }.into())
}

/// The pair that a choice needs.
fn both(pair: Option<&Pair>, reader: Choice) -> Result<&Pair, LawError> {
    let missing = || Problem::MissingMaterial { sphere: true, surface: true, reader: Some(reader) };
    pair.ok_or_else(|| missing().into())
}

fn work(pair: &Pair, factor: f64) -> Result<Work, LawError> {
    Ok(Work::new(pair.stiffness()?, pair.work_of_adhesion()?, factor, pair.density()?))
}

fn uses_roughness(normal: &NormalLaw) -> bool {
    match normal {
        NormalLaw::Ledger(ledger) => ledger.uses_work(),
        NormalLaw::Table(_) => false,
        NormalLaw::Resolved(_) => true,
    }
}

const _: () = assert!(crate::normal::plastic::BETA <= 0.6);
