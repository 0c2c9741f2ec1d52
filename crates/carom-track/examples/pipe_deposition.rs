//! Deposition in a turbulent pipe: V⁺ against τ⁺, with and without a near-wall correction of the random walk.
//!
//! `cargo run --release -p carom-track --example pipe_deposition -- OUT`

mod study;

use carom_report::plot::Marker;
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use carom_track::flow::{Fluid, Pipe, Profile};
use carom_track::force::{Slip, Sphere, relaxation_time};
use carom_track::record::{End, Fate};
use study::{CaseFile, Paths, Result, logspace, meters, track};

const RADIUS: f64 = 6.35e-3;
const SPEED: f64 = 12.15;
const DENSITY: f64 = 920.0;
/// Droplets for each point.
const COUNT: i64 = 120;
/// Deposits are counted between these; the droplets need the first stretch to forget how they started.
const FROM: f64 = 0.3;
const TO: f64 = 0.99;
/// Until every droplet has ended, and twice what the air needs for the pipe, s.
const LONG: f64 = 20.0;
const SHORT: f64 = 0.15;

fn main() -> Result<()> {
    let out = study::out_dir()?;
    let case = CaseFile::read("pipe.toml")?;
    let fluid = Fluid::default();
    let pipe = Pipe::new(Profile::Turbulent, [0.0; 3], [1.0, 0.0, 0.0], RADIUS, SPEED, &fluid)?;
    let wall_time = fluid.kinematic_viscosity() / pipe.friction_velocity().powi(2);
    println!("u_tau = {:.4} m/s, nu/u_tau^2 = {:.3e} s", pipe.friction_velocity(), wall_time);

    let taus = logspace(2.0, 100.0, 8);
    let tau = logspace(1.0, 200.0, 80);
    let wood: Vec<f64> = tau.iter().map(|t| if *t < 20.0 { 4.5e-4 * t * t } else { f64::NAN }).collect();
    let papavergos: Vec<f64> = tau.iter().map(|t| (3.5e-4 * t * t).min(0.18)).collect();
    let mut plot = Plot::new(
        "Droplets in a turbulent pipe, Re = 10 000",
        Axis::new("relaxation time τ⁺", "").log(),
        Axis::new("deposition velocity V⁺", "").log().range(3e-4, 1.0),
    )
    .with(Series::line("Papavergos & Hedley 1984", tau.clone(), papavergos).color(Color::BLACK))
    .with(Series::line("Wood 1981", tau, wood).color(Color::GREY).dashed());
    let mut columns = vec![Column::float("tau_plus", "", taus.clone())];
    let models = [
        ("plain walk", "isotropic", Marker::Cross, Color::BLUE),
        ("Wang & James", "wang-james", Marker::Triangle, Color::VERMILION),
        ("Kallio & Reeks", "kallio-reeks", Marker::Circle, Color::GREEN),
    ];
    for (label, near_wall, marker, color) in models {
        let run = |until: f64| -> Result<Vec<[f64; 3]>> {
            let points = taus.iter().map(|t| {
                let v = deposition(&case, near_wall, diameter(&fluid, t * wall_time), until)?;
                Ok(v.map(|v| v / pipe.friction_velocity()))
            });
            points.collect()
        };
        let (all, early) = (run(LONG)?, run(SHORT)?);
        // where nothing deposited a log axis has no place for the point: its upper bound is in the table
        let shown = |v: &[[f64; 3]], i: usize| -> Vec<f64> {
            v.iter().map(|v| if v[1] > 0.0 { v[i] } else { f64::NAN }).collect()
        };
        let points = Series::points(label, taus.clone(), shown(&all, 1)).interval(shown(&all, 0), shown(&all, 2));
        plot = plot.with(points.marker(marker).color(color));
        let line = Series::line(format!("{label}, first {SHORT} s"), taus.clone(), shown(&early, 1));
        plot = plot.with(line.color(color).dotted());
        for (found, when) in [(all, ""), (early, "_early")] {
            for (i, bound) in ["_low", "", "_high"].into_iter().enumerate() {
                columns.push(Column::float(format!("{near_wall}{when}{bound}"), "", found.iter().map(|v| v[i])));
            }
        }
    }
    plot.write(study::figure(&out, "pipe-deposition"))?;
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("pipe-deposition.csv"))?)
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
fn deposition(case: &CaseFile, near_wall: &str, diameter: f64, until: f64) -> Result<[f64; 3]> {
    let case = case.clone().set("forces.random_walk.near_wall", near_wall).set("run.until", until);
    let case = case.set_each("injection", "diameter", meters(diameter)).set_each("injection", "count", COUNT);
    let ends: Vec<End> = track(&case.case()?, Paths::Dropped).into_iter().map(|t| t.end).collect();
    let reached = ends.iter().filter(|e| e.position[0] >= FROM).count() as f64;
    let kept = |e: &&End| e.fate == Fate::Trapped && e.position[0] >= FROM && e.position[0] < TO;
    let share = ends.iter().filter(kept).count() as f64 / reached;
    let per_log = SPEED * 2.0 * RADIUS / (4.0 * (TO - FROM));
    let (low, high) = wilson(share, reached);
    Ok([low, share, high].map(|s| per_log * (1.0 / (1.0 - s)).ln()))
}

/// The 95 % interval of a share found among `n` (Wilson 1927).
fn wilson(share: f64, n: f64) -> (f64, f64) {
    let z2 = 1.96f64.powi(2) / n;
    let middle = (share + 0.5 * z2) / (1.0 + z2);
    let half = (z2 * (share * (1.0 - share) + 0.25 * z2)).sqrt() / (1.0 + z2);
    ((middle - half).max(0.0), middle + half)
}
