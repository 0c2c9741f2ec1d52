//! What ran: the case as written, put in order.

use carom_report::{Column, Report, ReportError, Table};
use carom_track::About;
use toml::Value;

/// Adds the section.
pub fn section(report: &mut Report, about: &About) -> Result<(), ReportError> {
    // the case was read from this text: it is TOML
    let case: toml::Table = about.text.parse().unwrap_or_default();
    report.section("What ran");
    let rows = [
        ("fluid", "fluid", "dry air at 24 °C and one atmosphere"),
        ("flow", "flow", "still"),
        ("forces", "forces", "drag after Schiller & Naumann, no gravity"),
        ("run", "run", "until all have ended at walls"),
    ];
    let given = rows.map(|(_, key, absent)| case.get(key).map_or_else(|| absent.to_owned(), |v| keys(v, &[])));
    let seed = case.get("seed").map_or_else(|| "1".to_owned(), text);
    let names = rows.map(|r| r.0).into_iter().chain(["seed"]);
    report.table(
        &Table::new([Column::text("what", names), Column::text("as given", given.into_iter().chain([seed]))])?,
        "Flow and forces",
    );
    let walls = list(&case, "wall");
    if !walls.is_empty() {
        let column = |name: &str, absent: &str| {
            Column::text(name, walls.iter().map(|w| w.get(name).map_or_else(|| absent.to_owned(), text)))
        };
        let rest = walls.iter().map(|w| keys(w, &["name", "law"]));
        report.table(&Table::new([column("name", ""), column("law", ""), Column::text("shape", rest)])?, "Walls");
    }
    if let Some(laws) = case.get("law").and_then(Value::as_table).filter(|l| !l.is_empty()) {
        let names = Column::text("law", laws.keys().map(String::as_str));
        report.table(&Table::new([names, Column::text("as given", laws.values().map(|l| keys(l, &[])))])?, "Wall laws");
    }
    let given = list(&case, "injection");
    let rest = about
        .injections
        .iter()
        .enumerate()
        .map(|(i, _)| given.get(i).map_or_else(String::new, |g| keys(g, &["name", "count"])));
    let injections = Table::new([
        Column::text("name", about.injections.iter().map(|i| i.name.as_str())),
        Column::count("particles", about.injections.iter().map(|i| i.count)),
        Column::float("density", "kg/m³", about.injections.iter().map(|i| i.density)),
        Column::text("as given", rest),
    ])?;
    report.table(&injections, "Injections");
    Ok(())
}

fn list<'a>(case: &'a toml::Table, key: &str) -> &'a [Value] {
    case.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// The keys of a table in a line, without some.
fn keys(table: &Value, without: &[&str]) -> String {
    let entries = table.as_table().into_iter().flatten().filter(|(key, _)| !without.contains(&key.as_str()));
    let entries: Vec<String> =
        entries.map(|(key, value)| format!("{} {}", key.replace('_', " "), text(value))).collect();
    entries.join(", ")
}

fn text(value: &Value) -> String {
    match value {
        Value::String(s) => s.clone(),
        Value::Boolean(true) => "yes".to_owned(),
        Value::Boolean(false) => "no".to_owned(),
        Value::Array(all) => format!("[{}]", all.iter().map(text).collect::<Vec<_>>().join(", ")),
        Value::Table(_) => format!("({})", keys(value, &[])),
        other => other.to_string(),
    }
}
