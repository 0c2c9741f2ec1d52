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

mod values;

pub use values::{Measured, Point, Stated};

use crate::error::LabError;
use carom::material::Library;
use carom::spec::{At, parse_named_law};
use carom::units::{Length, Number, Speed};
use carom::{LawError, WallLaw};
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
#[derive(Clone, Debug, Serialize)]
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
    /// The file of points beside it and what that says of itself, if there is one.
    pub points_from: Option<String>,
    /// What a reader should know.
    pub notes: Vec<String>,
    /// The plots.
    #[serde(skip)]
    pub panels: Vec<Panel>,
    /// Single numbers that a source prints, to be recomputed.
    #[serde(skip)]
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
    /// Why it is told and not counted: another reading or another point of a claim that is, or nothing that follows from inputs.
    pub aside: Option<String>,
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
        let file: File = toml::from_str(text).map_err(|e| wrong(LawError::from(e)))?;
        let experiment = Self {
            name: name.to_owned(),
            text: text.to_owned(),
            title: file.title,
            source: file.source,
            values_from: file.values_from,
            points_from: None,
            notes: file.notes,
            panels: file.panels,
            claims: file.claims,
        };
        experiment.check().map_err(wrong)?;
        Ok(experiment)
    }

    /// Where the values come from: the file of points if there is one, else what the experiment's own file says.
    pub fn values_from(&self) -> &str {
        self.points_from.as_deref().unwrap_or(&self.values_from)
    }

    /// Checks what serde cannot.
    pub(crate) fn check(&self) -> Result<(), LawError> {
        for (n, panel) in self.panels.iter().enumerate() {
            let [from, to] = panel.range;
            let end = if panel.over == Over::Angle { 90.0 } else { f64::MAX };
            if !(from > 0.0 && from < to && to <= end) {
                let help = "two positive numbers, the smaller first; angles up to 90 degrees";
                return Err(LawError::new(format!("panel {}: range [{from}, {to}]", panel.name)).help(help));
            }
            if self.panels[..n].iter().any(|p| p.name == panel.name) {
                return Err(LawError::new(format!("two panels named {}", panel.name)).help("give each its own name"));
            }
            if panel.over == Over::Angle && panel.speed.is_none() {
                let message = format!("panel {} runs over angle and has no speed", panel.name);
                return Err(LawError::new(message).help("give one, such as speed = \"5 m/s\""));
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
        if normal_only && law.friction.is_none() && law.reads(carom::spec::Key::Friction) {
            law.friction = Some(Number(0.0).into());
        }
        let compiled = law.compile(library).and_then(|wall| {
            if !normal_only {
                wall.require_friction()?;
            }
            Ok(wall)
        });
        compiled.map_err(|e| self.wrong(e.at(name.span.clone())))
    }

    /// An error in this experiment's text.
    pub(crate) fn wrong(&self, error: LawError) -> LabError {
        LabError::Experiment { name: format!("{}.toml", self.name), text: self.text.clone(), error }
    }
}
