//! A law as a formula of speed, angle and diameter, for programs whose conditions take expressions.
//!
//! Laws of adhesion, damping and yielding depend on the normal speed v_n and the diameter d. With x = v_n/V(d), where V is the capture
//! velocity, a power of the diameter within a bin, e² is a polynomial of u = xᵖ − 1 (or ln x) without a constant, so that e vanishes at
//! capture: one for each end of the bin, and between them the mean weighted in ln d. Of the powers tried the best is kept; p = −4/5 makes
//! the law of adhesion work alone exact, e² = 1 − x^(−4/5) for every size (Kim & Dunn 2007, Eqs 21 and 24).
//! Laws without capture have a constant and V = 1 m/s. Tables by angle are polynomials of the angle.
//!
//! The tangential part is the law's own where it is rolling or Walton's, e_t = 1 − min(f(1 + e) tan α, (2/7)(1 + β₀)), else a
//! polynomial of the angle, the mean over speeds and diameters.

use super::deviation::{Deviation, FORMULA};
use super::polynomial::{self, Points};
use super::sample::{Cell, Sample, by_angle, captured, components, rebound};
use super::{Span, rounded};
use crate::error::LabError;
use carom::normal::NormalLaw;
use carom::tangential::Tangential;
use carom::{WallLaw, math};

/// u of x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// xᵖ − 1.
    Power(f64),
    /// ln x.
    Logarithm,
}

/// Adhesion work, damping of adhesion, damping of Hertz' force, and what is none of them.
const BASES: [Basis; 4] = [Basis::Power(-0.8), Basis::Power(0.2), Basis::Power(1.0), Basis::Logarithm];

impl Basis {
    fn of(self, x: f64) -> f64 {
        match self {
            Self::Power(p) => math::pow(x, p) - 1.0,
            Self::Logarithm => math::ln(x),
        }
    }
}

/// V(d) = at (d/reference)^exponent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// m/s.
    pub at: f64,
    /// m.
    pub reference: f64,
    /// Power of the diameter.
    pub exponent: f64,
}

impl Scale {
    fn of(&self, diameter: f64) -> f64 {
        self.at * math::pow(diameter / self.reference, self.exponent)
    }
}

/// The normal restitution.
#[derive(Clone, Debug, PartialEq)]
pub enum Normal {
    /// Every impact is a capture.
    Stick,
    /// A polynomial of the angle (rad).
    ByAngle(Vec<f64>),
    /// e² as a polynomial of u(v_n/V).
    BySpeed {
        /// V, the capture velocity where there is one.
        scale: Scale,
        /// Is V a capture velocity?
        captures: bool,
        /// From this normal speed (m/s) on it is captured again.
        exhausted: Option<f64>,
        /// u.
        basis: Basis,
        /// e² at the lower end of the bin, lowest power first.
        squared: Vec<f64>,
        /// At the upper end, where it differs.
        upper: Option<Upper>,
    },
}

/// e² at the upper end of a bin.
#[derive(Clone, Debug, PartialEq)]
pub struct Upper {
    /// Lowest power first.
    pub squared: Vec<f64>,
    /// The lower end, m.
    pub from: f64,
    /// 1/ln(upper end/lower end).
    pub per_ln: f64,
}

impl Upper {
    /// Its weight at a diameter.
    fn share(&self, diameter: f64) -> f64 {
        (math::ln(diameter / self.from) * self.per_ln).clamp(0.0, 1.0)
    }
}

/// The tangential restitution.
#[derive(Clone, Debug, PartialEq)]
pub enum Tangent {
    /// 1 − min(f(1 + e) tan α, cap).
    Friction {
        /// f.
        friction: f64,
        /// (2/7)(1 + β₀).
        cap: f64,
    },
    /// A polynomial of the angle (rad).
    ByAngle(Vec<f64>),
}

/// A law within a bin of sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// e.
    pub normal: Normal,
    /// e_t.
    pub tangent: Tangent,
}

/// x below which a law without capture is not followed further.
pub(super) const SLOWEST: f64 = 1e-9;

impl Normal {
    /// e, 0 for a capture, at a normal speed (m/s) and an angle (rad).
    pub fn at(&self, diameter: f64, normal_speed: f64, angle: f64) -> f64 {
        match self {
            Self::Stick => 0.0,
            Self::ByAngle(c) => polynomial::value(c, angle).clamp(0.0, 1.0),
            Self::BySpeed { scale, captures, exhausted, basis, squared, upper } => {
                let x = normal_speed / scale.of(diameter);
                if (*captures && x <= 1.0) || exhausted.is_some_and(|v| normal_speed >= v) {
                    return 0.0;
                }
                let u = basis.of(x.max(if *captures { 1.0 } else { SLOWEST }));
                let mut square = polynomial::value(squared, u);
                if let Some(upper) = upper {
                    square += upper.share(diameter) * (polynomial::value(&upper.squared, u) - square);
                }
                square.clamp(0.0, 1.0).sqrt()
            }
        }
    }
}

impl Formula {
    /// e and e_t, `None` for a capture. The angle in degrees.
    pub fn at(&self, diameter: f64, speed: f64, degrees: f64) -> Option<(f64, f64)> {
        let (normal_speed, along) = components(speed, degrees);
        let angle = degrees.to_radians();
        let e = self.normal.at(diameter, normal_speed, angle);
        let e_t = match &self.tangent {
            Tangent::Friction { friction, cap } => 1.0 - (friction * (1.0 + e) * (normal_speed / along)).min(*cap),
            Tangent::ByAngle(c) => polynomial::value(c, angle).clamp(-1.0, 1.0),
        };
        (e > 0.0).then_some((e, e_t))
    }
}

/// The formula of a cell, the share that the law captures and the deviation.
///
/// # Errors
/// What the law refuses, and a formula that is further from the law than its bounds.
pub fn fit(law: &WallLaw, cell: &Cell, degree: usize) -> Result<(Formula, f64, Deviation), LabError> {
    let samples = cell.samples(law)?;
    let normal = match law.normal() {
        NormalLaw::Table(_) => Normal::ByAngle(angles(&samples, degree, |r| r.0, 0.0)),
        _ => by_speed(law, cell, degree)?,
    };
    let tangent = match law.tangential() {
        Tangential::Friction { friction, beta } => {
            Tangent::Friction { friction: rounded(*friction), cap: rounded(2.0 / 7.0 * (1.0 + beta)) }
        }
        _ => Tangent::ByAngle(angles(&samples, degree, |r| r.1, -1.0)),
    };
    let formula = Formula { normal, tangent };
    let deviation = Deviation::of(&samples, |s| formula.at(s.diameter, s.speed, s.angle));
    deviation.within(&FORMULA, cell)?;
    Ok((formula, captured(&samples), deviation))
}

fn angles(samples: &[Sample], degree: usize, get: fn((f64, f64)) -> f64, low: f64) -> Vec<f64> {
    let (x, y) = by_angle(samples, get);
    let x: Vec<f64> = x.into_iter().map(f64::to_radians).collect();
    polynomial::bounded(&x, &y, degree, (0.0, std::f64::consts::FRAC_PI_2), (low, 1.0))
}

fn by_speed(law: &WallLaw, cell: &Cell, degree: usize) -> Result<Normal, LabError> {
    let Some(window) = windows(law, cell.diameters)? else { return Ok(Normal::Stick) };
    let (scale, captures) = window.scale;
    let slowest = components(cell.speeds.from, cell.angles.from).0;
    let fastest = components(cell.speeds.to, cell.angles.to).0;
    let exhausted = window.exhausted.filter(|v| *v < fastest).map(rounded);
    let mut ends = Vec::new();
    for diameter in cell.diameters.ratios(2) {
        let from = if captures { slowest.max(scale.of(diameter)) } else { slowest };
        let mut end = End::default();
        for speed in Span::new(from, fastest.max(from)).ratios(193) {
            let Some((e, _)) = rebound(law, diameter, speed, 90.0)? else { continue };
            if exhausted.is_some_and(|v| speed >= v) {
                continue;
            }
            end.x.push((speed / scale.of(diameter)).max(if captures { 1.0 } else { SLOWEST }));
            end.e.push(e);
        }
        ends.push(end);
    }
    let (basis, squares) = best(&ends, degree, captures);
    // a bin of a single diameter has one end
    let mut squares = squares.into_iter();
    let squared = squares.next().unwrap_or_default();
    let Span { from, to } = cell.diameters;
    let upper = squares.next().filter(|u| *u != squared);
    let upper = upper.map(|squared| Upper { squared, from: rounded(from), per_ln: rounded(1.0 / math::ln(to / from)) });
    Ok(Normal::BySpeed { scale, captures, exhausted, basis, squared, upper })
}

/// Rebounds of one size by x.
#[derive(Default)]
struct End {
    x: Vec<f64>,
    e: Vec<f64>,
}

impl End {
    /// e² by u, and the largest difference in e.
    fn fit(&self, basis: Basis, degree: usize, captures: bool) -> (Vec<f64>, f64) {
        let u: Vec<f64> = self.x.iter().map(|x| basis.of(*x)).collect();
        let square: Vec<f64> = self.e.iter().map(|e| e * e).collect();
        // d(e²) = 2e de; near capture e itself is steep
        let weight: Vec<f64> = self.e.iter().map(|e| 0.5 / e.max(0.1)).collect();
        let mut c = polynomial::fit(&Points { x: &u, y: &square, weight: &weight }, degree, captures);
        c.iter_mut().for_each(|v| *v = rounded(*v));
        let root = |u: &f64| polynomial::value(&c, *u).clamp(0.0, 1.0).sqrt();
        let largest = u.iter().zip(&self.e).map(|(u, e)| (root(u) - e).abs()).fold(0.0, f64::max);
        (c, largest)
    }
}

/// The basis and degree whose largest difference is least, the lower degree where the higher gains little.
fn best(ends: &[End], degree: usize, captures: bool) -> (Basis, Vec<Vec<f64>>) {
    let mut least = (f64::INFINITY, BASES[0], Vec::new());
    for degree in usize::from(captures)..=degree.max(1) {
        for basis in BASES {
            let (squares, apart): (Vec<_>, Vec<_>) = ends.iter().map(|e| e.fit(basis, degree, captures)).unzip();
            let largest = apart.into_iter().fold(0.0, f64::max);
            if largest < 0.99 * least.0 - 1e-9 {
                least = (largest, basis, squares);
            }
        }
    }
    (least.1, least.2)
}

/// V(d) with whether it is a capture velocity, and the upper end in the middle of the bin.
struct Windows {
    scale: (Scale, bool),
    exhausted: Option<f64>,
}

/// `None` where no sphere of the bin's ends rebounds at any speed.
fn windows(law: &WallLaw, diameters: Span) -> Result<Option<Windows>, LabError> {
    let window = |d: f64| law.window(d, None).map_err(|e| LabError::Model(format!("{d} m: {e}")));
    let reference = rounded(diameters.middle());
    let (low, high) = match (window(diameters.from)?, window(diameters.to)?) {
        (Some(low), Some(high)) => (low.capture_velocity, high.capture_velocity),
        (Some(one), None) | (None, Some(one)) => (one.capture_velocity, one.capture_velocity),
        (None, None) => return Ok(None),
    };
    let scale = if low > 0.0 && high > 0.0 {
        let exponent =
            if diameters.is_point() { 0.0 } else { math::ln(high / low) / math::ln(diameters.to / diameters.from) };
        let at = low * math::pow(reference / diameters.from, exponent);
        (Scale { at: rounded(at), reference, exponent: rounded(exponent) }, true)
    } else {
        (Scale { at: 1.0, reference, exponent: 0.0 }, false)
    };
    let exhausted = window(reference)?.map(|w| w.exhausted_velocity).filter(|v| v.is_finite());
    Ok(Some(Windows { scale, exhausted }))
}
