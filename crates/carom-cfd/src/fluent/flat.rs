//! Cases of two dimensions: cells are polygons and faces are lines, made solid as the plane and axisymmetric results of VTK are.

use super::fields::{Chosen, RELATIVE, choose, in_cells, on_faces};
use super::hdf::Hdf;
use super::mesh::{NONE, Raw, raw, said};
use crate::vtk::{Axis, Flat, Values};
use crate::{Error, Names, Polygons, Snapshot};

/// Reads a case and its data.
pub(super) fn read(
    case: &Hdf,
    data: Option<&Hdf>,
    names: &Names,
    axis: Option<Axis>,
    mut notes: Vec<String>,
) -> Result<Snapshot, Error> {
    let raw = raw(case, 2, &mut notes)?;
    let rings = rings(case, &raw)?;
    let (mut of_cells, mut of_faces, mut others) = (Values::default(), Values::default(), Vec::new());
    if let Some(data) = data {
        let Chosen { velocity, scalars, others: left } = choose(data, true, names, &mut notes)?;
        [of_cells[0], of_faces[0]] = quantity(data, &raw, &velocity)?.map(Some);
        for (q, name) in (1..).zip(scalars).filter(|(_, name)| name.is_some()) {
            [of_cells[q], of_faces[q]] = quantity(data, &raw, &[name])?.map(Some);
        }
        if of_cells[6].is_some() {
            notes.push(RELATIVE.to_owned());
        }
        others = left;
    }
    let mut flat = Flat::new(raw.places.clone(), rings.clone(), of_cells, others);
    for zone in &raw.zones {
        let (mut lines, mut faces) = (Vec::new(), Vec::new());
        for f in zone.range.clone() {
            let Some((cell, _)) = raw.faces.alone(f) else { continue };
            lines.push(along(rings.get(cell as usize), raw.faces.polygons.get(f)));
            faces.push(f);
        }
        notes.extend(said(zone, zone.range.clone().filter(|f| raw.faces.is_between(*f)).count()));
        if !lines.is_empty() {
            let picked = of_faces.each_ref().map(|values| {
                let values = values.as_ref()?;
                let width = values.len() / raw.counts[1];
                Some(faces.iter().flat_map(|f| values[f * width..][..width].iter().copied()).collect())
            });
            flat.add_boundary(&zone.name, zone.patch(), &lines, picked);
        }
    }
    flat.snapshot(axis, case.path(), notes)
}

/// A quantity in the cells of the fluid and on all faces, one value after the other.
fn quantity<const N: usize>(data: &Hdf, raw: &Raw, names: &[Option<String>; N]) -> Result<[Vec<f64>; 2], Error> {
    let [cells, faces] = raw.counts;
    Ok([
        in_cells(data, names, &raw.kept, cells)?.into_flattened(),
        on_faces(data, names, 0..faces as u32, faces)?.into_flattened(),
    ])
}

/// The corners of each cell of the fluid, counter-clockwise.
fn rings(file: &Hdf, raw: &Raw) -> Result<Polygons, Error> {
    let mut edges: Vec<Vec<[u32; 2]>> = vec![Vec::new(); raw.kept.len()];
    for f in 0..raw.faces.polygons.len() {
        let &[a, b] = raw.faces.polygons.get(f) else {
            return Err(file.error(format!("face {} of a case of two dimensions is no line", f + 1)));
        };
        for cell in raw.faces.cells.each_ref().map(|c| c[f]).into_iter().filter(|c| *c != NONE) {
            edges[cell as usize].push([a, b]);
        }
    }
    let mut rings = Polygons { starts: vec![0], corners: Vec::new() };
    for (edges, cell) in edges.into_iter().zip(&raw.kept) {
        let mut ring =
            ring(edges).ok_or_else(|| file.error(format!("the faces of cell {} do not go round it", cell + 1)))?;
        if area(&raw.places, &ring) < 0.0 {
            ring.reverse();
        }
        rings.corners.extend(ring);
        rings.starts.push(rings.corners.len() as u32);
    }
    Ok(rings)
}

/// Edges one after the other; none where they are not one ring.
fn ring(mut edges: Vec<[u32; 2]>) -> Option<Vec<u32>> {
    let [first, mut end] = edges.pop()?;
    let mut ring = vec![first];
    while end != first {
        ring.push(end);
        let next = edges.iter().position(|edge| edge.contains(&end))?;
        let [a, b] = edges.swap_remove(next);
        end = if a == end { b } else { a };
    }
    (edges.is_empty() && ring.len() >= 3).then_some(ring)
}

/// Twice the area within a ring, negative if it goes clockwise.
fn area(places: &[[f64; 3]], ring: &[u32]) -> f64 {
    let at = |i: usize| places[ring[i % ring.len()] as usize];
    (0..ring.len()).map(|i| at(i)[0] * at(i + 1)[1] - at(i + 1)[0] * at(i)[1]).sum()
}

/// A line in the direction in which the ring of its cell has it.
fn along(ring: &[u32], line: &[u32]) -> [u32; 2] {
    let (a, b) = (line[0], line[1]);
    let ahead = |i: usize| ring[i] == a && ring[(i + 1) % ring.len()] == b;
    if (0..ring.len()).any(ahead) { [a, b] } else { [b, a] }
}
