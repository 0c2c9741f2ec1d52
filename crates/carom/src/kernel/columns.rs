//! Many impacts in columns: one body, compiled for each instruction set.
//!
//! Rows go through in chunks that stay in the first-level cache. Each loss takes its share from the whole chunk in a loop of its own
//! (so that there is one loop a loss, not one a combination of losses), then friction does.

use super::impact::{NO_SLIP, Rubbed};
use super::{Kernel, Tables, judge};
use crate::batch::{Incidence, Rebound};
use crate::instructions::{InstructionSet, Work};
use crate::math::{Fma, Plain, sqrt, watched};
use crate::normal::{Account, Ledger, Loops, Losses, Mechanism, NormalLaw, NormalResponse, Size};
use crate::tangential::{Coulomb, FrictionLaw, Shaped, Tangential, constant};

/// Rows handled at once.
const CHUNK: usize = 128;

type Column = [f64; CHUNK];

/// One chunk of the columns in.
struct Rows<'a> {
    normal: &'a Column,
    tangential: &'a Column,
    spin: &'a Column,
    diameter: &'a Column,
}

/// One chunk of the columns out.
struct Out<'a> {
    normal: &'a mut Column,
    tangential: &'a mut Column,
    spin: &'a mut Column,
    /// Restitution and impulse ratio, where either is asked for.
    more: Option<(&'a mut Column, &'a mut Column)>,
}

/// What stands between the losses and friction.
struct Between {
    bulk: Column,
    /// 1 − Σ ε, then e.
    left: Column,
    friction_share: Column,
}

/// The size of a row: flat walls skip what would only multiply by one.
trait Sizing: Copy {
    fn size<F: Fma>(&self, f: F, diameter: f64) -> Size;
}
#[derive(Clone, Copy)]
struct Flat;
impl Sizing for Flat {
    #[inline(always)]
    fn size<F: Fma>(&self, _: F, diameter: f64) -> Size {
        Size::flat(0.5 * diameter)
    }
}
#[derive(Clone, Copy)]
struct Curved(f64);
impl Sizing for Curved {
    #[inline(always)]
    fn size<F: Fma>(&self, f: F, diameter: f64) -> Size {
        let radius = 0.5 * diameter;
        Size { kappa: 1.0 / f.fma(self.0, radius, 1.0), ..Size::flat(radius) }
    }
}

/// All rows, whose columns have one length; whether every one of them was an impact.
pub(crate) fn run(set: InstructionSet, kernel: &Kernel, tables: &Tables, rows: &Incidence, out: &mut Rebound) -> bool {
    set.run(AllRows { kernel, tables, rows, out })
}

struct AllRows<'a, 'b> {
    kernel: &'a Kernel,
    tables: &'a Tables<'a>,
    rows: &'a Incidence<'a>,
    out: &'a mut Rebound<'b>,
}

impl Work for AllRows<'_, '_> {
    type Output = bool;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, f: F) -> bool {
        all_rows(self.kernel, self.tables, self.rows, self.out, |kernel, tables, rows, out, between| {
            chunk(f, kernel, tables, rows, out, between)
        })
    }

    /// Without fused multiply-add: branch-free emulation, and the exact one for the rare chunk where that does not suffice.
    #[inline(always)]
    fn run_portable(self) -> bool {
        all_rows(self.kernel, self.tables, self.rows, self.out, |kernel, tables, rows, out, between| {
            let (fine, exact) = watched(|f| chunk(f, kernel, tables, rows, out, between));
            if exact { fine } else { chunk_exactly(kernel, tables, rows, out, between) }
        })
    }
}

#[cold]
#[inline(never)]
fn chunk_exactly(kernel: &Kernel, tables: &Tables, rows: &Rows, out: &mut Out, between: &mut Between) -> bool {
    chunk(Plain, kernel, tables, rows, out, between)
}

#[inline(always)]
fn all_rows(
    kernel: &Kernel,
    tables: &Tables,
    rows: &Incidence,
    out: &mut Rebound,
    one_chunk: impl Fn(&Kernel, &Tables, &Rows, &mut Out, &mut Between) -> bool,
) -> bool {
    let mut between = Between { bulk: [0.0; CHUNK], left: [0.0; CHUNK], friction_share: [1.0; CHUNK] };
    let (mut scratch_e, mut scratch_ratio) = ([0.0; CHUNK], [0.0; CHUNK]);
    let wants_more = out.restitution.is_some() || out.impulse_ratio.is_some();
    let mut all_fine = true;
    let (normal, normal_end) = rows.normal.as_chunks::<CHUNK>();
    let (tangential, tangential_end) = rows.tangential.as_chunks::<CHUNK>();
    let (spin, spin_end) = rows.spin.as_chunks::<CHUNK>();
    let (diameter, diameter_end) = rows.diameter.as_chunks::<CHUNK>();
    let whole = normal.len();
    for (k, (((normal, tangential), spin), diameter)) in
        normal.iter().zip(tangential).zip(spin).zip(diameter).enumerate()
    {
        let range = k * CHUNK..(k + 1) * CHUNK;
        let rows = Rows { normal, tangential, spin, diameter };
        let (Ok(normal), Ok(tangential), Ok(spin)) = (
            (&mut out.normal[range.clone()]).try_into(),
            (&mut out.tangential[range.clone()]).try_into(),
            (&mut out.spin[range.clone()]).try_into(),
        ) else {
            debug_assert!(false, "a range of a chunk's length");
            continue;
        };
        let more = wants_more.then_some((&mut scratch_e, &mut scratch_ratio));
        all_fine &= one_chunk(kernel, tables, &rows, &mut Out { normal, tangential, spin, more }, &mut between);
        write_more(out, range, &scratch_e, &scratch_ratio);
    }
    if normal_end.is_empty() {
        return all_fine;
    }
    // rows that are harmless impacts fill the end of the last chunk
    let filled = |end: &[f64], with: f64| {
        let mut column = [with; CHUNK];
        column[..end.len()].copy_from_slice(end);
        column
    };
    let last = Rows {
        normal: &filled(normal_end, 1.0),
        tangential: &filled(tangential_end, 0.0),
        spin: &filled(spin_end, 0.0),
        diameter: &filled(diameter_end, 1e-5),
    };
    let (mut n, mut t, mut w) = ([0.0; CHUNK], [0.0; CHUNK], [0.0; CHUNK]);
    let more = wants_more.then_some((&mut scratch_e, &mut scratch_ratio));
    let mut last_out = Out { normal: &mut n, tangential: &mut t, spin: &mut w, more };
    all_fine &= one_chunk(kernel, tables, &last, &mut last_out, &mut between);
    let range = whole * CHUNK..rows.normal.len();
    out.normal[range.clone()].copy_from_slice(&n[..normal_end.len()]);
    out.tangential[range.clone()].copy_from_slice(&t[..normal_end.len()]);
    out.spin[range.clone()].copy_from_slice(&w[..normal_end.len()]);
    write_more(out, range, &scratch_e, &scratch_ratio);
    all_fine
}

#[inline(always)]
fn write_more(out: &mut Rebound, range: core::ops::Range<usize>, e: &Column, ratio: &Column) {
    let n = range.len();
    if let Some(column) = out.restitution.as_deref_mut() {
        column[range.clone()].copy_from_slice(&e[..n]);
    }
    if let Some(column) = out.impulse_ratio.as_deref_mut() {
        column[range].copy_from_slice(&ratio[..n]);
    }
}

#[inline(always)]
fn chunk<F: Fma>(f: F, kernel: &Kernel, tables: &Tables, rows: &Rows, out: &mut Out, between: &mut Between) -> bool {
    if kernel.surface_curvature == 0.0 {
        restitutions(f, kernel, tables, rows, Flat, between);
    } else {
        restitutions(f, kernel, tables, rows, Curved(kernel.surface_curvature), between);
    }
    match out.more {
        None => along_the_wall::<_, false>(f, kernel, tables, rows, out, between),
        Some(_) => along_the_wall::<_, true>(f, kernel, tables, rows, out, between),
    }
}

/// e of every row into `between.left`.
#[inline(always)]
fn restitutions<F: Fma, S: Sizing>(
    f: F,
    kernel: &Kernel,
    tables: &Tables,
    rows: &Rows,
    sizing: S,
    between: &mut Between,
) {
    match &kernel.normal {
        NormalLaw::Ledger(ledger) => take_losses(f, ledger, rows, sizing, between),
        NormalLaw::Table(curve) => {
            for i in 0..CHUNK {
                let v_t = sqrt(rows.tangential[i] * rows.tangential[i]);
                between.left[i] = curve.at(f, tables.pieces, rows.normal[i], v_t, 0.0, 1.0);
            }
        }
        NormalLaw::Resolved(resolved) => {
            for i in 0..CHUNK {
                let response = resolved.respond(rows.normal[i], &sizing.size(f, rows.diameter[i]));
                (between.left[i], between.friction_share[i]) = (response.e, response.friction_share);
            }
        }
    }
}

/// The loop of one loss over a chunk.
struct Take<'a, F, S> {
    rows: &'a Rows<'a>,
    sizing: S,
    between: &'a mut Between,
    f: F,
}

impl<F: Fma, S: Sizing> Loops for Take<'_, F, S> {
    #[inline(always)]
    fn of<M: Mechanism>(&mut self, mechanism: &M) {
        let (v, d, sizing, f) = (self.rows.normal, self.rows.diameter, self.sizing, self.f);
        let Between { bulk, left, .. } = &mut *self.between;
        let mechanism = *mechanism;
        for i in 0..CHUNK {
            let mut account = Account { bulk: bulk[i], left: left[i], losses: Losses::default() };
            mechanism.take(f, v[i], &sizing.size(f, d[i]), &mut account);
            (bulk[i], left[i]) = (account.bulk, account.left);
        }
    }
}

#[inline(always)]
fn take_losses<F: Fma, S: Sizing>(f: F, ledger: &Ledger, rows: &Rows, sizing: S, between: &mut Between) {
    let (bulk, surface) = ledger.stages();
    between.bulk = [0.0; CHUNK];
    for term in bulk.iter().flatten() {
        term.with(&mut Take { rows, sizing, between, f });
    }
    for i in 0..CHUNK {
        between.left[i] = 1.0 - between.bulk[i];
    }
    for term in surface.iter().flatten() {
        term.with(&mut Take { rows, sizing, between, f });
    }
    for e in &mut between.left {
        *e = if *e > 0.0 { sqrt(*e) } else { 0.0 };
    }
}

/// Friction, and the rebound of every row; whether all of them are impacts.
#[inline(always)]
fn along_the_wall<F: Fma, const MORE: bool>(
    f: F,
    kernel: &Kernel,
    tables: &Tables,
    rows: &Rows,
    out: &mut Out,
    between: &Between,
) -> bool {
    let one = |_: usize| 1.0;
    let resolved = |i: usize| between.friction_share[i];
    match (kernel.tangential, &kernel.normal) {
        (Tangential::Friction { friction, beta }, NormalLaw::Resolved(_)) => {
            rub::<_, _, MORE>(f, &Coulomb { friction, beta }, rows, out, &between.left, resolved)
        }
        (Tangential::Friction { friction, beta }, _) => {
            rub::<_, _, MORE>(f, &Coulomb { friction, beta }, rows, out, &between.left, one)
        }
        (Tangential::MicroSlip(slip), NormalLaw::Resolved(_)) => {
            rub::<_, _, MORE>(f, &Shaped { slip, shape: tables.shape }, rows, out, &between.left, resolved)
        }
        (Tangential::MicroSlip(slip), _) => {
            rub::<_, _, MORE>(f, &Shaped { slip, shape: tables.shape }, rows, out, &between.left, one)
        }
        (Tangential::Restitution(curve), _) => {
            let mut fine = true;
            for i in 0..CHUNK {
                let (row, e) = (Row::at(rows, i), between.left[i]);
                let v_t = row.v_t.abs();
                let e_t = curve.at(f, tables.pieces, row.v_n, v_t, -1.0, 1.0);
                let ratio = (v_t - e_t * v_t).abs() / ((1.0 + e) * row.v_n);
                let rebound = Leaving { e, v_t: constant::rebound(e_t, row.v_t), spin: row.spin, ratio };
                fine &= row.write::<_, MORE>(f, true, &rebound, out, i);
            }
            fine
        }
        (Tangential::NotGiven, _) => {
            let mut fine = true;
            for i in 0..CHUNK {
                let (row, e) = (Row::at(rows, i), between.left[i]);
                let slip = f.fma(-(0.5 * row.diameter), row.spin, row.v_t);
                let answered = e <= 0.0 || slip.abs() <= NO_SLIP * row.v_n;
                let rebound = Leaving { e, v_t: row.v_t, spin: row.spin, ratio: 0.0 };
                fine &= row.write::<_, MORE>(f, answered, &rebound, out, i);
            }
            fine
        }
    }
}

#[inline(always)]
fn rub<F: Fma, L: FrictionLaw, const MORE: bool>(
    f: F,
    law: &L,
    rows: &Rows,
    out: &mut Out,
    e: &Column,
    friction_share: impl Fn(usize) -> f64,
) -> bool {
    let mut fine = true;
    for i in 0..CHUNK {
        let (row, e) = (Row::at(rows, i), e[i]);
        let radius = 0.5 * row.diameter;
        let normal_impulse = (1.0 + e) * row.v_n;
        let slip = f.fma(-radius, row.spin, row.v_t);
        let response = NormalResponse { e, losses: Losses::default(), friction_share: friction_share(i) };
        let rubbed = Rubbed::new(f, law, slip.abs(), normal_impulse, &response);
        let direction = if slip < 0.0 { -1.0 } else { 1.0 };
        let rebound = Leaving {
            e,
            v_t: row.v_t - direction * rubbed.impulse,
            spin: rubbed.spin(radius) * direction + row.spin,
            ratio: rubbed.impulse / normal_impulse,
        };
        fine &= row.write::<_, MORE>(f, true, &rebound, out, i);
    }
    fine
}

#[derive(Clone, Copy)]
struct Row {
    v_n: f64,
    v_t: f64,
    spin: f64,
    diameter: f64,
}

/// How a row leaves, if it does.
struct Leaving {
    e: f64,
    v_t: f64,
    spin: f64,
    ratio: f64,
}

impl Row {
    #[inline(always)]
    fn at(rows: &Rows, i: usize) -> Self {
        Self { v_n: rows.normal[i], v_t: rows.tangential[i], spin: rows.spin[i], diameter: rows.diameter[i] }
    }

    /// Writes the row: the rebound, zeros for a capture, NaN for a row that is no impact or was not answered.
    #[inline(always)]
    fn write<F: Fma, const MORE: bool>(
        &self,
        f: F,
        answered: bool,
        leaving: &Leaving,
        out: &mut Out,
        i: usize,
    ) -> bool {
        let fine = judge::row_is_fine(f, self.v_n, self.v_t, self.spin, self.diameter) & answered;
        let rebounds = leaving.e > 0.0;
        let pick = |value: f64, captured: f64| {
            let settled = if rebounds { value } else { captured };
            if fine { settled } else { f64::NAN }
        };
        out.normal[i] = pick(leaving.e * self.v_n, 0.0);
        out.tangential[i] = pick(leaving.v_t, 0.0);
        out.spin[i] = pick(leaving.spin, 0.0);
        if MORE && let Some((e, ratio)) = &mut out.more {
            e[i] = pick(leaving.e, 0.0);
            ratio[i] = pick(leaving.ratio, f64::NAN);
        }
        fine
    }
}
