//! Points along one quantity (`--over`) and curves of others (`--by`), for `sweep` and `capture`.

mod by;
mod over;

pub use by::By;
pub use over::{Over, Swept, with_unit};

use crate::failure::Failure;
use crate::motion::ImpactArgs;
use crate::output::{self, Files};
use crate::text::plotted;
use crate::values;
use by::set;
use carom::study::Given;
use carom_report::plot::Dash;
use carom_report::{Axis, Color, Column, Plot, Series, Table, Values};
use std::path::PathBuf;

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
        let drawn = |c: &Curve| c.args.motion.diameter.as_ref().is_some_and(|d| d.distribution().is_some());
        if over.quantity == Swept::Diameter && curves.iter().any(drawn) {
            return Err(Failure::input("--diameter is a distribution, but --over runs through the diameter; keep one"));
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

    /// A diameter that is a distribution, at a probability; none where it is one value or runs.
    pub fn diameter(&self, quantity: Swept, probability: f64) -> Option<f64> {
        let given = self.args.motion.diameter.as_ref().filter(|_| quantity != Swept::Diameter)?;
        given.distribution().map(|d| d.quantile(probability))
    }

    /// The flags at one point.
    pub fn at(&self, quantity: Swept, value: f64) -> crate::motion::MotionArgs {
        let mut motion = self.args.motion.clone();
        match quantity {
            Swept::Speed => motion.speed = Some(value),
            Swept::Diameter => motion.diameter = Some(Given::One(value)),
            Swept::Angle => motion.angle = Some(value),
        }
        motion
    }
}

impl Grid<'_> {
    /// Whether a curve has impacts that are not head-on.
    pub fn is_oblique(&self, curve: &Curve) -> bool {
        curve.args.motion.is_oblique() || self.quantity() == Swept::Angle
    }

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
            let quantity = Swept::ALL.into_iter().find(|q| q.flag() == by.key);
            if let Some(quantity) = quantity.filter(|q| by.values.iter().all(|v| q.read(v).is_ok())) {
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
        self.draw_with(plot, values, &[])
    }

    /// As [`Grid::draw`], with points of its own for each curve, (x, y), where a line turns between those of the grid.
    pub fn draw_with(&self, plot: Plot, values: &[f64], more: &[Vec<[f64; 2]>]) -> Plot {
        let lines = self.curves.iter().zip(values.chunks(self.points.len())).enumerate();
        lines.fold(plot, |plot, (number, (curve, y))| {
            let mut points: Vec<[f64; 2]> = self.points.iter().zip(y).map(|(x, y)| [*x, *y]).collect();
            points.extend(
                more.get(number).into_iter().flatten().filter(|p| p[0] > self.over.from && p[0] < self.over.to),
            );
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let mut line = Series::line(self.label(curve), points.iter().map(|p| p[0]), points.iter().map(|p| p[1]));
            if let [color, dash, ..] = curve.places[..] {
                line = line.color(Color::cycle(color)).dash([Dash::Solid, Dash::Dashed, Dash::Dotted][dash % 3]);
            }
            plot.with(line)
        })
    }

    /// A line and a band for each curve, in one colour; the name of the band where there is one curve.
    pub fn draw_bands(&self, plot: Plot, bands: &[(f64, f64, f64)], names: [&str; 2]) -> Plot {
        let curves = self.curves.iter().zip(bands.chunks(self.points.len())).enumerate();
        curves.fold(plot, |plot, (number, (curve, rows))| {
            let color = Color::cycle(number);
            let alone = self.curves.len() == 1;
            let [line, band] = if alone { names.map(str::to_owned) } else { [self.label(curve), String::new()] };
            let x = || self.points.iter().copied();
            let dash = [Dash::Solid, Dash::Dashed, Dash::Dotted][number / Color::PALETTE.len() % 3];
            plot.with(Series::band(band, x(), rows.iter().map(|r| r.1), rows.iter().map(|r| r.2)).color(color))
                .with(Series::line(line, x(), rows.iter().map(|r| r.0)).color(color).dash(dash))
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
