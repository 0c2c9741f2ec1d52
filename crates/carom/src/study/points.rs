//! Points from one value to another.

use crate::math;
use alloc::vec;
use alloc::vec::Vec;

/// `count` values in equal ratios between two of one sign, both ends exact; fewer than two are the first alone.
///
/// ```
/// let speeds = carom::study::ratios(0.1, 10.0, 3);
/// assert_eq!((speeds[0], speeds[2]), (0.1, 10.0));
/// assert!((speeds[1] - 1.0).abs() < 1e-15);
/// ```
pub fn ratios(from: f64, to: f64, count: usize) -> Vec<f64> {
    between(from, to, count, |share| from * math::pow(to / from, share))
}

/// `count` values in equal steps, both ends exact; fewer than two are the first alone.
///
/// ```
/// assert_eq!(carom::study::steps(1.0, 3.0, 3), [1.0, 2.0, 3.0]);
/// ```
pub fn steps(from: f64, to: f64, count: usize) -> Vec<f64> {
    between(from, to, count, |share| from + share * (to - from))
}

fn between(from: f64, to: f64, count: usize, at: impl Fn(f64) -> f64) -> Vec<f64> {
    if count < 2 {
        return vec![from];
    }
    let mut values: Vec<f64> = (0..count).map(|i| at(i as f64 / (count - 1) as f64)).collect();
    (values[0], values[count - 1]) = (from, to);
    values
}
