//! A trial step of all lanes, each by the method of its sphere.
//!
//! Spheres whose relaxation time is long take explicit steps, those that follow the fluid steps that do not know it
//! ([`Dynamics::follows`](crate::dynamics::Dynamics::follows)): for life, so that a run of one kind runs one kind of step.

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
            let h = if some { masked(&crew.h, &crew.follows, false) } else { crew.h };
            let forces =
                Acting { dynamics: self.dynamics, domain: self.domain, here: &crew.here, bodies: &crew.bodies };
            step(&crew.time, &crew.motion, &crew.rates, &h, control, &forces, &mut crew.step);
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
        let forces = Acting { dynamics: walk.dynamics, domain: walk.domain, here: &crew.here, bodies: &crew.bodies };
        if all {
            exponential::step(&crew.time, &crew.motion, &crew.rates, &crew.h, control, &forces, &mut crew.step);
            return;
        }
        let h = masked(&crew.h, &crew.follows, true);
        let (mut out, mut theirs) = (Step::ZERO, [0; W]);
        exponential::step(&crew.time, &crew.motion, &crew.rates, &h, control, &forces, &mut out);
        for l in 0..W {
            theirs[l] = mask(crew.follows[l]);
        }
        crew.step.take(&out, &theirs);
    }
}

/// The steps of lanes of one kind; of the others none.
#[inline(always)]
fn masked<const W: usize>(h: &Lanes<W>, follows: &[bool; W], wanted: bool) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = if follows[l] == wanted { h[l] } else { 0.0 };
    }
    out
}
