//! One particle in flight.

use super::Particle;
use super::chance::Chance;
use super::crew::Crew;
use super::crew::column;
use super::diffusion::Diffusion;
use super::gait::Gait;
use crate::geometry::evaluate;
use crate::integrate::Lanes3;
use crate::record::Sink;
use crate::vector::{Vec3, add};

/// A particle's state besides its motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lane {
    pub particle: Particle,
    /// Number of impacts so far: keys the random draws.
    pub impacts: u64,
    /// Impacts in a row during which no time passed.
    pub standing: u32,
    /// Edges in a row during which no time passed.
    pub edges: u32,
    /// Edges in a row without getting on.
    pub round: u32,
    /// The trial step was chosen for a wall already seen.
    pub fitted: bool,
    /// Points of the path are wanted.
    pub trace: bool,
    /// It has been where nothing is known of the fluid.
    pub strayed: bool,
    /// The cell of a mesh behind whose side its place was lost.
    pub lost_from: Option<u32>,
    /// Which kind of step it takes.
    pub gait: Gait,
    /// What changes at random.
    pub chance: Chance,
    /// How it diffuses.
    pub diffusion: Diffusion,
}

impl Lane {
    /// No particle yet.
    pub const IDLE: Self = Self {
        particle: Particle {
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
        impacts: 0,
        standing: 0,
        edges: 0,
        round: 0,
        fitted: false,
        trace: false,
        strayed: false,
        lost_from: None,
        gait: Gait::new(0.0),
        chance: Chance::NONE,
        diffusion: Diffusion::NONE,
    };

    /// Begins with a particle; what changes at random is cleared where anything does.
    #[inline(always)]
    pub fn begin(&mut self, particle: Particle, trace: bool, has_chance: bool) {
        self.particle = particle;
        self.gait = Gait::new(particle.time);
        (self.impacts, self.standing, self.edges, self.round) = (0, 0, 0, 0);
        (self.fitted, self.trace, self.strayed, self.lost_from) = (false, trace, false, None);
        if has_chance {
            (self.chance, self.diffusion) = (Chance::NONE, Diffusion::NONE);
        }
    }

    /// Nothing about it needs a look when a step of it meets no wall.
    #[inline(always)]
    pub fn is_quiet(&self) -> bool {
        !(self.trace | self.fitted) && self.standing == 0
    }
}

/// Control points of one lane.
#[inline(always)]
pub(super) fn points<const W: usize, const N: usize>(points: &[Lanes3<W>; N], l: usize) -> [Vec3; N] {
    let mut out = [[0.0; 3]; N];
    for (out, p) in out.iter_mut().zip(points) {
        *out = [p[0][l], p[1][l], p[2][l]];
    }
    out
}

/// Most points of one step that a trajectory shows.
const MOST_POINTS: f64 = 64.0;

/// Tells the sink the path from the start of the step up to `theta` (not included), with as many points as a smooth
/// line needs: no chord further from the curve than a thousandth of the step's length.
pub(super) fn trace<const W: usize, P: Copy>(crew: &Crew<W, P>, l: usize, theta: f64, sink: &mut dyn Sink) {
    let lane = &crew.lanes[l];
    let (x, v, spin) = super::crew::motion_of(&crew.motion, l);
    let path = points(&crew.step.path, l);
    let twist = points(&crew.step.twist, l);
    let size = |p: Vec3| p.iter().fold(0.0f64, |m, c| m.max(c.abs()));
    let at = |i: usize| if i == 0 { [0.0; 3] } else { path[i - 1] };
    let bend = (0..4).fold(0.0f64, |m, i| {
        let second = [0, 1, 2].map(|c| at(i)[c] - 2.0 * at(i + 1)[c] + at(i + 2)[c]);
        m.max(size(second))
    });
    // a quintic's second derivative is at most 20 times the greatest second difference
    let count = (20.0 / 8.0 * bend / (1e-3 * size(path[4]).max(bend * 1e-2))).sqrt() * theta;
    let count = if count.is_finite() { count.ceil().clamp(1.0, MOST_POINTS) } else { 1.0 };
    for i in 0..count as u32 {
        let t = theta * f64::from(i) / count;
        let (offset, velocity) = crew.step.along(&crew.h, &[t; W]);
        sink.point(
            lane.particle.number,
            crew.time[l] + t * crew.h[l],
            add(x, column(&offset, l)),
            // a path by chance says nothing of the velocity at its start
            if i == 0 { v } else { column(&velocity, l) },
            add(spin, evaluate(&twist, t)),
        );
    }
}
