//! Three-vectors, with a fixed order of operations.

use crate::impact::Vec3;

#[inline(always)]
pub(crate) fn dot(a: &Vec3, b: &Vec3) -> f64 {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

#[inline(always)]
pub(crate) fn norm(a: &Vec3) -> f64 {
    dot(a, a).sqrt()
}

#[inline(always)]
pub(crate) fn cross(a: &Vec3, b: &Vec3) -> Vec3 {
    [a[1].mul_add(b[2], -(a[2] * b[1])), a[2].mul_add(b[0], -(a[0] * b[2])), a[0].mul_add(b[1], -(a[1] * b[0]))]
}

/// a + s b.
#[inline(always)]
pub(crate) fn add_scaled(a: &Vec3, s: f64, b: &Vec3) -> Vec3 {
    [s.mul_add(b[0], a[0]), s.mul_add(b[1], a[1]), s.mul_add(b[2], a[2])]
}
