//! Rolling of a sphere that adheres to its wall, in the shear that took it off ([`carom::removal`]).
//!
//! The sphere touches the wall in the linear profile G y next to it, G = u_τ²/ν, along the unit vector t of the flow. With V its velocity
//! along the wall, s = R ω × n that of its surface as it spins (V = s where it rolls), β = 6πμR/m, per mass:
//!
//! force = β [1.7009 G R t − A V + B s] + g − (F_po − F_L) n/m,  torque/R = β [(2/3) 0.944 G R t + B V − (4/3) C s] − M/(mR) V̂
//!
//! | symbol | meaning | source |
//! |---|---|---|
//! | 1.7009, 0.944 | force and torque of the shear on a sphere at rest | O'Neill 1968, <https://doi.org/10.1016/0009-2509(68)89039-6> |
//! | A = 0.9588 − (8/15) ln ε, B = −0.2526 − (2/15) ln ε, C = 0.3817 − (2/5) ln ε | resistance to its own motion and spin next to the wall | Goldman, Cox & Brenner 1967, <https://doi.org/10.1016/0009-2509(67)80047-2> |
//! | F_po, M, F_L | pull-off force, greatest moment of adhesion (N m), lift at the wall | [`carom::removal`] |
//!
//! M is the moment that set it rolling: the contact is peeled behind and made anew in front, and all of that work is lost. So it begins
//! to move exactly where the criterion is exceeded, and rolling, (7/5) V' = β [2.3302 G R − (A − 2B + (4/3) C) V] − M/(mR): in an even
//! shear V = V_∞ (1 − e^{−t/T}), T = (7/5)/(β (1.9729 − 0.8 ln ε)). It rests again where the flow no longer turns it against M, and lifts
//! off where F_L exceeds F_po. Friction f (F_po − F_L + m g_n) lets it roll; where that is too little it slides.
//!
//! ε R is the gap, for a contact of solids none; lubrication ends at the mean free path in a gas and at R/1000 in a liquid, as in
//! [`wall_drag`](crate::force::wall_drag). Range: ε ≤ 0.1, where the logarithms hold within some percent (ε = 0.1 is taken beyond: spheres below 1.3 µm
//! in air); u_τ d/ν below 5; steady shear. Lift is that of a sphere at rest. Brownian kicks and eddies are left out.

use super::surface::Surface;
use super::{Contact, Kind, Motion};
use crate::domain::Domain;
use crate::geometry::Shape;
use crate::integrate::Rates;
use crate::vector::{Vec3, add, cross, dot, norm, scale, sub, unit};
use carom::math::ln;
use carom::removal::{DRAG_AT_WALL, Fluid, Removal, TORQUE_AT_WALL};
use std::f64::consts::PI;

/// Largest gap over the radius at which the logarithms hold.
const WIDEST: f64 = 0.1;

/// What holds a sphere that rolls on in a shear.
#[derive(Clone, Copy, Debug)]
pub(in crate::tracker) struct Adhered {
    /// The wall that holds it.
    wall: usize,
    /// Friction velocity, m/s, where the flow's own does not count.
    friction_velocity: Option<f64>,
    /// F_po/m, m/s².
    pull: f64,
    /// M/(mR), m/s².
    moment: f64,
    /// A, B, C.
    resistance: [f64; 3],
}

impl Adhered {
    /// A sphere of a mass (kg) and radius (m) in a fluid of that mean free path (m; 0 in a liquid).
    pub fn new(
        wall: usize,
        friction_velocity: Option<f64>,
        held: &Removal,
        (mass, radius): (f64, f64),
        mean_free_path: f64,
    ) -> Self {
        let gap = if mean_free_path > 0.0 { mean_free_path / radius } else { 1e-3 };
        Self {
            wall,
            friction_velocity,
            pull: held.pull_off_force / mass,
            moment: held.adhesion_moment / (mass * radius),
            resistance: resistance(gap.min(WIDEST)),
        }
    }
}

/// A, B, C of a gap over the radius.
fn resistance(gap: f64) -> [f64; 3] {
    let log = -ln(gap);
    [0.9588 + 8.0 / 15.0 * log, 2.0 / 15.0 * log - 0.2526, 0.3817 + 0.4 * log]
}

impl<D: Domain> Contact<'_, D> {
    /// Rolling on from rest as it adheres.
    pub fn rolling_off(mut self, adhered: Adhered) -> Self {
        self.adhered = Some(adhered);
        self
    }

    /// What holds it to the wall it is on.
    pub(super) fn adhered(&self) -> Option<&Adhered> {
        self.adhered.as_ref().filter(|a| a.wall == self.wall)
    }

    /// The rates of a sphere that adheres.
    pub(super) fn rates_as_adhered(&self, held: &Adhered, time: f64, m: &Motion) -> Rates<1> {
        let Some(wall) = self.walk.domain.walls().list().get(self.wall) else { return Rates::ZERO };
        let n = if let Shape::Cylinder(c) = &wall.shape { c.normal(m.x) } else { self.normal };
        let along = |v: Vec3| sub(v, scale(n, dot(v, n)));
        let radius = self.radius();
        let mass = self.body.sphere[0].mass();
        let local = self.walk.domain.fluid(self.here, time, m.x);
        let fluid = self.walk.dynamics.fluid_at(&local);
        let rate = 6.0 * PI * fluid.viscosity * radius / mass;
        let speed = held.friction_velocity.unwrap_or(local.friction_velocity);
        let shear = unit(along(sub(local.velocity, wall.velocity)))
            .map_or([0.0; 3], |t| scale(t, speed * speed / fluid.kinematic_viscosity() * radius));
        let (v, s) = (along(sub(m.v, wall.velocity)), scale(cross(m.spin, n), radius));
        let [a, b, c] = held.resistance;
        let sum = |by_shear: f64, by_motion: f64, by_spin: f64| {
            [0, 1, 2].map(|i| rate * (by_shear * shear[i] + by_motion * v[i] + by_spin * s[i]))
        };
        let at_wall = Fluid { density: fluid.density, viscosity: fluid.viscosity };
        let lift = at_wall.lift_at_wall(2.0 * radius, speed) / mass;
        let weight = self.body.weight.map(|w| w[0]);
        let force = add(add(sum(DRAG_AT_WALL, -a, b), weight), scale(n, lift - held.pull));
        let torque = sub(sum(2.0 / 3.0 * TORQUE_AT_WALL, b, -4.0 / 3.0 * c), scale(along(self.heading), held.moment));
        let turn = scale(cross(n, torque), 2.5 / radius);
        let mut out = Rates::ZERO;
        (out.a, out.alpha) = (force.map(|c| [c]), turn.map(|c| [c]));
        (out.drag, out.torque) = ([rate * (a - b)], [2.5 * rate * (4.0 / 3.0 * c - b)]);
        out
    }

    /// Which way it rolls, or would if it is at rest: zero where adhesion holds it there.
    pub(super) fn heading(&mut self, surface: &Surface) -> Vec3 {
        let Some(moment) = self.adhered().map(|a| a.moment) else { return [0.0; 3] };
        let u = surface.wall_velocity();
        let v = surface.along(sub(self.motion.v, u));
        if let Some(ahead) = unit(v) {
            return ahead;
        }
        self.heading = [0.0; 3];
        let still = Motion { v: u, spin: [0.0; 3], ..self.motion };
        let (a, turn) = self.steady(self.time, &still);
        let drive = surface.along(add(a, scale(cross(turn, self.normal), 0.4 * self.radius())));
        if norm(drive) > moment { unit(drive).unwrap_or_default() } else { [0.0; 3] }
    }

    /// Whether the rest of its way counts as none.
    pub(super) fn creeps(&self, surface: &Surface) -> bool {
        let v = surface.along(sub(self.motion.v, surface.wall_velocity()));
        let (a, turn) = self.steady(self.time, &self.motion);
        let rolls = Kind::Rolls;
        let slowed = surface.along(self.accelerations(surface, rolls, &self.motion, a, turn).0);
        let speed = norm(v);
        speed > 0.0 && speed * speed * speed < self.height * -dot(slowed, v)
    }

    /// Energy per mass that adhesion takes on a way, m²/s².
    pub(super) fn peeled(&self, from: Vec3, to: Vec3) -> f64 {
        self.adhered().map_or(0.0, |a| a.moment * norm(sub(to, from)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resistances_are_those_of_the_sum_of_the_motions() {
        // the moment about the contact of a sphere that rolls, over πμR²V: 4.8 ln(1/ε) + 11.84
        for gap in [1e-4, 1e-2] {
            let [a, b, c] = resistance(gap);
            let sum = 6.0 * (a - 2.0 * b + 4.0 / 3.0 * c);
            assert!((sum - (4.8 * (1.0 / gap).ln() + 11.838)).abs() < 1e-2, "{sum}");
            // a spin of its own needs a torque, a translation a force, whatever the other does
            assert!(a * (4.0 / 3.0 * c) > b * b);
        }
    }
}
