//! Gravity and buoyancy: a = g (1 − ρ_f/ρ_p) (Archimedes).
//!
//! ```
//! // water's weight in water
//! assert_eq!(carom_track::force::gravity::acceleration([0.0, -9.81, 0.0], 1.0), [0.0, 0.0, 0.0]);
//! ```

use crate::vector::scale;

/// Acceleration (m/s²) in gravity `g` (m/s²) of a sphere for a density ratio ρ_f/ρ_p (0 without buoyancy).
#[inline(always)]
pub fn acceleration(g: [f64; 3], density_ratio: f64) -> [f64; 3] {
    scale(g, 1.0 - density_ratio)
}
