//! Deposition in a ventilation duct: floor, walls and ceiling by both walks against every smooth test of Sippola & Nazaroff
//! 2004, and what each cause does to one of them.
//!
//! `cargo run --release -p carom-track --example duct_deposition -- OUT [svg|png] [causes] [COUNT] [TEST...]`, COUNT particles for each
//! point, tests by number

mod study;

use carom_report::plot::Marker;
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use carom_track::flow::Fluid;
use carom_track::force::{Slip, Sphere, relaxation_time};
use carom_track::record::{End, ParticleFate};
use study::{CaseFile, Paths, Result, in_parallel, meters, track, wilson};

const MEASURED: &str = include_str!("duct-measured.csv");
const HEIGHT: f64 = 0.152;
/// Deposits are counted between these; the particles need the first stretch to forget how they started.
const FROM: f64 = 6.0;
const TO: f64 = 10.0;
/// Temperature, K, and density of the particles, kg/m³.
const TEMPERATURE: f64 = 295.15;
const DENSITY: f64 = 1350.0;
/// The test whose causes are looked at.
const EXAMINED: u32 = 16;

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
    if std::env::args().any(|a| a == "causes") {
        return causes(&out, &tests, count);
    }
    let case = CaseFile::read("duct.toml")?;
    let jobs: Vec<(usize, usize)> = (0..tests.len()).flat_map(|t| (0..WALKS.len()).map(move |w| (t, w))).collect();
    let found = in_parallel(jobs.len(), |job| {
        let (t, w) = jobs[job];
        let case = case.clone().set("forces.random_walk.model", WALKS[w].0);
        let test = &tests[t];
        let v = mean_speed(test.friction_velocity).and_then(|speed| deposition(&case, test.diameter, speed, count));
        let v = v.map_err(|e| e.to_string())?;
        eprintln!("test {} {}: {v:.5?}, measured {:.5?}", tests[t].number, WALKS[w].0, tests[t].measured);
        Ok(v)
    })?;
    show(&out, &tests, &jobs, &found)
}

/// Table, figure and means.
fn show(out: &std::path::Path, tests: &[Test], jobs: &[(usize, usize)], found: &[[[f64; 3]; 3]]) -> Result<()> {
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
            let logs: Vec<f64> = ratio.iter().filter(|r| **r > 0.0).map(|r| r.ln()).collect();
            let mean = logs.iter().sum::<f64>() / logs.len() as f64;
            let spread = (logs.iter().map(|l| (l - mean) * (l - mean)).sum::<f64>() / logs.len() as f64).sqrt();
            println!(
                "{surface}, {walk}: geometric mean {:.2}, spread {:.2}, {} of {}",
                mean.exp(),
                spread.exp(),
                logs.len(),
                ratio.len()
            );
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

/// What each change alone does to one test.
fn causes(out: &std::path::Path, tests: &[Test], count: i64) -> Result<()> {
    let test = tests.iter().find(|t| t.number == EXAMINED).ok_or("no such test")?;
    let base = CaseFile::read("duct.toml")?;
    let eddies = base.clone().set("forces.random_walk.model", "eddies");
    let walk = |key: &str, value: &str| base.clone().set(&format!("forces.random_walk.{key}"), value);
    let of_eddies = |key: &str, value: &str| eddies.clone().set(&format!("forces.random_walk.{key}"), value);
    let bounces = |case: CaseFile, roughness_factor: f64| {
        let law = [
            ("sphere", "ammonium-fluorescein"),
            ("surface", "stainless-steel"),
            ("normal", "ea"),
            ("tangential", "rolling"),
        ];
        let case = law.iter().fold(case, |case, (key, value)| case.set(&format!("law.steel.{key}"), *value));
        let mut case = case.set("law.steel.friction", 0.3).set("law.steel.roughness_factor", roughness_factor);
        for wall in case.list("wall").into_iter().take(2) {
            wall.insert("law".into(), "steel".into());
        }
        case
    };
    let mut variants = vec![
        ("eddies", eddies.clone()),
        ("eddies, plain", eddies.clone().set("forces.random_walk.drift", false)),
        ("eddies, isotropic", of_eddies("near_wall", "isotropic")),
        ("eddies, Kallio & Reeks", of_eddies("near_wall", "kallio-reeks")),
        ("eddies, statistics of simulations", of_eddies("near_wall", "dns")),
        ("eddies of random life", of_eddies("life", "random")),
        ("Langevin", base.clone()),
        ("Langevin, plain", base.clone().set("forces.random_walk.drift", false)),
        ("Langevin, isotropic", walk("near_wall", "isotropic")),
        ("Langevin, Wang & James", walk("near_wall", "wang-james")),
        ("Langevin, Kallio & Reeks", walk("near_wall", "kallio-reeks")),
        ("Langevin, C_L = 0.3", base.clone().set("forces.random_walk.time_scale", 0.3)),
        ("lift", base.clone().set("forces.saffman", true)),
        ("no gravity", base.clone().set("forces.gravity", vec![0.0; 3])),
        ("density 1000", base.clone().set_each("injection", "density", "1000 kg/m3")),
        ("steel, C_R = 1", bounces(base.clone(), 1.0)),
        ("steel, C_R = 0.1", bounces(base.clone(), 0.1)),
        ("steel, C_R = 0.02", bounces(base.clone(), 0.02)),
    ];
    const SLOWER: &str = "measured speed, u_tau 0.416";
    variants.push((SLOWER, base.clone()));
    let speed = mean_speed(test.friction_velocity)?;
    let found = in_parallel(variants.len(), |job| {
        let (name, case) = &variants[job];
        let speed = if *name == SLOWER { 9.1 } else { speed };
        let v = deposition(case, test.diameter, speed, count).map_err(|e| e.to_string())?;
        eprintln!("{name}: {v:.5?}, measured {:.5?}", test.measured);
        Ok(v)
    })?;
    let mut columns = vec![Column::text("cause", variants.iter().map(|(name, _)| *name))];
    for (s, surface) in SURFACES.iter().enumerate() {
        for (i, bound) in ["_low", "", "_high"].into_iter().enumerate() {
            columns.push(Column::float(
                format!("{surface}{bound}"),
                "",
                found.iter().map(|v| v[s][i] / test.measured[s]),
            ));
        }
    }
    let table = Table::new(columns)?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("duct-causes.csv"))?)
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

/// Deposition velocities on ceiling, walls and floor, m/s, each with a 95 % interval, in a channel of a mean speed (m/s).
fn deposition(case: &CaseFile, diameter: f64, speed: f64, count: i64) -> Result<[[f64; 3]; 3]> {
    let case = case.clone().set("flow.mean_speed", speed).set_each("injection", "diameter", meters(diameter));
    let case = case.set_each("injection", "count", count);
    let [ceiling, floor] = velocities(&case, speed)?;
    // gravity along the walls, or none
    let across = case.set("forces.gravity", vec![0.0, 0.0, -9.81]);
    let walls = velocities(&across, speed)?;
    let mean = |i: usize| 0.5 * (walls[0][i] + walls[1][i]);
    Ok([ceiling, [mean(0), mean(1), mean(2)], floor])
}

/// V = n U h/∫N dx on the upper and on the lower wall: n kept between `FROM` and `TO`, N the particles that pass x.
fn velocities(case: &CaseFile, speed: f64) -> Result<[[f64; 3]; 2]> {
    let case = case.case()?;
    let ends: Vec<End> = track(&case, Paths::Dropped).into_iter().map(|t| t.end).collect();
    let passes: f64 = ends.iter().map(|e| (e.position[0].min(TO) - FROM).max(0.0)).sum();
    let reached = ends.iter().filter(|e| e.position[0] >= FROM).count() as f64;
    let kept = |e: &&End| {
        matches!(e.fate, ParticleFate::Trapped | ParticleFate::Captured | ParticleFate::Settled)
            && e.position[0] >= FROM
            && e.position[0] < TO
    };
    let on = |upper: bool| {
        let count = ends.iter().filter(kept).filter(|e| (e.position[1] > 0.5 * HEIGHT) == upper).count() as f64;
        let (low, high) = wilson(count / reached, reached);
        [low, count / reached, high].map(|share| share * reached * speed * HEIGHT / passes)
    };
    Ok([on(true), on(false)])
}
