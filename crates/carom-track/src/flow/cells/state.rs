//! The state of the gas at the nodes, where a result gives its temperature.

use super::Cells;
use super::tetrahedron::Tetrahedron;
use crate::flow::LocalGas;
use crate::vector::Vec3;

/// T, K, and ρ, kg/m³, of each node; ρ is 0 where it is not given.
#[derive(Debug)]
pub(super) struct States {
    nodes: Vec<[f64; 2]>,
    dense: bool,
    /// Lowest and highest of both.
    range: [[f64; 2]; 2],
}

impl States {
    pub fn new(temperature: &[[f64; 1]], density: Option<&[[f64; 1]]>) -> Self {
        let at = |i: usize| density.map_or(0.0, |d| d[i][0]);
        let nodes: Vec<[f64; 2]> = temperature.iter().enumerate().map(|(i, t)| [t[0], at(i)]).collect();
        let range = [0, 1].map(|q: usize| {
            let all = || nodes.iter().map(|n| n[q]);
            [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
        });
        Self { nodes, dense: density.is_some(), range }
    }

    #[inline(always)]
    pub fn at(&self, cells: &Cells, here: &Tetrahedron, x: Vec3) -> LocalGas {
        let [temperature, density] = cells.blend(here, x, &self.nodes);
        // beyond a tetrahedron, where a step that is then cut may look, its formula may lead below all there is
        let [least, light] = self.range.map(|[low, _]| 0.5 * low);
        LocalGas {
            temperature: temperature.max(least),
            density: self.dense.then_some(density.max(light)),
            temperature_gradient: cells.slope(here, |node| self.nodes[node][0]),
        }
    }
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
        let (corners, centre) = self.corners(here.id);
        let base = of(centre);
        let changes = corners.map(|c| of(c) - base);
        [0, 1, 2].map(|j| (0..3).map(|n| changes[n] * here.dual[n][j]).sum())
    }
}
