//! Points of a mesh beyond which the space goes on, and what holds of fields there: one value on both of a pair of cyclic patches, nothing
//! across a plane of symmetry. A field that broke it would jump there, or press spheres onto the seam from both sides.

use crate::vector::{Vec3, dot, scale, sub, unit};
use carom_cfd::{Carry, Mesh, PatchKind};
use std::collections::{BTreeMap, HashMap};

/// The points on seams.
#[derive(Debug)]
pub(super) struct Seams {
    /// Points on each pair of cyclic patches: one on a patch, that on its partner, and how it is carried there.
    pairs: Vec<(u32, u32, Carry)>,
    /// Points on planes of symmetry, each with the normals of its planes.
    mirrors: Vec<(u32, Vec3)>,
    /// Points on the sides of a wedge likewise: mirrors of what has no swirl.
    sides: Vec<(u32, Vec3)>,
}

/// Places on cyclic patches, by their bits, and those of their partners, m.
pub(super) type Places = HashMap<[u64; 3], Vec3>;

/// Normals whose cosine differs less from one are those of one plane.
const SAME: f64 = 1e-6;

impl Seams {
    /// Those of a mesh, from the areas of its faces.
    pub fn new(mesh: &Mesh, areas: &[Vec3]) -> Self {
        let of = |kind| normals(mesh, areas, kind);
        let (mirrors, sides) = (of(&PatchKind::Symmetry), of(&PatchKind::Wedge));
        Self { pairs: super::beyond::pairs(mesh), mirrors, sides }
    }

    /// Joins values of the two points of each pair; `add` gives that of both from one's own and the other's, carried by `turn`.
    pub fn join<T: Copy>(&self, values: &mut [T], turn: impl Fn(&Carry, T) -> T, add: impl Fn(T, T) -> T) {
        for (from, to, carry) in &self.pairs {
            let (a, b) = (values[*from as usize], values[*to as usize]);
            let (there, back) = (turn(carry, a), turn(&carry.inverse(), b));
            values[*from as usize] = add(a, back);
            values[*to as usize] = add(there, b);
        }
    }

    /// Where the partners of the points on cyclic patches are.
    pub fn places(&self, place: impl Fn(u32) -> Vec3) -> Places {
        let both = self.pairs.iter().flat_map(|(from, to, _)| [(*from, *to), (*to, *from)]);
        both.map(|(from, to)| (place(from).map(f64::to_bits), place(to))).collect()
    }

    /// A velocity less what leads through planes of symmetry, at the points on them.
    pub fn along_mirrors(&self, velocity: &mut [Vec3]) {
        along(&self.mirrors, velocity);
    }

    /// Directions of what has no swirl less what leads through planes of symmetry and sides of a wedge.
    pub fn along_all(&self, directions: &mut [Vec3]) {
        along(&self.mirrors, directions);
        along(&self.sides, directions);
    }
}

/// Points of patches of a kind, each with the different normals of the faces around it.
fn normals(mesh: &Mesh, areas: &[Vec3], kind: &PatchKind) -> Vec<(u32, Vec3)> {
    let mut found = BTreeMap::<u32, Vec<Vec3>>::new();
    for face in mesh.patches.iter().filter(|p| p.kind == *kind).flat_map(|p| p.faces.clone()) {
        let Some(n) = unit(areas[face]) else { continue };
        for point in mesh.faces.get(face) {
            let known = found.entry(*point).or_default();
            if known.iter().all(|k| dot(*k, n).abs() < 1.0 - SAME) {
                known.push(n);
            }
        }
    }
    found.into_iter().flat_map(|(point, normals)| normals.into_iter().map(move |n| (point, n))).collect()
}

fn along(points: &[(u32, Vec3)], vectors: &mut [Vec3]) {
    for (point, n) in points {
        let v = &mut vectors[*point as usize];
        *v = sub(*v, scale(*n, dot(*v, *n)));
    }
}
