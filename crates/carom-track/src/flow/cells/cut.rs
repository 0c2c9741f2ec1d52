//! Cells cut into tetrahedra: each face into a fan of triangles from its base point, each triangle joined to the centre of the cell
//! on either side, as OpenFOAM does it.
//!
//! The tetrahedron on the owner's side of triangle `t` has the number 2t, that on the other side 2t + 1. What they are made of is
//! kept (three corners a triangle, three neighbours a tetrahedron: 24 bytes each); the tetrahedra themselves are made when a sphere
//! enters one.

use carom_cfd::Mesh;
use carom_cfd::geometry::BasePoints;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering};

/// No tetrahedron.
pub(super) const NONE: u32 = u32::MAX;

/// The triangles of all faces and how tetrahedra lie beside each other.
#[derive(Debug)]
pub(super) struct Cut {
    /// Corners, numbers of points; turned as the face, out of its owner.
    pub triangles: Vec<[u32; 3]>,
    /// The face each is of.
    face_of: Vec<u32>,
    /// The first triangle of each face; one more entry than faces.
    pub first: Vec<u32>,
    /// Of each tetrahedron the one in the same cell behind the side that faces corner 0, 1, 2 of its triangle.
    beside: Vec<[AtomicU32; 3]>,
    /// Faces of each cell: where they begin, and what they are.
    cell_starts: Vec<u32>,
    cell_faces: Vec<u32>,
    owner: Vec<u32>,
    neighbour: Vec<u32>,
}

impl Cut {
    pub fn new(mesh: &Mesh, base: &BasePoints) -> Self {
        let faces = mesh.faces.len();
        let (mut triangles, mut face_of, mut first) = (Vec::new(), Vec::new(), Vec::with_capacity(faces + 1));
        first.push(0);
        for face in 0..faces {
            let corners = mesh.faces.get(face);
            let at = |i: usize| corners[(base.base[face] as usize + i) % corners.len()];
            for i in 1..corners.len() - 1 {
                triangles.push([at(0), at(i), at(i + 1)]);
                face_of.push(face as u32);
            }
            first.push(triangles.len() as u32);
        }
        let (cell_starts, cell_faces) = faces_of_cells(mesh);
        let mut beside = Vec::with_capacity(2 * triangles.len());
        beside.resize_with(2 * triangles.len(), || [const { AtomicU32::new(NONE) }; 3]);
        let (owner, neighbour) = (mesh.owner.clone(), mesh.neighbour.clone());
        let cut = Self { triangles, face_of, first, beside, cell_starts, cell_faces, owner, neighbour };
        (0..mesh.cells).into_par_iter().for_each_init(Vec::new, |edges, cell| cut.join(cell, edges));
        cut
    }

    /// Finds which tetrahedra of a cell share a side: those whose triangles share an edge.
    fn join(&self, cell: usize, edges: &mut Vec<(u64, u32, u32)>) {
        edges.clear();
        for &face in self.faces(cell) {
            let side = u32::from(self.owner[face as usize] as usize != cell);
            let (begin, end) = (self.first[face as usize], self.first[face as usize + 1]);
            for t in begin..end {
                let [a, b, c] = self.triangles[t as usize];
                let tet = 2 * t + side;
                // within the fan the next triangle is across the edge from the base point
                if t + 1 < end {
                    self.beside[tet as usize][1].store(tet + 2, Ordering::Relaxed);
                    self.beside[tet as usize + 2][2].store(tet, Ordering::Relaxed);
                }
                edges.push((edge(b, c), tet, 0));
                if t + 1 == end {
                    edges.push((edge(a, c), tet, 1));
                }
                if t == begin {
                    edges.push((edge(a, b), tet, 2));
                }
            }
        }
        edges.sort_unstable();
        for pair in edges.chunk_by(|a, b| a.0 == b.0) {
            // a cell that is not closed has edges of its own; what leaves it there is looked for
            if let [(_, p, i), (_, q, j)] = *pair {
                self.beside[p as usize][i as usize].store(q, Ordering::Relaxed);
                self.beside[q as usize][j as usize].store(p, Ordering::Relaxed);
            }
        }
    }

    /// The tetrahedron behind the side that faces a corner of the triangle, in the same cell; [`NONE`] where there is none.
    #[inline(always)]
    pub fn beside(&self, tet: u32, corner: usize) -> u32 {
        self.beside[tet as usize][corner].load(Ordering::Relaxed)
    }

    /// Puts a tetrahedron behind a side.
    pub fn put_beside(&mut self, tet: u32, corner: usize, next: u32) {
        *self.beside[tet as usize][corner].get_mut() = next;
    }

    /// The tetrahedron across a triangle of a face, and its cell; `None` on the boundary.
    #[inline(always)]
    pub fn across(&self, tet: u32, face: usize) -> Option<(u32, u32)> {
        let neighbour = *self.neighbour.get(face)?;
        Some((tet ^ 1, if tet & 1 == 0 { neighbour } else { self.owner[face] }))
    }

    /// The face of a tetrahedron's triangle.
    #[inline(always)]
    pub fn face(&self, tet: u32) -> u32 {
        self.face_of[(tet >> 1) as usize]
    }

    /// The cell of a tetrahedron.
    #[inline(always)]
    pub fn cell(&self, tet: u32) -> u32 {
        let face = self.face(tet) as usize;
        if tet & 1 == 0 { self.owner[face] } else { self.neighbour[face] }
    }

    /// Faces of a cell.
    pub fn faces(&self, cell: usize) -> &[u32] {
        &self.cell_faces[self.cell_starts[cell] as usize..self.cell_starts[cell + 1] as usize]
    }

    /// Tetrahedra of a cell.
    pub fn of_cell(&self, cell: usize) -> impl Iterator<Item = u32> {
        self.faces(cell).iter().flat_map(move |face| {
            let side = u32::from(self.owner[*face as usize] as usize != cell);
            (self.first[*face as usize]..self.first[*face as usize + 1]).map(move |t| 2 * t + side)
        })
    }

    /// Cells.
    pub fn cells(&self) -> usize {
        self.cell_starts.len() - 1
    }
}

fn edge(a: u32, b: u32) -> u64 {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

fn faces_of_cells(mesh: &Mesh) -> (Vec<u32>, Vec<u32>) {
    let sides = || mesh.owner.iter().zip(0..).chain(mesh.neighbour.iter().zip(0..));
    let mut starts = vec![0u32; mesh.cells + 1];
    for (cell, _) in sides() {
        starts[*cell as usize + 1] += 1;
    }
    for i in 0..mesh.cells {
        starts[i + 1] += starts[i];
    }
    let mut next = starts.clone();
    let mut faces = vec![0u32; starts[mesh.cells] as usize];
    for (cell, face) in sides() {
        let place = &mut next[*cell as usize];
        faces[*place as usize] = face;
        *place += 1;
    }
    (starts, faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use carom_cfd::block::{Kind, block};
    use carom_cfd::geometry::{base_points, cell_centres_and_volumes, face_centres_and_areas};

    #[test]
    fn neighbours_share_three_corners() {
        for kind in Kind::ALL {
            let mesh = block(kind, [4, 3, 2], |x| x);
            let (centres, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
            let (cells, _) = cell_centres_and_volumes(&mesh, &centres, &areas);
            let cut = Cut::new(&mesh, &base_points(&mesh, &cells));
            let mut count = 0;
            for cell in 0..mesh.cells {
                for tet in cut.of_cell(cell) {
                    count += 1;
                    assert_eq!(cut.cell(tet) as usize, cell);
                    let corners = cut.triangles[(tet >> 1) as usize];
                    for i in 0..3 {
                        let next = cut.beside(tet, i);
                        assert_ne!(next, NONE, "{kind:?}");
                        assert_eq!(cut.cell(next) as usize, cell);
                        let theirs = cut.triangles[(next >> 1) as usize];
                        let shared = |c: &u32| *c != corners[i] && theirs.contains(c);
                        assert_eq!(corners.iter().filter(|c| shared(c)).count(), 2, "{kind:?}");
                        assert!((0..3).any(|j| cut.beside(next, j) == tet), "{kind:?}");
                    }
                    let face = cut.face(tet) as usize;
                    if let Some((other, its)) = cut.across(tet, face) {
                        assert!(its as usize != cell && its == cut.cell(other));
                        assert_eq!(cut.across(other, face), Some((tet, cell as u32)));
                    }
                }
            }
            let per_cell = match kind {
                Kind::Hexahedra => 12,
                Kind::Prisms => 8,
                Kind::Tetrahedra => 4,
                Kind::Pyramids => 6,
                Kind::Polyhedra => 20,
            };
            assert_eq!(count, per_cell * mesh.cells, "{kind:?}");
        }
    }
}
