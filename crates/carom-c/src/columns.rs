//! Many impacts in a plane, in columns: the core's vectorised loops.

use crate::calls::{null, refused_at};
use crate::law::Law;
use crate::status::{Status, fail, guard};
use carom::batch::{BatchError, Incidence, Rebound};

/// Many impacts at once, several times as fast as one by one: in columns of `n` numbers, each in its own plane of incidence, spheres of the
/// law's own density, the wall at rest. The same bits as carom_impact, on any machine.
/// A wall that scatters takes every draw at 1/2 here.
///
/// In: `normal` approach speed (m/s, positive), `tangential` speed (m/s), `spin` (rad/s, positive when it rolls forward along
/// positive tangential speed), `diameter` (m). Out: normal speed away from the wall, tangential speed and spin after the impact,
/// zeros for a capture; `restitution` and `impulse_ratio` may be NULL.
///
/// A row that is no impact has NaN in all columns out; `failed`, if not NULL, receives the index of the first, or `n`, and the status is
/// that row's. Columns out must not overlap each other or columns in.
///
/// # Safety
/// Pointers are NULL (an error where not allowed) or to a law that was not freed and to `n` numbers each.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // columns, as C has them
pub unsafe extern "C" fn carom_impact_columns(
    law: *const Law,
    n: usize,
    normal: *const f64,
    tangential: *const f64,
    spin: *const f64,
    diameter: *const f64,
    normal_out: *mut f64,
    tangential_out: *mut f64,
    spin_out: *mut f64,
    restitution: *mut f64,
    impulse_ratio: *mut f64,
    failed: *mut usize,
) -> Status {
    guard(|| {
        // SAFETY: NULL or a law, as the caller promises.
        let Some(law) = (unsafe { law.as_ref() }) else { return null("law") };
        let wanted = [normal, tangential, spin, diameter, normal_out, tangential_out, spin_out];
        if n > 0 && wanted.into_iter().any(<*const f64>::is_null) {
            return null("a column");
        }
        if n > isize::MAX as usize / size_of::<f64>() {
            return fail(Status::BadArgument, &format_args!("columns of {n} numbers do not fit into memory"));
        }
        // SAFETY: the caller promises columns of `n` numbers that do not overlap where they are written; not NULL unless `n` is 0 or
        // they are optional.
        let (incidence, mut rebound) = unsafe {
            (
                Incidence {
                    normal: column(normal, n),
                    tangential: column(tangential, n),
                    spin: column(spin, n),
                    diameter: column(diameter, n),
                },
                Rebound {
                    normal: column_out(normal_out, n),
                    tangential: column_out(tangential_out, n),
                    spin: column_out(spin_out, n),
                    restitution: (!restitution.is_null()).then(|| column_out(restitution, n)),
                    impulse_ratio: (!impulse_ratio.is_null()).then(|| column_out(impulse_ratio, n)),
                    energy: None,
                },
            )
        };
        let (index, status) = match law.0.impact_batch(&incidence, &mut rebound) {
            Ok(()) => (n, Status::Ok),
            Err(BatchError::Row { index, error }) => (index, refused_at(index, error)),
            Err(BatchError::Lengths) => (0, fail(Status::BadArgument, &BatchError::Lengths)),
        };
        // SAFETY: NULL or fit to be written to, as the caller promises.
        if let Some(failed) = unsafe { failed.as_mut() } {
            *failed = index;
        }
        status
    })
}

/// # Safety
/// `n` numbers, or `n` is 0.
unsafe fn column<'a>(pointer: *const f64, n: usize) -> &'a [f64] {
    // SAFETY: as the caller promises; an empty slice needs no memory.
    if n == 0 { &[] } else { unsafe { std::slice::from_raw_parts(pointer, n) } }
}

/// # Safety
/// `n` numbers that nobody else reads or writes, or `n` is 0.
unsafe fn column_out<'a>(pointer: *mut f64, n: usize) -> &'a mut [f64] {
    // SAFETY: as the caller promises; an empty slice needs no memory.
    if n == 0 { &mut [] } else { unsafe { std::slice::from_raw_parts_mut(pointer, n) } }
}
