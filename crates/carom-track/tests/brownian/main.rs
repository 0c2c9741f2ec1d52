//! Brownian motion held against what is known of it: Einstein, Maxwell, Smoluchowski, Gormley & Kennedy.
//!
//! Every test has a fixed seed and says it. The bounds are four standard errors, or what one sample in a thousand exceeds.

mod flows;
mod free;
mod impacts;
mod walls;

use carom_track::domain::{AnyDomain, ContactAt, Wall};
use carom_track::dynamics::Dynamics;
use carom_track::force::{Drag, Forces, Slip, Sphere, brownian};
use carom_track::geometry::{Plane, Shape};
use carom_track::record::{End, ImpactRecord, Sink};
use carom_track::tracker::{Behavior, Particle, Settings, Tracker};

type Vec3 = [f64; 3];

#[derive(Default)]
struct Log {
    impacts: Vec<ImpactRecord>,
    ends: Vec<End>,
    stalled: u32,
}

impl Sink for Log {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, impact: &ImpactRecord) {
        self.impacts.push(*impact);
    }
    fn contact_ended(&mut self, _: &ImpactRecord) {}
    fn point(&mut self, _: u64, _: f64, _: Vec3, _: Vec3, _: Vec3) {}
    fn end(&mut self, end: &End) {
        self.ends.push(*end);
    }
    fn stalled(&mut self) {
        self.stalled += 1;
    }
}

/// Drag with slip and the molecules' kicks, without weight.
fn air() -> Dynamics {
    let forces = Forces { gravity: [0.0; 3], slip: Slip::Davies, drag: Drag::Stokes, ..Forces::default() };
    Dynamics { forces, brownian: true, ..Dynamics::default() }
}

/// What a sphere of 1000 kg/m³ does in it.
struct Scales {
    /// Relaxation time, s.
    tau: f64,
    /// Thermal speed, m/s.
    thermal: f64,
    /// Diffusivity, m²/s.
    diffusivity: f64,
    /// Stopping distance at the thermal speed, m.
    free: f64,
}

fn scales(d: &Dynamics, diameter: f64) -> Scales {
    let like = Sphere { diameter, density: 1000.0 };
    let (tau, thermal) = (d.relaxation_time(&like), brownian::thermal_speed(&d.fluid, &like));
    Scales { tau, thermal, diffusivity: thermal * thermal * tau, free: thermal * tau }
}

fn sphere(number: u64, diameter: f64, position: Vec3) -> Particle {
    Particle::sphere(number, diameter, 1000.0, position, [0.0; 3])
}

/// A plane that the centre of a sphere touches.
fn plane(name: &str, point: Vec3, normal: Vec3) -> Wall {
    Wall { contact_at: ContactAt::Center, ..Wall::new(name, Shape::Plane(Plane { point, normal })) }
}

fn elastic() -> Behavior {
    let text = "normal = \"constant\"\nrestitution = 1.0\ntangential_restitution = 1.0\n";
    Behavior::Law(vec![carom::spec::parse_law(text).unwrap().compile(carom::material::Library::builtin()).unwrap()])
}

fn track(
    domain: &AnyDomain,
    dynamics: &Dynamics,
    behaviors: &[Behavior],
    (until, seed): (f64, u64),
    particles: impl IntoIterator<Item = Particle>,
) -> Log {
    let mut log = Log::default();
    let settings = Settings { until, seed, ..Settings::default() };
    Tracker { domain, dynamics, behaviors, settings }.run(&mut particles.into_iter(), &mut log).unwrap();
    assert_eq!(log.stalled, 0);
    log
}

/// Mean of the squares.
fn mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(s, n), x| (s + x * x, n + 1.0));
    sum / count
}

/// The largest difference between a sample's distribution and another, times √n: 1.95 in one of a thousand.
fn kolmogorov(sample: &mut [f64], cumulative: impl Fn(f64) -> f64) -> f64 {
    sample.sort_by(f64::total_cmp);
    let n = sample.len() as f64;
    let off = |(i, x): (usize, &f64)| {
        let p = cumulative(*x);
        (p - i as f64 / n).abs().max(((i + 1) as f64 / n - p).abs())
    };
    sample.iter().enumerate().map(off).fold(0.0, f64::max) * n.sqrt()
}
