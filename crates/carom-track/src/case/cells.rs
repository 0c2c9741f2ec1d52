//! Finished CFD results in a case: `[flow]` of a mesh, `patch` of a wall, `patch` of an injection.

use super::check::{needed, unknown, wrong};
use super::files::Files;
use super::text::{FieldsText, FlowText, TimeName, WallText};
use super::wall::SYMMETRY;
use crate::flow::Cells;
use crate::flow::cells::CellsError;
use crate::injection::Source;
use crate::vector::{cross, dot, norm, sub};
use carom::LawError;
use carom::error::did_you_mean;
use carom::spec::At;
use carom::units::TemperatureGradient;
#[cfg(feature = "fluent")]
use carom_cfd::fluent;
use carom_cfd::{Names, Patch, PatchKind, Snapshot, openfoam, vtk};
use carom_table::quoted;
use std::sync::Arc;

/// A little more than touching: rounding makes no overlap.
const CLEAR: f64 = 1e-6;
/// Share of a vector across a plane of symmetry, or that a rotation changes, that rounding may make.
const ACROSS: f64 = 1e-6;
/// Cells, faces or patches named in a message.
const NAMED: usize = 12;

/// Reads what the case's flow names, which the readers check; what the reader has to say is added to `notes`.
pub(super) fn read(
    text: &At<FlowText>,
    walls: &[At<WallText>],
    files: &Files,
    notes: &mut Vec<String>,
) -> Result<Arc<Cells>, LawError> {
    let (at, mut snapshot) = match text.value.kind.value.as_str() {
        "openfoam" => {
            let case = needed(&text.value.case, text, "case", "an openfoam flow")?;
            let time = text.value.time.as_ref().map(|t| match &t.value {
                TimeName::Name(name) => name.clone(),
                TimeName::Whole(n) => n.to_string(),
                TimeName::Number(n) => n.to_string(),
            });
            let options = openfoam::Options { time, names: names(text.value.fields.as_ref()) };
            let read = openfoam::read(&files.beside(&case.value), &options);
            (case, read.map_err(|e| wrong(case, e.to_string()))?)
        }
        #[cfg(not(feature = "fluent"))]
        "fluent" => {
            return Err(wrong(&text.value.kind, "this build reads no results of Fluent")
                .help("build with the feature fluent, or export the result as .vtu"));
        }
        #[cfg(feature = "fluent")]
        "fluent" => {
            let file = needed(&text.value.file, text, "file", "a fluent flow")?;
            let names = names(text.value.fields.as_ref());
            let options = fluent::Options { names, axis: axis(&text.value)?, ..fluent::Options::default() };
            let read = fluent::read(&files.beside(&file.value), &options);
            (file, read.map_err(|e| wrong(file, e.to_string()))?)
        }
        _ => {
            let file = needed(&text.value.file, text, "file", "a vtk flow")?;
            let patches = text.value.patches.as_ref().map(|p| p.value.clone());
            let options = vtk::Options { names: names(text.value.fields.as_ref()), patches, axis: axis(&text.value)? };
            let read = vtk::read(&files.beside(&file.value), &options);
            (file, read.map_err(|e| wrong(file, e.to_string()))?)
        }
    };
    notes.extend(snapshot.notes.iter().map(|note| format!("{}: {note}", at.value)));
    give_kinds(&mut snapshot, walls)?;
    files.take_in(&snapshot);
    let cells = Cells::new(&snapshot).map_err(|e| {
        let error = wrong(at, format!("{}: {e}", at.value));
        match e {
            CellsError::NoVelocity => error.help(velocity_is_named(&snapshot.fields.others)),
            CellsError::Density { .. } => error.help("fields = { density = \"none\" } leaves it out"),
            _ => error,
        }
    })?;
    notes.push(described(&at.value, &cells));
    if text.value.kind.value == "vtk" {
        notes.extend(cells.boundary_inside().map(|note| format!("{}: {note}", at.value)));
    }
    Ok(Arc::new(cells))
}

/// The axis that an axisymmetric result goes round, if it is one.
fn axis(text: &FlowText) -> Result<Option<vtk::Axis>, LawError> {
    let Some(at) = &text.axisymmetric else { return Ok(None) };
    vtk::Axis::named(&at.value)
        .map(Some)
        .ok_or_else(|| unknown(at, "axis", vtk::Axis::ALL.into_iter().map(vtk::Axis::name)))
}

fn names(text: Option<&At<FieldsText>>) -> Names {
    let FieldsText { velocity, k, epsilon, omega, density, temperature, pressure } =
        text.map(|t| t.value.clone()).unwrap_or_default();
    Names { velocity, k, epsilon, omega, density, temperature, pressure }
}

fn velocity_is_named(others: &[String]) -> String {
    match others {
        [] => "there are no fields: is it the time that was meant?".to_owned(),
        _ => format!("fields = {{ velocity = \"NAME\" }} names it; there are {}", others.join(", ")),
    }
}

fn described(name: &str, cells: &Cells) -> String {
    let mut note = format!("{name}: {} cells", cells.len());
    if cells.inverted() > 0 {
        note += &format!(
            "; {} faces have tetrahedra that are turned or flat: near them the flow may be off",
            cells.inverted()
        );
    }
    note
}

/// Whether a patch needs a `[[wall]]`: the others say themselves what they are.
fn needs_wall(patch: &Patch) -> bool {
    matches!(patch.kind, PatchKind::Wall | PatchKind::Plain) && !patch.faces.is_empty()
}

/// The patches whose whole names a pattern matches. One that says itself what it is must be named, not only matched.
fn matching<'a>(pattern: &At<String>, patches: &'a [Patch]) -> Result<Vec<&'a Patch>, LawError> {
    let whole = format!("^(?:{})$", pattern.value);
    let regex =
        regex_lite::Regex::new(&whole).map_err(|e| wrong(pattern, format!("patch is no regular expression: {e}")))?;
    let found: Vec<&Patch> =
        patches.iter().filter(|p| p.name == pattern.value || (needs_wall(p) && regex.is_match(&p.name))).collect();
    if found.is_empty() {
        return Err(no_patch(pattern, patches));
    }
    if let Some(side) = found.iter().find(|p| {
        matches!(p.kind, PatchKind::Empty | PatchKind::Wedge | PatchKind::Cyclic { .. } | PatchKind::CyclicAmi { .. })
    }) {
        let message = format!("patch '{}' is a side of the space ({}), not a wall", side.name, side.kind.name());
        return Err(wrong(pattern, message).help("leave it out: the mesh says how the space goes on there"));
    }
    Ok(found)
}

fn no_patch(at: &At<String>, patches: &[Patch]) -> LawError {
    let names = || patches.iter().map(|p| p.name.as_str());
    let near = did_you_mean(&at.value, names()).map_or(String::new(), |n| format!("{n} "));
    wrong(at, format!("the mesh has no patch {}", quoted(&at.value)))
        .help(format!("{near}its patches are {}", listed(patches)))
}

fn listed<'a>(patches: impl IntoIterator<Item = &'a Patch>) -> String {
    let all: Vec<String> = patches.into_iter().map(|p| format!("{} ({})", p.name, p.kind.name())).collect();
    let more = if all.len() > NAMED { format!(" and {} more", all.len() - NAMED) } else { String::new() };
    all.into_iter().take(NAMED).collect::<Vec<_>>().join(", ") + &more
}

/// Patches that the case makes mirrors, or no mirrors any more.
fn give_kinds(snapshot: &mut Snapshot, walls: &[At<WallText>]) -> Result<(), LawError> {
    for wall in walls {
        let Some(pattern) = &wall.value.patch else { continue };
        let mirror = wall.value.law.value == SYMMETRY;
        let found = matching(pattern, &snapshot.mesh.patches)?.into_iter().map(|p| p.name.clone()).collect::<Vec<_>>();
        for patch in snapshot.mesh.patches.iter_mut().filter(|p| found.contains(&p.name)) {
            match (&patch.kind, mirror) {
                (_, true) => patch.kind = PatchKind::Symmetry,
                (PatchKind::Symmetry, false) => patch.kind = PatchKind::Wall,
                _ => {}
            }
        }
    }
    Ok(())
}

/// The walls of a case, one for each patch that a `[[wall]]` names; without mirrors, which are no walls.
pub(super) fn walls(texts: Vec<At<WallText>>, cells: Option<&Cells>) -> Result<Vec<At<WallText>>, LawError> {
    let mut walls = Vec::with_capacity(texts.len());
    let mut taken: Vec<(String, At<String>)> = Vec::new();
    for text in texts {
        let Some(pattern) = text.value.patch.clone() else {
            if text.value.law.value == SYMMETRY {
                return Err(wrong(&text.value.law, "law = \"symmetry\" is for a patch of a mesh")
                    .help("a wall of a shape mirrors with law = \"reflect\", restitution = 1, tangential_restitution = 1 and contact_at = \"center\""));
            }
            if text.value.name.value.is_empty() && text.value.name.span.is_none() {
                return Err(wrong(&text, "a wall without a name").help("give name = \"floor\""));
            }
            walls.push(text);
            continue;
        };
        let Some(cells) = cells else {
            return Err(wrong(&pattern, "a wall's patch without a mesh")
                .help("only flows of kind openfoam and vtk have patches"));
        };
        let named = !text.value.name.value.is_empty();
        let found = matching(&pattern, cells.patches())?;
        if named && found.len() > 1 {
            let message = format!(
                "name = '{}' for {} patches: {}",
                text.value.name.value,
                found.len(),
                listed(found.iter().copied())
            );
            return Err(
                wrong(&text.value.name, message).help("leave name out: each patch is then a wall of its own name")
            );
        }
        for patch in found {
            if let Some((_, other)) = taken.iter().find(|(name, _)| *name == patch.name) {
                let message = format!(
                    "patch '{}' has two walls: by {} and by {}",
                    patch.name,
                    quoted(&other.value),
                    quoted(&pattern.value)
                );
                return Err(wrong(&pattern, message).help("each patch is one wall: make one pattern narrower"));
            }
            taken.push((patch.name.clone(), pattern.clone()));
            if text.value.law.value == SYMMETRY {
                continue;
            }
            let mut wall = text.clone();
            if !named {
                wall.value.name = At { value: patch.name.clone(), span: pattern.span.clone() };
            }
            wall.value.patch = Some(At { value: patch.name.clone(), span: pattern.span.clone() });
            walls.push(wall);
        }
    }
    Ok(walls)
}

/// Every patch that needs a wall must have one.
pub(super) fn all_named(cells: &Cells, walls: &[At<WallText>], flow: &At<FlowText>) -> Result<(), LawError> {
    let has = |patch: &Patch| walls.iter().any(|w| w.value.patch.as_ref().is_some_and(|p| p.value == patch.name));
    let without: Vec<&Patch> = cells.patches().iter().filter(|p| needs_wall(p) && !has(p)).collect();
    if without.is_empty() {
        return Ok(());
    }
    let names = without.iter().map(|p| format!("'{}'", p.name)).take(NAMED).collect::<Vec<_>>().join(", ");
    Err(wrong(&flow.value.kind, format!("no [[wall]] says what happens at {names}"))
        .help(format!("add [[wall]] patch = \"...\" law = \"...\"; the patches are {}", listed(cells.patches()))))
}

/// What injections need of a mesh: its patches as openings.
#[derive(Default)]
pub(super) struct Openings<'a> {
    pub cells: Option<&'a Cells>,
    pub walls: &'a [At<WallText>],
}

impl Openings<'_> {
    /// A patch to start from, one radius inside where spheres touch it with their surface.
    pub fn find(&self, name: &str) -> Result<Source, LawError> {
        let Some(cells) = self.cells else {
            return Err(LawError::new(format!("position has a patch {} without a mesh", quoted(name)))
                .help("only flows of kind openfoam and vtk have patches by name"));
        };
        let at = At::from(name.to_owned());
        let patch = cells.patches().iter().find(|p| p.name == name).ok_or_else(|| no_patch(&at, cells.patches()))?;
        // the mesh's faces turn out of it
        let triangles = cells.triangles(patch).into_iter().map(|[a, b, c]| [a, c, b]).collect();
        let wall = self.walls.iter().find(|w| w.value.patch.as_ref().is_some_and(|p| p.value == name));
        let center = wall.and_then(|w| w.value.contact_at.as_ref()).is_some_and(|c| c.value == "center");
        Ok(Source::Opening { triangles, inset: if center { CLEAR } else { 1.0 + CLEAR } })
    }
}

/// Spheres start inside the mesh.
pub(super) fn inside(cells: &Cells, injections: &[super::Injected]) -> Result<(), LawError> {
    const SAMPLE: u64 = 1000;
    for injected in injections {
        for i in 0..injected.injection.count().min(SAMPLE) {
            let x = injected.injection.particle(i, |_, x| cells.velocity(x)).position;
            if !cells.holds(x) {
                let b = cells.bounds();
                return Err(LawError::new(format!("{} starts outside the mesh, at {x:?} m", injected.name))
                    .help(format!("the mesh reaches from {:?} to {:?} m", b.min, b.max))
                    .at(injected.place.clone()));
            }
        }
    }
    Ok(())
}

const WHOLE: &str = "it would act otherwise on what is carried over: use the whole body";

/// Whether a vector is the same where the space goes on elsewhere; what is wrong, if it is not.
fn alike(cells: &Cells, vector: [f64; 3]) -> Result<(), String> {
    for patch in cells.patches().iter().filter(|p| p.kind == PatchKind::Symmetry) {
        let across = |[a, b, c]: crate::geometry::Triangle| {
            let n = cross(sub(b, a), sub(c, a));
            dot(n, vector).abs() > ACROSS * norm(n) * norm(vector)
        };
        if cells.triangles(patch).into_iter().any(across) {
            return Err(format!("points across the plane of symmetry '{}'", patch.name));
        }
    }
    let turned = |carry: carom_cfd::Carry| norm(sub(carry.vector(vector), vector)) > ACROSS * norm(vector);
    match cells.carries().find(|(_, carry)| turned(*carry)) {
        Some((patch, _)) => Err(format!("is not along the axis that '{patch}' goes on round")),
        None => Ok(()),
    }
}

/// What the forces ask of a mesh that it does not have, or that does not go with how its space goes on.
pub(super) fn chance(
    cells: &Cells,
    text: &super::text::ForcesText,
    gradient: Option<&At<[TemperatureGradient; 3]>>,
    dynamics: &crate::dynamics::Dynamics,
) -> Result<(), LawError> {
    let forces = &dynamics.forces;
    if let Some(at) = &text.gravity {
        alike(cells, forces.gravity).map_err(|m| wrong(at, format!("gravity {m}")).help(WHOLE))?;
    }
    if let (Some(at), Some(thermal)) = (gradient, forces.thermophoresis) {
        alike(cells, thermal.gradient).map_err(|m| wrong(at, format!("temperature_gradient {m}")).help(WHOLE))?;
    }
    if let Some(at) = text.random_walk.as_ref().filter(|_| !cells.is_turbulent()) {
        return Err(wrong(at, "random_walk in a result without turbulence")
            .help("the time folder needs k and epsilon or omega; other names go into fields = { k = \"...\" }"));
    }
    Ok(())
}
