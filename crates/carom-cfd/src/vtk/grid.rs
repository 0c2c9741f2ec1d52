//! A part of a result as its file holds it.

use super::cells::{Shape, is_flat, is_quadratic, is_solid, shape};
use super::data::Data;
use crate::Polygons;

/// Cells of any kinds, and what is known at their points and in them.
#[derive(Debug, Default)]
pub(super) struct Grid {
    pub points: Vec<[f64; 3]>,
    /// Kinds by VTK's numbers; 0 where a cell is left out.
    pub kinds: Vec<u8>,
    /// Points of the cells; nothing for polyhedra.
    pub cells: Polygons,
    pub shells: Shells,
    pub data: Data,
    pub time: Option<f64>,
}

/// The faces of polyhedra: those of cell `c` are `starts[c]..starts[c + 1]`. Empty where there are no polyhedra.
#[derive(Debug, Default)]
pub(super) struct Shells {
    pub starts: Vec<u32>,
    pub faces: Polygons,
}

impl Shells {
    pub fn of(&self, cell: usize) -> std::ops::Range<usize> {
        match self.starts.get(cell..cell + 2) {
            Some([from, to]) => *from as usize..*to as usize,
            _ => 0..0,
        }
    }
}

/// Puts together lists of points as they are in a file: places where each ends (or begins and ends, one more), and the points.
pub(super) fn polygons(starts: Vec<u32>, corners: Vec<u32>, points: usize, what: &str) -> Result<Polygons, String> {
    if starts.first() != Some(&0) || !starts.is_sorted() || starts.last().map(|n| *n as usize) != Some(corners.len()) {
        return Err(format!("the places where {what} begin do not fit the list of their points"));
    }
    if let Some(place) = corners.iter().position(|p| *p as usize >= points) {
        let n = starts.partition_point(|s| *s as usize <= place) - 1;
        return Err(format!("number {n} of {what} has a point that is not there; there are {points}"));
    }
    Ok(Polygons { starts, corners })
}

/// The starts of lists that end at these places.
pub(super) fn starts(ends: Vec<u32>) -> Vec<u32> {
    let mut starts = ends;
    starts.insert(0, 0);
    starts
}

/// Faces in a stream as polyhedra once were stored: how many faces, then of each how many corners, and these.
pub(super) fn stream(numbers: &[u32], faces: &mut Polygons) -> Option<()> {
    let (count, mut rest) = numbers.split_first()?;
    for _ in 0..*count {
        let (corners, after) = rest.split_first()?;
        let (corners, after) = after.split_at_checked(*corners as usize)?;
        faces.corners.extend(corners);
        faces.starts.push(u32::try_from(faces.corners.len()).ok()?);
        rest = after;
    }
    rest.is_empty().then_some(())
}

impl Grid {
    pub fn has_solids(&self) -> bool {
        self.kinds.iter().any(|k| is_solid(*k))
    }

    pub fn has_polygons(&self) -> bool {
        self.kinds.iter().any(|k| is_flat(*k))
    }

    /// Refuses cells of kinds that are not read, and those that have not as many points as their kind.
    pub fn check(&self) -> Result<(), String> {
        for (cell, kind) in self.kinds.iter().enumerate() {
            let found = self.cells.get(cell).len();
            let fits = match shape(*kind) {
                Shape::Thin => true,
                Shape::Flat([]) => found >= 3,
                Shape::Flat(order) => found >= order.len() && (is_quadratic(*kind) || found == order.len()),
                Shape::FlatQuadratic => found >= 6 && found.is_multiple_of(2),
                Shape::Solid(solid) => found >= solid.corners && (is_quadratic(*kind) || found == solid.corners),
                Shape::Polyhedron => self.shells.of(cell).len() >= 4,
                Shape::Other => {
                    return Err(format!("cell {cell} is of VTK's kind {kind}, which is not read"));
                }
            };
            if !fits {
                let name = match shape(*kind) {
                    Shape::Solid(solid) => solid.name,
                    Shape::Polyhedron => "polyhedron of too few faces",
                    _ => "polygon",
                };
                return Err(format!("cell {cell} is a {name} (VTK's kind {kind}) of {found} points"));
            }
        }
        Ok(())
    }

    /// Refuses points of cells that are no places. Those of cells that are left out, and of none, may be anything.
    pub fn check_places(&self) -> Result<(), String> {
        let is_place = |x: &[f64; 3]| x.iter().all(|c| c.is_finite());
        if self.points.iter().all(is_place) {
            return Ok(());
        }
        let used = self.used(|kind| shape(kind) != Shape::Thin);
        match self.points.iter().zip(used).position(|(x, used)| used && !is_place(x)) {
            Some(p) => Err(format!("point {p} is no place: {:?}", self.points[p])),
            None => Ok(()),
        }
    }

    /// Of each point whether cells of such kinds are made of it.
    pub fn used(&self, wanted: impl Fn(u8) -> bool) -> Vec<bool> {
        let mut used = vec![false; self.points.len()];
        let mut mark = |corners: &[u32]| corners.iter().for_each(|p| used[*p as usize] = true);
        for (cell, kind) in self.kinds.iter().enumerate().filter(|(_, kind)| wanted(**kind)) {
            let all = self.cells.get(cell);
            match shape(*kind) {
                Shape::Solid(solid) => mark(all.get(..solid.corners).unwrap_or(all)),
                Shape::Polyhedron => self.shells.of(cell).for_each(|face| mark(self.shells.faces.get(face))),
                _ => mark(all),
            }
        }
        used
    }

    /// The corners of a cell that is a polygon, in order round it.
    pub fn polygon(&self, cell: usize) -> Option<Vec<u32>> {
        let all = self.cells.get(cell);
        Some(match shape(*self.kinds.get(cell)?) {
            Shape::Flat([]) => all.to_vec(),
            Shape::Flat(order) => order.iter().filter_map(|i| all.get(usize::from(*i)).copied()).collect(),
            Shape::FlatQuadratic => all[..all.len() / 2].to_vec(),
            _ => return None,
        })
    }
}
