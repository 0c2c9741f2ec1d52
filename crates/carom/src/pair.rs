//! Two materials as contact constants: stiffness, effective modulus, work of adhesion, plastic constant.
//!
//! Source: Kim & Dunn (2007), Eqs 5, 6, 16–18 and §4, <https://doi.org/10.1016/j.jaerosci.2007.03.006>.
//!
//! - compliance k_i = (1 − ν_i²)/(πE_i), 1/Pa (Eq. 6);
//! - Hertzian stiffness K = 4/(3π(k₁ + k₂)), Pa (Eq. 5), the same as (4/3)E* with 1/E* = Σ(1 − ν_i²)/E_i;
//! - work of adhesion w = γ₁ + γ₂ − γ₁₂ with γ₁₂ = γ₁ + γ₂ − 2Φ√(γ₁γ₂), so w = 2Φ√(γ₁γ₂), J/m² (Eqs 17, 18);
//! - plastic constant k of the body whose contact yields first, Pa: σ/2 from its yield strength σ, else H/λ from its hardness H, since
//!   the model's limiting contact pressure λk (λ = 5.7, [`crate::normal::plastic`]) is what an indentation measures. The strength at
//!   which a brittle body breaks in tension is no yield strength and is never used: under the pressure of a small contact silicon flows
//!   at about 10 GPa, though a wafer breaks at 0.1 GPa.

use crate::error::{LawError, Problem};
use crate::material::{Material, PropertyKind};
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use crate::normal::plastic::LAMBDA;
use crate::spec::Key;
use core::f64::consts::PI;

/// Values that replace what the materials would give.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overrides {
    /// Work of adhesion w, J/m².
    pub work_of_adhesion: Option<f64>,
    /// Hertzian stiffness K, Pa.
    pub stiffness: Option<f64>,
    /// Plastic constant k, Pa.
    pub plastic_constant: Option<f64>,
    /// Interfacial parameter Φ, 1 when absent.
    pub interfacial_parameter: Option<f64>,
    /// Factor on the plastic constant for strain rate and size, 1 when absent.
    pub dynamic_strength_factor: Option<f64>,
}

/// What a plastic constant follows from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StrengthSource {
    /// Given as such.
    Given,
    /// The yield strength of a body: in a table, one of a bulk specimen in a slow test.
    YieldStrength,
    /// The hardness of a body: an indentation, slow as well.
    Hardness,
}

/// The body of a pair that a value belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// The sphere.
    Sphere,
    /// The surface.
    Surface,
}

/// The plastic constant of a pair and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Strength {
    /// Plastic constant k, Pa, with the factor for strain rate and size in it.
    pub plastic_constant: f64,
    /// What it follows from.
    pub source: StrengthSource,
    /// The body that yields first; `None` where k was given for the pair.
    pub body: Option<Body>,
}

/// Contact constants of two materials. What neither the materials nor an override give is `None`, and a law that
/// needs it says so.
///
/// ```
/// use carom::{material::Material, pair::{Overrides, Pair}};
/// let steel = Material::from_inline("rho=8000,E=190GPa,nu=0.27,gamma=1.62")?;
/// let silicon = Material::from_inline("rho=2330,E=166GPa,nu=0.28,gamma=1.42")?;
/// let pair = Pair::new(&steel, &silicon, &Overrides::default());
/// assert_eq!((pair.stiffness()? / 1e8).round(), 1278.0); // Table 2: 127.8 GPa
/// assert_eq!((pair.work_of_adhesion()? * 100.0).round(), 303.0); // Table 2: 3.03 J/m²
/// # Ok::<(), carom::LawError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    sphere: Material,
    surface: Material,
    /// Whether each of the two was given: a law may need neither.
    given: [bool; 2],
    overrides: Overrides,
}

impl Pair {
    /// Puts two materials together.
    pub fn new(sphere: &Material, surface: &Material, overrides: &Overrides) -> Self {
        Self::of(Some(sphere), Some(surface), overrides)
    }

    /// As [`Pair::new`], where one of the two, or both, may be missing.
    pub(crate) fn of(sphere: Option<&Material>, surface: Option<&Material>, overrides: &Overrides) -> Self {
        let given = [sphere.is_some(), surface.is_some()];
        let body = |material: Option<&Material>, name: &str| material.cloned().unwrap_or_else(|| Material::new(name));
        Self { sphere: body(sphere, "sphere"), surface: body(surface, "surface"), given, overrides: *overrides }
    }

    /// A property of one body that the law needs; `instead` would do for it.
    fn needed(&self, body: Body, property: PropertyKind, instead: Option<Key>) -> Result<f64, LawError> {
        let (material, given) = match body {
            Body::Sphere => (&self.sphere, self.given[0]),
            Body::Surface => (&self.surface, self.given[1]),
        };
        material.value(property).ok_or_else(|| match given {
            true => Problem::MissingProperty { material: material.name.clone(), property, instead }.into(),
            false => {
                let sphere = body == Body::Sphere;
                Problem::MissingMaterial { sphere, surface: !sphere, reader: None }.into()
            }
        })
    }

    /// Young's modulus and Poisson's ratio of one body.
    fn elasticity(&self, body: Body, instead: Option<Key>) -> Result<[f64; 2], LawError> {
        Ok([
            self.needed(body, PropertyKind::YoungModulus, instead)?,
            self.needed(body, PropertyKind::PoissonRatio, instead)?,
        ])
    }

    /// Compliance k_i = (1 − ν_i²)/(πE_i), 1/Pa (Eq. 6), of one body.
    ///
    /// # Errors
    /// No Young's modulus or no Poisson's ratio.
    pub fn compliance(&self, body: Body) -> Result<f64, LawError> {
        let [e, nu] = self.elasticity(body, Some(Key::Stiffness))?;
        Ok((1.0 - nu * nu) / (PI * e))
    }

    /// The sphere's material.
    pub fn sphere(&self) -> &Material {
        &self.sphere
    }

    /// The surface's material.
    pub fn surface(&self) -> &Material {
        &self.surface
    }

    /// Density of the sphere, kg/m³.
    ///
    /// # Errors
    /// The sphere's material has none.
    pub fn density(&self) -> Result<f64, LawError> {
        self.needed(Body::Sphere, PropertyKind::Density, None)
    }

    /// Hertzian stiffness K, Pa (Eq. 5).
    ///
    /// # Errors
    /// A material without Young's modulus or Poisson's ratio, and no override.
    pub fn stiffness(&self) -> Result<f64, LawError> {
        if let Some(k) = self.overrides.stiffness {
            return Ok(k);
        }
        Ok(4.0 / (3.0 * PI * (self.compliance(Body::Sphere)? + self.compliance(Body::Surface)?)))
    }

    /// Effective modulus E* = (3/4)K, Pa.
    ///
    /// # Errors
    /// As [`Pair::stiffness`].
    pub fn effective_modulus(&self) -> Result<f64, LawError> {
        Ok(0.75 * self.stiffness()?)
    }

    /// Stiffness ratio κ = G*/E* of tangential to normal deformation, from the materials alone: an override of the stiffness
    /// scales both. See [`crate::tangential::micro_slip`].
    ///
    /// # Errors
    /// A material without Young's modulus or Poisson's ratio.
    pub fn stiffness_ratio(&self) -> Result<f64, LawError> {
        let (mut normal, mut tangential) = (0.0, 0.0);
        for body in [Body::Sphere, Body::Surface] {
            let [e, nu] = self.elasticity(body, None)?;
            normal += (1.0 - nu * nu) / e;
            // (2 − ν)/(4G) with G = E/(2(1 + ν))
            tangential += (2.0 - nu) * (1.0 + nu) / (2.0 * e);
        }
        Ok(normal / tangential)
    }

    /// Work of adhesion w, J/m² (Eqs 17, 18).
    ///
    /// # Errors
    /// A material without surface energy, and no override.
    pub fn work_of_adhesion(&self) -> Result<f64, LawError> {
        if let Some(w) = self.overrides.work_of_adhesion {
            return Ok(w);
        }
        let gamma = |body| self.needed(body, PropertyKind::SurfaceEnergy, Some(Key::WorkOfAdhesion));
        Ok(2.0
            * self.overrides.interfacial_parameter.unwrap_or(1.0)
            * (gamma(Body::Sphere)? * gamma(Body::Surface)?).sqrt())
    }

    /// Plastic constant k, Pa, of the body whose contact yields first. A body with neither yield strength nor hardness is taken to
    /// stay elastic, so one of the two is enough.
    ///
    /// # Errors
    /// Neither material has a yield strength or a hardness, and no override.
    ///
    /// ```
    /// use carom::{material::Library, pair::{Overrides, Pair, StrengthSource}};
    /// let library = Library::builtin();
    /// let pair = |sphere, surface| -> Result<_, carom::LawError> {
    ///     Ok(Pair::new(library.get(sphere)?, library.get(surface)?, &Overrides::default()))
    /// };
    /// // steel on silicon: the steel yields (sigma = 310 MPa), not the silicon, which is hard though it breaks at 120 MPa
    /// assert_eq!(pair("stainless-steel", "silicon")?.plastic_constant()?, 155e6);
    /// // quartz on silicon: both are brittle, and their hardness limits the pressure
    /// assert_eq!(pair("quartz", "silicon")?.strength()?.source, StrengthSource::Hardness);
    /// # Ok::<(), carom::LawError>(())
    /// ```
    pub fn plastic_constant(&self) -> Result<f64, LawError> {
        self.strength().map(|s| s.plastic_constant)
    }

    /// The plastic constant with where it comes from.
    ///
    /// # Errors
    /// As [`Pair::plastic_constant`].
    pub fn strength(&self) -> Result<Strength, LawError> {
        let factor = self.overrides.dynamic_strength_factor.unwrap_or(1.0);
        let strength = match self.overrides.plastic_constant {
            Some(k) => Some(Strength { plastic_constant: k, source: StrengthSource::Given, body: None }),
            None => weaker(strength_of(&self.sphere, Body::Sphere), strength_of(&self.surface, Body::Surface)),
        };
        let strength = strength.ok_or_else(|| match self.given {
            [true, true] => Problem::MissingInBoth {
                sphere: self.sphere.name.clone(),
                surface: self.surface.name.clone(),
                properties: [PropertyKind::YieldStrength, PropertyKind::Hardness],
                instead: Key::PlasticConstant,
            },
            [sphere, surface] => Problem::MissingMaterial { sphere: !sphere, surface: !surface, reader: None },
        })?;
        Ok(Strength { plastic_constant: factor * strength.plastic_constant, ..strength })
    }
}

/// What limits the pressure on one body: where it flows before it breaks its yield strength, else its hardness.
fn strength_of(material: &Material, body: Body) -> Option<Strength> {
    let ductile = material.yield_strength.map(|sigma| (sigma / 2.0, StrengthSource::YieldStrength));
    let (plastic_constant, source) =
        ductile.or(material.hardness.map(|hardness| (hardness / LAMBDA, StrengthSource::Hardness)))?;
    Some(Strength { plastic_constant, source, body: Some(body) })
}

fn weaker(a: Option<Strength>, b: Option<Strength>) -> Option<Strength> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.plastic_constant < a.plastic_constant { b } else { a }),
        (a, b) => a.or(b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Library;

    /// Table 2 as printed, (surface, sphere, w, K in GPa), where the table's own inputs reproduce it (Tedlar with the
    /// modulus its printed compliance implies, molybdenum with its decimal point restored, see the data files).
    #[test]
    fn table_2_follows_from_table_1() {
        let library = Library::builtin();
        for (surface, sphere, w, k) in [
            ("silicon", "ammonium-fluorescein", 0.24, 1.8),
            ("mica", "ammonium-fluorescein", 0.18, 1.8),
            ("molybdenum", "ammonium-fluorescein", 0.34, 1.8),
            ("tedlar-table-2", "ammonium-fluorescein", 0.03, 1.6),
            ("stainless-steel", "ag-coated-glass", 1.99, 73.4),
            ("copper", "ag-coated-glass", 1.65, 66.4),
            ("aluminium", "ag-coated-glass", 1.20, 50.9),
            ("tedlar-table-2", "ag-coated-glass", 0.21, 12.9),
            ("silicon", "stainless-steel", 3.03, 127.8),
        ] {
            let get = |n: &str| library.get(n).unwrap_or_else(|e| panic!("{e}"));
            let pair = Pair::new(get(sphere), get(surface), &Overrides::default());
            let got_w = pair.work_of_adhesion().expect("both surface energies");
            let got_k = pair.stiffness().expect("both moduli") / 1e9;
            assert!((got_w - w).abs() <= 0.0051, "{sphere} on {surface}: w = {got_w}, printed {w}");
            assert!((got_k - k).abs() <= 0.051, "{sphere} on {surface}: K = {got_k}, printed {k}");
        }
    }

    #[test]
    fn what_is_missing_is_named() {
        let bare = Material::from_inline("rho=1000").expect("fine");
        let pair = Pair::new(&bare, &bare, &Overrides::default());
        assert!(pair.stiffness().is_err_and(|e| e.to_string().contains("Young's modulus")));
        assert!(pair.work_of_adhesion().is_err_and(|e| e.to_string().contains("work_of_adhesion")));
        assert!(pair.plastic_constant().is_err_and(|e| e.to_string().contains("yield strength")));
    }

    fn strength(sphere: &str, surface: &str, overrides: &Overrides) -> Option<Strength> {
        let material = |text| Material::from_inline(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        Pair::new(&material(sphere), &material(surface), overrides).strength().ok()
    }

    #[test]
    fn the_weaker_of_yield_strength_and_hardness_limits_the_pressure_and_a_tensile_strength_never_does() {
        use Body::{Sphere, Surface};
        use StrengthSource::{Given, Hardness, YieldStrength};
        let none = Overrides::default();
        let given = Overrides { plastic_constant: Some(1e8), ..none };
        let fast = Overrides { dynamic_strength_factor: Some(3.0), ..none };
        for (sphere, surface, overrides, wanted) in [
            // a ductile body's yield strength, whatever its hardness
            ("sigma=310MPa,H=1.3GPa", "rho=1000", none, Some((155e6, YieldStrength, Some(Sphere)))),
            // a brittle body's hardness: the mean pressure 5.7 k is H
            ("rho=1000", "H=5.7GPa,sigma_t=120MPa", none, Some((1e9, Hardness, Some(Surface)))),
            ("sigma=310MPa", "H=5.7GPa,sigma_t=120MPa", none, Some((155e6, YieldStrength, Some(Sphere)))),
            ("sigma=4GPa", "H=5.7GPa,sigma_t=120MPa", none, Some((1e9, Hardness, Some(Surface)))),
            ("sigma_t=120MPa", "sigma_t=50MPa", none, None),
            // told to
            ("rho=1000", "sigma=120MPa,sigma_t=120MPa", none, Some((60e6, YieldStrength, Some(Surface)))),
            ("sigma=310MPa", "H=5.7GPa", given, Some((1e8, Given, None))),
            ("sigma=310MPa", "H=5.7GPa", fast, Some((3.0 * 155e6, YieldStrength, Some(Sphere)))),
            ("sigma=310MPa", "rho=1000", Overrides { plastic_constant: Some(1e8), ..fast }, Some((3e8, Given, None))),
        ] {
            let got = strength(sphere, surface, &overrides).map(|s| (s.plastic_constant, s.source, s.body));
            assert_eq!(got, wanted, "{sphere} on {surface}");
        }
    }
}
