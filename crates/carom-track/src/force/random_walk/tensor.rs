//! S(x) of u' = S ζ at a place.

use super::NearWall;
use crate::flow::Local;
use crate::vector::{Vec3, add, cross, dot, frame, norm, scale, sub};

/// S = σ_t tt + σ_n nn + σ_b bb, with the shear stress where there is one.
pub(super) struct Tensor {
    /// t along the flow, n along the wall's normal, b across; x, y, z where no wall is known.
    pub directions: [Vec3; 3],
    /// σ_t, σ_n, σ_b, m/s.
    sigma: Vec3,
    /// Minus the correlation of the components along t and n.
    rho: f64,
    /// Whether S is σ_t times unity.
    is_isotropic: bool,
}

impl Tensor {
    #[inline(always)]
    pub fn new(near_wall: NearWall, local: &Local, nu: f64) -> Self {
        let directions = directions(local);
        if local.k <= 0.0 {
            return Self { directions, sigma: [0.0; 3], rho: 0.0, is_isotropic: true };
        }
        let sigma = near_wall.intensities(local, nu);
        let [along, normal, across] = sigma;
        let knows_no_wall = dot(local.wall_normal, local.wall_normal) == 0.0;
        let is_isotropic = knows_no_wall || (along == normal && along == across);
        let rho = if is_isotropic { 0.0 } else { near_wall.correlation(local, nu) };
        Self { directions, sigma, rho, is_isotropic }
    }

    /// S ζ, or Sᵀ ζ, m/s.
    #[inline(always)]
    pub fn apply<const TRANSPOSED: bool>(&self, deviates: Vec3) -> Vec3 {
        let ([t, n, b], [along, normal, across], rho) = (self.directions, self.sigma, self.rho);
        if self.is_isotropic {
            // no minus zeros
            return if along == 0.0 { [0.0; 3] } else { scale(deviates, along) };
        }
        let part = |d: Vec3, sigma: f64| scale(d, sigma * dot(d, deviates));
        if rho == 0.0 {
            return add(add(part(t, along), part(n, normal)), part(b, across));
        }
        // away from the wall comes slower fluid
        let (to, from) = if TRANSPOSED { (n, t) } else { (t, n) };
        let shared = scale(to, -rho * along * dot(from, deviates));
        let alone = along * (1.0 - rho * rho).sqrt();
        add(add(add(part(t, alone), shared), part(n, normal)), part(b, across))
    }
}

#[inline(always)]
fn directions(local: &Local) -> [Vec3; 3] {
    let n = local.wall_normal;
    if dot(n, n) == 0.0 {
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    }
    let stream = sub(local.velocity, scale(n, dot(local.velocity, n)));
    let speed = norm(stream);
    let t = if speed > 0.0 { scale(stream, 1.0 / speed) } else { frame(n).0 };
    [t, n, cross(t, n)]
}
