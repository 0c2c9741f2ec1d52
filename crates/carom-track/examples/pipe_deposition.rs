//! Deposition in a turbulent pipe: V⁺ against τ⁺, with and without a near-wall correction of the random walk, well mixed
//! and plain.
//!
//! `cargo run --release -p carom-track --example pipe_deposition -- OUT`

mod study;

use carom_report::plot::Marker;
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use carom_track::flow::{Fluid, Pipe, Profile};
use carom_track::force::{Slip, Sphere, relaxation_time};
use carom_track::record::{End, ParticleFate};
use study::{CaseFile, Paths, Result, in_parallel, logspace, meters, track, wilson};

const RADIUS: f64 = 6.35e-3;
const SPEED: f64 = 12.15;
const DENSITY: f64 = 920.0;
/// Deposits are counted between these; the droplets need the first stretch to forget how they started.
const FROM: f64 = 0.3;
const TO: f64 = 0.99;

/// A way to walk.
struct Walk {
    label: &'static str,
    column: &'static str,
    model: &'static str,
    near_wall: &'static str,
    drift: bool,
    /// Droplets for each point.
    count: i64,
    marker: Marker,
    color: Color,
}

const WALKS: [Walk; 7] = [
    Walk { model: "langevin", ..walk("Langevin", "langevin", "dns", true, Marker::Square, Color::BLACK) },
    walk("Wang & James", "wang_james", "wang-james", true, Marker::Triangle, Color::VERMILION),
    walk("Kallio & Reeks", "kallio_reeks", "kallio-reeks", true, Marker::Circle, Color::GREEN),
    walk("isotropic", "isotropic", "isotropic", true, Marker::Cross, Color::BLUE),
    walk("Wang & James, plain", "wang_james_plain", "wang-james", false, Marker::Triangle, Color::VERMILION),
    walk("Kallio & Reeks, plain", "kallio_reeks_plain", "kallio-reeks", false, Marker::Circle, Color::GREEN),
    walk("isotropic, plain", "isotropic_plain", "isotropic", false, Marker::Cross, Color::BLUE),
];

const fn walk(
    label: &'static str,
    column: &'static str,
    near_wall: &'static str,
    drift: bool,
    marker: Marker,
    color: Color,
) -> Walk {
    let count = if drift { 1000 } else { 200 };
    Walk { label, column, model: "eddies", near_wall, drift, count, marker, color }
}

fn main() -> Result<()> {
    let out = study::out_dir()?;
    let case = CaseFile::read("pipe.toml")?;
    let fluid = Fluid::default();
    let pipe = Pipe::new(Profile::Turbulent, [0.0; 3], [1.0, 0.0, 0.0], RADIUS, SPEED, &fluid)?;
    let wall_time = fluid.kinematic_viscosity() / pipe.friction_velocity().powi(2);
    println!("u_tau = {:.4} m/s, nu/u_tau^2 = {:.3e} s", pipe.friction_velocity(), wall_time);

    let taus = logspace(2.0, 100.0, 8);
    let jobs: Vec<(usize, usize)> = (0..WALKS.len()).flat_map(|w| (0..taus.len()).map(move |t| (w, t))).collect();
    let found = in_parallel(jobs.len(), |job| {
        let (w, t) = jobs[job];
        let v = deposition(&case, &WALKS[w], diameter(&fluid, taus[t] * wall_time)).map_err(|e| e.to_string())?;
        let v = v.map(|v| v / pipe.friction_velocity());
        eprintln!("{} tau+ {:.1}: V+ {v:.5?}", WALKS[w].label, taus[t]);
        Ok(v)
    })?;

    let mut columns = vec![Column::float("tau_plus", "", taus.clone())];
    let mut plot = correlations();
    for (walk, found) in WALKS.iter().zip(found.chunks(taus.len())) {
        // where nothing deposited a log axis has no place for the point: its upper bound is in the table
        let shown = |i: usize| -> Vec<f64> { found.iter().map(|v| if v[1] > 0.0 { v[i] } else { f64::NAN }).collect() };
        if walk.drift {
            let points = Series::points(walk.label, taus.clone(), shown(1)).interval(shown(0), shown(2));
            plot = plot.with(points.marker(walk.marker).color(walk.color));
        } else {
            plot = plot.with(Series::line(walk.label, taus.clone(), shown(1)).color(walk.color).dotted());
        }
        for (i, bound) in ["_low", "", "_high"].into_iter().enumerate() {
            columns.push(Column::float(format!("{}{bound}", walk.column), "", found.iter().map(|v| v[i])));
        }
    }
    plot.write(study::figure(&out, "pipe-deposition"))?;
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("pipe-deposition.csv"))?)
}

/// Axes, and what fits to measurements say.
fn correlations() -> Plot {
    let tau = logspace(1.0, 200.0, 80);
    let wood: Vec<f64> = tau.iter().map(|t| if *t < 20.0 { 4.5e-4 * t * t } else { f64::NAN }).collect();
    let papavergos: Vec<f64> = tau.iter().map(|t| (3.5e-4 * t * t).min(0.18)).collect();
    Plot::new(
        "Droplets in a turbulent pipe, Re = 10 000",
        Axis::new("relaxation time τ⁺", "").log(),
        Axis::new("deposition velocity V⁺", "").log().range(3e-4, 1.0),
    )
    .with(Series::line("Papavergos & Hedley 1984", tau.clone(), papavergos).color(Color::BLACK))
    .with(Series::line("Wood 1981", tau, wood).color(Color::GREY).dashed())
}

/// The diameter of a droplet of a relaxation time, by bisection (slip depends on it).
fn diameter(fluid: &Fluid, time: f64) -> f64 {
    let (mut low, mut high) = (1e-8, 1e-3);
    while high / low > 1.0 + 1e-12 {
        let middle = f64::sqrt(low * high);
        let sphere = Sphere { diameter: middle, density: DENSITY };
        let slip = Slip::Davies.factor(middle, fluid.mean_free_path);
        if relaxation_time(fluid, &sphere, slip) < time { low = middle } else { high = middle }
    }
    low
}

/// Deposition velocity from the share of the droplets that reach `FROM` and deposit before `TO`,
/// V = (U D/4L) ln(1/(1 − share)), with a 95 % interval. m/s.
fn deposition(case: &CaseFile, walk: &Walk, diameter: f64) -> Result<[f64; 3]> {
    let case = case.clone().set("forces.random_walk.model", walk.model);
    let case = case.set("forces.random_walk.near_wall", walk.near_wall);
    let case = case.set("forces.random_walk.drift", walk.drift);
    let case = case.set_each("injection", "diameter", meters(diameter)).set_each("injection", "count", walk.count);
    let ends: Vec<End> = track(&case.case()?, Paths::Dropped).into_iter().map(|t| t.end).collect();
    let reached = ends.iter().filter(|e| e.position[0] >= FROM).count() as f64;
    let kept = |e: &&End| e.fate == ParticleFate::Trapped && e.position[0] >= FROM && e.position[0] < TO;
    let share = ends.iter().filter(kept).count() as f64 / reached;
    let per_log = SPEED * 2.0 * RADIUS / (4.0 * (TO - FROM));
    let (low, high) = wilson(share, reached);
    Ok([low, share, high].map(|s| per_log * (1.0 / (1.0 - s)).ln()))
}
