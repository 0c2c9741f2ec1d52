//! How cells are cut into tetrahedra.
//!
//! A face is cut into a fan of triangles from one of its corners, its base point, and each triangle makes a tetrahedron with the centre of the cell on
//! either side. The base point is the first corner for which every tetrahedron of the fan, on both sides, is turned the right way and not flat; where no
//! corner does, it is the one whose worst tetrahedron is the best, and the face is said to be inverted. On meshes without inverted faces this is
//! the decomposition of OpenFOAM v1912 (`polyMeshTetDecomposition.C`), so that what is linear there is linear here.

use super::vector::{cross, dot, length, sub};
use crate::Mesh;

/// A tetrahedron of lower quality is flat or turned; the square of OpenFOAM's smallest number.
const LEAST: f64 = 1e-30;

/// At most so many corners of a face are tried, which matters for its time where it has very many.
const TRIED: usize = 256;

/// The corner of each face from which its fan starts.
#[derive(Clone, Debug, Default)]
pub struct BasePoints {
    /// Place of the corner among the face's corners.
    pub base: Vec<u32>,
    /// Faces whose tetrahedra are turned or flat from whichever corner.
    pub inverted: Vec<u32>,
}

/// Volume of a tetrahedron over that of the regular one in its circumsphere: 1 at best, negative where it is turned. The triangle a, b, c is to be seen
/// counterclockwise from outside the cell, and `apex` to lie inside.
#[inline]
pub fn tetrahedron_quality(apex: [f64; 3], a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let (u, v, w) = (sub(a, apex), sub(b, apex), sub(c, apex));
    let vw = cross(v, w);
    let six = dot(u, vw);
    // the circumcentre, from the apex, is `pull` over twice `six`
    let (wu, uv) = (cross(w, u), cross(u, v));
    let pull = [0, 1, 2].map(|i| dot(u, u) * vw[i] + dot(v, v) * wu[i] + dot(w, w) * uv[i]);
    let radius = length(pull) / (2.0 * six.abs());
    // a regular tetrahedron in a sphere of radius R has 8√3/27 R³
    let regular = 8.0 * 3_f64.sqrt() / 27.0 * radius * radius * radius;
    if six == 0.0 || !radius.is_finite() { 0.0 } else { six / 6.0 / regular.max(f64::MIN_POSITIVE) }
}

impl BasePoints {
    /// Of the cells on both sides of a face, those whose tetrahedra on it are turned or flat.
    pub fn inverted_cells(&self, mesh: &Mesh, cell_centres: &[[f64; 3]], face: u32) -> Vec<u32> {
        let (f, corners) = (face as usize, mesh.faces.get(face as usize));
        let turned: Vec<u32> = corners.iter().rev().copied().collect();
        let n = corners.len();
        let base = self.base[f] as usize;
        let own = worst_of_fan(&mesh.points, corners, base, cell_centres[mesh.owner[f] as usize], None);
        let own = (own <= LEAST).then_some(mesh.owner[f]);
        let other =
            mesh.neighbour.get(f).copied().filter(|&c| {
                worst_of_fan(&mesh.points, &turned, n - 1 - base, cell_centres[c as usize], None) <= LEAST
            });
        own.into_iter().chain(other).collect()
    }
}

/// The base points of all faces.
pub fn base_points(mesh: &Mesh, cell_centres: &[[f64; 3]]) -> BasePoints {
    let mut found = BasePoints { base: Vec::with_capacity(mesh.faces.len()), inverted: Vec::new() };
    for f in 0..mesh.faces.len() {
        let corners = mesh.faces.get(f);
        let owner = cell_centres[mesh.owner[f] as usize];
        let other = mesh.neighbour.get(f).map(|&c| cell_centres[c as usize]);
        let (mut best, mut place) = (f64::NEG_INFINITY, 0);
        for base in 0..corners.len().min(TRIED) as u32 {
            let worst = worst_of_fan(&mesh.points, corners, base as usize, owner, other);
            if worst > best {
                (best, place) = (worst, base);
            }
            if best > LEAST {
                break;
            }
        }
        if best <= LEAST {
            found.inverted.push(f as u32);
        }
        found.base.push(place);
    }
    found
}

fn worst_of_fan(points: &[[f64; 3]], corners: &[u32], base: usize, owner: [f64; 3], other: Option<[f64; 3]>) -> f64 {
    let n = corners.len();
    let at = |i: usize| points[corners[if i >= n { i - n } else { i }] as usize];
    let mut worst = f64::INFINITY;
    for i in 1..n.saturating_sub(1) {
        let (a, b, c) = (at(base), at(base + i), at(base + i + 1));
        worst = worst.min(tetrahedron_quality(owner, a, b, c));
        if let Some(other) = other {
            worst = worst.min(tetrahedron_quality(other, a, c, b));
        }
    }
    worst
}

/// Volume of a tetrahedron, m³, negative where it is turned; corners as in [`tetrahedron_quality`].
#[inline]
pub fn tetrahedron_volume(apex: [f64; 3], a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    dot(sub(a, apex), cross(sub(b, apex), sub(c, apex))) / 6.0
}

#[cfg(test)]
mod tests {
    use super::super::{cell_centres_and_volumes, face_centres_and_areas};
    use super::*;
    use crate::samples::{block, shaken};

    #[test]
    fn a_regular_tetrahedron_has_quality_one_and_minus_one_turned() {
        let [a, b, c, d] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let q = tetrahedron_quality(d, a, b, c);
        assert!((q.abs() - 1.0).abs() < 1e-15, "{q}");
        assert_eq!(tetrahedron_quality(d, a, c, b), -q);
        assert_eq!(tetrahedron_volume(d, a, b, c).signum(), q.signum());
        // a corner of a cube: volume 1/6, circumradius √3/2
        let corner = tetrahedron_quality([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        let exact = (1.0 / 6.0) / (8.0 * 3_f64.sqrt() / 27.0 * (3_f64.sqrt() / 2.0).powi(3));
        assert!((corner - exact).abs() < 1e-15, "{corner} {exact}");
    }

    #[test]
    fn tetrahedra_of_a_shaken_block_fill_it() {
        let mesh = shaken(block([4, 4, 4], [1.0; 3]), 0.2, 3);
        let (fc, fa) = face_centres_and_areas(&mesh.points, &mesh.faces);
        let (cc, _) = cell_centres_and_volumes(&mesh, &fc, &fa);
        let found = base_points(&mesh, &cc);
        assert!(found.inverted.is_empty());
        let mut sum = 0.0;
        for f in 0..mesh.faces.len() {
            let (corners, base) = (mesh.faces.get(f), found.base[f] as usize);
            let at = |i: usize| mesh.points[corners[(base + i) % corners.len()] as usize];
            for i in 1..corners.len() - 1 {
                sum += tetrahedron_volume(cc[mesh.owner[f] as usize], at(0), at(i), at(i + 1));
                if let Some(&c) = mesh.neighbour.get(f) {
                    sum += tetrahedron_volume(cc[c as usize], at(0), at(i + 1), at(i));
                }
            }
        }
        assert!((sum - 1.0).abs() < 1e-13, "{sum}");
    }

    #[test]
    fn a_corner_pushed_through_its_cell_inverts_a_face() {
        let mut mesh = block([2, 2, 2], [1.0; 3]);
        mesh.points[13] = [1.3, 1.3, 1.3];
        let (fc, fa) = face_centres_and_areas(&mesh.points, &mesh.faces);
        let (cc, _) = cell_centres_and_volumes(&mesh, &fc, &fa);
        assert!(!base_points(&mesh, &cc).inverted.is_empty());
    }
}
