//! A round jet on a plate at y = 0, flowing down (−y) around the y axis: an impactor's stage.
//!
//! Stream function ψ = ½U min(r², δ²) g(y/δ), g(s) = 1 − (1 − s)² up to s = 1, a plug beyond. So
//!
//! - above y = δ the jet is a plug of diameter D: v = −U;
//! - below, within r = δ, it turns: v = −U g, u_r = U (r/δ)(1 − s), the stagnation flow of strain rate a = U/δ near the plate;
//! - beyond r = δ it is a wall jet fed by that: u_r = U (δ/r)(1 − s), v = 0, which loses speed as measured radial wall jets do
//!   (about r^−1.1: Poreh, Tsuei & Cermak 1967, J. Appl. Mech. 34, 457–463).
//!
//! The jet ends where ψ is that of its edge, ½U (D/2)²; beyond, the fluid is at rest. Divergence-free, its flux π D² U/4 through every
//! cylinder around the axis from r = δ on, and nowhere faster than U.
//!
//! δ = D/1.75. An inviscid free jet strains with a = 0.916 U/D only (Liu, Gabour & Lienhard 1993, J. Heat Transfer 115, 99–105). A nozzle near
//! the plate leaves the air less room to turn, and a is chosen so that half of the spheres that start all over the jet land at
//! √Stk = 0.49 to 0.50, Stk = 2 τ_p U/D, as measured on round impactors (0.49: Hinds 1999, Aerosol Technology, table 5.4). On the axis spheres land from
//! 2 a τ_p = ¼ on, √Stk = 0.38. Left out: the boundary layer on the plate and the mixing at the edges; the shape of the efficiency curve
//! is this flow's, not measured. Use a table from a computed flow for that.
//!
//! ```
//! use carom_track::flow::RoundJet;
//! let jet = RoundJet::new(1e-3, 10.0)?;
//! assert_eq!(jet.velocity([0.0, 2e-3, 0.0]), [0.0, -10.0, 0.0]);
//! assert_eq!(jet.velocity([2e-3, 2e-3, 0.0]), [0.0; 3]);
//! let far = jet.velocity([17e-3, 0.0, 0.0]);
//! assert!((far[0] - 10.0 / 1.75 / 17.0).abs() < 1e-12 && far[1] == 0.0);
//! # Ok::<(), carom_track::flow::FlowError>(())
//! ```

use super::jet::{check_speed, plate};
use super::piece::{Exit, Piece, along, leave, square_of_distance};
use super::{FlowError, Local};
use crate::geometry::{Bernstein, Path};

/// Round jet on a plate.
#[derive(Clone, Copy, Debug)]
pub struct RoundJet {
    speed: f64,
    radius: f64,
    thickness: f64,
}

/// The pieces: beyond the jet's edge, where it turns, above, along the plate.
const OUTSIDE: usize = 0;
const TURN: usize = 1;
const PLUG: usize = 2;
const ALONG: usize = 3;

/// Values on the edge by rounding count as on it: this much of δ².
const THIN: f64 = 1e-13;

/// Halvings of a path; an edge that is crossed to and fro within the last of them is not seen.
const DEEPEST: u32 = 12;

impl RoundJet {
    /// a in U/D, for the measured cut-point.
    const STRAIN: f64 = 1.75;

    /// A jet of a diameter (m) and speed (m/s).
    ///
    /// # Errors
    /// [`FlowError::Value`] for a diameter that is not positive, or a speed that is negative or not finite.
    pub fn new(diameter: f64, speed: f64) -> Result<Self, FlowError> {
        FlowError::positive("jet diameter", diameter)?;
        check_speed(speed)?;
        Ok(Self { speed, radius: 0.5 * diameter, thickness: diameter / Self::STRAIN })
    }

    /// Speed of the jet, nowhere exceeded, m/s.
    pub(super) fn speed(&self) -> f64 {
        self.speed
    }

    /// The distance δ from the plate below which the jet is turned, and from the axis beyond which it is a wall jet, m.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Below zero in the jet, zero on its edge; rises with r²/δ² and y/δ.
    fn edge(&self, square: f64, s: f64) -> f64 {
        let rest = 1.0 - s.clamp(0.0, 1.0);
        let share = self.radius / self.thickness;
        square.min(1.0) * (1.0 - rest * rest) - share * share
    }

    /// r²/δ² and y/δ.
    fn scaled(&self, x: [f64; 3]) -> (f64, f64) {
        let [a, b] = [x[0] / self.thickness, x[2] / self.thickness];
        (a * a + b * b, x[1] / self.thickness)
    }

    /// The piece of a point that is in the jet.
    fn within(&self, x: [f64; 3]) -> Piece {
        let (square, s) = self.scaled(x);
        Piece::layer(match (s >= 1.0, square >= 1.0) {
            (true, _) => PLUG,
            (false, true) => ALONG,
            (false, false) => TURN,
        })
    }

    /// The piece of a point.
    pub fn piece(&self, x: [f64; 3]) -> Piece {
        let (square, s) = self.scaled(x);
        if self.edge(square, s) > 0.0 { Piece::layer(OUTSIDE) } else { self.within(x) }
    }

    /// Where a path leaves a piece.
    pub fn exit(&self, piece: Piece, path: &Path) -> Option<Exit> {
        let scale = 1.0 / self.thickness;
        let (y, rise) = along(path, 1);
        let (s, rise) = (y * scale, rise.scaled(scale, 0.0));
        let start = [path.start[0] * scale, 0.0, path.start[2] * scale];
        let across = path.points.map(|p| [p[0] * scale, 0.0, p[2] * scale]);
        let square = start[0] * start[0] + start[2] * start[2];
        let outwards = square_of_distance(start, &across);
        let crossing = Crossing {
            jet: self,
            square: outwards.scaled(1.0, square),
            // the same degree for both: times one
            height: rise.scaled(1.0, s).times(&Bernstein([1.0; 6])),
            sign: if piece.index() == OUTSIDE { -1.0 } else { 1.0 },
        };
        let edge = crossing.first().map(|theta| {
            let into = if piece.index() == OUTSIDE { self.within(path.at(theta)) } else { Piece::layer(OUTSIDE) };
            Exit { theta, into }
        });
        let whole = [f64::NEG_INFINITY, f64::INFINITY];
        let to = |theta: Option<f64>, into| theta.map(|theta| Exit { theta, into: Piece::layer(into) });
        match piece.index() {
            TURN => {
                let up = to(leave(s, &rise, [whole[0], 1.0]).1, PLUG);
                let out = to(leave(square, &outwards, [whole[0], 1.0]).1, ALONG);
                Exit::earlier(edge, Exit::earlier(up, out))
            }
            PLUG => Exit::earlier(edge, to(leave(s, &rise, [1.0, whole[1]]).0, TURN)),
            ALONG => Exit::earlier(edge, to(leave(square, &outwards, [1.0, whole[1]]).0, TURN)),
            _ => edge,
        }
    }

    /// How far a step may go from `x`, m: a share of δ, more where the jet is far.
    pub fn reach(&self, x: [f64; 3]) -> f64 {
        let (square, s) = self.scaled(x);
        let far = (s - 2.0).max(0.0) + if s > 1.0 { (square.sqrt() - 2.0).max(0.0) } else { 0.0 };
        0.5 * self.thickness * (1.0 + far)
    }

    /// Velocity at `x`, m/s.
    #[inline(always)]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        self.velocity_in(self.piece(x), x)
    }

    /// Velocity at `x` by the formula of a piece, m/s.
    #[inline(always)]
    pub fn velocity_in(&self, piece: Piece, x: [f64; 3]) -> [f64; 3] {
        let (square, s) = self.scaled(x);
        let rest = 1.0 - s.max(0.0);
        let strain = self.speed / self.thickness;
        match piece.index() {
            TURN => [strain * rest * x[0], self.speed * (rest * rest - 1.0), strain * rest * x[2]],
            PLUG => [0.0, -self.speed, 0.0],
            ALONG => {
                let outwards = strain * rest / square;
                [outwards * x[0], 0.0, outwards * x[2]]
            }
            _ => [0.0; 3],
        }
    }

    /// Everything known at `x`.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        self.sample_in(self.piece(x), x)
    }

    /// Everything known at `x`, by the formulas of a piece.
    #[inline(always)]
    pub fn sample_in(&self, piece: Piece, x: [f64; 3]) -> Local {
        let (square, s) = self.scaled(x);
        let rest = 1.0 - s.max(0.0);
        let strain = self.speed / self.thickness;
        let slope = -strain / self.thickness;
        let gradient = match piece.index() {
            TURN => {
                let radial = strain * rest;
                [[radial, slope * x[0], 0.0], [0.0, -2.0 * radial, 0.0], [0.0, slope * x[2], radial]]
            }
            ALONG => {
                // u = c x/r², so ∂u_i/∂x_j = c (δ_ij − 2 x_i x_j/r²)/r²
                let c = strain * rest / square;
                let [a, b] = [x[0] / self.thickness, x[2] / self.thickness];
                let cross = -2.0 * c * a * b / square;
                let along = c * (b * b - a * a) / square;
                let turn = slope / square;
                [[along, turn * x[0], cross], [0.0; 3], [cross, turn * x[2], -along]]
            }
            _ => [[0.0; 3]; 3],
        };
        plate(x, Local::steady(self.velocity_in(piece, x), gradient))
    }
}

/// Where a path crosses the jet's edge. The edge's function rises with r² and y, so its value at the corner of a box bounds it in the
/// box: a stretch of the path whose box lies on one side surely does not cross. Others are halved.
struct Crossing<'a> {
    jet: &'a RoundJet,
    square: Bernstein<11>,
    height: Bernstein<11>,
    /// Makes the function negative where the path comes from.
    sign: f64,
}

impl Crossing<'_> {
    fn value(&self, theta: f64) -> f64 {
        self.sign * self.jet.edge(self.square.value(theta), self.height.value(theta))
    }

    fn first(&self) -> Option<f64> {
        // a path that starts on the other side, by rounding, and goes on there has crossed already
        if self.value(0.0) > 0.0 && self.value(1e-6) > THIN {
            return Some(0.0);
        }
        self.search(&self.square, &self.height, 0.0, 1.0, DEEPEST)
    }

    fn search(&self, square: &Bernstein<11>, height: &Bernstein<11>, low: f64, high: f64, depth: u32) -> Option<f64> {
        let range =
            |p: &Bernstein<11>| p.0.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), c| (a.min(*c), b.max(*c)));
        let (q, s) = (range(square), range(height));
        let corner = if self.sign > 0.0 { self.jet.edge(q.1, s.1) } else { -self.jet.edge(q.0, s.0) };
        if corner <= THIN {
            return None;
        }
        if depth == 0 {
            let at = |i: usize| self.sign * self.jet.edge(square.0[i], height.0[i]);
            return (at(0) <= THIN && at(10) > THIN).then(|| self.root(low, high));
        }
        let middle = 0.5 * (low + high);
        let ((q1, q2), (s1, s2)) = (square.split(), height.split());
        self.search(&q1, &s1, low, middle, depth - 1).or_else(|| self.search(&q2, &s2, middle, high, depth - 1))
    }

    /// The crossing between a θ on the near side and one beyond, by halving.
    fn root(&self, mut low: f64, mut high: f64) -> f64 {
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.value(middle) > THIN { high = middle } else { low = middle }
        }
        high
    }
}

#[cfg(test)]
mod tests;
