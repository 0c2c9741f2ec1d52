//! Tables as legacy VTK: rectilinear grids and images.

use super::arrays::{Chosen, Described, cells, hidden, rising};
use super::columns::Validity;
use super::{Table, TableError};
use carom_cfd::vtk::legacy::{Array, Problem, Reader};
use carom_table::clipped;

pub(super) fn read(file: &[u8]) -> Result<Table, TableError> {
    Ok(table(file)?)
}

impl From<Problem> for TableError {
    fn from(Problem { byte, what }: Problem) -> Self {
        Self::Vtk { byte, what }
    }
}

fn table(file: &[u8]) -> Result<Table, Problem> {
    let mut reader = Reader::new(file)?;
    let axes = geometry(&mut reader)?;
    let size = axes.each_ref().map(Vec::len);
    let [points, of_cells] = reader.data(size.iter().product(), cells(size).iter().product())?;
    let describe = |a: &Array| Described { name: a.name.to_owned(), components: a.components };
    let point_data: Vec<Described> = points.iter().map(describe).collect();
    let cell_data: Vec<Described> = of_cells.iter().map(describe).collect();
    let (chosen, by_cell) = match Chosen::of(&point_data, false) {
        Ok(chosen) => (chosen, false),
        Err(what) => (Chosen::of(&cell_data, true).map_err(|_| reader.error(what))?, true),
    };
    let (described, arrays) = if by_cell { (cell_data, &of_cells) } else { (point_data, &points) };
    let mut values = vec![None; arrays.len()];
    for i in chosen.used() {
        values[i] = Some(reader.decoded(&arrays[i])?);
    }
    let mask = of_cells.iter().filter(|_| !by_cell).find_map(|a| Some((a, Validity::of(a.name, true)?)));
    let hidden = match mask {
        Some((array, kind)) => Some(hidden(size, kind, &reader.decoded::<f64>(array)?)),
        None => None,
    };
    chosen.table(axes, &described, &values, hidden.as_deref()).map_err(|what| reader.error(what))
}

fn geometry(reader: &mut Reader) -> Result<[Vec<f64>; 3], Problem> {
    let kind = reader.expect("DATASET", 1)?[0].to_ascii_uppercase();
    let words = reader.expect("DIMENSIONS", 3)?;
    let mut size = [0usize; 3];
    for (n, word) in size.iter_mut().zip(words) {
        *n = reader.parse(word)?;
    }
    let nodes = size.iter().try_fold(1usize, |n, m| n.checked_mul(*m));
    // every node takes some bytes: a size beyond the file's is a mistake, not a reason to allocate
    if nodes.is_none_or(|n| n == 0 || n > reader.size()) {
        return Err(reader.error(format!("dimensions {size:?} do not fit the file")));
    }
    let axes = match kind.as_str() {
        "RECTILINEAR_GRID" => coordinates(reader, size)?,
        "STRUCTURED_POINTS" => origin_and_spacing(reader, size)?,
        _ => {
            return Err(reader.error(format!(
                "{} is not a rectilinear grid: a mesh is resampled first (ParaView: Resample To Image)",
                clipped(&kind)
            )));
        }
    };
    rising(&axes).map_err(|what| reader.error(what))?;
    Ok(axes)
}

fn coordinates(reader: &mut Reader, size: [usize; 3]) -> Result<[Vec<f64>; 3], Problem> {
    let mut axes = [const { Vec::new() }; 3];
    for (i, keyword) in ["X_COORDINATES", "Y_COORDINATES", "Z_COORDINATES"].into_iter().enumerate() {
        let words = reader.expect(keyword, 2)?;
        let count: usize = reader.parse(words[0])?;
        if count != size[i] {
            return Err(reader.error(format!("{keyword} has {count} values, DIMENSIONS says {}", size[i])));
        }
        axes[i] = reader.values(count, words[1])?;
        reader.skip_metadata();
    }
    Ok(axes)
}

fn origin_and_spacing(reader: &mut Reader, size: [usize; 3]) -> Result<[Vec<f64>; 3], Problem> {
    let mut given = [None; 2];
    while given.contains(&None) {
        let words = reader.words().unwrap_or_default();
        let which = match words.first().map(|w| w.to_ascii_uppercase()).as_deref() {
            Some("ORIGIN") => 0,
            Some("SPACING" | "ASPECT_RATIO") => 1,
            _ => return Err(reader.error("ORIGIN and SPACING must follow DIMENSIONS")),
        };
        let mut triple = [0.0f64; 3];
        for (i, c) in triple.iter_mut().enumerate() {
            *c = reader.parse(words.get(i + 1).copied().unwrap_or(""))?;
        }
        given[which] = Some(triple);
    }
    let [origin, spacing] = given.map(Option::unwrap_or_default);
    if origin.iter().chain(&spacing).any(|c| !c.is_finite()) {
        return Err(reader.error("ORIGIN and SPACING must be finite"));
    }
    Ok([0, 1, 2].map(|i| (0..size[i]).map(|n| origin[i] + n as f64 * spacing[i]).collect()))
}

#[cfg(test)]
mod tests;
