//! What each change alone does.

use crate::deposits::{Setup, Velocities, velocities};
use crate::section::Section;
use crate::study::{CaseFile, Result};
use crate::{HEIGHT, SURFACES, Test, WALKS};
use carom_report::{Column, Table};
use std::path::Path;

/// The test whose causes are looked at.
const EXAMINED: u32 = 16;

/// Greatest speed of the secondary currents over the mean speed.
const CURRENTS: [f64; 3] = [0.0, 0.01, 0.02];

/// One change after another.
pub fn one_by_one(out: &Path, tests: &[Test], count: i64) -> Result<()> {
    let test = tests.iter().find(|t| t.number == EXAMINED).ok_or("no such test")?;
    let base = CaseFile::read("duct.toml")?;
    let setup = |(name, file): (&str, CaseFile)| test.setup(name, file, count);
    let mut setups = files(&base).into_iter().map(setup).collect::<Result<Vec<_>>>()?;
    let plain = setup(("", base.clone()))?;
    setups.push(Setup { name: "measured speed, u_tau 0.416".into(), speed: 9.1, ..plain.clone() });
    for [from, to] in [[2.0, 6.0], [10.0, 14.0], [14.0, 20.0]] {
        setups.push(Setup { name: format!("counted from {from} to {to} m"), stretch: [from, to], ..plain.clone() });
    }
    let found = velocities(&setups, out)?;
    let names = setups.iter().map(|s| s.name.as_str());
    write(out, "duct-causes.csv", vec![Column::text("cause", names)], &found, |_| test.measured)
}

/// Both walks in channel and square, for every test.
pub fn sections(out: &Path, tests: &[Test], count: i64) -> Result<()> {
    let base = CaseFile::read("duct.toml")?;
    let (mut setups, mut of) = (Vec::new(), Vec::new());
    for test in tests {
        for (walk, _) in WALKS {
            let file = base.clone().set("forces.random_walk.model", walk);
            setups.push(test.setup(format!("{walk}, channel"), file.clone(), count)?);
            let named = |s: Setup| Setup { name: format!("{walk}, {}", s.name), ..s };
            setups.extend(shapes(test, &file, count)?.into_iter().map(named));
            of.resize(setups.len(), test);
        }
    }
    let found = velocities(&setups, out)?;
    let columns = vec![
        Column::integer("test", of.iter().map(|t| i64::from(t.number))),
        Column::text("section", setups.iter().map(|s| s.name.as_str())),
    ];
    write(out, "duct-sections.csv", columns, &found, |row| of[row].measured)
}

/// The sections beside the channel's.
fn shapes(test: &Test, file: &CaseFile, count: i64) -> Result<Vec<Setup>> {
    let with = |name: String, section| Ok(Setup { section, ..test.setup(name, file.clone(), count)? });
    let square = |share: &f64| with(format!("square, currents of {} %", 100.0 * share), Section::Square(*share));
    let mesh = with("channel as a mesh".into(), Section::Meshed);
    std::iter::once(mesh).chain(CURRENTS.iter().map(square)).collect()
}

/// The case with one thing changed.
fn files(base: &CaseFile) -> Vec<(&'static str, CaseFile)> {
    let eddies = base.clone().set("forces.random_walk.model", "eddies");
    let walk = |key: &str, value: &str| base.clone().set(&format!("forces.random_walk.{key}"), value);
    let of_eddies = |key: &str, value: &str| eddies.clone().set(&format!("forces.random_walk.{key}"), value);
    let force = |key: &str, value: toml::Value| base.clone().set(&format!("forces.{key}"), value);
    vec![
        ("eddies", eddies.clone()),
        ("eddies, plain", eddies.clone().set("forces.random_walk.drift", false)),
        ("eddies, isotropic", of_eddies("near_wall", "isotropic")),
        ("eddies, Kallio & Reeks", of_eddies("near_wall", "kallio-reeks")),
        ("eddies, statistics of simulations", of_eddies("near_wall", "dns")),
        ("eddies of random life", of_eddies("life", "random")),
        ("Langevin", base.clone()),
        ("Langevin, plain", force("random_walk.drift", false.into())),
        ("Langevin, isotropic", walk("near_wall", "isotropic")),
        ("Langevin, Wang & James", walk("near_wall", "wang-james")),
        ("Langevin, Kallio & Reeks", walk("near_wall", "kallio-reeks")),
        ("Langevin, C_L = 0.3", force("random_walk.time_scale", 0.3.into())),
        ("lift", force("saffman", true.into())),
        ("no gravity", force("gravity", vec![0.0; 3].into())),
        ("density 1000", base.clone().set_each("injection", "density", "1000 kg/m3")),
        ("start in the lowest 3 cm", starting(base, 5e-4, 0.03)),
        ("start in the uppermost 3 cm", starting(base, HEIGHT - 0.03, HEIGHT - 5e-4)),
        ("start within 1 cm of the middle", starting(base, 0.5 * HEIGHT - 0.01, 0.5 * HEIGHT + 0.01)),
        ("start at rest", base.clone().set_each("injection", "velocity", vec![0.0; 3])),
        ("warmer upwards, 1000 K/m", warmer(base, 1000.0)),
        ("warmer downwards, 1000 K/m", warmer(base, -1000.0)),
        ("steel, C_R = 1", bouncing(base, 1.0)),
        ("steel, C_R = 0.1", bouncing(base, 0.1)),
        ("steel, C_R = 0.02", bouncing(base, 0.02)),
    ]
}

/// Spheres start between two heights, m.
fn starting(base: &CaseFile, from: f64, to: f64) -> CaseFile {
    let sides = [vec![0.0, to - from, 0.0], vec![0.0, 0.0, 0.01]].map(toml::Value::from).to_vec();
    let patch: toml::Table =
        [("corner".into(), vec![0.0, from, 0.0].into()), ("sides".into(), sides.into())].into_iter().collect();
    let position: toml::Table = [("patch".into(), patch.into())].into_iter().collect();
    base.clone().set_each("injection", "position", position)
}

/// The gas's temperature rises from plate to plate, K/m, and drives spheres of 0.2 W/m/K.
fn warmer(base: &CaseFile, upwards: f64) -> CaseFile {
    let case = base.clone().set("fluid.temperature_gradient", vec![0.0, upwards, 0.0]);
    case.set("forces.thermophoresis.thermal_conductivity", 0.2)
}

/// Walls of steel that hold by adhesion, on a share of the smooth contact.
fn bouncing(base: &CaseFile, roughness_factor: f64) -> CaseFile {
    let law = [
        ("sphere", "ammonium-fluorescein"),
        ("surface", "stainless-steel"),
        ("normal", "ea"),
        ("tangential", "rolling"),
    ];
    let case = law.iter().fold(base.clone(), |case, (key, value)| case.set(&format!("law.steel.{key}"), *value));
    let mut case = case.set("law.steel.friction", 0.3).set("law.steel.roughness_factor", roughness_factor);
    for wall in case.list("wall").into_iter().take(2) {
        wall.insert("law".into(), "steel".into());
    }
    case
}

/// Computed over measured, as a table.
fn write(
    out: &Path,
    name: &str,
    mut columns: Vec<Column>,
    found: &[Velocities],
    measured: impl Fn(usize) -> [f64; 3],
) -> Result<()> {
    for (s, surface) in SURFACES.iter().enumerate() {
        for (i, bound) in ["_low", "", "_high"].into_iter().enumerate() {
            let ratios = found.iter().enumerate().map(|(row, v)| v[s][i] / measured(row)[s]);
            columns.push(Column::float(format!("{surface}{bound}"), "", ratios));
        }
    }
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    Ok(table.write(out.join(name))?)
}
