//! Edges of pieces that spheres come to: gone over side by side where that is plain, else one by one.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::ahead::Met;
use super::crew::Crew;
use super::meeting::NO_TIME;
use super::walk::{least_step, lose};
use super::{Walk, lane, meeting};
use crate::domain::{Carry, Domain, Edges, Pieces};
use crate::flow::cells::carry_spin;
use crate::integrate::Lanes;
use crate::lanes::{Mask, bits, choose, mask, take_lowest};
use crate::record::Sink;

/// Edges met in a row without any time between them after which a sphere is led off the edge.
pub(super) const MOST_EDGES: u32 = 8;
/// Share of a step that is no way to get on.
pub(super) const NO_WAY: f64 = 1e-9;
/// Edges met in a row without getting on, as where pieces overlap, after which the piece is looked for anew.
pub(super) const ROUND: u32 = 2 * MOST_EDGES;
/// And after which the sphere is lost.
const LOST: u32 = 64 * MOST_EDGES;

/// Edges of pieces that spheres went across, for tests that count them.
#[cfg(test)]
pub(super) static CROSSED: std::sync::atomic::AtomicU64 = std::sync::atomic::AtomicU64::new(0);
/// What is left of a step that leads off an edge.
pub(super) const SHORT: f64 = 1e-3;

impl<D: Domain> Walk<'_, D> {
    /// Ends the steps of some lanes at the edges they come to, and puts them into the pieces behind, as [`Walk::cross`] does it one by one;
    /// those of which that is plain: nothing is to be told, and the step gets on.
    #[inline(always)]
    pub(super) fn cross_together<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        edges: &Edges<W>,
        among: &Mask<W>,
        factor: &Lanes<W>,
    ) -> Mask<W> {
        if self.dynamics.spins() {
            return [0; W];
        }
        let (mut time, mut next, mut goes) = ([0.0; W], [0.0; W], [0; W]);
        for l in 0..W {
            time[l] = edges.theta[l].mul_add(crew.h[l], crew.time[l]);
            next[l] = crew.after(l, factor[l]);
        }
        for l in 0..W {
            goes[l] = among[l] & edges.plain[l] & crew.quiet[l];
            goes[l] &= mask(crew.step.error_squared[l] <= 1.0) & mask(crew.steps[l] <= self.settings.max_steps);
            goes[l] &= mask(edges.theta[l] >= NO_WAY) & mask(gets_on(crew.time[l], time[l]));
        }
        if bits(&goes) == 0 {
            return goes;
        }
        let goes = self.domain.go_over(&mut crew.here, edges, &goes);
        for c in 0..3 {
            let (mut x, mut v) = ([0.0; W], [0.0; W]);
            for l in 0..W {
                x[l] = crew.motion.x[c][l] + edges.way[c][l];
                v[l] = edges.slope[c][l] / crew.h[l];
            }
            choose(&mut crew.motion.x[c], &x, &goes);
            choose(&mut crew.motion.v[c], &v, &goes);
        }
        choose(&mut crew.time, &time, &goes);
        choose(&mut crew.next, &next, &goes);
        let mut gone = bits(&goes);
        #[cfg(test)]
        CROSSED.fetch_add(u64::from(gone.count_ones()), std::sync::atomic::Ordering::Relaxed);
        while let Some(l) = take_lowest(&mut gone) {
            crew.stale[l] = true;
            let lane = &mut crew.lanes[l];
            (lane.round, lane.edges) = (0, 0);
        }
        goes
    }

    /// Ends a step of one lane at the edge of a piece, and puts it into the next one, carried over where the space goes on elsewhere.
    #[inline(never)]
    pub(super) fn cross<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        (theta, into, carry): (f64, D::Here, Option<&Carry>),
        met: &Met<D::Here>,
        factor: f64,
        sink: &mut dyn Sink,
    ) {
        #[cfg(test)]
        CROSSED.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let h = crew.h[l];
        if crew.lanes[l].trace {
            lane::trace(crew, l, theta, sink);
        }
        let spin = self.spin_at(crew, l, theta);
        let before = crew.time[l];
        crew.time[l] += theta * h;
        crew.next[l] = crew.after(l, factor);
        // led round and round where pieces overlap
        let lane = &mut crew.lanes[l];
        lane.round = if theta < NO_WAY || !gets_on(before, crew.time[l]) { lane.round + 1 } else { 0 };
        let round = lane.round > ROUND;
        let left = crew.here.get(l);
        crew.here.set(l, if round { self.domain.enter_ahead(into, met.position, met.velocity) } else { into });
        self.stray(crew, l, sink);
        let (mut x, mut v, mut spin) = (met.position, met.velocity, spin);
        if let Some(carry) = carry {
            (x, v, spin) = (carry.point(x), carry.vector(v), carry_spin(carry, spin));
            crew.lanes[l].chance.carry(carry);
            crew.bodies.carry(l, carry);
            if crew.lanes[l].trace {
                sink.point(crew.lanes[l].particle.number, crew.time[l], x, v, spin);
            }
        }
        meeting::put(crew, l, x, v, spin);
        if self.domain.is_lost(crew.here.get(l)) || crew.lanes[l].round > LOST {
            return lose(crew, l, self.domain.cell(left), sink);
        }
        let lane = &mut crew.lanes[l];
        lane.fitted = false;
        if crew.time[l] > before {
            (lane.standing, lane.edges) = (0, 0);
        } else {
            lane.edges += 1;
            if lane.edges > MOST_EDGES {
                // held on the edge from both sides: a short step leads off it
                crew.next[l] = (SHORT * crew.next[l]).max(least_step(crew.time[l]));
            }
        }
        crew.quiet[l] = mask(lane.is_quiet() && !self.has_chance());
        if theta > 0.0 && self.has_chance() {
            self.renew_in_flight(crew, l, theta * h);
        }
    }
}

/// Whether the time from one edge to the next is more than rounding, by which alone a sphere that is led round and round may get on where
/// pieces overlap.
#[inline(always)]
fn gets_on(before: f64, time: f64) -> bool {
    time - before > NO_TIME * before.abs()
}
