//! Micro-slip: an elastic contact that partly sticks and partly slips, `micro-slip`.
//!
//! Under Coulomb's law applied at every point of an elastic contact the edge slips while the middle sticks and stores energy, which
//! throws the contact point back (Maw, Barber & Fawcett 1976). For Hertz contact and any loading history this is exactly (Popov & Heß
//! 2015) a row of independent springs along ξ, in contact where ξ² < rd at overlap d, pressed by u_n = d − ξ²/r:
//!
//! F_n = 2∫E* u_n dξ,  F_t = 2∫G* u_t dξ over 0 < ξ < √(rd),  1/G* = Σ (2 − ν_i)/(4G_i),  1/E* = Σ (1 − ν_i)/(2G_i)
//!
//! each spring follows the slip while |G* u_t| ≤ f E* u_n, else slips at that bound, and forgets its stretch when it leaves the wall. The
//! sphere answers with m v̇_s = −(7/2)F_t, always along the first slip. Scaled, three numbers remain: with P the impulse per mass,
//!
//! P = f v_n π(ψ, κ, e),  ψ = |v_s|/(f v_n),  κ = G*/E*
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | v_s | slip velocity of the contact point, spin included | m/s |
//! | v_n, e, f | normal approach speed, restitution, friction coefficient | m/s, –, – |
//! | E*, G* | effective moduli, normal and tangential | Pa |
//! | G_i, ν_i | shear modulus E_i/(2(1 + ν_i)) and Poisson's ratio of each body | Pa, – |
//! | κ | stiffness ratio: 2(1 − ν)/(2 − ν) for like bodies, 2/3 (ν = ½) to 1 (ν = 0), up to 4/3 for ν = −1 | – |
//! | P | impulse per mass against the slip | m/s |
//!
//! **Restitution below one.** The history is the elastic Hertz impact, whatever the normal law lost: on separation both forces act on the
//! sphere with e times their elastic value at the same depth and time, so the normal impulse is e v_n, the tangential one stays within
//! f times that, and no energy is gained (the springs give back e times what they hold). With the [resolved](crate::resolved)
//! normal law its e enters, and f as it stands there, on the Hertz force.
//!
//! **The closed law.** [`resolved`] integrates the springs. [`MicroSlip`] holds a polynomial through it at Chebyshev nodes, for the law's κ:
//! with ψ_m = (7/2)(1 + e) − e(2 − e)/κ and u = ψ/ψ_m,
//!
//! π = (1 + e) min(1, u + u(1 − u)ρ(u, e)),  π = 1 + e from u = 1.
//!
//! It lies within 0.006 of the integration in e_t (π/ψ), for 0 ≤ e ≤ 1 and every κ; within 0.005 for ν ≥ 0. Sliding throughout begins
//! exactly at ψ = (7/2)max(1, 1 + e − 2/(7κ)), which is ψ_m at e = 1 and at most 0.5 less below. The table is made by the example
//! `micro_slip_table`.
//!
//! **When it matters.** [`rolling`](super::rolling) has P = (2/7)|v_s| up to ψ = (7/2)(1 + e). Without spin and at e = 1, κ = 0.86, its e_t
//! of 5/7 is 0.08 too low near ψ = 0, right at ψ = 1.2, 0.13 too high at ψ = 3.5 (19° from the normal at f = 0.1, 35° at f = 0.2) and
//! right again from ψ = 7. `rolling` will do for glancing impacts (tan α < 2/(7f(1 + e)), α from the surface), for f so small that
//! nearly all impacts are, and where e_t to 0.13 is enough; for steep impacts, and for the spin they leave, take micro-slip.
//!
//! Range: Hertz contact, friction by Coulomb's law point by point, adhesion without effect on the tangential force, no yield (a plastic
//! contact is larger and flatter on separation than the elastic history has it). Against 5 mm alumina on glass (Kharaz, Gorham & Salman
//! 2001) within 0.033 in e_t from 2° to 60° from the normal, with nothing fitted; rolling is 0.12 off.
//!
//! Sources: Maw, Barber & Fawcett (1976), Wear 38, 101–114, <https://doi.org/10.1016/0043-1648(76)90201-5>; Popov & Heß (2015), Method of
//! Dimensionality Reduction in Contact Mechanics and Friction, Springer, <https://doi.org/10.1007/978-3-642-53876-6>; Kharaz, Gorham &
//! Salman (2001), Powder Technol. 120, 281–291, <https://doi.org/10.1016/S0032-5910(01)00283-2>.
//!
//! ```
//! use carom::tangential::micro_slip::{MicroSlip, resolved};
//! // alumina on glass at 20° from the normal, f = 0.092, lossless: measured e_t = 0.596, rolling 5/7
//! let psi = 20.1f64.to_radians().tan() / 0.092;
//! let closed = 1.0 - MicroSlip::new(0.092, 0.859).scaled_impulse(psi, 1.0) / psi;
//! let exact = 1.0 - resolved::impulse(psi, 0.859, 1.0, 200) / psi;
//! assert!((exact - 0.593).abs() < 5e-4 && (closed - exact).abs() < 6e-3);
//! ```

pub mod resolved;
mod table;

use crate::math::{BEST, Fma};
use table::{IN_KAPPA, IN_RESTITUTION, IN_SLIP, TABLE};

/// Least and greatest κ that Poisson's ratios from ½ to −1 allow.
pub const STIFFNESS_RATIOS: [f64; 2] = [2.0 / 3.0, 4.0 / 3.0];

/// Scaled slip ψ_m from which the closed law slides throughout.
pub fn full_slip(stiffness_ratio: f64, restitution: f64) -> f64 {
    edge(BEST, 1.0 / stiffness_ratio, restitution)
}

#[inline(always)]
fn edge<F: Fma>(f: F, compliance_ratio: f64, e: f64) -> f64 {
    f.fma(e * (e - 2.0), compliance_ratio, 3.5 * (1.0 + e))
}

/// κ taken into [`STIFFNESS_RATIOS`].
fn within(stiffness_ratio: f64) -> f64 {
    let [least, greatest] = STIFFNESS_RATIOS;
    stiffness_ratio.max(least).min(greatest)
}

/// The numbers of the closed law of one pair; the [`Shape`] of its curve stands beside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartialSlip {
    friction: f64,
    /// 1/κ.
    compliance_ratio: f64,
}

impl PartialSlip {
    /// From the friction coefficient f and the stiffness ratio κ ([`crate::pair::Pair::stiffness_ratio`]), taken into
    /// [`STIFFNESS_RATIOS`].
    pub fn new(friction: f64, stiffness_ratio: f64) -> Self {
        Self { friction, compliance_ratio: 1.0 / within(stiffness_ratio) }
    }

    /// f.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// κ.
    pub fn stiffness_ratio(&self) -> f64 {
        1.0 / self.compliance_ratio
    }

    /// Slip (m/s) from which it slides throughout, when the impulse bound is `cap` = f(1 + e)v_n.
    #[inline(always)]
    pub(crate) fn sliding_slip<F: Fma>(&self, f: F, cap: f64, e: f64) -> f64 {
        cap * (edge(f, self.compliance_ratio, e) / (1.0 + e))
    }
}

/// ρ(u, e) of one κ, as powers of 2e − 1 (rows) and 2u − 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape([[f64; IN_SLIP]; IN_RESTITUTION]);

impl Shape {
    /// ρ = 0, for laws that have no micro-slip.
    pub(crate) const NONE: Self = Self([[0.0; IN_SLIP]; IN_RESTITUTION]);

    /// Of a stiffness ratio κ, taken into [`STIFFNESS_RATIOS`].
    pub fn new(stiffness_ratio: f64) -> Self {
        let at = chebyshev::<IN_KAPPA>(3.0 * within(stiffness_ratio) - 3.0);
        let mut series = [[0.0; IN_SLIP]; IN_RESTITUTION];
        for (of_kappa, factor) in TABLE.iter().zip(at) {
            for (row, given) in series.iter_mut().zip(of_kappa) {
                for (c, g) in row.iter_mut().zip(given) {
                    *c += factor * g;
                }
            }
        }
        let rows = series.map(|row| powers(&row));
        let mut shape = [[0.0; IN_SLIP]; IN_RESTITUTION];
        for i in 0..IN_SLIP {
            let column = powers(&core::array::from_fn::<_, IN_RESTITUTION, _>(|j| rows[j][i]));
            for (row, c) in shape.iter_mut().zip(column) {
                row[i] = c;
            }
        }
        Self(shape)
    }

    /// P over f(1 + e)v_n at u = ψ/ψ_m ≤ 1.
    #[inline(always)]
    pub(crate) fn fraction<F: Fma>(&self, f: F, u: f64, e: f64) -> f64 {
        let (x, y) = (f.fma(2.0, u, -1.0), f.fma(2.0, e, -1.0));
        let [s0, s1, s2, s3] = &self.0;
        let mut c = [0.0; IN_SLIP];
        for i in 0..IN_SLIP {
            c[i] = f.fma(y, f.fma(y, f.fma(y, s3[i], s2[i]), s1[i]), s0[i]);
        }
        // in halves: a short chain of dependent operations
        let x2 = x * x;
        let x4 = x2 * x2;
        halve::<_, 8>(f, &mut c, x4 * x4);
        halve::<_, 4>(f, &mut c, x4);
        halve::<_, 2>(f, &mut c, x2);
        let q = f.fma(u * (1.0 - u), f.fma(x, c[1], c[0]), u);
        if q < 1.0 { q } else { 1.0 }
    }
}

/// The closed law of one pair, with the shape of its curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MicroSlip {
    slip: PartialSlip,
    shape: Shape,
}

impl MicroSlip {
    /// From the friction coefficient f and the stiffness ratio κ, taken into [`STIFFNESS_RATIOS`].
    pub fn new(friction: f64, stiffness_ratio: f64) -> Self {
        Self { slip: PartialSlip::new(friction, stiffness_ratio), shape: Shape::new(stiffness_ratio) }
    }

    /// κ.
    pub fn stiffness_ratio(&self) -> f64 {
        self.slip.stiffness_ratio()
    }

    /// π = P/(f v_n) at scaled slip ψ ≥ 0 and restitution e.
    pub fn scaled_impulse(&self, slip: f64, restitution: f64) -> f64 {
        let u = (slip / edge(BEST, self.slip.compliance_ratio, restitution)).min(1.0);
        (1.0 + restitution) * self.shape.fraction(BEST, u, restitution)
    }
}

/// Σ cᵢxⁱ over 2N terms as a sum over N, given x^N.
#[inline(always)]
fn halve<F: Fma, const N: usize>(f: F, c: &mut [f64; IN_SLIP], power: f64) {
    for i in 0..N {
        c[i] = f.fma(power, c[i + N], c[i]);
    }
}

/// T₀ … at z.
fn chebyshev<const N: usize>(z: f64) -> [f64; N] {
    let mut t = [1.0; N];
    for n in 1..N {
        t[n] = if n == 1 { z } else { 2.0 * z * t[n - 1] - t[n - 2] };
    }
    t
}

/// A Chebyshev series as powers.
fn powers<const N: usize>(series: &[f64; N]) -> [f64; N] {
    // T_{n+1} = 2x T_n − T_{n−1}, as coefficients
    let (mut before, mut now) = ([0.0; N], [0.0; N]);
    now[0] = 1.0;
    let mut out = [0.0; N];
    for (n, c) in series.iter().enumerate() {
        let mut next = [0.0; N];
        let twice = if n == 0 { 1.0 } else { 2.0 };
        for i in 0..N {
            out[i] += c * now[i];
            next[i] = twice * if i == 0 { 0.0 } else { now[i - 1] } - before[i];
        }
        (before, now) = (now, next);
    }
    out
}

#[cfg(test)]
mod tests;
