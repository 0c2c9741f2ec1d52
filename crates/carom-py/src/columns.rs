//! Arrays as columns of rows: broadcast without copies, spread over threads in chunks.

use crate::numbers::{Input, numpy};
use carom::ImpactError;
use numpy::ndarray::{ArrayViewD, Axis, IxDyn};
use numpy::{PyArrayDyn, PyArrayMethods as _, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArrayMethods as _};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::{Mutex, PoisonError};

/// Rows handled at once: their columns stay in the second-level cache.
pub const CHUNK: usize = 2048;

/// The shape that arrays have together, by NumPy's rules; `None` where all are single numbers.
pub fn shape(py: Python<'_>, inputs: &[(&str, &Input)]) -> PyResult<Option<Vec<usize>>> {
    let shapes: Vec<(&str, Vec<usize>)> = inputs
        .iter()
        .filter_map(|(name, input)| match input {
            Input::One(_) => None,
            Input::Many(array) => Some((*name, array.bind(py).shape().to_vec())),
        })
        .collect();
    let Some(most) = shapes.iter().map(|(_, s)| s.len()).max() else { return Ok(None) };
    let mut all = vec![1; most];
    for (_, shape) in &shapes {
        for (whole, length) in all.iter_mut().rev().zip(shape.iter().rev()) {
            match (*whole, *length) {
                (whole, length) if whole == length || length == 1 => {}
                (1, length) => *whole = length,
                _ => {
                    let told: Vec<String> = shapes.iter().map(|(n, s)| format!("{n} {s:?}")).collect();
                    return Err(PyValueError::new_err(format!("shapes that do not broadcast: {}", told.join(", "))));
                }
            }
        }
    }
    if all.iter().try_fold(1usize, |n, length| n.checked_mul(*length)).is_none_or(|n| n > isize::MAX as usize / 8) {
        return Err(PyValueError::new_err(format!("{all:?} has more rows than memory can hold")));
    }
    Ok(Some(all))
}

/// An array for results. NumPy refuses what is too large.
pub fn empty<'py>(py: Python<'py>, shape: &[usize]) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    Ok(numpy(py)?.call_method1("empty", (PyTuple::new(py, shape)?,))?.cast_into()?)
}

/// Its values, to be written.
pub fn written<'py>(array: &Bound<'py, PyArrayDyn<f64>>) -> PyResult<PyReadwriteArrayDyn<'py, f64>> {
    array.try_readwrite().map_err(|e| PyValueError::new_err(e.to_string()))
}

/// An input that is held while it is read.
pub enum Held<'py> {
    One(f64),
    Many(PyReadonlyArrayDyn<'py, f64>),
}

impl<'py> Held<'py> {
    pub fn of(py: Python<'py>, input: &Input) -> PyResult<Self> {
        Ok(match input {
            Input::One(value) => Self::One(*value),
            Input::Many(array) => {
                Self::Many(array.bind(py).try_readonly().map_err(|e| PyValueError::new_err(e.to_string()))?)
            }
        })
    }

    /// The column in a shape that it broadcasts to.
    pub fn column(&self, shape: &[usize]) -> Column<'_> {
        match self {
            Self::One(value) => Column::One(*value),
            Self::Many(array) => match array.as_slice() {
                Ok(slice) if array.is_c_contiguous() && array.shape() == shape => Column::Flat(slice),
                _ => Column::View { array: array.as_array(), shape: shape.to_vec() },
            },
        }
    }
}

/// The rows of one input.
pub enum Column<'a> {
    One(f64),
    Flat(&'a [f64]),
    /// An array, and the shape that it broadcasts to.
    View {
        array: ArrayViewD<'a, f64>,
        shape: Vec<usize>,
    },
}

impl Column<'_> {
    /// Rows `from` and on; `room` holds them where they do not lie side by side.
    pub fn rows<'b>(&'b self, from: usize, count: usize, room: &'b mut Vec<f64>) -> &'b [f64] {
        match self {
            Self::Flat(slice) => &slice[from..from + count],
            Self::One(value) => {
                room.clear();
                room.resize(count, *value);
                room
            }
            Self::View { array, shape } => {
                room.clear();
                if let Some(view) = array.broadcast(IxDyn(shape)) {
                    gather(&view, from, count, room);
                }
                room
            }
        }
    }

    /// One row.
    pub fn row(&self, row: usize) -> f64 {
        match self {
            Self::One(value) => *value,
            Self::Flat(slice) => slice[row],
            Self::View { array, shape } => {
                let mut index = index(shape, row);
                let mut own = index.split_off(shape.len() - array.ndim());
                for (place, length) in own.iter_mut().zip(array.shape()) {
                    *place = if *length == 1 { 0 } else { *place };
                }
                array[IxDyn(&own)]
            }
        }
    }
}

/// Where a row stands in a shape.
pub fn index(shape: &[usize], mut row: usize) -> Vec<usize> {
    let mut index = vec![0; shape.len()];
    for (place, length) in index.iter_mut().zip(shape).rev() {
        *place = row % length;
        row /= length;
    }
    index
}

/// Where a row stands, for an error.
pub fn place(shape: &[usize], row: usize) -> String {
    let index = index(shape, row);
    match &index[..] {
        [one] => format!("row {one}"),
        several => format!("row ({})", several.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// Copies rows lane by lane of the last axis.
fn gather(view: &ArrayViewD<'_, f64>, from: usize, count: usize, room: &mut Vec<f64>) {
    let shape = view.shape();
    let Some(last) = shape.last().copied() else { return };
    let mut row = from;
    while row < from + count {
        let (lane, start) = (row / last, row % last);
        let take = (last - start).min(from + count - row);
        let mut values = view.view();
        for place in index(&shape[..shape.len() - 1], lane) {
            values = values.index_axis_move(Axis(0), place);
        }
        room.extend(values.iter().skip(start).take(take));
        row += take;
    }
}

/// Threads for so many rows that each cost about so many nanoseconds: none where a thread would take longer to start.
pub fn threads(asked: Option<usize>, rows: usize, cost: usize) -> usize {
    const WORTH: usize = 200_000;
    let machine = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let most = rows.div_ceil(CHUNK).max(1);
    match asked {
        Some(asked) => asked.clamp(1, 4096).min(most),
        None => machine.min(rows.saturating_mul(cost) / WORTH + 1).min(most),
    }
}

/// Does the work for each item, on several threads. They are this call's own, so that a process may fork between calls.
pub fn over<T: Send>(threads: usize, items: impl Iterator<Item = T> + Send, work: impl Fn(T) + Sync) {
    let items = Mutex::new(items);
    let next = || items.lock().unwrap_or_else(PoisonError::into_inner).next();
    let all = || {
        while let Some(item) = next() {
            work(item);
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(all);
        }
        all();
    });
}

/// The first row that is no impact, whichever thread meets it.
pub struct First(Mutex<Option<(usize, ImpactError)>>);

impl First {
    pub const fn none() -> Self {
        Self(Mutex::new(None))
    }

    /// A row that is none.
    pub fn met(&self, row: usize, error: ImpactError) {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if first.is_none_or(|(other, _)| row < other) {
            *first = Some((row, error));
        }
    }

    pub fn row(self) -> Option<(usize, ImpactError)> {
        self.0.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}
