//! A wall law, compiled: pair × normal law × tangential law × roughness. An impact in, an outcome out.

use crate::impact::{Energy, Fate, Impact, ImpactError, Outcome, Vec3};
use crate::normal::empirical::Curve;
use crate::normal::ledger::Balance;
use crate::normal::{Ledger, Losses, Size};
use crate::pair::Pair;
use crate::resolved::Resolved;
use crate::scatter::Scatter;
use crate::tangential::{Contact, Coulomb, FrictionLaw, Tangential};
use crate::validity::Validity;

mod checks;
mod figures;
mod rough;

use crate::vector::{add_scaled, cross, dot, norm};
use checks::ContactLimit;
pub(crate) use checks::column_ok;
pub use figures::Window;

/// A normal law, compiled.
#[derive(Clone, Debug, PartialEq)]
pub enum NormalLaw {
    /// A list of losses.
    Ledger(Ledger),
    /// Restitution as a constant or by angle.
    Table(Curve),
    /// The resolved contact equation.
    Resolved(Resolved),
}

/// What a normal law answers.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NormalResponse {
    pub e: f64,
    pub losses: Losses,
    /// Loss without a named mechanism.
    pub other: f64,
    /// Hertz impulse over (1 + e)v_n, by which the resolved law's friction is larger; 1 otherwise.
    pub friction_share: f64,
}

impl NormalResponse {
    #[inline(always)]
    pub fn of_balance(balance: &Balance) -> Self {
        Self { e: balance.restitution(), losses: balance.losses, other: 0.0, friction_share: 1.0 }
    }

    /// Fraction of the normal kinetic energy lost, above 1 for a capture.
    #[inline(always)]
    pub fn lost(&self) -> f64 {
        self.losses.total() + self.other
    }

    #[inline(always)]
    pub fn of_restitution(e: f64) -> Self {
        Self { e, losses: Losses::default(), other: 1.0 - e * e, friction_share: 1.0 }
    }
}

impl NormalLaw {
    /// `tangent2` is the square of the tangential speed.
    #[inline(always)]
    pub(crate) fn respond(&self, v_n: f64, tangent2: f64, size: &Size) -> NormalResponse {
        match self {
            Self::Ledger(ledger) => NormalResponse::of_balance(&ledger.balance(v_n, size)),
            Self::Table(curve) => NormalResponse::of_restitution(curve.at(v_n, tangent2.sqrt(), 0.0, 1.0)),
            Self::Resolved(resolved) => resolved.respond(v_n, size),
        }
    }
}

/// A wall law, compiled from a [`crate::spec::LawSpec`]. Pure: no state, no allocation per impact, no panics; usable from
/// many threads.
#[derive(Clone, Debug)]
pub struct WallLaw {
    pub(crate) normal: NormalLaw,
    pub(crate) tangential: Tangential,
    /// Density of the law's own sphere, kg/m³; a law that needs none and was given none holds 1000.
    pub(crate) density: f64,
    /// 1/r_s, 1/m.
    pub(crate) surface_curvature: f64,
    pub(crate) contact_limit: ContactLimit,
    pub(crate) validity: Validity,
    pub(crate) pair: Option<Pair>,
    pub(crate) roughness: Option<f64>,
    pub(crate) roughness_factor: f64,
    pub(crate) spacing: f64,
    /// A rough wall's facets; none on a smooth one.
    pub(crate) scatter: Option<Scatter>,
}

impl WallLaw {
    pub(crate) fn assemble(
        normal: NormalLaw,
        tangential: Tangential,
        pair: Option<Pair>,
        surface_curvature: f64,
    ) -> Self {
        let density = pair.as_ref().and_then(|p| p.density().ok()).unwrap_or(1000.0);
        let contact_limit = ContactLimit::new(&normal, pair.as_ref(), density);
        Self {
            normal,
            tangential,
            density,
            surface_curvature,
            contact_limit,
            validity: Validity::NONE,
            pair,
            roughness: None,
            roughness_factor: 1.0,
            spacing: crate::roughness::CALIBRATED_SPACING,
            scatter: None,
        }
    }

    /// The materials' contact constants, if the law has materials.
    pub fn pair(&self) -> Option<&Pair> {
        self.pair.as_ref()
    }

    /// The normal law.
    pub fn normal(&self) -> &NormalLaw {
        &self.normal
    }

    /// The tangential law.
    pub fn tangential(&self) -> &Tangential {
        &self.tangential
    }

    /// A rough wall's facets: such a law uses the [`Impact::draws`]. `None` for a smooth wall.
    pub fn scatter(&self) -> Option<&Scatter> {
        self.scatter.as_ref()
    }

    /// Density of the law's own sphere, kg/m³, used when an impact names none.
    pub fn density(&self) -> f64 {
        self.density
    }

    #[inline(always)]
    pub(crate) fn size(&self, diameter: f64, density: Option<f64>) -> Result<Size, ImpactError> {
        if !(1e-10..=10.0).contains(&diameter) {
            return Err(ImpactError::Diameter);
        }
        let radius = 0.5 * diameter;
        let mut size = Size::flat(radius);
        if let Some(density) = density {
            size.density_ratio = density / self.density;
            if !(1e-3..=1e3).contains(&size.density_ratio) {
                return Err(ImpactError::Density);
            }
        }
        if self.surface_curvature != 0.0 {
            size.kappa = 1.0 / self.surface_curvature.mul_add(radius, 1.0);
            if !(size.kappa > 1e-3 && size.kappa < 1e3) {
                return Err(ImpactError::Curvature);
            }
        }
        Ok(size)
    }

    /// One impact.
    ///
    /// # Errors
    /// A sphere that does not approach, a diameter or density out of range, numbers that are not finite: the caller's
    /// sphere is then as it was.
    ///
    /// ```
    /// use carom::{Impact, Fate, material::Library, spec::LawSpec};
    /// let law: LawSpec = carom::spec::parse_law(r#"
    ///     sphere = "stainless-steel"
    ///     surface = "silicon"
    ///     normal = "ea"
    ///     friction = 0.2
    ///     roughness_factor = 0.15
    /// "#)?;
    /// let wall = law.compile(&Library::builtin())?;
    /// let out = wall.impact(&Impact::new(70e-6, [1.0, -1.0, 0.0], [0.0, 1.0, 0.0])).expect("it approaches");
    /// assert_eq!(out.fate, Fate::Rebound);
    /// assert!((out.velocity[1] - 0.9728).abs() < 1e-3);
    /// # Ok::<(), carom::LawError>(())
    /// ```
    #[inline]
    pub fn impact(&self, impact: &Impact) -> Result<Outcome, ImpactError> {
        match &self.scatter {
            None => self.smooth_impact(impact),
            Some(scatter) => self.rough_impact(scatter, impact),
        }
    }

    /// One impact on the wall, or the facet, whose normal it names.
    #[inline]
    fn smooth_impact(&self, impact: &Impact) -> Result<Outcome, ImpactError> {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("fma") {
            // SAFETY: the processor has the features the function is compiled for, as was just asked.
            return unsafe { impact_fma(self, impact) };
        }
        self.smooth_body(impact)
    }

    /// As [`WallLaw::impact`], compiled into the caller for the caller's own instruction set: the same bits, and the answer need not pass
    /// through memory. Fast only where the caller is compiled with fused multiply-add (`#[target_feature(enable = "fma")]`).
    ///
    /// # Errors
    /// As [`WallLaw::impact`].
    #[inline(always)]
    pub fn impact_inlined(&self, impact: &Impact) -> Result<Outcome, ImpactError> {
        match &self.scatter {
            None => self.smooth_body(impact),
            Some(scatter) => self.rough_impact(scatter, impact),
        }
    }

    #[inline(always)]
    fn smooth_body(&self, impact: &Impact) -> Result<Outcome, ImpactError> {
        // what is added to a law must be heeded here, or by `impact` and `impact_inlined` both, as scatter is
        let Self {
            normal: _,
            tangential: _,
            density: _,
            surface_curvature: _,
            contact_limit: _,
            validity: _,
            pair: _,
            roughness: _,
            roughness_factor: _,
            spacing: _,
            scatter: _,
        } = self;
        let square = dot(&impact.normal, &impact.normal);
        let normal = if checks::is_unit(square) { impact.normal } else { checks::unit(&impact.normal, square)? };
        let size = self.size(impact.diameter, impact.density)?;
        let u = impact.wall_velocity;
        let relative = [impact.velocity[0] - u[0], impact.velocity[1] - u[1], impact.velocity[2] - u[2]];
        let v_n = -dot(&relative, &normal);
        let tangent = add_scaled(&relative, v_n, &normal);
        let tangent2 = dot(&tangent, &tangent);
        let spin_speed2 = dot(&impact.spin, &impact.spin);
        // twice the energy per mass
        let rotational = 0.4 * (size.radius * size.radius) * spin_speed2;
        let incident = v_n.mul_add(v_n, tangent2 + rotational);
        checks::approach(v_n, incident)?;
        let share = 1.0 / incident;
        let response = self.normal.respond(v_n, tangent2, &size);
        let validity = self.judge(v_n, &size, &response);
        let normal_share = v_n * v_n * share;
        let energy = normal_energy(&response, normal_share);
        if response.e <= 0.0 {
            return Ok(captured(u, energy, validity));
        }
        let out =
            self.slide(&Sliding { tangent, tangent2, normal, v_n, spin: impact.spin, radius: size.radius }, &response);
        let velocity = add_scaled(&out.tangent, response.e * v_n, &normal);
        let friction = out.friction * share;
        Ok(Outcome {
            fate: Fate::Rebound,
            velocity: [velocity[0] + u[0], velocity[1] + u[1], velocity[2] + u[2]],
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

    #[inline(always)]
    fn slide(&self, s: &Sliding, response: &NormalResponse) -> Slid {
        let normal_impulse = (1.0 + response.e) * s.v_n;
        match &self.tangential {
            Tangential::Friction { friction, beta } => {
                s.rub(&Coulomb { friction: *friction, beta: *beta }, normal_impulse, response)
            }
            Tangential::MicroSlip(law) => s.rub(law.as_ref(), normal_impulse, response),
            Tangential::Restitution(curve) => {
                let v_t = s.tangent2.sqrt();
                let e_t = curve.at(s.v_n, v_t, -1.0, 1.0);
                let tangent = [e_t * s.tangent[0], e_t * s.tangent[1], e_t * s.tangent[2]];
                let out = e_t * v_t;
                Slid {
                    tangent,
                    spin: s.spin,
                    ratio: (v_t - out).abs() / normal_impulse,
                    friction: v_t * v_t - out * out,
                    restitution: if v_t > 0.0 { e_t } else { f64::NAN },
                    contact: Contact::None,
                }
            }
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "fma")]
fn impact_fma(law: &WallLaw, impact: &Impact) -> Result<Outcome, ImpactError> {
    law.smooth_body(impact)
}

struct Sliding {
    tangent: Vec3,
    tangent2: f64,
    normal: Vec3,
    v_n: f64,
    spin: Vec3,
    radius: f64,
}

impl Sliding {
    #[inline(always)]
    fn rub<F: FrictionLaw>(&self, law: &F, normal_impulse: f64, response: &NormalResponse) -> Slid {
        let lever = cross(&self.spin, &self.normal);
        let slip = add_scaled(&self.tangent, -self.radius, &lever);
        let speed = norm(&slip);
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
        let (p, slides) = law.impulse(speed, normal_impulse, response);
        let direction = [slip[0] / speed, slip[1] / speed, slip[2] / speed];
        let along = dot(&self.tangent, &direction) * per_tangent;
        Slid {
            tangent: add_scaled(&self.tangent, -p, &direction),
            spin: add_scaled(&self.spin, p * (2.5 / self.radius), &cross(&self.normal, &direction)),
            ratio: p / normal_impulse,
            friction: p * 3.5f64.mul_add(-p, 2.0 * speed),
            restitution: along.mul_add(-p, 1.0),
            contact: if slides { Contact::Sliding } else { F::HELD },
        }
    }
}

struct Slid {
    tangent: Vec3,
    spin: Vec3,
    ratio: f64,
    /// Twice the energy per mass lost to friction.
    friction: f64,
    /// e_t along the incoming tangential direction, NaN without one.
    restitution: f64,
    contact: Contact,
}

/// The normal losses as fractions of the whole incident energy, `share` being the normal motion's. When they would take
/// more than there is (capture), they are scaled down to what there was.
#[inline(always)]
pub(crate) fn normal_energy(response: &NormalResponse, share: f64) -> Energy {
    let total = response.lost();
    let scale = if total > 1.0 { share / total } else { share };
    let l = &response.losses;
    let mut energy = Energy {
        adhesion: l.adhesion * scale,
        adhesion_damping: l.adhesion_damping * scale,
        hertz_damping: l.hertz_damping * scale,
        plastic: l.plastic * scale,
        other: response.other * scale,
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
