//! The state of the gas on the nodes of a table or a mesh: temperature, and density where it is given.

use super::LocalGas;
use crate::vector::Vec3;

/// T, K, and ρ, kg/m³, of each node; ρ is 0 where it is not given.
#[derive(Clone, Debug)]
pub(super) struct GasNodes {
    pub nodes: Vec<[f64; 2]>,
    /// Whether the density is given.
    pub dense: bool,
    /// Lowest and highest of both.
    pub range: [[f64; 2]; 2],
}

impl GasNodes {
    pub fn new(nodes: Vec<[f64; 2]>, dense: bool) -> Self {
        let range = [0, 1].map(|q: usize| {
            let all = || nodes.iter().map(|n| n[q]);
            [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
        });
        Self { nodes, dense, range }
    }

    /// The state where T and ρ between the nodes, and the gradient of T, are these.
    #[inline(always)]
    pub fn state(&self, [temperature, density]: [f64; 2], temperature_gradient: Vec3) -> LocalGas {
        // beyond a cell, where a step that is then cut may look, its formula may lead below all there is
        let [least, light] = self.range.map(|[low, _]| 0.5 * low);
        LocalGas {
            temperature: temperature.max(least),
            density: self.dense.then_some(density.max(light)),
            temperature_gradient,
        }
    }
}
