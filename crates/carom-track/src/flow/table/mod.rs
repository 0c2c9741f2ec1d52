//! Velocity (and k, ε, temperature, density) on the nodes of a rectilinear grid, interpolated linearly along each axis.
//!
//! Text (VTK too, see [`Table::from_vtk`] and [`Table::from_vtk_xml`]): columns of x, y, z, u, v, w and optionally k and ε (or ω), T and ρ, by the
//! names and in the units that ParaView, Fluent, CFD-Post, STAR-CCM+, COMSOL and OpenFOAM write, or by those given ([`Named`]); SI units
//! where none is named; one node a row, in any order, every node of the grid exactly once. What is left out is told ([`Table::notes`]).
//! A coordinate with one value, or left out, makes a table of fewer dimensions:
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

mod arrays;
mod columns;
mod csv;
mod error;
mod fastest;
mod holes;
mod state;
mod vtk;
mod xml;

pub use columns::Named;
pub use error::TableError;

use super::Local;
use super::gas_nodes::GasNodes;
use super::piece::{Exit, Piece, leave, soonest};
use crate::geometry::Path;
use std::io::Read;

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

    /// Which interval a coordinate lies in: 0 below the first node, as many as there are nodes above the last.
    #[inline]
    fn interval(&self, x: f64) -> u32 {
        let n = self.at.len() - 1;
        // one node: nothing varies, and nothing ends
        if n == 0 || x < self.at[0] || x.is_nan() {
            return 0;
        }
        if x > self.at[n] {
            return n as u32 + 1;
        }
        let low = match self.per_spacing {
            Some(s) => (((x - self.at[0]) * s) as usize).min(n - 1),
            None => (self.at.partition_point(|a| *a <= x) - 1).min(n - 1),
        };
        // the quotient may fall on the wrong side of a node by rounding
        let low = if x < self.at[low] { low - 1 } else { low };
        let low = if low + 1 < n && x >= self.at[low + 1] { low + 1 } else { low };
        low as u32 + 1
    }

    /// Edges of an interval, infinite where it has none.
    #[inline]
    fn bounds(&self, interval: u32) -> [f64; 2] {
        let (i, n) = (interval as usize, self.at.len());
        if n == 1 {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        [if i == 0 { f64::NEG_INFINITY } else { self.at[i - 1] }, if i == n { f64::INFINITY } else { self.at[i] }]
    }

    /// The place of a coordinate by the formula of an interval.
    #[inline]
    fn place(&self, interval: u32, x: f64) -> Place {
        let (i, n) = (interval as usize, self.at.len());
        if i == 0 {
            return Place { low: 0, high: 1.min(n - 1), t: 0.0, slope: 0.0 };
        }
        if i == n {
            return Place { low: n - 2, high: n - 1, t: 1.0, slope: 0.0 };
        }
        let slope = self.width(i - 1);
        Place { low: i - 1, high: i, t: (x - self.at[i - 1]) * slope, slope }
    }

    #[inline]
    fn width(&self, low: usize) -> f64 {
        1.0 / (self.at[low + 1] - self.at[low])
    }
}

const MESH: &str =
    "a mesh is no table: resample it (ParaView: Resample To Image) and save it as .vti, or as one file of one piece";

const QUANTITIES: usize = 5;
/// u, v, w, k, ε.
type Node = [f64; QUANTITIES];
/// What is read of a node: these, T and ρ.
type Row = [f64; QUANTITIES + 2];
const TEMPERATURE: usize = QUANTITIES;
const DENSITY: usize = QUANTITIES + 1;

/// Which of the quantities a file has besides the velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Given {
    turbulence: bool,
    temperature: bool,
    density: bool,
}

/// A flow given on a rectilinear grid.
#[derive(Clone, Debug)]
pub struct Table {
    axes: [Axis; 3],
    nodes: Vec<Node>,
    turbulent: bool,
    state: Option<GasNodes>,
    notes: Vec<String>,
}

impl Table {
    /// Reads a file: VTK XML by the endings `.vtr` and `.vti`, legacy VTK by `.vtk`, anything else as CSV.
    ///
    /// # Errors
    /// [`TableError`], naming the file, line or node.
    pub fn load(path: &std::path::Path) -> Result<Self, TableError> {
        let name = path.display().to_string();
        match carom_table::file::read_regular(path, crate::case::LARGEST) {
            Ok(bytes) => Self::from_file(&name, &bytes),
            Err(source) => Err(TableError::File { path: name, source }),
        }
    }

    /// Reads what is in a file of that name, as [`Table::load`] does.
    ///
    /// # Errors
    /// [`TableError`], naming the line or node.
    pub fn from_file(name: &str, bytes: &[u8]) -> Result<Self, TableError> {
        Self::from_named(name, bytes, &Named::new())
    }

    /// Reads what is in a file of that name, with its columns under the names given.
    ///
    /// # Errors
    /// [`TableError`], naming the line or node.
    pub fn from_named(name: &str, bytes: &[u8], named: &Named) -> Result<Self, TableError> {
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
        match ending.as_str() {
            "vtk" | "vtr" | "vti" if !named.is_empty() => {
                Err(TableError::Kind("columns are of a text table; a VTK file's arrays have names of their own"))
            }
            "vtk" => Self::from_vtk(bytes),
            "vtr" | "vti" => Self::from_vtk_xml(bytes),
            "vtu" | "pvtu" | "vtp" | "vts" | "vtm" | "pvti" | "pvtr" => Err(TableError::Kind(MESH)),
            _ => csv::read(bytes, named),
        }
    }

    /// Reads a text table.
    ///
    /// # Errors
    /// [`TableError`], naming the line, column or node.
    pub fn from_csv(mut text: impl Read) -> Result<Self, TableError> {
        let mut bytes = Vec::new();
        let failed = |source| TableError::File { path: "flow table".to_owned(), source };
        text.read_to_end(&mut bytes).map_err(failed)?;
        csv::read(&bytes, &Named::new())
    }

    /// Reads legacy VTK (`DATASET RECTILINEAR_GRID` or `STRUCTURED_POINTS`, ASCII or binary) with point data, or else cell data, whose
    /// values are those of the cells' middles: a vector array named `velocity` or `U`, or the only one there is, and optionally scalars
    /// `k` and `epsilon` (or `omega`), in any case. What `vtkValidPointMask` and `vtkGhostType` mark as not valid is no data: there the
    /// nearest valid values hold.
    ///
    /// # Errors
    /// [`TableError`], naming the place.
    pub fn from_vtk(file: &[u8]) -> Result<Self, TableError> {
        vtk::read(file)
    }

    /// Reads VTK XML (`RectilinearGrid` or `ImageData` of one piece; ASCII or binary, inline or appended, plain or compressed with
    /// zlib) with point or cell data as in [`Table::from_vtk`].
    ///
    /// # Errors
    /// [`TableError`], naming the array.
    pub fn from_vtk_xml(file: &[u8]) -> Result<Self, TableError> {
        xml::read(file)
    }

    /// Axes strictly rising and not empty; nodes with z running fastest.
    fn new(axes: [Vec<f64>; 3], read: &[Row], given: Given) -> Self {
        let nodes = read.iter().map(|[u, v, w, k, epsilon, ..]| [*u, *v, *w, *k, *epsilon]).collect();
        let state = given.temperature.then(|| state::nodes(read, given.density));
        Self { axes: axes.map(Axis::new), nodes, turbulent: given.turbulence, state, notes: Vec::new() }
    }

    fn noting(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// What of the file is left out or filled in.
    pub fn notes(&self) -> &[String] {
        &self.notes
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
        &self.nodes[self.index(i, j, k)]
    }

    #[inline]
    fn index(&self, i: usize, j: usize, k: usize) -> usize {
        (i * self.axes[1].at.len() + j) * self.axes[2].at.len() + k
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
    fn places(&self, piece: Piece, x: [f64; 3]) -> ([Place; 3], [[f64; 2]; 3]) {
        let p = std::array::from_fn(|i| self.axes[i].place(piece.0[i], x[i]));
        let w = [0, 1, 2].map(|i: usize| {
            let q: &Place = &p[i];
            [1.0 - q.t, q.t]
        });
        (p, w)
    }

    /// The piece of a point: a cell, or what continues the grid's boundary beyond it.
    #[inline]
    pub fn piece(&self, x: [f64; 3]) -> Piece {
        Piece(std::array::from_fn(|i| self.axes[i].interval(x[i])))
    }

    /// Where a path leaves a piece.
    pub fn exit(&self, piece: Piece, path: &Path) -> Option<Exit> {
        let mut first = None;
        for c in 0..3 {
            let (down, up) = leave(path.start[c], &path.component(c), self.axes[c].bounds(piece.0[c]));
            let next = |step: i32| {
                let mut into = piece;
                into.0[c] = into.0[c].wrapping_add_signed(step);
                into
            };
            first = Exit::earlier(first, down.map(|theta| Exit { theta, into: next(-1) }));
            first = Exit::earlier(first, up.map(|theta| Exit { theta, into: next(1) }));
        }
        first
    }

    /// Whether a piece lies outside the grid, along an axis on which something may vary.
    pub fn is_outside(&self, piece: Piece) -> bool {
        self.axes.iter().zip(piece.0).any(|(a, i)| a.at.len() > 1 && (i == 0 || i as usize == a.at.len()))
    }

    /// Edges of a piece across an axis.
    #[inline]
    pub(super) fn edges(&self, piece: Piece, axis: usize) -> [f64; 2] {
        self.axes[axis].bounds(piece.0[axis])
    }

    /// How soon a straight path at `v` leaves a piece, s.
    pub fn soonest(&self, piece: Piece, x: [f64; 3], v: [f64; 3]) -> f64 {
        (0..3).fold(f64::INFINITY, |t, c| t.min(soonest(x[c], v[c], self.axes[c].bounds(piece.0[c]))))
    }

    /// Velocity at `x`, m/s.
    #[inline]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        self.velocity_in(self.piece(x), x)
    }

    /// Velocity at `x` by the formula of a piece, m/s.
    #[inline]
    pub fn velocity_in(&self, piece: Piece, x: [f64; 3]) -> [f64; 3] {
        let (p, w) = self.places(piece, x);
        self.blend(&p, w)
    }

    /// Everything known at `x`. A table knows no walls: distance, normal and friction velocity are the caller's to fill in.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        self.sample_in(self.piece(x), x)
    }

    /// Everything known at `x`, by the formulas of a piece.
    #[inline(always)]
    pub fn sample_in(&self, piece: Piece, x: [f64; 3]) -> Local {
        let (p, w) = self.places(piece, x);
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
        let gas = self.state.as_ref().map(|states| states.at(self, &p, w));
        Local { k: k.max(0.0), epsilon: epsilon.max(0.0), gas, ..Local::steady([u, v, w_], gradient) }
    }
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
            prop_assert!(local.velocity.iter().zip(want).all(|(got, want)| (got - want).abs() < 1e-12));
            prop_assert_eq!(local.velocity, table.velocity([x, y, z]));
            prop_assert!((local.k - want[3]).abs() < 1e-12 && (local.epsilon - want[4]).abs() < 1e-12);
            let g = [[2.0, -1.0, 1.0], [y, x, 0.0], [-3.0 * z * y, -3.0 * z * x, -3.0 * x * y]];
            for (got, want) in local.gradient.iter().flatten().zip(g.iter().flatten()) {
                prop_assert!((got - want).abs() < 1e-11, "{:?} {:?}", local.gradient, g);
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
}
