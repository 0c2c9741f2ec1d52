//! How a run is tracked: its tolerance, its end and what counts as settled.

/// A height of bounce that counts as none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SettleHeight {
    /// A fraction of the sphere's radius.
    Radii(f64),
    /// A length, m.
    Length(f64),
}

impl SettleHeight {
    /// A thousandth of the radius: far below what bounces are measured to.
    pub const DEFAULT: Self = Self::Radii(1e-3);

    pub(super) fn of(self, radius: f64) -> f64 {
        match self {
            Self::Radii(share) => share * radius,
            Self::Length(height) => height,
        }
    }
}

/// How a run is tracked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Tolerated relative error of the time and speed of a first impact.
    pub tolerance: f64,
    /// When the run ends, s; infinite where only the walls end it.
    pub until: f64,
    /// Height of bounce below which a sphere has settled.
    pub settle_height: SettleHeight,
    /// Steps after which a particle is left where it is.
    pub max_steps: u64,
    /// Seed of every random draw.
    pub seed: u64,
}

/// Tolerance 1e-5, no end but at walls, 10⁸ steps at most, seed 1.
impl Default for Settings {
    fn default() -> Self {
        Self {
            tolerance: 1e-5,
            until: f64::INFINITY,
            settle_height: SettleHeight::DEFAULT,
            max_steps: 100_000_000,
            seed: 1,
        }
    }
}

/// Local error of a step over the tolerance of a first impact. Errors of steps add up, and a shallow approach turns an
/// error across the wall into a larger one of the time: docs/benchmarks.md says by how much.
const PER_STEP: f64 = 1.0 / 40.0;
/// Largest local error: beyond, the estimate says little of the error.
const COARSEST: f64 = 1e-5;

impl Settings {
    /// Tolerated error of a step, in a flow that differs from place to place or in one that does not: there an error of the place
    /// feeds on itself. In one made of pieces a sphere may be thrown sideways within a few steps, and everything after has their errors.
    pub(super) fn per_step(&self, place: bool, pieces: bool) -> f64 {
        let share = match (place, pieces) {
            (false, _) => PER_STEP,
            (true, false) => 0.5 * PER_STEP,
            (true, true) => 0.08 * PER_STEP,
        };
        (share * self.tolerance).min(COARSEST)
    }
}
