//! Deposition in a 90° bend, over the Stokes number, in the computed flow of `examples/cfd/bend-90` against Pui, Romay-Novas & Liu 1987: how the aerosol
//! enters, what happens within a few radii of the wall, gravity, walls that let spheres bounce.
//!
//! `cargo run --release -p carom-track --example bend -- OUT [svg|png] [COUNT] [FOLDER] [center|wall-drag]`, COUNT spheres for each point, FOLDER of
//! another mesh's case. The last word changes every curve, and gives the shares at the measured points alone: spheres touch with their centres, or
//! feel the wall in their drag.

mod study;

use carom_report::plot::{Dash, Marker};
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use carom_track::force::Sphere;
use carom_track::record::ParticleFate;
use study::{CaseFile, Paths, Result, Track, in_parallel, logspace, meters, track};

const MEASURED: &str = include_str!("bend-measured.csv");
const RADIUS: f64 = 5e-3;
const SPEED: f64 = 1.5;
const POINTS: usize = 18;

/// A curve: what is changed of the case.
struct Curve {
    label: &'static str,
    density: f64,
    change: fn(CaseFile) -> CaseFile,
    look: (Color, Dash),
}

const CURVES: [Curve; 6] = [
    Curve { label: "as the flow carries them", density: 1000.0, change: |c| c, look: (Color::BLUE, Dash::Solid) },
    Curve {
        label: "evenly over the inlet",
        density: 1000.0,
        change: |c| c.set_each("injection", "distribution", "uniform"),
        look: (Color::SKY, Dash::Dashed),
    },
    Curve {
        label: "flat profile at the inlet",
        density: 1000.0,
        change: |c| c.set("flow.fields.velocity", "UPlug"),
        look: (Color::GREEN, Dash::Solid),
    },
    Curve {
        label: "gravity, the bend turns down",
        density: 1000.0,
        change: |c| c.set("forces.gravity", vec![0.0, 9.81, 0.0]),
        look: (Color::GREY, Dash::Dashed),
    },
    Curve { label: "touching with their centres", density: 1000.0, change: center, look: (Color::BLUE, Dash::Dotted) },
    Curve { label: "glass spheres on steel", density: 2500.0, change: steel, look: (Color::VERMILION, Dash::Solid) },
];

/// Spheres that touch with their centres. One that creeps along the wall never does: what has not by the end stays out.
fn center(case: CaseFile) -> CaseFile {
    case.set_each("wall", "contact_at", "center").set("run.until", "0.4 s")
}

/// Spheres that feel the wall in their drag.
fn wall_drag(case: CaseFile) -> CaseFile {
    case.set("forces.wall_drag", true).set("run.until", "0.25 s")
}

/// Glass spheres on stainless steel, dry: they bounce.
fn steel(mut case: CaseFile) -> CaseFile {
    if let Some(pipe) = case.list("wall").into_iter().next() {
        pipe.insert("law".into(), "steel".into());
    }
    case.set("law.steel.sphere", "glass")
        .set("law.steel.surface", "stainless-steel")
        .set("law.steel.normal", "eap")
        .set("law.steel.tangential", "rolling")
        .set("law.steel.friction", 0.2)
        .set("law.steel.roughness_factor", 0.5)
        .set("run.until", "2 s")
}

fn main() -> Result<()> {
    let out = study::out_dir()?;
    let count = std::env::args().find_map(|a| a.parse::<i64>().ok()).unwrap_or(2000);
    let mut case = CaseFile::read("cfd/bend-90/bend-90.toml")?.set_each("injection", "count", count);
    if let Some(folder) = std::env::args().skip(2).find(|a| a.contains('/')) {
        case = case.set("flow.case", folder);
    }
    let near = std::env::args().find_map(|a| match a.as_str() {
        "center" => Some(center as fn(CaseFile) -> CaseFile),
        "wall-drag" => Some(wall_drag),
        _ => None,
    });
    if let Some(near) = near {
        return at_measured(&near(case));
    }
    at_measured(&case)?;
    let stokes = logspace(0.06, 1.4, POINTS);
    let found = shares(&case, &stokes)?;
    let mut columns = vec![Column::float("stokes", "", stokes.clone())];
    let mut plot = Plot::new(
        "A 90° bend, Re = 1000, bend radius 5.7 R",
        Axis::new("Stokes number", "").log().range(0.06, 1.4),
        Axis::scaled("deposited", "%", 100.0).range(0.0, 1.03),
    );
    for (curve, shares) in CURVES.iter().zip(&found) {
        let line = Series::line(curve.label, stokes.clone(), shares.iter().copied());
        plot = plot.with(line.color(curve.look.0).dash(curve.look.1));
        columns.push(Column::float(curve.label.replace(", ", "_").replace(' ', "_"), "", shares.iter().copied()));
        println!("{}: half at {:.3}", curve.label, half(&stokes, shares));
    }
    for (source, label, look) in [
        ("cheng-wang-1981", "Cheng & Wang 1981, theory", (Color::BLACK, Dash::Dotted)),
        ("pilou-2011", "Pilou et al. 2011, computed", (Color::BLACK, Dash::Dashed)),
    ] {
        let (x, y) = curve(source);
        println!("{source}: half at {:.3}", half(&x, &y));
        plot = plot.with(Series::line(label, x, y).color(look.0).dash(look.1).thin());
    }
    let (x, y) = curve("pui-1987");
    println!("measured: half at {:.3}", half(&x, &y));
    plot.with(Series::points("measured, Pui et al. 1987", x, y).marker(Marker::Circle).color(Color::BLACK))
        .write(study::figure(&out, "bend-90"))?;
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("bend-90.csv"))?)
}

/// The share of each curve.
fn shares(case: &CaseFile, stokes: &[f64]) -> Result<Vec<Vec<f64>>> {
    let found = in_parallel(CURVES.len(), |curve| {
        let curve = &CURVES[curve];
        deposited(&(curve.change)(case.clone()), curve.density, stokes).map_err(|e| e.to_string())
    })?;
    Ok(found)
}

/// Prints what was measured and the share of each curve there.
fn at_measured(case: &CaseFile) -> Result<()> {
    let (stokes, measured) = curve("pui-1987");
    let found = shares(case, &stokes)?;
    let row = |label: &str, values: &[f64], scale: f64| {
        let texts: Vec<_> =
            values.iter().map(|v| format!("{:6.*}", if scale == 1.0 { 2 } else { 1 }, scale * v)).collect();
        println!("{label:28}{}", texts.join(" "));
    };
    row("Stokes number", &stokes, 1.0);
    row("measured, %", &measured, 100.0);
    CURVES.iter().zip(&found).for_each(|(curve, shares)| row(curve.label, shares, 100.0));
    Ok(())
}

/// The points of a source.
fn curve(source: &str) -> (Vec<f64>, Vec<f64>) {
    let rows = MEASURED.lines().filter_map(|l| l.strip_prefix(source)?.strip_prefix(',')?.split_once(','));
    rows.filter_map(|(x, y)| Some((x.parse::<f64>().ok()?, y.parse::<f64>().ok()?))).unzip()
}

/// The share that stays in the bend of those that reach it, for each Stokes number.
fn deposited(case: &CaseFile, density: f64, stokes: &[f64]) -> Result<Vec<f64>> {
    let mut case = case.clone().set_each("injection", "density", density);
    let dynamics = case.case()?.dynamics;
    let drops = case.list("injection").into_iter().next().ok_or("no injection")?.clone();
    let sizes = stokes.iter().map(|stokes| {
        let (mut low, mut high) = (1e-6, 1e-4);
        while high / low > 1.0 + 1e-6 {
            let diameter = f64::sqrt(low * high);
            let time = dynamics.relaxation_time(&Sphere { diameter, density });
            if time * SPEED / RADIUS < *stokes { low = diameter } else { high = diameter }
        }
        let mut drops = drops.clone();
        drops.remove("name");
        drops.insert("diameter".into(), meters(low).into());
        toml::Value::Table(drops)
    });
    let case = case.clone().set("injection", sizes.collect::<Vec<_>>()).case()?;
    let wall = |name: &str| case.domain.walls().iter().position(|w| w.name == name);
    let (before, bend) = (wall("before"), wall("bend"));
    let tracks = track(&case, Paths::Dropped);
    let share = |tracks: &[Track]| {
        let kept = |at: Option<usize>| {
            let held =
                tracks.iter().filter(|t| !matches!(t.end.fate, ParticleFate::Escaped | ParticleFate::Overlapping));
            held.filter(|t| t.end.wall == at).count() as f64
        };
        let started = tracks.iter().filter(|t| t.end.fate != ParticleFate::Overlapping).count() as f64;
        kept(bend) / (started - kept(before))
    };
    Ok(tracks.chunks(tracks.len() / stokes.len()).map(share).collect())
}

/// Where a curve first passes one half.
fn half(x: &[f64], y: &[f64]) -> f64 {
    let step = x.windows(2).zip(y.windows(2)).find(|(_, y)| y[0] < 0.5 && y[1] >= 0.5);
    step.map_or(f64::NAN, |(x, y)| x[0] + (x[1] - x[0]) * (0.5 - y[0]) / (y[1] - y[0]))
}
