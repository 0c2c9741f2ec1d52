//! What a run was of: enough to tell and draw its results without the case.

use crate::case::Case;
use crate::geometry::Shape;
use crate::vector::Vec3;

/// The case of a run, as its results need it.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct About {
    /// Title.
    pub title: String,
    /// The text of the case file.
    pub text: String,
    /// Walls that are planes.
    pub planes: Vec<AboutPlane>,
    /// Edges of the size bins that were asked for, m.
    pub size_bins: Vec<f64>,
    /// Particles whose paths are recorded, from number 0 on.
    pub trajectories: u64,
    /// Injections, in the order of their particles' numbers.
    pub injections: Vec<AboutInjection>,
}

/// A wall that is a plane.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AboutPlane {
    /// The wall's name.
    pub name: String,
    /// A point of it, m.
    pub point: Vec3,
    /// Its unit normal.
    pub normal: Vec3,
}

/// An injection.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AboutInjection {
    /// Its name.
    pub name: String,
    /// Its particles.
    pub count: u64,
    /// Density of its spheres, kg/m³.
    pub density: f64,
}

impl About {
    /// What a case is of.
    pub fn of(case: &Case) -> Self {
        let planes = case.domain.walls().iter().filter_map(|wall| match &wall.shape {
            Shape::Plane(p) => Some(AboutPlane { name: wall.name.clone(), point: p.point, normal: p.normal }),
            _ => None,
        });
        let injections = case.injections.iter().map(|i| AboutInjection {
            name: i.name.clone(),
            count: i.injection.count(),
            density: i.injection.plan().density,
        });
        Self {
            title: case.title.clone(),
            text: case.text.clone(),
            planes: planes.collect(),
            size_bins: case.bins.sizes.clone(),
            trajectories: case.trajectories.min(case.count()),
            injections: injections.collect(),
        }
    }

    /// The index of the injection that a particle came from.
    pub fn injection(&self, particle: u64) -> Option<usize> {
        let mut end = 0;
        self.injections.iter().position(|i| {
            end += i.count;
            particle < end
        })
    }
}
