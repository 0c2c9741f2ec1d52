//! Turbulent dispersion by a discrete random walk through eddies (Gosman & Ioannides 1983, J. Energy 7, 482–490,
//! doi:10.2514/3.62687), well mixed.
//!
//! A sphere meets one eddy after another. Each adds u' = S(x) ζ to the mean velocity: ζ three standard normal deviates,
//! S the root mean squares of the fluctuation where the sphere is, √(2k/3) in every direction far from walls. An eddy
//! lasts until it dies or the sphere has crossed it, whichever is first:
//!
//! - life 2 T_L, or exponentially distributed with mean T_L ([`Life`]; both give the integral time scale T_L),
//!   T_L = C_L T, C_L = 0.15 for k–ε, T = max(k/ε, 6 √(ν/ε));
//! - crossing time t_c = −τ ln(1 − L_e/(τ |u − v|)), L_e = C_μ^{3/4} L, C_μ = 0.09, L = max(k^{3/2}/ε, 70 (ν³/ε)^{1/4}), u − v
//!   as the eddy is met; a sphere too slow to leave never crosses, and so does none that follows the fluid: τ |u − v|
//!   vanishes with τ.
//!
//! The second terms are Kolmogorov's scales, which no eddy falls short of (Durbin 1991, Theor. Comput. Fluid Dyn. 3, 1–13,
//! doi:10.1007/BF00271513): they act below y⁺ of about 7 (T) and 50 (L).
//!
//! # Near walls
//! Isotropic fluctuations carry far too many small spheres to a wall: real turbulence is damped along the wall's normal.
//! S = σ_t tt + σ_n nn + σ_b bb, t along the flow, n the wall's normal, b across:
//! - [`NearWall::WangJames`]: √(2k/3) times f_u, f_v, f_w fitted to direct simulations for y⁺ < 80 (Wang & James 1999, Int. J.
//!   Multiphase Flow 25, 551–558): f_u = 1 + 0.285 (y⁺ + 6) e^{−0.455 (y⁺+6)^0.53} along the flow, f_v = 1 − e^{−0.02 y⁺} along the
//!   normal, f_w = √(3 − f_u² − f_v²) across, so that k is kept. Beyond 80 they go on, for they tend to 1.
//!   With k given, they meet the simulation at δ⁺ = 180 within 3 % (u'), 20 % (v') and 7 % (w'). T_L is at least 10 ν/u_τ²,
//!   that of the viscous sublayer below: C_L k/ε was made for isotropic fluctuations and falls to 2 there.
//! - [`NearWall::KallioReeks`]: along the normal the rms and the eddy's life are those of a boundary layer (Kallio & Reeks
//!   1989, Int. J. Multiphase Flow 15, 433–446, doi:10.1016/0301-9322(89)90012-8), for y⁺ < 200:
//!   v'⁺ = 0.005 y⁺²/(1 + 0.002923 y⁺^2.128); T⁺ = 10 up to y⁺ = 5, then 7.122 + 0.5731 y⁺ − 0.00129 y⁺². They speak of the
//!   normal alone; along and across it is as above, for isotropic fluctuations around the axis of a pipe fling out too much.
//!
//! Both are faded out smoothly between y⁺ = 150 and 200: a jump of S would be a wall to the walk.
//!
//! # Drift
//! With ζ fixed for an eddy's life, spheres that follow the fluid gather where S is small, at walls above all. They stay
//! evenly spread if, within an eddy,
//!
//! dζ/dt = ∇·S  and  da/dt = 1/T_L(x)
//!
//! with the age a counted from 0 to 2, or to an exponential deviate of mean 1, at the place where the sphere *is*. For
//! dx/dt = U + Sζ, ∇·U = 0, the density n N(ζ) f(a), N the normal one, does not change in time if
//! ∂_i (S_ij ζ_j) − ζ_j dζ_j/dt = 0, hence the first; dying eddies, at the rate f/T_L, are replaced where they die,
//! and f (uniform on 0 to 2, or e^{−a}) answers ageing at the rate 1/T_L(x): the second. For short T_L this is the
//! known mean velocity σσ'T + σ²T' (Legg & Raupach 1982, Boundary-Layer Meteorol. 24, 3–13, doi:10.1007/BF00121796; MacInnes
//! & Bracco 1992, Phys. Fluids A 4, 2809–2824) and it meets the well-mixed condition of Thomson 1987 (J. Fluid Mech. 180,
//! 529–556, doi:10.1017/S0022112087001940).
//!
//! A sphere with inertia does not follow: of the fluid's mean acceleration ∇·(⟨u'v⟩) it sees as much as its velocity
//! correlates with the fluid's, ⟨u'v⟩ = φ σ². The drift is taken times φ: 1/(1 + St) for exponential lives, St = τ/T_L (as
//! Bocksell & Loth 2006, Int. J. Multiphase Flow 32, 1234–1253, and Dehbi 2008, Int. J. Multiphase Flow 34, 819–828, have it for
//! Langevin walks), 1 − (St/2)(1 − e^{−2/St}) for constant ones, τ of Stokes' drag.
//!
//! `drift = false` gives the plain walk: ζ fixed, life that of the place of birth.
//!
//! # Limits
//! - Correlation in time is a step or an exponential, each eddy forgets the last, the three components are
//!   independent: no shear stress, no bursts.
//! - Crossing breaks even mixing of spheres with inertia; no theory says what would be right for them.
//! - On the axis of a pipe of less than 200 wall units of radius S is not isotropic and so has no single value: spheres
//!   that pass within a step of it are scattered a little too much or too little.
//! - Where σ_n ~ y², as near a wall, spheres of St > 1/3 thin out as σ_n^{−2St/(1+St)}, which has no integral down to the wall:
//!   the sublayer keeps them until they touch.
//! - Where a flow knows no wall, S = √(2k/3) everywhere.
//!
//! ```
//! use carom_track::{flow::Local, force::RandomWalk};
//! let local = Local { k: 1.5, epsilon: 10.0, ..Local::uniform([1.0, 0.0, 0.0]) };
//! let walk = RandomWalk::default();
//! let eddy = walk.eddy([1.0, -2.0, 0.0], 0.5);
//! assert_eq!(walk.fluctuation(eddy.deviates, &local, 1.5e-5), [1.0, -2.0, 0.0]);
//! let here = walk.surroundings(|_| local, [0.0; 3], 1.5e-5, 0.0);
//! assert!((here.time * eddy.life - 0.045).abs() < 1e-15 && here.drift == [0.0; 3]);
//! ```

mod eddy;
mod near_wall;
#[cfg(test)]
mod well_mixed;

pub use eddy::{Eddy, Surroundings};
pub use near_wall::NearWall;

use crate::flow::Local;
use crate::vector::{Vec3, add, cross, dot, frame, norm, scale, sub};
use carom::math::{exp, ln};

/// How long eddies live.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Life {
    /// All alike, 2 T_L.
    #[default]
    Constant,
    /// Exponentially distributed with mean T_L.
    Random,
}

impl Life {
    /// ⟨u'v⟩/σ² of a sphere in even turbulence: 1 if it follows the fluid, 0 if it does not.
    fn response(self, stokes: f64) -> f64 {
        match self {
            Self::Random => 1.0 / (1.0 + stokes),
            Self::Constant => {
                let s = 0.5 * stokes;
                // the ends of a form that cancels there
                if s < 1e-3 {
                    1.0 - s
                } else if s > 1e3 {
                    0.5 / s
                } else {
                    1.0 - s * (1.0 - exp(-1.0 / s))
                }
            }
        }
    }
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
    /// Whether eddies drift and age with the place, so that spheres which follow the fluid stay evenly spread.
    pub drift: bool,
}

/// Wang & James, constant life, C_L = 0.15, with drift.
impl Default for RandomWalk {
    fn default() -> Self {
        Self { near_wall: NearWall::default(), life: Life::default(), time_scale: 0.15, drift: true }
    }
}

/// Where a flow is sampled again for ∇·S, over the distance to the wall.
const REACH: f64 = 1e-4;

/// Shortest time scale in relaxation times: shorter ones a sphere does not feel, and they would take for ever.
const SHORTEST: f64 = 5e-4;

impl RandomWalk {
    /// A new eddy, from three standard normal deviates and one uniform in (0, 1).
    pub fn eddy(&self, deviates: [f64; 3], uniform: f64) -> Eddy {
        let life = match self.life {
            Life::Constant => 2.0,
            Life::Random => -ln(uniform.max(1e-300)),
        };
        Eddy { deviates, age: 0.0, life }
    }

    /// The next eddy that lasts, begun at an age, from draws: whether it is a sphere's first, deviates and uniform.
    ///
    /// A sphere is injected into the midst of an eddy: of constant life, its first has lived for a while already.
    pub fn next_eddy(&self, age: f64, mut draw: impl FnMut() -> (bool, [f64; 3], f64)) -> Eddy {
        let mut age = age;
        loop {
            let (first, deviates, uniform) = draw();
            let mut eddy = self.eddy(deviates, uniform);
            let past = if first && self.life == Life::Constant { uniform * eddy.life } else { 0.0 };
            eddy.age = age + past;
            if !eddy.is_over() {
                return eddy;
            }
            age = eddy.overdue();
        }
    }

    /// What a place does to the eddy of a sphere of a relaxation time (s), in a fluid of kinematic viscosity `nu` (m²/s).
    ///
    /// With drift the fluid is sampled four times, at `x` and close by.
    #[inline(always)]
    pub fn surroundings(
        &self,
        fluid: impl Fn([f64; 3]) -> Local,
        x: [f64; 3],
        nu: f64,
        relaxation_time: f64,
    ) -> Surroundings {
        let local = fluid(x);
        if !(local.k > 0.0 && local.epsilon > 0.0) {
            return Surroundings::CALM;
        }
        let (free, length) = self.scales(&local, nu);
        let time = self.near_wall.time(free, &local, nu);
        let follows = if self.drift { self.life.response(relaxation_time / time) } else { 0.0 };
        let drift =
            if follows > 0.0 { scale(self.divergence(&fluid, x, &local, nu, length), follows) } else { [0.0; 3] };
        Surroundings { drift, time: time.max(SHORTEST * relaxation_time), length }
    }

    /// T_L (s) and L_e (m) far from walls.
    #[inline(always)]
    fn scales(&self, local: &Local, nu: f64) -> (f64, f64) {
        let kolmogorov = (nu / local.epsilon).sqrt();
        let time = self.time_scale * (local.k / local.epsilon).max(6.0 * kolmogorov);
        // (ν³/ε)^{1/4} = √ν (ν/ε)^{1/4}
        let length = (local.k * local.k.sqrt() / local.epsilon).max(70.0 * (nu * kolmogorov).sqrt());
        // C_μ^{3/4} with C_μ = 0.09
        const LENGTH: f64 = 0.164_316_767_251_549_83;
        (time, LENGTH * length)
    }

    /// ∇·S = Σ_d ∂(S d)/∂d over three directions at right angles, 1/s.
    #[inline(always)]
    fn divergence(&self, fluid: &impl Fn(Vec3) -> Local, x: Vec3, local: &Local, nu: f64, length: f64) -> Vec3 {
        let step = REACH * local.wall_distance.min(length).max(REACH * length);
        directions(local).iter().fold([0.0; 3], |sum, d| {
            let there = fluid(add(x, scale(*d, step)));
            let change = sub(self.fluctuation(*d, &there, nu), self.fluctuation(*d, local, nu));
            add(sum, scale(change, 1.0 / step))
        })
    }

    /// How long a sphere of a relaxation time (s) that moves at a speed (m/s) against the fluid takes to cross an eddy of
    /// a length (m), s; infinite if it never does.
    #[inline(always)]
    pub fn crossing(&self, length: f64, relaxation_time: f64, relative_speed: f64) -> f64 {
        let share = length / (relaxation_time * relative_speed);
        if share < 1.0 { -relaxation_time * ln(1.0 - share) } else { f64::INFINITY }
    }

    /// u' = S ζ (m/s) where the mean flow is `local`: to be added to the mean velocity.
    #[inline(always)]
    pub fn fluctuation(&self, deviates: [f64; 3], local: &Local, nu: f64) -> [f64; 3] {
        if local.k <= 0.0 {
            return [0.0; 3];
        }
        let [along, normal, across] = self.near_wall.intensities(local, nu);
        if dot(local.wall_normal, local.wall_normal) == 0.0 || (along == normal && along == across) {
            return scale(deviates, along);
        }
        let [t, n, b] = directions(local);
        let part = |d: Vec3, sigma: f64| scale(d, sigma * dot(d, deviates));
        add(add(part(t, along), part(n, normal)), part(b, across))
    }
}

/// Along the flow, along the wall's normal, and across; x, y, z where no wall is known.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Stream};

    pub(super) const NU: f64 = 1.5e-5;

    pub(super) fn near_wall(y_plus: f64) -> Local {
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

    fn isotropic() -> RandomWalk {
        RandomWalk { near_wall: NearWall::Isotropic, ..RandomWalk::default() }
    }

    #[test]
    fn far_from_walls_the_variance_is_two_thirds_k() {
        let (seed, n) = (11, 20_000);
        let local = Local { k: 0.6, epsilon: 1.0, ..Local::uniform([1.0, 0.0, 0.0]) };
        let walk = RandomWalk { life: Life::Random, ..RandomWalk::default() };
        let (mut variance, mut life) = ([0.0; 3], 0.0);
        for particle in 0..n {
            let mut s = Stream::new(seed, particle, Purpose::Eddy, 0);
            let eddy = walk.eddy(s.normals(), s.open_uniform());
            let u = walk.fluctuation(eddy.deviates, &local, NU);
            variance = add(variance, u.map(|c| c * c / n as f64));
            life += eddy.life / n as f64;
        }
        let e = 4.0 / (n as f64).sqrt();
        assert!(variance.iter().all(|v| (v / 0.4 - 1.0).abs() < 1.42 * e), "seed {seed}: {variance:?}");
        assert!((life - 1.0).abs() < e, "seed {seed}: {life}");
        let time = walk.surroundings(|_| local, [0.0; 3], NU, 0.0).time;
        assert!((time / 0.09 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn eddies_at_a_wall_keep_kolmogorovs_scales() {
        // in wall units: T⁺ = 6/√ε⁺, L⁺ = 70/ε⁺^{1/4} where k vanishes; above, k and ε rule
        let local = Local { k: 1e-12, epsilon: 1.0 / 6.0, ..Local::uniform([1.0, 0.0, 0.0]) };
        let near = isotropic().surroundings(|_| local, [0.0; 3], 1.0, 0.0);
        assert!((near.time - 0.15 * 6.0 * 6.0f64.sqrt()).abs() < 1e-12, "{near:?}");
        assert!((near.length - 0.09f64.powf(0.75) * 70.0 * 6.0f64.powf(0.25)).abs() < 1e-12, "{near:?}");
        let far = isotropic().surroundings(|_| Local { k: 2.0, epsilon: 0.008, ..local }, [0.0; 3], 1.0, 0.0);
        assert!((far.time - 0.15 * 250.0).abs() < 1e-12, "{far:?}");
        assert!((far.length - 0.09f64.powf(0.75) * 2.0f64.powf(1.5) / 0.008).abs() < 1e-10, "{far:?}");
    }

    #[test]
    fn an_eddy_is_crossed_or_not() {
        // x = s τ (1 − e^{−t/τ}) reaches the length at t
        let t = isotropic().crossing(0.01, 0.1, 1.0);
        assert!((0.1 * (1.0 - (-t / 0.1).exp()) - 0.01).abs() < 1e-15);
        assert_eq!(isotropic().crossing(0.01, 0.1, 0.05), f64::INFINITY);
        // what follows the fluid never crosses
        assert_eq!(isotropic().crossing(0.01, 0.0, 1e3), f64::INFINITY);
        let still = Local::uniform([0.0; 3]);
        assert_eq!(isotropic().surroundings(|_| still, [0.0; 3], NU, 0.0), Surroundings::CALM);
        assert_eq!(isotropic().fluctuation([1.0; 3], &still, NU), [0.0; 3]);
    }

    #[test]
    fn a_wall_at_any_angle() {
        let n = [0.6, 0.8, 0.0];
        let along = [0.8, -0.6, 0.0];
        let local = Local { wall_normal: n, velocity: along, ..near_wall(0.0) };
        let u = RandomWalk::default().fluctuation([0.3, 5.0, -0.4], &local, NU);
        assert!(dot(u, n).abs() < 1e-15 && dot(u, along) * dot([0.3, 5.0, -0.4], along) > 0.0);
    }

    #[test]
    fn divergence_by_hand() {
        // around an axis: ∇·S = [dσ_n/dr + (σ_n − σ_b)/r] e_r; here σ_n and σ_b of Wang & James with k ~ y
        let (radius, u_tau) = (0.1, 0.1);
        let fluid = |x: Vec3| {
            let r = x[1].hypot(x[2]);
            let y = radius - r;
            let n = [0.0, -x[1] / r, -x[2] / r];
            Local { k: 0.4 * y, wall_distance: y, wall_normal: n, ..near_wall(1.0) }
        };
        let walk = RandomWalk::default();
        let sigma = |r: f64| walk.near_wall.intensities(&fluid([0.0, r, 0.0]), NU);
        for y_plus in [0.3, 5.0, 60.0, 170.0] {
            let r = radius - y_plus * NU / u_tau;
            let h = 1e-4 * (radius - r);
            let [_, n, b] = sigma(r);
            let slope = (sigma(r + h)[1] - sigma(r - h)[1]) / (2.0 * h);
            let want = slope + (n - b) / r;
            let x = [0.7, 0.6 * r, -0.8 * r];
            let got = walk.surroundings(fluid, x, NU, 0.0).drift;
            let out = 0.6 * got[1] - 0.8 * got[2];
            assert!((out / want - 1.0).abs() < 1e-3, "{y_plus} {got:?} {want}");
            assert!(got[0].abs() + (0.8 * got[1] + 0.6 * got[2]).abs() < 1e-4 * want.abs(), "{y_plus} {got:?}");
        }
    }

    #[test]
    fn a_heavy_sphere_feels_no_drift() {
        let fluid = |x: Vec3| Local { k: 1.0 + x[0], epsilon: 1.0, ..Local::uniform([0.0; 3]) };
        let drift = |life, st: f64| {
            let walk = RandomWalk { life, ..isotropic() };
            walk.surroundings(fluid, [0.0; 3], NU, st * 0.15).drift[0] / (1.0f64 / 6.0).sqrt()
        };
        for life in [Life::Constant, Life::Random] {
            assert!((drift(life, 0.0) - 1.0).abs() < 1e-3 && drift(life, f64::INFINITY) == 0.0, "{life:?}");
            assert!((1e6 * drift(life, 1e6) - 1.0).abs() < 1e-2, "{life:?} {}", drift(life, 1e6));
            let mut before = 1.0;
            for st in [1e-3, 1.99e-3, 2.01e-3, 0.1, 1.0, 10.0, 1.99e3, 2.01e3] {
                let now = drift(life, st);
                assert!(now < before && (now * (1.0 + st) - 1.0).abs() < 0.21, "{life:?} {st} {now}");
                before = now;
            }
        }
        assert!((drift(Life::Random, 1.0) - 0.5).abs() < 1e-3);
        let plain = RandomWalk { drift: false, ..isotropic() };
        assert_eq!(plain.surroundings(fluid, [0.0; 3], NU, 0.0).drift, [0.0; 3]);
    }
}
