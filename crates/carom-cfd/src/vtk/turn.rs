//! Faces turned so that their area vectors point out of their cell.

use crate::Polygons;
use crate::geometry::vector::{cross, dot, sub};

/// An edge, its points in order; the face; whether the face runs along it from the lower point to the higher.
pub(super) type Edge = (u32, u32, u32, bool);

/// Turns the faces from `first` on, those of one cell, outward. Of a cell of a known kind (`agree`), the faces agree and only all may
/// be wrong; a polyhedron's may each be turned either way. Whether all of a known kind's were wrong.
pub(super) fn turned_out(
    points: &[[f64; 3]],
    faces: &mut Polygons,
    first: usize,
    agree: bool,
    edges: &mut Vec<Edge>,
) -> Result<bool, String> {
    if !agree {
        return polyhedron(points, faces, first, edges).map(|()| false);
    }
    let all = first..faces.len();
    let wrong = volume(points, faces, all.clone()) < 0.0;
    if wrong {
        all.for_each(|f| turn(faces, f));
    }
    Ok(wrong)
}

fn turn(faces: &mut Polygons, face: usize) {
    let (from, to) = (faces.starts[face] as usize, faces.starts[face + 1] as usize);
    faces.corners[from..to].reverse();
}

/// Six times the volume within faces: V = ⅙ Σ a·(b × c) over their triangles, from one of their points.
fn volume(points: &[[f64; 3]], faces: &Polygons, which: impl IntoIterator<Item = usize>) -> f64 {
    let mut origin = None;
    let mut sum = 0.0;
    for f in which {
        let corners = faces.get(f);
        let at = |i: usize| points[corners[i] as usize];
        let o = *origin.get_or_insert(at(0));
        let a = sub(at(0), o);
        let mut b = sub(at(1), o);
        for i in 2..corners.len() {
            let c = sub(at(i), o);
            sum += dot(a, cross(b, c));
            b = c;
        }
    }
    sum
}

/// Lets a polyhedron's faces agree, from neighbour to neighbour across their edges, and then point outward.
fn polyhedron(points: &[[f64; 3]], faces: &mut Polygons, first: usize, edges: &mut Vec<Edge>) -> Result<(), String> {
    let count = faces.len() - first;
    edges.clear();
    for f in 0..count {
        let corners = faces.get(first + f);
        let mut from = corners[corners.len() - 1];
        for &to in corners {
            edges.push((from.min(to), from.max(to), f as u32, from < to));
            from = to;
        }
    }
    edges.sort_unstable();
    let mut agreed = true;
    for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let [a, b] = same else {
            let (p, q, ..) = same[0];
            let how_many = same.len();
            let closed = if how_many == 1 { "it is open" } else { "its surface is not that of one body" };
            return Err(format!("the edge between points {p} and {q} has {how_many} of its faces: {closed}"));
        };
        agreed &= a.3 != b.3;
    }
    if agreed && is_connected(edges, count) {
        if volume(points, faces, first..first + count) < 0.0 {
            (first..first + count).for_each(|f| turn(faces, f));
        }
        return Ok(());
    }
    one_by_one(points, faces, first, count, edges)
}

/// Whether faces hang together; a surface with as many corners and faces as one ball has is one (Euler).
fn is_connected(edges: &[Edge], faces: usize) -> bool {
    let mut corners: Vec<u32> = edges.iter().flat_map(|e| [e.0, e.1]).collect();
    corners.sort_unstable();
    corners.dedup();
    corners.len() + faces == edges.len() / 2 + 2
}

fn one_by_one(
    points: &[[f64; 3]],
    faces: &mut Polygons,
    first: usize,
    count: usize,
    edges: &[Edge],
) -> Result<(), String> {
    // of each face: its neighbours, and whether they run along the common edge against it, as they should
    let mut near: Vec<Vec<(u32, bool)>> = vec![Vec::new(); count];
    for pair in edges.as_chunks::<2>().0 {
        let [a, b] = pair;
        near[a.2 as usize].push((b.2, a.3 != b.3));
        near[b.2 as usize].push((a.2, a.3 != b.3));
    }
    let mut turned: Vec<Option<bool>> = vec![None; count];
    for begin in 0..count {
        if turned[begin].is_some() {
            continue;
        }
        turned[begin] = Some(false);
        let mut part = vec![begin];
        let mut at = 0;
        while let Some(&f) = part.get(at) {
            at += 1;
            let mine = turned[f] == Some(true);
            for &(other, agrees) in &near[f] {
                let wanted = mine == agrees;
                match turned[other as usize] {
                    None => {
                        turned[other as usize] = Some(wanted);
                        part.push(other as usize);
                    }
                    Some(t) if t != wanted => return Err("its surface has one side only".to_owned()),
                    Some(_) => {}
                }
            }
        }
        for &f in &part {
            if turned[f] == Some(true) {
                turn(faces, first + f);
            }
        }
        if volume(points, faces, part.iter().map(|f| first + f)) < 0.0 {
            part.iter().for_each(|f| turn(faces, first + f));
        }
    }
    Ok(())
}
