//! Recomputes impacts that a front has logged, by the core alone, and compares them bit for bit.
//!
//!     cargo run --release -p carom-c --example check_impacts -- impacts.csv sideLeft=walls.toml:steel floor=floor.toml
//!
//! The log has a header and one row per impact, with all digits; columns are found by name: patch, diameter, density, the velocity
//! before (vx vy vz), the spin (w), the normal (n), the wall's velocity (u), draw0 to draw3, fate, and after the impact velocity and spin
//! (vx_out ... wz_out), restitution, impulse_ratio. A captured sphere is expected at rest, as flow solvers keep it. Says how many agree;
//! fails on the first that does not, and when a patch that was given a law has no impact.

use carom::material::Library;
use carom::spec::{parse_named_law, parse_only_law};
use carom::{Fate, Impact, Vec3, WallLaw};
use std::collections::BTreeMap;
use std::process::ExitCode;

/// Rebounds and captures seen on one patch.
type Seen = [usize; 2];

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match args.split_first().ok_or("which log?".to_owned()).and_then(|(log, laws)| check(log, laws)) {
        Ok(seen) => {
            for (patch, [rebounds, captures]) in seen {
                println!("{patch}: {rebounds} rebounds and {captures} captures, bit for bit");
            }
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn check(log: &str, laws: &[String]) -> Result<BTreeMap<String, Seen>, String> {
    let laws: BTreeMap<&str, WallLaw> = laws.iter().map(|text| law(text)).collect::<Result<_, _>>()?;
    let mut seen: BTreeMap<String, Seen> = laws.keys().map(|&patch| (patch.to_owned(), [0, 0])).collect();

    let text = std::fs::read_to_string(log).map_err(|e| format!("{log}: {e}"))?;
    let mut lines = text.lines().enumerate();
    let (_, header) = lines.next().ok_or_else(|| format!("{log} is empty"))?;
    let columns: BTreeMap<&str, usize> = header.split(',').enumerate().map(|(i, name)| (name, i)).collect();

    for (i, line) in lines {
        let at = |message: String| format!("{log}:{}: {message}", i + 1);
        let row = Row { columns: &columns, cells: line.split(',').collect() };
        let patch = row.text("patch").map_err(at)?;
        let law = laws.get(patch).ok_or_else(|| at(format!("no law was given for patch {patch}")))?;
        let fate = agree(law, &row).map_err(at)?;
        seen.entry(patch.to_owned()).or_default()[usize::from(fate == Fate::Capture)] += 1;
    }
    match seen.iter().find(|(_, counts)| **counts == [0, 0]) {
        Some((patch, _)) => Err(format!("{log}: no impact on {patch}")),
        None => Ok(seen),
    }
}

/// `PATCH=FILE` or `PATCH=FILE:NAME`.
fn law(text: &str) -> Result<(&str, WallLaw), String> {
    let (patch, place) = text.split_once('=').ok_or_else(|| format!("'{text}' is not PATCH=FILE:NAME"))?;
    let (file, name) = place.rsplit_once(':').map_or((place, None), |(file, name)| (file, Some(name)));
    let toml = std::fs::read_to_string(file).map_err(|e| format!("{file}: {e}"))?;
    let spec = name.map_or_else(|| parse_only_law(&toml), |name| parse_named_law(&toml, name));
    let law = spec.and_then(|spec| spec.compile(Library::builtin())).map_err(|e| e.shown(file, &toml))?;
    Ok((patch, law))
}

struct Row<'a> {
    columns: &'a BTreeMap<&'a str, usize>,
    cells: Vec<&'a str>,
}

impl Row<'_> {
    fn text(&self, name: &str) -> Result<&str, String> {
        let cell = self.columns.get(name).and_then(|&i| self.cells.get(i));
        cell.copied().ok_or_else(|| format!("no {name}"))
    }

    fn number(&self, name: &str) -> Result<f64, String> {
        let text = self.text(name)?;
        text.parse().map_err(|_| format!("{name} is no number: '{text}'"))
    }

    fn vector(&self, symbol: char, suffix: &str) -> Result<Vec3, String> {
        let part = |axis: char| self.number(&format!("{symbol}{axis}{suffix}"));
        Ok([part('x')?, part('y')?, part('z')?])
    }

    fn impact(&self) -> Result<Impact, String> {
        let mut impact = Impact::new(self.number("diameter")?, self.vector('v', "")?, self.vector('n', "")?);
        impact.density = Some(self.number("density")?);
        impact.spin = self.vector('w', "")?;
        impact.wall_velocity = self.vector('u', "")?;
        for (i, draw) in impact.draws.iter_mut().enumerate() {
            *draw = self.number(&format!("draw{i}"))?;
        }
        Ok(impact)
    }
}

fn agree(law: &WallLaw, row: &Row) -> Result<Fate, String> {
    let impact = row.impact()?;
    let expected = law.impact(&impact).map_err(|e| e.to_string())?;

    let fate = if expected.fate == Fate::Capture { "capture" } else { "rebound" };
    if row.text("fate")? != fate {
        return Err(format!("{impact:?}: {}, but the core says {fate}", row.text("fate")?));
    }
    let velocity = if expected.fate == Fate::Capture { [0.0; 3] } else { expected.velocity };
    let logged = [
        ("velocity", row.vector('v', "_out")?, velocity),
        ("spin", row.vector('w', "_out")?, expected.spin),
        ("restitution", [row.number("restitution")?, 0.0, 0.0], [expected.restitution, 0.0, 0.0]),
        ("impulse ratio", [row.number("impulse_ratio")?, 0.0, 0.0], [expected.impulse_ratio, 0.0, 0.0]),
    ];
    for (what, was, wanted) in logged {
        let same = was.iter().zip(&wanted).all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan());
        if !same {
            return Err(format!("{impact:?}: {what} {was:?}, but the core says {wanted:?}"));
        }
    }
    Ok(expected.fate)
}
