//! The wind tunnel of Kim & Dunn (2007), section 7 (Figs 11 and 12), by carom's tracker. The case files in `examples/` say what
//! the paper leaves open and what is assumed for it.

use crate::error::LabError;
use carom::material::Library;
use carom_report::plot::Legend;
use carom_report::{Axis, Color, Plot, Series};
use carom_track::Case;
use carom_track::record::{End, ImpactRecord, ParticleFate, Sink};
use carom_track::tracker::Particle;
use serde::Serialize;
use std::path::Path;

const DROPPED: &str = include_str!("../data/cases/wind-tunnel.toml");
const THROWN: &str = include_str!("../data/cases/wind-tunnel-upward.toml");

/// The elastic walls that Fig. 12 compares with: e = 1, tangentially too.
const ELASTIC: &str = "normal = \"constant\"\nrestitution = 1.0\ntangential_restitution = 1.0\n";

/// Height of the tunnel in both case files, m.
const HEIGHT: f64 = 0.056;

/// One sphere's way.
#[derive(Clone, Debug, Serialize)]
pub struct Way {
    /// Figure of Kim & Dunn (2007).
    pub figure: &'static str,
    /// The case file.
    pub case: &'static str,
    /// What it is.
    pub label: String,
    /// Diameter, m.
    pub diameter: f64,
    /// Impacts before its end, the last included.
    pub impacts: usize,
    /// How many the paper states, the last included.
    pub impacts_stated: Option<usize>,
    /// Where along the tunnel it first hits the floor, m.
    pub first_floor_impact: Option<f64>,
    /// How it ends.
    pub fate: &'static str,
    /// Where along the tunnel its flight ends, m: captured, or bouncing no more and sliding on for as long as it is followed.
    pub end: f64,
    /// Along the tunnel, m.
    #[serde(skip)]
    pub x: Vec<f64>,
    /// Above the floor, m.
    #[serde(skip)]
    pub y: Vec<f64>,
}

#[derive(Default)]
struct Follow {
    points: Vec<(u64, f64, f64)>,
    impacts: Vec<ImpactRecord>,
    ends: Vec<End>,
}

impl Sink for Follow {
    fn start(&mut self, _: &Particle) -> bool {
        true
    }
    fn impact(&mut self, impact: &ImpactRecord) {
        self.impacts.push(*impact);
    }
    fn point(&mut self, particle: u64, _: f64, x: [f64; 3], _: [f64; 3], _: [f64; 3]) {
        self.points.push((particle, x[0], x[1]));
    }
    fn end(&mut self, end: &End) {
        self.ends.push(*end);
    }
}

/// Follows the spheres of Figs 11 and 12.
///
/// # Errors
/// A case file that does not fit the library.
pub fn paths(library: &Library) -> Result<Vec<Way>, LabError> {
    let mut paths = track(("11", "examples/wind-tunnel.toml"), "", DROPPED, library)?;
    let thrown = ("12", "examples/wind-tunnel-upward.toml");
    paths.extend(track(thrown, "EA", THROWN, library)?);
    let head = THROWN.split("[law.aluminium]").next().unwrap_or_default();
    paths.extend(track(thrown, "e = 1", &format!("{head}[law.aluminium]\n{ELASTIC}"), library)?);
    Ok(paths)
}

fn track(
    (figure, case_file): (&'static str, &'static str),
    walls: &str,
    text: &str,
    library: &Library,
) -> Result<Vec<Way>, LabError> {
    let case = Case::from_toml(text, Path::new(case_file), library).map_err(|error| LabError::Experiment {
        name: case_file.into(),
        text: text.into(),
        error,
    })?;
    let mut follow = Follow::default();
    case.tracker().run(&mut (0..case.count()).filter_map(|n| case.particle(n)), &mut follow)?;
    follow.ends.sort_by_key(|e| e.particle.number);
    let way = |end: &End| {
        let number = end.particle.number;
        let mine: Vec<&ImpactRecord> = follow.impacts.iter().filter(|i| i.particle == number).collect();
        let line: Vec<&(u64, f64, f64)> = follow.points.iter().filter(|p| p.0 == number).collect();
        let size = format!("{:.0} µm", end.particle.diameter * 1e6);
        Way {
            figure,
            case: case_file,
            label: if walls.is_empty() { size } else { format!("{size}, {walls}") },
            diameter: end.particle.diameter,
            impacts: mine.len(),
            impacts_stated: stated(figure, walls, end.particle.diameter),
            first_floor_impact: mine.iter().find(|i| i.normal[1] > 0.5).map(|i| i.position[0]),
            fate: end.fate.name(),
            end: match (end.fate, mine.last()) {
                (ParticleFate::Sliding, Some(last)) => last.position[0],
                _ => end.position[0],
            },
            x: line.iter().map(|p| p.1).collect(),
            y: line.iter().map(|p| p.2).collect(),
        }
    };
    Ok(follow.ends.iter().map(way).collect())
}

/// Impacts that section 7 of the paper states: two bounces and capture, capture at once; a bounce off the upper wall and capture.
fn stated(figure: &str, walls: &str, diameter: f64) -> Option<usize> {
    match (figure, walls) {
        ("11", _) => Some(if diameter > 80e-6 { 3 } else { 1 }),
        ("12", "EA") => Some(2),
        _ => None,
    }
}

/// The paths of a figure.
pub fn plot(figure: &str, paths: &[Way]) -> Plot {
    let title = match figure {
        "11" => "Copper spheres let fall into the tunnel",
        _ => "A silver-coated glass sphere thrown upward",
    };
    let mine = || paths.iter().filter(|p| p.figure == figure);
    let far = mine().flat_map(|p| p.x.iter().copied()).fold(0.0, f64::max);
    let mut plot = Plot::new(title, Axis::scaled("along the tunnel", "mm", 1e3), Axis::scaled("height", "mm", 1e3));
    for (n, path) in mine().enumerate() {
        plot = plot.with(Series::line(&path.label, path.x.clone(), path.y.clone()).color(Color::cycle(n)));
    }
    plot.wall([0.0, 0.0], [far, 0.0]).wall([0.0, HEIGHT], [far, HEIGHT]).legend(Legend::Outside)
}
