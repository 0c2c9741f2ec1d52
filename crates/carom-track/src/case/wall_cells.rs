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
/// So many starts of each injection are looked at.
const SAMPLE: u64 = 100;

/// The wall with the widest cells, as seen by the smallest spheres that do not fly through everything.
pub(super) fn note(
    flow: &Flow,
    walls: &[Wall],
    behaviors: &[Behavior],
    dynamics: &Dynamics,
    injections: &[Injected],
) -> Option<String> {
    let Flow::Cells(cells) = flow else { return None };
    let diameter = injections.iter().filter_map(|i| carried(i, cells, dynamics)).reduce(f64::min)?;
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

/// Median diameter of an injection, m, unless its spheres fly through the whole mesh before the flow stops them.
fn carried(injected: &Injected, cells: &Cells, dynamics: &Dynamics) -> Option<f64> {
    let count = injected.injection.count().min(SAMPLE);
    let mut starts: Vec<_> = (0..count).map(|i| injected.injection.particle(i, |_, x| cells.velocity(x))).collect();
    starts.sort_by(|a, b| a.diameter.total_cmp(&b.diameter));
    let median = starts.get(starts.len() / 2)?;
    let bounds = cells.bounds();
    let speed = cells.fastest([bounds.min, bounds.max]);
    let sphere = Sphere { diameter: median.diameter, density: median.density };
    let stops_within = dynamics.relaxation_time(&sphere) * speed;
    (stops_within < norm(sub(bounds.max, bounds.min))).then_some(median.diameter)
}
