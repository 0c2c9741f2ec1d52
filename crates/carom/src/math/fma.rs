//! Multiplication and addition with one rounding, on every processor.
//!
//! The leaves of [`math`](crate::math) and the kernels built of them are generic over how a·b + c is rounded once: [`Fused`] where the
//! processor does it, [`Plain`] and [`Watched`] where it does not. The result is the same number, to the bit. What a function is compiled
//! for (`#[target_feature]`) is not visible to `cfg!`, so the caller that knows passes the value.
//!
//! Without the instruction the product is split into two numbers, a·b = u − n exactly, and so is the sum u + c = v − w; n + w is
//! rounded to odd, so that the last addition, v − (n + w), rounds as if the sum had been exact (Boldo & Melquiond 2008, IEEE Trans.
//! Comput. 57, 462–471, doi:10.1109/TC.2007.70819). Splitting: Dekker 1971, Numer. Math. 18, 224–242, doi:10.1007/BF01397083; sums:
//! Knuth. That holds while nothing overflows and the low half of the product is not lost below the subnormal numbers.

use core::cell::Cell;

/// How a·b + c is rounded once. Passed by value: it holds nothing, or one reference.
pub trait Fma: Copy {
    /// a·b + c, rounded once, to nearest even: what IEEE 754 calls fusedMultiplyAdd.
    fn fma(self, a: f64, b: f64, c: f64) -> f64;

    /// p·z + c where |p·z| ≤ |c| or c = 0, p·z is 0 or above 2⁻⁹⁶⁸ or lost beside c, and nothing is above 2⁹⁶⁰: a step of Horner's rule.
    /// The same number as [`Fma::fma`], sooner without the instruction; most so if z is shared or constant.
    #[inline(always)]
    fn horner(self, p: f64, z: f64, c: f64) -> f64 {
        self.fma(p, z, c)
    }
}

/// The processor's instruction: for code compiled with it ([`f64::mul_add`] elsewhere calls the platform's library).
#[derive(Clone, Copy, Debug, Default)]
pub struct Fused;

impl Fma for Fused {
    #[inline(always)]
    fn fma(self, a: f64, b: f64, c: f64) -> f64 {
        #[cfg(feature = "std")]
        return a.mul_add(b, c);
        #[cfg(not(feature = "std"))]
        libm::fma(a, b, c)
    }
}

/// Plain additions and multiplications, exact for all numbers: where they do not suffice (see [`Watched`]), integers do it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

impl Fma for Plain {
    #[inline(always)]
    fn fma(self, a: f64, b: f64, c: f64) -> f64 {
        let (rounded, u) = emulated(a, b, c);
        if is_exact(a, b, u, rounded) { rounded } else { by_integers(a, b, c) }
    }

    #[inline(always)]
    fn horner(self, p: f64, z: f64, c: f64) -> f64 {
        emulated_onto(p, z, c)
    }
}

/// Plain additions and multiplications without branches, for loops over many numbers; made by [`watched`], which also says whether
/// every result was exact. It was if no product (of two numbers other than 0) was below 2⁻⁹⁶⁸ and nothing infinite or NaN arose.
#[derive(Clone, Copy, Debug)]
pub struct Watched<'a>(&'a Cell<bool>);

impl Fma for Watched<'_> {
    #[inline(always)]
    fn fma(self, a: f64, b: f64, c: f64) -> f64 {
        let (rounded, u) = emulated(a, b, c);
        self.0.set(self.0.get() & is_exact(a, b, u, rounded));
        rounded
    }

    #[inline(always)]
    fn horner(self, p: f64, z: f64, c: f64) -> f64 {
        emulated_onto(p, z, c)
    }
}

/// Runs a loop with [`Watched`]: its result, and whether it is exact. If not, the loop must be run again with [`Plain`].
#[inline(always)]
pub fn watched<R>(body: impl FnOnce(Watched) -> R) -> (R, bool) {
    let exact = Cell::new(true);
    let result = body(Watched(&exact));
    (result, exact.get())
}

/// Below this magnitude the low half of a product may be lost.
const SMALLEST_PRODUCT: f64 = f64::from_bits((1023 - 968) << 52);

/// Whether [`emulated`] was exact: `u` = a·b rounded. All that overflows on the way ends as NaN.
#[inline(always)]
fn is_exact(a: f64, b: f64, u: f64, rounded: f64) -> bool {
    !((u.abs() < SMALLEST_PRODUCT) & (a != 0.0) & (b != 0.0) | rounded.is_nan())
}

#[cold]
#[inline(never)]
fn by_integers(a: f64, b: f64, c: f64) -> f64 {
    libm::fma(a, b, c)
}

/// a·b + c rounded once, and a·b rounded.
#[inline(always)]
fn emulated(a: f64, b: f64, c: f64) -> (f64, f64) {
    let (u, n) = product(a, b);
    let (v, w) = sum(u, c);
    let (low, lost) = sum(w, n);
    (v - to_odd(low, -lost), u)
}

/// As [`emulated`] where |p·z| ≤ |c| or c = 0. Then w is 0 or at least twice n, and both sums take three operations.
#[inline(always)]
fn emulated_onto(p: f64, z: f64, c: f64) -> f64 {
    debug_assert!(c == 0.0 || (p * z).abs() <= c.abs() || !(p * z).is_finite(), "{p:e} * {z:e} + {c:e}");
    let (u, n) = product(p, z);
    let v = c + u;
    let w = (v - c) - u;
    let low = w + n;
    v - to_odd(low, n - (low - w))
}

/// (u, n) with a·b = u − n exactly, u = a·b rounded; n is never −0.
///
/// `a` is cut after 26 bits, `b` rounded after 26: then al has 27 bits and bl 26, and each partial product and each partial
/// difference fits into 53 (counted in units of the last places of a and b).
#[inline(always)]
fn product(a: f64, b: f64) -> (f64, f64) {
    const HIGH: u64 = !((1 << 27) - 1);
    let u = a * b;
    let a_high = f64::from_bits(a.to_bits() & HIGH);
    let a_low = a - a_high;
    let b_high = f64::from_bits(b.to_bits().wrapping_add(1 << 26) & HIGH);
    let b_low = b - b_high;
    (u, (((u - a_high * b_high) - a_low * b_high) - a_high * b_low) - a_low * b_low)
}

/// (s, w) with a + b = s − w exactly, s = a + b rounded; w is never −0, so that s − w keeps the sign of a zero.
#[inline(always)]
fn sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let b_part = s - a;
    (s, ((s - b_part) - a) + (b_part - b))
}

/// s + e rounded to odd, where s is that sum rounded to nearest: if it is not exact, the neighbour of s + e whose last bit is set.
#[inline(always)]
fn to_odd(s: f64, e: f64) -> f64 {
    let inexact = if e != 0.0 { u64::MAX } else { 0 };
    let beyond = ((s.to_bits() ^ e.to_bits()) & inexact) >> 63;
    f64::from_bits(s.to_bits().wrapping_sub(beyond) | inexact >> 63)
}

/// What functions use that are not told: the instruction where it may be there.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "fma"))]
pub type Best = Fused;
/// What functions use that are not told: the instruction where it may be there.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "fma")))]
pub type Best = Plain;

/// The value of [`Best`].
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "fma"))]
pub const BEST: Best = Fused;
/// The value of [`Best`].
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "fma")))]
pub const BEST: Best = Plain;

#[cfg(test)]
mod tests;
