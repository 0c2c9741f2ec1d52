//! Points along one quantity (`--over`) and curves of others (`--by`), for `sweep` and `capture`.

mod by;
mod over;

pub use by::By;
pub use over::{LengthUnit, Over, Swept, length_unit, with_unit};

use crate::failure::Failure;
use crate::law::Law;
use crate::motion::ImpactArgs;
use crate::output::{self, Files};
use crate::text::plotted;
use crate::values;
use by::set;
use carom::study::Given;
use carom_report::plot::Dash;
use carom_report::{Axis, Color, Column, Plot, ReportError, Series, Table, Values};
use std::path::{Path, PathBuf};

/// Points, curves and where they go.
#[derive(clap::Args, Clone, Debug)]
pub struct GridArgs {
    /// One curve for each value of any flag above: diameter=10um,20um, law=ea,eap, surface=glass,steel; or
    /// pair=SPHERE/SURFACE,...; a range A..B:N of numbers is N values; repeat it for all combinations. Values that hold
    /// commas are separated by ';'
    #[arg(long, value_name = "FLAG=A,B,...", help_heading = "Sweep")]
    by: Vec<By>,
    /// Number of points of a range
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(2..=1_000_000), help_heading = "Sweep")]
    points: u32,
    /// Equal steps instead of equal ratios (an angle always has equal steps)
    #[arg(long, help_heading = "Sweep")]
    linear: bool,
    /// Write the whole table to a file (.csv, .parquet or .json), or as CSV to standard output: -
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,
    /// Draw the curves (.svg or .png)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,
    /// The plot's title instead of the law's and the impact's own
    #[arg(long, value_name = "TEXT", requires = "plot", help_heading = "Output")]
    title: Option<String>,
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
    /// The title that was asked for.
    pub fn title(&self) -> Option<&str> {
        self.title.as_deref()
    }

    /// Is JSON wanted?
    pub fn json(&self) -> bool {
        self.json
    }

    /// Is there anything of a grid without `--over`?
    pub fn needs_over(&self) -> bool {
        !self.by.is_empty() || self.out.is_some() || self.plot.is_some()
    }

    /// Lays a map out: the points of `across` for each point of `up`.
    pub fn map(&self, across: &Over, up: &Over, base: &ImpactArgs) -> Result<(GridArgs, Vec<f64>), Failure> {
        if !self.by.is_empty() {
            return Err(Failure::input("--by makes curves, and two --over make a map; leave one of them out"));
        }
        if across.quantity == up.quantity {
            return Err(Failure::input(format!("--over {}: it runs already; keep one", up.quantity.flag())));
        }
        let drawn = base.motion.diameter.as_ref().is_some_and(|d| d.distribution().is_some());
        if drawn || base.law.drawn().next().is_some() {
            return Err(Failure::input("a map has one value of each flag; a distribution cannot be drawn there"));
        }
        refuse_idle(up, base)?;
        let points = up.points(self.points as usize, self.is_linear(up));
        Ok((Self { by: vec![By::along(up, &points)], ..self.clone() }, points))
    }

    /// The files, checked.
    pub fn files(&self) -> Result<Files<'_>, Failure> {
        Files::check(self.out.as_ref(), self.plot.as_ref())?.beside(self.json)
    }

    /// Lays the grid out.
    pub fn grid(&self, over: &Over, base: &ImpactArgs) -> Result<Grid<'_>, Failure> {
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
        let drawn = |c: &Curve| c.args.motion.diameter.as_ref().is_some_and(|d| d.distribution().is_some());
        if over.quantity == Swept::Diameter && curves.iter().any(drawn) {
            return Err(Failure::input("--diameter is a distribution, but --over runs through the diameter; keep one"));
        }
        if let Swept::Law(key) = over.quantity
            && curves.iter().any(|c| c.args.law.draws(key))
        {
            let flag = over.quantity.flag();
            return Err(Failure::input(format!("--{flag} is a distribution, but --over runs through it; keep one")));
        }
        refuse_idle(over, base)?;
        let points = over.points(count, self.is_linear(over));
        if curves.len().saturating_mul(points.len()) > MOST {
            return Err(Failure::input(format!(
                "{} curves of {} points are too many rows; at most {MOST}",
                curves.len(),
                points.len()
            )));
        }
        Ok(Grid { args: self, over: over.clone(), points, curves })
    }

    /// Whether a range has equal steps.
    pub fn is_linear(&self, over: &Over) -> bool {
        self.linear || over.is_linear()
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
            Swept::Spin => motion.spin = Some(value),
            Swept::Law(_) => {}
        }
        motion
    }

    /// The laws along the points: one for all, or one for each where a number of the law runs.
    pub fn laws(&self, grid: &Grid) -> Result<Vec<Law>, Failure> {
        let oblique = grid.is_oblique(self);
        let Swept::Law(key) = grid.quantity() else { return Ok(vec![self.args.law.compile(oblique)?]) };
        let at = |value: &f64| {
            let mut law = self.args.law.clone();
            law.set_number(key, *value);
            law.compile(oblique)
        };
        grid.points.iter().map(at).collect()
    }
}

impl Grid<'_> {
    /// Whether a curve has impacts that are not head-on.
    pub fn is_oblique(&self, curve: &Curve) -> bool {
        curve.args.motion.is_oblique() || matches!(self.quantity(), Swept::Angle | Swept::Spin)
    }

    /// What runs.
    pub fn quantity(&self) -> Swept {
        self.over.quantity
    }

    /// Columns of the curves' values and of the swept quantity, a row for each point of each curve.
    fn columns(&self) -> Vec<Column> {
        let each = |value: &dyn Fn(&Curve) -> f64| -> Vec<f64> {
            self.curves.iter().flat_map(|c| std::iter::repeat_n(value(c), self.points.len())).collect()
        };
        let mut columns: Vec<Column> = Vec::new();
        for (n, by) in self.args.by.iter().enumerate() {
            let quantity = Swept::all().find(|q| q.flag() == by.key);
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

    /// These columns and those of the results; a number of the law that is a result as well is `given_` by its name.
    pub fn table(&self, results: Vec<Column>) -> Result<Table, Failure> {
        let mut columns = self.columns();
        for column in columns.iter_mut().filter(|c| results.iter().any(|r| r.name == c.name)) {
            column.name.insert_str(0, "given_");
        }
        columns.extend(results);
        Ok(Table::new(columns)?)
    }

    /// The horizontal axis.
    pub fn axis(&self) -> Axis {
        self.over.axis(self.args.is_linear(&self.over))
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

    /// The unit that diameters were given in.
    fn unit(&self) -> Option<LengthUnit> {
        let by = self.args.by.iter().find(|by| by.key == Swept::Diameter.flag());
        self.over.unit.or_else(|| length_unit(by?.values.first()?))
    }

    /// With diameters in the unit that they were given in.
    fn in_units(&self, table: Table) -> Result<Table, Failure> {
        let (name, si) = Swept::Diameter.column();
        let Some((unit, factor)) = self.unit() else { return Ok(table) };
        let columns = table.columns().iter().map(|column| match &column.values {
            Values::Float(v) if column.name == name && column.unit == si => {
                Column::float(name, unit, v.iter().map(|d| fifteen_digits(d / factor)))
            }
            _ => column.clone(),
        });
        Ok(Table::new(columns)?)
    }

    /// Shows the result: files where named, else the table.
    pub fn show(
        &self,
        files: &Files,
        whole: impl Fn() -> Result<Table, Failure>,
        short: impl FnOnce() -> Result<Table, Failure>,
        plot: impl FnOnce() -> Plot,
    ) -> Result<(), Failure> {
        let plot = || match &self.args.title {
            Some(title) => Plot { title: title.clone(), ..plot() },
            None => plot(),
        };
        let plot = files.drawn(plot)?;
        self.show_drawn(files, whole, short, |path| plot.map_or(Ok(()), |plot| plot.write(path)))
    }

    /// Likewise, with what draws the picture.
    pub fn show_drawn(
        &self,
        files: &Files,
        whole: impl Fn() -> Result<Table, Failure>,
        short: impl FnOnce() -> Result<Table, Failure>,
        draw: impl FnOnce(&Path) -> Result<(), ReportError>,
    ) -> Result<(), Failure> {
        // JSON is in SI units, whatever was given
        files.write_drawn(|| if files.is_json() { whole() } else { self.in_units(whole()?) }, draw)?;
        if self.args.json {
            output::print(&whole()?.to_json()?)
        } else if !files.any() {
            output::print(&self.in_units(telling(short()?)?)?.to_text())
        } else {
            Ok(())
        }
    }
}

/// A value of what runs would silently do nothing.
fn refuse_idle(over: &Over, base: &ImpactArgs) -> Result<(), Failure> {
    let motion = &base.motion;
    let given = match over.quantity {
        Swept::Speed => motion.speed.is_some(),
        Swept::Diameter => motion.diameter.is_some(),
        Swept::Angle => motion.angle.is_some(),
        Swept::Spin => motion.spin.is_some(),
        Swept::Law(key) => base.law.gives(key),
    };
    let flag = over.quantity.flag();
    if given {
        Err(Failure::input(format!("--{flag} has no effect: --over runs through it; leave one out")))
    } else {
        Ok(())
    }
}

/// Without what dividing by a unit leaves in the last digit.
fn fifteen_digits(x: f64) -> f64 {
    format!("{x:.14e}").parse().unwrap_or(x)
}

/// Without the columns that have no value at all.
fn telling(table: Table) -> Result<Table, Failure> {
    let empty = |c: &&Column| matches!(&c.values, Values::Float(v) if v.iter().all(|x| x.is_nan()));
    Ok(Table::new(table.columns().iter().filter(|c| !empty(c)).cloned())?)
}
