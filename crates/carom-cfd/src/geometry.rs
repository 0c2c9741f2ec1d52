//! Centres, areas and volumes, as OpenFOAM defines them.
//!
//! A face of more than three corners x₁ … xₙ is cut into the triangles (xᵢ, xᵢ₊₁, x̄) about the mean x̄ of its corners. Its area vector is the sum of theirs,
//! S = ½ Σ (xᵢ₊₁ − xᵢ) × (x̄ − xᵢ), and its centre is the mean of their centres, weighted by the magnitude of their areas. A cell is cut into pyramids
//! from the mean c̄ of its faces' centres: V = ⅓ Σ ±S·(x_f − c̄), and its centre is the mean of the pyramids' centres ¾ x_f + ¼ c̄, weighted by volume.
//!
//! Source: `primitiveMeshFaceCentresAndAreas.C` and `primitiveMeshCellCentresAndVols.C` of OpenFOAM v1912, whose numbers the tests hold these against.
//! Plain additions, products and roots in a fixed order: the same bits on every machine.

mod base;
pub(crate) mod vector;

pub use base::{BasePoints, base_points, tetrahedron_quality, tetrahedron_volume};

use crate::{Mesh, Polygons};
use vector::{add, cross, dot, length, scaled, sub};

/// Centre and area vector of one face whose corners are `points[corners[i]]`.
///
/// Indices must be in their range ([`check::mesh`](crate::check::mesh) sees to it).
#[inline]
pub fn face_centre_and_area(points: &[[f64; 3]], corners: &[u32]) -> ([f64; 3], [f64; 3]) {
    let at = |i: usize| points[corners[i] as usize];
    match corners.len() {
        0 => ([0.0; 3], [0.0; 3]),
        3 => {
            let [a, b, c] = [at(0), at(1), at(2)];
            (scaled(1.0 / 3.0, add(add(a, b), c)), scaled(0.5, cross(sub(b, a), sub(c, a))))
        }
        n => {
            let mut mean = at(0);
            for i in 1..n {
                mean = add(mean, at(i));
            }
            mean = scaled(1.0 / n as f64, mean);
            let (mut normal, mut weight, mut moment) = ([0.0; 3], 0.0, [0.0; 3]);
            for i in 0..n {
                let (here, next) = (at(i), at(if i + 1 == n { 0 } else { i + 1 }));
                let twice = cross(sub(next, here), sub(mean, here));
                let size = length(twice);
                normal = add(normal, twice);
                weight += size;
                moment = add(moment, scaled(size, add(add(here, next), mean)));
            }
            let centre = if weight > f64::MIN_POSITIVE { scaled(1.0 / 3.0 / weight, moment) } else { mean };
            (centre, scaled(0.5, normal))
        }
    }
}

/// Centres, m, and area vectors, m², of all faces.
///
/// ```
/// let points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let faces = carom_cfd::Polygons { starts: vec![0, 4], corners: vec![0, 1, 2, 3] };
/// let (centres, areas) = carom_cfd::geometry::face_centres_and_areas(&points, &faces);
/// assert_eq!((centres[0], areas[0]), ([1.0, 0.5, 0.0], [0.0, 0.0, 2.0]));
/// ```
pub fn face_centres_and_areas(points: &[[f64; 3]], faces: &Polygons) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    (0..faces.len()).map(|f| face_centre_and_area(points, faces.get(f))).unzip()
}

/// Centres, m, and volumes, m³, of all cells, from the centres and area vectors of the faces.
pub fn cell_centres_and_volumes(
    mesh: &Mesh,
    face_centres: &[[f64; 3]],
    face_areas: &[[f64; 3]],
) -> (Vec<[f64; 3]>, Vec<f64>) {
    let sides = || {
        let outer = mesh.owner.iter().enumerate().map(|(f, &c)| (f, c as usize, 1.0));
        outer.chain(mesh.neighbour.iter().enumerate().map(|(f, &c)| (f, c as usize, -1.0)))
    };
    let (mut guess, mut count) = (vec![[0.0; 3]; mesh.cells], vec![0_u32; mesh.cells]);
    for (f, c, _) in sides() {
        guess[c] = add(guess[c], face_centres[f]);
        count[c] += 1;
    }
    for (g, n) in guess.iter_mut().zip(&count) {
        *g = scaled(1.0 / f64::from((*n).max(1)), *g);
    }
    drop(count);
    let (mut centres, mut volumes) = (vec![[0.0; 3]; mesh.cells], vec![0.0; mesh.cells]);
    for (f, c, sign) in sides() {
        let triple = sign * dot(face_areas[f], sub(face_centres[f], guess[c]));
        let middle = add(scaled(0.75, face_centres[f]), scaled(0.25, guess[c]));
        centres[c] = add(centres[c], scaled(triple, middle));
        volumes[c] += triple;
    }
    for ((centre, volume), guess) in centres.iter_mut().zip(&mut volumes).zip(&guess) {
        *centre = if volume.abs() > f64::MIN_POSITIVE { scaled(1.0 / *volume, *centre) } else { *guess };
        *volume *= 1.0 / 3.0;
    }
    (centres, volumes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{block, shaken};

    #[test]
    fn a_block_s_cells_have_the_volumes_and_centres_of_boxes() {
        let mesh = block([3, 2, 4], [3.0, 1.0, 2.0]);
        let (fc, fa) = face_centres_and_areas(&mesh.points, &mesh.faces);
        let (cc, cv) = cell_centres_and_volumes(&mesh, &fc, &fa);
        for (i, (c, v)) in cc.iter().zip(&cv).enumerate() {
            let at = [i % 3, i / 3 % 2, i / 6];
            let exact = [(at[0] as f64 + 0.5) * 1.0, (at[1] as f64 + 0.5) * 0.5, (at[2] as f64 + 0.5) * 0.5];
            assert!((v - 0.25).abs() < 1e-15, "{i}: {v}");
            assert!(length(sub(*c, exact)) < 1e-15, "{i}: {c:?} {exact:?}");
        }
    }

    #[test]
    fn volumes_of_a_shaken_block_fill_it_and_area_vectors_close_each_cell() {
        let mesh = shaken(block([5, 4, 3], [1.0, 1.0, 1.0]), 0.25, 7);
        let (fc, fa) = face_centres_and_areas(&mesh.points, &mesh.faces);
        let (_, cv) = cell_centres_and_volumes(&mesh, &fc, &fa);
        assert!((cv.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        let mut sums = vec![[0.0; 3]; mesh.cells];
        for (f, &c) in mesh.owner.iter().enumerate() {
            sums[c as usize] = add(sums[c as usize], fa[f]);
        }
        for (f, &c) in mesh.neighbour.iter().enumerate() {
            sums[c as usize] = sub(sums[c as usize], fa[f]);
        }
        assert!(sums.iter().all(|s| length(*s) < 1e-15));
    }

    #[test]
    fn a_tetrahedron_has_a_sixth_of_the_triple_product_and_its_mean_as_centre() {
        let points = vec![[0.1, 0.0, 0.2], [1.0, 0.3, 0.0], [0.2, 2.0, 0.1], [0.0, 0.4, 3.0]];
        let faces = Polygons { starts: vec![0, 3, 6, 9, 12], corners: vec![0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2] };
        let mesh = Mesh { points, faces, owner: vec![0; 4], neighbour: vec![], cells: 1, patches: vec![] };
        let p = &mesh.points;
        let exact = dot(sub(p[1], p[0]), cross(sub(p[2], p[0]), sub(p[3], p[0]))) / 6.0;
        let (fc, fa) = face_centres_and_areas(&mesh.points, &mesh.faces);
        let (cc, cv) = cell_centres_and_volumes(&mesh, &fc, &fa);
        assert!((cv[0] - exact).abs() < 1e-15 * exact, "{} {exact}", cv[0]);
        let mean = scaled(0.25, p.iter().fold([0.0; 3], |s, x| add(s, *x)));
        assert!(length(sub(cc[0], mean)) < 1e-15, "{:?} {mean:?}", cc[0]);
    }
}
