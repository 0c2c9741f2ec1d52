//! The resolved contact in time: overlap, speed, forces, slip.

use crate::failure::Failure;
use crate::law::Law;
use crate::motion::Motion;
use crate::text::{plotted, quantity};
use carom::normal::{NormalLaw, Size};
use carom::resolved::{Moment, Scales};
use carom::tangential::Tangential;
use carom_report::{Axis, Column, Plot, Series, Table};

/// Moments at least: enough for a smooth line, and for the jump at the turn, where adhesion sets in, to stand upright.
const MOMENTS: usize = 600;

/// The contact's moments; only the resolved law has them.
pub fn moments(law: &Law, motion: &Motion) -> Result<Vec<Moment>, Failure> {
    let (NormalLaw::Resolved(resolved), Some(pair)) = (law.wall.normal(), law.wall.pair()) else {
        return Err(Failure::input("--history and --plot show a contact in time, which only --law resolved follows"));
    };
    let constant = |c: Result<f64, carom::LawError>| c.map_err(|e| Failure::input(e.to_string()));
    let scales = Scales { stiffness: constant(pair.stiffness())?, density: constant(pair.density())? };
    let radius = 0.5 * motion.diameter;
    let curvature = law.spec.surface_curvature.as_ref().map_or(0.0, |r| 1.0 / r.value.0);
    let size = Size { kappa: 1.0 / (1.0 + radius * curvature), ..Size::flat(radius) };
    let friction = match law.wall.tangential() {
        Tangential::Friction { friction, .. } => *friction,
        Tangential::MicroSlip(_) => {
            return Err(Failure::input(
                "--history follows the slip with rolling alone (Eqs 26-28): write --tangential rolling",
            ));
        }
        _ => 0.0,
    };
    let (normal, tangential) = motion.components();
    Ok(resolved.history(normal, &size, &scales, tangential - radius * motion.spin, friction, MOMENTS))
}

/// One row a moment.
pub fn table(moments: &[Moment]) -> Result<Table, Failure> {
    let column = |name: &str, unit: &str, get: fn(&Moment) -> f64| Column::float(name, unit, moments.iter().map(get));
    Ok(Table::new([
        column("time", "s", |m| m.time),
        column("overlap", "m", |m| m.overlap),
        column("speed", "m/s", |m| m.speed),
        column("hertz_force", "N", |m| m.hertz_force),
        column("net_force", "N", |m| m.net_force),
        column("slip", "m/s", |m| m.slip),
    ])?)
}

/// Forces over time.
pub fn plot(moments: &[Moment], law: &Law, motion: &Motion) -> Plot {
    let largest = |get: fn(&Moment) -> f64| moments.iter().map(get).fold(0.0, |a: f64, b| a.max(b.abs()));
    let (time, time_factor) = prefixed("s", largest(|m| m.time));
    let (force, force_factor) = prefixed("N", largest(|m| m.hertz_force));
    let title = format!("{}, {}, {}", law.description(), plotted(motion.diameter, "m"), quantity(motion.speed, "m/s"));
    let line = |label: &str, get: fn(&Moment) -> f64| {
        Series::line(label, moments.iter().map(|m| m.time), moments.iter().map(get))
    };
    Plot::new(
        title,
        Axis::scaled("time", time, time_factor),
        Axis::scaled("force away from the wall", force, force_factor),
    )
    .with(line("net force", |m| m.net_force))
    .with(line("Hertz force", |m| m.hertz_force).dashed())
}

/// A unit whose prefix suits `largest`, and its factor.
fn prefixed(unit: &str, largest: f64) -> (String, f64) {
    const PREFIXES: [(f64, &str); 6] = [(1.0, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n"), (1e12, "p"), (1e15, "f")];
    let (factor, prefix) = PREFIXES.into_iter().find(|(f, _)| largest * f >= 1.0).unwrap_or((1.0, ""));
    (format!("{prefix}{unit}"), factor)
}
