//! The state of the gas on a table's nodes: temperature, and density where it is given.

use super::{DENSITY, Place, Row, TEMPERATURE, Table};
use crate::flow::LocalGas;
use crate::flow::gas_nodes::GasNodes;

/// The nodes' states, in their order.
pub(super) fn nodes(read: &[Row], dense: bool) -> GasNodes {
    GasNodes::new(read.iter().map(|n| [n[TEMPERATURE], n[DENSITY]]).collect(), dense)
}

impl GasNodes {
    /// In a cell, with the weights of its faces.
    #[inline(always)]
    pub(super) fn at(&self, table: &Table, p: &[Place; 3], w: [[f64; 2]; 3]) -> LocalGas {
        let mut gradient = [0.0; 3];
        for j in 0..3 {
            let mut difference = w;
            difference[j] = [-p[j].slope, p[j].slope];
            [gradient[j], _] = self.blend(table, p, difference);
        }
        self.state(self.blend(table, p, w), gradient)
    }

    #[inline(always)]
    fn blend(&self, table: &Table, p: &[Place; 3], w: [[f64; 2]; 3]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (i, wi) in [p[0].low, p[0].high].into_iter().zip(w[0]) {
            for (j, wj) in [p[1].low, p[1].high].into_iter().zip(w[1]) {
                for (k, wk) in [p[2].low, p[2].high].into_iter().zip(w[2]) {
                    let weight = wi * wj * wk;
                    let node = &self.nodes[table.index(i, j, k)];
                    for q in 0..2 {
                        sum[q] += weight * node[q];
                    }
                }
            }
        }
        sum
    }
}

impl Table {
    /// Whether it gives the gas's temperature.
    #[inline(always)]
    pub fn has_gas(&self) -> bool {
        self.state.is_some()
    }

    /// Lowest and highest temperature of its nodes, K, if it gives any.
    pub fn temperatures(&self) -> Option<[f64; 2]> {
        self.state.as_ref().map(|s| s.range[0])
    }

    /// Lowest and highest density of its nodes, kg/m³, if it gives any.
    pub fn densities(&self) -> Option<[f64; 2]> {
        self.state.as_ref().filter(|s| s.dense).map(|s| s.range[1])
    }

    /// The same without temperature and density: a liquid, say.
    #[must_use]
    pub fn without_gas(self) -> Self {
        Self { state: None, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn state_and_gradient_are_the_interpolants() {
        let f = |x: f64, y: f64| (300.0 + 20.0 * x - 5.0 * y + 3.0 * x * y, 1.2 - 0.1 * x + 0.05 * y);
        let mut text = String::from("x,y,u,T [K],rho [kg/m3]\n");
        for (x, y) in [(0.0, 0.0), (2.0, 0.0), (3.0, 0.0), (0.0, 1.0), (2.0, 1.0), (3.0, 1.0)] {
            let (t, rho) = f(x, y);
            text += &format!("{x},{y},1,{t},{rho}\n");
        }
        let table = Table::from_csv(text.as_bytes()).unwrap();
        for (x, y) in [(0.3, 0.2), (2.5, 0.9), (2.0, 1.0)] {
            let gas = table.sample([x, y, 7.0]).gas.expect("a state");
            let (t, rho) = f(x, y);
            assert!((gas.temperature - t).abs() < 1e-12 * t, "{gas:?}");
            assert!((gas.density.unwrap() - rho).abs() < 1e-14, "{gas:?}");
            let want = [20.0 + 3.0 * y, -5.0 + 3.0 * x, 0.0];
            assert!(gas.temperature_gradient.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-11), "{gas:?}");
        }
        assert_eq!(table.temperatures(), Some([295.0, 364.0]));
        assert!(table.notes().is_empty(), "{:?}", table.notes());
        assert!(!table.without_gas().has_gas());
    }

    #[test]
    fn columns_of_programs_and_units() {
        let warm = Table::from_csv("y,u,Temperature [C]\n0,1,20\n1,1,40\n".as_bytes()).unwrap();
        let gas = warm.sample([0.0, 0.5, 0.0]).gas.unwrap();
        assert!((gas.temperature - 303.15).abs() < 1e-10 && gas.density.is_none(), "{gas:?}");
        assert!((gas.temperature_gradient[1] - 20.0).abs() < 1e-10);
        // density alone says nothing of the gas's state, and t is the time
        let rho = Table::from_csv("y,u,density,t\n0,1,1.2,0\n1,1,1.2,0\n".as_bytes()).unwrap();
        assert!(!rho.has_gas() && rho.notes().iter().any(|n| n.contains("density is left out")), "{:?}", rho.notes());
        for bad in ["y,u,T\n0,1,0\n1,1,300\n", "y,u,T,rho\n0,1,300,1\n1,1,300,-1\n"] {
            let error = Table::from_csv(bad.as_bytes()).expect_err("no such gas").to_string();
            assert!(error.contains("must be positive"), "{error}");
        }
    }
}
