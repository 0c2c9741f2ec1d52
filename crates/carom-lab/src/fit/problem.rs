//! The problem: a law with free parameters against measured points, as residuals.

use super::data::{Data, Measurement};
use super::parameter::Parameter;
use crate::compare::meet;
use crate::error::LabError;
use crate::experiment::Quantity;
use carom::material::{Library, MaterialRef};
use carom::spec::LawSpec;
use carom::{LawError, WallLaw, error::ErrorKind, spec::Key};
use nalgebra::DMatrix;
use std::ops::RangeInclusive;

/// A parameter that is to be found.
#[derive(Clone, Debug, PartialEq)]
pub struct Free {
    /// Which.
    pub parameter: Key,
    /// Where it may lie.
    pub bounds: RangeInclusive<f64>,
}

impl Free {
    /// A parameter within its natural bounds.
    pub fn new(parameter: Key) -> Self {
        Self { parameter, bounds: parameter.natural_bounds() }
    }
}

/// One measured number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Observation {
    pub point: Measurement,
    pub quantity: Quantity,
    pub value: f64,
    /// Its standard uncertainty, 1 where none is known.
    pub sigma: f64,
}

/// What residuals are differences of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// Restitution: what is fitted. Flat where the law captures.
    Restitution,
    /// e² before it is cut at zero, scaled to the same size near the data: no flat parts, and linear in C_A, C_H and C_R of `ea`.
    /// A way to a start.
    Energy,
}

pub(super) struct Problem<'a> {
    pub law: &'a LawSpec,
    /// The same without the texts of its materials, quick to copy.
    bare: LawSpec,
    pub library: &'a Library,
    pub free: Vec<Free>,
    pub starts: Vec<f64>,
    pub scales: Vec<f64>,
    pub observations: Vec<Observation>,
    pub has_sigma: bool,
}

impl<'a> Problem<'a> {
    pub fn new(law: &'a LawSpec, free: &[Free], data: &Data, library: &'a Library) -> Result<Self, LabError> {
        let has_sigma = data.has_sigma();
        let mut observations = Vec::new();
        for point in &data.points {
            let sigma = if has_sigma { point.sigma.unwrap_or(1.0) } else { 1.0 };
            let values = [
                (Quantity::Restitution, point.restitution),
                (Quantity::TangentialRestitution, point.tangential_restitution),
            ];
            for (quantity, value) in values {
                observations.extend(value.map(|value| Observation { point: *point, quantity, value, sigma }));
            }
        }
        let inside = |f: &Free| f.parameter.start(law, library).clamp(*f.bounds.start(), *f.bounds.end());
        let starts: Vec<f64> = free.iter().map(inside).collect();
        let scales = free.iter().zip(&starts).map(|(f, s)| super::parameter::scale(f.parameter, *s)).collect();
        let bare = bare(law, library).map_err(LabError::Fit)?;
        let problem = Self { law, bare, library, free: free.to_vec(), starts, scales, observations, has_sigma };
        problem.check(data)?;
        Ok(problem)
    }

    /// Refuses what cannot be found from these data.
    fn check(&self, data: &Data) -> Result<(), LabError> {
        let refuse = |message: String, help: String| Err(LabError::Fit(LawError::new(message).help(help)));
        if self.law.scatters() {
            let message = "the law scatters (roughness_angle), and a fit needs one answer to each impact".to_owned();
            return refuse(message, "fit the smooth wall: roughness_angle = 0".to_owned());
        }
        let tangential = data.points.iter().any(|p| p.tangential_restitution.is_some());
        for (n, free) in self.free.iter().enumerate() {
            let name = free.parameter;
            if name.info().search.is_none() {
                return refuse(format!("{name} is not fitted"), format!("known are {}", names()));
            }
            if self.free[..n].iter().any(|f| f.parameter == free.parameter) {
                return refuse(format!("{name} is free twice"), "name it once".into());
            }
            if name == Key::Friction && !tangential {
                return refuse(
                    "friction does not act on the normal restitution".into(),
                    "add a column tangential_restitution (and angle), or leave friction out".into(),
                );
            }
            let with_starts = self.law_at(&self.starts);
            let acts = match name.acts(&with_starts, self.library) {
                Err(e) if e.kind() == ErrorKind::IdleKey && e.key() == Some(name.name()) => false,
                other => other.map_err(LabError::Fit)?,
            };
            if !acts {
                return refuse(format!("{name} changes nothing in this law"), super::parameter::readers(name));
            }
        }
        let (wanted, got) = (self.free.len() + 1, self.observations.len());
        if got < wanted {
            return refuse(
                format!("{got} measured values for {} free parameters", self.free.len()),
                format!("at least {wanted} are needed, several times as many are better; or free fewer"),
            );
        }
        if self.observations.iter().all(|o| o.quantity == Quantity::Restitution && o.value <= 0.0) {
            let fastest = data.points.iter().map(Measurement::normal_speed).fold(0.0, f64::max);
            return refuse(
                format!("every sphere stayed: the data say only that the capture velocity is above {fastest} m/s"),
                "add points that rebound".into(),
            );
        }
        Ok(())
    }

    /// The law with its free parameters at `values`.
    pub fn law_at(&self, values: &[f64]) -> LawSpec {
        self.with(self.law, values)
    }

    fn with(&self, law: &LawSpec, values: &[f64]) -> LawSpec {
        let mut law = law.clone();
        for (free, value) in self.free.iter().zip(values) {
            free.parameter.set(&mut law, *value);
        }
        law
    }

    fn wall(&self, values: &[f64]) -> Result<WallLaw, LabError> {
        self.with(&self.bare, values).compile(self.library).map_err(LabError::Fit)
    }

    /// The same problem with other observations.
    pub fn observing(&self, observations: Vec<Observation>) -> Self {
        let (free, starts, scales) = (self.free.clone(), self.starts.clone(), self.scales.clone());
        Self { observations, free, starts, scales, bare: self.bare.clone(), ..*self }
    }

    /// What the law gives at each observation; 0 where it captures.
    pub fn model(&self, values: &[f64]) -> Result<Vec<f64>, LabError> {
        let wall = self.wall(values)?;
        self.observations.iter().map(|o| given(&wall, o)).collect()
    }

    /// (measured − model)/σ at each observation, of `measured` values.
    pub fn residuals(&self, form: Form, measured: &[f64], values: &[f64]) -> Result<Vec<f64>, LabError> {
        let wall = self.wall(values)?;
        let pairs = self.observations.iter().zip(measured);
        pairs
            .map(|(o, m)| {
                if form == Form::Restitution || o.quantity != Quantity::Restitution {
                    return Ok((m - given(&wall, o)?) / o.sigma);
                }
                let left = wall.energy_left(o.point.normal_speed(), o.point.diameter).map_err(|e| refused(o, e))?;
                let slope = 2.0 * m.max(0.2) * o.sigma;
                // a sphere that stayed asks for nothing but that nothing be left
                Ok(if *m > 0.0 { (m * m - left) / slope } else { (-left).min(0.0) / slope })
            })
            .collect()
    }

    /// Derivatives of the residuals by the parameters of `columns`, by central differences within the bounds.
    pub fn jacobian(
        &self,
        form: Form,
        measured: &[f64],
        values: &[f64],
        columns: &[usize],
    ) -> Result<DMatrix<f64>, LabError> {
        let mut matrix = DMatrix::zeros(self.observations.len(), columns.len());
        let mut at = values.to_vec();
        for (column, &n) in columns.iter().enumerate() {
            let (value, step) = (values[n], 1e-5 * values[n].abs().max(0.1 * self.scales[n]));
            let ends = [self.inside(n, value - step), self.inside(n, value + step)];
            let [low, high] = ends.map(|end| {
                at[n] = end;
                self.residuals(form, measured, &at)
            });
            at[n] = value;
            let width = ends[1] - ends[0];
            if width > 0.0 {
                let slopes = high?.iter().zip(low?).map(|(h, l)| (h - l) / width).collect::<Vec<_>>();
                matrix.column_mut(column).copy_from_slice(&slopes);
            }
        }
        Ok(matrix)
    }

    /// A value of parameter `n`, brought within its bounds.
    pub fn inside(&self, n: usize, value: f64) -> f64 {
        value.clamp(*self.free[n].bounds.start(), *self.free[n].bounds.end())
    }

    /// The measured values.
    pub fn measured(&self) -> Vec<f64> {
        self.observations.iter().map(|o| o.value).collect()
    }
}

/// The law with its materials looked up and reduced to numbers.
fn bare(law: &LawSpec, library: &Library) -> Result<LawSpec, LawError> {
    let mut law = law.clone();
    for body in [&mut law.sphere, &mut law.surface].into_iter().flatten() {
        let mut material = body.value.resolve(library).map_err(|e| e.at(body.span.clone()))?;
        (material.description, material.note) = (String::new(), None);
        (material.aliases, material.properties) = (Vec::new(), Vec::new());
        body.value = MaterialRef::Inline(Box::new(material));
    }
    Ok(law)
}

fn given(wall: &WallLaw, o: &Observation) -> Result<f64, LabError> {
    let p = &o.point;
    let value = meet(wall, o.quantity, p.speed, p.angle_deg, p.diameter).map_err(|e| refused(o, e))?;
    // a captured sphere takes the wall's velocity along it, too
    Ok(if value.is_nan() { 0.0 } else { value })
}

fn refused(o: &Observation, error: carom::ImpactError) -> LabError {
    LabError::Fit(LawError::new(format!("line {}: {error}", o.point.line)))
}

fn names() -> String {
    super::parameter::parameters().map(Key::name).collect::<Vec<_>>().join(", ")
}
