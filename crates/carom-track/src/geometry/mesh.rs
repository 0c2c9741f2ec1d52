//! A triangulated wall, met from either side.
//!
//! A sphere touches a triangle on its face, or an edge or a corner that sticks out: the centre's path is tested against the
//! plane one radius off, the cylinders around the edges and the spheres around the corners, and the earliest contact counts.
//! A point (contact at the centre) touches as a sphere does whose radius is a 10⁻¹² of the wall's coordinates: far above the
//! rounding of positions, so that none slips through where triangles meet, and far below anything measured.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

mod falls;
mod flats;
pub(crate) mod nearest;
mod piece;
mod rim;
mod surface;
mod sweep;
pub(crate) mod tree;

use super::contact::misses;
use super::{Bounds, Meeting, Path};
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::{Mask, bits, mask};
use crate::vector::{Vec3, norm, sub};
use carom::instructions::{InstructionSet, Work};
use carom::math::Fma;
use rayon::prelude::*;
use rim::Reach;
use surface::{Face, Surface};
use sweep::Sweep;
use tree::{Halves, MIXED, Tree};

/// A triangle by its corners, m.
pub type Triangle = [Vec3; 3];

/// Triangles and the tree that finds them.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    surface: Box<Surface>,
    tree: Tree,
    /// The box around it.
    bounds: Bounds,
    /// Half the diagonal of a leaf's box, as a mean, m.
    size: f64,
    /// Clearance of a point, m.
    skin: f64,
    /// The block that it is the surface of, if it is one.
    solid: Option<Bounds>,
    /// From which place in the list on its triangles are copies of others, and of which.
    first_copy: u32,
    copies: Box<[u32]>,
}

/// Share of the coordinates by which a point stays off.
const SKIN: f64 = 1e-12;
/// Precision of corners computed in double precision, as a share of the largest coordinate.
const DOUBLE: f64 = 8e-15;
/// Up to so many planes are looked at side by side before triangles are.
const FEW: usize = 12;

/// The instructions for a search: four boxes side by side.
const SET: InstructionSet = if cfg!(target_arch = "aarch64") { InstructionSet::Neon } else { InstructionSet::Avx2 };

/// A search for the first contact.
struct Meet<'a> {
    mesh: &'a Mesh,
    path: &'a Path,
    reach: Reach,
}

impl Work for Meet<'_> {
    type Output = Option<(Meeting, u32)>;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, _: F) -> Option<(Meeting, u32)> {
        let (meeting, face) = Sweep::new(self.mesh, self.path, self.reach).first()?;
        Some((meeting, self.mesh.number(&self.mesh.surface.faces[face as usize])))
    }
}

impl Mesh {
    /// A wall of triangles; those without area or with a corner that is not finite are left out. `None` if none is left.
    ///
    /// Neighbours whose corners lie in one plane but for rounding in double precision are flat together.
    pub fn new(triangles: &[Triangle]) -> Option<Self> {
        Self::with_precision(triangles, 0.0)
    }

    /// Likewise of triangles whose corners were rounded to a share `precision` of the largest coordinate: neighbours that lie
    /// in one plane but for that are put into it.
    pub fn with_precision(triangles: &[Triangle], precision: f64) -> Option<Self> {
        let sound = triangles.iter().flatten().filter(|x| x.iter().all(|c| c.is_finite()));
        let all = Bounds::around(sound.copied());
        let largest = all.min.iter().chain(&all.max).fold(0.0f64, |m, c| m.max(c.abs()));
        let (mut surface, sides) = Surface::new(triangles, precision.max(DOUBLE) * largest);
        if surface.faces.is_empty() {
            return None;
        }
        let boxes: Vec<Bounds> = surface.faces.par_iter().map(|f| Bounds::around(surface.triangle(f))).collect();
        let (mut tree, order) = Tree::new(&boxes, Halves::LeastArea);
        surface.arrange(sides, &order);
        tree.name_flats(&surface.faces.iter().map(|f| if f.rim == 0 { f.flat } else { MIXED }).collect::<Vec<_>>());
        let (bounds, size) = (tree.bounds(), tree.leaf_size());
        let (skin, first_copy, copies) = (SKIN * largest, u32::MAX, Box::new([]));
        Some(Self { surface: Box::new(surface), tree, bounds, size, skin, solid: None, first_copy, copies })
    }

    /// Triangles of which some stand in other places too, as seen where the space goes on elsewhere. Such a copy, given with the place in
    /// the list of what it copies, is met like all others, under the name of that one.
    pub fn with_copies(triangles: &[Triangle], copies: &[(u32, Triangle)]) -> Option<Self> {
        let all: Vec<Triangle> = triangles.iter().copied().chain(copies.iter().map(|(_, copy)| *copy)).collect();
        let first_copy = u32::try_from(triangles.len()).unwrap_or(u32::MAX);
        Some(Self { first_copy, copies: copies.iter().map(|(of, _)| *of).collect(), ..Self::new(&all)? })
    }

    /// The place in the list given of a face, or of what it copies.
    fn number(&self, face: &Face) -> u32 {
        let copied = face.number.checked_sub(self.first_copy).and_then(|copy| self.copies.get(copy as usize));
        copied.copied().unwrap_or(face.number)
    }

    /// The outside of a block along the axes: twelve triangles.
    pub fn block(min: Vec3, max: Vec3) -> Option<Self> {
        const FACES: [[usize; 4]; 6] =
            [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        let v = |i: usize| [0, 1, 2].map(|c| if i >> c & 1 == 0 { min[c] } else { max[c] });
        let halves = |q: &[usize; 4]| [[v(q[0]), v(q[1]), v(q[2])], [v(q[0]), v(q[2]), v(q[3])]];
        let surface = Self::new(&FACES.iter().flat_map(halves).collect::<Vec<_>>())?;
        Some(Self { solid: Some(Bounds { min, max }), ..surface })
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Whether it is the surface of a block, and so has an inside.
    pub fn is_block(&self) -> bool {
        self.solid.is_some()
    }

    /// How many triangles.
    pub fn len(&self) -> usize {
        self.surface.faces.len()
    }

    /// Never: a wall has triangles.
    pub fn is_empty(&self) -> bool {
        self.surface.faces.is_empty()
    }

    /// How many of the triangles given were left out: without area, or with a corner that is not finite.
    pub fn left_out(&self) -> usize {
        self.surface.left_out
    }

    /// The triangles with their places in the list given, in that order; copies aside.
    pub fn triangles(&self) -> Vec<(u32, Triangle)> {
        let own = self.surface.faces.iter().filter(|f| f.number < self.first_copy);
        let mut all: Vec<_> = own.map(|f| (f.number, self.surface.triangle(f))).collect();
        all.sort_unstable_by_key(|(number, _)| *number);
        all
    }

    /// What must be close for contact: a point has a skin.
    #[inline(always)]
    fn reach(&self, clearance: f64, slack: f64) -> Reach {
        if clearance < self.skin {
            Reach { clearance: self.skin, slack: 1e-2 * self.skin }
        } else {
            Reach { clearance, slack }
        }
    }

    /// Where a path first comes within `clearance` of a triangle, and the triangle's place in the list given.
    pub fn meet(&self, path: &Path, clearance: f64, slack: f64) -> Option<(Meeting, u32)> {
        SET.run(Meet { mesh: self, path, reach: self.reach(clearance, slack) })
    }

    /// Which of `W` paths may come within their clearances: all that are not surely clear of the box around it, nor, where it
    /// has few planes, of all its planes.
    #[inline(always)]
    pub(super) fn may_meet<const W: usize>(
        &self,
        start: &Lanes3<W>,
        path: &[Lanes3<W>; 5],
        clearance: &Lanes<W>,
        margin: &Lanes<W>,
    ) -> Mask<W> {
        let mut may = [u64::MAX; W];
        let mut reach = *clearance;
        for l in 0..W {
            reach[l] = if reach[l] < self.skin { self.skin } else { reach[l] };
        }
        for c in 0..3 {
            for l in 0..W {
                let (mut low, mut high) = (0.0, 0.0);
                for p in path {
                    low = if p[c][l] < low { p[c][l] } else { low };
                    high = if p[c][l] > high { p[c][l] } else { high };
                }
                let far = reach[l] + margin[l];
                may[l] &= !mask(start[c][l] + low > self.bounds.max[c] + far);
                may[l] &= !mask(start[c][l] + high < self.bounds.min[c] - far);
            }
        }
        if self.surface.flats.len() > FEW || bits(&may) == 0 {
            return may;
        }
        let mut near = [0; W];
        for flat in &self.surface.flats {
            let n = flat.normal;
            for l in 0..W {
                let x = [start[0][l] - flat.point[0], start[1][l] - flat.point[1], start[2][l] - flat.point[2]];
                let height = n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
                let sign = if height < 0.0 { -1.0 } else { 1.0 };
                let gap = sign * height - reach[l];
                let mut lowest = f64::INFINITY;
                for p in path {
                    let along = sign * (n[0] * p[0][l] + n[1] * p[1][l] + n[2] * p[2][l]);
                    lowest = if along < lowest { along } else { lowest };
                }
                // one deep in the plane's clearance may be beside the wall
                near[l] |= mask(!misses(gap, lowest, margin[l])) | mask(gap < -margin[l]);
            }
        }
        for l in 0..W {
            may[l] &= near[l];
        }
        may
    }

    /// Distance of a point from the nearest triangle, m; negative in a block.
    pub fn distance(&self, x: Vec3) -> f64 {
        let away = self.nearest(x).map_or(f64::INFINITY, |(_, foot)| norm(sub(x, foot)));
        let inside = self.solid.is_some_and(|s| (0..3).all(|c| x[c] > s.min[c] && x[c] < s.max[c]));
        if inside { -away } else { away }
    }
}

#[cfg(test)]
mod tests;
