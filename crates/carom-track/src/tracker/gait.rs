//! By which kind of step a sphere flies: explicit, or one that does not know its relaxation time; that which gets on more for its cost.
//!
//! An explicit step is held below a few relaxation times wherever drag brings a sphere back to the fluid's velocity; one that follows the
//! fluid costs about twice as much and is held by the flow alone. Which is the better depends on the flow, and changes on the way from
//! a nozzle into a room. Each sphere tries the other kind for a while where its steps say that this may pay, and keeps what got on further
//! ([`Dynamics::follows`](crate::dynamics::Dynamics::follows) says how it begins). Its path is the same by either kind, to the tolerance.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes")]

use super::Walk;
use super::crew::Crew;
use crate::domain::Domain;
use crate::lanes::{bits, mask, take_lowest};

/// Steps after which the kind is looked at again.
const WHILE: u64 = 64;
/// Explicit steps of more relaxation times than this are likely held by the drag, and with less the drag holds nothing: where the fluid's
/// velocity goes on without a jump, as they may reach three, and where it does not, as in a walk. A trial costs more in the first case, where
/// all lanes take both kinds of steps side by side.
const HELD: [f64; 2] = [1.0, 0.05];
/// What a step that follows the fluid must get on for, in explicit ones.
const COST: f64 = 2.5;
/// The most looks between two trials.
const PATIENCE: u32 = 64;

/// How a sphere got on by each kind.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gait {
    /// Time at the last look, s.
    since: f64,
    /// What an explicit step got on by when last tried, s.
    explicit: f64,
    /// Looks until the other kind is tried again.
    wait: u32,
    /// And how many that will be next time.
    patience: u32,
}

impl Gait {
    /// Nothing known yet, at a time, s.
    pub const fn new(time: f64) -> Self {
        Self { since: time, explicit: 0.0, wait: 0, patience: 1 }
    }

    /// Whether to follow the fluid from here on, from the time now (s), whether the sphere does, its rate of drag (1/s), and what steps are
    /// held by the drag.
    fn follows(&mut self, time: f64, follows: bool, drag_rate: f64, from: f64) -> bool {
        let advance = (time - self.since) / WHILE as f64;
        self.since = time;
        let held = advance * drag_rate > from;
        if !follows {
            self.explicit = advance;
            let tries = held && self.wait == 0;
            self.wait = self.wait.saturating_sub(1);
            return tries;
        }
        if held && advance > COST * self.explicit {
            self.patience = 1;
            return true;
        }
        (self.wait, self.patience) = (self.patience, (2 * self.patience).min(PATIENCE));
        false
    }
}

impl<D: Domain> Walk<'_, D> {
    /// Looks at the kinds of steps again, of the lanes of which it is time.
    #[inline(always)]
    pub(super) fn choose_gaits<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>) {
        let mut due = [0; W];
        for l in 0..W {
            due[l] = mask(crew.busy[l]) & mask(crew.steps[l] % WHILE == 0) & mask(crew.steps[l] > 0);
        }
        let mut due = bits(&due);
        while let Some(l) = take_lowest(&mut due) {
            self.choose_gait(crew, l);
        }
    }

    #[inline(never)]
    fn choose_gait<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize) {
        let (rate, time) = (crew.bodies.drag_rate[l], crew.time[l]);
        let held = HELD[usize::from(self.has_chance())];
        let follows = crew.lanes[l].gait.follows(time, crew.follows[l], rate, held);
        if crew.follows[l] && !follows {
            // what the drag allows
            crew.next[l] = crew.next[l].min(1.0 / rate);
        }
        crew.follows[l] = follows;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks until `looks`, with what each kind gets on by in a step, in relaxation times; how many by which kind.
    fn looks(gait: &mut Gait, follows: &mut bool, looks: u32, explicit: f64, following: f64) -> [u32; 2] {
        let mut count = [0, 0];
        for _ in 0..looks {
            let advance = if *follows { following } else { explicit };
            count[usize::from(*follows)] += 1;
            *follows = gait.follows(gait.since + WHILE as f64 * advance, *follows, 1.0, 1.0);
        }
        count
    }

    #[test]
    fn what_gets_on_more_is_kept() {
        // the drag holds explicit steps in an even flow
        let (mut gait, mut follows) = (Gait::new(0.0), false);
        assert_eq!(looks(&mut gait, &mut follows, 100, 2.0, 50.0), [1, 99]);
        // into a fast one, whose edges hold both
        assert!(looks(&mut gait, &mut follows, 100, 0.01, 0.01)[1] <= 1);
        // nothing is gained where both are held alike: few trials
        let (mut gait, mut follows) = (Gait::new(0.0), false);
        assert!(looks(&mut gait, &mut follows, 1000, 2.0, 3.0)[1] < 25);
        // what begins by following goes on so while that pays, and comes back to it
        let (mut gait, mut follows) = (Gait::new(0.0), true);
        assert_eq!(looks(&mut gait, &mut follows, 50, 2.0, 50.0), [0, 50]);
        assert!(looks(&mut gait, &mut follows, 50, 0.1, 0.1)[1] == 1);
        assert!(looks(&mut gait, &mut follows, 50, 2.0, 50.0)[1] > 45);
    }
}
