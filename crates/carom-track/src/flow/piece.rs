//! The smooth pieces of a flow, and where a path leaves one.
//!
//! A flow is smooth inside a piece: the cell of a table, the inside of a jet, a layer of a profile. A piece's formula is asked beyond
//! its edges too (a trial step reaches there before it is cut), and goes on smoothly there. At an edge the velocity may jump, its
//! slope may, or a finer layer begins; no step spans one.

use crate::geometry::{Bernstein, Path, first_contact};
use crate::vector::Vec3;

/// Which smooth piece of a flow: the index of a layer, or a cell's along each axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Piece(pub(crate) [u32; 3]);

impl Piece {
    /// A layer.
    #[inline(always)]
    pub(crate) fn layer(index: usize) -> Self {
        Self([index as u32, 0, 0])
    }

    /// The layer's index.
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        self.0[0] as usize
    }
}

/// Where a path leaves the piece it is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exit {
    /// Where on the path, 0 to 1.
    pub theta: f64,
    /// The piece it enters.
    pub into: Piece,
}

impl Exit {
    /// The earlier of two.
    #[inline(always)]
    pub(crate) fn earlier(a: Option<Self>, b: Option<Self>) -> Option<Self> {
        match (a, b) {
            (Some(a), Some(b)) => Some(if b.theta < a.theta { b } else { a }),
            (a, b) => a.or(b),
        }
    }
}

/// Most edges of a profile's layers.
const MOST: usize = 24;

/// Rising edges of layers along one coordinate: layer i lies between edges i − 1 and i.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layers {
    edges: [f64; MOST],
    count: usize,
}

impl Layers {
    /// Rising edges; beyond the first [`MOST`] they are left out, which merges layers.
    pub fn new(edges: impl IntoIterator<Item = f64>) -> Self {
        let mut layers = Self { edges: [f64::INFINITY; MOST], count: 0 };
        for (slot, edge) in layers.edges.iter_mut().zip(edges) {
            *slot = edge;
            layers.count += 1;
        }
        debug_assert!(layers.edges().is_sorted());
        layers
    }

    pub fn edges(&self) -> &[f64] {
        &self.edges[..self.count]
    }

    /// The layer of a place.
    pub fn of(&self, s: f64) -> usize {
        self.edges().partition_point(|e| *e <= s)
    }

    /// Lower and upper edge of a layer, infinite where it has none.
    #[inline(always)]
    pub fn bounds(&self, layer: usize) -> [f64; 2] {
        let low = if layer == 0 { f64::NEG_INFINITY } else { self.edges[layer - 1] };
        [low, if layer < self.count { self.edges[layer] } else { f64::INFINITY }]
    }

    /// Where a path leaves a layer, `start` being where it begins and `change` how the coordinate changes along it.
    #[inline(always)]
    pub fn exit<const N: usize>(&self, layer: usize, start: f64, change: &Bernstein<N>) -> Option<Exit> {
        let (low, high) = leave(start, change, self.bounds(layer));
        let down = low.map(|theta| Exit { theta, into: Piece::layer(layer - 1) });
        let up = high.map(|theta| Exit { theta, into: Piece::layer(layer + 1) });
        Exit::earlier(down, up)
    }
}

/// Where a coordinate that starts at `start` and goes as `change` leaves an interval, downwards and upwards.
#[inline(always)]
pub(super) fn leave<const N: usize>(
    start: f64,
    change: &Bernstein<N>,
    [low, high]: [f64; 2],
) -> (Option<f64>, Option<f64>) {
    let (least, most) = change.range_ahead();
    let down = if start + least.min(0.0) > low { None } else { first_contact(start - low, change, 0.0, |_| true) };
    let up = if start + most.max(0.0) < high {
        None
    } else {
        first_contact(high - start, &change.scaled(-1.0, 0.0), 0.0, |_| true)
    };
    (down, up)
}

/// How soon a straight path from `s` at the speed `v` leaves an interval, s.
#[inline(always)]
pub(super) fn soonest(s: f64, v: f64, [low, high]: [f64; 2]) -> f64 {
    let edge = if v > 0.0 { high } else { low };
    let time = (edge - s) / v;
    // at the edge itself, or at rest
    if time > 0.0 { time } else { f64::INFINITY }
}

/// The path's way along one axis.
#[inline(always)]
pub(super) fn along(path: &Path, axis: usize) -> (f64, Bernstein<6>) {
    (path.start[axis], path.component(axis))
}

/// How the squared distance from an axis changes along a path, from where it starts and its control points, both across the axis.
pub(super) fn square_of_distance(start: Vec3, across: &[Vec3; 5]) -> Bernstein<11> {
    let mut change = Bernstein([0.0; 11]);
    for c in 0..3 {
        let p = Bernstein([0.0, across[0][c], across[1][c], across[2][c], across[3][c], across[4][c]]);
        change = change.plus(&p.times(&p.scaled(1.0, 2.0 * start[c])));
    }
    change
}
