//! Finnie's micro-cutting of ductile metals (1960, Wear 3, 87–103, doi:10.1016/0043-1648(60)90055-7): a sharp grain cuts a chip until it
//! comes to rest along the surface or leaves it.
//!
//! V/m = U²/(p ψ K) · (sin 2α − (6/K) sin² α) for tan α ≤ K/6, (K/6) cos² α beyond; E = ρ_w V/m.
//!
//! | symbol | key | meaning | unit |
//! |---|---|---|---|
//! | ρ_w | `density` | of the wall | kg/m³ |
//! | p | `flow_stress` | plastic flow stress of the wall | Pa |
//! | ψ | `chip_ratio` | length of contact over depth of cut, 2 | – |
//! | K | `force_ratio` | normal over tangential force, 2 | – |
//!
//! Every grain is taken to cut. COMSOL's form has the fraction that does, a tenth unless told otherwise: a ten times larger `flow_stress` says
//! the same. For small angles: at normal impact it gives nothing, and metals do lose there. Both pieces as OpenFOAM's `ParticleErosion` has them (after Finnie & McFadden 1978,
//! Wear 48, 181–190, doi:10.1016/0043-1648(78)90147-3); they meet at tan α = K/6 in value and, for the greatest loss, in slope.
//!
//! ```
//! use carom::erosion::{Erosion, Hit};
//! let law = Erosion::new("finnie", None, &[("density", 7800.0), ("flow_stress", 1e9)]).expect("a law");
//! // 30 m/s at 60°: 7800 · 900/(4e9) · cos² 60°/3
//! let lost = law.mass(&Hit::new(1.0, 1e-4, 30.0, 60f64.to_radians()));
//! assert!((lost / (7800.0 * 900.0 / 4e9 / 12.0) - 1.0).abs() < 1e-12);
//! ```

use super::{Blow, Key, Known, Law, Unit};

/// Finnie's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finnie {
    /// ρ_w/(p ψ K), s²/m².
    strength: f64,
    /// K.
    ratio: f64,
}

impl Law for Finnie {
    const NAME: &'static str = "finnie";
    const ABOUT: &'static str = "micro-cutting of ductile metals (Finnie 1960)";
    const KEYS: &'static [Key] = &[
        Key {
            name: "density",
            unit: Unit::Density,
            default: None,
            range: [100.0, 3e4],
            about: "the wall's density",
            example: "\"7800 kg/m3\"",
        },
        Key {
            name: "flow_stress",
            unit: Unit::Pressure,
            default: None,
            range: [1e5, 1e12],
            about: "the wall's plastic flow stress",
            example: "\"1 GPa\"",
        },
        Key {
            name: "chip_ratio",
            unit: Unit::Number,
            default: Some(2.0),
            range: [0.1, 100.0],
            about: "length of contact over depth of cut",
            example: "2",
        },
        Key {
            name: "force_ratio",
            unit: Unit::Number,
            default: Some(2.0),
            range: [0.1, 100.0],
            about: "normal over tangential force",
            example: "2",
        },
    ];
    const KNOWN: &'static [Known] = &[];

    fn of(values: &[f64]) -> Self {
        let [density, stress, chip, ratio] = *values else { return Self { strength: 0.0, ratio: 2.0 } };
        Self { strength: density / (stress * chip * ratio), ratio }
    }

    fn ratio(&self, blow: &Blow) -> f64 {
        let Blow { speed, sine, cosine, .. } = *blow;
        let shallow = sine * 6.0 <= self.ratio * cosine;
        let share = if shallow {
            2.0 * sine * cosine - 6.0 / self.ratio * sine * sine
        } else {
            self.ratio / 6.0 * cosine * cosine
        };
        self.strength * speed * speed * share
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Erosion, Hit};

    #[test]
    fn the_pieces_meet_and_the_greatest_loss_is_finnies() {
        let law = Erosion::new("finnie", None, &[("density", 1000.0), ("flow_stress", 1e9)]).unwrap();
        let at = |tangent: f64| law.mass(&Hit { mass: 1.0, diameter: 1e-4, normal: tangent, tangential: 1.0 });
        assert!((at(1.0 / 3.0) / at(1.0 / 3.0 + 1e-9) - 1.0).abs() < 1e-8);
        // d/dα of sin 2α − 3 sin² α is 0 at tan 2α = 2/3: 16.85°
        let peak = (2.0f64 / 3.0).atan() / 2.0;
        let by = |a: f64| law.mass(&Hit::new(1.0, 1e-4, 10.0, a));
        assert!(by(peak) > by(peak - 1e-3) && by(peak) > by(peak + 1e-3));
        assert!((peak.to_degrees() - 16.845).abs() < 1e-3);
        assert!(by(std::f64::consts::FRAC_PI_2) < 1e-20);
    }
}
