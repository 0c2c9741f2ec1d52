//! Steps of Brownian spheres across planes of symmetry, the sides of wedges and cyclic patches.
//!
//! A step with its noise is one path. It is followed from piece to piece, and where the space goes on elsewhere the rest of it is carried
//! there, with the sphere's velocity and what is remembered of it: the law of the motion is the same on both sides, so the path is one that the
//! whole body could have had. Walls are looked for on each part where it is.

use super::{Leg, lay};
use crate::domain::{Carry, Domain, Hit, Next, Pieces};
use crate::flow::cells::carry_spin;
use crate::geometry::{Path, split};
use crate::record::Sink;
use crate::tracker::Walk;
use crate::tracker::crew::{Crew, motion_of};
use crate::tracker::cross::NO_WAY;
use crate::tracker::lane;
use crate::tracker::meeting::put;
use crate::vector::add;

/// Pieces that a step goes through before its place is looked for anew: where cells overlap it may be led round and round.
const MOST_PIECES: usize = 256;

/// Where a step leads.
struct Unfolded<H> {
    /// What share of it lies before the last place from which it goes on elsewhere.
    begun: f64,
    /// How it was carried until there.
    carry: Option<Carry>,
    /// The rest of it.
    rest: Path,
    /// The piece that it ends in.
    into: H,
    /// The wall that it meets, on the rest.
    hit: Option<Hit>,
}

impl<D: Domain> Walk<'_, D> {
    /// Ends a step of a lane where the space goes on elsewhere.
    pub(super) fn unfold<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        mut leg: Leg<D::Here>,
        sink: &mut dyn Sink,
    ) {
        let to = self.follow(crew.here.get(l), crew.time[l], leg.path, crew.bodies.radius[l]);
        let retried = to.hit.is_some() && !leg.smooth;
        if let Some(carry) = to.carry.filter(|_| !retried) {
            self.begin_elsewhere(crew, l, &mut leg, (to.begun, carry), sink);
            leg.path = to.rest;
        }
        leg.into = to.hit.is_none().then_some(to.into);
        self.end_leg(crew, l, leg, to.hit, sink);
    }

    fn follow(&self, here: D::Here, time: f64, path: Path, radius: f64) -> Unfolded<D::Here> {
        let first = |path: &Path| self.domain.walls().first(path, radius);
        let mut to = Unfolded { begun: 0.0, carry: None, rest: path, into: here, hit: first(&path) };
        // the part in the piece at hand, and what share of `rest` lies before it
        let (mut part, mut before) = (path, 0.0);
        for _ in 0..MOST_PIECES {
            let (theta, into, carry) = match self.domain.edge(to.into, &part) {
                Next::Edge { theta, into } => (theta, into, None),
                Next::Carried { theta, into, carry } => (theta, into, Some(carry)),
                Next::Clear | Next::Wall(_) | Next::Longest(_) => return to,
            };
            let at = before + theta * (1.0 - before);
            if to.hit.is_some_and(|hit| hit.meeting.theta <= at) {
                return to;
            }
            let (x, slope) = (part.at(theta), part.slope(theta));
            to.into = into;
            match carry {
                Some(carry) => {
                    let rest = to.rest.from(at);
                    let points = rest.points.map(|p| carry.vector(p));
                    to.rest = Path { start: carry.point(rest.start), points };
                    to.begun += at * (1.0 - to.begun);
                    to.carry = Some(to.carry.map_or(carry, |c| c.then(&carry)));
                    to.hit = first(&to.rest);
                    (part, before) = (to.rest, 0.0);
                }
                None => {
                    if theta < NO_WAY {
                        to.into = self.domain.enter_ahead(to.into, x, slope);
                    }
                    (part, before) = (part.from(theta), at);
                }
            }
        }
        to.into = self.domain.enter(time, to.rest.at(1.0));
        to
    }

    /// Puts a lane where its step goes on elsewhere, with the rest of that.
    fn begin_elsewhere<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        leg: &mut Leg<D::Here>,
        (begun, carry): (f64, Carry),
        sink: &mut dyn Sink,
    ) {
        lay(crew, l, leg);
        if crew.lanes[l].trace {
            lane::trace(crew, l, begun, sink);
        }
        let (_, v, spin) = motion_of(&crew.motion, l);
        let (until, from) = split(&leg.twist, begun);
        put(crew, l, leg.path.at(begun), v, add(spin, until[3]));
        crew.time[l] += begun * leg.h;
        self.carry(crew, l, &carry);
        leg.h *= 1.0 - begun;
        leg.v = carry.vector(leg.v);
        leg.twist = from.map(|p| carry_spin(&carry, p));
    }

    /// Carries a lane's sphere and what is remembered of it.
    pub(super) fn carry<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, carry: &Carry) {
        let (x, v, spin) = motion_of(&crew.motion, l);
        put(crew, l, carry.point(x), carry.vector(v), carry_spin(carry, spin));
        crew.lanes[l].chance.carry(carry);
        crew.bodies.carry(l, carry);
        let diffusion = &mut crew.lanes[l].diffusion;
        diffusion.slow = carry.vector(diffusion.slow);
        diffusion.jitter = carry.vector(diffusion.jitter);
    }
}
