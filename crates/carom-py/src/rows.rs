//! What is asked of a law: one impact, or a row for each element of arrays.

use crate::columns::{CHUNK, Column, Held, empty, over, written};
use crate::numbers::Input;
use carom::batch::{BatchError, Incidence, Rebound};
use carom::impact::{components, components_on};
use carom::instructions::{InstructionSet, Work};
use carom::math::Fma;
use carom::normal::NormalLaw;
use carom::{Fate, Impact, ImpactError, Outcome, WallLaw};
use numpy::PyArrayDyn;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::{Mutex, PoisonError};

/// How the spheres come.
#[derive(Debug)]
pub struct Rows {
    pub diameter: Input,
    /// Speed and angle, or normal and tangential speed.
    pub motion: [Input; 2],
    pub by_angle: bool,
    pub spin: Input,
    pub density: Option<Input>,
    /// Four columns.
    pub draws: Option<[Input; 4]>,
}

/// The five columns of an answer: normal and tangential speed, spin, restitution, impulse ratio.
pub type Answer<'py> = [Bound<'py, PyArrayDyn<f64>>; 5];

/// One row in plain numbers.
#[derive(Clone, Copy, Debug)]
pub struct One {
    pub diameter: f64,
    pub motion: [f64; 2],
    pub by_angle: bool,
    pub spin: f64,
    pub density: Option<f64>,
    pub draws: [f64; 4],
}

impl One {
    /// On a wall at y = 0, with the sphere above it moving along +x.
    #[inline]
    pub fn impact(&self) -> Impact {
        let [a, b] = self.motion;
        let (normal, tangential) = if self.by_angle { components(a, b) } else { (a, b) };
        Impact {
            density: self.density,
            spin: [0.0, 0.0, -self.spin],
            draws: self.draws,
            ..Impact::new(self.diameter, [tangential, -normal, 0.0], [0.0, 1.0, 0.0])
        }
    }

    /// Speed and angle in degrees.
    pub fn speed_and_angle(&self) -> (f64, f64) {
        let [a, b] = self.motion;
        match (self.by_angle, b == 0.0) {
            (true, _) => (a, b),
            (false, true) => (a, 90.0),
            (false, false) => (a.hypot(b), a.atan2(b).to_degrees()),
        }
    }
}

/// An outcome as a batch writes it: normal and tangential speed, spin, restitution, impulse ratio. Zeros have no sign, which says nothing
/// here and need not be the same in both.
#[inline]
pub fn as_row(out: &Outcome) -> [f64; 5] {
    match out.fate {
        Fate::Capture => [0.0, 0.0, 0.0, 0.0, f64::NAN],
        Fate::Rebound => {
            [out.velocity[1] + 0.0, out.velocity[0] + 0.0, 0.0 - out.spin[2], out.restitution, out.impulse_ratio]
        }
    }
}

impl Rows {
    /// All inputs with their names.
    pub fn inputs(&self) -> Vec<(&'static str, &Input)> {
        let names = if self.by_angle { ["speed", "angle"] } else { ["normal", "tangential"] };
        let mut all = vec![("diameter", &self.diameter)];
        all.extend(names.into_iter().zip(&self.motion));
        all.push(("spin", &self.spin));
        all.extend(self.density.as_ref().map(|d| ("density", d)));
        all.extend(self.draws.iter().flatten().map(|d| ("draws", d)));
        all
    }

    /// The row, if all are single numbers.
    #[inline]
    pub fn one(&self) -> Option<One> {
        let density = match &self.density {
            None => None,
            Some(density) => Some(density.one()?),
        };
        let draws = match &self.draws {
            None => [0.5; 4],
            Some([a, b, c, d]) => [a.one()?, b.one()?, c.one()?, d.one()?],
        };
        let motion = [self.motion[0].one()?, self.motion[1].one()?];
        let (diameter, spin) = (self.diameter.one()?, self.spin.one()?);
        Some(One { diameter, motion, by_angle: self.by_angle, spin, density, draws })
    }

    /// About what a row costs, ns.
    pub fn cost(&self, law: &WallLaw) -> usize {
        match law.normal() {
            _ if law.scatter().is_some() => 2000,
            NormalLaw::Resolved(_) => 3000,
            _ if self.density.is_some() || self.draws.is_some() => 100,
            _ => 10,
        }
    }

    fn held<'py>(&self, py: Python<'py>) -> PyResult<HeldRows<'py>> {
        let of = |input: &Input| Held::of(py, input);
        Ok(HeldRows {
            diameter: of(&self.diameter)?,
            motion: [of(&self.motion[0])?, of(&self.motion[1])?],
            by_angle: self.by_angle,
            spin: of(&self.spin)?,
            density: self.density.as_ref().map(of).transpose()?,
            draws: match &self.draws {
                None => None,
                Some([a, b, c, d]) => Some([of(a)?, of(b)?, of(c)?, of(d)?]),
            },
        })
    }

    /// The law's answers, and the first row that is no impact.
    pub fn answer<'py>(
        &self,
        py: Python<'py>,
        law: &WallLaw,
        shape: &[usize],
        threads: usize,
    ) -> PyResult<(Answer<'py>, Option<(usize, ImpactError)>)> {
        let held = self.held(py)?;
        let columns = held.columns(shape);
        let out: Answer =
            [empty(py, shape)?, empty(py, shape)?, empty(py, shape)?, empty(py, shape)?, empty(py, shape)?];
        let first: Mutex<Option<(usize, ImpactError)>> = Mutex::new(None);
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
                        let mut first = first.lock().unwrap_or_else(PoisonError::into_inner);
                        let index = number * CHUNK + index;
                        if first.is_none_or(|(other, _)| index < other) {
                            *first = Some((index, error));
                        }
                    }
                });
            });
        }
        Ok((out, first.into_inner().unwrap_or_else(PoisonError::into_inner)))
    }

    /// Figures of each row that the answer's columns do not hold, one array of `WIDTH` by the rows. The answer is computed again and
    /// must be what it was: else the arrays were changed meanwhile.
    pub fn figures<'py, const WIDTH: usize>(
        &self,
        py: Python<'py>,
        law: &WallLaw,
        (shape, threads): (&[usize], usize),
        answer: [&Bound<'py, PyArrayDyn<f64>>; 3],
        write: impl Fn(&Result<Outcome, ImpactError>) -> [f64; WIDTH] + Sync,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let held = self.held(py)?;
        let columns = held.columns(shape);
        let whole: Vec<usize> = std::iter::once(WIDTH).chain(shape.iter().copied()).collect();
        let out = empty(py, &whole)?;
        let rows: usize = shape.iter().product();
        let changed = Mutex::new(false);
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
                        let met = law.impact(&columns.one(row).impact());
                        let now = met.as_ref().map_or([f64::NAN; 5], as_row);
                        if before.iter().zip(now).any(|(b, n)| !same(b.row(row), n)) {
                            *changed.lock().unwrap_or_else(PoisonError::into_inner) = true;
                        }
                        for (column, value) in out.iter_mut().zip(write(&met)) {
                            column[place] = value;
                        }
                    }
                });
            });
        }
        if changed.into_inner().unwrap_or_else(PoisonError::into_inner) {
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

struct HeldRows<'py> {
    diameter: Held<'py>,
    motion: [Held<'py>; 2],
    by_angle: bool,
    spin: Held<'py>,
    density: Option<Held<'py>>,
    draws: Option<[Held<'py>; 4]>,
}

impl HeldRows<'_> {
    fn columns(&self, shape: &[usize]) -> Columns<'_> {
        Columns {
            diameter: self.diameter.column(shape),
            motion: [self.motion[0].column(shape), self.motion[1].column(shape)],
            by_angle: self.by_angle,
            spin: self.spin.column(shape),
            density: self.density.as_ref().map(|d| d.column(shape)),
            draws: self.draws.as_ref().map(|d| [0, 1, 2, 3].map(|i| d[i].column(shape))),
        }
    }
}

struct Columns<'a> {
    diameter: Column<'a>,
    motion: [Column<'a>; 2],
    by_angle: bool,
    spin: Column<'a>,
    density: Option<Column<'a>>,
    draws: Option<[Column<'a>; 4]>,
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

impl Columns<'_> {
    fn one(&self, row: usize) -> One {
        One {
            diameter: self.diameter.row(row),
            motion: [self.motion[0].row(row), self.motion[1].row(row)],
            by_angle: self.by_angle,
            spin: self.spin.row(row),
            density: self.density.as_ref().map(|d| d.row(row)),
            draws: self.draws.as_ref().map_or([0.5; 4], |d| [0, 1, 2, 3].map(|i| d[i].row(row))),
        }
    }

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
            let met = law.impact(&self.one(from + place).impact());
            let row = met.as_ref().map_or([f64::NAN; 5], as_row);
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
