//! A law's answers to rows of arrays.

use crate::columns::{CHUNK, Column, First, Held, empty, over, written};
use crate::met::{self, Met};
use crate::numbers::Input;
use crate::spheres::Spheres;
use carom::batch::{BatchError, Incidence, Rebound};
use carom::impact::components_on;
use carom::instructions::{InstructionSet, Work};
use carom::math::Fma;
use carom::normal::NormalLaw;
use carom::{ImpactError, WallLaw};
use numpy::PyArrayDyn;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// The five columns of an answer, as `met::COLUMNS` names them.
pub type Answer<'py> = [Bound<'py, PyArrayDyn<f64>>; 5];

impl Spheres<Input> {
    /// About what a row costs, ns.
    pub fn cost(&self, law: &WallLaw) -> usize {
        match law.normal() {
            _ if law.scatter().is_some() => 2000,
            NormalLaw::Resolved(_) => 3000,
            _ if self.density.is_some() || self.draws.is_some() => 100,
            _ => 10,
        }
    }

    /// The law's answers, and the first row that is no impact.
    pub fn answer<'py>(
        &self,
        py: Python<'py>,
        law: &WallLaw,
        shape: &[usize],
        threads: usize,
    ) -> PyResult<(Answer<'py>, Option<(usize, ImpactError)>)> {
        let held = self.try_map(|input| Held::of(py, input))?;
        let columns = held.map(|input| input.column(shape));
        let out: Answer =
            [empty(py, shape)?, empty(py, shape)?, empty(py, shape)?, empty(py, shape)?, empty(py, shape)?];
        let first = First::none();
        {
            let [n, t, w, e, r] = &out;
            let mut guards = [written(n)?, written(t)?, written(w)?, written(e)?, written(r)?];
            let [n, t, w, e, r] = &mut guards;
            let slices =
                [n.as_slice_mut()?, t.as_slice_mut()?, w.as_slice_mut()?, e.as_slice_mut()?, r.as_slice_mut()?];
            py.detach(|| {
                let chunks = chunks(slices).enumerate();
                over(threads, chunks, |(number, out)| {
                    if let Err((index, error)) = columns.answer(law, number * CHUNK, out) {
                        first.met(number * CHUNK + index, error);
                    }
                });
            });
        }
        Ok((out, first.row()))
    }

    /// Figures of each row that the answer's columns do not hold, one array of `WIDTH` by the rows. The answer is computed again and
    /// must be what it was: else the arrays were changed meanwhile.
    pub fn figures<'py, const WIDTH: usize>(
        &self,
        py: Python<'py>,
        law: &WallLaw,
        (shape, threads): (&[usize], usize),
        answer: [&Bound<'py, PyArrayDyn<f64>>; 3],
        write: impl Fn(&Met) -> [f64; WIDTH] + Sync,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let held = self.try_map(|input| Held::of(py, input))?;
        let columns = held.map(|input| input.column(shape));
        let whole: Vec<usize> = std::iter::once(WIDTH).chain(shape.iter().copied()).collect();
        let out = empty(py, &whole)?;
        let rows: usize = shape.iter().product();
        let changed = AtomicBool::new(false);
        {
            let input = |a: &Bound<'py, PyArrayDyn<f64>>| Held::of(py, &Input::Many(a.clone().unbind()));
            let before = [input(answer[0])?, input(answer[1])?, input(answer[2])?];
            let before = [before[0].column(shape), before[1].column(shape), before[2].column(shape)];
            let mut guard = written(&out)?;
            let mut rest = guard.as_slice_mut()?;
            let slices: [&mut [f64]; WIDTH] = std::array::from_fn(|_| {
                let (one, others) = std::mem::take(&mut rest).split_at_mut(rows);
                rest = others;
                one
            });
            py.detach(|| {
                over(threads, chunks(slices).enumerate(), |(number, mut out)| {
                    for place in 0..out[0].len() {
                        let row = number * CHUNK + place;
                        let met = law.impact(&columns.map(|column| column.row(row)).impact());
                        let now = met::row(&met);
                        if before.iter().zip(now).any(|(b, n)| !same(b.row(row), n)) {
                            changed.store(true, Ordering::Relaxed);
                        }
                        for (column, value) in out.iter_mut().zip(write(&met)) {
                            column[place] = value;
                        }
                    }
                });
            });
        }
        if changed.into_inner() {
            return Err(PyRuntimeError::new_err(
                "the arrays that went into or came out of impact() were changed since; ask for this before, or work on copies",
            ));
        }
        Ok(out)
    }
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// Columns cut into chunks, side by side.
fn chunks<const N: usize>(columns: [&mut [f64]; N]) -> impl Iterator<Item = [&mut [f64]; N]> {
    let mut columns = columns.map(|c| c.chunks_mut(CHUNK));
    std::iter::from_fn(move || {
        let mut next = Vec::with_capacity(N);
        for column in &mut columns {
            next.push(column.next()?);
        }
        next.try_into().ok()
    })
}

/// Speeds and angles as normal and tangential speeds, on the widest vectors.
struct Components<'a> {
    speed: &'a [f64],
    angle: &'a [f64],
    normal: &'a mut [f64],
    tangential: &'a mut [f64],
}

impl Work for Components<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, f: F) {
        let rows = self.speed.iter().zip(self.angle).zip(self.normal).zip(self.tangential);
        for (((speed, angle), normal), tangential) in rows {
            (*normal, *tangential) = components_on(f, *speed, *angle);
        }
    }
}

impl Spheres<Column<'_>> {
    /// A chunk of answers; the first row that is no impact, counted from the chunk's first.
    fn answer(&self, law: &WallLaw, from: usize, out: [&mut [f64]; 5]) -> Result<(), (usize, ImpactError)> {
        if self.density.is_some() || self.draws.is_some() {
            return self.one_by_one(law, from, out);
        }
        let [normal, tangential, spin, restitution, impulse_ratio] = out;
        let count = normal.len();
        let [mut a, mut b, mut c, mut d] = [const { Vec::new() }; 4];
        let (mut n, mut t) = (Vec::new(), Vec::new());
        let (first, second) = (self.motion[0].rows(from, count, &mut a), self.motion[1].rows(from, count, &mut b));
        let (first, second) = if self.by_angle {
            n.resize(count, 0.0);
            t.resize(count, 0.0);
            let work = Components { speed: first, angle: second, normal: &mut n, tangential: &mut t };
            InstructionSet::best().run(work);
            (&n[..], &t[..])
        } else {
            (first, second)
        };
        let incidence = Incidence {
            normal: first,
            tangential: second,
            spin: self.spin.rows(from, count, &mut c),
            diameter: self.diameter.rows(from, count, &mut d),
        };
        let mut rebound = Rebound::new(normal, tangential, spin);
        rebound.restitution = Some(restitution);
        rebound.impulse_ratio = Some(impulse_ratio);
        let met = law.impact_batch(&incidence, &mut rebound);
        for column in [rebound.normal, rebound.tangential, rebound.spin] {
            column.iter_mut().for_each(|v| *v += 0.0);
        }
        match met {
            Ok(()) | Err(BatchError::Lengths) => Ok(()),
            Err(BatchError::Row { index, error }) => Err((index, error)),
        }
    }

    fn one_by_one(&self, law: &WallLaw, from: usize, mut out: [&mut [f64]; 5]) -> Result<(), (usize, ImpactError)> {
        let mut first = Ok(());
        for place in 0..out[0].len() {
            let met = law.impact(&self.map(|column| column.row(from + place)).impact());
            let row = met::row(&met);
            for (column, value) in out.iter_mut().zip(row) {
                column[place] = value;
            }
            if let Err(error) = met {
                first = first.and(Err((place, error)));
            }
        }
        first
    }
}
