//! Spheres through finished results: what a crossing of a tetrahedron costs.
//!
//! The step of `examples/cfd/pitz-daily`, a plane case, and a box of 20³ cells with a vortex, between elastic walls. Printed is the least
//! processor time of several rounds.

mod common;

use carom_cfd::block::{Kind, block};
use carom_cfd::{Field, Fields, Snapshot};
use carom_track::Case;
use carom_track::domain::{AnyDomain, ContactAt, Wall};
use carom_track::dynamics::Dynamics;
use carom_track::flow::{Cells, Flow};
use carom_track::geometry::{Room, Shape};
use carom_track::tracker::{Behavior, Particle, Settings, Tracker};
use common::{Count, particle, processor};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

const ROUNDS: usize = 5;

fn time(name: &str, mut run: impl FnMut(&mut Count)) {
    let (begin, mut least, mut count) = (Instant::now(), f64::INFINITY, Count::default());
    for _ in 0..ROUNDS {
        count = Count::default();
        let before = processor(begin);
        run(&mut count);
        least = least.min(processor(begin) - before);
    }
    let Count { impacts, steps, flown, .. } = count;
    println!(
        "{name}: {impacts} impacts, {steps} steps; {:.0} ns a sphere and ms, {:.0} ns a step",
        least / (1e3 * flown),
        least / steps as f64
    );
}

fn pitz_daily() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/cfd/pitz-daily");
    let text = std::fs::read_to_string(folder.join("pitz-daily.toml")).expect("the example");
    let text = text.replace("count = 20000", "count = 1000");
    let case =
        Case::from_toml(&text, &folder.join("pitz-daily.toml"), carom::material::Library::builtin()).expect("a case");
    time("pitzDaily", |count| {
        case.tracker()
            .run(&mut (0..case.count()).filter_map(|n| case.particle(n)), count)
            .expect("a behavior for each wall");
    });
}

fn vortex() {
    let snapshot = {
        let mesh = block(Kind::Hexahedra, [20; 3], |x| x.map(|c| 0.02 * c));
        let turn = |x: [f64; 3]| {
            let [a, b, _] = x.map(|c| std::f64::consts::PI * c / 0.02);
            [4.0 * a.sin() * b.cos(), -4.0 * a.cos() * b.sin(), 0.0]
        };
        let velocity = Field::Points(mesh.points.iter().map(|x| turn(*x)).collect());
        Snapshot {
            mesh,
            fields: Fields { velocity: Some(velocity), ..Fields::default() },
            time: None,
            notes: Vec::new(),
        }
    };
    let cells = Arc::new(Cells::new(&snapshot).expect("a flow"));
    let shape = Shape::Room(Room { min: [0.0; 3], max: [0.02; 3] });
    let wall = Wall { name: "box".into(), shape, contact_at: ContactAt::Surface, velocity: [0.0; 3], patch: None };
    let domain = AnyDomain::new(Flow::Cells(cells), vec![wall]);
    let law = "normal = \"constant\"\nrestitution = 0.95\ntangential = \"constant\"\ntangential_restitution = 0.95\n";
    let law = carom::spec::parse_law(law).expect("a law").compile(carom::material::Library::builtin()).expect("a law");
    let behaviors = [Behavior::Law(vec![law])];
    let dynamics = Dynamics::default();
    let settings = Settings { until: 0.05, ..Settings::default() };
    let tracker = Tracker { domain: &domain, dynamics: &dynamics, behaviors: &behaviors, settings };
    let particles: Vec<Particle> = (0..1024).map(particle).collect();
    time("20^3 box", |count| {
        tracker.run(&mut particles.iter().copied(), count).expect("a behavior for each wall");
    });
}

fn main() {
    pitz_daily();
    vortex();
}
