//! All experiments, all comparisons, one report.

use crate::compare::{Comparison, Model, Recomputed, claim, panel};
use crate::error::LabError;
use crate::experiment::{Experiment, Tier};
use crate::identities::{Identity, identities};
use crate::resolved::{Forms, forms};
use crate::table_2::{self, Row};
use crate::tunnel::{self, Way};
use crate::{plots, report};
use carom::material::Library;
use carom_report::{Column, Plot, Table};
use serde::Serialize;
use std::path::Path;

/// A panel as it was computed.
#[derive(Clone, Debug, Serialize)]
pub struct PanelResult {
    /// The experiment's file.
    pub experiment: String,
    /// Figure of Kim & Dunn (2007).
    pub figure: Option<String>,
    /// Its name.
    pub panel: String,
    /// What the comparison is worth.
    pub tier: Tier,
    /// How many values it has.
    pub values: usize,
    /// Its curves.
    pub curves: Vec<CurveResult>,
    /// How it looks.
    #[serde(skip)]
    pub plot: Plot,
}

/// A curve's inputs.
#[derive(Clone, Debug, Serialize)]
pub struct CurveResult {
    /// Name in the plot.
    pub label: String,
    /// `[law.NAME]` of the experiment's file, two for an area.
    pub laws: Vec<String>,
    /// m.
    pub diameter: f64,
}

/// Everything that was found.
#[derive(Clone, Debug, Serialize)]
pub struct Validation {
    /// Version of carom.
    pub version: &'static str,
    /// Every panel of every experiment.
    pub panels: Vec<PanelResult>,
    /// Models against measured and stated values.
    pub comparisons: Vec<Comparison>,
    /// Printed numbers against what their own inputs give.
    pub claims: Vec<Recomputed>,
    /// Table 2 of Kim & Dunn (2007), recomputed.
    pub table_2: Vec<Row>,
    /// The wind tunnel's paths.
    pub tunnel: Vec<Way>,
    /// The algebraic form against the resolved one.
    pub resolved: Forms,
    /// What must hold by construction.
    pub identities: Vec<Identity>,
    /// The experiments, as read.
    pub experiments: Vec<Experiment>,
}

/// Computes everything: a second or so.
///
/// # Errors
/// What is wrong in an experiment's files, with its place.
///
/// ```
/// use carom::material::Library;
/// let found = carom_lab::validate(carom_lab::builtin()?, Library::builtin())?;
/// let micro_slip = found.comparisons.iter().find(|c| c.curve == "micro-slip").expect("it is there");
/// assert!(micro_slip.greatest < 0.035);
/// # Ok::<(), carom_lab::LabError>(())
/// ```
pub fn validate(experiments: Vec<Experiment>, library: &Library) -> Result<Validation, LabError> {
    let (mut panels, mut comparisons, mut claims) = (Vec::new(), Vec::new(), Vec::new());
    for experiment in &experiments {
        for one in &experiment.panels {
            let models: Vec<Model<'_>> =
                one.curves.iter().map(|c| Model::new(experiment, one, c, library)).collect::<Result<_, _>>()?;
            comparisons.extend(panel(experiment, one, &models)?);
            let curve = |m: &Model<'_>| CurveResult {
                label: m.curve.label.clone(),
                laws: [Some(&m.curve.law), m.curve.to.as_ref()]
                    .into_iter()
                    .flatten()
                    .map(|l| l.value.clone())
                    .collect(),
                diameter: m.curve.diameter.0,
            };
            let stated = one.stated.iter().flat_map(|s| [s.above, s.below]).flatten().count();
            panels.push(PanelResult {
                experiment: experiment.name.clone(),
                figure: one.figure.as_ref().map(|f| f.value.clone()),
                panel: one.name.clone(),
                tier: one.tier(),
                values: one.points().count() + stated,
                curves: models.iter().map(curve).collect(),
                plot: plots::panel(one, &models)?,
            });
        }
        for one in &experiment.claims {
            claims.push(claim(experiment, one, library)?);
        }
    }
    // the paper's figures first, in its order
    panels.sort_by_key(|p| p.figure.as_ref().map_or(u32::MAX, |f| f.parse().unwrap_or(u32::MAX - 1)));
    let resolved = forms(library)?;
    Ok(Validation {
        version: env!("CARGO_PKG_VERSION"),
        panels,
        comparisons,
        claims,
        table_2: table_2::rows(library)?,
        tunnel: tunnel::paths(library)?,
        identities: identities(&resolved, library)?,
        resolved,
        experiments,
    })
}

/// A row of the summary.
#[derive(Clone, Debug)]
struct Line {
    figure: String,
    experiment: String,
    panel: String,
    model: String,
    tier: Tier,
    values: Option<u64>,
    deviation: String,
}

impl Default for Line {
    fn default() -> Self {
        let none = String::new;
        let (figure, experiment, panel, model, deviation) = (none(), none(), none(), none(), none());
        Self { figure, experiment, panel, model, tier: Tier::Prediction, values: None, deviation }
    }
}

impl Validation {
    /// The comparisons of a panel.
    pub fn of<'a>(&'a self, panel: &'a PanelResult) -> impl Iterator<Item = &'a Comparison> {
        self.comparisons.iter().filter(|c| c.experiment == panel.experiment && c.panel == panel.panel)
    }

    /// One row for each model that meets values, for each panel without any, and for what is no panel.
    ///
    /// # Errors
    /// None: the columns have one length.
    pub fn summary(&self) -> Result<Table, LabError> {
        let mut lines: Vec<Line> = Vec::new();
        let (of_paper, beyond): (Vec<_>, Vec<_>) = self.panels.iter().partition(|p| p.figure.is_some());
        lines.extend(of_paper.into_iter().flat_map(|p| self.lines(p)));
        lines.extend(self.tunnel.iter().map(|w| Line {
            figure: w.figure.to_owned(),
            experiment: "wind tunnel".to_owned(),
            model: w.label.clone(),
            tier: if w.figure == "11" { Tier::Stated } else { Tier::Model },
            deviation: match w.impacts_stated {
                Some(stated) => format!("{} impacts, stated {stated}", w.impacts),
                None => format!("{} impacts, {}", w.impacts, w.fate),
            },
            ..Line::default()
        }));
        lines.extend(beyond.into_iter().flat_map(|p| self.lines(p)));
        for (model, off) in [("undamped", self.resolved.undamped), ("damped, 0.1 to 25 m/s", self.resolved.damped)] {
            lines.push(Line {
                experiment: "algebraic form".to_owned(),
                panel: "resolved form".to_owned(),
                model: model.to_owned(),
                tier: if model == "undamped" { Tier::Analytic } else { Tier::Model },
                deviation: if off < 1e-4 { format!("{off:.0e}") } else { format!("{off:.4}") },
                ..Line::default()
            });
        }
        let text = |name: &str, get: fn(&Line) -> &str| Column::text(name, lines.iter().map(get));
        Ok(Table::new([
            text("figure", |l| &l.figure),
            text("experiment", |l| &l.experiment),
            text("panel", |l| &l.panel),
            text("model", |l| &l.model),
            text("held against", |l| l.tier.name()),
            Column::text("values", lines.iter().map(|l| l.values.map(|v| v.to_string()).unwrap_or_default())),
            text("greatest deviation", |l| &l.deviation),
        ])?)
    }

    fn lines(&self, panel: &PanelResult) -> Vec<Line> {
        let line = Line {
            figure: panel.figure.clone().unwrap_or_default(),
            experiment: panel.experiment.clone(),
            panel: panel.panel.clone(),
            tier: panel.tier,
            ..Line::default()
        };
        let met: Vec<Line> = self
            .of(panel)
            .map(|c| Line {
                model: c.curve.clone(),
                tier: c.tier,
                values: Some(c.points.len() as u64),
                deviation: format!("{:.4}", c.greatest),
                ..line.clone()
            })
            .collect();
        if !met.is_empty() {
            return met;
        }
        let model = match &panel.curves[..] {
            [one] => one.label.clone(),
            several => format!("{} curves", several.len()),
        };
        vec![Line { model, ..line }]
    }

    /// Everything as JSON, SI units; NaN is null.
    ///
    /// # Errors
    /// None in practice.
    pub fn to_json(&self) -> Result<String, LabError> {
        let text = serde_json::to_string_pretty(self).map_err(|e| LabError::Model(format!("JSON: {e}")))?;
        Ok(text + "\n")
    }

    /// The report as HTML.
    ///
    /// # Errors
    /// A plot that cannot be drawn.
    pub fn html(&self) -> Result<String, LabError> {
        Ok(report::report(self)?.html())
    }

    /// Writes `report.html` and `report.json` into a folder, which is made if it is not there.
    ///
    /// # Errors
    /// What the file system says.
    pub fn write(&self, folder: &Path) -> Result<(), LabError> {
        let failed = |path: &Path| {
            let path = path.to_path_buf();
            move |source| LabError::File { path, source }
        };
        let report = report::report(self)?;
        let json = self.to_json()?;
        std::fs::create_dir_all(folder).map_err(failed(folder))?;
        report.write(folder.join("report.html"))?;
        let path = folder.join("report.json");
        std::fs::write(&path, json).map_err(failed(&path))
    }
}
