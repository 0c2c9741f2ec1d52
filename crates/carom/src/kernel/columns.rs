//! Many impacts in columns: one body, compiled for each instruction set.
//!
//! Rows go through in chunks that stay in the first-level cache. Each loss takes its share from the whole chunk in a loop of its own
//! (so that there is one loop a loss, not one a combination of losses), then friction does.

mod row;

use super::impact::NO_SLIP;
use super::short::{Short, ShortLaw};
use super::{Kernel, Tables};
use crate::batch::{Incidence, Rebound};
use crate::curvature::Curvature;
use crate::instructions::{InstructionSet, Work};
use crate::math::{Fma, Plain, sqrt, watched};
use crate::normal::{Account, Ledger, Loops, Losses, Mechanism, NormalLaw, Size};
use crate::tangential::{Coulomb, FrictionLaw, Shaped, Tangential, constant};
use row::{Leaving, Row};

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
struct Curved(Curvature);
impl Sizing for Curved {
    #[inline(always)]
    fn size<F: Fma>(&self, f: F, diameter: f64) -> Size {
        let radius = 0.5 * diameter;
        Size { kappa: self.0.kappa(f, radius), ..Size::flat(radius) }
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
        all_rows(With { f, one_loop: LANES >= MANY_REGISTERS }, self.kernel, self.tables, self.rows, self.out)
    }

    #[inline(always)]
    fn run_portable(self) -> bool {
        all_rows(Emulated, self.kernel, self.tables, self.rows, self.out)
    }
}

/// How a chunk is done: a trait, not a closure, since a closure need not be inlined and would then lose the instruction set.
trait Chunks: Copy {
    fn one(self, kernel: &Kernel, tables: &Tables, rows: &Rows, out: &mut Out, between: &mut Between) -> bool;
}

/// With a given fused multiply-add.
#[derive(Clone, Copy)]
struct With<F> {
    f: F,
    /// Whether a short law goes through in one loop.
    one_loop: bool,
}

/// Lanes of the sets whose registers hold all of a short law's loop; with fewer, two loops without spills are faster than one with.
const MANY_REGISTERS: usize = 16;

impl<F: Fma> Chunks for With<F> {
    #[inline(always)]
    fn one(self, kernel: &Kernel, tables: &Tables, rows: &Rows, out: &mut Out, between: &mut Between) -> bool {
        if self.one_loop && kernel.curvature.is_flat() && out.more.is_none() {
            match kernel.short() {
                Some(ShortLaw::Elastic(law)) => return one_loop(self.f, &law, rows, out),
                Some(ShortLaw::ElasticPlastic(law)) => return one_loop(self.f, &law, rows, out),
                Some(ShortLaw::Given(_)) | None => {}
            }
        }
        chunk(self.f, kernel, tables, rows, out, between)
    }
}

/// Without one: branch-free emulation, and the exact one for the rare chunk where that does not suffice.
#[derive(Clone, Copy)]
struct Emulated;

impl Chunks for Emulated {
    #[inline(always)]
    fn one(self, kernel: &Kernel, tables: &Tables, rows: &Rows, out: &mut Out, between: &mut Between) -> bool {
        let (fine, exact) = watched(
            #[inline(always)]
            |f| chunk(f, kernel, tables, rows, out, between),
        );
        if exact { fine } else { chunk_exactly(kernel, tables, rows, out, between) }
    }
}

#[cold]
#[inline(never)]
fn chunk_exactly(kernel: &Kernel, tables: &Tables, rows: &Rows, out: &mut Out, between: &mut Between) -> bool {
    chunk(Plain, kernel, tables, rows, out, between)
}

#[inline(always)]
fn all_rows<C: Chunks>(chunks: C, kernel: &Kernel, tables: &Tables, rows: &Incidence, out: &mut Rebound) -> bool {
    let mut between = Between { bulk: [0.0; CHUNK], left: [0.0; CHUNK], friction_share: [1.0; CHUNK] };
    let mut scratch = [[0.0; CHUNK]; 5];
    let [e, ratio, last_normal, last_tangential, last_spin] = &mut scratch;
    let wants_more = out.restitution.is_some() || out.impulse_ratio.is_some();
    let last = Filled::end_of(rows);
    let n = rows.normal.len();
    let mut all_fine = true;
    for first in (0..n).step_by(CHUNK) {
        let end = n.min(first + CHUNK);
        let range = first..end;
        let whole = Rows::of(rows, first);
        let columns = if whole.is_some() {
            (
                out.normal[range.clone()].first_chunk_mut(),
                out.tangential[range.clone()].first_chunk_mut(),
                out.spin[range.clone()].first_chunk_mut(),
            )
        } else {
            (Some(&mut *last_normal), Some(&mut *last_tangential), Some(&mut *last_spin))
        };
        let (Some(normal), Some(tangential), Some(spin)) = columns else {
            debug_assert!(false, "columns out are as long as those in");
            return false;
        };
        let more = wants_more.then_some((&mut *e, &mut *ratio));
        let is_last = whole.is_none();
        let rows = whole.unwrap_or_else(|| last.rows());
        all_fine &= chunks.one(kernel, tables, &rows, &mut Out { normal, tangential, spin, more }, &mut between);
        if is_last {
            let len = end - first;
            out.normal[range.clone()].copy_from_slice(&last_normal[..len]);
            out.tangential[range.clone()].copy_from_slice(&last_tangential[..len]);
            out.spin[range.clone()].copy_from_slice(&last_spin[..len]);
        }
        write_more(out, range, e, ratio);
    }
    all_fine
}

impl<'a> Rows<'a> {
    /// The chunk that begins at row `first`, if it is whole.
    #[inline(always)]
    fn of(rows: &Incidence<'a>, first: usize) -> Option<Self> {
        Some(Self {
            normal: rows.normal[first..].first_chunk()?,
            tangential: rows.tangential[first..].first_chunk()?,
            spin: rows.spin[first..].first_chunk()?,
            diameter: rows.diameter[first..].first_chunk()?,
        })
    }
}

/// The rows of the last chunk, with harmless impacts at its end.
struct Filled([Column; 4]);

impl Filled {
    fn end_of(rows: &Incidence) -> Self {
        let first = rows.normal.len() / CHUNK * CHUNK;
        let filled = |column: &[f64], with: f64| {
            let mut chunk = [with; CHUNK];
            let end = &column[first..];
            chunk[..end.len()].copy_from_slice(end);
            chunk
        };
        Self([
            filled(rows.normal, 1.0),
            filled(rows.tangential, 0.0),
            filled(rows.spin, 0.0),
            filled(rows.diameter, 1e-5),
        ])
    }

    fn rows(&self) -> Rows<'_> {
        let [normal, tangential, spin, diameter] = &self.0;
        Rows { normal, tangential, spin, diameter }
    }
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
    if kernel.curvature.is_flat() {
        restitutions(f, kernel, tables, rows, Flat, between);
    } else {
        restitutions(f, kernel, tables, rows, Curved(kernel.curvature), between);
    }
    match out.more {
        None => along_the_wall::<_, false>(f, kernel, tables, rows, out, between),
        Some(_) => along_the_wall::<_, true>(f, kernel, tables, rows, out, between),
    }
}

/// A short law on a flat wall in one loop.
#[inline(always)]
fn one_loop<F: Fma, B: Mechanism>(f: F, law: &Short<B>, rows: &Rows, out: &mut Out) -> bool {
    let (bulk, work, friction) = (law.bulk, *law.work, law.friction);
    let law = Short { bulk, work: &work, friction };
    let mut fine = true;
    for i in 0..CHUNK {
        let row = Row::at(rows, i);
        let e = law.balance(f, row.v_n, &Size::flat(0.5 * row.diameter)).restitution();
        fine &= row.rub::<_, _, false>(f, &law.friction, e, 1.0, out, i);
    }
    fine
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
    // a copy that nothing written can overlap, so that the loops may keep it in registers
    let shape = &{ *tables.shape };
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
            rub::<_, _, MORE>(f, &Shaped { slip, shape }, rows, out, &between.left, resolved)
        }
        (Tangential::MicroSlip(slip), _) => {
            rub::<_, _, MORE>(f, &Shaped { slip, shape }, rows, out, &between.left, one)
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
    for (i, e) in e.iter().enumerate() {
        fine &= Row::at(rows, i).rub::<_, _, MORE>(f, law, *e, friction_share(i), out, i);
    }
    fine
}
