//! The case file: what to track, in what, between which walls.
//!
//! Read with places, so that every error points at the line: unknown keys, wrong units, unknown laws and materials (with
//! the nearest known one), walls that contradict each other, injections inside a wall, a run that nothing would end.

mod cells;
mod check;
mod erosion;
mod files;
mod flow;
mod fluid;
mod injection;
mod particles;
mod removal;
mod scale;
mod text;
mod triangles;
mod wall;
mod wall_cells;
mod whole;

pub use files::Sources;
pub(crate) use files::{Fingerprint, LARGEST};
pub use injection::Injected;

use crate::deposition::{Bins, Region};
use crate::domain::{AnyDomain, Wall};
use crate::dynamics::Dynamics;
use crate::flow::Flow;
use crate::injection::Start;
use crate::tables::TableFormat;
use crate::tracker::{Behavior, Particle, Settings, SettleHeight, Tracker};
use carom::erosion::Erosion;
use carom::material::{Library, Material};
use carom::{Impact, LawError};
use check::{positive, wrong};
use files::Files;
use std::ops::Range;
use std::path::{Path, PathBuf};
use text::{CaseText, OutputText, RunText, Si};

/// What is wrong in a case file, where, and what would be right.
pub type CaseError = LawError;

/// A checked case, ready to run.
#[derive(Debug)]
pub struct Case {
    /// Its title.
    pub title: String,
    /// The file it came from.
    pub name: PathBuf,
    /// Flow and walls.
    pub domain: AnyDomain,
    /// What acts on the spheres.
    pub dynamics: Dynamics,
    /// What each wall does.
    pub behaviors: Vec<Behavior>,
    /// What impacts take away of each wall.
    pub erosion: Vec<Option<Erosion>>,
    /// The injections, in the order of particle numbers.
    pub injections: Vec<Injected>,
    /// How it is tracked.
    pub settings: Settings,
    /// How many particles' trajectories are recorded.
    pub trajectories: u64,
    /// How impacts are recorded, if they are.
    pub impacts: Option<TableFormat>,
    /// How the particles' fates are recorded, if they are.
    pub fates: Option<TableFormat>,
    /// Whether trajectories and deposits are written as VTK too.
    pub vtk: bool,
    /// How deposits are sorted.
    pub bins: Bins,
    /// What the case leaves unsaid that one might take for granted.
    pub notes: Vec<String>,
    /// Its text.
    pub text: String,
    /// A number that tells this case from others, for resuming: of its text, of the files it names, and of its materials.
    pub fingerprint: u64,
}

/// Trajectories recorded unless the case says otherwise: as many lines as a plot bears.
const TRAJECTORIES: u64 = 100;
const TOLERANCE: f64 = 1e-5;
const MAX_STEPS: u64 = 10_000_000;

impl Case {
    /// Reads a case. Files it names are looked for beside `name`; materials come from `library`.
    ///
    /// # Errors
    /// What is wrong, with its place in `text` ([`CaseError::located`] puts the line in front).
    pub fn from_toml(text: &str, name: &Path, library: &Library) -> Result<Self, CaseError> {
        Self::from_toml_with(text, name, library, &Sources::default())
    }

    /// As [`Case::from_toml`], with files held in memory: a file that the case names is looked for there first.
    ///
    /// # Errors
    /// As [`Case::from_toml`].
    pub fn from_toml_with(text: &str, name: &Path, library: &Library, sources: &Sources) -> Result<Self, CaseError> {
        let mut read: CaseText = toml::from_str(text)?;
        let laws = carom::spec::parse_laws(text)?;
        let files = Files::new(name, text, sources);
        let seed = read.seed.map_or(1, |s| s.0);
        let (fluid, gas) = fluid::fluid(read.fluid.as_ref())?;
        let gradient = read.fluid.as_ref().and_then(|f| f.value.temperature_gradient.as_ref());
        let mut notes = Vec::new();
        let flow = flow::flow(read.flow.as_ref(), &read.wall, &fluid, &files, &mut notes)?;
        let flow = fluid::in_its_gas(flow, gas, read.flow.as_ref(), &mut notes)?;
        let cells = if let Flow::Cells(cells) = &flow { Some(cells.clone()) } else { None };
        read.wall = cells::walls(read.wall, cells.as_deref())?;
        if let (Some(cells), Some(text)) = (&cells, &read.flow) {
            cells::all_named(cells, &read.wall, text)?;
        }
        let openings = cells::Openings { cells: cells.as_deref(), walls: &read.wall };
        let dynamics = flow::dynamics(&read.forces, (fluid, gas), gradient, flow.varies_gas())?;
        let injections = read
            .injection
            .iter()
            .enumerate()
            .map(|(i, at)| {
                injection::read(at, i, seed, (&fluid, dynamics.forces.slip), &flow, &openings, library, &files)
            })
            .collect::<Result<Vec<_>, _>>()?;
        if injections.is_empty() {
            return Err(LawError::new("the case injects nothing").help("add an [[injection]]"));
        }
        countable(&injections)?;
        injection::distinct(read.injection.iter().filter_map(|i| i.value.name.as_ref()), "injection")?;
        injection::distinct(read.wall.iter().map(|w| &w.value.name), "wall")?;
        let walls = read
            .wall
            .iter()
            .map(|w| wall::read(w, cells.as_deref(), &files, &mut notes))
            .collect::<Result<Vec<_>, _>>()?;
        notes.extend(triangles::left_out(read.wall.iter().filter_map(|w| w.value.stl.as_ref()), &files));
        let largest = injections.iter().map(|i| i.largest).fold(0.0, f64::max);
        wall::contradictions(&read.wall, &walls, largest)?;
        let behaviors = read
            .wall
            .iter()
            .zip(&walls)
            .map(|(at, wall)| {
                let behavior = wall::behavior(at, wall, &laws, &injections, library)?;
                removal::with_removal(behavior, &at.value, &flow, &fluid, largest)
            })
            .collect::<Result<Vec<_>, _>>()?;
        let erosion = read
            .wall
            .iter()
            .zip(&behaviors)
            .map(|(at, behavior)| erosion::of(&at.value, behavior))
            .collect::<Result<Vec<_>, _>>()?;
        unused_laws(&read, &laws, library)?;
        let settings = settings(&read, seed, &behaviors)?;
        injected_in_the_fluid(&walls, &injections, &behaviors)?;
        sampled_starts(&walls, &flow, &injections, &behaviors)?;
        if let Some(cells) = &cells {
            cells::inside(cells, &injections)?;
            cells::chance(cells, &read.forces, gradient, &dynamics)?;
        }
        // materials come from a library that may change: what they are made of tells, and the text tells the rest
        let fingerprint =
            materials(&read, &laws, library).iter().fold(files.fingerprint(), |f, m| f.with_material(m)).number();
        let open = behaviors.iter().map(|b| matches!(b, Behavior::Escape)).collect();
        let rubs = dynamics.random_walk.is_some() || behaviors.iter().any(|b| matches!(b, Behavior::Removal(..)));
        let output = read.output;
        let bins = bins(&output)?;
        notes.extend(read.forces.gravity.is_none().then(|| "no gravity: [forces] gives none".to_owned()));
        notes.extend(fluid::notes(read.fluid.as_ref(), &dynamics, &flow, &injections));
        notes.extend(injections.iter().filter_map(injection::outflow));
        notes.extend(scale::notes(&flow, &walls, &behaviors, &injections));
        notes.extend(wall_cells::note(&flow, &walls, &behaviors, &dynamics, &injections));
        let domain = AnyDomain::new(flow, walls).with_openings(open);
        let domain = if rubs { domain.with_friction(fluid.kinematic_viscosity()) } else { domain };
        Ok(Self {
            title: read.title.unwrap_or_default(),
            name: name.to_owned(),
            domain,
            dynamics,
            behaviors,
            erosion,
            injections,
            settings,
            trajectories: output.trajectories.map_or(TRAJECTORIES, |t| t.value.0),
            impacts: output.impacts.unwrap_or_default().0,
            fates: output.fates.unwrap_or_default().0,
            vtk: output.vtk.unwrap_or(true),
            bins,
            notes,
            text: text.to_owned(),
            fingerprint,
        })
    }

    /// How many particles it injects.
    pub fn count(&self) -> u64 {
        self.injections.iter().map(|i| i.injection.count()).sum()
    }

    /// The numbers of the particles whose paths are recorded: the first ones of each injection, shared out by their counts, and
    /// one at least of each.
    pub fn recorded(&self) -> impl Iterator<Item = Range<u64>> {
        let (all, wanted) = (self.count(), self.trajectories.min(self.count()));
        // rounded down up to any number, so that the shares add up
        let share = move |number: u64| (u128::from(wanted) * u128::from(number) / u128::from(all.max(1))) as u64;
        let mut start = 0;
        self.injections.iter().map(move |injected| {
            let count = injected.injection.count();
            let from = start;
            start += count;
            from..from + (share(start) - share(from)).max(u64::from(wanted > 0)).min(count)
        })
    }

    /// The tracker of this case.
    pub fn tracker(&self) -> Tracker<'_> {
        Tracker { domain: &self.domain, dynamics: &self.dynamics, behaviors: &self.behaviors, settings: self.settings }
    }

    /// The particle of a number below [`Case::count`].
    pub fn particle(&self, number: u64) -> Option<Particle> {
        let mut first = 0;
        for (index, injected) in self.injections.iter().enumerate() {
            let count = injected.injection.count();
            if number < first + count {
                let fluid = |time, x| self.domain.fluid(time, x).velocity;
                let fits = |x, radius| self.domain.geometry().overlap(x, radius).is_none();
                let start = injected.injection.particle_where(number - first, fluid, fits);
                return Some(Particle::new(number, index, &start));
            }
            first += count;
        }
        None
    }
}

/// The materials that a case names, in the order in which it does.
fn materials(read: &CaseText, laws: &wall::Laws, library: &Library) -> Vec<Material> {
    let injected = read.injection.iter().filter_map(|i| i.value.material.as_ref());
    let named = laws.values().flat_map(|law| [law.value.sphere.as_ref(), law.value.surface.as_ref()]).flatten();
    // one that is not in the library is an error where it is used, and nothing where it is not
    injected.chain(named).filter_map(|m| m.value.resolve(library).ok()).collect()
}

/// Particles are counted one by one, and JSON's readers keep no more digits.
const MOST_PARTICLES: u64 = 1 << 53;

fn countable(injections: &[Injected]) -> Result<(), LawError> {
    let mut all = 0u64;
    for injected in injections {
        all = all.saturating_add(injected.injection.count());
        if all > MOST_PARTICLES {
            let message = format!("{} makes {} particles or more in all", injected.name, MOST_PARTICLES + 1);
            let help =
                "at most 2^53 (9007199254740992) can be counted: give fewer, each with a weight (mass and parcels)";
            return Err(LawError::new(message).help(help).at(injected.place.clone()));
        }
    }
    Ok(())
}

/// Laws that no wall uses must be right too.
fn unused_laws(read: &CaseText, laws: &wall::Laws, library: &Library) -> Result<(), LawError> {
    for (name, law) in laws {
        if wall::WORDS.contains(&name.as_str()) {
            let message = format!("a law may not be called '{name}'");
            return Err(wrong(law, message).help("that word has its own meaning at a wall"));
        }
        let used = read.wall.iter().any(|w| w.value.law.value == *name);
        if !used && law.value.sphere.is_some() {
            law.value.compile(library).map_err(|e| e.at(law.span.clone()))?;
        }
    }
    Ok(())
}

fn settings(read: &CaseText, seed: u64, behaviors: &[Behavior]) -> Result<Settings, LawError> {
    let default = RunText::default();
    let run = read.run.as_ref().map_or(&default, |r| &r.value);
    let until = run.until.as_ref().map(|u| positive(u, "until", u.value.0)).transpose()?;
    let way_out = behaviors.iter().any(|b| matches!(b, Behavior::Trap | Behavior::Escape));
    if until.is_none() && !way_out {
        let error = LawError::new("nothing ends this run: neither until nor a wall that traps or lets escape");
        return Err(error.help("give until = \"2 s\" in [run]").at(read.run.as_ref().and_then(|r| r.span.clone())));
    }
    let tolerance = match &run.tolerance {
        None => TOLERANCE,
        Some(t) if t.value.0 >= 1e-12 && t.value.0 <= 1e-2 => t.value.0,
        Some(t) => return Err(wrong(t, format!("tolerance is {}", t.value.0)).help("it lies between 1e-12 and 1e-2")),
    };
    let settle_height = match &run.settle_height {
        None => SettleHeight::DEFAULT,
        Some(h) if h.value.0 >= 0.0 && h.value.0.is_finite() => SettleHeight::Length(h.value.0),
        Some(h) => {
            return Err(wrong(h, format!("settle_height is {}", h.value.0))
                .help("it must be positive, or 0 where no bounce counts as none"));
        }
    };
    let max_steps = run.max_steps.as_ref().map_or(MAX_STEPS, |m| m.value.0.max(1));
    Ok(Settings { tolerance, until: until.unwrap_or(f64::INFINITY), settle_height, max_steps, seed })
}

/// The first spheres of each injection, as they will be: in the fluid, and fit for the laws of the walls.
fn sampled_starts(
    walls: &[Wall],
    flow: &Flow,
    injections: &[Injected],
    behaviors: &[Behavior],
) -> Result<(), LawError> {
    const SAMPLE: u64 = 1000;
    for (index, injected) in injections.iter().enumerate() {
        // of an opening only where there is room
        let opening = injected.injection.plan().source.is_opening();
        for i in 0..injected.injection.count().min(SAMPLE) {
            let start = injected.injection.particle(i, |_, x| flow.velocity(x));
            for (wall, behavior) in walls.iter().zip(behaviors) {
                let reach = 0.5 * start.diameter;
                if !opening && wall.shape.distance(start.position) - wall.clearance(reach) < -1e-9 * reach {
                    let (name, wall, x, d) = (&injected.name, &wall.name, start.position, start.diameter);
                    return Err(LawError::new(format!(
                        "{name} starts inside wall '{wall}': a sphere of {d} m at {x:?} m"
                    ))
                    .help("a normal points out of the wall into the fluid; a sphere needs one radius of room")
                    .at(injected.place.clone()));
                }
                let Some(laws) = behavior.laws() else { continue };
                let Some(law) = laws.get(index).or(laws.first()) else { continue };
                let density = Some(start.density);
                let trial = Impact { density, ..Impact::new(start.diameter, [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]) };
                if let Err(e) = law.impact(&trial) {
                    let message = format!("{} does not fit the law of wall '{}': {e}", injected.name, wall.name);
                    return Err(LawError::new(message).at(injected.place.clone()));
                }
            }
        }
    }
    Ok(())
}

fn bins(output: &OutputText) -> Result<Bins, LawError> {
    injection::distinct(output.region.iter().map(|r| &r.value.name), "region")?;
    let mut sizes = Vec::new();
    if let Some(at) = &output.size_bins {
        sizes = at.value.iter().map(|l| l.0).collect();
        if !sizes.iter().zip(sizes.iter().skip(1)).all(|(a, b)| a < b) || sizes.first().is_some_and(|s| *s <= 0.0) {
            return Err(
                wrong(at, "the edges of size bins do not rise").help("give positive diameters, each above the last")
            );
        }
    }
    let by_face = output.face_sizes.as_ref().is_some_and(|f| f.value);
    if let Some(at) = output.face_sizes.as_ref().filter(|_| by_face && sizes.is_empty()) {
        return Err(wrong(at, "face_sizes without sizes")
            .help("give the edges of the size bins: size_bins = [\"1 um\", \"10 um\"]"));
    }
    let region = |r: &carom::spec::At<text::RegionText>| {
        let (a, b) = (r.value.room[0].si(), r.value.room[1].si());
        let name = r.value.name.value.clone();
        Region { name, min: [0, 1, 2].map(|c| a[c].min(b[c])), max: [0, 1, 2].map(|c| a[c].max(b[c])) }
    };
    Ok(Bins { sizes, by_face, regions: output.region.iter().map(region).collect() })
}

/// No sphere may start inside a wall.
fn injected_in_the_fluid(walls: &[Wall], injections: &[Injected], behaviors: &[Behavior]) -> Result<(), LawError> {
    for injected in injections {
        let plan = injected.injection.plan();
        if plan.source.is_opening() {
            continue;
        }
        for x in injection::hull(&plan.source) {
            for (wall, behavior) in walls.iter().zip(behaviors) {
                let gap = wall.shape.distance(x) - wall.clearance(0.5 * injected.largest);
                let touching = 1e-9 * injected.largest;
                if gap < -touching {
                    let what = if matches!(behavior, Behavior::Escape) { "beyond" } else { "inside" };
                    let message = format!(
                        "{} starts {what} wall '{}': at {x:?} m a sphere of {} m reaches {:.3e} m into it",
                        injected.name, wall.name, injected.largest, -gap
                    );
                    return Err(LawError::new(message)
                        .help(injection::room(&plan.source, wall, 0.5 * injected.largest))
                        .at(injected.place.clone()));
                }
            }
        }
        if let Start::Velocity(v) = plan.velocity
            && !v.iter().all(|c| c.abs() < 1e6)
        {
            return Err(LawError::new(format!("{} starts at {v:?} m/s", injected.name))
                .help("below 1e6 m/s is wanted")
                .at(injected.place.clone()));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
