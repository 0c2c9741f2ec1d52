//! Spheres that are thrown, spin up or are large, without their noise: the steps of spheres that do not diffuse, one lane's.

use super::Leg;
use crate::domain::{Domain, Next, Pieces};
use crate::dynamics::Bodies;
use crate::force::brownian::Relaxation;
use crate::geometry::{Path, split};
use crate::integrate::{Control, Motion, Rates, Step, growth, step};
use crate::tracker::Walk;
use crate::tracker::crew::{Crew, motion_of};
use crate::tracker::cross::{MOST_EDGES, SHORT};
use crate::tracker::walk::{Acting, least_step};
use crate::vector::{Vec3, scale};

impl<D: Domain> Walk<'_, D> {
    /// A step of `h` (s) without noise, up to the edge of the piece; `None` if it must be shorter.
    pub(super) fn fly<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        body: &Bodies<1>,
        h: f64,
    ) -> Option<Leg<D::Here>> {
        let trial = self.attempt(crew, l, body, h);
        let place = self.dynamics.need_place(self.domain);
        let factor = growth(trial.error_squared[0], place);
        let good = trial.error_squared[0] <= 1.0;
        if !good {
            crew.next[l] = h * factor.min(0.9);
            return None;
        }
        crew.h[l] = h;
        let after = crew.after(l, factor);
        let one = |v: [[f64; 1]; 3]| -> Vec3 { v.map(|c| c[0]) };
        let path = Path { start: motion_of(&crew.motion, l).0, points: trial.path.map(one) };
        let rate = crew.lanes[l].diffusion.rate;
        let relaxation = Relaxation::over(rate * h);
        let leg = Leg {
            h,
            relaxation,
            path,
            v: one(trial.end.v),
            twist: trial.twist.map(one),
            into: None,
            carry: None,
            smooth: true,
        };
        let leg = match self.domain.edge(crew.here.get(l), &path) {
            Next::Longest(share) => {
                crew.next[l] = h * share;
                return None;
            }
            Next::Edge { theta, into } => cut(leg, theta, into, rate),
            Next::Carried { theta, into, carry } => Leg { carry: Some(carry), ..cut(leg, theta, into, rate) },
            Next::Clear | Next::Wall(_) => leg,
        };
        crew.next[l] = after;
        if crew.lanes[l].edges > MOST_EDGES {
            // held on the edge from both sides: a short step leads off it
            crew.next[l] = (SHORT * crew.next[l]).max(least_step(crew.time[l]));
        }
        Some(leg)
    }

    fn attempt<const W: usize>(&self, crew: &Crew<W, D::Many<W>>, l: usize, body: &Bodies<1>, h: f64) -> Step<1> {
        let mut leant = *body;
        if self.drifts() {
            leant.eddy = [Some(crew.lanes[l].chance.midway(h))];
        }
        let (here, time) = (D::Many::all(crew.here.get(l)), [crew.time[l]]);
        let one = |v: Vec3| v.map(|c| [c]);
        let (x, v, spin) = motion_of(&crew.motion, l);
        let start = Motion { x: one(x), v: one(v), spin: one(spin) };
        let mut first = Rates::ZERO;
        self.dynamics.rates(self.domain, &here, &[true], &time, &leant, &start, &mut first);
        let place = self.dynamics.need_place(self.domain);
        let control = Control { tolerance: self.per_step(), spins: self.dynamics.spins(), place };
        let forces =
            Acting { dynamics: self.dynamics, domain: self.domain, here: &here, wanted: &[true], bodies: &leant };
        let mut out = Step::ZERO;
        step(&time, &start, &first, &[h], control, &forces, &mut out);
        out
    }
}

/// A step up to θ, where another piece begins.
fn cut<H>(leg: Leg<H>, theta: f64, into: H, rate: f64) -> Leg<H> {
    let path = leg.path.until(theta);
    let v = scale(leg.path.slope(theta), 1.0 / leg.h);
    let twist = split(&leg.twist, theta).0;
    let h = theta * leg.h;
    Leg { h, relaxation: Relaxation::over(rate * h), path, v, twist, into: Some(into), carry: None, smooth: true }
}
