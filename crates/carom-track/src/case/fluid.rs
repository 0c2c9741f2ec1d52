//! `[fluid]`, and what is doubtful about the spheres' drag in it.

use super::check::{placed, unknown, wrong};
use super::injection::Injected;
use super::text::{FlowText, FluidText};
use crate::dynamics::Dynamics;
use crate::flow::{Flow, Fluid, Gas, GasState, StateError};
use crate::force::{Drag, Slip};
use crate::vector::{norm, sub};
use carom::LawError;
use carom::spec::At;

/// What a liquid is at where no temperature is given, K.
const USUAL_TEMPERATURE: f64 = 297.15;

/// The fluid, air at 24 °C and one atmosphere where nothing else is said, and which gas it is; none of a liquid.
pub(super) fn fluid(text: Option<&At<FluidText>>) -> Result<(Fluid, Option<Gas>), LawError> {
    let Some(at) = text else { return Ok((Fluid::default(), Some(Gas::Air))) };
    if at.value.liquid.as_ref().is_some_and(|l| l.value) {
        return liquid(at).map(|fluid| (fluid, None));
    }
    let text = &at.value;
    let gas = text.gas.as_ref().map_or(Ok(Gas::Air), gas)?;
    let state = GasState {
        gas,
        temperature: text.temperature.as_ref().map(|t| t.value.0),
        pressure: text.pressure.as_ref().map(|p| p.value.0),
        humidity: text.humidity.as_ref().map(|h| h.value.0),
        density: text.density.as_ref().map(|d| d.value.0),
        viscosity: text.viscosity.as_ref().map(|v| v.value.0),
    };
    let mut fluid = state.fluid().map_err(|e| blame(at, e))?;
    if let Some(path) = &text.mean_free_path {
        fluid.mean_free_path = path.value.0;
        fluid.check().map_err(|e| placed(path, e))?;
    }
    Ok((fluid, Some(gas)))
}

/// A flow whose temperatures are those of a gas whose viscosity is known there; of a liquid, they are left out.
pub(super) fn in_its_gas(
    flow: Flow,
    gas: Option<Gas>,
    text: Option<&At<FlowText>>,
    notes: &mut Vec<String>,
) -> Result<Flow, LawError> {
    let (range, otherwise) = match &flow {
        Flow::Table(table) => (table.temperatures(), "if they are not in K, name their unit, as in \"T [degC]\""),
        Flow::Cells(cells) => {
            (cells.temperatures(), "if they are no temperatures, fields = { temperature = \"none\" } leaves them out")
        }
        _ => return Ok(flow),
    };
    let Some([low, high]) = range else { return Ok(flow) };
    let Some(gas) = gas else {
        let Flow::Table(table) = flow else {
            let kind = text.and_then(|t| t.value.kind.span.clone());
            return Err(LawError::new("the result has a temperature, and [fluid] is a liquid")
                .help("the properties of a liquid are those of [fluid] everywhere: fields = { temperature = \"none\" } leaves the field out")
                .at(kind));
        };
        notes.push(
            "the table's temperature is left out: a liquid's properties are those of [fluid] everywhere".to_owned(),
        );
        return Ok(Flow::Table(table.without_gas()));
    };
    let [least, most] = gas.range();
    if low < least || high > most {
        let message = format!("the flow's temperatures are from {low:.2} K to {high:.2} K");
        let help = format!("the viscosity of {} is known from {least} K to {most} K; {otherwise}", gas.name());
        let value = text.map(|t| &t.value);
        let named = value.and_then(|t| t.file.as_ref().or(t.case.as_ref()));
        let span = named.and_then(|f| f.span.clone());
        return Err(LawError::new(message).help(help).at(span));
    }
    Ok(flow)
}

fn gas(text: &At<String>) -> Result<Gas, LawError> {
    Gas::ALL
        .into_iter()
        .find(|gas| gas.name() == text.value)
        .ok_or_else(|| unknown(text, "gas", Gas::ALL.into_iter().map(Gas::name)))
}

/// A liquid is its density and viscosity; what only a gas has is refused.
fn liquid(at: &At<FluidText>) -> Result<Fluid, LawError> {
    let text = &at.value;
    let gaseous = [
        ("pressure", text.pressure.as_ref().map(|a| &a.span)),
        ("humidity", text.humidity.as_ref().map(|a| &a.span)),
        ("gas", text.gas.as_ref().map(|a| &a.span)),
        ("mean_free_path", text.mean_free_path.as_ref().map(|a| &a.span)),
    ];
    for (key, span) in gaseous {
        if let Some(span) = span {
            return Err(LawError::new(format!("{key} of a liquid"))
                .help("a liquid takes density, viscosity and temperature: leave the others or liquid = true out")
                .at(span.clone()));
        }
    }
    let (Some(density), Some(viscosity)) = (&text.density, &text.viscosity) else {
        return Err(wrong(at, "a liquid needs density and viscosity"));
    };
    let temperature = text.temperature.as_ref().map_or(USUAL_TEMPERATURE, |t| t.value.0);
    Fluid::liquid(density.value.0, viscosity.value.0, temperature).map_err(|e| placed(at, e))
}

/// Puts a state's error at the key that it is about.
fn blame(at: &At<FluidText>, error: StateError) -> LawError {
    let text = &at.value;
    let span = match error.about {
        "temperature" => text.temperature.as_ref().map(|a| &a.span),
        "pressure" => text.pressure.as_ref().map(|a| &a.span),
        "humidity" => text.humidity.as_ref().map(|a| &a.span),
        "viscosity" => text.viscosity.as_ref().map(|a| &a.span),
        _ => text.density.as_ref().map(|a| &a.span),
    };
    LawError::new(error.what).help(error.right).at(span.unwrap_or(&at.span).clone())
}

/// Slip factors above this are worth a word where slip is off.
const SLIPS: f64 = 1.02;
/// Speed ratios above this: free-molecular drag grows by S²/5 to first order, so 1 % here; the Mach number is 0.27 in air.
const SPEED_RATIO: f64 = 0.22;
/// Other conventions of the mean free path lie within this.
const CONVENTIONS: f64 = 0.2;
/// Above this pressure a gas may be off the ideal one by more than 1 % (5 % for carbon dioxide), Pa.
const NEAR_IDEAL: f64 = 1e6;
/// What to say of the drag of a case's spheres in its fluid.
pub(super) fn notes(
    text: Option<&At<FluidText>>,
    dynamics: &Dynamics,
    flow: &Flow,
    injections: &[Injected],
) -> Vec<String> {
    let fluid = &dynamics.fluid;
    let state = text.map_or_else(GasState::default, |at| GasState {
        gas: at.value.gas.as_ref().and_then(|g| gas(g).ok()).unwrap_or_default(),
        ..GasState::default()
    });
    let mut notes = Vec::new();
    if dynamics.forces.drag == Drag::None || fluid.mean_free_path <= 0.0 {
        return notes;
    }
    let thermal = state.gas.specific_constant() * fluid.temperature;
    let pressure = fluid.density * thermal;
    if pressure > NEAR_IDEAL {
        notes.push(format!(
            "a gas at {:.0} bar is taken as ideal: its density may be a few per cent off; density and viscosity can be given",
            pressure * 1e-5
        ));
    }
    if let Some(path) = text.and_then(|at| at.value.mean_free_path.as_ref()) {
        let of_state = crate::flow::mean_free_path(fluid.density, fluid.viscosity, thermal);
        if (path.value.0 / of_state - 1.0).abs() > CONVENTIONS {
            notes.push(format!(
                "mean_free_path is {:.3e} m; that of the gas as given is {of_state:.3e} m",
                path.value.0
            ));
        }
    }
    for injected in injections {
        let (mut smallest, mut fastest) = (f64::INFINITY, 0.0f64);
        for start in injected.sample(|x| flow.velocity(x)) {
            smallest = smallest.min(start.diameter);
            fastest = fastest.max(norm(sub(start.velocity, flow.velocity(start.position))));
        }
        let factor = Slip::Davies.factor(smallest, fluid.mean_free_path);
        if dynamics.forces.slip == Slip::None && factor > SLIPS {
            notes.push(format!(
                "slip is none, but the gas slips at spheres as small as those of {}: at {smallest:.3e} m drag is {factor:.3} times too large",
                injected.name
            ));
        }
        let ratio = fastest / (2.0 * thermal).sqrt();
        if ratio > SPEED_RATIO {
            notes.push(format!(
                "{} starts at {fastest:.0} m/s through the gas, {ratio:.2} times its molecules' most probable speed: the drag laws hold for slow spheres (below {SPEED_RATIO}), without compressibility",
                injected.name
            ));
        }
    }
    notes
}
