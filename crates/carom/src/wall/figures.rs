//! Figures of a wall law: the window of rebound (capture velocity), yield velocity, critical angle, adhesion numbers.

use super::WallLaw;
use crate::impact::ImpactError;
use crate::math::root::sign_change;
use crate::math::{BEST, sin_cos};
use crate::normal::{NormalLaw, Window};
use crate::roughness::{AdhesionNumbers, adhesion_numbers};
use crate::tangential::{Tangential, walton};

impl WallLaw {
    /// The share of the normal kinetic energy that a head-on impact at `speed` (m/s) leaves, 1 − Σ ε(v): e² where the sphere
    /// rebounds, and below zero where the losses of a ledger ask for more than there is. So it tells how far a capture is from a rebound.
    ///
    /// # Errors
    /// A diameter out of range.
    pub fn energy_left(&self, speed: f64, diameter: f64) -> Result<f64, ImpactError> {
        let size = self.size(diameter, None)?;
        Ok(1.0 - self.kernel.normal.respond(BEST, &self.pieces, speed, 0.0, &size).lost())
    }

    /// The window of rebound for a sphere of diameter `diameter` (m): `Ok(None)` when it never rebounds. Table laws have none and
    /// answer with the whole range of speeds.
    ///
    /// # Errors
    /// A diameter or density out of range.
    pub fn window(&self, diameter: f64, density: Option<f64>) -> Result<Option<Window>, ImpactError> {
        let size = self.size(diameter, density)?;
        Ok(match &self.kernel.normal {
            NormalLaw::Ledger(ledger) => ledger.window(&size),
            NormalLaw::Table(_) => Some(Window::ALL),
            NormalLaw::Resolved(resolved) => resolved.window(&size),
        })
    }

    /// Yield velocity of the law's own plastic loss, m/s; `None` for a law without one.
    ///
    /// # Errors
    /// A diameter or density out of range.
    pub fn yield_velocity(&self, diameter: f64, density: Option<f64>) -> Result<Option<f64>, ImpactError> {
        let size = self.size(diameter, density)?;
        Ok(match &self.kernel.normal {
            NormalLaw::Ledger(ledger) => ledger.yield_velocity(&size),
            _ => None,
        })
    }

    /// The capture velocity that user-defined functions of flow solvers compute for this pair, m/s, for comparison: it knows nothing of
    /// the pair's adhesion, see [`crate::normal::el_batsh`]. `None` without a stiffness and a density.
    pub fn el_batsh_capture_velocity(&self, diameter: f64) -> Option<f64> {
        let pair = self.about.pair.as_ref()?;
        Some(crate::normal::el_batsh::capture_velocity(diameter, pair.stiffness().ok()?, pair.density().ok()?))
    }

    /// Critical angle from the surface (rad) at a given speed (m/s), for a sphere without spin: below it the sphere slides to the end.
    /// The restitution is the law's own at that angle's normal speed. `None` for tangential laws without friction.
    ///
    /// # Errors
    /// A diameter or density out of range.
    pub fn critical_angle(&self, diameter: f64, density: Option<f64>, speed: f64) -> Result<Option<f64>, ImpactError> {
        let size = self.size(diameter, density)?;
        let Some(friction) = self.tangential().friction() else { return Ok(None) };
        if friction <= 0.0 {
            return Ok(Some(core::f64::consts::FRAC_PI_2));
        }
        // sliding to the end ⇔ f(1 + e)v_n < (2/7)(1 + β₀)v_t
        let excess = |angle: f64| {
            let (s, c) = sin_cos(angle);
            let response = self.kernel.normal.respond(BEST, &self.pieces, speed * s, (speed * c) * (speed * c), &size);
            let cap = friction * response.friction_share * (1.0 + response.e) * s;
            match self.tangential() {
                Tangential::Friction { beta, .. } => cap - walton::stick_impulse(*beta, c),
                Tangential::MicroSlip(law) => law.sliding_slip(BEST, cap, response.e) - c,
                Tangential::Restitution(_) | Tangential::NotGiven => 0.0,
            }
        };
        Ok(Some(sign_change(1e-9, core::f64::consts::FRAC_PI_2, excess)))
    }

    /// Tabor's parameter, its verdict and the adhesion parameter: the asperities' where Fuller & Tabor's C_R is in force, which it
    /// decides, else the sphere's; `None` without materials that have a work of adhesion.
    ///
    /// # Errors
    /// A diameter out of range.
    pub fn adhesion_numbers(&self, diameter: f64) -> Result<Option<AdhesionNumbers>, ImpactError> {
        let size = self.size(diameter, None)?;
        let Some(pair) = &self.about.pair else { return Ok(None) };
        let (Ok(w), Ok(e_star)) = (pair.work_of_adhesion(), pair.effective_modulus()) else { return Ok(None) };
        let of = |radius| adhesion_numbers(radius, w, e_star, self.about.spacing, self.about.roughness);
        Ok((w > 0.0).then(|| {
            let sphere = of(size.radius * size.kappa);
            match self.about.asperity_radius {
                Some(radius) => {
                    AdhesionNumbers { adhesion_parameter: of(radius).adhesion_parameter, asperities: true, ..sphere }
                }
                None => sphere,
            }
        }))
    }
}
