//! What can be wrong with a table.

/// A table that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The text is not CSV.
    #[error("flow table: {0}")]
    Csv(#[from] csv::Error),
    /// The file cannot be read.
    #[error("flow table {path}: {source}")]
    File {
        /// The file.
        path: String,
        /// Why not.
        source: std::io::Error,
    },
    /// A column that means nothing here, or the same one twice.
    #[error("flow table: column \"{name}\" {what}; columns are x, y, z, u, v, w, k, epsilon")]
    Column {
        /// The column's name.
        name: String,
        /// What is wrong with it.
        what: &'static str,
    },
    /// A field that is not a finite number.
    #[error("flow table, line {line}, column \"{column}\": \"{text}\" is not a finite number")]
    Number {
        /// Line, counted from 1.
        line: u64,
        /// The column's name.
        column: &'static str,
        /// The field.
        text: String,
    },
    /// k or ε below zero.
    #[error("flow table, line {line}: {column} is {value}; it cannot be negative")]
    Negative {
        /// Line, counted from 1.
        line: u64,
        /// The column's name.
        column: &'static str,
        /// The value.
        value: f64,
    },
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
    #[error("flow table: no row for the node ({}, {}, {}) of the {} x {} x {} grid", .node[0], .node[1], .node[2], .size[0], .size[1], .size[2])]
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
