//! What a run was of: enough to tell and draw its results without the case.

use crate::case::Case;
use crate::geometry::Shape;
use crate::outline::outline;
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
    /// Walls that are round.
    #[serde(default)]
    pub cylinders: Vec<AboutCylinder>,
    /// Walls of triangles and boxes, as they are seen along z.
    #[serde(default)]
    pub outlines: Vec<AboutOutline>,
    /// Edges of the size bins that were asked for, m.
    pub size_bins: Vec<f64>,
    /// How many particles' paths are recorded: of each injection the first few.
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

/// A wall that is a cylinder without end.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AboutCylinder {
    /// The wall's name.
    pub name: String,
    /// A point of its axis, m.
    pub point: Vec3,
    /// Unit direction of the axis.
    pub axis: Vec3,
    /// Radius, m.
    pub radius: f64,
}

/// Lines that show a wall as it is seen along z.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AboutOutline {
    /// The wall's name.
    pub name: String,
    /// x and y of both ends of each, m.
    pub lines: Vec<[[f64; 2]; 2]>,
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
        let cylinders = case.domain.walls().iter().filter_map(|wall| match &wall.shape {
            Shape::Cylinder(c) => {
                Some(AboutCylinder { name: wall.name.clone(), point: c.point, axis: c.axis, radius: c.radius })
            }
            _ => None,
        });
        let trajectories = case.recorded().map(|numbers| numbers.end - numbers.start).sum();
        // only pictures of paths show them, and those of many triangles take a while
        let seen = if trajectories > 0 { case.domain.walls() } else { &[] };
        let outlines = seen.iter().filter_map(|wall| {
            let lines = match &wall.shape {
                Shape::Mesh(mesh) => outline(mesh),
                Shape::Room(r) => {
                    let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|c| [0, 1].map(|i| [r.min, r.max][c[i]][i]));
                    (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect()
                }
                _ => return None,
            };
            Some(AboutOutline { name: wall.name.clone(), lines })
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
            cylinders: cylinders.collect(),
            outlines: outlines.collect(),
            size_bins: case.bins.sizes.clone(),
            trajectories,
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
