//! Deposition in a ventilation duct: floor, walls and ceiling by both walks against every smooth test of Sippola & Nazaroff
//! 2004, and what each cause does to one of them.
//!
//! `cargo run --release -p carom-track --example duct_deposition -- OUT [svg|png] [causes|sections] [brownian] [COUNT]
//! [TEST...]`, COUNT particles for each point, tests by number; `causes` varies one thing after another in test 16, `sections` the shape of the
//! duct in each test, `brownian` adds Brownian motion to small particles, which takes six times as long

mod causes;
mod deposits;
mod section;
#[path = "../study/mod.rs"]
mod study;

use carom_report::plot::Marker;
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use carom_track::flow::Fluid;
use carom_track::force::{Slip, Sphere, relaxation_time};
use deposits::{Setup, Velocities, velocities};
use section::Section;
use std::path::Path;
use study::{CaseFile, Result};

const MEASURED: &str = include_str!("../duct-measured.csv");
const HEIGHT: f64 = 0.152;
/// Deposits are counted between these, m: 40 heights to forget the start.
const STRETCH: [f64; 2] = [6.0, 10.0];
/// The same for small particles, of which few deposit.
const LONG_STRETCH: [f64; 2] = [6.0, 30.0];
/// Relaxation time, in wall units, below which particles are small.
const SMALL: f64 = 1.0;
/// Temperature, K, and density of the particles, kg/m³.
const TEMPERATURE: f64 = 295.15;
const DENSITY: f64 = 1350.0;

/// A test: its mean results at two sections of the duct, ceiling, walls and floor, m/s.
struct Test {
    number: u32,
    diameter: f64,
    friction_velocity: f64,
    measured: [f64; 3],
}

const SURFACES: [&str; 3] = ["ceiling", "wall", "floor"];
const COLORS: [Color; 3] = [Color::BLUE, Color::GREEN, Color::VERMILION];
const WALKS: [(&str, Marker); 2] = [("eddies", Marker::Triangle), ("langevin", Marker::Circle)];

fn main() -> Result<()> {
    let out = study::out_dir()?;
    let numbers: Vec<i64> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    let (count, chosen) = numbers.split_first().map_or((4000, &[][..]), |(count, chosen)| (*count, chosen));
    let mut tests = tests()?;
    tests.retain(|t| chosen.is_empty() || chosen.contains(&i64::from(t.number)));
    match (asked("causes"), asked("sections")) {
        (true, _) => causes::one_by_one(&out, &tests, count),
        (_, true) => causes::sections(&out, &tests, count),
        _ => compare(&out, &tests, count),
    }
}

fn asked(word: &str) -> bool {
    std::env::args().any(|a| a == word)
}

impl Test {
    /// The test in a channel, with the case's walk.
    fn setup(&self, name: impl Into<String>, file: CaseFile, count: i64) -> Result<Setup> {
        let small = tau_plus(self) < SMALL;
        Ok(Setup {
            name: name.into(),
            file: if small && asked("brownian") { file.set("forces.brownian", true) } else { file },
            section: Section::Channel,
            speed: mean_speed(self.friction_velocity)?,
            stretch: if small { LONG_STRETCH } else { STRETCH },
            diameter: self.diameter,
            count,
        })
    }
}

/// Both walks against all tests.
fn compare(out: &Path, tests: &[Test], count: i64) -> Result<()> {
    let case = CaseFile::read("duct.toml")?;
    let jobs: Vec<(usize, usize)> = (0..tests.len()).flat_map(|t| (0..WALKS.len()).map(move |w| (t, w))).collect();
    let setup = |(t, w): &(usize, usize)| {
        let file = case.clone().set("forces.random_walk.model", WALKS[*w].0);
        tests[*t].setup(format!("test {}, {}", tests[*t].number, WALKS[*w].0), file, count)
    };
    let setups = jobs.iter().map(setup).collect::<Result<Vec<_>>>()?;
    show(out, tests, &jobs, &velocities(&setups, out)?)
}

/// Table, figure and means.
fn show(out: &Path, tests: &[Test], jobs: &[(usize, usize)], found: &[Velocities]) -> Result<()> {
    let tau: Vec<f64> = tests.iter().map(tau_plus).collect();
    let mut columns = vec![
        Column::integer("test", tests.iter().map(|t| i64::from(t.number))),
        Column::float("diameter", "m", tests.iter().map(|t| t.diameter)),
        Column::float("tau_plus", "", tau.clone()),
    ];
    let mut plot = Plot::new(
        "A ventilation duct: computed over measured",
        Axis::new("relaxation time τ⁺", "").log(),
        Axis::new("deposition velocity, computed over measured", "").log().range(1e-2, 1e2),
    );
    plot = plot.with(Series::line("", [1e-3, 30.0], [1.0, 1.0]).color(Color::GREY));
    for (s, surface) in SURFACES.iter().enumerate() {
        columns.push(Column::float(format!("{surface}_measured"), "m/s", tests.iter().map(|t| t.measured[s])));
        for (w, (walk, marker)) in WALKS.iter().enumerate() {
            let of = |i: usize| -> Vec<f64> {
                let all = jobs.iter().zip(found).filter(|((_, job), _)| *job == w);
                all.map(|((t, _), v)| v[s][i] / tests[*t].measured[s]).collect()
            };
            let ratio = of(1);
            let some = |of: Vec<f64>| -> Vec<f64> {
                of.iter().zip(&ratio).map(|(v, r)| if *r > 0.0 { *v } else { f64::NAN }).collect()
            };
            let points = Series::points(format!("{surface}, {walk}"), tau.clone(), some(ratio.clone()));
            plot = plot.with(points.interval(some(of(0)), some(of(2))).marker(*marker).color(COLORS[s]));
            report(&format!("{surface}, {walk}"), &ratio, &of(2));
            for (i, bound) in ["_low", "", "_high"].into_iter().enumerate() {
                columns.push(Column::float(format!("{surface}_{walk}{bound}"), "", of(i)));
            }
        }
    }
    plot.write(study::figure(out, "duct"))?;
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("duct.csv"))?)
}

/// The geometric mean of what was found, its spread as a factor, and the mean at most: with the upper ends where nothing was found.
fn report(name: &str, ratios: &[f64], high: &[f64]) {
    let mean_and_spread = |values: &[f64]| {
        let logs: Vec<f64> = values.iter().map(|v| v.ln()).collect();
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        let square = logs.iter().map(|l| (l - mean) * (l - mean)).sum::<f64>() / logs.len() as f64;
        (mean.exp(), square.sqrt().exp())
    };
    let found: Vec<f64> = ratios.iter().copied().filter(|r| *r > 0.0).collect();
    let most: Vec<f64> = ratios.iter().zip(high).map(|(r, high)| if *r > 0.0 { *r } else { *high }).collect();
    let ((mean, spread), (at_most, _)) = (mean_and_spread(&found), mean_and_spread(&most));
    let (n, all) = (found.len(), ratios.len());
    println!("{name}: geometric mean {mean:.2}, spread {spread:.2} of {n} of {all}; of all at most {at_most:.2}");
}

fn tests() -> Result<Vec<Test>> {
    let mut tests: Vec<(Test, f64)> = Vec::new();
    for line in MEASURED.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit())) {
        let v: Vec<f64> = line.split(',').map(str::parse).collect::<std::result::Result<_, _>>()?;
        let [number, diameter, _, friction_velocity, ceiling, wall, floor] = v[..] else { return Err(line.into()) };
        let logs = [ceiling, wall, floor].map(f64::ln);
        match tests.last_mut() {
            Some((last, sections)) if f64::from(last.number) == number => {
                *sections += 1.0;
                for (sum, log) in last.measured.iter_mut().zip(logs) {
                    *sum += log;
                }
            }
            _ => tests.push((Test { number: number as u32, diameter, friction_velocity, measured: logs }, 1.0)),
        }
    }
    let mean =
        |(test, sections): (Test, f64)| Test { measured: test.measured.map(|sum| (sum / sections).exp()), ..test };
    Ok(tests.into_iter().map(mean).collect())
}

fn air() -> Result<Fluid> {
    Ok(Fluid::air(TEMPERATURE, 101_325.0)?)
}

fn tau_plus(test: &Test) -> f64 {
    let air = air().unwrap_or_default();
    let sphere = Sphere { diameter: test.diameter, density: DENSITY };
    let slip = Slip::Davies.factor(test.diameter, air.mean_free_path);
    relaxation_time(&air, &sphere, slip) * test.friction_velocity.powi(2) / air.kinematic_viscosity()
}

/// The mean speed (m/s) of a channel with a friction velocity (m/s): Dean's u_τ = U √0.0365 (U h/ν)^{−1/8}, solved for U.
fn mean_speed(friction_velocity: f64) -> Result<f64> {
    let nu = air()?.kinematic_viscosity();
    Ok((friction_velocity / 0.0365f64.sqrt()).powf(8.0 / 7.0) * (HEIGHT / nu).powf(1.0 / 7.0))
}
