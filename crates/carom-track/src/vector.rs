//! Three-component vectors as plain arrays.

/// A vector in the laboratory frame.
pub(crate) type Vec3 = [f64; 3];

#[inline(always)]
pub(crate) fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(crate) fn scale(a: Vec3, s: f64) -> Vec3 {
    [a[0] * s, a[1] * s, a[2] * s]
}

#[inline(always)]
pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub(crate) fn norm(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// `a` as a unit vector; `None` where it has no direction or is not finite.
pub(crate) fn unit(a: Vec3) -> Option<Vec3> {
    let n = norm(a);
    (n > 0.0 && n.is_finite()).then(|| scale(a, 1.0 / n))
}

/// Two unit vectors that complete the unit vector `n` to a right-handed frame (t, b, n).
pub(crate) fn frame(n: Vec3) -> (Vec3, Vec3) {
    // the axis least aligned with n cannot be parallel to it
    let i = (0..3).fold(0, |best, i| if n[i].abs() < n[best].abs() { i } else { best });
    let mut axis = [0.0; 3];
    axis[i] = 1.0;
    let t = cross(axis, n);
    let t = scale(t, 1.0 / norm(t));
    (t, cross(n, t))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_right_handed_and_orthonormal() {
        for n in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, -0.8], [0.48, 0.6, 0.64]] {
            let (t, b) = frame(n);
            assert!(dot(t, n).abs() < 1e-15 && dot(b, n).abs() < 1e-15 && dot(t, b).abs() < 1e-15);
            assert!(norm(sub(cross(t, b), n)) < 1e-15);
        }
    }
}
