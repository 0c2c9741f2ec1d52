//! Spheres that nothing can happen to any more: what rests for good, and what can never meet a wall.
//!
//! Judged only where it is certain: without forces that depend on the place, a sphere's motion across a plane is known to the end. It
//! never comes nearer if neither its velocity nor a force leads there, or if drag stops it before; a bounded wall lies behind a plane.

use super::Walk;
use super::crew::{Crew, motion_of};
use super::walk::finish;
use crate::domain::{Domain, Pieces};
use crate::force::Drag;
use crate::geometry::{Shape, Wall};
use crate::record::{ParticleFate, Sink};
use crate::vector::{Vec3, add, dot, norm, scale, sub};

/// What moves a sphere in a fluid that is alike everywhere.
struct Free {
    v: Vec3,
    /// Acceleration by weight, m/s².
    weight: Vec3,
    /// The fluid's velocity, m/s, and the longest time the drag needs, s; `None` without drag.
    drag: Option<(Vec3, f64)>,
}

/// Speed relative to the final one, or distance left relative to the radius, that counts as none.
const RELAXED: f64 = 1e-9;

impl<D: Domain> Walk<'_, D> {
    /// Ends a lane that nothing can happen to any more; whether it did.
    pub(super) fn is_done<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        sink: &mut dyn Sink,
    ) -> bool {
        if self.has_chance() {
            return false;
        }
        let (x, v, spin) = motion_of(&crew.motion, l);
        let a = [crew.rates.a[0][l], crew.rates.a[1][l], crew.rates.a[2][l]];
        let until = self.settings.until;
        let lasts = until - crew.time[l];
        if norm(v) == 0.0 && norm(a) == 0.0 && norm(spin) == 0.0 {
            crew.time[l] = if lasts.is_finite() { until } else { crew.time[l] };
            finish(crew, l, ParticleFate::Airborne, None, sink);
            return true;
        }
        if self.dynamics.need_place(self.domain)
            || !self.dynamics.is_plain(self.domain)
            || (lasts.is_finite() && crew.lanes[l].trace)
        {
            return false;
        }
        let weight = crew.bodies.weight.map(|w| w[l]);
        let drag = (self.dynamics.forces.drag != Drag::None).then(|| {
            let u = self.domain.velocities(&D::Many::all(crew.here.get(l)), &[crew.time[l]], &x.map(|c| [c]));
            (u.map(|c| c[0]), 1.0 / crew.bodies.drag_rate[l])
        });
        let free = Free { v, weight, drag };
        if !self.domain.walls().list().iter().all(|w| free.never_meets(w, x, crew.bodies.radius[l])) {
            return false;
        }
        if lasts.is_finite() {
            let (x, v) = match drag {
                None => {
                    (add(x, add(scale(v, lasts), scale(weight, 0.5 * lasts * lasts))), add(v, scale(weight, lasts)))
                }
                // what drag leaves to change: followed until it is next to nothing
                Some((_, tau)) => {
                    let rest = tau * norm(a);
                    if rest > RELAXED * norm(v) && rest * tau > RELAXED * crew.bodies.radius[l] {
                        return false;
                    }
                    let last = add(v, scale(a, tau));
                    (add(x, scale(last, lasts)), last)
                }
            };
            for c in 0..3 {
                crew.motion.x[c][l] = x[c];
                crew.motion.v[c][l] = v[c];
            }
            crew.time[l] = until;
        }
        finish(crew, l, ParticleFate::Airborne, None, sink);
        true
    }
}

impl Free {
    /// Whether a sphere `gap` (m) off a plane with that normal never comes to it.
    fn is_clear(&self, n: Vec3, gap: f64) -> bool {
        let (v, g) = (dot(self.v, n), dot(self.weight, n));
        if !(g >= 0.0 && gap >= 0.0) {
            return false;
        }
        match self.drag {
            None => v >= 0.0 || v * v < 2.0 * g * gap,
            Some((u, tau)) => dot(u, n) >= 0.0 && (v >= 0.0 || -v * tau < gap),
        }
    }

    fn never_meets(&self, wall: &Wall, x: Vec3, radius: f64) -> bool {
        let clearance = wall.clearance(radius);
        match &wall.shape {
            Shape::Plane(p) => self.is_clear(p.normal, p.distance(x) - clearance),
            Shape::Room(r) => r.faces().iter().all(|f| self.is_clear(f.normal, f.distance(x) - clearance)),
            // behind the plane that touches it beneath the sphere
            Shape::Cylinder(c) if !c.inside => self.is_clear(c.normal(x), c.distance(x) - clearance),
            Shape::Cylinder(c) => {
                let across = |v: Vec3| norm(sub(v, scale(c.axis, dot(v, c.axis))));
                let gap = c.distance(x) - clearance;
                let (stops, carried) = match self.drag {
                    None => (across(self.v) == 0.0, 0.0),
                    Some((u, tau)) => (across(self.v) * tau < gap, across(u)),
                };
                stops && carried == 0.0 && across(self.weight) == 0.0
            }
            Shape::Mesh(m) => {
                let bounds = m.bounds();
                (0..3).any(|c| {
                    let (mut down, mut up) = ([0.0; 3], [0.0; 3]);
                    (down[c], up[c]) = (-1.0, 1.0);
                    let below = bounds.min[c] - clearance - x[c];
                    let above = x[c] - bounds.max[c] - clearance;
                    (below > 0.0 && self.is_clear(down, below)) || (above > 0.0 && self.is_clear(up, above))
                })
            }
        }
    }
}
