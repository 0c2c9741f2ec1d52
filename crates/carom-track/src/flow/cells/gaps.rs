//! Over the gap between a patch and its partner: the facets of a curved `cyclicAMI` are chords, which do not coincide once one side has turned, and
//! coordinates are rounded. A sphere that is carried into such a gap goes on from within the partner's cell, as far from its face as it was before it.

use super::{Cells, Tetrahedron};
use crate::geometry::Bounds;
use crate::vector::{Vec3, add, dot, norm, scale, sub};
use carom_cfd::Carry;

/// Gaps looked for, over the size of the mesh: from rounding to the gap under a chord of a twelfth of a circle.
const REACHES: [f64; 8] = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2];

impl Cells {
    /// The tetrahedron that a sphere comes into which is carried from `x` and went along `v`, and how it is carried.
    pub(crate) fn carry_over(&self, carry: Carry, x: Vec3, v: Vec3) -> (Tetrahedron, Carry) {
        let there = carry.point(x);
        let into = self.find_ahead(there, carry.vector(v));
        let over = if into.is_nowhere() { self.over_gap(there) } else { None };
        over.map_or((into, carry), |(into, shift)| (into, carry.then(&Carry::by(shift))))
    }

    #[cold]
    fn over_gap(&self, x: Vec3) -> Option<(Tetrahedron, Vec3)> {
        let size = norm(sub(self.bounds.max, self.bounds.min));
        REACHES.iter().find_map(|reach| {
            let into = |shift: Vec3| Some(self.find(add(x, shift))).filter(|t| !t.is_nowhere()).map(|t| (t, shift));
            self.ways_in(x, reach * size).into_iter().find_map(|(_, shift)| into(shift))
        })
    }

    /// Distances from tetrahedra within reach, m, nearest first, and the shifts that put `x` as far inside.
    fn ways_in(&self, x: Vec3, reach: f64) -> Vec<(f64, Vec3)> {
        let mut ways = Vec::new();
        let Some(locator) = &self.locator else { return ways };
        locator.meeting(&Bounds::around([self.flat(x)]).wider(reach), |cell| {
            for here in self.cut.of_cell(cell as usize).filter_map(|tet| self.tetrahedron(tet)) {
                let sides = here.coordinates(x).into_iter().enumerate().filter(|(_, at)| *at < 0.0);
                let off = sides.map(|(side, at)| {
                    let normal = here.normal(side);
                    let square = dot(normal, normal);
                    (-at / square.sqrt(), scale(normal, -2.0 * at / square))
                });
                ways.extend(off.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(off, _)| *off <= reach));
            }
        });
        ways.sort_by(|a, b| a.0.total_cmp(&b.0));
        ways
    }
}
