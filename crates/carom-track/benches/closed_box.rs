//! Spheres in a closed box for 50 ms: Schiller–Naumann drag, gravity, about six wall hits each.
//!
//! Reported per particle; a fiftieth of it is the time per particle and millisecond.

mod common;

use carom_track::domain::{AnyDomain, ContactAt, Wall};
use carom_track::dynamics::Dynamics;
use carom_track::flow::Flow;
use carom_track::force::{Drag, Forces};
use carom_track::geometry::{Room, Shape};
use carom_track::tracker::{Behavior, Particle, Settings, SettleHeight, Tracker};
use common::{Count, particle};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const PARTICLES: u64 = 4096;

fn closed_box(c: &mut Criterion) {
    let room = Shape::Room(Room { min: [0.0; 3], max: [0.02; 3] });
    let wall =
        Wall { name: "box".into(), shape: room, contact_at: ContactAt::Surface, velocity: [0.0; 3], patch: None };
    let domain = AnyDomain::new(Flow::Still, vec![wall]);
    let law = "normal = \"constant\"\nrestitution = 0.95\ntangential = \"constant\"\ntangential_restitution = 0.95\n";
    let law = carom::spec::parse_law(law).expect("a law").compile(carom::material::Library::builtin()).expect("a law");
    let behaviors = [Behavior::Law(vec![law])];
    let forces = Forces { drag: Drag::SchillerNaumann, ..Forces::default() };
    let dynamics = Dynamics { forces, ..Dynamics::default() };
    let settings =
        Settings { tolerance: 1e-5, until: 0.05, settle_height: SettleHeight::DEFAULT, max_steps: 1_000_000, seed: 1 };
    let tracker = Tracker { domain: &domain, dynamics: &dynamics, behaviors: &behaviors, settings };
    let particles: Vec<Particle> = (0..PARTICLES).map(particle).collect();
    let mut count = Count::default();
    tracker.run(&mut particles.iter().copied(), &mut count).expect("one wall, one behavior");
    let each = |n: u64| n as f64 / count.ends as f64;
    println!("{:.2} hits and {:.2} steps per particle", each(count.impacts), each(count.steps));
    let mut group = c.benchmark_group("closed box, 50 ms");
    group.throughput(Throughput::Elements(PARTICLES));
    group.bench_function("widest instructions", |b| {
        b.iter(|| {
            let mut count = Count::default();
            tracker.run(&mut particles.iter().copied(), &mut count).expect("one wall, one behavior");
            count.impacts
        })
    });
    group.sample_size(10);
    group.bench_function("plain", |b| {
        b.iter(|| {
            let mut count = Count::default();
            tracker.run_plain(&mut particles.iter().copied(), &mut count).expect("one wall, one behavior");
            count.impacts
        })
    });
    group.finish();
}

criterion_group!(benches, closed_box);
criterion_main!(benches);
