//! Results of Fluent in its Common Fluids Format: a case (`.cas.h5`) with the mesh, and data (`.dat.h5`) with the fields.
//!
//! HDF5 is read by the crate hdf5-reader. What the files hold is not documented by Ansys in full; it is taken from what VTK's `vtkFLUENTCFFReader` reads and from files
//! of Fluent 22.2 that Ansys publishes (github.com/ansys/example-data). Values are in SI units whatever the program displays.
//!
//! **The mesh**: cells of any kind in fluid zones; those of solid zones are left out. Zones of faces are patches by their names: walls, symmetries, and all others
//! [plain](crate::PatchKind::Plain). A zone between two fluid cells (interior, fan, porous jump) lets the fluid through.
//!
//! **Fields** are those of the first phase (of the mixture, where there are several), at cells and at the faces of the boundary: `SV_U`, `SV_V`, `SV_W`, `SV_K`, `SV_D` (ε),
//! `SV_O` (ω), `SV_DENSITY`, `SV_T`, `SV_P` (relative to the operating pressure). [`Names`] name others, the velocity by its first component.
//!
//! Cases of two dimensions are plane, one layer of cells between two [empty](crate::PatchKind::Empty) sides, or, with [`Options::axis`], a [wedge](crate::PatchKind::Wedge)
//! of 5°, with the swirl `SV_W` where there is one.
//!
//! Not read, and refused: meshes refined by hanging nodes (`tree`). Periodic zones and
//! non-conformal interfaces become patches, which a note tells.

mod fields;
mod flat;
mod hdf;
mod mesh;

pub use crate::vtk::Axis;
use crate::{Error, Fields, Names, Snapshot, check};
use hdf::Hdf;
use std::path::{Path, PathBuf};

/// What a reader is told.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The data; none: beside the case, `.dat.h5` in place of `.cas.h5`.
    pub data: Option<PathBuf>,
    /// Names of the fields, where they are not the usual ones.
    pub names: Names,
    /// The axis of an axisymmetric case of two dimensions, in Fluent x; none: such a case is plane.
    pub axis: Option<Axis>,
}

/// Reads a case and its data. A case without data beside it has a mesh alone.
///
/// # Errors
/// What cannot be read, or cannot be used: see [above](self).
pub fn read(case: &Path, options: &Options) -> Result<Snapshot, Error> {
    let data = match &options.data {
        Some(data) => Some(Hdf::open(data)?),
        None => Some(beside(case)).filter(|data| data.exists()).map(|data| Hdf::open(&data)).transpose()?,
    };
    let mut snapshot = snapshot(&Hdf::open(case)?, data.as_ref(), options)?;
    if data.is_none() {
        snapshot.notes.push(format!("no data: there is no {}", beside(case).display()));
    }
    Ok(snapshot)
}

/// Reads what is in the files of a case and of its data.
///
/// # Errors
/// What cannot be read, or cannot be used: see [above](self).
pub fn from_bytes(case: Vec<u8>, data: Option<Vec<u8>>, options: &Options) -> Result<Snapshot, Error> {
    let data = data.map(|data| Hdf::of(data, Path::new("data"))).transpose()?;
    snapshot(&Hdf::of(case, Path::new("case"))?, data.as_ref(), options)
}

fn snapshot(case: &Hdf, data: Option<&Hdf>, Options { names, axis, .. }: &Options) -> Result<Snapshot, Error> {
    let mut notes = Vec::new();
    if mesh::dimensions(case)? == 2 {
        return flat::read(case, data, names, *axis, notes);
    }
    if axis.is_some() {
        return Err(case.error("a case of three dimensions: axisymmetric is for those of two"));
    }
    let part = mesh::read(case, &mut notes)?;
    let fields = match data {
        Some(data) => fields::read(data, &part, names, &mut notes)?,
        None => Fields::default(),
    };
    let snapshot = Snapshot { mesh: part.mesh, fields, time: None, notes };
    check::snapshot(&snapshot)?;
    Ok(snapshot)
}

/// The data that belong to a case by their name.
fn beside(case: &Path) -> PathBuf {
    let name = case.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.strip_suffix(".cas.h5").unwrap_or(&name);
    case.with_file_name(format!("{stem}.dat.h5"))
}

#[cfg(test)]
mod tests;
