//! The figures of the report.

use super::tally::{ANGLE, Ends, Impacts, RESTITUTION, SizeBin};
use carom::study::wilson;
use carom_report::plot::Legend;
use carom_report::{Axis, Color, HeatMap, Plot, Series};
use carom_track::Summary;

/// Size of a figure of which there are several, CSS pixels.
const SIZE: (u32, u32) = (900, 380);

/// Walls that one figure can hold apart.
pub const TOGETHER: usize = Color::PALETTE.len();

/// One histogram: edges, and the amounts of each wall.
struct Histogram<'a> {
    edges: &'a [f64],
    amounts: Vec<&'a [f64]>,
}

/// The distributions of impact speed, angle and restitution over some walls, each with its caption; what has no data is
/// left out.
pub fn distributions(impacts: &Impacts, summary: &Summary, walls: &[usize]) -> Vec<(Plot, &'static str)> {
    let mut plots = Vec::new();
    if let Some(bars) = impacts.speeds.bars(40) {
        let speed = Axis::new("normal impact speed", "m/s").log();
        let amounts = walls.iter().map(|w| bars.amounts[*w].as_slice()).collect();
        let plot = histogram(speed, "impacts", &Histogram { edges: &bars.edges, amounts }, summary, walls);
        plots.push((plot, "Speed towards the wall at impact, in bins of equal ratio."));
    }
    let edges = |n: usize, width: f64| (0..=n).map(|i| i as f64 * width).collect::<Vec<_>>();
    let amounts: Vec<&[f64]> = walls.iter().map(|w| impacts.walls[*w].angles.as_slice()).collect();
    let angles = edges((90.0 / ANGLE) as usize, ANGLE);
    let angle = Axis::new("impact angle", "°").range(0.0, 90.0);
    let plot = histogram(angle, "impacts", &Histogram { edges: &angles, amounts }, summary, walls);
    plots.push((plot, "Angle of the path at impact, measured from the surface: 90° is head-on."));
    let amounts: Vec<&[f64]> = walls.iter().map(|w| impacts.walls[*w].restitutions.as_slice()).collect();
    if amounts.iter().any(|a| a.iter().any(|v| *v > 0.0)) {
        let bins = edges(amounts[0].len(), RESTITUTION);
        let restitution = Axis::new("restitution", "").range(0.0, 1.0 + RESTITUTION);
        let plot = histogram(restitution, "rebounds", &Histogram { edges: &bins, amounts }, summary, walls);
        plots.push((plot, "Normal restitution of the rebounds; captures are not among them."));
    }
    plots
}

/// Bars for one wall, outlines for several; each wall's own amounts are 100 %.
fn histogram(x: Axis, what: &str, data: &Histogram, summary: &Summary, walls: &[usize]) -> Plot {
    let shares: Vec<Vec<f64>> = data
        .amounts
        .iter()
        .map(|a| {
            let total: f64 = a.iter().sum();
            a.iter().map(|v| if total > 0.0 { 100.0 * v / total } else { 0.0 }).collect()
        })
        .collect();
    let mut plot =
        Plot::new("", x, Axis::new(format!("share of {what}"), "%").range(0.0, top(shares.iter().flatten())));
    plot.size = SIZE;
    for (place, (wall, heights)) in walls.iter().zip(&shares).enumerate() {
        let name = &summary.walls[*wall].name;
        if heights.iter().all(|h| *h == 0.0) {
            continue;
        }
        let edges = data.edges.iter().copied();
        let series = if walls.len() == 1 {
            Series::bars(name, edges, heights.iter().copied())
        } else {
            let x = edges.flat_map(|e| [e, e]);
            let y = heights.iter().flat_map(|h| [*h, *h]);
            Series::line(name, x, [0.0].into_iter().chain(y).chain([0.0]))
        };
        plot = plot.with(series.color(Color::cycle(place)));
    }
    plot.legend(if walls.len() == 1 { Legend::Hidden } else { Legend::Outside })
}

/// The upper end of an axis from 0 on.
fn top<'a>(heights: impl Iterator<Item = &'a f64>) -> f64 {
    let most = heights.fold(0.0, |a: f64, b| a.max(*b));
    if most > 0.0 { 1.08 * most } else { 1.0 }
}

/// The mass kept by a wall along the axis on which it lies widest; `None` where it kept nothing.
pub fn deposit(ends: &Ends, wall: usize) -> Option<(Plot, &'static str)> {
    let axes = ends.deposits.get(wall)?;
    let spreads = axes.each_ref().map(super::bins::LinearBins::spread);
    let main = (0..3).fold(0, |best, axis| if spreads[axis] > spreads[best] { axis } else { best });
    let bars = axes[main].bars()?;
    let total: f64 = bars.amounts[0].iter().sum();
    let shares: Vec<f64> = bars.amounts[0].iter().map(|a| 100.0 * a / total).collect();
    let label = ["x", "y", "z"][main];
    let (unit, factor) = unit_of(bars.edges.iter().copied());
    let y = Axis::new("share of the mass it kept", "%").range(0.0, top(shares.iter()));
    let mut plot = Plot::new("", Axis::scaled(label, unit, factor), y).with(Series::bars("", bars.edges, shares));
    plot.size = SIZE;
    Some((plot.legend(Legend::Hidden), label))
}

/// The unit in which lengths up to the longest are short to write, and what a metre is in it.
fn unit_of(lengths: impl Iterator<Item = f64>) -> (&'static str, f64) {
    match lengths.fold(0.0, |a: f64, b| a.max(b.abs())) {
        r if r < 1e-3 => ("µm", 1e6),
        r if r < 1.0 => ("mm", 1e3),
        _ => ("m", 1.0),
    }
}

/// Cells of a map along its longer side.
const CELLS: f64 = 48.0;

/// Where a wall made of triangles kept mass, seen along the axis in which it is thinnest; `None` where it kept nothing.
pub fn map(ends: &Ends, wall: usize) -> Option<(HeatMap, [&'static str; 2])> {
    let places = ends.places.get(&wall).filter(|places| !places.is_empty())?;
    let ends_of = |axis: usize| {
        places.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], (x, _)| [a.min(x[axis]), b.max(x[axis])])
    };
    let reach: [[f64; 2]; 3] = [0, 1, 2].map(ends_of);
    let width = |axis: usize| reach[axis][1] - reach[axis][0];
    let thin = (0..3).fold(0, |least, axis| if width(axis) <= width(least) { axis } else { least });
    let axes: Vec<usize> = (0..3).filter(|axis| *axis != thin).collect();
    let cell = axes.iter().map(|a| width(*a)).fold(0.0, f64::max) / CELLS;
    if cell.is_nan() || cell <= 0.0 {
        return None;
    }
    let count = |axis: usize| (width(axis) / cell).ceil().max(1.0) as usize;
    let place = |axis: usize, x: f64| (((x - reach[axis][0]) / cell) as usize).min(count(axis) - 1);
    let (across, up) = (axes[0], axes[1]);
    let mut masses = vec![0.0; count(across) * count(up)];
    let mut total = 0.0;
    for (x, mass) in places {
        masses[place(up, x[up]) * count(across) + place(across, x[across])] += mass;
        total += mass;
    }
    let edges = |axis: usize| (0..=count(axis)).map(move |i| reach[axis][0] + i as f64 * cell);
    let values = masses.into_iter().map(|m| if m > 0.0 { 100.0 * m / total } else { f64::NAN });
    let labels = [["x", "y", "z"][across], ["x", "y", "z"][up]];
    let (unit, factor) = unit_of(reach.as_flattened().iter().copied());
    let mut map = HeatMap::new(
        "",
        Axis::scaled(labels[0], unit, factor),
        Axis::scaled(labels[1], unit, factor),
        Axis::new("share of the mass it kept", "%"),
    )
    .cells(edges(across), edges(up), values.collect::<Vec<_>>());
    map.size = (SIZE.0, 520);
    Some((map, labels))
}

/// The share kept, by size, of each wall that kept any, with 95 % intervals; `None` where there is only one size.
pub fn efficiency(sizes: &[SizeBin], summary: &Summary, walls: &[usize]) -> Option<Plot> {
    if sizes.len() < 2 || walls.is_empty() {
        return None;
    }
    let diameters: Vec<f64> = sizes.iter().map(|s| s.diameters / s.injected as f64).collect();
    let (low, high) = (diameters.first()?, diameters.last()?);
    let mut x = Axis::scaled("diameter", "µm", 1e6).range(low / 1.1, high * 1.1);
    if high / low > 3.0 {
        x = x.log();
    }
    let mut plot = Plot::new("", x, Axis::new("share kept", "%").range(0.0, 105.0));
    for (place, wall) in walls.iter().enumerate() {
        let share = |s: &SizeBin| 100.0 * s.kept[*wall] as f64 / s.injected as f64;
        let (low, high): (Vec<f64>, Vec<f64>) = sizes
            .iter()
            .map(|s| wilson(s.kept[*wall], s.injected))
            .map(|(low, high)| (100.0 * low, 100.0 * high))
            .unzip();
        let points = Series::points(&summary.walls[*wall].name, diameters.iter().copied(), sizes.iter().map(share));
        plot = plot.with(points.interval(low, high).color(Color::cycle(place)));
    }
    Some(plot.legend(Legend::Outside))
}
