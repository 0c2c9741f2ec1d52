//! Parameters from measurements, and the models held against experiments.

use crate::law::{Law, WallLaw};
use crate::materials::Materials;
use crate::numbers::whole;
use crate::table::Table;
use crate::words;
use carom::material::Library;
use carom_lab::fit::{BootstrapOptions, Data, Free, Options, Parameter as _, Resampling, fit as fitted, parameter};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// Fits parameters of a law to points in CSV.
#[pyfunction]
#[pyo3(signature = (name, csv, law, free, bounds, diameter, resamples, seed, resample))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of `carom.fit`")]
pub fn fit<'py>(
    py: Python<'py>,
    name: &str,
    csv: &str,
    law: &Bound<'py, WallLaw>,
    free: Vec<String>,
    bounds: Vec<(String, f64, f64)>,
    diameter: Option<f64>,
    #[pyo3(from_py_with = whole)] resamples: u32,
    #[pyo3(from_py_with = whole)] seed: u64,
    resample: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let law = &law.get().0;
    let library = &law.materials.library;
    let mut wanted = Vec::new();
    for one in &free {
        wanted.push(Free::new(parameter(one).map_err(|e| words::of_keys(&e))?));
    }
    for (name, low, high) in bounds {
        let key = parameter(&name).map_err(|e| words::of_keys(&e))?;
        let natural = key.natural_bounds();
        if !(low < high && natural.contains(&low) && natural.contains(&high)) {
            let (from, to) = (natural.start(), natural.end());
            let message = format!("bounds of {name}: two numbers are wanted, the smaller first, within {from} to {to}");
            return Err(PyValueError::new_err(message));
        }
        let Some(found) = wanted.iter_mut().find(|f| f.parameter == key) else {
            return Err(PyValueError::new_err(format!(
                "bounds of {name}: it is not free; name it in free, or leave its bounds out"
            )));
        };
        found.bounds = low..=high;
    }
    let resampling = match resample {
        "residuals" => Resampling::Residuals,
        "pairs" => Resampling::Pairs,
        other => return Err(PyValueError::new_err(format!("resample='{other}'; 'residuals' or 'pairs' is wanted"))),
    };
    let data = Data::from_csv(name, csv, diameter).map_err(words::of_lab)?;
    let mut spec = law.spec.clone();
    for one in &wanted {
        let start = one.parameter.start(&spec, library).clamp(*one.bounds.start(), *one.bounds.end());
        one.parameter.set(&mut spec, start);
    }
    let options = Options { bootstrap: BootstrapOptions { resamples, seed, resampling } };
    let found = py.detach(|| fitted(&spec, &wanted, &data, library, &options)).map_err(words::of_lab)?;
    let all = PyDict::new(py);
    let json = serde_json::to_string(&found).map_err(|e| PyRuntimeError::new_err(e.to_string()))?;
    all.set_item("fit", py.import("json")?.call_method1("loads", (json,))?)?;
    all.set_item("law", WallLaw(Arc::new(Law::new(found.law, law.materials.clone())?)))?;
    all.set_item("left_out", data.left_out)?;
    Ok(all)
}

/// Holds the models against the experiments that come along, or against those of a folder.
#[pyfunction]
#[pyo3(signature = (folder, out, materials))]
pub fn validate<'py>(
    py: Python<'py>,
    folder: Option<PathBuf>,
    out: Option<PathBuf>,
    materials: Option<&Bound<'py, Materials>>,
) -> PyResult<Bound<'py, PyDict>> {
    let library = materials.map(|m| Arc::clone(&m.get().library));
    let found = py.detach(|| {
        let experiments = folder.as_deref().map_or_else(carom_lab::builtin, carom_lab::from_folder)?;
        let found = carom_lab::validate(experiments, library.as_deref().unwrap_or(Library::builtin()))?;
        out.as_deref().map_or(Ok(()), |out| found.write(out))?;
        Ok((found.to_json()?, found.summary()?))
    });
    let (json, summary) = found.map_err(words::of_lab)?;
    let all = PyDict::new(py);
    all.set_item("found", py.import("json")?.call_method1("loads", (json,))?)?;
    all.set_item("summary", Table::of_table(&summary)?)?;
    Ok(all)
}
