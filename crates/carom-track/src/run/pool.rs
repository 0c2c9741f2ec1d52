//! Work over threads, results in order.
//!
//! Threads take the next few particles in turn and may run ahead of the oldest unfinished ones by a few turns only, so that
//! finished results waiting for their turn stay few. A turn is short where particles take long: what an interruption costs, and
//! what the last thread keeps the others waiting for, is then little.

use super::RunError;
use std::any::Any;
use std::collections::BTreeMap;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// How many turns each thread may run ahead.
pub(super) const AHEAD: usize = 4;
/// Particles of a turn: as many as fill all lanes at least; more cost memory and gain nothing at most. Tests want the same
/// turns every time.
const FEWEST: u64 = 16;
const MOST: u64 = if cfg!(test) { FEWEST } else { 1024 };
/// What a turn should take, s.
const TURN: f64 = 0.1;

/// Numbers handed out and finished.
struct Turn {
    next: u64,
    /// Turns handed out and taken.
    given: u64,
    taken: u64,
    stop: bool,
}

/// Calls `work` for ranges of numbers on some thread and `take` for each result, in order, on this one. The first error of
/// either stops everything; so does a panic, which becomes an error.
pub(super) fn in_order<T: Send>(
    threads: usize,
    numbers: Range<u64>,
    work: impl Fn(Range<u64>) -> Result<T, RunError> + Sync,
    mut take: impl FnMut(Range<u64>, T) -> Result<(), RunError>,
) -> Result<(), RunError> {
    let end = numbers.end;
    if threads <= 1 {
        let (mut next, mut size) = (numbers.start, FEWEST);
        while next < end {
            let range = next..end.min(next.saturating_add(size));
            let started = Instant::now();
            take(range.clone(), caught(&work, range.clone())?)?;
            (next, size) = (range.end, resized(size, started));
        }
        return Ok(());
    }
    let turn = Mutex::new(Turn { next: numbers.start, given: 0, taken: 0, stop: false });
    let moved = Condvar::new();
    let (sender, results) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let sender = sender.clone();
            let (turn, moved, work) = (&turn, &moved, &work);
            scope.spawn(move || {
                let mut size = FEWEST;
                loop {
                    let mut t = lock(turn);
                    while !t.stop && t.next < end && t.given >= t.taken + (AHEAD * threads) as u64 {
                        t = moved.wait(t).unwrap_or_else(PoisonError::into_inner);
                    }
                    if t.stop || t.next >= end {
                        return;
                    }
                    let range = t.next..end.min(t.next.saturating_add(size));
                    t.next = range.end;
                    t.given += 1;
                    drop(t);
                    let started = Instant::now();
                    let result = caught(work, range.clone());
                    if sender.send((range, result)).is_err() {
                        return;
                    }
                    size = resized(size, started);
                }
            });
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        let mut outcome = Ok(());
        let (mut next, mut taken) = (numbers.start, 0);
        for (range, result) in &results {
            waiting.insert(range.start, (range, result));
            while outcome.is_ok()
                && let Some((range, result)) = waiting.remove(&next)
            {
                next = range.end;
                taken += 1;
                outcome = result.and_then(|result| take(range, result));
            }
            let mut t = lock(&turn);
            t.taken = taken;
            t.stop = outcome.is_err();
            drop(t);
            moved.notify_all();
        }
        outcome
    })
}

fn lock(turn: &Mutex<Turn>) -> MutexGuard<'_, Turn> {
    turn.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The size of the next turn, after one of a size that began then.
fn resized(size: u64, started: Instant) -> u64 {
    let ratio = TURN / started.elapsed().as_secs_f64().max(1e-9);
    ((size as f64 * ratio.min(4.0)) as u64).clamp(FEWEST, MOST)
}

fn caught<T>(work: &impl Fn(Range<u64>) -> Result<T, RunError>, range: Range<u64>) -> Result<T, RunError> {
    let particles = range.clone();
    catch_unwind(AssertUnwindSafe(|| work(range)))
        .unwrap_or_else(|panic| Err(RunError::Panic { particles, message: message(panic.as_ref()) }))
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_and_an_error_stops() {
        for threads in [1, 4] {
            let mut next = 3;
            in_order(
                threads,
                3..20_000,
                |n| Ok(n.start * n.start),
                |n, r| {
                    assert_eq!((n.start, r), (next, n.start * n.start));
                    next = n.end;
                    Ok(())
                },
            )
            .unwrap();
            assert_eq!(next, 20_000);
            let mut count = 0;
            let stopped = in_order(threads, 0..1_000_000_000, Ok, |_, n| {
                count += 1;
                if n.end > 1000 { Err(RunError::NoFolder) } else { Ok(()) }
            });
            assert!(stopped.is_err());
            assert!(count < 100);
        }
    }

    #[test]
    fn a_panic_ends_the_run_with_a_message() {
        for threads in [1, 2, 5] {
            let failing = |n: Range<u64>| if n.contains(&1000) { panic!("at {}", 1000) } else { Ok(()) };
            let error = in_order(threads, 0..1_000_000, failing, |_, ()| Ok(())).unwrap_err();
            assert!(matches!(&error, RunError::Panic { message, .. } if message == "at 1000"), "{error}");
        }
    }
}
