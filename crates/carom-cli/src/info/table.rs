//! Of a flow table.

use super::triple;
use crate::failure::Failure;
use crate::output;
use crate::text::Lines;
use carom_track::flow::Table;
use std::path::Path;

#[derive(serde::Serialize)]
struct Info {
    kind: &'static str,
    path: String,
    nodes: [usize; 3],
    low: [f64; 3],
    high: [f64; 3],
    turbulent: bool,
    notes: Vec<String>,
    flow: String,
}

/// Shows what a flow table holds.
pub fn run(file: &Path, json: bool) -> Result<(), Failure> {
    let table = Table::load(file).map_err(|e| {
        let (path, text) = (file.display().to_string(), e.to_string());
        Failure::input(if text.starts_with(&path) { text } else { format!("{path}: {text}") })
    })?;
    let path = file.display().to_string();
    let [low, high] = table.bounds();
    let flow = format!("[flow]\nkind = \"table\"\nfile = {}\n", toml::Value::String(path.clone()));
    let (nodes, turbulent, notes) = (table.size(), table.is_turbulent(), table.notes().to_vec());
    let info = Info { kind: "table", path, nodes, low, high, turbulent, notes, flow };
    if json {
        return output::print_json(&info);
    }
    let mut lines = Lines::default();
    lines.add("nodes", info.nodes.map(|n| n.to_string()).join(" x "));
    lines.add("box", format!("{} to {} m", triple(info.low), triple(info.high)));
    lines.add("fields", if info.turbulent { "velocity, k, epsilon or omega" } else { "velocity" });
    for note in &info.notes {
        lines.add("note", note);
    }
    output::print(&format!("{}: flow table\n\n{lines}\nFor a case file:\n\n{}", info.path, info.flow))
}
