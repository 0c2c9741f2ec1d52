//! A block of cells of a given kind, for trials and tests: what comes out of a domain must not depend on how it is cut.

use crate::{Mesh, Patch, PatchKind, Polygons};
use std::collections::BTreeMap;

/// What the cells of a block are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Bricks.
    Hexahedra,
    /// Bricks halved along z.
    Prisms,
    /// Bricks in six tetrahedra round a diagonal.
    Tetrahedra,
    /// Bricks in six pyramids round their middles.
    Pyramids,
    /// Pairs of bricks with a common side cut out, ten faces each.
    Polyhedra,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Hexahedra, Self::Prisms, Self::Tetrahedra, Self::Pyramids, Self::Polyhedra];
}

/// Names of a block's patches, in order.
pub const SIDES: [&str; 6] = ["left", "right", "bottom", "top", "back", "front"];

/// The block from 0 to 1 along each axis in `n` bricks, cut into cells of a kind, each point then put to where `place` says.
/// Its patches are [`SIDES`]: x = 0 and 1, y, z. Points of the six sides of the cube must stay on smooth surfaces for patches to make sense.
pub fn block(kind: Kind, n: [usize; 3], place: impl Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    let at = |i: usize, j: usize, k: usize| ((k * (n[1] + 1) + j) * (n[0] + 1) + i) as u32;
    let mut unit = Vec::new();
    for (k, j, i) in grid([n[2] + 1, n[1] + 1, n[0] + 1]) {
        unit.push([i as f64 / n[0] as f64, j as f64 / n[1] as f64, k as f64 / n[2] as f64]);
    }
    let mut cells: Vec<Vec<Vec<u32>>> = Vec::new();
    for (k, j, i) in grid([n[2], n[1], n[0]]) {
        let c = [0, 1, 2, 3, 4, 5, 6, 7].map(|m: usize| at(i + (m & 1), j + (m >> 1 & 1), k + (m >> 2 & 1)));
        match kind {
            Kind::Hexahedra => cells.push(brick(&c)),
            Kind::Prisms => {
                // halves on either side of the diagonal from corner 0 to corner 3
                cells.push(prism([c[0], c[1], c[3]], [c[4], c[5], c[7]]));
                cells.push(prism([c[0], c[3], c[2]], [c[4], c[7], c[6]]));
            }
            Kind::Tetrahedra => {
                for [a, b] in [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]] {
                    cells.push(tetrahedron([c[0], c[a], c[b], c[7]]));
                }
            }
            Kind::Pyramids => {
                let middle = unit.len() as u32;
                unit.push([0, 1, 2].map(|d| 0.5 * (unit[c[0] as usize][d] + unit[c[7] as usize][d])));
                for side in brick(&c) {
                    let mut faces: Vec<Vec<u32>> = (0..4).map(|m| vec![side[m], side[(m + 1) % 4], middle]).collect();
                    faces.push(side);
                    cells.push(faces);
                }
            }
            Kind::Polyhedra => {
                let faces = brick(&c);
                // a brick of even place takes its right neighbour in
                if i % 2 == 1 {
                    let before = cells.len() - 1;
                    let pair = &mut cells[before];
                    pair.retain(|f| !same(f, &faces[0]));
                    pair.extend(faces.into_iter().skip(1));
                } else {
                    cells.push(faces);
                }
            }
        }
    }
    assemble(unit, &cells, place)
}

fn grid([a, b, c]: [usize; 3]) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..a).flat_map(move |i| (0..b).flat_map(move |j| (0..c).map(move |k| (i, j, k))))
}

fn brick(c: &[u32; 8]) -> Vec<Vec<u32>> {
    const FACES: [[usize; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    FACES.iter().map(|f| f.iter().map(|m| c[*m]).collect()).collect()
}

fn prism(low: [u32; 3], high: [u32; 3]) -> Vec<Vec<u32>> {
    let side = |m: usize| vec![low[m], low[(m + 1) % 3], high[(m + 1) % 3], high[m]];
    vec![vec![low[0], low[2], low[1]], high.to_vec(), side(0), side(1), side(2)]
}

fn tetrahedron(c: [u32; 4]) -> Vec<Vec<u32>> {
    [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
        .iter()
        .map(|f: &[usize; 3]| f.iter().map(|m| c[*m]).collect())
        .collect()
}

fn same(a: &[u32], b: &[u32]) -> bool {
    a.len() == b.len() && a.iter().all(|p| b.contains(p))
}

/// Faces found by their corners; those of one cell alone are sorted onto the sides of the cube.
fn assemble(unit: Vec<[f64; 3]>, cells: &[Vec<Vec<u32>>], place: impl Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    let mut found: BTreeMap<Vec<u32>, (Vec<u32>, Vec<u32>)> = BTreeMap::new();
    for (number, faces) in (0..).zip(cells) {
        for face in faces {
            let mut key = face.clone();
            key.sort_unstable();
            found.entry(key).or_insert_with(|| (face.clone(), Vec::new())).1.push(number);
        }
    }
    let mut mesh = Mesh { cells: cells.len(), ..Mesh::default() };
    mesh.faces.starts.push(0);
    let add = |mesh: &mut Mesh, face: &[u32], of: &[u32]| {
        mesh.faces.corners.extend(face);
        mesh.faces.starts.push(mesh.faces.corners.len() as u32);
        mesh.owner.push(of[0]);
        mesh.neighbour.extend(of.get(1));
    };
    for (face, of) in found.values().filter(|(_, of)| of.len() == 2) {
        add(&mut mesh, face, of);
    }
    for (side, name) in SIDES.iter().enumerate() {
        let (axis, level) = (side / 2, (side % 2) as f64);
        let on = |face: &[u32]| face.iter().all(|p| unit[*p as usize][axis] == level);
        let begin = mesh.owner.len();
        for (face, of) in found.values().filter(|(face, of)| of.len() == 1 && on(face)) {
            add(&mut mesh, face, of);
        }
        let faces = begin..mesh.owner.len();
        mesh.patches.push(Patch { name: (*name).to_owned(), groups: Vec::new(), kind: PatchKind::Wall, faces });
    }
    mesh.points = unit.into_iter().map(place).collect();
    orient(&mut mesh, cells);
    mesh
}

/// Turns each face so that it points out of its owner.
fn orient(mesh: &mut Mesh, cells: &[Vec<Vec<u32>>]) {
    let middle = |corners: &mut dyn Iterator<Item = u32>| {
        let (sum, count) = corners
            .fold(([0.0; 3], 0.0f64), |(s, n), p| ([0, 1, 2].map(|c| s[c] + mesh.points[p as usize][c]), n + 1.0));
        sum.map(|c| c / count)
    };
    let centres: Vec<[f64; 3]> = cells.iter().map(|c| middle(&mut c.iter().flatten().copied())).collect();
    let turn: Vec<bool> = (0..mesh.owner.len())
        .map(|f| {
            let face = mesh.faces.get(f);
            let m = middle(&mut face.iter().copied());
            let area = (0..face.len()).fold([0.0; 3], |sum, i| {
                let [a, b] = [face[i], face[(i + 1) % face.len()]].map(|p| {
                    let x = mesh.points[p as usize];
                    [0, 1, 2].map(|c| x[c] - m[c])
                });
                [0, 1, 2].map(|c: usize| {
                    let (i, j) = ((c + 1) % 3, (c + 2) % 3);
                    sum[c] + a[i] * b[j] - a[j] * b[i]
                })
            });
            let out = centres[mesh.owner[f] as usize];
            (0..3).map(|c| area[c] * (m[c] - out[c])).sum::<f64>() < 0.0
        })
        .collect();
    let Polygons { starts, corners } = &mut mesh.faces;
    for (f, _) in turn.iter().enumerate().filter(|(_, turn)| **turn) {
        corners[starts[f] as usize..starts[f + 1] as usize].reverse();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_fills_the_block() {
        for kind in Kind::ALL {
            let mesh = block(kind, [4, 3, 2], |x| [2.0 * x[0], x[1], 3.0 * x[2]]);
            let pieces = match kind {
                Kind::Hexahedra => 24,
                Kind::Prisms => 48,
                Kind::Tetrahedra | Kind::Pyramids => 144,
                Kind::Polyhedra => 12,
            };
            assert_eq!(mesh.cells, pieces, "{kind:?}");
            // the volume by the divergence theorem, over the boundary
            let mut volume = 0.0;
            for f in mesh.inner_faces()..mesh.owner.len() {
                let face: Vec<[f64; 3]> = mesh.faces.get(f).iter().map(|p| mesh.points[*p as usize]).collect();
                for w in face[1..].windows(2) {
                    let (a, b, c) = (face[0], w[0], w[1]);
                    volume += (a[0] * (b[1] * c[2] - b[2] * c[1])
                        + a[1] * (b[2] * c[0] - b[0] * c[2])
                        + a[2] * (b[0] * c[1] - b[1] * c[0]))
                        / 6.0;
                }
            }
            assert!((volume - 6.0).abs() < 1e-12, "{kind:?} {volume}");
            let total: usize = mesh.patches.iter().map(|p| p.faces.len()).sum();
            assert_eq!(total + mesh.inner_faces(), mesh.owner.len());
        }
    }
}
