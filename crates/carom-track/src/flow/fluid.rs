//! The fluid's properties; what of a gas follows from what is in `gas.rs`.

use super::gas::{ATMOSPHERE, USUAL_TEMPERATURE, with_path};
use super::{FlowError, Gas, GasState};

/// A Newtonian fluid of constant properties.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluid {
    /// Density, kg/m³.
    pub density: f64,
    /// Dynamic viscosity, Pa s.
    pub viscosity: f64,
    /// Temperature, K.
    pub temperature: f64,
    /// Mean free path of the molecules, m; 0 for a liquid or a continuum.
    pub mean_free_path: f64,
}

impl Fluid {
    /// Dry air at a temperature (K) and pressure (Pa).
    ///
    /// # Errors
    /// [`FlowError::Value`] unless 170 K ≤ temperature ≤ 1900 K (Sutherland's range) and 0 < pressure ≤ 100 bar.
    ///
    /// ```
    /// let air = carom_track::flow::Fluid::air(293.15, 101_325.0)?;
    /// assert!((air.density - 1.204).abs() < 1e-3 && (air.viscosity - 1.81e-5).abs() < 1e-7);
    /// # Ok::<(), carom_track::flow::FlowError>(())
    /// ```
    pub fn air(temperature: f64, pressure: f64) -> Result<Self, FlowError> {
        let [low, high] = Gas::Air.range();
        if !(low..=high).contains(&temperature) {
            return Err(FlowError::value("air temperature", temperature, "170 K to 1900 K"));
        }
        let state = GasState { temperature: Some(temperature), pressure: Some(pressure), ..GasState::default() };
        state.fluid().map_err(|_| FlowError::value("air pressure", pressure, "positive and at most 1e7 Pa"))
    }

    /// A liquid: no slip at a sphere, however small.
    ///
    /// # Errors
    /// As [`Fluid::check`].
    pub fn liquid(density: f64, viscosity: f64, temperature: f64) -> Result<Self, FlowError> {
        let liquid = Self { density, viscosity, temperature, mean_free_path: 0.0 };
        liquid.check().map(|()| liquid)
    }

    /// Mean speed of a gas's molecules, from λ = μ/(0.499 ρ c̄), m/s; infinite where there is no mean free path.
    #[inline]
    pub fn molecular_speed(&self) -> f64 {
        self.viscosity / (0.499 * self.density * self.mean_free_path)
    }

    /// Kinematic viscosity, m²/s.
    #[inline]
    pub fn kinematic_viscosity(&self) -> f64 {
        self.viscosity / self.density
    }

    /// Refuses properties that no fluid has.
    ///
    /// # Errors
    /// [`FlowError::Value`] naming the property that is not positive (the mean free path may be 0) or not finite.
    pub fn check(&self) -> Result<(), FlowError> {
        FlowError::positive("fluid density", self.density)?;
        FlowError::positive("fluid viscosity", self.viscosity)?;
        FlowError::positive("fluid temperature", self.temperature)?;
        if self.mean_free_path >= 0.0 && self.mean_free_path.is_finite() {
            Ok(())
        } else {
            Err(FlowError::value("mean free path", self.mean_free_path, "zero or a positive length"))
        }
    }
}

/// Air at 24 °C and one atmosphere.
impl Default for Fluid {
    fn default() -> Self {
        let thermal = Gas::Air.specific_constant() * USUAL_TEMPERATURE;
        with_path(ATMOSPHERE / thermal, Gas::Air.viscosity(USUAL_TEMPERATURE), USUAL_TEMPERATURE, thermal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn air_at_24_degrees() {
        let air = Fluid::default();
        assert!((air.density - 1.188).abs() < 5e-4, "{air:?}");
        assert!((air.viscosity - 1.8325e-5).abs() < 5e-10, "{air:?}");
        // Hinds 1999, section 2.4: 0.066 µm at 20 °C and 1 atm
        let at20 = Fluid::air(293.15, 101_325.0).unwrap();
        assert!((at20.mean_free_path - 0.066e-6).abs() < 1e-9, "{at20:?}");
    }

    #[test]
    fn refuses_what_is_not_a_fluid() {
        assert!(Fluid { density: -1.0, ..Fluid::default() }.check().is_err());
        assert!(Fluid { viscosity: f64::NAN, ..Fluid::default() }.check().is_err());
        assert!(Fluid { mean_free_path: 0.0, ..Fluid::default() }.check().is_ok());
        assert!(Fluid::air(24.0, 101_325.0).is_err());
    }
}
