//! Impacts on a law: one, or a row for each element of arrays.

use crate::columns::{self, place, shape};
use crate::law::WallLaw;
use crate::numbers::{Input, What, numpy, whole};
use crate::outcome::Outcome;
use crate::outcomes::{More, Outcomes};
use crate::spheres::Spheres;
use crate::words;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::sync::Arc;

#[pymethods]
impl WallLaw {
    /// One impact, or one for each element of arrays.
    ///
    /// Parameters
    /// ----------
    /// diameter : number, str or array_like
    ///     Diameter of the sphere, m.
    /// speed, angle : number, str or array_like
    ///     Speed, m/s, and angle of incidence, degrees from the surface (90, head-on, by default).
    /// normal, tangential : number, str or array_like
    ///     In their place: speeds normal to the wall and along it, m/s.
    /// spin : number, str or array_like
    ///     Spin, rad/s; positive rolls forward along the tangential velocity.
    /// density : number, str or array_like, optional
    ///     Density of the sphere, kg/m3, in place of the law's own.
    /// draws : array_like, optional
    ///     For walls that scatter: four uniform numbers in [0, 1) for each impact, along the last axis; all 1/2 by default.
    /// errors : {"raise", "nan"}, optional
    ///     What becomes of impacts that are none: an error, or NaN with a fate that says why. By default one impact raises, rows of arrays
    ///     are NaN.
    /// threads : int, optional
    ///     For arrays; by default, or with 0, as many as the machine has where that is worth it. The bits do not depend on it.
    ///
    /// Returns
    /// -------
    /// Outcome or Outcomes
    ///     :class:`Outcomes`, whose arrays have the broadcast shape, where any input is an array of one dimension or more.
    ///
    /// Raises
    /// ------
    /// ValueError, TypeError
    ///     A unit that does not fit, shapes that do not broadcast, an array that is not of numbers; with ``errors="raise"`` the first row that
    ///     is no impact.
    ///
    /// Notes
    /// -----
    /// Contiguous arrays of float64 are read where they are, without a copy. Scalars and rows have the same bits, which are also those of
    /// ``carom impact`` and of the Rust library.
    ///
    /// References
    /// ----------
    /// Kim, O. V. and Dunn, P. F., 2007. J. Aerosol Sci. 38, 532-549, doi:10.1016/j.jaerosci.2007.03.006, for ``ea`` and ``eap``; the others in
    /// docs/which-law.md.
    #[pyo3(signature = (diameter, speed=None, angle=None, spin=None, *, normal=None, tangential=None, density=None, draws=None,
                        errors=None, threads=None))]
    #[expect(clippy::too_many_arguments, reason = "the keyword arguments of the contract")]
    fn impact<'py>(
        &self,
        py: Python<'py>,
        diameter: &Bound<'py, PyAny>,
        speed: Option<&Bound<'py, PyAny>>,
        angle: Option<&Bound<'py, PyAny>>,
        spin: Option<&Bound<'py, PyAny>>,
        normal: Option<&Bound<'py, PyAny>>,
        tangential: Option<&Bound<'py, PyAny>>,
        density: Option<&Bound<'py, PyAny>>,
        draws: Option<&Bound<'py, PyAny>>,
        errors: Option<&str>,
        #[pyo3(from_py_with = whole)] threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let raises = match errors {
            None => None,
            Some("raise") => Some(true),
            Some("nan") => Some(false),
            Some(other) => return Err(PyValueError::new_err(format!("errors='{other}'; 'raise' or 'nan' is wanted"))),
        };
        let (motion, by_angle) = match (speed, normal) {
            (Some(speed), None) if tangential.is_none() => {
                ([Input::of(speed, "speed", What::Speed)?, Input::or(angle, 90.0, "angle", What::Angle)?], true)
            }
            (None, Some(normal)) if angle.is_none() => (
                [Input::of(normal, "normal", What::Speed)?, Input::or(tangential, 0.0, "tangential", What::Speed)?],
                false,
            ),
            _ => {
                return Err(PyTypeError::new_err(
                    "impact() takes speed= with or without angle=, or normal= with or without tangential=",
                ));
            }
        };
        let rows = Spheres {
            diameter: Input::of(diameter, "diameter", What::Diameter)?,
            motion,
            by_angle,
            spin: Input::or(spin, 0.0, "spin", What::Spin)?,
            density: density.map(|d| Input::of(d, "density", What::Density)).transpose()?,
            draws: draws.map(four).transpose()?,
        };
        if let Some(one) = rows.one() {
            let met = self.0.wall.impact(&one.impact());
            if let (Err(error), true) = (&met, raises.unwrap_or(true)) {
                return Err(words::of_impact(*error, ""));
            }
            return Ok(Bound::new(py, Outcome { law: Arc::clone(&self.0), one, met })?.into_any());
        }
        let shape = shape(py, &rows.named())?.unwrap_or_default();
        let threads = threads.filter(|n| *n > 0);
        let workers = columns::threads(threads, shape.iter().product(), rows.cost(&self.0.wall));
        let (answer, first) = rows.answer(py, &self.0.wall, &shape, workers)?;
        if let (Some((row, error)), true) = (first, raises.unwrap_or(false)) {
            return Err(words::of_impact(error, &place(&shape, row)));
        }
        let answer = answer.map(Bound::unbind);
        let outcomes = Outcomes { law: Arc::clone(&self.0), rows, shape, threads, answer, more: More::none() };
        Ok(Bound::new(py, outcomes)?.into_any())
    }
}

/// Draws for walls that scatter: four along the last axis.
fn four(draws: &Bound<'_, PyAny>) -> PyResult<[Input; 4]> {
    let wrong = || PyValueError::new_err("draws: four numbers in [0, 1) for each impact, along the last axis");
    let array = numpy(draws.py())?.call_method1("asarray", (draws,))?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    if shape.last() != Some(&4) {
        return Err(wrong());
    }
    let ellipsis = draws.py().Ellipsis();
    let of = |place: usize| Input::of(&array.get_item((ellipsis.clone_ref(draws.py()), place))?, "draws", What::Draws);
    Ok([of(0)?, of(1)?, of(2)?, of(3)?])
}
