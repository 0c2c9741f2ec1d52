//! Flow in a round pipe.
//!
//! Laminar: u = 2 U (1 − r²/R²), U the mean. Turbulent: the profile of a smooth wall (see [`Profile`]) with the
//! friction factor f = (0.790 ln Re − 1.64)^{−2}, Re = 2UR/ν, u_τ = U √(f/8) (Petukhov 1970, Adv. Heat Transfer 6, 503–564,
//! doi:10.1016/S0065-2717(08)70153-9; 3e3 < Re < 5e6).
//!
//! ```
//! use carom_track::flow::{Fluid, Pipe, Profile};
//! let pipe = Pipe::new(Profile::Laminar, [0.0; 3], [1.0, 0.0, 0.0], 0.01, 1.5, &Fluid::default())?;
//! assert_eq!(pipe.velocity([4.0, 0.0, 0.0]), [3.0, 0.0, 0.0]);
//! # Ok::<(), carom_track::flow::FlowError>(())
//! ```

use super::piece::{Exit, Layers, Piece, square_of_distance};
use super::profile::{Section, Shape, WallTurbulence, wall_layers};
use super::{FlowError, Fluid, Local, Profile};
use crate::geometry::Path;
use crate::vector::{Vec3, add, dot, norm, scale, sub, unit};
use carom::math::ln;

/// Fully developed flow in a round pipe.
#[derive(Clone, Copy, Debug)]
pub struct Pipe {
    shape: Shape,
    friction_velocity: f64,
    point: Vec3,
    axis: Vec3,
    radius: f64,
    mean_speed: f64,
    reynolds: f64,
    /// By the distance from the axis.
    layers: Layers,
}

impl Pipe {
    /// A pipe of a radius (m) around the line through `point` along `axis` (any length), with a mean speed along it (m/s).
    ///
    /// # Errors
    /// [`FlowError`] for a radius that is not positive, an axis without direction, values that are not finite, an impossible
    /// fluid, or a turbulent profile of Re < 2000, where a pipe is laminar.
    pub fn new(
        profile: Profile,
        point: [f64; 3],
        axis: [f64; 3],
        radius: f64,
        mean_speed: f64,
        fluid: &Fluid,
    ) -> Result<Self, FlowError> {
        fluid.check()?;
        FlowError::positive("pipe radius", radius)?;
        FlowError::finite("pipe mean speed", mean_speed)?;
        for c in point {
            FlowError::finite("pipe axis point", c)?;
        }
        let axis = unit(axis).ok_or(FlowError::Direction { name: "pipe axis" })?;
        let nu = fluid.kinematic_viscosity();
        let reynolds = 2.0 * radius * mean_speed.abs() / nu;
        if profile == Profile::Turbulent && reynolds < 2000.0 {
            return Err(FlowError::value(
                "Reynolds number (mean speed, diameter)",
                reynolds,
                "above 2000 for a turbulent profile",
            ));
        }
        let friction_velocity = match profile {
            Profile::Plug => 0.0,
            Profile::Laminar => (4.0 * nu * mean_speed.abs() / radius).sqrt(),
            Profile::Turbulent => mean_speed.abs() / (0.790 * ln(reynolds) - 1.64) / 8.0f64.sqrt(),
        };
        let shape = match profile {
            Profile::Plug => Shape::Plug,
            Profile::Laminar => Shape::Laminar,
            Profile::Turbulent => {
                Shape::Turbulent(WallTurbulence::new(Section::Round, radius, mean_speed, friction_velocity, nu))
            }
        };
        let layers = match &shape {
            // a plug goes on beyond the wall
            Shape::Plug => Layers::new([]),
            Shape::Laminar => Layers::new([radius]),
            Shape::Turbulent(_) => {
                let low = wall_layers(radius, friction_velocity, nu);
                Layers::new(low.iter().rev().map(|y| radius - y).chain([radius]))
            }
        };
        Ok(Self { shape, friction_velocity, point, axis, radius, mean_speed, reynolds, layers })
    }

    /// 2UR/ν.
    pub fn reynolds(&self) -> f64 {
        self.reynolds
    }

    /// √(τ_w/ρ), m/s; 0 for a plug.
    pub fn friction_velocity(&self) -> f64 {
        self.friction_velocity
    }

    #[inline(always)]
    fn radial(&self, x: Vec3) -> Vec3 {
        let d = sub(x, self.point);
        sub(d, scale(self.axis, dot(d, self.axis)))
    }

    /// m.
    pub(super) fn distance_from_axis(&self, x: Vec3) -> f64 {
        norm(self.radial(x))
    }

    /// Speed at a distance (m) from the axis, m/s: it falls from there to the wall.
    pub(super) fn speed_at(&self, r: f64) -> f64 {
        self.speed(Piece::layer(self.layers.of(r)), r).abs()
    }

    /// The piece of a point: one of the layers around the axis, or beyond the wall.
    pub fn piece(&self, x: [f64; 3]) -> Piece {
        Piece::layer(self.layers.of(norm(self.radial(x))))
    }

    /// Whether the flow is one piece.
    pub fn is_one_piece(&self) -> bool {
        self.layers.edges().is_empty()
    }

    /// Where a path leaves a piece: a root of the squared distance from the axis, of degree ten.
    pub fn exit(&self, piece: Piece, path: &Path) -> Option<Exit> {
        let [low, high] = self.layers.bounds(piece.index());
        let start = self.radial(path.start);
        let across = path.points.map(|p| sub(p, scale(self.axis, dot(p, self.axis))));
        let r = norm(start);
        // a disc is convex, and nothing comes nearer to the axis than its projection on where it started
        let stays_in = across.iter().all(|p| norm(add(start, *p)) < high);
        let stays_out = low <= 0.0 || across.iter().all(|p| dot(add(start, *p), start) > low * r);
        if stays_in && stays_out && r > low && r < high {
            return None;
        }
        let change = square_of_distance(start, &across);
        let squares = [if low < 0.0 { low } else { low * low }, high * high];
        let (down, up) = super::piece::leave(r * r, &change, squares);
        let down = down.map(|theta| Exit { theta, into: Piece::layer(piece.index() - 1) });
        let up = up.map(|theta| Exit { theta, into: Piece::layer(piece.index() + 1) });
        Exit::earlier(down, up)
    }

    /// How soon a straight path at `v` leaves a piece, s: a root of its squared distance from the axis.
    pub fn soonest(&self, piece: Piece, x: [f64; 3], v: [f64; 3]) -> f64 {
        let radial = self.radial(x);
        let across = sub(v, scale(self.axis, dot(v, self.axis)));
        let (square, outwards) = (dot(across, across), dot(radial, across));
        let r = norm(radial);
        let [low, high] = self.layers.bounds(piece.index());
        // r² + 2 (x·v) t + v² t² = edge², in the form that keeps its digits; no root or one behind is none
        let meets = |edge: f64, way: f64| {
            let gap = (r - edge) * (r + edge);
            let root = (outwards * outwards - square * gap).sqrt();
            let time =
                if way * outwards > 0.0 { -gap / (outwards + way * root) } else { (way * root - outwards) / square };
            if time > 0.0 { time } else { f64::INFINITY }
        };
        let inner = if low > 0.0 && outwards < 0.0 { meets(low, -1.0) } else { f64::INFINITY };
        inner.min(if high < f64::INFINITY { meets(high, 1.0) } else { f64::INFINITY })
    }

    /// Speed along the axis at a distance from it, by the formula of a piece.
    #[inline(always)]
    fn speed(&self, piece: Piece, r: f64) -> f64 {
        // beyond the axis there is nothing; beyond the wall the formula goes on
        let y = self.radius - r;
        match &self.shape {
            Shape::Plug => self.mean_speed,
            _ if piece.index() == self.layers.edges().len() => 0.0,
            Shape::Laminar => 2.0 * self.mean_speed * (y / self.radius) * (2.0 - y / self.radius),
            Shape::Turbulent(wall) => wall.velocity(y),
        }
    }

    /// Velocity at `x`, m/s.
    #[inline(always)]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        self.velocity_in(self.piece(x), x)
    }

    /// Velocity at `x` by the formula of a piece, m/s.
    #[inline(always)]
    pub fn velocity_in(&self, piece: Piece, x: [f64; 3]) -> [f64; 3] {
        scale(self.axis, self.speed(piece, norm(self.radial(x))))
    }

    /// Everything known at `x`. On the axis itself the wall normal is zero.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        self.sample_in(self.piece(x), x)
    }

    /// Everything known at `x`, by the formulas of a piece.
    #[inline(always)]
    pub fn sample_in(&self, piece: Piece, x: [f64; 3]) -> Local {
        let radial = self.radial(x);
        let r = norm(radial);
        let y = (self.radius - r).max(0.0);
        let outward = unit(radial).unwrap_or([0.0; 3]);
        let slope = match &self.shape {
            _ if piece.index() == self.layers.edges().len() => 0.0,
            Shape::Plug => 0.0,
            Shape::Laminar => -4.0 * self.mean_speed * (self.radius - y) / (self.radius * self.radius),
            Shape::Turbulent(wall) => -wall.slope(self.radius - r),
        };
        let (k, epsilon) = if let Shape::Turbulent(wall) = &self.shape { wall.turbulence(y) } else { (0.0, 0.0) };
        Local {
            gradient: self.axis.map(|a| scale(outward, a * slope)),
            k,
            epsilon,
            wall_distance: y,
            wall_normal: scale(outward, -1.0),
            friction_velocity: self.friction_velocity(),
            ..Local::uniform(scale(self.axis, self.speed(piece, r)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn air_like() -> Fluid {
        Fluid { density: 1.0, viscosity: 1.5e-5, temperature: 297.15, mean_free_path: 0.0 }
    }

    #[test]
    fn every_profile_has_the_given_mean() {
        for profile in [Profile::Plug, Profile::Laminar, Profile::Turbulent] {
            let pipe = Pipe::new(profile, [0.0; 3], [1.0, 0.0, 0.0], 0.05, 3.0, &air_like()).unwrap();
            let n = 20_000;
            let node = 0.6f64.sqrt();
            let h = 0.05 / n as f64;
            let f = |r: f64| pipe.velocity([0.0, 0.0, r])[0] * 2.0 * r / 0.0025;
            let mean: f64 = (0..n)
                .map(|i| {
                    let m = (i as f64 + 0.5) * h;
                    h / 18.0 * (5.0 * f(m - 0.5 * h * node) + 8.0 * f(m) + 5.0 * f(m + 0.5 * h * node))
                })
                .sum();
            assert!((mean / 3.0 - 1.0).abs() < 1e-9, "{profile:?} {mean}");
        }
    }

    #[test]
    fn any_axis_and_its_gradient() {
        for profile in [Profile::Laminar, Profile::Turbulent] {
            let pipe = Pipe::new(profile, [0.1, 0.2, 0.3], [2.0, 1.0, 2.0], 0.05, 3.0, &air_like()).unwrap();
            let x = [0.11, 0.22, 0.29];
            let local = pipe.sample(x);
            assert!((local.wall_distance + norm(pipe.radial(x)) - 0.05).abs() < 1e-15);
            for j in 0..3 {
                let (mut a, mut b) = (x, x);
                a[j] += 1e-7;
                b[j] -= 1e-7;
                let (a, b) = (pipe.velocity(a), pipe.velocity(b));
                for i in 0..3 {
                    let fd = (a[i] - b[i]) / 2e-7;
                    assert!(
                        (local.gradient[i][j] - fd).abs() < 1e-5 * 300.0,
                        "{profile:?} {i}{j} {fd} {:?}",
                        local.gradient
                    );
                }
            }
            let trace: f64 = (0..3).map(|i| local.gradient[i][i]).sum();
            assert!(trace.abs() < 1e-10);
            assert!(dot(local.wall_normal, pipe.radial(x)) < 0.0);
        }
    }

    #[test]
    fn friction_is_near_blasius() {
        // f = 0.3164 Re^{−1/4} at Re = 2e4, which Petukhov's law meets within 2 %
        let pipe = Pipe::new(Profile::Turbulent, [0.0; 3], [0.0, 0.0, 1.0], 0.05, 3.0, &air_like()).unwrap();
        let f = 8.0 * (pipe.friction_velocity() / 3.0).powi(2);
        let blasius = 0.3164 * 2e4f64.powf(-0.25);
        assert!((f / blasius - 1.0).abs() < 0.02, "{f} {blasius}");
        let Shape::Turbulent(wall) = pipe.shape else { unreachable!() };
        assert!((wall.scale() - 1.0).abs() < 0.05, "{}", wall.scale());
        let laminar = Pipe::new(Profile::Laminar, [0.0; 3], [0.0, 0.0, 1.0], 0.05, 0.03, &air_like()).unwrap();
        let f = 8.0 * (laminar.friction_velocity() / 0.03).powi(2);
        assert!((f / (64.0 / laminar.reynolds()) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_straight_path_leaves_a_layer_when_its_distance_says_so() {
        let pipe = Pipe::new(Profile::Turbulent, [0.0; 3], [1.0, 0.0, 0.0], 0.05, 3.0, &air_like()).unwrap();
        let edges = pipe.layers.edges();
        for (i, bounds) in edges.windows(2).enumerate() {
            let [low, high] = [bounds[0], bounds[1]];
            for share in [1e-12, 0.1, 0.5, 0.9, 1.0 - 1e-12] {
                let r = low + share * (high - low);
                for angle in (0..64).map(|k| f64::from(k) * 0.1) {
                    let v = [0.3, 2.0 * angle.cos(), 2.0 * angle.sin()];
                    let time = pipe.soonest(Piece::layer(i + 1), [0.7, r, 0.0], v);
                    let distance = |t: f64| (r + v[1] * t).hypot(v[2] * t);
                    let end = distance(time);
                    let edge = if (end - low).abs() < (end - high).abs() { low } else { high };
                    assert!((end - edge).abs() < 1e-13, "{i} {share} {angle}: {end} {low} {high}");
                    // and not before; grazing costs digits of the time, not of the distance
                    let inside = |t: f64| (low - 1e-13..=high + 1e-13).contains(&distance(t));
                    assert!((0..=100).all(|k| inside(time * f64::from(k) * 0.01)), "{i} {share} {angle}");
                }
            }
        }
        // along the edge it never ends next to it
        let along = pipe.soonest(Piece::layer(1), [0.0, edges[0], 0.0], [1.0, 0.0, 2.0]);
        assert!((along - (edges[1] * edges[1] - edges[0] * edges[0]).sqrt() / 2.0).abs() < 1e-12);
    }

    #[test]
    fn on_the_axis_and_outside() {
        let pipe = Pipe::new(Profile::Laminar, [0.0; 3], [1.0, 0.0, 0.0], 0.05, 1.0, &air_like()).unwrap();
        assert_eq!(pipe.sample([3.0, 0.0, 0.0]).gradient, [[0.0; 3]; 3]);
        assert_eq!(pipe.velocity([0.0, 0.06, 0.0]), [0.0; 3]);
        assert!(Pipe::new(Profile::Plug, [0.0; 3], [0.0; 3], 0.05, 1.0, &air_like()).is_err());
        assert!(Pipe::new(Profile::Turbulent, [0.0; 3], [1.0, 0.0, 0.0], 0.001, 1.0, &air_like()).is_err());
    }
}
