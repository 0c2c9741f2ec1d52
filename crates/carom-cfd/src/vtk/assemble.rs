//! A snapshot of what was read: faces in order, points that are used, fields.

use super::data::{COUNT, QUANTITIES};
use super::grid::Grid;
use super::patches::{Boundary, Surface};
use super::sides::{NONE, Sides};
use crate::points::renumber;
use crate::{Field, Fields, Mesh, Patch, PatchKind, Polygons};
use carom_table::clipped;

/// The mesh, and the numbers that its points had.
pub(super) fn mesh(grid: &Grid, sides: &Sides, boundary: &Boundary) -> (Mesh, Option<Vec<u32>>) {
    let cells = sides.cells();
    let mut mesh = Mesh { cells: sides.starts.len() - 1, ..Mesh::default() };
    let inner = (sides.faces.len() - boundary.faces.len()) / 2;
    let all = inner + boundary.faces.len();
    mesh.faces = Polygons { starts: Vec::with_capacity(all + 1), corners: Vec::with_capacity(all * 4) };
    mesh.faces.starts.push(0);
    mesh.owner.reserve(all);
    mesh.neighbour.reserve(inner);
    let push = |mesh: &mut Mesh, face: u32, owner: u32| {
        mesh.faces.corners.extend(sides.faces.get(face as usize));
        mesh.faces.starts.push(mesh.faces.corners.len() as u32);
        mesh.owner.push(owner);
    };
    let mut next: Vec<(u32, u32)> = Vec::new();
    for owner in 0..mesh.cells as u32 {
        next.clear();
        for face in sides.starts[owner as usize]..sides.starts[owner as usize + 1] {
            let other = sides.other[face as usize];
            if other != NONE && cells[other as usize] > owner {
                next.push((cells[other as usize], face));
            }
        }
        next.sort_unstable();
        for &(neighbour, face) in &next {
            push(&mut mesh, face, owner);
            mesh.neighbour.push(neighbour);
        }
    }
    let mut begin = mesh.owner.len();
    boundary.faces.iter().for_each(|f| push(&mut mesh, *f, cells[*f as usize]));
    for (name, kind, count) in &boundary.patches {
        let faces = begin..begin + count;
        begin = faces.end;
        mesh.patches.push(Patch { name: name.clone(), groups: Vec::new(), kind: kind.clone(), faces });
    }
    let kept = renumber(&mut mesh.faces.corners, grid.points.len());
    mesh.points = match &kept {
        Some(kept) => kept.iter().map(|p| grid.points[*p as usize]).collect(),
        None => grid.points.clone(),
    };
    (mesh, kept)
}

/// What the fields are made of.
pub(super) struct Sources<'a> {
    pub grid: &'a Grid,
    pub solids: &'a [u32],
    pub kept: Option<&'a [u32]>,
    pub surfaces: &'a [Surface<'a>],
    pub boundary: &'a Boundary,
    pub mesh: &'a Mesh,
}

impl Sources<'_> {
    pub fn fields(&self, notes: &mut Vec<String>) -> Fields {
        let scalar = |q| self.field::<1>(q);
        let fields = Fields {
            velocity: self.field::<3>(0),
            k: scalar(1),
            epsilon: scalar(2),
            omega: scalar(3),
            density: scalar(4),
            temperature: scalar(5),
            pressure: scalar(6),
            others: self.others(),
        };
        self.note(notes);
        fields
    }

    fn field<const N: usize>(&self, q: usize) -> Option<Field<N>> {
        let data = &self.grid.data;
        if let Some(values) = &data.points[q] {
            return Some(Field::Points(match self.kept {
                Some(kept) => picked(values, kept),
                None => values.as_chunks::<N>().0.to_vec(),
            }));
        }
        let cells: Vec<[f64; N]> = picked(data.cells[q].as_ref()?, self.solids);
        let owners = &self.mesh.owner[self.mesh.inner_faces()..];
        let value = |(owner, on): (&u32, &Option<(u32, u32)>)| {
            on.and_then(|on| self.of_surface(on, q)).unwrap_or_else(|| cells[*owner as usize])
        };
        let boundary = owners.iter().zip(&self.boundary.on).map(value).collect();
        Some(Field::Cells { cells, boundary })
    }

    /// A value that a polygon of a surface has. Those among the solid cells have what their file gives all cells.
    fn of_surface<const N: usize>(&self, on: (u32, u32), q: usize) -> Option<[f64; N]> {
        self.given(on, q)?.first_chunk().copied()
    }

    /// The same, of any width. NaN stands where a file's cells have no value.
    fn given(&self, (surface, cell): (u32, u32), q: usize) -> Option<&[f64]> {
        let values = self.surfaces[surface as usize].grid.data.cells[q].as_ref()?;
        let value = values.chunks(QUANTITIES[q].1).nth(cell as usize)?;
        value.iter().all(|x| x.is_finite()).then_some(value)
    }

    fn others(&self) -> Vec<String> {
        let of_surfaces = self.surfaces.iter().filter(|s| !s.among_cells).map(|s| &s.grid.data);
        let all = std::iter::once(&self.grid.data).chain(of_surfaces).flat_map(|d| &d.others);
        let named = |n: &&String| !n.starts_with("vtk");
        let mut all: Vec<String> = all.filter(named).map(|n| clipped(n).into_owned()).collect();
        all.sort();
        all.dedup();
        all
    }

    /// Says where fields of cells have no values on the boundary.
    fn note(&self, notes: &mut Vec<String>) {
        let of_cells = |q: &usize| self.grid.data.points[*q].is_none() && self.grid.data.cells[*q].is_some();
        let Some(q) = (0..COUNT).find(of_cells) else { return };
        let mut bare: Vec<&str> = Vec::new();
        let inner = self.mesh.inner_faces();
        for patch in &self.mesh.patches {
            let mut on = self.boundary.on[patch.faces.start - inner..patch.faces.end - inner].iter();
            let has = |on: &Option<(u32, u32)>| on.is_some_and(|on| self.given(on, q).is_some());
            if !matches!(patch.kind, PatchKind::Empty | PatchKind::Wedge) && !on.all(has) {
                bare.push(&patch.name);
            }
        }
        if !bare.is_empty() {
            let more = if bare.len() > 8 { ", …" } else { "" };
            let names: Vec<_> = bare.iter().take(8).map(|n| clipped(n)).collect();
            let slips = if q == 0 { ", and the fluid slips along walls" } else { "" };
            notes.push(format!(
                "the {} is of cells, and the file gives it no values on {}{more}: there the cells' own hold{slips}",
                QUANTITIES[q].0,
                names.join(", ")
            ));
        }
    }
}

fn picked<const N: usize>(values: &[f64], which: &[u32]) -> Vec<[f64; N]> {
    let all = values.as_chunks::<N>().0;
    which.iter().map(|i| all[*i as usize]).collect()
}
