//! Every curve of an experiment against every value of its panel, and every claim against what its inputs give.

use crate::error::LabError;
use crate::experiment::{Claim, Curve, Experiment, Figure, Over, Panel, Point, Quantity, Tier};
use carom::material::Library;
use carom::{Impact, WallLaw};
use serde::Serialize;

/// Two diameters closer than this are the same.
const SAME_DIAMETER: f64 = 0.02;

/// A curve with its laws compiled.
pub struct Model<'a> {
    /// As written.
    pub curve: &'a Curve,
    /// Its law, and the second one of an area.
    pub walls: Vec<WallLaw>,
}

impl<'a> Model<'a> {
    /// Compiles a curve of an experiment.
    ///
    /// # Errors
    /// A bad law, with its place.
    pub fn new(experiment: &Experiment, panel: &Panel, curve: &'a Curve, library: &Library) -> Result<Self, LabError> {
        let names = [Some(&curve.law), curve.to.as_ref()];
        let walls = names
            .into_iter()
            .flatten()
            .map(|n| experiment.law(n, panel.quantity == Quantity::Restitution, library))
            .collect::<Result<_, _>>()?;
        Ok(Self { curve, walls })
    }

    /// Lower and upper value at a speed (m/s) and angle (degrees from the surface).
    ///
    /// # Errors
    /// An impact that the law refuses.
    pub fn at(&self, quantity: Quantity, speed: f64, angle_deg: f64, diameter: f64) -> Result<(f64, f64), LabError> {
        let mut ends = (f64::INFINITY, f64::NEG_INFINITY);
        for wall in &self.walls {
            let value = meet(wall, quantity, speed, angle_deg, diameter)
                .map_err(|e| LabError::Model(format!("{}: {e}", self.curve.label)))?;
            if value.is_nan() {
                return Ok((f64::NAN, f64::NAN));
            }
            ends = (ends.0.min(value), ends.1.max(value));
        }
        Ok(ends)
    }
}

/// What a law gives for an impact at `speed` (m/s), `angle_deg` from the surface, of a sphere of diameter `d` (m) without spin.
pub(crate) fn meet(
    wall: &WallLaw,
    quantity: Quantity,
    speed: f64,
    angle_deg: f64,
    d: f64,
) -> Result<f64, carom::ImpactError> {
    let (s, c) = if angle_deg == 90.0 { (1.0, 0.0) } else { angle_deg.to_radians().sin_cos() };
    let out = wall.impact(&Impact::new(d, [speed * c, -speed * s, 0.0], [0.0, 1.0, 0.0]))?;
    Ok(match quantity {
        Quantity::Restitution => out.restitution,
        Quantity::TangentialRestitution => out.tangential_restitution,
        Quantity::ImpulseRatio => out.impulse_ratio,
    })
}

/// The number between `low` and `high` that is nearest to `value`; NaN where the model has none.
fn nearest(value: f64, low: f64, high: f64) -> f64 {
    if low.is_nan() { f64::NAN } else { value.max(low).min(high) }
}

/// One value and what a model gives there.
#[derive(Clone, Debug, Serialize)]
pub struct Pointwise {
    /// Normal speed (m/s) or angle from the surface (degrees).
    pub at: f64,
    /// Measured or stated.
    pub value: f64,
    /// Its standard uncertainty.
    pub sigma: Option<f64>,
    /// The model's, or the nearer end of an area.
    pub model: f64,
    /// Model minus value; 0 within an area.
    pub deviation: f64,
    /// For a stated bound, whether the model keeps it (with its uncertainty).
    pub holds: Option<bool>,
    /// Where the value comes from.
    pub source: String,
}

/// A model against the values of its panel.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// The experiment's file.
    pub experiment: String,
    /// Figure of Kim & Dunn (2007).
    pub figure: Option<String>,
    /// The panel.
    pub panel: String,
    /// The curve.
    pub curve: String,
    /// Its law, `[law.NAME]` of the file.
    pub law: String,
    /// m.
    pub diameter: f64,
    /// What the values are.
    pub tier: Tier,
    /// What the values run over.
    pub over: Over,
    /// Each value.
    pub points: Vec<Pointwise>,
    /// Greatest |deviation|.
    pub greatest: f64,
    /// Root of the mean squared deviation.
    pub rms: f64,
}

impl Comparison {
    fn new(experiment: &Experiment, panel: &Panel, curve: &Curve, tier: Tier, points: Vec<Pointwise>) -> Self {
        // a model without a value somewhere has no greatest deviation
        let greatest =
            points.iter().map(|p| p.deviation.abs()).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a });
        let rms = (points.iter().map(|p| p.deviation * p.deviation).sum::<f64>() / points.len() as f64).sqrt();
        Self {
            experiment: experiment.name.clone(),
            figure: panel.figure.as_ref().map(|f| f.value.clone()),
            panel: panel.name.clone(),
            curve: curve.label.clone(),
            law: curve.law.value.clone(),
            diameter: curve.diameter.0,
            tier,
            over: panel.over,
            points,
            greatest,
            rms,
        }
    }
}

/// Holds the curves of a panel against its values.
///
/// # Errors
/// A bad law; a point that no curve is for.
pub fn panel(experiment: &Experiment, panel: &Panel, models: &[Model<'_>]) -> Result<Vec<Comparison>, LabError> {
    let points: Vec<(Point, &str)> = panel
        .measured
        .iter()
        .flat_map(|m| std::iter::repeat_n(m.source.as_str(), m.value.len()))
        .zip(panel.points())
        .map(|(source, point)| (point, source))
        .collect();
    let fits = |curve: &Curve, point: &Point| {
        point.diameter.is_none_or(|d| (d / curve.diameter.0 - 1.0).abs() <= SAME_DIAMETER)
    };
    for (point, source) in &points {
        if !models.iter().any(|m| fits(m.curve, point)) {
            let d = point.diameter.unwrap_or(f64::NAN);
            return Err(LabError::Points(format!(
                "{source}: panel {} of {} has no curve for a diameter of {d:e} m",
                panel.name, experiment.name
            )));
        }
    }
    let mut comparisons = Vec::new();
    for model in models {
        let mut measured = Vec::new();
        for (point, source) in points.iter().filter(|(p, _)| fits(model.curve, p)) {
            let d = point.diameter.unwrap_or(model.curve.diameter.0);
            let (low, high) = model.at(panel.quantity, point.speed, point.angle_deg, d)?;
            let nearest = nearest(point.value, low, high);
            measured.push(Pointwise {
                at: panel.place(point),
                value: point.value,
                sigma: point.sigma,
                model: nearest,
                deviation: nearest - point.value,
                holds: None,
                source: (*source).to_owned(),
            });
        }
        if !measured.is_empty() {
            comparisons.push(Comparison::new(experiment, panel, model.curve, Tier::Measured, measured));
        }
        let stated = stated(panel, model)?;
        if !stated.is_empty() {
            comparisons.push(Comparison::new(experiment, panel, model.curve, Tier::Stated, stated));
        }
    }
    Ok(comparisons)
}

fn stated(panel: &Panel, model: &Model<'_>) -> Result<Vec<Pointwise>, LabError> {
    let mut points = Vec::new();
    for stated in &panel.stated {
        let (speed, angle) = match panel.over {
            Over::Speed => (stated.at, 90.0),
            Over::Angle => (panel.speed.map_or(f64::NAN, |s| s.0), stated.at),
        };
        let (low, high) = model.at(panel.quantity, speed, angle, model.curve.diameter.0)?;
        for (bound, is_above) in [(stated.above, true), (stated.below, false)] {
            let Some(value) = bound else { continue };
            let holds = if is_above { high >= value - stated.sigma } else { low <= value + stated.sigma };
            let nearest = nearest(value, low, high);
            points.push(Pointwise {
                at: stated.at,
                value,
                sigma: (stated.sigma > 0.0).then_some(stated.sigma),
                model: nearest,
                deviation: nearest - value,
                holds: Some(holds),
                source: stated.source.clone(),
            });
        }
    }
    Ok(points)
}

/// A claim and what its inputs give.
#[derive(Clone, Debug, Serialize)]
pub struct Recomputed {
    /// The experiment's file.
    pub experiment: String,
    /// Figure of Kim & Dunn (2007).
    pub figure: Option<String>,
    /// What is claimed.
    pub says: String,
    /// Where.
    pub source: String,
    /// The law, `[law.NAME]` of the file.
    pub law: String,
    /// m.
    pub diameter: f64,
    /// What is claimed as a number: `0.37 ± 0.005`, `> 0.83`.
    pub printed: String,
    /// What the law gives; null if it has no such number.
    pub computed: f64,
    /// Whether they agree.
    pub holds: bool,
    /// An input was chosen so that it holds.
    pub by_choice: bool,
    /// Why it is told and not counted.
    pub aside: Option<String>,
}

impl Recomputed {
    /// Whether it is a claim of the paper, from its own inputs.
    pub fn counts(&self) -> bool {
        !self.by_choice && self.aside.is_none()
    }
}

/// Recomputes a claim.
///
/// # Errors
/// A bad law or impact.
pub fn claim(experiment: &Experiment, claim: &Claim, library: &Library) -> Result<Recomputed, LabError> {
    let wall = experiment.law(&claim.law, claim.quantity != Figure::CriticalAngle, library)?;
    let d = claim.diameter.0;
    let refused = |e: carom::ImpactError| LabError::Model(format!("{}: {e}", claim.says));
    let speed = claim.speed.map_or(f64::NAN, |s| s.0);
    let computed = match claim.quantity {
        Figure::YieldVelocity => wall.yield_velocity(d, None).map_err(refused)?.unwrap_or(f64::NAN),
        Figure::CaptureVelocity => wall.window(d, None).map_err(refused)?.map_or(f64::NAN, |w| w.capture_velocity),
        Figure::Restitution => meet(&wall, Quantity::Restitution, speed, 90.0, d).map_err(refused)?,
        Figure::GreatestRestitution => greatest(&wall, d).map_err(refused)?.1,
        Figure::SpeedOfGreatestRestitution => greatest(&wall, d).map_err(refused)?.0,
        Figure::CriticalAngle => {
            wall.critical_angle(d, None, speed).map_err(refused)?.map_or(f64::NAN, f64::to_degrees)
        }
    };
    let mut printed = Vec::new();
    let mut holds = computed.is_finite();
    if let Some(value) = claim.printed {
        printed.push(if claim.within > 0.0 { format!("{value} ± {}", claim.within) } else { value.to_string() });
        holds &= (computed - value).abs() <= claim.within;
    }
    if let Some(value) = claim.above {
        printed.push(format!("> {value}"));
        holds &= computed > value;
    }
    if let Some(value) = claim.below {
        printed.push(format!("< {value}"));
        holds &= computed < value;
    }
    Ok(Recomputed {
        experiment: experiment.name.clone(),
        figure: claim.figure.as_ref().map(|f| f.value.clone()),
        says: claim.says.clone(),
        source: claim.source.clone(),
        law: claim.law.value.clone(),
        diameter: d,
        printed: printed.join(", "),
        computed,
        holds,
        by_choice: claim.by_choice,
        aside: claim.aside.clone(),
    })
}

/// Speed (m/s) and value of the greatest restitution between 1 mm/s and 1 km/s, on a grid of 0.1 %.
fn greatest(wall: &WallLaw, d: f64) -> Result<(f64, f64), carom::ImpactError> {
    let mut best = (f64::NAN, f64::NEG_INFINITY);
    for n in 0..=13_816 {
        let speed = 1e-3 * (f64::from(n) * 1e-3).exp();
        let e = meet(wall, Quantity::Restitution, speed, 90.0, d)?;
        if e > best.1 {
            best = (speed, e);
        }
    }
    Ok(best)
}
