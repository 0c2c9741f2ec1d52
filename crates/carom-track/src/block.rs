//! A block of particle numbers, tracked to the end: its rows in order, and its part of the summary.

use crate::case::Case;
use crate::record::{End, ImpactRecord, Sink};
use crate::summary::Summary;
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
    /// Rows of `impacts.csv`.
    pub impacts: Vec<u8>,
    /// Rows of `trajectories.csv`.
    pub trajectories: Vec<u8>,
}

/// The first line of `impacts.csv`.
pub(crate) const IMPACTS_HEADER: &str = "particle,time,x,y,z,wall,diameter,normal_speed_in,tangential_speed_in,spin_in,\
restitution,impulse_ratio,fate,normal_speed_out,tangential_speed_out,spin_out,weight,normal_x,normal_y,normal_z,adhesion,\
adhesion_damping,hertz_damping,plastic,other,friction,captured,kept\n";

/// The first line of `trajectories.csv`.
pub(crate) const TRAJECTORIES_HEADER: &str = "particle,time,x,y,z,vx,vy,vz,spin_x,spin_y,spin_z\n";

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

/// One point of a recorded path.
type Point = (u64, [f64; 10]);

struct Collector<'a> {
    case: &'a Case,
    summary: Summary,
    impacts: Vec<ImpactRecord>,
    points: Vec<Point>,
    wanted: Wanted,
}

/// Which rows are wanted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    pub impacts: bool,
    pub trajectories: bool,
}

impl Sink for Collector<'_> {
    fn start(&mut self, particle: &Particle) -> bool {
        self.summary.start(particle.mass());
        self.wanted.trajectories && particle.number < self.case.trajectories
    }

    fn impact(&mut self, impact: &ImpactRecord) {
        self.summary.impact(impact);
        if self.wanted.impacts {
            self.impacts.push(*impact);
        }
    }

    fn point(&mut self, particle: u64, t: f64, x: Vec3, v: Vec3, w: Vec3) {
        self.points.push((particle, [t, x[0], x[1], x[2], v[0], v[1], v[2], w[0], w[1], w[2]]));
    }

    fn end(&mut self, end: &End) {
        self.summary.end(end, &self.case.bins);
    }

    fn stalled(&mut self) {
        self.summary.stalled += 1;
    }
}

/// Tracks the particles of a range of numbers.
pub(crate) fn track(case: &Case, numbers: Range<u64>, wanted: Wanted) -> Block {
    let mut collector = Collector { case, summary: empty(case), impacts: Vec::new(), points: Vec::new(), wanted };
    case.tracker().run(&mut numbers.filter_map(|n| case.particle(n)), &mut collector);
    let Collector { summary, mut impacts, mut points, .. } = collector;
    // events of one particle are in order already: a stable sort keeps them so
    impacts.sort_by_key(|i| i.particle);
    points.sort_by_key(|p| p.0);
    let walls: Vec<&str> = case.domain.walls().iter().map(|w| w.name.as_str()).collect();
    Block {
        summary,
        impacts: rows(impacts.iter().map(|i| impact_row(i, walls.get(i.wall).copied().unwrap_or_default()))),
        trajectories: rows(points.iter()),
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Fate;

    #[test]
    fn header_and_row_have_as_many_columns() {
        let names: Vec<&str> = IMPACTS_HEADER.trim_end().split(',').collect();
        assert_eq!(names.len(), 10 + 10 + 8);
        let energies = carom::Energy::default().named().map(|(name, _)| name);
        assert_eq!(names[20..], energies);
        assert_eq!(TRAJECTORIES_HEADER.split(',').count(), 11);
        assert_eq!(Fate::ALL.map(|f| f as usize), [0, 1, 2, 3, 4]);
    }
}
