//! Added mass: F = ½ m_f (Du/Dt − dv/dt), half of the displaced mass m_f (Auton, Hunt & Prud'homme 1988, J. Fluid Mech.
//! 197, 241–257, doi:10.1017/S0022112088003246; exact for a sphere in inviscid flow). Solved for dv/dt:
//!
//! dv/dt = (a + ½ s Du/Dt)/(1 + ½ s), s = ρ_f/ρ_p, a the acceleration by all other forces.
//!
//! ```
//! // a massless bubble released from rest in still fluid rises with twice gravity: a = g (1 − s), s → ∞
//! let s = 1e9;
//! let a = carom_track::force::added_mass::solve(s, [0.0, -9.81 * (1.0 - s), 0.0], [0.0; 3]);
//! assert!((a[1] - 2.0 * 9.81).abs() < 1e-6);
//! ```

use crate::vector::{add, scale};

/// dv/dt (m/s²) from the other forces' acceleration and Du/Dt (m/s²), for a density ratio ρ_f/ρ_p.
#[inline(always)]
pub fn solve(density_ratio: f64, others: [f64; 3], fluid_acceleration: [f64; 3]) -> [f64; 3] {
    let half = 0.5 * density_ratio;
    scale(add(others, scale(fluid_acceleration, half)), share(density_ratio))
}

/// What it leaves of the other forces' acceleration.
#[inline(always)]
pub fn share(density_ratio: f64) -> f64 {
    1.0 / (1.0 + 0.5 * density_ratio)
}
