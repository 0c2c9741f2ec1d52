//! Tables as text: the columns by the names that programs give them, or as the case names them.

use super::columns::{Columns, Quantity};
use super::holes::fill;
use super::{DENSITY, Named, Row, TEMPERATURE, Table, TableError};
use carom_table::Sheet;

pub(super) fn read(text: &[u8], named: &Named) -> Result<Table, TableError> {
    let sheet = Sheet::read(text, &|name| Columns::knows(name, named))?;
    let columns = Columns::find(&sheet, named)?;
    let rows = Rows::read(&sheet, &columns)?;
    let axes = [0, 1, 2].map(|i| distinct(rows.at.iter().map(|x| x[i]).collect()));
    let size = axes.each_ref().map(Vec::len);
    let count = size.iter().try_fold(1usize, |n, m| n.checked_mul(*m)).unwrap_or(usize::MAX);
    let mut line_of = vec![0u64; count.min(rows.at.len() * 4 + 1)];
    let mut nodes = vec![Row::default(); line_of.len()];
    let mut valid = vec![true; line_of.len()];
    for (((x, node), line), holds) in rows.at.iter().zip(&rows.values).zip(&rows.lines).zip(&rows.valid) {
        let index = (0..3).fold(0usize, |n, i| n.wrapping_mul(size[i]).wrapping_add(nearest(&axes[i], x[i])));
        let Some(seen) = line_of.get_mut(index) else { continue };
        if *seen != 0 {
            return Err(TableError::Twice { line: *line, first: *seen, node: *x });
        }
        *seen = *line;
        (nodes[index], valid[index]) = (*node, *holds);
    }
    if let Some(index) = line_of.iter().position(|line| *line == 0) {
        let k = index % size[2];
        let j = index / size[2] % size[1];
        let i = index / size[2] / size[1];
        return Err(TableError::Missing { node: [axes[0][i], axes[1][j], axes[2][k]], size });
    }
    let mut notes = columns.notes;
    notes.extend(fill(size, &mut nodes, &mut valid).map_err(|what| TableError::Holes { what })?);
    Ok(Table::new(axes, &nodes, columns.given).noting(notes))
}

/// The rows of a table, in order.
struct Rows {
    at: Vec<[f64; 3]>,
    values: Vec<Row>,
    lines: Vec<u64>,
    valid: Vec<bool>,
}

impl Rows {
    fn read(sheet: &Sheet, columns: &Columns) -> Result<Self, TableError> {
        let mut rows = Self { at: Vec::new(), values: Vec::new(), lines: Vec::new(), valid: Vec::new() };
        let mut reader = sheet.rows();
        while let Some(line) = reader.next_row()?.map(|row| row.line) {
            let mut valid = true;
            for mask in &columns.masks {
                let value = reader.number(mask.column)?;
                valid &= value.is_none_or(|v| mask.holds(v));
            }
            let (mut x, mut node) = ([0.0; 3], Row::default());
            for found in &columns.found {
                let value = if valid || found.is_place() { reader.number(found.column)? } else { Some(0.0) };
                let nothing = || TableError::Nothing { line, column: found.written.clone() };
                let value = value.ok_or_else(nothing)? * found.factor + found.offset;
                match found.quantity {
                    Quantity::Place(c) => x[c] = value,
                    Quantity::Value(c) => {
                        if (3..TEMPERATURE).contains(&c) && value < 0.0 {
                            return Err(TableError::Negative { line, column: found.written.clone(), value });
                        }
                        if (TEMPERATURE..=DENSITY).contains(&c) && valid && value <= 0.0 {
                            return Err(TableError::NotPositive { line, column: found.written.clone(), value });
                        }
                        node[c] = value;
                    }
                }
            }
            if columns.by_frequency {
                // ε = β* k ω (Wilcox, Turbulence Modeling for CFD), β* = 0.09
                node[4] *= 0.09 * node[3];
            }
            rows.at.push(x);
            rows.values.push(node);
            rows.lines.push(line);
            rows.valid.push(valid);
        }
        if rows.at.is_empty() { Err(TableError::Empty) } else { Ok(rows) }
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
mod tests;
