//! What a file holds, with the files that it names.

use super::cells::is_flat;
use super::grid::Grid;
use super::xml::{Form, Node, Parts, child};
use super::{Options, flat, old, piece};
use crate::{Error, PatchKind, Wanted};
use memchr::memmem;
use std::path::{Path, PathBuf};

/// Reads a file that another names.
pub(super) type Load<'a> = &'a dyn Fn(&Path) -> Result<Vec<u8>, Error>;

/// What was found.
#[derive(Default)]
pub(super) struct Found {
    /// Grids with solid cells.
    pub solids: Vec<Grid>,
    /// Names of the blocks of solid cells.
    pub blocks: Vec<String>,
    /// Grids of polygons alone.
    pub surfaces: Vec<Block>,
    /// The sides beside the plane of a result that was made solid.
    pub sides: Vec<Block>,
    pub time: Option<f64>,
}

/// A grid that names a part of the boundary.
pub(super) struct Block {
    pub name: String,
    pub kind: PatchKind,
    pub grid: Grid,
}

/// All that a file holds.
pub(super) fn all(bytes: &[u8], path: &Path, load: Load, options: &Options) -> Result<Found, Error> {
    let mut found = Found::default();
    let composite = matches!(
        root_type(bytes),
        Some("vtkMultiBlockDataSet" | "vtkPartitionedDataSetCollection" | "vtkPartitionedDataSet")
    );
    if !composite {
        found.take(None, grids(bytes, path, load, options)?);
        return Ok(found);
    }
    let fail = |what: String| Error::file(path, what);
    let parts = Parts::of(bytes).map_err(fail)?;
    let document = parts.document().map_err(fail)?;
    let root = document.root_element();
    found.time = Form::of(root, &parts).ok().and_then(|form| piece::time(root, &form));
    let body = root.attribute("type").and_then(|kind| child(root, kind)).ok_or_else(|| fail("no blocks".to_owned()))?;
    for set in body.descendants().filter(|n| n.has_tag_name("DataSet")) {
        // blocks may be empty
        let Some(file) = set.attribute("file").filter(|f| !f.trim().is_empty()) else { continue };
        let path = beside(path, file);
        let grids = grids(&load(&path)?, &path, load, options)?;
        found.take(Some(&block_name(set, file)), grids);
    }
    Ok(found)
}

impl Found {
    /// All grids that the file holds.
    pub fn grids(&self) -> impl Iterator<Item = &Grid> + Clone {
        self.solids.iter().chain(self.surfaces.iter().map(|block| &block.grid))
    }

    /// Takes the grids of a block, or of a file without blocks.
    fn take(&mut self, block: Option<&str>, grids: Vec<Grid>) {
        let solid = grids.iter().any(Grid::has_solids) || grids.iter().any(|g| g.data.ghosts > 0);
        if let Some(name) = block.filter(|_| solid) {
            self.blocks.push(name.to_owned());
        }
        for grid in grids {
            if solid || block.is_none() {
                self.solids.push(grid);
            } else if let Some(name) = block {
                self.surfaces.push(Block { name: name.to_owned(), kind: PatchKind::Plain, grid });
            }
        }
    }
}

/// A block's own name, or that of the nearest block around it, or the file's.
fn block_name(set: Node, file: &str) -> String {
    let named = set.ancestors().find_map(|n| n.attribute("name").map(str::trim).filter(|n| !n.is_empty()));
    let stem = || Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned());
    named.map(str::to_owned).or_else(stem).unwrap_or_default()
}

fn beside(path: &Path, name: &str) -> PathBuf {
    path.parent().unwrap_or(Path::new("")).join(name.trim())
}

/// The grids of a file without blocks.
fn grids(bytes: &[u8], path: &Path, load: Load, options: &Options) -> Result<Vec<Grid>, Error> {
    let fail = |what: String| Error::file(path, what);
    let Some(kind) = root_type(bytes) else {
        if bytes.starts_with(b"# vtk") {
            return Ok(vec![old::grid(bytes, path, options)?]);
        }
        return Err(fail(
            "not a VTK file: it holds no VTKFile element and does not begin with \"# vtk DataFile\"".into(),
        ));
    };
    let (whole, part) = match kind {
        "PUnstructuredGrid" => ("PUnstructuredGrid", "UnstructuredGrid"),
        "PPolyData" => ("PPolyData", "PolyData"),
        _ => return piece::grids(bytes, path, options),
    };
    let parts = Parts::of(bytes).map_err(fail)?;
    let document = parts.document().map_err(fail)?;
    let body = child(document.root_element(), whole).ok_or_else(|| fail(format!("no {whole}")))?;
    let mut grids = Vec::new();
    for node in body.children().filter(|n| n.has_tag_name("Piece")) {
        let source = node.attribute("Source").ok_or_else(|| fail("a Piece without Source".into()))?;
        let path = beside(path, source);
        let bytes = load(&path)?;
        if root_type(&bytes) != Some(part) {
            return Err(Error::file(&path, format!("a piece must be of type {part}, as XML")));
        }
        grids.extend(piece::grids(&bytes, &path, options)?);
    }
    Ok(grids)
}

/// The type that a VTK XML file says it is of; of any other file nothing.
fn root_type(bytes: &[u8]) -> Option<&str> {
    let head = &bytes[..bytes.len().min(1 << 16)];
    let tag = &head[memmem::find(head, b"<VTKFile")?..];
    let tag = std::str::from_utf8(&tag[..memchr::memchr(b'>', tag)?]).ok()?;
    let at = tag.match_indices("type").find(|(i, _)| tag[..*i].ends_with(char::is_whitespace))?.0;
    let rest = tag[at + 4..].trim_start().strip_prefix('=')?.trim_start();
    let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    rest[1..].split(quote).next()
}

/// Makes the polygons of a plane or axisymmetric result solid; refuses files without cells.
pub(super) fn need_solids(
    found: &mut Found,
    options: &Options,
    path: &Path,
    notes: &mut Vec<String>,
) -> Result<(), Error> {
    let fail = |what: String| Error::file(path, what);
    if found.solids.iter().any(Grid::has_solids) {
        // lines are of no use to solid cells
        found.surfaces.retain(|block| block.grid.has_polygons());
        return match options.axis {
            Some(_) => {
                Err(fail("its cells are solid: axisymmetric is for results whose cells are polygons".to_owned()))
            }
            None => Ok(()),
        };
    }
    let count = found.grids().flat_map(|grid| &grid.kinds).filter(|kind| is_flat(**kind)).count();
    let ghosts: usize = found.solids.iter().map(|g| g.data.ghosts).sum();
    match (count, ghosts) {
        (0, 0) => Err(fail("no cells".to_owned())),
        (0, _) => Err(fail(format!("no cells but {ghosts} copies of another piece's"))),
        _ => {
            all_named(found, options, path)?;
            flat::make_solid(found, options.axis, true, notes)
                .map_err(|why| fail(format!("{count} polygons and no solid cells: {why}")))
        }
    }
}

/// Refuses polygons without a field that is named; of the sides of a solid, fields are of less matter.
fn all_named(found: &Found, options: &Options, path: &Path) -> Result<(), Error> {
    let grids = || found.grids().filter(|g| g.has_polygons());
    for (q, wanted) in options.names.all().into_iter().enumerate() {
        let Wanted::Named(name) = wanted else { continue };
        if grids().all(|g| g.data.points[q].is_none() && g.data.cells[q].is_none()) {
            let (path, there) = (path.to_owned(), others(grids()));
            return Err(Error::Missing { path, kind: "field", name: name.to_owned(), there });
        }
    }
    Ok(())
}

/// Names of the arrays that are not used in any of some grids, in order.
pub(super) fn others<'a>(grids: impl Iterator<Item = &'a Grid>) -> Vec<String> {
    let mut all: Vec<String> = grids.flat_map(|g| &g.data.others).cloned().collect();
    all.sort();
    all.dedup();
    all
}
