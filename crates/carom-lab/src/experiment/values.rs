//! Values that a panel's models are held against: measured points and stated numbers.

use super::Panel;
use carom::LawError;
use serde::{Deserialize, Serialize};

/// Measured points, in arrays of one length.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Measured {
    /// Where they come from.
    pub source: String,
    /// Speed, m/s; the panel's when absent.
    pub speed: Vec<f64>,
    /// Angle from the surface, degrees; 90 when absent.
    pub angle_deg: Vec<f64>,
    /// The same from the normal.
    pub angle_from_normal_deg: Vec<f64>,
    /// Diameter, m; the curve's when absent.
    pub diameter: Vec<f64>,
    /// The panel's quantity.
    pub value: Vec<f64>,
    /// Standard uncertainty of each; may be absent.
    pub sigma: Vec<f64>,
}

/// A point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Point {
    /// Speed, m/s.
    pub speed: f64,
    /// Angle from the surface, degrees.
    pub angle_deg: f64,
    /// Diameter, m; the curve's when absent.
    pub diameter: Option<f64>,
    /// The panel's quantity.
    pub value: f64,
    /// Its standard uncertainty.
    pub sigma: Option<f64>,
}

impl Measured {
    pub(super) fn point(&self, n: usize, speed: Option<f64>) -> Point {
        let from_normal = self.angle_from_normal_deg.get(n).map(|a| 90.0 - a);
        Point {
            speed: self.speed.get(n).copied().or(speed).unwrap_or(f64::NAN),
            angle_deg: self.angle_deg.get(n).copied().or(from_normal).unwrap_or(90.0),
            diameter: self.diameter.get(n).copied(),
            value: self.value[n],
            sigma: self.sigma.get(n).copied(),
        }
    }

    pub(super) fn check(&self, panel: &Panel) -> Result<(), LawError> {
        let wanted = self.value.len();
        let columns = [
            ("speed", &self.speed),
            ("angle_deg", &self.angle_deg),
            ("angle_from_normal_deg", &self.angle_from_normal_deg),
            ("diameter", &self.diameter),
            ("sigma", &self.sigma),
        ];
        for (name, column) in columns {
            if !column.is_empty() && column.len() != wanted {
                let message =
                    format!("measured points of {}: {} of {name} for {wanted} values", panel.name, column.len());
                return Err(LawError::new(message).help("give one for each value, or none"));
            }
        }
        if self.source.is_empty() {
            return Err(LawError::new(format!("measured points of {} without a source", panel.name)));
        }
        let mut points = (0..wanted).map(|n| self.point(n, panel.speed.map(|s| s.0)));
        if points.any(|p| !(p.speed > 0.0 && p.angle_deg > 0.0 && p.angle_deg <= 90.0 && p.value.is_finite())) {
            let message = format!(
                "measured points of {}: speeds must be positive, angles above 0 and up to 90 degrees",
                panel.name
            );
            return Err(LawError::new(message).help("a panel over angle may give one speed for all"));
        }
        Ok(())
    }
}

/// A number that a source states in words.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stated {
    /// Normal speed, m/s, or angle from the surface, degrees.
    pub at: f64,
    /// "over 0.83": the quantity is above this.
    pub above: Option<f64>,
    /// "less than 0.57": it is below this.
    pub below: Option<f64>,
    /// Uncertainty stated with it.
    #[serde(default)]
    pub sigma: f64,
    /// Where.
    pub source: String,
}
