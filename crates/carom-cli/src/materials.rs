//! `carom materials`: the library, or one entry with every value and its source.

use crate::failure::Failure;
use crate::law::MaterialsArgs;
use crate::law::Words;
use crate::output;
use crate::text::{number, wrapped};
use carom::material::{Material, Property, PropertyKind};
use carom_report::{Column, Table};
use std::fmt::Write as _;

const EXAMPLE: &str = "\
Examples:
  carom materials
  carom materials copper
  carom materials my-alloy --materials my-alloys.toml

A file of your own holds tables such as
  [material.my-alloy]
  density = \"7850 kg/m3\"
  young_modulus = { value = \"210 GPa\", source = \"data sheet\" }
  poisson_ratio = 0.3
  surface_energy = \"1.1 J/m2\"
  yield_strength = \"310 MPa\"
  hardness = \"1.3 GPa\"";

/// List the materials, or show one with every value, range and source
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// A material's name or alias; without it all are listed
    name: Option<String>,
    #[command(flatten)]
    materials: MaterialsArgs,
    /// Print JSON, SI units
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    let library = args.materials.library()?;
    match &args.name {
        Some(name) => {
            let material = library.get(name).map_err(|e| Failure::input(e.said_in(&Words)))?;
            if args.json { output::print_json(&Entry::from(material)) } else { output::print(&tell(material)) }
        }
        None if args.json => output::print_json(&library.iter().map(Entry::from).collect::<Vec<_>>()),
        None => output::print(&list(library.iter().collect())?),
    }
}

/// One material as JSON: nominal values at the top, where they come from under `properties`.
#[derive(serde::Serialize)]
struct Entry<'a> {
    name: &'a str,
    description: &'a str,
    aliases: &'a [String],
    density: Option<f64>,
    young_modulus: Option<f64>,
    poisson_ratio: Option<f64>,
    surface_energy: Option<f64>,
    yield_strength: Option<f64>,
    hardness: Option<f64>,
    tensile_strength: Option<f64>,
    note: Option<&'a str>,
    properties: Vec<Value<'a>>,
}

#[derive(serde::Serialize)]
struct Value<'a> {
    property: &'static str,
    unit: &'static str,
    value: f64,
    low: Option<f64>,
    high: Option<f64>,
    source: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    typical: Option<&'a str>,
    note: Option<&'a str>,
    printed: Option<&'a str>,
    alternatives: Vec<Other<'a>>,
}

#[derive(serde::Serialize)]
struct Other<'a> {
    value: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
    source: Option<&'a str>,
    note: Option<&'a str>,
}

impl<'a> From<&'a Material> for Entry<'a> {
    fn from(m: &'a Material) -> Self {
        Self {
            name: &m.name,
            description: &m.description,
            aliases: &m.aliases,
            density: m.density,
            young_modulus: m.young_modulus,
            poisson_ratio: m.poisson_ratio,
            surface_energy: m.surface_energy,
            yield_strength: m.yield_strength,
            hardness: m.hardness,
            tensile_strength: m.tensile_strength,
            note: m.note.as_deref(),
            properties: m.properties.iter().map(|(kind, p)| value(*kind, p)).collect(),
        }
    }
}

fn value(kind: PropertyKind, p: &Property) -> Value<'_> {
    Value {
        property: kind.key(),
        unit: kind.unit(),
        value: p.value,
        low: p.low,
        high: p.high,
        source: p.source.as_deref(),
        typical: p.typical.as_deref(),
        note: p.note.as_deref(),
        printed: p.printed.as_deref(),
        alternatives: p
            .alternatives
            .iter()
            .map(|a| Other {
                value: a.value,
                low: a.low,
                high: a.high,
                source: a.source.as_deref(),
                note: a.note.as_deref(),
            })
            .collect(),
    }
}

fn list(materials: Vec<&Material>) -> Result<String, Failure> {
    let column = |name: &str, unit: &str, factor: f64, get: fn(&Material) -> Option<f64>| {
        Column::float(name, unit, materials.iter().map(move |m| get(m).map(|v| v / factor)).collect::<Vec<_>>())
    };
    let table = Table::new([
        Column::text("name", materials.iter().map(|m| m.name.as_str())),
        column("density", "kg/m3", 1.0, |m| m.density),
        column("E", "GPa", 1e9, |m| m.young_modulus),
        column("nu", "", 1.0, |m| m.poisson_ratio),
        column("gamma", "J/m2", 1.0, |m| m.surface_energy),
        column("sigma", "MPa", 1e6, |m| m.yield_strength),
        column("H", "GPa", 1e9, |m| m.hardness),
        Column::text("also", materials.iter().map(|m| m.aliases.first().map_or("", String::as_str))),
    ])?;
    Ok(table.to_text())
}

/// A value in the unit people use: GPa for moduli, MPa for strengths, else SI.
fn shown(kind: PropertyKind, value: f64) -> String {
    match kind {
        PropertyKind::YoungModulus | PropertyKind::Hardness => format!("{} GPa", number(value / 1e9)),
        PropertyKind::YieldStrength | PropertyKind::TensileStrength => format!("{} MPa", number(value / 1e6)),
        _ => format!("{} {}", number(value), kind.unit()).trim_end().to_owned(),
    }
}

/// `value (low to high)`, as far as they are known.
fn range(kind: PropertyKind, value: Option<f64>, low: Option<f64>, high: Option<f64>) -> String {
    let ends = match (low, high) {
        (Some(low), Some(high)) => format!("{} to {}", shown(kind, low), shown(kind, high)),
        (Some(low), None) => format!("from {}", shown(kind, low)),
        (None, Some(high)) => format!("up to {}", shown(kind, high)),
        (None, None) => String::new(),
    };
    match value {
        Some(v) if ends.is_empty() => shown(kind, v),
        Some(v) => format!("{} ({ends})", shown(kind, v)),
        None => ends,
    }
}

fn tell(material: &Material) -> String {
    let mut text = material.name.clone();
    if !material.description.is_empty() {
        let _ = write!(text, ": {}", material.description);
    }
    text.push('\n');
    if !material.aliases.is_empty() {
        let _ = writeln!(text, "also {}", material.aliases.join(", "));
    }
    if let Some(note) = &material.note {
        let _ = writeln!(text, "{}", wrapped(note, 100, 0));
    }
    for (kind, property) in &material.properties {
        let name = kind.key().replace('_', " ");
        let typical = if property.typical.is_some() { ", typical" } else { "" };
        let shown = range(*kind, Some(property.value), property.low, property.high);
        let _ = writeln!(text, "\n{name:15} {shown}{typical}");
        let mut line = |label: &str, content: &Option<String>| {
            if let Some(content) = content {
                let _ = writeln!(text, "  {label:14}{}", wrapped(content, 100, 16));
            }
        };
        line("source", &property.source);
        line("typical", &property.typical);
        line("printed", &property.printed);
        line("note", &property.note);
        for a in &property.alternatives {
            let mut other = range(*kind, a.value, a.low, a.high);
            for part in [&a.source, &a.note].into_iter().flatten() {
                let _ = write!(other, "; {part}");
            }
            line("other", &Some(other));
        }
    }
    let missing: Vec<String> = PropertyKind::ALL
        .iter()
        .copied()
        .filter(|kind| material.value(*kind).is_none() && asked_for(*kind, material))
        .map(|kind| kind.key().replace('_', " "))
        .collect();
    if !missing.is_empty() {
        let _ = writeln!(text, "\nnot known: {}", missing.join(", "));
    }
    text
}

/// May a law ask for it? A tensile strength no law reads, and of yield strength and hardness one is enough.
fn asked_for(kind: PropertyKind, material: &Material) -> bool {
    match kind {
        PropertyKind::TensileStrength => false,
        PropertyKind::YieldStrength => material.hardness.is_none(),
        PropertyKind::Hardness => material.yield_strength.is_none(),
        _ => true,
    }
}
