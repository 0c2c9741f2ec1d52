//! Cells at walls much wider than the spheres: told, as what comes to a wall slowly is met or missed by what the flow does within the last
//! radius, which such cells do not have (`docs/cfd-results.md`).

use super::injection::Injected;
use super::triangles::length;
use crate::domain::{ContactAt, Wall};
use crate::dynamics::Dynamics;
use crate::flow::{Cells, Flow};
use crate::force::Sphere;
use crate::tracker::Behavior;
use crate::vector::{norm, sub};

/// Cells of more radii than this are worth a word: in a bend at Stk = 0.28 cells of 11 radii keep a quarter of the deposit away, of 2 none.
const WIDE: f64 = 4.0;

/// The wall with the widest cells, as seen by the smallest spheres that do not fly through everything.
pub(super) fn note(
    flow: &Flow,
    walls: &[Wall],
    behaviors: &[Behavior],
    dynamics: &Dynamics,
    injections: &[Injected],
) -> Option<String> {
    let Flow::Cells(cells) = flow else { return None };
    let bounds = cells.bounds();
    let (size, speed) = (norm(sub(bounds.max, bounds.min)), cells.fastest([bounds.min, bounds.max]));
    let carried = |sphere: &Sphere| dynamics.relaxation_time(sphere) * speed < size;
    let medians = injections.iter().filter_map(|i| median(i, cells)).filter(carried);
    let diameter = medians.map(|sphere| sphere.diameter).reduce(f64::min)?;
    let solid = walls.iter().zip(behaviors).filter(|(wall, behavior)| {
        wall.contact_at == ContactAt::Surface && !matches!(behavior, Behavior::Escape | Behavior::WallJet)
    });
    let mut wide: Vec<(f64, &str)> =
        solid.filter_map(|(wall, _)| Some((height(cells, wall)?, wall.name.as_str()))).collect();
    wide.retain(|(height, _)| *height > WIDE * 0.5 * diameter);
    wide.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (height, name) = wide.first()?;
    let others = match wide.len() - 1 {
        0 => String::new(),
        1 => " (and at another)".to_owned(),
        more => format!(" (and at {more} more)"),
    };
    Some(format!(
        "cells at wall '{name}'{others} are {} high, {:.0} radii of a sphere of {}: of spheres that come to it slowly, the mesh decides which touch it; \
         contact_at = \"center\" or a finer mesh there tells how many",
        length(*height),
        height / (0.5 * diameter),
        length(diameter),
    ))
}

/// Median height of the cells at a wall that is a patch, m.
fn height(cells: &Cells, wall: &Wall) -> Option<f64> {
    let name = wall.patch.as_ref()?;
    cells.height_at(cells.patches().iter().find(|p| p.name == *name)?)
}

/// The sphere of an injection's median diameter.
fn median(injected: &Injected, cells: &Cells) -> Option<Sphere> {
    let spheres = injected.sample(|x| cells.velocity(x)).map(|p| Sphere { diameter: p.diameter, density: p.density });
    let mut spheres: Vec<Sphere> = spheres.collect();
    spheres.sort_by(|a, b| a.diameter.total_cmp(&b.diameter));
    spheres.get(spheres.len() / 2).copied()
}
