//! The loops of a batch: one body, compiled for each instruction set and each combination of losses.

use super::{Incidence, Rebound};
use crate::instructions::{InstructionSet, Work};
use crate::math::Fma;
use crate::normal::ledger::{self, Adhesion, AdhesiveLoss, Elastic, Ledger, NoAdhesion, Plastic, PlasticLoss};
use crate::normal::{Size, damping::Damping};
use crate::tangential::{Coulomb, FrictionLaw, Tangential, constant};
use crate::wall::{NormalLaw, NormalResponse, WallLaw, column_ok};

/// Rows handled at once: the columns of a chunk stay in the first-level cache.
const CHUNK: usize = 64;

type Column = [f64; CHUNK];

#[derive(Clone)]
struct Chunk {
    normal: Column,
    tangential: Column,
    spin: Column,
    diameter: Column,
    out: Out,
    all_fine: bool,
}

#[derive(Clone)]
struct Out {
    normal: Column,
    tangential: Column,
    spin: Column,
    restitution: Column,
    ratio: Column,
}

/// A normal law as a type, so that a loop holds no branch on its kind.
trait Normal {
    fn respond(&self, v_n: f64, tangent2: f64, size: &Size) -> NormalResponse;
}

struct Of<'a, A, P> {
    adhesive: A,
    plastic: &'a P,
    damping: Damping,
}
impl<A: AdhesiveLoss, P: PlasticLoss> Normal for Of<'_, A, P> {
    #[inline(always)]
    fn respond(&self, v_n: f64, _: f64, size: &Size) -> NormalResponse {
        NormalResponse::of_balance(&ledger::balance(&self.adhesive, self.plastic, &self.damping, v_n, size))
    }
}
impl Normal for NormalLaw {
    #[inline(always)]
    fn respond(&self, v_n: f64, tangent2: f64, size: &Size) -> NormalResponse {
        NormalLaw::respond(self, v_n, tangent2, size)
    }
}

/// The size of a row: flat walls skip what would only multiply by one.
trait Sizing {
    fn size(&self, diameter: f64) -> Size;
}
struct Flat;
impl Sizing for Flat {
    #[inline(always)]
    fn size(&self, diameter: f64) -> Size {
        Size::flat(0.5 * diameter)
    }
}
struct Curved(f64);
impl Sizing for Curved {
    #[inline(always)]
    fn size(&self, diameter: f64) -> Size {
        let radius = 0.5 * diameter;
        Size { kappa: 1.0 / self.0.mul_add(radius, 1.0), ..Size::flat(radius) }
    }
}

/// All rows; whether every one of them was an impact.
pub(super) fn run(set: InstructionSet, law: &WallLaw, rows: &Incidence, out: &mut Rebound) -> bool {
    match &law.normal {
        NormalLaw::Ledger(ledger) => run_ledger(set, law, ledger, rows, out),
        other => run_sized(set, law, other, rows, out),
    }
}

fn run_ledger(set: InstructionSet, law: &WallLaw, ledger: &Ledger, rows: &Incidence, out: &mut Rebound) -> bool {
    match &ledger.plastic {
        Plastic::None => run_plastic(set, law, ledger, &Elastic, rows, out),
        Plastic::Kadomtsev(p) => run_plastic(set, law, ledger, p, rows, out),
        Plastic::ThorntonNing(p) => run_plastic(set, law, ledger, p, rows, out),
        Plastic::Bons(p) => run_plastic(set, law, ledger, p, rows, out),
        Plastic::Tabor(_) => run_sized(set, law, &law.normal, rows, out),
    }
}

fn run_plastic<P: PlasticLoss>(
    set: InstructionSet,
    law: &WallLaw,
    ledger: &Ledger,
    plastic: &P,
    rows: &Incidence,
    out: &mut Rebound,
) -> bool {
    let damping = ledger.damping;
    match &ledger.adhesion {
        Adhesion::Jkr(_) => run_sized(set, law, &law.normal, rows, out),
        _ if ledger.uses_work() => {
            run_sized(set, law, &Of { adhesive: ledger.work_loss(), plastic, damping }, rows, out)
        }
        _ => run_sized(set, law, &Of { adhesive: NoAdhesion, plastic, damping }, rows, out),
    }
}

fn run_sized<N: Normal>(set: InstructionSet, law: &WallLaw, normal: &N, rows: &Incidence, out: &mut Rebound) -> bool {
    if law.surface_curvature == 0.0 {
        run_chunks(set, law, normal, &Flat, rows, out)
    } else {
        run_chunks(set, law, normal, &Curved(law.surface_curvature), rows, out)
    }
}

fn run_chunks<N: Normal, S: Sizing>(
    set: InstructionSet,
    law: &WallLaw,
    normal: &N,
    sizing: &S,
    rows: &Incidence,
    out: &mut Rebound,
) -> bool {
    // a row that is a harmless impact fills the end of the last chunk
    let zero = [0.0; CHUNK];
    let empty = Out { normal: zero, tangential: zero, spin: zero, restitution: zero, ratio: zero };
    let mut chunk = Chunk {
        normal: [1.0; CHUNK],
        tangential: zero,
        spin: zero,
        diameter: [1e-5; CHUNK],
        out: empty,
        all_fine: true,
    };
    let n = rows.normal.len();
    let mut all_fine = true;
    let mut first = 0;
    while first < n {
        let len = CHUNK.min(n - first);
        let range = first..first + len;
        chunk.normal[..len].copy_from_slice(&rows.normal[range.clone()]);
        chunk.tangential[..len].copy_from_slice(&rows.tangential[range.clone()]);
        chunk.spin[..len].copy_from_slice(&rows.spin[range.clone()]);
        chunk.diameter[..len].copy_from_slice(&rows.diameter[range.clone()]);
        if len < CHUNK {
            chunk.normal[len..].fill(1.0);
            chunk.diameter[len..].fill(1e-5);
            chunk.tangential[len..].fill(0.0);
            chunk.spin[len..].fill(0.0);
        }
        set.run(OneChunk { tangential: &law.tangential, normal, sizing, chunk: &mut chunk });
        all_fine &= chunk.all_fine;
        out.normal[range.clone()].copy_from_slice(&chunk.out.normal[..len]);
        out.tangential[range.clone()].copy_from_slice(&chunk.out.tangential[..len]);
        out.spin[range.clone()].copy_from_slice(&chunk.out.spin[..len]);
        if let Some(column) = out.restitution.as_deref_mut() {
            column[range.clone()].copy_from_slice(&chunk.out.restitution[..len]);
        }
        if let Some(column) = out.impulse_ratio.as_deref_mut() {
            column[range].copy_from_slice(&chunk.out.ratio[..len]);
        }
        first += len;
    }
    all_fine
}

/// The loop over a chunk, for each set of instructions.
struct OneChunk<'a, N, S> {
    tangential: &'a Tangential,
    normal: &'a N,
    sizing: &'a S,
    chunk: &'a mut Chunk,
}

impl<N: Normal, S: Sizing> Work for OneChunk<'_, N, S> {
    type Output = ();

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) {
        body(self.tangential, self.normal, self.sizing, self.chunk);
    }
}

#[inline(always)]
fn body<N: Normal, S: Sizing>(tangential: &Tangential, normal: &N, sizing: &S, chunk: &mut Chunk) {
    match tangential {
        Tangential::Friction { friction, beta } => {
            with_friction(&Coulomb { friction: *friction, beta: *beta }, normal, sizing, chunk)
        }
        Tangential::MicroSlip(law) => with_friction(law.as_ref(), normal, sizing, chunk),
        Tangential::Restitution(curve) => {
            let Chunk { normal: v_n, tangential: v_t, spin, diameter, out, all_fine } = chunk;
            *all_fine = true;
            for i in 0..CHUNK {
                let (vn, vt) = (v_n[i], v_t[i].abs());
                let response = normal.respond(vn, vt * vt, &sizing.size(diameter[i]));
                let e_t = curve.at(vn, vt, -1.0, 1.0);
                let rebound = constant::rebound(e_t, v_t[i]);
                let ratio = (vt - e_t * vt).abs() / ((1.0 + response.e) * vn);
                *all_fine &= out.write(
                    i,
                    &Row { v_n: vn, v_t: v_t[i], spin: spin[i], diameter: diameter[i] },
                    response.e,
                    rebound,
                    spin[i],
                    ratio,
                );
            }
        }
    }
}

#[inline(always)]
fn with_friction<F: FrictionLaw, N: Normal, S: Sizing>(friction: &F, normal: &N, sizing: &S, chunk: &mut Chunk) {
    let Chunk { normal: v_n, tangential: v_t, spin, diameter, out, all_fine } = chunk;
    let mut fine = true;
    for i in 0..CHUNK {
        let (vn, vt, w) = (v_n[i], v_t[i], spin[i]);
        let size = sizing.size(diameter[i]);
        let response = normal.respond(vn, vt * vt, &size);
        let normal_impulse = (1.0 + response.e) * vn;
        let slip = (-size.radius).mul_add(w, vt);
        let (p, _) = friction.impulse(slip.abs(), normal_impulse, &response);
        let signed = if slip < 0.0 { -p } else { p };
        let spun = (p * (2.5 / size.radius)) * if slip < 0.0 { -1.0 } else { 1.0 } + w;
        fine &= out.write(
            i,
            &Row { v_n: vn, v_t: vt, spin: w, diameter: diameter[i] },
            response.e,
            vt - signed,
            spun,
            p / normal_impulse,
        );
    }
    *all_fine = fine;
}

struct Row {
    v_n: f64,
    v_t: f64,
    spin: f64,
    diameter: f64,
}

impl Out {
    /// Writes one row: the rebound, zeros for a capture, NaN for a row that is no impact.
    #[inline(always)]
    fn write(&mut self, i: usize, row: &Row, e: f64, v_t: f64, spin: f64, ratio: f64) -> bool {
        let fine = column_ok(row.v_n, row.v_t, row.spin, row.diameter);
        let rebounds = e > 0.0;
        let pick = |value: f64, captured: f64| {
            let settled = if rebounds { value } else { captured };
            if fine { settled } else { f64::NAN }
        };
        self.normal[i] = pick(e * row.v_n, 0.0);
        self.tangential[i] = pick(v_t, 0.0);
        self.spin[i] = pick(spin, 0.0);
        self.restitution[i] = pick(e, 0.0);
        self.ratio[i] = pick(ratio, f64::NAN);
        fine
    }
}
