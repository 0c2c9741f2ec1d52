//! One impact, many impacts, the capture velocity.

use crate::impact::{ImpactIn, ImpactOut, LEAST_IN, LEAST_OUT};
use crate::law::Law;
use crate::status::{Status, fail, guard};
use carom::instructions::{Work, run_scalar};
use carom::math::Fma;
use carom::normal::NormalLaw;
use carom::{Fate, Impact, ImpactError};
use std::mem::size_of;

/// One impact.
///
/// Answers CAROM_STATUS_NOT_APPROACHING or CAROM_STATUS_BAD_IMPACT where there is none; `out` then says CAROM_FATE_UNMET and holds velocity and spin as they
/// came. On CAROM_STATUS_BAD_ARGUMENT `out` is not touched.
///
/// # Safety
/// Pointers are NULL (an error) or to a law that was not freed and to structs of the size they say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_impact(law: *const Law, impact: *const ImpactIn, out: *mut ImpactOut) -> Status {
    guard(|| {
        // SAFETY: NULL or a law, as the caller promises.
        let Some(law) = (unsafe { law.as_ref() }) else { return null("law") };
        if impact.is_null() || out.is_null() {
            return null(if impact.is_null() { "impact" } else { "out" });
        }
        // SAFETY: not NULL, so structs that begin with their size, as the caller promises.
        let (in_size, out_size) = unsafe { ((&raw const (*impact).size).read(), (&raw const (*out).size).read()) };
        if let Err(status) = known_sizes(in_size, out_size) {
            return status;
        }
        // SAFETY: the structs are of these sizes, as the caller promises, and the sizes are known to this library.
        unsafe { one(law, impact, in_size, out, out_size) }.map_or_else(refused, |()| Status::Ok)
    })
}

/// Many impacts, one after the other, each exactly as carom_impact gives it.
///
/// `impacts` and `out` are arrays of `n` structs, all of one size each: the size the first one says. `failed`, if not NULL, receives the index
/// of the first that is no impact, or `n`; all others are done nonetheless, and the status is that of the first. On
/// CAROM_STATUS_BAD_ARGUMENT nothing is done.
///
/// # Safety
/// Pointers are NULL (an error, but for `failed` and arrays of none) or to a law that was not freed and to `n` structs each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_impact_batch(
    law: *const Law,
    n: usize,
    impacts: *const ImpactIn,
    out: *mut ImpactOut,
    failed: *mut usize,
) -> Status {
    guard(|| {
        // SAFETY: NULL or a law, as the caller promises.
        let Some(law) = (unsafe { law.as_ref() }) else { return null("law") };
        if n > 0 && (impacts.is_null() || out.is_null()) {
            return null(if impacts.is_null() { "impacts" } else { "out" });
        }
        let first = if n == 0 {
            Ok(None)
        } else {
            // SAFETY: `n` structs each, as the caller promises.
            unsafe { all(law, n, impacts, out) }
        };
        let (index, status) = match first {
            Ok(None) => (n, Status::Ok),
            Ok(Some((index, error))) => (index, refused_at(index, error)),
            Err(refusal) => refusal,
        };
        // SAFETY: NULL or fit to be written to, as the caller promises.
        if let Some(failed) = unsafe { failed.as_mut() } {
            *failed = index;
        }
        status
    })
}

/// The speed at and below which a sphere sticks, m/s, when it comes in at `angle` (radians from the surface; pi/2 is head-on): what
/// adhesion holds is decided by the normal component, so it is the capture velocity over sin(angle).
///
/// `density`: kg/m3; 0 or NaN for the law's own sphere. `out`: 0 if nothing captures, infinity if the sphere never rebounds.
///
/// # Safety
/// `law` is NULL or a law that was not freed; `out` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_capture_velocity(
    law: *const Law,
    diameter: f64,
    density: f64,
    angle: f64,
    out: *mut f64,
) -> Status {
    guard(|| {
        // SAFETY: NULL or a law, as the caller promises.
        let Some(law) = (unsafe { law.as_ref() }) else { return null("law") };
        if out.is_null() {
            return null("out");
        }
        if !(angle > 0.0 && angle <= std::f64::consts::FRAC_PI_2) {
            let message =
                format_args!("the angle, {angle}, must lie above 0 and up to pi/2 (head-on), from the surface");
            return fail(Status::BadArgument, &message);
        }
        match capture_velocity(&law.0, diameter, density, angle) {
            Ok(speed) => {
                // SAFETY: not NULL, and so fit to be written to, as the caller promises.
                unsafe { out.write(speed) };
                Status::Ok
            }
            Err(error) => refused(error),
        }
    })
}

fn capture_velocity(law: &carom::WallLaw, diameter: f64, density: f64, angle: f64) -> Result<f64, ImpactError> {
    let density = if density == 0.0 || density.is_nan() { None } else { Some(density) };
    let Some(window) = law.window(diameter, density)? else { return Ok(f64::INFINITY) };
    let sine = angle.sin();
    if matches!(law.normal(), NormalLaw::Table(_)) {
        // a table knows the angle alone: at one where e is 0, every speed sticks
        let impact = Impact { density, ..Impact::new(diameter, [angle.cos(), -sine, 0.0], [0.0, 1.0, 0.0]) };
        return Ok(if law.impact(&impact)?.fate == Fate::Capture { f64::INFINITY } else { 0.0 });
    }
    Ok(window.capture_velocity / sine)
}

#[cold]
pub(crate) fn null(what: &str) -> Status {
    fail(Status::BadArgument, &format_args!("{what} is NULL"))
}

#[cold]
fn refused(error: ImpactError) -> Status {
    fail(status_of(error), &error)
}

#[cold]
pub(crate) fn refused_at(index: usize, error: ImpactError) -> Status {
    fail(status_of(error), &format_args!("impact {index}: {error}"))
}

fn status_of(error: ImpactError) -> Status {
    if error == ImpactError::NotApproaching { Status::NotApproaching } else { Status::BadImpact }
}

/// Are these sizes that a header of this or an earlier version has?
#[inline(always)]
fn known_sizes(in_size: usize, out_size: usize) -> Result<(), Status> {
    // the sizes of today are the common case
    if in_size == size_of::<ImpactIn>() && out_size == size_of::<ImpactOut>() {
        return Ok(());
    }
    known_size("carom_impact_in", in_size, LEAST_IN, size_of::<ImpactIn>())?;
    known_size("carom_impact_out", out_size, LEAST_OUT, size_of::<ImpactOut>())
}

#[cold]
fn known_size(name: &str, size: usize, least: usize, most: usize) -> Result<(), Status> {
    let why = if size < least {
        format_args!("fewer than the {least} it needs: set size to sizeof({name})").to_string()
    } else if size > most {
        let version = env!("CARGO_PKG_VERSION");
        format!(
            "more than the {most} that this library, {version}, knows: the program was compiled with the header of a later one"
        )
    } else if !size.is_multiple_of(size_of::<f64>()) {
        "no whole number of fields".to_owned()
    } else {
        return Ok(());
    };
    Err(fail(Status::BadArgument, &format_args!("{name} says it is {size} bytes long, {why}")))
}

/// The struct as this library knows it; what the caller's lacks takes its default.
///
/// # Safety
/// `impact` is to `size` bytes of an [`ImpactIn`], no more than it has.
#[inline(always)]
unsafe fn whole(impact: *const ImpactIn, size: usize) -> ImpactIn {
    if size == size_of::<ImpactIn>() {
        // SAFETY: all of it is there.
        return unsafe { impact.read() };
    }
    let mut full = ImpactIn::DEFAULT;
    // SAFETY: `size` bytes are there and fit; plain numbers take any bytes.
    unsafe { std::ptr::copy_nonoverlapping(impact.cast::<u8>(), (&raw mut full).cast::<u8>(), size) };
    full
}

/// # Safety
/// `impact` is to `in_size` bytes, `out` to `out_size` bytes, neither more than its struct has.
#[inline(always)]
unsafe fn one(
    law: &Law,
    impact: *const ImpactIn,
    in_size: usize,
    out: *mut ImpactOut,
    out_size: usize,
) -> Result<(), ImpactError> {
    run_scalar(One { law, impact, in_size, out, out_size })
}

/// An answer that goes straight to the caller's struct. Only [`one`] makes it, whose caller promises that the pointers are good.
struct One<'a> {
    law: &'a Law,
    impact: *const ImpactIn,
    in_size: usize,
    out: *mut ImpactOut,
    out_size: usize,
}

impl Work for One<'_> {
    type Output = Result<(), ImpactError>;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, f: F) -> Self::Output {
        // SAFETY: as the caller of `one` promises.
        unsafe { one_inlined(f, self.law, self.impact, self.in_size, self.out, self.out_size) }
    }
}

/// # Safety
/// As [`one`].
#[inline(always)]
unsafe fn one_inlined<F: Fma>(
    f: F,
    law: &Law,
    impact: *const ImpactIn,
    in_size: usize,
    out: *mut ImpactOut,
    out_size: usize,
) -> Result<(), ImpactError> {
    // SAFETY: as the caller promises.
    let impact = unsafe { whole(impact, in_size) }.impact();
    let answer = law.0.impact_on(f, &impact);
    let full = match &answer {
        Ok(outcome) => ImpactOut::of(outcome, out_size),
        Err(_) => ImpactOut::unmet(&impact, out_size),
    };
    if out_size == size_of::<ImpactOut>() {
        // SAFETY: all of it is there.
        unsafe { out.write(full) };
    } else {
        // SAFETY: `out_size` bytes are there, and no more than `full` has.
        unsafe { std::ptr::copy_nonoverlapping((&raw const full).cast::<u8>(), out.cast::<u8>(), out_size) };
    }
    answer.map(|_| ())
}

type First = Option<(usize, ImpactError)>;

/// # Safety
/// `impacts` and `out` are to `n` > 0 structs of the size that the first of each says.
unsafe fn all(law: &Law, n: usize, impacts: *const ImpactIn, out: *mut ImpactOut) -> Result<First, (usize, Status)> {
    // SAFETY: there is a first of each, which begins with its size.
    let (in_size, out_size) = unsafe { ((&raw const (*impacts).size).read(), (&raw const (*out).size).read()) };
    known_sizes(in_size, out_size).map_err(|status| (0, status))?;
    // SAFETY: within the arrays, or just behind them when not read.
    let nth = |i: usize| unsafe { (impacts.byte_add(i * in_size), out.byte_add(i * out_size)) };
    for i in 0..n {
        let (impact, out) = nth(i);
        // SAFETY: the `i`th of each array.
        let sizes = unsafe { ((&raw const (*impact).size).read(), (&raw const (*out).size).read()) };
        if sizes != (in_size, out_size) {
            let message = format_args!("impact {i}: size differs from that of the first; set it in every struct");
            return Err((i, fail(Status::BadArgument, &message)));
        }
    }
    let mut first = None;
    for i in 0..n {
        let (impact, out) = nth(i);
        // SAFETY: the `i`th of each array, of the sizes just checked.
        if let Err(error) = unsafe { one(law, impact, in_size, out, out_size) } {
            first = first.or(Some((i, error)));
        }
    }
    Ok(first)
}
