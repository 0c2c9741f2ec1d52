//! The CSV form of measured points, read once for experiments and fits: columns by name, values with their places.
//!
//! Names are read leniently: upper or lower case, spaces or hyphens for `_`, and a unit in brackets after the name, which may be
//! another than the SI unit (`diameter (um)`). Lines that begin with `#` and empty lines are passed over.

use carom::error::did_you_mean;
use carom::spec::At;
use carom::units::{Angle, Length, Number, Speed};
use carom::{SpecError, units::UnitError};
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
    /// What the lines that begin with `#` say.
    pub said: String,
    /// The points.
    pub rows: Vec<Row>,
}

const COLUMNS: [&str; 8] =
    ["speed", "restitution", "tangential_restitution", "impulse_ratio", "diameter", "angle", "sigma", "panel"];

/// A column: which, and the factor that brings its values to the units used here.
struct Column {
    name: &'static str,
    factor: f64,
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
/// # Ok::<(), carom::SpecError>(())
/// ```
pub fn read(text: &str) -> Result<Rows, SpecError> {
    let said: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix('#')).map(str::trim).collect();
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .flexible(true)
        .has_headers(false)
        .from_reader(text.as_bytes());
    let mut columns: Vec<Column> = Vec::new();
    let mut rows = Vec::new();
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|e| SpecError::new(e.to_string()))? {
        let start = record.position().map_or(0, |p| usize::try_from(p.byte()).unwrap_or(0));
        let places = Places::new(text, start, record.len());
        if record.iter().all(str::is_empty) {
            continue;
        }
        if columns.is_empty() {
            columns = headers(&record, &places)?;
        } else {
            rows.push(row(&record, &columns, &places)?);
        }
    }
    Ok(Rows { said: said.join(" "), rows })
}

/// Where the fields of a line stand.
struct Places {
    line: Range<usize>,
    fields: Vec<Range<usize>>,
}

impl Places {
    /// A record begins at or after `start`: comments and empty lines may come before it.
    fn new(text: &str, start: usize, count: usize) -> Self {
        let mut from = start.min(text.len());
        let mut line = "";
        for candidate in text.get(from..).unwrap_or_default().split_inclusive('\n') {
            let bare = candidate.trim();
            if !bare.is_empty() && !bare.starts_with('#') {
                line = candidate.trim_end();
                break;
            }
            from += candidate.len();
        }
        let mut fields = Vec::with_capacity(count);
        let mut at = from;
        for field in line.split(',') {
            let indent = field.len() - field.trim_start().len();
            fields.push(at + indent..at + indent + field.trim().len());
            at += field.len() + 1;
        }
        // quoted commas: the line is place enough
        if fields.len() != count {
            fields = vec![from..from + line.len(); count];
        }
        Self { line: from..from + line.len(), fields }
    }
}

fn headers(record: &csv::StringRecord, places: &Places) -> Result<Vec<Column>, SpecError> {
    let mut columns: Vec<Column> = Vec::with_capacity(record.len());
    for (written, place) in record.iter().zip(&places.fields) {
        let column = header(written).map_err(|e| e.at(Some(place.clone())))?;
        if columns.iter().any(|c| c.name == column.name) {
            let error = SpecError::new(format!("a second column {}", column.name)).help("keep one");
            return Err(error.at(Some(place.clone())));
        }
        columns.push(column);
    }
    Ok(columns)
}

fn header(written: &str) -> Result<Column, SpecError> {
    let (name, unit) = match written.trim_start_matches('\u{feff}').split_once('(') {
        Some((name, unit)) => (name, Some(unit.trim_end_matches(')').trim())),
        None => (written.trim_start_matches('\u{feff}'), None),
    };
    let wanted = name.trim().to_lowercase().replace([' ', '-'], "_");
    let Some(name) = COLUMNS.into_iter().find(|c| *c == wanted) else {
        let near = did_you_mean(&wanted, COLUMNS).map_or(String::new(), |n| format!("{n} "));
        return Err(SpecError::new(format!("unknown column '{written}'"))
            .help(format!("{near}known are {}; the first line names the columns", COLUMNS.join(", "))));
    };
    let factor = match unit.filter(|u| !u.is_empty()) {
        None => 1.0,
        Some(unit) => factor(name, unit).map_err(|e| SpecError::new(format!("column '{written}': {e}")))?,
    };
    Ok(Column { name, factor })
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

fn row(record: &csv::StringRecord, columns: &[Column], places: &Places) -> Result<Row, SpecError> {
    if record.len() != columns.len() {
        return Err(SpecError::new(format!("{} values under {} columns", record.len(), columns.len()))
            .help("give one for each column; an empty one where there is none")
            .at(Some(places.line.clone())));
    }
    let mut row = Row { span: places.line.clone(), ..Row::default() };
    for ((written, place), column) in record.iter().zip(&places.fields).zip(columns) {
        if written.is_empty() {
            continue;
        }
        if column.name == "panel" {
            row.panel = Some(At { value: written.to_owned(), span: Some(place.clone()) });
            continue;
        }
        let value = written.parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| {
            SpecError::new(format!("{} '{written}'", column.name)).help("a number is wanted").at(Some(place.clone()))
        })?;
        let value = Some(At { value: value * column.factor, span: Some(place.clone()) });
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
    /// An error at the line.
    pub fn wrong(&self, message: impl Into<String>, help: &str) -> SpecError {
        let error = SpecError::new(message).at(Some(self.span.clone()));
        if help.is_empty() { error } else { error.help(help) }
    }

    fn check(&self) -> Result<(), SpecError> {
        let outside = |field: &Option<At<f64>>, name: &str, fits: fn(f64) -> bool, help: &str| match field {
            Some(at) if !fits(at.value) => {
                Err(SpecError::new(format!("{name} {}", at.value)).help(help).at(at.span.clone()))
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
