//! The picture of a run: paths seen along z, with the walls that stand on edge.

use crate::failure::{Failure, of_file};
use carom_report::plot::Legend;
use carom_report::{Axis, Color, Plot, RowReader, Series};
use carom_track::About;
use carom_track::about::AboutPlane;
use std::borrow::Cow;
use std::path::Path;
use std::str::FromStr;

/// One particle's path.
struct Line {
    particle: u64,
    x: Vec<f64>,
    y: Vec<f64>,
    /// The last point, wherever it is; one point in so many is kept, and how many have come.
    last: [f64; 2],
    one_in: usize,
    seen: usize,
}

impl Line {
    fn new(particle: u64) -> Self {
        Self { particle, x: Vec::new(), y: Vec::new(), last: [f64::NAN; 2], one_in: 1, seen: 0 }
    }

    fn push(&mut self, x: f64, y: f64) {
        self.last = [x, y];
        if self.seen.is_multiple_of(self.one_in) {
            if self.x.len() == POINTS {
                for values in [&mut self.x, &mut self.y] {
                    let mut place = 0;
                    values.retain(|_| {
                        place += 1;
                        place % 2 == 1
                    });
                }
                self.one_in *= 2;
            }
            if self.seen.is_multiple_of(self.one_in) {
                self.x.push(x);
                self.y.push(y);
            }
        }
        self.seen += 1;
    }

    /// A thinned path ends where it ended.
    fn end(&mut self) {
        if self.one_in > 1 {
            self.x.push(self.last[0]);
            self.y.push(self.last[1]);
        }
    }
}

/// Paths drawn: as many lines as a picture bears.
const DRAWN: u64 = 100;
/// Points kept of a path; a longer one is thinned out evenly.
const POINTS: usize = 10_000;

/// The picture of `trajectories.csv` in the folder, and what it shows; `None` if the run recorded no path.
pub fn picture(about: &About, folder: &Path) -> Result<Option<(Plot, String)>, Failure> {
    let table = folder.join("trajectories.csv");
    if !table.exists() {
        return Ok(None);
    }
    let recorded = about.trajectories;
    let lines = read(&table, recorded)?;
    let Some((low, high)) = extent(&lines) else { return Ok(None) };
    let mut plot = plot(about, &lines, low, high);
    if recorded <= DRAWN {
        return Ok(Some((plot, "Paths of the first particles, seen along z.".to_owned())));
    }
    let few = format!("{DRAWN} of {recorded} recorded paths");
    plot.title = if plot.title.is_empty() { few.clone() } else { format!("{}: {few}", plot.title) };
    let rest = "seen along z. trajectories.csv and trajectories.vtp have them all.";
    Ok(Some((plot, format!("{few}, chosen evenly by particle number, {rest}"))))
}

/// Whether a particle's path is drawn: all are while they are few, else ones evenly spaced.
fn drawn(particle: u64, recorded: u64) -> bool {
    let step = |n: u64| u128::from(n) * u128::from(DRAWN) / u128::from(recorded.max(1));
    recorded <= DRAWN || particle == 0 || step(particle) != step(particle - 1)
}

fn read(table: &Path, recorded: u64) -> Result<Vec<Line>, Failure> {
    let name = table.display().to_string();
    let mut rows = RowReader::new(std::fs::File::open(table).map_err(|e| of_file(&name, &e))?);
    let mut lines: Vec<Line> = Vec::new();
    // the header
    rows.next_row().map_err(|e| of_file(&name, &e))?;
    while let Some(row) = rows.next_row().map_err(|e| of_file(&name, &e))? {
        let mut fields = row.fields();
        let particle = number(fields.next());
        if particle.is_some_and(|p| !drawn(p, recorded)) {
            continue;
        }
        let point = (particle, number(fields.nth(1)), number(fields.next()));
        drop(fields);
        let (Some(particle), Some(x), Some(y)) = point else {
            return Err(Failure::Other(format!("{name}: line {} is no point of a path", rows.line())));
        };
        if lines.last().is_none_or(|line| line.particle != particle) {
            lines.push(Line::new(particle));
        }
        if let Some(line) = lines.last_mut() {
            line.push(x, y);
        }
    }
    lines.iter_mut().for_each(Line::end);
    Ok(lines)
}

fn number<T: FromStr>(field: Option<Cow<[u8]>>) -> Option<T> {
    std::str::from_utf8(&field?).ok()?.parse().ok()
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
    // one unit for both axes
    let (unit, factor) = match width.max(height) {
        s if s < 1e-3 => ("µm", 1e6),
        s if s < 1.0 => ("mm", 1e3),
        _ => ("m", 1.0),
    };
    let mut plot = Plot::new(&about.title, Axis::scaled("x", unit, factor), Axis::scaled("y", unit, factor));
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
    fn many_paths_are_thinned_out_evenly_and_long_ones_too() {
        for recorded in [1, 100, 101, 150, 777, 123_457] {
            let shown: Vec<u64> = (0..recorded).filter(|n| drawn(*n, recorded)).collect();
            assert_eq!(shown.len() as u64, recorded.min(DRAWN));
            let gaps = shown.windows(2).map(|w| w[1] - w[0]);
            assert!(gaps.clone().max().unwrap_or(0) - gaps.min().unwrap_or(0) <= 1, "{recorded}");
        }
        let mut line = Line::new(0);
        (0..1_000_003).for_each(|i| line.push(f64::from(i), -f64::from(i)));
        line.end();
        assert!(line.x.len() <= POINTS + 1 && line.x.len() > POINTS / 2);
        assert_eq!([line.x[0], line.x[1], line.x[2]], [0.0, 128.0, 256.0]);
        assert_eq!(line.y.last(), Some(&-1_000_002.0));
    }

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
