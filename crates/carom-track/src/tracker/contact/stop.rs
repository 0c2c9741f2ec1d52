//! Where a step of contact motion must end.

use super::surface::{Held, Surface};
use super::{Contact, Kind, Motion};
use crate::domain::{Carry, Domain, Hit, Next};
use crate::geometry::{Path, Shape};
use crate::integrate::Step;
use crate::vector::{add, dot, norm, sub};

/// Where a step must end.
#[derive(Clone, Copy, Debug)]
pub(super) enum Stop<H> {
    /// At its end.
    Whole,
    Edge(H),
    /// Where the space goes on elsewhere.
    Carried(H, Carry),
    Wall(Hit),
    /// The slip is gone, or friction does not keep it zero.
    Grip,
    /// Adhesion has stopped it.
    Still,
    /// Nothing presses any more.
    Press,
    /// The wall is not under it any more.
    Support,
}

impl<D: Domain> Contact<'_, D> {
    /// What a step comes to first, and where.
    pub(super) fn first_stop(
        &self,
        surface: &Surface,
        kind: Kind,
        trial: &Step<1>,
        path: &Path,
        h: f64,
    ) -> (f64, Stop<D::Here>) {
        let mut first = (1.0, Stop::Whole);
        match self.walk.domain.edge(self.here, path) {
            Next::Edge { theta, into } => first = (theta, Stop::Edge(into)),
            Next::Carried { theta, into, carry } => first = (theta, Stop::Carried(into, carry)),
            Next::Clear | Next::Wall(_) | Next::Longest(_) => {}
        }
        if let Some(hit) = self.other_wall(surface, path).filter(|hit| hit.meeting.theta < first.0) {
            first = (hit.meeting.theta, Stop::Wall(hit));
        }
        let mut before = 0.0;
        for quarter in [0.25, 0.5, 0.75, 1.0] {
            if before >= first.0 {
                break;
            }
            let fails = |theta: f64| self.fails(surface, kind, &self.at(trial, h, theta), self.time + theta * h);
            if let Some(why) = fails(quarter) {
                let (mut low, mut high, mut why) = (before, quarter, why);
                for _ in 0..50 {
                    let middle = 0.5 * (low + high);
                    match fails(middle) {
                        Some(w) => (high, why) = (middle, w),
                        None => low = middle,
                    }
                }
                if high < first.0 {
                    first = (high, why);
                }
                break;
            }
            before = quarter;
        }
        first
    }

    /// Why a step may not go on to a motion.
    fn fails(&self, surface: &Surface, kind: Kind, m: &Motion, time: f64) -> Option<Stop<D::Here>> {
        let here = surface.at(m.x);
        let rolling = self.follows && matches!(kind, Kind::Rolls);
        let m = &if rolling { Motion { spin: here.rolling_spin(m, self.radius()), ..*m } } else { *m };
        let (a, turn) = self.steady(time, m);
        let pressed = here.press(m, a);
        if !pressed.holds {
            return Some(Stop::Press);
        }
        let halted = || dot(sub(m.v, here.wall_velocity()), self.heading) <= 0.0;
        if self.heading != [0.0; 3] && halted() {
            return Some(Stop::Still);
        }
        match kind {
            Kind::Free => {}
            Kind::Slides(ahead) if dot(here.slip(m, self.radius()), ahead) <= 0.0 => return Some(Stop::Grip),
            Kind::Slides(_) => {}
            Kind::Rolls if norm(self.grip(&here, m, pressed.acceleration, turn)) > pressed.friction => {
                return Some(Stop::Grip);
            }
            Kind::Rolls => {}
        }
        let under = |c: &Held| {
            let Shape::Mesh(_) = c.wall.shape else { return true };
            let supports = self.walk.domain.walls().support(m.x, self.radius(), self.height);
            supports.iter().any(|s| s.wall == c.index && dot(s.normal, c.normal) > 0.99)
        };
        (!here.list().iter().all(under)).then_some(Stop::Support)
    }

    /// The first other wall, or other part of its wall, that the sphere meets.
    fn other_wall(&self, surface: &Surface, path: &Path) -> Option<Hit> {
        let walls = self.walk.domain.walls();
        let lifted = Path { start: add(path.start, self.lift), ..*path };
        let mut first: Option<Hit> = None;
        for (index, wall) in walls.list().iter().enumerate() {
            let own = surface.list().iter().any(|c| c.index == index);
            if own && matches!(wall.shape, Shape::Cylinder(_) | Shape::Plane(_)) {
                continue;
            }
            let met = wall.shape.meet(&lifted, wall.clearance(self.radius()), 0.1 * norm(self.lift));
            let Some((meeting, face)) = met else { continue };
            let is_own = |c: &Held| c.index == index && dot(c.normal, meeting.normal) > 1.0 - 1e-6;
            if surface.list().iter().any(is_own) || first.is_some_and(|f| f.meeting.theta <= meeting.theta) {
                continue;
            }
            first = Some(Hit { wall: index, face, meeting, wall_velocity: wall.velocity });
        }
        first
    }
}
