//! Which size bin and which region: asked for every sphere, so answered without going through all regions.

use super::{Bins, Region};
use crate::vector::Vec3;

/// Bins made ready for many questions.
#[derive(Clone, Debug)]
pub(crate) struct Sorter {
    sizes: Vec<f64>,
    regions: Vec<Region>,
    /// Along each axis; empty where there are too many regions for it.
    axes: Vec<Axis>,
}

/// The regions' edges along one axis, and for each edge and each gap between two the regions that reach over it, as bits.
#[derive(Clone, Debug)]
struct Axis {
    edges: Vec<f64>,
    words: usize,
    over: Vec<u64>,
}

/// Regions for which tables of bits stay small.
const MOST: usize = 2048;

impl Axis {
    fn new(regions: &[Region], axis: usize) -> Self {
        let mut edges: Vec<f64> = regions.iter().flat_map(|r| [r.min[axis], r.max[axis]]).collect();
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        let words = regions.len().div_ceil(64);
        let mut over = vec![0; (2 * edges.len() + 1) * words];
        for (i, region) in regions.iter().enumerate() {
            // an edge has an odd slot, a gap an even one; boxes hold their edges
            let slot = |x: f64| 2 * edges.partition_point(|e| *e < x) + 1;
            for s in slot(region.min[axis])..=slot(region.max[axis]) {
                over[s * words + i / 64] |= 1 << (i % 64);
            }
        }
        Self { edges, words, over }
    }

    /// The bits of the regions that reach over a place.
    fn at(&self, x: f64) -> &[u64] {
        let below = self.edges.partition_point(|e| *e < x);
        let slot = 2 * below + usize::from(self.edges.get(below) == Some(&x));
        &self.over[slot * self.words..(slot + 1) * self.words]
    }
}

impl Sorter {
    pub fn new(bins: &Bins) -> Self {
        let regions = bins.regions.clone();
        let few = !regions.is_empty() && regions.len() <= MOST;
        let axes = if few { (0..3).map(|axis| Axis::new(&regions, axis)).collect() } else { Vec::new() };
        Self { sizes: bins.sizes.clone(), regions, axes }
    }

    /// The size bin of a diameter.
    pub fn size(&self, diameter: f64) -> usize {
        self.sizes.partition_point(|edge| *edge <= diameter)
    }

    /// The first region that holds a place; one more than there are where none does.
    pub fn region(&self, x: Vec3) -> usize {
        let none = self.regions.len();
        let [a, b, c] = self.axes.as_slice() else {
            return self.regions.iter().position(|r| r.holds(x)).unwrap_or(none);
        };
        let bits = a.at(x[0]).iter().zip(b.at(x[1])).zip(c.at(x[2])).map(|((a, b), c)| a & b & c);
        let first = bits.enumerate().find(|(_, bits)| *bits != 0);
        first.map_or(none, |(word, bits)| 64 * word + bits.trailing_zeros() as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_region_is_the_first_that_holds_the_place(
            boxes in prop::collection::vec(prop::array::uniform6(0i8..6), 0..150),
            places in prop::collection::vec(prop::array::uniform3(-1i8..14), 1..40),
        ) {
            let regions = boxes.iter().map(|b| {
                let [min, max] = [[b[0], b[1], b[2]], [b[0] + b[3], b[1] + b[4], b[2] + b[5]]];
                Region { name: String::new(), min: min.map(f64::from), max: max.map(f64::from) }
            });
            let bins = Bins { sizes: Vec::new(), by_face: false, regions: regions.collect() };
            let sorter = Sorter::new(&bins);
            for place in places {
                // on edges and between them
                let x = place.map(|c| 0.5 * f64::from(c));
                let first = bins.regions.iter().position(|r| r.holds(x)).unwrap_or(bins.regions.len());
                prop_assert_eq!(sorter.region(x), first);
            }
        }
    }
}
