//! `carom capture`: the window of rebound of one diameter, or a curve over diameters.

mod sampled;

use crate::failure::Failure;
use crate::figures::Figures;
use crate::grid::{Grid, GridArgs, Over, Swept};
use crate::law::LawArgs;
use crate::motion::{ImpactArgs, MotionArgs};
use crate::output;
use crate::removal::{self, RemovalArgs};
use crate::samples::SampleArgs;
use crate::study::is_drawn;
use crate::sweep;
use crate::text::{Lines, number};
use crate::warnings::{Warnings, Yielding};
use carom::WallLaw;
use carom::study::Given;
use carom_report::{Axis, Column, Plot, Table};

const EXAMPLE: &str = "\
Examples:
  carom capture --sphere copper --surface aluminium --diameter 10um --roughness-factor 0.8
  carom capture --sphere copper --surface aluminium --over diameter=1um..1mm --plot capture.svg
  carom capture --sphere copper --surface aluminium --diameter 10um --over roughness-factor=0.05..1
  carom capture --sphere copper --surface silicon --diameter 50um --friction 0.2 --removal
  carom capture --sphere copper --over diameter=1..100um --by surface=aluminium,silicon,stainless-steel
  carom capture --sphere copper --surface silicon --diameter 'lognormal(50um, 1.3)' --over speed=0.01..1 --plot p.svg

At and below the capture velocity (normal to the wall) the sphere sticks.";

/// Compute the capture velocity, yield velocity and Tabor's parameter, for one diameter or a range
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// Diameter of the sphere, such as 90um, or a distribution of it, such as 'lognormal(50um, 1.3)'
    #[arg(long, value_name = "LENGTH", help_heading = "Impact", value_parser = crate::values::diameters)]
    diameter: Option<Given>,
    #[command(flatten)]
    law: LawArgs,
    /// What to vary: a range (diameter=1um..1mm, roughness-factor=0.05..1) or a list (diameter=1,10,100um) of the diameter or any
    /// number of the law; where a value is a distribution, of the diameter or the speed
    #[arg(long, value_name = "RANGE", help_heading = "Sweep")]
    over: Option<Over>,
    #[command(flatten)]
    grid: GridArgs,
    #[command(flatten)]
    samples: SampleArgs,
    #[command(flatten)]
    removal: RemovalArgs,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    let motion = MotionArgs { diameter: args.diameter.clone(), ..MotionArgs::default() };
    let case = ImpactArgs { motion, law: args.law.clone() };
    match &args.over {
        Some(_) if args.removal.wanted() => {
            Err(Failure::input("--removal answers for one diameter; leave out --over, or --removal"))
        }
        Some(over) => curves(args, over, &case),
        None if args.grid.needs_over() => {
            Err(Failure::input("--by, --out and --plot need a range; give --over, such as --over diameter=1um..1mm"))
        }
        None => one(args, &case),
    }
}

#[derive(serde::Serialize)]
struct Answer {
    diameter: f64,
    law: String,
    #[serde(flatten)]
    figures: Figures,
    /// Of a head-on impact at the capture velocity.
    validity: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    above_yield: Option<Yielding>,
    #[serde(skip_serializing_if = "Option::is_none")]
    removal: Option<removal::Answer>,
}

fn one(args: &Args, case: &ImpactArgs) -> Result<(), Failure> {
    if let Some(sampling) = args.samples.sampling(is_drawn(case)) {
        return sampled::one(args, case, &sampling);
    }
    let diameter = case.motion.wanted_diameter()?;
    let law = case.law.compile(false)?;
    let figures = Figures::new(&law.wall, diameter)?;
    let removal = args.removal.answer(&law, diameter)?;
    let warnings = match figures.capture_velocity {
        Some(v) if v > 0.0 => Warnings::at(&law.wall, v, diameter)?,
        _ => Warnings::default(),
    };
    if args.grid.json() {
        let (validity, above_yield) = (warnings.codes(), warnings.yielding());
        let law = law.normal_name();
        return output::print_json(&Answer { diameter, law, figures, validity, above_yield, removal });
    }
    let mut lines = Lines::default();
    figures.tell(&mut lines);
    figures.compare(&mut lines);
    if let Some(typical) = law.typical() {
        lines.add("typical", typical);
    }
    if let Some(removal) = &removal {
        removal.tell(&mut lines);
    }
    warnings.tell(&mut lines);
    let plastic = |eap: &WallLaw| {
        let window = eap.window(diameter, None).ok()?;
        Some(
            window
                .map_or("no rebound".to_owned(), |w| format!("{} m/s as capture velocity", number(w.capture_velocity))),
        )
    };
    let default = law.by_default(plastic);
    output::print(&format!("{}{default}\n\n{lines}", law.heading(diameter)))
}

fn curves(args: &Args, over: &Over, case: &ImpactArgs) -> Result<(), Failure> {
    let files = args.grid.files()?;
    let grid = args.grid.grid(over, case)?;
    let sampling = args.samples.sampling(grid.curves.iter().any(|c| is_drawn(&c.args)));
    let flag = over.quantity.flag();
    match (over.quantity, &sampling) {
        (Swept::Diameter, _) | (Swept::Law(_), None) | (Swept::Speed, Some(_)) => {}
        (Swept::Law(_), Some(_)) => {
            return Err(Failure::input(format!(
                "--over {flag}: where values are distributions, diameter or speed runs; --by {flag}=... makes curves of it"
            )));
        }
        _ => {
            return Err(Failure::input(format!(
                "--over {flag}: the capture velocity depends on the diameter and the law alone (over speed it has the \
                 probability of sticking, where a value is a distribution)"
            )));
        }
    }
    if let Some(flag) = ["speed", "angle", "spin"].into_iter().find(|f| grid.varies(f)) {
        return Err(Failure::input(format!("--by {flag}: the capture velocity does not depend on it")));
    }
    if let Some(sampling) = sampling {
        return sampled::curves(&grid, &files, &sampling);
    }
    let mut figures = Vec::with_capacity(grid.curves.len() * grid.points.len());
    let mut laws = Vec::new();
    for curve in &grid.curves {
        let along = curve.laws(&grid)?;
        let each = along.iter().chain(along.last().into_iter().cycle());
        for (point, law) in grid.points.iter().zip(each) {
            figures.push(Figures::new(&law.wall, curve.at(grid.quantity(), *point).wanted_diameter()?)?);
        }
        laws.extend(along.into_iter().next());
    }
    let table = || table(&grid, &figures);
    grid.show(&files, table, table, || {
        let title = sweep::title(&grid, &laws);
        let capture: Vec<f64> = figures.iter().map(|f| f.capture_velocity.unwrap_or(f64::NAN)).collect();
        grid.draw(Plot::new(title, grid.axis(), Axis::new("capture velocity", "m/s").log()), &capture)
    })
}

fn table(grid: &Grid, figures: &[Figures]) -> Result<Table, Failure> {
    grid.table(vec![
        Column::float("capture_velocity", "m/s", figures.iter().map(|f| f.capture_velocity)),
        Column::float("exhausted_velocity", "m/s", figures.iter().map(|f| f.exhausted_velocity)),
        Column::float("yield_velocity", "m/s", figures.iter().map(|f| f.yield_velocity)),
        Column::float("tabor_parameter", "", figures.iter().map(Figures::tabor)),
        Column::optional_text("regime", figures.iter().map(Figures::regime)),
    ])
}
