//! `stl = { file, unit, solid }` of a wall: STL, OBJ or PLY.

use super::check::{positive, wrong};
use super::files::Files;
use super::text::StlText;
use crate::geometry::triangles::{self, Triangles};
use crate::geometry::{Mesh, Triangle};
use carom::LawError;
use carom::spec::At;
use carom_table::clipped;
use std::collections::{BTreeMap, BTreeSet};

/// Triangles from a file, and a note of what they are; numbers are in metres unless a unit is given.
pub(super) fn mesh(at: &At<StlText>, wall: &str, files: &Files) -> Result<(Mesh, String), LawError> {
    let file = &at.value.file;
    let unit = at.value.unit.as_ref().map_or(Ok(1.0), |u| positive(u, "unit", u.value.0))?;
    let failed = |e: &dyn std::fmt::Display| wrong(file, format!("{}: {e}", file.value));
    let read =
        triangles::read(&file.value, &files.read(&file.value).map_err(|e| failed(&e))?).map_err(|e| failed(&e))?;
    let of = match &at.value.solid {
        Some(solid) => chosen(&read, solid)?,
        None => read.triangles.clone(),
    };
    let triangles: Vec<Triangle> = of.iter().map(|t| t.map(|x| x.map(|c| c * unit))).collect();
    let mesh = Mesh::with_precision(&triangles, read.precision)
        .ok_or_else(|| wrong(file, format!("{} has no triangle with an area", file.value)))?;
    let note = note(wall, &file.value, &read, &mesh);
    Ok((mesh, note))
}

/// Of files whose solids are chosen by name, the solids that no wall takes.
pub(super) fn left_out<'a>(walls: impl Iterator<Item = &'a At<StlText>>, files: &Files) -> Vec<String> {
    let mut chosen: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut whole = BTreeSet::new();
    for wall in walls {
        match &wall.value.solid {
            Some(solid) => chosen.entry(&wall.value.file.value).or_default().push(&solid.value),
            None => {
                whole.insert(wall.value.file.value.as_str());
            }
        }
    }
    let mut notes = Vec::new();
    for (file, solids) in chosen.into_iter().filter(|(file, _)| !whole.contains(file)) {
        let Some(read) = files.read(file).ok().and_then(|bytes| triangles::read(file, &bytes).ok()) else { continue };
        let idle = read.solids.iter().filter(|s| !s.triangles.is_empty() && !solids.contains(&s.name.as_str()));
        let names: Vec<String> = idle.map(|s| format!("'{}'", clipped(&s.name))).collect();
        if !names.is_empty() {
            let more = if names.len() > 8 { format!(" and {} more", names.len() - 8) } else { String::new() };
            let first = names.iter().take(8).cloned().collect::<Vec<_>>().join(", ");
            notes.push(format!("{file}: no wall takes its solids {first}{more}: they are not there"));
        }
    }
    notes
}

/// The triangles of the solids of a name.
fn chosen(read: &Triangles, solid: &At<String>) -> Result<Vec<Triangle>, LawError> {
    let named = read.solids.iter().filter(|s| s.name == solid.value);
    let triangles: Vec<Triangle> = named.flat_map(|s| read.triangles[s.triangles.clone()].iter().copied()).collect();
    if triangles.is_empty() {
        let names: Vec<String> = read.solids.iter().take(20).map(|s| format!("'{}'", s.name)).collect();
        let message = format!("no triangles in a solid '{}'", solid.value);
        return Err(wrong(solid, message).help(format!("the file has {}", names.join(", "))));
    }
    Ok(triangles)
}

/// What was read, and what of it was left out.
fn note(wall: &str, file: &str, read: &Triangles, mesh: &Mesh) -> String {
    let bounds = mesh.bounds();
    let [x, y, z] = [0, 1, 2].map(|c| length(bounds.max[c] - bounds.min[c]));
    let plural = |n: usize, what: &str| if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") };
    let solids =
        if read.solids.len() == 1 { String::new() } else { format!(", {} solids in the file", read.solids.len()) };
    let mut note = format!("wall '{wall}': {} of {file}{solids}, {x} x {y} x {z}", plural(mesh.len(), "triangle"));
    if mesh.left_out() > 0 {
        note += &format!("; left out: {} without area", plural(mesh.left_out(), "triangle"));
    }
    note
}

/// A length to three digits.
pub(super) fn length(m: f64) -> String {
    let (factor, unit) = match m {
        m if m == 0.0 || m >= 1.0 => (1.0, "m"),
        m if m >= 1e-3 => (1e3, "mm"),
        m if m >= 1e-6 => (1e6, "um"),
        _ => (1e9, "nm"),
    };
    let rounded: f64 = format!("{:.2e}", m * factor).parse().unwrap_or(m * factor);
    format!("{rounded} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_three_digits() {
        let told = [0.0, 12.346, 0.02, 1.23456e-3, 9.999e-4, 5e-8].map(length);
        assert_eq!(told, ["0 m", "12.3 m", "20 mm", "1.23 mm", "1000 um", "50 nm"]);
    }
}
