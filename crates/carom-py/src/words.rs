//! How errors speak to Python's users.

use carom::error::{ErrorKind, Wording};
use carom::spec::Key;
use carom::{ImpactError, LawError};
use carom_lab::LabError;
use carom_track::{Remedy, RunError};
use pyo3::PyErr;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyTypeError, PyValueError};

/// Keys as keyword arguments.
pub struct Python;

impl Wording for Python {
    fn key(&self, key: &str) -> String {
        key.to_owned()
    }

    fn value(&self, value: &str) -> String {
        let bare = value.parse::<f64>().is_ok() || value.starts_with(['{', '[']);
        if bare { value.to_owned() } else { format!("'{value}'") }
    }

    fn setting(&self, key: &str, value: &str) -> String {
        format!("{key}={}", self.value(value))
    }

    fn loss(&self, name: &str) -> String {
        format!("normal=['{name}']")
    }

    fn materials(&self) -> Option<String> {
        Some("carom.materials holds all".to_owned())
    }
}

/// A mistake in keyword arguments.
pub fn of_keys(error: &LawError) -> PyErr {
    let text = error.said_in(&Python);
    match error.kind() {
        ErrorKind::WrongType | ErrorKind::UnknownKey => PyTypeError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

/// A mistake in one keyword argument: a unit's error names it.
pub fn of_key(key: Key, error: &LawError) -> PyErr {
    match error.kind() {
        ErrorKind::WrongUnit => PyValueError::new_err(format!("{key}: {}", error.said_in(&Python))),
        _ => of_keys(error),
    }
}

/// A mistake in a text, shown at its place.
pub fn of_text(error: &LawError, name: &str, text: &str) -> PyErr {
    PyValueError::new_err(error.shown(name, text))
}

/// No impact.
pub fn of_impact(error: ImpactError, place: &str) -> PyErr {
    let remedy = match error {
        ImpactError::FrictionNotGiven => ": give friction=0.2",
        _ => "",
    };
    let colon = if place.is_empty() { "" } else { ": " };
    PyValueError::new_err(format!("{place}{colon}{error}{remedy}"))
}

/// A run that could not be made. What to do next is said in the words of `carom.run`.
pub fn of_run(error: RunError) -> PyErr {
    match &error {
        RunError::Io { path, source } => {
            PyOSError::new_err((source.raw_os_error(), source.to_string(), path.display().to_string()))
        }
        RunError::Occupied { folder, what } => PyValueError::new_err(format!(
            "{}: holds {what}: go on with it with resume=True, replace it with force=True, or name another folder",
            folder.display()
        )),
        RunError::NoFolder => {
            PyValueError::new_err("nothing to resume: an interrupted run is found by its output folder, give out=")
        }
        RunError::Foreign { path, message, remedy } => {
            let remedy = match remedy {
                None => "",
                Some(Remedy::Resume) => ": go on with it with resume=True",
                Some(Remedy::Force) => ": start anew with force=True",
                Some(Remedy::ForceOrPutBack) => ": start anew with force=True, or put back what was there",
                Some(Remedy::SameShard) => ": give the same shard",
            };
            PyValueError::new_err(format!("{}: {message}{remedy}", path.display()))
        }
        RunError::Busy { .. } | RunError::Missing { .. } | RunError::Shard { .. } => {
            PyValueError::new_err(error.to_string())
        }
        _ => PyRuntimeError::new_err(error.to_string()),
    }
}

/// A fit or a validation that could not be made.
pub fn of_lab(error: LabError) -> PyErr {
    match &error {
        LabError::Experiment { name, text, error } => of_text(error, name, text),
        LabError::Data { name, text, error } => of_text(error, name, text),
        LabError::File { path, source } => {
            PyOSError::new_err((source.raw_os_error(), source.to_string(), path.display().to_string()))
        }
        LabError::Points(_) | LabError::Fit(_) => PyValueError::new_err(error.to_string()),
        _ => PyRuntimeError::new_err(error.to_string()),
    }
}
