//! The tables a run writes: their names, columns and formats.

use carom_table::{Field, Kind, Schema};

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

/// A table: the first part of its file's name, and its columns with their units.
#[derive(Debug)]
pub(crate) struct Layout {
    pub stem: &'static str,
    columns: &'static [(&'static str, &'static str, Kind)],
}

impl Layout {
    /// The first line of the CSV.
    pub fn header(&self) -> String {
        let names: Vec<&str> = self.columns.iter().map(|c| c.0).collect();
        names.join(",") + "\n"
    }

    /// The columns, typed.
    pub fn schema(&self) -> Schema {
        self.columns.iter().map(|(name, unit, kind)| Field::new(*name, *unit, *kind)).collect()
    }

    /// The file's name.
    pub fn file(&self, format: TableFormat) -> String {
        format!("{}.{}", self.stem, format.extension())
    }
}

/// Indices into [`LAYOUTS`].
pub(crate) const IMPACTS: usize = 0;
pub(crate) const FATES: usize = 1;
pub(crate) const TRAJECTORIES: usize = 2;

use Kind::{Count, Float, Text};

/// Every table of a run.
pub(crate) const LAYOUTS: [Layout; 3] = [
    Layout {
        stem: "impacts",
        columns: &[
            ("particle", "", Count),
            ("time", "s", Float),
            ("x", "m", Float),
            ("y", "m", Float),
            ("z", "m", Float),
            ("wall", "", Text),
            ("diameter", "m", Float),
            ("normal_speed_in", "m/s", Float),
            ("tangential_speed_in", "m/s", Float),
            ("spin_in", "rad/s", Float),
            ("restitution", "", Float),
            ("impulse_ratio", "", Float),
            ("fate", "", Text),
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
            ("validity", "", Text),
        ],
    },
    Layout {
        stem: "fates",
        columns: &[
            ("particle", "", Count),
            ("injection", "", Text),
            ("fate", "", Text),
            ("wall", "", Text),
            ("time", "s", Float),
            ("x", "m", Float),
            ("y", "m", Float),
            ("z", "m", Float),
            ("diameter", "m", Float),
            ("weight", "", Float),
            ("mass", "kg", Float),
            ("impacts", "", Count),
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
];
