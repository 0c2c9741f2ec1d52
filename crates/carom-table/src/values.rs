//! Values of a column, and of a cell.

use std::sync::Arc;

/// A column's values; the missing ones are NaN or `None`.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Real numbers; NaN is a missing value.
    Float(Vec<f64>),
    /// Signed whole numbers.
    Integer(Vec<Option<i64>>),
    /// Whole numbers from zero: counts, particle numbers.
    Count(Vec<Option<u64>>),
    /// Text; shared, since names of walls and fates repeat down a column.
    Text(Vec<Option<Arc<str>>>),
}

/// The kind of a column's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// `f64`, NaN where missing.
    Float,
    /// `i64`.
    Integer,
    /// `u64`.
    Count,
    /// Text.
    Text,
}

impl Values {
    pub(crate) fn empty(kind: Kind) -> Self {
        match kind {
            Kind::Float => Self::Float(Vec::new()),
            Kind::Integer => Self::Integer(Vec::new()),
            Kind::Count => Self::Count(Vec::new()),
            Kind::Text => Self::Text(Vec::new()),
        }
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Float(v) => v.len(),
            Self::Integer(v) => v.len(),
            Self::Count(v) => v.len(),
            Self::Text(v) => v.len(),
        }
    }

    /// Whether there are no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Their kind.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self {
            Self::Float(_) => Kind::Float,
            Self::Integer(_) => Kind::Integer,
            Self::Count(_) => Kind::Count,
            Self::Text(_) => Kind::Text,
        }
    }

    pub(crate) fn truncate(&mut self, rows: usize) {
        match self {
            Self::Float(v) => v.truncate(rows),
            Self::Integer(v) => v.truncate(rows),
            Self::Count(v) => v.truncate(rows),
            Self::Text(v) => v.truncate(rows),
        }
    }

    pub(crate) fn retain(&mut self, kept: &[bool]) {
        fn retain<T>(values: &mut Vec<T>, kept: &[bool]) {
            let mut kept = kept.iter();
            values.retain(|_| kept.next().is_none_or(|k| *k));
        }
        match self {
            Self::Float(v) => retain(v, kept),
            Self::Integer(v) => retain(v, kept),
            Self::Count(v) => retain(v, kept),
            Self::Text(v) => retain(v, kept),
        }
    }

    /// Appends one cell; hands it back when its kind does not fit.
    pub(crate) fn push(&mut self, cell: Cell) -> Result<(), Cell> {
        match (self, cell) {
            (Self::Float(v), Cell::Float(x)) => v.push(x),
            (Self::Float(v), Cell::Missing) => v.push(f64::NAN),
            (Self::Integer(v), Cell::Integer(i)) => v.push(Some(i)),
            (Self::Integer(v), Cell::Missing) => v.push(None),
            (Self::Count(v), Cell::Count(n)) => v.push(Some(n)),
            (Self::Count(v), Cell::Missing) => v.push(None),
            (Self::Text(v), Cell::Text(s)) => v.push(Some(s)),
            (Self::Text(v), Cell::Missing) => v.push(None),
            (_, cell) => return Err(cell),
        }
        Ok(())
    }

    pub(crate) fn extend(&mut self, other: &Self, rows: std::ops::Range<usize>) {
        match (self, other) {
            (Self::Float(a), Self::Float(b)) => a.extend_from_slice(&b[rows]),
            (Self::Integer(a), Self::Integer(b)) => a.extend_from_slice(&b[rows]),
            (Self::Count(a), Self::Count(b)) => a.extend_from_slice(&b[rows]),
            (Self::Text(a), Self::Text(b)) => a.extend_from_slice(&b[rows]),
            // The only caller, Table::append_rows, has compared the schemas.
            _ => {}
        }
    }
}

/// One value on its way into a row.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// No value, for a column of any kind.
    Missing,
    /// A real number (NaN: missing).
    Float(f64),
    /// A signed whole number.
    Integer(i64),
    /// A whole number from zero.
    Count(u64),
    /// Text.
    Text(Arc<str>),
}

macro_rules! cell_from {
    ($($type:ty => $variant:ident),* $(,)?) => {$(
        impl From<$type> for Cell {
            fn from(value: $type) -> Self {
                Self::$variant(value.into())
            }
        }
        impl From<Option<$type>> for Cell {
            fn from(value: Option<$type>) -> Self {
                value.map_or(Self::Missing, Self::from)
            }
        }
    )*};
}
cell_from!(f64 => Float, i64 => Integer, u64 => Count, &str => Text, String => Text, Arc<str> => Text);
