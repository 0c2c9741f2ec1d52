//! The state of the gas at the nodes, where a result gives its temperature.

use super::Cells;
use super::tetrahedron::Tetrahedron;
use crate::flow::gas_nodes::GasNodes;
use crate::vector::Vec3;

/// The nodes' states from their temperatures and, where there are any, densities.
pub(super) fn nodes(temperature: &[[f64; 1]], density: Option<&[[f64; 1]]>) -> GasNodes {
    let at = |i: usize| density.map_or(0.0, |d| d[i][0]);
    GasNodes::new(temperature.iter().enumerate().map(|(i, t)| [t[0], at(i)]).collect(), density.is_some())
}

impl Cells {
    /// Whether it gives the gas's temperature.
    pub fn has_gas(&self) -> bool {
        self.state.is_some()
    }

    /// Lowest and highest temperature of its nodes, K, if it gives any.
    pub fn temperatures(&self) -> Option<[f64; 2]> {
        self.state.as_ref().map(|s| s.range[0])
    }

    /// Gradient of a quantity of the nodes in a tetrahedron.
    #[inline(always)]
    pub(super) fn slope(&self, here: &Tetrahedron, of: impl Fn(usize) -> f64) -> Vec3 {
        let (corners, centre) = self.corners(here.id, here.cell);
        let base = of(centre);
        let changes = corners.map(|c| of(c) - base);
        [0, 1, 2].map(|j| (0..3).map(|n| changes[n] * here.dual[n][j]).sum())
    }
}
