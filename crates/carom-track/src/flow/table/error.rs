//! What can be wrong with a table.

use carom_table::quoted;

/// A table that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// A text that is no table, or has a row that is none.
    #[error("flow table, {0}")]
    Sheet(#[from] carom_table::SheetError),
    /// The file cannot be read.
    #[error("flow table {path}: {source}")]
    File {
        /// The file.
        path: String,
        /// Why not.
        source: std::io::Error,
    },
    /// No column is the velocity.
    #[error(
        "flow table, line {line}: no column of u, the velocity along x, among {columns}; name the columns in the case: columns = {{ x = \"...\", u = \"...\" }}"
    )]
    NoVelocity {
        /// The line of names, from 1.
        line: u64,
        /// The columns there are.
        columns: String,
    },
    /// A column that the case names is not there.
    #[error("flow table: no column {}; there are {columns}", quoted(.written))]
    NotThere {
        /// The column's name in the case.
        written: String,
        /// The columns there are.
        columns: String,
    },
    /// Two columns for one thing.
    #[error("flow table: {key} may be {} or {}; say which: columns = {{ {key} = {} }}", quoted(.a), quoted(.b), quoted(.a))]
    TwoColumns {
        /// What they may be.
        key: &'static str,
        /// One.
        a: String,
        /// Another.
        b: String,
    },
    /// One column for two things.
    #[error("flow table: the case gives one column for both {} and {}", .keys[0], .keys[1])]
    OneColumn {
        /// What it is given for.
        keys: [&'static str; 2],
    },
    /// A unit in the case that differs from the table's.
    #[error("flow table: the case gives the unit {} for column {}, which names another", quoted(.b), quoted(.a))]
    TwoUnits {
        /// The column.
        a: String,
        /// The case's unit.
        b: String,
    },
    /// A column in a unit that is none of its quantity.
    #[error("flow table: column {}: {what}", quoted(.column))]
    Unit {
        /// The column's name.
        column: String,
        /// What is wrong with the unit.
        what: String,
    },
    /// k without ε, where the case asks for it.
    #[error("flow table: k needs epsilon (or omega) beside it, and they need k")]
    HalfTurbulent,
    /// A field without a value.
    #[error("flow table, line {line}, column {}: nothing stands there", quoted(.column))]
    Nothing {
        /// Line, counted from 1.
        line: u64,
        /// The column's name.
        column: String,
    },
    /// No node where the values hold.
    #[error("flow table: {what}")]
    Holes {
        /// What is wrong.
        what: String,
    },
    /// A file of a kind that is not read.
    #[error("flow table: {0}")]
    Kind(&'static str),
    /// k or ε below zero.
    #[error("flow table, line {line}: {column} is {value}; it cannot be negative")]
    Negative {
        /// Line, counted from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// The value.
        value: f64,
    },
    /// A temperature or density that no gas has.
    #[error("flow table, line {line}: {column} is {value} in SI units; it must be positive")]
    NotPositive {
        /// Line, counted from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// The value, K or kg/m³.
        value: f64,
    },
    /// A density that the case names, without a temperature.
    #[error("flow table: rho needs T beside it")]
    DensityAlone,
    /// Two rows for one node.
    #[error("flow table, line {line}: the node ({}, {}, {}) was given before, in line {first}", .node[0], .node[1], .node[2])]
    Twice {
        /// The later line.
        line: u64,
        /// The earlier line.
        first: u64,
        /// The node, m.
        node: [f64; 3],
    },
    /// A node without a row.
    #[error("flow table: no row for the node ({}, {}, {}) of the {} x {} x {} grid: a table needs a row for each node of a rectilinear grid; resample a mesh first", .node[0], .node[1], .node[2], .size[0], .size[1], .size[2])]
    Missing {
        /// The node, m.
        node: [f64; 3],
        /// Nodes along each axis.
        size: [usize; 3],
    },
    /// No rows at all.
    #[error("flow table: no rows")]
    Empty,
    /// A VTK file that cannot be read.
    #[error("flow table, byte {byte} of the VTK file: {what}")]
    Vtk {
        /// How far the file was read.
        byte: usize,
        /// What is wrong there.
        what: String,
    },
    /// A VTK XML file that cannot be read.
    #[error("flow table, VTK XML: {what}")]
    Xml {
        /// What is wrong in it.
        what: String,
    },
}
