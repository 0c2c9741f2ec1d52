//! carom in Python. What a call does stands in the Python stubs (`python/carom/_carom.pyi`); here is how.
//!
//! Python's objects become numbers and texts in `numbers.rs` and `keys.rs`; `columns.rs` spreads rows over threads; the core answers.

mod columns;
mod command;
mod figures;
mod impact;
mod keys;
mod lab;
mod law;
mod materials;
mod met;
mod numbers;
mod outcome;
mod outcomes;
mod rows;
mod run;
mod spheres;
mod study;
mod table;
mod words;

use numbers::whole;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// What each validity code is: its bit in arrays, and its meaning.
fn validity(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let codes = PyDict::new(py);
    for (code, bit, meaning) in carom::validity::CODES {
        codes.set_item(code, (bit.bits(), meaning))?;
    }
    Ok(codes)
}

/// The validity codes whose bits are set.
///
/// Parameters
/// ----------
/// bits : int
///     An element of :attr:`Outcomes.validity`.
///
/// Returns
/// -------
/// tuple of str
#[pyfunction]
fn validity_codes(py: Python<'_>, #[pyo3(from_py_with = whole)] bits: u32) -> PyResult<Bound<'_, PyTuple>> {
    let set = carom::validity::CODES.iter().filter(|(_, bit, _)| bits & bit.bits() != 0);
    PyTuple::new(py, set.map(|(code, _, _)| *code).collect::<Vec<_>>())
}

/// The keys of a law.
///
/// Returns
/// -------
/// dict of str to dict
///     For each key its SI ``unit``, ``symbol``, ``meaning``, ``example``, ``default``, ``group``, and whether it ``may_be_drawn`` from a
///     distribution and ``may_be_fitted``.
#[pyfunction]
fn law_keys(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let keys = PyDict::new(py);
    for key in carom::spec::Key::ALL {
        let (info, about) = (key.info(), PyDict::new(py));
        for (name, value) in [
            ("unit", info.unit),
            ("symbol", info.symbol),
            ("meaning", info.meaning.trim()),
            ("example", info.example),
            ("default", info.default),
            ("group", info.group),
        ] {
            about.set_item(name, value)?;
        }
        about.set_item("may_be_drawn", info.draw.is_some())?;
        about.set_item("may_be_fitted", info.search.is_some())?;
        keys.set_item(info.name, about)?;
    }
    Ok(keys)
}

/// Does nothing: what a call costs.
#[pyfunction]
fn _nothing() {}

#[pymodule(gil_used = true)]
fn _carom(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    m.add("VALIDITY", validity(m.py())?)?;
    m.add_class::<law::WallLaw>()?;
    m.add_class::<outcome::Outcome>()?;
    m.add_class::<outcomes::Outcomes>()?;
    m.add_class::<materials::Materials>()?;
    m.add_class::<materials::Material>()?;
    m.add_class::<table::Table>()?;
    m.add_class::<run::Case>()?;
    m.add_function(wrap_pyfunction!(validity_codes, m)?)?;
    m.add_function(wrap_pyfunction!(law_keys, m)?)?;
    m.add_function(wrap_pyfunction!(_nothing, m)?)?;
    m.add_function(wrap_pyfunction!(numbers::_si, m)?)?;
    m.add_function(wrap_pyfunction!(study::sticking, m)?)?;
    m.add_function(wrap_pyfunction!(run::merge, m)?)?;
    m.add_function(wrap_pyfunction!(lab::fit, m)?)?;
    m.add_function(wrap_pyfunction!(lab::validate, m)?)?;
    m.add_function(wrap_pyfunction!(command::command, m)?)?;
    Ok(())
}
