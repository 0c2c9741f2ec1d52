//! The closed box of `closed_box` between walls of other shapes: what each costs over six planes.
//!
//! All shapes in turn, several rounds; the least processor time of each and its ratio to the planes' are printed. `-- build` times
//! building a mesh of a million triangles; `-- vessel N [FIRST]` flies spheres, counted from FIRST, for N steps in closed vessels of triangles, and
//! none may be outside at any impact or end: parts with a FIRST each run side by side.

mod common;

use carom_track::domain::{AnyDomain, ContactAt, Wall};
use carom_track::dynamics::Dynamics;
use carom_track::flow::Flow;
use carom_track::force::{Drag, Forces};
use carom_track::geometry::{Cylinder, Mesh, Room, Shape, Triangle};
use carom_track::record::{End, ImpactRecord, Sink};
use carom_track::tracker::{Behavior, Particle, Settings, SettleHeight, Tracker};
use common::{particle, processor};
use std::time::Instant;

const PARTICLES: u64 = 4096;
const ROUNDS: usize = 9;
const SIDE: f64 = 0.02;
const UNTIL: f64 = 0.05;

#[derive(Default)]
struct Count {
    impacts: u64,
    steps: u64,
    outside: u64,
}

impl Sink for Count {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, _: &ImpactRecord) {
        self.impacts += 1;
    }
    fn point(&mut self, _: u64, _: f64, _: [f64; 3], _: [f64; 3], _: [f64; 3]) {}
    fn end(&mut self, end: &End) {
        self.steps += end.steps;
        self.outside += u64::from(!end.position.iter().all(|c| (0.0..=SIDE).contains(c)));
    }
}

/// The box with every side divided into `n` × `n` squares of two triangles.
fn triangles(n: usize) -> Vec<Triangle> {
    let mut all = Vec::with_capacity(12 * n * n);
    let at = |i: usize| if i == n { SIDE } else { SIDE * i as f64 / n as f64 };
    for axis in 0..3 {
        for level in [0.0, SIDE] {
            let corner = |i: usize, j: usize| {
                let mut x = [level; 3];
                (x[(axis + 1) % 3], x[(axis + 2) % 3]) = (at(i), at(j));
                x
            };
            for i in 0..n {
                for j in 0..n {
                    let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                    all.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    all
}

fn wall(shape: Shape) -> Wall {
    Wall { name: "box".into(), shape, contact_at: ContactAt::Surface, velocity: [0.0; 3], patch: None }
}

fn mesh(n: usize) -> Shape {
    Shape::Mesh(Mesh::new(&triangles(n)).expect("triangles"))
}

/// A stray triangle in each of many planes outside the box: what the few planes of a box hide.
fn scattered(n: usize) -> Shape {
    let mut all = triangles(n);
    all.extend((0..40).map(|i| {
        let z = -1.0 - 0.01 * f64::from(i);
        [[0.0, 0.0, z], [0.01, 0.001 * f64::from(i), z], [0.0, 0.01, z - 0.001]]
    }));
    Shape::Mesh(Mesh::new(&all).expect("triangles"))
}

fn build() {
    let all = triangles(289);
    for _ in 0..3 {
        let begin = Instant::now();
        let mesh = Mesh::new(&all).expect("triangles");
        println!("{} triangles built in {:.2} s", mesh.len(), begin.elapsed().as_secs_f64());
    }
}

/// A sphere of radius `SIDE` as triangles: an octahedron's, each divided into four `times` times.
fn vessel(times: u32) -> Vec<Triangle> {
    let put = |x: [f64; 3]| {
        let r = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        x.map(|c| SIDE * c / r)
    };
    let mut all: Vec<Triangle> = Vec::new();
    for signs in 0..8 {
        let sign = |c: usize| if signs >> c & 1 == 0 { 1.0 } else { -1.0 };
        all.push([[sign(0), 0.0, 0.0], [0.0, sign(1), 0.0], [0.0, 0.0, sign(2)]].map(put));
    }
    for _ in 0..times {
        let middle = |a: [f64; 3], b: [f64; 3]| put([0, 1, 2].map(|c| a[c] + b[c]));
        let four = |[a, b, c]: &Triangle| {
            let [d, e, f] = [middle(*a, *b), middle(*b, *c), middle(*c, *a)];
            [[*a, d, f], [d, *b, e], [f, e, *c], [d, e, f]]
        };
        all = all.iter().flat_map(four).collect();
    }
    all
}

/// Counts what leaves a vessel.
#[derive(Default)]
struct Watch {
    steps: u64,
    impacts: u64,
    ends: u64,
    outside: u64,
}

impl Watch {
    fn look(&mut self, x: [f64; 3]) {
        self.outside += u64::from(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] > SIDE * SIDE * (1.0 + 1e-12));
    }
}

impl Sink for Watch {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, impact: &ImpactRecord) {
        self.impacts += 1;
        self.look(impact.position);
    }
    fn point(&mut self, _: u64, _: f64, _: [f64; 3], _: [f64; 3], _: [f64; 3]) {}
    fn end(&mut self, end: &End) {
        self.ends += 1;
        self.steps += end.steps;
        self.look(end.position);
    }
}

/// Flies spheres, in turn by their surfaces and by their centres, until so many steps are done.
fn fly(wanted: f64, from: u64) {
    let law = "normal = \"constant\"\nrestitution = 1\ntangential = \"constant\"\ntangential_restitution = 1\n";
    let law = carom::spec::parse_law(law).expect("a law").compile(carom::material::Library::builtin()).expect("a law");
    let behaviors = [Behavior::Law(vec![law])];
    let forces = Forces { drag: Drag::None, ..Forces::default() };
    let dynamics = Dynamics { forces, ..Dynamics::default() };
    let settings =
        Settings { tolerance: 1e-5, until: 5.0, settle_height: SettleHeight::DEFAULT, max_steps: 1_000_000, seed: 1 };
    let (mut all, mut number) = (Watch::default(), from);
    for round in 0.. {
        let contact_at = if round % 2 == 0 { ContactAt::Center } else { ContactAt::Surface };
        let shape = Shape::Mesh(Mesh::new(&vessel(2 + round % 4)).expect("triangles"));
        let domain = AnyDomain::new(Flow::Still, vec![Wall { contact_at, ..wall(shape) }]);
        let tracker = Tracker { domain: &domain, dynamics: &dynamics, behaviors: &behaviors, settings };
        let mut watch = Watch::default();
        // from within half the radius, at some metres a second
        let spheres = (number..number + 1000).map(|n| {
            let p = particle(n);
            Particle { position: p.position.map(|c| 0.5 * (c - 0.5 * SIDE)), ..p }
        });
        tracker.run(&mut { spheres }, &mut watch).expect("a behavior for each wall");
        number += 1000;
        all.steps += watch.steps;
        all.impacts += watch.impacts;
        all.ends += watch.ends;
        all.outside += watch.outside;
        if all.steps as f64 >= wanted {
            break;
        }
    }
    let Watch { steps, impacts, ends, outside } = all;
    let spheres = number - from;
    println!("{steps:e} steps, {impacts:e} impacts, {ends} of {spheres} spheres ended, {outside} times outside");
    assert!(outside == 0 && ends == spheres, "spheres left a closed vessel");
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if arguments.iter().any(|a| a == "build") {
        return build();
    }
    if let Some(place) = arguments.iter().position(|a| a == "vessel") {
        let number = |place: usize| arguments.get(place).and_then(|n| n.parse::<f64>().ok());
        return fly(number(place + 1).unwrap_or(1e7), number(place + 2).unwrap_or(0.0) as u64);
    }
    let room = || wall(Shape::Room(Room { min: [0.0; 3], max: [SIDE; 3] }));
    let rod = Cylinder { point: [0.5; 3], axis: [0.0, 0.0, 1.0], radius: 0.01, inside: false };
    let inner = Cylinder { point: [0.012, 0.012, 0.0], axis: [0.0, 0.0, 1.0], radius: 1e-3, inside: false };
    let cases = [
        ("box of planes", vec![room()]),
        ("and a rod far away", vec![room(), wall(Shape::Cylinder(rod))]),
        ("and a rod inside", vec![room(), wall(Shape::Cylinder(inner))]),
        ("and a block far away", vec![room(), wall(Shape::Mesh(Mesh::block([1.0; 3], [2.0; 3]).expect("a block")))]),
        ("12 triangles", vec![wall(mesh(1))]),
        ("12, more planes", vec![wall(scattered(1))]),
        ("1 200", vec![wall(mesh(10))]),
        ("10 800", vec![wall(mesh(30))]),
        ("120 000", vec![wall(mesh(100))]),
        ("120 000, more planes", vec![wall(scattered(100))]),
        ("1 080 000", vec![wall(mesh(300))]),
    ];
    let law = "normal = \"constant\"\nrestitution = 0.95\ntangential = \"constant\"\ntangential_restitution = 0.95\n";
    let law = carom::spec::parse_law(law).expect("a law").compile(carom::material::Library::builtin()).expect("a law");
    let forces = Forces { drag: Drag::SchillerNaumann, ..Forces::default() };
    let dynamics = Dynamics { forces, ..Dynamics::default() };
    let settings =
        Settings { tolerance: 1e-5, until: UNTIL, settle_height: SettleHeight::DEFAULT, max_steps: 1_000_000, seed: 1 };
    let particles: Vec<Particle> = (0..PARTICLES).map(particle).collect();
    let domains: Vec<_> = cases.iter().map(|(_, walls)| AnyDomain::new(Flow::Still, walls.clone())).collect();
    let begin = Instant::now();
    let mut least = vec![f64::INFINITY; cases.len()];
    for round in 0..ROUNDS {
        for ((domain, (name, walls)), least) in domains.iter().zip(&cases).zip(&mut least) {
            let behaviors: Vec<_> = walls.iter().map(|_| Behavior::Law(vec![law.clone()])).collect();
            let tracker = Tracker { domain, dynamics: &dynamics, behaviors: &behaviors, settings };
            let mut count = Count::default();
            let before = processor(begin);
            tracker.run(&mut particles.iter().copied(), &mut count).expect("a behavior for each wall");
            *least = least.min(processor(begin) - before);
            if round == 0 {
                let Count { impacts, steps, outside } = count;
                println!("{name:22} {impacts} impacts, {steps} steps, {outside} outside");
            }
        }
    }
    let each = 1.0 / (PARTICLES as f64 * UNTIL * 1e3);
    for ((name, _), time) in cases.iter().zip(&least) {
        println!("{name:22} {:8.1} ns per sphere and ms, {:6.2} times the planes", time * each, time / least[0]);
    }
}
