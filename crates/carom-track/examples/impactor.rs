//! A slot impactor's efficiency over √Stk: a greased plate, a nozzle close by, a dry plate that small spheres stick to and
//! large ones bounce off.
//!
//! `cargo run --release -p carom-track --example impactor -- OUT`

mod study;

use carom_report::plot::{Dash, Reference};
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use carom_track::force::Sphere;
use carom_track::record::ParticleFate;
use study::{CaseFile, Paths, Result, logspace, meters, track};

const WIDTH: f64 = 1e-3;
const SPEED: f64 = 30.0;
const DENSITY: f64 = 1055.0;
/// Spheres for each point, side by side across half the slot.
const ACROSS: usize = 200;

fn main() -> Result<()> {
    let out = study::out_dir()?;
    let case = CaseFile::read("impactor.toml")?;
    let greased = plate(case.clone(), "trap");
    let stokes = greased.clone().set("forces.drag", "stokes");
    let diameters = logspace(1.4e-6, 9e-6, 60);
    let roots = diameters.iter().map(|d| root_stokes(&case, *d)).collect::<Result<Vec<_>>>()?;
    let (far, near) = (Start { height: 3.0 * WIDTH, fluid: true }, Start { height: WIDTH, fluid: false });
    let curves = [
        ("greased, Stokes drag", &stokes, far),
        ("greased", &greased, far),
        ("greased, nozzle at 1 W", &greased, near),
        ("dry steel, EAP", &case, far),
    ];
    let mut plot = Plot::new(
        "Slot impactor, polystyrene at 30 m/s",
        Axis::new("√Stk", "").range(0.6, 4.0).log(),
        Axis::scaled("collected", "%", 100.0).range(0.0, 1.03),
    );
    let mut columns =
        vec![Column::float("diameter", "m", diameters.clone()), Column::float("root_stokes", "", roots.clone())];
    let looks = [
        (Color::GREY, Dash::Dotted),
        (Color::BLUE, Dash::Solid),
        (Color::SKY, Dash::Solid),
        (Color::VERMILION, Dash::Dashed),
    ];
    for ((label, case, start), (color, dash)) in curves.into_iter().zip(looks) {
        let found = diameters.iter().map(|d| efficiency(case, *d, start)).collect::<Result<Vec<_>>>()?;
        println!("{label}: half at √Stk = {:.3}", half(&roots, &found));
        plot = plot.with(Series::line(label, roots.clone(), found.clone()).color(color).dash(dash));
        columns.push(Column::float(label.replace(", ", "_").replace(' ', "_").to_lowercase(), "", found));
    }
    plot.reference(Reference::vertical(0.77, "half, measured"))
        .reference(Reference::vertical((2.0 / std::f64::consts::PI).sqrt(), "threshold on the axis"))
        .write(study::figure(&out, "impactor"))?;
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    println!("round jet, Stokes drag: half at √Stk = {:.3}", round_half(&stokes)?);
    Ok(table.write(out.join("impactor.csv"))?)
}

/// Where the spheres start, and whether with the fluid's velocity or the jet's.
#[derive(Clone, Copy)]
struct Start {
    height: f64,
    fluid: bool,
}

/// Gives the plate, the first wall, a law.
fn plate(mut case: CaseFile, law: &str) -> CaseFile {
    if let Some(plate) = case.list("wall").into_iter().next() {
        plate.insert("law".into(), law.into());
    }
    case
}

/// √Stk, Stk = 2 τ U/W with the slip-corrected relaxation time.
fn root_stokes(case: &CaseFile, diameter: f64) -> Result<f64> {
    let time = case.case()?.dynamics.relaxation_time(&Sphere { diameter, density: DENSITY });
    Ok((2.0 * time * SPEED / WIDTH).sqrt())
}

/// One sphere of a diameter at each of these places.
fn at(case: &CaseFile, diameter: f64, places: &[f64], start: Start) -> CaseFile {
    let injection = places.iter().map(|x| {
        let velocity: toml::Value = if start.fluid {
            "fluid".into()
        } else {
            vec!["0 m/s".to_owned(), format!("{} m/s", -SPEED), "0 m/s".to_owned()].into()
        };
        let keys: [(&str, toml::Value); 4] = [
            ("material", "polystyrene".into()),
            ("diameter", meters(diameter).into()),
            ("position", vec![meters(*x), meters(start.height), meters(0.0)].into()),
            ("velocity", velocity),
        ];
        toml::Value::Table(keys.into_iter().map(|(k, v)| (k.to_owned(), v)).collect())
    });
    case.clone().set("injection", injection.collect::<Vec<_>>())
}

/// The share that the plate keeps.
fn efficiency(case: &CaseFile, diameter: f64, start: Start) -> Result<f64> {
    let places: Vec<f64> = (0..ACROSS).map(|i| 0.5 * WIDTH * (i as f64 + 0.5) / ACROSS as f64).collect();
    let tracks = track(&at(case, diameter, &places, start).case()?, Paths::Dropped);
    let kept = tracks
        .iter()
        .filter(|t| matches!(t.end.fate, ParticleFate::Captured | ParticleFate::Trapped | ParticleFate::Settled))
        .count();
    Ok(kept as f64 / ACROSS as f64)
}

/// Where a curve first passes one half.
fn half(x: &[f64], y: &[f64]) -> f64 {
    let step = x.windows(2).zip(y.windows(2)).find(|(_, y)| y[0] < 0.5 && y[1] >= 0.5);
    step.map_or(f64::NAN, |(x, y)| x[0] + (x[1] - x[0]) * (0.5 - y[0]) / (y[1] - y[0]))
}

/// Where half of the spheres that start all over a round jet land.
fn round_half(greased: &CaseFile) -> Result<f64> {
    let mut case = greased.clone().set("flow", toml::Table::new());
    case = case.set("flow.kind", "round-jet").set("flow.diameter", meters(WIDTH)).set("flow.speed", SPEED);
    let start = Start { height: 3.0 * WIDTH, fluid: true };
    // equal areas of the disc
    let places: Vec<f64> = (0..ACROSS).map(|i| 0.5 * WIDTH * ((i as f64 + 0.5) / ACROSS as f64).sqrt()).collect();
    let (mut low, mut high) = (0.3e-6, 5e-6);
    while high / low > 1.001 {
        let middle = f64::sqrt(low * high);
        let tracks = track(&at(&case, middle, &places, start).case()?, Paths::Dropped);
        let kept = tracks.iter().filter(|t| t.end.fate == ParticleFate::Trapped).count();
        if 2 * kept >= ACROSS { high = middle } else { low = middle }
    }
    root_stokes(greased, f64::sqrt(low * high))
}
