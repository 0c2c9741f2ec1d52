//! The `wall-jet` boundary: a drop or sphere that hits a plate in a jet leaves along the plate, in a direction drawn from
//! how the jet's momentum spreads over it (Naber & Reitz 1988, SAE 880107; as in Fluent's theory guide, discrete phase,
//! wall-jet).
//!
//! The flow off the plate within dψ of the incoming direction goes as e^{β(1−ψ/π)}, 0 ≤ ψ ≤ π on either side, β from the
//! jet's momentum along the plate, with φ the angle between the path and the wall's normal:
//!
//! sin φ = (e^β + 1)/(e^β − 1) · 1/(1 + (π/β)²),   ψ = −(π/β) ln[1 − P(1 − e^{−β})], P uniform.
//!
//! The speed is kept. A thing that is pressed against such a wall at rest has nowhere to go and settles.

use crate::vector::{Vec3, add, cross, dot, norm, scale, sub};
use carom::math::{exp, ln, sin_cos};
use std::f64::consts::PI;

/// The velocity after the wall, from the one before (both relative to it) and two uniform draws; `None` where it does not
/// approach.
pub(super) fn leave(v: Vec3, n: Vec3, draws: [f64; 2]) -> Option<Vec3> {
    let speed = norm(v);
    let along = sub(v, scale(n, dot(v, n)));
    let tangential = norm(along);
    if dot(v, n) >= -1e-12 * speed {
        return None;
    }
    let forward = if tangential > 0.0 { scale(along, 1.0 / tangential) } else { crate::vector::frame(n).0 };
    let psi = spread(tangential / speed, draws[0]);
    let psi = if draws[1] < 0.5 { psi } else { -psi };
    let (sin, cos) = sin_cos(psi);
    // a trace of outward speed keeps rounding from pressing it onto the wall
    let outward = scale(n, 1e-13 * speed);
    Some(add(outward, add(scale(forward, speed * cos), scale(cross(n, forward), speed * sin))))
}

/// ψ for the sine of the angle of impingement from the normal and a uniform draw.
fn spread(sine: f64, draw: f64) -> f64 {
    let beta = concentration(sine);
    if beta < 1e-6 {
        return PI * draw;
    }
    -PI / beta * ln((1.0 - draw * (1.0 - exp(-beta))).max(1e-300))
}

/// β, by halving: the right-hand side rises from 0 to 1.
fn concentration(sine: f64) -> f64 {
    let share = |beta: f64| {
        let e = exp(-beta);
        (1.0 + e) / (1.0 - e) / (1.0 + (PI / beta) * (PI / beta))
    };
    let (mut low, mut high) = (1e-6, 700.0);
    if sine <= share(low) {
        return 0.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if share(middle) < sine { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_normal_jet_spreads_evenly_and_a_grazing_one_goes_on() {
        assert!((spread(0.0, 0.25) - 0.25 * PI).abs() < 1e-12);
        assert!(spread(0.999, 0.5) < 0.05);
    }

    #[test]
    fn the_spread_carries_the_jets_momentum_along_the_plate() {
        // ∫ e^{β(1−ψ/π)} cos ψ dψ over ∫ e^{β(1−ψ/π)} dψ must be sin φ: momentum is kept along the plate
        for degrees in [10.0f64, 30.0, 45.0, 70.0] {
            let sine = degrees.to_radians().sin();
            let n = 20_000;
            let mean =
                (0..n).map(|i| spread(sine, (f64::from(i) + 0.5) / f64::from(n)).cos()).sum::<f64>() / f64::from(n);
            assert!((mean - sine).abs() < 1e-6, "{degrees}: {mean} {sine}");
        }
    }

    #[test]
    fn speed_is_kept_and_the_way_is_along_the_plate() {
        let (v, n) = ([1.0, -2.0, 0.5], [0.0, 1.0, 0.0]);
        for draws in [[0.1, 0.2], [0.9, 0.8], [0.0, 0.0]] {
            let out = leave(v, n, draws).unwrap();
            assert!((norm(out) - norm(v)).abs() < 1e-14 && dot(out, n).abs() < 1e-12);
        }
        assert!(leave([1.0, 0.0, 0.0], n, [0.5; 2]).is_none());
    }
}
