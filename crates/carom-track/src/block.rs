//! Some particles, tracked to the end: their rows in order, and their part of the summary.

use crate::case::Case;
use crate::deposition::{Brought, Cell, Sorter};
use crate::exact_sum::ExactSum;
use crate::record::columns::Columns;
use crate::record::{End, Event, ImpactRecord, Sink};
use crate::run::RunError;
use crate::run::spill::Spill;
use crate::summary::Summary;
use crate::tables::{DEPOSIT, FATES, IMPACTS, LAYOUTS, TRAJECTORIES, Words, push_deposit, push_end, push_impact};
use crate::tracker::Particle;
use crate::vector::Vec3;
use carom::erosion::Hit;
use std::io;
use std::ops::Range;
use std::path::PathBuf;

/// Particles that a shard is made of: it has whole multiples of them.
pub const SIZE: u64 = 1024;

/// In which forms the rows of a table are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Forms {
    /// As CSV.
    pub text: bool,
    /// As cells of eight bytes.
    pub cells: bool,
    /// As they are.
    pub columns: bool,
}

impl Forms {
    fn any(self) -> bool {
        self.text || self.cells || self.columns
    }
}

/// What is to be recorded, and how.
#[derive(Debug)]
pub(crate) struct Recording<'a> {
    pub case: &'a Case,
    pub forms: [Forms; LAYOUTS.len()],
    pub sorter: Sorter,
    pub words: Words,
    /// Numbers of the particles whose paths are wanted.
    recorded: Vec<Range<u64>>,
    /// Where rows go beyond as many bytes as may be held of a block.
    pub aside: PathBuf,
    pub most: usize,
}

/// Rows in the forms that are wanted.
#[derive(Debug, Default)]
pub(crate) struct Encoded {
    pub text: Vec<u8>,
    pub cells: Vec<u8>,
    pub columns: Option<Columns>,
}

/// The rows of a table.
#[derive(Debug)]
pub(crate) enum Rows {
    Held(Encoded),
    Aside(Spill),
}

/// A finished block.
#[derive(Debug)]
pub(crate) struct Block {
    pub summary: Summary,
    pub tables: [Rows; LAYOUTS.len()],
}

impl<'a> Recording<'a> {
    pub fn new(case: &'a Case, forms: [Forms; LAYOUTS.len()], aside: PathBuf, most: usize) -> Self {
        let walls = case.domain.walls().iter().map(|w| w.name.clone());
        let injections = case.injections.iter().map(|i| i.name.clone());
        let (sorter, words, recorded) =
            (Sorter::new(&case.bins), Words::new(walls, injections), case.recorded().collect());
        Self { case, forms, sorter, words, recorded, aside, most }
    }

    /// Rows of a table as they are wanted.
    pub fn encode(&self, table: usize, columns: Columns) -> Encoded {
        let forms = self.forms[table];
        let mut encoded = Encoded::default();
        if forms.text {
            encoded.text = self.words.to_csv(&LAYOUTS[table], &columns);
        }
        if forms.cells {
            columns.to_bytes(&mut encoded.cells);
        }
        encoded.columns = forms.columns.then_some(columns);
        encoded
    }

    /// What an impact of that mass brings.
    fn brought(&self, impact: &ImpactRecord, mass: f64) -> Brought {
        let law = self.case.erosion.get(impact.wall).and_then(Option::as_ref);
        let eroded = law.map(|law| {
            let (normal, tangential) = (impact.normal_speed_in, impact.tangential_speed_in);
            law.mass(&Hit { mass, diameter: impact.diameter, normal, tangential })
        });
        let size = self.case.bins.by_face.then(|| self.sorter.size(impact.diameter) as u32);
        Brought { mass, eroded, size }
    }

    /// Tracks the particles of a range of numbers.
    pub fn track(&self, numbers: Range<u64>) -> Result<Block, RunError> {
        let mut collector = Collector {
            recording: self,
            summary: Summary::part(self.case.domain.walls().len(), &self.case.bins),
            tables: LAYOUTS.each_ref().map(|layout| (layout.empty(), None)),
            held: 0,
            deposits: Vec::new(),
            first: numbers.start,
            own: vec![Own::default(); (numbers.end - numbers.start) as usize],
            failed: None,
        };
        self.case.tracker().run(&mut numbers.filter_map(|n| self.case.particle(n)), &mut collector)?;
        collector.finish().map_err(|e| RunError::io(&self.aside)(e))
    }
}

/// What is counted of one particle.
#[derive(Clone, Copy, Debug, Default)]
struct Own {
    impacts: u64,
    mass: f64,
}

struct Collector<'a> {
    recording: &'a Recording<'a>,
    summary: Summary,
    tables: [(Columns, Option<Spill>); LAYOUTS.len()],
    /// Bytes of the rows held.
    held: usize,
    deposits: Vec<(Cell, f64)>,
    /// The first particle's number.
    first: u64,
    own: Vec<Own>,
    failed: Option<io::Error>,
}

impl Collector<'_> {
    fn wants(&self, table: usize) -> bool {
        self.recording.forms[table].any() && self.failed.is_none()
    }

    fn own(&mut self, particle: u64) -> &mut Own {
        &mut self.own[(particle - self.first) as usize]
    }

    /// A row was added to a table.
    fn added(&mut self, table: usize) {
        self.held += self.tables[table].0.row_bytes();
        if self.held > self.recording.most
            && let Err(error) = self.put_aside()
        {
            self.failed = Some(error);
        }
    }

    fn put_aside(&mut self) -> io::Result<()> {
        self.held = 0;
        for (columns, spill) in self.tables.iter_mut().filter(|(columns, _)| columns.rows() > 0) {
            let empty = columns.empty_like();
            let spill = match spill {
                Some(spill) => spill,
                None => spill.insert(Spill::new(&self.recording.aside, empty.clone())?),
            };
            spill.add(std::mem::replace(columns, empty))?;
        }
        Ok(())
    }

    fn finish(mut self) -> io::Result<Block> {
        if let Some(error) = self.failed {
            return Err(error);
        }
        self.summary.deposition.keep(std::mem::take(&mut self.deposits));
        let mut tables = Vec::new();
        for (table, (columns, spill)) in self.tables.into_iter().enumerate() {
            tables.push(match spill {
                Some(mut spill) => {
                    spill.add(columns)?;
                    Rows::Aside(spill)
                }
                None => Rows::Held(self.recording.encode(table, columns.by_particle())),
            });
        }
        let tables = tables.try_into().map_err(|_| io::Error::other("a table too few"))?;
        Ok(Block { summary: self.summary, tables })
    }
}

impl Collector<'_> {
    /// Writes a row of the table of impacts, and of the deposits.
    fn row(&mut self, impact: &ImpactRecord) {
        if self.wants(IMPACTS) {
            push_impact(&mut self.tables[IMPACTS].0, impact);
            self.added(IMPACTS);
        }
        if self.wants(DEPOSIT) && matches!(impact.event, Event::Capture | Event::Settle | Event::Trap) {
            push_deposit(&mut self.tables[DEPOSIT].0, impact);
            self.added(DEPOSIT);
        }
    }
}

impl Sink for Collector<'_> {
    fn start(&mut self, particle: &Particle) -> bool {
        let mass = particle.mass();
        self.summary.start(mass);
        self.own(particle.number).mass = mass;
        self.wants(TRAJECTORIES) && self.recording.recorded.iter().any(|numbers| numbers.contains(&particle.number))
    }

    fn impact(&mut self, impact: &ImpactRecord) {
        let own = self.own(impact.particle);
        own.impacts += 1;
        let mass = own.mass;
        self.summary.impact(impact, &self.recording.brought(impact, mass));
        self.row(impact);
    }

    fn contact_ended(&mut self, row: &ImpactRecord) {
        let mass = self.own(row.particle).mass;
        self.summary.contact_ended(row, &self.recording.brought(row, mass));
        self.row(row);
    }

    fn point(&mut self, particle: u64, t: f64, x: Vec3, v: Vec3, w: Vec3) {
        if self.wants(TRAJECTORIES) {
            self.tables[TRAJECTORIES].0.row().count(particle).float(t).vector(x).vector(v).vector(w).end();
            self.added(TRAJECTORIES);
        }
    }

    fn end(&mut self, end: &End) {
        let deposit = self.summary.end(end, &self.recording.sorter);
        self.deposits.extend(deposit);
        if self.wants(FATES) {
            let impacts = self.own(end.particle.number).impacts;
            push_end(&mut self.tables[FATES].0, end, impacts);
            self.added(FATES);
        }
    }

    fn stalled(&mut self) {
        self.summary.stalled += 1;
    }

    fn strayed(&mut self) {
        self.summary.strayed += 1;
    }
}

/// A summary of nothing.
pub(crate) fn empty(case: &Case) -> Summary {
    let mut summary = Summary::new(&case.title, case.domain.walls().iter().map(|w| w.name.clone()), &case.bins);
    for (wall, law) in summary.walls.iter_mut().zip(&case.erosion) {
        wall.eroded = law.map(|_| ExactSum::default());
    }
    summary
}
