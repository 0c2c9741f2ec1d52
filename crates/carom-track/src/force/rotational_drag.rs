//! Torque of the fluid on a spinning sphere: dω_p/dt = (60 μ/(ρ_p d²)) h Ω, Ω = ½ ∇ × u − ω_p.
//!
//! h = 1 is the exact torque π μ d³ Ω at small Re_r = ρ_f d²|Ω|/μ (Rubinow & Keller 1961, doi:10.1017/S0022112061000640,
//! and Lamb before them). Dennis, Singh & Ingham 1980 (J. Fluid Mech. 101, 257–279, doi:10.1017/S0022112080001656):
//! C_r = 12.9/√Re_r + 128.4/Re_r for 32 < Re_r < 4000, against 64π/Re_r below. The two are joined where they cross,
//! h = max(1, (12.9 √Re_r + 128.4)/64π), Re_r ≈ 31.7, so the torque is continuous.
//!
//! ```
//! use carom_track::{flow::Fluid, force::{Sphere, rotational_drag}};
//! let a = rotational_drag::spin_rate(&Fluid::default(), &Sphere { diameter: 1e-4, density: 1000.0 }, [0.0, 0.0, -100.0]);
//! assert!(a[2] < 0.0);                                // towards the fluid's own rotation
//! ```

use super::Sphere;
use crate::flow::Fluid;
use crate::vector::{norm, scale};

/// dω_p/dt (rad/s²) at the relative rotation Ω = ½∇ × u − ω_p (rad/s).
#[inline(always)]
pub fn spin_rate(fluid: &Fluid, sphere: &Sphere, rotation: [f64; 3]) -> [f64; 3] {
    scale(rotation, rate(fluid, sphere, rotation))
}

/// The rate at which the relative rotation dies at Ω (rad/s), 1/s.
#[inline(always)]
pub fn rate(fluid: &Fluid, sphere: &Sphere, rotation: [f64; 3]) -> f64 {
    let d = sphere.diameter;
    let h = torque_factor(reynolds(fluid, d, norm(rotation)));
    60.0 * fluid.viscosity / (sphere.density * d * d) * h
}

/// ρ_f d²|Ω|/μ for a diameter (m) and a relative rotation (rad/s).
#[inline(always)]
pub fn reynolds(fluid: &Fluid, diameter: f64, rotation: f64) -> f64 {
    rotation * (diameter * diameter * fluid.density / fluid.viscosity)
}

/// Torque over that of creeping flow.
#[inline(always)]
pub fn torque_factor(rotational_reynolds: f64) -> f64 {
    const CREEPING: f64 = 64.0 * std::f64::consts::PI;
    ((12.9 * rotational_reynolds.sqrt() + 128.4) * (1.0 / CREEPING)).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn creeping_torque() {
        let fluid = Fluid { density: 1.2, viscosity: 1.8e-5, temperature: 300.0, mean_free_path: 0.0 };
        let sphere = Sphere { diameter: 1e-5, density: 2500.0 };
        let rate = spin_rate(&fluid, &sphere, [0.0, 50.0, 0.0])[1];
        let inertia = 0.1 * sphere.mass() * 1e-10;
        let torque = std::f64::consts::PI * 1.8e-5 * 1e-15 * 50.0;
        assert!((rate * inertia / torque - 1.0).abs() < 1e-13);
    }

    #[test]
    fn dennis_and_others_table() {
        // Dennis, Singh & Ingham 1980 in their own variables: M = 6.45/√R + 32.1/R, R = Re_r/4, M = C_r/… with creeping 16π/R
        for r in [20.0f64, 100.0, 1000.0] {
            let own = (6.45 / r.sqrt() + 32.1 / r) / (16.0 * std::f64::consts::PI / r);
            assert!((torque_factor(4.0 * r) / own - 1.0).abs() < 1e-12, "{r}");
        }
        assert_eq!(torque_factor(31.0), 1.0);
        assert!(torque_factor(32.0) > 1.0 && torque_factor(32.0) < 1.01);
    }
}
