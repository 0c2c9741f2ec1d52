//! `[[wall]]` and `[law.*]`.

use super::check::{needed, positive, word, wrong};
use super::files::Files;
use super::injection::{Injected, no_such_law};
use super::text::{Si, WallText};
use crate::domain::{ContactAt, Wall};
use crate::flow::Cells;
use crate::geometry::{Cylinder, Mesh, Plane, Room, Shape};
use crate::tracker::Behavior;
use crate::vector::{dot, norm, scale, sub, unit};
use carom::LawError;
use carom::curvature::Curvature;
use carom::material::{Library, MaterialRef};
use carom::spec::{At, LawSpec, NormalKind, NormalSpec, TangentialKind};
use std::collections::BTreeMap;

/// What a wall may be besides a law of the case.
pub(super) const WORDS: [&str; 4] = ["trap", "escape", "wall-jet", "reflect"];

/// What a patch of a mesh may be besides.
pub(super) const SYMMETRY: &str = "symmetry";

/// The laws as written, by name.
pub(super) type Laws = BTreeMap<String, At<LawSpec>>;

/// The geometry of a wall. What files were read for it is added to `notes`.
pub(super) fn read(
    at: &At<WallText>,
    cells: Option<&Cells>,
    files: &Files,
    notes: &mut Vec<String>,
) -> Result<Wall, LawError> {
    let text = &at.value;
    let shape = shape(at, cells, files, notes)?;
    let contacts = [("surface", ContactAt::Surface), ("center", ContactAt::Center)];
    let contact_at = text.contact_at.as_ref().map_or(Ok(ContactAt::Surface), |c| word(c, "contact_at", &contacts))?;
    let velocity = velocity(text, &shape)?;
    Ok(Wall {
        name: text.name.value.clone(),
        shape,
        contact_at,
        velocity,
        patch: text.patch.as_ref().map(|p| p.value.clone()),
    })
}

fn shape(at: &At<WallText>, cells: Option<&Cells>, files: &Files, notes: &mut Vec<String>) -> Result<Shape, LawError> {
    let text = &at.value;
    let name = &text.name.value;
    let mut shapes = Vec::new();
    if let Some(p) = &text.plane {
        shapes.push(Shape::Plane(Plane { point: p.value.point.si(), normal: direction(&p.value.normal, "normal")? }));
    }
    if let Some(c) = &text.cylinder {
        let c = &c.value;
        shapes.push(Shape::Cylinder(Cylinder {
            point: c.point.si(),
            axis: direction(&c.axis, "axis")?,
            radius: positive(&c.radius, "radius", c.radius.value.0)?,
            inside: c
                .fluid
                .as_ref()
                .map_or(Ok(true), |f| word(f, "side of the fluid", &[("inside", true), ("outside", false)]))?,
        }));
    }
    if let Some(room) = &text.room {
        let (min, max) = corners(room)?;
        shapes.push(Shape::Room(Room { min, max }));
    }
    if let Some(block) = &text.block {
        let (min, max) = corners(block)?;
        shapes.extend(Mesh::block(min, max).map(Shape::Mesh));
    }
    if let (Some(name), Some(cells)) = (&text.patch, cells) {
        let patch = cells.patches().iter().find(|p| p.name == name.value);
        let mesh = patch.and_then(|p| cells.wall(p));
        let mesh = mesh.ok_or_else(|| wrong(name, format!("patch '{}' has no face with an area", name.value)))?;
        shapes.push(Shape::Mesh(mesh));
    }
    if let Some(stl) = &text.stl {
        let (mesh, note) = super::triangles::mesh(stl, name, files)?;
        shapes.push(Shape::Mesh(mesh));
        notes.push(note);
    }
    match (shapes.pop(), shapes.is_empty()) {
        (Some(shape), true) => Ok(shape),
        (None, _) => Err(wrong(at, format!("wall '{name}' has no shape"))
            .help("give plane, cylinder, box, block or stl; or patch, where the flow is a mesh")),
        _ => Err(wrong(at, format!("wall '{name}' has more than one shape"))
            .help("keep one of plane, cylinder, box, block, stl and patch")),
    }
}

fn corners(at: &At<[[carom::units::Length; 3]; 2]>) -> Result<([f64; 3], [f64; 3]), LawError> {
    let (a, b) = (at.value[0].si(), at.value[1].si());
    match (0..3).find(|i| a[*i] >= b[*i]) {
        None => Ok((a, b)),
        Some(i) => {
            let message = format!("the box has no extent along {}: {} m to {} m", ["x", "y", "z"][i], a[i], b[i]);
            Err(wrong(at, message).help("give the lower corner first"))
        }
    }
}

fn direction(at: &At<[f64; 3]>, key: &str) -> Result<[f64; 3], LawError> {
    unit(at.value).ok_or_else(|| {
        wrong(at, format!("{key} has no direction: {:?}", at.value)).help("give a finite vector that is not zero")
    })
}

/// A wall may slide along itself, not leave its place.
fn velocity(text: &WallText, shape: &Shape) -> Result<[f64; 3], LawError> {
    let Some(at) = &text.velocity else { return Ok([0.0; 3]) };
    let v = at.value.si();
    if !v.iter().all(|c| c.is_finite()) {
        return Err(wrong(at, "the wall's velocity is not finite"));
    }
    let along = match shape {
        Shape::Plane(p) => dot(v, p.normal).abs() <= 1e-9 * norm(v),
        Shape::Cylinder(c) => norm(sub(v, scale(c.axis, dot(v, c.axis)))) <= 1e-9 * norm(v),
        _ => norm(v) == 0.0,
    };
    if along {
        return Ok(v);
    }
    Err(wrong(at, format!("wall '{}' moves off itself", text.name.value))
        .help("a plane may slide in its plane and a cylinder along its axis; other shapes stay where they are"))
}

/// What happens at a wall.
pub(super) fn behavior(
    at: &At<WallText>,
    wall: &Wall,
    laws: &Laws,
    injections: &[Injected],
    library: &Library,
) -> Result<Behavior, LawError> {
    let text = &at.value;
    let name = text.law.value.as_str();
    if name != "reflect"
        && let Some(extra) = text.restitution.as_ref().or(text.tangential_restitution.as_ref())
    {
        return Err(wrong(extra, format!("a restitution beside law = \"{name}\""))
            .help("only law = \"reflect\" takes its coefficients here"));
    }
    if let Some(law) = laws.get(name) {
        let curvature = curvature(wall, &law.value);
        let laws = compile(text, name, law, injections, library)?.into_iter();
        return Ok(Behavior::Law(laws.map(|law| if let Some(c) = curvature { law.curved(c) } else { law }).collect()));
    }
    match name {
        "trap" => Ok(Behavior::Trap),
        "escape" => Ok(Behavior::Escape),
        "wall-jet" => Ok(Behavior::WallJet),
        "reflect" => reflect(at, library),
        _ => Err(no_such_law(&text.law, laws.keys())),
    }
}

/// The wall's own curvature, where the law does not give one and contact is the surface's: of what meets a wall with its centre, the
/// size is nothing to the wall.
fn curvature(wall: &Wall, law: &LawSpec) -> Option<Curvature> {
    (law.surface_curvature.is_none() && wall.contact_at == ContactAt::Surface).then(|| wall.shape.curvature())
}

/// Fluent's and OpenFOAM's reflection: restitution of the centre, normal and tangential, spin untouched.
fn reflect(at: &At<WallText>, library: &Library) -> Result<Behavior, LawError> {
    let text = &at.value;
    let restitution = needed(&text.restitution, at, "restitution", "law = \"reflect\"")?;
    let tangential = needed(&text.tangential_restitution, at, "tangential_restitution", "law = \"reflect\"")?;
    let by_angle = |c: &carom::spec::CurveSpec| !matches!(c, carom::spec::CurveSpec::Constant(_));
    let spec = LawSpec {
        normal: Some(
            NormalSpec::Named(if by_angle(&restitution.value) { NormalKind::ByAngle } else { NormalKind::Constant })
                .into(),
        ),
        tangential: Some(
            if by_angle(&tangential.value) { TangentialKind::ByAngle } else { TangentialKind::Constant }.into(),
        ),
        restitution: Some(restitution.clone()),
        tangential_restitution: Some(tangential.clone()),
        ..LawSpec::default()
    };
    Ok(Behavior::Law(vec![spec.compile(library).map_err(|e| e.at(at.span.clone()))?]))
}

/// Spheres of a run slip along their walls.
fn checked(spec: &LawSpec, library: &Library) -> Result<carom::WallLaw, LawError> {
    let law = spec.compile(library)?;
    law.require_friction()?;
    Ok(law)
}

/// One compiled law for all, or one for each injection's material where the law names no sphere.
fn compile(
    text: &WallText,
    name: &str,
    law: &At<LawSpec>,
    injections: &[Injected],
    library: &Library,
) -> Result<Vec<carom::WallLaw>, LawError> {
    let place = |e: LawError| e.at(law.span.clone());
    let spec = &law.value;
    if let Some(sphere) = &spec.sphere {
        for injected in injections {
            if let (MaterialRef::Name(a), Some(MaterialRef::Name(b))) = (&sphere.value, &injected.material)
                && library.get(a).is_ok_and(|a| library.get(b).is_ok_and(|b| a != b))
            {
                let message = format!(
                    "law '{name}' is for spheres of {a}, but {} injects {b} towards wall '{}'",
                    injected.name, text.name.value
                );
                return Err(LawError::new(message)
                    .help("leave sphere out of the law: each injection then brings its own")
                    .at(sphere.span.clone()));
            }
        }
        return Ok(vec![checked(spec, library).map_err(place)?]);
    }
    if spec.surface.is_none() || injections.iter().all(|i| i.material.is_none()) {
        return Ok(vec![checked(spec, library).map_err(place)?]);
    }
    injections
        .iter()
        .map(|i| {
            let sphere = i.material.clone().map(At::from);
            checked(&LawSpec { sphere, ..spec.clone() }, library).map_err(place)
        })
        .collect()
}

/// A bore that a sphere fills up to this has no contact to speak of.
const NEARLY_FILLED: f64 = 1.0 - 1e-5;

/// Walls that leave no room for a sphere between them.
pub(super) fn contradictions(texts: &[At<WallText>], walls: &[Wall], largest: f64) -> Result<(), LawError> {
    let planes = |w: &Wall| match &w.shape {
        Shape::Plane(p) => vec![*p],
        Shape::Room(room) => room.faces().to_vec(),
        Shape::Cylinder(_) | Shape::Mesh(_) => Vec::new(),
    };
    for (i, (a, at)) in walls.iter().zip(texts).enumerate() {
        for b in walls.iter().take(i + 1) {
            for p in planes(a) {
                for q in planes(b) {
                    let facing = dot(p.normal, q.normal) < -1.0 + 1e-12;
                    let gap = p.distance(q.point);
                    let need = a.clearance(0.5 * largest) + b.clearance(0.5 * largest);
                    if facing && gap <= need {
                        let message = if gap <= 0.0 {
                            format!("walls '{}' and '{}' contradict: each lies behind the other", b.name, a.name)
                        } else {
                            format!(
                                "walls '{}' and '{}' are {gap} m apart: no room for a sphere of {largest} m",
                                b.name, a.name
                            )
                        };
                        return Err(wrong(at, message).help("a normal points out of the wall into the fluid"));
                    }
                }
            }
        }
        if let Shape::Cylinder(c) = &a.shape
            && c.inside
            && c.radius * NEARLY_FILLED <= a.clearance(0.5 * largest)
        {
            return Err(wrong(at, format!("wall '{}' is too narrow for a sphere of {largest} m", a.name)));
        }
    }
    Ok(())
}
