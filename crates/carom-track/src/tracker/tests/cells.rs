//! Through meshes of cells: what comes out does not depend on how the space is cut.

use super::*;
use crate::domain::{Carry, Meshed};
use crate::flow::cells::tests::{Dice, shaken, with_cell_velocity, with_velocity};
use crate::flow::{Cells, Stagnation, Symmetry};
use crate::geometry::{Mesh, Room, Walls};
use carom_cfd::block::{Kind, SIDES, block};
use carom_cfd::{PatchKind, Snapshot};
use std::sync::Arc;

/// A domain whose patches are all walls, in their order.
pub(super) fn domain(snapshot: &Snapshot) -> AnyDomain {
    let cells = Arc::new(Cells::new(snapshot).unwrap());
    let walls = cells.patches().iter().filter(|p| p.kind == PatchKind::Wall).map(|p| Wall {
        patch: Some(p.name.clone()),
        ..Wall::new(&p.name, Shape::Mesh(Mesh::new(&cells.wall(p)).unwrap()))
    });
    let walls: Vec<Wall> = walls.collect();
    AnyDomain::new(Flow::Cells(cells), walls)
}

fn fly(domain: &AnyDomain, d: &Dynamics, behavior: Behavior, until: f64, starts: &[Particle]) -> Log {
    let behaviors = vec![behavior; domain.walls().len()];
    let settings = Settings { until, ..settings() };
    let mut log = Log::default();
    let tracker = Tracker { domain, dynamics: d, behaviors: &behaviors, settings };
    tracker.run(&mut starts.iter().copied(), &mut log).unwrap();
    log.ends.sort_by_key(|e| e.particle.number);
    log
}

/// Drag alone: spheres that do not come to rest.
fn floating(drag: Drag) -> Dynamics {
    let mut d = dynamics(drag);
    d.forces.gravity = [0.0; 3];
    d
}

fn starts(count: u64, seed: u64, v: f64) -> Vec<Particle> {
    let mut dice = Dice::new(seed);
    let mut start = |i| {
        let x = dice.point().map(|c| 0.05 + 0.9 * c);
        let w = dice.point().map(|c| v * (2.0 * c - 1.0));
        Particle::sphere(i, 40e-6, 2000.0, x, w)
    };
    (0..count).map(&mut start).collect()
}

#[test]
fn in_a_linear_field_paths_are_those_of_the_formula() {
    let point = [0.5, 0.0, 0.5];
    let stagnation = Stagnation::new(Symmetry::Axisymmetric, point, [0.0, 1.0, 0.0], 20.0).unwrap();
    let flow = Flow::Stagnation(stagnation);
    let exact =
        AnyDomain::new(flow.clone(), vec![Wall::new("box", Shape::Room(Room { min: [0.0; 3], max: [1.0; 3] }))]);
    let starts = starts(40, 5, 3.0);
    let d = dynamics(Drag::SchillerNaumann);
    let want = fly(&exact, &d, Behavior::Escape, 10.0, &starts);
    for kind in [Kind::Hexahedra, Kind::Tetrahedra] {
        let mesh = domain(&with_velocity(block(kind, [5, 4, 3], |x| x), |x| flow.velocity(x)));
        let got = fly(&mesh, &d, Behavior::Escape, 10.0, &starts);
        assert_eq!(got.stalled, 0);
        for (got, want) in got.ends.iter().zip(&want.ends) {
            assert_eq!(
                (got.fate, want.fate),
                (ParticleFate::Escaped, ParticleFate::Escaped),
                "{kind:?} {}",
                got.particle.number
            );
            let off = crate::vector::norm(crate::vector::sub(got.position, want.position));
            // the way is about 1 m, the tolerance 1e-6 of it
            assert!(off < 2e-6, "{kind:?} {}: {off:e}", got.particle.number);
            assert!((got.time - want.time).abs() < 2e-6 * want.time.max(0.1), "{} {}", got.time, want.time);
        }
    }
}

#[test]
fn a_box_of_cells_is_a_box() {
    let walls = vec![Wall::new("box", Shape::Room(Room { min: [0.0; 3], max: [1.0; 3] }))];
    let exact = AnyDomain::new(Flow::Still, walls);
    let starts = starts(20, 8, 6.0);
    let d = floating(Drag::None);
    let want = fly(&exact, &d, bounce(0.9), 1.5, &starts);
    for kind in Kind::ALL {
        let mesh = domain(&with_velocity(shaken(kind, [4, 3, 2], 0.25, 3), |_| [0.0; 3]));
        let got = fly(&mesh, &d, bounce(0.9), 1.5, &starts);
        assert_eq!(got.impacts.len(), want.impacts.len(), "{kind:?}");
        for (got, want) in got.ends.iter().zip(&want.ends) {
            let off = crate::vector::norm(crate::vector::sub(got.position, want.position));
            assert!(off < 1e-9, "{kind:?} {}: {off:e}", got.particle.number);
        }
    }
}

#[test]
fn any_company_and_any_instructions_give_the_same_bits() {
    let mesh = domain(&with_velocity(shaken(Kind::Prisms, [5, 4, 3], 0.25, 9), rolls));
    // in turn such that follow the fluid and such that do not
    let mut spheres = starts(24, 3, 2.0);
    for p in spheres.iter_mut().step_by(2) {
        p.diameter = 4e-6;
    }
    let d = floating(Drag::SchillerNaumann);
    let behaviors = vec![bounce(0.7); mesh.walls().len()];
    let settings = Settings { until: 0.05, ..settings() };
    let tracker = Tracker { domain: &mesh, dynamics: &d, behaviors: &behaviors, settings };
    let run = |set, spheres: &[Particle]| {
        let mut log = Log::default();
        tracker.run_on(set, &mut spheres.iter().copied(), &mut log).unwrap();
        log.ends.sort_by_key(|e| e.particle.number);
        log.ends
    };
    let want: Vec<End> =
        spheres.iter().flat_map(|p| run(carom::instructions::InstructionSet::Portable, &[*p])).collect();
    assert!(want.iter().any(|e| e.steps > 20));
    for set in carom::instructions::InstructionSet::available() {
        assert_eq!(run(set, &spheres), want, "{set:?}");
    }
}

/// A field of rolls that vanishes on no wall.
fn rolls(x: Vec3) -> Vec3 {
    let wave = |s: f64| carom::math::sin_cos(std::f64::consts::TAU * s);
    let ((sx, cx), (sy, cy)) = (wave(x[0]), wave(x[1]));
    [3.0 * sx * cy, -3.0 * cx * sy, 0.5 * sx]
}

#[test]
fn nothing_is_lost_in_shaken_meshes() {
    for kind in Kind::ALL {
        let mesh = domain(&with_velocity(shaken(kind, [6, 5, 4], 0.3, 21), rolls));
        let log = fly(&mesh, &floating(Drag::SchillerNaumann), bounce(0.7), 0.5, &starts(30, 2, 2.0));
        assert_eq!((log.ends.len(), log.stalled), (30, 0));
        for end in &log.ends {
            assert_ne!(end.fate, ParticleFate::Stuck, "{kind:?} {end:?}");
            assert!(end.position.iter().all(|c| *c > 0.0 && *c < 1.0), "{kind:?} {end:?}");
        }
    }
}

#[test]
fn in_meshes_with_turned_cells_every_sphere_has_a_fate() {
    for kind in Kind::ALL {
        let snapshot = with_velocity(shaken(kind, [6, 5, 4], 1.0, 22), rolls);
        let mesh = domain(&snapshot);
        assert!(Cells::new(&snapshot).unwrap().inverted() > 0, "{kind:?}");
        let log = fly(&mesh, &floating(Drag::SchillerNaumann), bounce(0.7), 0.3, &starts(30, 2, 2.0));
        assert_eq!((log.ends.len(), log.stalled), (30, 0), "{kind:?}");
        let stuck = log.ends.iter().filter(|e| e.fate == ParticleFate::Stuck).count();
        assert!(stuck == 0, "{kind:?} {stuck}");
        assert!(log.ends.iter().all(|e| e.position.iter().all(|c| *c > -1e-6 && *c < 1.0 + 1e-6)));
    }
}

#[test]
fn a_stuck_sphere_says_in_which_cell() {
    // a side that no wall stands at: what goes out there is lost
    let kinds = |name: &str| if name == "right" { PatchKind::Plain } else { PatchKind::Wall };
    let mesh = domain(&with_velocity(sides([4, 3, 2], kinds, |x| x), |_| [1.0, 0.0, 0.0]));
    let AnyDomain::Meshed(meshed) = &mesh else { unreachable!("cells") };
    let starts = [[0.1, 0.1, 0.2], [0.1, 0.9, 0.8], [0.9, 0.5, 0.3]];
    let starts: Vec<Particle> =
        (0..).zip(starts).map(|(i, x)| Particle::sphere(i, 40e-6, 2000.0, x, [1.0, 0.0, 0.0])).collect();
    let log = fly(&mesh, &floating(Drag::SchillerNaumann), Behavior::Trap, 2.0, &starts);
    for (end, start) in log.ends.iter().zip(&starts) {
        let [_, y, z] = start.position;
        assert!(end.fate == ParticleFate::Stuck && (end.position[0] - 1.0).abs() < 1e-9, "{end:?}");
        assert_eq!(end.cell, Some(meshed.cells().find([0.99, y, z]).cell));
    }
    let fine = fly(
        &mesh,
        &floating(Drag::SchillerNaumann),
        Behavior::Trap,
        2.0,
        &[Particle::sphere(9, 40e-6, 2000.0, [0.001, 0.5, 0.5], [-9.0, 0.0, 0.0])],
    );
    assert_eq!((fine.ends[0].fate, fine.ends[0].cell), (ParticleFate::Trapped, None));
}

type Place<'a> = &'a dyn Fn(Vec3) -> Vec3;

/// Meshes that are hard to go through: each kind of cell shaken, skewed, flat, turned inside out, and bent into a hook.
fn hard_meshes(seed: u64) -> Vec<(String, carom_cfd::Mesh)> {
    let bend = |x: Vec3| {
        let (r, turn) = (1.0 + x[0], 4.5 * x[1]);
        let (s, c) = carom::math::sin_cos(turn);
        [r * c, r * s, x[2]]
    };
    let shapes: [(&str, f64, Place); 5] = [
        ("shaken", 0.3, &|x| x),
        ("skewed", 0.2, &|x| [x[0] + 1.5 * x[1], x[1] + 0.7 * x[2], x[2]]),
        ("flat", 0.2, &|x| [x[0], 0.01 * x[1], 3.0 * x[2]]),
        ("turned", 1.0, &|x| x),
        ("hook", 0.2, &bend),
    ];
    let mut all = Vec::new();
    for kind in Kind::ALL {
        for (name, share, place) in shapes {
            let mut mesh = shaken(kind, [6, 8, 5], share, seed);
            mesh.points.iter_mut().for_each(|x| *x = place(*x));
            all.push((format!("{name} {kind:?}"), mesh));
        }
    }
    all
}

/// `CAROM_CROSSINGS=1e9 cargo test --release -p carom-track --lib crossings -- --ignored --nocapture`; `CAROM_SEED` is the first seed.
#[test]
#[ignore = "10⁷ crossings by default, half a minute; 10⁹ in half an hour of one core"]
fn crossings_of_hard_meshes_lose_no_sphere() {
    use super::super::cross::CROSSED;
    use std::sync::atomic::Ordering;
    let wanted = std::env::var("CAROM_CROSSINGS").map_or(1e7, |n| n.parse::<f64>().expect("a number"));
    let (mut crossed, mut spheres, mut stuck) = (0, 0, std::collections::BTreeMap::<String, usize>::new());
    let (mut stalled, mut lost_in_sound, mut lost_in_bent) = (0, 0, 0);
    let first = std::env::var("CAROM_SEED").map_or(1, |n| n.parse().expect("a number"));
    for seed in first.. {
        for (name, mesh) in hard_meshes(seed) {
            let domain = domain(&with_velocity(mesh, rolls));
            let AnyDomain::Meshed(meshed) = &domain else { unreachable!("cells") };
            let cells = meshed.cells();
            let mut dice = Dice::new(seed + 1000);
            let starts: Vec<Particle> = (0..40)
                .map(|i| {
                    let middle = cells.middle((dice.roll() * cells.len() as f64) as usize);
                    Particle::sphere(i, 400e-6, 8000.0, middle, dice.point().map(|c| 4.0 * c - 2.0))
                })
                .collect();
            let before = CROSSED.load(Ordering::Relaxed);
            let log = fly(&domain, &floating(Drag::SchillerNaumann), bounce(0.99), 2.0, &starts);
            crossed += CROSSED.load(Ordering::Relaxed) - before;
            spheres += starts.len();
            stalled += log.stalled;
            assert_eq!(log.ends.len(), starts.len(), "{name} {seed}: every sphere has one fate");
            for end in &log.ends {
                if end.fate == ParticleFate::Stuck {
                    *stuck.entry(name.clone()).or_default() += 1;
                    lost_in_sound += usize::from(cells.inverted() == 0);
                    lost_in_bent += usize::from(!name.starts_with("turned"));
                } else if !name.starts_with("turned") {
                    let inside = !cells.find(end.position).is_nowhere();
                    assert!(inside || meshed.walls().distance(end.position) < 1e-6, "{name} {seed} {end:?}");
                }
            }
        }
        println!(
            "{crossed:.3e} crossings by {spheres} spheres, stuck {stuck:?}, stalled {stalled}",
            crossed = crossed as f64
        );
        if crossed as f64 >= wanted {
            break;
        }
    }
    // where tetrahedra are turned a place can be in none of them; seen: 38 of 1.0 million spheres outside the meshes that are turned throughout
    assert!(lost_in_sound == 0 && lost_in_bent <= 1 + spheres / 10_000 && stalled == 0, "{stuck:?}, {stalled} stalled");
}

#[test]
fn poiseuille_s_flow_on_any_mesh_deposits_as_the_formula_does_the_better_the_finer_it_is() {
    let (height, length) = (0.02, 0.4);
    let channel = crate::flow::Channel::new(crate::flow::Profile::Laminar, height, 0.2, &Fluid::default()).unwrap();
    let exact = AnyDomain::new(
        Flow::Channel(channel),
        vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0]), plane("end", [length, 0.0, 0.0], [-1.0, 0.0, 0.0])],
    );
    let d = dynamics(Drag::SchillerNaumann);
    let start = |i: u64| {
        let y = height * (0.1 + 0.1 * i as f64);
        Particle::sphere(i, 40e-6, 1000.0, [1e-3, y, 0.41 * height], [0.0; 3])
    };
    let starts: Vec<Particle> = (0..8).map(start).collect();
    let want = fly(&exact, &d, Behavior::Trap, 10.0, &starts);
    for kind in Kind::ALL {
        let error = |n: usize| {
            let mut mesh = shaken(kind, [2 * n, n, n / 2], 0.2, 31);
            for x in &mut mesh.points {
                // finer towards the floor
                let y = x[1] * (0.7 + 0.3 * x[1]);
                *x = [length * x[0], height * y, height * x[2]];
            }
            let flow = |x: Vec3| [1.2 * x[1] / height * (1.0 - x[1] / height), 0.0, 0.0];
            let got = fly(&domain(&with_cell_velocity(mesh, flow)), &d, Behavior::Trap, 10.0, &starts);
            let off = |(got, want): (&End, &End)| (got.position[0] - want.position[0]).abs();
            got.ends.iter().zip(&want.ends).map(off).fold(0.0, f64::max) / length
        };
        let (coarse, fine) = (error(6), error(18));
        assert!(fine < 0.02 && fine < 0.35 * coarse, "{kind:?}: {coarse} {fine}");
    }
}

/// A block of that many hexahedra with the kinds of its six patches.
pub(super) fn sides(n: [usize; 3], kinds: impl Fn(&str) -> PatchKind, place: impl Fn(Vec3) -> Vec3) -> carom_cfd::Mesh {
    let mut mesh = block(Kind::Hexahedra, n, place);
    for patch in &mut mesh.patches {
        patch.kind = kinds(&patch.name);
    }
    mesh
}

#[test]
fn a_plane_of_symmetry_is_a_mirror() {
    // half of the box, mirrored at x = 1, against the whole one
    let half = sides([4, 3, 2], |name| if name == "right" { PatchKind::Symmetry } else { PatchKind::Wall }, |x| x);
    let whole = block(Kind::Hexahedra, [8, 3, 2], |x| [2.0 * x[0], x[1], x[2]]);
    let u = |x: Vec3| [(1.0 - x[0]) * x[1], 0.3 * (1.0 - x[0]) * (1.0 - x[0]), 0.0];
    let (half, whole) = (domain(&with_velocity(half, u)), domain(&with_velocity(whole, u)));
    let starts = starts(20, 13, 4.0);
    let d = floating(Drag::None);
    let (got, want) = (fly(&half, &d, bounce(0.8), 1.0, &starts), fly(&whole, &d, bounce(0.8), 1.0, &starts));
    let mut crossed = 0;
    for (got, want) in got.ends.iter().zip(&want.ends) {
        let x = want.position;
        crossed += usize::from(x[0] > 1.0);
        let folded = [if x[0] > 1.0 { 2.0 - x[0] } else { x[0] }, x[1], x[2]];
        let off = crate::vector::norm(crate::vector::sub(got.position, folded));
        assert!(off < 5e-6, "{}: {off:e} {:?} {folded:?}", got.particle.number, got.position);
    }
    assert!(crossed > 3, "{crossed}");
}

#[test]
fn cyclic_patches_carry_over() {
    let kind = |partner, by| PatchKind::Cyclic { partner, carry: Carry::by([by, 0.0, 0.0]) };
    goes_on_as_the_long_one(kind, |x| x, |x| [9.0 * x[1] * (1.0 - x[1]), 0.0, 0.2]);
}

#[test]
fn cyclic_patches_whose_faces_do_not_match_carry_over() {
    let kind = |partner, by| PatchKind::CyclicAmi { partner, carry: Carry::by([by, 0.0, 0.0]) };
    // the points of the right side are not those of the left one; an even flow is the same on any cells
    let place = |x: Vec3| [x[0], x[1] + 0.4 * x[0] * x[1] * (1.0 - x[1]), x[2] - 0.3 * x[0] * x[2] * (1.0 - x[2])];
    goes_on_as_the_long_one(kind, place, |_| [3.0, 0.4, 0.2]);
}

/// A box that goes on from right to left, with `place` for its points, against four of it in a row.
fn goes_on_as_the_long_one(
    kind: impl Fn(usize, f64) -> PatchKind,
    place: impl Fn(Vec3) -> Vec3,
    u: impl Fn(Vec3) -> Vec3,
) {
    let kinds = |name: &str| match name {
        "left" => kind(1, 1.0),
        "right" => kind(0, -1.0),
        _ => PatchKind::Wall,
    };
    let one = sides([4, 3, 2], kinds, place);
    let four = block(Kind::Hexahedra, [16, 3, 2], |x| [4.0 * x[0] - 1.0, x[1], x[2]]);
    let (one, four) = (domain(&with_velocity(one, &u)), domain(&with_velocity(four, &u)));
    let starts = starts(20, 14, 2.0);
    let d = floating(Drag::SchillerNaumann);
    let (got, want) = (fly(&one, &d, bounce(0.8), 0.4, &starts), fly(&four, &d, bounce(0.8), 0.4, &starts));
    let mut crossed = 0;
    for (got, want) in got.ends.iter().zip(&want.ends) {
        let x = want.position;
        crossed += usize::from(!(0.0..1.0).contains(&x[0]));
        let off = crate::vector::norm(crate::vector::sub(got.position, [x[0].rem_euclid(1.0), x[1], x[2]]));
        assert!(off < 5e-6, "{}: {off:e}", got.particle.number);
    }
    assert!(crossed > 3, "{crossed}");
}

#[test]
fn a_plane_case_goes_on_across() {
    // one cell deep, and spheres that move across it for ever
    let kinds = |name: &str| if matches!(name, "back" | "front") { PatchKind::Empty } else { PatchKind::Wall };
    let plane = sides([5, 4, 1], kinds, |x| [x[0], x[1], 0.01 * x[2]]);
    let deep = block(Kind::Hexahedra, [5, 4, 3], |x| [x[0], x[1], 9.0 * x[2] - 4.5]);
    let u = |x: Vec3| [x[1], 0.5 * x[0], 0.0];
    let (plane, deep) = (domain(&with_velocity(plane, u)), domain(&with_velocity(deep, u)));
    let starts = starts(20, 15, 2.0);
    let d = floating(Drag::SchillerNaumann);
    let (got, want) = (fly(&plane, &d, Behavior::Escape, 1.0, &starts), fly(&deep, &d, Behavior::Escape, 1.0, &starts));
    for (got, want) in got.ends.iter().zip(&want.ends) {
        assert_eq!(got.fate, want.fate);
        let off = crate::vector::norm(crate::vector::sub(got.position, want.position));
        assert!(off < 1e-5, "{}: {off:e} {:?} {:?}", got.particle.number, got.position, want.position);
    }
}

#[test]
fn a_wedge_goes_on_round_its_axis() {
    // 5 degrees of a pipe of 1 m, along x; spheres fly as in the whole pipe
    let half = 2.5f64.to_radians();
    let kinds = |name: &str| match name {
        "back" | "front" => PatchKind::Wedge,
        "bottom" => PatchKind::Wall,
        _ => PatchKind::Wall,
    };
    let place = |x: Vec3| {
        let (r, turn) = (x[1], (2.0 * x[2] - 1.0) * half);
        let (s, c) = carom::math::sin_cos(turn);
        [2.0 * x[0], r * c, r * s]
    };
    let mut mesh = sides([6, 8, 1], kinds, place);
    // the axis is no patch
    mesh.patches[2].kind = PatchKind::Empty;
    let empty = mesh.patches[2].faces.clone();
    drop_faces(&mut mesh, empty);
    let cells = Arc::new(Cells::new(&with_velocity(mesh, |_| [1.0, 0.0, 0.0])).unwrap());
    let outer = cells.patches().iter().find(|p| p.name == "top").unwrap();
    let wall = |name: &str| {
        let patch = cells.patches().iter().find(|p| p.name == name).unwrap();
        Wall { patch: Some(name.into()), ..Wall::new(name, Shape::Mesh(Mesh::new(&cells.wall(patch)).unwrap())) }
    };
    assert!(!outer.faces.is_empty());
    let domain = AnyDomain::new(Flow::Cells(cells.clone()), vec![wall("left"), wall("right"), wall("top")]);
    let d = floating(Drag::None);
    let mut dice = Dice::new(6);
    for i in 0..160 {
        let (r, v) = (0.1 + 0.7 * dice.roll(), dice.point().map(|c| 2.0 * c - 1.0));
        // in the middle plane, a few straight through the axis
        let beside = 10f64.powi(-(i as i32 % 16));
        let v = if i % 4 == 1 {
            // past the axis at any distance
            [0.1 * v[0], -1.0, beside * v[2]]
        } else if i % 4 == 0 {
            [0.1 * v[0], -v[1].abs() - 0.1, 0.0]
        } else {
            [0.1 * v[0], v[1], v[2]]
        };
        let start = Particle::sphere(i, 1e-6, 1000.0, [1.0, r, 0.0], v);
        let log = fly(&domain, &d, Behavior::Escape, 0.8, &[start]);
        let end = log.ends[0];
        let free = [0, 1, 2].map(|c| start.position[c] + end.time * v[c]);
        let radius = |x: Vec3| (x[1] * x[1] + x[2] * x[2]).sqrt();
        assert_ne!(end.fate, ParticleFate::Stuck, "{i} {start:?}");
        assert!((radius(end.position) - radius(free)).abs() < 1e-7, "{i} {} {}", radius(end.position), radius(free));
        assert!((end.position[0] - free[0]).abs() < 1e-7);
        if end.fate == ParticleFate::Escaped {
            // the wall is a polygon: between r cos 2.5° and r
            assert!(radius(free) > half.cos() - 1e-6 && radius(free) < 1.0 + 1e-6, "{i} {}", radius(free));
        }
    }
}

/// Takes faces of no area out of a mesh.
pub(super) fn drop_faces(mesh: &mut carom_cfd::Mesh, faces: std::ops::Range<usize>) {
    let keep: Vec<usize> = (0..mesh.faces.len()).filter(|f| !faces.contains(f)).collect();
    let mut kept = carom_cfd::Polygons { starts: vec![0], corners: Vec::new() };
    for f in &keep {
        kept.corners.extend(mesh.faces.get(*f));
        kept.starts.push(kept.corners.len() as u32);
    }
    mesh.owner = keep.iter().map(|f| mesh.owner[*f]).collect();
    mesh.faces = kept;
    let gone = faces.len();
    mesh.patches.retain(|p| p.faces != faces);
    for patch in mesh.patches.iter_mut().filter(|p| p.faces.start >= faces.end) {
        patch.faces = patch.faces.start - gone..patch.faces.end - gone;
    }
}

#[test]
fn the_same_bits_whatever_the_lanes() {
    let mesh = domain(&with_cell_velocity(shaken(Kind::Polyhedra, [6, 5, 4], 0.2, 4), rolls));
    let (d, starts) = (floating(Drag::SchillerNaumann), starts(25, 3, 2.0));
    let behaviors = vec![bounce(0.7); SIDES.len()];
    let tracker =
        Tracker { domain: &mesh, dynamics: &d, behaviors: &behaviors, settings: Settings { until: 0.3, ..settings() } };
    let run = |plain: bool| {
        let mut log = Log::default();
        if plain {
            tracker.run_plain(&mut starts.iter().copied(), &mut log).unwrap();
        } else {
            tracker.run(&mut starts.iter().copied(), &mut log).unwrap();
        }
        log.ends.sort_by_key(|e| e.particle.number);
        log.ends
            .iter()
            .map(|e| (e.position.map(f64::to_bits), e.velocity.map(f64::to_bits), e.steps))
            .collect::<Vec<_>>()
    };
    assert_eq!(run(false), run(true));
    assert!(matches!(mesh, AnyDomain::Meshed(Meshed { .. })));
    let _: &Walls = mesh.geometry();
}
