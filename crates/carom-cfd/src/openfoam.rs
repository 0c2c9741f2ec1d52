//! Cases of OpenFOAM.
//!
//! Read are cases in one piece, decomposed (`processor0` …) and collated (`processors4`, `processors4_0-1` …); ASCII and binary; compressed or not; whole numbers and numbers of 32
//! and 64 bits, as each file's `arch` says; `faceList` and `faceCompactList`; the ways of writing of openfoam.com (v1912 is what the tests' files come from)
//! and openfoam.org. A decomposed case is put together to the mesh that it was cut from where its `…ProcAddressing` files tell how, and by the
//! faces that its parts have in common where not.
//!
//! The mesh is the newest in a time folder up to the time asked for, else that in `constant`. On a patch a field has the `value` of its entry; without one, zero (`noSlip`), the
//! cell's value less what goes through the face (`slip`, symmetries), or the cell's value. Periodic and wedge patches have the cell's value always.
//! Entries are found by the patch's name, else by its groups, else by patterns.
//!
//! Not read: directives (`#include`, `#calc` and the like; `foamDictionary -expand` writes them out), numbers with high bytes first, regions of
//! their own (`constant/REGION/polyMesh`), and patches that cover each other in part (`cyclicACMI`, `cyclicPeriodicAMI`, `nonConformal…`, `overset`).

mod boundary;
mod cyclic;
mod dictionary;
mod error;
mod fields;
mod files;
mod header;
mod layout;
mod list;
mod poly_mesh;
mod scan;
mod stitch;

use std::path::Path;

pub use crate::Names;
use crate::{Error, Fields, Mesh, Snapshot, Wanted, check};
use fields::Asked;
use layout::{Layout, Store, Time};

/// What is to be read of a case.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Name of the time; none or `latest`: the latest.
    pub time: Option<String>,
    /// Names of the fields, where they are not the usual ones.
    pub names: Names,
}

/// Whether a folder looks like a case: it has a mesh in it, whole or in parts.
pub fn is_case(folder: &Path) -> bool {
    folder.is_dir() && Layout::all(folder).is_ok_and(|layouts| layouts.iter().any(Layout::has_mesh))
}

/// Names of the times of a case, by time.
pub fn times(case: &Path) -> Result<Vec<String>, Error> {
    let mut times: Vec<Time> = Vec::new();
    for layout in Layout::all(case)?.into_iter().filter(Layout::has_mesh) {
        times.extend(layout.times.into_iter().filter(|t| times.iter().all(|o| o.value != t.value)).collect::<Vec<_>>());
    }
    times.sort_by(|a, b| a.value.total_cmp(&b.value));
    Ok(times.into_iter().map(|t| t.name).collect())
}

/// Reads mesh and fields of a case at one time, and refuses what cannot be used ([`check`]).
///
/// A case without times has a mesh alone.
pub fn read(case: &Path, options: &Options) -> Result<Snapshot, Error> {
    let mut notes = Vec::new();
    let (layout, time) = choose(case, options.time.as_deref(), &mut notes)?;
    let (folder, parts) = poly_mesh::read(&layout, time.as_ref().map(|t| t.value))?;
    let (whole, joints) = stitch::join(&layout, &folder, parts, &mut notes)?;
    let raw = whole.patches;
    let mut mesh = Mesh {
        points: whole.points,
        faces: whole.faces,
        owner: whole.owner,
        neighbour: whole.neighbour,
        cells: whole.cells,
        patches: Vec::new(),
    };
    check::without_patches(&mesh)?;
    mesh.patches = boundary::patches(&raw, &mesh, case)?;
    check::patches(&mesh)?;
    let fields = match &time {
        Some(time) => all_fields(&layout, &time.name, &options.names, &mesh, &joints, &mut notes)?,
        None => Fields::default(),
    };
    check::fields(&fields, &mesh)?;
    Ok(Snapshot { mesh, fields, time: time.map(|t| t.name), notes })
}

/// The way of storing that has the time, and the time.
fn choose(case: &Path, time: Option<&str>, notes: &mut Vec<String>) -> Result<(Layout, Option<Time>), Error> {
    let mut layouts: Vec<_> = Layout::all(case)?.into_iter().filter(Layout::has_mesh).collect();
    if layouts.is_empty() {
        let mut what = "no OpenFOAM case: there is no constant/polyMesh, whole or in processors' folders".to_owned();
        let regions = regions(case);
        if !regions.is_empty() {
            what += &format!("; there are regions, which are not read: {}", regions.join(", "));
        }
        return Err(Error::file(case, what));
    }
    let missing = |name: &str| {
        let there = times(case)?;
        Err(Error::Missing { path: case.to_owned(), kind: "time", name: name.into(), there })
    };
    let asked = time.filter(|t| *t != "latest");
    let found = match asked {
        Some(name) => {
            let value: Option<f64> = name.parse().ok();
            let same = |t: &Time| t.name == name || Some(t.value) == value;
            match layouts.iter().position(|l| l.times.iter().any(same)) {
                Some(at) => (at, layouts[at].times.iter().rev().find(|t| same(t)).cloned()),
                None => return missing(name),
            }
        }
        None => {
            let last = |l: &Layout| l.times.last().map_or(f64::NEG_INFINITY, |t| t.value);
            // of several with the same latest time the first: the case in one piece, if it is one of them
            let at = (1..layouts.len()).fold(0, |b, i| if last(&layouts[i]) > last(&layouts[b]) { i } else { b });
            (at, layouts[at].times.last().cloned())
        }
    };
    let several = layouts.len() > 1;
    let layout = layouts.swap_remove(found.0);
    match (&found.1, layout.times.as_slice()) {
        (None, _) => notes.push("there is no time folder: the mesh alone is read".into()),
        (Some(time), [first, .., last]) => notes.push(format!(
            "of {} times from {} to {}, {} is used, frozen",
            layout.times.len(),
            first.name,
            last.name,
            time.name
        )),
        _ => {}
    }
    match &layout.store {
        Store::Whole(_) => {}
        Store::Folders(parts) => notes.push(format!("put together from the folders of {} processors", parts.len())),
        Store::Blocks(_) => notes.push("put together from the processors' collated folders".into()),
    }
    if several && !matches!(layout.store, Store::Whole(_)) {
        notes.push("the case in one piece does not have this time".into());
    }
    Ok((layout, found.1))
}

/// Folders of `constant` that have meshes of their own.
fn regions(case: &Path) -> Vec<String> {
    let constant = case.join("constant");
    let mut names = layout::names(&constant).unwrap_or_default();
    names.retain(|name| constant.join(name).join("polyMesh").is_dir());
    names
}

/// Usual names of the scalars, in the order of [`Names`], and exponents of kg, m, s, K that they may have.
const SCALARS: [(&str, &[[i8; 4]]); 6] = [
    ("k", &[[0, 2, -2, 0]]),
    ("epsilon", &[[0, 2, -3, 0]]),
    ("omega", &[[0, 0, -1, 0]]),
    ("rho", &[[1, -3, 0, 0]]),
    ("T", &[[0, 0, 0, 1]]),
    ("p", &[[1, -1, -2, 0], [0, 2, -2, 0]]),
];

fn all_fields(
    layout: &Layout,
    time: &str,
    names: &Names,
    mesh: &Mesh,
    joints: &[stitch::Joint],
    notes: &mut Vec<String>,
) -> Result<Fields, Error> {
    let mut fields = Fields { others: fields::names(layout, time)?, ..Fields::default() };
    let there = fields.others.clone();
    let mut used = Vec::new();
    let root = layout.store.first().join(time);
    let name = |wanted: Wanted<'_>, usual: &str| {
        let (name, asked) = match wanted {
            Wanted::None => return Ok(None),
            Wanted::Named(name) => (name, true),
            Wanted::Usual => (usual, false),
        };
        if files::is_there(&root.join(name)) {
            return Ok(Some(name.to_owned()));
        }
        let missing = || Error::Missing { path: root.clone(), kind: "field", name: name.into(), there: there.clone() };
        if asked { Err(missing()) } else { Ok(None) }
    };
    let [velocity, scalars @ ..] = names.all();
    if let Some(name) = name(velocity, "U")? {
        let (file, kind) = (format!("{time}/{name}"), &[[0, 1, -1, 0]]);
        let asked = Asked { file: &file, name: &name, dimensions: kind, may_differ: false };
        fields.velocity = fields::read(layout, &asked, mesh, joints, notes)?.map(Into::into);
        used.push(name);
    }
    let places = [
        &mut fields.k,
        &mut fields.epsilon,
        &mut fields.omega,
        &mut fields.density,
        &mut fields.temperature,
        &mut fields.pressure,
    ];
    for ((place, wanted), (usual, dimensions)) in places.into_iter().zip(scalars).zip(SCALARS) {
        let Some(name) = name(wanted, usual)? else { continue };
        // a passive scalar is called T as well
        let may_differ = wanted == Wanted::Usual && matches!(usual, "rho" | "T");
        let asked = Asked { file: &format!("{time}/{name}"), name: &name, dimensions, may_differ };
        let Some(found) = fields::read::<[f64; 1]>(layout, &asked, mesh, joints, notes)? else { continue };
        if usual == "p" && found.dimensions == Some(1) {
            notes.push(format!("pressure ({name}) is over the density, m²/s²"));
        }
        *place = Some(found.into());
        used.push(name);
    }
    fields.others.retain(|name| !used.contains(name));
    Ok(fields)
}
