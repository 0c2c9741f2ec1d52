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
    #[serde(skip)]
    pub experiments: Vec<Experiment>,
}

/// Computes everything: a second or so.
///
/// # Errors
/// What is wrong in an experiment's files, with its place.
///
/// ```
/// use carom::material::Library;
/// let found = carom_lab::validate(carom_lab::builtin()?, &Library::builtin())?;
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

impl Validation {
    /// The comparisons of a panel.
    pub fn of<'a>(&'a self, panel: &'a PanelResult) -> impl Iterator<Item = &'a Comparison> {
        self.comparisons.iter().filter(|c| c.experiment == panel.experiment && c.panel == panel.panel)
    }

    /// One row for each model that meets values, and for each panel without any.
    ///
    /// # Errors
    /// None: the columns have one length.
    pub fn summary(&self) -> Result<Table, LabError> {
        type Line<'a> = (&'a PanelResult, &'a str, Tier, Option<u64>, Option<f64>);
        let mut lines: Vec<Line<'_>> = Vec::new();
        for panel in &self.panels {
            let before = lines.len();
            lines.extend(
                self.of(panel)
                    .map(|c| (panel, c.curve.as_str(), c.tier, Some(c.points.len() as u64), Some(c.greatest))),
            );
            if lines.len() == before {
                let one = panel.curves.first().map_or("", |c| c.label.as_str());
                lines.push((panel, if panel.curves.len() > 1 { "all" } else { one }, panel.tier, None, None));
            }
        }
        Ok(Table::new([
            Column::text("figure", lines.iter().map(|l| l.0.figure.clone().unwrap_or_default())),
            Column::text("experiment", lines.iter().map(|l| l.0.experiment.as_str())),
            Column::text("panel", lines.iter().map(|l| l.0.panel.as_str())),
            Column::text("model", lines.iter().map(|l| l.1)),
            Column::text("held against", lines.iter().map(|l| l.2.name())),
            Column::count("values", lines.iter().map(|l| l.3)),
            Column::text(
                "greatest deviation",
                lines.iter().map(|l| l.4.map(|d| format!("{d:.4}")).unwrap_or_default()),
            ),
        ])?)
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
