//! Patches as walls: their triangles, and copies of these where the space goes on elsewhere.
//!
//! A sphere next to a side of a wedge or to a cyclic patch touches what is behind it before its centre gets there. So a wall has copies of its
//! triangles as they are seen through that side: in a wedge of all, on both sides; beside a cyclic patch of those as near its partner as
//! the widest of its faces, which is more than the radius of any sphere that such a mesh is for. Planes of symmetry need none: what is
//! behind one is in reach from this side too.

use super::Cells;
use super::seams::Places;
use crate::geometry::{Bounds, Mesh, Triangle};
use crate::vector::{Vec3, add, cross, dot, norm, scale, sub, unit};
use carom_cfd::{Carry, Patch, PatchKind};

/// A triangle and its place among the patch's.
type Numbered = (u32, Triangle);

impl Cells {
    /// A patch as a wall, in a plane case far beyond its sides; a copy has the name of its triangle. `None` where no face has an area.
    pub fn wall(&self, patch: &Patch) -> Option<Mesh> {
        let own = self.triangles(patch);
        let mut all: Vec<Numbered> = (0..).zip(own.iter().copied()).collect();
        self.copy_beside_wedge(&mut all);
        self.copy_behind_cyclic_patches(&mut all);
        let stretched: Vec<Numbered> = all.into_iter().map(|(n, t)| (n, t.map(|x| self.stretched(x)))).collect();
        let (own, copies) = stretched.split_at(own.len());
        Mesh::with_copies(&own.iter().map(|(_, t)| *t).collect::<Vec<_>>(), copies)
    }

    /// Median height of the cells at a patch, m: twice the distance of their centres from their triangles there. `None` without any.
    pub(crate) fn height_at(&self, patch: &Patch) -> Option<f64> {
        let triangles = self.cut.first[patch.faces.start]..self.cut.first[patch.faces.end];
        // on the boundary a cell owns its faces
        let mut heights: Vec<f64> = triangles.filter_map(|t| self.height(2 * t)).collect();
        let middle = heights.len() / 2;
        (middle < heights.len()).then(|| *heights.select_nth_unstable_by(middle, f64::total_cmp).1)
    }

    /// Height of the cell before a triangle of the boundary, m.
    pub(super) fn height(&self, tet: u32) -> Option<f64> {
        self.face(tet).map(|(_, _, height)| height)
    }

    /// A triangle of the boundary, m, its normal, which points out of its cell, and the cell's height, m.
    pub(super) fn face(&self, tet: u32) -> Option<(Triangle, Vec3, f64)> {
        let (corners, centre) = self.corners(tet, self.cut.cell(tet));
        let [a, b, c] = corners.map(|p| self.nodes[p].place);
        let out = unit(cross(sub(b, a), sub(c, a)))?;
        Some(([a, b, c], out, 2.0 * dot(sub(a, self.nodes[centre].place), out).abs()))
    }

    /// A point of a plane case far out on its side; of others as it is.
    fn stretched(&self, x: Vec3) -> Vec3 {
        const FAR: f64 = 4.0;
        let Some(plane) = &self.plane else { return x };
        let far = FAR * norm(sub(self.bounds.max, self.bounds.min));
        let side = if dot(x, plane.across) > plane.level { 1.0 } else { -1.0 };
        add(plane.put(x), scale(plane.across, side * far))
    }

    fn copy_beside_wedge(&self, all: &mut Vec<Numbered>) {
        let Some(wedge) = &self.wedge else { return };
        let own = all.clone();
        for turn in [-wedge.angle, wedge.angle].map(|angle| wedge.turn(angle)) {
            all.extend(own.iter().map(|(n, t)| (*n, t.map(|x| turn.point(x)))));
        }
    }

    /// Pair by pair, so that what is behind two at once is copied from a copy.
    fn copy_behind_cyclic_patches(&self, all: &mut Vec<Numbered>) {
        let kind = |patch: &Patch| match patch.kind {
            PatchKind::Cyclic { partner, carry } | PatchKind::CyclicAmi { partner, carry } => Some((partner, carry)),
            _ => None,
        };
        let places = self.seams.places(|point| self.nodes[point as usize].place);
        for (index, patch) in self.patches.iter().enumerate() {
            let Some((partner, carry)) = kind(patch).filter(|(partner, _)| index < *partner) else { continue };
            let Some((other, back)) = self.patches.get(partner).and_then(|p| Some((p, kind(p)?.1))) else { continue };
            let copies = [(patch, carry), (other, back)].map(|(side, carry)| self.carried(all, side, &carry, &places));
            all.extend(copies.into_iter().flatten());
        }
    }

    /// Of triangles those near a side, carried over it.
    fn carried(&self, all: &[Numbered], side: &Patch, carry: &Carry, places: &Places) -> Vec<Numbered> {
        let faces = self.triangles(side);
        let along = |from: Vec3, to: Vec3| norm(self.plane.map_or(sub(to, from), |p| p.along(sub(to, from))));
        let widths = faces.iter().flat_map(|[a, b, c]| [along(*a, *b), along(*b, *c), along(*c, *a)]);
        let widest = widths.fold(0.0, f64::max);
        let around = Bounds::around(faces.iter().flatten().copied()).wider(widest);
        let near = all.iter().filter(|(_, t)| Bounds::around(*t).meets(&around));
        // a corner on the seam is to be that of the other side to the last bit, for a surface without a slit
        let over = |x: Vec3| {
            let (there, known) = (carry.point(x), places.get(&x.map(f64::to_bits)));
            known.copied().filter(|known| norm(sub(*known, there)) < 1e-3 * widest).unwrap_or(there)
        };
        near.map(|(n, t)| (*n, t.map(over))).collect()
    }
}
