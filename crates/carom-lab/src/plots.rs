//! The plots of the experiments' panels.

use crate::compare::Model;
use crate::error::LabError;
use crate::experiment::{Over, Panel, Quantity};
use carom_report::plot::Marker;
use carom_report::{Axis, Color, Plot, Series};

/// Points of a curve.
const POINTS: u32 = 300;

/// Where a panel's curves are computed.
pub fn grid(panel: &Panel) -> Vec<f64> {
    let [from, to] = panel.range;
    let share = |n: u32| f64::from(n) / f64::from(POINTS);
    (0..=POINTS)
        .map(|n| match panel.over {
            Over::Speed => from * (to / from).powf(share(n)),
            Over::Angle => from + (to - from) * share(n),
        })
        .collect()
}

/// Draws a panel: models as lines and areas, measured points as circles, stated bounds as triangles with a bar on their open
/// side.
///
/// # Errors
/// An impact that a law refuses.
pub fn panel(panel: &Panel, models: &[Model<'_>]) -> Result<Plot, LabError> {
    let x = grid(panel);
    let along = match panel.over {
        Over::Speed => Axis::new("normal approach speed", "m/s").log().range(panel.range[0], panel.range[1]),
        Over::Angle => Axis::new("angle from the surface", "°").range(0.0, 90.0),
    };
    let up = match panel.quantity {
        Quantity::Restitution => Axis::new("restitution", "").range(0.0, 1.05),
        Quantity::TangentialRestitution => Axis::new("tangential restitution", "").range(0.4, 1.05),
        Quantity::ImpulseRatio => Axis::new("impulse ratio", ""),
    };
    let title = if panel.title.is_empty() { &panel.name } else { &panel.title };
    let mut plot = Plot::new(title.as_str(), along, up);
    for (n, model) in models.iter().enumerate() {
        let mut values = Vec::with_capacity(x.len());
        for at in &x {
            let (speed, angle) = match panel.over {
                Over::Speed => (*at, 90.0),
                Over::Angle => (panel.speed.map_or(f64::NAN, |s| s.0), *at),
            };
            values.push(model.at(panel.quantity, speed, angle, model.curve.diameter.0)?);
        }
        let (low, high) = (values.iter().map(|v| v.0), values.iter().map(|v| v.1));
        let series = if model.walls.len() > 1 {
            Series::band(&model.curve.label, x.clone(), low, high)
        } else {
            Series::line(&model.curve.label, x.clone(), low)
        };
        let series = series.color(Color::cycle(n));
        plot = plot.with(if model.curve.dashed { series.dashed() } else { series });
    }
    Ok(stated(panel, measured(panel, plot)))
}

fn measured(panel: &Panel, plot: Plot) -> Plot {
    let points: Vec<_> = panel.points().collect();
    if points.is_empty() {
        return plot;
    }
    let (x, y) = (points.iter().map(|p| panel.place(p)), points.iter().map(|p| p.value));
    let series = Series::points("measured", x, y).color(Color::BLACK);
    plot.with(if points.iter().any(|p| p.sigma.is_some()) {
        series.deviation(points.iter().map(|p| p.sigma.unwrap_or(f64::NAN)))
    } else {
        series
    })
}

fn stated(panel: &Panel, mut plot: Plot) -> Plot {
    let (mut x, mut y, mut low, mut high) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for stated in &panel.stated {
        // the bar shows the side on which the source says the value lies
        for (value, reach) in [(stated.above, 0.06), (stated.below, -0.06)] {
            let Some(value) = value else { continue };
            x.push(stated.at);
            y.push(value);
            low.push(value.min(value + reach));
            high.push(value.max(value + reach));
        }
    }
    if !x.is_empty() {
        let series = Series::points("stated bound (bar: its open side)", x, y).marker(Marker::Triangle);
        plot = plot.with(series.interval(low, high).color(Color::BLACK));
    }
    plot
}
