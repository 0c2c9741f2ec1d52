//! Plane cases: across the plane that the fields are taken in, nothing changes, so the two triangles of a side make one.
//!
//! The mesh of a plane case is one cell thick. A face between two cells, or on the boundary but for the empty sides, is a strip between
//! two columns of two points each, on which the fields are alike (where values are given at points, that is looked at). So a cell is cut by its centre and its strips into as many triangles
//! of the plane, each of them in place of two tetrahedra with the same linear field. It is known by the first tetrahedron of its strip,
//! two of whose corners are on one column: each has half of the column's barycentric coordinate.

use super::beyond::Plane;
use super::cut::Cut;
use crate::vector::{norm, sub};
use carom_cfd::{Field, Fields, Mesh, PatchKind, Snapshot};

/// Along the plane, this share of an edge's length is none.
const ALONG: f64 = 1e-6;

/// Which tetrahedra of a plane case stand for the triangles of the plane.
#[derive(Debug)]
pub(super) struct Strips {
    /// Of each triangle of the cut, which of its corners is alone on its column; [`UNUSED`] where the triangle is not used.
    alone: Vec<u8>,
}

/// A triangle on an empty side, or the second of a strip.
const UNUSED: u8 = 3;

impl Strips {
    /// The strips of a plane case, whose neighbours are put into the cut; `None` where a side is no strip, or values at the points of a column differ.
    pub fn new(snapshot: &Snapshot, plane: &Plane, cut: &mut Cut) -> Option<Self> {
        let mesh = &snapshot.mesh;
        let empty = empty_faces(mesh);
        let sides: Vec<usize> = (0..mesh.faces.len()).filter(|f| !empty[*f]).collect();
        let column = columns(mesh, plane, &sides)?;
        if column.iter().zip(0..).any(|(first, p)| !alike(&snapshot.fields, *first as usize, p)) {
            return None;
        }
        let mut strips = Self { alone: vec![UNUSED; cut.triangles.len()] };
        for face in sides {
            let first = cut.first[face] as usize;
            let [a, b, c] = cut.triangles[first].map(|p| column[p as usize]);
            strips.alone[first] = match (a == b, b == c, c == a) {
                (true, false, false) => 2,
                (false, true, false) => 0,
                (false, false, true) => 1,
                _ => return None,
            };
        }
        let mut beside = Vec::new();
        for cell in 0..mesh.cells {
            strips.join(cell, &column, cut, &mut beside)?;
        }
        // the cut stays as it is unless all of it can be
        for (tet, side, next) in beside {
            cut.put_beside(tet, side, next);
        }
        Some(strips)
    }

    /// Which triangles of the plane lie beside each other in a cell; `None` where they do not go round its centre.
    fn join(&self, cell: usize, column: &[u32], cut: &Cut, beside: &mut Vec<(u32, usize, u32)>) -> Option<()> {
        let of = |tet: u32| cut.triangles[(tet >> 1) as usize].map(|p| column[p as usize]);
        let mut ends = Vec::new();
        for tet in cut.of_cell(cell).filter(|tet| self.alone[(tet >> 1) as usize] != UNUSED) {
            let corners = of(tet);
            let single = usize::from(self.alone[(tet >> 1) as usize]);
            ends.extend([(corners[single], tet), (corners[(single + 1) % 3], tet)]);
        }
        ends.sort_unstable();
        for shared in ends.chunk_by(|a, b| a.0 == b.0) {
            let &[(end, one), (_, other)] = shared else { return None };
            for (here, there) in [(one, other), (other, one)] {
                // behind the side that faces a corner lies what shares the other column
                let corners = of(here);
                beside.extend((0..3).filter(|side| corners[*side] != end).map(|side| (here, side, there)));
            }
        }
        Some(())
    }

    /// The corner of a tetrahedron's triangle that is alone on its column; 3 where the tetrahedron is not used.
    #[inline(always)]
    pub fn alone(&self, tet: u32) -> u64 {
        u64::from(self.alone[(tet >> 1) as usize])
    }
}

/// The column of each point, by the smaller number of its two; `None` where a side is no strip.
fn columns(mesh: &Mesh, plane: &Plane, sides: &[usize]) -> Option<Vec<u32>> {
    let across = |p: u32, q: u32| {
        let edge = sub(mesh.points[q as usize], mesh.points[p as usize]);
        norm(plane.along(edge)) <= ALONG * norm(edge)
    };
    let mut partner: Vec<u32> = (0..mesh.points.len() as u32).collect();
    for face in sides {
        let &[a, b, c, d] = mesh.faces.get(*face) else { return None };
        let pairs = match [across(a, b), across(b, c), across(c, d), across(d, a)] {
            [true, false, true, false] => [(a, b), (c, d)],
            [false, true, false, true] => [(b, c), (d, a)],
            _ => return None,
        };
        for (from, to) in pairs.into_iter().flat_map(|(p, q)| [(p, q), (q, p)]) {
            let known = partner[from as usize];
            if known != from && known != to {
                return None;
            }
            partner[from as usize] = to;
        }
    }
    Some(partner.into_iter().zip(0..).map(|(other, own)| own.min(other)).collect())
}

/// Whether what is given at two points is the same.
fn alike(fields: &Fields, p: usize, q: usize) -> bool {
    fn is_same<const N: usize>(field: Option<&Field<N>>, p: usize, q: usize) -> bool {
        match field {
            Some(Field::Points(values)) => values[p] == values[q],
            _ => true,
        }
    }
    is_same(fields.velocity.as_ref(), p, q) && fields.scalars().into_iter().all(|(_, field)| is_same(field, p, q))
}

fn empty_faces(mesh: &Mesh) -> Vec<bool> {
    let mut empty = vec![false; mesh.faces.len()];
    for patch in mesh.patches.iter().filter(|p| p.kind == PatchKind::Empty) {
        empty[patch.faces.clone()].fill(true);
    }
    empty
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Dice, shaken, with_cell_velocity};
    use super::super::{Cells, Cut};
    use super::*;
    use crate::vector::Vec3;
    use carom_cfd::block::Kind;
    use carom_cfd::geometry::{base_points, cell_centres_and_volumes, face_centres_and_areas};

    /// A plane case of uneven cells with a velocity of its own in each.
    fn plane_case() -> Snapshot {
        let mut mesh = shaken(Kind::Hexahedra, [7, 6, 1], 0.0, 1);
        let at = |x: Vec3| [x[0] + 0.05 * (9.0 * x[1]).sin(), x[1] + 0.04 * (7.0 * x[0]).cos(), 0.3 * x[2]];
        for x in &mut mesh.points {
            *x = at(*x);
        }
        for patch in mesh.patches.iter_mut().filter(|p| matches!(p.name.as_str(), "back" | "front")) {
            patch.kind = PatchKind::Empty;
        }
        let mut snapshot = with_cell_velocity(mesh, |_| [0.0; 3]);
        let mut dice = Dice::new(11);
        if let Some(Field::Cells { cells, boundary }) = &mut snapshot.fields.velocity {
            cells.iter_mut().chain(boundary).for_each(|v| *v = dice.point());
        }
        snapshot
    }

    #[test]
    fn triangles_of_the_plane_have_the_field_of_the_tetrahedra_they_stand_for() {
        let snapshot = plane_case();
        let mesh = &snapshot.mesh;
        let cells = Cells::new(&snapshot).unwrap();
        assert!(cells.strips.is_some());
        let (faces, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
        let (centres, _) = cell_centres_and_volumes(mesh, &faces, &areas);
        let cut = Cut::new(mesh, &base_points(mesh, &centres));
        let whole = Cells { cut, strips: None, ..Cells::new(&snapshot).unwrap() };
        let mut dice = Dice::new(12);
        let mut inside = 0;
        for _ in 0..2000 {
            let x = dice.point();
            let (got, want) = (cells.find(x), whole.find(x));
            assert_eq!(got.is_nowhere(), want.is_nowhere(), "{x:?}");
            inside += usize::from(!got.is_nowhere());
            assert!(norm(sub(got.velocity_at(x), want.velocity_at(x))) < 1e-12, "{x:?}");
        }
        assert!(inside > 1500, "{inside}");
    }

    #[test]
    fn values_at_points_are_alike_on_their_columns_or_no_strips_are_made() {
        let mut snapshot = plane_case();
        let along = |x: &Vec3| [x[0].sin() + x[1], x[0] * x[1], 0.0];
        snapshot.fields.velocity = Some(Field::Points(snapshot.mesh.points.iter().map(along).collect()));
        let cells = Cells::new(&snapshot).unwrap();
        assert!(cells.strips.is_some());
        let whole = Cells { strips: None, ..Cells::new(&snapshot).unwrap() };
        let mut dice = Dice::new(12);
        let mut inside = 0;
        for _ in 0..500 {
            let x = dice.point();
            let (got, want) = (cells.find(x), whole.find(x));
            inside += usize::from(!got.is_nowhere());
            assert!(norm(sub(got.velocity_at(x), want.velocity_at(x))) < 1e-12, "{x:?}");
        }
        assert!(inside > 300, "{inside}");
        let Some(Field::Points(values)) = &mut snapshot.fields.velocity else { unreachable!() };
        values[7][0] += 1e-3;
        assert!(Cells::new(&snapshot).unwrap().strips.is_none());
    }

    #[test]
    fn triangles_of_the_plane_lie_beside_each_other_where_they_share_a_column() {
        let snapshot = plane_case();
        let cells = Cells::new(&snapshot).unwrap();
        for cell in 0..cells.len() {
            let used: Vec<_> = cells.cut.of_cell(cell).filter_map(|tet| cells.tetrahedron(tet)).collect();
            assert_eq!(used.len(), 4);
            for here in &used {
                for side in 0..3 {
                    let next = cells.tetrahedron(cells.cut.beside(here.id, side)).unwrap();
                    assert!(next.cell == here.cell && next.id != here.id);
                    // the middle of their common side, from the cell's centre to a column
                    let corners = cells.corners(here.id, here.cell).0;
                    let end = (0..3).find(|i| here.dual[*i] != here.dual[side]).unwrap();
                    let end = cells.flat(cells.nodes[corners[end]].place);
                    let middle = [0, 1, 2].map(|c| 0.5 * (end[c] + here.origin[c]));
                    for at in [here, &next].map(|t| t.coordinates(middle)) {
                        let least = at.into_iter().fold(f64::INFINITY, f64::min);
                        assert!(least.abs() < 1e-12, "{at:?}");
                    }
                }
            }
        }
    }
}
