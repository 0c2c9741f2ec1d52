//! A map over two quantities: where a sphere is captured, where it rebounds, where it yields on the way.

use super::{Args, impacts, short, title, whole};
use crate::failure::Failure;
use crate::grid::Over;
use crate::law::Law;
use crate::motion::{Met, Motion};
use crate::samples::SampleArgs;
use carom::Validity;
use carom_report::{Axis, HeatMap};

/// The regions, in the order of their numbers.
const REGIONS: [&str; 3] = ["capture", "rebound", "rebound with yield"];

/// The region of an impact.
fn region(law: &Law, motion: &Motion, met: &Met) -> f64 {
    let yielding = || {
        let own = law.wall.yield_velocity(motion.diameter, None).ok().flatten();
        own.is_some_and(|v| motion.components().0 > v) || met.outcome.validity.contains(Validity::ABOVE_YIELD)
    };
    match (met.rebounds(), yielding()) {
        (false, _) => 0.0,
        (true, false) => 1.0,
        (true, true) => 2.0,
    }
}

/// Makes the map.
pub fn run(args: &Args, across: &Over, up: &Over) -> Result<(), Failure> {
    let files = args.grid.files()?;
    refuse_samples(&args.samples)?;
    if args.data.is_some() {
        return Err(Failure::input("--data: points lie over curves, not over a map; leave out one --over"));
    }
    let (map, rows) = args.grid.map(across, up, &args.case)?;
    let grid = map.grid(across, &args.case)?;
    let (mut met, mut regions, mut laws) = (Vec::new(), Vec::new(), Vec::new());
    for curve in &grid.curves {
        let along = curve.laws(&grid)?;
        for (place, (one, motion)) in impacts(&grid, curve, &along)?.into_iter().enumerate() {
            regions.push(region(&along[place.min(along.len() - 1)], &motion, &one));
            met.push(one);
        }
        if laws.is_empty() {
            laws.extend(along.into_iter().next());
        }
    }
    let oblique = grid.curves.iter().any(|c| grid.is_oblique(c));
    grid.show_drawn(
        &files,
        || whole(&grid, &met),
        || short(&grid, &met, oblique),
        |path| {
            let name = args.grid.title().map_or_else(|| title(&grid, &laws), str::to_owned);
            let (linear_x, linear_y) = (args.grid.is_linear(across), args.grid.is_linear(up));
            HeatMap::new(name, across.axis(linear_x), up.axis(linear_y), Axis::new("", ""))
                .classes(REGIONS)
                .cells(edges(&grid.points, linear_x), edges(&rows, linear_y), regions.iter().copied())
                .write(path)
        },
    )
}

fn refuse_samples(samples: &SampleArgs) -> Result<(), Failure> {
    match samples.sampling(false) {
        Some(_) => Err(Failure::input("--samples: a map draws nothing; leave it out, or one --over")),
        None => Ok(()),
    }
}

/// The ends of the points, and what lies between them.
fn edges(points: &[f64], linear: bool) -> Vec<f64> {
    let between = |pair: &[f64]| if linear { 0.5 * (pair[0] + pair[1]) } else { (pair[0] * pair[1]).sqrt() };
    let inner = points.windows(2).map(between);
    points.first().copied().into_iter().chain(inner).chain(points.last().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_lie_about_their_points() {
        assert_eq!(edges(&[1.0, 4.0, 16.0], false), [1.0, 2.0, 8.0, 16.0]);
        assert_eq!(edges(&[0.0, 1.0, 2.0], true), [0.0, 0.5, 1.5, 2.0]);
    }
}
