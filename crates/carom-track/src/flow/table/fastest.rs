//! How fast a table's flow can be within a box.

use super::Table;
use crate::vector::{Vec3, norm};

impl Table {
    /// Between nodes the velocity is a mean of theirs, so none is faster than the fastest of them.
    pub(in crate::flow) fn fastest(&self, [low, high]: [Vec3; 2]) -> f64 {
        let range = [0, 1, 2].map(|c: usize| {
            let at = &self.axes[c].at;
            let first = at.partition_point(|a| *a <= low[c]).saturating_sub(1);
            let last = at.partition_point(|a| *a < high[c]).min(at.len() - 1);
            first..=last.max(first)
        });
        let mut most = 0.0f64;
        for i in range[0].clone() {
            for j in range[1].clone() {
                for k in range[2].clone() {
                    let node = self.node(i, j, k);
                    most = most.max(norm([node[0], node[1], node[2]]));
                }
            }
        }
        most
    }
}
