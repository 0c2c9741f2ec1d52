//! An impact in the plane, as people ask for it: a size, a speed, an angle, a spin; and what comes out, in the same terms.

use crate::units::{Angle, AngularVelocity, Length, Speed, UnitError};
use crate::{Fate, Impact, ImpactError, Outcome, WallLaw, math};
use alloc::format;
use alloc::string::{String, ToString};

/// How a sphere comes to a wall.
///
/// ```
/// use carom::plane::{Motion, speed};
/// # let law = "sphere = 'copper'\nsurface = 'glass'\nnormal = 'constant'\nrestitution = 0.5\nfriction = 0";
/// # let wall = carom::spec::parse_law(law)?.compile(carom::material::Library::builtin())?;
/// let motion = Motion { diameter: 90e-6, speed: speed("2 m/s")?, angle: 30.0, spin: 0.0 };
/// let met = motion.meet(&wall)?;
/// // half of 1 m/s goes up, √3 m/s go on
/// assert!((met.normal - 0.5).abs() < 1e-15 && (met.tangential - 3f64.sqrt()).abs() < 1e-15);
/// assert!((met.angle() - (0.5 / 3f64.sqrt()).atan().to_degrees()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Diameter, m.
    pub diameter: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Angle from the surface, degrees; 90 is head-on.
    pub angle: f64,
    /// Spin, rad/s, positive when it rolls forward.
    pub spin: f64,
}

impl Motion {
    /// Normal and tangential speed, m/s.
    pub fn components(&self) -> (f64, f64) {
        crate::impact::components(self.speed, self.angle)
    }

    /// The impact, on a wall at y = 0 with the sphere above it moving along +x.
    pub fn impact(&self) -> Impact {
        Impact::in_plane(self.diameter, self.speed, self.angle, self.spin)
    }

    /// What the wall makes of it; one that scatters takes every draw at 1/2.
    ///
    /// # Errors
    /// As [`WallLaw::impact`].
    pub fn meet(&self, wall: &WallLaw) -> Result<Met, ImpactError> {
        self.meet_drawn(wall, [0.5; 4])
    }

    /// Likewise, with the draws of a wall that scatters.
    ///
    /// # Errors
    /// As [`WallLaw::impact`].
    #[inline(never)] // one copy of an impact is enough for a caller
    pub fn meet_drawn(&self, wall: &WallLaw, draws: [f64; 4]) -> Result<Met, ImpactError> {
        wall.impact(&Impact { draws, ..self.impact() }).map(Met::from)
    }
}

/// An outcome in the plane of the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// The core's answer.
    pub outcome: Outcome,
    /// Normal speed after, m/s, 0 for a capture.
    pub normal: f64,
    /// Tangential speed after, m/s, negative when it goes back.
    pub tangential: f64,
    /// Spin after, rad/s.
    pub spin: f64,
}

impl From<Outcome> for Met {
    fn from(outcome: Outcome) -> Self {
        // without the signs of zeros, which say nothing here
        let [tangential, normal] = [outcome.velocity[0] + 0.0, outcome.velocity[1] + 0.0];
        Self { outcome, normal, tangential, spin: 0.0 - outcome.spin[2] }
    }
}

impl Met {
    /// Did it rebound?
    pub fn rebounds(&self) -> bool {
        self.outcome.fate == Fate::Rebound
    }

    /// Speed after, m/s.
    pub fn speed(&self) -> f64 {
        libm::hypot(libm::hypot(self.normal, self.tangential), self.outcome.velocity[2])
    }

    /// Angle after from the surface, degrees, beyond 90 when it goes back, as seen from the side; NaN for a capture.
    pub fn angle(&self) -> f64 {
        if self.rebounds() { math::atan2(self.normal, self.tangential).to_degrees() } else { f64::NAN }
    }
}

/// Diameters that a sphere may have, m.
pub const DIAMETERS: (f64, f64) = (1e-10, 1.0);

/// A diameter as people write it, in metres.
///
/// # Errors
/// What is wrong with the text, or the range.
pub fn diameter(text: &str) -> Result<f64, String> {
    let Length(value) = text.parse().map_err(said)?;
    let right = "a diameter lies between 0.1 nm and 1 m, such as 90um; a bare number is in metres";
    within(text, value, (DIAMETERS.0..=DIAMETERS.1).contains(&value), right)
}

/// A speed of approach, m/s.
///
/// # Errors
/// What is wrong with the text, or the range.
pub fn speed(text: &str) -> Result<f64, String> {
    let Speed(value) = text.parse().map_err(said)?;
    within(text, value, value > 0.0 && value < 1e9, "a speed lies above 0 and below 1e9 m/s")
}

/// An angle from the surface: degrees, unless a unit is written.
///
/// # Errors
/// What is wrong with the text, or the range.
pub fn angle(text: &str) -> Result<f64, String> {
    // by hand, so that 30deg is 30 to the last bit
    let bare = text.trim().trim_end_matches("deg").trim_end_matches('°').trim_end();
    let degrees = match bare.parse::<f64>() {
        Ok(number) => number,
        Err(_) => text.parse::<Angle>().map_err(said)?.0.to_degrees(),
    };
    let right = "an angle is measured from the surface, above 0 and up to 90 degrees (head-on)";
    within(text, degrees, degrees > 0.0 && degrees <= 90.0, right)
}

/// A spin, rad/s.
///
/// # Errors
/// What is wrong with the text, or the range.
pub fn spin(text: &str) -> Result<f64, String> {
    let AngularVelocity(value) = text.parse().map_err(said)?;
    within(text, value, value.abs() < 1e100, "a spin lies below 1e100 rad/s")
}

fn said(error: UnitError) -> String {
    error.to_string()
}

fn within(text: &str, value: f64, fits: bool, right: &str) -> Result<f64, String> {
    if fits { Ok(value) } else { Err(format!("{text} is out of range; {right}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_degrees_unless_said_otherwise() {
        assert_eq!(angle("30"), Ok(30.0));
        assert_eq!(angle("30 deg").map(f64::round), Ok(30.0));
        assert!((angle("0.5rad").expect("fits") - 28.6479).abs() < 1e-4);
        for wrong in ["0", "-5", "90.0001", "91", "NaN", "inf", "2rad", "30m"] {
            assert!(angle(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn what_is_no_sphere_and_no_approach_is_refused() {
        assert_eq!(diameter("90um"), Ok(90e-6));
        assert!(diameter("2 m").is_err_and(|e| e.contains("between 0.1 nm and 1 m")));
        assert!(speed("0").is_err() && speed("1e9").is_err() && speed("2 kg").is_err());
        assert!(spin("-300").is_ok_and(|v| v == -300.0) && spin("1e101").is_err());
    }
}
