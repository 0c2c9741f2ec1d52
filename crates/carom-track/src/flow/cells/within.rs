//! Faces of the boundary behind which the mesh goes on: cells that lie beside each other without sharing points, hang by nodes between, or overlap.
//! To a sphere they are the end of the space.

use super::Cells;
use crate::vector::{Vec3, add, scale};
use carom_cfd::{Patch, PatchKind};
use rayon::prelude::*;

/// How far behind a face another cell is looked for, over the height of the cell before it.
const BEHIND: f64 = 0.01;

impl Cells {
    /// What to say of a mesh whose faces were found by what cells share, if some of its boundary lies inside it: `None` for one that hangs together.
    pub fn boundary_inside(&self) -> Option<String> {
        let ends = |p: &&Patch| matches!(p.kind, PatchKind::Wall | PatchKind::Plain);
        let found = self.patches.iter().filter(ends).map(|patch| (patch, self.within(patch)));
        let worst: Vec<_> = found.filter(|(_, places)| !places.is_empty()).collect();
        let (patch, places) = worst.first()?;
        let [x, y, z] = places[0];
        let count: usize = worst.iter().map(|(_, places)| places.len()).sum();
        Some(format!(
            "{count} faces of the boundary have other cells right behind them, the first in patch '{}' at ({x:.6e} {y:.6e} {z:.6e}) m: cells hang together \
             only where they have points in common, so what flies through ends there; join the points (ParaView: Clean to Grid), unless walls without \
             thickness are meant",
            patch.name
        ))
    }

    /// Middles of a patch's faces that lie inside the mesh, m.
    fn within(&self, patch: &Patch) -> Vec<Vec3> {
        patch.faces.clone().into_par_iter().filter_map(|face| self.other_cell_behind(face)).collect()
    }

    /// The middle of a face's first triangle, if another cell is behind it.
    fn other_cell_behind(&self, face: usize) -> Option<Vec3> {
        let tet = 2 * self.cut.first[face];
        let ([a, b, c], out, height) = self.face(tet)?;
        let middle = scale(add(a, add(b, c)), 1.0 / 3.0);
        let there = self.find(add(middle, scale(out, BEHIND * height)));
        (!there.is_nowhere() && there.cell != self.cut.cell(tet)).then_some(middle)
    }
}
