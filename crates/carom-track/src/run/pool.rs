//! Work over threads, results in order.
//!
//! Threads take the next number in turn and may run ahead of the oldest unfinished one by a few numbers only, so that
//! finished results waiting for their turn stay few.

use super::RunError;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::mpsc;
use std::sync::{Condvar, Mutex, PoisonError};

/// How far each thread may run ahead.
const AHEAD: u64 = 4;

/// Numbers handed out and finished.
struct Turn {
    next: u64,
    taken: u64,
    stop: bool,
}

/// Calls `work` for each number on some thread and `take` for each result, in order, on this one. The first error of
/// `take` stops everything.
pub(super) fn in_order<T: Send>(
    threads: usize,
    numbers: Range<u64>,
    work: impl Fn(u64) -> T + Sync,
    mut take: impl FnMut(u64, T) -> Result<(), RunError>,
) -> Result<(), RunError> {
    if threads <= 1 || numbers.end - numbers.start.min(numbers.end) <= 1 {
        return numbers.into_iter().try_for_each(|n| take(n, work(n)));
    }
    let turn = Mutex::new(Turn { next: numbers.start, taken: numbers.start, stop: false });
    let moved = Condvar::new();
    let (sender, results) = mpsc::channel();
    let end = numbers.end;
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let sender = sender.clone();
            let (turn, moved, work) = (&turn, &moved, &work);
            scope.spawn(move || {
                loop {
                    let mut t = turn.lock().unwrap_or_else(PoisonError::into_inner);
                    while !t.stop && t.next < end && t.next >= t.taken + AHEAD * threads as u64 {
                        t = moved.wait(t).unwrap_or_else(PoisonError::into_inner);
                    }
                    if t.stop || t.next >= end {
                        return;
                    }
                    let n = t.next;
                    t.next += 1;
                    drop(t);
                    if sender.send((n, work(n))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        let mut outcome = Ok(());
        let mut taken = numbers.start;
        for (n, result) in &results {
            waiting.insert(n, result);
            while let Some(result) = waiting.remove(&taken) {
                outcome = outcome.and_then(|()| take(taken, result));
                taken += 1;
            }
            let mut t = turn.lock().unwrap_or_else(PoisonError::into_inner);
            t.taken = taken;
            t.stop = outcome.is_err();
            drop(t);
            moved.notify_all();
        }
        outcome
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_and_an_error_stops() {
        let mut seen = Vec::new();
        in_order(
            4,
            3..200,
            |n| n * n,
            |n, r| {
                assert_eq!(r, n * n);
                seen.push(n);
                Ok(())
            },
        )
        .unwrap();
        assert_eq!(seen, (3..200).collect::<Vec<_>>());
        let mut count = 0;
        let stopped = in_order(
            3,
            0..1_000_000,
            |n| n,
            |_, n| {
                count += 1;
                if n == 10 { Err(RunError::NoFolder) } else { Ok(()) }
            },
        );
        assert!(stopped.is_err());
        assert_eq!(count, 11);
    }
}
