//! The picture of a run: paths seen along z, how they end, and the walls.

mod ends;
mod walls;

use crate::failure::{Failure, of_file};
use carom_report::plot::{Legend, Marker};
use carom_report::{Axis, Color, Plot, RowReader, Series};
use carom_track::About;
use carom_track::record::ParticleFate;
use std::borrow::Cow;
use std::path::Path;
use std::str::FromStr;

/// One particle's path.
#[derive(Debug)]
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
    let ends = ends::of(folder, &lines)?;
    let mut plot = plot(about, &lines, &ends, low, high);
    if recorded <= DRAWN {
        let whose = if about.injections.len() > 1 { " of each injection" } else { "" };
        return Ok(Some((plot, format!("Paths of the first particles{whose}, seen along z."))));
    }
    let few = format!("{DRAWN} of {recorded} recorded paths");
    plot.title = if plot.title.is_empty() { few.clone() } else { format!("{}: {few}", plot.title) };
    let rest = "seen along z. trajectories.csv and trajectories.vtp have them all.";
    Ok(Some((plot, format!("{few}, chosen evenly by particle number, {rest}"))))
}

/// Whether the path with that place among the recorded ones is drawn: all are while they are few, else ones evenly spaced.
fn drawn(place: u64, recorded: u64) -> bool {
    let step = |n: u64| u128::from(n) * u128::from(DRAWN) / u128::from(recorded.max(1));
    recorded <= DRAWN || place == 0 || step(place) != step(place - 1)
}

fn read(table: &Path, recorded: u64) -> Result<Vec<Line>, Failure> {
    let name = table.display().to_string();
    let mut rows = RowReader::new(std::fs::File::open(table).map_err(|e| of_file(&name, &e))?);
    let mut lines: Vec<Line> = Vec::new();
    // the header
    rows.next_row().map_err(|e| of_file(&name, &e))?;
    let (mut before, mut place) = (None, 0);
    while let Some(row) = rows.next_row().map_err(|e| of_file(&name, &e))? {
        let mut fields = row.fields();
        let particle: Option<u64> = number(fields.next());
        if before.is_some() && before != particle {
            place += 1;
        }
        before = particle;
        if particle.is_some() && !drawn(place, recorded) {
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

fn plot(about: &About, lines: &[Line], ends: &[(ParticleFate, [f64; 2])], low: [f64; 2], high: [f64; 2]) -> Plot {
    let (low, high) = walls::with_walls(about, low, high);
    let spans = [0, 1].map(|axis| high[axis] - low[axis]);
    // one unit for both: they are compared by eye
    let (unit, factor) = match spans[0].max(spans[1]) {
        s if s < 1e-3 => ("µm", 1e6),
        s if s < 1.0 => ("mm", 1e3),
        _ => ("m", 1.0),
    };
    let axis = |n: usize, label: &str| {
        let air = 0.04 * spans[n];
        Axis::scaled(label, unit, factor).range(low[n] - air, high[n] + air)
    };
    let mut plot = Plot::new(&about.title, axis(0, "x"), axis(1, "y"));
    let mut named = Vec::new();
    for line in lines {
        let injection = about.injection(line.particle).unwrap_or(0);
        let label = match about.injections.get(injection) {
            Some(injected) if !named.contains(&injection) => injected.name.clone(),
            _ => String::new(),
        };
        named.push(injection);
        let path = Series::line(label, line.x.iter().copied(), line.y.iter().copied()).color(Color::cycle(injection));
        plot = plot.with(if lines.len() > FEW { path.thin() } else { path });
    }
    for fate in ParticleFate::ALL {
        let here = || ends.iter().filter(move |(f, _)| *f == fate).map(|(_, at)| *at);
        if here().next().is_some() {
            let (marker, color) = mark(fate);
            let points = Series::points(fate.name(), here().map(|p| p[0]), here().map(|p| p[1]));
            plot = plot.with(points.marker(marker).color(color));
        }
    }
    for [from, to] in walls::lines(about, low, high) {
        plot = plot.wall(from, to);
    }
    if spans[0] < 8.0 * spans[1] && spans[1] < 8.0 * spans[0] {
        plot = plot.equal_aspect();
    }
    plot.legend(Legend::Outside)
}

/// Paths up to so many are drawn as lines of full width.
const FEW: usize = 8;

/// The mark where a path ends.
fn mark(fate: ParticleFate) -> (Marker, Color) {
    match fate {
        ParticleFate::Captured => (Marker::Circle, Color::BLACK),
        ParticleFate::Settled => (Marker::Circle, Color::GREY),
        ParticleFate::Trapped => (Marker::Square, Color::BLACK),
        ParticleFate::Escaped => (Marker::Triangle, Color::BLACK),
        ParticleFate::Airborne => (Marker::Cross, Color::GREY),
        _ => (Marker::Cross, Color::BLACK),
    }
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
}
