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
pub mod thermophoresis;
pub mod wall_drag;

pub use drag::{Drag, relaxation_time, reynolds};
pub use random_walk::{Eddy, Life, Model, NearWall, RandomWalk, Surroundings};
pub use slip::Slip;
pub use wall_drag::WallDrag;

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
    /// Drift from warm to cold in a gas.
    pub thermophoresis: Option<Thermophoresis>,
    /// Drag that grows near walls.
    pub wall_drag: Option<WallDrag>,
}

/// What thermophoresis needs besides the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thermophoresis {
    /// Thermal conductivity of the spheres, W/(m K).
    pub conductivity: f64,
    /// The gas's temperature gradient, K/m, the same everywhere; where the flow gives the gas's state, its own gradient acts.
    pub gradient: [f64; 3],
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
            thermophoresis: None,
            wall_drag: None,
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
    /// Rate at which drag takes the velocity relative to the fluid away at this speed, 1/s.
    pub drag: f64,
    /// Likewise of the torque and the relative rotation, 1/s.
    pub torque: f64,
}

impl Forces {
    /// Whether only drag, gravity and buoyancy act: then the fluid's velocity is all that is needed of the flow, and the
    /// spin neither changes nor matters in flight.
    #[inline(always)]
    pub fn is_plain(&self) -> bool {
        !(self.saffman
            || self.magnus
            || self.rotational_drag
            || self.pressure_gradient
            || self.added_mass
            || self.thermophoresis.is_some()
            || self.wall_drag.is_some())
    }

    /// dv/dt and dω/dt of a sphere at velocity `v` (m/s) and spin (rad/s) where the fluid is as `local` says, its properties there being
    /// `fluid`'s.
    ///
    /// With added mass the equation of motion is solved for dv/dt. `local.velocity` may hold a turbulent fluctuation.
    #[inline(always)]
    pub fn rates(&self, fluid: &Fluid, sphere: &Sphere, local: &Local, v: [f64; 3], spin: [f64; 3]) -> Rates {
        let relative = sub(local.velocity, v);
        let speed = norm(relative);
        let reynolds = reynolds(fluid, sphere.diameter, speed);
        let slip = self.slip.factor(sphere.diameter, fluid.mean_free_path);
        let tau = relaxation_time(fluid, sphere, slip);
        let ratio = fluid.density / sphere.density;
        let mut a = gravity::acceleration(self.gravity, if self.buoyancy { ratio } else { 0.0 });
        let mut drag = self.drag.factor(reynolds) / tau;
        match (&self.wall_drag, &local.wall) {
            (Some(walls), Some(near)) => {
                a = add(a, walls.acceleration(fluid, sphere, near, drag, local.velocity, v));
                drag *= walls.strongest(fluid, sphere, near);
            }
            _ => a = add(a, scale(relative, drag)),
        }
        if let Some(t) = &self.thermophoresis {
            let gradient = local.gas.map_or(t.gradient, |gas| gas.temperature_gradient);
            a = add(a, thermophoresis::acceleration(fluid, sphere, t.conductivity, fluid.temperature, gradient));
        }
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
            drag *= added_mass::share(ratio);
        }
        let torque = if self.rotational_drag { rotational_drag::rate(fluid, sphere, rotation) } else { 0.0 };
        let spin = if self.rotational_drag { scale(rotation, torque) } else { [0.0; 3] };
        Rates { acceleration: a, spin, drag, torque }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::{Stagnation, Symmetry};
    use crate::vector::cross;

    const WATER: Fluid = Fluid { density: 998.0, viscosity: 1e-3, temperature: 293.15, mean_free_path: 0.0 };

    #[test]
    fn nothing_accelerates_at_the_terminal_speed() {
        // a 100 µm glass bead in water: w = τ g (1 − s)/f(Re w), by fixed point
        let sphere = Sphere { diameter: 1e-4, density: 2500.0 };
        let stokes = relaxation_time(&WATER, &sphere, 1.0) * 9.81 * (1.0 - 998.0 / 2500.0);
        let w = (0..100).fold(stokes, |w, _| stokes / drag::schiller_naumann(reynolds(&WATER, 1e-4, w)));
        // 7.4 mm/s: slower than Stokes' 8.2 by the drag's rise at Re = 0.7
        assert!((w - 7.4e-3).abs() < 1e-4, "{w}");
        let rates = Forces::default().rates(&WATER, &sphere, &Local::uniform([0.0; 3]), [0.0, -w, 0.0], [0.0; 3]);
        assert!(norm(rates.acceleration) < 1e-12 && rates.spin == [0.0; 3]);
    }

    #[test]
    fn a_neutral_sphere_moves_as_the_fluid() {
        // equal densities, v = u: pressure gradient and added mass together give exactly Du/Dt
        let flow = Stagnation::new(Symmetry::Axisymmetric, [0.0; 3], [0.0, 0.0, 1.0], 100.0).unwrap();
        let local = flow.sample([0.01, 0.02, 0.03]);
        let forces = Forces { pressure_gradient: true, added_mass: true, ..Forces::default() };
        let sphere = Sphere { diameter: 1e-4, density: WATER.density };
        let a = forces.rates(&WATER, &sphere, &local, local.velocity, [0.0; 3]).acceleration;
        assert!(norm(sub(a, local.acceleration)) < 1e-12 * norm(a), "{a:?} {local:?}");
        assert!(forces.rates(&WATER, &sphere, &local, [0.0; 3], [0.0; 3]).acceleration != a);
    }

    #[test]
    fn all_forces_turn_with_the_axes() {
        let all =
            Forces { saffman: true, magnus: true, rotational_drag: true, pressure_gradient: true, ..Forces::default() };
        let all = Forces { added_mass: true, slip: Slip::Davies, ..all };
        let local = Local {
            gradient: [[1.0, 200.0, -3.0], [0.0, -2.0, 40.0], [7.0, 0.0, 1.0]],
            acceleration: [1.0, -2.0, 3.0],
            ..Local::uniform([2.0, 0.5, -0.3])
        };
        let (air, sphere) = (Fluid::default(), Sphere { diameter: 5e-5, density: 2000.0 });
        let (v, spin) = ([1.0, -0.2, 0.1], [100.0, -300.0, 20.0]);
        // x → y → z → x
        let turn = |a: [f64; 3]| [a[2], a[0], a[1]];
        let turned = Local {
            velocity: turn(local.velocity),
            gradient: turn_rows(local.gradient.map(turn)),
            acceleration: turn(local.acceleration),
            ..local
        };
        let a = all.rates(&air, &sphere, &local, v, spin);
        let forces = Forces { gravity: turn(all.gravity), ..all };
        let b = forces.rates(&air, &sphere, &turned, turn(v), turn(spin));
        assert!(norm(sub(turn(a.acceleration), b.acceleration)) < 1e-12 * norm(a.acceleration));
        assert!(norm(sub(turn(a.spin), b.spin)) < 1e-12 * norm(a.spin));
        // every switch matters here
        for one in [
            Forces { saffman: false, ..all },
            Forces { magnus: false, ..all },
            Forces { pressure_gradient: false, ..all },
            Forces { added_mass: false, ..all },
            Forces { buoyancy: false, ..all },
            Forces { slip: Slip::None, ..all },
        ] {
            assert_ne!(one.rates(&air, &sphere, &local, v, spin).acceleration, a.acceleration);
        }
        assert!(Forces::default().is_plain() && !all.is_plain());
    }

    fn turn_rows(g: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        [g[2], g[0], g[1]]
    }

    #[test]
    fn lifts_do_no_work_on_the_slip() {
        let local = Local { gradient: [[0.0, 500.0, 0.0], [0.0; 3], [0.0; 3]], ..Local::uniform([1.0, 0.0, 0.0]) };
        let (air, sphere) = (Fluid::default(), Sphere { diameter: 5e-5, density: 2000.0 });
        let lift_only =
            Forces { gravity: [0.0; 3], drag: Drag::None, saffman: true, magnus: true, ..Forces::default() };
        let v = [0.3, -0.1, 0.2];
        let a = lift_only.rates(&air, &sphere, &local, v, [0.0, 0.0, 900.0]).acceleration;
        let slip = sub(local.velocity, v);
        assert!(norm(a) > 0.0 && crate::vector::dot(a, slip).abs() < 1e-12 * norm(a) * norm(slip));
        assert!(norm(cross(a, slip)) > 0.0);
    }
}
