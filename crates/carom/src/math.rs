//! Logarithm, exponential and arc tangent with the same bits on every machine.
//!
//! The system's `ln`, `exp` and `powf` differ between C libraries by a last digit, which would make a result depend on
//! where it was computed. These leaves use a fixed order of operations and fused multiply-add only (both defined
//! exactly by IEEE 754), have no branches and no tables, and so also vectorise when they stand in a loop.
//! Relative errors stay below about 2 units in the last place of a double for `ln` (away from its zero, see the tests) and `exp`.
//!
//! Each leaf comes twice: `pow_on(f, …)` takes the multiply-add it is to be built of ([`Fma`]; the bits are the same), `pow(…)` takes
//! [`BEST`].

mod fma;
pub mod normal;
pub mod root;

pub use fma::{BEST, Best, Fma, Fused, Plain, Watched, watched};

/// √x, correctly rounded.
#[inline(always)]
pub fn sqrt(x: f64) -> f64 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    libm::sqrt(x)
}

/// The largest whole number that is not above x.
#[inline(always)]
pub fn floor(x: f64) -> f64 {
    #[cfg(feature = "std")]
    return x.floor();
    #[cfg(not(feature = "std"))]
    libm::floor(x)
}

/// What [`f64`] can do with the standard library, for modules that stand above the kernel and are written with it.
#[cfg(not(feature = "std"))]
pub(crate) trait Plainly {
    fn sqrt(self) -> f64;
    fn round(self) -> f64;
    fn fract(self) -> f64;
}

#[cfg(not(feature = "std"))]
impl Plainly for f64 {
    fn sqrt(self) -> f64 {
        libm::sqrt(self)
    }
    fn round(self) -> f64 {
        libm::round(self)
    }
    fn fract(self) -> f64 {
        self - libm::trunc(self)
    }
}

/// ∛x, correctly rounded.
///
/// ```
/// assert_eq!(carom::math::cbrt(-27.0), -3.0);
/// ```
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// Angle in radians, (−π, π], of the direction (`x`, `y`), to less than one unit in the last place.
///
/// ```
/// assert_eq!(carom::math::atan2(1.0, 0.0), std::f64::consts::FRAC_PI_2);
/// ```
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// xⁿ by repeated squaring, in a fixed order; exact where all products are. A negative power is the inverse of the positive one.
///
/// ```
/// assert_eq!(carom::math::powi(2.0, -1022), f64::MIN_POSITIVE);
/// assert_eq!(carom::math::powi(10.0, 3), 1000.0);
/// ```
pub fn powi(x: f64, n: i32) -> f64 {
    let (mut result, mut square, mut left) = (1.0, x, n.unsigned_abs());
    loop {
        if left & 1 == 1 {
            result *= square;
        }
        left >>= 1;
        if left == 0 {
            break;
        }
        square *= square;
    }
    if n < 0 { 1.0 / result } else { result }
}

/// Natural logarithm of a positive, finite, normal number.
///
/// Outside that domain (zero, negative, subnormal, infinite, NaN) the value is unspecified but the call is safe:
/// callers clamp first.
///
/// ```
/// assert!((carom::math::ln(10.0) - std::f64::consts::LN_10).abs() < 1e-15);
/// assert_eq!(carom::math::ln(1.0), 0.0);
/// ```
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    ln_on(BEST, x)
}

/// As [`ln`].
#[inline(always)]
pub fn ln_on<F: Fma>(f: F, x: f64) -> f64 {
    let (k, s) = reduce(x);
    let z = s * s;
    // Σ zⁿ/(2n + 3), in pairs and pairs of pairs: a short chain of dependent operations
    let z2 = z * z;
    let z4 = z2 * z2;
    let pair = |high: f64, low: f64| f.horner(1.0 / high, z, 1.0 / low);
    let a = f.horner(pair(9.0, 7.0), z2, pair(5.0, 3.0));
    let b = f.horner(pair(17.0, 15.0), z2, pair(13.0, 11.0));
    let c = f.horner(1.0 / 23.0, z2, pair(21.0, 19.0));
    let p = f.horner(f.horner(c, z4, b), z4, a);
    let tail = (s * z) * p;
    let low = f.fma(k, LN2_LOW, 2.0 * tail);
    f.fma(k, LN2_HIGH, f.fma(2.0, s, low))
}

/// x = 2^k · m with m in [√½, √2): (k, (m − 1)/(m + 1)), so that ln x = k ln 2 + 2 artanh(s).
#[inline(always)]
fn reduce(x: f64) -> (f64, f64) {
    const SQRT_HALF: u64 = 0x3FE6_A09E_0000_0000;
    const EXPONENT: u64 = 0xFFF0_0000_0000_0000;
    let bits = x.to_bits();
    let shifted = bits.wrapping_sub(SQRT_HALF);
    let m = f64::from_bits(bits.wrapping_sub(shifted & EXPONENT));
    // The exponent as a double without an integer conversion (AVX2 has none for 64 bits).
    let biased = shifted.wrapping_add(1023 << 52) >> 52;
    let k = f64::from_bits(biased | 0x4330_0000_0000_0000) - (4_503_599_627_370_496.0 + 1023.0);
    (k, (m - 1.0) / (m + 1.0))
}

/// 1.5 · 2^52: adding it rounds to an integer and keeps that in the low bits.
const SHIFT: f64 = 6_755_399_441_055_744.0;

/// ln 2 split so that `k · LN2_HIGH` is exact for every exponent of a double.
const LN2_HIGH: f64 = f64::from_bits(0x3FE6_2E42_FEE0_0000);
const LN2_LOW: f64 = f64::from_bits(0x3DEA_39EF_3579_3C76);

/// Exponential. Arguments are clamped to [−708, 709], so the result is always normal and finite (NaN stays NaN).
///
/// ```
/// assert!((carom::math::exp(1.0) - std::f64::consts::E).abs() < 1e-15);
/// assert_eq!(carom::math::exp(0.0), 1.0);
/// ```
#[inline(always)]
pub fn exp(x: f64) -> f64 {
    exp_on(BEST, x)
}

/// As [`exp`].
#[inline(always)]
pub fn exp_on<F: Fma>(f: F, x: f64) -> f64 {
    // written so that a NaN survives: comparisons with it are false
    let x = if x < -708.0 { -708.0 } else { x };
    let x = if x > 709.0 { 709.0 } else { x };
    let shifted = f.horner(x, core::f64::consts::LOG2_E, SHIFT);
    let k = shifted - SHIFT;
    let r = f.fma(k, -LN2_LOW, f.fma(k, -LN2_HIGH, x));
    // Σ rⁿ/(n + 2)!, likewise
    let r2 = r * r;
    let r4 = r2 * r2;
    let pair = |high: f64, low: f64| f.horner(1.0 / high, r, 1.0 / low);
    let a = f.horner(pair(120.0, 24.0), r2, pair(6.0, 2.0));
    let b = f.horner(pair(362_880.0, 40_320.0), r2, pair(5_040.0, 720.0));
    let c = f.horner(pair(6_227_020_800.0, 479_001_600.0), r2, pair(39_916_800.0, 3_628_800.0));
    let p = f.horner(f.horner(c, r4, b), r4, a);
    let p = f.horner(p, r2, r) + 1.0;
    f64::from_bits(p.to_bits().wrapping_add(shifted.to_bits() << 52))
}

/// x^y for positive, finite, normal x; the result is clamped to the normal numbers as in [`exp`].
///
/// Through the logarithm and the exponential to base 2, which need no multiples of ln 2: shorter than `exp(y ln x)`, and as good
/// while |y log₂ x| stays small (relative error about |y log₂ x| · 2⁻⁵²).
///
/// ```
/// assert!((carom::math::pow(2.0, 0.5) - 2f64.sqrt()).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn pow(x: f64, y: f64) -> f64 {
    pow_on(BEST, x, y)
}

/// As [`pow`].
#[inline(always)]
pub fn pow_on<F: Fma>(f: F, x: f64, y: f64) -> f64 {
    exp2_on(f, y * log2_on(f, x))
}

/// log₂ x, domain as [`ln`].
#[inline(always)]
pub fn log2(x: f64) -> f64 {
    log2_on(BEST, x)
}

/// As [`log2`].
#[inline(always)]
pub fn log2_on<F: Fma>(f: F, x: f64) -> f64 {
    use core::f64::consts::LOG2_E;
    let (k, s) = reduce(x);
    let z = s * s;
    let z2 = z * z;
    let z4 = z2 * z2;
    // (artanh(s)/s − 1)/z · 2/ln 2 to a relative 2e-18 of log₂ m: best approximation of degree six, by Remez' exchange
    const C: [f64; 7] = [
        0.961_796_693_925_985_4,
        0.577_078_016_347_130_7,
        0.412_198_585_580_056_44,
        0.320_598_556_513_415_2,
        0.262_333_396_302_315_7,
        0.220_934_625_579_232_3,
        0.213_464_901_520_120_87,
    ];
    let pair = |low: usize| f.horner(C[low + 1], z, C[low]);
    let a = f.horner(pair(2), z2, pair(0));
    let b = f.horner(C[6], z2, pair(4));
    let p = f.horner(b, z4, a);
    f.horner(s * z, p, f.horner(s, 2.0 * LOG2_E, k))
}

/// 2^t.
#[inline(always)]
pub fn exp2(t: f64) -> f64 {
    exp2_on(BEST, t)
}

/// As [`exp2`].
#[inline(always)]
pub fn exp2_on<F: Fma>(f: F, t: f64) -> f64 {
    use core::f64::consts::LN_2;
    let t = if t < -1020.0 { -1020.0 } else { t };
    let t = if t > 1022.0 { 1022.0 } else { t };
    let shifted = t + SHIFT;
    let r = t - (shifted - SHIFT);
    // (2^r − 1 − r ln 2)/r² to 4e-18 of 2^r: best approximation of degree nine
    const C: [f64; 10] = [
        0.240_226_506_959_101_22,
        0.055_504_108_664_820_73,
        0.009_618_129_107_596_99,
        0.001_333_355_814_668_604_8,
        1.540_353_045_405_673e-4,
        1.525_273_354_692_432_2e-5,
        1.321_543_661_421_405_2e-6,
        1.017_818_463_938_340_6e-7,
        7.073_578_420_173_589e-9,
        4.436_304_380_985_355e-10,
    ];
    let r2 = r * r;
    let r4 = r2 * r2;
    let pair = |low: usize| f.horner(C[low + 1], r, C[low]);
    let a = f.horner(pair(2), r2, pair(0));
    let b = f.horner(pair(6), r2, pair(4));
    let p = f.horner(f.horner(pair(8), r4, b), r4, a);
    let p = f.horner(p, r2, r * LN_2) + 1.0;
    f64::from_bits(p.to_bits().wrapping_add(shifted.to_bits() << 52))
}

/// Sine and cosine of an angle in [−2π, 2π] (beyond, the reduction loses digits), to about one unit in the last place of 1.
///
/// ```
/// let (s, c) = carom::math::sin_cos(std::f64::consts::FRAC_PI_6);
/// assert!((s - 0.5).abs() < 1e-15 && (c - 0.75f64.sqrt()).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    sin_cos_on(BEST, x)
}

/// As [`sin_cos`].
#[inline(always)]
pub fn sin_cos_on<F: Fma>(f: F, x: f64) -> (f64, f64) {
    use core::f64::consts::{FRAC_2_PI, FRAC_PI_2};
    /// π/2 less its double.
    const PI_2_LOW: f64 = 6.123_233_995_736_766e-17;
    let k = f.fma(x, FRAC_2_PI, SHIFT) - SHIFT;
    let r = f.fma(k, -PI_2_LOW, f.fma(k, -FRAC_PI_2, x));
    let z = r * r;
    // not steps of `horner`: beyond the range r is not small. Taylor series on |r| ≤ π/4, 1/n! with alternating signs
    let series = |c: [f64; 8]| c.iter().rev().fold(0.0f64, |sum, &a| f.fma(sum, z, a));
    const FACTORIALS: [f64; 18] = {
        let mut f = [1.0; 18];
        let mut n = 1;
        while n < 18 {
            f[n] = f[n - 1] * n as f64;
            n += 1;
        }
        f
    };
    let sign = |n: usize| if n.is_multiple_of(2) { 1.0 } else { -1.0 };
    let s = f.fma(r * z, series(core::array::from_fn(|n| sign(n + 1) / FACTORIALS[2 * n + 3])), r);
    let c = f.fma(series(core::array::from_fn(|n| sign(n + 1) / FACTORIALS[2 * n + 2])), z, 1.0);
    match (k as i64).rem_euclid(4) {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// Angle in radians, [0, π/2], of the direction (`along`, `up`), both ≥ 0 and not both zero: the angle of incidence
/// measured from the surface when `along` is the tangential and `up` the normal speed.
///
/// ```
/// assert!((carom::math::angle(1.0, 1.0) - std::f64::consts::FRAC_PI_4).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn angle(along: f64, up: f64) -> f64 {
    angle_on(BEST, along, up)
}

/// As [`angle`].
#[inline(always)]
pub fn angle_on<F: Fma>(f: F, along: f64, up: f64) -> f64 {
    // Three halvings of the angle bring the tangent below tan(π/16), where the series is short.
    let mut t = up / (along + sqrt(f.fma(along, along, up * up)));
    t /= 1.0 + sqrt(f.horner(t, t, 1.0));
    t /= 1.0 + sqrt(f.horner(t, t, 1.0));
    let z = t * t;
    let mut p: f64 = 1.0 / 25.0;
    for c in [
        -1.0 / 23.0,
        1.0 / 21.0,
        -1.0 / 19.0,
        1.0 / 17.0,
        -1.0 / 15.0,
        1.0 / 13.0,
        -1.0 / 11.0,
        1.0 / 9.0,
        -1.0 / 7.0,
        1.0 / 5.0,
        -1.0 / 3.0,
    ] {
        p = f.horner(p, z, c);
    }
    8.0 * f.horner(t * z, p, t)
}

#[cfg(test)]
mod tests;
