//! Figures of a law: capture velocity, yield velocity, critical angle, adhesion numbers.

use crate::columns::{CHUNK, Held, empty, over, shape, threads, written};
use crate::numbers::{Input, What, one};
use crate::outcomes::place;
use crate::words;
use carom::{ImpactError, WallLaw, Window};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Mutex, PoisonError};

type Any<'py> = Bound<'py, PyAny>;

/// A number of each row of up to three inputs.
fn each<'py, const N: usize>(
    py: Python<'py>,
    inputs: [(&'static str, Input); N],
    of: impl Fn([f64; N]) -> Result<f64, ImpactError> + Sync,
) -> PyResult<Any<'py>> {
    let named: Vec<(&str, &Input)> = inputs.iter().map(|(n, i)| (*n, i)).collect();
    let Some(shape) = shape(py, &named)? else {
        let row = std::array::from_fn(|i| inputs[i].1.one().unwrap_or(f64::NAN));
        let number = of(row).map_err(|e| words::of_impact(e, ""))?;
        return Ok(number.into_pyobject(py)?.into_any());
    };
    let held = inputs.iter().map(|(_, input)| Held::of(py, input)).collect::<PyResult<Vec<_>>>()?;
    let columns: Vec<_> = held.iter().map(|h| h.column(&shape)).collect();
    let out = empty(py, &shape)?;
    let bad: Mutex<Option<(usize, ImpactError)>> = Mutex::new(None);
    {
        let mut guard = written(&out)?;
        let slice = guard.as_slice_mut()?;
        let threads = threads(None, slice.len(), 1000);
        py.detach(|| {
            over(threads, slice.chunks_mut(CHUNK).enumerate(), |(number, out)| {
                for (place, value) in out.iter_mut().enumerate() {
                    let row = number * CHUNK + place;
                    *value = of(std::array::from_fn(|i| columns[i].row(row))).unwrap_or_else(|error| {
                        let mut bad = bad.lock().unwrap_or_else(PoisonError::into_inner);
                        if bad.is_none_or(|(other, _)| row < other) {
                            *bad = Some((row, error));
                        }
                        f64::NAN
                    });
                }
            });
        });
    }
    match bad.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some((row, error)) => Err(words::of_impact(error, &place(&shape, row))),
        None => Ok(out.into_any()),
    }
}

/// The density, NaN for the law's own.
fn density(value: Option<&Any<'_>>) -> PyResult<Input> {
    Input::or(value, f64::NAN, "density", What::Density)
}

fn given(density: f64) -> Option<f64> {
    if density.is_nan() { None } else { Some(density) }
}

/// An end of the window of rebound.
pub fn window<'py>(
    py: Python<'py>,
    law: &WallLaw,
    diameter: &Any<'py>,
    rho: Option<&Any<'py>>,
    end: impl Fn(Option<Window>) -> f64 + Sync,
) -> PyResult<Any<'py>> {
    let inputs = [("diameter", Input::of(diameter, "diameter", What::Diameter)?), ("density", density(rho)?)];
    each(py, inputs, |[d, rho]| law.window(d, given(rho)).map(&end))
}

/// Yield velocity; NaN for a law without a plastic loss.
pub fn yielding<'py>(
    py: Python<'py>,
    law: &WallLaw,
    diameter: &Any<'py>,
    rho: Option<&Any<'py>>,
) -> PyResult<Any<'py>> {
    let inputs = [("diameter", Input::of(diameter, "diameter", What::Diameter)?), ("density", density(rho)?)];
    each(py, inputs, |[d, rho]| Ok(law.yield_velocity(d, given(rho))?.unwrap_or(f64::NAN)))
}

/// Critical angle, degrees; NaN for a law without friction.
pub fn critical<'py>(
    py: Python<'py>,
    law: &WallLaw,
    diameter: &Any<'py>,
    speed: &Any<'py>,
    rho: Option<&Any<'py>>,
) -> PyResult<Any<'py>> {
    let inputs = [
        ("diameter", Input::of(diameter, "diameter", What::Diameter)?),
        ("speed", Input::of(speed, "speed", What::Speed)?),
        ("density", density(rho)?),
    ];
    each(py, inputs, |[d, v, rho]| Ok(law.critical_angle(d, given(rho), v)?.map_or(f64::NAN, f64::to_degrees)))
}

/// Tabor's parameter and its like; `None` without adhesion.
pub fn adhesion<'py>(py: Python<'py>, law: &WallLaw, diameter: &Any<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
    let diameter = one(diameter, "diameter", What::Diameter)?;
    let Some(numbers) = law.adhesion_numbers(diameter).map_err(|e| words::of_impact(e, ""))? else { return Ok(None) };
    let all = PyDict::new(py);
    all.set_item("tabor", numbers.tabor)?;
    all.set_item("regime", numbers.regime.name())?;
    all.set_item("adhesion_parameter", numbers.adhesion_parameter)?;
    all.set_item("equilibrium_spacing", numbers.spacing)?;
    Ok(Some(all))
}

/// The materials' contact constants, SI units.
pub fn pair<'py>(py: Python<'py>, law: &WallLaw) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(pair) = law.pair() else { return Ok(None) };
    let all = PyDict::new(py);
    all.set_item("sphere", &pair.sphere().name)?;
    all.set_item("surface", &pair.surface().name)?;
    all.set_item("density", pair.density().ok())?;
    all.set_item("stiffness", pair.stiffness().ok())?;
    all.set_item("work_of_adhesion", pair.work_of_adhesion().ok())?;
    all.set_item("plastic_constant", pair.plastic_constant().ok())?;
    Ok(Some(all))
}
