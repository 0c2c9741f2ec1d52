//! Brownian spheres: processor time for each sphere and second of flight, and steps.
//!
//! In a laminar channel of 10 mm at 0.1 m/s with weight, and in elastic boxes of still air, where spheres hit walls over and over.

mod common;

use carom_track::domain::{AnyDomain, Wall};
use carom_track::dynamics::Dynamics;
use carom_track::flow::{Channel, Flow, Fluid, Profile};
use carom_track::force::{Drag, Forces, Slip};
use carom_track::geometry::{Plane, Room, Shape};
use carom_track::tracker::{Behavior, Particle, Settings, Tracker};
use common::{Count, processor};
use std::time::Instant;

struct Case {
    name: &'static str,
    domain: AnyDomain,
    at: [f64; 3],
    diameter: f64,
    spheres: u64,
    until: f64,
}

fn channel(name: &'static str, diameter: f64, spheres: u64) -> Case {
    let flow = Flow::Channel(Channel::new(Profile::Laminar, 0.01, 0.1, &Fluid::default()).expect("a channel"));
    let wall = |name, y, up| Wall::new(name, Shape::Plane(Plane { point: [0.0, y, 0.0], normal: [0.0, up, 0.0] }));
    let domain = AnyDomain::new(flow, vec![wall("low", 0.0, 1.0), wall("high", 0.01, -1.0)]);
    Case { name, domain, at: [0.0, 0.006, 0.0], diameter, spheres, until: 1.0 }
}

fn closed(name: &'static str, half: f64) -> Case {
    let room = Shape::Room(Room { min: [-half; 3], max: [half; 3] });
    let domain = AnyDomain::new(Flow::Still, vec![Wall::new("room", room)]);
    Case { name, domain, at: [0.0; 3], diameter: 6e-8, spheres: 400, until: 0.05 }
}

fn main() {
    let cases = [
        channel("channel, 10 nm", 1e-8, 200),
        channel("channel, 60 nm", 6e-8, 200),
        channel("channel, 0.1 um", 1e-7, 200),
        channel("channel, 1 um", 1e-6, 200),
        channel("channel, 3 um", 3e-6, 200),
        channel("channel, 10 um", 1e-5, 200),
        channel("channel, 30 um", 3e-5, 200),
        closed("box of 2 mm, 60 nm", 1e-3),
        closed("box of 0.2 mm, 60 nm", 1e-4),
        closed("box of 50 um, 60 nm", 2.5e-5),
    ];
    let law = "normal = \"constant\"\nrestitution = 1\ntangential = \"constant\"\ntangential_restitution = 1\n";
    let law = carom::spec::parse_law(law).expect("a law").compile(carom::material::Library::builtin()).expect("a law");
    let begin = Instant::now();
    for case in &cases {
        let Case { name, domain, at, diameter, spheres, until } = case;
        let behaviors: Vec<_> = domain.walls().iter().map(|_| Behavior::Law(vec![law.clone()])).collect();
        let forces = Forces { drag: Drag::SchillerNaumann, slip: Slip::Davies, ..Forces::default() };
        let dynamics = Dynamics { forces, brownian: true, ..Dynamics::default() };
        let settings = Settings { until: *until, ..Settings::default() };
        let tracker = Tracker { domain, dynamics: &dynamics, behaviors: &behaviors, settings };
        let velocity = domain.fluid(0.0, *at).velocity;
        let mut start = (0..*spheres).map(|n| Particle::sphere(n, *diameter, 1000.0, *at, velocity));
        let (mut count, before) = (Count::default(), processor(begin));
        tracker.run(&mut start, &mut count).expect("a behavior for each wall");
        let time = 1e-9 * (processor(begin) - before);
        let each = |n: u64| n as f64 / *spheres as f64;
        println!(
            "{name:22} {time:7.3} s for {spheres} spheres and {until} s: {:8.3} ms per sphere and s, {:9.1} steps and {:7.2} impacts each, {:.0} ns a step",
            1e3 * time / (*spheres as f64 * until),
            each(count.steps),
            each(count.impacts),
            1e9 * time / count.steps as f64
        );
    }
}
