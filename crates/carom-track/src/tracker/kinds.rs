//! A trial step of all lanes, each by the method of its sphere.
//!
//! Spheres whose relaxation time is long against the flow's times take explicit steps, those that follow the fluid steps that do not know
//! it: `gait.rs` chooses.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::Walk;
use super::crew::Crew;
use super::walk::Acting;
use crate::domain::Domain;
use crate::integrate::{Control, Lanes, Step, exponential, step};
use crate::lanes::mask;
use carom::instructions::Work;
use carom::math::{Fma, Plain};

impl<D: Domain> Walk<'_, D> {
    /// Tries the steps of all lanes.
    #[inline(always)]
    pub(super) fn try_steps<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, control: Control) {
        let (mut some, mut all) = (false, true);
        for l in 0..W {
            some |= crew.busy[l] & crew.follows[l];
            all &= !crew.busy[l] | crew.follows[l];
        }
        crew.some_follow = some;
        if !all {
            let (h, wanted) = if some { masked(crew, false) } else { (crew.h, crew.busy) };
            let Crew { here, bodies, time, motion, rates, step: out, .. } = crew;
            let forces = Acting { dynamics: self.dynamics, domain: self.domain, here, wanted: &wanted, bodies };
            step(time, motion, rates, &h, control, &forces, out);
        }
        if some {
            self.set.run(Following { walk: self, crew, control, all });
        }
    }
}

/// The steps of the lanes that follow the fluid: in a frame of their own, so that the others' loop keeps its numbers near.
struct Following<'a, 'b, const W: usize, D: Domain> {
    walk: &'a Walk<'b, D>,
    crew: &'a mut Crew<W, D::Many<W>>,
    control: Control,
    /// Whether no others are at work.
    all: bool,
}

impl<const W: usize, D: Domain> Work for Following<'_, '_, W, D> {
    type Output = ();

    const LAID_OUT_FOR: Option<usize> = Some(W);

    #[inline(always)]
    fn run_portable(self) {
        if const { W == 1 } {
            self.run::<_, 1>(Plain);
        } else {
            debug_assert!(false, "so many lanes are asked for where the set that they fill was found");
        }
    }

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) {
        let Self { walk, crew, control, all } = self;
        let (h, wanted) = if all { (crew.h, crew.busy) } else { masked(crew, true) };
        let Crew { here, bodies, time, motion, rates, step, .. } = crew;
        let forces = Acting { dynamics: walk.dynamics, domain: walk.domain, here, wanted: &wanted, bodies };
        if all {
            exponential::step(time, motion, rates, &h, control, &forces, step);
            return;
        }
        let (mut out, mut theirs) = (Step::ZERO, [0; W]);
        exponential::step(time, motion, rates, &h, control, &forces, &mut out);
        for l in 0..W {
            theirs[l] = mask(wanted[l]);
        }
        step.take(&out, &theirs);
    }
}

/// The steps of the lanes at work of one kind, of the others none, and which lanes these are.
#[inline(always)]
fn masked<const W: usize, P>(crew: &Crew<W, P>, follows: bool) -> (Lanes<W>, [bool; W]) {
    let (mut h, mut those) = ([0.0; W], [false; W]);
    for l in 0..W {
        those[l] = crew.busy[l] & (crew.follows[l] == follows);
        h[l] = if those[l] { crew.h[l] } else { 0.0 };
    }
    (h, those)
}
