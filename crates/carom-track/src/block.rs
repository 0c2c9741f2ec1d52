//! A block of particle numbers, tracked to the end: its rows in order, and its part of the summary.

use crate::case::Case;
use crate::record::{End, ImpactRecord, Sink};
use crate::summary::Summary;
use crate::tables::{FATES, IMPACTS, LAYOUTS, TRAJECTORIES};
use crate::tracker::Particle;
use crate::vector::Vec3;
use serde::Serialize;
use std::ops::Range;

/// Particles in a block. Results do not depend on it; memory and the grain of a checkpoint do.
pub const SIZE: u64 = 1024;

/// A finished block.
#[derive(Debug)]
pub(crate) struct Block {
    pub summary: Summary,
    /// Rows of each table, as CSV.
    pub rows: [Vec<u8>; LAYOUTS.len()],
}

/// A row of `impacts.csv`, columns in groups.
#[derive(Serialize)]
struct ImpactRow<'a> {
    particle: u64,
    time_and_place: [f64; 4],
    wall: &'a str,
    incoming: [f64; 4],
    restitution: Option<f64>,
    impulse_ratio: Option<f64>,
    fate: &'static str,
    outgoing: [f64; 3],
    weight: f64,
    normal: [f64; 3],
    energy: [f64; 8],
}

/// A row of `fates.csv`, columns in groups.
#[derive(Serialize)]
struct FateRow<'a> {
    particle: u64,
    words: [&'a str; 3],
    time_and_place: [f64; 4],
    size: [f64; 3],
    impacts: u64,
}

/// One point of a recorded path.
type Point = (u64, [f64; 10]);

struct Collector<'a> {
    case: &'a Case,
    summary: Summary,
    impacts: Vec<ImpactRecord>,
    ends: Vec<End>,
    points: Vec<Point>,
    /// The first particle's number, and how many impacts each has had.
    first: u64,
    hits: Vec<u64>,
    wanted: Wanted,
}

/// Which tables' rows are wanted.
pub(crate) type Wanted = [bool; LAYOUTS.len()];

impl Collector<'_> {
    fn hits(&mut self, particle: u64) -> Option<&mut u64> {
        self.hits.get_mut(usize::try_from(particle.checked_sub(self.first)?).ok()?)
    }
}

impl Sink for Collector<'_> {
    fn start(&mut self, particle: &Particle) -> bool {
        self.summary.start(particle.mass());
        self.wanted[TRAJECTORIES] && particle.number < self.case.trajectories
    }

    fn impact(&mut self, impact: &ImpactRecord) {
        self.summary.impact(impact);
        if let Some(hits) = self.hits(impact.particle) {
            *hits += 1;
        }
        if self.wanted[IMPACTS] {
            self.impacts.push(*impact);
        }
    }

    fn point(&mut self, particle: u64, t: f64, x: Vec3, v: Vec3, w: Vec3) {
        self.points.push((particle, [t, x[0], x[1], x[2], v[0], v[1], v[2], w[0], w[1], w[2]]));
    }

    fn end(&mut self, end: &End) {
        self.summary.end(end, &self.case.bins);
        if self.wanted[FATES] {
            self.ends.push(*end);
        }
    }

    fn stalled(&mut self) {
        self.summary.stalled += 1;
    }
}

/// Tracks the particles of a range of numbers.
pub(crate) fn track(case: &Case, numbers: Range<u64>, wanted: Wanted) -> Block {
    let mut collector = Collector {
        case,
        summary: empty(case),
        impacts: Vec::new(),
        ends: Vec::new(),
        points: Vec::new(),
        first: numbers.start,
        hits: vec![0; numbers.clone().count()],
        wanted,
    };
    case.tracker().run(&mut numbers.filter_map(|n| case.particle(n)), &mut collector);
    let Collector { summary, mut impacts, mut ends, mut points, hits, first, .. } = collector;
    // events of one particle are in order already: a stable sort keeps them so
    impacts.sort_by_key(|i| i.particle);
    points.sort_by_key(|p| p.0);
    ends.sort_by_key(|e| e.particle.number);
    let walls: Vec<&str> = case.domain.walls().iter().map(|w| w.name.as_str()).collect();
    let wall = |w: usize| walls.get(w).copied().unwrap_or_default();
    let hits = |particle: u64| hits.get((particle - first) as usize).copied().unwrap_or_default();
    let mut tables = Wanted::default().map(|_| Vec::new());
    tables[IMPACTS] = rows(impacts.iter().map(|i| impact_row(i, wall(i.wall))));
    tables[FATES] = rows(ends.iter().map(|e| {
        let injection = case.injections.get(e.particle.injection).map_or("", |i| i.name.as_str());
        fate_row(e, injection, e.wall.map_or("", wall), hits(e.particle.number))
    }));
    tables[TRAJECTORIES] = rows(points.iter());
    Block { summary, rows: tables }
}

/// A summary of nothing.
pub(crate) fn empty(case: &Case) -> Summary {
    Summary::new(&case.title, case.domain.walls().iter().map(|w| w.name.clone()), &case.bins)
}

fn rows<R: Serialize>(rows: impl Iterator<Item = R>) -> Vec<u8> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
    for row in rows {
        // a vector in memory takes every row
        let _ = writer.serialize(row);
    }
    writer.into_inner().unwrap_or_default()
}

fn impact_row<'a>(i: &ImpactRecord, wall: &'a str) -> ImpactRow<'a> {
    let known = |v: f64| (!v.is_nan()).then_some(v);
    let [x, y, z] = i.position;
    ImpactRow {
        particle: i.particle,
        time_and_place: [i.time, x, y, z],
        wall,
        incoming: [i.diameter, i.normal_speed_in, i.tangential_speed_in, i.spin_in],
        restitution: known(i.restitution),
        impulse_ratio: known(i.impulse_ratio),
        fate: i.event.name(),
        outgoing: [i.normal_speed_out, i.tangential_speed_out, i.spin_out],
        weight: i.weight,
        normal: i.normal,
        energy: i.energy.named().map(|(_, share)| share),
    }
}

fn fate_row<'a>(e: &End, injection: &'a str, wall: &'a str, impacts: u64) -> FateRow<'a> {
    let (p, [x, y, z]) = (&e.particle, e.position);
    FateRow {
        particle: p.number,
        words: [injection, e.fate.name(), wall],
        time_and_place: [e.time, x, y, z],
        size: [p.diameter, p.weight, p.mass()],
        impacts,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Fate;

    #[test]
    fn headers_and_rows_have_as_many_columns() {
        let names: Vec<String> = LAYOUTS[IMPACTS].schema().into_iter().map(|f| f.name).collect();
        assert_eq!(names.len(), 10 + 10 + 8);
        let energies = carom::Energy::default().named().map(|(name, _)| name);
        assert_eq!(names[20..], energies);
        assert_eq!(LAYOUTS[TRAJECTORIES].schema().len(), 11);
        assert_eq!(LAYOUTS[FATES].header(), "particle,injection,fate,wall,time,x,y,z,diameter,weight,mass,impacts\n");
        assert_eq!(Fate::ALL.map(|f| f as usize), [0, 1, 2, 3, 4, 5]);
    }
}
