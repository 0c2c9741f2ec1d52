//! The Erosion/Corrosion Research Center's law, Tulsa (Zhang, Reuterfors, McLaury, Shirazi & Rybicki 2007, Wear 263, 330–338,
//! doi:10.1016/j.wear.2006.12.048):
//!
//! E = C B^−0.59 F_s Uⁿ F(α), F = 5.40α − 10.11α² + 10.93α³ − 6.33α⁴ + 1.42α⁵ (α in rad).
//!
//! | symbol | key | meaning | unit |
//! |---|---|---|---|
//! | B | `brinell` | Brinell's hardness of the wall | – |
//! | F_s | `sharpness` | 1 sharp, 0.53 half rounded, 0.2 round grains; 0.2, since these are spheres | – |
//! | C | `constant` | 2.17e-7 for speeds in m/s | (m/s)⁻ⁿ |
//! | n | `exponent` | 2.41 | – |
//!
//! Sand on steels and nickel alloys, dry. F is greatest at 50° (1.32) and 0.94 at normal impact. C, n and F_s = 0.2 are those that
//! COMSOL's manual of particle tracing has as well.
//!
//! ```
//! use carom::erosion::{Erosion, Hit};
//! let law = Erosion::new("e-crc", None, &[("brinell", 160.0), ("sharpness", 1.0)]).expect("a law");
//! let lost = law.mass(&Hit::new(1.0, 1e-4, 20.0, 90f64.to_radians()));
//! let want = 2.17e-7 * 160f64.powf(-0.59) * 20f64.powf(2.41) * 0.941_352;
//! assert!((lost / want - 1.0).abs() < 1e-5);
//! ```

use super::dnv::polynomial;
use super::{Blow, Key, Known, Law, Unit};
use crate::math::pow;

/// The E/CRC's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ECrc {
    /// C B^−0.59 F_s.
    strength: f64,
    exponent: f64,
}

/// Of α to α⁵.
const ANGLE: [f64; 5] = [5.40, -10.11, 10.93, -6.33, 1.42];

impl Law for ECrc {
    const NAME: &'static str = "e-crc";
    const ABOUT: &'static str = "sand on steels (Zhang & others 2007, Erosion/Corrosion Research Center)";
    const KEYS: &'static [Key] = &[
        Key {
            name: "brinell",
            unit: Unit::Number,
            default: None,
            range: [1.0, 2000.0],
            about: "Brinell's hardness of the wall",
            example: "160",
        },
        Key {
            name: "sharpness",
            unit: Unit::Number,
            default: Some(0.2),
            range: [0.0, 1.0],
            about: "1 for sharp, 0.53 for half rounded, 0.2 for round grains",
            example: "0.2",
        },
        Key {
            name: "constant",
            unit: Unit::Number,
            default: Some(2.17e-7),
            range: [1e-12, 1e-2],
            about: "the law's constant for speeds in m/s",
            example: "2.17e-7",
        },
        Key {
            name: "exponent",
            unit: Unit::Number,
            default: Some(2.41),
            range: [1.0, 5.0],
            about: "the exponent of the speed",
            example: "2.41",
        },
    ];
    const KNOWN: &'static [Known] = &[];

    fn of(values: &[f64]) -> Self {
        let [brinell, sharpness, constant, exponent] = *values else { return Self { strength: 0.0, exponent: 1.0 } };
        Self { strength: constant * sharpness * pow(brinell, -0.59), exponent }
    }

    fn ratio(&self, blow: &Blow) -> f64 {
        self.strength * pow(blow.speed, self.exponent) * polynomial(&ANGLE, blow.angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angles_function() {
        let f = |degrees: i32| polynomial(&ANGLE, f64::from(degrees).to_radians());
        let (most, at) = (0..=90).map(|d| (f(d), d)).fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
        assert!((most - 1.324_545).abs() < 1e-6 && at == 50, "{most} {at}");
        for (degrees, want) in [(15, 0.888_920_743_17), (30, 1.204_806_474_157), (90, 0.941_352_427_418)] {
            assert!((f(degrees) - want).abs() < 1e-10, "{degrees}");
        }
    }
}
