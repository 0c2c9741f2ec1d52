//! Deposition by wall, region and size bin.
//!
//! Counts and exact masses, so that parts of a run add up to the whole; fractions of what was injected in each size bin,
//! with 95 % confidence intervals after Wilson (1927, J. Am. Stat. Assoc. 22, 209–212, doi:10.2307/2276774).

mod faces;
mod regions;

pub(crate) use faces::Brought;
pub use faces::{FaceTally, Faces};
pub(crate) use regions::Sorter;

use crate::record::{End, ParticleFate};
use crate::summary::Amount;
use crate::vector::Vec3;
use std::collections::BTreeMap;

/// A named box; a particle counts in the first that holds its place.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Region {
    /// Its name in results.
    pub name: String,
    /// Lower corner, m.
    pub min: Vec3,
    /// Upper corner, m.
    pub max: Vec3,
}

impl Region {
    pub(crate) fn holds(&self, x: Vec3) -> bool {
        (0..3).all(|c| x[c] >= self.min[c] && x[c] <= self.max[c])
    }
}

/// How deposits are sorted.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Bins {
    /// Edges of the size bins, m, rising; below the first and above the last are bins too.
    pub sizes: Vec<f64>,
    /// Whether the faces of walls made of triangles count what they keep by size bin too.
    #[serde(default)]
    pub by_face: bool,
    /// Regions; whatever lies in none is counted under an empty name.
    pub regions: Vec<Region>,
}

impl Bins {
    /// The bounds of a size bin, m.
    fn bounds(&self, bin: usize) -> (f64, f64) {
        let edge = |i: usize| self.sizes.get(i).copied();
        (bin.checked_sub(1).and_then(edge).unwrap_or(0.0), edge(bin).unwrap_or(f64::INFINITY))
    }
}

/// Where a deposit is counted: indices of its wall, its region (one more than there are for none) and its size bin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
pub struct Cell {
    /// Of the wall.
    pub wall: u32,
    /// Of the region.
    pub region: u32,
    /// Of the size bin.
    pub size: u32,
}

/// Counts by size bin, and by wall, region and size bin; only cells that hold something take room.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Deposition {
    /// Injected, by size bin.
    pub injected: Vec<Amount>,
    /// Kept by walls.
    #[serde(with = "pairs")]
    kept: BTreeMap<Cell, Amount>,
}

/// Maps whose keys are no text, as lists of pairs.
pub(crate) mod pairs {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::collections::BTreeMap;

    pub fn serialize<K: Serialize, V: Serialize, S: Serializer>(
        map: &BTreeMap<K, V>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(map)
    }

    pub fn deserialize<'de, K: Deserialize<'de> + Ord, V: Deserialize<'de>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<BTreeMap<K, V>, D::Error> {
        Ok(Vec::<(K, V)>::deserialize(deserializer)?.into_iter().collect())
    }
}

impl Deposition {
    /// Nothing yet.
    pub fn new(bins: &Bins) -> Self {
        Self { injected: vec![Amount::default(); bins.sizes.len() + 1], kept: BTreeMap::new() }
    }

    /// What walls kept, by cell, in their order.
    pub fn kept(&self) -> impl Iterator<Item = (Cell, &Amount)> {
        self.kept.iter().map(|(cell, amount)| (*cell, amount))
    }

    /// Counts how a sphere ended; the cell of its deposit, if it is one, is left to [`Deposition::keep`].
    pub(crate) fn end(&mut self, sorter: &Sorter, end: &End) -> Option<(Cell, f64)> {
        let size = sorter.size(end.particle.diameter);
        let mass = end.particle.mass();
        self.injected[size].add(mass);
        if !matches!(end.fate, ParticleFate::Captured | ParticleFate::Settled | ParticleFate::Trapped) {
            return None;
        }
        let cell = Cell { wall: end.wall? as u32, region: sorter.region(end.position) as u32, size: size as u32 };
        Some((cell, mass))
    }

    /// Adds deposits, in any order.
    pub(crate) fn keep(&mut self, mut deposits: Vec<(Cell, f64)>) {
        deposits.sort_unstable_by_key(|(cell, _)| *cell);
        for run in deposits.chunk_by(|a, b| a.0 == b.0) {
            let amount = self.kept.entry(run[0].0).or_default();
            run.iter().for_each(|(_, mass)| amount.add(*mass));
        }
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        self.injected.iter_mut().zip(&other.injected).for_each(|(a, b)| a.merge(b));
        for (cell, amount) in &other.kept {
            self.kept.entry(*cell).or_default().merge(amount);
        }
    }

    /// Whether it is of so many walls and of these bins.
    pub(crate) fn fits(&self, bins: &Bins, walls: usize) -> bool {
        self.injected.len() == bins.sizes.len() + 1
            && self.kept.keys().all(|c| {
                (c.wall as usize) < walls
                    && c.region as usize <= bins.regions.len()
                    && c.size as usize <= bins.sizes.len()
            })
    }

    /// The text of `deposition.csv`: wall, region, size bin, count, mass, the fraction of the number injected in that size
    /// bin and its 95 % confidence interval, the fraction of the mass. Empty cells are left out.
    ///
    /// # Errors
    /// What the writer says.
    pub fn to_csv(&self, bins: &Bins, walls: &[String]) -> Result<String, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(schema().iter().map(|f| f.name.as_str()))?;
        let none = Amount::default();
        for (w, wall) in walls.iter().enumerate() {
            for r in 0..=bins.regions.len() {
                let region = bins.regions.get(r).map_or("", |r| r.name.as_str());
                for (bin, injected) in self.injected.iter().enumerate() {
                    let cell = Cell { wall: w as u32, region: r as u32, size: bin as u32 };
                    let kept = self.kept.get(&cell).unwrap_or(&none);
                    if kept.count == 0 && (injected.count == 0 || r == bins.regions.len() && r > 0) {
                        continue;
                    }
                    let (from, to) = bins.bounds(bin);
                    let (low, high) = carom::study::wilson(kept.count, injected.count);
                    let fraction = kept.count as f64 / injected.count as f64;
                    let masses = (kept.mass.value(), kept.mass.value() / injected.mass.value());
                    let to = to.is_finite().then_some(to);
                    writer.serialize((
                        wall,
                        region,
                        from,
                        to,
                        injected.count,
                        kept.count,
                        masses.0,
                        [fraction, low, high],
                        masses.1,
                    ))?;
                }
            }
        }
        let bytes = writer.into_inner().map_err(|e| csv::Error::from(e.into_error()))?;
        // a writer of texts and numbers makes UTF-8
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

/// The columns of `deposition.csv`.
pub(crate) fn schema() -> carom_table::Schema {
    use carom_table::Field;
    vec![
        Field::text("wall"),
        Field::text("region"),
        Field::float("diameter_from", "m"),
        Field::float("diameter_to", "m"),
        Field::count("injected"),
        Field::count("kept"),
        Field::float("kept_mass", "kg"),
        Field::float("fraction", ""),
        Field::float("fraction_low", ""),
        Field::float("fraction_high", ""),
        Field::float("mass_fraction", ""),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_and_regions_hold_what_they_say() {
        let region = Region { name: "left".into(), min: [0.0; 3], max: [1.0; 3] };
        let bins = Bins { sizes: vec![1e-5, 2e-5], by_face: false, regions: vec![region] };
        let sorter = Sorter::new(&bins);
        assert_eq!([5e-6, 1e-5, 1.5e-5, 3e-5].map(|d| sorter.size(d)), [0, 1, 1, 2]);
        assert_eq!((bins.bounds(0), bins.bounds(2)), ((0.0, 1e-5), (2e-5, f64::INFINITY)));
        assert_eq!((sorter.region([0.5; 3]), sorter.region([2.0; 3])), (0, 1));
    }
}
