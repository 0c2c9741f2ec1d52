//! `report.html`: what a run came to, in one file that asks for nothing else.
//!
//! Made from the files of the finished run, so that a merged run's is the whole run's, to the bit.

mod bins;
mod faces;
mod figures;
mod made;
mod tally;
mod what;

use crate::failure::Failure;
use crate::trajectories;
use carom::validity::CODES;
use carom_report::{Column, Report, Table, significant};
use carom_track::record::ParticleFate;
use carom_track::{About, Summary};
pub use made::Made;
use std::path::Path;
use tally::{Ends, Impacts, MECHANISMS};

/// The file's name.
pub const FILE: &str = "report.html";
const PICTURE: &str = "trajectories.svg";

/// What is made of a finished run besides its tables: the picture of its paths and, if wanted, the report.
pub fn write(about: &About, summary: &Summary, folder: &Path, report: Option<&Made>) -> Result<(), Failure> {
    let picture = trajectories::picture(about, folder)?;
    match &picture {
        Some((plot, _)) => plot.write(folder.join(PICTURE))?,
        None => clear(folder, PICTURE),
    }
    let Some(made) = report else {
        clear(folder, FILE);
        return Ok(());
    };
    let title = if about.title.is_empty() { "A run of carom" } else { &about.title };
    let mut page = Report::new(title);
    page.made(&made.to_string());
    what::section(&mut page, about)?;
    fates(&mut page, summary)?;
    if let Some((mut plot, caption)) = picture {
        plot.title.clear();
        page.section("Paths").figure(&plot.svg()?, &caption);
    }
    // the two tables are large and know nothing of each other
    let (ends, impacts) = std::thread::scope(|scope| {
        let ends = scope.spawn(|| tally::ends(folder, about, summary));
        let impacts = tally::impacts(folder, about, summary);
        (ends.join(), impacts)
    });
    match ends.map_err(|_| Failure::Other("the table of fates could not be read".to_owned()))?? {
        Some(ends) => deposits(&mut page, &ends, summary)?,
        None => {
            page.section("Deposit").paragraph("Not shown: the case has fates = false.");
        }
    }
    faces::section(&mut page, summary, folder)?;
    match impacts? {
        Some(impacts) => {
            distributions(&mut page, &impacts, summary)?;
            energy(&mut page, &impacts, summary);
        }
        None => {
            page.section("Impacts").paragraph("Not shown: the case has impacts = false.");
        }
    }
    page.section("The case file").preformatted(&about.text);
    Ok(page.write(folder.join(FILE))?)
}

/// Takes away what an earlier run left; what is not there needs no taking away.
fn clear(folder: &Path, name: &str) {
    let _ = std::fs::remove_file(folder.join(name));
}

fn fates(page: &mut Report, summary: &Summary) -> Result<(), Failure> {
    let all = summary.injected.count as f64;
    let mass = summary.injected.mass.value();
    let rows: Vec<ParticleFate> = ParticleFate::ALL.into_iter().filter(|f| summary.count(*f) > 0).collect();
    let masses = rows.iter().map(|f| summary.fates[*f as usize].mass.value());
    let table = Table::new([
        Column::text("fate", rows.iter().map(|f| f.name()).chain(["injected"])),
        Column::count("particles", rows.iter().map(|f| summary.count(*f)).chain([summary.injected.count])),
        Column::float(
            "share",
            "%",
            rows.iter().map(|f| rounded(100.0 * summary.count(*f) as f64 / all)).chain([100.0]),
        ),
        Column::float("mass", "kg", masses.clone().chain([mass])),
        Column::float("share of mass", "%", masses.map(|m| rounded(100.0 * m / mass)).chain([100.0])),
    ])?;
    page.section("Fates").table(&table, "How the particles ended, and the mass they stand for.");
    if summary.strayed > 0 {
        let went =
            format!("{} went outside the table of the flow, where the values of its boundary hold.", summary.strayed);
        page.paragraph(&went);
    }
    if summary.stalled > 0 {
        page.paragraph(&format!("{} of the airborne were left where their steps ran out.", summary.stalled));
    }
    let walls = &summary.walls;
    if walls.is_empty() {
        return Ok(());
    }
    let mut columns = vec![
        Column::text("wall", walls.iter().map(|w| w.name.as_str())),
        Column::count("impacts", walls.iter().map(|w| w.impacts)),
        Column::count("rebounds", walls.iter().map(|w| w.rebounds)),
    ];
    // two tables: counts and masses side by side are wider than a page
    let mut amounts = vec![Column::text("wall", walls.iter().map(|w| w.name.as_str()))];
    let at_walls = |f: &ParticleFate| walls.iter().any(|w| w.ends[*f as usize].count > 0);
    for fate in rows.into_iter().filter(at_walls) {
        columns.push(Column::count(fate.name(), walls.iter().map(|w| w.ends[fate as usize].count)));
        let masses = walls.iter().map(|w| w.ends[fate as usize].mass.value());
        amounts.push(Column::float(fate.name(), "kg", masses));
    }
    page.table(&Table::new(columns)?, "What happened at each wall.");
    if amounts.len() > 1 {
        page.table(&Table::new(amounts)?, "The mass that ended at each wall.");
    }
    doubts(page, summary)
}

/// What to mind about the laws' answers.
fn doubts(page: &mut Report, summary: &Summary) -> Result<(), Failure> {
    let found: Vec<_> = summary
        .walls
        .iter()
        .flat_map(|w| {
            CODES.iter().zip(w.doubts).map(move |((code, _, meaning), n)| (*code, w.name.as_str(), n, *meaning))
        })
        .filter(|(_, _, impacts, _)| *impacts > 0)
        .collect();
    if found.is_empty() {
        return Ok(());
    }
    let columns = [
        Column::text("code", found.iter().map(|f| f.0)),
        Column::text("wall", found.iter().map(|f| f.1)),
        Column::count("impacts", found.iter().map(|f| f.2)),
        Column::text("which means", found.iter().map(|f| f.3)),
    ];
    page.table(&Table::new(columns)?, "Doubts: impacts that asked a wall's law for more than it is good for.");
    Ok(())
}

/// Says of how many rows a section was made, where not of all.
fn say_sample(page: &mut Report, rows: u64, one_in: u64, of: u64, what: &str, whole: &str) {
    if one_in > 1 {
        page.paragraph(&format!("From a random sample of {rows} of the {of} {what}. {whole}"));
    }
}

/// A percentage to a hundredth.
fn rounded(percent: f64) -> f64 {
    (100.0 * percent).round() / 100.0
}

/// The first few walls of which something holds, and how many more there are.
fn some_walls(summary: &Summary, holds: impl Fn(usize) -> bool) -> (Vec<usize>, usize) {
    let mut walls: Vec<usize> = (0..summary.walls.len()).filter(|w| holds(*w)).collect();
    let more = walls.len().saturating_sub(figures::TOGETHER);
    walls.truncate(figures::TOGETHER);
    (walls, more)
}

fn say_more(page: &mut Report, more: usize) {
    if more > 0 {
        page.paragraph(&format!("{more} more walls are not shown: a figure holds {}.", figures::TOGETHER));
    }
}

fn deposits(page: &mut Report, ends: &Ends, summary: &Summary) -> Result<(), Failure> {
    let (walls, more) = some_walls(summary, |w| ends.sizes.iter().any(|s| s.kept[w] > 0));
    page.section("Deposit");
    if walls.is_empty() {
        page.paragraph("No wall kept a particle.");
    }
    say_sample(page, ends.rows, ends.one_in, summary.injected.count, "particles", "deposition.csv counts them all.");
    for wall in &walls {
        if let Some((plot, axis)) = figures::deposit(ends, *wall) {
            let name = &summary.walls[*wall].name;
            page.subsection(name)
                .figure(&plot.svg()?, &format!("Mass kept by {name} along {axis}, where it lies widest."));
            if let Some((map, [across, up])) = figures::map(ends, *wall) {
                let seen = format!("Where {name} kept mass, over {across} and {up}; deposit.vtp has it face by face.");
                page.figure(&map.svg()?, &seen);
            }
        }
    }
    if let Some(plot) = figures::efficiency(&ends.sizes, summary, &walls) {
        page.subsection("By size").figure(
            &plot.svg()?,
            "Share of the particles injected in each size bin that a wall kept, with 95 % confidence (Wilson 1927), at the \
             mean diameter of the bin.",
        );
    }
    say_more(page, more);
    Ok(())
}

fn distributions(page: &mut Report, impacts: &Impacts, summary: &Summary) -> Result<(), Failure> {
    page.section("Impacts");
    let (walls, more) = some_walls(summary, |w| impacts.walls[w].impacts > 0.0);
    if walls.is_empty() {
        page.paragraph("No particle met a wall that bounces or keeps it.");
        return Ok(());
    }
    let all = summary.walls.iter().map(|w| w.impacts).sum();
    say_sample(page, impacts.rows, impacts.one_in, all, "impacts", "The shares of energy below are from it too.");
    for (plot, caption) in figures::distributions(impacts, summary, &walls) {
        page.figure(&plot.svg()?, caption);
    }
    say_more(page, more);
    Ok(())
}

fn energy(page: &mut Report, impacts: &Impacts, summary: &Summary) {
    let mut begun = false;
    for (wall, tally) in summary.walls.iter().zip(&impacts.walls) {
        let total: f64 = tally.energy.iter().sum();
        if total.is_nan() || total <= 0.0 {
            continue;
        }
        if !begun {
            page.section("Energy").paragraph(
                "Where the kinetic energy of the impacts went: each impact counts with its energy relative to the wall, \
                 translation and spin, and a parcel with all its particles. A sphere that bounces many times counts many times, so \
                 that most of the energy may seem kept where every sphere is slow in the end.",
            );
            begun = true;
        }
        let rows = MECHANISMS.iter().zip(tally.energy).filter(|(_, energy)| *energy > 0.0);
        // a sample's energy stands for that of all
        let joules = |energy: f64| {
            let all = energy * impacts.one_in.max(1) as f64;
            format!("{} J", significant(all, if impacts.one_in > 1 { 3 } else { 4 }))
        };
        let rows: Vec<_> =
            rows.map(|(name, energy)| (name.replace('_', " "), energy / total, joules(energy))).collect();
        page.shares(rows.iter().map(|(name, share, amount)| (name.as_str(), *share, amount.clone())), &wall.name);
    }
}
