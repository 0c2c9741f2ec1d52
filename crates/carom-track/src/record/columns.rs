//! Records as columns: what the tracker appends to, and what all files are written from.

use crate::vector::Vec3;

/// One column; all of a table are of one length.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Column {
    /// Whole numbers.
    Count(Vec<u64>),
    /// Real numbers; NaN where there is none.
    Float(Vec<f64>),
    /// Codes of words; [`NO_WORD`] where there is none.
    Word(Vec<u32>),
}

/// The code of no word.
pub(crate) const NO_WORD: u32 = u32::MAX;

/// Which kind a column is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Count,
    Float,
    Word,
}

/// Bytes of a cell in memory at most, and of one on disk between memory and a file for users.
pub(crate) const CELL: usize = 8;

/// A table as columns, of which the first holds the particles' numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Columns(Vec<Column>);

impl Columns {
    pub fn new(kinds: impl IntoIterator<Item = Kind>) -> Self {
        let empty = |kind| match kind {
            Kind::Count => Column::Count(Vec::new()),
            Kind::Float => Column::Float(Vec::new()),
            Kind::Word => Column::Word(Vec::new()),
        };
        Self(kinds.into_iter().map(empty).collect())
    }

    /// Empty columns of the same kinds.
    pub fn empty_like(&self) -> Self {
        Self::new(self.0.iter().map(Column::kind))
    }

    pub fn columns(&self) -> &[Column] {
        &self.0
    }

    pub fn into_columns(self) -> Vec<Column> {
        self.0
    }

    pub fn rows(&self) -> usize {
        match self.0.first() {
            Some(Column::Count(v)) => v.len(),
            Some(Column::Float(v)) => v.len(),
            Some(Column::Word(v)) => v.len(),
            None => 0,
        }
    }

    /// Bytes of a row on its way through a file.
    pub fn row_bytes(&self) -> usize {
        CELL * self.0.len()
    }

    /// The particles' numbers.
    pub fn particles(&self) -> &[u64] {
        match self.0.first() {
            Some(Column::Count(v)) => v,
            _ => &[],
        }
    }

    /// Begins a row; each column is given one value, in order.
    pub fn row(&mut self) -> Row<'_> {
        Row(self.0.iter_mut())
    }

    /// The rows ordered by particle; those of one particle keep their order.
    pub fn by_particle(self) -> Self {
        if self.particles().is_sorted() {
            return self;
        }
        let particles = self.particles();
        let mut order: Vec<u32> = (0..particles.len() as u32).collect();
        order.sort_by_key(|i| particles[*i as usize]);
        let column = |column: &Column| match column {
            Column::Count(v) => Column::Count(order.iter().map(|i| v[*i as usize]).collect()),
            Column::Float(v) => Column::Float(order.iter().map(|i| v[*i as usize]).collect()),
            Column::Word(v) => Column::Word(order.iter().map(|i| v[*i as usize]).collect()),
        };
        Self(self.0.iter().map(column).collect())
    }

    /// Appends the rows to bytes, cell by cell, eight bytes each.
    pub fn to_bytes(&self, out: &mut Vec<u8>) {
        out.reserve(self.rows() * self.row_bytes());
        for row in 0..self.rows() {
            for column in &self.0 {
                let cell = match column {
                    Column::Count(v) => v[row],
                    Column::Float(v) => v[row].to_bits(),
                    Column::Word(v) => u64::from(v[row]),
                };
                out.extend_from_slice(&cell.to_le_bytes());
            }
        }
    }

    /// Appends whole rows from bytes.
    pub fn extend_from_bytes(&mut self, bytes: &[u8]) {
        debug_assert!(bytes.len().is_multiple_of(self.row_bytes()));
        for row in bytes.chunks_exact(self.row_bytes()) {
            for (column, cell) in self.0.iter_mut().zip(row.as_chunks::<CELL>().0) {
                let cell = u64::from_le_bytes(*cell);
                match column {
                    Column::Count(v) => v.push(cell),
                    Column::Float(v) => v.push(f64::from_bits(cell)),
                    Column::Word(v) => v.push(cell as u32),
                }
            }
        }
    }
}

impl Column {
    fn kind(&self) -> Kind {
        match self {
            Self::Count(_) => Kind::Count,
            Self::Float(_) => Kind::Float,
            Self::Word(_) => Kind::Word,
        }
    }
}

/// A row under way.
pub(crate) struct Row<'a>(std::slice::IterMut<'a, Column>);

impl Row<'_> {
    pub fn count(&mut self, n: u64) -> &mut Self {
        match self.0.next() {
            Some(Column::Count(v)) => v.push(n),
            other => debug_assert!(false, "a count for {other:?}"),
        }
        self
    }

    pub fn float(&mut self, x: f64) -> &mut Self {
        match self.0.next() {
            Some(Column::Float(v)) => v.push(x),
            other => debug_assert!(false, "a number for {other:?}"),
        }
        self
    }

    pub fn floats(&mut self, all: impl IntoIterator<Item = f64>) -> &mut Self {
        all.into_iter().for_each(|x| {
            self.float(x);
        });
        self
    }

    pub fn vector(&mut self, v: Vec3) -> &mut Self {
        self.floats(v)
    }

    pub fn word(&mut self, code: u32) -> &mut Self {
        match self.0.next() {
            Some(Column::Word(v)) => v.push(code),
            other => debug_assert!(false, "a word for {other:?}"),
        }
        self
    }

    /// Ends the row.
    pub fn end(&mut self) {
        debug_assert!(self.0.next().is_none(), "a row too short");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_their_order_within_a_particle_and_go_through_bytes_unchanged() {
        let mut columns = Columns::new([Kind::Count, Kind::Float, Kind::Word]);
        for (i, particle) in [3u64, 1, 3, 2, 1, 1].into_iter().enumerate() {
            columns.row().count(particle).float(if i == 2 { f64::NAN } else { i as f64 }).word(i as u32).end();
        }
        let sorted = columns.by_particle();
        assert_eq!(sorted.particles(), [1, 1, 1, 2, 3, 3]);
        assert_eq!(sorted.columns()[2], Column::Word(vec![1, 4, 5, 3, 0, 2]));
        let mut bytes = Vec::new();
        sorted.to_bytes(&mut bytes);
        assert_eq!(bytes.len(), 6 * sorted.row_bytes());
        let mut read = sorted.empty_like();
        read.extend_from_bytes(&bytes);
        assert_eq!(format!("{read:?}"), format!("{sorted:?}"));
    }
}
