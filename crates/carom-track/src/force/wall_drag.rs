//! Drag near a plane wall, at Re ≪ 1: with ε = gap/R and s = 1/(1 + ε) = R/(distance of the centre),
//!
//! F = 3πμd [f(s) u − λ(s) v]: u the fluid's velocity at the centre as it were without the sphere, v the sphere's, both against the wall's.
//!
//! **Normal**: λ_n = s/(1 − s) − (1/5) ln(1 − s) + 1 − 0.07422 s + 0.15833 s² − 0.13894 s³ + 0.03020 s⁴, a fit to Brenner's exact series
//! (1961, Chem. Eng. Sci. 16, 242–251, doi:10.1016/0009-2509(61)80035-3) within 5e-5 at 10⁻⁴ ≤ ε ≤ 200; its lead terms are
//! lubrication's (Cox & Brenner 1967, Chem. Eng. Sci. 22, 1753–1777, doi:10.1016/0009-2509(67)85208-4). f_n = 1 + (9/8) s + 1.105 s³
//! joins the first image to the 3.23 of a sphere that touches the wall in a stagnation flow (Goren & O'Neill 1971, Chem. Eng. Sci. 26, 325–338,
//! doi:10.1016/0009-2509(71)83013-0): an interpolation.
//!
//! **Along the wall**: λ_t = 1 − (8/15) ln(1 − s) + 0.02917 s + 0.03676 s² + 0.01318 s³ − 0.47556 s⁴ + 0.75152 s⁵ − 0.39627 s⁶
//! goes from Faxén's series over Goldman, Cox & Brenner's exact values (1967, Chem. Eng. Sci. 22, 637–651,
//! doi:10.1016/0009-2509(67)80047-2) to their −(8/15) ln ε + 0.9588, within 1e-3. A sphere held in a shear feels
//! f_t = 1 + (9/16) s + 0.30657 s² − 0.25168 s³ + 0.08311 s⁴ (their part II, 653–660, doi:10.1016/0009-2509(67)80048-4; 1.7005 at contact, within
//! 3e-4). Both are of a sphere that does not spin; one that spins freely meets up to 1/8 less near contact. No torque is added.
//!
//! **Contact.** λ_n grows as 1/ε, and in a continuum no sphere would ever touch. The gap therefore counts as no less than `least_gap`: in a
//! gas the mean free path, below which lubrication gives way (Hocking 1973, J. Eng. Math. 7, 207–221, doi:10.1007/BF01535282), in a
//! liquid a thousandth of the radius, as spheres' roughness was found by their fall (Smart & Leighton 1989, Phys. Fluids A 1, 52–60,
//! doi:10.1063/1.857523). From there the drag is constant and the sphere touches with a speed that the wall law sees.
//!
//! Only the nearest wall counts, as the plane that touches it there: in a gap between two walls that underrates the drag (in the
//! middle of a slit of 10 R by 4 %), on a round wall it is right for R ≪ its radius. A sphere in the slip regime (Kn > 0.1) is outside: the
//! correction multiplies its slip-corrected drag, and where λ > R it has gone at every gap.
//!
//! ```
//! use carom_track::force::wall_drag;
//! // Brenner's λ at cosh α = 1.5431 is 3.0360
//! assert!((wall_drag::normal(0.5431) - 3.0360).abs() < 3e-4);
//! ```

use super::Sphere;
use crate::flow::Fluid;
use crate::vector::{add, dot, scale, sub};
use carom::math::ln;

/// The wall nearest to a sphere's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Distance of the centre, m.
    pub distance: f64,
    /// Unit normal of the wall there, to the centre.
    pub normal: [f64; 3],
    /// Velocity of the wall, m/s.
    pub velocity: [f64; 3],
}

/// Drag that knows of walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallDrag {
    /// Gaps count as no less than this, m; where it is not given, as the mean free path in a gas and R/1000 in a liquid.
    pub least_gap: Option<f64>,
}

impl WallDrag {
    /// Acceleration (m/s²) by drag of a rate (1/s, far from walls) on a sphere at velocity `v` in fluid of velocity `u` (m/s).
    #[inline(always)]
    pub fn acceleration(
        &self,
        fluid: &Fluid,
        sphere: &Sphere,
        near: &Nearest,
        rate: f64,
        u: [f64; 3],
        v: [f64; 3],
    ) -> [f64; 3] {
        let gap = self.gap(fluid, sphere, near);
        let (u, v) = (sub(u, near.velocity), sub(v, near.velocity));
        let part = |of: [f64; 3]| scale(near.normal, dot(of, near.normal));
        let (un, vn) = (part(u), part(v));
        let across = sub(scale(un, held_normal(gap)), scale(vn, normal(gap)));
        let along = sub(scale(sub(u, un), held_along(gap)), scale(sub(v, vn), self::along(gap)));
        scale(add(across, along), rate)
    }

    /// λ_n there: the most by which the wall makes the drag stronger in any direction.
    #[inline(always)]
    pub fn strongest(&self, fluid: &Fluid, sphere: &Sphere, near: &Nearest) -> f64 {
        normal(self.gap(fluid, sphere, near))
    }

    /// The gap that counts, over the radius.
    #[inline(always)]
    fn gap(&self, fluid: &Fluid, sphere: &Sphere, near: &Nearest) -> f64 {
        let radius = 0.5 * sphere.diameter;
        let usual = if fluid.mean_free_path > 0.0 { fluid.mean_free_path } else { 1e-3 * radius };
        let least = self.least_gap.unwrap_or(usual);
        (near.distance - radius).max(least) / radius
    }
}

/// λ_n of a gap over the radius.
#[inline(always)]
pub fn normal(gap: f64) -> f64 {
    let s = 1.0 / (1.0 + gap);
    let rest = 1.0 + s * (-0.074_223_14 + s * (0.158_334_93 + s * (-0.138_944_61 + s * 0.030_197_98)));
    1.0 / gap + 0.2 * opened(gap) + rest
}

/// λ_t of a gap over the radius.
#[inline(always)]
pub fn along(gap: f64) -> f64 {
    let s = 1.0 / (1.0 + gap);
    let low = s * (0.029_166_67 + s * (0.036_758_31 + s * 0.013_183_8));
    let high = s * s * s * s * (-0.475_560_96 + s * (0.751_522_71 - s * 0.396_270_52));
    1.0 + 8.0 / 15.0 * opened(gap) + low + high
}

/// f_t of a gap over the radius.
#[inline(always)]
pub fn held_along(gap: f64) -> f64 {
    let s = 1.0 / (1.0 + gap);
    1.0 + s * (0.5625 + s * (0.306_565_68 + s * (-0.251_677_08 + s * 0.083_111_41)))
}

/// f_n of a gap over the radius.
#[inline(always)]
pub fn held_normal(gap: f64) -> f64 {
    let s = 1.0 / (1.0 + gap);
    1.0 + s * (1.125 + 1.105 * s * s)
}

/// −ln(1 − s) = ln(1 + 1/ε).
#[inline(always)]
fn opened(gap: f64) -> f64 {
    ln(1.0 + 1.0 / gap)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Brenner's series (1961, Eq. 2.19), summed until it no longer changes.
    fn brenner(gap: f64) -> f64 {
        let alpha = (1.0 + gap).acosh();
        let mut sum = 0.0;
        for n in 1.. {
            let n = f64::from(n);
            let (s, odd) = (alpha.sinh(), 2.0 * n + 1.0);
            // numerator and denominator over e^{(2n+1)α}
            let decay = (-odd * alpha).exp();
            let above = 1.0 - decay * decay + odd * (2.0 * alpha).sinh() * decay;
            let below = 1.0 - 2.0 * decay + decay * decay - odd * odd * s * s * decay;
            let term = n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (above / below - 1.0);
            sum += term;
            if n > 5.0 && term.abs() < 1e-12 * sum {
                return 4.0 / 3.0 * s * sum;
            }
        }
        f64::NAN
    }

    #[test]
    fn normal_motion_is_brenners() {
        // high precision: 30 digits
        for (gap, want) in [(1e-3, 1_002.353_326_869_7), (0.1, 11.459_157_203_4), (10.0, 1.113_503_233_9)] {
            assert!((brenner(gap) / want - 1.0).abs() < 1e-6, "{gap} {}", brenner(gap));
        }
        for i in 0..=60 {
            let gap = carom::math::pow(10.0, f64::from(i) / 10.0 - 4.0);
            let (got, want) = (normal(gap), brenner(gap));
            assert!((got / want - 1.0).abs() < 1e-4, "{gap} {got} {want}");
        }
    }

    #[test]
    fn motion_along_the_wall_is_goldman_cox_and_brenners() {
        // their tables: distance over radius, force on a sphere that moves, and on one held in a shear
        let table = [
            (3.7622, 1.1738, 1.1671),
            (2.3524, 1.3079, 1.2780),
            (1.5431, 1.5675, 1.4391),
            (1.1276, 2.1514, 1.6160),
            (1.0453, 2.6475, 1.6682),
            (1.005_004, 3.7863, 1.6969),
            (1.003_202, 4.0223, 1.6982),
        ];
        for (distance, moving, held) in table {
            let gap = distance - 1.0;
            assert!((along(gap) / moving - 1.0).abs() < 1e-3, "{gap} {}", along(gap));
            assert!((held_along(gap) / held - 1.0).abs() < 5e-4, "{gap} {}", held_along(gap));
        }
        // lubrication and Faxén
        assert!((along(1e-6) - (8.0 / 15.0 * 6.0 * 10f64.ln() + 0.9588)).abs() < 1e-4);
        let s: f64 = 0.1;
        let cube = s * s * s;
        let faxen = 1.0 / (1.0 - 9.0 / 16.0 * s + cube / 8.0 - 45.0 / 256.0 * s * cube - s * s * cube / 16.0);
        assert!((along(9.0) / faxen - 1.0).abs() < 1e-4);
        assert!((held_along(1e-9) - 1.7005).abs() < 1e-6 && (held_normal(1e-9) - 3.23).abs() < 1e-6);
    }

    #[test]
    fn drag_turns_with_the_wall_and_stays_finite_at_contact() {
        let (air, sphere) = (Fluid::default(), Sphere { diameter: 2e-5, density: 1000.0 });
        let drag = WallDrag { least_gap: None };
        let near = |distance| Nearest { distance, normal: [0.0, 1.0, 0.0], velocity: [0.0; 3] };
        let at = |distance, v| drag.acceleration(&air, &sphere, &near(distance), 2.0, [0.0; 3], v);
        let touching = at(1e-5, [0.0, -0.1, 0.0]);
        let least = air.mean_free_path / 1e-5;
        assert!((touching[1] / (0.2 * normal(least)) - 1.0).abs() < 1e-12 && touching[0] == 0.0, "{touching:?}");
        // the same below, and far away Stokes'
        assert_eq!(at(0.9e-5, [0.0, -0.1, 0.0]), touching);
        let far = at(1.0, [0.3, -0.1, 0.0]);
        assert!((far[0] + 0.6).abs() < 1e-4 && (far[1] - 0.2).abs() < 1e-4);
        // a wall that moves with the sphere and the fluid drags nothing
        let with = Nearest { velocity: [0.3, 0.0, 0.0], ..near(1.1e-5) };
        let a = drag.acceleration(&air, &sphere, &with, 2.0, [0.3, 0.0, 0.0], [0.3, 0.0, 0.0]);
        assert_eq!(a, [0.0; 3]);
    }
}
