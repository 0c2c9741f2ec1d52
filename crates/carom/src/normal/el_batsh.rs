//! The capture velocity that user-defined functions of flow solvers compute, for comparison with the laws here.
//!
//! Brach & Dunn (1992), Aerosol Sci. Technol. 16, 51–64, <https://doi.org/10.1080/02786829208959537>, made a formula of by
//! El-Batsh & Haselbacher (2002), ASME GT2002-30600, <https://doi.org/10.1115/GT2002-30600>:
//!
//! v_cr = (2E/d)^{10/7},  E = 0.51 [5π²(k₁ + k₂)/(4ρ^{3/2})]^{2/5}
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d, ρ | sphere diameter and density | m, kg/m³ |
//! | k_i = (1 − ν_i²)/(πE_i) | compliances; k₁ + k₂ = 4/(3πK) | 1/Pa |
//! | 0.51 | (3/2) · 0.34, see below | kg m^{−1/2} s^{−3/2} |
//!
//! **Its 0.51 hides one material.** The formula is the balance ½mv² = γπa_m² of the sphere's energy with an energy of adhesion γ over
//! the greatest Hertzian contact, a_m⁵ = (5/4)π²(k₁ + k₂)ρR⁵v², and γ = 0.34 √v (J/m², v in m/s), a fit to the measurements Brach and
//! Dunn had. So neither the surface energies nor the roughness of the pair at hand enter it: it answers for that one material's
//! adhesion, whatever the names of the two bodies. Use the law's own capture velocity; compare with this one.
//!
//! ```
//! let v = carom::normal::el_batsh::capture_velocity(5e-6, 1.8e9, 1350.0); // ammonium fluorescein on something stiff
//! assert!((v / 1.05723598 - 1.0).abs() < 1e-8);
//! ```

use crate::math;
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use core::f64::consts::PI;

/// v_cr (m/s) from the diameter (m), the Hertzian stiffness K (Pa) and the sphere's density (kg/m³).
pub fn capture_velocity(diameter: f64, stiffness: f64, density: f64) -> f64 {
    let compliances = 4.0 / (3.0 * PI * stiffness);
    let e = 0.51 * math::pow(5.0 * PI * PI * compliances / (4.0 * density * density.sqrt()), 0.4);
    math::pow(2.0 * e / diameter, 10.0 / 7.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The balance the formula stands for, solved by bisection.
    #[test]
    fn it_is_one_materials_adhesion_over_the_hertzian_contact() {
        for (d, k, rho) in [(10e-6, 127.8e9, 8000.0), (1e-6, 1.8e9, 1350.0), (90e-6, 50.9e9, 1350.0)] {
            let r: f64 = d / 2.0;
            let excess = |v: f64| {
                let compliances = 4.0 / (3.0 * PI * k);
                let area = PI * (1.25 * PI * PI * compliances * rho * r.powi(5) * v * v).powf(0.4);
                0.5 * (4.0 / 3.0 * PI * rho * r.powi(3)) * v * v - 0.34 * v.sqrt() * area
            };
            let (mut low, mut high) = (1e-9f64, 1e9f64);
            for _ in 0..200 {
                let middle = (low * high).sqrt();
                if excess(middle) > 0.0 { high = middle } else { low = middle }
            }
            let v = capture_velocity(d, k, rho);
            assert!((v / low - 1.0).abs() < 1e-12, "{v} {low}");
        }
    }
}
