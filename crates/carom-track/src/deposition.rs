//! Deposition by wall, region and size bin.
//!
//! Counts and exact masses, so that parts of a run add up to the whole; fractions of what was injected in each size bin,
//! with 95 % confidence intervals after Wilson (1927, J. Am. Stat. Assoc. 22, 209–212, doi:10.2307/2276774).

use crate::record::{End, Fate};
use crate::summary::Amount;
use crate::vector::Vec3;

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
    fn holds(&self, x: Vec3) -> bool {
        (0..3).all(|c| x[c] >= self.min[c] && x[c] <= self.max[c])
    }
}

/// How deposits are sorted.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Bins {
    /// Edges of the size bins, m, rising; below the first and above the last are bins too.
    pub sizes: Vec<f64>,
    /// Regions; whatever lies in none is counted under an empty name.
    pub regions: Vec<Region>,
}

impl Bins {
    fn size(&self, diameter: f64) -> usize {
        self.sizes.partition_point(|edge| *edge <= diameter)
    }

    fn region(&self, x: Vec3) -> usize {
        self.regions.iter().position(|r| r.holds(x)).unwrap_or(self.regions.len())
    }

    /// The bounds of a size bin, m.
    pub fn bounds(&self, bin: usize) -> (f64, f64) {
        let edge = |i: usize| self.sizes.get(i).copied();
        (bin.checked_sub(1).and_then(edge).unwrap_or(0.0), edge(bin).unwrap_or(f64::INFINITY))
    }
}

/// Counts by size bin, and by wall, region and size bin.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Deposition {
    /// Injected, by size bin.
    pub injected: Vec<Amount>,
    /// Kept by a wall: `[wall][region][size]`.
    pub kept: Vec<Vec<Vec<Amount>>>,
}

impl Deposition {
    /// Nothing yet.
    pub fn new(bins: &Bins, walls: usize) -> Self {
        let sizes = vec![Amount::default(); bins.sizes.len() + 1];
        Self { kept: vec![vec![sizes.clone(); bins.regions.len() + 1]; walls], injected: sizes }
    }

    pub(crate) fn add(&mut self, bins: &Bins, end: &End) {
        let size = bins.size(end.particle.diameter);
        let mass = end.particle.mass();
        if let Some(injected) = self.injected.get_mut(size) {
            injected.add(mass);
        }
        if !matches!(end.fate, Fate::Captured | Fate::Settled | Fate::Trapped) {
            return;
        }
        let cell = end
            .wall
            .and_then(|w| self.kept.get_mut(w))
            .and_then(|w| w.get_mut(bins.region(end.position)))
            .and_then(|r| r.get_mut(size));
        if let Some(cell) = cell {
            cell.add(mass);
        }
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        let merge = |a: &mut [Amount], b: &[Amount]| a.iter_mut().zip(b).for_each(|(a, b)| a.merge(b));
        merge(&mut self.injected, &other.injected);
        for (a, b) in self.kept.iter_mut().zip(&other.kept) {
            for (a, b) in a.iter_mut().zip(b) {
                merge(a, b);
            }
        }
    }

    /// The text of `deposition.csv`: wall, region, size bin, count, mass, the fraction of the number injected in that size
    /// bin and its 95 % confidence interval, the fraction of the mass. Empty cells are left out.
    pub fn to_csv(&self, bins: &Bins, walls: &[String]) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header = [
            "wall",
            "region",
            "diameter_from",
            "diameter_to",
            "injected",
            "kept",
            "kept_mass",
            "fraction",
            "fraction_low",
            "fraction_high",
            "mass_fraction",
        ];
        // a vector in memory takes every row
        let _ = writer.write_record(header);
        for (wall, regions) in walls.iter().zip(&self.kept) {
            for (r, sizes) in regions.iter().enumerate() {
                let region = bins.regions.get(r).map_or("", |r| r.name.as_str());
                for (bin, (kept, injected)) in sizes.iter().zip(&self.injected).enumerate() {
                    if kept.count == 0 && (injected.count == 0 || r == bins.regions.len() && r > 0) {
                        continue;
                    }
                    let (from, to) = bins.bounds(bin);
                    let (low, high) = wilson(kept.count, injected.count);
                    let fraction = kept.count as f64 / injected.count as f64;
                    let masses = (kept.mass.value(), kept.mass.value() / injected.mass.value());
                    let to = to.is_finite().then_some(to);
                    let _ = writer.serialize((
                        wall,
                        region,
                        from,
                        to,
                        injected.count,
                        kept.count,
                        masses.0,
                        [fraction, low, high],
                        masses.1,
                    ));
                }
            }
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}

/// Wilson's 95 % interval of a share of `n`.
pub fn wilson(hits: u64, n: u64) -> (f64, f64) {
    const Z: f64 = 1.959_963_984_540_054;
    if n == 0 {
        return (0.0, 1.0);
    }
    let (n, p) = (n as f64, hits as f64 / n as f64);
    let z2 = Z * Z / n;
    let centre = p + 0.5 * z2;
    let reach = Z * (p * (1.0 - p) / n + 0.25 * z2 / n).sqrt();
    (((centre - reach) / (1.0 + z2)).max(0.0), ((centre + reach) / (1.0 + z2)).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilsons_interval_is_as_published() {
        // Newcombe 1998, Stat. Med. 17, 857-872, table I, method 3: 81/263 and 0/20
        let (low, high) = wilson(81, 263);
        assert!((low - 0.2553).abs() < 5e-5 && (high - 0.3662).abs() < 5e-5, "{low} {high}");
        let (low, high) = wilson(0, 20);
        assert!(low == 0.0 && (high - 0.1611).abs() < 5e-5, "{high}");
    }

    #[test]
    fn bins_and_regions_hold_what_they_say() {
        let region = Region { name: "left".into(), min: [0.0; 3], max: [1.0; 3] };
        let bins = Bins { sizes: vec![1e-5, 2e-5], regions: vec![region] };
        assert_eq!([5e-6, 1e-5, 1.5e-5, 3e-5].map(|d| bins.size(d)), [0, 1, 1, 2]);
        assert_eq!((bins.bounds(0), bins.bounds(2)), ((0.0, 1e-5), (2e-5, f64::INFINITY)));
        assert_eq!((bins.region([0.5; 3]), bins.region([2.0; 3])), (0, 1));
    }
}
