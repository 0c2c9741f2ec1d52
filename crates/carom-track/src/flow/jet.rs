//! Jets on a plate at y = 0, flowing down (−y) around x = 0 (slot) or the y axis (round): models of an impactor's stage.
//!
//! # Slot
//! Potential flow between the impaction plate and a nozzle plate at y = S with a slot of width W that blows uniformly at
//! speed U: the field of a source strip and its images, which sums to a closed form. With A± = π(x ± W/2)/(2S),
//! T = tan(πy/2S) and c = cos(πy/S),
//!
//! u = (U/2π) ln[(cosh 2A₊ + c)/(cosh 2A₋ + c)],   v = −(U/π)[atan(T tanh A₊) − atan(T tanh A₋)].
//!
//! No boundary layers (thin at an impactor's Re ≈ 3000), no separation at the nozzle's lip, where u is logarithmically
//! infinite (cut off within about 1e-6 S); above the nozzle plane a plug, so u jumps there.
//! The same flow is derived from sources in a strip in Milne-Thomson, Theoretical Hydrodynamics, chapter X.
//!
//! # Round
//! Stream function ψ = ½U r² g(y/δ), g(s) = 1 − (1 − s)³ up to s = 1, a plug beyond: v = −U g, u_r = ½U r g'/δ.
//! Exactly divergence-free, the stagnation flow of strain rate a = 3U/(2δ) near the plate, joined smoothly to a plug.
//! δ = 1.638 D gives a = 0.916 U/D, that of an inviscid free jet of diameter D (Liu, Gabour & Lienhard 1993, J. Heat
//! Transfer 115, 99–105, doi:10.1115/1.2910677). Good within about r < D/2 only: u_r grows without bound with r, the
//! vorticity is that of the joint, not of a shear layer, and every sphere meets the same approach, so an ideal
//! impactor's efficiency is a step here. Use a table for what depends on r.
//!
//! ```
//! use carom_track::flow::SlotJet;
//! let jet = SlotJet::new(1e-3, 1e-3, 50.0)?;
//! let far = jet.velocity([0.02, 5e-4, 0.0]);          // all that came in leaves to both sides
//! assert!((far[0] - 25.0).abs() < 1e-9 && far[1].abs() < 1e-9);
//! # Ok::<(), carom_track::flow::FlowError>(())
//! ```

use super::tangent::{atan, tan};
use super::{FlowError, Local};
use carom::math::{exp, ln};
use std::f64::consts::PI;

/// Slot jet between a nozzle plate and an impaction plate.
#[derive(Clone, Copy, Debug)]
pub struct SlotJet {
    width: f64,
    distance: f64,
    speed: f64,
}

/// One edge of the slot seen from a point: q = e^{−2|A|}, its sign, and N = 1 + q² + 2cq.
#[derive(Clone, Copy)]
struct Edge {
    twice_a: f64,
    q: f64,
    n: f64,
}

impl SlotJet {
    /// A slot of a width (m) at a distance (m) from the plate, blowing at a speed (m/s).
    ///
    /// # Errors
    /// [`FlowError::Value`] for a width or distance that is not positive, or a speed that is negative or not finite.
    pub fn new(width: f64, distance: f64, speed: f64) -> Result<Self, FlowError> {
        FlowError::positive("slot width", width)?;
        FlowError::positive("slot to plate distance", distance)?;
        check_speed(speed)?;
        Ok(Self { width, distance, speed })
    }

    #[inline(always)]
    fn edge(&self, x: f64, c: f64) -> Edge {
        let twice_a = PI * x / self.distance;
        let q = exp(-twice_a.abs());
        // the lip, where n = 0, is the flow's only singular point
        Edge { twice_a, q, n: (1.0 + q * q + 2.0 * c * q).max(1e-12) }
    }

    /// T = tan(πy/2S), cos(πy/S), sin(πy/S).
    #[inline(always)]
    fn height(&self, y: f64) -> (f64, f64, f64) {
        let t = tan((0.5 * PI / self.distance * y).clamp(0.0, 0.5 * PI));
        let s = 1.0 / (1.0 + t * t);
        (t, (1.0 - t * t) * s, 2.0 * t * s)
    }

    /// Velocity at `x`, m/s.
    #[inline]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        if x[1] > self.distance {
            let inside = x[0].abs() < 0.5 * self.width;
            return [0.0, if inside { -self.speed } else { 0.0 }, 0.0];
        }
        let (t, c, _) = self.height(x[1]);
        let (p, m) = (self.edge(x[0] + 0.5 * self.width, c), self.edge(x[0] - 0.5 * self.width, c));
        let u = (p.twice_a.abs() - m.twice_a.abs() + ln(p.n / m.n)) * (self.speed / (2.0 * PI));
        let angle = |e: Edge| atan(t * e.twice_a.signum() * (1.0 - e.q) / (1.0 + e.q));
        [u, (angle(m) - angle(p)) * (self.speed / PI), 0.0]
    }

    /// Everything known at `x`.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        let mut gradient = [[0.0; 3]; 3];
        if x[1] <= self.distance {
            // dw/dz = (U/2S)[coth ζ₊ − coth ζ₋] of the complex velocity w = u − iv
            let (_, c, s) = self.height(x[1]);
            let coth = |e: Edge| (e.twice_a.signum() * (1.0 - e.q * e.q) / e.n, 2.0 * s * e.q / e.n);
            let (p, m) = (coth(self.edge(x[0] + 0.5 * self.width, c)), coth(self.edge(x[0] - 0.5 * self.width, c)));
            let rate = 0.5 * self.speed / self.distance;
            gradient[0][0] = rate * (p.0 - m.0);
            gradient[1][1] = -gradient[0][0];
            gradient[1][0] = -rate * (p.1 - m.1);
            gradient[0][1] = gradient[1][0];
        }
        plate(x, Local::steady(self.velocity(x), gradient))
    }
}

/// Round jet on a plate.
#[derive(Clone, Copy, Debug)]
pub struct RoundJet {
    speed: f64,
    thickness: f64,
}

impl RoundJet {
    /// δ/D that gives the strain rate of an inviscid free jet, 0.916 U/D.
    const THICKNESS: f64 = 1.5 / 0.916;

    /// A free jet of a diameter (m) and speed (m/s).
    ///
    /// # Errors
    /// [`FlowError::Value`] for a diameter that is not positive, or a speed that is negative or not finite.
    pub fn new(diameter: f64, speed: f64) -> Result<Self, FlowError> {
        FlowError::positive("jet diameter", diameter)?;
        check_speed(speed)?;
        Ok(Self { speed, thickness: Self::THICKNESS * diameter })
    }

    /// The distance δ from the plate below which the jet is turned, m.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// 1 − s of s = y/δ, held within [0, 1].
    #[inline(always)]
    fn rest(&self, y: f64) -> f64 {
        (1.0 - y / self.thickness).clamp(0.0, 1.0)
    }

    /// Velocity at `x`, m/s.
    #[inline]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        let rest = self.rest(x[1]);
        let radial = 1.5 * self.speed / self.thickness * rest * rest;
        [radial * x[0], self.speed * (rest * rest * rest - 1.0), radial * x[2]]
    }

    /// Everything known at `x`.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        let rest = self.rest(x[1]);
        let radial = 1.5 * self.speed / self.thickness * rest * rest;
        let turn = -3.0 * self.speed / (self.thickness * self.thickness) * rest;
        let gradient = [[radial, turn * x[0], 0.0], [0.0, -2.0 * radial, 0.0], [0.0, turn * x[2], radial]];
        plate(x, Local::steady(self.velocity(x), gradient))
    }
}

fn check_speed(speed: f64) -> Result<(), FlowError> {
    if speed >= 0.0 && speed.is_finite() {
        Ok(())
    } else {
        Err(FlowError::value("jet speed", speed, "zero or positive, towards the plate"))
    }
}

fn plate(x: [f64; 3], local: Local) -> Local {
    Local { wall_distance: x[1].max(0.0), wall_normal: [0.0, 1.0, 0.0], ..local }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_gradient(velocity: impl Fn([f64; 3]) -> [f64; 3], local: Local, x: [f64; 3], h: f64) {
        let size = local.gradient.iter().flatten().fold(1.0f64, |m, g| m.max(g.abs()));
        for j in 0..3 {
            let (mut a, mut b) = (x, x);
            a[j] += h;
            b[j] -= h;
            let (a, b) = (velocity(a), velocity(b));
            for i in 0..3 {
                let fd = (a[i] - b[i]) / (2.0 * h);
                assert!((local.gradient[i][j] - fd).abs() < 1e-5 * size, "{x:?} {i}{j} {fd} {:?}", local.gradient);
            }
        }
        let trace: f64 = (0..3).map(|i| local.gradient[i][i]).sum();
        assert!(trace.abs() < 1e-12 * size);
    }

    #[test]
    fn slot_meets_its_boundary_conditions() {
        let jet = SlotJet::new(1e-3, 2e-3, 10.0).unwrap();
        for x in [-5e-3, -4e-4, 0.0, 2e-4, 1e-3] {
            assert!(jet.velocity([x, 0.0, 0.0])[1].abs() < 1e-12, "flow through the plate");
            let top = jet.velocity([x, 2e-3, 0.0])[1];
            let want = if x.abs() < 5e-4 { -10.0 } else { 0.0 };
            assert!((top - want).abs() < 1e-9, "{x} {top}");
        }
        let centre = jet.velocity([0.0, 1e-3, 0.0]);
        assert!(centre[0].abs() < 1e-12 && centre[1] < 0.0);
        // strain rate at the stagnation line: (U/S) tanh(πW/4S)
        let a = jet.sample([0.0; 3]).gradient[0][0];
        assert!((a / (5000.0 * (PI / 8.0).tanh()) - 1.0).abs() < 1e-12);
        assert!(jet.velocity([5e-4, 2e-3, 0.0]).iter().all(|c| c.is_finite()), "lip");
    }

    #[test]
    fn gradients_are_the_velocitys() {
        let slot = SlotJet::new(1e-3, 1.5e-3, 10.0).unwrap();
        for x in [[1e-4, 2e-4, 0.0], [-6e-4, 1e-3, 1.0], [3e-3, 7e-4, 0.0]] {
            check_gradient(|x| slot.velocity(x), slot.sample(x), x, 1e-8);
        }
        let round = RoundJet::new(1e-3, 10.0).unwrap();
        for x in [[1e-4, 2e-4, 3e-4], [-6e-4, 1e-3, 0.0], [1e-4, 3e-3, 0.0]] {
            check_gradient(|x| round.velocity(x), round.sample(x), x, 1e-8);
        }
        assert!((round.sample([0.0; 3]).gradient[0][0] - 0.916 * 1e4).abs() < 1e-9);
        assert_eq!(round.velocity([0.0, 0.01, 0.0]), [0.0, -10.0, 0.0]);
    }
}
