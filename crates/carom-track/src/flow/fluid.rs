//! The fluid's properties.
//!
//! Air as an ideal gas: density ρ = p/(R_s T), R_s = 287.05 J/(kg K); viscosity by Sutherland's law
//! μ = 1.458e-6 T^{3/2}/(T + 110.4) Pa s (U.S. Standard Atmosphere 1976, NOAA-S/T 76-1562, section 1.3.11; 170–1900 K);
//! mean free path λ = μ/(0.499 ρ c̄), c̄ = √(8 R_s T/π) (Chapman & Cowling as quoted by Willeke 1976,
//! J. Aerosol Sci. 7, 381–387, doi:10.1016/0021-8502(76)90024-0).
//! Moisture is left out: at 24 °C and 25 % relative humidity it lowers the density by 0.3 %.

use super::FlowError;

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
    /// [`FlowError::Value`] unless 170 K ≤ temperature ≤ 1900 K (Sutherland's range) and the pressure is positive and finite.
    ///
    /// ```
    /// let air = carom_track::flow::Fluid::air(293.15, 101_325.0)?;
    /// assert!((air.density - 1.204).abs() < 1e-3 && (air.viscosity - 1.81e-5).abs() < 1e-7);
    /// # Ok::<(), carom_track::flow::FlowError>(())
    /// ```
    pub fn air(temperature: f64, pressure: f64) -> Result<Self, FlowError> {
        if !(170.0..=1900.0).contains(&temperature) {
            return Err(FlowError::value("air temperature", temperature, "170 K to 1900 K"));
        }
        FlowError::positive("air pressure", pressure)?;
        Ok(air(temperature, pressure))
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
        air(297.15, 101_325.0)
    }
}

fn air(temperature: f64, pressure: f64) -> Fluid {
    const GAS_CONSTANT: f64 = 287.05;
    let density = pressure / (GAS_CONSTANT * temperature);
    let viscosity = 1.458e-6 * temperature * temperature.sqrt() / (temperature + 110.4);
    let mean_speed = (8.0 * GAS_CONSTANT * temperature / std::f64::consts::PI).sqrt();
    Fluid { density, viscosity, temperature, mean_free_path: viscosity / (0.499 * density * mean_speed) }
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
