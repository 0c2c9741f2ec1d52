use super::*;
use crate::geometry::{Mesh, Room};
use crate::vector::unit;
use proptest::prelude::*;

/// Keeps every point of every path.
#[derive(Default)]
struct Paths {
    log: Log,
    points: Vec<Vec3>,
}

impl Sink for Paths {
    fn start(&mut self, _: &Particle) -> bool {
        true
    }
    fn impact(&mut self, impact: &ImpactRecord) {
        self.log.impact(impact);
    }
    fn contact_ended(&mut self, row: &ImpactRecord) {
        self.log.contact_ended(row);
    }
    fn point(&mut self, _: u64, _: f64, x: Vec3, _: Vec3, _: Vec3) {
        self.points.push(x);
    }
    fn end(&mut self, end: &End) {
        self.log.end(end);
    }
    fn stalled(&mut self) {
        self.log.stalled();
    }
}

/// Few cases unless `PROPTEST_CASES` asks for more.
fn cases() -> ProptestConfig {
    let default = ProptestConfig::default();
    if std::env::var_os("PROPTEST_CASES").is_some() { default } else { ProptestConfig { cases: 48, ..default } }
}

proptest! {
    #![proptest_config(cases())]

    /// Whatever the walls, forces and laws: nothing gets through a wall, hovers, or is lost.
    #[test]
    fn nothing_sinks_hovers_or_is_lost(
        normals in prop::collection::vec(prop::array::uniform3(-1.0f64..1.0), 0..4),
        wind in prop::array::uniform3(-5.0f64..5.0),
        gravity in prop::array::uniform3(-20.0f64..20.0),
        v in prop::array::uniform3(-5.0f64..5.0),
        restitution in 1e-3f64..1.0,
        diameter in 5e-6f64..2e-3,
        vacuum in any::<bool>(),
        block in any::<bool>(),
        angle in prop::sample::select(vec![0.0, 5.0, 25.0]),
    ) {
        let wall = |name: &str, shape| Wall { name: name.into(), shape, contact_at: ContactAt::Surface, velocity: [0.0; 3], patch: None };
        let mut walls = vec![wall("room", Shape::Room(Room { min: [-0.02; 3], max: [0.02; 3] }))];
        for n in normals.iter().filter_map(|n| unit(*n)) {
            walls.push(wall("plane", Shape::Plane(Plane { point: n.map(|c| -0.01 * c), normal: n })));
        }
        if block {
            let away = Mesh::block([0.004, -0.015, -0.015], [0.009, 0.015, 0.015]).unwrap();
            walls.push(wall("block", Shape::Mesh(away)));
        }
        let behaviors: Vec<_> = walls.iter().map(|_| rough_bounce(restitution, angle)).collect();
        let domain = AnyDomain::new(Flow::Uniform { velocity: wind }, walls);
        let mut d = dynamics(if vacuum { Drag::None } else { Drag::SchillerNaumann });
        d.forces.gravity = gravity;
        let mut paths = Paths::default();
        let settings = Settings { until: 0.5, ..settings() };
        let tracker = Tracker { domain: &domain, dynamics: &d, behaviors: &behaviors, settings };
        let p = Particle { diameter, density: 2500.0, ..sphere(0, [0.0; 3], v) };
        tracker.run(&mut std::iter::once(p), &mut paths).unwrap();
        let r = 0.5 * diameter;
        prop_assert_eq!(paths.log.ends.len(), 1);
        prop_assert_eq!(paths.log.stalled, 0);
        for x in &paths.points {
            for w in domain.walls() {
                let gap = w.shape.distance(*x) - r;
                prop_assert!(gap > -1e-9 * r - 1e-14, "{} into {} at {:?}", -gap, w.name, x);
            }
        }
        for i in &paths.log.impacts {
            let gap = domain.walls()[i.wall].shape.distance(i.position) - r;
            prop_assert!(gap.abs() < 1e-9 * r + 1e-14, "impact {gap} m off {}", domain.walls()[i.wall].name);
        }
        let end = paths.log.ends[0];
        if matches!(end.fate, ParticleFate::Settled | ParticleFate::Sliding) {
            let gap = domain.walls()[end.wall.unwrap()].shape.distance(end.position) - r;
            prop_assert!(gap.abs() < 1e-9 * r + 1e-14, "settled {gap} m off");
        } else {
            prop_assert_eq!(end.fate, ParticleFate::Airborne);
            prop_assert_eq!(end.time, 0.5);
        }
        if vacuum {
            let energy = |x: Vec3, v: Vec3| 0.5 * crate::vector::dot(v, v) - crate::vector::dot(gravity, x);
            prop_assert!(energy(end.position, end.velocity) <= energy([0.0; 3], v) + 1e-9);
        }
    }
}

/// In the groove between two walls, where roundings alone keep a sphere from leaving one of them: the wind takes it out.
#[test]
fn a_sphere_driven_along_a_groove_is_blown_out_of_it() {
    let n = unit([0.04438786216286354, 0.10755382851353631, -0.14688404611707714]).unwrap();
    let walls = vec![
        plane("low", n.map(|c| -0.01 * c), n),
        Wall {
            shape: Shape::Mesh(Mesh::block([0.004, -0.015, -0.015], [0.009, 0.015, 0.015]).unwrap()),
            ..plane("block", [0.0; 3], n)
        },
    ];
    let behaviors = [bounce(0.0014863437283143086), bounce(0.0014863437283143086)];
    let domain = AnyDomain::new(Flow::Uniform { velocity: [-1.0843897599167562, 3.6106815808456254, 0.0] }, walls);
    let mut d = dynamics(Drag::SchillerNaumann);
    d.forces.gravity = [-0.6904331635817815, 0.0, 0.0];
    let v = [2.400293785861977, -4.988245807374214, 2.6474216303883624];
    let p = Particle { diameter: 0.0005869892327772226, density: 2500.0, ..sphere(0, [0.0; 3], v) };
    let log = track(&domain, &d, &behaviors, Settings { until: 0.5, max_steps: 3000, ..settings() }, &[p]);
    assert_eq!(log.ends[0].fate, ParticleFate::Airborne);
    assert!(log.ends[0].steps < 3000, "{}", log.ends[0].steps);
}
