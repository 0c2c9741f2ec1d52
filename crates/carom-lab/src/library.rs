//! The experiments that come along, and those of a folder.

use crate::error::LabError;
use crate::experiment::Experiment;
use crate::points;
use std::path::Path;

macro_rules! experiments {
    ($($name:literal),* $(,)?) => {
        const BUILTIN: &[(&str, &str)] = &[$(($name, include_str!(concat!("../data/experiments/", $name, ".toml")))),*];
    };
}

experiments! {
    "kim-dunn-2007", "wall-1990", "dahneke-1975", "dunn-1995", "dunn-1996", "li-2000", "gorham-kharaz-2000",
    "kangur-kleis-1988", "kharaz-2001",
}

/// The experiments that come along.
///
/// # Errors
/// None in a build that passed its tests.
pub fn builtin() -> Result<Vec<Experiment>, LabError> {
    BUILTIN.iter().map(|(name, text)| Experiment::from_toml(name, text)).collect()
}

/// Every experiment of a folder: its `.toml` files in the order of their names, each with the points of the `.csv` file of the
/// same name beside it.
///
/// # Errors
/// What cannot be read or is wrong, with file and place; a folder without experiments.
pub fn from_folder(folder: &Path) -> Result<Vec<Experiment>, LabError> {
    let failed = |path: &Path| {
        let path = path.to_path_buf();
        move |source| LabError::File { path, source }
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed(folder))? {
        let path = entry.map_err(failed(folder))?.path();
        if path.extension().is_some_and(|e| e == "toml") {
            files.push(path);
        }
    }
    files.sort();
    let mut experiments = Vec::with_capacity(files.len());
    for path in files {
        let name = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        let mut experiment = Experiment::from_toml(&name, &std::fs::read_to_string(&path).map_err(failed(&path))?)?;
        let beside = path.with_extension("csv");
        if beside.exists() {
            let bytes = carom_table::file::read_regular(&beside, points::LARGEST).map_err(failed(&beside))?;
            let text = points::text(&bytes).map_err(|e| LabError::Points(format!("{name}.csv: {e}")))?;
            points::add(&mut experiment, &format!("{name}.csv"), &text)?;
        }
        experiments.push(experiment);
    }
    if experiments.is_empty() {
        let source = std::io::Error::new(std::io::ErrorKind::NotFound, "no experiment (.toml) in this folder");
        return Err(LabError::File { path: folder.to_path_buf(), source });
    }
    Ok(experiments)
}
