//! What tests of several modules share.

use crate::random::{Purpose, Stream};

/// Whole numbers by chance.
pub struct Chance(Stream);

impl Chance {
    /// From the seed in `CAROM_SEED`, else 1; it is printed.
    pub fn seeded() -> Self {
        let seed = std::env::var("CAROM_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
        println!("seed {seed} (CAROM_SEED)");
        Self(Stream::new(seed, 0, Purpose::Injection, 0))
    }

    /// Below a number.
    pub fn below(&mut self, end: usize) -> usize {
        (self.0.uniform() * end as f64) as usize
    }
}

/// A step of the classical Runge–Kutta method.
pub fn runge_kutta<const N: usize>(s: [f64; N], h: f64, rate: impl Fn([f64; N]) -> [f64; N]) -> [f64; N] {
    let step = |k: [f64; N], h: f64| std::array::from_fn(|i| s[i] + h * k[i]);
    let k1 = rate(s);
    let k2 = rate(step(k1, 0.5 * h));
    let k3 = rate(step(k2, 0.5 * h));
    let k4 = rate(step(k3, h));
    std::array::from_fn(|i| s[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
}
