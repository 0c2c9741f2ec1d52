//! Over the gap between a patch and its partner: the facets of a curved `cyclicAMI` are chords, which do not coincide once one side has turned, and
//! coordinates are rounded. A sphere that is carried to another patch goes on behind the face nearest to it, from as far within the cell there as it
//! was before it.

use super::tetrahedron::ROUNDING;
use super::{Cells, Tetrahedron};
use crate::geometry::{Bounds, Triangle, nearest_point};
use crate::vector::{Vec3, add, dot, norm, scale, sub, unit};
use carom_cfd::{Carry, PatchKind};

/// Gaps looked for, over the size of the mesh, from rounding upwards.
const REACHES: [f64; 9] = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
/// The widest gap that coordinates of some digits leave, over the size of the mesh.
const ROUNDED: f64 = 1e-5;
/// The widest gap under a chord, over its length: that of a quarter of a circle has 0.21.
const SAGITTA: f64 = 0.25;
/// The most of a tetrahedron's height that a sphere is put into it.
const DEEPEST: f64 = 0.25;

impl Cells {
    /// The tetrahedron behind the `partner` of a patch that a sphere comes into which leaves another one, `from`, by that patch at `x`, and how it is
    /// carried.
    ///
    /// The faces of the partner alone count: where both sides lie on each other, cells of the side that it left hold it as well.
    pub(crate) fn carry_behind(
        &self,
        carry: Carry,
        partner: usize,
        from: &Tetrahedron,
        x: Vec3,
    ) -> (Tetrahedron, Carry) {
        let faces = self.patches.get(partner).map_or(0..0, |patch| patch.faces.clone());
        self.over_gap(carry, x, SAGITTA * self.chord(from.id), |face| faces.contains(&face))
    }

    /// The tetrahedron that a sphere comes into which leaves a wedge at `x` towards `v`, and how it is carried.
    pub(crate) fn carry_back(&self, carry: Carry, x: Vec3, v: Vec3) -> (Tetrahedron, Carry) {
        let into = self.find_ahead(carry.point(x), carry.vector(v));
        if !into.is_nowhere() {
            return (into, carry);
        }
        let sides = || self.patches.iter().filter(|patch| patch.kind == PatchKind::Wedge);
        self.over_gap(carry, x, 0.0, |face| sides().any(|patch| patch.faces.contains(&face)))
    }

    /// Carries a sphere behind the nearest of some faces of the boundary, over a gap that may be so wide, m.
    fn over_gap(&self, carry: Carry, x: Vec3, wide: f64, faces: impl Fn(usize) -> bool) -> (Tetrahedron, Carry) {
        let (there, size) = (self.flat(carry.point(x)), norm(sub(self.bounds.max, self.bounds.min)));
        let found = REACHES.iter().find_map(|reach| self.nearest_face(there, reach * size, &faces));
        let allowed = |tet: u32| wide.max(SAGITTA * self.chord(tet)).max(ROUNDED * size);
        let Some((off, on, here)) = found.filter(|(off, _, here)| *off <= allowed(here.id)) else {
            return (Tetrahedron::NOWHERE, carry);
        };
        if holds(&here, there) {
            return (here, carry);
        }
        let (into, place) = self.behind_face(&here, on, off);
        (into, carry.then(&Carry::by(sub(self.flat(place), there))))
    }

    /// The nearest point within reach, m, on some faces of the boundary: its distance, the point, and the tetrahedron behind it.
    fn nearest_face(&self, x: Vec3, reach: f64, faces: &impl Fn(usize) -> bool) -> Option<(f64, Vec3, Tetrahedron)> {
        let (mut least, mut best) = (reach, None);
        self.locator.as_ref()?.meeting(&Bounds::around([x]).wider(reach), |cell| {
            for tet in self.cut.of_cell(cell as usize).filter(|tet| faces(self.cut.face(*tet) as usize)) {
                let corners = self.face_corners(tet);
                let on = if self.plane.is_some() { nearest_along(corners, x) } else { nearest_point(&corners, x) };
                let off = norm(sub(x, on));
                if off <= least
                    && let Some(here) = self.tetrahedron_of(tet, cell)
                {
                    (least, best) = (off, Some((off, on, here)));
                }
            }
        });
        best
    }

    /// Corners of a tetrahedron's triangle, in the plane of a plane case, m.
    fn face_corners(&self, tet: u32) -> Triangle {
        self.cut.triangles[(tet >> 1) as usize].map(|p| self.flat(self.nodes[p as usize].place))
    }

    /// The longest side of a tetrahedron's triangle, m.
    fn chord(&self, tet: u32) -> f64 {
        let [a, b, c] = self.face_corners(tet);
        [(a, b), (b, c), (c, a)].into_iter().map(|(from, to)| norm(sub(to, from))).fold(0.0, f64::max)
    }

    /// The place in a cell that is as deep behind a point on its face; nearer to the face and towards the cell's centre where that is outside.
    fn behind_face(&self, here: &Tetrahedron, on: Vec3, deep: f64) -> (Tetrahedron, Vec3) {
        let rise = here.normal(3);
        let place = unit(rise).map_or(on, |inwards| add(on, scale(inwards, deep)));
        let cell = here.cell;
        let mut all = self.cut.of_cell(cell as usize).filter_map(|tet| self.tetrahedron_of(tet, cell));
        match all.find(|tet| holds(tet, place)) {
            Some(into) => (into, place),
            None => (*here, add(on, scale(sub(here.origin, on), (deep * norm(rise)).min(DEEPEST)))),
        }
    }
}

/// The nearest point of a triangle that stands on the plane of a plane case: of its longest side.
fn nearest_along([a, b, c]: Triangle, x: Vec3) -> Vec3 {
    let length = |(from, to): (Vec3, Vec3)| dot(sub(to, from), sub(to, from));
    let longest = |s, t| if length(t) > length(s) { t } else { s };
    let (from, to) = [(b, c), (c, a)].into_iter().fold((a, b), longest);
    let along = sub(to, from);
    let square = length((from, to));
    let share = if square > 0.0 { dot(sub(x, from), along) / square } else { 0.0 };
    add(from, scale(along, share.clamp(0.0, 1.0)))
}

fn holds(tet: &Tetrahedron, x: Vec3) -> bool {
    tet.coordinates(x).into_iter().all(|c| c > -ROUNDING)
}
