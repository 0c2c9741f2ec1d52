//! What the report shows, gathered in one pass through each table of a finished run; memory does not grow with the tables.
//!
//! Of a long table only a sample of the rows is read, chosen as if by chance: enough for figures, whose bars it moves by less
//! than their outlines are wide, and stated where they stand.

use super::bins::{LinearBins, LogBins};
use crate::failure::Failure;
use carom_report::{Column, Field, TableReader, Values};
use carom_track::{About, Summary, TableFormat};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The mechanisms, as the columns of the impacts are called.
pub const MECHANISMS: [&str; 8] =
    ["adhesion", "adhesion_damping", "hertz_damping", "plastic", "other", "friction", "captured", "kept"];

/// Width of the bins of the angle, degrees.
pub const ANGLE: f64 = 2.0;
/// Width of the bins of restitution; one more than fill 0 to 1, for what is 1 or above.
pub const RESTITUTION: f64 = 0.02;

/// What the impacts on one wall came to. Amounts are of real particles: a parcel counts with its weight.
#[derive(Debug)]
pub struct WallImpacts {
    /// By angle from the surface.
    pub angles: Vec<f64>,
    /// Rebounds by restitution.
    pub restitutions: Vec<f64>,
    /// All of them.
    pub impacts: f64,
    /// Energy of the impacts that a law decided, J: what each mechanism took.
    pub energy: [f64; 8],
}

/// Rows read of a table, about, where it has more: a share p of them is then known to √(p (1 − p)/200 000), 0.1 % at most.
const ROWS: u64 = 200_000;

/// What the impacts came to.
#[derive(Debug)]
pub struct Impacts {
    /// One row in so many was read.
    pub one_in: u64,
    /// How many were.
    pub rows: u64,
    /// By wall.
    pub walls: Vec<WallImpacts>,
    /// By normal speed, grouped by wall.
    pub speeds: LogBins,
}

/// Particles of about one size.
#[derive(Clone, Debug, Default)]
pub struct SizeBin {
    /// Injected.
    pub injected: u64,
    /// Sum of their diameters, m.
    pub diameters: f64,
    /// Kept, by wall.
    pub kept: Vec<u64>,
}

/// How the particles ended.
#[derive(Debug)]
pub struct Ends {
    /// One row in so many was read.
    pub one_in: u64,
    /// How many were.
    pub rows: u64,
    /// Mass kept by each wall along x, y and z.
    pub deposits: Vec<[LinearBins; 3]>,
    /// Of walls made of triangles: where each deposit lies, m, and its mass, kg.
    pub places: BTreeMap<usize, Vec<([f64; 3], f64)>>,
    /// By size, rising: the bins of the case, or bins of equal ratio.
    pub sizes: Vec<SizeBin>,
}

/// Reads the table of impacts; `None` where the run recorded none.
pub fn impacts(folder: &Path, about: &About, summary: &Summary) -> Result<Option<Impacts>, Failure> {
    const NUMBERS: [&str; 6] =
        ["diameter", "normal_speed_in", "tangential_speed_in", "spin_in", "restitution", "weight"];
    let Some(path) = find(folder, "impacts") else { return Ok(None) };
    let mut schema = vec![Field::count("particle"), Field::text("wall"), Field::text("fate")];
    schema.extend(NUMBERS.into_iter().chain(MECHANISMS).map(|name| Field::float(name, "")));
    let one_in = summary.walls.iter().map(|w| w.impacts).sum::<u64>().div_ceil(ROWS);
    let mut reader = TableReader::open(path, schema)?.one_in(one_in);
    let wall = || WallImpacts {
        angles: vec![0.0; (90.0 / ANGLE) as usize],
        restitutions: vec![0.0; (1.0 / RESTITUTION) as usize + 1],
        impacts: 0.0,
        energy: [0.0; 8],
    };
    let walls = summary.walls.len();
    let mut all = Impacts { one_in, rows: 0, walls: (0..walls).map(|_| wall()).collect(), speeds: LogBins::new(walls) };
    let mut names = Names::new(summary);
    while let Some(batch) = reader.next_batch()? {
        let [particle, wall, fate, numbers @ ..] = batch.columns() else { continue };
        let (particles, wall_names, fates) = (counts(particle), texts(wall), texts(fate));
        let columns: Vec<&[f64]> = numbers.iter().map(floats).collect();
        all.rows += batch.rows() as u64;
        for row in 0..batch.rows() {
            let Some(w) = wall_names[row].as_ref().and_then(|name| names.find(name)) else { continue };
            let [d, normal, along, spin, restitution, weight] = [0, 1, 2, 3, 4, 5].map(|c| columns[c][row]);
            let fate = fates[row].as_deref();
            // what leaves through a wall does not hit it
            if fate == Some("escape") || (restitution.is_nan() && ends_contact(fate, normal, along)) {
                continue;
            }
            all.speeds.add(normal, w, weight);
            let wall = &mut all.walls[w];
            wall.impacts += weight;
            put(&mut wall.angles, normal.atan2(along).to_degrees() / ANGLE, weight);
            if fate == Some("rebound") && !restitution.is_nan() {
                // a hair more, so that 0.7 is not left below its edge by the division
                put(&mut wall.restitutions, restitution / RESTITUTION + 1e-9, weight);
            }
            let density =
                particles[row].and_then(|p| about.injection(p)).map_or(f64::NAN, |i| about.injections[i].density);
            let mass = density * std::f64::consts::PI / 6.0 * d.powi(3);
            // a solid sphere: I = 2/5 m r2
            let incident = 0.5 * mass * (normal * normal + along * along + 0.1 * d * d * spin * spin);
            for (m, energy) in wall.energy.iter_mut().enumerate() {
                let share = columns[NUMBERS.len() + m][row];
                *energy += weight * incident * share;
            }
        }
    }
    Ok(Some(all))
}

/// Whether a row without restitution is one where contact motion ends, which is no impact: nothing came towards the wall.
fn ends_contact(fate: Option<&str>, normal: f64, along: f64) -> bool {
    let ends = matches!(fate, Some("settle" | "roll-off" | "slide-off" | "lift-off"));
    ends && normal.abs() <= 1e-9 * along.abs()
}

/// Reads the table of fates; `None` where the run recorded none.
pub fn ends(folder: &Path, about: &About, summary: &Summary) -> Result<Option<Ends>, Failure> {
    let Some(path) = find(folder, "fates") else { return Ok(None) };
    let mut schema = vec![Field::text("fate"), Field::text("wall")];
    schema.extend(["x", "y", "z", "diameter", "mass"].map(|name| Field::float(name, "")));
    let one_in = summary.injected.count.div_ceil(ROWS);
    let mut reader = TableReader::open(path, schema)?.one_in(one_in);
    let mut rows = 0;
    let walls = summary.walls.len();
    let mut deposits: Vec<[LinearBins; 3]> = (0..walls).map(|_| Default::default()).collect();
    let mut places: BTreeMap<usize, Vec<_>> = summary.faces.iter().map(|(wall, ..)| (wall, Vec::new())).collect();
    let mut sizes: BTreeMap<i32, SizeBin> = BTreeMap::new();
    let ratios = LogBins::new(0);
    let mut names = Names::new(summary);
    while let Some(batch) = reader.next_batch()? {
        let [fate, wall, numbers @ ..] = batch.columns() else { continue };
        let (fates, wall_names) = (texts(fate), texts(wall));
        let columns: Vec<&[f64]> = numbers.iter().map(floats).collect();
        rows += batch.rows() as u64;
        for row in 0..batch.rows() {
            let (d, mass) = (columns[3][row], columns[4][row]);
            let bin = match about.size_bins.as_slice() {
                [] => ratios.index(d).unwrap_or(i32::MIN),
                edges => edges.partition_point(|edge| *edge <= d) as i32,
            };
            let bin = sizes.entry(bin).or_insert_with(|| SizeBin { kept: vec![0; walls], ..SizeBin::default() });
            bin.injected += 1;
            bin.diameters += d;
            let kept = matches!(fates[row].as_deref(), Some("captured" | "settled" | "trapped"));
            let wall = wall_names[row].as_ref().filter(|_| kept).and_then(|name| names.find(name));
            let Some(wall) = wall else { continue };
            bin.kept[wall] += 1;
            if let Some(places) = places.get_mut(&wall) {
                places.push(([0, 1, 2].map(|axis| columns[axis][row]), mass));
            }
            deposits[wall].iter_mut().zip(&columns).for_each(|(bins, column)| bins.add(column[row], mass));
        }
    }
    let sizes = if about.size_bins.is_empty() { grouped(sizes) } else { sizes.into_values().collect() };
    Ok(Some(Ends { one_in, rows, deposits, places, sizes }))
}

/// Sizes shown at most.
const SIZES: usize = 24;

/// Bins put together, two and two, until they are few enough to be told apart.
fn grouped(mut bins: BTreeMap<i32, SizeBin>) -> Vec<SizeBin> {
    while bins.len() > SIZES {
        let mut halved: BTreeMap<i32, SizeBin> = BTreeMap::new();
        for (index, bin) in bins {
            halved.entry(index.div_euclid(2)).or_default().join(bin);
        }
        bins = halved;
    }
    filled(bins.into_values())
}

/// Particles in a bin at least: of fewer, the interval about the share kept is wider than what could be read from it.
const FEWEST: u64 = 20;

/// Neighbours put together until each has particles enough, in rising order; the last takes what is left.
fn filled(bins: impl Iterator<Item = SizeBin>) -> Vec<SizeBin> {
    let mut full: Vec<SizeBin> = Vec::new();
    let mut open = SizeBin::default();
    for bin in bins {
        open.join(bin);
        if open.injected >= FEWEST {
            full.push(std::mem::take(&mut open));
        }
    }
    match full.last_mut() {
        Some(last) => last.join(open),
        None if open.injected > 0 => full.push(open),
        None => {}
    }
    full
}

impl SizeBin {
    fn join(&mut self, other: Self) {
        self.injected += other.injected;
        self.diameters += other.diameters;
        self.kept.resize(self.kept.len().max(other.kept.len()), 0);
        self.kept.iter_mut().zip(other.kept).for_each(|(a, b)| *a += b);
    }
}

/// The table of that name, in whichever format the run wrote it.
fn find(folder: &Path, stem: &str) -> Option<PathBuf> {
    [TableFormat::Csv, TableFormat::Parquet]
        .map(|format| folder.join(format!("{stem}.{}", format.extension())))
        .into_iter()
        .find(|path| path.exists())
}

fn put(bins: &mut [f64], place: f64, amount: f64) {
    let last = bins.len().saturating_sub(1);
    if let Some(bin) = bins.get_mut((place as usize).min(last)) {
        *bin += amount;
    }
}

fn floats(column: &Column) -> &[f64] {
    if let Values::Float(v) = &column.values { v } else { &[] }
}

fn counts(column: &Column) -> &[Option<u64>] {
    if let Values::Count(v) = &column.values { v } else { &[] }
}

fn texts(column: &Column) -> &[Option<Arc<str>>] {
    if let Values::Text(v) = &column.values { v } else { &[] }
}

/// Walls by name; the last one found is asked first.
struct Names<'a> {
    summary: &'a Summary,
    last: usize,
}

impl<'a> Names<'a> {
    fn new(summary: &'a Summary) -> Self {
        Self { summary, last: 0 }
    }

    fn find(&mut self, name: &str) -> Option<usize> {
        let walls = &self.summary.walls;
        if walls.get(self.last).is_none_or(|w| w.name != name) {
            self.last = walls.iter().position(|w| w.name == name)?;
        }
        Some(self.last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_a_contact_is_no_impact() {
        assert!(ends_contact(Some("settle"), 0.0, 0.3) && ends_contact(Some("roll-off"), -1e-18, 0.3));
        assert!(ends_contact(Some("lift-off"), 0.0, 0.0));
        assert!(!ends_contact(Some("settle"), 1e-4, 0.3), "it settled by an impact");
        assert!(!ends_contact(Some("capture"), 0.0, 0.3) && !ends_contact(None, 0.0, 0.0));
    }

    #[test]
    fn sparse_sizes_are_put_together() {
        let bin = |injected: u64| SizeBin { injected, diameters: injected as f64, kept: vec![injected / 2] };
        let sizes = filled([1, 3, 30, 50, 19, 1, 2].map(bin).into_iter());
        assert_eq!(sizes.iter().map(|s| s.injected).collect::<Vec<_>>(), [34, 50, 22]);
        assert_eq!((sizes[0].kept[0], sizes[2].kept[0], sizes[2].diameters), (16, 10, 22.0));
        assert_eq!(filled([bin(3)].into_iter()).len(), 1);
        assert!(filled(std::iter::empty()).is_empty());
    }
}
