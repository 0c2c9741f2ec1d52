//! A CSV file of measured points beside an experiment's file: `wall-1990.csv` beside `wall-1990.toml`.
//!
//! Columns by name, in any order: `speed` (m/s), `restitution` (or `tangential_restitution`, `impulse_ratio`), and where wanted
//! `diameter` (m), `angle` (degrees from the surface, 90 when absent), `sigma` (standard uncertainty) and `panel` (the name of a
//! panel, needed where several show the same quantity). Lines that begin with `#` say where the points come from.

use crate::error::LabError;
use crate::experiment::{Experiment, Measured, Over, Panel, Quantity};

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    speed: Option<f64>,
    restitution: Option<f64>,
    tangential_restitution: Option<f64>,
    impulse_ratio: Option<f64>,
    diameter: Option<f64>,
    angle: Option<f64>,
    sigma: Option<f64>,
    panel: Option<String>,
}

impl Row {
    fn value(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::Restitution => self.restitution,
            Quantity::TangentialRestitution => self.tangential_restitution,
            Quantity::ImpulseRatio => self.impulse_ratio,
        }
    }
}

const QUANTITIES: [(Quantity, &str); 3] = [
    (Quantity::Restitution, "restitution"),
    (Quantity::TangentialRestitution, "tangential_restitution"),
    (Quantity::ImpulseRatio, "impulse_ratio"),
];

/// Adds the points of a CSV text, named `name`, to an experiment.
///
/// # Errors
/// What is wrong, with file and line.
///
/// ```
/// let mut experiment = carom_lab::builtin()?.into_iter().find(|e| e.name == "dahneke-1975").expect("it comes along");
/// assert_eq!(experiment.panels[0].tier().name(), "prediction only");
/// let csv = "# made up for this example\nspeed,restitution,sigma\n20,0.9,0.02\n";
/// carom_lab::points::add(&mut experiment, "dahneke-1975.csv", csv)?;
/// assert_eq!(experiment.panels[0].tier().name(), "measured data");
/// # Ok::<(), carom_lab::LabError>(())
/// ```
pub fn add(experiment: &mut Experiment, name: &str, text: &str) -> Result<(), LabError> {
    let wrong = |line: u64, what: String| LabError::Points(format!("{name}:{line}: {what}"));
    let said: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix('#')).map(str::trim).collect();
    let source = if said.is_empty() { name.to_owned() } else { format!("{name}: {}", said.join(" ")) };
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let headers = reader.headers().map_err(|e| LabError::Points(format!("{name}: {e}")))?.clone();
    let mut found: Vec<Vec<(u64, Row)>> = experiment.panels.iter().map(|_| Vec::new()).collect();
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|e| LabError::Points(format!("{name}: {e}")))? {
        let line = record.position().map_or(0, csv::Position::line);
        let row: Row = record.deserialize(Some(&headers)).map_err(|e| wrong(line, cause(&e)))?;
        let index = panel(&experiment.panels, &row).map_err(|what| wrong(line, what))?;
        let panel = &experiment.panels[index];
        let speed = row.speed.or(panel.speed.map(|s| s.0));
        if !speed.is_some_and(|v| v > 0.0 && v.is_finite()) {
            return Err(wrong(line, "a point needs a positive speed in m/s".into()));
        }
        let angle = row.angle.unwrap_or(90.0);
        if !(angle > 0.0 && angle <= 90.0) {
            return Err(wrong(line, format!("angle {angle}: above 0 and up to 90 degrees from the surface")));
        }
        if panel.over == Over::Angle && row.angle.is_none() {
            return Err(wrong(line, format!("panel {} runs over angle: give one", panel.name)));
        }
        if let Some(d) = row.diameter.filter(|d| !(*d > 1e-10 && *d < 1.0)) {
            return Err(wrong(line, format!("diameter {d}: metres are wanted, such as 70e-6")));
        }
        found[index].push((line, row));
    }
    if found.iter().all(Vec::is_empty) {
        return Err(LabError::Points(format!("{name}: no points")));
    }
    for (panel, rows) in experiment.panels.iter_mut().zip(found) {
        for (_, row) in rows {
            let value = row.value(panel.quantity).unwrap_or(f64::NAN);
            let one = |x: Option<f64>| x.into_iter().collect::<Vec<_>>();
            panel.measured.push(Measured {
                source: source.clone(),
                speed: one(row.speed),
                angle_deg: one(row.angle),
                diameter: one(row.diameter),
                value: vec![value],
                sigma: one(row.sigma),
                ..Measured::default()
            });
        }
    }
    experiment.points_from = Some(source);
    Ok(())
}

fn cause(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => err.to_string(),
        _ => error.to_string(),
    }
}

/// The panel a row belongs to.
fn panel(panels: &[Panel], row: &Row) -> Result<usize, String> {
    let names = |panels: &[&Panel]| panels.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
    if let Some(name) = row.panel.as_deref().filter(|n| !n.is_empty()) {
        let index = panels.iter().position(|p| p.name == name);
        let index = index.ok_or_else(|| {
            format!("no panel '{name}'; the experiment has {}", names(&panels.iter().collect::<Vec<_>>()))
        })?;
        let wanted = QUANTITIES.iter().find(|(q, _)| *q == panels[index].quantity).map_or("", |(_, n)| n);
        let value = row.value(panels[index].quantity).filter(|v| v.is_finite());
        return value.map(|_| index).ok_or_else(|| format!("panel {name} shows {wanted}: give a number for it"));
    }
    let fits: Vec<usize> =
        (0..panels.len()).filter(|n| row.value(panels[*n].quantity).is_some_and(f64::is_finite)).collect();
    match fits[..] {
        [one] => Ok(one),
        [] => {
            Err("a point needs a number in a column such as restitution that one of the experiment's panels shows"
                .into())
        }
        _ => {
            let several: Vec<&Panel> = fits.iter().map(|n| &panels[*n]).collect();
            Err(format!("the point fits several panels; name one in a column panel: {}", names(&several)))
        }
    }
}
