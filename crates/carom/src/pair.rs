//! Two materials as contact constants: stiffness, effective modulus, work of adhesion, plastic constant.
//!
//! Source: Kim & Dunn (2007), Eqs 5, 6, 16–18 and §4, <https://doi.org/10.1016/j.jaerosci.2007.03.006>.
//!
//! - compliance k_i = (1 − ν_i²)/(πE_i), 1/Pa (Eq. 6);
//! - Hertzian stiffness K = 4/(3π(k₁ + k₂)), Pa (Eq. 5), the same as (4/3)E* with 1/E* = Σ(1 − ν_i²)/E_i;
//! - work of adhesion w = γ₁ + γ₂ − γ₁₂ with γ₁₂ = γ₁ + γ₂ − 2Φ√(γ₁γ₂), so w = 2Φ√(γ₁γ₂), J/m² (Eqs 17, 18);
//! - plastic constant k = σ/2 of the body that yields first, Pa.

use crate::error::{LawError, Problem};
use crate::material::{Material, PropertyKind};
use crate::spec::Key;
use std::f64::consts::PI;

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
    fn needed(&self, surface: bool, property: PropertyKind, instead: Option<Key>) -> Result<f64, LawError> {
        let material = if surface { &self.surface } else { &self.sphere };
        material.value(property).ok_or_else(|| match self.given[usize::from(surface)] {
            true => Problem::MissingProperty { material: material.name.clone(), property, instead }.into(),
            false => Problem::MissingMaterial { sphere: !surface, surface, reader: None }.into(),
        })
    }

    /// Young's modulus and Poisson's ratio of one body.
    fn elasticity(&self, surface: bool, instead: Option<Key>) -> Result<[f64; 2], LawError> {
        Ok([
            self.needed(surface, PropertyKind::YoungModulus, instead)?,
            self.needed(surface, PropertyKind::PoissonRatio, instead)?,
        ])
    }

    /// Compliance k_i = (1 − ν²)/(πE), 1/Pa (Eq. 6), of the sphere and of the surface.
    ///
    /// # Errors
    /// No Young's modulus or no Poisson's ratio.
    pub fn compliances(&self) -> Result<[f64; 2], LawError> {
        let one = |surface| -> Result<f64, LawError> {
            let [e, nu] = self.elasticity(surface, Some(Key::Stiffness))?;
            Ok((1.0 - nu * nu) / (PI * e))
        };
        Ok([one(false)?, one(true)?])
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
        self.needed(false, PropertyKind::Density, None)
    }

    /// Hertzian stiffness K, Pa (Eq. 5).
    ///
    /// # Errors
    /// A material without Young's modulus or Poisson's ratio, and no override.
    pub fn stiffness(&self) -> Result<f64, LawError> {
        if let Some(k) = self.overrides.stiffness {
            return Ok(k);
        }
        let [sphere, surface] = self.compliances()?;
        Ok(4.0 / (3.0 * PI * (sphere + surface)))
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
        for surface in [false, true] {
            let [e, nu] = self.elasticity(surface, None)?;
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
        let gamma = |surface| self.needed(surface, PropertyKind::SurfaceEnergy, Some(Key::WorkOfAdhesion));
        Ok(2.0 * self.overrides.interfacial_parameter.unwrap_or(1.0) * (gamma(false)? * gamma(true)?).sqrt())
    }

    /// Plastic constant k = σ/2 of the body that yields first, Pa. A body without a yield strength is taken to stay
    /// elastic (a ceramic on a metal), so one of the two is enough.
    ///
    /// # Errors
    /// Neither material has a yield strength, and no override.
    pub fn plastic_constant(&self) -> Result<f64, LawError> {
        if let Some(k) = self.overrides.plastic_constant {
            return Ok(k);
        }
        match (self.sphere.yield_strength, self.surface.yield_strength) {
            (Some(a), Some(b)) => Ok(a.min(b) / 2.0),
            (Some(a), None) | (None, Some(a)) => Ok(a / 2.0),
            (None, None) => Err(match self.given {
                [true, true] => Problem::MissingInBoth {
                    sphere: self.sphere.name.clone(),
                    surface: self.surface.name.clone(),
                    property: PropertyKind::YieldStrength,
                    instead: Key::PlasticConstant,
                },
                [sphere, surface] => Problem::MissingMaterial { sphere: !sphere, surface: !surface, reader: None },
            }
            .into()),
        }
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
}
