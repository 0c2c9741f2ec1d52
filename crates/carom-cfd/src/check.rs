//! What makes a mesh or a field unusable.
//!
//! A mesh that passes has its indices in their ranges, finite points, faces of three different corners at least, patches that hold every face of the boundary
//! once, and closed cells: every edge of a cell belongs to two of its faces, which run along it in opposite directions. Then the area vectors of a
//! cell sum to zero. Whether cells are flat, skewed or turned is a matter of quality, and refuses nothing.

use crate::geometry::{cell_centres_and_volumes, face_centres_and_areas};
use crate::{Field, Fields, Mesh, PatchKind, Snapshot};

/// At most so many cells are named.
const NAMED: usize = 10;

/// What is wrong with a mesh or a field.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Broken {
    /// A list is not as long as another says.
    #[error("{what}: {found} where there should be {expected}")]
    Length {
        /// Which list.
        what: String,
        /// How many it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
    /// An index points at nothing.
    #[error("face {face} names {what} {index}, and there are {count} (numbers start at 0)")]
    Index {
        /// The face.
        face: usize,
        /// What kind of thing it names.
        what: &'static str,
        /// Its number.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// A face is no polygon.
    #[error("face {face} of cell {cell} {why}")]
    Face {
        /// The face.
        face: usize,
        /// Its owner.
        cell: u32,
        /// What is wrong.
        why: String,
    },
    /// A point has a coordinate that is no finite number.
    #[error("point {point} is not finite: {at:?}")]
    Point {
        /// The point.
        point: usize,
        /// Where it is.
        at: [f64; 3],
    },
    /// Cells are not closed.
    #[error("{count} {} not closed by {} faces: {}{}", if *count == 1 { "cell is" } else { "cells are" }, if *count == 1 { "its" } else { "their" }, numbers(cells), if cells.len() < *count { ", …" } else { "" })]
    Open {
        /// How many.
        count: usize,
        /// The first of them.
        cells: Vec<u32>,
    },
    /// All in all the cells have no volume, or are inside out.
    #[error("the cells have a volume of {volume:e} m³ in total: faces do not point out of their owners")]
    InsideOut {
        /// Total volume, m³.
        volume: f64,
    },
    /// The patches do not hold the boundary.
    #[error("patch `{patch}`: {why}")]
    Patch {
        /// The patch.
        patch: String,
        /// What is wrong.
        why: String,
    },
    /// A field is of another mesh.
    #[error("field {field} has {found} values for {expected} {what}s: it belongs to another mesh")]
    FieldLength {
        /// The field.
        field: String,
        /// How many values it has.
        found: usize,
        /// How many there should be.
        expected: usize,
        /// Of what.
        what: &'static str,
    },
    /// A field has a value that is no finite number.
    #[error("field {field} is not finite in {what} {index}: {}", shown(value))]
    FieldValue {
        /// The field.
        field: String,
        /// What kind of place.
        what: &'static str,
        /// Which.
        index: usize,
        /// The value.
        value: Vec<f64>,
    },
}

fn numbers(cells: &[u32]) -> String {
    cells.iter().map(u32::to_string).collect::<Vec<_>>().join(", ")
}

fn shown(value: &[f64]) -> String {
    let all: Vec<_> = value.iter().map(f64::to_string).collect();
    if all.len() == 1 { all.concat() } else { format!("({})", all.join(" ")) }
}

/// Refuses a snapshot whose mesh or fields cannot be used.
pub fn snapshot(snapshot: &Snapshot) -> Result<(), Broken> {
    mesh(&snapshot.mesh)?;
    fields(&snapshot.fields, &snapshot.mesh)
}

/// Refuses a mesh that cannot be used.
pub fn mesh(mesh: &Mesh) -> Result<(), Broken> {
    indices(mesh)?;
    patches(mesh)?;
    cells(mesh)
}

/// Refuses faces, points and cells that cannot be used, whatever the patches.
pub(crate) fn without_patches(mesh: &Mesh) -> Result<(), Broken> {
    indices(mesh)?;
    cells(mesh)
}

fn cells(mesh: &Mesh) -> Result<(), Broken> {
    if let Some((point, at)) = mesh.points.iter().enumerate().find(|(_, x)| x.iter().any(|x| !x.is_finite())) {
        return Err(Broken::Point { point, at: *at });
    }
    closed(mesh)?;
    let (centres, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
    let volume = cell_centres_and_volumes(mesh, &centres, &areas).1.iter().sum::<f64>();
    if volume > 0.0 { Ok(()) } else { Err(Broken::InsideOut { volume }) }
}

fn length(what: &str, found: usize, expected: usize) -> Result<(), Broken> {
    if found == expected { Ok(()) } else { Err(Broken::Length { what: what.into(), found, expected }) }
}

fn indices(mesh: &Mesh) -> Result<(), Broken> {
    let faces = &mesh.faces;
    let starts = &faces.starts;
    if faces.is_empty() || mesh.cells == 0 {
        return Err(Broken::Length { what: "cells".into(), found: 0, expected: 1 });
    }
    length("owners of faces", mesh.owner.len(), faces.len())?;
    if mesh.neighbour.len() > faces.len() {
        length("neighbours of faces", mesh.neighbour.len(), faces.len())?;
    }
    length("start of the first face", starts[0] as usize, 0)?;
    length("corners of faces", faces.corners.len(), starts[faces.len()] as usize)?;
    let mut last = vec![u32::MAX; mesh.points.len()];
    for face in 0..faces.len() {
        let cell = mesh.owner[face];
        let bad = |why: String| Err(Broken::Face { face, cell, why });
        let corners = match starts[face + 1].checked_sub(starts[face]) {
            None => return bad("has less than no corners".into()),
            Some(n @ 0..3) => return bad(format!("has {n} corners")),
            Some(_) => faces.get(face),
        };
        for &point in corners {
            match last.get_mut(point as usize) {
                None => {
                    let count = mesh.points.len();
                    return Err(Broken::Index { face, what: "point", index: point, count });
                }
                Some(seen) if *seen == face as u32 => return bad(format!("has corner {point} twice")),
                Some(seen) => *seen = face as u32,
            }
        }
        let other = mesh.neighbour.get(face).copied();
        for index in [Some(cell), other].into_iter().flatten() {
            if index as usize >= mesh.cells {
                return Err(Broken::Index { face, what: "cell", index, count: mesh.cells });
            }
        }
        if other == Some(cell) {
            return bad("has the same cell on both sides".into());
        }
    }
    Ok(())
}

/// Refuses patches that do not hold the boundary.
pub(crate) fn patches(mesh: &Mesh) -> Result<(), Broken> {
    let mut next = mesh.inner_faces();
    for patch in &mesh.patches {
        let bad = |why: String| Err(Broken::Patch { patch: patch.name.clone(), why });
        if patch.faces.start != next || patch.faces.end < next || patch.faces.end > mesh.faces.len() {
            return bad(format!("has the faces {:?} where {next} is the next of {}", patch.faces, mesh.faces.len()));
        }
        next = patch.faces.end;
        if let PatchKind::Cyclic { partner, .. } | PatchKind::CyclicAmi { partner, .. } = patch.kind {
            let Some(other) = mesh.patches.get(partner) else {
                return bad("has no other side".into());
            };
            if matches!(patch.kind, PatchKind::Cyclic { .. }) && other.faces.len() != patch.faces.len() {
                let (here, there) = (patch.faces.len(), other.faces.len());
                return bad(format!("has {here} faces, and `{}`, its other side, {there}", other.name));
            }
        }
    }
    length("faces of the patches and between cells", next, mesh.faces.len())
}

/// Faces of each cell: those of cell `c` are `faces[starts[c]..starts[c + 1]]`, own ones and the neighbours' in order of their numbers.
pub(crate) fn faces_of_cells(mesh: &Mesh) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; mesh.cells + 1];
    for &c in mesh.owner.iter().chain(&mesh.neighbour) {
        starts[c as usize + 1] += 1;
    }
    for c in 0..mesh.cells {
        starts[c + 1] += starts[c];
    }
    let mut next = starts.clone();
    let mut faces = vec![0_u32; mesh.owner.len() + mesh.neighbour.len()];
    for (f, &owner) in mesh.owner.iter().enumerate() {
        for c in [Some(owner), mesh.neighbour.get(f).copied()].into_iter().flatten() {
            let place = &mut next[c as usize];
            faces[*place as usize] = f as u32;
            *place += 1;
        }
    }
    (starts, faces)
}

fn closed(mesh: &Mesh) -> Result<(), Broken> {
    let (starts, faces) = faces_of_cells(mesh);
    let (mut count, mut cells) = (0, Vec::new());
    // an edge, its points in order, and which way it is run along
    let mut edges: Vec<(u64, bool)> = Vec::new();
    for c in 0..mesh.cells {
        edges.clear();
        for &f in &faces[starts[c] as usize..starts[c + 1] as usize] {
            let corners = mesh.faces.get(f as usize);
            let own = mesh.owner[f as usize] as usize == c;
            let mut from = corners[corners.len() - 1];
            for &to in corners {
                let (low, high) = (from.min(to), from.max(to));
                edges.push((u64::from(low) << 32 | u64::from(high), own == (from < to)));
                from = to;
            }
        }
        edges.sort_unstable();
        let (pairs, left) = edges.as_chunks::<2>();
        let paired = pairs.iter().all(|[a, b]| a.0 == b.0 && a.1 != b.1);
        let shared = pairs.windows(2).any(|w| w[0][0].0 == w[1][0].0);
        if edges.is_empty() || !left.is_empty() || !paired || shared {
            count += 1;
            if cells.len() < NAMED {
                cells.push(c as u32);
            }
        }
    }
    if count == 0 { Ok(()) } else { Err(Broken::Open { count, cells }) }
}

/// Refuses fields of another mesh and values that are no finite numbers.
pub fn fields(fields: &Fields, mesh: &Mesh) -> Result<(), Broken> {
    fields.velocity.as_ref().map_or(Ok(()), |f| field("velocity", f, mesh))?;
    for (name, scalar) in fields.scalars() {
        scalar.map_or(Ok(()), |f| field(name, f, mesh))?;
    }
    Ok(())
}

/// Refuses a field of another mesh and values that are no finite numbers.
pub fn field<const N: usize>(name: &str, field: &Field<N>, mesh: &Mesh) -> Result<(), Broken> {
    let list = |values: &[[f64; N]], expected: usize, what: &'static str, first: usize| {
        if values.len() != expected {
            return Err(Broken::FieldLength { field: name.into(), found: values.len(), expected, what });
        }
        match values.iter().position(|v| v.iter().any(|x| !x.is_finite())) {
            Some(i) => {
                Err(Broken::FieldValue { field: name.into(), what, index: first + i, value: values[i].to_vec() })
            }
            None => Ok(()),
        }
    };
    match field {
        Field::Points(values) => list(values, mesh.points.len(), "point", 0),
        Field::Cells { cells, boundary } => {
            list(cells, mesh.cells, "cell", 0)?;
            let inner = mesh.inner_faces();
            list(boundary, mesh.faces.len() - inner, "face", inner)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::block;

    fn broken(change: impl FnOnce(&mut Mesh)) -> Broken {
        let mut m = block([3, 2, 2], [1.0; 3]);
        mesh(&m).unwrap();
        change(&mut m);
        mesh(&m).unwrap_err()
    }

    #[test]
    fn indices_out_of_range_name_the_face() {
        let e = broken(|m| m.faces.corners[5] = 36);
        assert_eq!(e, Broken::Index { face: 1, what: "point", index: 36, count: 36 });
        assert!(matches!(broken(|m| m.owner[3] = 12), Broken::Index { face: 3, what: "cell", index: 12, .. }));
        assert!(matches!(broken(|m| m.neighbour[0] = 99), Broken::Index { face: 0, what: "cell", index: 99, .. }));
        assert!(matches!(broken(|m| m.neighbour[0] = m.owner[0]), Broken::Face { face: 0, .. }));
        assert!(matches!(broken(|m| m.faces.corners[1] = m.faces.corners[0]), Broken::Face { face: 0, cell: 0, .. }));
        assert!(matches!(broken(|m| m.faces.starts[1] = 2), Broken::Face { face: 0, cell: 0, .. }));
        assert!(matches!(broken(|m| m.faces.starts[1] = 90), Broken::Face { .. }));
    }

    #[test]
    fn points_that_are_not_finite_are_named() {
        assert!(matches!(broken(|m| m.points[7][1] = f64::NAN), Broken::Point { point: 7, .. }));
        assert!(matches!(broken(|m| m.points[8][2] = f64::INFINITY), Broken::Point { point: 8, .. }));
    }

    #[test]
    fn open_cells_are_named() {
        // a face that belongs to the wrong cell opens both
        let e = broken(|m| *m.owner.last_mut().unwrap() = 0);
        assert_eq!(e, Broken::Open { count: 2, cells: vec![0, 11] });
        assert_eq!(e.to_string(), "2 cells are not closed by their faces: 0, 11");
        // a face turned over
        assert!(matches!(broken(|m| m.faces.corners[..4].reverse()), Broken::Open { count: 2, .. }));
        // a cell that no face knows
        assert!(matches!(broken(|m| m.cells += 1), Broken::Open { count: 1, .. }));
    }

    #[test]
    fn a_mesh_inside_out_is_refused() {
        let e = broken(|m| m.points.iter_mut().for_each(|x| x[0] = -x[0]));
        assert!(matches!(e, Broken::InsideOut { volume } if (volume + 1.0).abs() < 1e-14), "{e}");
    }

    #[test]
    fn patches_hold_the_boundary() {
        assert!(matches!(broken(|m| m.patches[2].faces.end -= 1), Broken::Patch { .. }));
        assert!(matches!(broken(|m| drop(m.patches.pop())), Broken::Length { .. }));
        let kind = |partner| PatchKind::Cyclic { partner, carry: crate::Carry::by([1.0, 0.0, 0.0]) };
        assert!(matches!(broken(|m| m.patches[0].kind = kind(17)), Broken::Patch { .. }));
        assert!(matches!(broken(|m| m.patches[0].kind = kind(2)), Broken::Patch { .. }));
    }

    #[test]
    fn fields_of_another_mesh_and_values_that_are_not_finite_are_refused() {
        let m = block([3, 2, 2], [1.0; 3]);
        let faces = m.faces.len() - m.inner_faces();
        let good = Field::Cells { cells: vec![[1.0]; 12], boundary: vec![[0.0]; faces] };
        assert_eq!(field("k", &good, &m), Ok(()));
        let short = Field::Cells { cells: vec![[1.0]; 11], boundary: vec![[0.0]; faces] };
        let e = field("k", &short, &m).unwrap_err();
        assert_eq!(e.to_string(), "field k has 11 values for 12 cells: it belongs to another mesh");
        let mut bad = vec![[0.0; 3]; 36];
        bad[4] = [0.0, f64::NAN, 1.0];
        let e = field("U", &Field::Points(bad), &m).unwrap_err();
        assert_eq!(e.to_string(), "field U is not finite in point 4: (0 NaN 1)");
    }
}
