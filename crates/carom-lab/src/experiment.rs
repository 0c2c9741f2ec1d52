//! The text form of an experiment: laws, panels (plots) with curves and values, claims about single numbers.
//!
//! ```
//! let text = r#"
//! title = "Copper on aluminium"
//! source = "an example"
//! values_from = "made up for this example"
//! [law.adhesion]
//! sphere = "copper"
//! surface = "aluminium"
//! normal = "ea"
//! [[panel]]
//! name = "copper"
//! over = "speed"
//! range = [0.1, 10]
//! [[panel.curve]]
//! label = "adhesion alone"
//! law = "adhesion"
//! diameter = "90 um"
//! [[panel.measured]]
//! source = "an example"
//! speed = [1.0, 2.0]
//! value = [0.9, 0.95]
//! "#;
//! let experiment = carom_lab::Experiment::from_toml("example", text)?;
//! assert_eq!(experiment.panels[0].points().count(), 2);
//! # Ok::<(), carom_lab::LabError>(())
//! ```

use crate::error::LabError;
use carom::material::Library;
use carom::spec::{At, parse_named_law};
use carom::units::{Length, Number, Speed};
use carom::{SpecError, WallLaw};
use serde::{Deserialize, Serialize};

/// How much a comparison is worth, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
pub enum Tier {
    /// Measured points with a public source.
    #[serde(rename = "measured data")]
    Measured,
    /// Numbers that a source states in words: limits and single values, not points.
    #[serde(rename = "stated bounds")]
    Stated,
    /// What another model or program gives.
    #[serde(rename = "another model")]
    Model,
    /// An exact solution.
    #[serde(rename = "analytic")]
    Analytic,
    /// Nothing to hold it against.
    #[serde(rename = "prediction only")]
    Prediction,
}

impl Tier {
    /// The words in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured data",
            Self::Stated => "stated bounds",
            Self::Model => "another model",
            Self::Analytic => "analytic",
            Self::Prediction => "prediction only",
        }
    }
}

/// An experiment.
#[derive(Clone, Debug)]
pub struct Experiment {
    /// Name of its file, without ending: `wall-1990`.
    pub name: String,
    /// The file's text.
    pub text: String,
    /// What was done.
    pub title: String,
    /// Who did it, where it is published.
    pub source: String,
    /// Where the values come from, or that there are none.
    pub values_from: String,
    /// What a reader should know.
    pub notes: Vec<String>,
    /// The plots.
    pub panels: Vec<Panel>,
    /// Single numbers that a source prints, to be recomputed.
    pub claims: Vec<Claim>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    title: String,
    source: String,
    values_from: String,
    #[serde(default)]
    notes: Vec<String>,
    #[serde(default, rename = "law")]
    _laws: toml::Table,
    #[serde(default, rename = "panel")]
    panels: Vec<Panel>,
    #[serde(default, rename = "claim")]
    claims: Vec<Claim>,
}

/// What a panel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// e.
    #[default]
    Restitution,
    /// e_t of the centre.
    TangentialRestitution,
    /// μ.
    ImpulseRatio,
}

/// What runs along a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Over {
    /// Normal speed, m/s.
    Speed,
    /// Angle from the surface, degrees.
    Angle,
}

/// A plot.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Panel {
    /// Short name, which a file of points uses.
    pub name: String,
    /// Figure of Kim & Dunn (2007) that it stands for: "3".
    pub figure: Option<At<String>>,
    /// Heading of the plot; the name when empty.
    #[serde(default)]
    pub title: String,
    /// What is shown.
    #[serde(default)]
    pub quantity: Quantity,
    /// What runs.
    pub over: Over,
    /// Ends of the axis: m/s or degrees from the surface.
    pub range: [f64; 2],
    /// Speed of a panel over angle.
    pub speed: Option<Speed>,
    /// What it is worth when there is neither a measured nor a stated value.
    pub tier: Option<Tier>,
    /// The models.
    #[serde(rename = "curve", default)]
    pub curves: Vec<Curve>,
    /// Measured points.
    #[serde(default)]
    pub measured: Vec<Measured>,
    /// Stated numbers.
    #[serde(default)]
    pub stated: Vec<Stated>,
}

/// A model along a panel.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Curve {
    /// Name in the legend.
    pub label: String,
    /// A `[law.NAME]` of the same file.
    pub law: At<String>,
    /// A second law: the area between both is drawn, for an input known as a range.
    pub to: Option<At<String>>,
    /// Of the sphere.
    pub diameter: Length,
    /// Whether the line is dashed.
    #[serde(default)]
    pub dashed: bool,
}

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

impl Panel {
    /// All measured points.
    pub fn points(&self) -> impl Iterator<Item = Point> + '_ {
        self.measured.iter().flat_map(|m| (0..m.value.len()).map(|n| m.point(n, self.speed.map(|s| s.0))))
    }

    /// Where a point lies along the panel.
    pub fn place(&self, point: &Point) -> f64 {
        match self.over {
            Over::Speed => point.speed * point.angle_deg.to_radians().sin(),
            Over::Angle => point.angle_deg,
        }
    }

    /// What comparisons in it are worth.
    pub fn tier(&self) -> Tier {
        if !self.measured.is_empty() {
            Tier::Measured
        } else if !self.stated.is_empty() {
            Tier::Stated
        } else {
            self.tier.unwrap_or(Tier::Prediction)
        }
    }
}

impl Measured {
    fn point(&self, n: usize, speed: Option<f64>) -> Point {
        let from_normal = self.angle_from_normal_deg.get(n).map(|a| 90.0 - a);
        Point {
            speed: self.speed.get(n).copied().or(speed).unwrap_or(f64::NAN),
            angle_deg: self.angle_deg.get(n).copied().or(from_normal).unwrap_or(90.0),
            diameter: self.diameter.get(n).copied(),
            value: self.value[n],
            sigma: self.sigma.get(n).copied(),
        }
    }

    fn check(&self, panel: &Panel) -> Result<(), SpecError> {
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
                return Err(SpecError::new(message).help("give one for each value, or none"));
            }
        }
        if self.source.is_empty() {
            return Err(SpecError::new(format!("measured points of {} without a source", panel.name)));
        }
        let mut points = (0..wanted).map(|n| self.point(n, panel.speed.map(|s| s.0)));
        if points.any(|p| !(p.speed > 0.0 && p.angle_deg > 0.0 && p.angle_deg <= 90.0 && p.value.is_finite())) {
            let message = format!(
                "measured points of {}: speeds must be positive, angles above 0 and up to 90 degrees",
                panel.name
            );
            return Err(SpecError::new(message).help("a panel over angle may give one speed for all"));
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

/// A single number that a source prints, recomputed from its own inputs.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Figure of Kim & Dunn (2007) it belongs to.
    pub figure: Option<At<String>>,
    /// What it says.
    pub says: String,
    /// Where.
    pub source: String,
    /// The number.
    pub quantity: Figure,
    /// A `[law.NAME]` of the same file.
    pub law: At<String>,
    /// Of the sphere.
    pub diameter: Length,
    /// Where the quantity has a speed.
    pub speed: Option<Speed>,
    /// The printed number.
    pub printed: Option<f64>,
    /// Half a unit of its last digit, or what "about" allows.
    #[serde(default)]
    pub within: f64,
    /// It lies above this.
    pub above: Option<f64>,
    /// It lies below this.
    pub below: Option<f64>,
    /// What was chosen here so that it holds: then it is no test.
    #[serde(default)]
    pub by_choice: bool,
}

/// A number that a law gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Figure {
    /// Of the law's plastic loss, m/s.
    YieldVelocity,
    /// m/s.
    CaptureVelocity,
    /// At the claim's speed, head-on.
    Restitution,
    /// Greatest restitution at any speed.
    GreatestRestitution,
    /// The speed of it, m/s.
    SpeedOfGreatestRestitution,
    /// From the surface, degrees, at the claim's speed.
    CriticalAngle,
}

impl Experiment {
    /// Reads an experiment.
    ///
    /// # Errors
    /// What is wrong with the text, where.
    pub fn from_toml(name: &str, text: &str) -> Result<Self, LabError> {
        let wrong = |error| LabError::Experiment { name: format!("{name}.toml"), text: text.to_owned(), error };
        let file: File = toml::from_str(text).map_err(|e| wrong(SpecError::from(e)))?;
        let experiment = Self {
            name: name.to_owned(),
            text: text.to_owned(),
            title: file.title,
            source: file.source,
            values_from: file.values_from,
            notes: file.notes,
            panels: file.panels,
            claims: file.claims,
        };
        experiment.check().map_err(wrong)?;
        Ok(experiment)
    }

    /// Checks what serde cannot.
    pub(crate) fn check(&self) -> Result<(), SpecError> {
        for panel in &self.panels {
            if !(panel.range[0] < panel.range[1] && panel.range[0] > 0.0) {
                return Err(SpecError::new(format!(
                    "panel {}: range [{}, {}]",
                    panel.name, panel.range[0], panel.range[1]
                ))
                .help("two positive numbers, the smaller first"));
            }
            panel.measured.iter().try_for_each(|m| m.check(panel))?;
        }
        Ok(())
    }

    /// Compiles one of its laws. Where only normal restitution is asked for (`normal_only`), friction may be left out.
    ///
    /// # Errors
    /// An unknown or bad law, with its place.
    pub fn law(&self, name: &At<String>, normal_only: bool, library: &Library) -> Result<WallLaw, LabError> {
        let mut law = parse_named_law(&self.text, name).map_err(|e| self.wrong(e.at(name.span.clone())))?;
        if normal_only && law.friction.is_none() && law.tangential.is_none() && law.tangential_restitution.is_none() {
            law.friction = Some(Number(0.0).into());
        }
        law.compile(library).map_err(|e| self.wrong(e.at(name.span.clone())))
    }

    /// An error in this experiment's text.
    pub(crate) fn wrong(&self, error: SpecError) -> LabError {
        LabError::Experiment { name: format!("{}.toml", self.name), text: self.text.clone(), error }
    }
}
