//! Where steps meet walls.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::crew::column;
use super::{Crew, Tracker, lane};
use crate::domain::{Domain, Hit};
use crate::geometry::{Ahead, Meeting, Path};
use crate::lanes::{Mask, bits, mask, take_lowest};
use crate::vector::{Vec3, add};

/// No wall.
pub(super) const NONE: Hit = Hit {
    wall: 0,
    face: None,
    meeting: Meeting { theta: 0.0, position: [0.0; 3], normal: [0.0; 3] },
    wall_velocity: [0.0; 3],
};

impl<D: Domain> Tracker<'_, D> {
    /// Where the steps of some lanes meet walls: the lanes that do as bits, their hits and the velocities there.
    #[inline(always)]
    pub(super) fn find_walls<const W: usize>(
        &self,
        crew: &Crew<W>,
        ahead: &Ahead<W>,
        among: &Mask<W>,
        hits: &mut [(Hit, Vec3); W],
    ) -> u64 {
        let mut look = *among;
        for l in 0..W {
            look[l] &= mask(crew.step.error_squared[l] <= 1.0) & mask(ahead.count[l] != 0);
        }
        let (mut theta, plain) = ahead.descents();
        let mut hard = look;
        for l in 0..W {
            hard[l] &= !plain[l];
        }
        let (mut hard, mut met) = (bits(&hard), 0);
        let mut plain = bits(&look) & !hard;
        while let Some(l) = take_lowest(&mut hard) {
            if let Some(hit) = self.domain.next_wall(&path_of(crew, l), crew.bodies.radius[l]) {
                met |= 1 << l;
                theta[l] = hit.meeting.theta;
                hits[l].0 = hit;
            }
        }
        let (offset, velocity) = crew.step.along(&crew.h, &theta);
        while let Some(l) = take_lowest(&mut plain) {
            let x = add(column(&crew.motion.x, l), column(&offset, l));
            if let Some(hit) = self.domain.hit(ahead.face[l] as usize, theta[l], x, crew.bodies.radius[l]) {
                met |= 1 << l;
                hits[l].0 = hit;
            }
        }
        let mut all = met;
        while let Some(l) = take_lowest(&mut all) {
            hits[l].1 = column(&velocity, l);
        }
        met
    }
}

#[inline(always)]
fn path_of<const W: usize>(crew: &Crew<W>, l: usize) -> Path {
    Path { start: column(&crew.motion.x, l), points: lane::points(&crew.step.path, l) }
}
