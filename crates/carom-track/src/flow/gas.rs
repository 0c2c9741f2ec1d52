//! Gases: what of a state follows from the rest.
//!
//! Ideal gas: density ρ = p/(R_s T), R_s = R/M, with R the molar gas constant and M the molar mass. Real gases depart from
//! it by about 1 % at 10 bar (5 % for carbon dioxide). Viscosity by Sutherland's law μ = C T^{3/2}/(T + S). Mean free path
//! λ = μ/(0.499 ρ c̄), c̄ = √(8 R_s T/π) (Chapman & Cowling as quoted by Willeke 1976, J. Aerosol Sci. 7, 381–387,
//! doi:10.1016/0021-8502(76)90024-0): always of the state at hand.
//!
//! | gas | C, S from | range, K | viscosity off by at most |
//! |---|---|---|---|
//! | air | U.S. Standard Atmosphere 1976 (NOAA-S/T 76-1562, section 1.3.11) | 170–1900 | 0.5 % to 300 K, 2 % to 600 K, 9 % |
//! | nitrogen, oxygen, argon, carbon dioxide, hydrogen | White 2006, Viscous Fluid Flow, 3rd ed., McGraw-Hill, Table 1-2 | below | 3 % |
//! | helium | S: Licht & Stechert 1944 (J. Phys. Chem. 48, 23–47, doi:10.1021/j150433a004); 19.825 μPa s at 298.15 K: Hurly & Mehl 2007 (J. Res. NIST 112, 75–94, doi:10.6028/jres.112.006) | 200–600 | 3 % |
//!
//! The last column and the ranges of the last two rows are what comparison with the reference correlations of each gas gave
//! (as CoolProp 8 evaluates them at low density); White's own ranges are wider. Moist air: `humid.rs`.
//!
//! ```
//! use carom_track::flow::{Gas, GasState};
//! // half an atmosphere: half the density, twice the mean free path
//! let half = GasState { pressure: Some(50_662.5), temperature: Some(293.15), ..GasState::default() }.fluid()?;
//! assert!((half.density - 0.602).abs() < 1e-3 && (half.mean_free_path - 130.4e-9).abs() < 1e-10);
//! let helium = GasState { gas: Gas::Helium, temperature: Some(298.15), ..GasState::default() }.fluid()?;
//! assert!((helium.viscosity - 19.825e-6).abs() < 1e-9);
//! # Ok::<(), carom_track::flow::StateError>(())
//! ```

use super::Fluid;
use super::humid::Humid;

/// Molar gas constant, J/(mol K) (SI, exact).
const GAS_CONSTANT: f64 = 8.314_462_618_153_24;
/// One atmosphere, Pa.
pub(super) const ATMOSPHERE: f64 = 101_325.0;
/// 24 °C.
pub(super) const USUAL_TEMPERATURE: f64 = 297.15;
/// Beyond this no gas is near ideal, and what is as dense as that is a liquid, Pa.
const DENSEST: f64 = 1e7;
/// No gas is as viscous at any temperature here, Pa s: argon at 2000 K has 8.7e-5.
const MOST_VISCOUS: f64 = 2e-4;
/// Density, pressure and temperature as people round them agree within this.
const AGREEMENT: f64 = 0.01;

/// A gas whose properties are known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gas {
    /// Air, 28.965 g/mol.
    #[default]
    Air,
    /// N₂.
    Nitrogen,
    /// O₂.
    Oxygen,
    /// Ar.
    Argon,
    /// CO₂.
    CarbonDioxide,
    /// He.
    Helium,
    /// H₂.
    Hydrogen,
}

struct Properties {
    /// R/M, J/(kg K).
    specific: f64,
    /// C and S of Sutherland's law.
    sutherland: [f64; 2],
    /// K.
    range: [f64; 2],
}

impl Properties {
    /// From M (kg/mol) and the viscosity `mu` (Pa s) at `t` (K).
    fn new(molar_mass: f64, [t, mu]: [f64; 2], s: f64, range: [f64; 2]) -> Self {
        Self { specific: GAS_CONSTANT / molar_mass, sutherland: [mu * (t + s) / (t * t.sqrt()), s], range }
    }
}

impl Gas {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Air, Self::Nitrogen, Self::Oxygen, Self::Argon, Self::CarbonDioxide, Self::Helium, Self::Hydrogen];

    /// Its name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Air => "air",
            Self::Nitrogen => "nitrogen",
            Self::Oxygen => "oxygen",
            Self::Argon => "argon",
            Self::CarbonDioxide => "carbon-dioxide",
            Self::Helium => "helium",
            Self::Hydrogen => "hydrogen",
        }
    }

    fn properties(self) -> Properties {
        let s = self.sutherland();
        match self {
            // 287.05 is R/M of dry air, 28.96546 g/mol (CIPM-2007, doi:10.1088/0026-1394/45/2/004)
            Self::Air => Properties { specific: 287.05, sutherland: [1.458e-6, s], range: [170.0, 1900.0] },
            Self::Nitrogen => Properties::new(28.0134e-3, [273.0, 1.663e-5], s, [120.0, 800.0]),
            Self::Oxygen => Properties::new(31.9988e-3, [273.0, 1.919e-5], s, [150.0, 1500.0]),
            Self::Argon => Properties::new(39.948e-3, [273.0, 2.125e-5], s, [120.0, 1000.0]),
            Self::CarbonDioxide => Properties::new(44.0095e-3, [273.0, 1.370e-5], s, [190.0, 500.0]),
            Self::Helium => Properties::new(4.002_602e-3, [298.15, 1.9825e-5], s, [200.0, 600.0]),
            Self::Hydrogen => Properties::new(2.015_88e-3, [273.0, 8.411e-6], s, [200.0, 800.0]),
        }
    }

    /// R/M, J/(kg K).
    pub fn specific_constant(self) -> f64 {
        self.properties().specific
    }

    /// Viscosity by Sutherland's law, Pa s; within [`Gas::range`].
    pub fn viscosity(self, temperature: f64) -> f64 {
        let [c, s] = self.properties().sutherland;
        c * temperature * temperature.sqrt() / (temperature + s)
    }

    /// S of Sutherland's law, K.
    #[inline(always)]
    pub fn sutherland(self) -> f64 {
        match self {
            Self::Air => 110.4,
            Self::Nitrogen => 107.0,
            Self::Oxygen => 139.0,
            Self::Argon => 144.0,
            Self::CarbonDioxide => 222.0,
            Self::Helium => 79.4,
            Self::Hydrogen => 97.0,
        }
    }

    /// Temperatures between which its viscosity is good, K.
    pub fn range(self) -> [f64; 2] {
        self.properties().range
    }
}

/// What is given of a gas; [`GasState::fluid`] finds the rest.
///
/// Temperature follows from density and pressure where both are given, else it is 24 °C; pressure follows from the density,
/// else it is one atmosphere.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GasState {
    /// Which gas.
    pub gas: Gas,
    /// K.
    pub temperature: Option<f64>,
    /// Pa.
    pub pressure: Option<f64>,
    /// Relative humidity, 0 to 1; of air alone.
    pub humidity: Option<f64>,
    /// kg/m³.
    pub density: Option<f64>,
    /// Pa s.
    pub viscosity: Option<f64>,
}

/// A state that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: {right}")]
pub struct StateError {
    /// The given value that it is about, by its field's name.
    pub about: &'static str,
    /// What is wrong.
    pub what: String,
    /// What would be right.
    pub right: String,
}

fn wrong(about: &'static str, what: String, right: impl Into<String>) -> StateError {
    StateError { about, what, right: right.into() }
}

/// A gas of a density (kg/m³), viscosity (Pa s) and temperature (K) whose R_s T is `thermal` (m²/s²).
pub(super) fn with_path(density: f64, viscosity: f64, temperature: f64, thermal: f64) -> Fluid {
    Fluid { density, viscosity, temperature, mean_free_path: mean_free_path(density, viscosity, thermal) }
}

/// λ (m) of a gas of a density (kg/m³) and viscosity (Pa s) whose R_s T is `thermal` (m²/s²).
pub(crate) fn mean_free_path(density: f64, viscosity: f64, thermal: f64) -> f64 {
    viscosity / (0.499 * density * (8.0 * thermal / std::f64::consts::PI).sqrt())
}

impl GasState {
    /// The fluid in this state.
    ///
    /// # Errors
    /// [`StateError`]: a value that is not positive, values that contradict each other, a temperature outside the range of
    /// the viscosity's source, what no gas is.
    pub fn fluid(&self) -> Result<Fluid, StateError> {
        self.positive()?;
        let temperature = self.temperature()?;
        let humid = self.humid(temperature)?;
        let dry = self.gas.specific_constant() * temperature;
        let pressure = match (self.pressure, self.density) {
            (Some(p), _) => p,
            (None, Some(density)) => density * dry + humid.as_ref().map_or(0.0, Humid::lift),
            (None, None) => ATMOSPHERE,
        };
        self.gaseous(temperature, pressure)?;
        if let Some(humid) = humid.as_ref().filter(|h| h.vapour >= pressure) {
            let what = format!("vapour of {:.3e} Pa in air of {pressure:.4e} Pa", humid.vapour);
            return Err(wrong("humidity", what, "no air is left: less humidity, a lower temperature or more pressure"));
        }
        let of_state = (pressure - humid.as_ref().map_or(0.0, Humid::lift)) / dry;
        let density = self.density.unwrap_or(of_state);
        if (density / of_state - 1.0).abs() > AGREEMENT {
            let gas = self.gas.name();
            let what = format!(
                "density {density} kg/m3, pressure {pressure} Pa and temperature {temperature:.2} K contradict each other"
            );
            let right =
                format!("{gas} of this pressure and temperature has {of_state:.4} kg/m3: leave one of them out");
            return Err(wrong("density", what, right));
        }
        let viscosity = self.viscosity.unwrap_or_else(|| match &humid {
            Some(humid) => humid.viscosity(pressure, self.gas.viscosity(temperature)),
            None => self.gas.viscosity(temperature),
        });
        // R_s T of the mixture: that of the dry gas, exactly, where there is no vapour
        let thermal = humid.as_ref().map_or(dry, |h| dry * pressure / (pressure - h.lift()));
        Ok(with_path(density, viscosity, temperature, thermal))
    }

    fn positive(&self) -> Result<(), StateError> {
        let given = [
            ("temperature", self.temperature, "K"),
            ("pressure", self.pressure, "Pa"),
            ("density", self.density, "kg/m3"),
            ("viscosity", self.viscosity, "Pa s"),
        ];
        for (name, value, unit) in given {
            if let Some(v) = value.filter(|v| !(*v > 0.0 && v.is_finite())) {
                return Err(wrong(name, format!("{name} is {v} {unit}"), "it must be positive and finite"));
            }
        }
        Ok(())
    }

    fn temperature(&self) -> Result<f64, StateError> {
        let (temperature, about) = match (self.temperature, self.pressure, self.density) {
            (Some(t), _, _) => (t, "temperature"),
            (None, Some(_), Some(_)) if self.humidity.is_some() => {
                let what = "humidity with a density and a pressure needs a temperature".to_owned();
                return Err(wrong("humidity", what, "give it, and leave the density out"));
            }
            (None, Some(p), Some(density)) => (p / (density * self.gas.specific_constant()), "density"),
            (None, ..) => (USUAL_TEMPERATURE, "density"),
        };
        let [low, high] = self.gas.range();
        if self.viscosity.is_none() && !(low..=high).contains(&temperature) {
            let gas = self.gas.name();
            let what = if about == "temperature" {
                format!("{gas} at {temperature:.2} K")
            } else {
                format!("{gas} of this density and pressure is at {temperature:.1} K")
            };
            let right = format!("its viscosity is known from {low} K to {high} K: beyond, give viscosity");
            return Err(wrong(about, what, right));
        }
        Ok(temperature)
    }

    fn humid(&self, temperature: f64) -> Result<Option<Humid>, StateError> {
        let Some(humidity) = self.humidity else { return Ok(None) };
        if !(0.0..=1.0).contains(&humidity) {
            return Err(wrong(
                "humidity",
                format!("humidity is {humidity}"),
                "it is a share of saturation, from 0 to 1: air above saturation does not last",
            ));
        }
        if self.gas != Gas::Air {
            let what = format!("humidity in {}", self.gas.name());
            return Err(wrong("humidity", what, "it is known of air alone: give density and viscosity"));
        }
        if humidity == 0.0 {
            return Ok(None);
        }
        Humid::new(humidity, temperature).map(Some).ok_or_else(|| {
            wrong(
                "humidity",
                format!("humidity at {temperature:.2} K"),
                "moist air is known from 0 degC to 100 degC: beyond, give density and viscosity",
            )
        })
    }

    /// Refuses what only a liquid can be.
    fn gaseous(&self, temperature: f64, pressure: f64) -> Result<(), StateError> {
        const RIGHT: &str = "add liquid = true if it is a liquid";
        let gas = self.gas.name();
        if pressure > DENSEST {
            return Err(match self.density {
                Some(density) if self.pressure.is_none() => wrong(
                    "density",
                    format!(
                        "density {density} kg/m3 is no gas's: {gas} at {temperature:.2} K would be at {:.0} bar",
                        pressure * 1e-5
                    ),
                    RIGHT,
                ),
                _ => wrong(
                    "pressure",
                    format!("{gas} at {:.0} bar is no ideal gas", pressure * 1e-5),
                    "up to 100 bar it is taken as one",
                ),
            });
        }
        match self.viscosity {
            Some(mu) if mu > MOST_VISCOUS => Err(wrong("viscosity", format!("viscosity {mu} Pa s is no gas's"), RIGHT)),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(gas: Gas, temperature: f64) -> GasState {
        GasState { gas, temperature: Some(temperature), ..GasState::default() }
    }

    #[test]
    fn viscosities_agree_with_reference_correlations() {
        // the reference correlation of each gas at low density, as CoolProp 8.0 evaluates it, Pa s
        let known = [
            (Gas::Air, [200.0, 1.3316e-5], [300.0, 1.8523e-5], [600.0, 3.0760e-5], 0.02),
            (Gas::Nitrogen, [120.0, 8.2015e-6], [300.0, 1.7877e-5], [800.0, 3.5883e-5], 0.03),
            (Gas::Oxygen, [150.0, 1.1352e-5], [300.0, 2.0631e-5], [1500.0, 6.3966e-5], 0.03),
            (Gas::Argon, [120.0, 9.8378e-6], [300.0, 2.2724e-5], [1000.0, 5.5682e-5], 0.03),
            (Gas::CarbonDioxide, [190.0, 9.6555e-6], [300.0, 1.4994e-5], [500.0, 2.3910e-5], 0.03),
            (Gas::Helium, [200.0, 1.5135e-5], [300.0, 1.9926e-5], [600.0, 3.2213e-5], 0.03),
            (Gas::Hydrogen, [200.0, 6.7464e-6], [300.0, 8.9379e-6], [800.0, 1.7705e-5], 0.03),
        ];
        for (gas, a, b, c, within) in known {
            for [t, mu] in [a, b, c] {
                let got = state(gas, t).fluid().unwrap().viscosity;
                assert!((got / mu - 1.0).abs() < within, "{gas:?} {t} {got} {mu}");
            }
        }
    }

    #[test]
    fn the_rest_follows_whatever_is_given() {
        let p = 101_325.0;
        let whole = GasState { pressure: Some(p), ..state(Gas::Argon, 320.0) }.fluid().unwrap();
        // 39.948 g/mol at 320 K: ρ = pM/(RT)
        assert!((whole.density / (p * 39.948e-3 / (8.314_462_618 * 320.0)) - 1.0).abs() < 1e-9);
        let near = |a: Fluid, b: Fluid| {
            let each = [(a.density, b.density), (a.temperature, b.temperature), (a.mean_free_path, b.mean_free_path)];
            each.into_iter().chain([(a.viscosity, b.viscosity)]).all(|(a, b)| (a / b - 1.0).abs() < 1e-12)
        };
        let argon = GasState { gas: Gas::Argon, ..GasState::default() };
        let of = |state: GasState| state.fluid().unwrap();
        assert!(near(whole, of(GasState { density: Some(whole.density), ..state(Gas::Argon, 320.0) })));
        assert!(near(whole, of(GasState { density: Some(whole.density), pressure: Some(p), ..argon })));
        // a given viscosity counts for the path too
        let double = of(GasState { viscosity: Some(2.0 * whole.viscosity), ..state(Gas::Argon, 320.0) });
        assert!((double.mean_free_path / whole.mean_free_path - 2.0).abs() < 1e-12);
        assert_eq!(of(GasState::default()), Fluid::default());
    }

    #[test]
    fn the_mean_free_path_is_that_of_the_state() {
        let at = |p: f64| GasState { pressure: Some(p), ..state(Gas::Air, 293.15) }.fluid().unwrap();
        assert!((at(101_325.0).mean_free_path - 65.198e-9).abs() < 1e-12);
        // 1e-4 Torr: half a metre
        let chamber = at(1e-4 * 133.322_368);
        assert!((chamber.mean_free_path / (65.198e-9 * 101_325.0 / 0.013_332_236_8) - 1.0).abs() < 1e-5);
        assert_eq!(chamber.viscosity, at(101_325.0).viscosity);
    }

    #[test]
    fn refuses_what_contradicts_itself() {
        let air = GasState::default();
        let refused = |state: GasState, about: &str, words: &str| {
            let error = state.fluid().unwrap_err();
            assert!(error.about == about && error.to_string().contains(words), "{error:?}");
        };
        let all = GasState { pressure: Some(101_325.0), ..state(Gas::Air, 293.15) };
        refused(
            GasState { density: Some(0.6), ..all },
            "density",
            "contradict each other: air of this pressure and temperature has 1.204",
        );
        assert!(GasState { density: Some(1.2), ..all }.fluid().is_ok(), "rounded to two digits");
        refused(
            GasState { density: Some(998.0), viscosity: Some(1e-3), ..air },
            "density",
            "851 bar: add liquid = true",
        );
        refused(GasState { viscosity: Some(1e-3), ..air }, "viscosity", "add liquid = true");
        refused(GasState { pressure: Some(2e7), ..air }, "pressure", "200 bar is no ideal gas");
        refused(state(Gas::Helium, 100.0), "temperature", "from 200 K to 600 K");
        assert!(GasState { viscosity: Some(9e-6), ..state(Gas::Helium, 100.0) }.fluid().is_ok());
        refused(GasState { pressure: Some(101_325.0), density: Some(0.1), ..air }, "density", "is at 3529.");
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            refused(GasState { pressure: Some(value), ..air }, "pressure", "positive");
        }
        refused(GasState { humidity: Some(1.01), ..air }, "humidity", "from 0 to 1");
        refused(GasState { humidity: Some(0.5), ..state(Gas::Argon, 300.0) }, "humidity", "air alone");
        refused(GasState { humidity: Some(0.5), ..state(Gas::Air, 263.15) }, "humidity", "from 0 degC to 100 degC");
        refused(GasState { humidity: Some(1.0), pressure: Some(1000.0), ..air }, "humidity", "no air is left");
        refused(
            GasState { humidity: Some(1.0), pressure: Some(1e5), density: Some(1.2), ..air },
            "humidity",
            "needs a temperature",
        );
    }
}
