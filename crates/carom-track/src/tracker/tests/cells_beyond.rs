//! Where the space goes on beyond the sides of a mesh: mirrors, cyclic patches, plane cases, wedges.

use super::cells::{domain, floating, fly, starts};
use super::*;
use crate::domain::Carry;
use crate::flow::Cells;
use crate::flow::cells::tests::{Dice, with_velocity};
use crate::vector::{norm, sub};
use carom_cfd::PatchKind;
use carom_cfd::block::{Kind, block};
use std::sync::Arc;

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

#[test]
fn cyclic_patches_a_rounding_apart_carry_over() {
    // carried points lie 1e-7 of the mesh outside
    let kind = |partner, by: f64| PatchKind::Cyclic { partner, carry: Carry::by([(1.0 + 1e-7) * by, 0.0, 0.0]) };
    goes_on_as_the_long_one(kind, |x| x, |x| [9.0 * x[1] * (1.0 - x[1]), 0.0, 0.2]);
}

#[test]
fn chords_that_do_not_coincide_carry_over() {
    // both sides are arcs of the same bow, cut into three chords at other places: as the sides of a rotor that has turned
    let place = |x: Vec3| {
        let y = x[1] + 0.4 * x[0] * x[1] * (1.0 - x[1]);
        [x[0] + 0.4 * y * (1.0 - y), y, x[2]]
    };
    let kinds = |name: &str| match name {
        "left" => PatchKind::CyclicAmi { partner: 1, carry: Carry::by([1.0, 0.0, 0.0]) },
        "right" => PatchKind::CyclicAmi { partner: 0, carry: Carry::by([-1.0, 0.0, 0.0]) },
        _ => PatchKind::Wall,
    };
    // along the bow, so that spheres go in and out of its chords, and across
    for u in [[0.1, 1.0, 0.0], [3.0, 0.4, 0.2]] {
        let mesh = domain(&with_velocity(sides([4, 3, 2], kinds, place), |_| u));
        let row = domain(&with_velocity(block(Kind::Hexahedra, [16, 3, 2], |x| [8.0 * x[0] - 4.0, x[1], x[2]]), |_| u));
        // in the middle of the box and beside its seam
        let all: Vec<Particle> = (0..200)
            .map(|i| {
                let (a, b) = (f64::from(i) / 200.0, f64::from(i % 20) / 20.0);
                Particle::sphere(i as u64, 40e-6, 2000.0, [0.35 + 0.7 * b, 0.1 + 0.8 * a, 0.47], u)
            })
            .collect();
        let cells = Cells::new(&with_velocity(sides([4, 3, 2], kinds, place), |_| u)).unwrap();
        let starts: Vec<Particle> = all.into_iter().filter(|p| cells.holds(p.position)).collect();
        assert!(starts.len() > 100);
        let d = floating(Drag::SchillerNaumann);
        let (got, want) = (fly(&mesh, &d, bounce(0.8), 0.4, &starts), fly(&row, &d, bounce(0.8), 0.4, &starts));
        for (got, want) in got.ends.iter().zip(&want.ends) {
            assert_eq!(got.fate, want.fate, "{got:?}");
            let [x, y, z] = sub(got.position, want.position);
            // the gaps are up to 0.02 wide, and gone over once or more
            assert!(norm([x - x.round(), y, z]) < 0.1, "{got:?} {want:?}");
        }
    }
}

/// Two blocks with 2 and with 6 faces between them, stored; bent, these are chords of one bow that lie beside each other, as where a rotor has turned.
#[test]
fn chords_of_bodies_that_touch_carry_over() {
    let case = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../carom-cfd/tests/cases/ami");
    let ways = [[1.0, 0.1, 0.05], [-1.0, 0.3, 0.0], [0.05, 0.6, 0.3], [-0.05, -0.6, 0.3]];
    for (bow, u) in [1.0, -0.6].into_iter().flat_map(|bow| ways.map(|u| (bow, u))) {
        let mut mesh = carom_cfd::openfoam::read(&case, &carom_cfd::openfoam::Options::default()).unwrap().mesh;
        for x in &mut mesh.points {
            x[0] += 0.4 * bow * (x[1] * (1.0 - x[1]) + x[2] * (1.0 - x[2]));
        }
        let snapshot = with_velocity(mesh, |_| u);
        let cells = Cells::new(&snapshot).unwrap();
        let mut dice = Dice::new(5);
        let places = (0..400).map(|_| dice.point()).map(|x| [0.2 + 1.8 * x[0], x[1], x[2]]).filter(|x| cells.holds(*x));
        let starts: Vec<Particle> = (0..).zip(places).map(|(i, x)| Particle::sphere(i, 40e-6, 2000.0, x, u)).collect();
        assert!(starts.len() > 300);
        let mesh = domain(&snapshot);
        let behaviors = vec![Behavior::Trap; mesh.walls().len()];
        let settings = Settings { until: 1.5, max_steps: 500, ..settings() };
        let d = floating(Drag::SchillerNaumann);
        let tracker = Tracker { domain: &mesh, dynamics: &d, behaviors: &behaviors, settings };
        let mut log = Log::default();
        tracker.run(&mut starts.iter().copied(), &mut log).unwrap();
        assert_eq!(log.ends.len(), starts.len());
        let mut worst = 0.0f64;
        for end in &log.ends {
            assert!(end.fate != ParticleFate::Stuck && end.steps < 500, "{bow} {u:?}: {end:?}");
            let straight = crate::vector::add(end.particle.position, crate::vector::scale(u, end.time));
            let [x, y, z] = sub(end.position, straight);
            worst = worst.max(norm([x - 2.0 * (x / 2.0).round(), y, z]));
        }
        // gaps are up to 0.1 wide, and gone over by twice as much, once or more
        assert!(worst < 0.25 * f64::abs(bow), "{bow} {u:?}: {worst}");
    }
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
    let mesh = wedge([6, 8, 1], kinds, [2.0, 1.0], half);
    let cells = Arc::new(Cells::new(&with_velocity(mesh, |_| [1.0, 0.0, 0.0])).unwrap());
    let outer = cells.patches().iter().find(|p| p.name == "top").unwrap();
    let wall = |name: &str| {
        let patch = cells.patches().iter().find(|p| p.name == name).unwrap();
        Wall { patch: Some(name.into()), ..Wall::new(name, Shape::Mesh(cells.wall(patch).unwrap())) }
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

/// A wedge round x, of that length and radius (m) and that half of its angle; its axis is no patch.
pub(super) fn wedge(
    n: [usize; 3],
    kinds: impl Fn(&str) -> PatchKind,
    [length, radius]: [f64; 2],
    half: f64,
) -> carom_cfd::Mesh {
    let place = |x: Vec3| {
        let (s, c) = carom::math::sin_cos((2.0 * x[2] - 1.0) * half);
        [length * x[0], radius * x[1] * c, radius * x[1] * s]
    };
    let mut mesh = sides(n, kinds, place);
    let axis = mesh.patches[2].faces.clone();
    drop_faces(&mut mesh, axis);
    mesh
}

/// Takes faces of no area out of a mesh.
fn drop_faces(mesh: &mut carom_cfd::Mesh, faces: std::ops::Range<usize>) {
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

/// Height of a floor with valleys at whole x, steeper on their left: there it is the nearer side for a while to the right of them too.
fn valley(x: f64) -> f64 {
    let along = x.rem_euclid(1.0);
    (0.6 * along).min(1.8 * (1.0 - along))
}

/// Spheres of 0.1 m in a channel with valleys, one of which goes on from right to left, or four in a row.
fn into_valleys(kind: fn(usize, f64) -> PatchKind, deep: bool) {
    let shape = |x: [f64; 3]| [x[0], valley(x[0]) + x[1] * (1.0 - valley(x[0])), x[2]];
    let kinds = |name: &str| match name {
        "left" => kind(1, 1.0),
        "right" => kind(0, -1.0),
        "back" | "front" if !deep => PatchKind::Empty,
        _ => PatchKind::Wall,
    };
    let layers = if deep { 2 } else { 1 };
    let one = sides([4, 3, layers], kinds, shape);
    let long = |name: &str| if deep { PatchKind::Wall } else { kinds(name) };
    let long = |name: &str| if matches!(name, "left" | "right") { PatchKind::Wall } else { long(name) };
    let four = sides([16, 3, layers], long, |x| shape([4.0 * x[0] - 1.0, x[1], x[2]]));
    let (one, four) = (domain(&with_velocity(one, |_| [0.0; 3])), domain(&with_velocity(four, |_| [0.0; 3])));
    let mut dice = Dice::new(21);
    let mut start = |i| {
        let near = if i % 2 == 0 { 0.1 } else { 0.99 };
        let x = [0.005 + near * dice.roll(), 0.75, 0.2 + 0.6 * dice.roll()];
        Particle::sphere(i, 0.1, 2000.0, x, [1.6 * dice.roll() - 0.8, -3.0, 0.4 * dice.roll() - 0.2])
    };
    let starts: Vec<Particle> = (0..60).map(&mut start).collect();
    let d = floating(Drag::None);
    let (got, want) = (fly(&one, &d, bounce(0.8), 0.3, &starts), fly(&four, &d, bounce(0.8), 0.3, &starts));
    assert_eq!((got.impacts.len(), got.stalled), (want.impacts.len(), 0));
    let first = |log: &Log, i: u64| log.impacts.iter().find(|hit| hit.particle == i).copied();
    let mut beyond = 0;
    for i in 0..starts.len() as u64 {
        let (Some(got), Some(want)) = (first(&got, i), first(&want, i)) else { continue };
        let off = norm(sub(got.position, [want.position[0].rem_euclid(1.0), want.position[1], want.position[2]]));
        assert!(off < 1e-9 && (got.time - want.time).abs() < 1e-9, "{i}: {off:e} {got:?} {want:?}");
        assert!(norm(sub(got.normal, want.normal)) < 1e-9, "{i}: {got:?} {want:?}");
        // the floor on the right of a valley has a normal that leans to the left
        beyond += usize::from(got.position[0] < 0.5 && got.normal[0] > 0.1);
    }
    assert!(beyond > 3, "{beyond}");
    for (got, want) in got.ends.iter().zip(&want.ends) {
        let off = norm(sub(got.position, [want.position[0].rem_euclid(1.0), want.position[1], want.position[2]]));
        assert!(off < 1e-6, "{}: {off:e}", got.particle.number);
    }
}

#[test]
fn a_wall_behind_a_cyclic_patch_is_touched_from_this_side() {
    let cyclic = |partner, by| PatchKind::Cyclic { partner, carry: Carry::by([by, 0.0, 0.0]) };
    let by_interpolation = |partner, by| PatchKind::CyclicAmi { partner, carry: Carry::by([by, 0.0, 0.0]) };
    into_valleys(cyclic, true);
    into_valleys(cyclic, false);
    into_valleys(by_interpolation, true);
}
