//! C_R by Fuller & Tabor's integral: many asperities of Gaussian heights, each a JKR contact that stretches before it tears.
//!
//! Fuller & Tabor (1975), Proc. R. Soc. A 345, 327–342, <https://doi.org/10.1098/rspa.1975.0138>, in the variables of Greenwood (2017),
//! Tribol. Lett. 65, 159, <https://doi.org/10.1007/s11249-017-0938-1>. Lengths are in L = (βw²/E*²)^{1/3}, forces in βw. One asperity
//! pressed in by δ, touching on a radius a, carries (Johnson, Kendall & Roberts 1971, <https://doi.org/10.1098/rspa.1971.0141>)
//!
//! P(a) = (4/3)a³ − √(8πa³),  δ(a) = a² − √(2πa),
//!
//! as it is drawn out until it tears at a³ = π/8, δ = −3(π/8)^{2/3} = −1.609. With the mean plane at a separation D the pull is
//! −∫ P(δ = z − D) φ(z) dz over all heights z that still touch, and the greatest pull over D, divided by that of asperities of one
//! height, (3/2)π each, is
//!
//! C_R = max_D −∫ P φ dz / (3π/2).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | σ_r | standard deviation of the heights | m |
//! | β | radius of an asperity's tip | m |
//! | w, E* | work of adhesion, effective modulus | J/m², Pa |
//! | θ = E*σ_r^{3/2}/(β^{1/2}w) = (σ_r/L)^{3/2} | Fuller & Tabor's adhesion parameter, with the asperity's radius | – |
//!
//! C_R is a function of θ alone: 1 − 0.2351 θ^{4/3} for small θ, 0.733 at θ = 1, 0.036 at θ = 10, past which
//! Johnson (1985, Contact Mechanics, ch. 5, <https://doi.org/10.1017/CBO9781139171731>) calls the effect of adhesion small. Range: asperities that do not feel
//! each other, tips large against the range of the surface forces (μ_T of a tip above 5), elastic, pressed together once before; the
//! factor of a plane is taken for the sphere's contact. The sphere's pull-off force changes by C_R; that its adhesion work does too is
//! the assumption of every C_R here.
//!
//! ```
//! use carom::roughness::fuller_tabor::{adhesion_parameter, factor};
//! let theta = adhesion_parameter(0.5e-9, 100e-9, 1.0, 50e9); // σ_r, β, w, E*
//! assert!((theta - 1.7678).abs() < 1e-4);
//! let c_r = factor(theta);
//! assert!((c_r - 0.5558).abs() < 1e-4);
//! assert_eq!(factor(0.0), 1.0);
//! ```

use crate::math;
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use core::f64::consts::PI;

/// Heights beyond this many standard deviations count for nothing.
const TAIL: f64 = 9.0;
/// Panels of one integral, eight Gauss–Legendre points each.
const PANELS: u32 = 24;
/// Half the nodes on [−1, 1] and their weights (Abramowitz & Stegun 1964, table 25.4).
const NODES: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// (1/2)|d²P/dδ²| over 3π/2 at an asperity's own pull-off, a³ = 9π/8: (9/8π)(8/9π)^{1/3}.
const CURVATURE: f64 = 0.2350905568671024;

/// θ = E*σ_r^{3/2}/(β^{1/2}w) from σ_r (m), the asperities' radius β (m), w (J/m²) and E* (Pa).
pub fn adhesion_parameter(roughness: f64, asperity_radius: f64, work_of_adhesion: f64, effective_modulus: f64) -> f64 {
    effective_modulus / work_of_adhesion * roughness * (roughness / asperity_radius).sqrt()
}

/// C_R at an adhesion parameter θ ≥ 0.
pub fn factor(theta: f64) -> f64 {
    let sigma = math::cbrt(theta * theta);
    // so narrow that the first term of the series is exact to 1e-11, and the integral would lose digits
    if theta < 1e-4 {
        return 1.0 - CURVATURE * sigma * sigma;
    }
    // past this less than 1e-17 is left
    if theta.is_nan() || theta > 200.0 {
        return 0.0;
    }
    (greatest(sigma) / (1.5 * PI)).clamp(0.0, 1.0)
}

/// The greatest pull per asperity, over the separation, by golden section: the pull rises to one maximum and fades.
fn greatest(sigma: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut low, mut high) = (0.0, TEAR + TAIL * sigma);
    let (mut c, mut d) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_c, mut at_d) = (pull(c, sigma), pull(d, sigma));
    for _ in 0..80 {
        if at_c > at_d {
            (high, d, at_d) = (d, c, at_c);
            c = high - GOLDEN * (high - low);
            at_c = pull(c, sigma);
        } else {
            (low, c, at_c) = (c, d, at_d);
            d = low + GOLDEN * (high - low);
            at_d = pull(d, sigma);
        }
    }
    at_c.max(at_d)
}

/// The extension at which an asperity tears, 3(π/8)^{2/3}.
const TEAR: f64 = 1.608_772_047_833_269;

/// Mean pull per asperity with the mean plane at `separation`.
fn pull(separation: f64, sigma: f64) -> f64 {
    let lowest = (-TAIL * sigma).max(separation - TEAR);
    let highest = (TAIL * sigma).max(lowest + TAIL * sigma);
    let (from, to) = (contact_radius(lowest - separation), contact_radius(highest - separation));
    let half = 0.5 * (to - from) / f64::from(PANELS);
    let mut sum = 0.0;
    for panel in 0..PANELS {
        let middle = from + half * f64::from(2 * panel + 1);
        for (node, weight) in NODES {
            sum += weight
                * (density(middle - half * node, separation, sigma) + density(middle + half * node, separation, sigma));
        }
    }
    -half * sum / (sigma * (2.0 * PI).sqrt())
}

/// P φ dδ/da without φ's constant factor.
fn density(a: f64, separation: f64, sigma: f64) -> f64 {
    let root = a.sqrt();
    let load = 4.0 / 3.0 * (a * a * a) - (8.0 * PI).sqrt() * (a * root);
    let height = (depth(a) + separation) / sigma;
    load * (2.0 * a - (0.5 * PI).sqrt() / root) * math::exp(-0.5 * height * height)
}

fn depth(a: f64) -> f64 {
    a * a - (2.0 * PI * a).sqrt()
}

/// a of a depth, on the branch that has not torn.
fn contact_radius(wanted: f64) -> f64 {
    let mut low = math::cbrt(PI / 8.0);
    if wanted <= depth(low) {
        return low;
    }
    let mut high = 2.0 * low;
    while depth(high) < wanted {
        high *= 2.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if depth(middle) < wanted { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_the_asperitys_own() {
        assert!((TEAR - 3.0 * (PI / 8.0).powf(2.0 / 3.0)).abs() < 1e-15);
        assert!((depth((PI / 8.0).cbrt()) + TEAR).abs() < 1e-15);
        assert!((CURVATURE - 9.0 / (8.0 * PI) * (8.0 / (9.0 * PI)).cbrt()).abs() < 1e-15);
    }

    /// Against an adaptive integral over the heights instead of the contact radius (QUADPACK, with a root-finder for a(δ)).
    #[test]
    fn agrees_with_an_independent_integration() {
        for (theta, expected) in [
            (0.01, 0.9994930141758027),
            (0.1, 0.9887908516929715),
            (0.5, 0.8799697981989104),
            (1.0, 0.7334565984085664),
            (2.0, 0.5119023829591998),
            (5.0, 0.18548271666054456),
            (10.0, 0.03641937047313077),
        ] {
            assert!((factor(theta) - expected).abs() < 1e-9, "{theta}: {}", factor(theta));
        }
        assert!((factor(30.0) / 4.006951223947029e-5 - 1.0).abs() < 1e-6, "{}", factor(30.0));
    }

    #[test]
    fn smooth_is_one_rough_is_none_and_between_it_falls() {
        assert_eq!(factor(0.0), 1.0);
        let mut last = 1.0;
        for i in 1..360 {
            let theta = 10f64.powf(f64::from(i) / 50.0 - 4.5);
            let c_r = factor(theta);
            assert!(c_r < last || c_r == 0.0, "{theta}: {c_r} {last}");
            last = c_r;
        }
        assert!(last == 0.0, "{last}");
        // the first term of the series joins the integral
        assert!((factor(0.999_999e-4) - factor(1.000_001e-4)).abs() < 1e-10);
        assert_eq!((factor(1e9), factor(f64::INFINITY)), (0.0, 0.0));
    }

    #[test]
    fn small_past_ten() {
        // Johnson (1985): the effect of adhesion is small for θ above 10
        assert!(factor(10.0) < 0.05 && factor(3.0) > 0.3);
    }
}
