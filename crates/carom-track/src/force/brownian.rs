//! Brownian motion, exact in distribution over a step of any length.
//!
//! A sphere of mass m under a drag at the rate β (1/s) in a fluid of temperature T obeys Langevin's equation
//!
//! dv = β(w − v) dt + √(2β k_B T/m) dW,  dx = v dt,
//!
//! with w = u + g′/β (m/s), the fluid's velocity and the drift in it by weight and other slow forces. Over a step h the pair
//! (x, v) is Gaussian about its motion without noise (Chandrasekhar 1943, Rev. Mod. Phys. 15, 1, doi:10.1103/RevModPhys.15.1;
//! Ermak & Buckholz 1980, J. Comput. Phys. 35, 169, doi:10.1016/0021-9991(80)90084-4): with z = βh and E = e^{−z},
//!
//! Var v = (k_B T/m)(1 − E²),  Cov(x, v) = (k_B T/m)(1 − E)²/β,  Var x = (k_B T/m)(2z − 3 + 4E − E²)/β².
//!
//! From these follows how both are drawn from two independent standard normal deviates ζ₁, ζ₂ a component:
//!
//! v = √(k_B T/m) √(1 − E²) ζ₁,  x = tanh(z/2) v/β + √(k_B T/m) √(2z − 4 tanh(z/2)) ζ₂/β.
//!
//! The last root, the spread of x given v, is what loses its digits first where z is small (it is z³/6 there): a series
//! then. Displacements spread as Einstein says, D = k_B T/(mβ) = k_B T C_c/(3π μ d), and velocities as k_B T/m, for **any** step. Where the
//! fluid's mass moves with the sphere (added mass), m is the sum of both and D is the same.
//!
//! ```
//! use carom_track::{flow::Fluid, force::{Sphere, brownian}};
//! let (air, sphere) = (Fluid::default(), Sphere { diameter: 1e-7, density: 1000.0 });
//! // 0.1 µm in air: 6.9e-10 m²/s (Hinds 1999, table 7.1)
//! assert!((brownian::diffusivity(&air, &sphere, 2.9) / 6.9e-10 - 1.0).abs() < 0.03);
//! ```

mod relaxation;

pub use relaxation::Relaxation;

use super::Sphere;
use crate::flow::Fluid;
use std::f64::consts::PI;

/// Boltzmann's constant, J/K (exact in the SI).
pub const BOLTZMANN: f64 = 1.380_649e-23;

/// D = k_B T C_c/(3π μ d), m²/s.
pub fn diffusivity(fluid: &Fluid, sphere: &Sphere, slip: f64) -> f64 {
    BOLTZMANN * fluid.temperature * slip / (3.0 * PI * fluid.viscosity * sphere.diameter)
}

/// √(k_B T/m), m/s: the standard deviation of each component of a sphere's velocity.
pub fn thermal_speed(fluid: &Fluid, sphere: &Sphere) -> f64 {
    (BOLTZMANN * fluid.temperature / sphere.mass()).sqrt()
}

/// How the noise of a step spreads velocity and place, for a thermal speed and a drag rate of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Standard deviation of the velocity, over √(k_B T/m).
    pub velocity: f64,
    /// What of the place follows from the velocity: x = `along` · v/β.
    pub along: f64,
    /// Standard deviation of the rest of the place, over √(k_B T/m)/β.
    pub place: f64,
}

impl Spread {
    /// Of a step.
    #[inline(always)]
    pub fn of(relaxation: &Relaxation) -> Self {
        let Relaxation { z, decay, phi } = *relaxation;
        let lost = z * phi[0];
        let along = lost / (1.0 + decay);
        let rest = if z < SMALL { less_its_tanh(0.5 * z) } else { 0.5 * z - along };
        Self { velocity: (lost * (1.0 + decay)).sqrt(), along, place: 2.0 * rest.sqrt() }
    }

    /// Standard deviation of the place, over √(k_B T/m)/β.
    #[inline(always)]
    pub fn total(&self) -> f64 {
        let with = self.along * self.velocity;
        (with * with + self.place * self.place).sqrt()
    }

    /// Changes of place and velocity, over √(k_B T/m)/β and √(k_B T/m), from two standard normal deviates.
    #[inline(always)]
    pub fn draw(&self, first: f64, second: f64) -> (f64, f64) {
        let velocity = self.velocity * first;
        (self.along * velocity + self.place * second, velocity)
    }
}

/// Steps, over the relaxation time, below which y − tanh y comes from its series: at this z the plain difference keeps 14 digits.
const SMALL: f64 = 0.5;

/// y − tanh y for |y| ≤ ¼, by Taylor's series of tanh.
#[inline(always)]
fn less_its_tanh(y: f64) -> f64 {
    const SERIES: [f64; 9] = [
        1.0 / 3.0,
        -2.0 / 15.0,
        17.0 / 315.0,
        -62.0 / 2835.0,
        1382.0 / 155_925.0,
        -21844.0 / 6_081_075.0,
        929_569.0 / 638_512_875.0,
        -6_404_582.0 / 10_854_718_875.0,
        443_861_162.0 / 1_856_156_927_625.0,
    ];
    let square = y * y;
    y * square * SERIES.iter().rev().fold(0.0, |sum, c| sum * square + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the moments as printed in the sheet, in wider arithmetic: each as a series in z with exact integer factorials.
    fn moments(z: f64) -> [f64; 3] {
        let term = |n: u32| (1..=n).fold(1.0, |t, i| t * z / f64::from(i));
        let sum = |c: &dyn Fn(u32) -> f64| {
            (1..60).map(|n| if n % 2 == 0 { term(n) * c(n) } else { -term(n) * c(n) }).sum::<f64>()
        };
        let power = |n: u32| 2f64.powi(n as i32);
        // 1 − E², (1 − E)², 2z − 3 + 4E − E²: the first terms of the last cancel exactly
        let v = -sum(&|n| power(n));
        let c = sum(&|n| power(n) - 2.0);
        let x = sum(&|n| if n < 3 { 0.0 } else { 4.0 - power(n) });
        [v, c, x]
    }

    #[test]
    fn the_draws_have_the_moments_of_the_ornstein_uhlenbeck_process() {
        for z in [1e-9, 1e-5, 1e-3, 0.1, 0.49999, 0.5, 0.50001, 1.0, 3.0] {
            let s = Spread::of(&Relaxation::over(z));
            let [v, c, x] = moments(z);
            assert!((s.velocity * s.velocity / v - 1.0).abs() < 1e-13, "{z}: {s:?}");
            assert!((s.along * s.velocity * s.velocity / c - 1.0).abs() < 1e-12, "{z}: {s:?}");
            let var = s.total() * s.total();
            assert!((var / x - 1.0).abs() < 1e-11, "{z}: {var} {x}");
        }
        // z³/6 is all of the spread of x given v where z is small; a quarter of Var x = 2z³/3
        let s = Spread::of(&Relaxation::over(1e-8));
        assert!((s.place * s.place / (1e-24 / 6.0) - 1.0).abs() < 1e-12);
        // far beyond: independent, kT/m and 2Dh
        let s = Spread::of(&Relaxation::over(1e9));
        assert_eq!((s.velocity, s.along, s.place * s.place), (1.0, 1.0, (2.0 * (5e8f64 - 1.0).sqrt()).powi(2)));
    }

    #[test]
    fn einstein_and_the_thermal_speed_agree() {
        use crate::force::{Slip, relaxation_time};
        let air = Fluid::default();
        let sphere = Sphere { diameter: 2e-7, density: 1500.0 };
        let slip = Slip::Davies.factor(2e-7, air.mean_free_path);
        let v = thermal_speed(&air, &sphere);
        let d = v * v * relaxation_time(&air, &sphere, slip);
        assert!((d / diffusivity(&air, &sphere, slip) - 1.0).abs() < 1e-12);
    }
}
