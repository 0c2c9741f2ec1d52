//! What steps come to first: walls, and the edges of the flow's pieces.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::crew::{Crew, column};
use super::{Walk, lane};
use crate::domain::{Domain, Next, Pieces};
use crate::geometry::{Ahead, Path};
use crate::lanes::{Mask, bits, mask, take_lowest};
use crate::vector::{Vec3, add};

/// What a step comes to first, and the motion there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met<H> {
    pub next: Next<H>,
    /// Where the sphere's centre is then, m.
    pub position: Vec3,
    /// Its velocity, m/s.
    pub velocity: Vec3,
}

impl<H> Met<H> {
    /// Nothing.
    pub const NOTHING: Self = Self { next: Next::Clear, position: [0.0; 3], velocity: [0.0; 3] };
}

impl<D: Domain> Walk<'_, D> {
    /// What the steps of some lanes come to first: the lanes that come to something as bits, and what.
    #[inline(always)]
    pub(super) fn find_first<const W: usize>(
        &self,
        crew: &Crew<W, D::Many<W>>,
        ahead: &Ahead<W>,
        among: &Mask<W>,
        met: &mut [Met<D::Here>; W],
    ) -> u64 {
        let mut look = *among;
        for l in 0..W {
            look[l] &= mask(crew.step.error_squared[l] <= 1.0) & mask(ahead.count[l] != 0);
        }
        if bits(&look) == 0 {
            return 0;
        }
        let (mut theta, plain) = ahead.descents();
        let mut hard = look;
        for l in 0..W {
            hard[l] &= !plain[l];
        }
        let (mut hard, mut found) = (bits(&hard), 0);
        let mut plain = bits(&look) & !hard;
        while let Some(l) = take_lowest(&mut hard) {
            let next = self.domain.first(crew.here.get(l), &path_of(crew, l), crew.bodies.radius[l]);
            theta[l] = match &next {
                Next::Clear => continue,
                Next::Wall(hit) => hit.meeting.theta,
                Next::Edge { theta, .. } | Next::Carried { theta, .. } => *theta,
                Next::Longest(_) => 0.0,
            };
            found |= 1 << l;
            met[l].next = next;
        }
        let (offset, velocity) = crew.step.along(&crew.h, &theta);
        while let Some(l) = take_lowest(&mut plain) {
            let x = add(column(&crew.motion.x, l), column(&offset, l));
            if let Some(hit) = self.domain.walls().hit(ahead.face[l] as usize, theta[l], x, crew.bodies.radius[l]) {
                found |= 1 << l;
                met[l].next = Next::Wall(hit);
            }
        }
        let mut all = found;
        while let Some(l) = take_lowest(&mut all) {
            met[l].velocity = column(&velocity, l);
            met[l].position = add(column(&crew.motion.x, l), column(&offset, l));
        }
        found
    }
}

#[inline(always)]
fn path_of<const W: usize, P>(crew: &Crew<W, P>, l: usize) -> Path {
    Path { start: column(&crew.motion.x, l), points: lane::points(&crew.step.path, l) }
}
