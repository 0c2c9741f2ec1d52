//! Roughness: how much adhesion it leaves, and the numbers that judge an adhesive contact.
//!
//! - Heights are Gaussian with standard deviation σ_r (Kim & Dunn 2007, Eq. 38). C_R, the factor on the adhesion force, is best given
//!   directly (fits: 0.43–0.82 for polished surfaces, 0.15 for silicon called 1 nm rough). From σ_r it follows here Rabinovich's form
//!   without the small-asperity term, C_R = 1/(1 + 1.485 σ_r/z₀)², with z₀ set so that C_R(5 Å) = 0.05, the one pair of numbers printed
//!   (Cheng, Brach & Dunn 2002). Beyond 0.5 nm that is an extrapolation and flagged: at 1 nm it gives 0.016 where the paper fits 0.15.
//!   The other choice is Fuller & Tabor's integral, [`fuller_tabor`].
//! - Tabor's parameter μ_T = (r w²/(E*² z₀³))^{1/3} (Eq. 39): JKR for large (above 5), DMT for small (below 0.1), after
//!   Johnson & Greenwood (1997), J. Colloid Interface Sci. 192, 326–333, <https://doi.org/10.1006/jcis.1997.4984>.
//! - Adhesion parameter θ = E* σ_r^{3/2}/(r^{1/2} w) (Eq. 40): adhesion fades as it grows past 1. Fuller & Tabor (1975, Proc. R. Soc. A
//!   345, 327–342, <https://doi.org/10.1098/rspa.1975.0138>) use the asperities' radius; the paper the sphere's, as here, so neither that
//!   radius nor a threshold of 1 is theirs.
//!
//! Rabinovich et al. (2000), J. Colloid Interface Sci. 232, 10–16, <https://doi.org/10.1006/jcis.2000.7167>.
//!
//! ```
//! use carom::roughness::{CALIBRATED_SPACING, factor};
//! assert!((factor(5e-10, CALIBRATED_SPACING) - 0.05).abs() < 1e-12);
//! assert_eq!(factor(0.0, CALIBRATED_SPACING), 1.0);
//! ```

pub mod fuller_tabor;

use crate::math;
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;

/// Which way C_R follows from a roughness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RoughnessModel {
    /// `rabinovich`: C_R = 1/(1 + 1.485 σ_r/z₀)².
    #[default]
    Rabinovich,
    /// `fuller-tabor`: [`fuller_tabor`], which needs the asperities' radius.
    FullerTabor,
}

/// z₀ that makes C_R(5 Å) = 0.05, m: 1.485 · 5 Å/(√20 − 1).
pub const CALIBRATED_SPACING: f64 = 2.138_453_129_782_730_3e-10;
/// The calibrated end of the roughness curve, m.
pub const CALIBRATED_ROUGHNESS: f64 = 5e-10;

/// C_R from the roughness σ_r (m) and the equilibrium spacing z₀ (m).
pub fn factor(roughness: f64, spacing: f64) -> f64 {
    let q = 1.0 + 1.485 * roughness / spacing;
    1.0 / (q * q)
}

/// The theory of adhesion a contact belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// Johnson, Kendall & Roberts: soft, strongly adhesive, large.
    Jkr,
    /// Between the two.
    Transition,
    /// Derjaguin, Muller & Toporov: hard, weakly adhesive, small.
    Dmt,
}

impl Regime {
    /// The word in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Jkr => "JKR",
            Self::Transition => "transition",
            Self::Dmt => "DMT",
        }
    }
}

/// Numbers that judge an adhesive contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdhesionNumbers {
    /// Tabor's parameter μ_T.
    pub tabor: f64,
    /// Its verdict.
    pub regime: Regime,
    /// Adhesion parameter θ, if a roughness is given.
    pub adhesion_parameter: Option<f64>,
    /// Is θ that of the asperities, not of the sphere?
    pub asperities: bool,
    /// Equilibrium spacing used, m.
    pub spacing: f64,
}

/// Tabor's parameter and the adhesion parameter of a contact: effective radius r (m), w (J/m²), E* (Pa), z₀ (m), σ_r (m).
pub fn adhesion_numbers(r: f64, w: f64, e_star: f64, spacing: f64, roughness: Option<f64>) -> AdhesionNumbers {
    let tabor = math::cbrt(r * (w / e_star) * (w / e_star) / (spacing * spacing * spacing));
    let regime = if tabor > 5.0 {
        Regime::Jkr
    } else if tabor < 0.1 {
        Regime::Dmt
    } else {
        Regime::Transition
    };
    AdhesionNumbers {
        tabor,
        regime,
        adhesion_parameter: roughness.map(|s| e_star * s * s.sqrt() / (r.sqrt() * w)),
        asperities: false,
        spacing,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_one_calibration_point_and_its_contradiction() {
        assert!((CALIBRATED_SPACING - 1.485 * 5e-10 / (20f64.sqrt() - 1.0)).abs() < 1e-24);
        let one_nm = factor(1e-9, CALIBRATED_SPACING);
        assert!((one_nm - 0.016).abs() < 5e-4, "{one_nm}");
    }

    #[cfg(feature = "toml")]
    #[test]
    fn the_asperities_parameter_is_told_where_it_decides() {
        let text = "sphere = \"copper\"\nsurface = \"glass\"\nnormal = \"ea\"\nroughness = \"1 nm\"\n";
        let theta = |more: &str| {
            let law = crate::spec::parse_law(&format!("{text}{more}")).expect("a law");
            let law = law.compile(crate::material::Library::builtin()).expect("it compiles");
            let numbers = law.adhesion_numbers(20e-6).expect("fits").expect("it adheres");
            (numbers.adhesion_parameter.expect("rough"), numbers.asperities, law.roughness_factor())
        };
        let (sphere, of_asperities, _) = theta("");
        assert!(!of_asperities && (sphere - 0.41455).abs() < 1e-5, "{sphere}");
        let (asperity, of_asperities, factor) =
            theta("roughness_model = \"fuller-tabor\"\nasperity_radius = \"50 nm\"\n");
        assert!(of_asperities && (asperity / (sphere * (10e-6f64 / 50e-9).sqrt()) - 1.0).abs() < 1e-12, "{asperity}");
        // C_R is a function of it alone
        assert!((fuller_tabor::factor(asperity) - factor).abs() < 1e-12);
    }

    #[test]
    fn verdicts() {
        // 70 µm steel on silicon: stiff but large, so JKR; a 10 nm sphere of the same: DMT or between
        let e = 95.85e9;
        assert_eq!(adhesion_numbers(35e-6, 3.03, e, 2e-10, None).regime, Regime::Jkr);
        assert_eq!(adhesion_numbers(5e-9, 0.05, e, 4e-10, Some(1e-9)).regime, Regime::Dmt);
        let n = adhesion_numbers(1e-6, 0.1, 1e10, 2e-10, Some(1e-9));
        assert!((n.adhesion_parameter.expect("given") - 1e10 * 1e-9f64.powf(1.5) / (1e-3 * 0.1)).abs() < 1e-12);
    }
}
