//! Grids in VTK XML: unstructured ones, and polygons.

use super::Options;
use super::cells::{POLYGON, POLYLINE};
use super::data::{Arrays, Described, gather};
use super::grid::{Grid, Shells, polygons, starts, stream};
use super::xml::{Form, MOST_PACKED, Node, Parts, arrays, child, components, name};
use crate::{Error, Polygons};
use carom_table::{clipped, quoted};
use std::path::Path;

/// The pieces of a file that holds cells.
pub(super) fn grids(file: &[u8], path: &Path, options: &Options) -> Result<Vec<Grid>, Error> {
    let fail = |what: String| Error::file(path, what);
    let parts = Parts::of(file).map_err(fail)?;
    let document = parts.document().map_err(fail)?;
    let root = document.root_element();
    let form = Form::of(root, &parts).map_err(fail)?;
    let kind = root.attribute("type").unwrap_or("no type");
    let body = child(root, kind).filter(|_| matches!(kind, "UnstructuredGrid" | "PolyData"));
    let body = body.ok_or_else(|| fail(format!("{} is not read: {}", clipped(kind), wanted(kind))))?;
    let time = time(root, &form).or_else(|| time(body, &form));
    let mut grids = Vec::new();
    for piece in body.children().filter(|n| n.has_tag_name("Piece")) {
        let whole = Piece { form: &form, piece, most: file.len().saturating_mul(MOST_PACKED) };
        let Some(mut grid) = whole.cells(kind == "PolyData").map_err(fail)? else { continue };
        grid.time = time;
        grid.check().map_err(fail)?;
        let list = |of: &str| child(piece, of).into_iter().flat_map(arrays).collect::<Vec<_>>();
        let nodes = [list("PointData"), list("CellData")];
        let mut listed = [Vec::new(), Vec::new()];
        for (listed, nodes) in listed.iter_mut().zip(&nodes) {
            for array in nodes {
                listed.push(Described { name: name(*array).to_owned(), components: components(*array).map_err(fail)? });
            }
        }
        let counts = [grid.points.len(), grid.kinds.len()];
        gather(&mut grid, &mut InXml { form: &form, piece, nodes, listed, counts }, path, options)?;
        grids.push(grid);
    }
    Ok(grids)
}

/// What to do with a file of another type.
fn wanted(kind: &str) -> &'static str {
    match kind {
        "Collection" => "name the file of one time in it",
        "RectilinearGrid" | "ImageData" => "a grid is a flow of kind \"table\", not a mesh",
        "StructuredGrid" | "vtkOverlappingAMR" | "HyperTreeGrid" => {
            "make an unstructured grid of it first (ParaView: Append Datasets or Merge Blocks)"
        }
        _ => "an unstructured grid (.vtu, .pvtu) or blocks of such (.vtm) are read",
    }
}

/// The time that a file is of.
pub(super) fn time(node: Node, form: &Form) -> Option<f64> {
    let array = arrays(child(node, "FieldData")?).find(|a| name(*a) == "TimeValue")?;
    form.every::<f64>(array).ok()?.first().copied().filter(|t| t.is_finite())
}

struct Piece<'f, 'a, 'b> {
    form: &'f Form<'f>,
    piece: Node<'a, 'b>,
    /// No list is longer.
    most: usize,
}

impl<'a, 'b> Piece<'_, 'a, 'b> {
    fn count(&self, name: &str) -> Result<usize, String> {
        let written = self.piece.attribute(name).unwrap_or("0");
        let count: usize = written.trim().parse().map_err(|_| format!("{name} is {}", quoted(written)))?;
        self.bounded(count).map_err(|_| format!("{name} {count} does not fit the file"))
    }

    fn bounded(&self, count: usize) -> Result<usize, String> {
        if count > self.most || count >= u32::MAX as usize {
            return Err(format!("a list of {count} does not fit the file"));
        }
        Ok(count)
    }

    fn array(&self, of: &str, wanted: &str) -> Result<Node<'a, 'b>, String> {
        let found = child(self.piece, of).and_then(|n| arrays(n).find(|a| name(*a) == wanted));
        found.ok_or_else(|| format!("no {wanted} in {of}"))
    }

    fn numbers(&self, of: &str, wanted: &str, count: usize) -> Result<Vec<u32>, String> {
        self.form.values(self.array(of, wanted)?, self.bounded(count)?)
    }

    /// Lists of points by the places where they end.
    fn lists(&self, of: &str, count: usize, points: usize) -> Result<Polygons, String> {
        let starts = starts(self.numbers(of, "offsets", count)?);
        let total = starts.last().map_or(0, |n| *n as usize);
        polygons(starts, self.numbers(of, "connectivity", total)?, points, &of.to_ascii_lowercase())
    }

    /// Points and cells, where there are cells.
    fn cells(&self, surface: bool) -> Result<Option<Grid>, String> {
        let points = self.count("NumberOfPoints")?;
        let at = child(self.piece, "Points").and_then(|n| arrays(n).next());
        let mut grid = Grid::default();
        if surface {
            let [verts, lines, strips, polys] =
                ["NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys"].map(|n| self.count(n));
            let (verts, lines, strips, polys) = (verts?, lines?, strips?, polys?);
            if strips > 0 {
                return Err("strips of triangles are not read (ParaView: Triangulate)".to_owned());
            }
            if lines + polys == 0 {
                return Ok(None);
            }
            // what holds for cells is listed for points and lines first, and then for polygons
            grid.cells = Polygons { starts: vec![0; verts + 1], corners: Vec::new() };
            grid.kinds = vec![0; verts];
            for (of, count, kind) in [("Lines", lines, POLYLINE), ("Polys", polys, POLYGON)] {
                if count > 0 {
                    grid.kinds.resize(grid.kinds.len() + count, kind);
                    let lists = self.lists(of, count, points)?;
                    let first = grid.cells.corners.len() as u32;
                    grid.cells.starts.extend(lists.starts[1..].iter().map(|s| s + first));
                    grid.cells.corners.extend(lists.corners);
                }
            }
        } else {
            let cells = self.count("NumberOfCells")?;
            if cells == 0 {
                return Ok(None);
            }
            grid.kinds = self.form.values(self.array("Cells", "types")?, cells)?;
            grid.cells = self.lists("Cells", cells, points)?;
            grid.shells = self.shells(&grid.kinds, points)?;
        }
        let at = at.ok_or("no Points")?;
        if components(at)? != 3 {
            return Err("points need three coordinates".to_owned());
        }
        let numbers: Vec<f64> = self.form.values(at, points.checked_mul(3).ok_or("too many points")?)?;
        grid.points = numbers.as_chunks::<3>().0.to_vec();
        Ok(Some(grid))
    }

    /// The faces of polyhedra, as they are stored since VTK 9.4 (places in lists) or were before (a stream).
    fn shells(&self, kinds: &[u8], points: usize) -> Result<Shells, String> {
        if !kinds.contains(&42) {
            return Ok(Shells::default());
        }
        if self.array("Cells", "polyhedron_offsets").is_err() {
            return self.old_shells(kinds, points);
        }
        let places = starts(self.numbers("Cells", "polyhedron_offsets", kinds.len())?);
        let total = places.last().map_or(0, |n| *n as usize);
        let order = self.numbers("Cells", "polyhedron_to_faces", total)?;
        if !places.is_sorted() {
            return Err("polyhedron_offsets fall".to_owned());
        }
        let ends: Vec<u32> = self.form.every(self.array("Cells", "face_offsets")?)?;
        let starts = starts(ends);
        let corners = self.numbers("Cells", "face_connectivity", starts.last().map_or(0, |n| *n as usize))?;
        let faces = polygons(starts, corners, points, "faces")?;
        // in the order of the cells
        let mut shells = Shells { starts: places, faces: Polygons { starts: vec![0], corners: Vec::new() } };
        for face in order {
            if face as usize >= faces.len() {
                return Err(format!("a polyhedron has face {face}; there are {}", faces.len()));
            }
            shells.faces.corners.extend(faces.get(face as usize));
            shells.faces.starts.push(u32::try_from(shells.faces.corners.len()).map_err(|_| "too many faces")?);
            self.bounded(shells.faces.corners.len())?;
        }
        Ok(shells)
    }

    fn old_shells(&self, kinds: &[u8], points: usize) -> Result<Shells, String> {
        let ends: Vec<i64> = self.form.values(self.array("Cells", "faceoffsets")?, kinds.len())?;
        let total = ends.iter().copied().max().and_then(|n| usize::try_from(n).ok()).unwrap_or_default();
        let numbers = self.numbers("Cells", "faces", total)?;
        let mut faces = Polygons { starts: vec![0], corners: Vec::new() };
        let (mut starts, mut from) = (vec![0], 0);
        for (cell, (kind, end)) in kinds.iter().zip(ends).enumerate() {
            if let Ok(end) = usize::try_from(end)
                && *kind == 42
            {
                let list = numbers.get(from..end).and_then(|n| stream(n, &mut faces));
                list.ok_or_else(|| format!("the faces of cell {cell} do not fit their list"))?;
                from = end;
            }
            starts.push(u32::try_from(faces.len()).map_err(|_| "too many faces")?);
        }
        let faces = polygons(faces.starts, faces.corners, points, "faces")?;
        Ok(Shells { starts, faces })
    }
}

/// The arrays of a piece.
struct InXml<'f, 'a, 'b> {
    form: &'f Form<'f>,
    piece: Node<'a, 'b>,
    nodes: [Vec<Node<'a, 'b>>; 2],
    listed: [Vec<Described>; 2],
    counts: [usize; 2],
}

impl<'a, 'b> InXml<'_, 'a, 'b> {
    fn text_arrays(&self) -> impl Iterator<Item = Node<'a, 'b>> {
        let all = child(self.piece, "CellData").into_iter().flat_map(|n| n.children());
        all.filter(|n| n.attribute("type") == Some("String"))
    }
}

impl Arrays for InXml<'_, '_, '_> {
    fn listed(&self) -> &[Vec<Described>; 2] {
        &self.listed
    }

    fn read(&mut self, of_cells: bool, index: usize) -> Result<Vec<f64>, String> {
        let list = usize::from(of_cells);
        let count = self.counts[list].checked_mul(self.listed[list][index].components).ok_or("too many values")?;
        self.form.values(self.nodes[list][index], count)
    }

    fn text_names(&self) -> Vec<String> {
        self.text_arrays().map(|a| name(a).to_owned()).collect()
    }

    fn texts(&mut self, wanted: &str) -> Option<Result<Vec<String>, String>> {
        let array = self.text_arrays().find(|a| name(*a) == wanted)?;
        let count = self.counts[1];
        Some(self.form.every::<u8>(array).and_then(|bytes| {
            // each text ends with a zero
            let texts: Vec<String> = bytes
                .strip_suffix(&[0])
                .unwrap_or(&bytes)
                .split(|b| *b == 0)
                .map(|b| String::from_utf8_lossy(b).into_owned())
                .collect();
            let wrong = || format!("array {}: {} texts where {count} are wanted", quoted(wanted), texts.len());
            if texts.len() == count { Ok(texts) } else { Err(wrong()) }
        }))
    }
}
