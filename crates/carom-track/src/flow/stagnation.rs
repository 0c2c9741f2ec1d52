//! Potential flow against an infinite plate.
//!
//! With n the distance from the plate, t and r the distances from the stagnation line or point along it and a the strain
//! rate: plane u_t = a t, u_n = −a n; axisymmetric u_r = a r, u_n = −2 a n. This is the outer flow of Hiemenz (1911) and
//! Homann (1936), as in Schlichting & Gersten, Boundary-Layer Theory, sections 5.1.3 and 5.2.3
//! (doi:10.1007/978-3-662-52919-5); the boundary layer, about 2.4 √(ν/a) (plane) or 2.0 √(ν/a) thick, is left out.
//!
//! A sphere with Stokes drag that starts with the fluid never reaches the plate when its Stokes number τ_p ∂u_n/∂n is
//! below ¼: the motion n'' + n'/τ_p + S n/τ_p = 0 (S = a, axisymmetric 2a) is then over-damped.
//!
//! ```
//! use carom_track::flow::{Stagnation, Symmetry};
//! let flow = Stagnation::new(Symmetry::Axisymmetric, [0.0; 3], [0.0, 0.0, 1.0], 100.0)?;
//! assert_eq!(flow.velocity([0.01, 0.0, 0.02]), [1.0, 0.0, -4.0]);
//! # Ok::<(), carom_track::flow::FlowError>(())
//! ```

use super::{FlowError, Local};
use crate::vector::{Vec3, add, cross, dot, scale, sub, unit};

/// How the fluid leaves the stagnation point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Symmetry {
    /// To both sides of a line along the given direction in the plate.
    Plane {
        /// Direction of the stagnation line (any length; its part along the plate's normal is dropped).
        line: [f64; 3],
    },
    /// To all sides of a point.
    Axisymmetric,
}

/// Potential stagnation flow.
#[derive(Clone, Copy, Debug)]
pub struct Stagnation {
    point: Vec3,
    normal: Vec3,
    gradient: [Vec3; 3],
}

impl Stagnation {
    /// Flow against the plate through `point` with `normal` (out of the plate, any length) at a strain rate a (1/s).
    ///
    /// # Errors
    /// [`FlowError`] for directions without length, a line along the normal, or values that are not finite.
    pub fn new(symmetry: Symmetry, point: [f64; 3], normal: [f64; 3], rate: f64) -> Result<Self, FlowError> {
        FlowError::finite("strain rate", rate)?;
        for c in point {
            FlowError::finite("stagnation point", c)?;
        }
        let n = unit(normal).ok_or(FlowError::Direction { name: "stagnation plate normal" })?;
        let outer = |a: Vec3, s: f64| a.map(|c| scale(a, s * c));
        let sum = |a: [Vec3; 3], b: [Vec3; 3]| [add(a[0], b[0]), add(a[1], b[1]), add(a[2], b[2])];
        let gradient = match symmetry {
            Symmetry::Plane { line } => {
                let t = unit(cross(line, n)).ok_or(FlowError::Direction { name: "stagnation line in the plate" })?;
                sum(outer(t, rate), outer(n, -rate))
            }
            Symmetry::Axisymmetric => {
                let identity = [[rate, 0.0, 0.0], [0.0, rate, 0.0], [0.0, 0.0, rate]];
                sum(identity, outer(n, -3.0 * rate))
            }
        };
        Ok(Self { point, normal: n, gradient })
    }

    /// Velocity at `x`, m/s.
    #[inline(always)]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        let d = sub(x, self.point);
        self.gradient.map(|row| dot(row, d))
    }

    /// Everything known at `x`.
    #[inline(always)]
    pub fn sample(&self, x: [f64; 3]) -> Local {
        Local {
            wall_distance: dot(sub(x, self.point), self.normal).max(0.0),
            wall_normal: self.normal,
            ..Local::steady(self.velocity(x), self.gradient)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closed_forms_on_a_tilted_plate() {
        let n = [0.6, 0.0, 0.8];
        let t = [0.8, 0.0, -0.6];
        let plane = Stagnation::new(Symmetry::Plane { line: [0.0, 2.0, 0.0] }, [1.0, 2.0, 3.0], n, 50.0).unwrap();
        let x = add([1.0, 2.0, 3.0], add(scale(n, 0.02), add(scale(t, 0.01), [0.0, 5.0, 0.0])));
        let u = plane.velocity(x);
        assert!((dot(u, n) + 1.0).abs() < 1e-13 && (dot(u, t) - 0.5).abs() < 1e-13 && u[1].abs() < 1e-13);
        let round = Stagnation::new(Symmetry::Axisymmetric, [1.0, 2.0, 3.0], n, 50.0).unwrap();
        for flow in [plane, round] {
            let local = flow.sample(x);
            let g = local.gradient;
            assert!((g[0][0] + g[1][1] + g[2][2]).abs() < 1e-12, "divergence");
            assert!(local.vorticity().iter().all(|w| w.abs() < 1e-12), "vorticity");
            assert!((local.wall_distance - 0.02).abs() < 1e-14);
        }
        // Du/Dt is the gradient of ½u²: along n, S² n with S = 2a
        let a = round.sample(add([1.0, 2.0, 3.0], scale(n, 0.02))).acceleration;
        assert!((dot(a, n) - 100.0 * 100.0 * 0.02).abs() < 1e-9);
    }

    #[test]
    fn refuses_a_line_along_the_normal() {
        assert!(Stagnation::new(Symmetry::Plane { line: [0.0, 0.0, 1.0] }, [0.0; 3], [0.0, 0.0, 1.0], 1.0).is_err());
        assert!(Stagnation::new(Symmetry::Axisymmetric, [0.0; 3], [0.0; 3], 1.0).is_err());
    }
}
