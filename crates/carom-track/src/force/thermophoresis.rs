//! Thermophoresis: in a gas a sphere drifts from warm to cold.
//!
//! Talbot, Cheng, Schefer & Willis 1980 (J. Fluid Mech. 101, 737–758, doi:10.1017/S0022112080001905), their fit between Brock's slip
//! flow and Waldmann's free molecules, for every Kn = 2λ/d:
//!
//! F = −6π μ² d C_s (κ + C_t Kn) ∇T/(ρ T (1 + 3 C_m Kn)(1 + 2κ + 2 C_t Kn)),  κ = k_g/k_p,
//!
//! C_s = 1.17, C_t = 2.18, C_m = 1.14; k_p the sphere's thermal conductivity, k_g the gas's of translation alone, (15/4) μ R/M.
//! The drift is F C_c/(3πμd) with the run's slip law. As Kn → 0 it is −2 C_s ν κ/(1 + 2κ) ∇T/T; as Kn → ∞, −0.551 ν ∇T/T with
//! Talbot's own C_c (1.61 Kn), −0.567 with Davies' (1.657 Kn), where Waldmann's is −0.539 for diffuse reflection. Talbot & others: within 20 % of
//! all measurements. Below Kn = 0.1, at κ ≪ 1, it is the least sure. For |∇T| λ ≪ T and |∇T| d ≪ T.
//!
//! ```
//! use carom_track::{flow::Fluid, force::{Sphere, thermophoresis}};
//! let (air, sphere) = (Fluid::default(), Sphere { diameter: 1e-6, density: 1000.0 });
//! let a = thermophoresis::acceleration(&air, &sphere, 0.2, 297.15, [0.0, 1e4, 0.0]);
//! assert!(a[1] < 0.0 && a[0] == 0.0); // towards the cold
//! ```

use super::Sphere;
use crate::flow::Fluid;
use crate::vector::scale;

const SLIP: f64 = 1.17;
const JUMP: f64 = 2.18;
const MOMENTUM: f64 = 1.14;

/// Acceleration (m/s²) of a sphere of a conductivity (W/(m K)) in gas of a temperature (K) that rises by `gradient` (K/m).
#[inline(always)]
pub fn acceleration(
    fluid: &Fluid,
    sphere: &Sphere,
    conductivity: f64,
    temperature: f64,
    gradient: [f64; 3],
) -> [f64; 3] {
    let d = sphere.diameter;
    let kn = 2.0 * fluid.mean_free_path / d;
    let ratio = gas_conductivity(fluid) / conductivity;
    let shape = SLIP * (ratio + JUMP * kn) / ((1.0 + 3.0 * MOMENTUM * kn) * (1.0 + 2.0 * ratio + 2.0 * JUMP * kn));
    // divided by the mass (π/6) ρ_p d³
    let strength = 36.0 * fluid.viscosity * fluid.viscosity * shape / (fluid.density * sphere.density * d * d);
    scale(gradient, -strength / temperature)
}

/// (15/4) μ R/M, with R/M from c̄ = √(8RT/(πM)), W/(m K).
#[inline(always)]
fn gas_conductivity(fluid: &Fluid) -> f64 {
    let speed = fluid.molecular_speed();
    3.75 * fluid.viscosity * std::f64::consts::PI * speed * speed / (8.0 * fluid.temperature)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::GasState;
    use crate::force::{Slip, relaxation_time};

    /// −v T/(ν ∇T): the reduced drift.
    fn reduced(fluid: &Fluid, diameter: f64, conductivity: f64, slip: f64) -> f64 {
        let sphere = Sphere { diameter, density: 1234.0 };
        let a = acceleration(fluid, &sphere, conductivity, fluid.temperature, [0.0, 0.0, 1e3]);
        -a[2] * relaxation_time(fluid, &sphere, slip) * fluid.temperature / (fluid.kinematic_viscosity() * 1e3)
    }

    #[test]
    fn the_gas_conducts_by_translation() {
        // (15/4) μ R/M of air at 24 °C: 1.8325e-5 × 287.05 × 3.75
        let got = gas_conductivity(&Fluid::default());
        assert!((got / 0.019_726 - 1.0).abs() < 1e-3, "{got}");
    }

    #[test]
    fn drift_is_talbots() {
        // their Eq. for the velocity, with C_c in it, worked out independently at Kn = 0.01 to 100 and κ = 0.1
        let air = Fluid::default();
        let conductivity = 10.0 * gas_conductivity(&air);
        for (kn, want) in [(0.01, 0.224_263), (0.1, 0.379_601), (1.0, 0.514_533), (10.0, 0.544_470), (100.0, 0.550_108)]
        {
            let talbot = 1.0 + kn * (1.2 + 0.41 * carom::math::exp(-0.88 / kn));
            let got = reduced(&air, 2.0 * air.mean_free_path / kn, conductivity, talbot);
            assert!((got / want - 1.0).abs() < 1e-3, "{kn} {got} {want}");
        }
    }

    #[test]
    fn limits() {
        let state = GasState { pressure: Some(1.0), ..GasState::default() };
        let thin = state.fluid().unwrap();
        // free molecules: Waldmann's 3/(4 (1 + π/8)), whatever the sphere conducts
        let waldmann = 0.75 / (1.0 + std::f64::consts::PI / 8.0);
        for conductivity in [0.01, 400.0] {
            let d = 1e-8;
            let drift = reduced(&thin, d, conductivity, Slip::Davies.factor(d, thin.mean_free_path));
            assert!((drift / 0.567 - 1.0).abs() < 2e-3 && (drift / waldmann - 1.0).abs() < 0.06, "{drift}");
        }
        // a continuum: −2 C_s ν κ/(1 + 2κ) ∇T/T
        let air = Fluid { mean_free_path: 66e-9, ..Fluid::default() };
        let ratio = gas_conductivity(&air) / 0.05;
        let drift = reduced(&air, 5.0, 0.05, 1.0);
        assert!((drift / (2.0 * 1.17 * ratio / (1.0 + 2.0 * ratio)) - 1.0).abs() < 1e-5, "{drift}");
    }
}
