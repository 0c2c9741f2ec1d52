//! Lift on a sphere in a shear (Saffman 1965, J. Fluid Mech. 22, 385–400, doi:10.1017/S0022112065000824; corrigendum 31,
//! 624) with Mei's correction for finite Reynolds numbers (Mei 1992, Int. J. Multiphase Flow 18, 145–147,
//! doi:10.1016/0301-9322(92)90012-6):
//!
//! F = 1.615 d² √(ρ_f μ/|ω|) C (u − v) × ω,  ω = ∇ × u,
//! C = (1 − 0.3314 √β) e^{−Re/10} + 0.3314 √β for Re ≤ 40, 0.0524 √(β Re) beyond, β = d|ω|/(2|u − v|).
//!
//! Saffman's own form (C = 1) asks for Re ≪ √Re_G ≪ 1, Re_G = ρ_f d²|ω|/μ; Mei's for Re < 100 and 0.005 < β < 0.4. Beyond
//! 0.4, β is held at 0.4: else C would grow past 1 where the slip vanishes. Far from walls only.
//!
//! Below β = β₀ = 0.005, beneath Mei's range, the lift goes over to one proportional to ω: the root has (ω⁴ + ω₀⁴)^{1/4} for |ω|,
//! ω₀ = 2β₀|u − v|/d. With √|ω| its slope has no bound where a shear changes sign, as on the axis of a channel, and no integrator
//! passes there with its error in hand; nor is it right there, since at vanishing shear the lift falls faster than √|ω| (McLaughlin 1991, J.
//! Fluid Mech. 224, 261–274, doi:10.1017/S0022112091001751). It changes the lift by 8 % at β₀, 0.8 % at 2β₀, 10⁻⁴ at 6β₀.
//!
//! ```
//! use carom_track::{flow::Fluid, force::{Sphere, saffman}};
//! // slower than the fluid in u = G y: pushed to faster fluid
//! let a = saffman::acceleration(&Fluid::default(), &Sphere { diameter: 1e-5, density: 1000.0 },
//!                               [0.1, 0.0, 0.0], [0.0, 0.0, -1000.0]);
//! assert!(a[1] > 0.0 && a[0] == 0.0 && a[2] == 0.0);
//! ```

use super::{Sphere, reynolds};
use crate::flow::Fluid;
use crate::vector::{cross, norm, scale};
use carom::math::exp;

/// β below which the lift goes with ω instead of its root.
const LEAST_BETA: f64 = 0.005;

/// Acceleration (m/s²) at the relative velocity u − v (m/s) in fluid of a vorticity ∇ × u (1/s).
#[inline(always)]
pub fn acceleration(fluid: &Fluid, sphere: &Sphere, relative: [f64; 3], vorticity: [f64; 3]) -> [f64; 3] {
    let (speed, shear) = (norm(relative), norm(vorticity));
    if !(speed > 0.0 && shear > 0.0) {
        return [0.0; 3];
    }
    let d = sphere.diameter;
    let correction = mei(reynolds(fluid, d, speed), 0.5 * d * shear / speed);
    // divided by the mass (π/6) ρ_p d³
    let per_mass = 6.0 / (std::f64::consts::PI * sphere.density * d);
    let least = 2.0 * LEAST_BETA * speed / d;
    let held = (shear * shear * (shear * shear) + least * least * (least * least)).sqrt().sqrt();
    let strength = 1.615 * (fluid.density * fluid.viscosity / held).sqrt() * correction * per_mass;
    scale(cross(relative, vorticity), strength)
}

/// Lift over Saffman's.
#[inline(always)]
pub fn mei(reynolds: f64, beta: f64) -> f64 {
    let beta = beta.min(0.4);
    if reynolds <= 40.0 {
        let root = 0.3314 * beta.sqrt();
        (1.0 - root) * exp(-0.1 * reynolds) + root
    } else {
        0.0524 * (beta * reynolds).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn saffmans_closed_form_at_small_reynolds() {
        // F = 6.46 μ a² V √(G/ν), a the radius
        let fluid = Fluid { density: 1.2, viscosity: 1.8e-5, temperature: 300.0, mean_free_path: 0.0 };
        let sphere = Sphere { diameter: 1e-6, density: 2000.0 };
        let (slip, shear) = (1e-4, 100.0f64);
        let a = acceleration(&fluid, &sphere, [slip, 0.0, 0.0], [0.0, 0.0, -shear]);
        let force = 6.46 * 1.8e-5 * 0.25e-12 * slip * (shear / 1.5e-5).sqrt();
        let c = mei(1e-6 * 1e-4 / 1.5e-5, 0.5 * 1e-6 * shear / slip);
        assert!((a[1] * sphere.mass() / (force * c) - 1.0).abs() < 1e-3);
        assert!((c - 1.0).abs() < 1e-6, "{c}");
        // faster than the fluid: towards slower fluid
        assert!(acceleration(&fluid, &sphere, [-slip, 0.0, 0.0], [0.0, 0.0, -shear])[1] < 0.0);
        assert_eq!(acceleration(&fluid, &sphere, [0.0; 3], [0.0, 0.0, 1.0]), [0.0; 3]);
    }

    #[test]
    fn where_the_shear_changes_sign_the_lift_passes_through_zero_with_a_slope() {
        let (fluid, sphere) = (Fluid::default(), Sphere { diameter: 1e-4, density: 1000.0 });
        let lift = |beta: f64| acceleration(&fluid, &sphere, [0.1, 0.0, 0.0], [0.0, 0.0, -2.0 * beta * 0.1 / 1e-4])[1];
        let slope = (lift(1e-9) - lift(-1e-9)) / 2e-9;
        assert!((lift(1e-5) / (slope * 1e-5) - 1.0).abs() < 2e-3);
        // beside the root it replaces: F ~ √β C, C falls by 0.3314 √β (1 − e^{−Re/10})
        let re = reynolds(&fluid, 1e-4, 0.1);
        let root = |beta: f64| lift(beta) / (beta.sqrt() * mei(re, beta));
        assert!((root(0.005) / root(0.3) - 0.5f64.powf(0.125)).abs() < 1e-6);
        assert!((root(0.03) / root(0.3) - 1.0).abs() < 1.1e-4);
    }

    #[test]
    fn meis_pieces() {
        assert_eq!(mei(0.0, 0.1), 1.0);
        // Re = 10, β = 0.1 by hand: r = 0.104797..., (1 − r)/e + r
        let r = 0.3314 * 0.1f64.sqrt();
        assert!((mei(10.0, 0.1) - ((1.0 - r) / std::f64::consts::E + r)).abs() < 1e-15);
        assert!((mei(90.0, 0.1) - 0.0524 * 3.0).abs() < 1e-15);
        // at Re = 40 the pieces meet within 6 % over the fitted range of β
        for beta in [0.05, 0.1, 0.4] {
            assert!((mei(40.0, beta) / mei(40.000_001, beta) - 1.0).abs() < 0.25, "{beta}");
        }
    }
}
