//! What impacts came to, in arrays.

use crate::columns::{index, threads};
use crate::law::Law;
use crate::numbers::numpy;
use crate::rows::Rows;
use crate::table::Table;
use crate::words;
use carom::{Contact, ImpactError, Outcome as Core};
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyCapsule, PyDict, PyTuple};
use std::sync::Arc;

/// What impacts came to, in arrays of the shape that the inputs have together.
///
/// Attributes
/// ----------
/// normal, tangential, spin, restitution, impulse_ratio : numpy.ndarray of float
///     As in :class:`Outcome`; NaN where there was no impact.
/// fate, contact : numpy.ndarray of str
/// captured : numpy.ndarray of bool
/// tangential_restitution : numpy.ndarray of float
/// energy : dict of str to numpy.ndarray
///     Shares by name.
/// validity : numpy.ndarray of uint32
///     Bits; :func:`carom.validity_codes` names them.
///
/// Notes
/// -----
/// The first line's arrays are there at once, the others are computed when they are first asked for. They are then held against what was
/// there: if arrays were changed in between, that is a ``RuntimeError`` rather than a wrong answer.
///
/// pandas, polars and pyarrow read the rows through Arrow's C stream: ``polars.DataFrame(out)``, ``pyarrow.table(out)``.
#[pyclass(frozen, module = "carom")]
pub struct Outcomes {
    pub law: Arc<Law>,
    pub rows: Rows,
    pub shape: Vec<usize>,
    pub threads: Option<usize>,
    pub answer: [Py<PyArrayDyn<f64>>; 5],
    pub more: More,
}

/// What is computed when it is asked for, once.
pub struct More {
    fate: PyOnceLock<Py<PyAny>>,
    energy: PyOnceLock<Py<PyDict>>,
    contact: PyOnceLock<Py<PyAny>>,
    validity: PyOnceLock<Py<PyAny>>,
    tangential_restitution: PyOnceLock<Py<PyAny>>,
}

impl More {
    pub fn none() -> Self {
        Self {
            fate: PyOnceLock::new(),
            energy: PyOnceLock::new(),
            contact: PyOnceLock::new(),
            validity: PyOnceLock::new(),
            tangential_restitution: PyOnceLock::new(),
        }
    }
}

const FATES: [&str; 8] = [
    "rebound",
    "capture",
    "not-approaching",
    "bad-diameter",
    "bad-density",
    "not-finite",
    "friction-not-given",
    "bad-curvature",
];

fn fate_code(met: &Result<Core, ImpactError>) -> f64 {
    let word = met.as_ref().map_or_else(|e| words::fate(*e), |o| o.fate.name());
    FATES.iter().position(|f| *f == word).map_or(f64::NAN, |p| p as f64)
}

const CONTACTS: [Contact; 4] = [Contact::None, Contact::Sliding, Contact::Rolling, Contact::MicroSlip];

impl Outcomes {
    fn figures<'py, const WIDTH: usize>(
        &self,
        py: Python<'py>,
        write: impl Fn(&Result<Core, ImpactError>) -> [f64; WIDTH] + Sync,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let rows = self.shape.iter().product();
        let threads = threads(self.threads, rows, self.rows.cost(&self.law.wall).max(60));
        let answer = [self.answer[0].bind(py), self.answer[1].bind(py), self.answer[2].bind(py)];
        self.rows.figures(py, &self.law.wall, (&self.shape, threads), answer, write)
    }

    fn words<'py>(
        &self,
        py: Python<'py>,
        all: Vec<&'static str>,
        code: impl Fn(&Result<Core, ImpactError>) -> f64 + Sync,
    ) -> PyResult<Py<PyAny>> {
        let codes = self.figures(py, |met| [code(met)])?.get_item(0)?.call_method1("astype", ("uint8",))?;
        Ok(numpy(py)?.call_method1("array", (all,))?.get_item(codes)?.unbind())
    }

    /// The columns of a table.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        all.set_item("fate", self.fate(py)?)?;
        for (name, column) in
            ["normal", "tangential", "spin", "restitution", "impulse_ratio"].into_iter().zip(&self.answer)
        {
            all.set_item(name, column.bind(py))?;
        }
        all.set_item("tangential_restitution", self.tangential_restitution(py)?)?;
        all.set_item("contact", self.contact(py)?)?;
        all.update(self.energy(py)?.bind(py).as_mapping())?;
        all.set_item("validity", self.validity(py)?)?;
        Ok(all)
    }
}

#[pymethods]
impl Outcomes {
    #[getter]
    fn shape<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, &self.shape)
    }
    #[getter]
    fn size(&self) -> usize {
        self.shape.iter().product()
    }
    fn __len__(&self) -> usize {
        self.shape.first().copied().unwrap_or(0)
    }
    #[getter]
    fn normal(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.answer[0].clone_ref(py)
    }
    #[getter]
    fn tangential(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.answer[1].clone_ref(py)
    }
    #[getter]
    fn spin(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.answer[2].clone_ref(py)
    }
    #[getter]
    fn restitution(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.answer[3].clone_ref(py)
    }
    #[getter]
    fn impulse_ratio(&self, py: Python<'_>) -> Py<PyArrayDyn<f64>> {
        self.answer[4].clone_ref(py)
    }

    #[getter]
    fn fate(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let fate = self.more.fate.get_or_try_init(py, || self.words(py, FATES.to_vec(), fate_code))?;
        Ok(fate.clone_ref(py))
    }

    #[getter]
    fn captured<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        numpy(py)?.call_method1("equal", (self.answer[3].bind(py), 0.0))
    }

    #[getter]
    fn contact(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let code = |met: &Result<Core, ImpactError>| {
            let contact = met.as_ref().map_or(Contact::None, |o| o.contact);
            CONTACTS.iter().position(|c| *c == contact).unwrap_or(0) as f64
        };
        let names = CONTACTS.iter().map(|c| c.name()).collect();
        Ok(self.more.contact.get_or_try_init(py, || self.words(py, names, code))?.clone_ref(py))
    }

    #[getter]
    fn tangential_restitution(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let make = || {
            let of = |met: &Result<Core, ImpactError>| [met.as_ref().map_or(f64::NAN, |o| o.tangential_restitution)];
            Ok::<_, PyErr>(self.figures(py, of)?.get_item(0)?.unbind())
        };
        Ok(self.more.tangential_restitution.get_or_try_init(py, make)?.clone_ref(py))
    }

    #[getter]
    fn validity(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let make = || {
            let of = |met: &Result<Core, ImpactError>| [met.as_ref().map_or(0.0, |o| f64::from(o.validity.bits()))];
            Ok::<_, PyErr>(self.figures(py, of)?.get_item(0)?.call_method1("astype", ("uint32",))?.unbind())
        };
        Ok(self.more.validity.get_or_try_init(py, make)?.clone_ref(py))
    }

    #[getter]
    fn energy(&self, py: Python<'_>) -> PyResult<Py<PyDict>> {
        let make = || {
            let of = |met: &Result<Core, ImpactError>| {
                met.as_ref().map_or([f64::NAN; 8], |o| o.energy.named().map(|(_, share)| share))
            };
            let shares = self.figures(py, of)?;
            let energy = PyDict::new(py);
            for (place, (name, _)) in carom::Energy::default().named().into_iter().enumerate() {
                energy.set_item(name, shares.get_item(place)?)?;
            }
            Ok::<_, PyErr>(energy.unbind())
        };
        Ok(self.more.energy.get_or_try_init(py, make)?.clone_ref(py))
    }

    /// All columns by name, the energy's shares among them: ``pandas.DataFrame(out.to_dict())``.
    ///
    /// Returns
    /// -------
    /// dict of str to numpy.ndarray
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.columns(py)
    }

    /// The rows as an Arrow stream, one for each element in C order.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let _ = requested_schema;
        let units = [("normal", "m/s"), ("tangential", "m/s"), ("spin", "rad/s")];
        Table::of_arrays(&self.columns(py)?, &units)?.stream(py)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let rows: usize = self.shape.iter().product();
        let count =
            |name: &str, of: &Bound<'_, PyAny>| -> PyResult<usize> { numpy(py)?.call_method1(name, (of,))?.extract() };
        let captured = count("count_nonzero", &self.captured(py)?)?;
        let none = count("count_nonzero", &numpy(py)?.call_method1("isnan", (self.answer[3].bind(py),))?)?;
        let shape = PyTuple::new(py, &self.shape)?.repr()?;
        let unmet = if none > 0 { format!(", {none} no impact") } else { String::new() };
        Ok(format!(
            "<carom.Outcomes: {rows} impacts of shape {shape} on {}: {} rebound, {captured} capture{unmet}>",
            self.law.described(),
            rows - captured - none,
        ))
    }
}

/// Where a row stands, for an error.
pub fn place(shape: &[usize], row: usize) -> String {
    let index = index(shape, row);
    match &index[..] {
        [one] => format!("row {one}"),
        several => format!("row ({})", several.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
    }
}
