//! Fields at the nodes: the points of the mesh, then the centres of its cells.
//!
//! A point within the mesh has the mean of the cells around it, weighted by the inverse of the distance of their centres; one on the
//! boundary that of the boundary's faces around it alone, so that there the flow is what the boundary condition says. These are the
//! weights of OpenFOAM's `volPointInterpolation` (v1912), so that its `cellPoint` interpolation gives the same field. Sides of plane
//! and axisymmetric cases, planes of symmetry and cyclic patches are no boundary in this sense.

use super::cut::Cut;
use super::seams::Seams;
use crate::vector::{Vec3, add, cross, dot, norm, scale, sub};
use carom_cfd::{Carry, Field, Mesh, PatchKind};
use rayon::prelude::*;

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

    /// Values at cells' centres from their points': those of the linear field that fits the points best. Of a field that is linear over the
    /// cell it is that field's own, which the mean of the points is not where their middle is not the centre.
    fn means<const N: usize>(&self, points: &[[f64; N]]) -> Vec<[f64; N]> {
        let cell = |cell: usize| {
            let mut corners: Vec<u32> = Vec::new();
            for face in self.cut.faces(cell) {
                corners.extend(self.mesh.faces.get(*face as usize));
            }
            corners.sort_unstable();
            corners.dedup();
            self.fitted(&corners, self.cell_centres[cell], points)
        };
        (0..self.mesh.cells).into_par_iter().map(cell).collect()
    }

    /// Value at a place of the linear field that fits those of some points best, within the range of these.
    fn fitted<const N: usize>(&self, corners: &[u32], centre: Vec3, points: &[[f64; N]]) -> [f64; N] {
        let share = 1.0 / corners.len().max(1) as f64;
        let place = |corner: u32| self.mesh.points[corner as usize];
        let middle = scale(corners.iter().fold([0.0; 3], |sum, c| add(sum, place(*c))), share);
        let mut spread = [[0.0; 3]; 3];
        for x in corners.iter().map(|c| sub(place(*c), middle)) {
            for (row, a) in spread.iter_mut().zip(x) {
                *row = add(*row, scale(x, a));
            }
        }
        // a weight for each corner: their sum is 1, and the middle weighted by them the centre
        let lean = solved(&spread, sub(centre, middle)).unwrap_or([0.0; 3]);
        let (mut sum, mut low, mut high) = ([0.0; N], [f64::INFINITY; N], [f64::NEG_INFINITY; N]);
        for corner in corners {
            let weight = share + dot(lean, sub(place(*corner), middle));
            for (i, v) in points[*corner as usize].into_iter().enumerate() {
                sum[i] += weight * v;
                (low[i], high[i]) = (low[i].min(v), high[i].max(v));
            }
        }
        std::array::from_fn(|i| if corners.is_empty() { 0.0 } else { sum[i].clamp(low[i], high[i]) })
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

/// y with A y = b for a symmetric A that is no less than zero; `None` where A is flat.
fn solved(a: &[Vec3; 3], b: Vec3) -> Option<Vec3> {
    const FLAT: f64 = 1e-12;
    let minors = [cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])];
    let determinant = dot(a[0], minors[0]);
    let size = a[0][0] * a[1][1] * a[2][2];
    if determinant.is_nan() || determinant <= FLAT * size {
        return None;
    }
    let sum = (0..3).fold([0.0; 3], |sum, c| add(sum, scale(minors[c], b[c])));
    Some(scale(sum, 1.0 / determinant))
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

#[cfg(test)]
mod tests {
    use super::super::Cells;
    use super::super::tests::{Dice, shaken, with_velocity};
    use crate::vector::{norm, sub};
    use carom_cfd::block::Kind;

    #[test]
    fn a_linear_field_given_at_points_is_exact_in_cells_of_any_shape() {
        let linear = |x: [f64; 3]| [3.0 * x[1] - x[2], 0.5 + 2.0 * x[0], x[0] + x[1] + 4.0 * x[2]];
        for kind in Kind::ALL {
            let cells = Cells::new(&with_velocity(shaken(kind, [4, 3, 5], 0.3, 17), linear)).unwrap();
            let mut dice = Dice::new(3);
            for _ in 0..500 {
                let x = dice.point();
                let off = norm(sub(cells.velocity(x), linear(x)));
                assert!(off < 1e-12, "{kind:?} {x:?}: {off:e}");
            }
        }
    }
}
