//! One eddy, and how a place changes it.

use crate::vector::{Vec3, add, scale};

/// One eddy, met by one sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eddy {
    /// ζ, standard normal deviates along x, y, z.
    pub deviates: [f64; 3],
    /// Age, in time scales of the places it was at.
    pub age: f64,
    /// Age at which it dies.
    pub life: f64,
}

/// What a place does to an eddy that a sphere carries through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// dζ/dt, 1/s.
    pub drift: [f64; 3],
    /// T_L, s; infinite where there is no turbulence.
    pub time: f64,
    /// Length of an eddy, m; infinite where there is no turbulence.
    pub length: f64,
}

impl Surroundings {
    /// Without turbulence.
    pub const CALM: Self = Self { drift: [0.0; 3], time: f64::INFINITY, length: f64::INFINITY };
}

impl Eddy {
    /// No fluctuation, for ever.
    pub const NONE: Self = Self { deviates: [0.0; 3], age: 0.0, life: f64::INFINITY };

    /// The deviates in the middle of a step (s) that starts at a place: what the fluctuation has all through the step.
    #[inline]
    pub fn middle(&self, place: &Surroundings, step: f64) -> Self {
        Self { deviates: add(self.deviates, scale(place.drift, 0.5 * step)), ..*self }
    }

    /// After a step (s) from one place to another.
    #[inline]
    pub fn after(&self, from: &Surroundings, to: &Surroundings, step: f64) -> Self {
        let drift = scale(add(from.drift, to.drift), 0.5 * step);
        let aged = 0.5 * step * (1.0 / from.time + 1.0 / to.time);
        Self { deviates: add(self.deviates, drift), age: self.age + aged, ..*self }
    }

    /// Whether it is dead, or so nearly that no step is worth it.
    #[inline]
    pub fn is_over(&self) -> bool {
        self.life - self.age < LEAST
    }

    /// The age to begin the next eddy with: what this one lived too long or too short, so that none is lost.
    #[inline]
    pub fn overdue(&self) -> f64 {
        (self.age - self.life).min(MOST)
    }

    /// How long it lasts if it stays at a place, s.
    pub fn rest(&self, place: &Surroundings) -> f64 {
        (self.life - self.age) * place.time
    }

    /// The longest step (s) at a place that resolves its drift and its age, and does not outlive it.
    pub fn longest_step(&self, place: &Surroundings) -> f64 {
        let size = |v: Vec3| v[0].abs().max(v[1].abs()).max(v[2].abs());
        let fast = 1.0 / place.time + size(place.drift) * (1.0 + size(self.deviates));
        (RESOLUTION / fast).min(self.rest(place))
    }
}

/// Share of a time scale that counts as none, and the most that is carried over.
const LEAST: f64 = 1e-3;
const MOST: f64 = 0.25;

/// Step over the time in which an eddy changes. With 0.25 the error of mixing is far below that of chance.
const RESOLUTION: f64 = 0.25;
