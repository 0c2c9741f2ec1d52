//! Rough walls that scatter: each impact meets a facet of the wall, tilted by a random roughness angle γ.
//!
//! A sphere that comes in at the angle α from the mean wall meets facets turned towards it more often than facets turned away, and
//! none that lie in their own shadow (Sommerfeld & Huber 1999, Int. J. Multiphase Flow 25, 1457–1489,
//! <https://doi.org/10.1016/S0301-9322(99)00037-6>):
//!
//! p(γ) ∝ e^{−γ²/2Δγ²} sin(α + γ)/sin α,  −α < γ < π/2.
//!
//! γ > 0 turns the facet towards the incoming sphere, which then meets it at α + γ. The facet is also turned sideways, out of the plane
//! of incidence, by a Gaussian δ of the same deviation, |δ| < π/2: seen along the path a facet's width times its slope sideways does
//! not change, so that δ has no shadow weight. A head-on sphere has no plane of incidence: the axes are then fixed ones of the wall.
//!
//! The impact on the facet is the smooth law's. Where the sphere then still moves into the mean wall it hits a second facet, drawn anew
//! for its new direction, and if need be the mean wall itself: three impacts at most, and never a rebound into the wall. A rebound that
//! leaves at a small angle may in reality meet the next asperity (Konan, Kannengieser & Simonin 2009, Int. J. Multiphase Flow 35,
//! 933–945): that is not in it, so grazing rebounds are somewhat too many.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Δγ | standard deviation of the roughness angle, up to 30° | rad |
//! | α | angle of incidence from the mean wall | rad |
//! | γ, δ | tilt of the facet in the plane of incidence and out of it | rad |
//!
//! **Sampling.** γ is the inverse of the distribution at one uniform draw. With x = γ/Δγ,
//! ∫ φ(x) sin(α + Δγ x) dx = e^{−Δγ²/2} Im[e^{iα} Φ(x − iΔγ)], and Φ(x − iσ) = Φ(x) − φ(x) Σ_{n≥1} (iσ)ⁿ He_{n−1}(x)/n!, whose
//! terms fall fast for σ ≤ 0.53; the root is found by Halley's steps kept within a shrinking bracket. No draw is rejected.
//! The draws of an [`Impact`](crate::Impact) are, in order, γ and δ of the first facet, γ and δ of the second. All at ½ give the
//! median of γ and no tilt sideways.
//!
//! **The outcome speaks of the mean wall.** e = V_n/v_n, μ = |Δv_t|/Δv_n and e_t = V_t/v_t take the speeds along and normal to it.
//! Energy fractions are ≥ 0 and sum to 1, and no energy is gained, spin included; e is ≥ 0 but may exceed 1 at shallow angles, where a
//! facet turns tangential speed into normal speed, and μ may exceed the friction coefficient, because a facet pushes sideways too.
//! Capture is decided by the speed normal to the facet. Capture velocity and critical angle of the law stay those of a smooth wall.
//!
//! ```
//! use carom::scatter::Scatter;
//! let rough = Scatter::new(5f64.to_radians());
//! // a grazing sphere, α = 2°, meets facets turned towards it: one in two by more than 4.8°
//! let alpha = 2f64.to_radians();
//! let median = rough.tilt(alpha.sin(), alpha.cos(), 0.5);
//! assert!((median.to_degrees() - 4.846).abs() < 1e-3);
//! ```

use crate::impact::Vec3;
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use crate::math::normal::{normal_density_on, normal_probability, normal_quantile_on};
use crate::math::{self, BEST, Fma, angle_on, exp_on, sin_cos_on};
use crate::vector::{cross, dot, norm};
use core::f64::consts::FRAC_PI_2;

/// Greatest Δγ, rad: 30°, far beyond measured walls (2° to 10°), and what the series is tested to.
pub const LARGEST: f64 = core::f64::consts::PI / 6.0;
/// Deviates beyond this many standard deviations do not come from draws of 53 bits.
const FAR: f64 = 8.5;
/// The smallest probability inverted: half the step of a draw.
const SMALLEST: f64 = 1.0 / (1u64 << 54) as f64;

/// A wall whose facets are tilted by a Gaussian roughness angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    deviation: f64,
    /// Terms of the series of Φ(x − iΔγ) that count.
    terms: u32,
}

/// Integral of φ(x) sin(α + σx), times e^{σ²/2}, with x = γ/σ.
struct Weighted {
    sin: f64,
    cos: f64,
    sigma: f64,
    terms: u32,
}

impl Weighted {
    /// The integral from −∞ to `x`.
    #[inline(always)]
    fn integral<F: Fma>(&self, f: F, x: f64) -> f64 {
        let (mut real, mut imaginary) = (0.0, 0.0);
        let (mut he, mut before, mut power) = (1.0, 0.0, self.sigma);
        for n in 1..=self.terms {
            let term = power * he;
            // iⁿ for n = 1, 2, 3, 4, ...
            match n % 4 {
                1 => imaginary += term,
                2 => real -= term,
                3 => imaginary -= term,
                _ => real += term,
            }
            // He_n = x He_{n−1} − (n − 1) He_{n−2}; the power is σⁿ/n!
            (he, before) = (x * he - f64::from(n - 1) * before, he);
            power *= self.sigma / f64::from(n + 1);
        }
        let density = normal_density_on(f, x);
        self.sin * (normal_probability(x) - density * real) - self.cos * density * imaginary
    }

    /// sin(α + σx) and cos(α + σx).
    #[inline(always)]
    fn direction<F: Fma>(&self, f: F, x: f64) -> (f64, f64) {
        let (s, c) = sin_cos_on(f, self.sigma * x);
        (self.sin * c + self.cos * s, self.cos * c - self.sin * s)
    }
}

impl Scatter {
    /// A wall of the deviation Δγ in rad, above 0 and up to [`LARGEST`]; beyond, it is taken as that.
    pub fn new(deviation: f64) -> Self {
        let deviation = deviation.clamp(0.0, LARGEST);
        // |φ He_{n−1}| stays below √n!, so that a term is below σⁿ/√n!: 22 of them at the largest σ, 12 at 5°
        let (mut terms, mut bound) = (1, deviation);
        while bound > 1e-17 {
            terms += 1;
            bound *= deviation / f64::from(terms).sqrt();
        }
        Self { deviation, terms }
    }

    /// Δγ, rad.
    pub fn deviation(&self) -> f64 {
        self.deviation
    }

    /// The limits of γ/Δγ.
    #[inline(always)]
    fn ends<F: Fma>(&self, f: F, sin: f64, cos: f64) -> (f64, f64) {
        (-(angle_on(f, cos, sin) / self.deviation).min(FAR), (FRAC_PI_2 / self.deviation).min(FAR))
    }

    #[inline(always)]
    fn weighted(&self, sin: f64, cos: f64) -> Weighted {
        Weighted { sin, cos, sigma: self.deviation, terms: self.terms }
    }

    /// Density of γ (rad) at the angle of incidence α, given by its sine and cosine (both ≥ 0), 1/rad.
    pub fn density(&self, sin: f64, cos: f64, gamma: f64) -> f64 {
        self.density_on(BEST, sin, cos, gamma)
    }

    fn density_on<F: Fma>(&self, f: F, sin: f64, cos: f64, gamma: f64) -> f64 {
        let weighted = self.weighted(sin, cos);
        let (low, high) = self.ends(f, sin, cos);
        let x = gamma / self.deviation;
        if !(low..=high).contains(&x) {
            return 0.0;
        }
        let whole = weighted.integral(f, high) - weighted.integral(f, low);
        let scale = exp_on(f, 0.5 * self.deviation * self.deviation);
        scale * normal_density_on(f, x) * weighted.direction(f, x).0 / (whole * self.deviation)
    }

    /// γ, rad, in (−α, π/2), for a uniform draw in [0, 1) and the angle of incidence α, given by its sine and cosine (both ≥ 0).
    pub fn tilt(&self, sin: f64, cos: f64, draw: f64) -> f64 {
        self.tilt_on(BEST, sin, cos, draw)
    }

    #[inline(always)]
    fn tilt_on<F: Fma>(&self, f: F, sin: f64, cos: f64, draw: f64) -> f64 {
        let weighted = self.weighted(sin, cos);
        let (mut low, mut high) = self.ends(f, sin, cos);
        let from = weighted.integral(f, low);
        let draw = draw.max(SMALLEST);
        let wanted = draw * (weighted.integral(f, high) - from);
        // where it would be without the shadow's weight
        let below = normal_probability(low);
        let mut x = normal_quantile_on(f, (below + draw * (normal_probability(high) - below)).max(SMALLEST));
        let scale = exp_on(f, 0.5 * self.deviation * self.deviation);
        for _ in 0..100 {
            if !(x > low && x < high) {
                x = 0.5 * (low + high);
            }
            let excess = weighted.integral(f, x) - from - wanted;
            if excess > 0.0 {
                high = x
            } else {
                low = x
            }
            let (s, c) = weighted.direction(f, x);
            let slope = scale * normal_density_on(f, x) * s;
            let newton = excess / slope;
            // Halley: the logarithmic derivative of the slope is σ cot(α + σx) − x
            let step = newton / (1.0 - 0.5 * newton * (self.deviation * c / s - x));
            let next = x - step;
            if step.abs() <= 1e-15 * (1.0 + x.abs()) || high - low <= 1e-15 * (1.0 + x.abs()) {
                break;
            }
            x = next;
        }
        self.deviation * x
    }

    /// δ, rad, in (−π/2, π/2), for a uniform draw in [0, 1).
    pub fn sideways(&self, draw: f64) -> f64 {
        self.sideways_on(BEST, draw)
    }

    #[inline(always)]
    fn sideways_on<F: Fma>(&self, f: F, draw: f64) -> f64 {
        let end = (FRAC_PI_2 / self.deviation).min(FAR);
        let below = normal_probability(-end);
        let p = below + draw * (1.0 - 2.0 * below);
        self.deviation * normal_quantile_on(f, p.clamp(SMALLEST, 1.0 - f64::EPSILON)).clamp(-end, end)
    }

    /// The facet that a sphere meets which moves at `relative` (m/s) to the mean wall and not away from it: its unit normal.
    #[inline(always)]
    pub(crate) fn facet<F: Fma>(&self, f: F, relative: &Vec3, normal: &Vec3, draws: [f64; 2]) -> Vec3 {
        let v_n = (-dot(f, relative, normal)).max(0.0);
        let along: Vec3 = core::array::from_fn(|i| f.fma(v_n, normal[i], relative[i]));
        let v_t = norm(f, &along);
        let speed = math::sqrt(f.fma(v_n, v_n, v_t * v_t));
        let forward = if v_t > 0.0 { along.map(|c| c / v_t) } else { any_tangent(f, normal) };
        let side = cross(f, normal, &forward);
        let (s, c) = sin_cos_on(f, self.tilt_on(f, v_n / speed, v_t / speed, draws[0]));
        let (s_side, c_side) = sin_cos_on(f, self.sideways_on(f, draws[1]));
        let facet: Vec3 = core::array::from_fn(|i| c_side * (c * normal[i] - s * forward[i]) + s_side * side[i]);
        let length = norm(f, &facet);
        facet.map(|c| c / length)
    }
}

/// A unit vector along a wall: the coordinate axis nearest to it, laid on it.
fn any_tangent<F: Fma>(f: F, normal: &Vec3) -> Vec3 {
    let axis = (1..3).fold(0, |best, i| if normal[i].abs() < normal[best].abs() { i } else { best });
    let mut along = normal.map(|n| -normal[axis] * n);
    along[axis] += 1.0;
    let length = norm(f, &along);
    along.map(|c| c / length)
}
