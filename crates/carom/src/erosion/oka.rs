//! Oka's law (Oka, Okamura & Yoshida 2005, Wear 259, 95–101, doi:10.1016/j.wear.2005.01.039; Oka & Yoshida 2005, 102–109,
//! doi:10.1016/j.wear.2005.01.040):
//!
//! E = E₉₀ g(α) (U/U′)^k₂ (d/d′)^k₃, g = (sin α)^n₁ (1 + H (1 − sin α))^n₂.
//!
//! | symbol | key | meaning | unit |
//! |---|---|---|---|
//! | E₉₀ | `reference_ratio` | mass of wall over mass of grains at normal impact, U′ and d′ | – |
//! | H | `hardness` | Vickers' hardness of the wall, in GPa in g | Pa |
//! | n₁, n₂ | `n1`, `n2` | of the angle | – |
//! | k₂, k₃ | `speed_exponent`, `diameter_exponent` | of speed and diameter | – |
//! | U′, d′ | `reference_speed`, `reference_diameter` | 104 m/s, 326 µm | m/s, m |
//!
//! `material = "sand-on-steel"`: the example of Ansys Fluent's Theory Guide (table 12.3): E₉₀ = 6.154e-4, H = 1.8 GPa, n₁ = 0.8, n₂ = 1.3, k₂ = 2.35,
//! k₃ = 0.19. Oka's own rules for n₁, n₂ and k₂ by hardness are not in here: they could not be checked against the source. So a
//! wall of another hardness wants all of its own numbers.
//!
//! ```
//! use carom::erosion::{Erosion, Hit};
//! let law = Erosion::new("oka", Some("sand-on-steel"), &[]).expect("a law");
//! let lost = law.mass(&Hit::new(1.0, 326e-6, 104.0, 90f64.to_radians()));
//! assert!((lost / 6.154e-4 - 1.0).abs() < 1e-12);
//! ```

use super::{Blow, Key, Known, Law, Unit};
use crate::math::pow;

/// Oka's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oka {
    ratio: f64,
    /// GPa.
    hardness: f64,
    angle: [f64; 2],
    exponents: [f64; 2],
    /// 1/U′ and 1/d′.
    per_reference: [f64; 2],
}

const fn number(
    name: &'static str,
    default: Option<f64>,
    range: [f64; 2],
    about: &'static str,
    example: &'static str,
) -> Key {
    Key { name, unit: Unit::Number, default, range, about, example }
}

impl Law for Oka {
    const NAME: &'static str = "oka";
    const ABOUT: &'static str = "grains on metals by hardness (Oka & others 2005)";
    const KEYS: &'static [Key] = &[
        number(
            "reference_ratio",
            None,
            [1e-9, 1.0],
            "the mass lost over the mass of grains at the reference",
            "6.154e-4",
        ),
        Key {
            name: "hardness",
            unit: Unit::Pressure,
            default: None,
            range: [1e7, 2e11],
            about: "Vickers' hardness of the wall",
            example: "\"1.8 GPa\"",
        },
        number("n1", None, [0.0, 10.0], "the exponent of sin α", "0.8"),
        number("n2", None, [0.0, 20.0], "the exponent of 1 + H (1 − sin α)", "1.3"),
        number("speed_exponent", None, [1.0, 5.0], "the exponent of the speed", "2.35"),
        number("diameter_exponent", Some(0.19), [0.0, 2.0], "the exponent of the diameter", "0.19"),
        Key {
            name: "reference_speed",
            unit: Unit::Speed,
            default: Some(104.0),
            range: [0.1, 1e4],
            about: "the speed of the reference",
            example: "\"104 m/s\"",
        },
        Key {
            name: "reference_diameter",
            unit: Unit::Length,
            default: Some(326e-6),
            range: [1e-7, 1e-1],
            about: "the diameter of the reference",
            example: "\"326 um\"",
        },
    ];
    const KNOWN: &'static [Known] = &[Known {
        name: "sand-on-steel",
        values: &[
            ("reference_ratio", 6.154e-4),
            ("hardness", 1.8e9),
            ("n1", 0.8),
            ("n2", 1.3),
            ("speed_exponent", 2.35),
            ("diameter_exponent", 0.19),
        ],
    }];

    fn of(values: &[f64]) -> Self {
        let [ratio, hardness, n1, n2, k2, k3, speed, diameter] = *values else {
            return Self { ratio: 0.0, hardness: 1.0, angle: [1.0; 2], exponents: [1.0; 2], per_reference: [1.0; 2] };
        };
        let per_reference = [1.0 / speed, 1.0 / diameter];
        Self { ratio, hardness: hardness * 1e-9, angle: [n1, n2], exponents: [k2, k3], per_reference }
    }

    fn ratio(&self, blow: &Blow) -> f64 {
        // so small a sine takes nothing, and powers stay in their domain
        if blow.sine < 1e-100 {
            return 0.0;
        }
        let hard = 1.0 + self.hardness * (1.0 - blow.sine).max(0.0);
        let by_angle = pow(blow.sine, self.angle[0]) * pow(hard, self.angle[1]);
        let by_speed = pow(blow.speed * self.per_reference[0], self.exponents[0]);
        self.ratio * by_angle * by_speed * pow(blow.diameter * self.per_reference[1], self.exponents[1])
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Erosion, Hit};

    #[test]
    fn by_hand() {
        let law = Erosion::new("oka", Some("sand-on-steel"), &[]).unwrap();
        // 30°, 52 m/s, 163 µm
        let lost = law.mass(&Hit::new(2.0, 163e-6, 52.0, 30f64.to_radians()));
        let want = 2.0 * 6.154e-4 * 0.5f64.powf(0.8) * 1.9f64.powf(1.3) * 0.5f64.powf(2.35) * 0.5f64.powf(0.19);
        assert!((lost / want - 1.0).abs() < 1e-12, "{lost} {want}");
    }
}
