//! Fields at the nodes: the points of the mesh, then the centres of its cells.
//!
//! A point within the mesh has the mean of the cells around it, weighted by the inverse of the distance of their centres; one on the
//! boundary that of the boundary's faces around it alone, so that there the flow is what the boundary condition says. These are the
//! weights of OpenFOAM's `volPointInterpolation` (v1912), so that its `cellPoint` interpolation gives the same field. Sides of plane
//! and axisymmetric cases, planes of symmetry and cyclic patches are no boundary in this sense.

use super::cut::Cut;
use super::seams::Seams;
use crate::vector::{Vec3, norm, sub};
use carom_cfd::{Carry, Field, Mesh, PatchKind};

/// What to interpolate on.
pub(super) struct Nodes<'a> {
    pub mesh: &'a Mesh,
    pub cut: &'a Cut,
    pub cell_centres: &'a [Vec3],
    pub face_centres: &'a [Vec3],
    pub seams: &'a Seams,
}

/// Whether the values of a patch's faces hold at its points.
pub(super) fn is_boundary(kind: &PatchKind) -> bool {
    matches!(kind, PatchKind::Wall | PatchKind::Plain)
}

impl Nodes<'_> {
    /// Values of points, then of cells' centres. `turn` carries a value as a vector where one has a direction.
    pub fn values<const N: usize>(
        &self,
        field: &Field<N>,
        turn: impl Fn(&Carry, [f64; N]) -> [f64; N],
    ) -> Vec<[f64; N]> {
        match field {
            Field::Points(points) => {
                let mut nodes = points.clone();
                nodes.extend(self.means(points));
                nodes
            }
            Field::Cells { cells, boundary } => {
                let mut nodes = self.points(cells, boundary, turn);
                nodes.extend_from_slice(cells);
                nodes
            }
        }
    }

    /// Cells' values from their points': the mean of the corners of the faces, each face counting once.
    fn means<const N: usize>(&self, points: &[[f64; N]]) -> Vec<[f64; N]> {
        let mesh = self.mesh;
        let mut sums = vec![([0.0; N], 0.0f64); mesh.cells];
        for face in 0..mesh.faces.len() {
            let corners = mesh.faces.get(face);
            let of = [mesh.owner.get(face), mesh.neighbour.get(face)];
            for cell in of.into_iter().flatten() {
                let (total, count) = &mut sums[*cell as usize];
                for corner in corners {
                    for (t, v) in total.iter_mut().zip(points[*corner as usize]) {
                        *t += v;
                    }
                }
                *count += corners.len() as f64;
            }
        }
        sums.into_iter().map(|(sum, n)| sum.map(|s| s / n.max(1.0))).collect()
    }

    fn points<const N: usize>(
        &self,
        cells: &[[f64; N]],
        boundary: &[[f64; N]],
        turn: impl Fn(&Carry, [f64; N]) -> [f64; N],
    ) -> Vec<[f64; N]> {
        let mesh = self.mesh;
        let on_boundary = on_boundary(mesh);
        let mut sums = vec![([0.0; N], 0.0f64); mesh.points.len()];
        let mut add = |point: u32, centre: Vec3, value: &[f64; N]| {
            let (sum, weight) = &mut sums[point as usize];
            let w = 1.0 / norm(sub(mesh.points[point as usize], centre)).max(f64::MIN_POSITIVE);
            for (s, v) in sum.iter_mut().zip(value) {
                *s += w * v;
            }
            *weight += w;
        };
        for patch in mesh.patches.iter().filter(|p| is_boundary(&p.kind)) {
            for face in patch.faces.clone() {
                for point in mesh.faces.get(face) {
                    add(*point, self.face_centres[face], &boundary[face - mesh.inner_faces()]);
                }
            }
        }
        self.each_cell_point(|cell, point| {
            if !on_boundary[point as usize] {
                add(point, self.cell_centres[cell], &cells[cell]);
            }
        });
        let plus = |a: [f64; N], b: [f64; N]| std::array::from_fn(|i| a[i] + b[i]);
        self.seams.join(&mut sums, |carry, (v, w)| (turn(carry, v), w), |(a, w), (b, x)| (plus(a, b), w + x));
        sums.into_iter().map(|(sum, w)| sum.map(|s| if w > 0.0 { s / w } else { 0.0 })).collect()
    }

    /// Each point of each cell once.
    fn each_cell_point(&self, mut tell: impl FnMut(usize, u32)) {
        // of each point, the cell that it was last told of
        let mut told = vec![u32::MAX; self.mesh.points.len()];
        for cell in 0..self.mesh.cells {
            for face in self.cut.faces(cell) {
                for point in self.mesh.faces.get(*face as usize) {
                    if std::mem::replace(&mut told[*point as usize], cell as u32) != cell as u32 {
                        tell(cell, *point);
                    }
                }
            }
        }
    }
}

/// Which points lie on a patch whose values hold at its points.
pub(super) fn on_boundary(mesh: &Mesh) -> Vec<bool> {
    let mut on = vec![false; mesh.points.len()];
    for patch in mesh.patches.iter().filter(|p| is_boundary(&p.kind)) {
        for point in patch.faces.clone().flat_map(|face| mesh.faces.get(face)) {
            on[*point as usize] = true;
        }
    }
    on
}
