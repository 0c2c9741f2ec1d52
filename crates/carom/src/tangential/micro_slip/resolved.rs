//! The contact of the micro-slip law followed in time: the reference the closed law is tabulated from and tested against.
//!
//! In the scaled variables of the [parent module](super): depth y (of the greatest), time τ (greatest depth over v_n), tangential
//! stretch σ of the spring at the scaled position ξ (stretch times G*/(f E*)), slip ψ:
//!
//! y″ = −(5/4)y^{3/2},  |σ| ≤ y − ξ²,  dσ/dτ = κψ (unless at its bound),  Q = (15/8)∫σ dξ over ξ² < y,  dψ/dτ = −(7/2) c Q,
//! π = ∫c Q dτ,
//!
//! c = 1 on approach and e on separation. A spring whose contact ends forgets its stretch.
//!
//! **Discretisation.** The springs are the positions where the contact's edge stands at the steps' times, so that each one meets and
//! leaves the wall exactly at a step; between them σ is linear in ξ², as its bound is; time goes by leapfrog (slip at the half steps).
//! Second order in the number of steps, which is also the number of springs.
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use alloc::vec::Vec;

/// Duration of the approach, ∫₀¹ dy/√(1 − y^{5/2}) = (2/5)B(2/5, 1/2).
const APPROACH: f64 = 1.471_637_592_162_352_3;

/// A contact at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Scaled time τ.
    pub time: f64,
    /// Scaled depth y.
    pub depth: f64,
    /// Scaled tangential force Q, at most y^{3/2}·5/4 in size.
    pub force: f64,
    /// Scaled slip ψ half a step later.
    pub slip: f64,
}

/// Scaled impulse π = P/(f v_n) of an impact at scaled slip `slip` (ψ ≥ 0), stiffness ratio `stiffness_ratio` (κ) and `restitution`,
/// with `steps` steps each way (and as many springs).
///
/// ```
/// use carom::tangential::micro_slip::resolved::impulse;
/// // beyond 7 − 1/κ a lossless impact slides throughout: f on the whole normal impulse
/// assert!((impulse(7.0 - 1.0 / 0.85 + 1e-3, 0.85, 1.0, 100) - 2.0).abs() < 1e-3);
/// ```
pub fn impulse(slip: f64, stiffness_ratio: f64, restitution: f64, steps: usize) -> f64 {
    follow(slip, stiffness_ratio, restitution, steps, |_| ())
}

/// As [`impulse`], handing every instant to `watch`.
pub fn follow(slip: f64, stiffness_ratio: f64, restitution: f64, steps: usize, mut watch: impl FnMut(Instant)) -> f64 {
    let depths = approach(steps);
    let h = APPROACH / steps as f64;
    let edges: Vec<f64> = depths.iter().map(|y| y.sqrt()).collect();
    let mut stretch = vec![0.0; steps + 1];
    let (mut psi, mut total) = (slip, 0.0);
    for i in 1..2 * steps {
        // the contact's edge stands at spring `edge`: that one bears nothing
        let edge = if i <= steps { i } else { 2 * steps - i };
        let moved = stiffness_ratio * psi * h;
        for (sigma, &mark) in stretch[..edge].iter_mut().zip(&depths) {
            let bound = depths[edge] - mark;
            *sigma = (*sigma + moved).clamp(-bound, bound);
        }
        stretch[edge] = 0.0;
        let area: f64 = (0..edge).map(|j| panel([edges[j], edges[j + 1]], [stretch[j], stretch[j + 1]])).sum();
        let share = match i.cmp(&steps) {
            core::cmp::Ordering::Less => 1.0,
            core::cmp::Ordering::Equal => 0.5 * (1.0 + restitution),
            core::cmp::Ordering::Greater => restitution,
        };
        let force = 15.0 / 8.0 * area;
        total += share * force * h;
        psi -= 3.5 * share * force * h;
        watch(Instant { time: i as f64 * h, depth: depths[edge], force, slip: psi });
    }
    total
}

/// ∫σ dξ between two springs at `xi`, σ linear in ξ².
fn panel(xi: [f64; 2], sigma: [f64; 2]) -> f64 {
    let weight = (xi[1] + 2.0 * xi[0]) / (3.0 * (xi[1] + xi[0]));
    (xi[1] - xi[0]) * (sigma[0] + weight * (sigma[1] - sigma[0]))
}

/// Depths of the elastic approach at equal times, 0 to 1, by fourth-order steps.
fn approach(steps: usize) -> Vec<f64> {
    let h = APPROACH / steps as f64;
    let force = |y: f64| -1.25 * y * y.max(0.0).sqrt();
    let (mut y, mut v) = (0.0f64, 1.0f64);
    let mut depths = vec![0.0];
    for _ in 0..steps {
        let (y1, v1) = (v, force(y));
        let (y2, v2) = (v + 0.5 * h * v1, force(y + 0.5 * h * y1));
        let (y3, v3) = (v + 0.5 * h * v2, force(y + 0.5 * h * y2));
        let (y4, v4) = (v + h * v3, force(y + h * y3));
        y += h / 6.0 * (y1 + 2.0 * y2 + 2.0 * y3 + y4);
        v += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        depths.push(y);
    }
    depths
}
