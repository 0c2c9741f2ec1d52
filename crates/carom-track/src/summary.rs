//! What a run came to: counts, and masses summed without rounding.

use crate::deposition::{Bins, Brought, Cell, Deposition, Faces, Sorter};
use crate::exact_sum::ExactSum;
use crate::record::{End, Event, ImpactRecord, ParticleFate};
use carom::removal::Mode;
use carom::validity::CODES;
use serde::Serialize;
use serde::ser::SerializeMap;

/// How many fates there are.
const FATES: usize = ParticleFate::ALL.len();

/// How many, and how much of it, kg.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, serde::Deserialize)]
pub struct Amount {
    /// Particles (parcels where they stand for more than one).
    pub count: u64,
    /// Mass.
    pub mass: ExactSum,
}

impl Amount {
    pub(crate) fn add(&mut self, mass: f64) {
        self.count += 1;
        self.mass.add(mass);
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        self.count += other.count;
        self.mass.merge(&other.mass);
    }
}

/// What happened at one wall.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, serde::Deserialize)]
pub struct WallTally {
    /// Its name.
    pub name: String,
    /// Impacts on it, the last ones included.
    pub impacts: u64,
    /// Rebounds from it.
    pub rebounds: u64,
    /// Ends at it, by fate in the order of [`ParticleFate::ALL`].
    pub ends: [Amount; FATES],
    /// How many the flow took off it again by rolling, sliding and lifting.
    pub removed: [u64; 3],
    /// Impacts whose outcome carried each validity code, in the order of [`CODES`].
    pub doubts: [u64; CODES.len()],
    /// Mass of it that impacts took away, kg, where it has a law of erosion.
    #[serde(default)]
    pub eroded: Option<ExactSum>,
}

/// A run, or a part of one. Parts add up to the whole, to the bit, in any order.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, serde::Deserialize)]
pub struct Summary {
    /// Title of the case.
    pub title: String,
    /// All that was injected.
    pub injected: Amount,
    /// By fate, in the order of [`ParticleFate::ALL`].
    pub fates: [Amount; FATES],
    /// By wall.
    pub walls: Vec<WallTally>,
    /// What walls kept, by region and size bin.
    pub deposition: Deposition,
    /// What happened on the faces of walls made of triangles.
    pub faces: Faces,
    /// Particles left where they were because their steps ran out; they count as airborne.
    pub stalled: u64,
    /// Particles that began or went outside the table of the flow.
    #[serde(default)]
    pub strayed: u64,
}

impl Summary {
    /// Nothing yet.
    pub fn new(title: &str, walls: impl Iterator<Item = String>, bins: &Bins) -> Self {
        let walls: Vec<_> = walls.map(|name| WallTally { name, ..WallTally::default() }).collect();
        Self { title: title.to_owned(), walls, deposition: Deposition::new(bins), ..Self::default() }
    }

    /// Nothing yet of a part, to be added to a whole that knows the names.
    pub(crate) fn part(walls: usize, bins: &Bins) -> Self {
        Self { walls: vec![WallTally::default(); walls], deposition: Deposition::new(bins), ..Self::default() }
    }

    /// How many ended that way.
    pub fn count(&self, fate: ParticleFate) -> u64 {
        self.fates[fate as usize].count
    }

    /// Particles without a fate: always 0.
    pub fn lost(&self) -> u64 {
        let ended = self.fates.iter().map(|f| f.count).sum::<u64>();
        debug_assert!(ended <= self.injected.count, "more ends than starts");
        self.injected.count.saturating_sub(ended)
    }

    /// The validity codes that impacts carried, and how many did.
    pub fn doubts(&self) -> impl Iterator<Item = (&'static str, u64)> {
        counted((0..CODES.len()).map(|i| self.walls.iter().map(|w| w.doubts[i]).sum()))
    }

    pub(crate) fn start(&mut self, mass: f64) {
        self.injected.add(mass);
    }

    pub(crate) fn impact(&mut self, impact: &ImpactRecord, brought: &Brought) {
        self.faces.impact(impact, brought);
        if let Some(wall) = self.walls.get_mut(impact.wall) {
            if let Some(eroded) = brought.eroded {
                wall.eroded.get_or_insert_default().add(eroded);
            }
            wall.impacts += 1;
            wall.rebounds += u64::from(impact.event == Event::Rebound);
            if let Event::Remove(mode) = impact.event {
                wall.removed[mode as usize] += 1;
            }
            if !impact.validity.is_empty() {
                for (count, (_, code, _)) in wall.doubts.iter_mut().zip(CODES) {
                    *count += u64::from(impact.validity.contains(code));
                }
            }
        }
    }

    /// Counts what settled at the end of a contact motion on the face where it did.
    pub(crate) fn contact_ended(&mut self, row: &ImpactRecord, brought: &Brought) {
        if row.event == Event::Settle {
            self.faces.impact(row, &Brought { eroded: None, ..*brought });
        }
    }

    /// Counts an end; its deposit's cell, if it left one, is the caller's to keep.
    pub(crate) fn end(&mut self, end: &End, sorter: &Sorter) -> Option<(Cell, f64)> {
        let mass = end.particle.mass();
        self.fates[end.fate as usize].add(mass);
        if let Some(wall) = end.wall.and_then(|w| self.walls.get_mut(w)) {
            wall.ends[end.fate as usize].add(mass);
        }
        self.deposition.end(sorter, end)
    }

    /// Adds another part.
    pub fn merge(&mut self, other: &Self) {
        self.injected.merge(&other.injected);
        for (a, b) in self.fates.iter_mut().zip(&other.fates) {
            a.merge(b);
        }
        for (a, b) in self.walls.iter_mut().zip(&other.walls) {
            a.impacts += b.impacts;
            a.rebounds += b.rebounds;
            a.removed.iter_mut().zip(b.removed).for_each(|(a, b)| *a += b);
            for (a, b) in a.ends.iter_mut().zip(&b.ends) {
                a.merge(b);
            }
            if let Some(eroded) = &b.eroded {
                a.eroded.get_or_insert_default().merge(eroded);
            }
            a.doubts.iter_mut().zip(b.doubts).for_each(|(a, b)| *a += b);
        }
        self.deposition.merge(&other.deposition);
        self.faces.merge(&other.faces);
        self.stalled += other.stalled;
        self.strayed += other.strayed;
    }

    /// The text of `summary.json`.
    ///
    /// # Errors
    /// What the writer says.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        Ok(serde_json::to_string_pretty(&Report(self))? + "\n")
    }
}

/// The codes that occurred, with their counts.
fn counted(counts: impl Iterator<Item = u64>) -> impl Iterator<Item = (&'static str, u64)> {
    CODES.iter().map(|(code, _, _)| *code).zip(counts).filter(|(_, count)| *count > 0)
}

struct Report<'a>(&'a Summary);
struct Fates<'a>(&'a Summary);
struct Masses<'a>(&'a [Amount; FATES]);
struct Walls<'a>(&'a [WallTally]);
struct One<'a>(&'a WallTally);
struct Modes([u64; 3]);
struct Doubts<'a>(&'a [(&'static str, u64)]);

impl Serialize for Report<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let s = self.0;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("title", &s.title)?;
        map.serialize_entry("injected", &s.injected.count)?;
        map.serialize_entry("fates", &Fates(s))?;
        map.serialize_entry("injected_mass", &s.injected.mass.value())?;
        map.serialize_entry("masses", &Masses(&s.fates))?;
        map.serialize_entry("walls", &Walls(&s.walls))?;
        map.serialize_entry("stalled", &s.stalled)?;
        map.serialize_entry("outside_table", &s.strayed)?;
        map.serialize_entry("validity", &Doubts(&s.doubts().collect::<Vec<_>>()))?;
        map.end()
    }
}

impl Serialize for Fates<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for fate in ParticleFate::ALL {
            map.serialize_entry(fate.name(), &self.0.count(fate))?;
        }
        map.serialize_entry("lost", &self.0.lost())?;
        map.end()
    }
}

impl Serialize for Masses<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(ParticleFate::ALL.into_iter().map(|f| (f.name(), self.0[f as usize].mass.value())))
    }
}

impl Serialize for Walls<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|w| (&w.name, One(w))))
    }
}

impl Serialize for Doubts<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}

impl Serialize for One<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("impacts", &self.0.impacts)?;
        map.serialize_entry("rebounds", &self.0.rebounds)?;
        for fate in ParticleFate::AT_WALLS {
            let amount = &self.0.ends[fate as usize];
            map.serialize_entry(fate.name(), &amount.count)?;
            map.serialize_entry(&format!("{}_mass", fate.name()), &amount.mass.value())?;
        }
        if let Some(eroded) = &self.0.eroded {
            map.serialize_entry("eroded_mass", &eroded.value())?;
        }
        map.serialize_entry("removed_by", &Modes(self.0.removed))?;
        map.serialize_entry("validity", &Doubts(&counted(self.0.doubts.into_iter()).collect::<Vec<_>>()))?;
        map.end()
    }
}

impl Serialize for Modes {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(Mode::ALL.iter().zip(self.0).map(|(mode, count)| (mode.name(), count)))
    }
}
