//! The library of materials.

use crate::keys::quoted;
use crate::words;
use carom::material::{Library, PropertyKind};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::path::PathBuf;
use std::sync::Arc;

/// Materials by name, each value with its source: a read-only mapping.
///
/// ``carom.materials`` holds those that come along; :meth:`with_file` and :meth:`with_toml` add one's own.
#[pyclass(frozen, module = "carom")]
#[derive(Clone)]
pub struct Materials {
    pub library: Arc<Library>,
    /// What was added to the built-in ones.
    pub added: Arc<str>,
}

impl Materials {
    /// Those that come along.
    pub fn builtin() -> Self {
        Self { library: Arc::new(Library::builtin().clone()), added: "".into() }
    }

    /// These, or those that come along.
    pub fn or_builtin(given: Option<&Bound<'_, Self>>) -> Self {
        given.map_or_else(Self::builtin, |m| m.get().clone())
    }

    fn with(&self, name: &str, text: &str) -> PyResult<Self> {
        let mut library = (*self.library).clone();
        library.extend_from_toml(text).map_err(|e| words::of_text(&e, name, text))?;
        let added = if self.added.is_empty() { text.to_owned() } else { format!("{}\n{text}", self.added) };
        Ok(Self { library: Arc::new(library), added: added.into() })
    }
}

#[pymethods]
impl Materials {
    #[new]
    fn new() -> Self {
        Self::builtin()
    }

    /// These, and the ``[material.NAME]`` tables of a text.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     TOML.
    ///
    /// Returns
    /// -------
    /// Materials
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     What is wrong, with its line.
    fn with_toml(&self, text: &str) -> PyResult<Self> {
        self.with("materials", text)
    }

    /// These, and the ``[material.NAME]`` tables of a file; see :meth:`with_toml`.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     A file.
    ///
    /// Returns
    /// -------
    /// Materials
    fn with_file(&self, path: PathBuf) -> PyResult<Self> {
        let text = std::fs::read_to_string(&path).map_err(|e| file_error(&e, &path))?;
        self.with(&path.display().to_string(), &text)
    }

    fn __getitem__(&self, name: &str) -> PyResult<Material> {
        match self.library.get(name) {
            Ok(found) => Ok(Material(found.clone())),
            Err(error) => Err(PyKeyError::new_err(error.said_in(&words::Python))),
        }
    }

    #[pyo3(signature = (name, default=None))]
    fn get<'py>(&self, py: Python<'py>, name: &str, default: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        match self.library.get(name) {
            Ok(found) => Ok(Bound::new(py, Material(found.clone()))?.into_any()),
            Err(_) => Ok(default.unwrap_or_else(|| py.None().into_bound(py))),
        }
    }

    fn keys(&self) -> Vec<String> {
        self.library.iter().map(|m| m.name.clone()).collect()
    }

    fn values(&self) -> Vec<Material> {
        self.library.iter().map(|m| Material(m.clone())).collect()
    }

    fn items(&self) -> Vec<(String, Material)> {
        self.library.iter().map(|m| (m.name.clone(), Material(m.clone()))).collect()
    }

    fn __contains__(&self, name: &Bound<'_, PyAny>) -> bool {
        name.extract::<String>().is_ok_and(|n| self.library.get(&n).is_ok())
    }

    fn __len__(&self) -> usize {
        self.library.iter().count()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        PyList::new(py, self.keys())?.call_method0("__iter__")
    }

    fn __repr__(&self) -> String {
        format!("<carom.Materials: {}>", self.keys().join(", "))
    }

    fn _repr_html_(&self) -> String {
        let mut rows = String::new();
        for m in self.library.iter() {
            let cells: String = PropertyKind::ALL
                .iter()
                .map(|k| format!("<td>{}</td>", m.value(*k).map_or_else(String::new, |v| format!("{v:.4e}"))))
                .collect();
            rows += &format!("<tr><th>{}</th>{cells}</tr>", html(&m.name));
        }
        let heads: String = PropertyKind::ALL.iter().map(|k| format!("<th>{} ({})</th>", k.noun(), k.unit())).collect();
        format!("<table><tr><th>material</th>{heads}</tr>{rows}</table>")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let restore = slf.py().import("carom._carom")?.getattr("Materials")?.getattr("_restored")?;
        Ok((restore, (slf.get().added.to_string(),)))
    }

    #[staticmethod]
    fn _restored(added: &str) -> PyResult<Self> {
        let own = Self::builtin();
        if added.is_empty() { Ok(own) } else { own.with_toml(added) }
    }
}

/// The error of a file.
pub fn file_error(error: &std::io::Error, path: &std::path::Path) -> PyErr {
    pyo3::exceptions::PyOSError::new_err((error.raw_os_error(), error.to_string(), path.display().to_string()))
}

/// A material. ``None`` stands for what is not known.
///
/// Attributes
/// ----------
/// name, description : str
/// density : float
///     kg/m3.
/// young_modulus : float
///     Pa.
/// poisson_ratio : float
/// surface_energy : float
///     J/m2.
/// yield_strength, hardness, tensile_strength : float
///     Pa.
/// properties : dict
///     Each known property: value, unit, ends of its printed range, source, what a typical value rests on, note.
/// aliases : list of str
/// note : str
#[pyclass(frozen, eq, module = "carom")]
#[derive(Clone, PartialEq)]
pub struct Material(pub carom::material::Material);

impl Material {
    /// As an inline table of a law's text.
    pub fn inline(&self) -> String {
        let entries: Vec<String> = PropertyKind::ALL
            .iter()
            .filter_map(|k| Some(format!("{} = {:?}", quoted(k.key()), self.0.value(*k)?)))
            .collect();
        format!("{{ {} }}", entries.join(", "))
    }
}

#[pymethods]
impl Material {
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }
    #[getter]
    fn description(&self) -> &str {
        &self.0.description
    }
    #[getter]
    fn aliases(&self) -> Vec<String> {
        self.0.aliases.clone()
    }
    #[getter]
    fn note(&self) -> Option<&str> {
        self.0.note.as_deref()
    }
    #[getter]
    fn density(&self) -> Option<f64> {
        self.0.density
    }
    #[getter]
    fn young_modulus(&self) -> Option<f64> {
        self.0.young_modulus
    }
    #[getter]
    fn poisson_ratio(&self) -> Option<f64> {
        self.0.poisson_ratio
    }
    #[getter]
    fn surface_energy(&self) -> Option<f64> {
        self.0.surface_energy
    }
    #[getter]
    fn yield_strength(&self) -> Option<f64> {
        self.0.yield_strength
    }
    #[getter]
    fn hardness(&self) -> Option<f64> {
        self.0.hardness
    }
    #[getter]
    fn tensile_strength(&self) -> Option<f64> {
        self.0.tensile_strength
    }

    /// Each known property: value, unit, ends of its range, source, what a typical value rests on, note.
    #[getter]
    fn properties<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (kind, p) in &self.0.properties {
            let one = PyDict::new(py);
            one.set_item("value", p.value)?;
            one.set_item("unit", kind.unit())?;
            one.set_item("low", p.low)?;
            one.set_item("high", p.high)?;
            one.set_item("source", p.source.as_deref())?;
            one.set_item("typical", p.typical.as_deref())?;
            one.set_item("note", p.note.as_deref())?;
            all.set_item(kind.key(), one)?;
        }
        Ok(all)
    }

    fn __repr__(&self) -> String {
        let known: Vec<String> =
            PropertyKind::ALL.iter().filter_map(|k| Some(format!("{}={:?}", k.key(), self.0.value(*k)?))).collect();
        format!("<carom.Material {}: {}>", self.0.name, known.join(", "))
    }

    fn _repr_html_(&self) -> String {
        let rows: String = self
            .0
            .properties
            .iter()
            .map(|(kind, p)| {
                let source = p.source.as_deref().or(p.typical.as_deref()).unwrap_or_default();
                format!(
                    "<tr><th>{}</th><td>{:?} {}</td><td>{}</td></tr>",
                    kind.noun(),
                    p.value,
                    kind.unit(),
                    html(source)
                )
            })
            .collect();
        format!("<table><caption>{}</caption>{rows}</table>", html(&self.0.name))
    }
}

/// A text in HTML.
pub fn html(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
