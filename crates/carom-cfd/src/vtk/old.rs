//! Unstructured grids in legacy files.

use super::Options;
use super::data::{Arrays, Described, gather};
use super::grid::{Grid, Shells, polygons, stream};
use super::legacy::{Array, Problem, Reader, decoded};
use crate::{Error, Polygons};
use carom_table::clipped;
use std::path::Path;

/// The grid of a file.
pub(super) fn grid(file: &[u8], path: &Path, options: &Options) -> Result<Grid, Error> {
    let fail = |p: Problem| Error::file(path, format!("byte {}: {}", p.byte, p.what));
    let mut reader = Reader::new(file).map_err(fail)?;
    let mut grid = geometry(&mut reader).map_err(fail)?;
    grid.check().map_err(|what| Error::file(path, what))?;
    let arrays = reader.data_if_any(grid.points.len(), grid.kinds.len()).map_err(fail)?.unwrap_or_default();
    let describe = |a: &Array| Described { name: decoded(a.name.as_bytes()), components: a.components };
    let listed = [0, 1].map(|list| arrays[list].iter().map(describe).collect());
    gather(&mut grid, &mut InLegacy { reader, arrays, listed }, path, options)?;
    Ok(grid)
}

fn geometry(reader: &mut Reader) -> Result<Grid, Problem> {
    let kind = reader.expect("DATASET", 1)?[0].to_ascii_uppercase();
    if kind != "UNSTRUCTURED_GRID" {
        let what = format!("{} is no mesh of solid cells: DATASET UNSTRUCTURED_GRID is read", clipped(&kind));
        return Err(reader.error(what));
    }
    let mut grid = Grid::default();
    reader.skip_metadata();
    while reader.peek().first().is_some_and(|w| w.eq_ignore_ascii_case("FIELD")) {
        let count = reader.expect("FIELD", 2)?[1];
        for array in reader.field(count)? {
            if matches!(array.name, "TimeValue" | "TIME") && array.count == 1 && !array.is_text() {
                grid.time = reader.again(&array)?.first().copied();
            }
        }
    }
    points(reader, &mut grid)?;
    reader.skip_metadata();
    cells(reader, &mut grid)?;
    Ok(grid)
}

fn points(reader: &mut Reader, grid: &mut Grid) -> Result<(), Problem> {
    let words = reader.expect("POINTS", 2)?;
    let count = reader.parse::<usize>(words[0])?.checked_mul(3).ok_or_else(|| reader.error("too many points"))?;
    grid.points = reader.values::<f64>(count, words[1])?.as_chunks::<3>().0.to_vec();
    Ok(())
}

fn cells(reader: &mut Reader, grid: &mut Grid) -> Result<(), Problem> {
    let words = reader.expect("CELLS", 2)?;
    let (first, second) = (reader.parse::<usize>(words[0])?, reader.parse::<usize>(words[1])?);
    let (starts, corners) = if reader.major() >= 5 {
        let kind = reader.expect("OFFSETS", 1)?[0];
        let starts = reader.values::<u32>(first, kind)?;
        reader.skip_metadata();
        let kind = reader.expect("CONNECTIVITY", 1)?[0];
        (starts, reader.values::<u32>(second, kind)?)
    } else {
        counted(reader, first, second)?
    };
    let cells = starts.len().saturating_sub(1);
    reader.skip_metadata();
    let words = reader.expect("CELL_TYPES", 1)?;
    if reader.parse::<usize>(words[0])? != cells {
        return Err(reader.error(format!("{} kinds of {cells} cells", clipped(words[0]))));
    }
    grid.kinds = reader.values::<u8>(cells, "int")?;
    shells(grid, starts, corners).map_err(|what| reader.error(what))
}

/// Of each cell how many numbers it has, and these, as versions before 5 have it.
fn counted(reader: &mut Reader, cells: usize, size: usize) -> Result<(Vec<u32>, Vec<u32>), Problem> {
    let numbers = reader.values::<u32>(size, "int")?;
    let (mut starts, mut corners) = (vec![0], Vec::new());
    let mut rest = numbers.as_slice();
    for cell in 0..cells {
        let list = rest.split_first().and_then(|(n, rest)| rest.split_at_checked(*n as usize));
        let Some((list, after)) = list else {
            return Err(reader.error(format!("the points of cell {cell} do not fit their list")));
        };
        corners.extend(list);
        starts.push(corners.len() as u32);
        rest = after;
    }
    if rest.is_empty() { Ok((starts, corners)) } else { Err(reader.error("more points of cells than cells have")) }
}

/// Takes the faces of polyhedra out of the lists of points, where these files have them.
fn shells(grid: &mut Grid, starts: Vec<u32>, corners: Vec<u32>) -> Result<(), String> {
    let points = grid.points.len();
    if !grid.kinds.contains(&42) {
        grid.cells = polygons(starts, corners, points, "cells")?;
        return Ok(());
    }
    let lists = polygons(starts, corners, u32::MAX as usize, "cells")?;
    let mut cells = Polygons { starts: vec![0], corners: Vec::new() };
    let mut faces = cells.clone();
    let mut of_cells = vec![0];
    for (cell, kind) in grid.kinds.iter().enumerate() {
        let list = lists.get(cell);
        if *kind == 42 {
            stream(list, &mut faces).ok_or_else(|| format!("the faces of cell {cell} do not fit their list"))?;
        } else {
            cells.corners.extend(list);
        }
        cells.starts.push(cells.corners.len() as u32);
        of_cells.push(faces.len() as u32);
    }
    grid.cells = polygons(cells.starts, cells.corners, points, "cells")?;
    grid.shells = Shells { starts: of_cells, faces: polygons(faces.starts, faces.corners, points, "faces")? };
    Ok(())
}

/// The arrays of a file.
struct InLegacy<'a> {
    reader: Reader<'a>,
    arrays: [Vec<Array<'a>>; 2],
    listed: [Vec<Described>; 2],
}

impl Arrays for InLegacy<'_> {
    fn listed(&self) -> &[Vec<Described>; 2] {
        &self.listed
    }

    fn read(&mut self, of_cells: bool, index: usize) -> Result<Vec<f64>, String> {
        let array = self.arrays[usize::from(of_cells)][index];
        self.reader.decoded(&array).map_err(|p| format!("array {}: {}", clipped(array.name), p.what))
    }

    fn text_names(&self) -> Vec<String> {
        self.reader.text_arrays().iter().map(|a| decoded(a.name.as_bytes())).collect()
    }

    fn texts(&mut self, name: &str) -> Option<Result<Vec<String>, String>> {
        let all = self.reader.text_arrays();
        let array = *all.iter().find(|a| a.components == 1 && decoded(a.name.as_bytes()) == name)?;
        Some(self.reader.texts(&array).map_err(|p| format!("array {}: {}", clipped(array.name), p.what)))
    }
}
