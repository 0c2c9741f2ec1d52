//! How friction acts on a sphere that moves along a wall.

use super::surface::Surface;
use super::{Contact, Motion};
use crate::domain::Domain;
use crate::integrate::{Derivative, Lanes, Motion as Motions, Rates, Step};
use crate::vector::{Vec3, add, dot, norm, scale, sub, unit};

/// Slip over the speeds it is made of that counts as none.
const NO_SLIP: f64 = 1e-9;

/// How friction acts during a step.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    Free,
    /// Against a slip that is within a right angle of this direction; beyond zero slip it goes on smoothly.
    Slides(Vec3),
    Rolls,
}

impl<D: Domain> Contact<'_, D> {
    pub(super) fn kind(&self, surface: &Surface) -> Kind {
        let m = &self.motion;
        let (a, turn) = self.steady(self.time, m);
        let pressed = surface.press(m, a);
        if pressed.friction <= 0.0 {
            return Kind::Free;
        }
        let slip = surface.slip(m, self.radius());
        let speeds = norm(sub(m.v, surface.wall_velocity())) + self.radius() * norm(m.spin);
        if !self.rolls && norm(slip) > NO_SLIP * speeds {
            return unit(slip).map_or(Kind::Free, Kind::Slides);
        }
        let grip = self.grip(surface, m, pressed.acceleration, turn);
        if norm(grip) <= pressed.friction {
            Kind::Rolls
        } else {
            unit(grip).map_or(Kind::Rolls, |g| Kind::Slides(scale(g, -1.0)))
        }
    }

    /// The friction per mass that keeps the slip as it is, m/s².
    pub(super) fn grip(&self, surface: &Surface, m: &Motion, a: Vec3, turn: Vec3) -> Vec3 {
        let change = Motion { v: add(surface.wall_velocity(), a), spin: turn, ..*m };
        let lever = surface.lever();
        scale(surface.slip(&change, self.radius()), -1.0 / (1.0 + 2.5 * lever * lever))
    }

    /// Acceleration and angular acceleration on a surface, where the forces alone would give `a` and `turn`.
    pub(super) fn accelerations(&self, surface: &Surface, kind: Kind, m: &Motion, a: Vec3, turn: Vec3) -> (Vec3, Vec3) {
        let pressed = surface.press(m, a);
        let friction = match kind {
            Kind::Free => return (pressed.acceleration, turn),
            Kind::Rolls => self.grip(surface, m, pressed.acceleration, turn),
            Kind::Slides(ahead) => {
                let direction = unit(surface.slip(m, self.radius())).unwrap_or(ahead);
                let direction = if dot(direction, ahead) < 0.0 { scale(direction, -1.0) } else { direction };
                scale(direction, -pressed.friction)
            }
        };
        (add(pressed.acceleration, friction), add(turn, surface.turn(friction, self.radius())))
    }

    /// Energy per mass that friction, and adhesion as it is peeled, take up to θ of a step: Boole's rule over the power f p |v_s|.
    pub(super) fn work(&self, surface: &Surface, kind: Kind, trial: &Step<1>, h: f64, theta: f64) -> f64 {
        let peeled = self.peeled(self.motion.x, self.at(trial, h, theta).x);
        if !matches!(kind, Kind::Slides(_)) {
            return peeled;
        }
        const WEIGHTS: [f64; 5] = [7.0, 32.0, 12.0, 32.0, 7.0];
        let power = |i: usize| {
            let t = theta * 0.25 * i as f64;
            let m = self.at(trial, h, t);
            let here = surface.at(m.x);
            let (a, _) = self.steady(self.time + t * h, &m);
            here.press(&m, a).friction * norm(here.slip(&m, self.radius()))
        };
        let sum: f64 = WEIGHTS.iter().enumerate().map(|(i, w)| w * power(i)).sum();
        peeled + sum * theta * h / 90.0
    }
}

/// The forces on a sphere on a surface.
pub(super) struct OnSurface<'b, 'a, D: Domain> {
    pub contact: &'b Contact<'a, D>,
    pub surface: &'b Surface<'a>,
    pub kind: Kind,
}

impl<D: Domain> Derivative<1> for OnSurface<'_, '_, D> {
    fn rates(&self, time: &Lanes<1>, motion: &Motions<1>, out: &mut Rates<1>) {
        let column = |v: &[[f64; 1]; 3]| [v[0][0], v[1][0], v[2][0]];
        let mut m = Motion { x: column(&motion.x), v: column(&motion.v), spin: column(&motion.spin) };
        let here = self.surface.at(m.x);
        let rolls = matches!(self.kind, Kind::Rolls);
        if rolls && self.contact.follows {
            m.spin = here.rolling_spin(&m, self.contact.radius());
        }
        let rates = self.contact.rates(time[0], &m);
        let (a, turn) = self.contact.shared(&rates);
        let (a, turn) = self.contact.accelerations(&here, self.kind, &m, a, turn);
        (out.a, out.alpha) = (a.map(|c| [c]), turn.map(|c| [c]));
        (out.drag, out.torque) = (rates.drag, rates.torque);
        if rolls {
            // friction hands over what the spin has of the motion, and what the torque takes of it
            let spinning = 2.5 * self.surface.lever() * self.surface.lever();
            out.drag = [(spinning * rates.drag[0] + rates.torque[0]) / (1.0 + spinning)];
        }
    }
}
