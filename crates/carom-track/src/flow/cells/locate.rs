//! Which tetrahedron a point lies in, asked where a sphere starts or has lost its place.

use super::Cells;
use super::cut::NONE;
use super::tetrahedron::ROUNDING;
use crate::geometry::{Bounds, Halves, Tree};
use crate::vector::Vec3;
use rayon::prelude::*;

/// A hierarchy of boxes around cells.
#[derive(Debug)]
pub(super) struct Locator {
    tree: Tree,
    /// Cells in the order in which leaves name them.
    order: Vec<u32>,
}

impl Locator {
    pub fn new(cells: &Cells) -> Self {
        let boxes: Vec<Bounds> = (0..cells.cut.cells())
            .into_par_iter()
            .map(|cell| {
                let faces = cells.cut.faces(cell).iter();
                let triangles = faces.flat_map(|f| {
                    let (a, b) = (cells.cut.first[*f as usize], cells.cut.first[*f as usize + 1]);
                    cells.cut.triangles[a as usize..b as usize].iter().flatten()
                });
                let around = Bounds::around(triangles.map(|p| cells.flat(cells.nodes[*p as usize].place)));
                let around = around.with(cells.flat(cells.nodes[cells.centre(cell)].place));
                around.wider(1e-9 * (0..3).map(|c| around.max[c] - around.min[c]).fold(0.0, f64::max))
            })
            .collect();
        let (tree, order) = Tree::new(&boxes, Halves::Middle);
        Self { tree, order }
    }

    /// Cells whose boxes hold a point.
    fn around(&self, x: Vec3, tell: impl FnMut(u32)) {
        self.meeting(&Bounds::around([x]), tell);
    }

    /// Cells whose boxes meet another.
    pub fn meeting(&self, region: &Bounds, mut tell: impl FnMut(u32)) {
        let mut stack = arrayvec::ArrayVec::<u32, { crate::geometry::STACK }>::new();
        if !self.tree.nodes.is_empty() {
            stack.push(0);
        }
        while let Some(node) = stack.pop() {
            for (_, child) in self.tree.nodes[node as usize].children().filter(|(b, _)| b.meets(region)) {
                for i in child.first..child.first + child.count {
                    tell(self.order[i as usize]);
                }
                if child.count == 0 {
                    stack.push(child.first);
                }
            }
        }
    }

    /// The tetrahedron of a point; none outside all cells. Of several that hold it, on a side or where cells overlap, the one it is
    /// deepest in.
    pub fn find(&self, cells: &Cells, x: Vec3) -> Option<u32> {
        let (mut best, mut found) = (-ROUNDING, NONE);
        self.around(cells.flat(x), |cell| {
            for tet in cells.cut.of_cell(cell as usize) {
                let Some(here) = cells.tetrahedron(tet) else { continue };
                let depth = here.coordinates(x).into_iter().fold(f64::INFINITY, |m, l| if l < m { l } else { m });
                if depth > best {
                    (best, found) = (depth, tet);
                }
            }
        });
        (found != NONE).then_some(found)
    }
}
