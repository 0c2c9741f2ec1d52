//! The fields of a result.

use super::hdf::Hdf;
use super::mesh::Part;
use crate::{Error, Field, Fields, Names, Wanted};

/// The first phase, or the mixture of several.
const PHASE: &str = "results/1/phase-1";

/// Usual names of the scalars, in the order of [`Names`].
const USUAL: [&str; 7] = ["SV_U", "SV_K", "SV_D", "SV_O", "SV_DENSITY", "SV_T", "SV_P"];

/// What holds for a pressure.
pub(super) const RELATIVE: &str = "the pressure is relative to the operating pressure of the case";

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
    let used = |n: &String| components.contains(n) || scalars.iter().flatten().any(|f| f == n);
    let others = there.iter().filter(|n| !used(n)).cloned().collect();
    Ok(Chosen { velocity: components.map(|c| Some(c).filter(|c| there.contains(c))), scalars, others })
}

pub(super) fn read(file: &Hdf, part: &Part, names: &Names, notes: &mut Vec<String>) -> Result<Fields, Error> {
    let Chosen { velocity, scalars, others } = choose(file, false, names, notes)?;
    let velocity = field(file, part, &velocity, notes)?;
    let mut read: [Option<Field<1>>; 6] = Default::default();
    for (scalar, name) in read.iter_mut().zip(scalars) {
        if name.is_some() {
            *scalar = Some(field(file, part, &[name], notes)?);
        }
    }
    let [k, epsilon, omega, density, temperature, pressure] = read;
    if pressure.is_some() {
        notes.push(RELATIVE.to_owned());
    }
    Ok(Fields { velocity: Some(velocity), k, epsilon, omega, density, temperature, pressure, others })
}

/// Values of a quantity in some of a file's `count` cells, each of which must have one; zero where a component is none.
pub(super) fn in_cells<const N: usize>(
    file: &Hdf,
    names: &[Option<String>; N],
    cells: &[u32],
    count: usize,
) -> Result<Vec<[f64; N]>, Error> {
    let mut values = vec![[0.0; N]; cells.len()];
    for (c, name) in names.iter().enumerate() {
        let Some(name) = name else { continue };
        let all = list(file, &format!("{PHASE}/cells/{name}"), count)?;
        for (value, cell) in values.iter_mut().zip(cells) {
            value[c] = all[*cell as usize];
        }
        if let Some(cell) = cells.iter().find(|cell| !all[**cell as usize].is_finite()) {
            let what = if all[*cell as usize].is_nan() { "no value" } else { "infinite" };
            return Err(file.error(format!("{name} has {what} in cell {}", cell + 1)));
        }
    }
    Ok(values)
}

/// The same on some of a file's `count` faces; not a number where there is no value.
pub(super) fn on_faces<const N: usize>(
    file: &Hdf,
    names: &[Option<String>; N],
    faces: impl ExactSizeIterator<Item = u32> + Clone,
    count: usize,
) -> Result<Vec<[f64; N]>, Error> {
    let mut values = vec![[f64::NAN; N]; faces.len()];
    for (c, name) in names.iter().enumerate() {
        let Some(name) = name else {
            values.iter_mut().for_each(|value| value[c] = 0.0);
            continue;
        };
        let at = format!("{PHASE}/faces/{name}");
        if file.has(&at) {
            let all = list(file, &at, count)?;
            for (value, face) in values.iter_mut().zip(faces.clone()) {
                value[c] = all[face as usize];
            }
        }
    }
    Ok(values)
}

fn missing(file: &Hdf, name: &str, there: Vec<String>) -> Error {
    Error::Missing { path: file.path().to_owned(), kind: "field", name: name.to_owned(), there }
}

/// A field of one list for each component.
fn field<const N: usize>(
    file: &Hdf,
    part: &Part,
    names: &[Option<String>; N],
    notes: &mut Vec<String>,
) -> Result<Field<N>, Error> {
    let owners = &part.mesh.owner[part.mesh.inner_faces()..];
    let cells = in_cells(file, names, &part.cells, part.counts[0])?;
    let mut faces = on_faces(file, names, part.boundary.iter().copied(), part.counts[1])?;
    let is_whole = |v: &[f64; N]| v.iter().all(|x| x.is_finite());
    let inner = part.mesh.inner_faces();
    let of = |p: &crate::Patch| p.faces.start - inner..p.faces.end - inner;
    let bare: Vec<&str> =
        part.mesh.patches.iter().filter(|p| !faces[of(p)].iter().all(is_whole)).map(|p| p.name.as_str()).collect();
    if !bare.is_empty() {
        let name = names[0].as_deref().unwrap_or_default();
        notes.push(format!("{name} has no values on {}: there the cells' own hold", bare.join(", ")));
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
