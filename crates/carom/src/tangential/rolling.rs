//! Rigid-body rolling: Coulomb friction until the slip ends, then rolling (the paper's model, `rolling`).
//!
//! The impulse ratio that just ends slip is μ_roll = (2/7)|v_s|/((1 + e)v_n); μ = min(f, μ_roll). From ω = 0 the angle that divides
//! sliding from rolling is tan α_crit = 2/(7f(1 + e)), α measured from the surface. Kim & Dunn's Eq. 25 prints 2(1 + e)/(7f) instead,
//! which does not follow from the impulse balance and fails against measurements: for f = 0.092, e = 0.98 it gives 80.8°, the
//! balance 57.5°, and spheres measured at those values (Kharaz, Gorham & Salman 2001) leave the sliding line between 60° and 70°.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | v_s | slip velocity of the contact point | m/s |
//! | f | Coulomb friction coefficient | – |
//! | e, v_n | restitution, normal approach speed | –, m/s |
//!
//! Range: a contact stiff in shear. Near normal incidence real spheres show micro-slip instead (0.12 in e_t at 20° from the
//! normal for 5 mm alumina on glass). Source: Kim & Dunn (2007), J. Aerosol Sci. 38, 532–549,
//! <https://doi.org/10.1016/j.jaerosci.2007.03.006>.
//!
//! ```
//! let alpha = carom::tangential::rolling::critical_angle(0.092, 0.98).to_degrees();
//! assert!((alpha - 57.5).abs() < 0.05);
//! ```

/// Angle from the surface (rad) below which a sphere without spin slides to the end, at a given restitution.
pub fn critical_angle(friction: f64, restitution: f64) -> f64 {
    crate::math::atan2(2.0, 7.0 * friction * (1.0 + restitution))
}
