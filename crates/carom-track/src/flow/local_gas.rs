//! A gas whose temperature and density differ from place to place.
//!
//! From the run's state (ρ₀, μ₀, T₀, λ₀) and the local temperature T (K), with S the constant of Sutherland's law of the run's gas:
//!
//! μ = μ₀ (T/T₀)^{3/2} (T₀ + S)/(T + S),  λ = λ₀ (μ/μ₀)(ρ₀/ρ)(T₀/T)^{1/2},
//!
//! the same as Sutherland's μ and λ = μ/(0.499 ρ c̄) of the local state (`gas.rs`), and right too where the case gives its own
//! viscosity or mean free path. Where the flow gives no density, it is that of an ideal gas at the run's pressure, ρ = ρ₀ T₀/T. What
//! humidity does is taken as the run's.
//!
//! ```
//! use carom_track::flow::{Fluid, Gas, LocalGas};
//! let hot = LocalGas { temperature: 600.0, density: None, temperature_gradient: [0.0; 3] };
//! let got = Fluid::default().at(Gas::Air, &hot);
//! let want = Fluid::air(600.0, 101_325.0)?;
//! assert!((got.viscosity / want.viscosity - 1.0).abs() < 1e-14 && (got.density / want.density - 1.0).abs() < 1e-14);
//! assert!((got.mean_free_path / want.mean_free_path - 1.0).abs() < 1e-14);
//! # Ok::<(), carom_track::flow::FlowError>(())
//! ```

use super::{Fluid, Gas};

/// The state of a gas at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalGas {
    /// Temperature, K; positive.
    pub temperature: f64,
    /// Density, kg/m³; positive. Where it is not given, that of an ideal gas at the run's pressure.
    pub density: Option<f64>,
    /// Gradient of the temperature, K/m.
    pub temperature_gradient: [f64; 3],
}

impl Fluid {
    /// This gas where its state is a local one.
    #[inline(always)]
    pub fn at(&self, gas: Gas, local: &LocalGas) -> Self {
        let (t, s) = (local.temperature, gas.sutherland());
        let warmer = t / self.temperature;
        let root = warmer.sqrt();
        let thicker = warmer * root * ((self.temperature + s) / (t + s));
        let density = local.density.unwrap_or(self.density / warmer);
        Self {
            density,
            viscosity: self.viscosity * thicker,
            temperature: t,
            mean_free_path: self.mean_free_path * thicker * (self.density / density) / root,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::GasState;

    #[test]
    fn it_is_the_state_itself() {
        for gas in Gas::ALL {
            let state = |t, p| GasState { gas, temperature: Some(t), pressure: Some(p), ..GasState::default() };
            let run = state(300.0, 2e4).fluid().unwrap();
            for (t, p) in [(220.0, 2e4), (300.0, 2e4), (450.0, 3e5)] {
                let want = state(t, p).fluid().unwrap();
                let here = LocalGas { temperature: t, density: Some(want.density), temperature_gradient: [0.0; 3] };
                let got = run.at(gas, &here);
                for (got, want) in [
                    (got.density, want.density),
                    (got.viscosity, want.viscosity),
                    (got.mean_free_path, want.mean_free_path),
                    (got.temperature, want.temperature),
                ] {
                    assert!((got / want - 1.0).abs() < 1e-14, "{gas:?} {t} {p}: {got} {want}");
                }
            }
        }
        // what the case gives itself is kept in proportion
        let own = Fluid { viscosity: 2e-5, mean_free_path: 1e-7, ..Fluid::default() };
        let here = |t| LocalGas { temperature: t, density: None, temperature_gradient: [0.0; 3] };
        assert_eq!(own.at(Gas::Air, &here(own.temperature)), own);
        let warm = own.at(Gas::Air, &here(2.0 * own.temperature));
        assert_eq!(warm.density, 0.5 * own.density);
        assert!((warm.viscosity / 2e-5 - Gas::Air.viscosity(594.3) / Gas::Air.viscosity(297.15)).abs() < 1e-14);
    }
}
