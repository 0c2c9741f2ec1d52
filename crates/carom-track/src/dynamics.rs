//! Rates of change of `W` spheres side by side.
//!
//! Where only drag, gravity and buoyancy act, they are worked out in loops that vectorise; every other force goes
//! through [`Forces::rates`], sphere by sphere. Either way the lanes do not mix.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use crate::domain::{Carry, Domain, Pieces};
use crate::flow::{Fluid, Gas, Local};
use crate::force::{Drag, Eddy, Forces, RandomWalk, Sphere, relaxation_time};
use crate::integrate::{Lanes, Lanes3, Motion, Rates};
use crate::vector::{Vec3, add, dot};
use carom::instructions::{Work, run_scalar};
use carom::math::Fma;

/// Relaxation time below which spheres follow the fluid, s: 6 µm of 1000 kg/m³ in air, 30 µm in water. Above, explicit steps are the
/// cheaper ones in most flows.
const SHORT: f64 = 1e-4;

/// What acts on the spheres of a run.
#[derive(Clone, Copy, Debug)]
pub struct Dynamics {
    /// The fluid.
    pub fluid: Fluid,
    /// Which gas it is, where it is one: what its viscosity is elsewhere, if the flow gives its state place by place.
    pub gas: Option<Gas>,
    /// The deterministic forces.
    pub forces: Forces,
    /// Turbulent dispersion, if any.
    pub random_walk: Option<RandomWalk>,
    /// Whether the molecules' kicks are felt.
    pub brownian: bool,
}

/// What the forces need of each sphere, worked out once.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Bodies<const W: usize> {
    /// The spheres.
    pub sphere: [Sphere; W],
    /// Radius, m.
    pub radius: Lanes<W>,
    /// Rate of Stokes drag, 1/τ_p, 1/s; 0 without drag.
    pub drag_rate: Lanes<W>,
    /// Reynolds number per speed, ρ_f d/μ, s/m.
    pub reynolds: Lanes<W>,
    /// Gravity less buoyancy, m/s².
    pub weight: Lanes3<W>,
    /// The eddy each is in.
    pub eddy: [Option<Eddy>; W],
    /// How fast its deviates drift, 1/s.
    pub drift: Lanes3<W>,
    /// Since when they do, s.
    pub since: Lanes<W>,
}

impl<const W: usize> Bodies<W> {
    /// Spheres that feel nothing.
    pub const NONE: Self = Self {
        sphere: [Sphere { diameter: 1.0, density: 1.0 }; W],
        radius: [0.0; W],
        drag_rate: [0.0; W],
        reynolds: [0.0; W],
        weight: [[0.0; W]; 3],
        eddy: [None; W],
        drift: [[0.0; W]; 3],
        since: [0.0; W],
    };

    /// One of the spheres alone.
    #[inline(always)]
    pub fn one(&self, l: usize) -> Bodies<1> {
        Bodies {
            sphere: [self.sphere[l]],
            radius: [self.radius[l]],
            drag_rate: [self.drag_rate[l]],
            reynolds: [self.reynolds[l]],
            weight: [[self.weight[0][l]], [self.weight[1][l]], [self.weight[2][l]]],
            eddy: [self.eddy[l]],
            drift: [[self.drift[0][l]], [self.drift[1][l]], [self.drift[2][l]]],
            since: [self.since[l]],
        }
    }

    /// Turns what one of the spheres has of its eddy, where it is carried over.
    #[inline(always)]
    pub fn carry(&mut self, l: usize, carry: &Carry) {
        if let Some(eddy) = &mut self.eddy[l] {
            eddy.deviates = carry.vector(eddy.deviates);
        }
        let drift = carry.vector([self.drift[0][l], self.drift[1][l], self.drift[2][l]]);
        for c in 0..3 {
            self.drift[c][l] = drift[c];
        }
    }
}

/// Drag, gravity and buoyancy in air at 24 °C and one atmosphere; nothing random.
impl Default for Dynamics {
    fn default() -> Self {
        let gas = Some(Gas::Air);
        Self { fluid: Fluid::default(), gas, forces: Forces::default(), random_walk: None, brownian: false }
    }
}

impl Dynamics {
    /// Only drag, gravity and buoyancy, in a fluid that is the same everywhere.
    #[inline(always)]
    pub(crate) fn is_plain<D: Domain>(&self, domain: &D) -> bool {
        self.forces.is_plain() && self.random_walk.is_none() && !domain.varies_gas()
    }

    /// The fluid where it is as `local` says: the run's, unless that gives a state of the gas.
    #[inline(always)]
    pub fn fluid_at(&self, local: &Local) -> Fluid {
        match (self.gas, &local.gas) {
            (Some(gas), Some(state)) => self.fluid.at(gas, state),
            _ => self.fluid,
        }
    }

    /// Whether spin changes in flight.
    pub fn spins(&self) -> bool {
        self.forces.rotational_drag
    }

    /// Whether the forces depend on where a sphere is.
    pub fn need_place<D: Domain>(&self, domain: &D) -> bool {
        !(self.is_plain(domain) && (self.forces.drag == Drag::None || domain.is_uniform()))
    }

    /// τ_p of Stokes drag with slip in the run's fluid, s; infinite without drag.
    pub fn relaxation_time(&self, sphere: &Sphere) -> f64 {
        self.relaxation_time_in(&self.fluid, sphere)
    }

    /// The same in a fluid.
    pub(crate) fn relaxation_time_in(&self, fluid: &Fluid, sphere: &Sphere) -> f64 {
        match self.forces.drag {
            Drag::None => f64::INFINITY,
            _ => relaxation_time(fluid, sphere, self.forces.slip.factor(sphere.diameter, fluid.mean_free_path)),
        }
    }

    /// Whether a sphere follows the fluid so closely that its steps should at first not know by how much
    /// ([`exponential`](crate::integrate::exponential)), by its relaxation time in the run's fluid, wherever it goes. What the steps give
    /// is the same on both sides, to the tolerance; kicks change within a relaxation time, and are stepped as such.
    pub fn follows(&self, sphere: &Sphere) -> bool {
        !self.brownian && self.relaxation_time(sphere) < SHORT
    }

    /// Cunningham's factor.
    pub fn slip(&self, sphere: &Sphere) -> f64 {
        self.forces.slip.factor(sphere.diameter, self.fluid.mean_free_path)
    }

    /// Puts a sphere into a lane.
    #[inline(always)]
    pub fn body<const W: usize>(&self, l: usize, sphere: Sphere, bodies: &mut Bodies<W>) {
        bodies.sphere[l] = sphere;
        bodies.radius[l] = 0.5 * sphere.diameter;
        bodies.drag_rate[l] = 1.0 / self.relaxation_time(&sphere);
        bodies.reynolds[l] = self.fluid.density * sphere.diameter / self.fluid.viscosity;
        let left = if self.forces.buoyancy { 1.0 - self.fluid.density / sphere.density } else { 1.0 };
        for c in 0..3 {
            bodies.weight[c][l] = self.forces.gravity[c] * left;
            bodies.drift[c][l] = 0.0;
        }
        bodies.eddy[l] = None;
    }

    /// Accelerations of spheres in a domain's fluid, of those at least that are `wanted`.
    #[inline(always)]
    #[allow(clippy::too_many_arguments, reason = "the state of a sphere, and where it is")]
    pub fn rates<const W: usize, D: Domain>(
        &self,
        domain: &D,
        here: &D::Many<W>,
        wanted: &[bool; W],
        time: &Lanes<W>,
        bodies: &Bodies<W>,
        m: &Motion<W>,
        out: &mut Rates<W>,
    ) {
        if self.is_plain(domain) {
            self.plain_rates(domain, here, time, bodies, m, out);
        } else {
            for l in 0..W {
                if !wanted[l] {
                    continue;
                }
                let r = self.full_rates(domain, here.get(l), time[l], bodies, m, l);
                for c in 0..3 {
                    out.a[c][l] = r.acceleration[c];
                    out.alpha[c][l] = r.spin[c];
                }
                (out.drag[l], out.torque[l]) = (r.drag, r.torque);
            }
        }
    }

    #[inline(always)]
    fn plain_rates<const W: usize, D: Domain>(
        &self,
        domain: &D,
        here: &D::Many<W>,
        time: &Lanes<W>,
        bodies: &Bodies<W>,
        m: &Motion<W>,
        out: &mut Rates<W>,
    ) {
        (out.a, out.drag, out.torque) = (bodies.weight, [0.0; W], [0.0; W]);
        if self.forces.drag == Drag::None {
            return;
        }
        let u = domain.velocities(here, time, &m.x);
        let slip = [difference(u[0], m.v[0]), difference(u[1], m.v[1]), difference(u[2], m.v[2])];
        let mut rate = bodies.drag_rate;
        if self.forces.drag != Drag::Stokes {
            let mut squares = [0.0; W];
            for l in 0..W {
                let (x, y, z) = (slip[0][l], slip[1][l], slip[2][l]);
                squares[l] = bodies.reynolds[l] * bodies.reynolds[l] * x.mul_add(x, y.mul_add(y, z * z));
            }
            let factors = self.forces.drag.factors_of_squares(&squares);
            for l in 0..W {
                rate[l] *= factors[l];
            }
        }
        for c in 0..3 {
            let mut a = bodies.weight[c];
            for l in 0..W {
                a[l] = rate[l].mul_add(slip[c][l], a[l]);
            }
            out.a[c] = a;
        }
        out.drag = rate;
    }

    /// A bound on how hard the forces press one of the spheres at velocity `v` against a wall with that normal, m/s²; infinite where
    /// none is at hand.
    #[inline(always)]
    pub fn press_at_most<const W: usize, D: Domain>(
        &self,
        domain: &D,
        (here, time): (D::Here, f64),
        (bodies, l): (&Bodies<W>, usize),
        x: Vec3,
        v: Vec3,
        normal: Vec3,
    ) -> f64 {
        if !self.is_plain(domain) {
            return f64::INFINITY;
        }
        let u = domain.velocities(&D::Many::all(here), &[time], &x.map(|c| [c]));
        let slip = [u[0][0] - v[0], u[1][0] - v[1], u[2][0] - v[2]];
        let weight = [bodies.weight[0][l], bodies.weight[1][l], bodies.weight[2][l]];
        let speed = slip[0].abs() + slip[1].abs() + slip[2].abs();
        let drag = bodies.drag_rate[l] * Drag::at_most(bodies.reynolds[l] * speed);
        drag * dot(slip, normal).abs() - dot(weight, normal)
    }

    #[inline(always)]
    fn full_rates<const W: usize, D: Domain>(
        &self,
        domain: &D,
        here: D::Here,
        time: f64,
        bodies: &Bodies<W>,
        m: &Motion<W>,
        l: usize,
    ) -> crate::force::Rates {
        let at = |v: &Lanes3<W>| -> Vec3 { [v[0][l], v[1][l], v[2][l]] };
        let (x, v, spin) = (at(&m.x), at(&m.v), at(&m.spin));
        run_scalar(AllForces {
            dynamics: self,
            domain,
            place: (here, time, x),
            sphere: &bodies.sphere[l],
            deviates: bodies.eddy[l].map(|eddy| {
                let age = time - bodies.since[l];
                [0, 1, 2].map(|c| bodies.drift[c][l].mul_add(age, eddy.deviates[c]))
            }),
            v,
            spin,
        })
    }
}

/// Every force on one sphere: compiled once for processors with a fused multiply-add and once for those without.
struct AllForces<'a, D: Domain> {
    dynamics: &'a Dynamics,
    domain: &'a D,
    place: (D::Here, f64, Vec3),
    sphere: &'a Sphere,
    /// The eddy's deviates now.
    deviates: Option<Vec3>,
    v: Vec3,
    spin: Vec3,
}

impl<D: Domain> Work for AllForces<'_, D> {
    type Output = crate::force::Rates;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) -> Self::Output {
        let Self { dynamics, domain, place: (here, time, x), sphere, deviates, v, spin } = self;
        let mut local = domain.fluid(here, time, x);
        let fluid = &dynamics.fluid_at(&local);
        if let (Some(walk), Some(deviates)) = (&dynamics.random_walk, deviates) {
            let gust = walk.fluctuation(deviates, &local, fluid.kinematic_viscosity());
            local.velocity = add(local.velocity, gust);
        }
        if dynamics.forces.wall_drag.is_some() {
            local.wall = domain.walls().nearest(x);
        }
        dynamics.forces.rates(fluid, sphere, &local, v, spin)
    }
}

#[inline(always)]
fn difference<const W: usize>(a: Lanes<W>, b: Lanes<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = a[l] - b[l];
    }
    out
}
