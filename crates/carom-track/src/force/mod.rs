//! What the fluid and the earth do to a sphere, per unit of its mass.
//!
//! One mechanism a file. [`Forces`] adds up the deterministic ones; [`brownian`] and [`random_walk`] give the chance a
//! tracker adds step by step.

pub mod added_mass;
pub mod brownian;
pub mod drag;
pub mod gravity;
pub mod magnus;
pub mod pressure_gradient;
pub mod random_walk;
pub mod rotational_drag;
pub mod saffman;
pub mod slip;

pub use brownian::brownian_amplitude;
pub use drag::{Drag, relaxation_time, reynolds};
pub use random_walk::{Eddy, NearWall, RandomWalk};
pub use slip::Slip;

use crate::flow::{Fluid, Local};
use crate::vector::{add, norm, scale, sub};

/// A solid sphere of even density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Diameter, m.
    pub diameter: f64,
    /// Density, kg/m³.
    pub density: f64,
}

impl Sphere {
    /// Mass, kg.
    #[inline]
    pub fn mass(&self) -> f64 {
        std::f64::consts::PI / 6.0 * self.density * self.diameter * self.diameter * self.diameter
    }
}

/// Which forces act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forces {
    /// Acceleration of gravity, m/s².
    pub gravity: [f64; 3],
    /// Whether gravity is reduced by the displaced fluid.
    pub buoyancy: bool,
    /// Drag on a sphere that moves through the fluid.
    pub drag: Drag,
    /// Slip of small spheres in a gas.
    pub slip: Slip,
    /// Saffman's lift in a shear, with Mei's correction.
    pub saffman: bool,
    /// Lift of a spinning sphere.
    pub magnus: bool,
    /// Torque of the fluid on a spinning sphere.
    pub rotational_drag: bool,
    /// Force of the undisturbed flow's pressure gradient.
    pub pressure_gradient: bool,
    /// Inertia of the fluid that moves with the sphere.
    pub added_mass: bool,
}

/// Schiller–Naumann drag in the earth's gravity along −y, with buoyancy; nothing else.
impl Default for Forces {
    fn default() -> Self {
        Self {
            gravity: [0.0, -9.81, 0.0],
            buoyancy: true,
            drag: Drag::SchillerNaumann,
            slip: Slip::None,
            saffman: false,
            magnus: false,
            rotational_drag: false,
            pressure_gradient: false,
            added_mass: false,
        }
    }
}

/// Rates of change of a sphere's velocity and spin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// dv/dt, m/s².
    pub acceleration: [f64; 3],
    /// dω/dt, rad/s².
    pub spin: [f64; 3],
}

impl Forces {
    /// Whether only drag, gravity and buoyancy act: then the fluid's velocity is all that is needed of the flow, and the
    /// spin neither changes nor matters in flight.
    pub fn is_plain(&self) -> bool {
        !(self.saffman || self.magnus || self.rotational_drag || self.pressure_gradient || self.added_mass)
    }

    /// dv/dt and dω/dt of a sphere at velocity `v` (m/s) and spin (rad/s) where the fluid is as `local` says.
    ///
    /// With added mass the equation of motion is solved for dv/dt. `local.velocity` may hold a turbulent fluctuation.
    pub fn rates(&self, fluid: &Fluid, sphere: &Sphere, local: &Local, v: [f64; 3], spin: [f64; 3]) -> Rates {
        let relative = sub(local.velocity, v);
        let speed = norm(relative);
        let reynolds = reynolds(fluid, sphere.diameter, speed);
        let slip = self.slip.factor(sphere.diameter, fluid.mean_free_path);
        let tau = relaxation_time(fluid, sphere, slip);
        let ratio = fluid.density / sphere.density;
        let mut a = gravity::acceleration(self.gravity, if self.buoyancy { ratio } else { 0.0 });
        a = add(a, scale(relative, self.drag.factor(reynolds) / tau));
        if self.saffman {
            a = add(a, saffman::acceleration(fluid, sphere, relative, local.vorticity()));
        }
        if self.pressure_gradient {
            a = add(a, pressure_gradient::acceleration(ratio, local.acceleration));
        }
        let rotation = sub(scale(local.vorticity(), 0.5), spin);
        if self.magnus {
            a = add(a, magnus::acceleration(fluid, sphere, relative, rotation));
        }
        if self.added_mass {
            a = added_mass::solve(ratio, a, local.acceleration);
        }
        let spin = if self.rotational_drag { rotational_drag::spin_rate(fluid, sphere, rotation) } else { [0.0; 3] };
        Rates { acceleration: a, spin }
    }
}
