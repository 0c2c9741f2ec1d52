//! Kim & Dunn's wind tunnel: contact at the surface or at the centre, and what the number of bounces hangs on.
//!
//! `cargo run --release -p carom-track --example wind_tunnel -- OUT`

mod study;

use carom::material::Library;
use carom_report::{Axis, Color, Column, HeatMap, Plot, Series, Table};
use std::path::Path;
use study::{CaseFile, Paths, Result, linspace, logspace, meters, track};

/// Diameters as the case file names them, and the bounces that the paper saw.
const SPHERES: [(&str, f64, usize); 2] = [("90 um", 90e-6, 2), ("61 um", 61e-6, 0)];
const TUNNEL: f64 = 56e-3;
/// Glass as the case file takes it, J/m².
const GLASS: f64 = 0.315;
/// More bounces than these share a colour.
const MOST: usize = 8;

fn main() -> Result<()> {
    let out = study::out_dir()?;
    trajectories(&out)?;
    sensitivity(&out)?;
    agreement(&out)
}

/// Figs 11a and 11b: the same spheres, touching the wall with their surface or with their centre.
fn trajectories(out: &Path) -> Result<()> {
    let case = CaseFile::read("wind-tunnel.toml")?;
    let contacts = [("contact at the surface", "surface"), ("contact at the centre", "center")];
    let runs = contacts.map(|(_, at)| Ok(track(&case.clone().set_each("wall", "contact_at", at).case()?, Paths::Kept)));
    let runs: Vec<_> = runs.into_iter().collect::<Result<_>>()?;
    let mut rows = Vec::new();
    for (s, (name, diameter, _)) in SPHERES.iter().enumerate() {
        let title = format!("Copper, {:.0} µm, on glass: near the floor", diameter * 1e6);
        let (x, y) = (
            Axis::scaled("x, downstream of the dispenser", "cm", 100.0),
            Axis::scaled("height of the centre", "mm", 1e3),
        );
        let (first, last) =
            (&runs[0][s].impacts[0], runs.iter().filter_map(|r| r[s].impacts.last()).map(|i| i.position[0]));
        let from = first.position[0] - 0.01;
        let to = last.fold(first.position[0], f64::max) + 0.01;
        let mut plot = Plot::new(title, x.range(from, to), y.range(0.0, 5e-3)).wall([from, 0.0], [to, 0.0]);
        for (run, (label, at)) in runs.iter().zip(contacts) {
            let track = &run[s];
            let line = Series::line(label, track.path.iter().map(|p| p[1]), track.path.iter().map(|p| p[2]));
            plot = plot.with(if at == "center" { line.dashed() } else { line });
            for (n, i) in track.impacts.iter().enumerate() {
                rows.push((format!("{name}, {at}"), n as u64 + 1, *i));
            }
        }
        plot.write(study::figure(out, &format!("wind-tunnel-{}", name.replace(' ', ""))))?;
    }
    let table = Table::new([
        Column::text("sphere", rows.iter().map(|r| r.0.clone())),
        Column::count("impact", rows.iter().map(|r| r.1)),
        Column::float("x", "m", rows.iter().map(|r| r.2.position[0])),
        Column::float("normal_speed_in", "m/s", rows.iter().map(|r| r.2.normal_speed_in)),
        Column::float("tangential_speed_in", "m/s", rows.iter().map(|r| r.2.tangential_speed_in)),
        Column::float("restitution", "", rows.iter().map(|r| r.2.restitution)),
    ])?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("wind-tunnel-impacts.csv"))?)
}

/// Bounces of each sphere released at each height: `[sphere][height]`.
fn bounces(case: &CaseFile, heights: &[f64], surface_energy: f64) -> Result<[Vec<usize>; 2]> {
    let copper = Library::builtin().get("copper")?.surface_energy.ok_or("copper has no surface energy")?;
    let work = 2.0 * (copper * surface_energy).sqrt();
    let mut counts = [Vec::new(), Vec::new()];
    for height in heights {
        let mut case = case.clone().set("law.glass.work_of_adhesion", work);
        for (injection, (_, diameter, _)) in case.list("injection").into_iter().zip(SPHERES) {
            // the case file's own release is at the top, one radius below the ceiling
            let y = height.min(TUNNEL - 0.5 * diameter);
            injection.insert("position".into(), vec!["0 m".to_owned(), meters(y), "0 m".to_owned()].into());
        }
        for (count, track) in counts.iter_mut().zip(track(&case.case()?, Paths::Dropped)) {
            count.push(track.bounces());
        }
    }
    Ok(counts)
}

/// Bounces before capture over release height and the glass's surface energy.
fn sensitivity(out: &Path) -> Result<()> {
    let case = CaseFile::read("wind-tunnel.toml")?;
    let (energies, heights) = (logspace(0.02, 20.0, 37), linspace(0.0, TUNNEL, 29));
    let middle = |e: &[f64]| e.windows(2).map(|e| (e[0] * e[1]).sqrt()).collect::<Vec<_>>();
    let mut columns: [Vec<Vec<usize>>; 2] = Default::default();
    let levels: Vec<f64> = heights.windows(2).map(|h| 0.5 * (h[0] + h[1])).collect();
    for energy in middle(&energies) {
        for (columns, counts) in columns.iter_mut().zip(bounces(&case, &levels, energy)?) {
            columns.push(counts);
        }
    }
    for ((name, diameter, seen), columns) in SPHERES.iter().zip(&columns) {
        let title = format!("Copper, {:.0} µm: bounces before capture (seen: {seen})", diameter * 1e6);
        let cells = (0..levels.len()).flat_map(|h| columns.iter().map(move |c| c[h].min(MOST) as f64));
        let (x, y) =
            (Axis::new("surface energy of the glass", "J/m²").log(), Axis::scaled("release height", "mm", 1e3));
        HeatMap::new(title, x, y, Axis::new(format!("bounces ({MOST}: or more)"), "").range(0.0, MOST as f64))
            .cells(energies.iter().copied(), heights.iter().copied(), cells)
            .write(study::figure(out, &format!("wind-tunnel-bounces-{}", name.replace(' ', ""))))?;
    }
    Ok(())
}

/// The surface energy from which on a sphere released there bounces at most `most` times, by bisection.
fn limit(case: &CaseFile, sphere: usize, height: f64, most: usize) -> Result<f64> {
    let (mut low, mut high) = (1e-3f64, 100.0f64);
    while high / low > 1.002 {
        let middle = (low * high).sqrt();
        if bounces(case, &[height], middle)?[sphere][0] <= most { high = middle } else { low = middle }
    }
    Ok((low * high).sqrt())
}

/// Where each sphere bounces as often as it did in the paper, and whether one glass does for both.
fn agreement(out: &Path) -> Result<()> {
    let case = CaseFile::read("wind-tunnel.toml")?;
    // closer together near the floor, where they matter more
    let heights: Vec<f64> = linspace(0.1, 1.0, 24).iter().map(|s| TUNNEL * s * s).collect();
    let each = |sphere, most| heights.iter().map(|h| limit(&case, sphere, *h, most)).collect::<Result<Vec<_>>>();
    let (two, one, none) = (each(0, 2)?, each(0, 1)?, each(1, 0)?);
    let top = heights.iter().map(|_| 20.0);
    Plot::new(
        "Where copper bounces as the paper saw",
        Axis::scaled("release height", "mm", 1e3),
        Axis::new("surface energy of the glass", "J/m²").log().range(0.1, 20.0),
    )
    .with(Series::band("61 µm: no bounce", heights.clone(), none.clone(), top).color(Color::SKY))
    .with(Series::band("90 µm: two bounces", heights.clone(), two.clone(), one.clone()).color(Color::VERMILION))
    .reference(carom_report::plot::Reference::horizontal(GLASS, "soda-lime glass, dry, 0.315"))
    .write(study::figure(out, "wind-tunnel-agreement"))?;
    let table = Table::new([
        Column::float("release_height", "m", heights),
        Column::float("two_bounces_from_90um", "J/m2", two),
        Column::float("two_bounces_to_90um", "J/m2", one),
        Column::float("no_bounce_from_61um", "J/m2", none),
    ])?;
    println!("{}", table.to_text());
    Ok(table.write(out.join("wind-tunnel-agreement.csv"))?)
}
