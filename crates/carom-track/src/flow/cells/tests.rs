use super::*;
use carom_cfd::block::{Kind, block};
use carom_cfd::{Fields, Mesh};

/// Draws of numbers from 0 to 1 that are the same everywhere.
pub(crate) struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn point(&mut self) -> Vec3 {
        [self.roll(), self.roll(), self.roll()]
    }
}

/// A block whose inner points are moved by a share of the cells.
pub(crate) fn shaken(kind: Kind, n: [usize; 3], share: f64, seed: u64) -> Mesh {
    let mut mesh = block(kind, n, |x| x);
    let mut dice = Dice::new(seed);
    for x in &mut mesh.points {
        let by = dice.point();
        for c in 0..3 {
            if x[c] > 0.0 && x[c] < 1.0 {
                x[c] += share * (2.0 * by[c] - 1.0) / n[c] as f64;
            }
        }
    }
    mesh
}

/// A result with a velocity at every point.
pub(crate) fn with_velocity(mesh: Mesh, velocity: impl Fn(Vec3) -> Vec3) -> Snapshot {
    let field = Field::Points(mesh.points.iter().map(|x| velocity(*x)).collect());
    let fields = Fields { velocity: Some(field), ..Fields::default() };
    Snapshot { mesh, fields, time: None, notes: Vec::new() }
}

/// A result with a velocity in every cell and on every face of the boundary.
pub(crate) fn with_cell_velocity(mesh: Mesh, velocity: impl Fn(Vec3) -> Vec3) -> Snapshot {
    let (faces, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
    let (centres, _) = cell_centres_and_volumes(&mesh, &faces, &areas);
    let cells = centres.iter().map(|x| velocity(*x)).collect();
    let boundary = faces[mesh.inner_faces()..].iter().map(|x| velocity(*x)).collect();
    let fields = Fields { velocity: Some(Field::Cells { cells, boundary }), ..Fields::default() };
    Snapshot { mesh, fields, time: None, notes: Vec::new() }
}

fn close(a: Vec3, b: Vec3, by: f64) -> bool {
    norm(sub(a, b)) < by
}

#[test]
fn a_uniform_and_a_linear_field_are_exact() {
    let u = |x: Vec3| [1.0 + 2.0 * x[0] - x[1], 0.5 * x[2], x[0] + x[1] - 3.0 * x[2]];
    for kind in Kind::ALL {
        let cells = Cells::new(&with_velocity(block(kind, [4, 4, 2], |x| x), u)).unwrap();
        let mut dice = Dice::new(3);
        for _ in 0..200 {
            let x = dice.point();
            let here = cells.find(x);
            assert!(!here.is_nowhere(), "{kind:?} {x:?}");
            assert!(close(here.velocity_at(x), u(x), 1e-12), "{kind:?} {x:?}");
            let local = cells.sample_in(&here, x);
            assert!((local.gradient[0][0] - 2.0).abs() < 1e-10 && (local.gradient[2][2] + 3.0).abs() < 1e-10);
        }
        let uniform = Cells::new(&with_cell_velocity(shaken(kind, [4, 4, 2], 0.2, 5), |_| [1.0, 2.0, 3.0])).unwrap();
        for _ in 0..100 {
            assert!(close(uniform.velocity(dice.point()), [1.0, 2.0, 3.0], 1e-12));
        }
    }
}

#[test]
fn fields_are_continuous_across_tetrahedra() {
    let u = |x: Vec3| [x[1] * x[1], x[0] * x[2], 1.0 - x[0] * x[1]];
    for kind in Kind::ALL {
        for snapshot in
            [with_velocity, with_cell_velocity].map(|f: fn(Mesh, _) -> Snapshot| f(shaken(kind, [4, 3, 2], 0.2, 11), u))
        {
            let cells = Cells::new(&snapshot).unwrap();
            let mut dice = Dice::new(7);
            for _ in 0..10 {
                let (a, b) = (dice.point(), dice.point());
                let steps = 50;
                for i in 0..steps {
                    let at = |s: f64| [0, 1, 2].map(|c| a[c] + s * (b[c] - a[c]));
                    let (s, t) = (i as f64 / steps as f64, (i as f64 + 1e-6) / steps as f64);
                    // 2e-8 of the way on, the fluid is no faster than its steepest gradient makes it
                    let change = norm(sub(cells.velocity(at(s)), cells.velocity(at(t))));
                    assert!(change < 1e-5, "{kind:?} {:?} {change}", at(s));
                }
            }
        }
    }
}

#[test]
fn on_the_boundary_the_boundary_condition_holds() {
    // walls at rest below and above a stream
    let mut snapshot = with_cell_velocity(shaken(Kind::Polyhedra, [6, 5, 4], 0.2, 1), |_| [1.0, 0.0, 0.0]);
    let inner = snapshot.mesh.inner_faces();
    if let Some(Field::Cells { boundary, .. }) = &mut snapshot.fields.velocity {
        for patch in &snapshot.mesh.patches[2..4] {
            patch.faces.clone().for_each(|f| boundary[f - inner] = [0.0; 3]);
        }
    }
    let cells = Cells::new(&snapshot).unwrap();
    let mut dice = Dice::new(2);
    for _ in 0..200 {
        let x = dice.point();
        // away from the rims, where the sides' faces speak too
        let x = [0.25 + 0.5 * x[0], if x[1] < 0.5 { 0.0 } else { 1.0 }, 0.35 + 0.3 * x[2]];
        assert!(close(cells.velocity(x), [0.0; 3], 1e-12), "{x:?} {:?}", cells.velocity(x));
    }
}

#[test]
fn a_point_is_in_the_tetrahedron_found_and_none_is_found_outside() {
    for kind in Kind::ALL {
        let cells = Cells::new(&with_velocity(shaken(kind, [5, 4, 3], 0.3, 9), |x| x)).unwrap();
        let mut dice = Dice::new(4);
        for _ in 0..1000 {
            let x = dice.point();
            let here = cells.find(x);
            assert!(!here.is_nowhere(), "{kind:?} {x:?}");
            assert!(here.coordinates(x).iter().all(|l| *l > -1e-9));
        }
        for x in [[-1e-3, 0.5, 0.5], [0.5, 1.001, 0.5], [f64::NAN; 3]] {
            assert!(cells.find(x).is_nowhere());
        }
    }
}

/// What is known of some patches as solid walls, the others open.
fn between(cells: &Cells, solid: &[&str], nu: f64) -> NearWalls {
    use crate::geometry::{Shape, Wall};
    let wall =
        |p: &Patch| Wall { patch: Some(p.name.clone()), ..Wall::new(&p.name, Shape::Mesh(cells.wall(p).unwrap())) };
    let walls: Vec<Wall> = cells.patches().iter().map(wall).collect();
    let open: Vec<bool> = walls.iter().map(|w| !solid.contains(&w.name.as_str())).collect();
    NearWalls::new(cells, &walls, &open, nu).unwrap()
}

#[test]
fn distance_and_friction_of_a_wall_are_those_of_a_shear_flow() {
    // u = 3 y above the floor alone: u_τ = √(ν 3)
    let snapshot = with_cell_velocity(shaken(Kind::Polyhedra, [8, 5, 8], 0.15, 8), |x| [3.0 * x[1], 0.0, 0.0]);
    let cells = Cells::new(&snapshot).unwrap();
    let nu = 1.5e-5;
    let near = between(&cells, &["bottom"], nu);
    let mut dice = Dice::new(10);
    for _ in 0..200 {
        // away from the rims, where values of points know of the sides
        let x = dice.point();
        let x = [0.4 + 0.2 * x[0], x[1], 0.4 + 0.2 * x[2]];
        let here = cells.find(x);
        let mut local = cells.sample_in(&here, x);
        near.add(&cells, &here, x, &mut local);
        assert!((local.wall_distance - x[1]).abs() < 1e-12, "{x:?} {}", local.wall_distance);
        assert!(close(local.wall_normal, [0.0, 1.0, 0.0], 1e-9), "{:?}", local.wall_normal);
        assert!((local.friction_velocity / (nu * 3.0).sqrt() - 1.0).abs() < 1e-9, "{}", local.friction_velocity);
    }
}

#[test]
fn on_seams_the_direction_of_walls_is_that_of_the_whole_body() {
    // midway between floor and ceiling the direction is made of turned tetrahedra on one side of the seam alone
    for what in ["mirrors", "cyclic"] {
        let kind = |name: &str| match name {
            "left" | "right" if what == "mirrors" => PatchKind::Symmetry,
            "left" => PatchKind::Cyclic { partner: 1, carry: Carry::by([1.0, 0.0, 0.0]) },
            "right" => PatchKind::Cyclic { partner: 0, carry: Carry::by([-1.0, 0.0, 0.0]) },
            _ => PatchKind::Wall,
        };
        let mut mesh = block(Kind::Hexahedra, [4, 4, 3], |x| [x[0], x[1] + 0.3 * x[1] * (1.0 - x[1]) * x[2], x[2]]);
        for (at, x) in mesh.points.iter_mut().enumerate() {
            // inside, not the same on both sides
            if x[0] > 0.01 && x[0] < 0.99 {
                x[0] += 0.04 * (at as f64).sin();
            }
        }
        for patch in &mut mesh.patches {
            patch.kind = kind(&patch.name);
        }
        let cells = Cells::new(&with_velocity(mesh, |_| [0.5, 0.1, 0.0])).unwrap();
        let near = between(&cells, &["bottom", "top"], 1.5e-5);
        let at = |x: Vec3| {
            let here = cells.find(x);
            let mut local = cells.sample_in(&here, x);
            near.add(&cells, &here, x, &mut local);
            local
        };
        let mut dice = Dice::new(4);
        for _ in 0..100 {
            let [_, y, z] = dice.point().map(|c| 0.02 + 0.96 * c);
            let (a, b) = (at([1e-12, y, z]), at([1.0 - 1e-12, y, z]));
            assert!((a.wall_distance - b.wall_distance).abs() < 1e-9, "{what} {y} {z}");
            if what == "cyclic" {
                assert!(close(a.wall_normal, b.wall_normal, 1e-8), "{y} {z}: {:?} {:?}", a.wall_normal, b.wall_normal);
            } else {
                assert!(a.wall_normal[0].abs().max(b.wall_normal[0].abs()) < 1e-9, "{y} {z}: {:?}", a.wall_normal);
                assert!(a.velocity[0].abs().max(b.velocity[0].abs()) < 1e-9, "{y} {z}: {:?}", a.velocity);
            }
        }
    }
}

#[test]
fn a_density_that_is_not_positive_is_refused() {
    let mut snapshot = with_velocity(block(Kind::Hexahedra, [3, 2, 2], |x| x), |x| x);
    let points = snapshot.mesh.points.len();
    let with = |odd: f64| Field::Points((0..points).map(|i| [if i == 4 { odd } else { 1.2 }]).collect());
    snapshot.fields.density = Some(with(0.9));
    assert!(Cells::new(&snapshot).is_ok());
    for odd in [0.0, -0.1] {
        snapshot.fields.density = Some(with(odd));
        assert_eq!(Cells::new(&snapshot).unwrap_err(), CellsError::Density { least: odd });
    }
}

#[test]
fn the_direction_of_walls_does_not_jump_where_two_are_as_near() {
    // a floor and a side: a direction that jumped at the sides of tetrahedra would hold walking spheres there
    let nu = 1.5e-5;
    for kind in Kind::ALL {
        let cells = Cells::new(&with_velocity(shaken(kind, [6, 6, 4], 0.05, 3), |x| x)).unwrap();
        assert_eq!(cells.inverted(), 0, "{kind:?}");
        let near = between(&cells, &["bottom", "left"], nu);
        let normal = |x: Vec3| {
            let here = cells.find(x);
            let mut local = cells.sample_in(&here, x);
            near.add(&cells, &here, x, &mut local);
            (here.id, local.wall_normal)
        };
        let mut dice = Dice::new(21);
        let mut crossed = 0;
        for _ in 0..120 {
            let x = dice.point().map(|c| 0.1 + 0.8 * c);
            let there = dice.point().map(|c| 0.1 + 0.8 * c);
            // a crossing by bisection
            let ((mut a, mut b), first) = ((0.0, 1.0), normal(x).0);
            let at = |t: f64| add(x, crate::vector::scale(sub(there, x), t));
            for _ in 0..40 {
                let middle = 0.5 * (a + b);
                if normal(at(middle)).0 == first { a = middle } else { b = middle }
            }
            let ((from, n), (into, m)) = (normal(at(a)), normal(at(b)));
            if from != into {
                crossed += 1;
                assert!(close(n, m, 1e-8), "{kind:?} at {:?}: {n:?} {m:?}", at(a));
            }
        }
        assert!(crossed > 60, "{kind:?}: {crossed}");
    }
}
