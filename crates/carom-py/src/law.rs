//! A wall law: made of keywords, texts and files, and written as such. Its impacts are in `impact.rs`, its figures in `figures.rs`.

use crate::materials::{Materials, file_error, html};
use crate::{keys, words};
use carom::spec::{Key, LawSpec, NormalSpec, parse_named_law, parse_only_law};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyType};
use std::path::PathBuf;
use std::sync::Arc;

/// A law as written and as it answers.
pub struct Law {
    pub spec: LawSpec,
    pub wall: carom::WallLaw,
    pub materials: Materials,
}

impl Law {
    /// Compiles it.
    pub fn new(spec: LawSpec, materials: Materials) -> PyResult<Self> {
        let wall = spec.compile(&materials.library).map_err(|e| words::of_keys(&e))?;
        Ok(Self { spec, wall, materials })
    }

    /// `copper on glass, ea`
    pub fn described(&self) -> String {
        let normal = match self.spec.normal.as_ref().map(|n| &n.value) {
            Some(NormalSpec::Named(kind)) => kind.name().to_owned(),
            Some(NormalSpec::Losses(losses)) => losses.iter().map(|l| l.name()).collect::<Vec<_>>().join(" + "),
            None => String::new(),
        };
        match self.wall.pair() {
            Some(pair) => format!("{} on {}, {normal}", pair.sphere().name, pair.surface().name),
            None => normal,
        }
    }

    fn toml(&self, name: &str) -> PyResult<String> {
        self.spec.to_toml(name).map_err(|e| words::of_keys(&e))
    }
}

/// What a wall does to spheres: two materials, a normal and a tangential law, roughness.
///
/// Parameters
/// ----------
/// materials : Materials, optional
///     The library that names are looked up in; the built-in one by default.
/// **keys
///     The keys of a law file (``carom.law_keys()`` lists them, docs/wall-law.md explains them): ``sphere``, ``surface``, ``normal``,
///     ``friction``, ``roughness_factor``, ... Quantities are SI numbers, texts with units (``"1.3 s/m"``) or pint quantities; a
///     material is a name, a :class:`Material` or a dict of properties; a curve is a dict, a list of losses a list.
///
/// Raises
/// ------
/// ValueError, TypeError
///     What is missing, impossible, idle or contradictory, and what would be right.
///
/// Notes
/// -----
/// A law never changes and may be used by many threads. It pickles, compares by its keys, and ``str(law)`` is its TOML.
///
/// Examples
/// --------
/// >>> import carom
/// >>> law = carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=0.2, roughness_factor=0.8)
/// >>> round(law.capture_velocity("90 um"), 6)
/// 0.091551
#[pyclass(frozen, module = "carom")]
#[derive(Clone)]
pub struct WallLaw(pub Arc<Law>);

impl WallLaw {
    fn read(text: &str, name: Option<&str>, materials: Materials, file: &str) -> PyResult<Self> {
        let read = || {
            let spec = name.map_or_else(|| parse_only_law(text), |name| parse_named_law(text, name))?;
            let wall = spec.compile(&materials.library)?;
            Ok((spec, wall))
        };
        let (spec, wall) = read().map_err(|e| words::of_text(&e, file, text))?;
        Ok(Self(Arc::new(Law { spec, wall, materials })))
    }
}

#[pymethods]
impl WallLaw {
    #[new]
    #[pyo3(signature = (*, materials=None, **keys))]
    fn new(materials: Option<&Bound<'_, Materials>>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Ok(Self(Arc::new(Law::new(keys::spec(keys)?, Materials::or_builtin(materials))?)))
    }

    /// A law from a text, as a law file or a case file holds it.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     TOML: one law's keys, or ``[law.NAME]`` tables.
    /// name : str, optional
    ///     Which law; needed where there is more than one.
    /// materials : Materials, optional
    ///     The library.
    ///
    /// Returns
    /// -------
    /// WallLaw
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     What is wrong, with its line.
    #[classmethod]
    #[pyo3(signature = (text, name=None, *, materials=None))]
    fn from_toml(
        _: &Bound<'_, PyType>,
        text: &str,
        name: Option<&str>,
        materials: Option<&Bound<'_, Materials>>,
    ) -> PyResult<Self> {
        Self::read(text, name, Materials::or_builtin(materials), "law")
    }

    /// A law from a file; see :meth:`from_toml`.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     A law file or a case file.
    /// name : str, optional
    ///     Which law.
    /// materials : Materials, optional
    ///     The library.
    ///
    /// Returns
    /// -------
    /// WallLaw
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     What is wrong, with its line.
    /// OSError
    ///     A file that cannot be read.
    #[classmethod]
    #[pyo3(signature = (path, name=None, *, materials=None))]
    fn from_file(
        _: &Bound<'_, PyType>,
        path: PathBuf,
        name: Option<&str>,
        materials: Option<&Bound<'_, Materials>>,
    ) -> PyResult<Self> {
        let text = std::fs::read_to_string(&path).map_err(|e| file_error(&e, &path))?;
        Self::read(&text, name, Materials::or_builtin(materials), &path.display().to_string())
    }

    /// The law as TOML with one table, ``[law.NAME]``; bare numbers are SI.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     The table's name.
    ///
    /// Returns
    /// -------
    /// str
    #[pyo3(signature = (name="law"))]
    fn to_toml(&self, name: &str) -> PyResult<String> {
        self.0.toml(name)
    }

    /// The law's keys as plain values, SI units.
    ///
    /// Returns
    /// -------
    /// dict
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = serde_json::to_string(&self.0.spec).map_err(|e| PyValueError::new_err(e.to_string()))?;
        py.import("json")?.call_method1("loads", (text,))
    }

    /// The law with other keys.
    ///
    /// Parameters
    /// ----------
    /// **keys
    ///     As in :class:`WallLaw`; ``None`` leaves a key out. A key takes the place of what excludes it.
    ///
    /// Returns
    /// -------
    /// WallLaw
    #[pyo3(signature = (**keys))]
    fn replace(&self, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut spec = self.0.spec.clone();
        for (name, value) in keys.into_iter().flatten() {
            let key = keys::key(name.cast::<PyString>()?.to_str()?)?;
            if value.is_none() {
                spec.remove(key);
            } else {
                spec.make_room(key);
                keys::set(&mut spec, key, &value)?;
            }
        }
        Ok(Self(Arc::new(Law::new(spec, self.0.materials.clone())?)))
    }

    /// Density of the law's own sphere, kg/m3.
    #[getter]
    fn density(&self) -> f64 {
        self.0.wall.density()
    }
    /// The roughness factor C_R in force.
    #[getter]
    fn roughness_factor(&self) -> f64 {
        self.0.wall.roughness_factor()
    }
    /// Whether facets are drawn, so that impacts depend on ``draws``.
    #[getter]
    fn scatters(&self) -> bool {
        self.0.wall.scatter().is_some()
    }
    /// The library its names were looked up in.
    #[getter]
    fn materials(&self) -> Materials {
        self.0.materials.clone()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let keys = self.to_dict(py)?.cast_into::<PyDict>()?;
        let mut written = Vec::new();
        for (name, value) in keys {
            written.push(format!("{name}={}", value.repr()?));
        }
        Ok(format!("carom.WallLaw({})", written.join(", ")))
    }

    fn __str__(&self) -> PyResult<String> {
        self.0.toml("law")
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let keys = self.to_dict(py)?.cast_into::<PyDict>()?;
        let mut rows = String::new();
        for (name, value) in keys {
            let name = name.str()?.to_string();
            let info = Key::by_name(&name).map(Key::info);
            let (unit, meaning) = info.map_or(("", ""), |i| (i.unit, i.meaning.trim()));
            rows += &format!(
                "<tr><th>{name}</th><td>{} {unit}</td><td>{}</td></tr>",
                html(&value.str()?.to_string()),
                html(meaning)
            );
        }
        Ok(format!("<table><caption>{}</caption>{rows}</table>", html(&self.0.described())))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        let Ok(other) = other.cast::<Self>() else { return Ok(false) };
        let (a, b) = (&self.0, &other.get().0);
        Ok(a.toml("law")? == b.toml("law")? && a.materials.added == b.materials.added)
    }

    fn __hash__(&self) -> PyResult<u64> {
        use std::hash::{DefaultHasher, Hash as _, Hasher as _};
        let mut hasher = DefaultHasher::new();
        self.0.toml("law")?.hash(&mut hasher);
        Ok(hasher.finish())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, Materials))> {
        let restore = slf.py().import("carom._carom")?.getattr("WallLaw")?.getattr("_restored")?;
        Ok((restore, (slf.get().0.toml("law")?, slf.get().0.materials.clone())))
    }

    #[staticmethod]
    fn _restored(text: &str, materials: &Materials) -> PyResult<Self> {
        Self::read(text, Some("law"), materials.clone(), "law")
    }
}
