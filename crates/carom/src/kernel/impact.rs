//! One impact in space. The normal law sees the normal motion alone; what friction does happens in the plane of the slip, so it is
//! computed there and only then laid out in space.

use super::{Kernel, Tables, judge};
use crate::impact::{Energy, Fate, Impact, ImpactError, Outcome, Vec3};
use crate::math::{self, Fma};
use crate::normal::{NormalResponse, Size};
use crate::tangential::{Contact, Coulomb, FrictionLaw, Shaped, Tangential};
use crate::validity::Validity;
use crate::vector::{add_scaled, cross, dot, minus, norm, plus};

/// Slip over normal speed that counts as none: the rounding of a normal that is no coordinate axis.
pub(super) const NO_SLIP: f64 = 1e-9;

impl Kernel {
    /// One impact, compiled into the caller for the caller's own instructions, whose fused multiply-add is `F`.
    ///
    /// # Errors
    /// As [`crate::WallLaw::impact`].
    #[inline(always)]
    pub fn impact<F: Fma>(&self, f: F, tables: &Tables, impact: &Impact) -> Result<Outcome, ImpactError> {
        match &self.scatter {
            None => self.smooth_impact(f, tables, impact),
            Some(scatter) => self.rough_impact(f, tables, scatter, impact),
        }
    }

    /// One impact on the wall, or the facet, whose normal it names.
    #[inline(always)]
    pub(crate) fn smooth_impact<F: Fma>(&self, f: F, tables: &Tables, impact: &Impact) -> Result<Outcome, ImpactError> {
        self.impact_by(f, &AnyLaw { kernel: self, tables }, impact)
    }

    /// One impact by a law given as a type.
    #[inline(always)]
    pub(super) fn impact_by<F: Fma, L: Laws>(&self, f: F, laws: &L, impact: &Impact) -> Result<Outcome, ImpactError> {
        let normal = judge::unit_normal(f, &impact.normal)?;
        let size = self.size(f, impact.diameter, impact.density)?;
        let u = impact.wall_velocity;
        let relative = minus(&impact.velocity, &u);
        let v_n = -dot(f, &relative, &normal);
        let tangent = add_scaled(f, &relative, v_n, &normal);
        let tangent2 = dot(f, &tangent, &tangent);
        // twice the energy per mass
        let rotational = 0.4 * (size.radius * size.radius) * dot(f, &impact.spin, &impact.spin);
        let incident = f.fma(v_n, v_n, tangent2 + rotational);
        judge::approach(v_n, incident)?;
        let share = 1.0 / incident;
        let response = laws.respond(f, v_n, tangent2, &size);
        let validity =
            laws.judge(self, v_n, &size, &response).with(self.scale_warnings(v_n, tangent2, &size, &response));
        let normal_share = v_n * v_n * share;
        let energy = normal_energy(&response, normal_share);
        if response.e <= 0.0 {
            return Ok(captured(u, energy, validity));
        }
        let motion = Motion { tangent, tangent2, normal, v_n, spin: impact.spin, radius: size.radius };
        let out = laws.slide(f, &motion, &response)?;
        let velocity = add_scaled(f, &out.tangent, response.e * v_n, &normal);
        let friction = out.friction * share;
        Ok(Outcome {
            fate: Fate::Rebound,
            velocity: plus(&velocity, &u),
            spin: out.spin,
            restitution: response.e,
            impulse_ratio: out.ratio,
            tangential_restitution: out.restitution,
            contact: out.contact,
            // what is left, rather than the motion's own energy: the same, and nothing waits for it
            energy: Energy { friction, kept: (1.0 - response.lost() * normal_share - friction).max(0.0), ..energy },
            validity,
        })
    }
}

/// A normal and a tangential law together, as a type: the laws that most impacts have get code of their own, without branches on what a
/// law might be.
pub(super) trait Laws {
    fn respond<F: Fma>(&self, f: F, v_n: f64, tangent2: f64, size: &Size) -> NormalResponse;
    fn judge(&self, kernel: &Kernel, v_n: f64, size: &Size, response: &NormalResponse) -> Validity;
    fn slide<F: Fma>(&self, f: F, motion: &Motion, response: &NormalResponse) -> Result<Slid, ImpactError>;
}

/// Whatever the kernel says.
struct AnyLaw<'a> {
    kernel: &'a Kernel,
    tables: &'a Tables<'a>,
}

impl Laws for AnyLaw<'_> {
    #[inline(always)]
    fn respond<F: Fma>(&self, f: F, v_n: f64, tangent2: f64, size: &Size) -> NormalResponse {
        self.kernel.normal.respond(f, self.tables.pieces, v_n, tangent2, size)
    }

    #[inline(always)]
    fn judge(&self, kernel: &Kernel, v_n: f64, size: &Size, response: &NormalResponse) -> Validity {
        kernel.judge(v_n, size, response)
    }

    #[inline(always)]
    fn slide<F: Fma>(&self, f: F, motion: &Motion, response: &NormalResponse) -> Result<Slid, ImpactError> {
        let tables = self.tables;
        match self.kernel.tangential {
            Tangential::Friction { friction, beta } => Ok(motion.rub(f, &Coulomb { friction, beta }, response)),
            Tangential::MicroSlip(slip) => Ok(motion.rub(f, &Shaped { slip, shape: tables.shape }, response)),
            Tangential::Restitution(curve) => {
                let v_t = math::sqrt(motion.tangent2);
                let e_t = curve.at(f, tables.pieces, motion.v_n, v_t, -1.0, 1.0);
                Ok(motion.restore(e_t, v_t, response))
            }
            Tangential::NotGiven => {
                let frictionless = Coulomb { friction: 0.0, beta: 0.0 };
                let (slip, speed) = motion.slip(f);
                debug_assert!(slip.iter().all(|c| c.is_finite()));
                if speed > NO_SLIP * motion.v_n {
                    return Err(ImpactError::FrictionNotGiven);
                }
                Ok(Slid { contact: Contact::None, ..motion.rub(f, &frictionless, response) })
            }
        }
    }
}

/// The motion of a sphere that meets a wall, in space and relative to the wall.
pub(super) struct Motion {
    tangent: Vec3,
    pub(super) tangent2: f64,
    normal: Vec3,
    v_n: f64,
    spin: Vec3,
    radius: f64,
}

/// What the contact made of the motion along the wall.
pub(super) struct Slid {
    tangent: Vec3,
    spin: Vec3,
    ratio: f64,
    /// Twice the energy per mass lost to friction.
    friction: f64,
    /// e_t along the incoming tangential direction, NaN without one.
    restitution: f64,
    contact: Contact,
}

impl Motion {
    /// Slip of the contact point and its speed.
    #[inline(always)]
    fn slip<F: Fma>(&self, f: F) -> (Vec3, f64) {
        let lever = cross(f, &self.spin, &self.normal);
        let slip = add_scaled(f, &self.tangent, -self.radius, &lever);
        let speed = norm(f, &slip);
        (slip, speed)
    }

    /// Friction against the slip.
    #[inline(always)]
    pub(super) fn rub<F: Fma, L: FrictionLaw>(&self, f: F, law: &L, response: &NormalResponse) -> Slid {
        let (slip, speed) = self.slip(f);
        let normal_impulse = (1.0 + response.e) * self.v_n;
        let per_tangent = if self.tangent2 > 0.0 { 1.0 / self.tangent2 } else { f64::NAN };
        if speed == 0.0 {
            return Slid {
                tangent: self.tangent,
                spin: self.spin,
                ratio: 0.0,
                friction: 0.0,
                restitution: self.tangent2 * per_tangent,
                contact: Contact::None,
            };
        }
        let rubbed = Rubbed::new(f, law, speed, normal_impulse, response);
        let direction = [slip[0] / speed, slip[1] / speed, slip[2] / speed];
        let along = dot(f, &self.tangent, &direction) * per_tangent;
        Slid {
            tangent: add_scaled(f, &self.tangent, -rubbed.impulse, &direction),
            spin: add_scaled(f, &self.spin, rubbed.spin(self.radius), &cross(f, &self.normal, &direction)),
            ratio: rubbed.impulse / normal_impulse,
            friction: rubbed.lost(f, speed),
            restitution: f.fma(along, -rubbed.impulse, 1.0),
            contact: if rubbed.slides { Contact::Sliding } else { L::HELD },
        }
    }

    /// The rebound along the wall given outright: e_t times the tangential speed v_t.
    #[inline(always)]
    pub(super) fn restore(&self, e_t: f64, v_t: f64, response: &NormalResponse) -> Slid {
        let out = e_t * v_t;
        Slid {
            tangent: [e_t * self.tangent[0], e_t * self.tangent[1], e_t * self.tangent[2]],
            spin: self.spin,
            ratio: (v_t - out).abs() / ((1.0 + response.e) * self.v_n),
            friction: v_t * v_t - out * out,
            restitution: if v_t > 0.0 { e_t } else { f64::NAN },
            contact: Contact::None,
        }
    }
}

/// Friction in the plane of the slip: what a single impact and a row of a batch share.
pub(super) struct Rubbed {
    /// Impulse per mass against the slip, m/s.
    pub impulse: f64,
    slides: bool,
}

impl Rubbed {
    #[inline(always)]
    pub fn new<F: Fma, L: FrictionLaw>(
        f: F,
        law: &L,
        speed: f64,
        normal_impulse: f64,
        response: &NormalResponse,
    ) -> Self {
        let (impulse, slides) = law.impulse(f, speed, normal_impulse, response);
        Self { impulse, slides }
    }

    /// Change of spin, rad/s: Δω = (5/2)(P/R).
    #[inline(always)]
    pub fn spin(&self, radius: f64) -> f64 {
        self.impulse * (2.5 / radius)
    }

    /// Twice the energy per mass lost: P(2|v_s| − (7/2)P).
    #[inline(always)]
    fn lost<F: Fma>(&self, f: F, speed: f64) -> f64 {
        self.impulse * f.fma(3.5, -self.impulse, 2.0 * speed)
    }
}

/// The normal losses as fractions of the whole incident energy, `share` being the normal motion's. When they would take
/// more than there is (capture), they are scaled down to what there was.
#[inline(always)]
fn normal_energy(response: &NormalResponse, share: f64) -> Energy {
    let total = response.lost();
    let scale = if total > 1.0 { share / total } else { share };
    let l = &response.losses;
    let mut energy = Energy {
        adhesion: l.adhesion * scale,
        adhesion_damping: l.adhesion_damping * scale,
        hertz_damping: l.hertz_damping * scale,
        plastic: l.plastic * scale,
        other: l.other * scale,
        ..Energy::default()
    };
    if response.e <= 0.0 {
        energy.captured =
            1.0 - (energy.adhesion + energy.adhesion_damping + energy.hertz_damping + energy.plastic + energy.other);
    }
    energy
}

#[inline(always)]
fn captured(wall_velocity: Vec3, energy: Energy, validity: Validity) -> Outcome {
    Outcome {
        fate: Fate::Capture,
        velocity: wall_velocity,
        spin: [0.0; 3],
        restitution: 0.0,
        impulse_ratio: f64::NAN,
        tangential_restitution: f64::NAN,
        contact: Contact::None,
        energy,
        validity,
    }
}
