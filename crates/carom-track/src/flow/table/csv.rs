//! Tables as CSV.

use super::{Node, QUANTITIES, Table, TableError};
use std::io::Read;

pub(super) fn read(text: impl Read) -> Result<Table, TableError> {
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
    Ok(Table::new(axes, nodes, rows.turbulent))
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
