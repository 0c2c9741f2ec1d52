//! Three-vectors, with a fixed order of operations.

use crate::impact::Vec3;
use crate::math::{self, Fma};

#[inline(always)]
pub(crate) fn dot<F: Fma>(f: F, a: &Vec3, b: &Vec3) -> f64 {
    f.fma(a[0], b[0], f.fma(a[1], b[1], a[2] * b[2]))
}

#[inline(always)]
pub(crate) fn norm<F: Fma>(f: F, a: &Vec3) -> f64 {
    math::sqrt(dot(f, a, a))
}

#[inline(always)]
pub(crate) fn cross<F: Fma>(f: F, a: &Vec3, b: &Vec3) -> Vec3 {
    [f.fma(a[1], b[2], -(a[2] * b[1])), f.fma(a[2], b[0], -(a[0] * b[2])), f.fma(a[0], b[1], -(a[1] * b[0]))]
}

/// a + s b.
#[inline(always)]
pub(crate) fn add_scaled<F: Fma>(f: F, a: &Vec3, s: f64, b: &Vec3) -> Vec3 {
    [f.fma(s, b[0], a[0]), f.fma(s, b[1], a[1]), f.fma(s, b[2], a[2])]
}

/// a − b.
#[inline(always)]
pub(crate) fn minus(a: &Vec3, b: &Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + b.
#[inline(always)]
pub(crate) fn plus(a: &Vec3, b: &Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
