//! What impacts came to, in arrays.

use crate::columns::threads;
use crate::law::Law;
use crate::met::{self, Met};
use crate::numbers::{Input, numpy};
use crate::spheres::Spheres;
use crate::table::Table;
use carom::Contact;
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
    pub rows: Spheres<Input>,
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

const CONTACTS: [Contact; 4] = [Contact::None, Contact::Sliding, Contact::Rolling, Contact::MicroSlip];

impl Outcomes {
    fn figures<'py, const WIDTH: usize>(
        &self,
        py: Python<'py>,
        write: impl Fn(&Met) -> [f64; WIDTH] + Sync,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let rows = self.shape.iter().product();
        let threads = threads(self.threads, rows, self.rows.cost(&self.law.wall).max(60));
        let answer = [self.answer[0].bind(py), self.answer[1].bind(py), self.answer[2].bind(py)];
        self.rows.figures(py, &self.law.wall, (&self.shape, threads), answer, write)
    }

    fn words<'py>(
        &self,
        py: Python<'py>,
        all: &[&'static str],
        word: impl Fn(&Met) -> &'static str + Sync,
    ) -> PyResult<Py<PyAny>> {
        let code = |met: &Met| [all.iter().position(|w| *w == word(met)).map_or(f64::NAN, |place| place as f64)];
        let codes = self.figures(py, code)?.get_item(0)?.call_method1("astype", ("uint8",))?;
        Ok(numpy(py)?.call_method1("array", (all,))?.get_item(codes)?.unbind())
    }

    /// The columns of a table.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        all.set_item("fate", self.fate(py)?)?;
        for (name, column) in met::COLUMNS.into_iter().zip(&self.answer) {
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
        let fate = self.more.fate.get_or_try_init(py, || self.words(py, &met::FATES, met::fate))?;
        Ok(fate.clone_ref(py))
    }

    #[getter]
    fn captured<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        numpy(py)?.call_method1("equal", (self.answer[3].bind(py), 0.0))
    }

    #[getter]
    fn contact(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let contact = |met: &Met| met::contact(met).name();
        let names = CONTACTS.map(Contact::name);
        Ok(self.more.contact.get_or_try_init(py, || self.words(py, &names, contact))?.clone_ref(py))
    }

    #[getter]
    fn tangential_restitution(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let make = || Ok::<_, PyErr>(self.figures(py, |met| [met::tangential_restitution(met)])?.get_item(0)?.unbind());
        Ok(self.more.tangential_restitution.get_or_try_init(py, make)?.clone_ref(py))
    }

    #[getter]
    fn validity(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let make = || {
            let of = |met: &Met| [met.as_ref().map_or(0.0, |o| f64::from(o.validity.bits()))];
            Ok::<_, PyErr>(self.figures(py, of)?.get_item(0)?.call_method1("astype", ("uint32",))?.unbind())
        };
        Ok(self.more.validity.get_or_try_init(py, make)?.clone_ref(py))
    }

    #[getter]
    fn energy(&self, py: Python<'_>) -> PyResult<Py<PyDict>> {
        let make = || {
            let shares = self.figures(py, |met| met::energy(met).map(|(_, share)| share))?;
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
        let units = [("normal", "m/s"), ("tangential", "m/s"), ("spin", "rad/s")];
        Table::of_arrays(&self.columns(py)?, &units)?.__arrow_c_stream__(py, requested_schema)
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
