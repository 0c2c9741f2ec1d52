//! A tetrahedron a sphere is in, and the fluid's velocity there, linear in the place.

use crate::geometry::{Bernstein, Path};
use crate::vector::{Vec3, dot, sub};
use std::fmt;

/// What a sphere keeps of the tetrahedron it is in: made when it enters, so that steps within ask nothing of the mesh.
///
/// The barycentric coordinates of its three corners besides the cell's centre are λᵢ(x) = dᵢ·(x − o), that of the centre o is
/// λ₀ = 1 − Σλᵢ; a point is inside where none is negative, whichever way the corners turn. The velocity is u(x) = u₀ + G (x − o).
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Tetrahedron {
    /// o, the cell's centre, m.
    pub(super) origin: Vec3,
    /// dᵢ, 1/m.
    pub(super) dual: [Vec3; 3],
    /// u₀, m/s.
    pub(super) velocity: Vec3,
    /// G, 1/s.
    pub(super) gradient: [Vec3; 3],
    /// Its number.
    pub(super) id: u32,
    /// That of its cell.
    pub(crate) cell: u32,
    /// No wall is nearer to o than this, m.
    pub(crate) clear: f64,
}

/// A ratio of volume to the product of edges below which a tetrahedron is flat: its λᵢ are noise.
pub(super) const FLAT: f64 = 1e-12;

/// A point beyond a side by this share of a tetrahedron's height is in it, to rounding.
pub(super) const ROUNDING: f64 = 1e-9;
/// A change of λ that is no more than rounding, over the steepest λ and the way.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

impl fmt::Debug for Tetrahedron {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "tetrahedron {}", self.id)
    }
}

impl Tetrahedron {
    /// Outside everything.
    pub const NOWHERE: Self = Self {
        origin: [0.0; 3],
        dual: [[0.0; 3]; 3],
        velocity: [0.0; 3],
        gradient: [[0.0; 3]; 3],
        id: super::cut::NONE,
        cell: super::cut::NONE,
        clear: 0.0,
    };

    /// Whether it is one.
    #[inline(always)]
    pub fn is_nowhere(&self) -> bool {
        self.id == super::cut::NONE
    }

    /// u(x), m/s.
    #[inline(always)]
    pub(crate) fn velocity_at(&self, x: Vec3) -> Vec3 {
        let y = sub(x, self.origin);
        [0, 1, 2].map(|i| {
            let g = &self.gradient[i];
            g[2].mul_add(y[2], g[1].mul_add(y[1], g[0].mul_add(y[0], self.velocity[i])))
        })
    }

    /// λ₁, λ₂, λ₃ and λ₀.
    #[inline(always)]
    pub(crate) fn coordinates(&self, x: Vec3) -> [f64; 4] {
        let y = sub(x, self.origin);
        let [a, b, c] = self.dual.map(|d| dot(d, y));
        [a, b, c, 1.0 - (a + b + c)]
    }

    /// How λ of a side changes along a displacement.
    #[inline(always)]
    pub(crate) fn normal(&self, side: usize) -> Vec3 {
        let d = &self.dual;
        match side {
            0..3 => d[side],
            _ => [0, 1, 2].map(|c| -(d[0][c] + d[1][c] + d[2][c])),
        }
    }

    /// The first side that a path leaves by, and where on it; sides are numbered as the corners they face, the centre's last.
    #[inline(always)]
    pub(crate) fn exit(&self, path: &Path) -> Option<(f64, usize)> {
        let start = self.coordinates(path.start);
        let size = |v: Vec3| dot(v, v).sqrt();
        let rounded = -ROUNDED * self.dual.map(size).into_iter().fold(0.0, f64::max);
        let mut first: Option<(f64, usize)> = None;
        for (side, start) in start.into_iter().enumerate() {
            let n = self.normal(side);
            let (mut least, mut along) = (f64::INFINITY, start > -ROUNDING);
            for p in &path.points {
                let change = dot(n, *p);
                least = if change < least { change } else { least };
                along &= change > rounded * size(*p);
            }
            // what goes along a side does not leave by it: both pieces there would hand it to the other by rounding, for ever
            if along || start + least > 0.0 {
                continue;
            }
            let found = leaves(start, &path.along(n));
            if let Some(theta) = found.filter(|theta| first.is_none_or(|f| *theta < f.0)) {
                first = Some((theta, side));
            }
        }
        first
    }

    /// How soon a straight path leaves, s; infinite where it does not.
    #[inline(always)]
    pub(crate) fn soonest(&self, x: Vec3, v: Vec3) -> f64 {
        let (at, mut soonest) = (self.coordinates(x), f64::INFINITY);
        for (side, at) in at.into_iter().enumerate() {
            let rate = dot(self.normal(side), v);
            let time = -at / rate;
            if rate < 0.0 && time > 0.0 && time < soonest {
                soonest = time;
            }
        }
        soonest
    }

    /// The least way from a place to a side and on to the opposite one, m: about its width there.
    pub(crate) fn room(&self) -> f64 {
        let steepest = (0..4).map(|side| dot(self.normal(side), self.normal(side))).fold(0.0, f64::max);
        // two corners on one column have half of its coordinate each
        let [a, b, c] = self.dual;
        let halved = a == b || b == c || c == a;
        (if halved { 0.5 } else { 1.0 }) / steepest.sqrt()
    }
}

/// Where λ, from `start`, comes down through zero.
#[inline(always)]
fn leaves(start: f64, change: &Bernstein<6>) -> Option<f64> {
    crate::geometry::first_contact(start, change, 0.0, |_| true)
}
