//! Sticking probability where values are distributions or the wall scatters.

use crate::columns::{Held, shape};
use crate::law::WallLaw;
use crate::numbers::{Input, What, numpy, whole};
use crate::spheres::Spheres;
use crate::{keys, words};
use carom::ImpactError;
use carom::plane::Met;
use carom::spec::{Key, LawSpec};
use carom::study::{Band, Distribution, Sampling, Share, read_distribution, sampled};
use numpy::PyArray1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use std::borrow::Cow;

/// Most samples times points: their values are sorted in memory.
const MOST: usize = 5_000_000;

/// A diameter's ends, m: those of an impact.
const DIAMETERS: (f64, f64) = (1e-10, 1.0);

/// What is drawn.
struct Drawn {
    diameter: Option<Distribution>,
    keys: Vec<(Key, Distribution)>,
}

enum Failed {
    Law(carom::LawError),
    Impact(ImpactError),
}

/// Probability of sticking where values are uncertain or the wall scatters.
///
/// Parameters
/// ----------
/// law : WallLaw
///     The wall, at the medians.
/// diameter : number, str or array_like
///     m; or a distribution: ``"lognormal(50um, 1.3)"``, ``"normal(50um, 5um)"``, ``"uniform(10um, 20um)"``.
/// speed : number, str or array_like
///     m/s.
/// angle : number, str or array_like, optional
///     Degrees from the surface; 90 by default.
/// spin : number, str or array_like, optional
///     rad/s.
/// samples : int
///     At every point the same draws (common random numbers).
/// seed : int
///     Of the draws.
/// **keys
///     Numbers of the law that are distributions: ``roughness_factor="normal(0.8, 0.05)"``. They are cut to what the number can be.
///
/// Returns
/// -------
/// dict of str to float or numpy.ndarray
///     ``sticking_probability`` with Wilson's 95 % interval ``sticking_low``, ``sticking_high``; median, 5 % and 95 % of ``restitution``,
///     ``rebound_speed`` (m/s), ``impulse_ratio``, ``tangential_restitution``, ``angle_out_deg``, as ``NAME_median``, ``NAME_p05``, ``NAME_p95``.
///     The bits are those of ``carom sweep --samples``.
///
/// Raises
/// ------
/// ValueError, TypeError
///     A distribution that cannot be read, a sample that is no law or no impact.
///
/// References
/// ----------
/// Wilson, E. B., 1927. J. Am. Stat. Assoc. 22, 209-212, doi:10.2307/2276774.
#[pyfunction]
#[pyo3(signature = (law, diameter, speed, angle=None, spin=None, *, samples=1000, seed=1, **keys))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub fn sticking<'py>(
    py: Python<'py>,
    law: &Bound<'py, WallLaw>,
    diameter: &Bound<'py, PyAny>,
    speed: &Bound<'py, PyAny>,
    angle: Option<&Bound<'py, PyAny>>,
    spin: Option<&Bound<'py, PyAny>>,
    #[pyo3(from_py_with = whole)] samples: u32,
    #[pyo3(from_py_with = whole)] seed: u64,
    keys: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let law = &law.get().0;
    let drawn = Drawn { diameter: diameters(diameter)?, keys: distributions(keys)? };
    let scatters = law.wall.scatter().is_some();
    if drawn.diameter.is_none() && drawn.keys.is_empty() && !scatters {
        return Err(PyValueError::new_err(
            "nothing is drawn here: make a value a distribution, such as diameter='lognormal(50um, 1.3)' or \
             roughness_factor='normal(0.8, 0.05)', or the wall scatter with roughness_angle",
        ));
    }
    if samples < 2 {
        return Err(PyValueError::new_err(format!("samples={samples}; 2 or more are wanted")));
    }
    let of_diameter =
        if drawn.diameter.is_some() { Input::One(f64::NAN) } else { Input::of(diameter, "diameter", What::Diameter)? };
    let inputs = [
        ("diameter", of_diameter),
        ("speed", Input::of(speed, "speed", What::Speed)?),
        ("angle", Input::or(angle, 90.0, "angle", What::Angle)?),
        ("spin", Input::or(spin, 0.0, "spin", What::Spin)?),
    ];
    let named: Vec<(&str, &Input)> = inputs.iter().map(|(n, i)| (*n, i)).collect();
    let shape = shape(py, &named)?.unwrap_or_default();
    let points: usize = shape.iter().product();
    if points.saturating_mul(samples as usize) > MOST {
        let message =
            format!("{samples} samples of {points} points are too many; samples times points may be {MOST} at most");
        return Err(PyValueError::new_err(message));
    }
    let held = inputs.iter().map(|(_, input)| Held::of(py, input)).collect::<PyResult<Vec<_>>>()?;
    let columns: Vec<_> = held.iter().map(|h| h.column(&shape)).collect();
    let rows: Vec<[f64; 4]> = (0..points).map(|row| std::array::from_fn(|i| columns[i].row(row))).collect();
    let sampling = Sampling { samples, seed };
    let study = py.detach(|| {
        sampled(
            &sampling,
            points,
            |sample| {
                if drawn.keys.is_empty() {
                    return Ok(Cow::Borrowed(&law.wall));
                }
                let mut spec = law.spec.clone();
                for (key, distribution) in &drawn.keys {
                    // a key's number stays its own: to add a distribution changes no other
                    spec.make_room(*key);
                    spec.set_number(*key, distribution.quantile(sampling.draw(sample, key.info().draw.unwrap_or(0))));
                }
                spec.compile(&law.materials.library).map(Cow::Owned).map_err(Failed::Law)
            },
            |wall, sample, point| {
                let [own, speed, angle, spin] = rows[point];
                let diameter = drawn.diameter.as_ref().map_or(own, |d| d.quantile(sampling.draw(sample, 0)));
                let draws = scatters.then(|| sampling.impact(sample));
                let one = Spheres { diameter, motion: [speed, angle], by_angle: true, spin, density: None, draws };
                let out = wall.impact(&one.impact()).map_err(Failed::Impact)?;
                let met = Met::from(out);
                let figures =
                    [out.restitution, met.speed(), out.impulse_ratio, out.tangential_restitution, met.angle()];
                Ok((!met.rebounds(), figures))
            },
        )
    });
    let study = study.map_err(|failed| match failed {
        Failed::Law(error) => words::of_keys(&error),
        Failed::Impact(error) => words::of_impact(error, "a sample"),
    })?;
    let all = PyDict::new(py);
    let put = |name: String, values: Vec<f64>| -> PyResult<()> {
        let array = PyArray1::from_vec(py, values);
        let array = if shape.is_empty() { array.get_item(0)? } else { array.call_method1("reshape", (&shape,))? };
        all.set_item(name, array)
    };
    let _ = numpy(py)?;
    let shares = |of: fn(&Share) -> f64| study.sticking.iter().map(of).collect::<Vec<f64>>();
    put("sticking_probability".to_owned(), shares(|s| s.value))?;
    put("sticking_low".to_owned(), shares(|s| s.low))?;
    put("sticking_high".to_owned(), shares(|s| s.high))?;
    let names = ["restitution", "rebound_speed", "impulse_ratio", "tangential_restitution", "angle_out_deg"];
    for (name, bands) in names.into_iter().zip(&study.bands) {
        let column = |end: &str, of: fn(&Band) -> f64| put(format!("{name}_{end}"), bands.iter().map(of).collect());
        column("median", |b| b.median)?;
        column("p05", |b| b.low)?;
        column("p95", |b| b.high)?;
    }
    Ok(all)
}

/// A distribution of diameters, if it is one.
fn diameters(value: &Bound<'_, PyAny>) -> PyResult<Option<Distribution>> {
    let Ok(text) = value.cast::<PyString>() else { return Ok(None) };
    let text = text.to_str()?;
    if !text.contains('(') {
        return Ok(None);
    }
    let part = |text: &str| What::Diameter.parse(text).map_err(|e| (0, e));
    read_distribution(text, &part, DIAMETERS).map(Some).map_err(|e| PyValueError::new_err(format!("diameter: {e}")))
}

/// The law's numbers that are distributions.
fn distributions(keys: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<(Key, Distribution)>> {
    let mut all = Vec::new();
    for (name, value) in keys.into_iter().flatten() {
        let key = keys::key(name.cast::<PyString>()?.to_str()?)?;
        let wrong = || {
            PyTypeError::new_err(format!(
                "{key}: a distribution is wanted, such as {key}='normal(0.8, 0.05)'; a value of the law is given to the law"
            ))
        };
        let text = value.cast::<PyString>().map_err(|_| wrong())?.to_str()?.to_owned();
        if key.info().draw.is_none() {
            return Err(PyValueError::new_err(format!("{key} cannot be a distribution")));
        }
        if !text.contains('(') {
            return Err(wrong());
        }
        let number = |part: &str| {
            let mut law = LawSpec::default();
            match law.set_text(key, part) {
                Ok(()) => Ok(law.number(key).unwrap_or(f64::NAN)),
                Err(e) => Err(e.unit_error().map_or((0, e.message()), |u| (u.at, u.message.clone()))),
            }
        };
        let read = read_distribution(&text, &number, key.ends());
        all.push((key, read.map_err(|e| PyValueError::new_err(format!("{key}: {e}")))?));
    }
    Ok(all)
}
