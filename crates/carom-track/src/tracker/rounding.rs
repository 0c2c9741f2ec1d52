//! Steps that move a place by so little that what seems an error is rounding: those of what creeps to a wall without end, 1e-13 m from it,
//! or is held in a corner, at 1e-16 m/s. Shorter steps have no less of it, so that none would be good.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::Walk;
use super::crew::{Crew, motion_of};
use crate::domain::Domain;
use crate::integrate::Control;
use crate::lanes::{bits, mask, take_lowest};
use crate::vector::{Vec3, norm};

/// Square of the share of the tolerated error that such a step counts as having: good enough, and none to grow by much.
pub(super) const GOOD: f64 = 0.4;

/// A step from a place, m, by its length, s, and the square of its error over the tolerated one.
pub(super) struct Tried {
    pub from: Vec3,
    pub h: f64,
    pub error_squared: f64,
    /// Velocities before it, after it, and that its acceleration would add, m/s: no error is relative to more.
    pub velocities: [Vec3; 3],
    /// Rate at which drag ends an error of the velocity, 1/s.
    pub drag_rate: f64,
}

impl Tried {
    /// Whether its error moves the place by less than this can hold, for as long as it lasts.
    pub fn is_rounding(&self, tolerance: f64) -> bool {
        let speed = self.velocities.map(norm).into_iter().fold(0.0, f64::max);
        let error = self.error_squared.sqrt() * tolerance * speed;
        error * self.h.max(1.0 / self.drag_rate) < f64::EPSILON * norm(self.from)
    }
}

impl<D: Domain> Walk<'_, D> {
    /// Such steps of all lanes are not refused.
    #[inline(always)]
    pub(super) fn forgive_rounding<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, control: Control) {
        let mut refused = [0; W];
        for l in 0..W {
            refused[l] = mask(crew.busy[l]) & mask(crew.step.error_squared[l] > 1.0);
        }
        let mut refused = bits(&refused);
        while let Some(l) = take_lowest(&mut refused) {
            let (from, v, _) = motion_of(&crew.motion, l);
            let h = crew.h[l];
            let velocities = [v, motion_of(&crew.step.end, l).1, [0, 1, 2].map(|c| h * crew.rates.a[c][l])];
            let (error_squared, drag_rate) = (crew.step.error_squared[l], crew.bodies.drag_rate[l]);
            if (Tried { from, h, error_squared, velocities, drag_rate }).is_rounding(control.tolerance) {
                crew.step.error_squared[l] = GOOD;
            }
        }
    }
}
