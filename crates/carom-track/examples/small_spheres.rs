//! Small spheres: diffusion in a pipe, settling between plates, penetration of a sampling line, each beside its formula.
//!
//! `cargo run --release -p carom-track --example small_spheres -- OUT`

mod study;

use carom_report::plot::Marker;
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use std::path::Path;
use study::{
    CaseFile, Result, diffusivity_and_settling, fuchs, gormley_kennedy, in_parallel, logspace, meters, through, wilson,
};

const MUS: [f64; 9] = [0.003, 0.006, 0.01, 0.02, 0.03, 0.06, 0.1, 0.2, 0.3];
/// Shares of v_s L/(U h).
const FALLS: [f64; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

fn main() -> Result<()> {
    let out = study::out_dir()?;
    diffusion(&out)?;
    settling(&out)?;
    sampling_line(&out)
}

/// Shares that come through, with the bounds of their 95 % intervals: low, share, high.
type Shares = [Vec<f64>; 3];

/// Runs cases side by side, each with draws of its own.
fn shares(cases: &[CaseFile]) -> Result<Shares> {
    let found = in_parallel(cases.len(), |i| {
        let case = cases[i].clone().set("seed", i as i64 + 1).case().map_err(|e| e.to_string())?;
        let (n, all) = through(&case);
        let (low, high) = wilson(n / all, all);
        Ok([low, n / all, high])
    })?;
    Ok([0, 1, 2].map(|i| found.iter().map(|f| f[i]).collect()))
}

fn points(label: &str, x: &[f64], [low, share, high]: &Shares) -> Series {
    Series::points(label, x.to_vec(), share.clone()).interval(low.clone(), high.clone())
}

/// A picture, and its numbers as a table on the screen and as CSV.
fn write(out: &Path, name: &str, plot: &Plot, key: (&str, &str, &[f64]), columns: &[(&str, &[f64])]) -> Result<()> {
    plot.write(study::figure(out, name))?;
    let first = Column::float(key.0, key.1, key.2.to_vec());
    let rest = columns.iter().map(|(name, values)| Column::float(*name, "", values.to_vec()));
    let table = Table::new(std::iter::once(first).chain(rest).collect::<Vec<_>>())?;
    println!("{name}\n{}", table.to_text());
    Ok(table.write(out.join(name).with_extension("csv"))?)
}

/// Speeds of `diffusion-pipe.toml` that give the µ, by flux and evenly over the area.
fn diffusion(out: &Path) -> Result<()> {
    let file = CaseFile::read("diffusion-pipe.toml")?;
    let [diffusivity, _] = diffusivity_and_settling(&file.case()?, 20e-9);
    let at = |mu: &f64| file.clone().set("flow.mean_speed", diffusivity * 0.1 / (0.5e-3f64.powi(2) * mu));
    let cases: Vec<CaseFile> = MUS.iter().map(at).collect();
    let even: Vec<CaseFile> =
        cases.iter().map(|c| c.clone().set_each("injection", "distribution", "uniform")).collect();
    let (flux, even) = (shares(&cases)?, shares(&even)?);
    let mu = logspace(0.002, 0.5, 100);
    let plot = Plot::new(
        "Spheres of 20 nm in a laminar pipe",
        Axis::new("µ = π D L/Q", "").log(),
        Axis::new("penetration", "").range(0.0, 1.0),
    )
    .with(
        Series::line("Gormley & Kennedy 1949", mu.clone(), mu.iter().map(|m| gormley_kennedy(*m))).color(Color::BLACK),
    )
    .with(points("even concentration at the inlet (flux)", &MUS, &flux).color(Color::BLUE))
    .with(points("evenly over the section (uniform)", &MUS, &even).color(Color::ORANGE).marker(Marker::Cross));
    let formula: Vec<f64> = MUS.iter().map(|m| gormley_kennedy(*m)).collect();
    let columns: [(&str, &[f64]); 5] =
        [("low", &flux[0]), ("flux", &flux[1]), ("high", &flux[2]), ("formula", &formula), ("uniform", &even[1])];
    write(out, "diffusion-in-a-pipe", &plot, ("mu", "", &MUS), &columns)
}

/// Speeds of `settling-plates.toml` that give v_s L/(U h), for two profiles, and by area.
fn settling(out: &Path) -> Result<()> {
    let file = CaseFile::read("settling-plates.toml")?;
    let [_, fall] = diffusivity_and_settling(&file.case()?, 5e-6);
    let at = |share: &f64| file.clone().set("flow.mean_speed", fall * 0.1 / (2e-3 * share));
    let laminar: Vec<CaseFile> = FALLS.iter().map(at).collect();
    let plug: Vec<CaseFile> = laminar.iter().map(|c| c.clone().set("flow.profile", "plug")).collect();
    let even: Vec<CaseFile> =
        laminar.iter().map(|c| c.clone().set_each("injection", "distribution", "uniform")).collect();
    let (laminar, plug, even) = (shares(&laminar)?, shares(&plug)?, shares(&even)?);
    let plot = Plot::new(
        "Droplets of 5 µm between plates",
        Axis::new("v_s L/(U h)", "").range(0.0, 1.0),
        Axis::new("penetration", "").range(0.0, 1.0),
    )
    .with(Series::line("1 − v_s L/(U h)", [0.0, 1.0], [1.0, 0.0]).color(Color::BLACK))
    .with(points("laminar, flux", &FALLS, &laminar).color(Color::BLUE))
    .with(points("plug, flux", &FALLS, &plug).color(Color::GREEN).marker(Marker::Triangle))
    .with(points("laminar, uniform", &FALLS, &even).color(Color::ORANGE).marker(Marker::Cross));
    let formula: Vec<f64> = FALLS.iter().map(|f| 1.0 - f).collect();
    let columns: [(&str, &[f64]); 6] = [
        ("low", &laminar[0]),
        ("laminar", &laminar[1]),
        ("high", &laminar[2]),
        ("formula", &formula),
        ("plug", &plug[1]),
        ("uniform", &even[1]),
    ];
    write(out, "settling-plates", &plot, ("fall", "", &FALLS), &columns)
}

/// Sizes through `sampling-line.toml`: with both, and what each formula says alone.
fn sampling_line(out: &Path) -> Result<()> {
    const SPEED: f64 = 0.5895;
    let file = CaseFile::read("sampling-line.toml")?;
    let case = file.case()?;
    let alone = |d: f64| {
        let [diffusivity, fall] = diffusivity_and_settling(&case, d);
        [gormley_kennedy(diffusivity / (3e-3f64.powi(2) * SPEED)), fuchs(0.75 * fall / (6e-3 * SPEED))]
    };
    let sizes = logspace(1e-8, 1e-5, 19);
    let cases: Vec<CaseFile> =
        sizes.iter().map(|d| file.clone().set_each("injection", "diameter", meters(*d))).collect();
    let found = shares(&cases)?;
    let fine = logspace(1e-8, 1e-5, 200);
    let lines: Vec<[f64; 2]> = fine.iter().map(|d| alone(*d)).collect();
    let plot = Plot::new(
        "A line of 6 mm bore, 1 m long, at 1 L/min",
        Axis::scaled("diameter", "µm", 1e6).log(),
        Axis::new("penetration", "").range(0.0, 1.0),
    )
    .with(
        Series::line("diffusion (Gormley & Kennedy)", fine.clone(), lines.iter().map(|l| l[0]))
            .color(Color::GREEN)
            .dashed(),
    )
    .with(Series::line("settling (Fuchs)", fine.clone(), lines.iter().map(|l| l[1])).color(Color::VERMILION).dashed())
    .with(Series::line("product of the two", fine, lines.iter().map(|l| l[0] * l[1])).color(Color::BLACK))
    .with(points("carom run", &sizes, &found).color(Color::BLUE));
    let alone: Vec<[f64; 2]> = sizes.iter().map(|d| alone(*d)).collect();
    let [diffuses, settles] = [0, 1].map(|i| alone.iter().map(|a| a[i]).collect::<Vec<f64>>());
    let columns: [(&str, &[f64]); 5] = [
        ("low", &found[0]),
        ("share", &found[1]),
        ("high", &found[2]),
        ("gormley_kennedy", &diffuses),
        ("fuchs", &settles),
    ];
    write(out, "sampling-line", &plot, ("diameter", "m", &sizes), &columns)
}
