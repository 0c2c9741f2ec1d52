//! Ten million spheres in a closed box: `cargo run --release -p carom-track --example ten_million [COUNT]`.

use carom::spec::NormalKind;
use carom_track::domain::{AnyDomain, Wall};
use carom_track::flow::Flow;
use carom_track::geometry::{Room, Shape};
use carom_track::random::{Purpose, Stream};
use carom_track::record::{ImpactRecord, Sink};
use carom_track::tracker::{Behavior, Particle, Settings, Tracker};

struct Impacts(u64);

impl Sink for Impacts {
    fn impact(&mut self, _: &ImpactRecord) {
        self.0 += 1;
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(10_000_000), |n| n.parse())?;
    let room = Wall::new("box", Shape::Room(Room { min: [0.0; 3], max: [0.02; 3] }));
    let domain = AnyDomain::new(Flow::Still, vec![room]);
    let materials = carom::material::Library::builtin();
    let law =
        carom::WallLaw::builder().sphere(materials.get("copper")?.clone()).surface(materials.get("glass")?.clone());
    let law = law.normal(NormalKind::Ea).friction(0.2).build()?;
    let (dynamics, behaviors) = (Default::default(), [Behavior::Law(vec![law])]);
    let settings = Settings { until: 0.05, ..Settings::default() };
    let tracker = Tracker { domain: &domain, dynamics: &dynamics, behaviors: &behaviors, settings };
    let mut spheres = (0..count).map(|number| {
        let mut draws = Stream::new(1, number, Purpose::Injection, 0);
        let place = draws.uniforms::<3>().map(|u| 1e-3 + 18e-3 * u);
        Particle::sphere(number, 90e-6, 8940.0, place, draws.uniforms::<3>().map(|u| 8.0 * u - 4.0))
    });
    let mut impacts = Impacts(0);
    tracker.run(&mut spheres, &mut impacts)?;
    println!("{count} spheres, {} impacts", impacts.0);
    Ok(())
}
