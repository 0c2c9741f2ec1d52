//! C_R from what a law says of its roughness.

use super::LawSpec;
use super::check::{checked, need, not_negative, positive};
use crate::error::SpecError;
use crate::pair::Pair;
use crate::roughness::{self, CALIBRATED_ROUGHNESS, RoughnessModel, fuller_tabor};
use crate::scatter::{self, Scatter};

/// How rough a surface is, and what that leaves of adhesion.
#[derive(Clone, Copy)]
pub(super) struct Roughness {
    /// σ_r, if given.
    pub height: Option<f64>,
    /// C_R.
    pub factor: f64,
    /// C_R lies beyond its curve's calibration.
    pub extrapolated: bool,
}

impl LawSpec {
    /// Whether the wall scatters: impacts then depend on their draws, and even a head-on one meets its facet obliquely.
    pub fn scatters(&self) -> bool {
        self.roughness_angle.as_ref().is_some_and(|a| a.value.0 > 0.0)
    }

    /// C_R: given, or from the roughness by its model, or 1. Fuller & Tabor's needs the `pair`; where there is none, nothing adheres.
    pub(super) fn roughness(&self, spacing: f64, pair: Option<&Pair>) -> Result<Roughness, SpecError> {
        let height = checked(&self.roughness, "roughness", |l| l.0, not_negative, "zero or more is wanted, in m")?;
        let given = checked(
            &self.roughness_factor,
            "roughness_factor",
            |n| n.0,
            |v| v > 0.0 && v <= 1.0,
            "C_R lies above 0 and up to 1",
        )?;
        if let (Some(_), Some(at)) = (given, &self.roughness) {
            return Err(SpecError::new("both roughness_factor and roughness")
                .help("C_R is given or follows from the roughness: keep one")
                .at(at.span.clone()));
        }
        self.refuse_idle_roughness_keys()?;
        let (factor, extrapolated) = match (given, height) {
            (Some(factor), _) => (factor, false),
            (None, None) => (1.0, false),
            (None, Some(height)) if self.model() == RoughnessModel::FullerTabor => {
                (self.fuller_tabor(height, pair)?, false)
            }
            (None, Some(height)) => (roughness::factor(height, spacing), height > CALIBRATED_ROUGHNESS),
        };
        Ok(Roughness { height, factor, extrapolated })
    }

    /// The facets of a wall that scatters; none where Δγ is absent or 0.
    pub(super) fn scatter(&self) -> Result<Option<Scatter>, SpecError> {
        let angle = checked(
            &self.roughness_angle,
            "roughness_angle",
            |a| a.0,
            |a| (0.0..=scatter::LARGEST).contains(&a),
            "the standard deviation lies between 0 and 30 deg, such as \"5 deg\"; a bare number is in radians",
        )?;
        Ok(angle.filter(|a| *a > 0.0).map(Scatter::new))
    }

    fn model(&self) -> RoughnessModel {
        self.roughness_model.as_ref().map(|m| m.value).unwrap_or_default()
    }

    fn refuse_idle_roughness_keys(&self) -> Result<(), SpecError> {
        if let (Some(at), None) = (&self.roughness_model, &self.roughness) {
            return Err(SpecError::new("roughness_model has no effect without roughness")
                .help("give roughness = \"0.5 nm\", or leave the key out")
                .at(at.span.clone()));
        }
        match &self.asperity_radius {
            Some(at) if self.model() == RoughnessModel::Rabinovich => {
                Err(SpecError::new("asperity_radius has no effect on this roughness model")
                    .help("write roughness_model = \"fuller-tabor\", or leave the key out")
                    .at(at.span.clone()))
            }
            _ => Ok(()),
        }
    }

    fn fuller_tabor(&self, height: f64, pair: Option<&Pair>) -> Result<f64, SpecError> {
        let place = self.roughness_model.as_ref().and_then(|m| m.span.clone());
        let radius =
            checked(&self.asperity_radius, "asperity_radius", |l| l.0, positive, "a positive length is wanted")?
                .ok_or_else(|| need("the asperities' radius", "asperity_radius = \"100 nm\"").at(place.clone()))?;
        let Some(pair) = pair else { return Ok(1.0) };
        let at_place = |e: SpecError| e.at(place.clone());
        let (w, e_star) = (pair.work_of_adhesion().map_err(at_place)?, pair.effective_modulus().map_err(at_place)?);
        if w <= 0.0 {
            return Ok(1.0);
        }
        Ok(fuller_tabor::factor(fuller_tabor::adhesion_parameter(height, radius, w, e_star)))
    }
}
