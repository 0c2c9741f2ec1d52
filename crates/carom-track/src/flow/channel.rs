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

use super::piece::{Exit, Layers, Piece, along, soonest};
use super::profile::{Section, Shape, WallTurbulence, wall_layers};
use super::{FlowError, Fluid, Local, Profile};
use crate::geometry::Path;

/// Fully developed flow between two plates.
#[derive(Clone, Copy, Debug)]
pub struct Channel {
    shape: Shape,
    friction_velocity: f64,
    height: f64,
    mean_speed: f64,
    reynolds: f64,
    layers: Layers,
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
        let layers = match &shape {
            // a plug goes on beyond the walls
            Shape::Plug => Layers::new([]),
            Shape::Laminar => Layers::new([0.0, height]),
            Shape::Turbulent(_) => {
                let low = wall_layers(0.5 * height, friction_velocity, nu);
                let high = low.iter().rev().map(|y| height - y);
                let edges = [0.0].into_iter().chain(low.iter().copied()).chain([0.5 * height]);
                Layers::new(edges.chain(high).chain([height]))
            }
        };
        Ok(Self { shape, friction_velocity, height, mean_speed, reynolds, layers })
    }

    /// Height of the middle, where it is fastest, m.
    pub(super) fn middle(&self) -> f64 {
        0.5 * self.height
    }

    /// U h/ν.
    pub fn reynolds(&self) -> f64 {
        self.reynolds
    }

    /// √(τ_w/ρ), m/s: exact for laminar flow, Dean's for turbulent flow, 0 for a plug.
    pub fn friction_velocity(&self) -> f64 {
        self.friction_velocity
    }

    /// The piece of a point: one of the layers from wall to wall, or beyond.
    pub fn piece(&self, x: [f64; 3]) -> Piece {
        Piece::layer(self.layers.of(x[1]))
    }

    /// Where a path leaves a piece.
    #[inline(always)]
    pub fn exit(&self, piece: Piece, path: &Path) -> Option<Exit> {
        let (start, change) = along(path, 1);
        self.layers.exit(piece.index(), start, &change)
    }

    /// Lower and upper edge of a piece.
    #[inline(always)]
    pub(super) fn bounds(&self, piece: Piece) -> [f64; 2] {
        self.layers.bounds(piece.index())
    }

    /// How soon a straight path at `v` leaves a piece, s.
    #[inline(always)]
    pub fn soonest(&self, piece: Piece, x: [f64; 3], v: [f64; 3]) -> f64 {
        soonest(x[1], v[1], self.bounds(piece))
    }

    /// Whether the flow is one piece.
    pub fn is_one_piece(&self) -> bool {
        self.layers.edges().is_empty()
    }

    /// Whether a place counts as the lower wall's: the formula of a turbulent profile is that of the piece's half.
    #[inline(always)]
    fn is_lower(&self, piece: Piece, y: f64) -> bool {
        match &self.shape {
            Shape::Turbulent(_) => 2 * piece.index() <= self.layers.edges().len(),
            // symmetric: the nearer wall's distance gives the same parabola
            Shape::Plug | Shape::Laminar => y <= self.height - y,
        }
    }

    /// Distance from the wall a place counts as of, m, no further than its formula goes; negative beyond the wall.
    #[inline(always)]
    fn wall_distance(&self, piece: Piece, y: f64) -> f64 {
        let d = if self.is_lower(piece, y) { y } else { self.height - y };
        d.min(0.75 * self.height)
    }

    #[inline(always)]
    fn is_inside(&self, piece: Piece) -> bool {
        piece.0[0].wrapping_sub(1) < (self.layers.edges().len() as u32).saturating_sub(1)
    }

    #[inline(always)]
    fn laminar(&self, d: f64) -> f64 {
        let s = d / self.height;
        6.0 * self.mean_speed * s * (1.0 - s)
    }

    /// Velocity at `x`, m/s.
    #[inline(always)]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        let mut u = [0.0];
        self.velocities(&[self.piece(x)], &[x[1]], &mut u);
        [u[0], 0.0, 0.0]
    }

    /// Streamwise velocity at `N` heights, by the formulas of pieces.
    #[inline(always)]
    pub(super) fn velocities<const N: usize>(&self, pieces: &[Piece; N], y: &[f64; N], u: &mut [f64; N]) {
        let mut d = [0.0; N];
        for ((d, y), piece) in d.iter_mut().zip(y).zip(pieces) {
            *d = self.wall_distance(*piece, *y);
        }
        match &self.shape {
            Shape::Plug => return *u = [self.mean_speed; N],
            Shape::Laminar => {
                for (u, d) in u.iter_mut().zip(d) {
                    *u = self.laminar(d);
                }
            }
            Shape::Turbulent(wall) => {
                for (u, d) in u.iter_mut().zip(d) {
                    *u = wall.velocity(d);
                }
            }
        }
        for (u, piece) in u.iter_mut().zip(pieces) {
            *u = if self.is_inside(*piece) { *u } else { 0.0 };
        }
    }

    /// Everything known at `x`.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        self.sample_in(self.piece(x), x)
    }

    /// Everything known at `x`, by the formulas of a piece.
    #[inline(always)]
    pub fn sample_in(&self, piece: Piece, x: [f64; 3]) -> Local {
        let d = self.wall_distance(piece, x[1]);
        let side = if self.is_lower(piece, x[1]) { 1.0 } else { -1.0 };
        let inside = self.is_inside(piece);
        let slope = match &self.shape {
            Shape::Laminar if inside => 6.0 * self.mean_speed / self.height * (1.0 - 2.0 * d / self.height),
            Shape::Turbulent(wall) if inside => wall.slope(d),
            _ => 0.0,
        };
        let y = d.max(0.0);
        let (k, epsilon) = if let Shape::Turbulent(wall) = &self.shape { wall.turbulence(y) } else { (0.0, 0.0) };
        let mut u = [0.0];
        self.velocities(&[piece], &[x[1]], &mut u);
        let mut local = Local::uniform([u[0], 0.0, 0.0]);
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
            channel.velocities(&y.map(|y| channel.piece([0.0, y, 0.0])), &y, &mut u);
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
