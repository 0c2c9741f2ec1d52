//! The fields of a result.

use super::hdf::Hdf;
use super::mesh::Part;
use crate::{Error, Field, Fields, Names, Wanted};

/// The first phase, or the mixture of several.
const PHASE: &str = "results/1/phase-1";

/// Usual names of the scalars, in the order of [`Names`].
const USUAL: [&str; 7] = ["SV_U", "SV_K", "SV_D", "SV_O", "SV_DENSITY", "SV_T", "SV_P"];

/// Which fields a result has and are meant, by their names.
pub(super) struct Chosen {
    /// The components of the velocity; a case of two dimensions may have no third one.
    pub velocity: [Option<String>; 3],
    /// The scalars, in the order of [`Names`].
    pub scalars: [Option<String>; 6],
    /// The names of the others.
    pub others: Vec<String>,
}

/// Chooses among the fields of a file.
pub(super) fn choose(file: &Hdf, plane: bool, names: &Names, notes: &mut Vec<String>) -> Result<Chosen, Error> {
    let there = file.groups(&format!("{PHASE}/cells"));
    if there.is_empty() {
        return Err(file.error(format!("no results: {PHASE}/cells is not there")));
    }
    let phases = file.groups("results/1").into_iter().filter(|n| n.starts_with("phase-")).count();
    if phases > 1 {
        notes.push(format!("{phases} phases: the fields are those of the first, which is the mixture"));
    }
    let mut found: [Option<String>; 7] = Default::default();
    for (q, (found, name)) in found.iter_mut().zip(names.all()).enumerate() {
        let usual = || there.iter().any(|n| n == USUAL[q]).then(|| USUAL[q].to_owned());
        *found = match name {
            Wanted::Named(name) if there.iter().any(|n| n == name) => Some(name.to_owned()),
            Wanted::Named(name) => return Err(missing(file, name, there)),
            Wanted::Usual => usual(),
            Wanted::None => None,
        };
    }
    let [Some(u), scalars @ ..] = found else { return Err(missing(file, "SV_U", there)) };
    // the other components by the first one's name
    let components = ["SV_U", "SV_V", "SV_W"].map(|c| u.replacen("SV_U", c, 1));
    if components[0] == components[1] {
        return Err(file.error(format!("the velocity is named by its first component, SV_U or SV_U_MEAN, not {u}")));
    }
    let needed = if plane { 2 } else { 3 };
    if let Some(name) = components[..needed].iter().find(|c| !there.contains(c)) {
        return Err(missing(file, name, there));
    }
    if scalars[5].is_some() {
        notes.push("the pressure is relative to the operating pressure of the case".to_owned());
    }
    let used = |n: &String| components.contains(n) || scalars.iter().flatten().any(|f| f == n);
    let others = there.iter().filter(|n| !used(n)).cloned().collect();
    Ok(Chosen { velocity: components.map(|c| Some(c).filter(|c| there.contains(c))), scalars, others })
}

pub(super) fn read(file: &Hdf, part: &Part, names: &Names, notes: &mut Vec<String>) -> Result<Fields, Error> {
    let mut of_pressure = Vec::new();
    let Chosen { velocity, scalars, others } = choose(file, false, names, &mut of_pressure)?;
    let name = |c: usize| velocity[c].as_deref().unwrap_or_default();
    let velocity = field(file, part, &[name(0), name(1), name(2)], notes)?;
    let mut read: [Option<Field<1>>; 6] = Default::default();
    for (scalar, name) in read.iter_mut().zip(&scalars) {
        if let Some(name) = name {
            *scalar = Some(field(file, part, &[name], notes)?);
        }
    }
    notes.extend(of_pressure);
    let [k, epsilon, omega, density, temperature, pressure] = read;
    Ok(Fields { velocity: Some(velocity), k, epsilon, omega, density, temperature, pressure, others })
}

/// Values of a quantity at all cells or faces (`of`) of a file, component by component: zero where a component is none, not a number where there are no values.
pub(super) fn values(file: &Hdf, of: &str, names: &[Option<String>], count: usize) -> Result<Vec<f64>, Error> {
    let mut all = vec![0.0; names.len() * count];
    for (c, name) in names.iter().enumerate() {
        let Some(name) = name else { continue };
        let at = format!("{PHASE}/{of}/{name}");
        let found = if of == "cells" || file.has(&at) { list(file, &at, count)? } else { vec![f64::NAN; count] };
        for (value, found) in all.iter_mut().skip(c).step_by(names.len()).zip(found) {
            *value = found;
        }
    }
    Ok(all)
}

fn missing(file: &Hdf, name: &str, there: Vec<String>) -> Error {
    Error::Missing { path: file.path().to_owned(), kind: "field", name: name.to_owned(), there }
}

/// A field of one list for each component.
fn field<const N: usize>(
    file: &Hdf,
    part: &Part,
    names: &[&str; N],
    notes: &mut Vec<String>,
) -> Result<Field<N>, Error> {
    let mut cells = vec![[0.0; N]; part.cells.len()];
    let owners = &part.mesh.owner[part.mesh.inner_faces()..];
    let mut faces = vec![[f64::NAN; N]; owners.len()];
    for (c, name) in names.iter().enumerate() {
        let all = list(file, &format!("{PHASE}/cells/{name}"), part.counts[0])?;
        for (value, cell) in cells.iter_mut().zip(&part.cells) {
            value[c] = all[*cell as usize];
        }
        if let Some(cell) = part.cells.iter().find(|cell| !all[**cell as usize].is_finite()) {
            let what = if all[*cell as usize].is_nan() { "no value" } else { "infinite" };
            return Err(file.error(format!("{name} has {what} in cell {}", cell + 1)));
        }
        let at = format!("{PHASE}/faces/{name}");
        if file.has(&at) {
            let all = list(file, &at, part.counts[1])?;
            for (value, face) in faces.iter_mut().zip(&part.boundary) {
                value[c] = all[*face as usize];
            }
        }
    }
    let is_whole = |v: &[f64; N]| v.iter().all(|x| x.is_finite());
    let inner = part.mesh.inner_faces();
    let of = |p: &crate::Patch| p.faces.start - inner..p.faces.end - inner;
    let bare: Vec<&str> =
        part.mesh.patches.iter().filter(|p| !faces[of(p)].iter().all(is_whole)).map(|p| p.name.as_str()).collect();
    if !bare.is_empty() {
        notes.push(format!("{} has no values on {}: there the cells' own hold", names[0], bare.join(", ")));
    }
    for (value, owner) in faces.iter_mut().zip(owners) {
        if !is_whole(value) {
            *value = cells[*owner as usize];
        }
    }
    Ok(Field::Cells { cells, boundary: faces })
}

/// The values of all cells or faces; not a number where there are none.
fn list(file: &Hdf, at: &str, count: usize) -> Result<Vec<f64>, Error> {
    let mut all = vec![f64::NAN; count];
    for (range, numbers) in file.sections::<f64>(at)? {
        let places =
            all.get_mut(range).ok_or_else(|| file.error(format!("{at} belongs to another mesh: it has more")))?;
        places.copy_from_slice(&numbers);
    }
    Ok(all)
}
