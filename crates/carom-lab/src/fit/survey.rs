//! The same fit for several surfaces: damping against the surface's Young's modulus, as Fig. 7 of Kim & Dunn (2007,
//! <https://doi.org/10.1016/j.jaerosci.2007.03.006>) shows it. The paper fits the smallest sphere of a pair of materials and keeps the
//! result for the larger ones; here all diameters of a pair are fitted together.

use super::{Data, Fit, Free, Key, Measurement, Options, fit};
use crate::error::LabError;
use crate::experiment::{Experiment, Over, Panel, Quantity};
use crate::points;
use carom::LawError;
use carom::material::Library;
use carom::spec::{LawSpec, parse_named_law};
use carom::units::Number;
use carom_report::plot::{Marker, Reference};
use carom_report::{Axis, Column, Plot, Series, Table};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What a survey fits where nothing else is said.
pub const FREE: [Key; 3] = [Key::AdhesionDamping, Key::HertzDamping, Key::RoughnessFactor];

/// A pair of materials with its data.
#[derive(Clone, Debug)]
pub struct Subject {
    /// What it is called in results.
    pub name: String,
    /// Its law; what is fitted need not be in it.
    pub law: LawSpec,
    /// Measured with it.
    pub data: Data,
}

/// A pair of materials with its fit.
#[derive(Clone, Debug, Serialize)]
pub struct Surveyed {
    /// As its [`Subject`].
    pub name: String,
    /// The surface's material.
    pub surface: Option<String>,
    /// Its Young's modulus, Pa.
    pub young_modulus: Option<f64>,
    /// How many impacts were measured.
    pub points: usize,
    /// What was found.
    #[serde(flatten)]
    pub fit: Fit,
}

/// Reads a law file, in which each `[law.NAME]` has its data in `NAME.csv` beside it, or an experiment with its own CSV file; `diameter`
/// (m) is that of points without one. Laws and panels without data are passed over.
///
/// # Errors
/// What cannot be read or is wrong, with file and place; a file without any data.
pub fn read(path: &Path, diameter: Option<f64>) -> Result<Vec<Subject>, LabError> {
    #[derive(serde::Deserialize)]
    struct File {
        #[serde(default)]
        law: BTreeMap<String, toml::Value>,
        panel: Option<toml::Value>,
    }
    let name = path.display().to_string();
    let text = read_file(path)?;
    let wrong = |error: LawError| LabError::Data { name: name.clone(), text: text.clone(), error: Box::new(error) };
    let file: File = toml::from_str(&text).map_err(|e| wrong(e.into()))?;
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let mut subjects = Vec::new();
    if file.panel.is_some() {
        let mut experiment = Experiment::from_toml(&stem, &text)?;
        let beside = path.with_extension("csv");
        if beside.exists() {
            points::add(&mut experiment, &beside.display().to_string(), &points_file(&beside)?)?;
        }
        for panel in &experiment.panels {
            subjects.extend(of_panel(&experiment, panel, diameter)?);
        }
    } else {
        for law in file.law.keys() {
            let beside = path.with_file_name(format!("{law}.csv"));
            if !beside.exists() {
                continue;
            }
            let spec = parse_named_law(&text, law).map_err(wrong)?;
            let data = Data::from_csv(&beside.display().to_string(), &points_file(&beside)?, diameter)?;
            subjects.push(Subject { name: law.clone(), law: spec, data });
        }
    }
    if subjects.is_empty() {
        let names = file.law.keys().map(|n| format!("{n}.csv")).collect::<Vec<_>>().join(", ");
        let wanted = if file.panel.is_some() { format!("{stem}.csv") } else { names };
        let help = if wanted.is_empty() {
            "give it [law.NAME] tables".into()
        } else {
            format!("beside it, {wanted} would be read")
        };
        return Err(LabError::Fit(LawError::new(format!("{name}: no data for any of its laws")).help(help)));
    }
    Ok(subjects)
}

fn read_file(path: &Path) -> Result<String, LabError> {
    String::from_utf8(bytes(path)?).map_err(|_| {
        let source = std::io::Error::new(std::io::ErrorKind::InvalidData, "not a text in UTF-8");
        LabError::File { path: PathBuf::from(path), source }
    })
}

fn bytes(path: &Path) -> Result<Vec<u8>, LabError> {
    let read = carom_table::file::read_regular(path, points::LARGEST);
    read.map_err(|source| LabError::File { path: PathBuf::from(path), source })
}

fn points_file(path: &Path) -> Result<String, LabError> {
    points::text(&bytes(path)?).map_err(|e| LabError::Points(format!("{}: {e}", path.display())))
}

/// A panel's measured restitution, with the law of its first curve.
fn of_panel(experiment: &Experiment, panel: &Panel, diameter: Option<f64>) -> Result<Option<Subject>, LabError> {
    let curve = panel.curves.first().filter(|_| !panel.measured.is_empty());
    let Some(curve) = curve.filter(|_| panel.quantity == Quantity::Restitution && panel.over == Over::Speed) else {
        return Ok(None);
    };
    let law = parse_named_law(&experiment.text, &curve.law).map_err(|e| experiment.wrong(e))?;
    let name = format!("{} {}", experiment.name, panel.name);
    // the curves' own diameter where they agree on one
    let one = panel.curves.iter().all(|c| c.diameter == curve.diameter).then_some(curve.diameter.0).or(diameter);
    let mut points = Vec::new();
    for p in panel.points() {
        let diameter = p.diameter.or(one).ok_or_else(|| {
            let error = LawError::new(format!("{name}: a point without a diameter, and curves of several"));
            LabError::Fit(error.help("add a column diameter, in m"))
        })?;
        points.push(Measurement {
            line: 0,
            speed: p.speed,
            angle_deg: p.angle_deg,
            diameter,
            restitution: Some(p.value),
            tangential_restitution: None,
            sigma: p.sigma,
        });
    }
    let source = experiment.values_from().to_owned();
    Ok(Some(Subject { data: Data { name: name.clone(), said: source, left_out: Vec::new(), points }, name, law }))
}

/// Fits every subject. Friction is taken as 0 where a law has none.
///
/// # Errors
/// As [`fit()`], with the subject's name before.
pub fn survey(
    subjects: &[Subject],
    free: &[Free],
    library: &Library,
    options: &Options,
) -> Result<Vec<Surveyed>, LabError> {
    let mut found = Vec::with_capacity(subjects.len());
    for subject in subjects {
        let named = |error: LawError| LabError::Fit(error.within(&subject.name));
        let mut law = subject.law.clone();
        if law.friction.is_none() && law.reads(Key::Friction) {
            law.friction = Some(Number(0.0).into());
        }
        let fit = fit(&law, free, &subject.data, library, options).map_err(|e| match e {
            LabError::Fit(error) => named(error),
            other => other,
        })?;
        let surface = law.surface.as_ref().map(|s| s.value.resolve(library)).transpose().map_err(named)?;
        found.push(Surveyed {
            name: subject.name.clone(),
            young_modulus: surface.as_ref().and_then(|s| s.young_modulus),
            surface: surface.map(|s| s.name),
            points: subject.data.points.len(),
            fit,
        });
    }
    found.sort_by(|a, b| a.young_modulus.unwrap_or(f64::NAN).total_cmp(&b.young_modulus.unwrap_or(f64::NAN)));
    Ok(found)
}

/// A row for each subject: its surface, and each parameter with its standard error and 95 % interval.
///
/// # Errors
/// None: the columns have one length.
pub fn table(found: &[Surveyed]) -> Result<Table, LabError> {
    let mut columns = vec![
        Column::text("name", found.iter().map(|s| s.name.as_str())),
        Column::optional_text("surface", found.iter().map(|s| s.surface.as_deref())),
        Column::float("young_modulus", "Pa", found.iter().map(|s| s.young_modulus)),
        Column::count("points", found.iter().map(|s| s.points as u64)),
    ];
    let count = found.first().map_or(0, |s| s.fit.parameters.len());
    for n in 0..count {
        let of = |s: &Surveyed| s.fit.parameters[n].clone();
        let (name, unit) = (found[0].fit.parameters[n].parameter.name(), found[0].fit.parameters[n].unit);
        let column = |what: &str, get: &dyn Fn(&Surveyed) -> Option<f64>| {
            Column::float(format!("{name}{what}"), unit, found.iter().map(get))
        };
        columns.push(column("", &|s| Some(of(s).value)));
        columns.push(column("_error", &|s| of(s).standard_error));
        columns.push(column("_low", &|s| of(s).interval.map(|i| i.0)));
        columns.push(column("_high", &|s| of(s).interval.map(|i| i.1)));
        if found.iter().any(|s| s.fit.bootstrap.is_some()) {
            columns.push(column("_bootstrap_low", &|s| of(s).bootstrap.map(|i| i.0)));
            columns.push(column("_bootstrap_high", &|s| of(s).bootstrap.map(|i| i.1)));
        }
    }
    columns.push(Column::float("reduced_chi_square", "", found.iter().map(|s| s.fit.goodness.reduced_chi_square)));
    columns.push(Column::float("scatter", "", found.iter().map(|s| s.fit.goodness.scatter)));
    Ok(Table::new(columns)?)
}

/// C_A and C_H, with their 95 % intervals, against the surface's Young's modulus.
pub fn plot(found: &[Surveyed]) -> Plot {
    let along = Axis::scaled("Young's modulus of the surface", "GPa", 1e-9).log();
    let mut plot = Plot::new("Damping coefficients", along, Axis::new("damping coefficient", "s/m").log());
    let kinds = [
        (Key::AdhesionDamping, "C_A, adhesion damping", Marker::Circle),
        (Key::HertzDamping, "C_H, Hertzian damping", Marker::Square),
    ];
    for (parameter, label, marker) in kinds {
        let estimates: Vec<_> = found
            .iter()
            .filter_map(|s| Some((s.young_modulus?, s.fit.parameters.iter().find(|p| p.parameter == parameter)?)))
            .filter(|(_, p)| p.value > 0.0)
            .collect();
        // an interval that reaches zero ends at a tenth of the value on a scale of ratios
        let interval = |p: &super::Estimate| p.interval.map_or((p.value, p.value), |(l, h)| (l.max(0.1 * p.value), h));
        if !estimates.is_empty() {
            let (x, y) = (estimates.iter().map(|e| e.0), estimates.iter().map(|e| e.1.value));
            let (low, high) = estimates.iter().map(|e| interval(e.1)).unzip::<_, _, Vec<_>, Vec<_>>();
            plot = plot.with(Series::points(label, x, y).interval(low, high).marker(marker));
        }
    }
    for surveyed in found {
        let (Some(surface), Some(modulus)) = (&surveyed.surface, surveyed.young_modulus) else { continue };
        if !plot.references.iter().any(|r| r.value == modulus) {
            plot = plot.reference(Reference::vertical(modulus, surface.as_str()));
        }
    }
    plot
}
