//! Refusals of impacts that are none, and the doubts about those that are.

use super::{NormalLaw, NormalResponse, WallLaw};
use crate::impact::{ImpactError, Vec3};
use crate::normal::Size;
use crate::normal::ledger::{Ledger, Plastic};
use crate::normal::plastic::LAMBDA;
use crate::pair::Pair;
use crate::validity::Validity;
use std::f64::consts::PI;

/// Speeds beyond this are no impacts (the squares must stay finite).
const FASTEST: f64 = 1e9;
/// Greatest contact radius over sphere radius that the contact models are trusted to.
const LARGE: f64 = 1.0 / 3.0;

/// Is a normal of this squared length one already, to the last bit or two?
#[inline(always)]
pub(super) fn is_unit(square: f64) -> bool {
    (square - 1.0).abs() <= 4.0 * f64::EPSILON
}

/// The wall's normal at length one.
#[cold]
pub(super) fn unit(normal: &Vec3, square: f64) -> Result<Vec3, ImpactError> {
    if !(1e-200..1e200).contains(&square) {
        return Err(ImpactError::NotFinite);
    }
    let length = square.sqrt();
    Ok([normal[0] / length, normal[1] / length, normal[2] / length])
}

/// `incident` is twice the kinetic energy per mass relative to the wall, spin included: NaN or infinite if anything in it is.
#[inline(always)]
pub(super) fn approach(v_n: f64, incident: f64) -> Result<(), ImpactError> {
    if incident.is_nan() || incident > 3.0 * FASTEST * FASTEST {
        return Err(ImpactError::NotFinite);
    }
    // below this the square underflows and nothing moves
    if v_n > 1e-150 { Ok(()) } else { Err(ImpactError::NotApproaching) }
}

/// One column's entries, for the batch: all fine?
#[inline(always)]
pub(crate) fn column_ok(v_n: f64, v_t: f64, spin: f64, diameter: f64) -> bool {
    let radius = 0.5 * diameter;
    let incident = v_n.mul_add(v_n, v_t.mul_add(v_t, 0.4 * (radius * radius) * (spin * spin)));
    (v_n > 1e-150) & (incident <= 3.0 * FASTEST * FASTEST) & (1e-10..=10.0).contains(&diameter)
}

/// When the contact is no longer small against the sphere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactLimit {
    /// Elastic: (a/R)⁵ = this · κ² v² · density ratio.
    elastic: f64,
    /// Kadomtsev: (a/R)³ = this · κ³ · y³, with y³ = e_pl² (v/V_y)²; zero for other laws.
    plastic: f64,
}

impl ContactLimit {
    /// Hertz gives a_m⁵ = 5r²mv²/(4K) (Kim & Dunn 2007, Eq. 20); Kadomtsev a² = F_max/η, so a/R = κ y (3η/4E*). Other plastic
    /// laws are judged by the elastic radius, which is smaller than theirs. Laws without a stiffness are never judged.
    pub(crate) fn new(normal: &NormalLaw, pair: Option<&Pair>, density: f64) -> Self {
        let Some(k) = pair.and_then(|p| p.stiffness().ok()) else { return Self { elastic: 0.0, plastic: 0.0 } };
        let plastic = match (normal, pair.and_then(|p| p.plastic_constant().ok())) {
            (NormalLaw::Ledger(Ledger { plastic: Plastic::Kadomtsev(_), .. }), Some(constant)) => {
                PI * LAMBDA * constant / k
            }
            _ => 0.0,
        };
        let elastic = if matches!(normal, NormalLaw::Table(_)) { 0.0 } else { 5.0 * PI / 3.0 * density / k };
        Self { elastic, plastic: plastic * plastic * plastic }
    }

    #[inline(always)]
    fn exceeded(&self, v: f64, size: &Size, kept_plastic: f64, yield_squared: f64) -> bool {
        let k2 = size.kappa * size.kappa;
        if self.plastic > 0.0 && v * v > yield_squared {
            return self.plastic * (k2 * size.kappa) * (kept_plastic * (v * v) / yield_squared) > LARGE * LARGE * LARGE;
        }
        let l2 = LARGE * LARGE;
        self.elastic * size.density_ratio * k2 * (v * v) > l2 * l2 * LARGE
    }
}

impl WallLaw {
    /// The doubts about one impact.
    #[inline(always)]
    pub(super) fn judge(&self, v: f64, size: &Size, response: &NormalResponse) -> Validity {
        let mut validity = self.validity;
        match &self.normal {
            NormalLaw::Table(_) => {}
            NormalLaw::Ledger(ledger) => {
                let yield_squared = ledger.yield_squared(size);
                let yielding = v * v > yield_squared;
                validity = validity
                    .with(Validity::LARGE_CONTACT.when(self.contact_limit.exceeded(
                        v,
                        size,
                        1.0 - response.losses.plastic,
                        yield_squared,
                    )))
                    .with(Validity::LOSSES_OVERLAP.when(yielding && !ledger.damping.is_none()));
                if response.e <= 0.0 && (!ledger.damping.is_none() || ledger.plastic_can_exhaust()) {
                    validity = validity.with(self.why_captured(v, size));
                }
            }
            NormalLaw::Resolved(resolved) => {
                validity = validity
                    .with(Validity::LARGE_CONTACT.when(self.contact_limit.exceeded(v, size, 1.0, f64::INFINITY)))
                    .with(resolved.doubts(v));
            }
        }
        validity
    }
}
