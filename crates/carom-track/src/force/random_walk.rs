//! Turbulent dispersion by a discrete random walk through eddies (Gosman & Ioannides 1983, J. Energy 7, 482–490,
//! doi:10.2514/3.62687).
//!
//! A sphere meets one eddy after another. Each adds u'_i = ζ_i √(2k/3), ζ standard normal, to the mean velocity until it
//! dies or the sphere has crossed it, whichever is first:
//!
//! - life 2 T_L, or −T_L ln r with r uniform ([`Life`]; both give the integral time scale T_L), T_L = C_L T, C_L = 0.15
//!   for k–ε, T = max(k/ε, 6 √(ν/ε));
//! - crossing time t_c = −τ ln(1 − L_e/(τ |u − v|)), L_e = C_μ^{3/4} L, C_μ = 0.09, L = max(k^{3/2}/ε, 70 (ν³/ε)^{1/4}); a sphere
//!   too slow to leave never crosses.
//!
//! The second terms are Kolmogorov's scales, which no eddy falls short of (Durbin 1991, Theor. Comput. Fluid Dyn. 3, 1–13,
//! doi:10.1007/BF00271513): they act below y⁺ of about 7 (T) and 50 (L). Without them eddies shrink to nothing at a wall, and
//! a sphere that lingers there would meet them without end.
//!
//! # Near walls
//! Isotropic fluctuations carry far too many small spheres to a wall: real turbulence is damped along the wall's normal.
//! - [`NearWall::WangJames`]: the three components are multiplied by f_u, f_v, f_w fitted to direct simulations (Wang &
//!   James 1999, Int. J. Multiphase Flow 25, 551–558) for y⁺ < 80:
//!   f_u = 1 + 0.285 (y⁺ + 6) e^{−0.455 (y⁺+6)^0.53} along the flow, f_v = 1 − e^{−0.02 y⁺} along the normal,
//!   f_w = √(3 − f_u² − f_v²) across, so that k is kept.
//!   With k given, they meet the simulation at δ⁺ = 180 within 3 % (u'), 20 % (v') and 7 % (w').
//! - [`NearWall::KallioReeks`]: along the normal the rms and the eddy's life are those of a boundary layer (Kallio & Reeks
//!   1989, Int. J. Multiphase Flow 15, 433–446, doi:10.1016/0301-9322(89)90012-8), for y⁺ < 200:
//!   v'⁺ = 0.005 y⁺²/(1 + 0.002923 y⁺^2.128); T⁺ = 10 up to y⁺ = 5, then 7.122 + 0.5731 y⁺ − 0.00129 y⁺².
//!
//! # Limits
//! Eddies of a random walk drift down a gradient of k, spheres that follow the fluid collect where k is low; correlation in
//! time is a step, not an exponential.
//!
//! ```
//! use carom_track::{flow::Local, force::RandomWalk};
//! let local = Local { k: 1.5, epsilon: 10.0, ..Local::uniform([1.0, 0.0, 0.0]) };
//! let walk = RandomWalk::default();
//! let eddy = walk.eddy(&local, 1.5e-5, [1.0, -2.0, 0.0], 0.5);
//! assert_eq!(walk.fluctuation(&eddy, &local, 1.5e-5), [1.0, -2.0, 0.0]);
//! assert!((eddy.life - 0.045).abs() < 1e-15);
//! ```

use crate::flow::Local;
use crate::vector::{add, cross, dot, frame, norm, scale, sub};
use carom::math::{exp, ln, pow};

/// What is done about turbulence near walls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NearWall {
    /// Nothing: isotropic up to the wall. Over-deposits small spheres.
    Isotropic,
    /// Components damped as Wang & James 1999 fitted.
    #[default]
    WangJames,
    /// Wall-normal intensity and time scale of Kallio & Reeks 1989.
    KallioReeks,
}

/// How long eddies live.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Life {
    /// All of one place alike, 2 T_L.
    #[default]
    Constant,
    /// Exponentially distributed with mean T_L.
    Random,
}

/// The model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RandomWalk {
    /// Near-wall correction.
    pub near_wall: NearWall,
    /// Distribution of the eddies' lives.
    pub life: Life,
    /// C_L of T_L = C_L k/ε.
    pub time_scale: f64,
}

/// Wang & James, constant life, C_L = 0.15.
impl Default for RandomWalk {
    fn default() -> Self {
        Self { near_wall: NearWall::default(), life: Life::default(), time_scale: 0.15 }
    }
}

/// One eddy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eddy {
    /// Standard normal deviates: along the flow, along the wall's normal, across; x, y, z where no wall is known.
    pub deviates: [f64; 3],
    /// Life, s; infinite where there is no turbulence.
    pub life: f64,
    /// Length, m.
    pub length: f64,
}

impl RandomWalk {
    /// A new eddy at a place, from three standard normal deviates and one uniform in (0, 1).
    ///
    /// `nu` is the kinematic viscosity, m²/s. Without turbulence the eddy is empty and lasts.
    pub fn eddy(&self, local: &Local, nu: f64, deviates: [f64; 3], uniform: f64) -> Eddy {
        if !(local.k > 0.0 && local.epsilon > 0.0) {
            return Eddy { deviates, life: f64::INFINITY, length: f64::INFINITY };
        }
        let kolmogorov = (nu / local.epsilon).sqrt();
        let mut t_l = self.time_scale * (local.k / local.epsilon).max(6.0 * kolmogorov);
        // (ν³/ε)^{1/4} = √ν (ν/ε)^{1/4}
        let length = (local.k * local.k.sqrt() / local.epsilon).max(70.0 * (nu * kolmogorov).sqrt());
        let y_plus = wall_units(local, nu);
        if self.near_wall == NearWall::KallioReeks && y_plus < KALLIO_REEKS_END {
            t_l = kallio_reeks_time(y_plus) * nu / (local.friction_velocity * local.friction_velocity);
        }
        let life = match self.life {
            Life::Constant => 2.0 * t_l,
            Life::Random => -t_l * ln(uniform.max(1e-300)),
        };
        // C_μ^{3/4} with C_μ = 0.09
        const LENGTH: f64 = 0.164_316_767_251_549_83;
        Eddy { deviates, life, length: LENGTH * length }
    }

    /// How long a sphere of a relaxation time (s) that moves at a speed (m/s) against the fluid stays in the eddy, s.
    pub fn residence(&self, eddy: &Eddy, relaxation_time: f64, relative_speed: f64) -> f64 {
        let share = eddy.length / (relaxation_time * relative_speed);
        if share < 1.0 { eddy.life.min(-relaxation_time * ln(1.0 - share)) } else { eddy.life }
    }

    /// u' (m/s) of an eddy where the mean flow is `local`: to be added to the mean velocity.
    ///
    /// Evaluate it where the sphere is, not where it met the eddy: so the fluctuation fades as the sphere nears a wall.
    pub fn fluctuation(&self, eddy: &Eddy, local: &Local, nu: f64) -> [f64; 3] {
        if local.k <= 0.0 {
            return [0.0; 3];
        }
        let sigma = (local.k * (2.0 / 3.0)).sqrt();
        let d = eddy.deviates;
        let n = local.wall_normal;
        if dot(n, n) == 0.0 {
            return scale(d, sigma);
        }
        let y_plus = wall_units(local, nu);
        let [along, normal, across] = match self.near_wall {
            NearWall::WangJames if y_plus < WANG_JAMES_END => scale(wang_james(y_plus), sigma),
            NearWall::KallioReeks if y_plus < KALLIO_REEKS_END => {
                [sigma, kallio_reeks_rms(y_plus) * local.friction_velocity, sigma]
            }
            _ => [sigma; 3],
        };
        let stream = sub(local.velocity, scale(n, dot(local.velocity, n)));
        let speed = norm(stream);
        let t = if speed > 0.0 { scale(stream, 1.0 / speed) } else { frame(n).0 };
        let b = cross(t, n);
        add(add(scale(t, d[0] * along), scale(n, d[1] * normal)), scale(b, d[2] * across))
    }
}

const WANG_JAMES_END: f64 = 80.0;
const KALLIO_REEKS_END: f64 = 200.0;

/// y u_τ/ν; infinite where no wall or no friction velocity is known.
fn wall_units(local: &Local, nu: f64) -> f64 {
    if local.friction_velocity > 0.0 { local.wall_distance * local.friction_velocity / nu } else { f64::INFINITY }
}

/// f_u, f_v, f_w.
fn wang_james(y_plus: f64) -> [f64; 3] {
    let s = y_plus + 6.0;
    let f_u = 1.0 + 0.285 * s * exp(-0.455 * pow(s, 0.53));
    let f_v = 1.0 - exp(-0.02 * y_plus);
    [f_u, f_v, (3.0 - f_u * f_u - f_v * f_v).max(0.0).sqrt()]
}

fn kallio_reeks_rms(y_plus: f64) -> f64 {
    0.005 * y_plus * y_plus / (1.0 + 0.002_923 * pow(y_plus.max(1e-9), 2.128))
}

fn kallio_reeks_time(y_plus: f64) -> f64 {
    if y_plus <= 5.0 { 10.0 } else { 7.122 + 0.5731 * y_plus - 0.001_29 * y_plus * y_plus }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Stream};

    const NU: f64 = 1.5e-5;

    fn near_wall(y_plus: f64) -> Local {
        let u_tau = 0.1;
        Local {
            k: 0.04,
            epsilon: 1.0,
            wall_distance: y_plus * NU / u_tau,
            wall_normal: [0.0, 1.0, 0.0],
            friction_velocity: u_tau,
            ..Local::uniform([2.0, 0.0, 0.0])
        }
    }

    #[test]
    fn far_from_walls_the_variance_is_two_thirds_k() {
        let (seed, n) = (11, 20_000);
        let local = Local { k: 0.6, epsilon: 1.0, ..Local::uniform([1.0, 0.0, 0.0]) };
        let walk = RandomWalk { life: Life::Random, ..RandomWalk::default() };
        let (mut variance, mut life) = ([0.0; 3], 0.0);
        for particle in 0..n {
            let mut s = Stream::new(seed, particle, Purpose::Eddy, 0);
            let eddy = walk.eddy(&local, NU, s.normals(), s.open_uniform());
            let u = walk.fluctuation(&eddy, &local, NU);
            variance = add(variance, u.map(|c| c * c / n as f64));
            life += eddy.life / n as f64;
        }
        let e = 4.0 / (n as f64).sqrt();
        assert!(variance.iter().all(|v| (v / 0.4 - 1.0).abs() < 1.42 * e), "seed {seed}: {variance:?}");
        assert!((life / 0.09 - 1.0).abs() < e, "seed {seed}: {life}");
    }

    #[test]
    fn corrections_damp_the_normal_and_keep_k() {
        for y_plus in [0.5, 5.0, 30.0, 79.0] {
            let [u, v, w] = wang_james(y_plus);
            assert!((u * u + v * v + w * w - 3.0).abs() < 1e-14 && v < 0.8 && v < w && w < u, "{y_plus}");
        }
        let eddy = Eddy { deviates: [0.0, 1.0, 0.0], life: 1.0, length: 1.0 };
        let normal = |near_wall, y_plus| {
            let walk = RandomWalk { near_wall, ..RandomWalk::default() };
            walk.fluctuation(&eddy, &self::near_wall(y_plus), NU)
        };
        let sigma = (0.08f64 / 3.0).sqrt();
        assert!((normal(NearWall::Isotropic, 1.0)[1] / sigma - 1.0).abs() < 1e-15);
        assert_eq!(normal(NearWall::WangJames, 0.0), [0.0; 3]);
        assert_eq!(normal(NearWall::WangJames, 100.0), normal(NearWall::Isotropic, 1.0));
        // v'⁺ at y⁺ = 10 by hand: 0.5/(1 + 0.002923 · 10^2.128)
        let want = 0.1 * 0.5 / (1.0 + 0.002_923 * 10.0f64.powf(2.128));
        assert!((normal(NearWall::KallioReeks, 10.0)[1] / want - 1.0).abs() < 1e-12);
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
            let f = wang_james(y).map(|f| f * (2.0 * k / 3.0).sqrt());
            assert!((f[0] / want[0] - 1.0f64).abs() < 0.03 && (f[1] / want[1] - 1.0f64).abs() < 0.2, "{y} {f:?}");
            assert!((f[2] / want[2] - 1.0f64).abs() < 0.07, "{y} {f:?}");
        }
        // Hoyas & Jiménez 2008, δ⁺ = 547: y⁺, v'⁺
        for (y, v) in [(8.0, 0.280), (15.0, 0.539), (30.0, 0.855), (50.0, 0.998), (100.0, 1.022)] {
            assert!((kallio_reeks_rms(y) / v - 1.0f64).abs() < 0.1, "{y}");
        }
    }

    #[test]
    fn kallio_and_reeks_time_scale() {
        assert!((kallio_reeks_time(5.0) - kallio_reeks_time(5.000_001)).abs() < 0.05);
        let walk = RandomWalk { near_wall: NearWall::KallioReeks, ..RandomWalk::default() };
        let eddy = walk.eddy(&near_wall(2.0), NU, [0.0; 3], 0.5);
        assert!((eddy.life - 20.0 * NU / 0.01).abs() < 1e-15);
    }

    #[test]
    fn eddies_at_a_wall_keep_kolmogorovs_scales() {
        // in wall units: T⁺ = 6/√ε⁺, L⁺ = 70/ε⁺^{1/4} where k vanishes; above, k and ε rule
        let walk = RandomWalk { near_wall: NearWall::Isotropic, ..RandomWalk::default() };
        let local = Local { k: 1e-12, epsilon: 1.0 / 6.0, ..Local::uniform([1.0, 0.0, 0.0]) };
        let eddy = walk.eddy(&local, 1.0, [0.0; 3], 0.5);
        assert!((eddy.life - 2.0 * 0.15 * 6.0 * 6.0f64.sqrt()).abs() < 1e-12, "{eddy:?}");
        assert!((eddy.length - 0.09f64.powf(0.75) * 70.0 * 6.0f64.powf(0.25)).abs() < 1e-12, "{eddy:?}");
        let far = walk.eddy(&Local { k: 2.0, epsilon: 0.008, ..local }, 1.0, [0.0; 3], 0.5);
        assert!((far.life - 2.0 * 0.15 * 250.0).abs() < 1e-12, "{far:?}");
        assert!((far.length - 0.09f64.powf(0.75) * 2.0f64.powf(1.5) / 0.008).abs() < 1e-10, "{far:?}");
    }

    #[test]
    fn residence_is_the_shorter_of_life_and_crossing() {
        let walk = RandomWalk::default();
        let eddy = Eddy { deviates: [0.0; 3], life: 1.0, length: 0.01 };
        // x = s τ (1 − e^{−t/τ}) reaches the length at t
        let t = walk.residence(&eddy, 0.1, 1.0);
        assert!((0.1 * (1.0 - (-t / 0.1).exp()) - 0.01).abs() < 1e-15);
        assert_eq!(walk.residence(&eddy, 0.1, 0.05), 1.0);
        assert_eq!(walk.residence(&eddy, 0.1, 0.0), 1.0);
        let still = walk.eddy(&Local::uniform([0.0; 3]), NU, [1.0; 3], 0.5);
        assert_eq!(walk.residence(&still, 0.1, 1.0), f64::INFINITY);
        assert_eq!(walk.fluctuation(&still, &Local::uniform([0.0; 3]), NU), [0.0; 3]);
    }

    #[test]
    fn a_wall_at_any_angle() {
        let n = [0.6, 0.8, 0.0];
        let local = Local { wall_normal: n, velocity: [0.8, -0.6, 0.0], ..near_wall(0.0) };
        let eddy = Eddy { deviates: [0.3, 5.0, -0.4], life: 1.0, length: 1.0 };
        let u = RandomWalk::default().fluctuation(&eddy, &local, NU);
        assert!(dot(u, n).abs() < 1e-15 && dot(u, [0.8, -0.6, 0.0]) > 0.0);
    }
}
