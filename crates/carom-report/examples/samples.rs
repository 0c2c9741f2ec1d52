//! Draws one sample of each kind of plot into a folder: `cargo run -p carom-report --example samples -- FOLDER`.

use std::f64::consts::PI;
use std::path::PathBuf;

use carom_report::plot::{Dash, Marker, Reference};
use carom_report::{Axis, Color, Column, HeatMap, Plot, Report, ReportError, Series, Table, plot::ColorMap};

fn main() -> Result<(), ReportError> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    let plots = [
        ("restitution", restitution()),
        ("scatter", scatter()),
        ("trajectories", trajectories()),
        ("histogram", histogram()),
    ];
    let mut report = Report::new("Samples <& escapes>");
    for (name, plot) in &plots {
        plot.write(folder.join(format!("{name}.png")))?;
        plot.write(folder.join(format!("{name}.svg")))?;
        report.section(name).figure(&plot.svg()?, &plot.title);
    }
    for (name, map) in [("deposit", deposit()), ("sensitivity", sensitivity())] {
        map.write(folder.join(format!("{name}.png")))?;
        report.section(name).figure(&map.svg()?, &map.title);
    }
    let speed = [0.1, 0.5, 2.0, 30.0];
    let table = Table::new([
        Column::float("speed", "m/s", speed),
        Column::float("restitution", "", speed.map(|v| curve(v, 0.05))),
        Column::text("fate", ["capture", "rebound", "rebound", "rebound"]),
    ])?;
    print!("{}", table.to_text());
    report.section("Table").paragraph("As in the terminal.").table(&table, "Restitution.");
    report.preformatted("[law.glass]\nnormal = \"ea\"").list(["one", "two"]);
    report.write(folder.join("report.html"))
}

/// A curve with the shape of adhesion at low and damping at high speed; NaN below capture.
fn curve(v: f64, damping: f64) -> f64 {
    let e2 = 1.0 - (0.12 / v).powi(2) - damping * v.powf(0.6);
    if e2 > 0.0 { e2.sqrt() } else { f64::NAN }
}

fn speeds(n: usize) -> Vec<f64> {
    (0..n).map(|i| 0.05 * 600_f64.powf(i as f64 / (n - 1) as f64)).collect()
}

fn restitution() -> Plot {
    let v = speeds(300);
    let e = |damping: f64| v.iter().map(move |v| curve(*v, damping)).collect::<Vec<_>>();
    Plot::new(
        "Copper on glass, 90 µm",
        Axis::new("incident normal speed", "m/s").log(),
        Axis::new("restitution", "").range(0.0, 1.0),
    )
    .with(Series::line("C_H = 0.05 s/m", v.clone(), e(0.05)))
    .with(Series::line("C_H = 0.02 s/m", v.clone(), e(0.02)).dashed())
    .with(Series::line("C_H = 0.08 s/m", v.clone(), e(0.08)).dash(Dash::Dotted))
    .with(Series::band("5–95 %", v.clone(), e(0.06), e(0.04)).color(Color::BLUE))
    .reference(Reference::vertical(0.12, "capture velocity"))
    .reference(Reference::vertical(0.17, "yield velocity"))
    .reference(Reference::horizontal(0.9, "e = 0.9"))
}

fn scatter() -> Plot {
    let x: Vec<f64> = (1..=14).map(|i| f64::from(i) * 6.0).collect();
    let y = |shift: f64| x.iter().map(move |a| 0.6 + shift + 0.003 * a + 0.05 * (a * 1.7).sin()).collect::<Vec<_>>();
    let marks = [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Cross];
    let mut plot = Plot::new("Restitution by angle", Axis::new("incidence angle", "deg"), Axis::new("e", ""));
    for (i, mark) in marks.into_iter().enumerate() {
        let series = Series::points(format!("set {}", i + 1), x.clone(), y(-0.15 * i as f64))
            .marker(mark)
            .deviation(vec![0.03; x.len()]);
        plot = plot.with(series);
    }
    plot
}

fn trajectories() -> Plot {
    let mut plot = Plot::new("Trajectories", Axis::new("x", "m"), Axis::scaled("y", "mm", 1e3))
        .wall([0.0, 0.0], [0.4, 0.0])
        .wall([0.0, 0.06], [0.4, 0.06]);
    for start in 0..5 {
        let (mut x, mut y, mut vy) = (0.0, 0.02 + 0.007 * f64::from(start), 0.0);
        let (mut xs, mut ys) = (vec![], vec![]);
        while x < 0.4 {
            xs.push(x);
            ys.push(y);
            vy -= 9.81 * 0.0005;
            y += vy * 0.0005;
            x += 0.0007;
            if y < 0.0 {
                (y, vy) = (-y, -0.8 * vy);
            }
        }
        plot = plot.with(Series::line(format!("particle {start}"), xs, ys));
    }
    plot.y.factor = 1.0;
    plot.y.unit = "m".to_owned();
    plot.equal_aspect()
}

fn histogram() -> Plot {
    let edges: Vec<f64> = (0..=30).map(|i| f64::from(i) * 5e-6).collect();
    let heights = edges.windows(2).map(|e| {
        let z = ((e[0] + 2.5e-6) / 70e-6_f64).ln() / 0.3;
        (1000.0 * (-0.5 * z * z).exp()).round()
    });
    Plot::new("Captured by diameter", Axis::scaled("diameter", "µm", 1e6), Axis::new("particles", ""))
        .with(Series::bars("captured", edges.clone(), heights.collect::<Vec<_>>()))
}

fn deposit() -> HeatMap {
    let x: Vec<f64> = (0..=60).map(|i| f64::from(i) / 60.0).collect();
    let z: Vec<f64> = (0..=24).map(|i| f64::from(i) / 240.0).collect();
    let values: Vec<f64> = (0..24 * 60)
        .map(|i| {
            let (a, b) = (f64::from(i % 60) / 60.0, f64::from(i / 60) / 24.0);
            let v = 1e-9 * (-8.0 * (a - 0.4).powi(2) - 10.0 * (b - 0.5).powi(2)).exp() * (1.2 + (9.0 * a).sin());
            if v < 2e-11 { f64::NAN } else { v }
        })
        .collect();
    HeatMap::new(
        "Deposit on the floor",
        Axis::new("x", "m"),
        Axis::new("z", "m"),
        Axis::scaled("mass", "mg", 1e6).log(),
    )
    .cells(x, z, values)
}

fn sensitivity() -> HeatMap {
    let d: Vec<f64> = (0..=40).map(|i| 1e-6 * 100_f64.powf(f64::from(i) / 40.0)).collect();
    let angle: Vec<f64> = (0..=30).map(|i| f64::from(i) * 3.0).collect();
    let values = (0..30 * 40).map(|i| (PI * f64::from(i % 40) / 40.0).cos() * (0.05 * f64::from(i / 40)).exp() - 0.3);
    HeatMap::new(
        "Sensitivity",
        Axis::scaled("diameter", "µm", 1e6).log(),
        Axis::new("angle", "deg"),
        Axis::new("∂e/∂ln γ", ""),
    )
    .cells(d, angle, values.collect::<Vec<_>>())
    .colors(ColorMap::Diverging)
}
