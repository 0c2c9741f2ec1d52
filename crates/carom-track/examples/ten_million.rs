//! Ten million spheres in a closed box, in a few lines: `cargo run --release -p carom-track --example ten_million [COUNT]`.

use carom_track::domain::{AnyDomain, ContactAt, Wall};
use carom_track::dynamics::Dynamics;
use carom_track::flow::{Flow, Fluid};
use carom_track::force::{Drag, Forces};
use carom_track::geometry::{Room, Shape};
use carom_track::random::{Purpose, Stream};
use carom_track::record::{End, ImpactRecord, Sink};
use carom_track::tracker::{Behavior, Particle, Settings, SettleHeight, Tracker};

#[derive(Default)]
struct Count {
    impacts: u64,
    ends: u64,
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
    fn end(&mut self, _: &End) {
        self.ends += 1;
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let spheres: u64 = std::env::args().nth(1).map_or(Ok(10_000_000), |n| n.parse())?;
    let room = Shape::Room(Room { min: [0.0; 3], max: [0.02; 3] });
    let wall = Wall { name: "box".into(), shape: room, contact_at: ContactAt::Surface, velocity: [0.0; 3] };
    let domain = AnyDomain::new(Flow::Still, vec![wall]);
    let text = "sphere = \"copper\"\nsurface = \"glass\"\nnormal = \"ea\"\nfriction = 0.2";
    let law = carom::spec::parse_law(text)?.compile(carom::material::Library::builtin())?;
    let forces = Forces { drag: Drag::SchillerNaumann, gravity: [0.0, -9.81, 0.0], ..Forces::default() };
    let dynamics = Dynamics { fluid: Fluid::default(), forces, random_walk: None, brownian: false };
    let settings =
        Settings { tolerance: 1e-5, until: 0.05, settle_height: SettleHeight::DEFAULT, max_steps: 1_000_000, seed: 1 };
    let tracker = Tracker { domain: &domain, dynamics: &dynamics, behaviors: &[Behavior::Law(vec![law])], settings };
    let particle = |number| {
        let mut draws = Stream::new(1, number, Purpose::Injection, 0);
        let (place, way): ([f64; 3], [f64; 3]) = (draws.uniforms(), draws.uniforms());
        let (position, velocity) = (place.map(|u| 1e-3 + 18e-3 * u), way.map(|u| 8.0 * u - 4.0));
        Particle {
            number,
            injection: 0,
            diameter: 9e-5,
            density: 8940.0,
            weight: 1.0,
            time: 0.0,
            position,
            velocity,
            spin: [0.0; 3],
        }
    };
    let mut count = Count::default();
    tracker.run(&mut (0..spheres).map(particle), &mut count);
    println!("{} spheres, {} impacts", count.ends, count.impacts);
    Ok(())
}
