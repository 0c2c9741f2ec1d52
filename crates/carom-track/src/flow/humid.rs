//! Moist air.
//!
//! Vapour pressure e = h p_s(T), h the relative humidity over water, p_s by Wagner & Pruß 2002 (J. Phys. Chem. Ref. Data 31,
//! 387–535, doi:10.1063/1.1461829, Eq. 2.5; within 0.03 % here). Density of the mixture of ideal gases
//! ρ = [p − e (1 − M_v/M_a)]/(R_a T), M_v/M_a = 0.62195; without the air's enhancement of p_s (0.4 % of e), so within 0.1 % of
//! the density up to saturation at 40 °C. Viscosity by Wilke's rule (1950, J. Chem. Phys. 18, 517–519,
//! doi:10.1063/1.1747673; over 17 pairs of gases within 1 % on average) from dry air's and the vapour's
//! (dilute steam: Huber & others 2009, J. Phys. Chem. Ref. Data 38, 101–125, doi:10.1063/1.3088050, Eq. 11).
//! Range 0 to 100 °C. At 24 °C a humidity of 50 % lowers the density by 0.6 % and the viscosity by 0.2 %.
//!
//! It does nothing to the wall: condensed water and its capillary forces at a contact are in no law.
//!
//! ```
//! use carom_track::flow::GasState;
//! let air = GasState { temperature: Some(310.15), humidity: Some(1.0), ..GasState::default() }.fluid()?;
//! assert!((air.density - 1.112).abs() < 1e-3); // dry: 1.138
//! # Ok::<(), carom_track::flow::StateError>(())
//! ```

use carom::math::{exp, sqrt};

/// M_v/M_a, with 18.01528 and 28.9652 g/mol.
const RATIO: f64 = 0.621_95;

/// Vapour in air.
pub(super) struct Humid {
    /// Its pressure, Pa.
    pub vapour: f64,
    temperature: f64,
}

impl Humid {
    /// At a relative humidity and temperature (K); `None` outside 0 to 100 °C.
    pub fn new(humidity: f64, temperature: f64) -> Option<Self> {
        (273.15..=373.15)
            .contains(&temperature)
            .then(|| Self { vapour: humidity * saturation(temperature), temperature })
    }

    /// By how much dry air of the same density and temperature has less pressure, Pa.
    pub fn lift(&self) -> f64 {
        (1.0 - RATIO) * self.vapour
    }

    /// Viscosity of the mixture at a pressure, from that of dry air, Pa s.
    pub fn viscosity(&self, pressure: f64, dry: f64) -> f64 {
        let x = self.vapour / pressure;
        let steam = steam_viscosity(self.temperature);
        let root = 1.0 + sqrt(dry / steam) * sqrt(sqrt(RATIO));
        let of_air = root * root / sqrt(8.0 * (1.0 + 1.0 / RATIO));
        let of_vapour = of_air * steam / dry / RATIO;
        (1.0 - x) * dry / (1.0 - x + x * of_air) + x * steam / (x + (1.0 - x) * of_vapour)
    }
}

/// Vapour pressure over water, Pa.
fn saturation(temperature: f64) -> f64 {
    const CRITICAL: [f64; 2] = [647.096, 22.064e6];
    let t = 1.0 - temperature / CRITICAL[0];
    let (root, cube) = (sqrt(t), t * t * t);
    let sum = -7.859_517_83 * t + 1.844_082_59 * t * root - 11.786_649_7 * cube + 22.680_741_1 * cube * root
        - 15.961_871_9 * t * cube
        + 1.801_225_02 * cube * cube * t * root;
    CRITICAL[1] * exp(CRITICAL[0] / temperature * sum)
}

/// Viscosity of dilute steam, Pa s.
fn steam_viscosity(temperature: f64) -> f64 {
    let t = temperature / 647.096;
    1e-4 * sqrt(t) / (1.677_52 + (2.204_62 + (0.636_656_4 - 0.241_605 / t) / t) / t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::GasState;

    #[test]
    fn steam_has_its_published_values() {
        // IAPWS-IF97, region 4: 3.53658941 kPa at 300 K; IAPWS-95 at 273.16 K: 611.655 Pa
        assert!((saturation(300.0) / 3_536.589_41 - 1.0).abs() < 1e-4);
        assert!((saturation(273.16) / 611.655 - 1.0).abs() < 1e-4);
        // CoolProp 8.0, IAPWS's correlation at low density
        for (t, mu) in [(300.0, 9.768_413e-6), (350.0, 1.148_616e-5), (373.0, 1.233_143e-5)] {
            assert!((steam_viscosity(t) / mu - 1.0).abs() < 1e-4, "{t}");
        }
    }

    #[test]
    fn moist_air_agrees_with_reference_values() {
        // ASHRAE's real-gas model RP-1485 as CoolProp 8.0 evaluates it (HAPropsSI), at one atmosphere
        let known = [
            (293.15, 0.5, 1.199_359),
            (297.15, 0.25, 1.185_038),
            (310.15, 1.0, 1.111_881),
            (313.15, 1.0, 1.096_606),
            (333.15, 0.8, 0.997_058),
        ];
        for (temperature, humidity, density) in known {
            let state = GasState { temperature: Some(temperature), humidity: Some(humidity), ..GasState::default() };
            let got = state.fluid().unwrap();
            assert!((got.density / density - 1.0).abs() < 1.2e-3, "{temperature} {humidity} {got:?}");
        }
    }

    #[test]
    fn it_changes_smoothly_from_dry_to_wet() {
        let at = |h: f64| GasState { humidity: Some(h), ..GasState::default() }.fluid().unwrap();
        let dry = GasState::default().fluid().unwrap();
        assert_eq!(at(0.0), dry);
        let little = at(1e-9);
        assert!((little.density / dry.density - 1.0).abs() < 1e-10);
        assert!((little.mean_free_path / dry.mean_free_path - 1.0).abs() < 1e-9);
        // by the density: the same state
        let half = at(0.5);
        let back =
            GasState { humidity: Some(0.5), density: Some(half.density), ..GasState::default() }.fluid().unwrap();
        assert!((back.mean_free_path / half.mean_free_path - 1.0).abs() < 1e-12 && back.viscosity == half.viscosity);
    }
}
