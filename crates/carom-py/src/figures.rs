//! What a law says of itself: capture velocity, yield velocity, critical angle, adhesion numbers.

use crate::columns::{CHUNK, First, Held, empty, over, place, shape, threads, written};
use crate::law::{Law, WallLaw};
use crate::numbers::{Input, What, one};
use crate::words;
use carom::{ImpactError, Window};
use pyo3::prelude::*;
use pyo3::types::PyDict;

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
    let bad = First::none();
    {
        let mut guard = written(&out)?;
        let slice = guard.as_slice_mut()?;
        let threads = threads(None, slice.len(), 1000);
        py.detach(|| {
            over(threads, slice.chunks_mut(CHUNK).enumerate(), |(number, out)| {
                for (place, value) in out.iter_mut().enumerate() {
                    let row = number * CHUNK + place;
                    *value = of(std::array::from_fn(|i| columns[i].row(row))).unwrap_or_else(|error| {
                        bad.met(row, error);
                        f64::NAN
                    });
                }
            });
        });
    }
    match bad.row() {
        Some((row, error)) => Err(words::of_impact(error, &place(&shape, row))),
        None => Ok(out.into_any()),
    }
}

/// Diameter and density; NaN for the law's own density.
fn by_size(diameter: &Any<'_>, density: Option<&Any<'_>>) -> PyResult<[(&'static str, Input); 2]> {
    Ok([
        ("diameter", Input::of(diameter, "diameter", What::Diameter)?),
        ("density", Input::or(density, f64::NAN, "density", What::Density)?),
    ])
}

fn given(density: f64) -> Option<f64> {
    if density.is_nan() { None } else { Some(density) }
}

impl Law {
    /// An end of the window of rebound.
    fn window<'py>(
        &self,
        py: Python<'py>,
        diameter: &Any<'py>,
        density: Option<&Any<'py>>,
        end: impl Fn(Option<Window>) -> f64 + Sync,
    ) -> PyResult<Any<'py>> {
        each(py, by_size(diameter, density)?, |[d, rho]| self.wall.window(d, given(rho)).map(&end))
    }
}

#[pymethods]
impl WallLaw {
    /// The speed at and below which a sphere that comes head-on sticks, m/s.
    ///
    /// Parameters
    /// ----------
    /// diameter : number, str or array_like
    ///     m.
    /// density : number, str or array_like, optional
    ///     kg/m3, in place of the law's own.
    ///
    /// Returns
    /// -------
    /// float or numpy.ndarray
    ///     0 where nothing sticks, infinity where it never rebounds.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     A diameter or density out of range.
    #[pyo3(signature = (diameter, *, density=None))]
    fn capture_velocity<'py>(
        &self,
        py: Python<'py>,
        diameter: &Bound<'py, PyAny>,
        density: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.0.window(py, diameter, density, |w| w.map_or(f64::INFINITY, |w| w.capture_velocity))
    }

    /// The speed above which losses other than adhesion leave nothing, m/s.
    ///
    /// Parameters
    /// ----------
    /// diameter : number, str or array_like
    ///     m.
    /// density : number, str or array_like, optional
    ///     kg/m3, in place of the law's own.
    ///
    /// Returns
    /// -------
    /// float or numpy.ndarray
    ///     Infinity where there is no such end.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     A diameter or density out of range.
    #[pyo3(signature = (diameter, *, density=None))]
    fn exhausted_velocity<'py>(
        &self,
        py: Python<'py>,
        diameter: &Bound<'py, PyAny>,
        density: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.0.window(py, diameter, density, |w| w.map_or(0.0, |w| w.exhausted_velocity))
    }

    /// Yield velocity of the law's own plastic loss, m/s.
    ///
    /// Parameters
    /// ----------
    /// diameter : number, str or array_like
    ///     m.
    /// density : number, str or array_like, optional
    ///     kg/m3, in place of the law's own.
    ///
    /// Returns
    /// -------
    /// float or numpy.ndarray
    ///     NaN for a law without one.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     A diameter or density out of range.
    #[pyo3(signature = (diameter, *, density=None))]
    fn yield_velocity<'py>(
        &self,
        py: Python<'py>,
        diameter: &Bound<'py, PyAny>,
        density: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let law = &self.0.wall;
        each(py, by_size(diameter, density)?, |[d, rho]| Ok(law.yield_velocity(d, given(rho))?.unwrap_or(f64::NAN)))
    }

    /// Critical angle from the surface, degrees: below it a sphere without spin slides to the end of contact.
    ///
    /// Parameters
    /// ----------
    /// diameter : number, str or array_like
    ///     m.
    /// speed : number, str or array_like
    ///     m/s.
    /// density : number, str or array_like, optional
    ///     kg/m3, in place of the law's own.
    ///
    /// Returns
    /// -------
    /// float or numpy.ndarray
    ///     NaN for a law without friction.
    #[pyo3(signature = (diameter, speed, *, density=None))]
    fn critical_angle<'py>(
        &self,
        py: Python<'py>,
        diameter: &Bound<'py, PyAny>,
        speed: &Bound<'py, PyAny>,
        density: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [diameter, density] = by_size(diameter, density)?;
        let inputs = [diameter, ("speed", Input::of(speed, "speed", What::Speed)?), density];
        let law = &self.0.wall;
        each(py, inputs, |[d, v, rho]| Ok(law.critical_angle(d, given(rho), v)?.map_or(f64::NAN, f64::to_degrees)))
    }

    /// Tabor's parameter with its regime, the adhesion parameter and the equilibrium spacing (m).
    ///
    /// Parameters
    /// ----------
    /// diameter : number or str
    ///     m.
    ///
    /// Returns
    /// -------
    /// dict or None
    ///     ``None`` without materials that have a work of adhesion.
    fn adhesion_numbers<'py>(
        &self,
        py: Python<'py>,
        diameter: &Bound<'py, PyAny>,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let diameter = one(diameter, "diameter", What::Diameter)?;
        let Some(numbers) = self.0.wall.adhesion_numbers(diameter).map_err(|e| words::of_impact(e, ""))? else {
            return Ok(None);
        };
        let all = PyDict::new(py);
        all.set_item("tabor", numbers.tabor)?;
        all.set_item("regime", numbers.regime.name())?;
        all.set_item("adhesion_parameter", numbers.adhesion_parameter)?;
        all.set_item("equilibrium_spacing", numbers.spacing)?;
        Ok(Some(all))
    }

    /// The materials' contact constants, SI units; ``None`` for a law without materials.
    #[getter]
    fn pair<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(pair) = self.0.wall.pair() else { return Ok(None) };
        let all = PyDict::new(py);
        all.set_item("sphere", &pair.sphere().name)?;
        all.set_item("surface", &pair.surface().name)?;
        all.set_item("density", pair.density().ok())?;
        all.set_item("stiffness", pair.stiffness().ok())?;
        all.set_item("work_of_adhesion", pair.work_of_adhesion().ok())?;
        all.set_item("plastic_constant", pair.plastic_constant().ok())?;
        Ok(Some(all))
    }
}
