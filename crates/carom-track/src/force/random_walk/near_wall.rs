//! Intensities and time scales near walls, fitted to simulations and measurements.
//!
//! The well-mixed walk needs intensities without jumps: both corrections end smoothly, between y⁺ = 150 and 200.

use crate::flow::Local;
use carom::math::{exp, pow};

/// What is done about turbulence near walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NearWall {
    /// Nothing: isotropic up to the wall. Over-deposits small spheres.
    Isotropic,
    /// Components damped as Wang & James 1999 fitted; no eddy shorter than in the viscous sublayer.
    #[default]
    WangJames,
    /// Wall-normal intensity and time scale of Kallio & Reeks 1989, along and across as Wang & James.
    KallioReeks,
    /// All three intensities, the shear stress and the time scale of direct simulations of channels.
    Dns,
}

/// Where the corrections begin to fade and where they have ended, y⁺.
const FADE: f64 = 150.0;
const END: f64 = 200.0;

impl NearWall {
    /// Root mean squares of the fluctuation along the flow, along the wall's normal and across, m/s.
    #[inline(always)]
    pub(super) fn intensities(self, local: &Local, nu: f64) -> [f64; 3] {
        let sigma = (local.k * (2.0 / 3.0)).sqrt();
        let y_plus = wall_units(local, nu);
        // none without a wall: y⁺ is infinite then
        let share = share(y_plus);
        if share == 0.0 {
            return [sigma; 3];
        }
        let fitted = || wang_james(y_plus, share).map(|f| f * sigma);
        match self {
            Self::Isotropic => [sigma; 3],
            Self::WangJames => fitted(),
            Self::KallioReeks => {
                let [along, _, across] = fitted();
                let normal = kallio_reeks_rms(y_plus) * local.friction_velocity;
                [along, share.mul_add(normal - sigma, sigma), across]
            }
            Self::Dns => dns_rms(y_plus).map(|f| share.mul_add(f * local.friction_velocity - sigma, sigma)),
        }
    }

    /// Minus the correlation of the components along the flow and along the wall's normal.
    #[inline(always)]
    pub(super) fn correlation(self, local: &Local, nu: f64) -> f64 {
        if self != Self::Dns {
            return 0.0;
        }
        let y_plus = wall_units(local, nu);
        share(y_plus) * dns_correlation(y_plus)
    }

    /// T_L near a wall for one of the free flow, s.
    #[inline(always)]
    pub(super) fn time(self, free: f64, local: &Local, nu: f64) -> f64 {
        let y_plus = wall_units(local, nu);
        let share = share(y_plus);
        if self == Self::Isotropic || share == 0.0 {
            return free;
        }
        let unit = nu / (local.friction_velocity * local.friction_velocity);
        let near = match self {
            Self::KallioReeks => kallio_reeks_time(y_plus) * unit,
            Self::Dns => dns_time(y_plus) * unit,
            _ => free.max(SUBLAYER_TIME * unit),
        };
        share.mul_add(near - free, free)
    }
}

/// y u_τ/ν; infinite where no wall or no friction velocity is known.
#[inline(always)]
fn wall_units(local: &Local, nu: f64) -> f64 {
    if local.friction_velocity > 0.0 { local.wall_distance * local.friction_velocity / nu } else { f64::INFINITY }
}

/// How much of the correction applies: 1, then falling smoothly to 0.
#[inline(always)]
fn share(y_plus: f64) -> f64 {
    let s = ((END - y_plus) / (END - FADE)).clamp(0.0, 1.0);
    s * s * (3.0 - 2.0 * s)
}

/// f_u, f_v, f_w.
#[inline(always)]
fn wang_james(y_plus: f64, share: f64) -> [f64; 3] {
    let s = y_plus + 6.0;
    let f_u = 1.0 + share * 0.285 * s * exp(-0.455 * pow(s, 0.53));
    let f_v = 1.0 - share * exp(-0.02 * y_plus);
    [f_u, f_v, (3.0 - f_u * f_u - f_v * f_v).max(0.0).sqrt()]
}

#[inline(always)]
fn kallio_reeks_rms(y_plus: f64) -> f64 {
    0.005 * y_plus * y_plus / (1.0 + 0.002_923 * pow(y_plus.max(1e-9), 2.128))
}

/// T⁺ of Kallio & Reeks in the viscous sublayer.
const SUBLAYER_TIME: f64 = 10.0;

#[inline(always)]
fn kallio_reeks_time(y_plus: f64) -> f64 {
    if y_plus <= 5.0 { SUBLAYER_TIME } else { 7.122 + 0.5731 * y_plus - 0.001_29 * y_plus * y_plus }
}

/// u'⁺, v'⁺, w'⁺.
#[inline(always)]
fn dns_rms(y_plus: f64) -> [f64; 3] {
    let y = y_plus.max(1e-9);
    let u = 0.40 * y / (1.0 + 0.0239 * pow(y, 1.496));
    let v = 0.0116 * y * y / (1.0 + 0.203 * y + 0.001_40 * pow(y, 2.421));
    let w = 0.19 * y / (1.0 + 0.0361 * pow(y, 1.322));
    [u, v, w]
}

#[inline(always)]
fn dns_correlation(y_plus: f64) -> f64 {
    0.41 - 0.19 * exp(-y_plus / 3.0)
}

#[inline(always)]
fn dns_time(y_plus: f64) -> f64 {
    let slope = 0.355 * y_plus;
    (6.2 * 6.2 + slope * slope).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{NU, near_wall};
    use super::*;

    #[test]
    fn corrections_damp_the_normal_and_keep_k() {
        for y_plus in [0.5, 5.0, 30.0, 79.0, 170.0] {
            let [u, v, w] = wang_james(y_plus, share(y_plus));
            assert!((u * u + v * v + w * w - 3.0).abs() < 1e-14 && v < 1.0 && v < w && w < u, "{y_plus}");
        }
        let normal = |correction: NearWall, y_plus| correction.intensities(&near_wall(y_plus), NU)[1];
        let sigma = (0.08f64 / 3.0).sqrt();
        assert!((normal(NearWall::Isotropic, 1.0) / sigma - 1.0).abs() < 1e-15);
        assert_eq!(normal(NearWall::WangJames, 0.0), 0.0);
        // v'⁺ at y⁺ = 10 by hand: 0.5/(1 + 0.002923 · 10^2.128)
        let want = 0.1 * 0.5 / (1.0 + 0.002_923 * 10.0f64.powf(2.128));
        assert!((normal(NearWall::KallioReeks, 10.0) / want - 1.0).abs() < 1e-12);
    }

    #[test]
    fn corrections_end_without_a_jump() {
        for correction in [NearWall::WangJames, NearWall::KallioReeks, NearWall::Dns] {
            let at = |y_plus: f64| correction.intensities(&near_wall(y_plus), NU);
            assert_eq!(at(200.0), NearWall::Isotropic.intensities(&near_wall(200.0), NU), "{correction:?}");
            for y_plus in [150.0, 200.0] {
                let (below, above) = (at(y_plus - 1e-6), at(y_plus + 1e-6));
                let jump = (0..3).map(|c| (below[c] - above[c]).abs()).fold(0.0, f64::max);
                assert!(jump < 1e-7 * below[0], "{correction:?} {y_plus} {jump}");
            }
        }
    }

    #[test]
    fn intensities_near_direct_simulation() {
        // del Álamo & others 2004, δ⁺ = 186: y⁺, k⁺, u'⁺, v'⁺, w'⁺
        for (y, k, want) in [
            (5.0, 1.623f64, [1.69, 0.122, 0.61]),
            (15.0, 4.096, [2.65, 0.456, 0.97]),
            (30.0, 3.345, [2.23, 0.742, 1.09]),
            (50.0, 2.459, [1.75, 0.847, 1.07]),
        ] {
            let f = wang_james(y, 1.0).map(|f| f * (2.0 * k / 3.0).sqrt());
            assert!((f[0] / want[0] - 1.0f64).abs() < 0.03 && (f[1] / want[1] - 1.0f64).abs() < 0.2, "{y} {f:?}");
            assert!((f[2] / want[2] - 1.0f64).abs() < 0.07, "{y} {f:?}");
        }
        // Hoyas & Jiménez 2008, δ⁺ = 547: y⁺, v'⁺
        for (y, v) in [(8.0, 0.280), (15.0, 0.539), (30.0, 0.855), (50.0, 0.998), (100.0, 1.022)] {
            assert!((kallio_reeks_rms(y) / v - 1.0f64).abs() < 0.1, "{y}");
        }
    }

    #[test]
    fn fits_to_direct_simulation() {
        // Hoyas & Jiménez, δ⁺ = 547, then 2003: y⁺, u'⁺, v'⁺, w'⁺, −⟨u'v'⟩⁺, dU⁺/dy⁺
        for [y, u, v, w, uv, slope] in [
            [1.0289, 0.4118, 0.010_849, 0.2377, 0.001_145_4, 0.996_97],
            [3.3313, 1.2866, 0.082_713, 0.5996, 0.038_076, 0.955_80],
            [4.9739, 1.8032, 0.150_34, 0.7650, 0.108_82, 0.882_05],
            [10.505, 2.6569, 0.380_99, 1.0747, 0.444_36, 0.536_59],
            [14.795, 2.7602, 0.532_59, 1.1999, 0.629_45, 0.343_90],
            [29.739, 2.4239, 0.851_51, 1.3513, 0.840_06, 0.106_75],
            [49.661, 2.0587, 0.996_62, 1.3552, 0.861_57, 0.048_649],
            [99.734, 1.7509, 1.0225, 1.2519, 0.792_01, 0.024_604],
            [4.6945, 1.8316, 0.149_57, 0.8241, 0.102_09, 0.895_95],
            [14.403, 2.9259, 0.548_77, 1.3386, 0.638_70, 0.354_50],
            [30.564, 2.6441, 0.899_72, 1.5341, 0.882_72, 0.101_92],
            [51.270, 2.3582, 1.0513, 1.5553, 0.927_38, 0.046_728],
            [100.16, 2.1759, 1.1090, 1.4862, 0.925_91, 0.023_573],
        ] {
            let got = dns_rms(y);
            assert!((got[1] / v - 1.0f64).abs() < 0.16, "{y} {got:?}");
            assert!((got[0] / u - 1.0f64).abs() < 0.26 && (got[2] / w - 1.0f64).abs() < 0.26, "{y} {got:?}");
            assert!((dns_correlation(y) / (uv / (u * v)) - 1.0).abs() < 0.13, "{y}");
            // σ_n² T_L = ν_t/0.9
            let time = uv / slope / (0.9 * v * v);
            assert!(y < 3.0 || (dns_time(y) / time - 1.0).abs() < 0.22, "{y} {time}");
        }
    }

    #[test]
    fn kallio_and_reeks_time_scale() {
        assert!((kallio_reeks_time(5.0) - kallio_reeks_time(5.000_001)).abs() < 0.05);
        let time = |y_plus| NearWall::KallioReeks.time(1e-3, &near_wall(y_plus), NU);
        assert!((time(2.0) - 10.0 * NU / 0.01).abs() < 1e-15);
        assert_eq!(time(200.0), 1e-3);
        // the sublayer's is the least with Wang & James, and nothing is known without a wall
        assert!((NearWall::WangJames.time(1e-3, &near_wall(2.0), NU) - 10.0 * NU / 0.01).abs() < 1e-15);
        assert_eq!(NearWall::WangJames.time(1.0, &near_wall(2.0), NU), 1.0);
        assert_eq!(NearWall::Isotropic.time(1e-3, &near_wall(2.0), NU), 1e-3);
    }
}
