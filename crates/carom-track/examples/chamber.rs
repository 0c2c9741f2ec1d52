//! A ventilated chamber: the computed air and the concentration of 10 µm spheres along three vertical lines, against Chen, Yu & Lai 2006.
//!
//! `cargo run --release -p carom-track --example chamber -- OUT [svg|png] [COUNT]`

mod study;

use carom_report::plot::{Dash, Marker};
use carom_report::{Axis, Color, Column, Plot, Series, Table};
use carom_track::record::ParticleFate;
use study::{CaseFile, Paths, Result, Track, in_parallel, linspace, track};

const MEASURED: &str = include_str!("chamber-measured.csv");
const STATIONS: [f64; 3] = [0.2, 0.4, 0.6];
const COLORS: [Color; 3] = [Color::BLUE, Color::GREEN, Color::VERMILION];
/// Air through half the inlet, m³/s.
const FLOW: f64 = 0.225 * 0.04 * 0.02;
/// A box round each point, on the middle plane: half its length and height, and its depth, m.
const BOX: [f64; 3] = [0.03, 0.005, 0.03];
/// The middle plane, m.
const MIDDLE: f64 = 0.2;

/// What is counted with a walk.
struct Counted {
    label: &'static str,
    walk: &'static str,
    dash: Dash,
}

const WALKS: [Counted; 3] = [
    Counted { label: "Langevin walk", walk: "langevin", dash: Dash::Solid },
    Counted { label: "eddies", walk: "eddies", dash: Dash::Dashed },
    Counted { label: "no walk", walk: "", dash: Dash::Dotted },
];

fn main() -> Result<()> {
    let out = study::out_dir()?;
    let count = std::env::args().find_map(|a| a.parse::<i64>().ok()).unwrap_or(4000);
    let case = CaseFile::read("cfd/chamber/chamber.toml")?.set_each("injection", "count", count);
    air(&out, &case)?;
    let heights = linspace(0.01, 0.39, 39);
    let found = in_parallel(WALKS.len(), |w| {
        let case = walking(&case, WALKS[w].walk);
        concentrations(&case, &heights).map_err(|e| e.to_string())
    })?;
    let mut columns = vec![Column::float("z", "m", heights.clone())];
    for (s, station) in STATIONS.into_iter().enumerate() {
        let mut plot = Plot::new(
            format!("10 µm spheres in the chamber, x = {station} m"),
            Axis::new("concentration over the inlet's", "").range(0.0, 1.2),
            Axis::new("height", "m").range(0.0, 0.4),
        );
        for (walk, (profiles, _)) in WALKS.iter().zip(&found) {
            let profile = profiles[s].clone();
            columns.push(Column::float(format!("c_{station}_{}", walk.label.replace(' ', "_")), "", profile.clone()));
            plot = plot.with(Series::line(walk.label, profile, heights.clone()).color(COLORS[s]).dash(walk.dash));
        }
        let (z, c) = measured('c', station);
        plot.with(Series::points("measured", c, z).marker(Marker::Circle).color(Color::BLACK))
            .write(study::figure(&out, &format!("chamber-{}", (station * 1000.0).round())))?;
    }
    for (walk, (profiles, fates)) in WALKS.iter().zip(&found) {
        println!("{}: {fates}", walk.label);
        for (station, profile) in STATIONS.into_iter().zip(profiles) {
            let (z, c) = measured('c', station);
            let ours: Vec<f64> = z.iter().map(|z| at(&heights, profile, *z)).collect();
            println!("  x = {station}: z, measured, here: {}", rows(&z, &c, &ours));
        }
    }
    let table = Table::new(columns)?;
    Ok(table.write(out.join("chamber.csv"))?)
}

/// The case with a walk, or none.
fn walking(case: &CaseFile, walk: &str) -> CaseFile {
    if walk.is_empty() {
        case.clone().without("forces.random_walk")
    } else {
        case.clone().set("forces.random_walk.model", walk)
    }
}

/// The air's speed along the chamber, beside the measured.
fn air(out: &std::path::Path, case: &CaseFile) -> Result<()> {
    let case = case.case()?;
    let heights = linspace(0.001, 0.399, 200);
    let speed = |x: f64, z: f64| case.domain.fluid(0.0, [x, MIDDLE - 1e-6, z]).velocity[0];
    let mut plot = Plot::new(
        "The air in the chamber, on its middle plane",
        Axis::new("speed along the chamber", "m/s").range(-0.05, 0.25),
        Axis::new("height", "m").range(0.0, 0.4),
    );
    for (station, color) in STATIONS.into_iter().zip(COLORS) {
        let profile: Vec<f64> = heights.iter().map(|z| speed(station, *z)).collect();
        let (z, u) = measured('u', station);
        let ours: Vec<f64> = z.iter().map(|z| speed(station, *z)).collect();
        println!("air at x = {station}: z, measured, computed: {}", rows(&z, &u, &ours));
        plot = plot
            .with(Series::line(format!("x = {station} m"), profile, heights.clone()).color(color))
            .with(Series::points("", u, z).marker(Marker::Circle).color(color));
    }
    Ok(plot.write(study::figure(out, "chamber-air"))?)
}

fn rows(z: &[f64], measured: &[f64], ours: &[f64]) -> String {
    let all = z.iter().zip(measured).zip(ours);
    all.map(|((z, m), o)| format!("{z:.2} {m:.3} {o:.3}")).collect::<Vec<_>>().join("; ")
}

/// Height and value of the measured points of a quantity at a station.
fn measured(quantity: char, station: f64) -> (Vec<f64>, Vec<f64>) {
    let rows = MEASURED.lines().filter_map(|l| l.strip_prefix(quantity)?.strip_prefix(','));
    rows.filter_map(|row| {
        let mut numbers = row.split(',').map(str::parse::<f64>);
        let (x, z, value) = (numbers.next()?.ok()?, numbers.next()?.ok()?, numbers.next()?.ok()?);
        (x == station).then_some((z, value))
    })
    .unzip()
}

/// A profile at a height.
fn at(heights: &[f64], profile: &[f64], z: f64) -> f64 {
    let step = (heights[1] - heights[0]).recip();
    let place = ((z - heights[0]) * step).clamp(0.0, (heights.len() - 1) as f64 - 1e-9);
    let i = place as usize;
    profile[i] + (profile[i + 1] - profile[i]) * (place - i as f64)
}

/// Concentrations over the inlet's at the stations and heights, and what became of the spheres. In a steady cloud a box holds as many
/// as enter in the time that one spends in it.
fn concentrations(case: &CaseFile, heights: &[f64]) -> Result<(Vec<Vec<f64>>, String)> {
    let case = case.case()?;
    let tracks = track(&case, Paths::Kept);
    let mut profiles = vec![vec![0.0; heights.len()]; STATIONS.len()];
    for track in &tracks {
        add(track, heights, &mut profiles);
    }
    let volume = 4.0 * BOX[0] * BOX[1] * BOX[2];
    let scale = FLOW / (volume * tracks.len() as f64);
    profiles.iter_mut().flatten().for_each(|c| *c *= scale);
    let of = |wall: &str| {
        let index = case.domain.walls().iter().position(|w| w.name == wall);
        tracks.iter().filter(|t| index.is_some() && t.end.wall == index).count() as f64 / tracks.len() as f64 * 100.0
    };
    let walls = ["floor", "ceiling", "side", "ends", "outlet"].map(|w| format!("{w} {:.1} %", of(w)));
    let airborne = tracks.iter().filter(|t| t.end.fate == ParticleFate::Airborne).count();
    Ok((profiles, format!("{}; {airborne} of {} still airborne", walls.join(", "), tracks.len())))
}

/// Adds the time that a sphere spends in each box: its path between recorded points, in short pieces.
fn add(track: &Track, heights: &[f64], profiles: &mut [Vec<f64>]) {
    let spacing = heights[1] - heights[0];
    for pair in track.path.windows(2) {
        let [[t0, a @ ..], [t1, b @ ..]] = [pair[0], pair[1]];
        let length = (0..3).map(|c| (b[c] - a[c]).powi(2)).sum::<f64>().sqrt();
        let pieces = (length / 0.002).ceil().max(1.0);
        for i in 0..pieces as usize {
            let f = (i as f64 + 0.5) / pieces;
            let x = [0, 1, 2].map(|c| a[c] + f * (b[c] - a[c]));
            if x[1] < MIDDLE - BOX[2] {
                continue;
            }
            let Some(s) = STATIONS.iter().position(|s| (x[0] - s).abs() < BOX[0]) else { continue };
            let near = ((x[2] - heights[0]) / spacing).round();
            if near >= 0.0 && (near as usize) < heights.len() && (x[2] - heights[near as usize]).abs() < BOX[1] {
                profiles[s][near as usize] += (t1 - t0) / pieces;
            }
        }
    }
}
