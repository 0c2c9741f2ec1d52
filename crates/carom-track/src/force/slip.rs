//! Slip of the gas at a small sphere (Cunningham): Stokes drag falls by C_c = 1 + Kn [α + β e^{−γ/Kn}], Kn = 2λ/d, so the
//! relaxation time grows by C_c. For any Kn, at Re ≪ 1.
//!
//! - Davies 1945 (Proc. Phys. Soc. 57, 259–270, doi:10.1088/0959-5309/57/4/301): α = 1.257, β = 0.400, γ = 1.10; what
//!   Fluent uses.
//! - Allen & Raabe 1985 (Aerosol Sci. Technol. 4, 269–286, doi:10.1080/02786828508959055), solid polystyrene spheres:
//!   α = 1.142, β = 0.558, γ = 0.999.
//!
//! Free molecules (Kn ≫ 1, a vacuum chamber): drag goes over into 3πμdv/((α + β) Kn), independent of μ. Kinetic theory
//! (Epstein 1924, Phys. Rev. 23, 710–733, doi:10.1103/PhysRev.23.710) has α + β = 1.612 for molecules that leave the sphere
//! diffusely and 2.245 for mirror-like ones; Davies' 1.657 and Allen & Raabe's 1.700 lie 3 and 5 % above the first. All of it is for
//! spheres slow against the molecules: drag grows by about S²/5 with the speed ratio S = v/√(2RT/M), and a case whose spheres
//! start faster says so.
//!
//! ```
//! use carom_track::force::Slip;
//! let c = Slip::Davies.factor(1e-6, 0.066e-6);
//! assert!((c - 1.166).abs() < 1e-3);
//! ```

use carom::math::exp;

/// Whose slip correction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Slip {
    /// None: a continuum, C_c = 1.
    #[default]
    None,
    /// Davies 1945.
    Davies,
    /// Allen & Raabe 1985.
    AllenRaabe,
}

impl Slip {
    /// C_c ≥ 1 for a diameter and a mean free path (m).
    #[inline(always)]
    pub fn factor(self, diameter: f64, mean_free_path: f64) -> f64 {
        let (a, b, c) = match self {
            Self::None => return 1.0,
            Self::Davies => (1.257, 0.400, 1.10),
            Self::AllenRaabe => (1.142, 0.558, 0.999),
        };
        let kn = 2.0 * mean_free_path / diameter;
        // infinite at Kn = 0; from 40 on the exponential is lost against α, and would be too small for fast arithmetic further on
        let decay = c / kn;
        let rest = if decay < 40.0 { b * exp(-decay) } else { 0.0 };
        1.0 + kn * (a + rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_handbook_values() {
        // Hinds 1999, Aerosol Technology, 2nd ed., Eq. 3.20 at λ = 0.066 µm (oil drops, itself good to 2.1 %)
        for (d, want) in [(0.01, 22.98), (0.1, 2.928), (1.0, 1.155), (10.0, 1.015)] {
            for slip in [Slip::Davies, Slip::AllenRaabe] {
                let got = slip.factor(d * 1e-6, 0.066e-6);
                assert!((got / want - 1.0).abs() < 0.03, "{slip:?} {d} {got} {want}");
            }
        }
    }

    #[test]
    fn limits() {
        for slip in [Slip::Davies, Slip::AllenRaabe] {
            assert_eq!(slip.factor(1e-6, 0.0), 1.0);
            // free molecules: C_c/Kn → α + β
            let kn = 2e6;
            assert!((slip.factor(1.0, 0.5 * kn) / kn - 1.68).abs() < 0.03);
        }
        // Epstein's drag (4π/3) R² ρ c̄ v (1 + π/8), diffuse reflection, as α + β: 9 × 0.499/(2 + π/4)
        let epstein = 9.0 * 0.499 / (2.0 + std::f64::consts::FRAC_PI_4);
        assert!((epstein - 1.612).abs() < 1e-3, "{epstein}");
        assert!((Slip::Davies.factor(1e-6, 0.5) / 1e6 / epstein - 1.028).abs() < 1e-3);
        assert_eq!(Slip::None.factor(1e-9, 1e-6), 1.0);
    }
}
