//! Velocity (and k, ε) on the nodes of a rectilinear grid, interpolated linearly along each axis.
//!
//! CSV: a header with the columns `x, y, z, u, v, w` and optionally `k, epsilon`, SI units, one node a row, in any order,
//! every node of the grid exactly once. A coordinate with one value, or left out, makes a table of fewer dimensions:
//! nothing varies along it. `v` and `w` left out are zero. Outside the grid the nearest value on its boundary holds.
//! The gradient is the interpolant's own: it jumps from cell to cell. A linear interpolant of a solenoidal field is
//! solenoidal only to first order in the spacing.
//!
//! ```
//! use carom_track::flow::Table;
//! let table = Table::from_csv("x,y,u\n0,0,0\n1,0,0\n0,2,4\n1,2,8\n".as_bytes())?;
//! assert_eq!(table.velocity([0.5, 1.0, 9.0]), [3.0, 0.0, 0.0]);
//! # Ok::<(), carom_track::flow::TableError>(())
//! ```

use super::Local;
use std::io::Read;

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
    /// A VTK file that is not what is wanted.
    #[error("flow table: {0}")]
    Vtk(String),
}

/// Node coordinates along one axis, rising.
#[derive(Clone, Debug)]
struct Axis {
    at: Vec<f64>,
    /// 1/spacing where the nodes are evenly spaced: then no search is needed.
    per_spacing: Option<f64>,
}

/// A cell and the place in it, along one axis.
#[derive(Clone, Copy)]
struct Place {
    low: usize,
    high: usize,
    t: f64,
    /// 1/width, or 0 where nothing varies (one node, or outside the grid).
    slope: f64,
}

impl Axis {
    fn new(at: Vec<f64>) -> Self {
        let (first, last) = (at[0], at[at.len() - 1]);
        let n = at.len() - 1;
        let h = (last - first) / n as f64;
        let even = n > 0 && at.iter().enumerate().all(|(i, x)| (x - (first + i as f64 * h)).abs() < 1e-9 * h);
        Self { at, per_spacing: even.then(|| 1.0 / h) }
    }

    #[inline]
    fn place(&self, x: f64) -> Place {
        let n = self.at.len() - 1;
        if n == 0 || x <= self.at[0] || x.is_nan() {
            return Place {
                low: 0,
                high: n.min(1),
                t: 0.0,
                slope: if n > 0 && x == self.at[0] { self.width(0) } else { 0.0 },
            };
        }
        if x >= self.at[n] {
            return Place { low: n - 1, high: n, t: 1.0, slope: if x == self.at[n] { self.width(n - 1) } else { 0.0 } };
        }
        let low = match self.per_spacing {
            // the quotient may fall on the wrong side of a node by rounding; interpolation there is the same
            Some(s) => (((x - self.at[0]) * s) as usize).min(n - 1),
            None => self.at.partition_point(|a| *a <= x) - 1,
        };
        let slope = self.width(low);
        Place { low, high: low + 1, t: (x - self.at[low]) * slope, slope }
    }

    #[inline]
    fn width(&self, low: usize) -> f64 {
        1.0 / (self.at[low + 1] - self.at[low])
    }
}

const QUANTITIES: usize = 5;
/// u, v, w, k, ε.
type Node = [f64; QUANTITIES];

/// A flow given on a rectilinear grid.
#[derive(Clone, Debug)]
pub struct Table {
    axes: [Axis; 3],
    nodes: Vec<Node>,
    turbulent: bool,
}

impl Table {
    /// Reads a file: VTK rectilinear grids by the endings `.vtk` (legacy) and `.vtr` (XML), anything else as CSV.
    ///
    /// # Errors
    /// [`TableError`], naming the file, line or node.
    pub fn load(path: &std::path::Path) -> Result<Self, TableError> {
        let file = std::fs::File::open(path)
            .map_err(|source| TableError::File { path: path.display().to_string(), source })?;
        Self::from_csv(std::io::BufReader::new(file))
    }

    /// Reads CSV text.
    ///
    /// # Errors
    /// [`TableError`], naming the line, column or node.
    pub fn from_csv(text: impl Read) -> Result<Self, TableError> {
        let rows = Rows::read(text)?;
        let axes = [0, 1, 2].map(|i| distinct(rows.at.iter().map(|x| x[i]).collect()));
        let size = axes.each_ref().map(Vec::len);
        let count = size.iter().try_fold(1usize, |n, m| n.checked_mul(*m)).unwrap_or(usize::MAX);
        let mut line_of = vec![0u64; count.min(rows.at.len() * 4 + 1)];
        let mut nodes = vec![[0.0; QUANTITIES]; line_of.len()];
        for ((x, node), line) in rows.at.iter().zip(&rows.values).zip(&rows.lines) {
            let index = (0..3).fold(0usize, |n, i| n.wrapping_mul(size[i]).wrapping_add(nearest(&axes[i], x[i])));
            let Some(seen) = line_of.get_mut(index) else { continue };
            if *seen != 0 {
                return Err(TableError::Twice { line: *line, first: *seen, node: *x });
            }
            *seen = *line;
            nodes[index] = *node;
        }
        if let Some(index) = line_of.iter().position(|line| *line == 0) {
            let k = index % size[2];
            let j = index / size[2] % size[1];
            let i = index / size[2] / size[1];
            return Err(TableError::Missing { node: [axes[0][i], axes[1][j], axes[2][k]], size });
        }
        Ok(Self::new(axes, nodes, rows.turbulent))
    }

    /// Axes strictly rising and not empty; nodes with z running fastest.
    pub(super) fn new(axes: [Vec<f64>; 3], nodes: Vec<Node>, turbulent: bool) -> Self {
        Self { axes: axes.map(Axis::new), nodes, turbulent }
    }

    /// Nodes along x, y and z.
    pub fn size(&self) -> [usize; 3] {
        self.axes.each_ref().map(|a| a.at.len())
    }

    /// Lowest and highest node.
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        [self.axes.each_ref().map(|a| a.at[0]), self.axes.each_ref().map(|a| a.at[a.at.len() - 1])]
    }

    /// Whether k and ε are given.
    pub fn is_turbulent(&self) -> bool {
        self.turbulent
    }

    #[inline]
    fn node(&self, i: usize, j: usize, k: usize) -> &Node {
        &self.nodes[(i * self.axes[1].at.len() + j) * self.axes[2].at.len() + k]
    }

    /// Weighted sum of the cell's corners: `w[axis]` are the weights of its low and high faces.
    #[inline]
    fn blend<const N: usize>(&self, p: &[Place; 3], w: [[f64; 2]; 3]) -> [f64; N] {
        let mut sum = [0.0; N];
        for (i, wi) in [p[0].low, p[0].high].into_iter().zip(w[0]) {
            for (j, wj) in [p[1].low, p[1].high].into_iter().zip(w[1]) {
                for (k, wk) in [p[2].low, p[2].high].into_iter().zip(w[2]) {
                    let weight = wi * wj * wk;
                    for (s, q) in sum.iter_mut().zip(self.node(i, j, k)) {
                        *s += weight * q;
                    }
                }
            }
        }
        sum
    }

    #[inline]
    fn places(&self, x: [f64; 3]) -> ([Place; 3], [[f64; 2]; 3]) {
        let p = std::array::from_fn(|i| self.axes[i].place(x[i]));
        let w = [0, 1, 2].map(|i: usize| {
            let q: &Place = &p[i];
            [1.0 - q.t, q.t]
        });
        (p, w)
    }

    /// Velocity at `x`, m/s.
    #[inline]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        let (p, w) = self.places(x);
        self.blend(&p, w)
    }

    /// Everything known at `x`. A table knows no walls: distance, normal and friction velocity are the caller's to fill in.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        let (p, w) = self.places(x);
        let [u, v, w_, k, epsilon] = self.blend::<QUANTITIES>(&p, w);
        let mut gradient = [[0.0; 3]; 3];
        for j in 0..3 {
            let mut difference = w;
            difference[j] = [-p[j].slope, p[j].slope];
            let column: [f64; 3] = self.blend(&p, difference);
            for i in 0..3 {
                gradient[i][j] = column[i];
            }
        }
        Local { k, epsilon, ..Local::steady([u, v, w_], gradient) }
    }
}

/// The rows of a CSV table, in order.
struct Rows {
    at: Vec<[f64; 3]>,
    values: Vec<Node>,
    lines: Vec<u64>,
    turbulent: bool,
}

const COLUMNS: [&str; 8] = ["x", "y", "z", "u", "v", "w", "k", "epsilon"];

impl Rows {
    fn read(text: impl Read) -> Result<Self, TableError> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text);
        let mut place = [None; 8];
        for (column, name) in reader.headers()?.iter().enumerate() {
            let bad = |what| TableError::Column { name: name.to_owned(), what };
            let i = COLUMNS.iter().position(|c| *c == name).ok_or_else(|| bad("is not known"))?;
            if place[i].replace(column).is_some() {
                return Err(bad("stands there twice"));
            }
        }
        let missing = |i: usize| TableError::Column { name: COLUMNS[i].to_owned(), what: "is missing" };
        if place[3].is_none() {
            return Err(missing(3));
        }
        if place[6].is_some() != place[7].is_some() {
            return Err(missing(if place[6].is_none() { 6 } else { 7 }));
        }
        let mut rows = Self { at: Vec::new(), values: Vec::new(), lines: Vec::new(), turbulent: place[6].is_some() };
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record)? {
            let line = record.position().map_or(0, csv::Position::line);
            let mut field = [0.0; 8];
            for (i, column) in place.iter().enumerate() {
                let Some(column) = column else { continue };
                field[i] = number(record.get(*column).unwrap_or(""), line, COLUMNS[i])?;
                if i >= 6 && field[i] < 0.0 {
                    return Err(TableError::Negative { line, column: COLUMNS[i], value: field[i] });
                }
            }
            let [x, y, z, u, v, w, k, epsilon] = field;
            rows.at.push([x, y, z]);
            rows.values.push([u, v, w, k, epsilon]);
            rows.lines.push(line);
        }
        if rows.at.is_empty() { Err(TableError::Empty) } else { Ok(rows) }
    }
}

fn number(text: &str, line: u64, column: &'static str) -> Result<f64, TableError> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err(TableError::Number { line, column, text: text.to_owned() }),
    }
}

/// The distinct values, rising; those closer than 1e-9 of the range are one node written with different digits.
fn distinct(mut at: Vec<f64>) -> Vec<f64> {
    at.sort_by(f64::total_cmp);
    let tolerance = 1e-9 * (at[at.len() - 1] - at[0]);
    at.dedup_by(|b, a| *b - *a <= tolerance);
    at
}

/// The node nearest to `x` along an axis.
fn nearest(at: &[f64], x: f64) -> usize {
    let i = at.partition_point(|a| *a < x);
    if i == at.len() || (i > 0 && x - at[i - 1] < at[i] - x) { i - 1 } else { i }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn csv(nodes: [&[f64]; 3], f: impl Fn([f64; 3]) -> [f64; 5]) -> String {
        let mut text = String::from("u,v,w,k,epsilon,z,x,y\n");
        for &z in nodes[2] {
            for &x in nodes[0] {
                for &y in nodes[1] {
                    let q = f([x, y, z]);
                    text += &format!("{},{},{},{},{},{z},{x},{y}\n", q[0], q[1], q[2], q[3], q[4]);
                }
            }
        }
        text
    }

    const X: &[f64] = &[-1.0, 0.0, 0.5, 2.0];
    const Y: &[f64] = &[0.0, 1.0, 2.0];
    const Z: &[f64] = &[1.0, 4.0];

    proptest! {
        #[test]
        fn a_trilinear_field_is_exact(x in -1.0..2.0f64, y in 0.0..2.0f64, z in 1.0..4.0f64) {
            let f = |[x, y, z]: [f64; 3]| [1.0 + 2.0 * x - y + z, x * y, -3.0 * z * x * y, x + 2.0, y + 1.0];
            let table = Table::from_csv(csv([X, Y, Z], f).as_bytes()).unwrap();
            let (local, want) = (table.sample([x, y, z]), f([x, y, z]));
            for i in 0..3 {
                prop_assert!((local.velocity[i] - want[i]).abs() < 1e-12);
                prop_assert_eq!(local.velocity[i], table.velocity([x, y, z])[i]);
            }
            prop_assert!((local.k - want[3]).abs() < 1e-12 && (local.epsilon - want[4]).abs() < 1e-12);
            let g = [[2.0, -1.0, 1.0], [y, x, 0.0], [-3.0 * z * y, -3.0 * z * x, -3.0 * x * y]];
            for i in 0..3 {
                for j in 0..3 {
                    prop_assert!((local.gradient[i][j] - g[i][j]).abs() < 1e-11, "{:?} {:?}", local.gradient, g);
                }
            }
        }
    }

    #[test]
    fn outside_the_grid_its_boundary_holds() {
        let table = Table::from_csv(csv([X, Y, Z], |[x, y, z]| [x, y, z, 1.0, 2.0]).as_bytes()).unwrap();
        assert_eq!(table.velocity([9.0, -3.0, 2.5]), [2.0, 0.0, 2.5]);
        let g = table.sample([9.0, -3.0, 2.5]).gradient;
        assert_eq!((g[0][0], g[1][1], g[2][2]), (0.0, 0.0, 1.0));
        assert_eq!(table.bounds(), [[-1.0, 0.0, 1.0], [2.0, 2.0, 4.0]]);
        assert!(table.velocity([f64::NAN; 3]).iter().all(|c| c.is_finite()));
    }

    #[test]
    fn fewer_dimensions() {
        let line = Table::from_csv("y,u\n0,0\n0.5,1\n1,4\n".as_bytes()).unwrap();
        assert_eq!(line.size(), [1, 3, 1]);
        assert_eq!(line.velocity([7.0, 0.75, -7.0]), [2.5, 0.0, 0.0]);
        assert_eq!(line.sample([7.0, 0.75, -7.0]).gradient, [[0.0, 6.0, 0.0], [0.0; 3], [0.0; 3]]);
        let constant = Table::from_csv("u,w\n1,2\n".as_bytes()).unwrap();
        assert_eq!(constant.velocity([1.0; 3]), [1.0, 0.0, 2.0]);
    }

    #[test]
    fn digits_that_differ_in_the_last_place_are_one_node() {
        let table = Table::from_csv("x,y,u\n0,0.1,1\n1,0.10000000000001,1\n0,0.3,1\n1,0.3,2\n".as_bytes()).unwrap();
        assert_eq!(table.size(), [2, 2, 1]);
    }

    #[test]
    fn errors_name_the_place() {
        let fails = |text: &str, want: &str| {
            let error = Table::from_csv(text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(want), "{error}");
        };
        fails("x,u\n0,1\n1,abc\n", "line 3, column \"u\": \"abc\"");
        fails("x,u\n0,1\n1,inf\n", "line 3");
        fails("x,u\n0,1\n0,2\n", "line 3: the node (0, 0, 0) was given before, in line 2");
        fails("x,y,u\n0,0,1\n1,0,1\n0,1,1\n", "no row for the node (1, 1, 0) of the 2 x 2 x 1 grid");
        fails("x,speed\n0,1\n", "\"speed\" is not known");
        fails("x,u,u\n0,1,1\n", "twice");
        fails("x,v\n0,1\n", "\"u\" is missing");
        fails("x,u,k\n0,1,1\n", "\"epsilon\" is missing");
        fails("x,u,k,epsilon\n0,1,-1,0\n", "k is -1");
        fails("x,u\n", "no rows");
        fails("", "\"u\" is missing");
        fails("x,u\n0\n", "flow table");
        // a scatter of points is no grid; it is refused without building one
        let scatter: String = (0..300).map(|i| format!("{i},{},{},1\n", i * 7, i * 11)).collect();
        fails(&format!("x,y,z,u\n{scatter}"), "no row for the node");
    }
}
