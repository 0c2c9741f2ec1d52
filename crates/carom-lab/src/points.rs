//! A CSV file of measured points beside an experiment's file: `wall-1990.csv` beside `wall-1990.toml`.
//!
//! Columns by name, in any order: `speed` (m/s), `restitution` (or `tangential_restitution`, `impulse_ratio`), and where wanted
//! `diameter` (m), `angle` (degrees from the surface, 90 when absent), `sigma` (standard uncertainty) and `panel` (the name of a
//! panel, needed where several show the same quantity). Lines that begin with `#` say where the points come from.

use crate::error::LabError;
use crate::experiment::{Experiment, Measured, Over, Panel, Quantity};
use carom::LawError;
use carom::spec::At;

/// Largest file read, bytes: far beyond any measurement.
pub const LARGEST: u64 = 64 << 20;

mod reader;

pub use reader::{Row, Rows, read, text};

impl Row {
    /// The measured value of a quantity.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        let field = match quantity {
            Quantity::Restitution => &self.restitution,
            Quantity::TangentialRestitution => &self.tangential_restitution,
            Quantity::ImpulseRatio => &self.impulse_ratio,
        };
        field.as_ref().map(|f| f.value)
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
    let wrong = |e: LawError| LabError::Points(e.located(name, text));
    let Rows { said, rows, .. } = read(text).map_err(wrong)?;
    let source = if said.is_empty() { name.to_owned() } else { format!("{name}: {said}") };
    let mut found: Vec<Vec<Row>> = experiment.panels.iter().map(|_| Vec::new()).collect();
    for row in rows {
        let index = panel(&experiment.panels, &row).map_err(|what| wrong(row.wrong(what, "")))?;
        let panel = &experiment.panels[index];
        if row.speed.is_none() && panel.speed.is_none() {
            return Err(wrong(row.wrong("a point without a speed", "give one, in m/s")));
        }
        if panel.over == Over::Angle && row.angle.is_none() {
            return Err(wrong(row.wrong(format!("panel {} runs over angle", panel.name), "give one, in degrees")));
        }
        found[index].push(row);
    }
    if found.iter().all(Vec::is_empty) {
        return Err(LabError::Points(format!("{name}: no points")));
    }
    for (panel, rows) in experiment.panels.iter_mut().zip(found) {
        for row in rows {
            let value = row.value(panel.quantity).unwrap_or(f64::NAN);
            let one = |x: &Option<At<f64>>| x.iter().map(|x| x.value).collect::<Vec<_>>();
            panel.measured.push(Measured {
                source: source.clone(),
                speed: one(&row.speed),
                angle_deg: one(&row.angle),
                diameter: one(&row.diameter),
                value: vec![value],
                sigma: one(&row.sigma),
                ..Measured::default()
            });
        }
    }
    experiment.points_from = Some(source);
    Ok(())
}

/// The panel a row belongs to.
fn panel(panels: &[Panel], row: &Row) -> Result<usize, String> {
    let names = |panels: &[&Panel]| panels.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
    if let Some(name) = row.panel.as_ref().map(|p| p.value.as_str()) {
        let index = panels.iter().position(|p| p.name == name);
        let index = index.ok_or_else(|| {
            format!("no panel '{name}'; the experiment has {}", names(&panels.iter().collect::<Vec<_>>()))
        })?;
        let wanted = QUANTITIES.iter().find(|(q, _)| *q == panels[index].quantity).map_or("", |(_, n)| n);
        let value = row.value(panels[index].quantity);
        return value.map(|_| index).ok_or_else(|| format!("panel {name} shows {wanted}: give a number for it"));
    }
    let fits: Vec<usize> = (0..panels.len()).filter(|n| row.value(panels[*n].quantity).is_some()).collect();
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
