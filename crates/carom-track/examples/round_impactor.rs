//! A round impactor's efficiency over √Stk in the computed flow of `examples/cfd/impactor`, greased, beside the formula's round jet.
//!
//! `cargo run --release -p carom-track --example round_impactor -- OUT [svg|png] [COUNT]`

mod study;

use carom_report::plot::{Dash, Reference};
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use carom_track::force::Sphere;
use carom_track::record::ParticleFate;
use study::{CaseFile, Paths, Result, in_parallel, linspace, meters, track};

const WIDTH: f64 = 1e-3;
const SPEED: f64 = 45.0;
const DENSITY: f64 = 1055.0;
const POINTS: usize = 24;

fn main() -> Result<()> {
    let out = study::out_dir()?;
    let count = std::env::args().find_map(|a| a.parse::<i64>().ok()).unwrap_or(1000);
    let case = CaseFile::read("cfd/impactor/impactor.toml")?;
    let round = formula(&case);
    let kinds = [
        ("computed flow", &case, "flux", Color::BLUE, Dash::Solid),
        ("computed flow, evenly over the inlet", &case, "uniform", Color::SKY, Dash::Dashed),
        ("the formula's round jet", &round, "uniform", Color::VERMILION, Dash::Solid),
    ];
    let roots = linspace(0.2, 0.9, POINTS);
    let found = in_parallel(kinds.len() * POINTS, |job| {
        let (_, case, distribution, ..) = kinds[job / POINTS];
        let case =
            case.clone().set_each("injection", "distribution", distribution).set_each("injection", "count", count);
        collected(&case, roots[job % POINTS]).map_err(|e| e.to_string())
    })?;
    let mut plot = Plot::new(
        "Round impactor, Re = 3000, plate one width away",
        Axis::new("√Stk", "").range(0.2, 0.9),
        Axis::scaled("collected", "%", 100.0).range(0.0, 1.03),
    );
    let mut columns = vec![Column::float("root_stokes", "", roots.clone())];
    for ((label, .., color, dash), shares) in kinds.iter().zip(found.chunks(POINTS)) {
        println!("{label}: half at √Stk = {:.3}", half(&roots, shares));
        plot = plot.with(Series::line(*label, roots.clone(), shares.iter().copied()).color(*color).dash(*dash));
        columns.push(Column::float(label.replace([',', '\''], "").replace(' ', "_"), "", shares.iter().copied()));
    }
    plot.reference(Reference::vertical(0.49, "half, measured")).write(study::figure(&out, "round-impactor"))?;
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("round-impactor.csv"))?)
}

/// The formula's jet of the same width and speed, the spheres all over it, three widths away.
fn formula(case: &CaseFile) -> CaseFile {
    let mut case = case.clone().without("flow.case").without("wall");
    case = case.set("flow.kind", "round-jet").set("flow.diameter", meters(WIDTH)).set("flow.speed", SPEED);
    let wall = |name: &str, point: [f64; 3], normal: [f64; 3], law: &str| {
        let mut plane = toml::Table::new();
        plane.insert("point".into(), point.to_vec().into());
        plane.insert("normal".into(), normal.to_vec().into());
        let mut wall = toml::Table::new();
        wall.insert("name".into(), name.into());
        wall.insert("plane".into(), plane.into());
        wall.insert("law".into(), law.into());
        toml::Value::Table(wall)
    };
    let sides = [
        wall("plate", [0.0; 3], [0.0, 1.0, 0.0], "trap"),
        wall("right", [5e-3, 0.0, 0.0], [-1.0, 0.0, 0.0], "escape"),
        wall("left", [-5e-3, 0.0, 0.0], [1.0, 0.0, 0.0], "escape"),
        wall("front", [0.0, 0.0, 5e-3], [0.0, 0.0, -1.0], "escape"),
        wall("back", [0.0, 0.0, -5e-3], [0.0, 0.0, 1.0], "escape"),
    ];
    let mut disc = toml::Table::new();
    disc.insert("center".into(), vec![0.0, 3.0 * WIDTH, 0.0].into());
    disc.insert("normal".into(), vec![0.0, -1.0, 0.0].into());
    disc.insert("radius".into(), (0.5 * WIDTH).into());
    let mut position = toml::Table::new();
    position.insert("disc".into(), disc.into());
    case.set("wall", sides.to_vec()).set_each("injection", "position", position)
}

/// The share that the plate keeps of those that come out of the nozzle. Stk = 2 τ U/W with the slip-corrected relaxation time.
fn collected(case: &CaseFile, root_stokes: f64) -> Result<f64> {
    let dynamics = case.case()?.dynamics;
    let (mut low, mut high) = (1e-8, 1e-5);
    while high / low > 1.0 + 1e-6 {
        let diameter = f64::sqrt(low * high);
        let time = dynamics.relaxation_time(&Sphere { diameter, density: DENSITY });
        if 2.0 * time * SPEED / WIDTH < root_stokes * root_stokes { low = diameter } else { high = diameter }
    }
    let case = case.clone().set_each("injection", "diameter", meters(low)).without("output.size_bins").case()?;
    let walls = case.domain.walls();
    let (plate, nozzle) = (walls.iter().position(|w| w.name == "plate"), walls.iter().position(|w| w.name == "nozzle"));
    let tracks = track(&case, Paths::Dropped);
    let kept = |wall: Option<usize>| {
        tracks.iter().filter(|t| t.end.fate == ParticleFate::Trapped && wall.is_some() && t.end.wall == wall).count()
            as f64
    };
    // what stays in the nozzle before its mouth counts as not come out
    let inside = tracks.iter().filter(|t| {
        t.end.fate == ParticleFate::Trapped
            && nozzle.is_some()
            && t.end.wall == nozzle
            && t.end.position[1] > WIDTH * 1.001
    });
    Ok(kept(plate) / (tracks.len() as f64 - inside.count() as f64))
}

/// Where a curve first passes one half.
fn half(x: &[f64], y: &[f64]) -> f64 {
    let step = x.windows(2).zip(y.windows(2)).find(|(_, y)| y[0] < 0.5 && y[1] >= 0.5);
    step.map_or(f64::NAN, |(x, y)| x[0] + (x[1] - x[0]) * (0.5 - y[0]) / (y[1] - y[0]))
}
