//! A fit as a reader sees it: the curve with the data, and what is left between them.

use super::parameter::Parameter as _;
use super::{Fit, Residual, bootstrap::quantile};
use crate::compare::meet;
use crate::error::LabError;
use crate::experiment::Quantity;
use carom::WallLaw;
use carom::material::Library;
use carom_report::plot::{Marker, Reference};
use carom_report::{Axis, Color, Plot, Series, significant};

/// Points of a curve.
const POINTS: u32 = 200;
/// Resampled laws behind a band.
const LAWS: usize = 200;
/// Diameters with a curve each; of more, the smallest, middle and largest.
const CURVES: usize = 5;

/// What a plot shows, and over what.
struct View {
    quantity: Quantity,
    /// Normal speeds (m/s) or angles from the surface (degrees).
    x: Vec<f64>,
    /// m/s, where angles run.
    speed: Option<f64>,
}

impl View {
    fn along(&self) -> Axis {
        match self.speed {
            None => Axis::new("normal approach speed", "m/s").log(),
            Some(_) => Axis::new("angle from the surface", "°").range(0.0, 90.0),
        }
    }

    fn place(&self, residual: &Residual) -> f64 {
        if self.speed.is_some() { residual.angle_deg } else { residual.normal_speed }
    }

    fn at(&self, wall: &WallLaw, x: f64, diameter: f64) -> Result<f64, LabError> {
        let (speed, angle) = self.speed.map_or((x, 90.0), |speed| (speed, x));
        meet(wall, self.quantity, speed, angle, diameter).map_err(|e| LabError::Model(e.to_string()))
    }
}

impl Fit {
    /// Restitution over normal speed (tangential restitution over angle, where nothing else was measured): the data, the fitted law for
    /// each diameter, and the middle 95 % of the resampled fits.
    ///
    /// # Errors
    /// None in practice.
    pub fn plot(&self, title: &str, library: &Library) -> Result<Plot, LabError> {
        let view = self.view();
        let along = view.along();
        let up = match view.speed {
            None => Axis::new("restitution", "").range(0.0, 1.05),
            Some(_) => Axis::new("tangential restitution", ""),
        };
        let mut plot = Plot::new(title, along, up);
        let wall = self.law.compile(library).map_err(LabError::Fit)?;
        let resampled = self.resampled(library)?;
        let all = self.data.diameters();
        let shown = if all.len() > CURVES { vec![all[0], all[all.len() / 2], all[all.len() - 1]] } else { all.clone() };
        for (n, diameter) in shown.iter().enumerate() {
            let label = |what: &str| {
                if all.len() == 1 { what.to_owned() } else { format!("{} µm, {what}", significant(diameter * 1e6, 3)) }
            };
            let color = Color::cycle(n);
            if resampled.len() > 1 {
                let (low, high) = band(&view, &resampled, *diameter)?;
                plot = plot.with(Series::band(label("95 % of resampled fits"), view.x.clone(), low, high).color(color));
            }
            let y = view.x.iter().map(|x| view.at(&wall, *x, *diameter)).collect::<Result<Vec<_>, _>>()?;
            plot = plot.with(Series::line(label("fitted"), view.x.clone(), y).color(color));
            if all.len() == shown.len() {
                let near = |d: f64| (d / diameter - 1.0).abs() <= 0.02;
                plot = plot.with(self.measured(&view, &label("measured"), near).color(if all.len() == 1 {
                    Color::BLACK
                } else {
                    color
                }));
            }
        }
        if all.len() > shown.len() {
            plot = plot.with(self.measured(&view, "measured, all diameters", |_| true).color(Color::BLACK));
        }
        Ok(plot)
    }

    /// Measured minus fitted over what [`Fit::plot`] runs over, in standard uncertainties where the data have them.
    pub fn residual_plot(&self, title: &str) -> Plot {
        let scaled = self.data.has_sigma();
        let up = if scaled { "(measured − fitted) / σ" } else { "measured − fitted" };
        let view = self.view();
        let mut plot = Plot::new(title, view.along(), Axis::new(up, ""));
        let kinds = [
            (Quantity::Restitution, "restitution", Marker::Circle),
            (Quantity::TangentialRestitution, "tangential restitution", Marker::Triangle),
        ];
        for (quantity, label, marker) in kinds {
            let of: Vec<_> = self.residuals.iter().filter(|r| r.quantity == quantity).collect();
            if !of.is_empty() {
                let y = of.iter().map(|r| (r.measured - r.model) / r.sigma.filter(|_| scaled).unwrap_or(1.0));
                plot = plot.with(Series::points(label, of.iter().map(|r| view.place(r)), y).marker(marker));
            }
        }
        plot.reference(Reference::horizontal(0.0, ""))
    }

    fn view(&self) -> View {
        let of = |q: Quantity| self.residuals.iter().filter(move |r| r.quantity == q);
        let share = |n: u32| f64::from(n) / f64::from(POINTS);
        if of(Quantity::Restitution).next().is_some() {
            let speeds = of(Quantity::Restitution).map(|r| r.normal_speed);
            let (low, high) = speeds.fold((f64::INFINITY, 0.0f64), |(l, h), v| (l.min(v), h.max(v)));
            let (low, high) = (low / 1.5, high * 1.5);
            let x = (0..=POINTS).map(|n| low * (high / low).powf(share(n))).collect();
            return View { quantity: Quantity::Restitution, x, speed: None };
        }
        let mut speeds: Vec<f64> = self.data.points.iter().map(|p| p.speed).collect();
        speeds.sort_by(f64::total_cmp);
        let x = (0..POINTS).map(|n| 1.0 + 88.9 * share(n)).collect();
        View { quantity: Quantity::TangentialRestitution, x, speed: Some(speeds[speeds.len() / 2]) }
    }

    /// The laws of resampled fits.
    fn resampled(&self, library: &Library) -> Result<Vec<WallLaw>, LabError> {
        let samples = self.bootstrap.iter().flat_map(|b| &b.samples).take(LAWS);
        let with = |values: &Vec<f64>| {
            let mut law = self.law.clone();
            self.parameters.iter().zip(values).for_each(|(p, value)| p.parameter.set(&mut law, *value));
            law.compile(library).map_err(LabError::Fit)
        };
        samples.map(with).collect()
    }

    fn measured(&self, view: &View, label: &str, of: impl Fn(f64) -> bool) -> Series {
        let points: Vec<_> = self.residuals.iter().filter(|r| r.quantity == view.quantity && of(r.diameter)).collect();
        let x = points.iter().map(|r| view.place(r));
        let series = Series::points(label, x, points.iter().map(|r| r.measured));
        if self.data.has_sigma() {
            series.deviation(points.iter().map(|r| r.sigma.unwrap_or(f64::NAN)))
        } else {
            series
        }
    }
}

/// The middle 95 % of what several laws give.
fn band(view: &View, laws: &[WallLaw], diameter: f64) -> Result<(Vec<f64>, Vec<f64>), LabError> {
    let (mut low, mut high) = (Vec::with_capacity(view.x.len()), Vec::with_capacity(view.x.len()));
    for x in &view.x {
        let mut values = laws.iter().map(|law| view.at(law, *x, diameter)).collect::<Result<Vec<_>, _>>()?;
        values.sort_by(f64::total_cmp);
        low.push(quantile(&values, 0.025).unwrap_or(f64::NAN));
        high.push(quantile(&values, 0.975).unwrap_or(f64::NAN));
    }
    Ok((low, high))
}
