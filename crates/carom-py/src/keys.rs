//! Keyword arguments as the keys of a law.

use crate::materials::Material;
use crate::numbers::magnitude;
use crate::words;
use carom::spec::{Key, LawSpec, parse_law};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple};

/// The key of that name.
///
/// # Errors
/// `TypeError`, as for any keyword argument that there is not, in the core's words.
pub fn key(name: &str) -> PyResult<Key> {
    match Key::by_name(name) {
        Some(key) => Ok(key),
        None => match parse_law(&format!("{} = 0", quoted(name))) {
            Err(error) => Err(words::of_keys(&error)),
            Ok(_) => Err(PyTypeError::new_err(format!("unknown key '{name}'"))),
        },
    }
}

/// A law of keyword arguments; `None` is as good as nothing.
pub fn spec(keys: Option<&Bound<'_, PyDict>>) -> PyResult<LawSpec> {
    let mut spec = LawSpec::default();
    for (name, value) in keys.into_iter().flatten() {
        let key = key(name.cast::<PyString>()?.to_str()?)?;
        if !value.is_none() {
            set(&mut spec, key, &value)?;
        }
    }
    Ok(spec)
}

/// Gives a key a value.
pub fn set(spec: &mut LawSpec, key: Key, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let text = match magnitude(value, key.name(), &powers(key.info().unit))? {
        Some(number) => text(&number, key)?,
        None => text(value, key)?,
    };
    spec.set_text(key, &text).map_err(|e| words::of_key(key, &e))
}

/// `J/m2` as pint writes it, `J/m**2`.
fn powers(unit: &str) -> String {
    let mut out = String::new();
    let mut letters = unit.chars().peekable();
    while let Some(letter) = letters.next() {
        out.push(letter);
        if letter.is_alphabetic() && letters.peek().is_some_and(char::is_ascii_digit) {
            out.push_str("**");
        }
    }
    out
}

/// A value as it stands in a law's text.
fn text(value: &Bound<'_, PyAny>, key: Key) -> PyResult<String> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(text.to_str()?.to_owned());
    }
    inline(value, key)
}

/// Likewise, texts in quotation marks: inside of lists and tables.
fn inline(value: &Bound<'_, PyAny>, key: Key) -> PyResult<String> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(quoted(text.to_str()?));
    }
    if let Ok(float) = value.cast::<PyFloat>() {
        return Ok(number(float.value()));
    }
    let unfit = || {
        let found = value.get_type().name().map_or_else(|_| "an object".to_owned(), |n| n.to_string());
        PyTypeError::new_err(format!(
            "{key}: a {found}; a number, a text with a unit, a list or a dict is wanted, such as {key}={}",
            carom::error::Wording::value(&words::Python, key.info().example)
        ))
    };
    if value.is_instance_of::<PyBool>() {
        return Err(unfit());
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(number(value.extract::<f64>()?));
    }
    if let Ok(material) = value.cast::<Material>() {
        return Ok(material.get().inline());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let items = value.try_iter()?.map(|item| inline(&item?, key)).collect::<PyResult<Vec<_>>>()?;
        return Ok(format!("[{}]", items.join(", ")));
    }
    if let Ok(mapping) = value.cast::<PyMapping>() {
        let mut entries = Vec::new();
        for item in mapping.items()?.iter() {
            let (name, value): (String, Bound<'_, PyAny>) = item.extract().map_err(|_| unfit())?;
            entries.push(format!("{} = {}", quoted(&name), inline(&value, key)?));
        }
        return Ok(format!("{{ {} }}", entries.join(", ")));
    }
    // NumPy's scalars are numbers, its arrays are lists
    if value.hasattr("tolist")? {
        let plain = value.call_method0("tolist")?;
        if !plain.hasattr("tolist")? {
            return inline(&plain, key);
        }
    }
    match value.extract::<f64>() {
        Ok(float) => Ok(number(float)),
        Err(_) => Err(unfit()),
    }
}

/// A number whose text gives the same bits again.
fn number(value: f64) -> String {
    if value.is_nan() { "nan".to_owned() } else { format!("{value:?}") }
}

/// A text as TOML has it.
pub fn quoted(text: &str) -> String {
    let mut out = String::from('"');
    for letter in text.chars() {
        match letter {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            c if c.is_control() => out.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
