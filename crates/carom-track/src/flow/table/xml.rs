//! Tables as VTK XML (`.vtr` rectilinear grids and `.vti` images), as ParaView and the vtk package write them, in one piece or several.

mod pieces;

use super::arrays::{Chosen, Described, cells, hidden};
use super::columns::Validity;
use super::{Table, TableError};
use carom_cfd::vtk::xml::{self, Form, Node, Parts, arrays, child, numbers};
use carom_table::clipped;

pub(super) fn read(file: &[u8]) -> Result<Table, TableError> {
    read_or_say(file).map_err(|what| TableError::Xml { what })
}

fn read_or_say(file: &[u8]) -> Result<Table, String> {
    let parts = Parts::of(file)?;
    let document = parts.document()?;
    let root = document.root_element();
    let kind = root.attribute("type").unwrap_or("no type");
    let form = Form::of(root, &parts)?;
    let grid = child(root, kind).filter(|_| matches!(kind, "RectilinearGrid" | "ImageData"));
    let grid =
        grid.ok_or_else(|| format!("a rectilinear grid (.vtr) or an image (.vti) is read, not {}", clipped(kind)))?;
    let pieces: Vec<Node> = grid.children().filter(|n| n.has_tag_name("Piece")).collect();
    let whole = match pieces[..] {
        [] => return Err("no Piece".to_owned()),
        [one] => Extent::of(one, "Extent")?,
        _ => Extent::of(grid, "WholeExtent")?,
    };
    if whole.nodes().is_none_or(|n| n / xml::MOST_PACKED > file.len()) {
        return Err(format!("the extent {whole} does not fit the file"));
    }
    let mut read = pieces::Pieces::new(whole);
    for piece in &pieces {
        read.add(&form, *piece, grid, kind == "ImageData")?;
    }
    read.table()
}

/// A box of nodes, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Extent {
    first: [i64; 3],
    size: [usize; 3],
}

impl Extent {
    fn of(node: Node, name: &str) -> Result<Self, String> {
        let numbers: Vec<i64> = numbers(node, name)?;
        let [a, b, c, d, e, f] = numbers[..] else { return Err(format!("{name} needs six numbers")) };
        let size = [(a, b), (c, d), (e, f)]
            .map(|(low, high)| high.checked_sub(low).and_then(|n| usize::try_from(n).ok()?.checked_add(1)));
        match size {
            [Some(x), Some(y), Some(z)] => Ok(Self { first: [a, c, e], size: [x, y, z] }),
            _ => Err(format!("the {name} {numbers:?} does not fit the file")),
        }
    }

    fn nodes(&self) -> Option<usize> {
        self.size.iter().try_fold(1usize, |n, m| n.checked_mul(*m))
    }
}

impl std::fmt::Display for Extent {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let last = |c: usize| i128::from(self.first[c]) + self.size[c] as i128 - 1;
        let [a, b, c] = self.first;
        write!(f, "{a} {} {b} {} {c} {}", last(0), last(1), last(2))
    }
}

/// The arrays of a piece, and which are used.
struct Fields<'f, 'a, 'b> {
    form: &'f Form<'f>,
    piece: Node<'a, 'b>,
    arrays: Vec<Node<'a, 'b>>,
    described: Vec<Described>,
    chosen: Chosen,
    /// Nodes.
    size: [usize; 3],
    of_cells: bool,
}

impl<'f, 'a, 'b> Fields<'f, 'a, 'b> {
    /// Point data, or cell data where the points have no velocity.
    fn of(form: &'f Form<'f>, piece: Node<'a, 'b>, size: [usize; 3]) -> Result<Self, String> {
        let fields = |name: &str, of_cells: bool| -> Result<Self, String> {
            let data = child(piece, name).ok_or_else(|| format!("no {name}"))?;
            let arrays: Vec<Node> = arrays(data).collect();
            let described = arrays.iter().map(|a| describe(*a)).collect::<Result<Vec<_>, _>>()?;
            let chosen = Chosen::of(&described, of_cells)?;
            Ok(Self { form, piece, arrays, described, chosen, size, of_cells })
        };
        fields("PointData", false).or_else(|what| fields("CellData", true).map_err(|_| what))
    }

    fn count(&self) -> Result<usize, String> {
        let size = if self.of_cells { cells(self.size) } else { self.size };
        size.iter().try_fold(1usize, |n, m| n.checked_mul(*m)).ok_or_else(|| "too many values".to_owned())
    }

    /// The values of the arrays that are used.
    fn read(&self) -> Result<Vec<Option<Vec<f64>>>, String> {
        let (used, count) = (self.chosen.used(), self.count()?);
        let mut values = vec![None; self.arrays.len()];
        for i in used {
            let all = count.checked_mul(self.described[i].components).ok_or("too many values")?;
            values[i] = Some(self.form.values(self.arrays[i], all)?);
        }
        Ok(values)
    }

    /// The nodes that a mask of the cells hides, where the data are of points.
    fn hidden(&self) -> Result<Option<Vec<bool>>, String> {
        let Some(data) = child(self.piece, "CellData").filter(|_| !self.of_cells) else { return Ok(None) };
        let kind = |a: &Node| Validity::of(xml::name(*a), true);
        let Some((array, kind)) = arrays(data).find_map(|a| Some((a, kind(&a)?))) else { return Ok(None) };
        let count = cells(self.size).iter().product();
        Ok(Some(hidden(self.size, kind, &self.form.values(array, count)?)))
    }
}

fn describe(array: Node) -> Result<Described, String> {
    Ok(Described { name: xml::name(array).to_owned(), components: xml::components(array)? })
}

/// The axes of an image.
fn evenly(grid: Node, Extent { first, size }: Extent) -> Result<[Vec<f64>; 3], String> {
    if grid.attribute("Direction").is_some()
        && numbers::<f64>(grid, "Direction")? != [1., 0., 0., 0., 1., 0., 0., 0., 1.]
    {
        return Err("an image that is turned (Direction) is not read".to_owned());
    }
    let triple = |name| match numbers::<f64>(grid, name)?[..] {
        [x, y, z] if f64::is_finite(x + y + z) => Ok([x, y, z]),
        _ => Err(format!("{name} needs three numbers")),
    };
    let (origin, spacing) = (triple("Origin")?, triple("Spacing")?);
    Ok([0, 1, 2].map(|i| (0..size[i]).map(|n| origin[i] + (first[i] as f64 + n as f64) * spacing[i]).collect()))
}

#[cfg(test)]
mod tests;
