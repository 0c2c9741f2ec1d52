//! What the benchmarks share: spheres of the closed box of 20 mm, what is counted of a run, processor time.

#![allow(dead_code, reason = "each benchmark uses a part of it")]

use carom_track::random::{Purpose, Stream};
use carom_track::record::{End, ImpactRecord, Sink};
use carom_track::tracker::Particle;
use std::time::Instant;

/// Counts of a run.
#[derive(Default)]
pub struct Count {
    pub impacts: u64,
    pub ends: u64,
    pub steps: u64,
    /// Time flown, s.
    pub flown: f64,
}

impl Sink for Count {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, _: &ImpactRecord) {
        self.impacts += 1;
    }
    fn contact_ended(&mut self, _: &ImpactRecord) {}
    fn point(&mut self, _: u64, _: f64, _: [f64; 3], _: [f64; 3], _: [f64; 3]) {}
    fn end(&mut self, end: &End) {
        self.ends += 1;
        self.steps += end.steps;
        self.flown += end.time - end.particle.time;
    }
}

/// A sphere of 60 to 120 µm anywhere in the box, to anywhere.
pub fn particle(number: u64) -> Particle {
    let mut draws = Stream::new(1, number, Purpose::Injection, 0);
    let place: [f64; 3] = draws.uniforms();
    let way: [f64; 3] = draws.uniforms();
    Particle {
        number,
        injection: 0,
        diameter: (60.0 + 60.0 * draws.uniform()) * 1e-6,
        density: 2500.0,
        weight: 1.0,
        time: 0.0,
        position: place.map(|u| 1e-3 + 18e-3 * u),
        velocity: way.map(|u| 8.0 * u - 4.0),
        spin: [0.0; 3],
    }
}

/// Processor time of this thread, ns, where the system tells it; else the clock.
pub fn processor(begin: Instant) -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    stat.split(' ').next().and_then(|n| n.parse().ok()).unwrap_or_else(|| begin.elapsed().as_nanos() as f64)
}
