//! What goes into an impact and what comes out.

use crate::math::{BEST, Fma, sin_cos_on};
use crate::tangential::Contact;
use crate::validity::Validity;
use core::f64::consts::PI;

/// A vector in any right-handed frame, SI units.
pub type Vec3 = [f64; 3];

/// A sphere meets a wall. SI units; velocities in one frame, which may be any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Sphere diameter, m.
    pub diameter: f64,
    /// Sphere density, kg/m³; `None` for the law's own sphere.
    pub density: Option<f64>,
    /// Velocity of the sphere's centre, m/s.
    pub velocity: Vec3,
    /// Angular velocity, rad/s.
    pub spin: Vec3,
    /// Normal of the wall, pointing from the wall to the sphere; any length but zero.
    pub normal: Vec3,
    /// Velocity of the wall at the contact point, m/s.
    pub wall_velocity: Vec3,
    /// Uniform draws in [0, 1) for walls that scatter ([`crate::scatter`]); the caller owns the randomness. Smooth walls use none.
    pub draws: [f64; 4],
}

impl Impact {
    /// A sphere without spin, of the law's own density, on a wall at rest.
    pub fn new(diameter: f64, velocity: Vec3, normal: Vec3) -> Self {
        Self { diameter, density: None, velocity, spin: [0.0; 3], normal, wall_velocity: [0.0; 3], draws: [0.5; 4] }
    }

    /// Likewise, in the plane: on a wall at y = 0 with the sphere above it moving along +x, at a speed (m/s) and an angle ([`components`]),
    /// with a spin (rad/s) that is positive when it rolls forward.
    pub fn in_plane(diameter: f64, speed: f64, angle_deg: f64, spin: f64) -> Self {
        let (normal, tangential) = components(speed, angle_deg);
        Self { spin: [0.0, 0.0, -spin], ..Self::new(diameter, [tangential, -normal, 0.0], [0.0, 1.0, 0.0]) }
    }
}

/// Normal and tangential speed, m/s, of a sphere that comes at a speed (m/s) and an angle (degrees from the surface; 90 is head-on and has
/// no tangential speed at all).
///
/// ```
/// let (normal, tangential) = carom::impact::components(2.0, 30.0);
/// assert!((normal - 1.0).abs() < 1e-15 && (tangential - 3f64.sqrt()).abs() < 1e-15);
/// assert_eq!(carom::impact::components(2.0, 90.0), (2.0, 0.0));
/// ```
#[inline]
pub fn components(speed: f64, angle_deg: f64) -> (f64, f64) {
    components_on(BEST, speed, angle_deg)
}

/// As [`components`].
#[inline(always)]
pub fn components_on<F: Fma>(f: F, speed: f64, angle_deg: f64) -> (f64, f64) {
    // π/2 is no double
    if angle_deg == 90.0 {
        return (speed, 0.0);
    }
    let (sin, cos) = sin_cos_on(f, angle_deg * (PI / 180.0));
    (speed * sin, speed * cos)
}

/// Sticks or bounces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
pub enum Fate {
    /// It leaves the wall.
    Rebound,
    /// It stays: it takes the wall's velocity and stops spinning.
    Capture,
}

impl Fate {
    /// The word in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rebound => "rebound",
            Self::Capture => "capture",
        }
    }
}

/// Where the incident kinetic energy went: fractions of the kinetic energy relative to the wall, translation plus spin.
/// They are ≥ 0 and sum to 1 (give or take rounding).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Energy {
    /// Work of adhesion.
    pub adhesion: f64,
    /// Adhesion damping.
    pub adhesion_damping: f64,
    /// Hertzian damping.
    pub hertz_damping: f64,
    /// Plastic deformation.
    pub plastic: f64,
    /// Normal loss of a table law, which names no mechanism.
    pub other: f64,
    /// Tangential loss.
    pub friction: f64,
    /// What was left when a captured sphere stopped.
    pub captured: f64,
    /// What the rebound keeps.
    pub kept: f64,
}

impl Energy {
    /// Of a motion whose loss along the normal has no mechanism's name: that loss, friction's share and what is kept.
    pub const fn without_mechanism(other: f64, friction: f64, kept: f64) -> Self {
        Self {
            adhesion: 0.0,
            adhesion_damping: 0.0,
            hertz_damping: 0.0,
            plastic: 0.0,
            other,
            friction,
            captured: 0.0,
            kept,
        }
    }

    /// Names and values, in the order of the results.
    pub fn named(&self) -> [(&'static str, f64); 8] {
        [
            ("adhesion", self.adhesion),
            ("adhesion_damping", self.adhesion_damping),
            ("hertz_damping", self.hertz_damping),
            ("plastic", self.plastic),
            ("other", self.other),
            ("friction", self.friction),
            ("captured", self.captured),
            ("kept", self.kept),
        ]
    }
}

/// How the sphere leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Outcome {
    /// Sticks or bounces.
    pub fate: Fate,
    /// Velocity of the centre after the impact, m/s, in the frame of the [`Impact`].
    pub velocity: Vec3,
    /// Angular velocity after the impact, rad/s.
    pub spin: Vec3,
    /// e, 0 for a capture; at most 1, but for a wall that scatters ([`crate::scatter`]): there it takes the speeds normal to the mean
    /// wall and may exceed 1 at shallow angles.
    pub restitution: f64,
    /// μ = |Δv_t|/((1 + e)v_n); NaN for a capture.
    pub impulse_ratio: f64,
    /// e_t = V_t/v_t along the incoming tangential direction; NaN for a capture or at normal incidence.
    pub tangential_restitution: f64,
    /// How the contact ended.
    pub contact: Contact,
    /// Where the energy went.
    pub energy: Energy,
    /// What to mind about this result.
    pub validity: Validity,
}

/// An impact that is none. The sphere is as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImpactError {
    /// The sphere does not move towards the wall.
    NotApproaching,
    /// The diameter is not between 0.1 nm and 1 m.
    Diameter,
    /// The density is not positive, or not within a factor of 1000 of the law's sphere.
    Density,
    /// A velocity, spin or normal is NaN or infinite, the motion is beyond about 1e9 m/s, or a wall that scatters is given a draw outside
    /// [0, 1).
    NotFinite,
    /// The sphere slips along the wall, and the law was given no friction coefficient.
    FrictionNotGiven,
    /// The concave surface is not wider than the sphere.
    Curvature,
}

impl core::error::Error for ImpactError {}

impl core::fmt::Display for ImpactError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::NotApproaching => {
                "the sphere does not approach the wall: the velocity relative to it, along the normal, must be negative"
            }
            Self::Diameter => "the diameter must lie between 1e-10 m and 1 m",
            Self::Density => "the density must be positive and within a factor of 1000 of the law's sphere",
            Self::NotFinite => {
                "velocities and spins must be finite and below 1e9 m/s at the surface, the normal finite and not zero, draws in [0, 1)"
            }
            Self::Curvature => "the surface is concave and its radius of curvature must exceed the sphere's radius",
            Self::FrictionNotGiven => "the sphere slips along the wall, and the law has no friction coefficient",
        })
    }
}
