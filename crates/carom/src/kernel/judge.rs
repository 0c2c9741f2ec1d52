//! Refusals of what is no impact, and the warnings about what is one.

use super::Kernel;
use crate::impact::{ImpactError, Vec3};
use crate::math::{self, Fma};
use crate::normal::plastic::{Kadomtsev, LAMBDA};
use crate::normal::{Loss, NormalLaw, NormalResponse, Size};
use crate::pair::Pair;
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
    (v_n > 1e-150) & (incident <= 3.0 * FASTEST * FASTEST) & (1e-10..=1.0).contains(&diameter)
}

/// Radius of the contact that adhesion makes without load, over the sphere's, that the contact models are trusted to: the slope of a sphere
/// is there 5 % steeper than that of the paraboloid in its place (Maugis 1995, <https://doi.org/10.1021/la00002a055>, treats what is beyond).
const LARGE_AT_REST: f64 = 0.3;
/// Energy along the wall, over what adhesion holds, beyond which a capture is called into question.
const GRAZING: f64 = 10.0;

/// Where the contact models end, as numbers that an impact is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits {
    /// Elastic: (a/R)⁵ = this · κ² v² · density ratio; zero where it is not judged.
    elastic: f64,
    /// Kadomtsev: (a/R)³ = this · κ³ · y³, with y³ = e_pl² (v/V_y)²; zero for other laws.
    plastic: f64,
    /// V_y² of a law that knows no yielding, on a flat wall at the law's own density; infinite where it is not judged.
    yield_squared: f64,
    /// Adhesion without load: (a/R)³ = (0.3)³ this · κ²/R, m; zero where it is not judged.
    at_rest: f64,
}

/// What the limits of a law follow from, SI units.
pub(crate) struct Judged<'a> {
    pub normal: &'a NormalLaw,
    /// The law's materials.
    pub pair: Option<&'a Pair>,
    /// C_R.
    pub roughness_factor: f64,
    /// Density of the law's own sphere, kg/m³.
    pub density: f64,
}

impl Limits {
    /// No limit at all.
    const NONE: Self = Self { elastic: 0.0, plastic: 0.0, yield_squared: f64::INFINITY, at_rest: 0.0 };

    /// Hertz gives a_m⁵ = 5r²mv²/(4K) (Kim & Dunn 2007, Eq. 20); Kadomtsev a² = F_max/η, so a/R = κ y (3η/4E*). Other plastic
    /// laws are judged by the elastic radius, which is smaller than theirs. JKR without load: a³ = 6πw r²/K, w reduced by C_R as the
    /// adhesion is. Laws without a stiffness are never judged.
    pub(crate) fn new(law: &Judged) -> Self {
        let Some(k) = law.pair.and_then(|p| p.stiffness().ok()) else { return Self::NONE };
        if matches!(law.normal, NormalLaw::Table(_)) {
            return Self::NONE;
        }
        let plastic_constant = law.pair.and_then(|p| p.plastic_constant().ok());
        let yields_as_kadomtsev =
            matches!(law.normal, NormalLaw::Ledger(l) if l.terms().any(|t| t.loss() == Loss::PlasticKadomtsev));
        let plastic = plastic_constant.filter(|_| yields_as_kadomtsev).map_or(0.0, |c| PI * LAMBDA * c / k);
        let yield_squared = plastic_constant
            .filter(|_| law.normal.is_elastic())
            .map_or(f64::INFINITY, |c| Kadomtsev::new(0.75 * k, c, law.density).yield_squared);
        let work = law.pair.and_then(|p| p.work_of_adhesion().ok()).unwrap_or(0.0);
        let adhesion = law.normal.adhesive_contact(law.roughness_factor) * work;
        let large = LARGE_AT_REST * LARGE_AT_REST * LARGE_AT_REST;
        Self {
            elastic: 5.0 * PI / 3.0 * law.density / k,
            plastic: plastic * plastic * plastic,
            yield_squared,
            at_rest: 6.0 * PI * adhesion / (k * large),
        }
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

    /// What is said of every law with a contact: whether it should have yielded, and how wide adhesion alone makes the contact.
    #[inline(always)]
    fn contact_warnings(&self, v: f64, size: &Size) -> Validity {
        let k2 = size.kappa * size.kappa;
        let yields = v * v * size.density_ratio > self.yield_squared * (k2 * size.kappa);
        Validity::ABOVE_YIELD.when(yields).with(Validity::ADHESIVE_CONTACT_LARGE.when(self.at_rest * k2 > size.radius))
    }
}

impl Kernel {
    /// The warnings about one impact.
    #[inline(always)]
    pub(super) fn judge(&self, v: f64, size: &Size, response: &NormalResponse) -> Validity {
        let validity = self.validity;
        match &self.normal {
            NormalLaw::Table(_) => validity,
            NormalLaw::Ledger(ledger) => {
                self.judge_ledger(ledger.yield_squared(size), ledger.is_damped(), v, size, response)
            }
            NormalLaw::Resolved(resolved) => {
                let large = self.limits.contact_is_large(v, size, 1.0, f64::INFINITY);
                validity.with(Validity::LARGE_CONTACT.when(large)).with(resolved.warnings(v))
            }
        }
    }
}

impl Kernel {
    /// The warnings about an impact of a list of losses, given its yield velocity and whether damping is among them.
    #[inline(always)]
    pub(super) fn judge_ledger(
        &self,
        yield_squared: f64,
        is_damped: bool,
        v: f64,
        size: &Size,
        response: &NormalResponse,
    ) -> Validity {
        let kept = 1.0 - response.losses.plastic;
        let large = self.limits.contact_is_large(v, size, kept, yield_squared);
        let overlap = v * v > yield_squared && is_damped;
        let validity =
            self.validity.with(Validity::LARGE_CONTACT.when(large)).with(Validity::LOSSES_OVERLAP.when(overlap));
        match &self.normal {
            NormalLaw::Ledger(ledger) if response.e <= 0.0 => validity.with(ledger.why_captured(v, size)),
            _ => validity,
        }
    }
}

impl Kernel {
    /// The warnings about materials at the scale of the contact, whatever the law; `tangent2` is the square of the speed along the wall.
    #[inline(always)]
    pub(super) fn scale_warnings(&self, v: f64, tangent2: f64, size: &Size, response: &NormalResponse) -> Validity {
        let warnings = self.limits.contact_warnings(v, size);
        // below 45° a capture may be one that adhesion cannot hold
        if response.e <= 0.0 && tangent2 > v * v {
            return warnings.with(grazing(&self.normal, tangent2, size));
        }
        warnings
    }
}

/// Captured by the normal speed: is the energy along the wall far above the greatest that the law's own adhesion takes from a sphere which
/// it captures head-on? An impact with that energy along the normal would have rebounded with ease.
#[cold]
fn grazing(normal: &NormalLaw, tangent2: f64, size: &Size) -> Validity {
    let hold = match normal {
        NormalLaw::Ledger(ledger) => ledger.terms().find_map(|t| t.hold_squared(size)),
        NormalLaw::Resolved(resolved) => Some(resolved.hold_squared(size)),
        NormalLaw::Table(_) => None,
    };
    Validity::GRAZING_CAPTURE.when(hold.is_some_and(|h| tangent2 > GRAZING * h))
}
