//! A slot jet on a plate at y = 0, flowing down (−y) around x = 0: an impactor's stage.
//!
//! A plane free jet of width W and speed U in still fluid, inviscid and exact (free-streamline theory: Milne-Thomson,
//! Theoretical Hydrodynamics, chapter XI). The complex velocity w = (u − iv)/U is given by where it is found,
//!
//! π(x + iy)/(2W) = arctan w + artanh w,  so  dw/d(x + iy) = (π/4W)(1 − w⁴),
//!
//! |w| < 1 inside the jet and 1 on its surface, (X − 1)(Y − 1) = 2 with X = e^{π(x/W − ½)}, Y = e^{π(y/W − ½)}. The strain
//! rate at the plate is (π/4) U/W. Outside the jet the fluid is at rest. Left out: the boundary layer on the plate, the
//! nozzle (the jet comes from infinity; on its axis it has 0.73 U left at y = W and 0.98 U at 2W) and the mixing at its edges.
//! Spheres that start with the jet land from √Stk = √(2/π) = 0.80 on, half of them at about 0.91, Stk = 2 τ_p U/W; measured
//! on rectangular impactors with a nozzle one or two W away: half at 0.77 (Hinds 1999, Aerosol Technology, table 5.4).
//!
//! ```
//! use carom_track::flow::SlotJet;
//! let jet = SlotJet::new(1e-3, 50.0)?;
//! let far = jet.velocity([0.02, 4e-4, 0.0]);          // a wall jet of half the width, as fast as the jet
//! assert!((far[0] - 50.0).abs() < 1e-9 && far[1].abs() < 1e-9);
//! assert_eq!(jet.velocity([0.02, 6e-4, 0.0]), [0.0; 3]);
//! # Ok::<(), carom_track::flow::FlowError>(())
//! ```

use super::piece::{Exit, Piece};
use super::{FlowError, Local};
use crate::geometry::Path;
use carom::math::{angle, exp, ln};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

mod edge;

/// Plane free jet against a plate.
#[derive(Clone, Copy, Debug)]
pub struct SlotJet {
    width: f64,
    speed: f64,
}

impl SlotJet {
    /// A jet of a width (m) and speed (m/s).
    ///
    /// # Errors
    /// [`FlowError::Value`] for a width that is not positive, or a speed that is negative or not finite.
    pub fn new(width: f64, speed: f64) -> Result<Self, FlowError> {
        FlowError::positive("slot width", width)?;
        check_speed(speed)?;
        Ok(Self { width, speed })
    }

    /// Speed of the jet, nowhere exceeded, m/s.
    pub(super) fn speed(&self) -> f64 {
        self.speed
    }

    /// Whether a point is in the jet, its mirror image x → |x| scaled by the width.
    #[inline(always)]
    fn contains(x: f64, y: f64) -> bool {
        surface(x, y) <= 0.0
    }

    /// The piece of a point.
    pub fn piece(&self, x: [f64; 3]) -> Piece {
        Piece::layer(if self.is_inside(x) { INSIDE } else { OUTSIDE })
    }

    fn is_inside(&self, x: [f64; 3]) -> bool {
        Self::contains(x[0].abs() / self.width, x[1].max(0.0) / self.width)
    }

    /// Where a path leaves a piece: where it crosses the jet's surface.
    pub fn exit(&self, piece: Piece, path: &Path) -> Option<Exit> {
        let (inside, into) = if piece.index() == INSIDE { (true, OUTSIDE) } else { (false, INSIDE) };
        let theta = edge::crossing(path, self.width, inside)?;
        Some(Exit { theta, into: Piece::layer(into) })
    }

    /// How far a step may go from `x`, m: a share of the width where the jet turns, more where it is even.
    pub fn reach(&self, piece: Piece, x: [f64; 3]) -> f64 {
        if piece.index() != INSIDE {
            return f64::INFINITY;
        }
        let far = x[0].abs().max(x[1]) - 3.0 * self.width;
        0.5 * (self.width + far.max(0.0))
    }

    /// w = (u − iv)/U at |x| and |y|, also a little beyond the jet's surface.
    #[inline(always)]
    fn complex_velocity(&self, x: [f64; 3]) -> Complex {
        invert(Complex(FRAC_PI_2 * x[0].abs() / self.width, FRAC_PI_2 * x[1].max(0.0) / self.width))
    }

    /// Velocity at `x`, m/s.
    #[inline(always)]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        self.velocity_in(self.piece(x), x)
    }

    /// Velocity at `x` by the formula of a piece, m/s.
    #[inline(always)]
    pub fn velocity_in(&self, piece: Piece, x: [f64; 3]) -> [f64; 3] {
        if piece.index() != INSIDE {
            return [0.0; 3];
        }
        let w = self.complex_velocity(x);
        [(w.0 * self.speed).copysign(x[0]), -w.1 * self.speed, 0.0]
    }

    /// Everything known at `x`.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        self.sample_in(self.piece(x), x)
    }

    /// Everything known at `x`, by the formulas of a piece.
    #[inline(always)]
    pub fn sample_in(&self, piece: Piece, x: [f64; 3]) -> Local {
        let mut gradient = [[0.0; 3]; 3];
        if piece.index() == INSIDE {
            let w = self.complex_velocity(x);
            let rate = FRAC_PI_4 * self.speed / self.width;
            let slope = w.one_minus_fourth();
            gradient[0][0] = rate * slope.0;
            gradient[1][1] = -gradient[0][0];
            gradient[1][0] = (-rate * slope.1) * 1f64.copysign(x[0]);
            gradient[0][1] = gradient[1][0];
        }
        plate(x, Local::steady(self.velocity_in(piece, x), gradient))
    }
}

/// The pieces of a slot jet.
const OUTSIDE: usize = 0;
const INSIDE: usize = 1;

/// Below zero in the jet, zero on its surface, above outside; rising with `x` ≥ 0 and `y` ≥ 0, both scaled by the width.
#[inline(always)]
fn surface(x: f64, y: f64) -> f64 {
    // beyond 60 widths the powers would overflow, and the surface is long at its asymptotes
    let power = |s: f64| exp(PI * (s.min(60.0) - 0.5)) - 1.0;
    let (x, y) = (power(x), power(y));
    if x <= 0.0 || y <= 0.0 { x.min(y) - 2.0 } else { x * y - 2.0 }
}

/// A complex number: real and imaginary part.
#[derive(Clone, Copy)]
struct Complex(f64, f64);

impl Complex {
    #[inline(always)]
    fn add(self, other: Self, times: f64) -> Self {
        Self(self.0 + times * other.0, self.1 + times * other.1)
    }

    #[inline(always)]
    fn multiply(self, other: Self) -> Self {
        Self(self.0 * other.0 - self.1 * other.1, self.0 * other.1 + self.1 * other.0)
    }

    /// 1 − w⁴.
    #[inline(always)]
    fn one_minus_fourth(self) -> Self {
        let square = self.multiply(self);
        let fourth = square.multiply(square);
        Self(1.0 - fourth.0, -fourth.1)
    }

    /// artanh of a number of the unit disc with both parts ≥ 0.
    #[inline(always)]
    fn artanh(self) -> Self {
        let Self(a, b) = self;
        let far = (1.0 + a) * (1.0 + a) + b * b;
        let near = ((1.0 - a) * (1.0 - a) + b * b).max(1e-300);
        Self(0.25 * ln(far / near), 0.5 * angle((1.0 - a * a - b * b).max(0.0), 2.0 * b))
    }
}

/// The root w of arctan w + artanh w = ζ, both parts of ζ ≥ 0, inside the jet.
#[inline(always)]
fn invert(zeta: Complex) -> Complex {
    // 1 − |w| is below rounding there
    const FAR: f64 = 20.0;
    if zeta.0 > FAR {
        return Complex(1.0, 0.0);
    }
    if zeta.1 > FAR {
        return Complex(0.0, 1.0);
    }
    let mut w = start(zeta);
    // Newton's iteration; where the last error's square is below rounding the step has removed it
    for _ in 0..8 {
        // arctan w = −i artanh(iw), and artanh(iw) is the mirror image of artanh(b + ia)
        let (t, c) = (w.artanh(), Complex(w.1, w.0).artanh());
        let error = Complex(t.0 + c.1 - zeta.0, t.1 + c.0 - zeta.1);
        w = inside(w.add(error.multiply(w.one_minus_fourth()), -0.5));
        if error.0 * error.0 + error.1 * error.1 < 1e-17 {
            break;
        }
    }
    w
}

/// A first estimate of w(ζ).
#[inline(always)]
fn start(zeta: Complex) -> Complex {
    // far along the plate or up the jet, ζ − π/4 = artanh of w or of w/i but for a phase
    let far = |s: f64| 1.0 - 2.0 * exp(FRAC_PI_2 - 2.0 * s);
    if zeta.0 > 2.0 {
        return Complex(far(zeta.0), 0.0);
    }
    if zeta.1 > 2.0 {
        return Complex(0.0, far(zeta.1));
    }
    // dw/dζ = (1 − w⁴)/2 along the ray from the stagnation point, by midpoint steps
    const STEPS: u32 = 8;
    let h = 0.5 / f64::from(STEPS);
    (0..STEPS).fold(Complex(0.0, 0.0), |w, _| {
        let middle = w.add(zeta.multiply(w.one_minus_fourth()), 0.5 * h);
        inside(w.add(zeta.multiply(middle.one_minus_fourth()), h))
    })
}

/// The nearest number of the quarter disc.
#[inline(always)]
fn inside(w: Complex) -> Complex {
    let Complex(a, b) = Complex(w.0.max(0.0), w.1.max(0.0));
    let size = (a * a + b * b).sqrt().max(1.0);
    Complex(a / size, b / size)
}

pub(super) fn check_speed(speed: f64) -> Result<(), FlowError> {
    if speed >= 0.0 && speed.is_finite() {
        Ok(())
    } else {
        Err(FlowError::value("jet speed", speed, "zero or positive, towards the plate"))
    }
}

pub(super) fn plate(x: [f64; 3], local: Local) -> Local {
    Local { wall_distance: x[1].max(0.0), wall_normal: [0.0, 1.0, 0.0], ..local }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::runge_kutta;

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
    fn slot_velocity_solves_its_equation() {
        // the inverse by the standard library's functions on the axis, the plate and the surface
        let jet = SlotJet::new(1.0, 1.0).unwrap();
        for w in [1e-6f64, 0.1, 0.5, 0.9, 0.999, 1.0 - 1e-9] {
            let x = 2.0 / PI * (w.atan() + w.atanh());
            assert!((jet.velocity([x, 0.0, 0.0])[0] - w).abs() < 1e-14, "{w}");
            assert!((jet.velocity([0.0, x, 0.0])[1] + w).abs() < 1e-14, "{w}");
            assert!(jet.velocity([x, 0.0, 0.0])[1].abs() < 1e-14, "flow through the plate");
        }
        for degrees in [1.0f64, 10.0, 45.0, 80.0, 89.0] {
            let theta = degrees.to_radians();
            // just inside the free surface the speed is the jet's, its direction θ below the plate's
            let x = 0.5 - (0.5 * theta).tan().ln() / PI;
            let y = 0.5 + (PI / 4.0 + 0.5 * theta).tan().ln() / PI;
            let u = jet.velocity([-x * (1.0 - 1e-9), y * (1.0 - 1e-9), 3.0]);
            assert!((u[0] + theta.cos()).abs() < 1e-7 && (u[1] + theta.sin()).abs() < 1e-7, "{degrees} {u:?}");
            assert_eq!(jet.velocity([x * (1.0 + 1e-9), y * (1.0 + 1e-9), 3.0]), [0.0; 3]);
        }
        assert!((jet.sample([0.0; 3]).gradient[0][0] - PI / 4.0).abs() < 1e-15);
    }

    #[test]
    fn gradients_are_the_velocitys() {
        let slot = SlotJet::new(1e-3, 10.0).unwrap();
        for x in [[1e-4, 2e-4, 0.0], [-4e-4, 1.2e-3, 1.0], [3e-3, 4e-4, 0.0], [1e-4, 3e-3, 0.0]] {
            check_gradient(|x| slot.velocity(x), slot.sample(x), x, 1e-8);
        }
    }

    /// Whether a sphere of τ U/W = `stokes`/2 that leaves the slot at x = `start`·W reaches the plate beside the fluid that
    /// turns away: Stokes drag, classical Runge–Kutta.
    fn lands(jet: impl Fn([f64; 3]) -> [f64; 3], stokes: f64, start: f64, height: f64) -> bool {
        let tau = 0.5 * stokes;
        let rate = |s: [f64; 4]| {
            let u = jet([s[0], s[1], 0.0]);
            [s[2], s[3], (u[0] - s[2]) / tau, (u[1] - s[3]) / tau]
        };
        let h = 0.01;
        let mut s = [start, height, 0.0, -1.0];
        for _ in 0..4000 {
            s = runge_kutta(s, h, rate);
            if s[1] <= 0.0 {
                return true;
            }
            // on its way out along the plate, or creeping up to it without ever arriving
            if s[0] > 6.0 || s[1] < 1e-12 {
                return false;
            }
        }
        false
    }

    #[test]
    fn critical_stokes_numbers() {
        // on the axis of a slot jet the plate is out of reach below a τ = 1/4, a = (π/4) U/W: √Stk = √(2/π) = 0.798
        let slot = SlotJet::new(1.0, 1.0).unwrap();
        let slot = |root: f64, start: f64| lands(|x| slot.velocity(x), root * root, start, 3.0);
        assert!(!slot(0.78, 0.0) && slot(0.82, 0.0));
        // half of the jet's spheres land at √Stk = 0.91
        assert!(!slot(0.88, 0.25) && slot(0.94, 0.25));
    }
}
