//! `[flow]` and `[forces]`.

use super::check::{needed, placed, unknown, word, wrong};
use super::files::Files;
use super::text::{FlowText, ForcesText, Si, WallDragText, WallText};
use crate::dynamics::Dynamics;
use crate::flow::{Channel, Flow, Fluid, Gas, Named, Pipe, Profile, RoundJet, SlotJet, Stagnation, Symmetry, Table};
use crate::force::{Drag, Forces, Life, Model, NearWall, RandomWalk, Slip, Thermophoresis, WallDrag};
use carom::LawError;
use carom::spec::At;
use carom::units::TemperatureGradient;
use carom_table::quoted;

const KINDS: [&str; 11] = [
    "still",
    "uniform",
    "channel",
    "pipe",
    "stagnation",
    "slot-jet",
    "round-jet",
    "table",
    "openfoam",
    "vtk",
    "fluent",
];
const COLUMNS: [&str; 11] = ["x", "y", "z", "u", "v", "w", "k", "epsilon", "omega", "T", "rho"];
const PROFILES: [(&str, Profile); 3] =
    [("plug", Profile::Plug), ("laminar", Profile::Laminar), ("turbulent", Profile::Turbulent)];

/// The flow; still where none is given. Files are looked for beside the case.
pub(super) fn flow(
    text: Option<&At<FlowText>>,
    walls: &[At<WallText>],
    fluid: &Fluid,
    files: &Files,
    notes: &mut Vec<String>,
) -> Result<Flow, LawError> {
    let Some(text) = text else { return Ok(Flow::Still) };
    let kind = text.kind.value.as_str();
    refuse_others(text, kind)?;
    let whose = format!("a {kind} flow");
    let profile = || word(needed(&text.profile, text, "profile", &whose)?, "profile", &PROFILES);
    let mean_speed = || needed(&text.mean_speed, text, "mean_speed", &whose).map(|s| s.value.0);
    Ok(match kind {
        "still" => Flow::Still,
        "uniform" => Flow::Uniform { velocity: needed(&text.velocity, text, "velocity", &whose)?.value.si() },
        "channel" => {
            let height = needed(&text.height, text, "height", &whose)?;
            Flow::Channel(Channel::new(profile()?, height.value.0, mean_speed()?, fluid).map_err(|e| placed(text, e))?)
        }
        "pipe" => {
            let point = needed(&text.point, text, "point", &whose)?.value.si();
            let axis = needed(&text.axis, text, "axis", &whose)?.value;
            let radius = needed(&text.radius, text, "radius", &whose)?.value.0;
            Flow::Pipe(Pipe::new(profile()?, point, axis, radius, mean_speed()?, fluid).map_err(|e| placed(text, e))?)
        }
        "stagnation" => {
            let point = needed(&text.point, text, "point", &whose)?.value.si();
            let normal = needed(&text.normal, text, "normal", &whose)?.value;
            let rate = needed(&text.strain_rate, text, "strain_rate", &whose)?.value.0;
            let symmetry = text.line.as_ref().map_or(Symmetry::Axisymmetric, |l| Symmetry::Plane { line: l.value });
            Flow::Stagnation(Stagnation::new(symmetry, point, normal, rate).map_err(|e| placed(text, e))?)
        }
        "slot-jet" => {
            let width = needed(&text.width, text, "width", &whose)?.value.0;
            let speed = needed(&text.speed, text, "speed", &whose)?.value.0;
            Flow::SlotJet(SlotJet::new(width, speed).map_err(|e| placed(text, e))?)
        }
        "round-jet" => {
            let diameter = needed(&text.diameter, text, "diameter", &whose)?.value.0;
            let speed = needed(&text.speed, text, "speed", &whose)?.value.0;
            Flow::RoundJet(RoundJet::new(diameter, speed).map_err(|e| placed(text, e))?)
        }
        "table" => {
            let file = needed(&text.file, text, "file", &whose)?;
            let failed = |e: &dyn std::fmt::Display| placed(file, format!("{}: {e}", file.value));
            let bytes = files.read(&file.value).map_err(|e| failed(&e))?;
            let named = named(text.columns.as_ref())?;
            Flow::Table(Table::from_named(&file.value, &bytes, &named).map_err(|e| failed(&e))?)
        }
        "openfoam" | "vtk" | "fluent" => Flow::Cells(super::cells::read(text, walls, files, notes)?),
        _ => return Err(unknown(&text.kind, "kind of flow", KINDS.into_iter())),
    })
}

/// The columns of a table as the case names them.
fn named(text: Option<&At<Named>>) -> Result<Named, LawError> {
    let Some(at) = text else { return Ok(Named::new()) };
    match at.value.keys().find(|key| !COLUMNS.contains(&key.as_str())) {
        Some(key) => Err(wrong(at, format!("columns has no {}", quoted(key)))
            .help(format!("it names the columns of {}", COLUMNS.join(", ")))),
        None => Ok(at.value.clone()),
    }
}

/// A key that this kind of flow does not have is a mistake, not a decoration.
fn refuse_others(text: &At<FlowText>, kind: &str) -> Result<(), LawError> {
    let given = [
        ("velocity", text.velocity.as_ref().map(|a| a.span.clone())),
        ("profile", text.profile.as_ref().map(|a| a.span.clone())),
        ("height", text.height.as_ref().map(|a| a.span.clone())),
        ("mean_speed", text.mean_speed.as_ref().map(|a| a.span.clone())),
        ("point", text.point.as_ref().map(|a| a.span.clone())),
        ("axis", text.axis.as_ref().map(|a| a.span.clone())),
        ("radius", text.radius.as_ref().map(|a| a.span.clone())),
        ("normal", text.normal.as_ref().map(|a| a.span.clone())),
        ("line", text.line.as_ref().map(|a| a.span.clone())),
        ("strain_rate", text.strain_rate.as_ref().map(|a| a.span.clone())),
        ("width", text.width.as_ref().map(|a| a.span.clone())),
        ("diameter", text.diameter.as_ref().map(|a| a.span.clone())),
        ("speed", text.speed.as_ref().map(|a| a.span.clone())),
        ("file", text.file.as_ref().map(|a| a.span.clone())),
        ("columns", text.columns.as_ref().map(|a| a.span.clone())),
        ("case", text.case.as_ref().map(|a| a.span.clone())),
        ("time", text.time.as_ref().map(|a| a.span.clone())),
        ("fields", text.fields.as_ref().map(|a| a.span.clone())),
        ("patches", text.patches.as_ref().map(|a| a.span.clone())),
        ("axisymmetric", text.axisymmetric.as_ref().map(|a| a.span.clone())),
    ];
    let keys: &[&str] = match kind {
        "still" => &[],
        "uniform" => &["velocity"],
        "channel" => &["profile", "height", "mean_speed"],
        "pipe" => &["profile", "point", "axis", "radius", "mean_speed"],
        "stagnation" => &["point", "normal", "strain_rate", "line"],
        "slot-jet" => &["width", "speed"],
        "round-jet" => &["diameter", "speed"],
        "table" => &["file", "columns"],
        "openfoam" => &["case", "time", "fields"],
        "vtk" => &["file", "fields", "patches", "axisymmetric"],
        "fluent" => &["file", "fields", "axisymmetric"],
        _ => return Ok(()),
    };
    for (key, span) in given {
        if let Some(span) = span.filter(|_| !keys.contains(&key)) {
            let right = if keys.is_empty() {
                "it has no keys besides kind".to_owned()
            } else {
                format!("its keys are {}", keys.join(", "))
            };
            return Err(LawError::new(format!(
                "{} {kind} flow has no {key}",
                if kind.starts_with("open") { "an" } else { "a" }
            ))
            .help(right)
            .at(span));
        }
    }
    Ok(())
}

/// The forces; without the table, Schiller–Naumann drag, Davies' slip in a gas and no gravity.
pub(super) fn dynamics(
    text: &ForcesText,
    (fluid, gas): (Fluid, Option<Gas>),
    gradient: Option<&At<[TemperatureGradient; 3]>>,
    varies: bool,
) -> Result<Dynamics, LawError> {
    let liquid = gas.is_none();
    const DRAGS: [(&str, Drag); 5] = [
        ("none", Drag::None),
        ("stokes", Drag::Stokes),
        ("schiller-naumann", Drag::SchillerNaumann),
        ("putnam", Drag::Putnam),
        ("morsi-alexander", Drag::MorsiAlexander),
    ];
    let drag = text.drag.as_ref().map_or(Ok(Drag::SchillerNaumann), |d| word(d, "drag law", &DRAGS))?;
    let usual = if liquid { Slip::None } else { Slip::Davies };
    let slip = text.slip.as_ref().map_or(Ok(usual), |s| word(s, "slip correction", &SLIPS))?;
    if let Some(s) = text.slip.as_ref().filter(|_| liquid && slip != Slip::None) {
        return Err(wrong(s, "slip in a liquid")
            .help("only a gas slips at small spheres: leave it out, or leave out liquid = true"));
    }
    let forces = Forces {
        gravity: text.gravity.as_ref().map_or([0.0; 3], |g| g.value.si()),
        // a vacuum buoys nothing
        buoyancy: text.buoyancy.unwrap_or(drag != Drag::None),
        drag,
        slip,
        saffman: text.saffman.unwrap_or(false),
        magnus: text.magnus.unwrap_or(false),
        rotational_drag: text.rotational_drag.unwrap_or(false),
        pressure_gradient: text.pressure_gradient.unwrap_or(false),
        added_mass: text.added_mass.unwrap_or(false),
        thermophoresis: thermophoresis(text, liquid, gradient, varies)?,
        wall_drag: wall_drag(text, drag)?,
    };
    let brownian = text.brownian.as_ref().is_some_and(|b| b.value);
    if let Some(b) = text.brownian.as_ref().filter(|_| brownian && drag == Drag::None) {
        return Err(wrong(b, "Brownian motion without drag").help("the molecules that kick also drag: give a drag law"));
    }
    if let Some(b) = text.brownian.as_ref().filter(|_| brownian && varies) {
        return Err(wrong(b, "Brownian motion in a gas whose temperature or density the flow gives")
            .help("kicks are known of an even gas alone: switch brownian off, or leave T and rho out of the flow"));
    }
    Ok(Dynamics { fluid, gas, forces, random_walk: random_walk(text)?, brownian })
}

fn thermophoresis(
    text: &ForcesText,
    liquid: bool,
    gradient: Option<&At<[TemperatureGradient; 3]>>,
    varies: bool,
) -> Result<Option<Thermophoresis>, LawError> {
    let (text, gradient) = match (&text.thermophoresis, gradient) {
        (_, Some(gradient)) if varies => {
            return Err(wrong(
                gradient,
                "two temperature gradients: the flow gives the temperature, and so its gradient",
            )
            .help("leave temperature_gradient out, or the temperature out of the flow"));
        }
        (Some(text), Some(gradient)) => (text, Some(gradient)),
        (None, None) => return Ok(None),
        (Some(text), None) if varies => (text, None),
        (Some(text), None) => {
            return Err(wrong(text, "thermophoresis without a temperature gradient").help(
                "give temperature_gradient = [\"0 K/m\", \"1e4 K/m\", \"0 K/m\"] in [fluid], or a flow with its temperature",
            ));
        }
        (None, Some(gradient)) => {
            return Err(wrong(gradient, "temperature_gradient acts on nothing")
                .help("give thermophoresis = { thermal_conductivity = \"0.2 W/m/K\" } in [forces]"));
        }
    };
    if liquid {
        return Err(wrong(text, "thermophoresis in a liquid").help("its law is known of gases alone"));
    }
    let conductivity = &text.value.thermal_conductivity;
    let conductivity = super::check::positive(conductivity, "thermal_conductivity", conductivity.value.0)?;
    let si = gradient.map_or([0.0; 3], |g| g.value.si());
    if let Some(at) = gradient.filter(|_| !si.iter().all(|c| c.is_finite())) {
        return Err(wrong(at, format!("temperature_gradient is {si:?} K/m")).help("it must be finite"));
    }
    Ok(Some(Thermophoresis { conductivity, gradient: si }))
}

fn wall_drag(text: &ForcesText, drag: Drag) -> Result<Option<WallDrag>, LawError> {
    let Some(at) = &text.wall_drag else { return Ok(None) };
    let least_gap = match &at.value {
        WallDragText::Switch(false) => return Ok(None),
        WallDragText::Switch(true) => None,
        WallDragText::Gap(text) => Some(super::check::positive(at, "least_gap", text.least_gap.0)?),
    };
    if drag == Drag::None {
        return Err(wrong(at, "wall_drag without drag").help("it multiplies the drag: give a drag law"));
    }
    if text.brownian.as_ref().is_some_and(|b| b.value) {
        return Err(wrong(at, "wall_drag with brownian")
            .help("the kicks know nothing of walls, so the two would not balance: switch one of them off"));
    }
    Ok(Some(WallDrag { least_gap }))
}

pub(super) const SLIPS: [(&str, Slip); 3] =
    [("none", Slip::None), ("davies", Slip::Davies), ("allen-raabe", Slip::AllenRaabe)];

fn random_walk(text: &ForcesText) -> Result<Option<RandomWalk>, LawError> {
    const MODELS: [(&str, Model); 2] = [("eddies", Model::Eddies), ("langevin", Model::Langevin)];
    const WALLS: [(&str, NearWall); 4] = [
        ("isotropic", NearWall::Isotropic),
        ("wang-james", NearWall::WangJames),
        ("kallio-reeks", NearWall::KallioReeks),
        ("dns", NearWall::Dns),
    ];
    const LIVES: [(&str, Life); 2] = [("constant", Life::Constant), ("random", Life::Random)];
    let Some(text) = &text.random_walk else { return Ok(None) };
    let model = text.model.as_ref().map_or(Ok(Model::Eddies), |m| word(m, "random walk", &MODELS))?;
    let mut walk = if model == Model::Langevin { RandomWalk::langevin() } else { RandomWalk::default() };
    if let Some(near_wall) = &text.near_wall {
        walk.near_wall = word(near_wall, "near-wall correction", &WALLS)?;
    }
    if let Some(life) = &text.life {
        if model == Model::Langevin {
            return Err(wrong(life, "a Langevin walk has no eddies and so no life").help("leave it out"));
        }
        walk.life = word(life, "eddy life", &LIVES)?;
    }
    if let Some(drift) = text.drift {
        walk.drift = drift;
    }
    if let Some(scale) = &text.time_scale {
        walk.time_scale = super::check::positive(scale, "time_scale", scale.value.0)?;
    }
    Ok(Some(walk))
}
