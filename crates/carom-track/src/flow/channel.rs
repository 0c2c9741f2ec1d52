//! Flow between two parallel plates, y = 0 and y = height, along +x.
//!
//! Laminar: u = 6 U (y/h)(1 − y/h), U the mean. Turbulent: the profile of a smooth wall from each side (see
//! [`Profile`]) with Dean's friction law, c_f = τ_w/(½ρU²) = 0.073 Re^{−1/4}, Re = U h/ν, u_τ = U √(c_f/2)
//! (Dean 1978, J. Fluids Eng. 100, 215–223, doi:10.1115/1.3448633; 6e3 < Re < 6e5, aspect ratio above 7).
//!
//! ```
//! use carom_track::flow::{Channel, Fluid, Profile};
//! let channel = Channel::new(Profile::Laminar, 0.03, 2.0, &Fluid::default())?;
//! assert_eq!(channel.velocity([0.0, 0.015, 0.0]), [3.0, 0.0, 0.0]);
//! # Ok::<(), carom_track::flow::FlowError>(())
//! ```

use super::profile::{Section, Shape, WallTurbulence};
use super::{FlowError, Fluid, Local, Profile};

/// Fully developed flow between two plates.
#[derive(Clone, Copy, Debug)]
pub struct Channel {
    shape: Shape,
    friction_velocity: f64,
    height: f64,
    mean_speed: f64,
    reynolds: f64,
}

impl Channel {
    /// A channel of a height (m) with a mean speed (m/s; negative flows towards −x).
    ///
    /// # Errors
    /// [`FlowError::Value`] for a height that is not positive, a mean speed that is not finite, an impossible fluid, or a
    /// turbulent profile of Re < 1000, far below where any channel is turbulent.
    pub fn new(profile: Profile, height: f64, mean_speed: f64, fluid: &Fluid) -> Result<Self, FlowError> {
        fluid.check()?;
        FlowError::positive("channel height", height)?;
        FlowError::finite("channel mean speed", mean_speed)?;
        let nu = fluid.kinematic_viscosity();
        let reynolds = mean_speed.abs() * height / nu;
        if profile == Profile::Turbulent && reynolds < 1000.0 {
            return Err(FlowError::value(
                "Reynolds number (mean speed, height)",
                reynolds,
                "above 1000 for a turbulent profile",
            ));
        }
        let friction_velocity = match profile {
            Profile::Plug => 0.0,
            Profile::Laminar => (6.0 * nu * mean_speed.abs() / height).sqrt(),
            // the fourth root as two square roots: the same bits everywhere
            Profile::Turbulent => mean_speed.abs() * (0.0365 / reynolds.sqrt().sqrt()).sqrt(),
        };
        let shape = match profile {
            Profile::Plug => Shape::Plug,
            Profile::Laminar => Shape::Laminar,
            Profile::Turbulent => {
                Shape::Turbulent(WallTurbulence::new(Section::Plane, 0.5 * height, mean_speed, friction_velocity, nu))
            }
        };
        Ok(Self { shape, friction_velocity, height, mean_speed, reynolds })
    }

    /// U h/ν.
    pub fn reynolds(&self) -> f64 {
        self.reynolds
    }

    /// √(τ_w/ρ), m/s: exact for laminar flow, Dean's for turbulent flow, 0 for a plug.
    pub fn friction_velocity(&self) -> f64 {
        self.friction_velocity
    }

    #[inline(always)]
    fn wall_distance(&self, y: f64) -> f64 {
        y.min(self.height - y).max(0.0)
    }

    #[inline(always)]
    fn laminar(&self, y: f64) -> f64 {
        let s = self.wall_distance(y) / self.height;
        6.0 * self.mean_speed * s * (1.0 - s)
    }

    /// Velocity at `x`, m/s.
    #[inline(always)]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        let u = match &self.shape {
            Shape::Plug => self.mean_speed,
            Shape::Laminar => self.laminar(x[1]),
            Shape::Turbulent(wall) => wall.velocity(self.wall_distance(x[1])),
        };
        [u, 0.0, 0.0]
    }

    /// Streamwise velocity at `N` heights.
    #[inline(always)]
    pub(super) fn velocities<const N: usize>(&self, y: &[f64; N], u: &mut [f64; N]) {
        match &self.shape {
            Shape::Plug => *u = [self.mean_speed; N],
            Shape::Laminar => {
                for (u, y) in u.iter_mut().zip(y) {
                    *u = self.laminar(*y);
                }
            }
            Shape::Turbulent(wall) => {
                for (u, y) in u.iter_mut().zip(y) {
                    *u = wall.velocity(self.wall_distance(*y));
                }
            }
        }
    }

    /// Everything known at `x`.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        let (low, high) = (x[1], self.height - x[1]);
        let y = self.wall_distance(x[1]);
        // +1 while the lower wall is nearer
        let side = if low <= high { 1.0 } else { -1.0 };
        let slope = match &self.shape {
            Shape::Plug => 0.0,
            Shape::Laminar => 6.0 * self.mean_speed / self.height * (1.0 - 2.0 * y / self.height),
            Shape::Turbulent(wall) => wall.slope(y),
        };
        let (k, epsilon) = if let Shape::Turbulent(wall) = &self.shape { wall.turbulence(y) } else { (0.0, 0.0) };
        let mut local = Local::uniform(self.velocity(x));
        local.gradient[0][1] = side * slope;
        Local {
            k,
            epsilon,
            wall_distance: y,
            wall_normal: [0.0, side, 0.0],
            friction_velocity: self.friction_velocity(),
            ..local
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn air_like() -> Fluid {
        Fluid { density: 1.0, viscosity: 1.5e-5, temperature: 297.15, mean_free_path: 0.0 }
    }

    fn mean(channel: &Channel, height: f64) -> f64 {
        let n = 20_000;
        let node = 0.6f64.sqrt();
        let h = height / n as f64;
        let at = |y: f64| channel.velocity([0.0, y, 0.0])[0];
        let sum: f64 = (0..n)
            .map(|i| {
                let m = (i as f64 + 0.5) * h;
                (5.0 * at(m - 0.5 * h * node) + 8.0 * at(m) + 5.0 * at(m + 0.5 * h * node)) / 18.0
            })
            .sum();
        sum / n as f64
    }

    #[test]
    fn every_profile_has_the_given_mean() {
        for profile in [Profile::Plug, Profile::Laminar, Profile::Turbulent] {
            let channel = Channel::new(profile, 0.03, 2.0, &air_like()).unwrap();
            let mean = mean(&channel, 0.03);
            assert!((mean / 2.0 - 1.0).abs() < 1e-9, "{profile:?} {mean}");
        }
    }

    #[test]
    fn friction_velocity_is_deans() {
        // Re = 4000: c_f = 0.073 · 4000^{−1/4} = 0.0091792…
        let channel = Channel::new(Profile::Turbulent, 0.03, 2.0, &air_like()).unwrap();
        assert!((channel.reynolds() - 4000.0).abs() < 1e-9);
        let c_f = 0.073 * 4000.0f64.powf(-0.25);
        assert!((channel.friction_velocity() - 2.0 * (0.5 * c_f).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn shape_is_deans() {
        // centreline over mean, Dean 1978: 1.28 Re^{−0.0116}; the profile's own factor stays near 1
        for (speed, tolerance) in [(3.0, 0.02), (10.0, 0.005), (40.0, 0.005), (200.0, 0.005)] {
            let channel = Channel::new(Profile::Turbulent, 0.03, speed, &air_like()).unwrap();
            let ratio = channel.velocity([0.0, 0.015, 0.0])[0] / speed;
            let dean = 1.28 * channel.reynolds().powf(-0.0116);
            assert!((ratio / dean - 1.0).abs() < tolerance, "{ratio} {dean}");
            let Shape::Turbulent(wall) = channel.shape else { unreachable!() };
            assert!((0.92..1.01).contains(&wall.scale()), "{}", wall.scale());
        }
    }

    #[test]
    fn symmetric_with_gradients_that_point_in() {
        for profile in [Profile::Laminar, Profile::Turbulent] {
            let channel = Channel::new(profile, 0.03, 2.0, &air_like()).unwrap();
            for y in [1e-4, 1e-3, 0.01] {
                let (a, b) = (channel.sample([0.0, y, 0.0]), channel.sample([1.0, 0.03 - y, 2.0]));
                assert!((a.velocity[0] - b.velocity[0]).abs() < 1e-12);
                assert!((a.gradient[0][1] + b.gradient[0][1]).abs() < 1e-9 * a.gradient[0][1]);
                let h = 1e-4 * y;
                let fd = (channel.velocity([0.0, y + h, 0.0])[0] - channel.velocity([0.0, y - h, 0.0])[0]) / (2.0 * h);
                assert!((a.gradient[0][1] / fd - 1.0).abs() < 1e-6);
                assert_eq!((a.wall_normal, b.wall_normal), ([0.0, 1.0, 0.0], [0.0, -1.0, 0.0]));
                assert_eq!(a.acceleration, [0.0; 3]);
            }
        }
    }

    #[test]
    fn columns_have_the_same_bits() {
        for profile in [Profile::Plug, Profile::Laminar, Profile::Turbulent] {
            let channel = Channel::new(profile, 0.03, -2.0, &air_like()).unwrap();
            let y = [-1e-3, 0.0, 1e-5, 3e-3, 0.015, 0.02, 0.03, 0.04];
            let mut u = [0.0; 8];
            channel.velocities(&y, &mut u);
            for (y, u) in y.into_iter().zip(u) {
                assert_eq!(channel.velocity([0.0, y, 0.0])[0].to_bits(), u.to_bits());
            }
        }
    }

    #[test]
    fn refuses_nonsense() {
        assert!(Channel::new(Profile::Plug, 0.0, 1.0, &air_like()).is_err());
        assert!(Channel::new(Profile::Plug, 1.0, f64::NAN, &air_like()).is_err());
        let error = Channel::new(Profile::Turbulent, 0.001, 1.0, &air_like()).unwrap_err().to_string();
        assert!(error.contains("66.6") && error.contains("above 1000"), "{error}");
    }
}
