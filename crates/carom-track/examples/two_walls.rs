//! Kim & Dunn's Fig. 12: a sphere between two walls, with adhesion and with none, and how far it travels.
//!
//! `cargo run --release -p carom-track --example two_walls -- OUT`

mod study;

use carom_report::plot::Reference;
use carom_report::{Axis, Column, Plot, Series, Table};
use std::path::Path;
use study::{CaseFile, Paths, Result, Track, linspace, meters, track};

/// The upper wall in the case file.
const HEIGHT: f64 = 20e-3;

fn main() -> Result<()> {
    let out = study::out_dir()?;
    reach()?;
    trajectories(&out)?;
    heights(&out)
}

/// The case file's law (EA), or e = 1 as Fluent's reflect condition has it: normal and along the wall.
fn elastic(case: &CaseFile) -> CaseFile {
    let case = case.clone().set_each("wall", "law", "reflect");
    case.set_each("wall", "restitution", 1.0).set_each("wall", "tangential_restitution", 1.0)
}

/// The same between walls of another distance.
fn between(case: &CaseFile, height: f64) -> CaseFile {
    let mut case = case.clone().set("flow.height", meters(height));
    if let Some(upper) = case.list("wall").into_iter().nth(1) {
        let point = vec!["0 m".to_owned(), meters(height), "0 m".to_owned()];
        let plane = [("point", toml::Value::from(point)), ("normal", vec![0.0, -1.0, 0.0].into())];
        upper.insert("plane".into(), toml::Table::from_iter(plane.map(|(k, v)| (k.to_owned(), v))).into());
    }
    case
}

fn one(case: &CaseFile, paths: Paths) -> Result<Track> {
    track(&case.case()?, paths).pop().ok_or_else(|| "the case tracks nothing".into())
}

/// How far it gets before it is caught or bounces no more; without adhesion and friction it slides on from there with the air.
fn travel(case: &CaseFile) -> Result<f64> {
    Ok(last_bounce(&one(case, Paths::Dropped)?).1)
}

/// Time and place of the last impact.
fn last_bounce(track: &Track) -> (f64, f64) {
    track.impacts.last().map_or((track.end.time, track.end.position[0]), |i| (i.time, i.position[0]))
}

/// How high it rises where no wall stops it.
fn reach() -> Result<()> {
    let case = between(&CaseFile::read("two-walls.toml")?, 60e-3);
    let top = one(&case, Paths::Kept)?.path.iter().map(|p| p[2]).fold(0.0, f64::max);
    println!("with the upper wall out of reach it rises to {:.1} mm", top * 1e3);
    Ok(())
}

fn trajectories(out: &Path) -> Result<()> {
    let case = CaseFile::read("two-walls.toml")?;
    let runs = [("EA", one(&case, Paths::Kept)?), ("e = 1", one(&elastic(&case), Paths::Kept)?)];
    let far = runs.iter().map(|r| last_bounce(&r.1).1).fold(0.0, f64::max) * 1.05;
    let mut plot = Plot::new(
        "Ag-coated glass, 70 µm, between aluminium walls",
        Axis::scaled("x", "mm", 1e3).range(0.0, far),
        Axis::scaled("y", "mm", 1e3),
    )
    .wall([0.0, 0.0], [far, 0.0])
    .wall([0.0, HEIGHT], [far, HEIGHT]);
    for (name, run) in &runs {
        let end = run.end;
        println!(
            "{name}: {} bounces, the last at x = {:.1} mm after {:.3} s; {:?}",
            run.bounces(),
            last_bounce(run).1 * 1e3,
            last_bounce(run).0,
            end.fate
        );
        for i in run.impacts.iter().take(6) {
            println!(
                "  x = {:.2} mm, y = {:.2} mm: {:.3} m/s onto the wall, e = {:.3}",
                i.position[0] * 1e3,
                i.position[1] * 1e3,
                i.normal_speed_in,
                i.restitution
            );
        }
        let path: Vec<_> = run.path.iter().filter(|p| p[0] <= last_bounce(run).0).collect();
        let line = Series::line(*name, path.iter().map(|p| p[1]), path.iter().map(|p| p[2]));
        plot = plot.with(if *name == "EA" { line } else { line.dashed() });
    }
    Ok(plot.write(study::figure(out, "two-walls"))?)
}

/// The ratio of both travels over the walls' distance, for three profiles of the flow.
fn heights(out: &Path) -> Result<()> {
    let base = CaseFile::read("two-walls.toml")?;
    let heights = linspace(9e-3, 32e-3, 93);
    let mut plot = Plot::new(
        "How much further with e = 1 than with adhesion",
        Axis::scaled("distance of the walls", "mm", 1e3).range(8e-3, 33e-3),
        Axis::new("ratio of travel, e = 1 over EA", "").log().range(0.5, 50.0),
    )
    .reference(Reference::horizontal(2.0, "the paper: about 2"));
    let mut columns = vec![Column::float("height", "m", heights.clone())];
    for profile in ["turbulent", "laminar", "plug"] {
        let case = base.clone().set("flow.profile", profile);
        let pairs = heights.iter().map(|h| {
            let case = between(&case, *h);
            Ok((travel(&case)?, travel(&elastic(&case))?))
        });
        let pairs: Vec<(f64, f64)> = pairs.collect::<Result<_>>()?;
        let ratio: Vec<f64> = pairs.iter().map(|(ea, one)| one / ea).collect();
        plot = plot.with(Series::line(format!("{profile} profile"), heights.clone(), ratio.clone()));
        columns.push(Column::float(format!("{profile}_ea"), "m", pairs.iter().map(|p| p.0)));
        columns.push(Column::float(format!("{profile}_elastic"), "m", pairs.iter().map(|p| p.1)));
        columns.push(Column::float(format!("{profile}_ratio"), "", ratio));
    }
    plot.write(study::figure(out, "two-walls-ratio"))?;
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("two-walls-ratio.csv"))?)
}
