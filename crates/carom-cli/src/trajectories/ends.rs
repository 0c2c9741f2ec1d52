//! How the drawn paths ended.

use super::Line;
use crate::failure::Failure;
use carom_report::{Field, TableReader, Values};
use carom_track::TableFormat;
use carom_track::record::ParticleFate;
use std::collections::HashMap;
use std::path::Path;

/// Fate and last place of each path, as far as the run recorded fates.
pub fn of(folder: &Path, lines: &[Line]) -> Result<Vec<(ParticleFate, [f64; 2])>, Failure> {
    let formats = [TableFormat::Csv, TableFormat::Parquet];
    let mut paths = formats.map(|format| folder.join(format!("fates.{}", format.extension()))).into_iter();
    let Some(path) = paths.find(|path| path.exists()) else { return Ok(Vec::new()) };
    let mut places: HashMap<u64, [f64; 2]> = lines.iter().map(|line| (line.particle, line.last)).collect();
    let mut ends = Vec::with_capacity(places.len());
    let mut reader = TableReader::open(path, vec![Field::count("particle"), Field::text("fate")])?;
    while let Some(batch) = reader.next_batch()? {
        let [particles, fates] = batch.columns() else { continue };
        let (Values::Count(particles), Values::Text(fates)) = (&particles.values, &fates.values) else { continue };
        for (particle, fate) in particles.iter().zip(fates) {
            let (Some(particle), Some(name)) = (particle, fate) else { continue };
            let Some(fate) = ParticleFate::ALL.into_iter().find(|f| f.name() == &**name) else { continue };
            ends.extend(places.remove(particle).map(|at| (fate, at)));
        }
        if places.is_empty() {
            break;
        }
    }
    Ok(ends)
}
