//! Brownian motion as white noise in the acceleration (Li & Ahmadi 1992, Aerosol Sci. Technol. 16, 209–226,
//! doi:10.1080/02786829208959550, as Fluent has it): over a step Δt each component is ζ √(π S₀/Δt), ζ a standard normal,
//!
//! S₀ = 216 ν k_B T/(π² ρ_f d⁵ (ρ_p/ρ_f)² C_c).
//!
//! With Stokes drag and slip, a kick held constant over each step gives the diffusivity of Einstein and Stokes,
//! D = k_B T C_c/(3π μ d), at times long against τ_p for **any** step if the drag is integrated exactly; the velocity's own
//! spread, k_B T/m, needs Δt ≪ τ_p. For spheres below about 1 µm, still compared with the molecules.
//!
//! ```
//! use carom_track::{flow::Fluid, force::{Sphere, brownian}};
//! let (air, sphere) = (Fluid::default(), Sphere { diameter: 1e-7, density: 1000.0 });
//! // 0.1 µm in air: 6.9e-10 m²/s (Hinds 1999, table 7.1)
//! assert!((brownian::diffusivity(&air, &sphere, 2.9) / 6.9e-10 - 1.0).abs() < 0.03);
//! ```

use super::Sphere;
use crate::flow::Fluid;
use std::f64::consts::PI;

/// Boltzmann's constant, J/K (exact in the SI).
pub const BOLTZMANN: f64 = 1.380_649e-23;

/// √(π S₀/Δt), m/s²: the standard deviation of each component of the acceleration over a step (s), for a slip factor C_c.
pub fn brownian_amplitude(fluid: &Fluid, sphere: &Sphere, slip: f64, step: f64) -> f64 {
    (PI * intensity(fluid, sphere, slip) / step).sqrt()
}

/// S₀, m²/s³.
pub fn intensity(fluid: &Fluid, sphere: &Sphere, slip: f64) -> f64 {
    let (d, ratio) = (sphere.diameter, sphere.density / fluid.density);
    let d2 = d * d;
    216.0 * fluid.kinematic_viscosity() * BOLTZMANN * fluid.temperature
        / (PI * PI * fluid.density * d2 * d2 * d * ratio * ratio * slip)
}

/// D = k_B T C_c/(3π μ d), m²/s.
pub fn diffusivity(fluid: &Fluid, sphere: &Sphere, slip: f64) -> f64 {
    BOLTZMANN * fluid.temperature * slip / (3.0 * PI * fluid.viscosity * sphere.diameter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force::{Slip, relaxation_time};
    use crate::random::{Purpose, Stream};

    #[test]
    fn intensity_is_einsteins() {
        let air = Fluid::default();
        let sphere = Sphere { diameter: 2e-7, density: 1500.0 };
        let c = Slip::Davies.factor(2e-7, air.mean_free_path);
        let tau = relaxation_time(&air, &sphere, c);
        let d = 0.5 * tau * tau * PI * intensity(&air, &sphere, c);
        assert!((d / diffusivity(&air, &sphere, c) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn spread_is_two_d_t_and_k_t_over_m() {
        // an ensemble with the drag integrated exactly over each step: displacement 2Dt, and k_B T/m for the velocity
        let (seed, particles, steps) = (7, 4000, 400);
        let air = Fluid::default();
        let sphere = Sphere { diameter: 1e-7, density: 1000.0 };
        let c = Slip::Davies.factor(sphere.diameter, air.mean_free_path);
        let tau = relaxation_time(&air, &sphere, c);
        let step = 0.1 * tau;
        let (amplitude, decay) = (brownian_amplitude(&air, &sphere, c, step), (-step / tau).exp());
        let (mut spread, mut agitation) = (0.0, 0.0);
        for particle in 0..particles {
            let (mut x, mut v) = ([0.0; 3], [0.0; 3]);
            for event in 0..steps {
                let kick = Stream::new(seed, particle, Purpose::Brownian, event).normals::<3>();
                for i in 0..3 {
                    let drift = kick[i] * amplitude * tau;
                    x[i] += drift * step + (v[i] - drift) * tau * (1.0 - decay);
                    v[i] = drift + (v[i] - drift) * decay;
                }
            }
            for i in 0..3 {
                spread += x[i] * x[i] / (3 * particles) as f64;
                agitation += v[i] * v[i] / (3 * particles) as f64;
            }
        }
        // from rest: 2D [t − 2τ(1 − e^{−t/τ}) + τ/2 (1 − e^{−2t/τ})]
        let t = f64::from(steps) * step;
        let want = 2.0 * diffusivity(&air, &sphere, c) * (t - 1.5 * tau);
        let thermal = BOLTZMANN * air.temperature / sphere.mass();
        // four standard errors of a variance, and the step's bias in the velocity (of order (Δt/τ)²/12)
        let error = 4.0 * (2.0 / (3 * particles) as f64).sqrt();
        assert!((spread / want - 1.0).abs() < error, "seed {seed}: {spread} {want}");
        assert!((agitation / thermal - 1.0).abs() < error + 1e-3, "seed {seed}: {agitation} {thermal}");
    }
}
