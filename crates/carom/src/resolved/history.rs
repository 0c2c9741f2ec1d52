//! Time histories of a resolved contact.

use super::Resolved;
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use crate::math::{self, BEST};
use crate::normal::Size;
use alloc::vec::Vec;
use core::f64::consts::PI;

/// Scales that turn the dimensionless contact into SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Hertzian stiffness K, Pa.
    pub stiffness: f64,
    /// Sphere density, kg/m³ (the law's own; the size's ratio is applied).
    pub density: f64,
}

/// One moment of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Time since first contact, s.
    pub time: f64,
    /// Overlap x, m.
    pub overlap: f64,
    /// ẋ, m/s: positive on approach.
    pub speed: f64,
    /// Hertz force without damping, N.
    pub hertz_force: f64,
    /// Net force on the sphere, N, positive away from the wall.
    pub net_force: f64,
    /// Slip of the contact point, m/s, along its initial direction; 0 once it rolls.
    pub slip: f64,
}

impl Resolved {
    /// The contact from first touch to its end, at least `points` moments; initial slip (m/s) and friction coefficient give the
    /// tangential motion (Eqs 26–28): Coulomb's law on the Hertz force until the slip ends.
    pub fn history(
        &self,
        v: f64,
        size: &Size,
        scales: &Scales,
        slip: f64,
        friction: f64,
        points: usize,
    ) -> Vec<Moment> {
        let contact = self.contact(BEST, v, size);
        let mass = 4.0 / 3.0 * PI * scales.density * size.density_ratio * size.radius * size.radius * size.radius;
        let r = size.radius * size.kappa;
        let length = math::pow(mass * v * v / (r.sqrt() * scales.stiffness), 0.4);
        let force = mass * v * v / length;
        // the steps' length bounds their number from below: s runs up to about 1 and back at a speed of at most 1
        let longest = 2.0 / points.clamp(4, 100_000) as f64;
        let mut moments = Vec::new();
        contact.solve(BEST, longest, &mut |state, adhesive| {
            let s = state.s.max(0.0);
            let hertz = s * s * s;
            let pull = if adhesive { contact.adhesion * s } else { 0.0 };
            let net =
                hertz * (1.0 + contact.hertz_damping * state.u) - pull * (1.0 - contact.adhesion_damping * state.u);
            moments.push(Moment {
                time: state.rides.time * length / v,
                overlap: s * s * length,
                speed: state.u * v,
                hertz_force: hertz * force,
                net_force: net * force,
                slip: slip.signum() * (slip.abs() - 3.5 * friction * state.rides.impulse * v).max(0.0),
            });
        });
        moments
    }
}
