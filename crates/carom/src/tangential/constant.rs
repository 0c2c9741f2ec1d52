//! Tangential restitution given outright, `constant` or `by-angle`: V_t = e_t v_t of the centre, the spin untouched.
//!
//! It is what Fluent's `reflect` and OpenFOAM's `rebound` do. The spin must stay as it is: an impulse that also spun the sphere could
//! create energy. |e_t| ≤ 1. Curves measured by incidence angle: [`crate::normal::empirical`].
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | v_t, V_t | tangential speed of the centre before and after | m/s |
//! | e_t | tangential restitution | – |
//!
//! Source: ANSYS Fluent's theory guide, discrete phase boundary conditions (`reflect`).
//!
//! ```
//! assert_eq!(carom::tangential::constant::rebound(0.9, 10.0), 9.0);
//! ```

/// Tangential speed after the impact, m/s.
#[inline(always)]
pub fn rebound(tangential_restitution: f64, v_t: f64) -> f64 {
    tangential_restitution * v_t
}
