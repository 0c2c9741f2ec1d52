//! What the studies share: a case file with some keys changed, its spheres tracked one by one, a place for figures.

#![allow(dead_code, reason = "each study uses a part of it")]

use carom::material::Library;
use carom_track::Case;
use carom_track::force::Sphere;
use carom_track::force::brownian::diffusivity;
use carom_track::record::{End, Event, ImpactRecord, ParticleFate, Sink};
use carom_track::tracker::Particle;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The density of the spheres whose sizes are aerodynamic diameters, kg/m³.
pub const UNIT_DENSITY: f64 = 1000.0;

/// Whatever may go wrong.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// A case file of `examples/`, with keys changed.
#[derive(Clone)]
pub struct CaseFile {
    table: toml::Table,
    name: PathBuf,
}

impl CaseFile {
    /// Reads `examples/NAME`.
    pub fn read(name: &str) -> Result<Self> {
        let name = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name);
        let text = std::fs::read_to_string(&name).map_err(|e| format!("{}: {e}", name.display()))?;
        Ok(Self { table: text.parse()?, name })
    }

    /// Changes what stands at a dotted key; numbers count through arrays: `wall.0.contact_at`.
    pub fn set(mut self, key: &str, value: impl Into<toml::Value>) -> Self {
        let mut keys: Vec<&str> = key.split('.').collect();
        let last = keys.pop().unwrap_or_default();
        let mut table = &mut self.table;
        for step in keys {
            let next = table.entry(step).or_insert_with(|| toml::Table::new().into());
            table = match next {
                toml::Value::Table(inner) => inner,
                _ => panic!("{key}: {step} is no table"),
            };
        }
        table.insert(last.to_owned(), value.into());
        self
    }

    /// Takes a dotted key out.
    pub fn without(mut self, key: &str) -> Self {
        let mut keys: Vec<&str> = key.split('.').collect();
        let last = keys.pop().unwrap_or_default();
        let inner = keys.iter().try_fold(&mut self.table, |t, k| t.get_mut(*k).and_then(toml::Value::as_table_mut));
        if let Some(table) = inner {
            table.remove(last);
        }
        self
    }

    /// Changes a key of every entry of a list of tables: `wall`, `injection`.
    pub fn set_each(mut self, list: &str, key: &str, value: impl Into<toml::Value>) -> Self {
        let value = value.into();
        for entry in self.list(list) {
            entry.insert(key.to_owned(), value.clone());
        }
        self
    }

    /// The entries of a list of tables.
    pub fn list(&mut self, list: &str) -> Vec<&mut toml::Table> {
        let entries = self.table.get_mut(list).and_then(toml::Value::as_array_mut);
        entries.into_iter().flatten().filter_map(toml::Value::as_table_mut).collect()
    }

    /// The checked case.
    pub fn case(&self) -> Result<Case> {
        let text = toml::to_string(&self.table)?;
        let case = Case::from_toml(&text, &self.name, Library::builtin());
        Ok(case.map_err(|e| e.located(&self.name.to_string_lossy(), &text))?)
    }
}

/// One sphere's history.
pub struct Track {
    /// Its impacts, the last one included.
    pub impacts: Vec<ImpactRecord>,
    /// Points of its path: t, x, y, z.
    pub path: Vec<[f64; 4]>,
    /// How it ended.
    pub end: End,
}

impl Track {
    /// Rebounds before it ended.
    pub fn bounces(&self) -> usize {
        self.impacts.iter().filter(|i| i.event == Event::Rebound).count()
    }
}

/// Whether the points of the paths are wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Paths {
    Kept,
    Dropped,
}

/// Tracks every sphere of a case, in the order of their numbers.
pub fn track(case: &Case, paths: Paths) -> Vec<Track> {
    let mut all = Collector { paths, open: (0..case.count()).map(|_| Open::default()).collect() };
    case.tracker()
        .run(&mut (0..case.count()).filter_map(|n| case.particle(n)), &mut all)
        .expect("a case's tracker is whole");
    all.open.into_iter().filter_map(|o| Some(Track { impacts: o.impacts, path: o.path, end: o.end? })).collect()
}

#[derive(Default)]
struct Open {
    impacts: Vec<ImpactRecord>,
    path: Vec<[f64; 4]>,
    end: Option<End>,
}

struct Collector {
    paths: Paths,
    open: Vec<Open>,
}

impl Sink for Collector {
    fn start(&mut self, _: &Particle) -> bool {
        self.paths == Paths::Kept
    }
    fn impact(&mut self, impact: &ImpactRecord) {
        self.open[impact.particle as usize].impacts.push(*impact);
    }
    fn contact_ended(&mut self, row: &ImpactRecord) {
        self.impact(row);
    }
    fn point(&mut self, particle: u64, t: f64, x: [f64; 3], _: [f64; 3], _: [f64; 3]) {
        self.open[particle as usize].path.push([t, x[0], x[1], x[2]]);
    }
    fn end(&mut self, end: &End) {
        self.open[end.particle.number as usize].end = Some(*end);
    }
}

/// The folder for figures: the first argument.
pub fn out_dir() -> Result<PathBuf> {
    let dir = std::env::args_os().nth(1).map(PathBuf::from).ok_or("give a folder for the figures")?;
    std::fs::create_dir_all(&dir)?;
    Ok(dir)
}

/// A figure's file: SVG, or PNG where the second argument is `png`.
pub fn figure(dir: &Path, name: &str) -> PathBuf {
    let png = std::env::args().nth(2).is_some_and(|a| a == "png");
    dir.join(name).with_extension(if png { "png" } else { "svg" })
}

/// `n` values at equal ratios from `from` to `to`.
pub fn logspace(from: f64, to: f64, n: usize) -> Vec<f64> {
    (0..n).map(|i| from * (to / from).powf(i as f64 / (n - 1) as f64)).collect()
}

/// `n` values at equal steps from `from` to `to`.
pub fn linspace(from: f64, to: f64, n: usize) -> Vec<f64> {
    (0..n).map(|i| from + (to - from) * i as f64 / (n - 1) as f64).collect()
}

/// A length as a case file writes it.
pub fn meters(x: f64) -> String {
    format!("{x:e} m")
}

/// The results of `count` jobs, in order, by as many threads as there are cores.
pub fn in_parallel<T: Send>(
    count: usize,
    job: impl Fn(usize) -> std::result::Result<T, String> + Sync,
) -> std::result::Result<Vec<T>, String> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    if i >= count {
                        break;
                    }
                    let result = job(i);
                    done.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push((i, result));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    done.sort_by_key(|(i, _)| *i);
    done.into_iter().map(|(_, result)| result).collect()
}

/// The 95 % interval of a share found among `n` (Wilson 1927).
pub fn wilson(share: f64, n: f64) -> (f64, f64) {
    let z2 = 1.96f64.powi(2) / n;
    let middle = (share + 0.5 * z2) / (1.0 + z2);
    let half = (z2 * (share * (1.0 - share) + 0.25 * z2)).sqrt() / (1.0 + z2);
    ((middle - half).max(0.0), middle + half)
}

/// Penetration of a laminar pipe by diffusion, over µ = π D L/Q (Gormley & Kennedy 1949, Proc. R. Ir. Acad. 52A, 163–169).
pub fn gormley_kennedy(mu: f64) -> f64 {
    if mu < 0.02 {
        let root = mu.cbrt();
        return 1.0 - 2.5638 * root * root + 1.2 * mu + 0.1767 * mu * root;
    }
    let terms: [(f64, f64); 4] = [(0.81905, 3.6568), (0.09753, 22.305), (0.0325, 56.961), (0.01544, 107.62)];
    terms.iter().map(|(c, k)| c * (-k * mu).exp()).sum()
}

/// Penetration of a horizontal laminar pipe by settling, over κ = 3 v_s L/(4 d U) (Fuchs 1964, The Mechanics of Aerosols; Thomas 1958).
pub fn fuchs(kappa: f64) -> f64 {
    if kappa >= 1.0 {
        return 0.0;
    }
    let third = kappa.cbrt();
    let root = (1.0 - third * third).sqrt();
    1.0 - 2.0 / std::f64::consts::PI * (2.0 * kappa * root - third * root + third.asin())
}

/// What a sphere does in a case's fluid: diffusivity (m²/s) and settling speed under 9.81 m/s².
pub fn diffusivity_and_settling(case: &Case, diameter: f64) -> [f64; 2] {
    let sphere = Sphere { diameter, density: UNIT_DENSITY };
    let (dynamics, fluid) = (&case.dynamics, &case.dynamics.fluid);
    let buoyed = 9.81 * (1.0 - fluid.density / UNIT_DENSITY);
    [diffusivity(fluid, &sphere, dynamics.slip(&sphere)), buoyed * dynamics.relaxation_time(&sphere)]
}

/// Spheres that came through, and all that started off the walls.
pub fn through(case: &Case) -> (f64, f64) {
    let tracks = track(case, Paths::Dropped);
    let of = |fate| tracks.iter().filter(|t| t.end.fate == fate).count() as f64;
    (of(ParticleFate::Escaped), tracks.len() as f64 - of(ParticleFate::Overlapping))
}
