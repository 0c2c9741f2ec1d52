//! `[[injection]]`.

use super::cells::Openings;
use super::check::{needed, positive, unknown, word, wrong};
use super::files::Files;
use super::text::{InjectionText, PatchText, PlaceText, PlacesText, Si, SizeText, SizesText, VelocityText};
use crate::domain::Wall;
use crate::flow::{Flow, Fluid};
use crate::force::Slip;
use crate::injection::{
    Amount, By, Diameter, Injection, InjectionError, Plan, Sizes, Source, Start, Window, geometric_diameter,
};
use crate::vector::Vec3;
use carom::LawError;
use carom::material::{Library, MaterialRef};
use carom::spec::At;
use std::ops::Range;

/// An injection of a case.
#[derive(Clone, Debug)]
pub struct Injected {
    /// Its name.
    pub name: String,
    /// The spheres' material, if it is given.
    pub material: Option<MaterialRef>,
    /// Ready to make its spheres.
    pub injection: Injection,
    /// Largest diameter to reckon with, m.
    pub largest: f64,
    /// Where its position stands in the case file.
    pub(super) place: Option<Range<usize>>,
}

/// So many starts of an injection are looked at for what is doubtful of all.
const SAMPLE: u64 = 100;

impl Injected {
    /// Its first spheres, in a flow of that velocity, m/s.
    pub(super) fn sample(&self, velocity: impl Fn(Vec3) -> Vec3) -> impl Iterator<Item = crate::injection::Injected> {
        (0..self.injection.count().min(SAMPLE)).map(move |i| self.injection.particle(i, |_, x| velocity(x)))
    }
}

/// Reads one injection.
#[expect(clippy::too_many_arguments, reason = "all that a case's text does not say itself")]
pub(super) fn read(
    at: &At<InjectionText>,
    index: usize,
    seed: u64,
    (fluid, slip): (&Fluid, Slip),
    flow: &Flow,
    openings: &Openings,
    library: &Library,
    files: &Files,
) -> Result<Injected, LawError> {
    let text = &at.value;
    let name = text.name.as_ref().map_or_else(|| format!("injection {}", index + 1), |n| n.value.clone());
    let number = u32::try_from(index).map_err(|_| wrong(at, "too many injections"))?;
    let density = density(at, library)?;
    let diameter = match &text.diameter_kind {
        None => Diameter::Geometric,
        Some(kind) => word(
            kind,
            "kind of diameter",
            &[("geometric", Diameter::Geometric), ("aerodynamic", Diameter::Aerodynamic(slip))],
        )?,
    };
    let (source, place) = start(at, openings, files)?;
    let (sizes, mut largest) = diameters(at, &source)?;
    if let Diameter::Aerodynamic(slip) = diameter {
        largest = geometric_diameter(largest, density, slip, fluid.mean_free_path);
    }
    let start = text.start.as_ref().map_or(0.0, |t| t.value.0);
    let ways = [("uniform", false), ("flux", true)];
    let by_flux = text.distribution.as_ref().map_or(Ok(false), |d| word(d, "distribution", &ways))?;
    let amount = amount(at, &source)?;
    let listed_velocities = has_velocities(&source);
    let plan = Plan {
        source,
        velocity: match text.velocity.as_ref().map(|v| &v.value) {
            Some(VelocityText::Given(v)) => Start::Velocity(*v),
            Some(VelocityText::Fluid) => Start::Fluid,
            None if by_flux || listed_velocities => Start::Fluid,
            None => return Err(wrong(at, "an injection needs velocity").help("a vector, or \"fluid\"")),
        },
        spin: text.spin.as_ref().map_or([0.0; 3], |s| s.value.si()),
        density,
        sizes,
        diameter,
        window: Window { start, stop: text.stop.as_ref().map_or(start, |t| t.value.0) },
        amount,
    };
    if let Some(start) = text.start.as_ref().filter(|s| s.value.0 < 0.0) {
        return Err(wrong(start, format!("start is {} s", start.value.0)).help("a run begins at 0 s"));
    }
    let injection = Injection::new(seed, number, plan, fluid).map_err(|e| blame(at, &e).at(at.span.clone()))?;
    let injection = if by_flux {
        injection.by_flux(flow).map_err(|e| LawError::new(e.to_string()).at(place.clone()))?
    } else {
        injection
    };
    Ok(Injected { name, material: text.material.as_ref().map(|m| m.value.clone()), injection, largest, place })
}

/// What to say where part of an inflow's area lets fluid out.
pub(super) fn outflow(injected: &Injected) -> Option<String> {
    const WORTH_A_WORD: f64 = 0.001;
    let share = injected.injection.outflow().filter(|share| *share > WORTH_A_WORD)?;
    Some(format!(
        "through part of {} fluid flows out, {:.1} % of what flows in: only the inflow carries spheres",
        injected.name,
        100.0 * share
    ))
}

/// The key that an injection's error is about.
fn blame(at: &At<InjectionText>, error: &InjectionError) -> LawError {
    let (InjectionError::Value { name, .. } | InjectionError::Shape { name, .. }) = error;
    let text = &at.value;
    let about = |words: &[&str]| words.iter().any(|w| name.contains(w));
    let span = if about(&["listed"]) {
        text.particles.as_ref().and_then(|a| a.span.clone())
    } else if about(&["start time"]) {
        text.start.as_ref().and_then(|a| a.span.clone())
    } else if about(&["stop time"]) {
        text.stop.as_ref().or(text.start.as_ref()).and_then(|a| a.span.clone())
    } else if about(&["mass", "number of particles"]) {
        let amount = [
            text.count.as_ref().map(|a| &a.span),
            text.mass.as_ref().map(|a| &a.span),
            text.mass_flow.as_ref().map(|a| &a.span),
        ];
        amount.into_iter().flatten().next().cloned().flatten()
    } else if about(&["point", "corner", "box", "disc", "patch", "surface"]) {
        text.position.as_ref().and_then(|a| a.span.clone())
    } else if about(&["velocity"]) {
        text.velocity.as_ref().and_then(|a| a.span.clone())
    } else if about(&["spin"]) {
        text.spin.as_ref().and_then(|a| a.span.clone())
    } else if about(&["density"]) {
        text.density.as_ref().and_then(|a| a.span.clone())
    } else {
        text.diameter.as_ref().and_then(|a| a.span.clone())
    };
    LawError::new(error.to_string()).at(span)
}

fn density(at: &At<InjectionText>, library: &Library) -> Result<f64, LawError> {
    let material =
        at.value.material.as_ref().map(|m| m.value.resolve(library).map_err(|e| e.at(m.span.clone()))).transpose()?;
    if let Some(density) = &at.value.density {
        return positive(density, "density", density.value.0);
    }
    let Some(material) = material else {
        return Err(wrong(at, "an injection needs a material or a density"));
    };
    material
        .density
        .ok_or_else(|| wrong(at, format!("{} has no density in the library", material.name)).help("give density"))
}

/// Where the spheres start, and where the case says so.
fn start(
    at: &At<InjectionText>,
    openings: &Openings,
    files: &Files,
) -> Result<(Source, Option<Range<usize>>), LawError> {
    let text = &at.value;
    match (&text.particles, &text.position) {
        (Some(file), None) => Ok((super::particles::read(file, files)?, file.span.clone())),
        (Some(file), Some(_)) => {
            Err(wrong(file, "both position and particles").help("particles bring their positions along: keep one"))
        }
        (None, _) => {
            let position = needed(&text.position, at, "position", "an injection")?;
            Ok((place(position, openings)?, position.span.clone()))
        }
    }
}

/// The diameters, and the largest to reckon with: the list's own, where every particle of one has its own.
fn diameters(at: &At<InjectionText>, source: &Source) -> Result<(Sizes, f64), LawError> {
    let own = match source {
        Source::Listed(list) => list.iter().try_fold(0.0, |most: f64, one| Some(most.max(one.diameter?))),
        _ => None,
    };
    match (own, &at.value.diameter) {
        (Some(largest), None) => Ok((Sizes::Mono(largest), largest)),
        (Some(_), Some(diameter)) => Err(wrong(diameter, "the particles bring their diameters along")
            .help("leave it out, or leave out their column")),
        (_, text) => sizes(needed(text, at, "diameter", "an injection")?),
    }
}

/// Whether every sphere brings its velocity along.
fn has_velocities(source: &Source) -> bool {
    matches!(source, Source::Listed(list) if list.iter().all(|one| one.velocity.is_some()))
}

fn amount(at: &At<InjectionText>, source: &Source) -> Result<Amount, LawError> {
    let text = &at.value;
    if let Source::Listed(list) = source {
        let given = [
            text.count.as_ref().map(|a| &a.span),
            text.mass.as_ref().map(|a| &a.span),
            text.mass_flow.as_ref().map(|a| &a.span),
            text.parcels.as_ref().map(|a| &a.span),
        ];
        return match given.into_iter().flatten().next() {
            None => Ok(Amount::Count(list.len() as u64)),
            Some(span) => Err(LawError::new("listed particles are as many as there are")
                .help("leave it out; a column weight says how many spheres each stands for")
                .at(span.clone())),
        };
    }
    let parcels = || {
        text.parcels
            .as_ref()
            .map(|p| p.value)
            .ok_or_else(|| wrong(at, "a mass needs a number of parcels to carry it").help("give parcels"))
    };
    match (&text.count, &text.mass, &text.mass_flow) {
        (Some(count), None, None) => match &text.parcels {
            Some(p) => Err(wrong(p, "parcels with a count")
                .help("a count injects single spheres; parcels carry a mass or a mass_flow")),
            None => Ok(Amount::Count(count.value.0)),
        },
        (None, Some(mass), None) => Ok(Amount::Mass { total: mass.value.0, parcels: parcels()?.0 }),
        (None, None, Some(flow)) => Ok(Amount::MassFlow { rate: flow.value.0, parcels: parcels()?.0 }),
        (None, None, None) => Ok(Amount::Count(1)),
        _ => Err(wrong(at, "more than one of count, mass and mass_flow").help("keep one")),
    }
}

/// The distribution, and the largest diameter to reckon with: of an endless tail, five standard deviations.
fn sizes(at: &At<SizeText>) -> Result<(Sizes, f64), LawError> {
    let text: &SizesText = match &at.value {
        SizeText::One(d) => return Ok((Sizes::Mono(positive(at, "diameter", *d)?), *d)),
        SizeText::Distribution(text) => text,
    };
    let kinds = [("number", By::Number), ("mass", By::Mass)];
    let by = |usual| text.by.as_ref().map_or(Ok(usual), |b| word(b, "way to count", &kinds));
    match (&text.lognormal, &text.rosin_rammler, &text.table) {
        (Some(l), None, None) => {
            let sizes = Sizes::Lognormal { median: l.median.0, gsd: l.gsd, by: by(By::Number)? };
            Ok((sizes, l.median.0 * carom::math::powi(l.gsd, 5)))
        }
        (None, Some(r), None) => {
            let sizes =
                Sizes::RosinRammler { mean: r.mean.0, spread: r.spread, min: r.min.0, max: r.max.0, by: by(By::Mass)? };
            Ok((sizes, r.max.0))
        }
        (None, None, Some(t)) => {
            if t.diameter.len() != t.amount.len() {
                let message = format!("{} diameters but {} amounts", t.diameter.len(), t.amount.len());
                return Err(wrong(at, message).help("a table gives one amount for each diameter"));
            }
            let rows: Vec<_> = t.diameter.iter().map(|d| d.0).zip(t.amount.iter().copied()).collect();
            let largest = rows.iter().map(|r| r.0).fold(0.0, f64::max);
            Ok((Sizes::Table { rows, by: by(By::Number)? }, largest))
        }
        _ => Err(wrong(at, "a diameter is one of lognormal, rosin_rammler and table")),
    }
}

fn place(at: &At<PlaceText>, openings: &Openings) -> Result<Source, LawError> {
    let text: &PlacesText = match &at.value {
        PlaceText::Point(p) => return Ok(Source::Point(*p)),
        PlaceText::Place(text) => text,
    };
    let patch = match &text.patch {
        Some(PatchText::Named(name)) if text.room.is_none() && text.disc.is_none() => {
            return openings.find(name).map_err(|e| e.at(at.span.clone()));
        }
        Some(PatchText::Given(patch)) => Some(patch),
        Some(PatchText::Named(_)) | None => None,
    };
    match (&text.room, &text.disc, patch) {
        (Some([a, b]), None, None) => {
            let (a, b) = (a.si(), b.si());
            Ok(Source::Box { low: [0, 1, 2].map(|i| a[i].min(b[i])), high: [0, 1, 2].map(|i| a[i].max(b[i])) })
        }
        (None, Some(d), None) => Ok(Source::Disc { centre: d.center.si(), normal: d.normal, radius: d.radius.0 }),
        (None, None, Some(p)) => Ok(Source::Patch { corner: p.corner.si(), sides: [p.sides[0].si(), p.sides[1].si()] }),
        _ => Err(wrong(at, "a position is a point or one of box, disc and patch")),
    }
}

/// What would be right where spheres of that radius start within a wall: for a disc that reaches too far, how large it may be.
pub(super) fn room(source: &Source, wall: &Wall, reach: f64) -> String {
    const USUAL: &str = "a normal points out of the wall into the fluid; a sphere needs one radius of room";
    let Source::Disc { centre, radius, .. } = source else { return USUAL.to_owned() };
    let gap = |x: [f64; 3]| wall.shape.distance(x) - wall.clearance(reach);
    let least = hull(source).into_iter().map(gap).fold(f64::INFINITY, f64::min);
    // the centre itself must have room: then only the rim reaches too far
    if gap(*centre) > 0.0 && radius + least > 0.0 {
        let most = (radius + least) * (1.0 - 1e-6);
        let by = radius - most;
        return format!(
            "the disc's rim is too near the wall for spheres of {} m: a radius of {most:.6e} m, smaller by {by:.2e} m, leaves them room",
            2.0 * reach
        );
    }
    USUAL.to_owned()
}

/// Points whose convex hull holds every start.
pub(super) fn hull(source: &Source) -> Vec<[f64; 3]> {
    use crate::vector::{add, frame, scale, unit};
    match source {
        Source::Point(p) => vec![*p],
        Source::Box { low, high } => {
            (0..8).map(|i| [0, 1, 2].map(|c| if i >> c & 1 == 0 { low[c] } else { high[c] })).collect()
        }
        Source::Disc { centre, normal, radius } => {
            let (t, b) = frame(unit(*normal).unwrap_or([0.0, 1.0, 0.0]));
            // a square around the disc would reach further than it does: points on its rim, close together
            (0..360)
                .map(|i| {
                    let (s, c) = carom::math::sin_cos(f64::from(i).to_radians());
                    add(*centre, add(scale(t, radius * c), scale(b, radius * s)))
                })
                .collect()
        }
        Source::Patch { corner, sides } => {
            vec![*corner, add(*corner, sides[0]), add(*corner, sides[1]), add(*corner, add(sides[0], sides[1]))]
        }
        Source::Triangles(triangles) | Source::Opening { triangles, .. } => {
            triangles.iter().flatten().copied().collect()
        }
        // of many, the first few: a start inside a wall is found when its turn comes
        Source::Listed(list) => list.iter().take(1000).map(|one| one.position).collect(),
    }
}

/// A name that no other has.
pub(super) fn distinct<'a>(names: impl Iterator<Item = &'a At<String>>, what: &str) -> Result<(), LawError> {
    let mut seen: Vec<&str> = Vec::new();
    for name in names {
        if seen.contains(&name.value.as_str()) {
            return Err(wrong(name, format!("two {what}s are called '{}'", name.value))
                .help("results are given by name: use another"));
        }
        if name.value.trim().is_empty() {
            return Err(wrong(name, format!("a {what} without a name")));
        }
        seen.push(&name.value);
    }
    Ok(())
}

/// The law a wall names, or the words that are no law.
pub(super) fn no_such_law<'a>(text: &At<String>, laws: impl Iterator<Item = &'a String>) -> LawError {
    let words = super::wall::WORDS.iter().copied();
    unknown(text, "wall law", laws.map(String::as_str).chain(words))
}
