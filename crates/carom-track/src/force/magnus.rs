//! Lift on a spinning sphere (Magnus): F = (π/8) ρ_f d³ g Ω × (u − v), Ω = ½ ∇ × u − ω_p.
//!
//! g = 1 is Rubinow & Keller 1961 (J. Fluid Mech. 11, 447–459, doi:10.1017/S0022112061000640), exact for Re ≪ 1. Beyond,
//! g = C_L/(Re_r/Re) with Oesterlé & Bui Dinh 1998 (Exp. Fluids 25, 16–22, doi:10.1007/s003480050203):
//!
//! C_L = 0.45 + (Re_r/Re − 0.45) e^{−0.05684 Re_r^0.4 Re^0.3},  Re_r = ρ_f d²|Ω|/μ
//!
//! (10 < Re < 140, spin parameter d|Ω|/(2|u − v|) of 1 to 6; it meets Rubinow & Keller as Re → 0). As it stands the lift
//! goes with Ω^0.4 where the spin vanishes, a slope without bound at the turn of the spin, which no integrator passes with its error in
//! hand. So Re_r in it is √(Re_r² + (0.02 Re)²): far below its range, at spin parameters about 0.01, the lift becomes
//! proportional to the spin; at 0.1 it is changed by less than 1 %, at 1 by less than 10⁻⁴.
//!
//! ```
//! use carom_track::{flow::Fluid, force::{Sphere, magnus}};
//! // a ball that flies along +x with back-spin (about +z) in still fluid is lifted: u − v along −x, Ω along −z
//! let a = magnus::acceleration(&Fluid::default(), &Sphere { diameter: 1e-4, density: 1000.0 },
//!                              [-1.0, 0.0, 0.0], [0.0, 0.0, -1000.0]);
//! assert!(a[1] > 0.0);
//! ```

use super::{Sphere, reynolds};
use crate::flow::Fluid;
use crate::vector::{cross, norm, scale};
use carom::math::{exp, pow};

/// Re_r/Re about which the lift becomes proportional to the spin.
const LEAST_SPIN: f64 = 0.02;

/// Acceleration (m/s²) at the relative velocity u − v (m/s) and the relative rotation Ω = ½∇ × u − ω_p (rad/s).
#[inline(always)]
pub fn acceleration(fluid: &Fluid, sphere: &Sphere, relative: [f64; 3], rotation: [f64; 3]) -> [f64; 3] {
    let d = sphere.diameter;
    let re = reynolds(fluid, d, norm(relative));
    let re_r = super::rotational_drag::reynolds(fluid, d, norm(rotation));
    // below this the force is lost against any other, and powers stay in their domain
    if re.min(re_r) < 1e-100 {
        return [0.0; 3];
    }
    let least = LEAST_SPIN * re;
    let re_r = (re_r * re_r + least * least).sqrt();
    // (π/8) ρ_f d³ over the mass (π/6) ρ_p d³
    scale(cross(rotation, relative), 0.75 * fluid.density / sphere.density * reduction(re, re_r))
}

/// Lift over Rubinow & Keller's.
#[inline(always)]
pub fn reduction(reynolds: f64, rotational_reynolds: f64) -> f64 {
    let fade = exp(-0.05684 * pow(rotational_reynolds, 0.4) * pow(reynolds, 0.3));
    fade + 0.45 * (1.0 - fade) * reynolds / rotational_reynolds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rubinow_and_keller_at_small_reynolds() {
        let fluid = Fluid { density: 1.0, viscosity: 1.0, temperature: 300.0, mean_free_path: 0.0 };
        let sphere = Sphere { diameter: 1e-3, density: 1000.0 };
        let a = acceleration(&fluid, &sphere, [0.0, 1e-5, 0.0], [0.0, 0.0, 1e-3]);
        // F = π ρ a³ Ω × V
        let force = std::f64::consts::PI * 0.125e-9 * 1e-8;
        assert!((a[0] * sphere.mass() / -force - 1.0).abs() < 1e-4, "{a:?}");
        assert!(a[1] == 0.0 && a[2] == 0.0);
    }

    #[test]
    fn oesterle_and_bui_dinh() {
        // Re = 100, Re_r = 400: C_L = 0.45 + 3.55 exp(−0.05684 · 400^0.4 · 100^0.3)
        let c_l = 0.45 + 3.55 * (-0.05684 * 400.0f64.powf(0.4) * 100.0f64.powf(0.3)).exp();
        assert!((reduction(100.0, 400.0) * 4.0 - c_l).abs() < 1e-13);
        // fast and spinning: C_L levels off at 0.45, whatever the spin
        assert!((reduction(2000.0, 8000.0) * 4.0 - 0.45).abs() < 0.02);
    }
}
