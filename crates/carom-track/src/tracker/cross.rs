//! Edges of pieces that spheres come to, gone over side by side.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::Walk;
use super::crew::Crew;
use super::walk::NO_WAY;
use crate::domain::{Domain, Edges};
use crate::integrate::Lanes;
use crate::lanes::{Mask, bits, choose, mask, take_lowest};

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
            goes[l] &= mask(edges.theta[l] >= NO_WAY) & mask(time[l] > crew.time[l]);
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
        super::walk::CROSSED.fetch_add(u64::from(gone.count_ones()), std::sync::atomic::Ordering::Relaxed);
        while let Some(l) = take_lowest(&mut gone) {
            crew.stale[l] = true;
            let lane = &mut crew.lanes[l];
            (lane.round, lane.edges) = (0, 0);
        }
        goes
    }
}
