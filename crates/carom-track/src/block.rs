//! A block of particle numbers, tracked to the end: its rows in order, and its part of the summary.

use crate::case::Case;
use crate::record::{End, ImpactRecord, Sink};
use crate::rows::{Rows, quoted};
use crate::summary::Summary;
use crate::tables::{FATES, IMPACTS, LAYOUTS, TRAJECTORIES};
use crate::tracker::Particle;
use crate::vector::Vec3;
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
    let walls: Vec<String> = case.domain.walls().iter().map(|w| quoted(&w.name)).collect();
    let injections: Vec<String> = case.injections.iter().map(|i| quoted(&i.name)).collect();
    fn word(words: &[String], i: usize) -> &str {
        words.get(i).map_or("", String::as_str)
    }
    let mut tables = [Rows::default(), Rows::default(), Rows::default()];
    for i in &impacts {
        impact_row(&mut tables[IMPACTS], i, word(&walls, i.wall));
    }
    for e in &ends {
        let hits = hits.get((e.particle.number - first) as usize).copied().unwrap_or_default();
        let wall = e.wall.map_or("", |w| word(&walls, w));
        fate_row(&mut tables[FATES], e, word(&injections, e.particle.injection), wall, hits);
    }
    for (particle, values) in &points {
        tables[TRAJECTORIES].count(*particle);
        tables[TRAJECTORIES].floats(*values);
        tables[TRAJECTORIES].end();
    }
    Block { summary, rows: tables.map(Rows::into_bytes) }
}

/// A summary of nothing.
pub(crate) fn empty(case: &Case) -> Summary {
    Summary::new(&case.title, case.domain.walls().iter().map(|w| w.name.clone()), &case.bins)
}

fn impact_row(row: &mut Rows, i: &ImpactRecord, wall: &str) {
    row.count(i.particle);
    row.float(i.time);
    row.floats(i.position);
    row.word(wall);
    row.floats([i.diameter, i.normal_speed_in, i.tangential_speed_in, i.spin_in, i.restitution, i.impulse_ratio]);
    row.word(i.event.name());
    row.floats([i.normal_speed_out, i.tangential_speed_out, i.spin_out, i.weight]);
    row.floats(i.normal);
    row.floats(i.energy.named().map(|(_, share)| share));
    row.words(i.validity.codes());
    row.end();
}

fn fate_row(row: &mut Rows, e: &End, injection: &str, wall: &str, impacts: u64) {
    let p = &e.particle;
    row.count(p.number);
    for word in [injection, e.fate.name(), wall] {
        row.word(word);
    }
    row.float(e.time);
    row.floats(e.position);
    row.floats([p.diameter, p.weight, p.mass()]);
    row.count(impacts);
    row.end();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Fate;

    #[test]
    fn headers_and_rows_have_as_many_columns() {
        let names: Vec<String> = LAYOUTS[IMPACTS].schema().into_iter().map(|f| f.name).collect();
        assert_eq!(names.len(), 10 + 10 + 8 + 1);
        let energies = carom::Energy::default().named().map(|(name, _)| name);
        assert_eq!(names[20..28], energies);
        assert_eq!(LAYOUTS[TRAJECTORIES].schema().len(), 11);
        assert_eq!(LAYOUTS[FATES].header(), "particle,injection,fate,wall,time,x,y,z,diameter,weight,mass,impacts\n");
        assert!(Fate::ALL.iter().enumerate().all(|(i, f)| *f as usize == i));
    }
}
