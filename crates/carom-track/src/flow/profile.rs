//! Mean velocity and turbulence of fully developed flow along a smooth wall.
//!
//! # Mean velocity
//! Reichardt 1951 (Z. angew. Math. Mech. 31, 208–219, doi:10.1002/zamm.19510310704), one formula from wall to axis:
//!
//! U⁺ = (1/κ) ln[(1 + κy⁺) · 1.5(1+η)/(1+2η²)] + 7.8 [1 − e^{−y⁺/11} − (y⁺/11) e^{−y⁺/3}], κ = 0.4,
//!
//! with y⁺ = y u_τ/ν, U⁺ = U/u_τ, δ the half height or the radius and η = 1 − y/δ the distance from the axis.
//! The friction velocity comes from a friction law; the profile is then multiplied by one factor so that its mean is
//! exactly the given one: 0.92 to 1.00 in a channel at 4e3 < Re < 4e5, 0.97 to 0.99 in a pipe, by which the slope at the
//! wall falls short of u_τ²/ν. The mean of U⁺ is a closed form.
//!
//! # Turbulence
//! k⁺ = 4.78 e^{−2y/δ} (1 − e^{−y⁺/22})² + 0.125 y⁺² e^{−2y⁺/15}  and  ε⁺ = e^{−y/δ} / (κ (y⁺⁴ + 15⁴)^{1/4})
//!
//! with k⁺ = k/u_τ², ε⁺ = εν/u_τ⁴. The factor 4.78 e^{−2y/δ} is Nezu & Nakagawa 1993 (Turbulence in Open-Channel Flows,
//! Balkema) and 1/(κy⁺) the log layer's balance of production and dissipation; the rest is this crate's fit to direct
//! simulations of channels at δ⁺ = 180, 550 and 2000 (del Álamo & others 2004, J. Fluid Mech. 500, 135–144,
//! doi:10.1017/S002211200300733X; Hoyas & Jiménez 2008, Phys. Fluids 20, 101511, doi:10.1063/1.3005862). Against those, k is
//! right within 12 % rms and 35 % at worst, ε within 35 % below y⁺ = 15 and 15 % beyond: k⁺ grows slowly with δ⁺, the fit
//! does not. U⁺ lies within 1 % of the simulations at y⁺ = 15 and 5 to 7 % above them at y⁺ > 100. Use a table for better.

use carom::math::{exp, ln};

/// Shape of the mean velocity across a channel or a pipe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// The mean speed everywhere: no boundary layer.
    Plug,
    /// Poiseuille's parabola.
    Laminar,
    /// Mean profile of turbulent flow along a smooth wall.
    Turbulent,
}

const KARMAN: f64 = 0.4;
const WAKE: f64 = 1.5;
const SUBLAYER: f64 = 7.8;
const A: f64 = 11.0;
const B: f64 = 3.0;

/// A fully developed turbulent wall layer that reaches from a wall to the axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallTurbulence {
    /// Friction velocity u_τ, m/s.
    pub friction_velocity: f64,
    /// Distance from the wall to the axis, m.
    half: f64,
    /// u_τ/ν, 1/m.
    per_wall_unit: f64,
    /// Velocity per U⁺, m/s: u_τ times the factor that makes the mean exact.
    speed: f64,
    viscosity: f64,
    /// dU/dy at the wall, 1/s.
    wall_slope: f64,
}

/// A profile with what it takes to evaluate it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    Plug,
    Laminar,
    Turbulent(WallTurbulence),
}

/// Which cross-section the mean is taken over.
#[derive(Clone, Copy)]
pub(super) enum Section {
    Plane,
    Round,
}

impl WallTurbulence {
    pub fn new(section: Section, half: f64, mean_speed: f64, friction_velocity: f64, kinematic_viscosity: f64) -> Self {
        let per_wall_unit = friction_velocity / kinematic_viscosity;
        let mean = mean_u_plus(section, half * per_wall_unit);
        let speed = mean_speed / mean;
        let viscosity = kinematic_viscosity;
        let wall = Self { friction_velocity, half, per_wall_unit, speed, viscosity, wall_slope: 0.0 };
        Self { wall_slope: wall.slope(0.0), ..wall }
    }

    /// What the profile was multiplied by to make its mean exact.
    #[cfg(test)]
    pub fn scale(&self) -> f64 {
        self.speed / self.friction_velocity
    }

    /// Mean velocity at the distance `y` from the wall (0 ≤ y ≤ half), m/s. Beyond the wall the tangent goes on, and beyond the axis
    /// the formula, to y = 1.5 half.
    #[inline(always)]
    pub fn velocity(&self, y: f64) -> f64 {
        let beyond = y.min(0.0) * self.wall_slope;
        self.inner(y.max(0.0)) + beyond
    }

    #[inline(always)]
    fn inner(&self, y: f64) -> f64 {
        let (y_plus, eta) = (y * self.per_wall_unit, 1.0 - y / self.half);
        let core = (1.0 + KARMAN * y_plus) * (WAKE * (1.0 + eta)) / (1.0 + 2.0 * eta * eta);
        let wall = 1.0 - exp(-y_plus / A) - y_plus / A * exp(-y_plus / B);
        self.speed * (ln(core) * (1.0 / KARMAN) + SUBLAYER * wall)
    }

    /// dU/dy at the distance `y` from the wall, 1/s.
    #[inline(always)]
    pub fn slope(&self, y: f64) -> f64 {
        let y = y.max(0.0);
        let (y_plus, eta) = (y * self.per_wall_unit, 1.0 - y / self.half);
        let half_plus = self.half * self.per_wall_unit;
        let core = 1.0 / (1.0 + KARMAN * y_plus)
            - (1.0 / (1.0 + eta) - 4.0 * eta / (1.0 + 2.0 * eta * eta)) / (KARMAN * half_plus);
        let wall = (exp(-y_plus / A) - (1.0 - y_plus / B) * exp(-y_plus / B)) / A;
        self.speed * self.per_wall_unit * (core + SUBLAYER * wall)
    }

    /// Turbulent kinetic energy (m²/s²) and its dissipation rate (m²/s³) at the distance `y` from the wall.
    #[inline(always)]
    pub fn turbulence(&self, y: f64) -> (f64, f64) {
        let (y_plus, outer) = (y * self.per_wall_unit, exp(-y / self.half));
        let damping = 1.0 - exp(-y_plus / 22.0);
        let u2 = self.friction_velocity * self.friction_velocity;
        let y2 = y_plus * y_plus;
        let length = (y2 * y2 + 50_625.0).sqrt().sqrt();
        let k_plus = 4.78 * outer * outer * damping * damping + 0.125 * y2 * exp(-y_plus / 7.5);
        (u2 * k_plus, u2 * u2 / self.viscosity * outer / (KARMAN * length))
    }
}

/// Distances from a wall, m, between which a turbulent profile has one scale each: 5 wall units, then four times as many, to the
/// axis (which is left out).
pub(super) fn wall_layers(half: f64, friction_velocity: f64, kinematic_viscosity: f64) -> Vec<f64> {
    let first = 5.0 * kinematic_viscosity / friction_velocity;
    let layers = std::iter::successors(Some(first), |y| Some(4.0 * y));
    layers.take(MOST_LAYERS).take_while(|y| *y < 0.75 * half).collect()
}

/// Layers are counted so far from a wall: beyond, no channel or pipe of a published friction law reaches.
const MOST_LAYERS: usize = 10;

/// Mean of U⁺ over the cross-section for δ⁺ = `d`, in closed form.
fn mean_u_plus(section: Section, d: f64) -> f64 {
    // integrals from 0 to d of ln(1+κy), e^{−y/A} and y e^{−y/B}, and the same times y
    let log = ln(1.0 + KARMAN * d);
    let log0 = (1.0 + KARMAN * d) / KARMAN * log - d;
    let a0 = A * (1.0 - exp(-d / A));
    let b1 = B * B * (1.0 - exp(-d / B) * (1.0 + d / B));
    let wall0 = d - a0 - b1 / A;
    let sqrt2 = std::f64::consts::SQRT_2;
    match section {
        Section::Plane => {
            // ∫₀¹ ln[1.5(1+η)/(1+2η²)] dη
            let core = ln(WAKE) + 2.0 * std::f64::consts::LN_2 + 1.0 - ln(3.0) - sqrt2 * ATAN_SQRT_2;
            (log0 / d + core) / KARMAN + SUBLAYER * wall0 / d
        }
        Section::Round => {
            let log1 = 0.5 * (d * d - 1.0 / (KARMAN * KARMAN)) * log - 0.25 * d * d + 0.5 * d / KARMAN;
            let a1 = A * A * (1.0 - exp(-d / A) * (1.0 + d / A));
            let s = d / B;
            let b2 = B * B * B * (2.0 - exp(-s) * (s * s + 2.0 * s + 2.0));
            let wall1 = 0.5 * d * d - a1 - b2 / A;
            // (2/d²) ∫ (d − y) f dy, and ∫₀¹ ln[1.5(1+η)/(1+2η²)] 2η dη
            let average = |f0: f64, f1: f64| 2.0 * (f0 / d - f1 / (d * d));
            let core = ln(WAKE) + 1.5 - 1.5 * ln(3.0);
            (average(log0, log1) + core) / KARMAN + SUBLAYER * average(wall0, wall1)
        }
    }
}

const ATAN_SQRT_2: f64 = 0.955_316_618_124_509_3;

#[cfg(test)]
mod tests {
    use super::*;

    /// Composite Gauss–Legendre (three points) of `f` from 0 to 1, refined towards 0.
    fn integral(f: impl Fn(f64) -> f64) -> f64 {
        let node = 0.6f64.sqrt();
        let n = 4000;
        let edge = |i: usize| (i as f64 / n as f64).powi(3);
        (0..n)
            .map(|i| {
                let (a, b) = (edge(i), edge(i + 1));
                let (m, h) = (0.5 * (a + b), 0.5 * (b - a));
                h / 9.0 * (5.0 * f(m - h * node) + 8.0 * f(m) + 5.0 * f(m + h * node))
            })
            .sum()
    }

    #[test]
    fn mean_is_exact() {
        for (half, u_tau) in [(0.015, 0.1), (0.5, 2.0), (0.001, 1.0)] {
            let plane = WallTurbulence::new(Section::Plane, half, 2.0, u_tau, 1.5e-5);
            let mean = integral(|s| plane.velocity(s * half));
            assert!((mean / 2.0 - 1.0).abs() < 1e-10, "plane {half} {mean}");
            let round = WallTurbulence::new(Section::Round, half, 3.0, u_tau, 1.5e-5);
            let mean = integral(|s| round.velocity(s * half) * 2.0 * (1.0 - s));
            assert!((mean / 3.0 - 1.0).abs() < 1e-10, "round {half} {mean}");
        }
    }

    #[test]
    fn slope_is_the_derivative_and_vanishes_on_the_axis() {
        let w = WallTurbulence::new(Section::Plane, 0.015, 2.0, 0.12, 1.5e-5);
        for y in [1e-5, 1e-4, 5e-4, 2e-3, 8e-3, 1.4e-2] {
            let h = 1e-4 * y;
            let want = (w.velocity(y + h) - w.velocity(y - h)) / (2.0 * h);
            assert!((w.slope(y) / want - 1.0).abs() < 1e-6, "{y} {} {want}", w.slope(y));
        }
        assert!(w.slope(0.015).abs() < 1e-3 * w.slope(0.0));
        // the wall shear of the unscaled profile is u_τ²/ν, up to the core factor's slope, 5/(6 κ δ⁺)
        let wall = w.slope(0.0) / (w.scale() * 0.12 * 0.12 / 1.5e-5);
        assert!((wall - 1.0 - 5.0 / (6.0 * 0.4 * 0.015 * 0.12 / 1.5e-5)).abs() < 1e-12, "{wall}");
    }

    #[test]
    fn log_layer_and_turbulence_limits() {
        // δ⁺ = 1e6: U⁺ = 2.5 ln y⁺ + 5.5 in the log layer (Nikuradse's constants), within 1 %
        let w = WallTurbulence::new(Section::Plane, 1.0, 1.0, 1.0, 1e-6);
        let u_plus = w.velocity(1e-3) / w.speed;
        assert!((u_plus / (2.5 * 1000.0f64.ln() + 5.5) - 1.0).abs() < 0.01, "{u_plus}");
        // viscous sublayer
        assert!((w.velocity(1e-6) / w.speed - 1.0).abs() < 0.06);
        let (k, epsilon) = w.turbulence(1e-8);
        assert!((k / 1e-4 - 0.1349).abs() < 1e-3, "k+ / y+^2 = {}", k / 1e-4);
        assert!((epsilon * 1e-6 - 1.0 / 6.0).abs() < 1e-6);
        let (_, epsilon) = w.turbulence(1e-3);
        assert!((epsilon * 1e-6 * 0.4 * 1000.0 - 1.0).abs() < 2e-3);
    }

    #[test]
    fn near_direct_simulation() {
        // Hoyas & Jiménez 2008, δ⁺ = 547: y⁺, U⁺, k⁺, ε⁺
        let simulated = [
            (5.0, 4.83, 1.944, 0.14596),
            (15.0, 10.64, 4.676, 0.12599),
            (30.0, 13.48, 4.202, 0.08063),
            (100.0, 16.51, 2.837, 0.02083),
            (218.7, 18.62, 2.016, 0.00788),
            (437.4, 20.67, 0.917, 0.00237),
        ];
        let w = WallTurbulence::new(Section::Plane, 546.7, 1.0, 1.0, 1.0);
        for (y, u, k, epsilon) in simulated {
            let got = w.turbulence(y);
            assert!((w.velocity(y) / w.speed / u - 1.0).abs() < 0.07, "U {y}");
            assert!((got.0 / k - 1.0).abs() < 0.16, "k {y} {}", got.0);
            assert!((got.1 / epsilon - 1.0).abs() < 0.15, "ε {y} {}", got.1);
        }
    }
}
