//! A plane or axisymmetric result that another reader has found.

use super::cells::{LINE, POLYGON};
use super::data::COUNT;
use super::files::{Block, Found};
use super::grid::Grid;
use super::{Axis, Options, flat, of_found};
use crate::points::renumber;
use crate::{Error, PatchKind, Polygons, Snapshot};
use std::path::Path;

/// Values of each quantity, one after the other.
pub(crate) type Values = [Option<Vec<f64>>; COUNT];

/// Cells that are polygons of a plane, with faces of the boundary that are lines.
pub(crate) struct Flat {
    grid: Grid,
    boundary: Vec<Block>,
}

impl Flat {
    /// Cells with their values, and the names of fields that are not used.
    pub fn new(points: Vec<[f64; 3]>, cells: Polygons, values: Values, others: Vec<String>) -> Self {
        let mut grid = Grid { points, kinds: vec![POLYGON; cells.len()], cells, ..Grid::default() };
        (grid.data.cells, grid.data.others) = (values, others);
        Self { grid, boundary: Vec::new() }
    }

    /// Adds a patch of lines between points of the cells, with their values.
    pub fn add_boundary(&mut self, name: &str, kind: PatchKind, lines: &[[u32; 2]], values: Values) {
        let starts = (0..=lines.len() as u32).map(|n| 2 * n).collect();
        let mut cells = Polygons { starts, corners: lines.concat() };
        let points = match renumber(&mut cells.corners, self.grid.points.len()) {
            Some(kept) => kept.iter().map(|p| self.grid.points[*p as usize]).collect(),
            None => self.grid.points.clone(),
        };
        let mut grid = Grid { points, kinds: vec![LINE; lines.len()], cells, ..Grid::default() };
        grid.data.cells = values;
        self.boundary.push(Block { name: name.to_owned(), kind, grid });
    }

    /// The result, round an axis or plane.
    pub fn snapshot(self, axis: Option<Axis>, path: &Path, mut notes: Vec<String>) -> Result<Snapshot, Error> {
        let mut found = Found { solids: vec![self.grid], surfaces: self.boundary, ..Found::default() };
        flat::make_solid(&mut found, axis, false, &mut notes).map_err(|what| Error::file(path, what))?;
        of_found(found, path, &Options::default(), notes)
    }
}
