//! The tables a run makes: their names and columns, what a record becomes in them, and their rows as text.

use crate::record::columns::{Column, Columns, Kind as Cells, NO_WORD};
use crate::record::text::{Rows, quoted};
use crate::record::{End, Event, ImpactRecord, ParticleFate};
use carom::validity::CODES;
use carom_table::{Field, Kind, Schema};
use std::borrow::Cow;

/// The file format of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TableFormat {
    /// Comma-separated text.
    Csv,
    /// Apache Parquet, typed and compressed.
    Parquet,
}

impl TableFormat {
    /// What files of it end in.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
        }
    }
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum What {
    Count,
    Float,
    /// A wall's name, by its index.
    Wall,
    /// An injection's name, by its index.
    Injection,
    /// The word of an [`Event`], by its place among all.
    Event,
    /// The word of a [`ParticleFate`], by its place among all.
    ParticleFate,
    /// Validity codes, by their bits.
    Validity,
    /// A cell's number; [`NO_WORD`] where there is none.
    Cell,
}

impl What {
    fn cells(self) -> Cells {
        match self {
            Self::Count => Cells::Count,
            Self::Float => Cells::Float,
            _ => Cells::Word,
        }
    }

    fn kind(self) -> Kind {
        match self {
            Self::Count | Self::Cell => Kind::Count,
            Self::Float => Kind::Float,
            _ => Kind::Text,
        }
    }
}

/// A table: the first part of its file's name, and its columns with their units.
#[derive(Debug)]
pub(crate) struct Layout {
    pub stem: &'static str,
    pub columns: &'static [(&'static str, &'static str, What)],
}

impl Layout {
    /// The first line of the CSV.
    pub fn header(&self) -> String {
        let names: Vec<&str> = self.columns.iter().map(|c| c.0).collect();
        names.join(",") + "\n"
    }

    /// The columns, typed.
    pub fn schema(&self) -> Schema {
        self.columns.iter().map(|(name, unit, what)| Field::new(*name, *unit, what.kind())).collect()
    }

    /// The file's name.
    pub fn file(&self, format: TableFormat) -> String {
        format!("{}.{}", self.stem, format.extension())
    }

    /// Columns without rows.
    pub fn empty(&self) -> Columns {
        Columns::new(self.columns.iter().map(|(_, _, what)| what.cells()))
    }
}

/// The names that codes of walls and injections stand for.
#[derive(Clone, Debug)]
pub(crate) struct Words {
    walls: Vec<String>,
    injections: Vec<String>,
}

impl Words {
    pub fn new(walls: impl Iterator<Item = String>, injections: impl Iterator<Item = String>) -> Self {
        Self { walls: walls.collect(), injections: injections.collect() }
    }

    /// The word of a code; empty for none.
    pub fn text(&self, what: What, code: u32) -> Cow<'_, str> {
        let place = code as usize;
        match what {
            What::Wall => Cow::Borrowed(self.walls.get(place).map_or("", String::as_str)),
            What::Injection => Cow::Borrowed(self.injections.get(place).map_or("", String::as_str)),
            What::Event => Cow::Borrowed(Event::ALL.get(place).map_or("", |e| e.name())),
            What::ParticleFate => Cow::Borrowed(ParticleFate::ALL.get(place).map_or("", |f| f.name())),
            What::Validity => {
                let codes = CODES.iter().filter(|(_, v, _)| code & v.bits() == v.bits()).map(|(word, _, _)| *word);
                Cow::Owned(codes.collect::<Vec<_>>().join(" "))
            }
            What::Cell if code != NO_WORD => Cow::Owned(code.to_string()),
            What::Count | What::Float | What::Cell => Cow::Borrowed(""),
        }
    }

    /// Rows as CSV, without a header.
    pub fn to_csv(&self, layout: &Layout, columns: &Columns) -> Vec<u8> {
        let mut rows = Rows::default();
        // names of walls and injections come again and again: made safe once
        let safe = |names: &[String]| names.iter().map(|name| quoted(name)).collect::<Vec<_>>();
        let (walls, injections) = (safe(&self.walls), safe(&self.injections));
        for row in 0..columns.rows() {
            for (column, (_, _, what)) in columns.columns().iter().zip(layout.columns) {
                match (column, what) {
                    (Column::Count(v), _) => rows.count(v[row]),
                    (Column::Float(v), _) => rows.float(v[row]),
                    (Column::Word(v), What::Wall) => rows.word(walls.get(v[row] as usize).map_or("", String::as_str)),
                    (Column::Word(v), What::Injection) => {
                        rows.word(injections.get(v[row] as usize).map_or("", String::as_str));
                    }
                    (Column::Word(v), What::Validity) if v[row] == 0 => rows.word(""),
                    (Column::Word(v), what) => rows.word(&self.text(*what, v[row])),
                }
            }
            rows.end();
        }
        rows.into_bytes()
    }
}

/// Appends an impact.
pub(crate) fn push_impact(columns: &mut Columns, i: &ImpactRecord) {
    let mut row = columns.row();
    row.count(i.particle).float(i.time).vector(i.position).word(i.wall as u32);
    row.floats([i.diameter, i.normal_speed_in, i.tangential_speed_in, i.spin_in, i.restitution, i.impulse_ratio]);
    row.word(i.event.index()).floats([i.normal_speed_out, i.tangential_speed_out, i.spin_out, i.weight]);
    row.vector(i.normal).floats(i.energy.named().map(|(_, share)| share)).word(i.validity.bits()).end();
}

/// Appends an end; `impacts` is how many the particle had.
pub(crate) fn push_end(columns: &mut Columns, e: &End, impacts: u64) {
    let p = &e.particle;
    let wall = e.wall.map_or(NO_WORD, |w| w as u32);
    let mut row = columns.row();
    row.count(p.number).word(p.injection as u32).word(e.fate as u32).word(wall).float(e.time);
    row.vector(e.position).vector(e.velocity).floats([p.diameter, p.weight, p.mass()]);
    row.count(impacts).word(e.cell.unwrap_or(NO_WORD)).end();
}

/// Appends what a wall kept.
pub(crate) fn push_deposit(columns: &mut Columns, i: &ImpactRecord) {
    let mut row = columns.row();
    row.count(i.particle).float(i.time).vector(i.position);
    row.floats([i.diameter, i.normal_speed_in, i.tangential_speed_in, i.weight]).end();
}

/// The typed columns of a run's table, by the first part of its file's name: `impacts`, `fates`, `trajectories`, `deposition`.
#[must_use]
pub fn schema(stem: &str) -> Option<Schema> {
    if stem == "deposition" {
        return Some(crate::deposition::schema());
    }
    LAYOUTS[..DEPOSIT].iter().find(|layout| layout.stem == stem).map(Layout::schema)
}

/// Indices into [`LAYOUTS`].
pub(crate) const IMPACTS: usize = 0;
pub(crate) const FATES: usize = 1;
pub(crate) const TRAJECTORIES: usize = 2;
pub(crate) const DEPOSIT: usize = 3;

use What::{Count, Float};

/// Every table of a run. The last is no file of its own: `deposit.vtp` is made of it.
pub(crate) const LAYOUTS: [Layout; 4] = [
    Layout {
        stem: "impacts",
        columns: &[
            ("particle", "", Count),
            ("time", "s", Float),
            ("x", "m", Float),
            ("y", "m", Float),
            ("z", "m", Float),
            ("wall", "", What::Wall),
            ("diameter", "m", Float),
            ("normal_speed_in", "m/s", Float),
            ("tangential_speed_in", "m/s", Float),
            ("spin_in", "rad/s", Float),
            ("restitution", "", Float),
            ("impulse_ratio", "", Float),
            ("fate", "", What::Event),
            ("normal_speed_out", "m/s", Float),
            ("tangential_speed_out", "m/s", Float),
            ("spin_out", "rad/s", Float),
            ("weight", "", Float),
            ("normal_x", "", Float),
            ("normal_y", "", Float),
            ("normal_z", "", Float),
            ("adhesion", "", Float),
            ("adhesion_damping", "", Float),
            ("hertz_damping", "", Float),
            ("plastic", "", Float),
            ("other", "", Float),
            ("friction", "", Float),
            ("captured", "", Float),
            ("kept", "", Float),
            ("validity", "", What::Validity),
        ],
    },
    Layout {
        stem: "fates",
        columns: &[
            ("particle", "", Count),
            ("injection", "", What::Injection),
            ("fate", "", What::ParticleFate),
            ("wall", "", What::Wall),
            ("time", "s", Float),
            ("x", "m", Float),
            ("y", "m", Float),
            ("z", "m", Float),
            ("vx", "m/s", Float),
            ("vy", "m/s", Float),
            ("vz", "m/s", Float),
            ("diameter", "m", Float),
            ("weight", "", Float),
            ("mass", "kg", Float),
            ("impacts", "", Count),
            ("cell", "", What::Cell),
        ],
    },
    Layout {
        stem: "trajectories",
        columns: &[
            ("particle", "", Count),
            ("time", "s", Float),
            ("x", "m", Float),
            ("y", "m", Float),
            ("z", "m", Float),
            ("vx", "m/s", Float),
            ("vy", "m/s", Float),
            ("vz", "m/s", Float),
            ("spin_x", "rad/s", Float),
            ("spin_y", "rad/s", Float),
            ("spin_z", "rad/s", Float),
        ],
    },
    Layout {
        stem: "deposit",
        columns: &[
            ("particle", "", Count),
            ("time", "s", Float),
            ("x", "m", Float),
            ("y", "m", Float),
            ("z", "m", Float),
            ("diameter", "m", Float),
            ("normal_speed_in", "m/s", Float),
            ("tangential_speed_in", "m/s", Float),
            ("weight", "", Float),
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_those_of_the_contract() {
        let names: Vec<String> = LAYOUTS[IMPACTS].schema().into_iter().map(|f| f.name).collect();
        assert_eq!(names.len(), 10 + 10 + 8 + 1);
        let energies = carom::Energy::default().named().map(|(name, _)| name);
        assert_eq!(names[20..28], energies);
        assert_eq!(LAYOUTS[TRAJECTORIES].schema().len(), 11);
        let fates = "particle,injection,fate,wall,time,x,y,z,vx,vy,vz,diameter,weight,mass,impacts,cell\n";
        assert_eq!(LAYOUTS[FATES].header(), fates);
        assert!(ParticleFate::ALL.iter().enumerate().all(|(i, f)| *f as usize == i));
        assert!(Event::ALL.iter().enumerate().all(|(i, e)| e.index() as usize == i));
    }
}
