//! Python's numbers, texts with units, pint's quantities and arrays as numbers in SI units.

use carom::units::{Angle, AngularVelocity, Density, Length, Quantity, Speed};
use numpy::{PyArrayDyn, PyArrayMethods as _, PyUntypedArrayMethods as _};
use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    Diameter,
    Speed,
    /// Degrees from the surface.
    Angle,
    Spin,
    Density,
    /// A pure number.
    Draws,
}

impl What {
    /// The unit as pint writes it.
    fn unit(self) -> &'static str {
        match self {
            Self::Diameter => "m",
            Self::Speed => "m/s",
            Self::Angle => "degree",
            Self::Spin => "rad/s",
            Self::Density => "kg/m**3",
            Self::Draws => "",
        }
    }

    /// A text with a unit.
    pub fn parse(self, text: &str) -> Result<f64, String> {
        fn of<Q: Quantity>(text: &str) -> Result<f64, String> {
            text.parse::<Q>().map(Q::si).map_err(|e| e.to_string())
        }
        match self {
            Self::Diameter => of::<Length>(text),
            Self::Speed => of::<Speed>(text),
            Self::Spin => of::<AngularVelocity>(text),
            Self::Density => of::<Density>(text),
            Self::Draws => of::<carom::units::Number>(text),
            Self::Angle => {
                // by hand, so that 30 deg is 30 to the last bit
                let bare = text.trim().trim_end_matches("deg").trim_end_matches('°').trim_end();
                bare.parse().or_else(|_| of::<Angle>(text).map(f64::to_degrees))
            }
        }
    }
}

/// A number, or an array of them.
#[derive(Debug)]
pub enum Input {
    One(f64),
    Many(Py<PyArrayDyn<f64>>),
}

impl Input {
    /// Of an argument called `name`.
    #[inline]
    pub fn of(value: &Bound<'_, PyAny>, name: &str, what: What) -> PyResult<Self> {
        // the common case first
        match value.cast::<PyFloat>() {
            Ok(float) => Ok(Self::One(float.value())),
            Err(_) => other(value, name, what),
        }
    }

    /// Of an argument that may be left out.
    #[inline]
    pub fn or(value: Option<&Bound<'_, PyAny>>, default: f64, name: &str, what: What) -> PyResult<Self> {
        value.map_or(Ok(Self::One(default)), |v| Self::of(v, name, what))
    }

    /// The number, if it is one.
    #[inline]
    pub fn one(&self) -> Option<f64> {
        match self {
            Self::One(value) => Some(*value),
            Self::Many(_) => None,
        }
    }
}

/// A whole number from zero, or what stands for none. One that is negative or too large is a mistake like any other.
pub fn whole<'a, 'py, T>(value: &'a Bound<'py, PyAny>) -> PyResult<T>
where
    T: FromPyObject<'a, 'py>,
    T::Error: Into<PyErr>,
{
    value.extract::<T>().map_err(|error| {
        let (error, py): (PyErr, _) = (error.into(), value.py());
        if error.is_instance_of::<PyOverflowError>(py) {
            PyValueError::new_err(format!("{value} is out of range: a whole number from 0 is wanted"))
        } else {
            error
        }
    })
}

/// One number, not an array.
pub fn one(value: &Bound<'_, PyAny>, name: &str, what: What) -> PyResult<f64> {
    Input::of(value, name, what)?
        .one()
        .ok_or_else(|| PyTypeError::new_err(format!("{name}: one number is wanted, not an array")))
}

fn other(value: &Bound<'_, PyAny>, name: &str, what: What) -> PyResult<Input> {
    if value.is_none() || value.is_instance_of::<PyBool>() {
        let kind = if value.is_none() { "None" } else { "a bool" };
        return Err(PyTypeError::new_err(format!(
            "{name}: {kind}; a number, a text with a unit or an array is wanted"
        )));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return parse(&text.to_string_lossy(), name, what).map(Input::One);
    }
    if value.is_instance_of::<PyInt>() {
        return value
            .extract()
            .map(Input::One)
            .map_err(|e| PyValueError::new_err(format!("{name}: {}", e.value(value.py()))));
    }
    match magnitude(value, name, what.unit())? {
        Some(number) => array(&number, name, what),
        None => array(value, name, what),
    }
}

fn parse(text: &str, name: &str, what: What) -> PyResult<f64> {
    what.parse(text).map_err(|e| PyValueError::new_err(format!("{name}: {e}")))
}

/// The number of a pint quantity in a unit; `None` for what is none.
pub fn magnitude<'py>(value: &Bound<'py, PyAny>, name: &str, unit: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
    if !(value.hasattr("magnitude")? && value.hasattr("to")?) {
        return Ok(None);
    }
    let wrong = |e: PyErr| PyValueError::new_err(format!("{name}: {}", e.value(value.py())));
    let unit = if unit.is_empty() { "dimensionless" } else { unit };
    Ok(Some(value.call_method1("to", (unit,)).map_err(wrong)?.getattr("magnitude")?))
}

/// NumPy.
pub fn numpy(py: Python<'_>) -> PyResult<&Bound<'_, PyModule>> {
    static NUMPY: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    Ok(NUMPY.get_or_try_init(py, || py.import("numpy").map(Bound::unbind))?.bind(py))
}

/// Anything that NumPy makes an array of real numbers of.
fn array(value: &Bound<'_, PyAny>, name: &str, what: What) -> PyResult<Input> {
    let py = value.py();
    // the common case: nothing to ask NumPy about
    if let Ok(array) = value.cast::<PyArrayDyn<f64>>()
        && array.is_exact_instance_of::<PyArrayDyn<f64>>()
        && array.ndim() > 0
        && aligned(array)
    {
        return Ok(Input::Many(array.clone().unbind()));
    }
    let numpy = numpy(py)?;
    let refused = |e: PyErr| {
        let message = format!("{name}: no array of numbers can be made of it: {}", e.value(py));
        if e.is_instance_of::<pyo3::exceptions::PyMemoryError>(py) { e } else { PyTypeError::new_err(message) }
    };
    let masked = value.hasattr("mask")? && value.hasattr("filled")?;
    let filled = if masked {
        // what is masked is no number
        value
            .call_method1("astype", ("float64",))
            .and_then(|v| v.call_method1("filled", (f64::NAN,)))
            .map_err(refused)?
    } else {
        value.clone()
    };
    let array = numpy.call_method1("asarray", (filled,)).map_err(refused)?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    let array = match kind.as_str() {
        "f" | "i" | "u" | "O" => {
            let wanted = PyDict::new(py);
            wanted.set_item("dtype", "float64")?;
            wanted.set_item("requirements", "A")?;
            numpy.call_method("require", (array,), Some(&wanted)).map_err(refused)?
        }
        "U" => texts(&array, name, what)?,
        _ => {
            let dtype = array.getattr("dtype")?.str()?;
            return Err(PyTypeError::new_err(format!(
                "{name}: an array of {}; real numbers are wanted, or texts with units",
                dtype.to_string_lossy()
            )));
        }
    };
    let array = array.cast_into::<PyArrayDyn<f64>>().map_err(|e| PyTypeError::new_err(format!("{name}: {e}")))?;
    if array.ndim() == 0 {
        return Ok(Input::One(array.call_method0("item")?.extract()?));
    }
    Ok(Input::Many(array.unbind()))
}

fn aligned(array: &Bound<'_, PyArrayDyn<f64>>) -> bool {
    (array.data() as usize).is_multiple_of(align_of::<f64>())
        && array.strides().iter().all(|s| s.unsigned_abs().is_multiple_of(align_of::<f64>()))
}

/// An array of texts, each with its unit.
fn texts<'py>(array: &Bound<'py, PyAny>, name: &str, what: What) -> PyResult<Bound<'py, PyAny>> {
    let flat: Vec<String> = array.call_method0("ravel")?.call_method0("tolist")?.extract()?;
    let numbers = flat.iter().map(|text| parse(text, name, what)).collect::<PyResult<Vec<f64>>>()?;
    numpy(array.py())?.call_method1("array", (numbers,))?.call_method1("reshape", (array.getattr("shape")?,))
}

/// An argument of an impact in SI units (angles in degrees), as it is or as an array.
#[pyfunction]
pub fn _si<'py>(py: Python<'py>, name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let what = match name {
        "diameter" => What::Diameter,
        "speed" | "normal" | "tangential" => What::Speed,
        "angle" => What::Angle,
        "spin" => What::Spin,
        "density" => What::Density,
        _ => What::Draws,
    };
    Ok(match Input::of(value, name, what)? {
        Input::One(number) => number.into_pyobject(py)?.into_any(),
        Input::Many(array) => array.into_bound(py).into_any(),
    })
}
