//! The curvature of the surface at the contact, and the sphere that would make the same contact on a flat wall.
//!
//! - With 1/r_i the principal curvatures of the surface (positive convex, negative concave), the gap between sphere and surface has the
//!   principal relative curvatures 1/R + 1/r_i. Where they differ the Hertz contact is an ellipse. To first order in their difference
//!   it takes force, overlap and area as a circular one whose radius is their geometric mean r = κR,
//!   κ = 1/√((1 + R/r₁)(1 + R/r₂)) (Johnson 1985, §4.2: R_e, with his F₁ and F₂ taken as 1).
//! - A sphere, r₁ = r₂ = r_s: κ = 1/(1 + R/r_s), exactly.
//! - A cylinder, r₁ = ∞ and r₂ = R_w outside a rod, −R_w inside a bore: κ = 1/√(1 ± R/R_w).
//!
//! | symbol | | unit |
//! |---|---|---|
//! | R | sphere radius | m |
//! | r_i, r_s, R_w | radius of curvature of the surface: principal, of a sphere, of a cylinder | m |
//! | r | effective radius of the contact | m |
//!
//! Range, for a cylinder, against the exact elliptical contact (complete elliptic integrals): of the radius that gives the exact force at
//! an overlap, and of the one that gives the exact area, κ is off by
//!
//! | R/R_w | bore: force | bore: area | rod: force | rod: area |
//! |---|---|---|---|---|
//! | 0.1 | −0.05 % | +0.02 % | −0.04 % | +0.01 % |
//! | 0.25 | −0.34 % | +0.11 % | −0.21 % | +0.07 % |
//! | 0.5 | −2.0 % | +0.66 % | −0.68 % | +0.23 % |
//! | 0.7 | −5.8 % | +1.9 % | −1.2 % | +0.39 % |
//! | 0.9 | −19 % | +6.3 % | −1.7 % | +0.56 % |
//!
//! For comparison, a sphere of twice the cylinder's radius (κ = 1/(1 ± R/(2R_w)), right to first order too) is off by −1.4 % and −0.9 %
//! in a bore at R/R_w = 0.25, by −7.6 % and −5.1 % at 0.5.
//!
//! K. L. Johnson, *Contact Mechanics*, Cambridge 1985, ch. 4, <https://doi.org/10.1017/CBO9781139171731>.
//!
//! ```
//! use carom::curvature::Curvature;
//! assert_eq!(Curvature::FLAT.relative_radius(50e-6), 1.0);
//! assert!((Curvature::sphere(-0.2e-3).relative_radius(50e-6) - 4.0 / 3.0).abs() < 1e-15);
//! // a 100 um sphere in a bore of 0.4 mm; exact: 1.158685 by force, 1.153379 by area
//! assert!((Curvature::cylinder(-0.2e-3).relative_radius(50e-6) - 1.154701).abs() < 1e-6);
//! ```

use crate::math::{BEST, Fma, sqrt};

/// The principal curvatures of a surface, 1/m: positive is convex, negative concave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature {
    first: f64,
    second: f64,
}

impl Curvature {
    /// A plane.
    pub const FLAT: Self = Self { first: 0.0, second: 0.0 };

    /// A sphere of radius `r` (m), negative for the inside of one; infinite is flat.
    pub fn sphere(r: f64) -> Self {
        Self { first: 1.0 / r, second: 1.0 / r }
    }

    /// A cylinder of radius `r` (m): a rod's outside, negative for a bore's inside; infinite is flat.
    pub fn cylinder(r: f64) -> Self {
        Self { first: 0.0, second: 1.0 / r }
    }

    /// Whether it is a plane.
    #[inline(always)]
    pub fn is_flat(&self) -> bool {
        self.first == 0.0 && self.second == 0.0
    }

    /// κ = r/R for a sphere of radius `radius` (m): 1 on a flat surface; not positive or NaN where the sphere does not fit into a
    /// hollow.
    pub fn relative_radius(&self, radius: f64) -> f64 {
        self.kappa(BEST, radius)
    }

    #[inline(always)]
    pub(crate) fn kappa<F: Fma>(&self, f: F, radius: f64) -> f64 {
        let (a, b) = (f.fma(self.first, radius, 1.0), f.fma(self.second, radius, 1.0));
        // of two negative numbers the product would pass for that of two positive ones
        1.0 / (a * sqrt(b / a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    /// Complete elliptic integrals K(m), E(m) by the arithmetic-geometric mean.
    fn elliptic(m: f64) -> (f64, f64) {
        let (mut a, mut b, mut c) = (1.0, (1.0 - m).sqrt(), m.sqrt());
        let (mut sum, mut power) = (0.5 * c * c, 1.0);
        while c.abs() > 1e-15 {
            (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
            sum += power * c * c;
            power *= 2.0;
        }
        let k = PI / (2.0 * a);
        (k, k * (1.0 - sum))
    }

    /// The radii of the circular contacts with the same force at an overlap, and the same area, as the elliptical one of relative
    /// curvatures `low` ≤ `high` (Johnson 1985, Eqs 4.25–4.28).
    fn exact(low: f64, high: f64) -> [f64; 2] {
        let ratio = |m: f64| {
            let (k, e) = elliptic(m);
            (e / (1.0 - m) - k) / (k - e)
        };
        let (mut left, mut right) = (1e-6, 1.0 - 1e-9);
        for _ in 0..100 {
            let middle = 0.5 * (left + right);
            if ratio(middle) > high / low { right = middle } else { left = middle }
        }
        let (k, e) = elliptic(left);
        let ba = (1.0 - left).sqrt();
        let f1 = (4.0 / (PI * left) * ba.powf(1.5) * ((e / (ba * ba) - k) * (k - e)).sqrt()).cbrt();
        let f2 = 2.0 / PI * ba.sqrt() * k / f1;
        let mean = 1.0 / (low * high).sqrt();
        [mean / f2.powi(3), mean * f1 * f1 / f2]
    }

    #[test]
    fn a_cylinder_is_the_geometric_mean_and_as_far_from_the_exact_contact_as_the_table_says() {
        for (s, errors) in [
            (-0.1, [-0.05, 0.02]),
            (-0.25, [-0.34, 0.11]),
            (-0.5, [-1.97, 0.66]),
            (-0.7, [-5.75, 1.92]),
            (-0.9, [-18.7, 6.3]),
            (0.1, [-0.04, 0.01]),
            (0.25, [-0.21, 0.07]),
            (0.5, [-0.68, 0.23]),
            (0.7, [-1.16, 0.39]),
            (0.9, [-1.69, 0.56]),
        ] {
            let kappa = Curvature::cylinder(1.0 / s).relative_radius(1.0);
            let exact = exact(f64::min(1.0, 1.0 + s), f64::max(1.0, 1.0 + s));
            for (exact, percent) in exact.into_iter().zip(errors) {
                let error = 100.0 * (kappa / exact - 1.0);
                assert!((error - percent).abs() < 0.006 + 0.003 * percent.abs(), "{s}: {error} %, {percent} %");
            }
        }
    }

    #[test]
    fn a_sphere_keeps_the_bits_of_its_own_formula() {
        for i in 1..2000 {
            let (radius, rs) = (1e-7 * f64::from(i), if i % 2 == 0 { 3e-4 } else { -3e-4 });
            let plain = 1.0 / BEST.fma(1.0 / rs, radius, 1.0);
            assert_eq!(Curvature::sphere(rs).relative_radius(radius).to_bits(), plain.to_bits(), "{radius} {rs}");
        }
    }

    #[test]
    fn what_does_not_fit_has_no_positive_radius() {
        for curvature in [Curvature::sphere(-1e-5), Curvature::cylinder(-1e-5)] {
            for radius in [1.1e-5, 5e-5, 1e-3] {
                let kappa = curvature.relative_radius(radius);
                assert!(kappa.is_nan() || kappa <= 0.0, "{curvature:?} {radius}: {kappa}");
            }
        }
    }
}
