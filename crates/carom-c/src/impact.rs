//! What goes into an impact and what comes out, as C sees it.

use carom::Impact;
use std::mem::{offset_of, size_of};

/// Does the sphere stick or bounce?
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// No impact: the sphere is as it was.
    Unmet = -1,
    /// It leaves the wall.
    Rebound = 0,
    /// It stays: it takes the wall's velocity and stops spinning.
    Capture = 1,
}

/// How the contact ended.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// No tangential contact force: no slip, a law that gives the tangential restitution outright, or a capture.
    None = 0,
    /// Sliding to the end of contact.
    Sliding = 1,
    /// Rolling (no slip) at the end of contact.
    Rolling = 2,
    /// Partial slip of an elastic contact.
    MicroSlip = 3,
}

/// A sphere meets a wall. Velocities in one frame, which may be any.
///
/// Zero it, then set `size` to sizeof(carom_impact_in) and what is known: fields left at zero are a sphere without spin, of the law's
/// own density, on a wall at rest. A caller may end the struct after `normal`, or after any later field, with `size` saying so.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ImpactIn {
    /// sizeof(carom_impact_in), set by the caller.
    pub size: usize,
    /// Sphere diameter, m.
    pub diameter: f64,
    /// Sphere density, kg/m3; 0 or NaN for the law's own sphere.
    pub density: f64,
    /// Velocity of the sphere's centre, m/s.
    pub velocity: [f64; 3],
    /// Angular velocity, rad/s.
    pub spin: [f64; 3],
    /// Normal of the wall, from the wall to the sphere; any length but zero.
    pub normal: [f64; 3],
    /// Velocity of the wall at the contact point, m/s.
    pub wall_velocity: [f64; 3],
    /// Uniform draws in [0, 1) for laws that scatter, new ones for each impact: the caller owns the randomness. Zeros are draws like
    /// any other.
    pub draws: [f64; 4],
}

/// Where the kinetic energy relative to the wall, translation plus spin, went: fractions, their sum is 1.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// How the sphere leaves. Set `size` to sizeof(carom_impact_out) before the call; the rest is written by it.
///
/// A caller may end the struct after `tangential_restitution`, or after any later field, with `size` saying so.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ImpactOut {
    /// sizeof(carom_impact_out), set by the caller.
    pub size: usize,
    /// Sticks or bounces: a carom_fate.
    pub fate: i32,
    /// How the contact ended: a carom_contact.
    pub contact: i32,
    /// Velocity of the sphere's centre after the impact, m/s, in the frame of the one before.
    pub velocity: [f64; 3],
    /// Angular velocity after the impact, rad/s.
    pub spin: [f64; 3],
    /// Restitution e, 0 for a capture; may exceed 1 on a wall that scatters.
    pub restitution: f64,
    /// Impulse ratio, tangential over normal; NaN for a capture.
    pub impulse_ratio: f64,
    /// Tangential restitution; NaN for a capture or at normal incidence.
    pub tangential_restitution: f64,
    /// What to mind: bits, see carom_validity_name. 0 is nothing.
    pub validity: u64,
    /// Where the energy went.
    pub energy: Energy,
}

/// The least that tells an impact: up to `normal`.
pub(crate) const LEAST_IN: usize = offset_of!(ImpactIn, wall_velocity);
/// The least that answers: up to `tangential_restitution`.
pub(crate) const LEAST_OUT: usize = offset_of!(ImpactOut, validity);

impl ImpactIn {
    /// What a field means that the caller does not give.
    pub(crate) const DEFAULT: Self = Self {
        size: size_of::<Self>(),
        diameter: 0.0,
        density: 0.0,
        velocity: [0.0; 3],
        spin: [0.0; 3],
        normal: [0.0; 3],
        wall_velocity: [0.0; 3],
        draws: [0.5; 4],
    };

    #[inline(always)]
    pub(crate) fn impact(&self) -> Impact {
        let own = self.density == 0.0 || self.density.is_nan();
        Impact {
            diameter: self.diameter,
            density: if own { None } else { Some(self.density) },
            velocity: self.velocity,
            spin: self.spin,
            normal: self.normal,
            wall_velocity: self.wall_velocity,
            draws: self.draws,
        }
    }
}

impl ImpactOut {
    /// The answer of the core.
    #[inline(always)]
    pub(crate) fn of(outcome: &carom::Outcome, size: usize) -> Self {
        let e = &outcome.energy;
        Self {
            size,
            fate: match outcome.fate {
                carom::Fate::Rebound => Fate::Rebound,
                carom::Fate::Capture => Fate::Capture,
            } as i32,
            contact: match outcome.contact {
                carom::Contact::None => Contact::None,
                carom::Contact::Sliding => Contact::Sliding,
                carom::Contact::Rolling => Contact::Rolling,
                carom::Contact::MicroSlip => Contact::MicroSlip,
            } as i32,
            velocity: outcome.velocity,
            spin: outcome.spin,
            restitution: outcome.restitution,
            impulse_ratio: outcome.impulse_ratio,
            tangential_restitution: outcome.tangential_restitution,
            validity: u64::from(outcome.validity.bits()),
            energy: Energy {
                adhesion: e.adhesion,
                adhesion_damping: e.adhesion_damping,
                hertz_damping: e.hertz_damping,
                plastic: e.plastic,
                other: e.other,
                friction: e.friction,
                captured: e.captured,
                kept: e.kept,
            },
        }
    }

    /// No impact: the sphere goes on as it came.
    #[cold]
    pub(crate) fn unmet(impact: &Impact, size: usize) -> Self {
        Self {
            size,
            fate: Fate::Unmet as i32,
            contact: Contact::None as i32,
            velocity: impact.velocity,
            spin: impact.spin,
            restitution: f64::NAN,
            impulse_ratio: f64::NAN,
            tangential_restitution: f64::NAN,
            validity: 0,
            energy: Energy {
                adhesion: 0.0,
                adhesion_damping: 0.0,
                hertz_damping: 0.0,
                plastic: 0.0,
                other: 0.0,
                friction: 0.0,
                captured: 0.0,
                kept: 1.0,
            },
        }
    }
}
