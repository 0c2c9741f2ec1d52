//! DNV's recommended practice for sand in pipes (DNV RP-O501, Managing sand production and erosion, rev. 4.2, 2007; DNVGL-RP-O501, 2015):
//!
//! E = K Uⁿ F(α), F = 9.37α − 42.295α² + 110.864α³ − 175.804α⁴ + 170.137α⁵ − 98.398α⁶ + 31.211α⁷ − 4.17α⁸ (α in rad).
//!
//! | symbol | key | meaning | unit |
//! |---|---|---|---|
//! | K | `constant` | of the wall's material | (m/s)⁻ⁿ |
//! | n | `exponent` | of the speed | – |
//!
//! F is of ductile walls, 1 at its greatest (36°) and 0.57 at normal impact. Materials (`material`): `steel` and `titanium` 2e-9, 2.6;
//! `epoxy-laminate` 0.3e-9, 3.6; `vinyl-ester-laminate` 0.6e-9, 3.6. For quartz sand of 20 µm to 5 mm up to 200 m/s.
//!
//! ```
//! use carom::erosion::{Erosion, Hit};
//! let law = Erosion::new("dnv", Some("steel"), &[]).expect("a law");
//! let lost = law.mass(&Hit::new(1.0, 1e-4, 1.0, std::f64::consts::FRAC_PI_2));
//! assert!((lost / (2e-9 * 0.56851) - 1.0).abs() < 1e-4);
//! ```

use super::{Blow, Key, Known, Law, Unit};
use crate::math::pow;

/// DNV's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dnv {
    constant: f64,
    exponent: f64,
}

/// Of α to α⁸.
const ANGLE: [f64; 8] = [9.37, -42.295, 110.864, -175.804, 170.137, -98.398, 31.211, -4.17];

/// a₁α + a₂α² + …
pub(super) fn polynomial(coefficients: &[f64], angle: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| (sum + c) * angle)
}

impl Law for Dnv {
    const NAME: &'static str = "dnv";
    const ABOUT: &'static str = "sand in pipes (DNV RP-O501)";
    const KEYS: &'static [Key] = &[
        Key {
            name: "constant",
            unit: Unit::Number,
            default: None,
            range: [1e-14, 1e-4],
            about: "the material's constant for speeds in m/s",
            example: "2e-9",
        },
        Key {
            name: "exponent",
            unit: Unit::Number,
            default: None,
            range: [1.0, 5.0],
            about: "the exponent of the speed",
            example: "2.6",
        },
    ];
    const KNOWN: &'static [Known] = &[
        Known { name: "steel", values: &[("constant", 2e-9), ("exponent", 2.6)] },
        Known { name: "titanium", values: &[("constant", 2e-9), ("exponent", 2.6)] },
        Known { name: "epoxy-laminate", values: &[("constant", 0.3e-9), ("exponent", 3.6)] },
        Known { name: "vinyl-ester-laminate", values: &[("constant", 0.6e-9), ("exponent", 3.6)] },
    ];

    fn of(values: &[f64]) -> Self {
        let [constant, exponent] = *values else { return Self { constant: 0.0, exponent: 1.0 } };
        Self { constant, exponent }
    }

    fn ratio(&self, blow: &Blow) -> f64 {
        self.constant * pow(blow.speed, self.exponent) * polynomial(&ANGLE, blow.angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angles_function_is_one_at_its_greatest() {
        let f = |degrees: i32| polynomial(&ANGLE, f64::from(degrees).to_radians());
        let (most, at) = (0..=90).map(|d| (f(d), d)).fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
        assert!((most - 1.0).abs() < 2e-3 && at == 36, "{most} {at}");
        // worked out apart
        for (degrees, want) in [(15, 0.897_731_514_833), (30, 0.992_543_275_736), (90, 0.568_510_726_241)] {
            assert!((f(degrees) - want).abs() < 1e-10, "{degrees}");
        }
    }
}
