//! The capture velocity where values are distributions: its median and band, and the probability of sticking.

use super::Args;
use crate::failure::{Failure, say};
use crate::grid::{Grid, Swept};
use crate::law::Law;
use crate::motion::ImpactArgs;
use crate::output::{self, Files};
use crate::samples::note;
use crate::study::{Figure, NOTHING, Study, band_columns, fits, is_drawn};
use crate::sweep;
use crate::text::{Lines, percent, quantity, scaled};
use carom::study::{Band, Given, Sampling};
use carom_report::plot::Reference;
use carom_report::{Axis, Column, Plot};

/// Capture velocities of the samples at some diameters.
struct Velocities {
    bands: Vec<Band>,
    /// Share of spheres that no speed lets rebound.
    never: Vec<f64>,
    law: Law,
}

impl Velocities {
    /// `at` puts the points in; without them the diameter is the flags' own.
    fn new(case: &ImpactArgs, points: Option<&[f64]>, sampling: &Sampling) -> Result<Self, Failure> {
        if !is_drawn(case) {
            return Err(Failure::input(NOTHING));
        }
        let population = case.law.population(false)?;
        let law = population.middle()?;
        let varies = case.law.drawn().next().is_some();
        let count = points.map_or(1, <[f64]>::len);
        let mut values = vec![Vec::with_capacity(sampling.samples as usize); count];
        for sample in 0..sampling.samples {
            let drawn = varies.then(|| population.law(|flag| sampling.draw(sample, flag))).transpose()?;
            let wall = drawn.as_ref().unwrap_or(&law.wall);
            for (n, values) in values.iter_mut().enumerate() {
                let diameter = match points {
                    Some(points) => points[n],
                    None => case.motion.wanted_diameters()?.at(sampling.draw(sample, 0)),
                };
                let refused = |e| Failure::input(format!("--diameter {}: {e}", scaled(diameter, "m")));
                let window = wall.window(diameter, None).map_err(refused)?;
                values.push(window.map_or(f64::INFINITY, |w| w.capture_velocity));
            }
        }
        let never = |v: &Vec<f64>| v.iter().filter(|v| v.is_infinite()).count() as f64 / v.len() as f64;
        let never = values.iter().map(never).collect();
        Ok(Self { bands: values.iter_mut().map(Band::of).collect(), never, law })
    }
}

#[derive(serde::Serialize)]
struct Answer {
    diameter: String,
    law: String,
    samples: u32,
    seed: u64,
    capture_velocity: Quantiles,
    never_rebounds: f64,
}

#[derive(serde::Serialize)]
struct Quantiles {
    median: f64,
    p05: f64,
    p95: f64,
}

/// One case.
pub fn one(args: &Args, case: &ImpactArgs, sampling: &Sampling) -> Result<(), Failure> {
    if args.removal.wanted() {
        return Err(Failure::input("--removal answers for one sphere; leave it out, or the distributions"));
    }
    let velocities = Velocities::new(case, None, sampling)?;
    let (band, never) = (velocities.bands[0], velocities.never[0]);
    let diameter = match case.motion.wanted_diameters()? {
        Given::One(d) => scaled(*d, "m"),
        Given::Drawn(d) => d.to_string(),
    };
    if args.grid.json() {
        return output::print_json(&Answer {
            diameter,
            law: velocities.law.normal_name(),
            samples: sampling.samples,
            seed: sampling.seed,
            capture_velocity: Quantiles { median: band.median, p05: band.low, p95: band.high },
            never_rebounds: never,
        });
    }
    let mut lines = Lines::default();
    let speed = |v: f64| if v.is_finite() { quantity(v, "m/s") } else { "none".to_owned() };
    lines.add("capture velocity", format!("median {}", speed(band.median)));
    lines.add("5 to 95 %", format!("{} to {}", speed(band.low), speed(band.high)));
    if never > 0.0 {
        lines.add("never rebound", percent(never));
    }
    lines.add("from", note(sampling, std::iter::once(case)));
    output::print(&format!("{diameter} {}\n\n{lines}", velocities.law.description()))
}

/// Over the diameter, the capture velocity's band; over the speed, the probability of sticking head-on.
pub fn curves(grid: &Grid, files: &Files, sampling: &Sampling) -> Result<(), Failure> {
    fits(grid, sampling)?;
    say(&note(sampling, grid.curves.iter().map(|c| &c.args)));
    if grid.quantity() == Swept::Speed {
        over_speed(grid, files, sampling)
    } else {
        over_diameter(grid, files, sampling)
    }
}

fn over_diameter(grid: &Grid, files: &Files, sampling: &Sampling) -> Result<(), Failure> {
    let (mut bands, mut never, mut laws) = (Vec::new(), Vec::new(), Vec::new());
    for curve in &grid.curves {
        let velocities = Velocities::new(&curve.args, Some(&grid.points), sampling)?;
        bands.extend(velocities.bands);
        never.extend(velocities.never);
        laws.push(velocities.law);
    }
    let table = || {
        let never = Column::float("never_rebounds", "", never.iter().copied());
        grid.table(band_columns("capture_velocity", "m/s", &bands).into_iter().chain([never]).collect())
    };
    grid.show(files, table, table, || {
        let title = sweep::title(grid, &laws);
        // beyond every speed is beyond the plot
        let shown = |v: f64| if v.is_finite() { v } else { f64::NAN };
        let rows: Vec<_> = bands.iter().map(|b| (shown(b.median), shown(b.low), shown(b.high))).collect();
        let plot = Plot::new(title, grid.axis(), Axis::new("capture velocity", "m/s").log());
        grid.draw_bands(plot, &rows, ["median", "5–95 %"])
    })
}

fn over_speed(grid: &Grid, files: &Files, sampling: &Sampling) -> Result<(), Failure> {
    let study = Study::new(grid, sampling)?;
    let table = || {
        let bands = study.band_columns(Figure::Restitution);
        grid.table(study.sticking_columns().into_iter().chain(bands).collect())
    };
    let references = references(grid, sampling)?;
    grid.show(files, table, table, || {
        let title = sweep::title(grid, &study.laws);
        let rows: Vec<_> = study.sticking.iter().map(|s| (s.value, s.low, s.high)).collect();
        let plot = Plot::new(title, grid.axis(), Axis::new("sticking probability", "").range(0.0, 1.0));
        let plot = grid.draw_bands(plot, &rows, ["probability", "95 % confidence"]);
        references.into_iter().fold(plot, Plot::reference)
    })
}

/// Median and band of the capture velocity of a single curve.
fn references(grid: &Grid, sampling: &Sampling) -> Result<Vec<Reference>, Failure> {
    let [curve] = &grid.curves[..] else { return Ok(Vec::new()) };
    if !is_drawn(&curve.args) {
        return Ok(Vec::new());
    }
    let band = Velocities::new(&curve.args, None, sampling)?.bands[0];
    let (from, to) = (grid.points[0], grid.points[grid.points.len() - 1]);
    let lines = [(band.low, "5 % of capture velocities"), (band.median, "median"), (band.high, "95 %")];
    let within = lines.into_iter().filter(|(v, _)| (from..=to).contains(v));
    Ok(within.map(|(v, label)| Reference::vertical(v, label)).collect())
}
