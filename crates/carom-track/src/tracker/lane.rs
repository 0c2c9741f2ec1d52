//! One particle in flight.

use super::chance::Chance;
use super::{Crew, Particle};
use crate::geometry::evaluate;
use crate::integrate::Lanes3;
use crate::record::Sink;
use crate::vector::{Vec3, add};

/// A particle's state besides its motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lane {
    pub particle: Particle,
    pub time: f64,
    /// Length of the next trial step, s.
    pub step: f64,
    pub steps: u64,
    /// Number of impacts so far: keys the random draws.
    pub impacts: u64,
    /// Impacts in a row during which no time passed.
    pub standing: u32,
    /// The trial step was chosen for a wall already seen.
    pub fitted: bool,
    /// Points of the path are wanted.
    pub trace: bool,
    /// What changes at random.
    pub chance: Chance,
}

impl Lane {
    /// No particle yet.
    pub const IDLE: Self = Self::new(
        Particle {
            number: 0,
            injection: 0,
            diameter: 1.0,
            density: 1.0,
            weight: 0.0,
            time: 0.0,
            position: [0.0; 3],
            velocity: [0.0; 3],
            spin: [0.0; 3],
        },
        false,
    );

    pub const fn new(particle: Particle, trace: bool) -> Self {
        Self {
            particle,
            time: particle.time,
            step: 0.0,
            steps: 0,
            impacts: 0,
            standing: 0,
            fitted: false,
            trace,
            chance: Chance::NONE,
        }
    }

    /// Where the next step must stop: at the end of the run or where something changes.
    #[inline(always)]
    pub fn stop(&self, until: f64) -> f64 {
        let next = self.chance.next();
        if next > self.time { until.min(next) } else { until }
    }

    /// The next trial step, not beyond the stop.
    #[inline(always)]
    pub fn next_step(&self, until: f64) -> f64 {
        self.step.min(self.stop(until) - self.time)
    }
}

/// Control points of one lane.
#[inline(always)]
pub(super) fn points<const W: usize>(points: &[Lanes3<W>; 4], l: usize) -> [Vec3; 4] {
    let at = |p: &Lanes3<W>| [p[0][l], p[1][l], p[2][l]];
    [at(&points[0]), at(&points[1]), at(&points[2]), at(&points[3])]
}

/// Most points of one step that a trajectory shows.
const MOST_POINTS: f64 = 64.0;

/// Tells the sink the path from the start of the step up to `theta` (not included), with as many points as a smooth
/// line needs: no chord further from the curve than a thousandth of the step's length.
pub(super) fn trace<const W: usize>(crew: &Crew<W>, l: usize, theta: f64, sink: &mut dyn Sink) {
    let lane = &crew.lanes[l];
    let (x, v, spin) = super::motion_of(&crew.motion, l);
    let path = points(&crew.step.path, l);
    let speed = points(&crew.step.speed, l);
    let twist = points(&crew.step.twist, l);
    let size = |p: Vec3| p.iter().fold(0.0f64, |m, c| m.max(c.abs()));
    let at = |i: usize| if i == 0 { [0.0; 3] } else { path[i - 1] };
    let bend = (0..3).fold(0.0f64, |m, i| {
        let second = [0, 1, 2].map(|c| at(i)[c] - 2.0 * at(i + 1)[c] + at(i + 2)[c]);
        m.max(size(second))
    });
    // a quartic's second derivative is at most 12 times the greatest second difference
    let count = (12.0 / 8.0 * bend / (1e-3 * size(path[3]).max(bend * 1e-2))).sqrt() * theta;
    let count = if count.is_finite() { count.ceil().clamp(1.0, MOST_POINTS) } else { 1.0 };
    for i in 0..count as u32 {
        let t = theta * f64::from(i) / count;
        let time = lane.time + t * crew.h[l];
        sink.point(
            lane.particle.number,
            time,
            add(x, evaluate(&path, t)),
            add(v, evaluate(&speed, t)),
            add(spin, evaluate(&twist, t)),
        );
    }
}
