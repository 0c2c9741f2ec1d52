//! Aligned text for a terminal. By hand: a table crate brings terminal control and wrapping, and all that is needed is padding.

use crate::number;
use crate::{Column, Table, Values};
use std::borrow::Cow;

/// What stands for a missing value.
const MISSING: &str = "-";

pub(crate) fn render(table: &Table) -> String {
    let cells: Vec<Vec<String>> = table.columns().iter().map(column_cells).collect();
    let widths: Vec<usize> =
        cells.iter().map(|column| column.iter().map(|c| c.chars().count()).max().unwrap_or_default()).collect();
    let mut out = String::new();
    for row in 0..=table.rows() {
        let padded: Vec<String> = table
            .columns()
            .iter()
            .zip(cells.iter().zip(&widths))
            .map(|(column, (cells, width))| match column.values {
                Values::Text(_) => format!("{:<width$}", cells[row]),
                _ => format!("{:>width$}", cells[row]),
            })
            .collect();
        out.push_str(padded.join("  ").trim_end());
        out.push('\n');
        if row == 0 {
            let rules: Vec<String> = widths.iter().map(|w| "-".repeat(*w)).collect();
            out.push_str(&rules.join("  "));
            out.push('\n');
        }
    }
    out
}

/// The heading and then every row's text, as a person reads it.
pub fn column_cells(column: &Column) -> Vec<String> {
    let missing = || MISSING.to_owned();
    let mut cells = vec![cut(&column.field().heading(), WIDEST).into_owned()];
    match &column.values {
        Values::Float(v) => {
            cells.extend(v.iter().map(|x| if x.is_nan() { missing() } else { number::significant(*x, 6) }));
        }
        Values::Integer(v) => cells.extend(v.iter().map(|i| i.map_or_else(missing, |i| i.to_string()))),
        Values::Count(v) => cells.extend(v.iter().map(|n| n.map_or_else(missing, |n| n.to_string()))),
        Values::Text(v) => {
            cells.extend(v.iter().map(|s| s.as_deref().map_or_else(missing, |s| cut(s, WIDEST).into_owned())));
        }
    }
    cells
}

/// Characters of a text that a message repeats.
const MOST: usize = 60;

/// Characters of a cell in a terminal; beyond 65535, formatting would refuse.
const WIDEST: usize = 300;

fn cut(text: &str, most: usize) -> Cow<'_, str> {
    match text.char_indices().nth(most) {
        Some((end, _)) => Cow::Owned(format!("{}…", &text[..end])),
        None => Cow::Borrowed(text),
    }
}

/// A text that is cut where it is too long for a message.
pub fn clipped(text: &str) -> Cow<'_, str> {
    cut(text, MOST)
}

/// A text in quotes for a message, cut where it is too long.
pub fn quoted(text: &str) -> String {
    format!("\"{}\"", clipped(text))
}
