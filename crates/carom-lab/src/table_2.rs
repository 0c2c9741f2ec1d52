//! Table 2 of Kim & Dunn (2007): stiffness K and work of adhesion w as printed against what the library's materials give, which
//! are those of Table 1 for all but quartz.

use crate::error::LabError;
use carom::LawError;
use carom::material::Library;
use carom::pair::{Overrides, Pair};
use carom::units::{Pressure, SurfaceEnergy};
use serde::{Deserialize, Serialize};

const TEXT: &str = include_str!("../data/kim-dunn-2007-pairs.toml");

#[derive(Deserialize)]
struct File {
    pair: Vec<Printed>,
}

#[derive(Deserialize)]
struct Printed {
    surface: String,
    sphere: String,
    work_of_adhesion: SurfaceEnergy,
    stiffness: Pressure,
    author: String,
    note: Option<String>,
}

/// A row of the table.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Sphere.
    pub sphere: String,
    /// Surface.
    pub surface: String,
    /// Whose experiment.
    pub author: String,
    /// K, Pa, as in the file (its note says where that is not what is printed).
    pub stiffness: f64,
    /// K from the library's materials; null where it lacks one.
    pub stiffness_computed: Option<f64>,
    /// w, J/m².
    pub work_of_adhesion: f64,
    /// w from the materials.
    pub work_of_adhesion_computed: Option<f64>,
    /// What is odd.
    pub note: String,
}

/// Recomputes the table.
///
/// # Errors
/// None in a build that passed its tests.
pub fn rows(library: &Library) -> Result<Vec<Row>, LabError> {
    let file: File = toml::from_str(TEXT).map_err(|e| LabError::Experiment {
        name: "kim-dunn-2007-pairs.toml".into(),
        text: TEXT.into(),
        error: LawError::from(e),
    })?;
    let row = |printed: Printed| {
        // quartz is in no table of the paper; the library has a material of that name from elsewhere
        let bodies = library.get(&printed.sphere).ok().zip(library.get(&printed.surface).ok());
        let pair = bodies.map(|(sphere, surface)| Pair::new(sphere, surface, &Overrides::default()));
        Row {
            stiffness_computed: pair.as_ref().and_then(|p| p.stiffness().ok()),
            work_of_adhesion_computed: pair.as_ref().and_then(|p| p.work_of_adhesion().ok()),
            sphere: printed.sphere,
            surface: printed.surface,
            author: printed.author,
            stiffness: printed.stiffness.0,
            work_of_adhesion: printed.work_of_adhesion.0,
            note: printed.note.unwrap_or_default(),
        }
    };
    Ok(file.pair.into_iter().map(row).collect())
}
