//! Finished results as VTK holds them.
//!
//! Read are
//!
//! - XML: unstructured grids (`.vtu`), in pieces (`.pvtu`), and blocks of such (`.vtm`, `.vtpc`, `.vtpd`) with surfaces (`.vtp`, or `.vtu` of polygons) that name
//!   parts of the boundary. ASCII, or binary inline or appended, raw or base64, plain or compressed with zlib or LZ4, either byte order,
//!   headers of 32 or 64 bits.
//! - Legacy files (`.vtk`) of an unstructured grid, ASCII or binary, versions 2 to 5.1.
//!
//! What a file is, its first bytes tell, not its name.
//!
//! **Cells**: tetrahedra, hexahedra, voxels, wedges, pyramids, prisms of five and six sides, and polyhedra in both forms (a stream of faces, and lists since VTK
//! 9.4). Quadratic, Lagrange and Bézier cells are taken by their corners, which come first in all of them. Cells of points, and
//! of lines among solid ones, are of no use and left out. Wherever faces turn, the result's turn out of their cells.
//!
//! Where all cells are polygons of one plane, the result is plane: one layer of cells between two [empty](crate::PatchKind::Empty) sides; or, with [`Options::axis`],
//! axisymmetric: a [wedge](crate::PatchKind::Wedge) of 5°. Lines are polygons of the boundary then.
//!
//! **The boundary**: a block's polygons lie on the outer faces whose corners have exactly the same coordinates, and the patch is called as the block.
//! Polygons beside the solid cells of a grid do the same; [`Options::patches`] names the cell array whose values are the patches'
//! names. All other outer faces are one patch, `boundary`. VTK knows no kinds of patches: all others are [`PatchKind::Plain`].
//!
//! **Fields**: of points, or else of cells. Velocity by the names `U`, `velocity`, `Velocity`, or as [`Options::names`] says; then `k`, `epsilon`, `omega`, `rho` or
//! `density`, `T` or `temperature`, `p` or `pressure` and what programs call them. On the boundary a field of cells has the values of the blocks, or else the cells'.
//!
//! **Refused**, with the place: faces of three cells, cells on the same side of a common face, open cells, points that are no places, NaN and infinity in a field that is used where solid cells have it, cells and
//! points that are hidden or not valid. Copies of other pieces' cells (`vtkGhostType`) are left out. Not read: LZMA, strips of triangles, convex
//! point sets, structured and hyper-tree grids.

mod agree;
mod assemble;
mod cells;
mod data;
mod files;
mod flat;
mod grid;
mod join;
pub mod legacy;
mod number;
mod old;
mod patches;
mod piece;
#[cfg(feature = "fluent")]
mod plane;
mod sides;
mod turn;
pub mod xml;

pub use number::{Number, Stored};
#[cfg(feature = "fluent")]
pub(crate) use plane::{Flat, Values};

use crate::{Error, Names, PatchKind, Snapshot, check};
use cells::{is_flat, is_solid};
use files::{Block, Found, Load, need_solids};
use grid::Grid;
use patches::Surface;
use std::collections::HashMap;
use std::path::Path;

/// What a reader is told.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Names of the arrays, where they are not the usual ones.
    pub names: Names,
    /// The cell array of the polygons beside solid cells, whose values name patches.
    pub patches: Option<String>,
    /// The axis of a result whose cells are polygons of a plane; none: such a result is plane.
    pub axis: Option<Axis>,
}

/// The axis of the coordinates round which an axisymmetric result goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "their names say it")]
pub enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    /// All, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// `x`, `y` or `z`.
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }

    /// The one of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|axis| axis.name() == name)
    }

    fn direction(self) -> [f64; 3] {
        Self::ALL.map(|axis| f64::from(u8::from(axis == self)))
    }
}

/// Reads a file and those that it names.
///
/// # Errors
/// What cannot be read, or cannot be used: see [above](self).
pub fn read(file: &Path, options: &Options) -> Result<Snapshot, Error> {
    let load = |path: &Path| carom_table::file::read_regular(path, u64::MAX).map_err(|e| Error::io(path, e));
    snapshot(load(file)?, file, &load, options)
}

/// Reads what is in a file, which may name no others.
///
/// # Errors
/// What cannot be read, or cannot be used: see [above](self).
pub fn from_bytes(file: Vec<u8>, options: &Options) -> Result<Snapshot, Error> {
    let none = |path: &Path| Err(Error::file(path, "another file is named, and only one was given"));
    snapshot(file, Path::new("VTK"), &none, options)
}

fn snapshot(bytes: Vec<u8>, path: &Path, load: Load, options: &Options) -> Result<Snapshot, Error> {
    let mut notes = Vec::new();
    let mut found = files::all(&bytes, path, load, options)?;
    drop(bytes);
    need_solids(&mut found, options, path, &mut notes)?;
    of_found(found, path, options, notes)
}

/// What grids of solid cells make with those that name parts of their boundary.
fn of_found(found: Found, path: &Path, options: &Options, mut notes: Vec<String>) -> Result<Snapshot, Error> {
    let fail = |what: String| Error::file(path, what);
    if found.blocks.len() > 1 {
        let names = found.blocks.join(", ");
        notes.push(format!("the blocks {names} are one mesh: they hang together where points coincide exactly"));
    }
    let grid = join::join(found.solids, &mut notes).map_err(fail)?;
    if grid.data.ghosts > 0 {
        notes.push(format!(
            "{} cells are copies of another piece's (vtkGhostType): they are left out",
            grid.data.ghosts
        ));
    }
    let solids: Vec<u32> = (0..grid.kinds.len() as u32).filter(|c| is_solid(grid.kinds[*c as usize])).collect();
    let sides = sides::Sides::of(&grid, &solids, &mut notes).map_err(fail)?;
    let all = |grid: &Grid| (0..grid.kinds.len() as u32).collect();
    let blocks = found.surfaces.iter().map(|Block { name, kind, grid }| Surface {
        name: name.clone(),
        kind: kind.clone(),
        grid,
        cells: all(grid),
        among_cells: false,
    });
    let mut surfaces: Vec<Surface> = blocks.collect();
    surfaces.extend(beside(&grid, surfaces.is_empty(), path, options, &mut notes)?);
    for Block { name, kind, grid } in &found.sides {
        let mut name = name.clone();
        while surfaces.iter().any(|s| s.name == name) {
            name.push('_');
        }
        surfaces.push(Surface { name, kind: kind.clone(), grid, cells: all(grid), among_cells: true });
    }
    let boundary = patches::boundary(&grid.points, &sides, &surfaces, &mut notes).map_err(fail)?;
    let (mesh, kept) = assemble::mesh(&grid, &sides, &boundary);
    drop(sides);
    let kept = kept.as_deref();
    let sources =
        assemble::Sources { grid: &grid, solids: &solids, kept, surfaces: &surfaces, boundary: &boundary, mesh: &mesh };
    let fields = sources.fields(&mut notes);
    let time = found.time.or(grid.time).map(|t| t.to_string());
    let snapshot = Snapshot { mesh, fields, time, notes };
    check::snapshot(&snapshot)?;
    Ok(snapshot)
}

/// Patches that a cell array may name.
const MOST_PATCHES: usize = 10_000;

/// The polygons beside the solid cells of a grid, by the patches that their values name.
fn beside<'a>(
    grid: &'a Grid,
    alone: bool,
    path: &Path,
    options: &Options,
    notes: &mut Vec<String>,
) -> Result<Vec<Surface<'a>>, Error> {
    let flat: Vec<u32> = (0..grid.kinds.len() as u32).filter(|c| is_flat(grid.kinds[*c as usize])).collect();
    let mut surfaces: Vec<Surface> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    let mut add = |name: String, cell: u32| {
        let next = surfaces.len();
        match *places.entry(name.clone()).or_insert(next) {
            place if place < next => surfaces[place].cells.push(cell),
            _ => surfaces.push(Surface { name, kind: PatchKind::Plain, grid, cells: vec![cell], among_cells: true }),
        }
        next < MOST_PATCHES
    };
    match (&options.patches, &grid.data.labels) {
        (Some(array), None) if alone => {
            let (path, there) = (path.to_owned(), grid.data.others.clone());
            return Err(Error::Missing { path, kind: "cell array", name: array.clone(), there });
        }
        (Some(array), Some(_)) if flat.is_empty() => {
            let what =
                format!("no boundary cells lie beside the others: values of {array} could name patches on such only");
            return Err(Error::file(path, what));
        }
        (_, Some(labels)) => {
            let few = flat.iter().all(|c| add(labels.name(*c as usize).unwrap_or_default(), *c));
            let name = options.patches.as_deref().unwrap_or_default();
            let what = format!("{name} names more than {MOST_PATCHES} patches: is that the array?");
            return if few { Ok(surfaces) } else { Err(Error::file(path, what)) };
        }
        (_, None) if alone && !flat.is_empty() => {
            notes.push(format!(
                "{} boundary cells lie beside the others: patches = \"...\" names the cell array whose values are the patches' names",
                flat.len()
            ));
        }
        _ => {}
    }
    Ok(surfaces)
}

#[cfg(test)]
mod tests;
