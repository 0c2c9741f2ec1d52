//! Scales that cannot be meant: told, not refused.

use super::injection::{Injected, hull};
use crate::domain::{ContactAt, Wall};
use crate::flow::Flow;
use crate::geometry::Shape;
use crate::tracker::Behavior;

/// A wall as far as this from everything injected is worth a word, m: no stage, duct or chamber is as large.
const FAR: f64 = 3.0;
/// Unless another wall is near: then it may be the far end of something long.
const LONG: f64 = 1e3;

/// What to say of a case's lengths.
pub(super) fn notes(flow: &Flow, walls: &[Wall], behaviors: &[Behavior], injections: &[Injected]) -> Vec<String> {
    let mut notes = far_walls(walls, injections);
    if walls.is_empty() {
        notes.push("the case has no [[wall]]: nothing is met, and the end of the run alone ends a flight".to_owned());
    }
    notes.extend(small_walls(walls, injections));
    notes.extend(narrow_bores(walls, behaviors, injections));
    if let Flow::Table(table) = flow {
        let ([nx, ny, nz], [low, high]) = (table.size(), table.bounds());
        let [x, y, z] = [0, 1, 2].map(|c| super::triangles::length(high[c] - low[c]));
        notes.push(format!("flow table: {nx} x {ny} x {nz} nodes, {x} x {y} x {z}"));
        notes.extend(table.notes().iter().map(|note| format!("flow table: {note}")));
        notes.extend(injections.iter().filter_map(|i| outside(table.bounds(), i)));
    }
    notes
}

fn far_walls(walls: &[Wall], injections: &[Injected]) -> Vec<String> {
    let starts: Vec<_> = injections.iter().flat_map(|i| hull(&i.injection.plan().source)).collect();
    let nearest = |w: &Wall| starts.iter().map(|x| w.shape.distance(*x).abs()).fold(f64::INFINITY, f64::min);
    let distances: Vec<f64> = walls.iter().map(nearest).collect();
    let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
    let far = walls.iter().zip(distances).filter(|(_, d)| d.is_finite() && *d > FAR && *d < LONG * (least + FAR));
    far.filter(|(_, d)| least > FAR || *d > LONG * FAR)
        .map(|(wall, distance)| {
            let unit = if matches!(wall.shape, Shape::Mesh(_)) {
                ": an STL file is read in metres unless unit = \"1 mm\" says otherwise"
            } else {
                ": are its lengths meant in metres?"
            };
            format!("wall '{}' lies {distance:.3} m from everything injected{unit}", wall.name)
        })
        .collect()
}

/// Walls of triangles that are smaller than the spheres.
fn small_walls(walls: &[Wall], injections: &[Injected]) -> Vec<String> {
    let largest = injections.iter().map(|i| i.largest).fold(0.0, f64::max);
    let size = |wall: &Wall| match &wall.shape {
        Shape::Mesh(mesh) => Some((0..3).map(|c| mesh.bounds().max[c] - mesh.bounds().min[c]).fold(0.0, f64::max)),
        _ => None,
    };
    let small = walls.iter().filter_map(|wall| Some((wall, size(wall)?))).filter(|(_, size)| *size < largest);
    small
        .map(|(wall, size)| {
            let name = &wall.name;
            format!("wall '{name}' is {size:.3e} m large, less than a sphere of {largest:.3e} m: is the unit of its file right?")
        })
        .collect()
}

/// Bores in which the contact is a longer ellipse than its formula is good for ([`carom::curvature`]).
fn narrow_bores(walls: &[Wall], behaviors: &[Behavior], injections: &[Injected]) -> Vec<String> {
    let largest = injections.iter().map(|i| i.largest).fold(0.0, f64::max);
    let narrow = |w: &Wall| {
        w.contact_at == ContactAt::Surface && matches!(&w.shape, Shape::Cylinder(c) if c.inside && largest > c.radius)
    };
    let laws = walls.iter().zip(behaviors).filter(|(wall, b)| b.laws().is_some() && narrow(wall));
    laws.map(|(wall, _)| {
        format!(
            "wall '{}' is less than twice as wide as a sphere of {largest:.3e} m: the true contact is more than 2 % stiffer than the formula",
            wall.name
        )
    })
    .collect()
}

/// An injection further outside a table than the table is large.
fn outside([low, high]: [[f64; 3]; 2], injected: &Injected) -> Option<String> {
    let size = (0..3).map(|c| high[c] - low[c]).fold(0.0, f64::max);
    // along an axis of one node nothing varies, and nothing is outside
    let off = |x: &[f64; 3]| {
        let axes = (0..3).filter(|c| high[*c] > low[*c]);
        axes.map(|c| (low[c] - x[c]).max(x[c] - high[c])).fold(0.0, f64::max)
    };
    let nearest = hull(&injected.injection.plan().source).iter().map(off).fold(f64::INFINITY, f64::min);
    (nearest > size && size > 0.0).then(|| {
        format!(
            "{} starts {nearest:.3} m outside the table of the flow, which is {size:.3} m large: beyond it the values of its boundary hold",
            injected.name
        )
    })
}
