//! Aerodynamic to geometric diameter: the diameter d of density ρ_p that settles as fast as a sphere of
//! ρ₀ = 1000 kg/m³ and diameter d_a, ρ_p d² C_c(d) = ρ₀ d_a² C_c(d_a) (Hinds 1999, Aerosol Technology, Eq. 3.26, without its
//! shape factor). Stokes' range.
//!
//! ```
//! use carom_track::{force::Slip, injection::geometric_diameter};
//! // without slip: d = d_a √(ρ₀/ρ_p)
//! assert!((geometric_diameter(10e-6, 4000.0, Slip::None, 0.0) - 5e-6).abs() < 1e-18);
//! ```

use crate::force::Slip;

/// The geometric diameter (m) of an aerodynamic one (m) for a density (kg/m³), a slip law and a mean free path (m).
pub fn geometric_diameter(aerodynamic: f64, density: f64, slip: Slip, mean_free_path: f64) -> f64 {
    let target = 1000.0 / density * aerodynamic * aerodynamic * slip.factor(aerodynamic, mean_free_path);
    // C_c falls no faster than 1/d, so each substitution at least halves the error of ln d; 64 reach rounding
    (0..64).fold(target.sqrt(), |d, _| (target / slip.factor(d, mean_free_path)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_settle_alike() {
        for slip in [Slip::None, Slip::Davies, Slip::AllenRaabe] {
            for (d_a, density) in [(1e-8, 8940.0), (1e-7, 2000.0), (1e-6, 500.0), (5e-5, 8940.0)] {
                let d = geometric_diameter(d_a, density, slip, 6.7e-8);
                let side = |d: f64, rho: f64| rho * d * d * slip.factor(d, 6.7e-8);
                assert!((side(d, density) / side(d_a, 1000.0) - 1.0).abs() < 1e-13, "{slip:?} {d_a} {density} {d}");
            }
        }
        let same = geometric_diameter(3e-7, 1000.0, Slip::Davies, 6.7e-8);
        assert!((same / 3e-7 - 1.0).abs() < 1e-14);
    }
}
