//! Cases of two dimensions: cells are polygons and faces are lines, made solid as the plane and axisymmetric results of VTK are.

use super::fields::{Chosen, choose, values};
use super::hdf::Hdf;
use super::mesh::{NONE, Raw, raw, said};
use crate::vtk::{Axis, Flat};
use crate::{Error, Names, Polygons, Snapshot};

/// Quantities of a result: the velocity and six scalars.
const COUNT: usize = 7;

/// Reads a case and its data.
pub(super) fn read(
    case: &Hdf,
    data: Option<&Hdf>,
    names: &Names,
    axis: Option<Axis>,
    mut notes: Vec<String>,
) -> Result<Snapshot, Error> {
    let raw = raw(case, &mut notes)?;
    let rings = rings(case, &raw)?;
    let mut fields: [Option<[Vec<f64>; 2]>; COUNT] = Default::default();
    let mut others = Vec::new();
    if let Some(data) = data {
        let Chosen { velocity, scalars, others: left } = choose(data, true, names, &mut notes)?;
        others = left;
        for (q, field) in fields.iter_mut().enumerate() {
            let names = if q == 0 { velocity.to_vec() } else { vec![scalars[q - 1].clone()] };
            if names[0].is_none() {
                continue;
            }
            let of_cells = values(data, "cells", &names, raw.counts[0])?;
            let missing =
                |cell: &&u32| of_cells[**cell as usize * names.len()..][..names.len()].iter().any(|x| !x.is_finite());
            if let (Some(cell), Some(name)) = (raw.kept.iter().find(missing), &names[0]) {
                return Err(data.error(format!("{name} has no value in cell {}", cell + 1)));
            }
            *field = Some([of_cells, values(data, "faces", &names, raw.counts[1])?]);
        }
    }
    let picked = |place: usize, which: &[u32]| {
        fields.each_ref().map(|field| {
            let values = &field.as_ref()?[place];
            let width = values.len() / raw.counts[place].max(1);
            Some(which.iter().flat_map(|i| values[*i as usize * width..][..width].iter().copied()).collect())
        })
    };
    let mut flat = Flat::new(raw.places.clone(), rings.clone(), picked(0, &raw.kept), others);
    for zone in &raw.zones {
        let (mut lines, mut faces) = (Vec::new(), Vec::new());
        for f in zone.range.clone() {
            let [c0, c1] = raw.faces.cells.each_ref().map(|c| c[f]);
            let cell = match (c0, c1) {
                (NONE, NONE) => continue,
                (cell, NONE) | (NONE, cell) => cell,
                _ => continue,
            };
            lines.push(along(rings.get(cell as usize), raw.faces.polygons.get(f)));
            faces.push(f as u32);
        }
        let through = zone.range.clone().filter(|f| raw.faces.cells.iter().all(|c| c[*f] != NONE)).count();
        notes.extend(said(zone, through));
        if !lines.is_empty() {
            flat.add_boundary(&zone.name, zone.patch(), &lines, picked(1, &faces));
        }
    }
    flat.snapshot(axis, case.path(), notes)
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
