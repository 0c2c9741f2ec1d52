//! Impacts of any kind, and vectors.

use carom::{Impact, Vec3};
use proptest::prelude::*;

/// A unit vector.
pub fn direction() -> impl Strategy<Value = Vec3> {
    [-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64].prop_filter("not zero", |v| dot(v, v) > 0.01).prop_map(|v| {
        let n = dot(&v, &v).sqrt();
        [v[0] / n, v[1] / n, v[2] / n]
    })
}

/// Scalar product.
pub fn dot(a: &Vec3, b: &Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product.
pub fn cross(a: &Vec3, b: &Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Rotation by `angle` about the unit vector `axis`.
pub fn rotate(v: &Vec3, axis: &Vec3, angle: f64) -> Vec3 {
    let (s, c) = angle.sin_cos();
    let (x, along) = (cross(axis, v), dot(axis, v));
    std::array::from_fn(|i| c * v[i] + s * x[i] + (1.0 - c) * along * axis[i])
}

/// An approaching sphere: log-uniform in speed and size, any angle, any spin, any wall velocity.
pub fn impacts() -> impl Strategy<Value = Impact> {
    let speed = (-4.0..2.5f64).prop_map(|x| 10f64.powf(x));
    let diameter = (-6.5..-2.5f64).prop_map(|x| 10f64.powf(x));
    (speed, diameter, direction(), direction(), direction(), -2.0..2.0f64, direction(), 0.0..30.0f64).prop_map(
        |(speed, diameter, normal, heading, axis, spin, wall, wall_speed)| {
            let toward = dot(&heading, &normal);
            let heading: Vec3 = if toward < 0.0 { heading } else { heading.map(|h| -h) };
            let mut impact = Impact::new(diameter, [0.0; 3], normal);
            impact.wall_velocity = wall.map(|w| w * wall_speed);
            impact.velocity = std::array::from_fn(|i| speed * heading[i] + impact.wall_velocity[i]);
            impact.spin = axis.map(|a| a * spin * speed / diameter);
            impact
        },
    )
}

/// Equal to within `scale` in every component?
pub fn close(a: &Vec3, b: &Vec3, scale: f64) -> bool {
    (0..3).all(|i| (a[i] - b[i]).abs() <= scale)
}
