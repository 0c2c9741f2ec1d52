//! Points along one quantity (`--over`) and curves of others (`--by`), for `sweep` and `capture`.

use crate::failure::Failure;
use crate::motion::ImpactArgs;
use crate::output::{self, Files};
use crate::text::plotted;
use crate::values;
use carom::error::did_you_mean;
use carom::math;
use carom_report::plot::Dash;
use carom_report::{Axis, Color, Column, Plot, Series, Table, Values};
use clap::{Args as _, FromArgMatches as _};
use std::path::PathBuf;

/// What can be swept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swept {
    Speed,
    Diameter,
    Angle,
}

impl Swept {
    const ALL: [Self; 3] = [Self::Speed, Self::Diameter, Self::Angle];

    /// Its flag.
    pub fn flag(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Diameter => "diameter",
            Self::Angle => "angle",
        }
    }

    fn read(self, text: &str) -> Result<f64, String> {
        match self {
            Self::Speed => values::speed(text),
            Self::Diameter => values::diameter(text),
            Self::Angle => values::angle(text),
        }
    }

    /// Column name and unit.
    fn column(self) -> (&'static str, &'static str) {
        match self {
            Self::Speed => ("speed", "m/s"),
            Self::Diameter => ("diameter", "m"),
            Self::Angle => ("angle_deg", ""),
        }
    }
}

/// `speed=0.1m/s..30m/s`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over {
    /// What runs.
    pub quantity: Swept,
    from: f64,
    to: f64,
}

impl std::str::FromStr for Over {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let form = "a range is wanted, such as speed=0.1m/s..30m/s";
        let (name, range) = text.split_once('=').ok_or(form)?;
        let names = Swept::ALL.map(Swept::flag);
        let quantity = Swept::ALL.into_iter().find(|q| q.flag() == name.trim()).ok_or_else(|| {
            let near = did_you_mean(name, names).map_or(String::new(), |n| format!("{n} "));
            format!("unknown quantity '{name}'; {near}known are {}", names.join(", "))
        })?;
        let (from, to) = range.split_once("..").ok_or(form)?;
        let (from, to) = (quantity.read(&with_unit(from, to))?, quantity.read(to)?);
        if from < to {
            Ok(Self { quantity, from, to })
        } else {
            Err(format!("the range '{range}' does not rise; {form}"))
        }
    }
}

/// A bare number before one with a unit shares it: in `1..100um` both are micrometres.
fn with_unit(text: &str, next: &str) -> String {
    let text = text.trim();
    if text.parse::<f64>().is_err() {
        return text.to_owned();
    }
    let next = next.trim();
    let digits = (1..=next.len()).rev().find(|n| next.get(..*n).is_some_and(|t| t.parse::<f64>().is_ok())).unwrap_or(0);
    format!("{text}{}", &next[digits..])
}

impl Over {
    /// The points: equal ratios, or equal steps; both ends exact.
    fn points(&self, count: usize, linear: bool) -> Vec<f64> {
        let last = count - 1;
        let between = |i: usize| {
            let share = i as f64 / last as f64;
            if linear {
                self.from + share * (self.to - self.from)
            } else {
                self.from * math::pow(self.to / self.from, share)
            }
        };
        (0..count)
            .map(|i| match i {
                0 => self.from,
                i if i == last => self.to,
                i => between(i),
            })
            .collect()
    }
}

/// `diameter=10um,20um`: one curve for each value of a flag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct By {
    key: String,
    values: Vec<String>,
}

impl std::str::FromStr for By {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let form = "a flag and its values are wanted, such as diameter=10um,20um or law=ea,eap";
        let (key, list) = text.split_once('=').ok_or(form)?;
        let separator = if list.contains(';') { ';' } else { ',' };
        let written: Vec<&str> = list.split(separator).map(str::trim).filter(|v| !v.is_empty()).collect();
        let last = written.last().ok_or(form)?;
        let key = key.trim().trim_start_matches("--").replace('_', "-");
        let shares_unit = Swept::ALL.iter().any(|q| q.flag() == key);
        let values = written.iter().map(|v| if shares_unit { with_unit(v, last) } else { (*v).to_owned() }).collect();
        Ok(Self { key, values })
    }
}

/// Points, curves and where they go.
#[derive(clap::Args)]
pub struct GridArgs {
    /// One curve for each value of any flag above: diameter=10um,20um, law=ea,eap, surface=glass,steel; or
    /// pair=SPHERE/SURFACE,...; repeat it for all combinations. Values that hold commas are separated by ';'
    #[arg(long, value_name = "FLAG=A,B,...", help_heading = "Sweep")]
    by: Vec<By>,
    /// Number of points
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..=1_000_000), help_heading = "Sweep")]
    points: u32,
    /// Equal steps instead of equal ratios (an angle always has equal steps)
    #[arg(long, help_heading = "Sweep")]
    linear: bool,
    /// Write the whole table to a file (.csv, .parquet or .json)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,
    /// Draw the curves (.svg or .png)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,
    /// Print the whole table as JSON, an object a row
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// One curve: the flags it is made with and how it differs from the others.
pub struct Curve {
    /// All its flags but the swept one.
    pub args: ImpactArgs,
    /// Value of each `--by`.
    values: Vec<String>,
    /// Number of that value.
    places: Vec<usize>,
}

/// Points times curves.
pub struct Grid<'a> {
    args: &'a GridArgs,
    over: Over,
    /// The swept values.
    pub points: Vec<f64>,
    /// The curves.
    pub curves: Vec<Curve>,
}

/// Most rows of a table that is held in memory.
const MOST: usize = 5_000_000;

impl GridArgs {
    /// Is JSON wanted?
    pub fn json(&self) -> bool {
        self.json
    }

    /// Is there anything of a grid without `--over`?
    pub fn needs_over(&self) -> bool {
        !self.by.is_empty() || self.out.is_some() || self.plot.is_some()
    }

    /// The files, checked.
    pub fn files(&self) -> Result<Files<'_>, Failure> {
        Files::check(self.out.as_ref(), self.plot.as_ref())
    }

    /// Lays the grid out.
    pub fn grid(&self, over: Over, base: &ImpactArgs) -> Result<Grid<'_>, Failure> {
        let swept = over.quantity.flag();
        let mut keys: Vec<&str> = vec![swept];
        for by in &self.by {
            if keys.contains(&by.key.as_str()) {
                return Err(Failure::input(format!("--by {}: it runs already; keep one", by.key)));
            }
            keys.push(&by.key);
        }
        let mut curves = vec![Curve { args: base.clone(), values: Vec::new(), places: Vec::new() }];
        for by in &self.by {
            let mut more = Vec::with_capacity(curves.len() * by.values.len());
            for curve in &curves {
                for (place, value) in by.values.iter().enumerate() {
                    more.push(curve.vary(by, value, place)?);
                }
            }
            curves = more;
        }
        let count = self.points as usize;
        if curves.len().saturating_mul(count) > MOST {
            return Err(Failure::input(format!(
                "{} curves of {count} points are too many rows; at most {MOST}",
                curves.len()
            )));
        }
        let points = over.points(count, self.is_linear(over));
        Ok(Grid { args: self, over, points, curves })
    }

    fn is_linear(&self, over: Over) -> bool {
        self.linear || over.quantity == Swept::Angle
    }
}

impl Curve {
    fn vary(&self, by: &By, value: &str, place: usize) -> Result<Self, Failure> {
        let mut args = self.args.clone();
        if by.key == "pair" {
            let (sphere, surface) = value.split_once('/').ok_or_else(|| {
                Failure::input(format!("--by pair={value}: SPHERE/SURFACE is wanted, such as copper/glass"))
            })?;
            set(&mut args, "sphere", sphere.trim())?;
            set(&mut args, "surface", surface.trim())?;
        } else {
            set(&mut args, &by.key, value)?;
        }
        let values = self.values.iter().cloned().chain([value.to_owned()]).collect();
        let places = self.places.iter().copied().chain([place]).collect();
        Ok(Self { args, values, places })
    }

    /// The flags at one point.
    pub fn at(&self, quantity: Swept, value: f64) -> crate::motion::MotionArgs {
        let mut motion = self.args.motion.clone();
        match quantity {
            Swept::Speed => motion.speed = Some(value),
            Swept::Diameter => motion.diameter = Some(value),
            Swept::Angle => motion.angle = Some(value),
        }
        motion
    }
}

/// Sets the flag `key` as if it had been given, by reading it as the command line is read.
fn set(args: &mut ImpactArgs, key: &str, value: &str) -> Result<(), Failure> {
    let command = ImpactArgs::augment_args_for_update(clap::Command::new("carom").no_binary_name(true));
    let command = command.disable_help_flag(true).mut_args(|a| a.allow_hyphen_values(true));
    let flags: Vec<String> = command.get_arguments().filter_map(|a| a.get_long()).map(str::to_owned).collect();
    if !flags.iter().any(|f| f == key) || key == "materials" {
        let near = did_you_mean(key, flags.iter().map(String::as_str)).map_or(String::new(), |n| format!("{n} "));
        return Err(Failure::input(format!(
            "--by {key}: no such flag; {near}any flag of the law or the impact will do, or pair"
        )));
    }
    let matches = command.try_get_matches_from([format!("--{key}={value}")]);
    matches.and_then(|m| args.update_from_arg_matches(&m)).map_err(|e| {
        let text = e.render().to_string();
        Failure::input(format!("--by: {}", text.trim_start_matches("error: ").trim_end()))
    })
}

impl Grid<'_> {
    /// What runs.
    pub fn quantity(&self) -> Swept {
        self.over.quantity
    }

    /// Columns of the curves' values and of the swept quantity, a row for each point of each curve.
    pub fn columns(&self) -> Vec<Column> {
        let each = |value: &dyn Fn(&Curve) -> f64| -> Vec<f64> {
            self.curves.iter().flat_map(|c| std::iter::repeat_n(value(c), self.points.len())).collect()
        };
        let mut columns: Vec<Column> = Vec::new();
        for (n, by) in self.args.by.iter().enumerate() {
            if let Some(quantity) = Swept::ALL.into_iter().find(|q| q.flag() == by.key) {
                let (name, unit) = quantity.column();
                columns.push(Column::float(name, unit, each(&|c| quantity.read(&c.values[n]).unwrap_or(f64::NAN))));
                continue;
            }
            let name = by.key.replace('-', "_");
            if by.values.iter().all(|v| v.parse::<f64>().is_ok()) {
                columns.push(Column::float(name, "", each(&|c| c.values[n].parse().unwrap_or(f64::NAN))));
            } else {
                let texts =
                    self.curves.iter().flat_map(|c| std::iter::repeat_n(c.values[n].as_str(), self.points.len()));
                columns.push(Column::text(name, texts));
            }
        }
        let (name, unit) = self.over.quantity.column();
        let runs: Vec<f64> = self.curves.iter().flat_map(|_| self.points.iter().copied()).collect();
        columns.push(Column::float(name, unit, runs));
        columns
    }

    /// The horizontal axis.
    pub fn axis(&self) -> Axis {
        let axis = match self.over.quantity {
            Swept::Speed => Axis::new("speed", "m/s"),
            Swept::Angle => Axis::new("angle of incidence from the surface", "°"),
            Swept::Diameter => {
                let (unit, factor) = match (self.over.from * self.over.to).sqrt() {
                    d if d < 5e-7 => ("nm", 1e9),
                    d if d < 1e-3 => ("µm", 1e6),
                    _ => ("mm", 1e3),
                };
                Axis::scaled("diameter", unit, factor)
            }
        };
        let axis = axis.range(self.over.from, self.over.to);
        if self.args.is_linear(self.over) { axis } else { axis.log() }
    }

    /// A line for each curve: colour by the first `--by`, dashes by the second.
    pub fn draw(&self, plot: Plot, values: &[f64]) -> Plot {
        let lines = self.curves.iter().zip(values.chunks(self.points.len()));
        lines.fold(plot, |plot, (curve, y)| {
            let mut line = Series::line(self.label(curve), self.points.iter().copied(), y.iter().copied());
            if let [color, dash, ..] = curve.places[..] {
                line = line.color(Color::cycle(color)).dash([Dash::Solid, Dash::Dashed, Dash::Dotted][dash % 3]);
            }
            plot.with(line)
        })
    }

    fn label(&self, curve: &Curve) -> String {
        let parts = self.args.by.iter().zip(&curve.values).map(|(by, value)| match by.key.as_str() {
            "pair" => value.replacen('/', " on ", 1),
            "law" | "sphere" | "surface" | "tangential" | "adhesion" | "wall-law" => value.clone(),
            "diameter" => values::diameter(value).map_or(value.clone(), |d| plotted(d, "m")),
            key => format!("{} {value}", key.replace('-', " ")),
        });
        parts.collect::<Vec<_>>().join(", ")
    }

    /// Does a `--by` vary this flag?
    pub fn varies(&self, flag: &str) -> bool {
        self.args.by.iter().any(|b| b.key == flag || (b.key == "pair" && (flag == "sphere" || flag == "surface")))
    }

    /// Shows the result: files where named, else the table.
    pub fn show(
        &self,
        files: &Files,
        whole: impl Fn() -> Result<Table, Failure>,
        short: impl FnOnce() -> Result<Table, Failure>,
        plot: impl FnOnce() -> Plot,
    ) -> Result<(), Failure> {
        files.write(&whole, plot)?;
        if self.args.json {
            output::print(&whole()?.to_json()?)
        } else if !files.any() {
            output::print(&telling(short()?)?.to_text())
        } else {
            Ok(())
        }
    }
}

/// Without the columns that have no value at all.
fn telling(table: Table) -> Result<Table, Failure> {
    let empty = |c: &&Column| matches!(&c.values, Values::Float(v) if v.iter().all(|x| x.is_nan()));
    Ok(Table::new(table.columns().iter().filter(|c| !empty(c)).cloned())?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_share_their_unit_and_keep_their_ends() {
        let over: Over = "diameter=1..100um".parse().expect("a range");
        let points = over.points(3, false);
        assert_eq!((points[0], points[2]), (1e-6, 1e-4));
        assert!((points[1] / 1e-5 - 1.0).abs() < 1e-12);
        let over: Over = "speed=1e-3..30".parse().expect("a range");
        assert_eq!(over.points(2, true), [1e-3, 30.0]);
    }

    #[test]
    fn ranges_that_are_none_are_refused() {
        for (text, part) in [
            ("sped=1..2", "did you mean speed?"),
            ("speed", "a range is wanted"),
            ("speed=1", "a range is wanted"),
            ("speed=2..1", "does not rise"),
            ("speed=1..1", "does not rise"),
            ("speed=0..1", "above 0"),
            ("speed=1..NaN", "finite"),
            ("angle=10..91", "up to 90"),
            ("diameter=1um..1kg", "no unit of length"),
        ] {
            let error = text.parse::<Over>().expect_err(text);
            assert!(error.contains(part), "{text}: {error}");
        }
    }

    #[test]
    fn curves_vary_any_flag() {
        let by: By = "law=adhesion-work,hertz-damping;ea".parse().expect("two laws");
        assert_eq!(by.values, ["adhesion-work,hertz-damping", "ea"]);
        let by: By = "diameter=10,20um".parse().expect("two diameters");
        assert_eq!(by.values, ["10um", "20um"]);
        let mut args = ImpactArgs::default();
        args.motion.speed = Some(3.0);
        set(&mut args, "diameter", "10um").expect("a diameter");
        assert_eq!((args.motion.diameter, args.motion.speed), (Some(1e-5), Some(3.0)));
        assert!(
            matches!(set(&mut args, "diamter", "1"), Err(Failure::Input(m)) if m.contains("did you mean diameter?"))
        );
        assert!(matches!(set(&mut args, "friction", "x"), Err(Failure::Input(m)) if m.contains("no number here")));
    }
}
