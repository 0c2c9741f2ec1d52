//! The pieces of a mesh put together: points with exactly equal coordinates become one.

use super::data::{Labels, QUANTITIES};
use super::grid::Grid;
use crate::Polygons;
use std::collections::HashMap;

/// Coordinates as a key: equal ones have equal keys, zero whatever its sign.
pub(super) fn key(x: [f64; 3]) -> [u64; 3] {
    x.map(|c| (c + 0.0).to_bits())
}

/// Values of two pieces at one point that differ by more than this part of the largest are told.
const ALIKE: f64 = 1e-6;

/// One grid of several.
pub(super) fn join(grids: Vec<Grid>, notes: &mut Vec<String>) -> Result<Grid, String> {
    let mut parts = grids.into_iter();
    let Some(mut whole) = parts.next() else { return Err("no cells".to_owned()) };
    if parts.len() == 0 {
        return Ok(whole);
    }
    let mut ids = Ids::default();
    let first: Vec<u32> = ids.of(&whole.points, 0)?;
    if first.iter().enumerate().any(|(i, n)| i as u32 != *n) {
        // points that coincide within the first piece
        whole.cells.corners.iter_mut().chain(&mut whole.shells.faces.corners).for_each(|c| *c = first[*c as usize]);
        whole.points = ids.points.clone();
        let keep = kept(&first, 0);
        for (values, (_, width, _)) in whole.data.points.iter_mut().zip(QUANTITIES) {
            if let Some(values) = values {
                *values = only(values, width, &keep);
            }
        }
    }
    let mut apart = 0.0_f64;
    for (n, part) in parts.enumerate() {
        let before = ids.points.len();
        let to = ids.of(&part.points, n + 1)?;
        apart = apart.max(append(&mut whole, part, &to, before)?);
    }
    whole.points = ids.points;
    if ids.twice > 0 {
        notes.push(format!(
            "{} points of single pieces coincide with others of the same piece: they are one now, and a thin wall there is closed up",
            ids.twice
        ));
    }
    if apart > ALIKE {
        notes.push(format!(
            "where pieces meet, values of their points differ by up to {apart:.1e} of the largest: the first piece's are taken"
        ));
    }
    Ok(whole)
}

/// Numbers of places.
#[derive(Default)]
struct Ids {
    of: HashMap<[u64; 3], (u32, u32)>,
    points: Vec<[f64; 3]>,
    twice: usize,
}

impl Ids {
    /// The numbers of a piece's points in the whole.
    fn of(&mut self, points: &[[f64; 3]], piece: usize) -> Result<Vec<u32>, String> {
        let mut to = Vec::with_capacity(points.len());
        for x in points {
            let next = u32::try_from(self.points.len()).map_err(|_| "too many points")?;
            let (id, last) = self.of.entry(key(*x)).or_insert((next, u32::MAX));
            self.twice += usize::from(*last == piece as u32);
            *last = piece as u32;
            if *id == next {
                self.points.push(*x);
            }
            to.push(*id);
        }
        Ok(to)
    }
}

/// The points that are new: the first of each number from `before` on.
fn kept(to: &[u32], before: usize) -> Vec<usize> {
    let mut next = before;
    let mut keep = Vec::new();
    for (i, id) in to.iter().enumerate() {
        if *id as usize == next {
            keep.push(i);
            next += 1;
        }
    }
    keep
}

fn only(values: &[f64], width: usize, keep: &[usize]) -> Vec<f64> {
    keep.iter().flat_map(|i| values[i * width..][..width].iter().copied()).collect()
}

/// Adds a piece; says how far values at common points are apart.
fn append(whole: &mut Grid, part: Grid, to: &[u32], before: usize) -> Result<f64, String> {
    let keep = kept(to, before);
    let mut apart = 0.0_f64;
    for (q, (name, width, _)) in QUANTITIES.iter().enumerate() {
        let [mine, theirs] = [&whole.data, &part.data].map(|d| [d.points[q].is_some(), d.cells[q].is_some()]);
        if mine != theirs {
            return Err(format!("its pieces do not all have the {name}, or not all at points"));
        }
        if let (Some(all), Some(more)) = (&mut whole.data.points[q], &part.data.points[q]) {
            let most = all.iter().filter(|x| x.is_finite()).fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
            for (i, id) in to.iter().enumerate().filter(|(_, id)| (**id as usize) < before) {
                let (a, b) = (&mut all[*id as usize * width..][..*width], &more[i * width..][..*width]);
                let [mine, theirs] = [&*a, b].map(|v| v.iter().all(|x| x.is_finite()));
                if !mine {
                    // no cell of the pieces before has this point
                    a.copy_from_slice(b);
                } else if theirs {
                    apart = a.iter().zip(b).fold(apart, |m, (a, b)| m.max((a - b).abs() / most));
                }
            }
            all.extend(only(more, *width, &keep));
        }
        if let (Some(all), Some(more)) = (&mut whole.data.cells[q], &part.data.cells[q]) {
            all.extend(more);
        }
    }
    match (&mut whole.data.labels, part.data.labels) {
        (None, None) => {}
        (Some(Labels::Numbers(all)), Some(Labels::Numbers(more))) => all.extend(more),
        (Some(Labels::Texts(all)), Some(Labels::Texts(more))) => all.extend(more),
        _ => return Err("its pieces do not all have the array that names patches".to_owned()),
    }
    let others = part.data.others.into_iter();
    let new: Vec<String> = others.filter(|n| !whole.data.others.contains(n)).collect();
    whole.data.others.extend(new);
    whole.data.ghosts += part.data.ghosts;
    whole.time = whole.time.or(part.time);
    if !whole.shells.starts.is_empty() || !part.shells.starts.is_empty() {
        if whole.shells.starts.is_empty() {
            whole.shells.starts = vec![0; whole.kinds.len() + 1];
            whole.shells.faces.starts = vec![0];
        }
        let base = whole.shells.faces.len() as u32;
        let cells = part.kinds.len();
        if part.shells.starts.is_empty() {
            whole.shells.starts.extend(std::iter::repeat_n(base, cells));
        } else {
            whole.shells.starts.extend(part.shells.starts.iter().skip(1).map(|s| s + base));
            lists(&mut whole.shells.faces, &part.shells.faces, to)?;
        }
    }
    lists(&mut whole.cells, &part.cells, to)?;
    whole.kinds.extend(part.kinds);
    Ok(apart)
}

/// Adds lists of points, with their new numbers.
fn lists(all: &mut Polygons, more: &Polygons, to: &[u32]) -> Result<(), String> {
    let base = all.corners.len() as u32;
    if u32::try_from(all.corners.len() + more.corners.len()).is_err() {
        return Err("too many cells".to_owned());
    }
    all.starts.extend(more.starts.iter().skip(1).map(|s| s + base));
    all.corners.extend(more.corners.iter().map(|c| to[*c as usize]));
    Ok(())
}
