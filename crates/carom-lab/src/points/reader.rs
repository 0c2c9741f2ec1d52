//! Measured points, read once for experiments and fits, from tables as people and programs write them ([`carom_table::sheet`]).
//!
//! Columns are known by the names people give them, with a unit behind the name, which may be another than the SI unit
//! (`diameter (um)`). Other columns are left out and told. What a `carom sweep` writes is read too.

use carom::error::did_you_mean;
use carom::spec::At;
use carom::units::{Angle, Length, Number, Speed};
use carom::{LawError, units::UnitError};
use carom_table::{Heading, Sheet, SheetError, SheetProblem, clipped};
use std::ops::Range;

/// A line of points, as written: values in SI units, angles in degrees from the surface.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// m/s.
    pub speed: Option<At<f64>>,
    /// e.
    pub restitution: Option<At<f64>>,
    /// e_t of the centre.
    pub tangential_restitution: Option<At<f64>>,
    /// μ.
    pub impulse_ratio: Option<At<f64>>,
    /// m.
    pub diameter: Option<At<f64>>,
    /// Degrees from the surface.
    pub angle: Option<At<f64>>,
    /// Standard uncertainty of the measured values.
    pub sigma: Option<At<f64>>,
    /// Name of an experiment's panel.
    pub panel: Option<At<String>>,
    /// The line, bytes of the text.
    pub span: Range<usize>,
}

/// A file of points.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    /// What the comments say.
    pub said: String,
    /// Columns that nothing reads.
    pub left_out: Vec<String>,
    /// The points.
    pub rows: Vec<Row>,
}

const COLUMNS: [&str; 8] =
    ["speed", "restitution", "tangential_restitution", "impulse_ratio", "diameter", "angle", "sigma", "panel"];

/// Other names of a column.
const ALIASES: [(&str, &[&str]); 7] = [
    (
        "speed",
        &[
            "velocity",
            "v",
            "v_i",
            "v_in",
            "impact_speed",
            "impact_velocity",
            "incident_speed",
            "incident_velocity",
            "speed_in",
            "velocity_in",
        ],
    ),
    (
        "restitution",
        &["e", "cor", "e_n", "coefficient_of_restitution", "restitution_coefficient", "normal_restitution"],
    ),
    ("tangential_restitution", &["e_t"]),
    ("impulse_ratio", &["mu"]),
    ("diameter", &["d", "d_p", "dp", "particle_diameter", "sphere_diameter"]),
    ("angle", &["angle_deg", "impact_angle"]),
    ("sigma", &["uncertainty", "standard_uncertainty"]),
];

/// A column: which, and the factor that brings its values to the units used here.
struct Column {
    name: &'static str,
    factor: f64,
}

/// Which column a name stands for.
fn column(name: &str) -> Option<&'static str> {
    let alias = || ALIASES.iter().find(|(_, others)| others.contains(&name)).map(|(column, _)| *column);
    COLUMNS.into_iter().find(|c| *c == name).or_else(alias)
}

/// The text of a file of points: UTF-8, UTF-16 with its mark, or Latin-1.
///
/// # Errors
/// A file that is no text.
pub fn text(bytes: &[u8]) -> Result<String, LawError> {
    carom_table::sheet::text(bytes).map(std::borrow::Cow::into_owned).map_err(LawError::new)
}

/// Reads a text.
///
/// # Errors
/// What is wrong, with its place in the text.
///
/// ```
/// let rows = carom_lab::points::read("# mine\nSpeed (m/s), restitution, diameter (um)\n2, 0.9, 90\n")?.rows;
/// assert_eq!(rows[0].diameter.as_ref().map(|d| d.value), Some(90.0 * 1e-6));
/// let text = "speed,restitution\n2,0.9\n3,high\n";
/// let error = carom_lab::points::read(text).unwrap_err();
/// assert_eq!(error.line_column(text), Some((3, 3)));
/// # Ok::<(), carom::LawError>(())
/// ```
pub fn read(text: &str) -> Result<Rows, LawError> {
    // places are of the text as given
    let mark = text.len() - text.trim_start_matches('\u{feff}').len();
    let text = &text[mark..];
    let shifted = |mut e: LawError| {
        e.span = e.span.map(|s| s.start + mark..s.end + mark);
        e
    };
    read_bare(text).map_err(shifted).map(|mut rows| {
        rows.rows.iter_mut().filter(|_| mark > 0).for_each(|row| row.shift(mark));
        rows
    })
}

fn read_bare(text: &str) -> Result<Rows, LawError> {
    let sheet = Sheet::read(text.as_bytes(), &|name| column(name).is_some()).map_err(wrong)?;
    let columns = columns(sheet.headings())?;
    let mut rows = Vec::new();
    let mut reader = sheet.rows();
    while reader.next_row().map_err(wrong)?.is_some() {
        rows.push(row(&mut reader, &columns)?);
    }
    let idle = sheet.headings().iter().zip(&columns).filter(|(h, c)| c.is_none() && !h.written.is_empty());
    let left_out = idle.map(|(h, _)| clipped(&h.written).into_owned()).collect();
    Ok(Rows { said: sheet.comments().collect::<Vec<_>>().join(" "), left_out, rows })
}

fn wrong(error: SheetError) -> LawError {
    let help = match &error.problem {
        SheetProblem::Fields { .. } => "give one for each column; an empty one where there is none",
        SheetProblem::Empty | SheetProblem::NoNames => {
            "a line of column names such as speed,restitution and a line for each impact are wanted"
        }
        SheetProblem::Number { .. } => "a number is wanted",
        _ => "",
    };
    let message = match &error.problem {
        SheetProblem::Number { column, text } => format!("{} '{}'", Heading::of(column).name, clipped(text)),
        SheetProblem::Empty => "no points".to_owned(),
        other => other.to_string(),
    };
    let error = LawError::new(message).at(Some(error.place));
    if help.is_empty() { error } else { error.help(help) }
}

/// Whether a name may be another one with a slip of the pen in it.
fn is_slip(name: &str, known: &str) -> bool {
    name.chars().next() == known.chars().next() && name.len().abs_diff(known.len()) <= 2
}

/// What each column is; none for one that nothing reads.
fn columns(headings: &[Heading]) -> Result<Vec<Option<Column>>, LawError> {
    let mut columns: Vec<Option<Column>> = Vec::with_capacity(headings.len());
    for heading in headings {
        let place = Some(heading.place.clone());
        let Some(name) = column(&heading.name) else {
            // what is nearly a name that is known is a slip, not a column of another kind
            if let Some(near) = did_you_mean(&heading.name, COLUMNS.into_iter().filter(|c| is_slip(&heading.name, c))) {
                let help = format!("{near} known are {}; the first line names the columns", COLUMNS.join(", "));
                return Err(LawError::new(format!("unknown column '{}'", clipped(&heading.written)))
                    .help(help)
                    .at(place));
            }
            columns.push(None);
            continue;
        };
        if columns.iter().flatten().any(|c| c.name == name) {
            return Err(LawError::new(format!("a second column {name}")).help("keep one").at(place));
        }
        let factor = match &heading.unit {
            None => 1.0,
            Some(unit) => factor(name, unit)
                .map_err(|e| LawError::new(format!("column '{}': {e}", clipped(&heading.written))).at(place))?,
        };
        columns.push(Some(Column { name, factor }));
    }
    if columns.iter().all(Option::is_none) {
        let all: Vec<_> = headings.iter().map(|h| format!("'{}'", clipped(&h.written))).take(20).collect();
        let place = headings.first().map(|h| h.place.clone());
        return Err(LawError::new(format!("no column is known among {}", all.join(", ")))
            .help(format!("known are {}; a line names the columns", COLUMNS.join(", ")))
            .at(place));
    }
    Ok(columns)
}

/// What brings a value in `unit` to the column's own unit.
fn factor(name: &str, unit: &str) -> Result<f64, UnitError> {
    let one = format!("1 {unit}");
    Ok(match name {
        "speed" => one.parse::<Speed>()?.0,
        "diameter" => one.parse::<Length>()?.0,
        "angle" if matches!(unit, "deg" | "°" | "degrees") => 1.0,
        "angle" => one.parse::<Angle>()?.0.to_degrees(),
        _ => one.parse::<Number>()?.0,
    })
}

fn row(reader: &mut carom_table::sheet::Rows, columns: &[Option<Column>]) -> Result<Row, LawError> {
    let mut row = Row { span: reader.row().place.clone(), ..Row::default() };
    for (index, column) in columns.iter().enumerate() {
        let Some(column) = column else { continue };
        let Some(field) = reader.row().fields.get(index).filter(|f| !f.text.is_empty()) else { continue };
        let span = Some(field.place.clone());
        if column.name == "panel" {
            row.panel = Some(At { value: field.text.clone().into_owned(), span });
            continue;
        }
        let Some(value) = reader.number(index).map_err(wrong)? else { continue };
        let value = Some(At { value: value * column.factor, span });
        match column.name {
            "speed" => row.speed = value,
            "restitution" => row.restitution = value,
            "tangential_restitution" => row.tangential_restitution = value,
            "impulse_ratio" => row.impulse_ratio = value,
            "diameter" => row.diameter = value,
            "angle" => row.angle = value,
            _ => row.sigma = value,
        }
    }
    row.check()?;
    Ok(row)
}

impl Row {
    /// Moves its places on.
    fn shift(&mut self, by: usize) {
        let on = |span: &mut Range<usize>| *span = span.start + by..span.end + by;
        let numbers = [
            &mut self.speed,
            &mut self.restitution,
            &mut self.tangential_restitution,
            &mut self.impulse_ratio,
            &mut self.diameter,
            &mut self.angle,
            &mut self.sigma,
        ];
        numbers.into_iter().flatten().filter_map(|at| at.span.as_mut()).for_each(on);
        self.panel.iter_mut().filter_map(|at| at.span.as_mut()).for_each(on);
        on(&mut self.span);
    }

    /// An error at the line.
    pub fn wrong(&self, message: impl Into<String>, help: &str) -> LawError {
        let error = LawError::new(message).at(Some(self.span.clone()));
        if help.is_empty() { error } else { error.help(help) }
    }

    fn check(&self) -> Result<(), LawError> {
        let outside = |field: &Option<At<f64>>, name: &str, fits: fn(f64) -> bool, help: &str| match field {
            Some(at) if !fits(at.value) => {
                Err(LawError::new(format!("{name} {}", at.value)).help(help).at(at.span.clone()))
            }
            _ => Ok(()),
        };
        outside(&self.speed, "speed", |v| v > 0.0 && v < 1e9, "a point needs a positive speed in m/s")?;
        outside(
            &self.angle,
            "angle",
            |a| a > 0.0 && a <= 90.0,
            "above 0 and up to 90 degrees from the surface (head-on)",
        )?;
        outside(&self.diameter, "diameter", |d| d > 1e-10 && d < 1.0, "metres are wanted, such as 70e-6")?;
        outside(&self.sigma, "sigma", |s| s > 0.0, "a standard uncertainty is above zero")
    }
}
