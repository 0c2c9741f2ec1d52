//! Which patch each outer face is in: the surface whose polygon has its corners at the same places.

use super::grid::Grid;
use super::join::key;
use super::sides::{NONE, Sides};
use crate::PatchKind;
use crate::geometry::face_centre_and_area;
use crate::geometry::vector::dot;
use carom_table::quoted;
use std::collections::HashMap;

/// Polygons that may lie on outer faces, under a name.
pub(super) struct Surface<'a> {
    pub name: String,
    pub kind: PatchKind,
    pub grid: &'a Grid,
    /// Its polygons, by their numbers in the grid.
    pub cells: Vec<u32>,
    /// Whether they are cells beside the solid ones: those may lie inside.
    pub among_cells: bool,
}

/// The outer faces, patch by patch.
#[derive(Debug, Default)]
pub(super) struct Boundary {
    /// The outer faces, by their numbers among the sides.
    pub faces: Vec<u32>,
    /// The surface and its polygon that each lies on.
    pub on: Vec<Option<(u32, u32)>>,
    /// Names of patches, what they are, and how many faces they have.
    pub patches: Vec<(String, PatchKind, usize)>,
}

/// What became of a surface's polygons.
#[derive(Default)]
struct Tally {
    placed: usize,
    taken: usize,
    lost: usize,
    first_lost: Option<[f64; 3]>,
}

/// The patch of outer faces that no surface names.
const REST: &str = "boundary";

/// Puts the outer faces into patches.
pub(super) fn boundary(
    points: &[[f64; 3]],
    sides: &Sides,
    surfaces: &[Surface],
    notes: &mut Vec<String>,
) -> Result<Boundary, String> {
    let outer: Vec<u32> = (0..sides.faces.len() as u32).filter(|f| sides.other[*f as usize] == NONE).collect();
    let mut names: Vec<(String, PatchKind)> = Vec::new();
    // of each outer face: patch, surface, polygon
    let mut on: Vec<Option<(u32, u32, u32)>> = vec![None; outer.len()];
    if !surfaces.is_empty() {
        let places = Places::of(points, sides, &outer);
        let mut placed = 0;
        for (s, surface) in surfaces.iter().enumerate() {
            let patch = names.iter().position(|n| n.0 == surface.name).unwrap_or(names.len()) as u32;
            let tally = places.put(surface, s as u32, patch, points, sides, &outer, &mut on);
            placed += if surface.among_cells { 0 } else { tally.placed };
            if tally.placed > 0 && patch as usize == names.len() {
                names.push((surface.name.clone(), surface.kind.clone()));
            }
            notes.extend(judged(surface, &tally)?);
        }
        if placed == 0 && surfaces.iter().any(|s| !s.among_cells) {
            let what = "no face of any block lies on an outer face of the mesh: its corners must have exactly the same coordinates";
            return Err(what.to_owned());
        }
    }
    let rest = on.iter().filter(|o| o.is_none()).count();
    if rest > 0 {
        let name = if names.iter().any(|n| n.0 == REST) { format!("{REST}-rest") } else { REST.to_owned() };
        if !surfaces.is_empty() {
            notes.push(format!("{rest} outer faces are in no block and on no boundary cell: they are patch `{name}`"));
        }
        names.push((name, PatchKind::Plain));
    }
    let mut patches: Vec<_> = names.into_iter().map(|(name, kind)| (name, kind, 0)).collect();
    let last = patches.len().saturating_sub(1) as u32;
    let patch = |i: usize| on[i].map_or(last, |o| o.0);
    let mut order: Vec<usize> = (0..outer.len()).collect();
    order.sort_by_key(|i| patch(*i));
    order.iter().for_each(|i| patches[patch(*i) as usize].2 += 1);
    Ok(Boundary {
        faces: order.iter().map(|i| outer[*i]).collect(),
        on: order.iter().map(|i| on[*i].map(|(_, surface, cell)| (surface, cell))).collect(),
        patches,
    })
}

/// What is to be said of a surface, or why it cannot be.
fn judged(surface: &Surface, tally: &Tally) -> Result<Option<String>, String> {
    let Tally { placed, taken, lost, first_lost } = *tally;
    let all = placed + taken + lost;
    let name = quoted(&surface.name);
    let count = |n: usize| if n == all { format!("all {all}") } else { format!("{n} of {all}") };
    let what = if surface.among_cells { "boundary cells of" } else { "faces of block" };
    let at = first_lost.map_or(String::new(), |[x, y, z]| format!("; the first of them begins at ({x}, {y}, {z})"));
    if lost > 0 && (placed == 0 || surface.among_cells) {
        let inside = if surface.among_cells { "lie inside the mesh" } else { "are no outer faces of the mesh" };
        return Ok(Some(format!("{} {what} {name} {inside}: they are left out{at}", count(lost))));
    }
    if lost > 0 {
        return Err(format!(
            "{} {what} {name} are no outer faces of the mesh: corners need the same coordinates{at}",
            count(lost)
        ));
    }
    match (placed, taken) {
        (_, 0) => Ok(None),
        (0, _) => Ok(Some(format!("{} {what} {name} are in other patches: it is left out", count(taken)))),
        _ => Err(format!("{} {what} {name} are faces of another patch too", count(taken))),
    }
}

/// Outer faces by the places of their corners.
struct Places {
    points: HashMap<[u64; 3], u32>,
    faces: HashMap<Vec<u32>, Vec<u32>>,
}

impl Places {
    fn of(points: &[[f64; 3]], sides: &Sides, outer: &[u32]) -> Self {
        let mut places = Self { points: HashMap::new(), faces: HashMap::new() };
        for (i, face) in outer.iter().enumerate() {
            let corners = sides.faces.get(*face as usize).iter();
            let mut ids: Vec<u32> = corners
                .map(|p| {
                    let next = places.points.len() as u32;
                    *places.points.entry(key(points[*p as usize])).or_insert(next)
                })
                .collect();
            ids.sort_unstable();
            places.faces.entry(ids).or_default().push(i as u32);
        }
        places
    }

    /// Puts a surface's polygons on the faces that are free.
    #[expect(clippy::too_many_arguments, reason = "what is looked up, and what is filled in")]
    fn put(
        &self,
        surface: &Surface,
        number: u32,
        patch: u32,
        points: &[[f64; 3]],
        sides: &Sides,
        outer: &[u32],
        on: &mut [Option<(u32, u32, u32)>],
    ) -> Tally {
        let mut tally = Tally::default();
        for &cell in &surface.cells {
            let Some(polygon) = surface.grid.polygon(cell as usize) else { continue };
            let ids: Option<Vec<u32>> =
                polygon.iter().map(|p| self.points.get(&key(surface.grid.points[*p as usize])).copied()).collect();
            let found = ids.and_then(|mut ids| {
                ids.sort_unstable();
                self.faces.get(&ids)
            });
            let Some(faces) = found else {
                tally.lost += 1;
                tally.first_lost.get_or_insert(surface.grid.points[polygon[0] as usize]);
                continue;
            };
            let mut free = faces.iter().copied().filter(|i| on[*i as usize].is_none());
            // of two faces in one place, as on a thin wall, the one that faces the same way
            let chosen = if faces.len() == 1 {
                free.next()
            } else {
                let area = face_centre_and_area(&surface.grid.points, &polygon).1;
                let alike = |i: &u32| {
                    let corners = sides.faces.get(outer[*i as usize] as usize);
                    dot(area, face_centre_and_area(points, corners).1) > 0.0
                };
                let free: Vec<u32> = free.collect();
                free.iter().copied().find(alike).or(free.first().copied())
            };
            match chosen {
                Some(i) => {
                    on[i as usize] = Some((patch, number, cell));
                    tally.placed += 1;
                }
                None => tally.taken += 1,
            }
        }
        tally
    }
}
