//! Force of the undisturbed flow's pressure gradient and viscous stress: a = (ρ_f/ρ_p) Du/Dt, the fluid's own
//! acceleration (Maxey & Riley 1983, Phys. Fluids 26, 883–889, doi:10.1063/1.864230; spheres small against the flow's
//! scales). Hydrostatic pressure is not in it: that is buoyancy.
//!
//! ```
//! let a = carom_track::force::pressure_gradient::acceleration(0.5, [2.0, 0.0, 0.0]);
//! assert_eq!(a, [1.0, 0.0, 0.0]);
//! ```

use crate::vector::scale;

/// Acceleration (m/s²) for a density ratio ρ_f/ρ_p and Du/Dt (m/s²).
#[inline(always)]
pub fn acceleration(density_ratio: f64, fluid_acceleration: [f64; 3]) -> [f64; 3] {
    scale(fluid_acceleration, density_ratio)
}
