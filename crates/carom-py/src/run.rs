//! Particles of a case from injection to fate.

use crate::materials::Materials;
use crate::numbers::whole;
use crate::words;
use carom_track::case::Sources;
use carom_track::{About, Progress, RunOptions, Shard};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// A case, read and checked.
#[pyclass(frozen, module = "carom")]
pub struct Case(carom_track::Case);

/// How often Python is asked whether to stop.
const HEARD: Duration = Duration::from_millis(50);

/// Tells Python how far a run is, and hears from it: Ctrl-C, or an exception of the callback.
struct Told {
    callback: Option<Py<PyAny>>,
    last: Mutex<Option<Instant>>,
    error: Mutex<Option<PyErr>>,
}

impl Progress for Told {
    fn particles(&self, done: u64, all: u64) {
        let now = Instant::now();
        let Ok(mut last) = self.last.lock() else { return };
        if done < all && last.is_some_and(|t| now - t < HEARD) {
            return;
        }
        *last = Some(now);
        drop(last);
        let heard = Python::attach(|py| {
            py.check_signals()?;
            self.callback.as_ref().map_or(Ok(()), |call| call.call1(py, (done, all)).map(|_| ()))
        });
        if let (Err(error), Ok(mut place)) = (heard, self.error.lock()) {
            place.get_or_insert(error);
        }
    }

    fn stops(&self) -> bool {
        self.error.lock().is_ok_and(|e| e.is_some())
    }
}

#[pymethods]
impl Case {
    /// Reads a case; `sources` are files that it names and that are not on disk.
    #[staticmethod]
    fn from_toml(
        text: &str,
        name: PathBuf,
        sources: BTreeMap<String, Vec<u8>>,
        materials: Option<&Bound<'_, Materials>>,
    ) -> PyResult<Self> {
        let materials = Materials::or_builtin(materials);
        let case = carom_track::Case::from_toml_with(text, &name, &materials.library, &Sources::new(sources));
        case.map(Self).map_err(|e| words::of_text(&e, &name.display().to_string(), text))
    }

    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes.clone()
    }
    #[getter]
    fn count(&self) -> u64 {
        self.0.count()
    }
    #[getter]
    fn walls(&self) -> Vec<String> {
        self.0.domain.walls().iter().map(|w| w.name.clone()).collect()
    }

    /// Runs it into a folder and gives the summary as JSON.
    #[pyo3(signature = (out, threads, resume, force, shard, callback))]
    #[expect(clippy::too_many_arguments, reason = "arguments of `carom.run`")]
    fn run(
        &self,
        py: Python<'_>,
        out: PathBuf,
        #[pyo3(from_py_with = whole)] threads: usize,
        resume: bool,
        force: bool,
        shard: Option<(u64, u64)>,
        callback: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        let shard = shard.map(|(index, of)| Shard { index, of });
        let options = RunOptions { threads, out: Some(out.clone()), resume, force, shard, ..RunOptions::default() };
        let told = Told { callback, last: Mutex::new(None), error: Mutex::new(None) };
        let start = Instant::now();
        let summary = py.detach(|| carom_track::run(&self.0, &options, &told));
        if let Ok(Some(error)) = told.error.into_inner() {
            return Err(error);
        }
        let summary = summary.map_err(words::of_run)?;
        if shard.is_none() {
            py.detach(|| carom_cli::write_report(&About::of(&self.0), &summary, &out, Some(start.elapsed())))
                .map_err(PyRuntimeError::new_err)?;
        }
        summary.to_json().map_err(|e| PyRuntimeError::new_err(e.to_string()))
    }
}

/// Puts shards together and gives the summary as JSON.
#[pyfunction]
pub fn merge(py: Python<'_>, shards: Vec<PathBuf>, out: PathBuf, force: bool) -> PyResult<String> {
    let (summary, about) = py.detach(|| carom_track::merge(&shards, &out, force)).map_err(words::of_run)?;
    py.detach(|| carom_cli::write_report(&about, &summary, &out, None)).map_err(PyRuntimeError::new_err)?;
    summary.to_json().map_err(|e| PyRuntimeError::new_err(e.to_string()))
}
