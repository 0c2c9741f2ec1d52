//! Walton's tangential restitution: as rolling, but the contact point rebounds, v_s′ = −β₀ v_s (`walton`).
//!
//! μ = min(f, (2/7)(1 + β₀)|v_s|/((1 + e)v_n)), 0 ≤ β₀ ≤ 1. β₀ = 0 is rigid-body rolling, β₀ = 1 a lossless reversal of slip.
//! Source: Walton (1993), in Particulate Two-Phase Flow, ed. Roco, Butterworth-Heinemann, ch. 25; measured values of β₀ for many
//! materials in Foerster, Louge, Chang & Allia (1994), Phys. Fluids 6, 1108–1115, <https://doi.org/10.1063/1.868282>.
//!
//! ```
//! // a quarter of the way from rolling to full reversal takes 1.25 times the impulse
//! use carom::tangential::walton::stick_impulse;
//! assert!((stick_impulse(0.25, 7.0) - 1.25 * stick_impulse(0.0, 7.0)).abs() < 1e-15);
//! ```

/// Impulse per mass (m/s) that turns the slip `slip` (m/s) into −β₀ times itself.
#[inline(always)]
pub fn stick_impulse(beta: f64, slip: f64) -> f64 {
    (2.0 / 7.0) * (1.0 + beta) * slip
}
