//! The faces of solid cells, each turned out of its cell, and which of them are the two sides of one.

use super::agree::agree;
use super::cells::{Shape, is_quadratic, shape};
use super::grid::Grid;
use super::turn::turned_out;
use crate::Polygons;

/// No face.
pub(super) const NONE: u32 = u32::MAX;

/// Faces of cells: those of the cell in place `c` are `starts[c]..starts[c + 1]`.
#[derive(Debug, Default)]
pub(super) struct Sides {
    pub starts: Vec<u32>,
    pub faces: Polygons,
    /// The other side of each, [`NONE`] of an outer one.
    pub other: Vec<u32>,
}

impl Sides {
    /// Those of a grid's cells of these numbers.
    pub fn of(grid: &Grid, solids: &[u32], notes: &mut Vec<String>) -> Result<Self, String> {
        let mut sides =
            Self { starts: vec![0], faces: Polygons { starts: vec![0], ..Default::default() }, other: vec![] };
        sides.faces.corners.reserve(solids.len() * 12);
        let (mut quadratic, mut inside_out, mut edges) = (0, 0, Vec::new());
        let mut may_turn = Vec::with_capacity(solids.len());
        for &cell in solids {
            let kind = grid.kinds[cell as usize];
            quadratic += usize::from(is_quadratic(kind));
            let first = sides.faces.len();
            sides.add(grid, cell as usize)?;
            let solid = match shape(kind) {
                Shape::Solid(solid) => Some(solid),
                _ => None,
            };
            let turned = turned_out(&grid.points, &mut sides.faces, first, solid.is_some(), &mut edges);
            let turned = turned.map_err(|what| format!("cell {cell}: {what}"))?;
            let agreed = solid.is_some_and(|s| s.agreed);
            inside_out += usize::from(turned && agreed);
            may_turn.push(turned || !agreed);
            sides.starts.push(sides.faces.len() as u32);
        }
        if quadratic > 0 {
            notes.push(format!(
                "{quadratic} cells of higher order are taken by their corners: their sides are straight"
            ));
        }
        if inside_out > 0 {
            notes.push(format!("{inside_out} cells list their corners inside out: they are turned"));
        }
        sides.other = partners(&sides, grid.points.len(), solids)?;
        agree(&mut sides, solids, &may_turn, notes)?;
        Ok(sides)
    }

    /// The faces of one more cell.
    fn add(&mut self, grid: &Grid, cell: usize) -> Result<(), String> {
        let corners = grid.cells.get(cell);
        match shape(grid.kinds[cell]) {
            Shape::Solid(solid) => {
                for face in solid.faces {
                    self.push(face.iter().map(|i| corners[usize::from(*i)]));
                }
            }
            _ => {
                for face in grid.shells.of(cell) {
                    self.push(grid.shells.faces.get(face).iter().copied());
                }
            }
        }
        if u32::try_from(self.faces.corners.len()).is_err() { Err("too many cells".to_owned()) } else { Ok(()) }
    }

    /// A face; corners that fall together are one, and what is then no polygon is no face.
    fn push(&mut self, corners: impl Iterator<Item = u32>) {
        let all = &mut self.faces.corners;
        let begin = all.len();
        for corner in corners {
            if all.len() == begin || all.last() != Some(&corner) {
                all.push(corner);
            }
        }
        if all.len() > begin + 1 && all.last() == all.get(begin) {
            all.pop();
        }
        if all.len() < begin + 3 {
            all.truncate(begin);
        } else {
            self.faces.starts.push(all.len() as u32);
        }
    }

    /// The cell, by its place, of each face.
    pub fn cells(&self) -> Vec<u32> {
        let mut cells = Vec::with_capacity(self.faces.len());
        for (place, ends) in self.starts.windows(2).enumerate() {
            cells.extend((ends[0]..ends[1]).map(|_| place as u32));
        }
        cells
    }
}

/// A face among those that have their lowest corner in common: its other corners in order (of more than four, some of them), how many.
type Key = ([u32; 3], u32);

fn key(corners: &[u32]) -> Key {
    let count = corners.len() as u32;
    match *corners {
        [a, b, c] => {
            let mut all = [a, b, c];
            all.sort_unstable();
            ([all[1], all[2], 0], count)
        }
        [a, b, c, d] => {
            let mut all = [a, b, c, d];
            all.sort_unstable();
            ([all[1], all[2], all[3]], count)
        }
        _ => {
            let all = sorted(corners);
            ([all[1], all[2], all[all.len() - 1]], count)
        }
    }
}

fn sorted(corners: &[u32]) -> Vec<u32> {
    let mut all = corners.to_vec();
    all.sort_unstable();
    all
}

/// The other side of each face: the one with the same corners.
fn partners(sides: &Sides, points: usize, solids: &[u32]) -> Result<Vec<u32>, String> {
    let faces = &sides.faces;
    let lowest = |f: usize| faces.get(f).iter().copied().min().unwrap_or_default() as usize;
    // faces in the order of their lowest corners
    let mut starts = vec![0u32; points + 1];
    for f in 0..faces.len() {
        starts[lowest(f) + 1] += 1;
    }
    for p in 0..points {
        starts[p + 1] += starts[p];
    }
    let mut next = starts.clone();
    let mut order = vec![0u32; faces.len()];
    for f in 0..faces.len() {
        let place = &mut next[lowest(f)];
        order[*place as usize] = f as u32;
        *place += 1;
    }
    drop(next);
    let mut other = vec![NONE; faces.len()];
    let mut near: Vec<(Key, u32)> = Vec::new();
    for ends in starts.windows(2) {
        near.clear();
        near.extend(order[ends[0] as usize..ends[1] as usize].iter().map(|f| (key(faces.get(*f as usize)), *f)));
        near.sort_unstable();
        for alike in near.chunk_by(|a, b| a.0 == b.0) {
            if alike.len() < 2 {
                continue;
            }
            if alike[0].0.1 <= 4 {
                pair(alike.iter().map(|a| a.1), sides, solids, &mut other)?;
                continue;
            }
            let mut whole: Vec<(Vec<u32>, u32)> =
                alike.iter().map(|a| (sorted(faces.get(a.1 as usize)), a.1)).collect();
            whole.sort_unstable();
            for same in whole.chunk_by(|a, b| a.0 == b.0) {
                pair(same.iter().map(|a| a.1), sides, solids, &mut other)?;
            }
        }
    }
    Ok(other)
}

/// Joins the faces that have the same corners, of which there may be two.
fn pair(
    mut same: impl ExactSizeIterator<Item = u32>,
    sides: &Sides,
    solids: &[u32],
    other: &mut [u32],
) -> Result<(), String> {
    let cell = |face: u32| solids[sides.starts.partition_point(|s| *s <= face) - 1];
    let count = same.len();
    let (Some(a), Some(b)) = (same.next(), same.next()) else { return Ok(()) };
    if let Some(c) = same.next() {
        let more = if count > 3 { format!(" and {} more", count - 3) } else { String::new() };
        return Err(format!("cells {}, {} and {}{more} have one face in common", cell(a), cell(b), cell(c)));
    }
    if cell(a) == cell(b) {
        return Err(format!("cell {} has the face of points {:?} twice", cell(a), sides.faces.get(a as usize)));
    }
    (other[a as usize], other[b as usize]) = (b, a);
    Ok(())
}
