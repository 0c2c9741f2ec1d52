//! The mesh of a case.

use super::hdf::Hdf;
use crate::geometry::face_centre_and_area;
use crate::geometry::vector::dot;
use crate::points::renumber;
use crate::{Error, Mesh, Patch, PatchKind, Polygons};
use std::ops::Range;

/// A mesh, and which of the file's cells and faces it is made of.
pub(super) struct Part {
    pub mesh: Mesh,
    /// Numbers of the cells in the file, from 0.
    pub cells: Vec<u32>,
    /// Numbers of the boundary's faces in the file.
    pub boundary: Vec<u32>,
    /// How many cells and faces the file has.
    pub counts: [usize; 2],
}

/// No cell.
pub(super) const NONE: u32 = u32::MAX;

/// A zone of cells or of faces.
pub(super) struct Zone {
    pub name: String,
    kind: u64,
    pub range: Range<usize>,
}

impl Zone {
    /// What a zone of the boundary is.
    pub fn patch(&self) -> PatchKind {
        match self.kind {
            3 => PatchKind::Wall,
            7 => PatchKind::Symmetry,
            _ => PatchKind::Plain,
        }
    }
}

/// Faces as the file has them: corners, and cells on both sides by their new numbers.
pub(super) struct Faces {
    pub polygons: Polygons,
    pub cells: [Vec<u32>; 2],
}

impl Faces {
    /// The only cell of the fluid at a face, and whether the face is turned into it.
    pub fn alone(&self, face: usize) -> Option<(u32, bool)> {
        match self.cells.each_ref().map(|c| c[face]) {
            [NONE, NONE] => None,
            [cell, NONE] => Some((cell, false)),
            [NONE, cell] => Some((cell, true)),
            _ => None,
        }
    }

    /// Whether a face lies between two cells of the fluid.
    pub fn is_between(&self, face: usize) -> bool {
        self.cells.iter().all(|c| c[face] != NONE)
    }
}

/// A mesh as the file has it.
pub(super) struct Raw {
    pub places: Vec<[f64; 3]>,
    pub faces: Faces,
    pub zones: Vec<Zone>,
    /// Numbers of the cells of the fluid in the file, from 0.
    pub kept: Vec<u32>,
    /// How many cells and faces the file has.
    pub counts: [usize; 2],
}

/// How many dimensions a case has.
pub(super) fn dimensions(file: &Hdf) -> Result<usize, Error> {
    match file.attribute(MESH, "dimension")? {
        n @ (2 | 3) => Ok(n as usize),
        n => Err(file.error(format!("a case of {n} dimensions"))),
    }
}

const MESH: &str = "meshes/1";

/// What a file holds of its mesh, of so many dimensions.
pub(super) fn raw(file: &Hdf, dimensions: usize, notes: &mut Vec<String>) -> Result<Raw, Error> {
    for tree in ["cells/tree", "faces/tree"] {
        if file.has(&format!("{MESH}/{tree}")) {
            return Err(file.error("the mesh is refined by hanging nodes (tree), which is not read"));
        }
    }
    let count = |name: &str| -> Result<usize, Error> {
        let count = file.attribute(MESH, name)?;
        let all = file.span(1, count).ok_or_else(|| file.error(format!("{name} is {count}")))?;
        Ok(all.len())
    };
    let [points, faces, cells] = [count("nodeCount")?, count("faceCount")?, count("cellCount")?];
    // what is long is read before anything is made as long as the file says: a cell has a face more than dimensions at least, a face two cells at most
    let places = self::points(file, points, dimensions)?;
    let polygons = polygons(file, points, faces)?;
    if cells > 2 * faces / (dimensions + 1) {
        return Err(file.error(format!("{cells} cells do not have {faces} faces alone")));
    }
    let (new, kept) = fluid(file, cells, notes)?;
    let faces = Faces { cells: both_sides(file, faces, cells, &new)?, polygons };
    let zones = zones(file, "meshes/1/faces/zoneTopology", faces.polygons.len())?;
    let counts = [cells, faces.polygons.len()];
    Ok(Raw { places, faces, zones, kept, counts })
}

/// The mesh of a case of three dimensions.
pub(super) fn read(file: &Hdf, notes: &mut Vec<String>) -> Result<Part, Error> {
    let Raw { places, mut faces, zones, kept, counts } = raw(file, 3, notes)?;
    outward(&places, &mut faces);
    let mut part = assemble(&faces, &zones, kept.len(), notes);
    part.counts = counts;
    part.cells = kept;
    let used = renumber(&mut part.mesh.faces.corners, places.len());
    part.mesh.points = match used {
        Some(used) => used.iter().map(|p| places[*p as usize]).collect(),
        None => places,
    };
    Ok(part)
}

fn zones(file: &Hdf, at: &str, most: usize) -> Result<Vec<Zone>, Error> {
    let count = usize::try_from(file.attribute(at, "nZones")?).unwrap_or(usize::MAX);
    let list = |name: &str| file.so_many::<i64>(&format!("{at}/{name}"), count);
    let (first, last, kinds) = (list("minId")?, list("maxId")?, list("zoneType")?);
    let names = file.texts(&format!("{at}/name"))?;
    let mut zones = Vec::new();
    for i in 0..count {
        let positive = |n: i64| u64::try_from(n).unwrap_or_default();
        let range = file.span(positive(first[i]), positive(last[i])).filter(|r| r.end <= most);
        let range = range.ok_or_else(|| file.error(format!("{at}: zone {} is no range", i + 1)))?;
        let name = names.get(i).filter(|n| !n.is_empty()).cloned().unwrap_or_else(|| format!("zone-{}", i + 1));
        zones.push(Zone { name, kind: positive(kinds[i]), range });
    }
    Ok(zones)
}

/// The new numbers of all cells, and the old ones of those in fluid zones.
fn fluid(file: &Hdf, cells: usize, notes: &mut Vec<String>) -> Result<(Vec<u32>, Vec<u32>), Error> {
    const FLUID: u64 = 1;
    const SOLID: u64 = 17;
    let mut is_fluid = vec![false; cells];
    let mut others = Vec::new();
    for zone in zones(file, "meshes/1/cells/zoneTopology", cells)? {
        match zone.kind {
            FLUID => is_fluid[zone.range].fill(true),
            SOLID => others.push(zone.name),
            kind => {
                return Err(
                    file.error(format!("zone {} of cells is of type {kind}, neither fluid nor solid", zone.name))
                );
            }
        }
    }
    if !others.is_empty() {
        notes.push(format!("solid zones are left out: {}", others.join(", ")));
    }
    let mut new = vec![NONE; cells];
    let mut kept = Vec::new();
    for (cell, _) in is_fluid.iter().enumerate().filter(|(_, fluid)| **fluid) {
        new[cell] = kept.len() as u32;
        kept.push(cell as u32);
    }
    Ok((new, kept))
}

fn points(file: &Hdf, count: usize, dimensions: usize) -> Result<Vec<[f64; 3]>, Error> {
    let mut zones = Vec::new();
    for zone in file.numbers::<i64>("meshes/1/nodes/zoneTopology/id")? {
        let at = format!("meshes/1/nodes/coords/{zone}");
        let range = file.range(&at)?;
        zones.push((range.start, file.so_many::<f64>(&at, range.len().saturating_mul(dimensions))?));
    }
    zones.sort_by_key(|z| z.0);
    let mut points: Vec<[f64; 3]> = Vec::new();
    for (begin, numbers) in zones {
        if begin != points.len() {
            return Err(file.error(format!("nodes from {} on where {} is the next", begin + 1, points.len() + 1)));
        }
        points.extend(numbers.chunks(dimensions).map(|x| [x[0], x[1], x.get(2).copied().unwrap_or(0.0)]));
    }
    if points.len() != count {
        return Err(file.error(format!("{} nodes, and nodeCount is {count}", points.len())));
    }
    Ok(points)
}

fn polygons(file: &Hdf, points: usize, faces: usize) -> Result<Polygons, Error> {
    const NODES: &str = "meshes/1/faces/nodes";
    let mut sections = Vec::new();
    for section in 1..=file.attribute(NODES, "nSections")? {
        let at = format!("{NODES}/{section}");
        sections.push((file.range(&at)?, at));
    }
    sections.sort_by_key(|s| s.0.start);
    let mut polygons = Polygons { starts: vec![0], corners: Vec::new() };
    for (range, at) in sections {
        if range.start != polygons.len() {
            return Err(file.error(format!(
                "{at} begins with face {} where {} is the next",
                range.start + 1,
                polygons.len() + 1
            )));
        }
        let sizes = file.so_many::<u32>(&format!("{at}/nnodes"), range.len())?;
        let total = sizes.iter().fold(0usize, |n, m| n.saturating_add(*m as usize));
        let nodes = file.so_many::<u32>(&format!("{at}/nodes"), total)?;
        let mut end = polygons.corners.len();
        for size in sizes {
            end += size as usize;
            polygons.starts.push(u32::try_from(end).map_err(|_| file.error("too many faces"))?);
        }
        if let Some(node) = nodes.iter().find(|n| **n == 0 || **n as usize > points) {
            return Err(file.error(format!("{at}: node {node}, and there are {points}")));
        }
        polygons.corners.extend(nodes.iter().map(|n| n - 1));
    }
    if polygons.len() != faces {
        return Err(file.error(format!("corners of {} faces, and there are {faces}", polygons.len())));
    }
    Ok(polygons)
}

/// The cells on both sides of each face, by their new numbers.
fn both_sides(file: &Hdf, faces: usize, cells: usize, new: &[u32]) -> Result<[Vec<u32>; 2], Error> {
    let mut sides = [vec![NONE; faces], vec![NONE; faces]];
    for (side, name) in sides.iter_mut().zip(["c0", "c1"]) {
        let at = format!("meshes/1/faces/{name}");
        for (range, numbers) in file.sections::<u32>(&at)? {
            let places = side.get_mut(range).ok_or_else(|| file.error(format!("{at}: more faces than there are")))?;
            for (place, number) in places.iter_mut().zip(numbers) {
                // nothing is 0
                if number as usize > cells {
                    return Err(file.error(format!("{at}: cell {number}, and there are {cells}")));
                }
                *place = (number as usize).checked_sub(1).map_or(NONE, |cell| new[cell]);
            }
        }
    }
    Ok(sides)
}

/// Turns all faces so that area vectors point from the first cell to the second. Files agree in themselves, so that one sum tells which
/// way they have it: the volume V = ⅓ Σ x·S over the boundary is positive.
fn outward(points: &[[f64; 3]], faces: &mut Faces) {
    let mut sum = 0.0;
    for f in 0..faces.polygons.len() {
        let Some((_, turned)) = faces.alone(f) else { continue };
        let (centre, area) = face_centre_and_area(points, faces.polygons.get(f));
        sum += if turned { -1.0 } else { 1.0 } * dot(centre, area);
    }
    if sum < 0.0 {
        let Polygons { starts, corners } = &mut faces.polygons;
        starts.windows(2).for_each(|w| corners[w[0] as usize..w[1] as usize].reverse());
    }
}

/// Puts the faces in order: those between cells, then zone by zone.
fn assemble(faces: &Faces, zones: &[Zone], cells: usize, notes: &mut Vec<String>) -> Part {
    let mut mesh = Mesh { cells, ..Mesh::default() };
    mesh.faces.starts.push(0);
    let [c0, c1] = &faces.cells;
    let push = |mesh: &mut Mesh, f: usize, turned: bool| {
        let corners = faces.polygons.get(f);
        match turned {
            true => mesh.faces.corners.extend(corners.iter().rev()),
            false => mesh.faces.corners.extend(corners),
        }
        mesh.faces.starts.push(mesh.faces.corners.len() as u32);
    };
    let between = |f: &usize| faces.is_between(*f);
    let mut inner: Vec<(u32, u32, u32)> =
        (0..faces.polygons.len()).filter(between).map(|f| (c0[f].min(c1[f]), c0[f].max(c1[f]), f as u32)).collect();
    inner.sort_unstable();
    for (owner, neighbour, f) in inner {
        push(&mut mesh, f as usize, c0[f as usize] != owner);
        mesh.owner.push(owner);
        mesh.neighbour.push(neighbour);
    }
    let mut boundary = Vec::new();
    for zone in zones {
        let begin = mesh.owner.len();
        for f in zone.range.clone() {
            let Some((owner, turned)) = faces.alone(f) else { continue };
            push(&mut mesh, f, turned);
            mesh.owner.push(owner);
            boundary.push(f as u32);
        }
        let through = zone.range.clone().filter(between).count();
        notes.extend(said(zone, through));
        let faces = begin..mesh.owner.len();
        if !faces.is_empty() {
            mesh.patches.push(Patch { name: zone.name.clone(), groups: Vec::new(), kind: zone.patch(), faces });
        }
    }
    Part { mesh, cells: Vec::new(), boundary, counts: [0; 2] }
}

/// What is to be said of a zone of faces. Types are those of Fluent's files of meshes: 2 interior, 8 and 12 periodic, 24 interface.
pub(super) fn said(zone: &Zone, through: usize) -> Option<String> {
    let name = &zone.name;
    match zone.kind {
        8 | 12 => Some(format!("the zone {name} is periodic: it is a patch, through which nothing goes on")),
        24 => Some(format!(
            "the zone {name} is an interface of meshes that do not fit: it is a patch, through which nothing goes on"
        )),
        2 => None,
        _ if through > 0 => {
            Some(format!("{through} faces of the zone {name} lie between cells of the fluid, which goes through"))
        }
        _ => None,
    }
}
