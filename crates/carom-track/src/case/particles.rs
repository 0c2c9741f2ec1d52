//! `particles = "starts.csv"` of an injection: each sphere with its own start.

use super::check::wrong;
use super::files::Files;
use crate::injection::{Listed, Source};
use carom::LawError;
use carom::spec::At;

/// Columns by name, SI units: position; velocity, diameter, weight and time where given.
const COLUMNS: [&str; 9] = ["x", "y", "z", "u", "v", "w", "diameter", "weight", "time"];

/// The starts of a file, in its order.
pub(super) fn read(file: &At<String>, files: &Files) -> Result<Source, LawError> {
    let failed = |e: &dyn std::fmt::Display| wrong(file, format!("{}: {e}", file.value));
    let bytes = files.read(&file.value).map_err(|e| failed(&e))?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(&bytes[..]);
    let head = reader.headers().map_err(|e| failed(&e))?.clone();
    if let Some(name) = head.iter().find(|name| !COLUMNS.contains(name)) {
        let name = carom_table::quoted(name);
        return Err(failed(&format_args!("no column {name} is read")).help(format!("known are {}", COLUMNS.join(", "))));
    }
    let places = COLUMNS.map(|name| head.iter().position(|h| h == name));
    if places[..3].iter().any(Option::is_none) {
        return Err(failed(&"a particle needs x, y and z").help("the first line names the columns, SI units"));
    }
    let moves = places[3..6].iter().flatten().count();
    if moves % 3 != 0 {
        return Err(failed(&"a velocity is u, v and w").help("give all three columns, or none"));
    }
    let mut list = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| failed(&e))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |column: usize| -> Result<Option<f64>, LawError> {
            let Some(text) = places[column].and_then(|p| record.get(p)) else { return Ok(None) };
            let wrong = || failed(&format_args!("line {line}: {} is no number", carom_table::quoted(text)));
            text.parse().map(Some).map_err(|_| wrong())
        };
        let vector = |from: usize| -> Result<Option<[f64; 3]>, LawError> {
            Ok(match (number(from)?, number(from + 1)?, number(from + 2)?) {
                (Some(x), Some(y), Some(z)) => Some([x, y, z]),
                _ => None,
            })
        };
        list.push(Listed {
            position: vector(0)?.unwrap_or_default(),
            velocity: vector(3)?,
            diameter: number(6)?,
            weight: number(7)?.unwrap_or(1.0),
            time: number(8)?,
        });
    }
    if list.is_empty() {
        return Err(failed(&"no particles"));
    }
    Ok(Source::Listed(list.into()))
}
