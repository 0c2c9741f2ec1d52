//! Refusals of what is no impact, and the warnings about what is one.

use super::Kernel;
use crate::impact::{ImpactError, Vec3};
use crate::math::{self, Fma};
use crate::normal::{Ledger, Loss, NormalLaw, NormalResponse, Size, plastic::LAMBDA};
use crate::validity::Validity;
use crate::vector::dot;
use core::f64::consts::PI;

/// Speeds beyond this are no impacts (the squares must stay finite).
const FASTEST: f64 = 1e9;
/// Greatest contact radius over sphere radius that the contact models are trusted to.
const LARGE: f64 = 1.0 / 3.0;

/// The wall's normal at length one; left as it is where it has that length to the last bit or two.
#[inline(always)]
pub(super) fn unit_normal<F: Fma>(f: F, normal: &Vec3) -> Result<Vec3, ImpactError> {
    let square = dot(f, normal, normal);
    if (square - 1.0).abs() <= 4.0 * f64::EPSILON { Ok(*normal) } else { scaled(normal, square) }
}

#[cold]
fn scaled(normal: &Vec3, square: f64) -> Result<Vec3, ImpactError> {
    if !(1e-200..1e200).contains(&square) {
        return Err(ImpactError::NotFinite);
    }
    let length = math::sqrt(square);
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

/// One row of a batch: is it an impact?
#[inline(always)]
pub(super) fn row_is_fine<F: Fma>(f: F, v_n: f64, v_t: f64, spin: f64, diameter: f64) -> bool {
    let radius = 0.5 * diameter;
    let incident = f.fma(v_n, v_n, f.fma(v_t, v_t, 0.4 * (radius * radius) * (spin * spin)));
    (v_n > 1e-150) & (incident <= 3.0 * FASTEST * FASTEST) & (1e-10..=10.0).contains(&diameter)
}

/// Where the contact models end, as numbers that an impact is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits {
    /// Elastic: (a/R)⁵ = this · κ² v² · density ratio; zero where it is not judged.
    elastic: f64,
    /// Kadomtsev: (a/R)³ = this · κ³ · y³, with y³ = e_pl² (v/V_y)²; zero for other laws.
    plastic: f64,
}

impl Limits {
    /// Hertz gives a_m⁵ = 5r²mv²/(4K) (Kim & Dunn 2007, Eq. 20); Kadomtsev a² = F_max/η, so a/R = κ y (3η/4E*). Other plastic
    /// laws are judged by the elastic radius, which is smaller than theirs. Laws without a stiffness are never judged.
    pub(crate) fn new(normal: &NormalLaw, stiffness: Option<f64>, plastic_constant: Option<f64>, density: f64) -> Self {
        let Some(k) = stiffness else { return Self { elastic: 0.0, plastic: 0.0 } };
        let yields_as_kadomtsev =
            matches!(normal, NormalLaw::Ledger(l) if l.terms().any(|t| t.loss() == Loss::PlasticKadomtsev));
        let plastic = plastic_constant.filter(|_| yields_as_kadomtsev).map_or(0.0, |c| PI * LAMBDA * c / k);
        let elastic = if matches!(normal, NormalLaw::Table(_)) { 0.0 } else { 5.0 * PI / 3.0 * density / k };
        Self { elastic, plastic: plastic * plastic * plastic }
    }

    /// Is the greatest contact radius larger than a third of the sphere's?
    #[inline(always)]
    fn contact_is_large(&self, v: f64, size: &Size, kept_plastic: f64, yield_squared: f64) -> bool {
        let k2 = size.kappa * size.kappa;
        if self.plastic > 0.0 && v * v > yield_squared {
            return self.plastic * (k2 * size.kappa) * (kept_plastic * (v * v) / yield_squared) > LARGE * LARGE * LARGE;
        }
        let l2 = LARGE * LARGE;
        self.elastic * size.density_ratio * k2 * (v * v) > l2 * l2 * LARGE
    }
}

impl Kernel {
    /// The warnings about one impact.
    #[inline(always)]
    pub(super) fn judge<F: Fma>(&self, f: F, v: f64, size: &Size, response: &NormalResponse) -> Validity {
        let validity = self.validity;
        match &self.normal {
            NormalLaw::Table(_) => validity,
            NormalLaw::Ledger(ledger) => {
                let yield_squared = ledger.yield_squared(size);
                let kept = 1.0 - response.losses.plastic;
                let large = self.limits.contact_is_large(v, size, kept, yield_squared);
                let overlap = v * v > yield_squared && ledger.is_damped();
                let mut validity =
                    validity.with(Validity::LARGE_CONTACT.when(large)).with(Validity::LOSSES_OVERLAP.when(overlap));
                if response.e <= 0.0 {
                    validity = validity.with(why_captured(f, ledger, v, size));
                }
                validity
            }
            NormalLaw::Resolved(resolved) => {
                let large = self.limits.contact_is_large(v, size, 1.0, f64::INFINITY);
                validity.with(Validity::LARGE_CONTACT.when(large)).with(resolved.warnings(v))
            }
        }
    }
}

/// A ledger left nothing: below the window (capture, no warning), above it, or without one.
#[cold]
fn why_captured<F: Fma>(f: F, ledger: &Ledger, v: f64, size: &Size) -> Validity {
    if !ledger.can_exhaust() {
        return Validity::NONE;
    }
    // rebounds at a higher speed, so below the window: the common case, told without searching for the window's ends
    let faster = |doublings: i32| v * f64::from(1 << doublings);
    if (1..=12).any(|n| ledger.balance(f, faster(n), size).left > 0.0) {
        return Validity::NONE;
    }
    match ledger.window(size) {
        None => Validity::NO_REBOUND_WINDOW,
        Some(window) if v <= window.capture_velocity => Validity::NONE,
        Some(_) => ledger.exhausted_by(v, size),
    }
}
