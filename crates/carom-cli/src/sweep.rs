//! `carom sweep`: impacts along a range of speeds, diameters, angles or numbers of the law, as a table and a plot; along two, a map.

mod map;
mod measured;

use crate::failure::{Failure, say};
use crate::grid::{Curve, Grid, GridArgs, Over, Swept};
use crate::law::Law;
use crate::motion::{ImpactArgs, Met, Motion, refused};
use crate::output::Files;
use crate::samples::{SampleArgs, note};
use crate::study::{Figure, NOTHING, Study, drawn, is_drawn};
use crate::text::{number, plotted, quantity};
use carom::study::Given;
use carom::study::Sampling;
use carom_report::plot::Reference;
use carom_report::{Axis, Column, Plot, Series, Table};
use std::path::PathBuf;

const EXAMPLE: &str = "\
Examples:
  carom sweep --sphere copper --surface silicon --diameter 90um --over speed=0.01..30 --plot e.svg
  carom sweep --sphere copper --surface silicon --over speed=0.01..30 --by diameter=10,90um --out e.csv
  carom sweep --sphere copper --surface silicon --diameter 90um --over speed=0.1..30 --by law=ea,resolved
  carom sweep --wall-law walls.toml:glass --diameter 90um --speed 2 --over angle=5..90 \
    --quantity impulse-ratio --plot impulse.png
  carom sweep --sphere copper --surface silicon --law eap --over speed=0.1..30 --over diameter=1..100um --plot map.svg
  carom sweep --wall-law walls.toml:glass --diameter 90um --over speed=0.1..30 --data points.csv --plot e.svg
  carom sweep --sphere copper --surface silicon --diameter 90um --speed 2 --angle 30 --over friction=0..0.5
  carom sweep --sphere copper --surface silicon --diameter 'lognormal(50um, 1.3)' \
    --roughness-factor 'normal(0.8, 0.1)' --over speed=0.01..1 --plot bands.svg

A value may be lognormal(MEDIAN, GSD), normal(MEAN, DEVIATION) or uniform(FROM, TO): the table then has the
probability of sticking and the median and 5-95 % of each figure. So it has where --samples is given and the wall
scatters (--roughness-angle).

The table goes to standard output unless a file is asked for with --out or --plot.";

/// Compute impacts over a range of speeds, diameters, angles or numbers of the law: a table, plot or map
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    #[command(flatten)]
    case: ImpactArgs,
    /// What to vary: a range (speed=0.1m/s..30m/s, diameter=1um..100um, angle=5..90, friction=0..0.5) or a list
    /// (speed=1,2,5m/s) of any number of the impact or the law
    ///
    /// Given twice it is a map: the regions of capture, rebound and rebound with yield.
    #[arg(long, value_name = "RANGE", required = true, help_heading = "Sweep")]
    over: Vec<Over>,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    samples: SampleArgs,
    /// Measured points (a CSV file as `carom fit` reads it) to draw over the curves
    #[arg(long, value_name = "FILE", requires = "plot", help_heading = "Output")]
    data: Option<PathBuf>,
    /// What the plot shows
    #[arg(long, value_enum, default_value_t = Shown::Restitution, help_heading = "Output")]
    quantity: Shown,
}

/// What a plot can show.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    Restitution,
    ReboundSpeed,
    ImpulseRatio,
    TangentialRestitution,
    AngleOut,
    StickingProbability,
}

impl Shown {
    /// The figure of an impact; none for what only many impacts have.
    fn figure(self) -> Option<Figure> {
        match self {
            Self::Restitution => Some(Figure::Restitution),
            Self::ReboundSpeed => Some(Figure::ReboundSpeed),
            Self::ImpulseRatio => Some(Figure::ImpulseRatio),
            Self::TangentialRestitution => Some(Figure::TangentialRestitution),
            Self::AngleOut => Some(Figure::AngleOut),
            Self::StickingProbability => None,
        }
    }

    /// The vertical axis for values up to `most`.
    fn axis(self, most: f64) -> Axis {
        match self {
            // off a wall that scatters, shallow rebounds are faster than they came in
            Self::Restitution if most > 1.0 => Axis::new("restitution", ""),
            Self::Restitution => Axis::new("restitution", "").range(0.0, 1.0),
            Self::ReboundSpeed => Axis::new("rebound speed", "m/s"),
            Self::ImpulseRatio => Axis::new("impulse ratio", ""),
            Self::TangentialRestitution => Axis::new("tangential restitution", ""),
            Self::AngleOut => Axis::new("angle of rebound from the surface", "°"),
            Self::StickingProbability => Axis::new("sticking probability", "").range(0.0, 1.0),
        }
    }
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    let files = args.grid.files()?;
    let over = match &args.over[..] {
        [over] => over,
        [across, up] => return map::run(args, across, up),
        _ => return Err(Failure::input("--over makes a curve, twice a map; --by adds more")),
    };
    let grid = args.grid.grid(over, &args.case)?;
    let measured = args.data.as_ref().map(|path| measured::read(path, args, &grid)).transpose()?.unwrap_or_default();
    if let Some(sampling) = args.samples.sampling(grid.curves.iter().any(|c| is_drawn(&c.args))) {
        if let Swept::Law(_) = grid.quantity() {
            let flag = grid.quantity().flag();
            let message = format!(
                "--over {flag}: where values are distributions, speed, diameter or angle runs; --by {flag}=... makes curves of it"
            );
            return Err(Failure::input(message));
        }
        return sampled(args, &grid, &files, &sampling, &measured);
    }
    let Some(shown) = args.quantity.figure() else {
        return Err(Failure::input(format!("--quantity sticking-probability: one impact has none. {NOTHING}")));
    };
    let (mut laws, mut met) = (Vec::with_capacity(grid.curves.len()), Vec::new());
    for curve in &grid.curves {
        let along = curve.laws(&grid)?;
        met.extend(impacts(&grid, curve, &along)?.into_iter().map(|(met, _)| met));
        laws.extend(along.into_iter().next());
    }
    let oblique = grid.curves.iter().any(|c| grid.is_oblique(c));
    grid.show(
        &files,
        || whole(&grid, &met),
        || short(&grid, &met, oblique),
        || measured::over(plot(&grid, &met, &laws, args.quantity, shown), &measured),
    )
}

/// What comes of each point of a curve, and its motion.
fn impacts(grid: &Grid, curve: &Curve, along: &[Law]) -> Result<Vec<(Met, Motion)>, Failure> {
    let laws = along.iter().chain(along.last().into_iter().cycle());
    let at = |(point, law): (&f64, &Law)| {
        let motion = curve.at(grid.quantity(), *point).complete()?;
        Ok((motion.meet(&law.wall).map_err(|e| refused(e, &motion))?, motion))
    };
    grid.points.iter().zip(laws).map(at).collect()
}

fn float(name: &str, unit: &str, met: &[Met], get: impl Fn(&Met) -> f64) -> Column {
    Column::float(name, unit, met.iter().map(get))
}

fn head_on(met: &[Met]) -> Vec<Column> {
    vec![
        Column::text("fate", met.iter().map(|m| m.outcome.fate.name())),
        float("restitution", "", met, |m| m.outcome.restitution),
        float("normal_speed_out", "m/s", met, |m| m.normal),
    ]
}

fn sideways(met: &[Met]) -> Vec<Column> {
    vec![
        float("tangential_speed_out", "m/s", met, |m| m.tangential),
        float("spin_out", "rad/s", met, |m| m.spin),
        float("angle_out_deg", "", met, Met::angle),
        float("impulse_ratio", "", met, |m| m.outcome.impulse_ratio),
        float("tangential_restitution", "", met, |m| m.outcome.tangential_restitution),
        Column::text("contact", met.iter().map(|m| m.outcome.contact.name())),
    ]
}

fn doubts(met: &[Met]) -> Column {
    Column::text("validity", met.iter().map(|m| m.outcome.validity.codes().collect::<Vec<_>>().join(" ")))
}

/// Every column, for files: the same whatever is swept.
fn whole(grid: &Grid, met: &[Met]) -> Result<Table, Failure> {
    let mut columns = head_on(met);
    columns.extend(sideways(met));
    let names = carom::Energy::default().named().map(|(name, _)| name);
    for (n, name) in names.into_iter().enumerate() {
        columns.push(float(&format!("energy_{name}"), "", met, |m| m.outcome.energy.named()[n].1));
    }
    columns.push(doubts(met));
    grid.table(columns)
}

/// The columns that say something, for the terminal.
fn short(grid: &Grid, met: &[Met], oblique: bool) -> Result<Table, Failure> {
    let mut columns = head_on(met);
    if oblique {
        columns.extend(sideways(met));
    }
    if met.iter().any(|m| !m.outcome.validity.is_empty()) {
        columns.push(doubts(met));
    }
    grid.table(columns)
}

fn plot(grid: &Grid, met: &[Met], laws: &[Law], shown: Shown, figure: Figure) -> Plot {
    let values: Vec<f64> = met.iter().map(|m| figure.of(m)).collect();
    let axis = shown.axis(values.iter().copied().fold(0.0, f64::max));
    let plot = grid.draw_with(Plot::new(title(grid, laws), grid.axis(), axis), &values, &turns(grid, laws, figure));
    references(grid, laws, shown).into_iter().fold(plot, Plot::reference)
}

/// Where values are distributions or the wall scatters: probabilities and bands.
fn sampled(args: &Args, grid: &Grid, files: &Files, sampling: &Sampling, measured: &[Series]) -> Result<(), Failure> {
    let study = Study::new(grid, sampling)?;
    let table = |figures: &[Figure]| {
        let bands = figures.iter().flat_map(|f| study.band_columns(*f));
        grid.table(study.sticking_columns().into_iter().chain(bands).collect())
    };
    let oblique = grid.curves.iter().any(|c| grid.is_oblique(c));
    let told: &[Figure] = if oblique { &[Figure::Restitution, Figure::AngleOut] } else { &[Figure::Restitution] };
    say(&note(sampling, grid.curves.iter().map(|c| &c.args)));
    grid.show(
        files,
        || table(&Figure::ALL),
        || table(told),
        || measured::over(sampled_plot(grid, &study, args.quantity), measured),
    )
}

fn sampled_plot(grid: &Grid, study: &Study, shown: Shown) -> Plot {
    let rows: Vec<(f64, f64, f64)> = match shown.figure() {
        Some(figure) => study.bands(figure).iter().map(|b| (b.median, b.low, b.high)).collect(),
        None => study.sticking.iter().map(|s| (s.value, s.low, s.high)).collect(),
    };
    let most = rows.iter().map(|r| r.2).fold(0.0, f64::max);
    let names =
        if shown == Shown::StickingProbability { ["probability", "95 % confidence"] } else { ["median", "5–95 %"] };
    let plot = grid.draw_bands(Plot::new(title(grid, &study.laws), grid.axis(), shown.axis(most)), &rows, names);
    // where both run from 0 to 1
    if shown == Shown::Restitution && most <= 1.0 && grid.curves.len() == 1 {
        let probability = study.sticking.iter().map(|s| s.value);
        return plot.with(Series::line("sticking probability", grid.points.iter().copied(), probability).dashed());
    }
    plot
}

/// Points of each curve over speed where its line turns: just below and above capture and yield, and up the steep rise.
fn turns(grid: &Grid, laws: &[Law], figure: Figure) -> Vec<Vec<[f64; 2]>> {
    const BESIDE: [f64; 7] = [1.0 - 1e-9, 1.0 + 1e-9, 1.0 + 1e-4, 1.0 + 1e-3, 1.004, 1.01, 1.03];
    if grid.quantity() != Swept::Speed {
        return Vec::new();
    }
    let of = |(curve, law): (&Curve, &Law)| -> Option<Vec<[f64; 2]>> {
        let diameter = curve.args.motion.diameter.as_ref().and_then(Given::one)?;
        let window = law.wall.window(diameter, None).ok().flatten();
        let ends = window.map(|w| [w.capture_velocity, w.exhausted_velocity]);
        let yielding = law.wall.yield_velocity(diameter, None).ok().flatten();
        let normal = curve.at(Swept::Speed, 1.0).complete().ok()?.components().0;
        let speeds = ends.into_iter().flatten().chain(yielding).map(|v| v / normal);
        let near = speeds.filter(|v| v.is_finite() && *v > 0.0).flat_map(|v| BESIDE.map(|b| v * b));
        let met = near.filter_map(|speed| {
            let met = curve.at(Swept::Speed, speed).complete().ok()?.meet(&law.wall).ok()?;
            Some([speed, figure.of(&met)])
        });
        Some(met.collect())
    };
    grid.curves.iter().zip(laws).map(|both| of(both).unwrap_or_default()).collect()
}

/// What all curves have in common.
pub fn title(grid: &Grid, laws: &[Law]) -> String {
    let (Some(law), Some(curve)) = (laws.first(), grid.curves.first()) else { return String::new() };
    let motion = &curve.args.motion;
    let mut parts = Vec::new();
    if !grid.varies("wall-law") {
        match (grid.varies("sphere"), grid.varies("surface")) {
            (false, false) => parts.extend(law.materials()),
            (false, true) => parts.extend(law.sphere().map(|s| format!("{s} spheres"))),
            (true, false) => parts.extend(law.surface().map(|s| format!("on {s}"))),
            (true, true) => {}
        }
        if !grid.varies("law") {
            parts.push(law.normal_name());
        }
    }
    if let (false, Some(d)) = (grid.varies("diameter") || grid.quantity() == Swept::Diameter, &motion.diameter) {
        parts.extend(d.one().map(|d| plotted(d, "m")));
    }
    if let (false, Some(v)) = (grid.varies("speed") || grid.quantity() == Swept::Speed, motion.speed) {
        parts.push(quantity(v, "m/s"));
    }
    if let (false, Some(angle)) = (grid.varies("angle") || grid.quantity() == Swept::Angle, motion.angle) {
        parts.push(format!("{angle}°"));
    }
    if let (false, Some(scatter)) = (grid.varies("roughness-angle"), law.wall.scatter()) {
        parts.push(format!("roughness angle {}°", number(scatter.deviation().to_degrees())));
    }
    let drawn = drawn(&curve.args).filter(|(flag, _)| !grid.varies(flag));
    parts.extend(drawn.map(|(flag, d)| format!("{} {d}", flag.replace('-', " "))));
    parts.join(", ")
}

/// Capture and yield velocity of a single head-on curve over speed.
fn references(grid: &Grid, laws: &[Law], shown: Shown) -> Vec<Reference> {
    let ([law], [curve]) = (laws, &grid.curves[..]) else { return Vec::new() };
    let head_on = curve.args.motion.angle.is_none_or(|a| a == 90.0);
    let (Swept::Speed, true, Shown::Restitution, Some(diameter)) =
        (grid.quantity(), head_on, shown, curve.args.motion.diameter.as_ref().and_then(Given::one))
    else {
        return Vec::new();
    };
    let capture = law.wall.window(diameter, None).ok().flatten().map(|w| (w.capture_velocity, "capture velocity"));
    let yielding = law.wall.yield_velocity(diameter, None).ok().flatten().map(|v| (v, "yield velocity"));
    [capture, yielding]
        .into_iter()
        .flatten()
        .filter(|(v, _)| *v > 0.0)
        .map(|(v, l)| Reference::vertical(v, l))
        .collect()
}
