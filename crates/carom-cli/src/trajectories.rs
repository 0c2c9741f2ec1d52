//! The picture of a run: paths seen along z, with the walls that stand on edge.

use crate::failure::{Failure, of_file};
use carom_report::plot::Legend;
use carom_report::{Axis, Color, Plot, Series};
use carom_track::About;
use carom_track::about::AboutPlane;
use std::path::Path;

/// One particle's path.
struct Line {
    particle: u64,
    x: Vec<f64>,
    y: Vec<f64>,
}

/// The picture of `trajectories.csv` in the folder, if the run recorded any.
pub fn picture(about: &About, folder: &Path) -> Result<Option<Plot>, Failure> {
    let table = folder.join("trajectories.csv");
    if !table.exists() {
        return Ok(None);
    }
    let lines = read(&table)?;
    Ok(extent(&lines).map(|(low, high)| plot(about, &lines, low, high)))
}

fn read(table: &Path) -> Result<Vec<Line>, Failure> {
    let name = table.display().to_string();
    let bad = |e: csv::Error| Failure::Other(format!("{name}: {e}"));
    let file = std::fs::File::open(table).map_err(|e| of_file(&name, &e))?;
    let mut lines: Vec<Line> = Vec::new();
    for row in csv::Reader::from_reader(file).into_deserialize() {
        let (particle, _time, x, y): (u64, f64, f64, f64) = first_four(row.map_err(bad)?);
        match lines.last_mut() {
            Some(line) if line.particle == particle => {
                line.x.push(x);
                line.y.push(y);
            }
            _ => lines.push(Line { particle, x: vec![x], y: vec![y] }),
        }
    }
    Ok(lines)
}

/// A row of the table: particle, time, position, velocity, spin.
type Row = (u64, f64, f64, f64, f64, f64, f64, f64, f64, f64, f64);

fn first_four(row: Row) -> (u64, f64, f64, f64) {
    (row.0, row.1, row.2, row.3)
}

/// Corners of the paths.
fn extent(lines: &[Line]) -> Option<([f64; 2], [f64; 2])> {
    let ends = |get: fn(&Line) -> &[f64]| {
        let all = lines.iter().flat_map(|l| get(l).iter().copied());
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
    };
    let (x, y) = (ends(|l| &l.x), ends(|l| &l.y));
    (x.0 <= x.1 && y.0 <= y.1).then_some(([x.0, y.0], [x.1, y.1]))
}

fn plot(about: &About, lines: &[Line], low: [f64; 2], high: [f64; 2]) -> Plot {
    let (low, high) = with_walls(about, low, high);
    let [width, height] = [high[0] - low[0], high[1] - low[1]];
    let axis = |label: &str, span: f64| {
        let (unit, factor) = match span {
            s if s < 1e-3 => ("µm", 1e6),
            s if s < 1.0 => ("mm", 1e3),
            _ => ("m", 1.0),
        };
        Axis::scaled(label, unit, factor)
    };
    let mut plot = Plot::new(&about.title, axis("x", width), axis("y", height));
    let mut named = Vec::new();
    for line in lines {
        let injection = about.injection(line.particle).unwrap_or(0);
        let label = match about.injections.get(injection) {
            Some(injected) if !named.contains(&injection) => injected.name.clone(),
            _ => String::new(),
        };
        named.push(injection);
        plot = plot
            .with(Series::line(label, line.x.iter().copied(), line.y.iter().copied()).color(Color::cycle(injection)));
    }
    for plane in &about.planes {
        if let Some([from, to]) = edge(plane, low, high) {
            plot = plot.wall(from, to);
        }
    }
    if width < 8.0 * height && height < 8.0 * width {
        plot = plot.equal_aspect();
    }
    plot.legend(Legend::Outside)
}

/// The corners with the walls beside the paths that lie nearly across an axis, and never a span of zero.
fn with_walls(about: &About, mut low: [f64; 2], mut high: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let spans = [high[0] - low[0], high[1] - low[1]];
    for plane in &about.planes {
        for axis in 0..2 {
            let (at, near) = (plane.point[axis], 0.5 * spans[axis]);
            if plane.normal[axis].abs() > 0.999 && at > low[axis] - near && at < high[axis] + near {
                low[axis] = low[axis].min(at);
                high[axis] = high[axis].max(at);
            }
        }
    }
    for axis in 0..2 {
        if high[axis] <= low[axis] {
            let margin = 0.5 * spans[1 - axis].max(1e-6);
            low[axis] -= margin;
            high[axis] += margin;
        }
    }
    (low, high)
}

/// The part of a plane's trace within the corners; none for a plane that does not stand on edge.
fn edge(plane: &AboutPlane, low: [f64; 2], high: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let [nx, ny, nz] = plane.normal;
    if nz.abs() > 1e-9 {
        return None;
    }
    let along = [-ny, nx];
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..2 {
        // a hair of slack: a wall on the very edge is within
        let slack = 1e-9 * (high[axis] - low[axis]);
        let [a, b] = [low[axis] - slack - plane.point[axis], high[axis] + slack - plane.point[axis]];
        if along[axis].abs() < 1e-12 {
            if a > 0.0 || b < 0.0 {
                return None;
            }
            continue;
        }
        let [s, t] = [a / along[axis], b / along[axis]];
        from = from.max(s.min(t));
        to = to.min(s.max(t));
    }
    let at = |s: f64| [plane.point[0] + s * along[0], plane.point[1] + s * along[1]];
    (from < to && from.is_finite() && to.is_finite()).then(|| [at(from), at(to)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_is_cut_to_the_picture() {
        let name = String::new();
        let floor = AboutPlane { name, point: [5.0, 0.0, 0.0], normal: [0.0, 1.0, 0.0] };
        let mut ends = edge(&floor, [0.0, 0.0], [1.0, 2.0]).expect("it stands on edge");
        ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert!(ends[0][0].abs() < 1e-8 && (ends[1][0] - 1.0).abs() < 1e-8 && ends[0][1] == 0.0);
        let far = AboutPlane { point: [0.0, -3.0, 0.0], ..floor.clone() };
        assert_eq!(edge(&far, [0.0, 0.0], [1.0, 2.0]), None);
        let facing = AboutPlane { point: [0.0; 3], normal: [0.0, 0.0, 1.0], ..floor };
        assert_eq!(edge(&facing, [0.0, 0.0], [1.0, 2.0]), None);
    }
}
