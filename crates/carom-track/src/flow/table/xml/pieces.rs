//! The pieces of a grid, put together: they may overlap, must leave no node out, and have the same arrays.

use super::super::arrays::{Chosen, Described, cells};
use super::{Extent, Fields, Form, Node, arrays, child, evenly};
use crate::flow::Table;

/// The pieces of a grid that have been read.
pub(super) struct Pieces {
    whole: Extent,
    parts: Vec<Part>,
    /// How many nodes they have, one by one.
    nodes: usize,
}

/// A piece.
struct Part {
    size: [usize; 3],
    /// Where it begins in the whole.
    offset: [usize; 3],
    axes: [Vec<f64>; 3],
    described: Vec<Described>,
    chosen: Chosen,
    of_cells: bool,
    values: Vec<Option<Vec<f64>>>,
    /// The nodes that a mask of its cells hides.
    hidden: Option<Vec<bool>>,
}

/// Most nodes that pieces have together, as a multiple of the grid's: those of single cells share each node with seven others.
const SHARED: usize = 8;

impl Pieces {
    pub fn new(whole: Extent) -> Self {
        Self { whole, parts: Vec::new(), nodes: 0 }
    }

    /// Reads a piece of a grid, an image or a rectilinear one.
    pub fn add(&mut self, form: &Form, piece: Node, grid: Node, image: bool) -> Result<(), String> {
        let extent = Extent::of(piece, "Extent")?;
        let offset = self.offset(extent)?;
        let size = extent.size;
        let fields = Fields::of(form, piece, size)?;
        // the arrays come first: what they hold tells whether the axes are worth making
        let values = fields.read()?;
        let hidden = fields.hidden()?;
        let axes = if image { evenly(grid, extent)? } else { coordinates(form, piece, size)? };
        let Fields { described, chosen, of_cells, .. } = fields;
        self.parts.push(Part { size, offset, axes, described, chosen, of_cells, values, hidden });
        Ok(())
    }

    /// Where a piece begins.
    fn offset(&mut self, extent: Extent) -> Result<[usize; 3], String> {
        let mut offset = [0; 3];
        for (c, offset) in offset.iter_mut().enumerate() {
            let begin = extent.first[c].checked_sub(self.whole.first[c]).and_then(|n| usize::try_from(n).ok());
            let end = begin.and_then(|n| n.checked_add(extent.size[c]));
            match (begin, end) {
                (Some(begin), Some(end)) if end <= self.whole.size[c] => *offset = begin,
                _ => return Err(format!("a piece of the extent {extent} lies outside the whole, {}", self.whole)),
            }
        }
        self.nodes = self.nodes.saturating_add(extent.nodes().unwrap_or(usize::MAX));
        if self.nodes / SHARED > self.whole.nodes().unwrap_or_default() {
            return Err("its pieces cover the same nodes again and again".to_owned());
        }
        Ok(offset)
    }

    pub fn table(mut self) -> Result<Table, String> {
        let all = self.whole.nodes().unwrap_or_default();
        // before room is made for the whole: its size is what the file says, that of the pieces is what it holds
        if self.nodes < all {
            return Err(format!("its pieces have {} nodes, fewer than the {all} of the whole", self.nodes));
        }
        let one = if self.parts.len() == 1 { self.parts.pop() } else { None };
        let Part { axes, described, chosen, values, hidden, .. } = one.map_or_else(|| self.joined(all), Ok)?;
        chosen.table(axes, &described, &values, hidden.as_deref())
    }

    /// Several pieces as one.
    fn joined(self, all: usize) -> Result<Part, String> {
        let Self { whole: Extent { size, .. }, parts, .. } = self;
        let mut parts = parts.into_iter();
        let first = parts.next().ok_or("no Piece")?;
        let room =
            |(values, d): (&Option<Vec<f64>>, &Described)| values.as_ref().map(|_| vec![f64::NAN; all * d.components]);
        let mut joined = Part {
            size,
            offset: [0; 3],
            axes: size.map(|n| vec![f64::NAN; n]),
            values: first.values.iter().zip(&first.described).map(room).collect(),
            hidden: Some(vec![true; all]),
            described: first.described.clone(),
            chosen: first.chosen.clone(),
            of_cells: first.of_cells,
        };
        let mut covered = vec![false; all];
        for part in std::iter::once(first).chain(parts) {
            if joined.of_cells != part.of_cells || joined.described != part.described {
                return Err("its pieces have different arrays".to_owned());
            }
            joined.take_axes(&part)?;
            joined.take_values(&part);
            for (i, n) in places(part.size, part.offset, size).enumerate() {
                covered[n] = true;
                // a node is hidden where every piece that has it hides it
                if let Some(hidden) = &mut joined.hidden {
                    hidden[n] &= part.hidden.as_ref().is_some_and(|h| h.get(i) == Some(&true));
                }
            }
        }
        match covered.iter().filter(|c| !**c).count() {
            0 => Ok(joined),
            missing => Err(format!("its pieces leave out {missing} of {all} nodes")),
        }
    }
}

impl Part {
    fn take_axes(&mut self, part: &Part) -> Result<(), String> {
        for (c, axis) in part.axes.iter().enumerate() {
            for (slot, x) in self.axes[c].iter_mut().skip(part.offset[c]).zip(axis) {
                if slot.is_finite() && slot != x {
                    return Err(format!("its pieces do not agree on the coordinates: {slot} and {x} of one node"));
                }
                *slot = *x;
            }
        }
        Ok(())
    }

    /// Copies the values of a piece to their places.
    fn take_values(&mut self, part: &Part) {
        let (size, whole) = if self.of_cells { (cells(part.size), cells(self.size)) } else { (part.size, self.size) };
        for ((all, piece), described) in self.values.iter_mut().zip(&part.values).zip(&self.described) {
            let (Some(all), Some(piece)) = (all, piece) else { continue };
            let width = described.components.max(1);
            for (from, n) in piece.chunks_exact(width).zip(places(size, part.offset, whole)) {
                if let Some(to) = all.get_mut(n * width..(n + 1) * width) {
                    to.copy_from_slice(from);
                }
            }
        }
    }
}

/// Where the nodes or cells of a piece lie among those of the whole, x running fastest.
fn places(size: [usize; 3], offset: [usize; 3], whole: [usize; 3]) -> impl Iterator<Item = usize> {
    let of = move |c: usize| offset[c]..offset[c] + size[c];
    of(2).flat_map(move |l| of(1).flat_map(move |j| of(0).map(move |i| i + whole[0] * (j + whole[1] * l))))
}

fn coordinates(form: &Form, piece: Node, [nx, ny, nz]: [usize; 3]) -> Result<[Vec<f64>; 3], String> {
    let coordinates = child(piece, "Coordinates").ok_or("no Coordinates")?;
    let all: Vec<Node> = arrays(coordinates).collect();
    let [x, y, z] = all[..] else { return Err("Coordinates needs three arrays".to_owned()) };
    Ok([form.values(x, nx)?, form.values(y, ny)?, form.values(z, nz)?])
}
