//! Turbulent dispersion by a random walk, well mixed: through eddies (Gosman & Ioannides 1983, J. Energy 7, 482–490,
//! doi:10.2514/3.62687), or by a Langevin equation ([`langevin`]), which shares everything below but the eddies' lives.
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
//! - [`NearWall::Dns`]: all three components fitted to direct simulations, by Dreeben & Pope 1997 (Phys. Fluids 9, 154–163,
//!   doi:10.1063/1.869157; the fits as Dehbi 2008 and others quote them), in u_τ, for y⁺ < 100:
//!   u'⁺ = 0.40 y⁺/(1 + 0.0239 y⁺^1.496), v'⁺ = 0.0116 y⁺²/(1 + 0.203 y⁺ + 0.00140 y⁺^2.421), w'⁺ = 0.19 y⁺/(1 + 0.0361 y⁺^1.322);
//!   the shear stress −⟨u'v'⟩ = ρ u'v' with ρ = 0.41 − 0.19 e^{−y⁺/3}, so that S = σ_n (n nᵀ) + ρσ_t (t nᵀ) + √(1−ρ²) σ_t (t tᵀ) + …;
//!   and T⁺ = √(6.2² + (0.355 y⁺)²), with which σ_n² T_L is the simulations' eddy viscosity −⟨u'v'⟩/(dU/dy) over a turbulent Schmidt
//!   number of 0.9, that of C_L = 0.15 far from walls. ρ and T⁺ are this crate's fits to channels at δ⁺ = 547 and 2003 (Hoyas & Jiménez
//!   2006, 2008, doi:10.1063/1.2162185, doi:10.1063/1.3005862). Against those v' is right within 16 %, u' and w' within 26 %, ρ within 13 % and
//!   T within 22 % for 3 < y⁺ < 100; nearer the wall T grows as 1/y⁺ in the simulations and the fit does not.
//!
//! They are faded out smoothly between y⁺ = 150 and 200: a jump of S would be a wall to the walk.
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
pub mod langevin;
mod near_wall;
mod tensor;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod well_mixed;

pub use eddy::{Eddy, Surroundings};
pub use near_wall::NearWall;

use crate::flow::Local;
use crate::vector::{Vec3, add, scale, sub};
use carom::math::{exp, ln};
use tensor::{Tensor, directions};

/// How the fluctuation that a sphere meets changes in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// From one eddy to the next.
    #[default]
    Eddies,
    /// Little by little, by a Langevin equation: see [`langevin`].
    Langevin,
}

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

/// The fluid near a sphere: anything that gives it at a place, m. A closure does; where every instruction counts, a type whose method
/// is inlined.
pub trait Around {
    /// What is known of the fluid at `x`.
    fn at(&self, x: [f64; 3]) -> Local;
}

impl<F: Fn([f64; 3]) -> Local> Around for F {
    #[inline(always)]
    fn at(&self, x: [f64; 3]) -> Local {
        self(x)
    }
}

/// The model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RandomWalk {
    /// Eddies or a Langevin equation.
    pub model: Model,
    /// Near-wall correction.
    pub near_wall: NearWall,
    /// Distribution of the eddies' lives; nothing to a Langevin equation.
    pub life: Life,
    /// C_L of T_L = C_L k/ε.
    pub time_scale: f64,
    /// Whether eddies drift and age with the place, so that spheres which follow the fluid stay evenly spread.
    pub drift: bool,
}

/// Eddies, Wang & James, constant life, C_L = 0.15, with drift.
impl Default for RandomWalk {
    fn default() -> Self {
        Self {
            model: Model::default(),
            near_wall: NearWall::default(),
            life: Life::default(),
            time_scale: 0.15,
            drift: true,
        }
    }
}

/// Where a flow is sampled again for ∇·S, over the distance to the wall.
const REACH: f64 = 1e-4;

/// Shortest time scale in relaxation times: shorter ones a sphere does not feel, and they would take for ever.
const SHORTEST: f64 = 5e-4;

impl RandomWalk {
    /// A Langevin equation with the statistics of direct simulations near walls.
    pub fn langevin() -> Self {
        Self { model: Model::Langevin, near_wall: NearWall::Dns, ..Self::default() }
    }

    /// A new eddy, from three standard normal deviates and one uniform in (0, 1).
    pub fn eddy(&self, deviates: [f64; 3], uniform: f64) -> Eddy {
        let life = match self.life {
            Life::Constant => 2.0,
            Life::Random => -ln(uniform.max(1e-300)),
        };
        Eddy { deviates, age: 0.0, life }
    }

    /// The next eddy that lasts, begun at an age, after the `last` one, from draws: whether it is a sphere's first, deviates and uniform.
    ///
    /// A sphere is injected into the midst of an eddy: of constant life, its first has lived for a while already.
    pub fn next_eddy(&self, last: &Eddy, age: f64, mut draw: impl FnMut() -> (bool, [f64; 3], f64)) -> Eddy {
        if self.model == Model::Langevin {
            let (first, deviates, _) = draw();
            return langevin::next(last, first, deviates);
        }
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
    pub fn surroundings(&self, fluid: impl Around, x: [f64; 3], nu: f64, relaxation_time: f64) -> Surroundings {
        let local = fluid.at(x);
        if !(local.k > 0.0 && local.epsilon > 0.0) {
            return Surroundings::CALM;
        }
        let (free, length) = self.scales(&local, nu);
        let time = self.near_wall.time(free, &local, nu);
        let follows = if self.drift { self.response(relaxation_time / time) } else { 0.0 };
        let drift =
            if follows > 0.0 { scale(self.divergence(&fluid, x, &local, nu, length), follows) } else { [0.0; 3] };
        Surroundings { drift, time: time.max(SHORTEST * relaxation_time), length }
    }

    /// ⟨u'v⟩/σ² of a sphere.
    #[inline(always)]
    fn response(&self, stokes: f64) -> f64 {
        match self.model {
            Model::Eddies => self.life.response(stokes),
            Model::Langevin => Life::Random.response(stokes),
        }
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

    /// ∇·S = Σ_d ∂(Sᵀ d)/∂d over three directions at right angles, 1/s.
    #[inline(always)]
    fn divergence(&self, fluid: &impl Around, x: Vec3, local: &Local, nu: f64, length: f64) -> Vec3 {
        let step = REACH * local.wall_distance.min(length).max(REACH * length);
        let here = Tensor::new(self.near_wall, local, nu);
        let mut sum = [0.0; 3];
        for d in directions(local) {
            let there = Tensor::new(self.near_wall, &fluid.at(add(x, scale(d, step))), nu);
            let change = sub(there.apply::<true>(d), here.apply::<true>(d));
            sum = add(sum, scale(change, 1.0 / step));
        }
        sum
    }

    /// How long a sphere of a relaxation time (s) that moves at a speed (m/s) against the fluid takes to cross an eddy of
    /// a length (m), s; infinite if it never does, as where no eddy has a size.
    #[inline(always)]
    pub fn crossing(&self, length: f64, relaxation_time: f64, relative_speed: f64) -> f64 {
        if self.model == Model::Langevin {
            return f64::INFINITY;
        }
        let share = length / (relaxation_time * relative_speed);
        if share < 1.0 { -relaxation_time * ln(1.0 - share) } else { f64::INFINITY }
    }

    /// u' = S ζ (m/s) where the mean flow is `local`: to be added to the mean velocity.
    #[inline(always)]
    pub fn fluctuation(&self, deviates: [f64; 3], local: &Local, nu: f64) -> [f64; 3] {
        Tensor::new(self.near_wall, local, nu).apply::<false>(deviates)
    }
}
