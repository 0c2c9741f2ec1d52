//! The files of a mesh: points, faces, owners, neighbours and patches of each part.

use std::path::Path;

use super::boundary::{self, Raw};
use super::layout::Layout;
use super::list;
use crate::check::Broken;
use crate::{Error, Polygons};

/// The mesh of a part: of one processor, or of all.
#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) faces: Polygons,
    pub(super) owner: Vec<u32>,
    pub(super) neighbour: Vec<u32>,
    pub(super) cells: usize,
    pub(super) patches: Vec<Raw>,
}

/// Folder of the faces, for what else lies there, and all parts.
pub(super) fn read(layout: &Layout, time: Option<f64>) -> Result<(String, Vec<Part>), Error> {
    let folder = layout.newest("faces", time);
    let root = layout.store.first();
    let need = |found: bool, file: &str| match found {
        true => Ok(()),
        false => Err(Error::file(&root.join(file), "is not there")),
    };
    let mut parts: Vec<Part> = Vec::new();
    let file = format!("{folder}/faces");
    let found = layout.each(&file, |i, c| {
        let compact = c.class == "faceCompactList";
        if !compact && c.class != "faceList" {
            return Err(Error::file(c.path, format!("a {} where faces were expected", c.class)));
        }
        let faces = c.read(|scan| list::faces(scan, c.format, compact))?;
        parts.resize_with(parts.len().max(i + 1), Part::default);
        parts[i].faces = faces;
        Ok(())
    })?;
    need(found, &file)?;
    let mut seen;
    for name in ["points", "owner", "neighbour", "boundary"] {
        let file = match name {
            "points" => format!("{}/points", layout.newest("points", time)),
            name => format!("{folder}/{name}"),
        };
        seen = 0;
        let found = layout.each(&file, |i, c| {
            seen = i + 1;
            let Some(part) = parts.get_mut(i) else {
                return Err(Error::file(c.path, "is of more processors than the faces"));
            };
            let most = part.faces.len();
            match name {
                "points" => part.points = c.read(|scan| list::list(scan, c.format, 0))?,
                "owner" => part.owner = c.read(|scan| list::list(scan, c.format, most))?,
                "neighbour" => part.neighbour = c.read(|scan| list::list(scan, c.format, most))?,
                _ => part.patches = boundary::read(c)?,
            }
            Ok(())
        })?;
        need(found, &file)?;
        if seen != parts.len() {
            return Err(Error::file(
                &root.join(&file),
                format!("is of {seen} processors, and the faces of {}", parts.len()),
            ));
        }
    }
    for part in &mut parts {
        finish(part, &root.join(&folder))?;
    }
    Ok((folder, parts))
}

/// Counts the cells and makes sure that no index leads astray.
fn finish(part: &mut Part, folder: &Path) -> Result<(), Error> {
    let faces = part.faces.len();
    if part.owner.len() != faces {
        let (what, found) = ("owners of faces".into(), part.owner.len());
        return Err(Broken::Length { what, found, expected: faces }.into());
    }
    if part.neighbour.len() > faces {
        let (what, found) = ("neighbours of faces".into(), part.neighbour.len());
        return Err(Broken::Length { what, found, expected: faces }.into());
    }
    // before anything is made as long as the largest number says: a cell has some faces
    let sides = || part.owner.iter().enumerate().chain(part.neighbour.iter().enumerate());
    if let Some((face, &index)) = sides().find(|(_, c)| **c as usize >= faces) {
        return Err(Broken::Index { face, what: "cell", index, count: faces }.into());
    }
    part.cells = sides().map(|(_, c)| *c as usize + 1).max().unwrap_or(0);
    let count = part.points.len();
    for face in 0..faces {
        if let Some(&index) = part.faces.get(face).iter().find(|p| **p as usize >= count) {
            return Err(Broken::Index { face, what: "point", index, count }.into());
        }
    }
    let mut next = part.neighbour.len();
    for patch in &mut part.patches {
        if patch.faces.is_empty() {
            patch.faces = next..next;
        }
        if patch.faces.start != next || patch.faces.end > faces {
            let what =
                format!("patch `{}` has the faces {:?} where {next} is the next of {faces}", patch.name, patch.faces);
            return Err(Error::file(&folder.join("boundary"), what));
        }
        next = patch.faces.end;
    }
    if next != faces {
        let what = format!("{} faces of the boundary are in no patch", faces - next);
        return Err(Error::file(&folder.join("boundary"), what));
    }
    Ok(())
}
