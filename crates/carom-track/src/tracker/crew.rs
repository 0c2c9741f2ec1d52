//! The particles at work, side by side.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::Settings;
use super::lane::Lane;
use crate::dynamics::Bodies;
use crate::geometry::Ahead;
use crate::integrate::{Lanes, Lanes3, Motion, Rates, Step};
use crate::lanes::{Mask, choose, mask};
use crate::vector::Vec3;

/// The lanes at work, `P` being the pieces of the domain they are in.
#[repr(align(64))]
pub(super) struct Crew<const W: usize, P> {
    pub lanes: [Lane; W],
    /// Which lanes have a particle.
    pub busy: [bool; W],
    /// Which lanes may go on by themselves where a step meets nothing.
    pub quiet: Mask<W>,
    pub time: Lanes<W>,
    /// Lengths of the next trial steps, s.
    pub next: Lanes<W>,
    /// Where the next step must stop: at the end of the run or where something changes.
    pub stop: Lanes<W>,
    /// The longest step worth trying in the piece each is in, s.
    pub longest: Lanes<W>,
    /// The pieces of the domain they are in.
    pub here: P,
    /// Trial steps so far.
    pub steps: [u64; W],
    pub motion: Motion<W>,
    pub rates: Rates<W>,
    /// Which lanes' rates are not those of their motion.
    pub stale: [bool; W],
    pub bodies: Bodies<W>,
    /// Which lanes step as spheres that follow the fluid.
    pub follows: [bool; W],
    /// Whether any at work does.
    pub some_follow: bool,
    pub h: Lanes<W>,
    pub step: Step<W>,
}

impl<const W: usize, P: Copy> Crew<W, P> {
    /// No lane at work.
    pub const fn idle(here: P) -> Self {
        Self {
            lanes: [Lane::IDLE; W],
            busy: [false; W],
            quiet: [0; W],
            time: [0.0; W],
            next: [0.0; W],
            stop: [0.0; W],
            longest: [f64::INFINITY; W],
            here,
            steps: [0; W],
            motion: Motion::ZERO,
            rates: Rates::ZERO,
            stale: [false; W],
            bodies: Bodies::NONE,
            h: [0.0; W],
            follows: [false; W],
            some_follow: false,
            step: Step::ZERO,
        }
    }

    /// Trial steps that overshoot no stop.
    #[inline(always)]
    pub fn set_steps(&mut self) {
        for l in 0..W {
            let rest = self.stop[l] - self.time[l];
            let h = if self.next[l] < self.longest[l] { self.next[l] } else { self.longest[l] };
            let h = if h < rest { h } else { rest };
            self.h[l] = if self.busy[l] { h } else { 0.0 };
            self.steps[l] += 1;
        }
    }

    /// Takes the steps of the lanes that nothing happens to, and says which these are.
    #[inline(always)]
    pub fn go_on(&mut self, ahead: &Ahead<W>, factor: &Lanes<W>, settings: &Settings, spins: bool) -> Mask<W> {
        let mut goes = self.quiet;
        for l in 0..W {
            goes[l] &= mask(ahead.count[l] == 0);
        }
        for l in 0..W {
            goes[l] &= mask(self.step.error_squared[l] <= 1.0);
        }
        for l in 0..W {
            goes[l] &= mask(self.h[l] < self.stop[l] - self.time[l]);
        }
        for l in 0..W {
            goes[l] &= mask(self.steps[l] <= settings.max_steps);
        }
        for l in 0..W {
            goes[l] &= mask(self.time[l] + self.h[l] > self.time[l]);
        }
        let (mut time, mut next) = ([0.0; W], [0.0; W]);
        for l in 0..W {
            time[l] = self.time[l] + self.h[l];
            next[l] = self.after(l, factor[l]);
        }
        choose(&mut self.time, &time, &goes);
        choose(&mut self.next, &next, &goes);
        if self.some_follow {
            choose(&mut self.rates.drag, &self.step.rates.drag, &goes);
            choose(&mut self.rates.torque, &self.step.rates.torque, &goes);
        }
        for c in 0..3 {
            choose(&mut self.motion.x[c], &self.step.end.x[c], &goes);
            choose(&mut self.motion.v[c], &self.step.end.v[c], &goes);
            choose(&mut self.rates.a[c], &self.step.rates.a[c], &goes);
            if spins {
                choose(&mut self.motion.spin[c], &self.step.end.spin[c], &goes);
                choose(&mut self.rates.alpha[c], &self.step.rates.alpha[c], &goes);
            }
        }
        goes
    }
}

impl<const W: usize, P> Crew<W, P> {
    /// The step to try after one that was good, s: one cut short says nothing against a longer one.
    #[inline(always)]
    pub fn after(&self, l: usize, factor: f64) -> f64 {
        let next = self.h[l] * factor;
        if next < self.next[l] && factor >= 1.0 { self.next[l] } else { next }
    }
}

/// One lane's vector.
#[inline(always)]
pub(super) fn column<const W: usize>(v: &Lanes3<W>, l: usize) -> Vec3 {
    [v[0][l], v[1][l], v[2][l]]
}

/// Position, velocity and spin of one lane.
#[inline(always)]
pub(super) fn motion_of<const W: usize>(m: &Motion<W>, l: usize) -> (Vec3, Vec3, Vec3) {
    (column(&m.x, l), column(&m.v, l), column(&m.spin, l))
}
