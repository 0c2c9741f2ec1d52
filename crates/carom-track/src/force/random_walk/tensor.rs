//! S(x) of u' = S ζ at a place.

use super::NearWall;
use crate::flow::Local;
use crate::vector::{Vec3, add, cross, dot, frame, norm, scale, sub};

/// S at a place.
pub(super) enum Tensor {
    /// σ times unity, m/s.
    Isotropic(f64),
    /// σ_t tt + σ_n nn + σ_b bb, with the shear stress where there is one.
    NearWall {
        /// t along the flow, n along the wall's normal, b across.
        directions: [Vec3; 3],
        /// σ_t, σ_n, σ_b, m/s.
        sigma: [f64; 3],
        /// Minus the correlation of the components along t and n.
        rho: f64,
    },
}

impl Tensor {
    #[inline(always)]
    pub fn new(near_wall: NearWall, local: &Local, nu: f64) -> Self {
        if local.k <= 0.0 {
            return Self::Isotropic(0.0);
        }
        let sigma = near_wall.intensities(local, nu);
        let [along, normal, across] = sigma;
        if dot(local.wall_normal, local.wall_normal) == 0.0 || (along == normal && along == across) {
            return Self::Isotropic(along);
        }
        Self::NearWall { directions: directions(local), sigma, rho: near_wall.correlation(local, nu) }
    }

    /// S ζ, or Sᵀ ζ, m/s.
    #[inline(always)]
    pub fn apply<const TRANSPOSED: bool>(&self, deviates: Vec3) -> Vec3 {
        let ([t, n, b], [along, normal, across], rho) = match *self {
            // no minus zeros
            Self::Isotropic(0.0) => return [0.0; 3],
            Self::Isotropic(sigma) => return scale(deviates, sigma),
            Self::NearWall { directions, sigma, rho } => (directions, sigma, rho),
        };
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

/// Along the flow, along the wall's normal, and across; x, y, z where no wall is known.
#[inline(always)]
pub(super) fn directions(local: &Local) -> [Vec3; 3] {
    let n = local.wall_normal;
    if dot(n, n) == 0.0 {
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    }
    let stream = sub(local.velocity, scale(n, dot(local.velocity, n)));
    let speed = norm(stream);
    let t = if speed > 0.0 { scale(stream, 1.0 / speed) } else { frame(n).0 };
    [t, n, cross(t, n)]
}
