//! What one impact came to.

use crate::law::Law;
use crate::materials::html;
use crate::met::{self, Met};
use crate::spheres::Spheres;
use carom::plane;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::Arc;

/// What one impact came to. Printed, it says what ``carom impact`` says.
///
/// Attributes
/// ----------
/// fate : str
///     ``"rebound"`` or ``"capture"``; what is no impact says why: ``"not-approaching"``, ``"friction-not-given"``, ...
/// captured : bool
///     Whether it sticks.
/// normal, tangential : float
///     Speeds after the impact, m/s.
/// spin : float
///     rad/s.
/// speed, angle : float
///     Speed after, m/s, and angle from the surface, degrees (beyond 90 when it goes back; NaN for a capture).
/// restitution : float
///     0 for a capture.
/// impulse_ratio, tangential_restitution : float
///     NaN for a capture.
/// contact : str
///     How the contact ended: ``"sliding"``, ``"rolling"``, ``"micro-slip"`` or ``"none"``.
/// energy : dict of str to float
///     Shares of the incident kinetic energy, translation plus spin; they sum to 1.
/// validity : tuple of str
///     What to mind: the codes of :data:`carom.VALIDITY`.
#[pyclass(frozen, module = "carom")]
pub struct Outcome {
    pub law: Arc<Law>,
    pub one: Spheres<f64>,
    pub met: Met,
}

#[pymethods]
impl Outcome {
    #[getter]
    fn fate(&self) -> &'static str {
        met::fate(&self.met)
    }
    #[getter]
    fn captured(&self) -> bool {
        self.met.as_ref().is_ok_and(|o| o.fate == carom::Fate::Capture)
    }
    #[getter]
    fn normal(&self) -> f64 {
        met::row(&self.met)[0]
    }
    #[getter]
    fn tangential(&self) -> f64 {
        met::row(&self.met)[1]
    }
    #[getter]
    fn spin(&self) -> f64 {
        met::row(&self.met)[2]
    }
    #[getter]
    fn restitution(&self) -> f64 {
        met::row(&self.met)[3]
    }
    #[getter]
    fn impulse_ratio(&self) -> f64 {
        met::row(&self.met)[4]
    }
    #[getter]
    fn tangential_restitution(&self) -> f64 {
        met::tangential_restitution(&self.met)
    }
    #[getter]
    fn contact(&self) -> &'static str {
        met::contact(&self.met).name()
    }
    #[getter]
    fn speed(&self) -> f64 {
        self.met.as_ref().map_or(f64::NAN, |o| plane::Met::from(*o).speed())
    }
    #[getter]
    fn angle(&self) -> f64 {
        self.met.as_ref().map_or(f64::NAN, |o| plane::Met::from(*o).angle())
    }
    #[getter]
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let energy = PyDict::new(py);
        for (name, share) in met::energy(&self.met) {
            energy.set_item(name, share)?;
        }
        Ok(energy)
    }
    #[getter]
    fn validity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let codes: Vec<&str> = self.met.as_ref().map_or_else(|_| Vec::new(), |o| o.validity.codes().collect());
        PyTuple::new(py, codes)
    }

    /// All figures by name, the energy's shares among them.
    ///
    /// Returns
    /// -------
    /// dict
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        all.set_item("fate", self.fate())?;
        for (name, value) in met::COLUMNS.into_iter().zip(met::row(&self.met)) {
            all.set_item(name, value)?;
        }
        all.set_item("tangential_restitution", self.tangential_restitution())?;
        all.set_item("contact", self.contact())?;
        for (name, share) in met::energy(&self.met) {
            all.set_item(name, share)?;
        }
        all.set_item("validity", self.validity(py)?)?;
        Ok(all)
    }

    /// As the command prints it.
    fn __repr__(&self) -> String {
        let plain = self.one.density.is_none() && self.one.draws.is_none_or(|d| d == [0.5; 4]);
        if self.met.is_ok() && plain {
            let (speed, angle) = self.one.speed_and_angle();
            let motion = [speed, angle, self.one.spin];
            if let Ok(text) = carom_cli::told(&self.law.spec, &self.law.wall, self.one.diameter, motion) {
                return text.trim_end().to_owned();
            }
        }
        let [normal, tangential, spin, restitution, _] = met::row(&self.met);
        format!(
            "<carom.Outcome: {}, restitution {restitution:?}, normal {normal:?} m/s, tangential {tangential:?} m/s, spin {spin:?} rad/s>",
            self.fate()
        )
    }

    fn _repr_html_(&self) -> String {
        format!("<pre>{}</pre>", html(&self.__repr__()))
    }
}
