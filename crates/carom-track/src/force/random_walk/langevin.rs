//! The normalised Langevin walk: the fluctuation a sphere meets changes little by little instead of eddy by eddy.
//!
//! u' = S(x) ζ as for eddies, but each of the three components of ζ is an Ornstein–Uhlenbeck process of unit variance,
//!
//! dζ = −ζ dt/T_L + √(2/T_L) dW + φ ∇·S dt,
//!
//! T_L(x) the Lagrangian time scale (s), W Wiener processes, S (m/s) with S Sᵀ = ⟨u'u'⟩ and φ what a sphere with inertia
//! feels of the drift, 1/(1 + τ/T_L) (Bocksell & Loth 2006, Int. J. Multiphase Flow 32, 1234–1253; Dehbi 2008, Int. J. Multiphase
//! Flow 34, 819–828, doi:10.1016/j.ijmultiphaseflow.2008.02.007). Dividing by the rms first goes back to Durbin and to Wilson, Thurtell &
//! Kidd 1981 (Boundary-Layer Meteorol. 21, 295–313, doi:10.1007/BF00119275).
//!
//! # Well mixed
//! For dx/dt = U + Sζ, ∇·U = 0, the even density with normal ζ, n N(ζ), does not change in time: friction and noise keep N;
//! of the rest, ∂_i(S_ij ζ_j) N + ∂/∂ζ_j [(∇·S)_j N] = ζ_j (∇·S)_j N − (∇·S)_j ζ_j N = 0 with (∇·S)_j = ∂_i S_ij. That is
//! Thomson's condition (1987, J. Fluid Mech. 180, 529–556, doi:10.1017/S0022112087001940), for any S, with shear stress or without.
//! `drift = false` leaves the last term out, and spheres that follow the fluid gather where S is small.
//!
//! # In time
//! ζ but for its drift is held for an interval of s = [`SHARE`] time scales, counted at the places the sphere comes to, and
//! then becomes a ζ + √(1 − a²) N, N three new normal deviates, a = (1 − s/2)/(1 + s/2). This keeps the variance exactly, and since
//! the integral time scale of a held process is (s/2)(1 + a)/(1 − a) T_L, it keeps T_L exactly too: the diffusivity σ²T_L
//! does not depend on s. An exponential, a = e^{−s}, from which it differs by s³/12, would raise T_L by s²/12. What
//! a sphere with inertia does may depend on s. The deposition velocity V⁺ in a channel of δ⁺ = 300 (6000 spheres each, by a
//! program of its own):
//!
//! | s | τ⁺ = 6 | 12 | 25 |
//! |---|---|---|---|
//! | 0.05 | 0.0039 | 0.036 | 0.098 |
//! | 0.1 | 0.0038 | 0.037 | 0.097 |
//! | 0.25 | 0.0039 | 0.038 | 0.098 |
//! | 0.5 | 0.0040 | 0.038 | 0.098 |
//! | 1 | 0.0078 | 0.039 | 0.098 |
//! | chance (1 standard error) | 8 % | 3 % | 2 % |
//!
//! # Limits
//! - The correlation in time is an exponential; there are no bursts, and no eddy has a size: a sphere that falls through the
//!   turbulence meets the time scale of one that follows it (the eddy walk has a time to cross an eddy). It matters where
//!   the speed of falling is not small against σ.
//! - The three components have one time scale. Near walls it is that along the normal.
//! - 1/(1 + τ/T_L) is for turbulence that is even over the distance a sphere remembers.
//!
//! ```
//! use carom_track::force::{Eddy, Model, RandomWalk};
//! let walk = RandomWalk { model: Model::Langevin, ..RandomWalk::default() };
//! let last = Eddy { deviates: [1.0, -2.0, 0.5], age: 0.4, life: 0.25 };
//! // a = (1 − 0.2)/(1 + 0.2) = 2/3
//! let next = walk.next_eddy(&last, 0.0, || (false, [0.0; 3], 0.5));
//! assert!((next.deviates[1] + 4.0 / 3.0).abs() < 1e-15 && next.age == 0.0);
//! // the first of a sphere remembers nothing
//! assert_eq!(walk.next_eddy(&Eddy::NONE, 0.0, || (true, [3.0; 3], 0.5)).deviates, [3.0; 3]);
//! ```

use super::eddy::Eddy;
use crate::vector::{Vec3, add, scale};

/// How long ζ is held, in time scales.
pub const SHARE: f64 = 0.25;

/// a for an interval of `held` time scales.
#[inline]
fn memory(held: f64) -> f64 {
    let half = (0.5 * held).min(1.0);
    (1.0 - half) / (1.0 + half)
}

/// The next interval's fluctuation after `last`, from three standard normal deviates.
pub(super) fn next(last: &Eddy, is_first: bool, deviates: Vec3) -> Eddy {
    let kept = if is_first { 0.0 } else { memory(last.age) };
    let fresh = (1.0 - kept * kept).sqrt();
    Eddy { deviates: add(scale(last.deviates, kept), scale(deviates, fresh)), age: 0.0, life: SHARE }
}

#[cfg(test)]
mod tests {
    use super::super::{Model, RandomWalk};
    use super::*;
    use crate::random::{Purpose, Stream};

    /// A chain of intervals of one sphere.
    fn chain(seed: u64, sphere: u64, held: f64) -> impl Iterator<Item = Vec3> {
        let walk = RandomWalk { model: Model::Langevin, ..RandomWalk::default() };
        let (mut eddy, mut events) = (Eddy::NONE, 0);
        std::iter::repeat_with(move || {
            let mut s = Stream::new(seed, sphere, Purpose::Eddy, events);
            eddy = Eddy { age: held, ..walk.next_eddy(&eddy, 0.0, || (events == 0, s.normals(), 0.5)) };
            events += 1;
            eddy.deviates
        })
    }

    #[test]
    fn variance_and_diffusivity_do_not_depend_on_the_interval() {
        let (seed, spheres, until) = (3, 4000, 12.0);
        for held in [0.1, SHARE, 1.0] {
            let steps = (until / held) as usize;
            let (mut variance, mut spread) = (0.0, 0.0);
            for sphere in 0..spheres {
                let mut x = [0.0; 3];
                for u in chain(seed, sphere, held).take(steps) {
                    x = add(x, scale(u, held));
                    variance += u.iter().map(|u| u * u).sum::<f64>() / (3 * steps) as f64;
                }
                spread += x.iter().map(|x| x * x).sum::<f64>() / 3.0;
            }
            let n = spheres as f64;
            // Taylor's 2σ²T [t − T(1 − e^{−t/T})] with T = 1, for held values to within s²/12 of T
            let want = 2.0 * (until - 1.0);
            let error = 4.0 * (2.0 / (3.0 * n)).sqrt();
            assert!((spread / n / want - 1.0).abs() < error, "seed {seed}: {held}: {}", spread / n / want);
            assert!((variance / n - 1.0).abs() < error, "seed {seed}: {held}: {}", variance / n);
        }
    }

    #[test]
    fn it_forgets_as_an_exponential() {
        // a^{1/s} = 1/e within s²/12
        for held in [0.01, 0.1, SHARE] {
            let over_one_scale = carom::math::pow(memory(held), 1.0 / held) * std::f64::consts::E;
            assert!((over_one_scale - 1.0).abs() < 1.01 * held * held / 12.0, "{held} {over_one_scale}");
        }
        // longer than it can remember
        assert_eq!(memory(3.0), 0.0);
    }

    #[test]
    fn a_sphere_follows_as_its_drift_says() {
        // ⟨u'v⟩/σ² = 1/(1 + St): dv/dt = (u − v)/τ in closed form over each interval, T_L = 1
        let (seed, spheres, steps) = (5, 60, 4000);
        for stokes in [0.3, 1.0, 5.0f64] {
            let left = (-SHARE / stokes).exp();
            let mut uv = 0.0;
            for sphere in 0..spheres {
                let mut v = [0.0; 3];
                for (i, u) in chain(seed, sphere, SHARE).take(steps).enumerate() {
                    // the mean of v over the interval, without the start
                    let lag = [v[0] - u[0], v[1] - u[1], v[2] - u[2]];
                    let mean = add(u, scale(lag, stokes / SHARE * (1.0 - left)));
                    if i >= steps / 4 {
                        uv += (0..3).map(|c| u[c] * mean[c]).sum::<f64>();
                    }
                    v = add(u, scale(lag, left));
                }
            }
            let got = uv / (spheres as f64 * 0.75 * steps as f64 * 3.0);
            let want = 1.0 / (1.0 + stokes);
            // products correlate over 2 T_L (1 + St)
            let error =
                4.0 * (2.0 * want / (3.0 * spheres as f64 * 0.75 * steps as f64 * SHARE / 2.0 / (1.0 + stokes))).sqrt();
            assert!((got - want).abs() < error.min(0.05 * want), "seed {seed}: {stokes}: {got} {want} ± {error}");
        }
    }
}
