//! Deposition velocities of a case: what is kept on each side of a stretch, over what passes through it.

use crate::section::Section;
use crate::study::{CaseFile, Result, in_parallel, wilson};
use carom_track::Case;
use carom_track::record::{End, ParticleFate, Sink};
use std::path::Path;

/// Spheres that a thread tracks at a time.
const BLOCK: u64 = 250;

/// A case and where its deposits are counted.
#[derive(Clone)]
pub struct Setup {
    pub name: String,
    pub file: CaseFile,
    pub section: Section,
    /// The mean speed of a channel with the walls' friction velocity, m/s.
    pub speed: f64,
    /// Deposits are counted between these, m; the first stretch is there to forget how the spheres started.
    pub stretch: [f64; 2],
    pub diameter: f64,
    pub count: i64,
}

/// V on ceiling, walls and floor, m/s, each with a 95 % interval: lower end, value, upper end.
pub type Velocities = [[f64; 3]; 3];

/// A case to be tracked: of a channel there are two, with gravity across and along the plates.
struct Run {
    case: Case,
    upright: bool,
}

/// What was counted: spheres kept on ceiling, walls and floor, those that came as far as the stretch, and the length of it that they passed, m.
#[derive(Clone, Copy, Default)]
struct Tally {
    kept: [f64; 3],
    reached: f64,
    passed: f64,
}

impl Tally {
    fn plus(self, other: Self) -> Self {
        Self {
            kept: [0, 1, 2].map(|s| self.kept[s] + other.kept[s]),
            reached: self.reached + other.reached,
            passed: self.passed + other.passed,
        }
    }
}

/// The deposition velocities of each setup, by as many threads as there are cores.
pub fn velocities(setups: &[Setup], out: &Path) -> Result<Vec<Velocities>> {
    let mut runs = Vec::new();
    for (s, setup) in setups.iter().enumerate() {
        runs.extend(setup.runs(&out.join(format!("section-{s}.vtk")))?.into_iter().map(|run| (s, run)));
    }
    let blocks = |(r, (_, run)): (usize, &(usize, Run))| (0..run.case.count().div_ceil(BLOCK)).map(move |b| (r, b));
    let jobs: Vec<(usize, u64)> = runs.iter().enumerate().flat_map(blocks).collect();
    let found = in_parallel(jobs.len(), |job| {
        let (r, block) = jobs[job];
        let (s, run) = &runs[r];
        Ok(setups[*s].tally(run, block))
    })?;
    let mut tallies = vec![[Tally::default(); 2]; setups.len()];
    for ((r, _), tally) in jobs.iter().zip(found) {
        let (s, run) = &runs[*r];
        let sum = &mut tallies[*s][usize::from(run.upright)];
        *sum = sum.plus(tally);
    }
    setups.iter().zip(tallies).map(|(setup, [across, along])| setup.evaluate(across, along)).collect()
}

impl Setup {
    fn runs(&self, mesh: &Path) -> Result<Vec<Run>> {
        let end = self.stretch[1];
        let mut file = self.file.clone().set("flow.mean_speed", self.speed);
        file = file.set_each("injection", "diameter", format!("{:e} m", self.diameter));
        file = file.set_each("injection", "count", self.count);
        for wall in file.list("wall") {
            if wall.get("name").and_then(toml::Value::as_str) == Some("outlet") {
                let plane = [("point", vec![end, 0.0, 0.0]), ("normal", vec![-1.0, 0.0, 0.0])];
                let plane: toml::Table = plane.into_iter().map(|(key, v)| (key.to_owned(), v.into())).collect();
                wall.insert("plane".into(), plane.into());
            }
        }
        let file = self.section.put(file, self.speed, end, mesh)?;
        let mut runs = vec![Run { case: file.case()?, upright: false }];
        if matches!(self.section, Section::Channel | Section::Meshed) {
            // gravity along the plates, or none, as between mirrors: they are side walls
            let along = if self.section == Section::Channel { -9.81 } else { 0.0 };
            let upright = file.set("forces.gravity", vec![0.0, 0.0, along]);
            runs.push(Run { case: upright.case()?, upright: true });
        }
        Ok(runs)
    }

    fn tally(&self, run: &Run, block: u64) -> Tally {
        let numbers = block * BLOCK..((block + 1) * BLOCK).min(run.case.count());
        let mut ends = Ends(Vec::new());
        run.case
            .tracker()
            .run(&mut numbers.filter_map(|n| run.case.particle(n)), &mut ends)
            .expect("a case's tracker is whole");
        let [from, to] = self.stretch;
        let mut tally = Tally::default();
        for end in ends.0.iter().filter(|e| e.position[0] >= from) {
            tally.reached += 1.0;
            tally.passed += end.position[0].min(to) - from;
            let stays = matches!(end.fate, ParticleFate::Trapped | ParticleFate::Captured | ParticleFate::Settled);
            let side = self.section.side(end.position).filter(|_| stays && end.position[0] < to);
            if let Some(side) = side {
                tally.kept[if run.upright { 1 } else { side }] += 1.0;
            }
        }
        tally
    }

    /// V = n U A/(b ∫N dx): n kept on a side, N the spheres that pass x, A the area of the section and b the plates' width.
    fn evaluate(&self, across: Tally, along: Tally) -> Result<Velocities> {
        let (speed, width) = self.section.mean_and_width(self.speed)?;
        let of = |tally: Tally, side: usize, sides: f64| {
            let n = tally.kept[side];
            let chances = sides * tally.reached;
            let (low, high) = wilson(n / chances, chances);
            [low * chances, n, high * chances].map(|n| n * speed * width / (sides * tally.passed))
        };
        // two plates, or two side walls
        let walls = if along.reached > 0.0 { along } else { across };
        eprintln!("{}: kept {:?} and {:?}, passed {} m", self.name, across.kept, along.kept, across.passed.round());
        Ok([of(across, 0, 1.0), of(walls, 1, 2.0), of(across, 2, 1.0)])
    }
}

/// How the spheres ended, and nothing else.
struct Ends(Vec<End>);

impl Sink for Ends {
    fn end(&mut self, end: &End) {
        self.0.push(*end);
    }
}
