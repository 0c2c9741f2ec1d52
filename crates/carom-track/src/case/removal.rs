//! `removal` of a `[[wall]]`: whether the flow takes off again what the wall keeps.

use super::check::{positive, word, wrong};
use super::text::WallText;
use crate::flow::{Flow, Fluid};
use crate::tracker::{Behavior, Reentrainment};
use carom::LawError;
use carom::removal::{self, Mode};
use carom::spec::At;
use carom::units::Speed;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use std::fmt;

/// `true`, `"rolling"`, or a table.
#[derive(Clone, Debug)]
pub(super) struct RemovalText {
    wanted: bool,
    mode: Option<At<String>>,
    friction_velocity: Option<At<Speed>>,
    follow: Option<At<bool>>,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct TableText {
    mode: Option<At<String>>,
    friction_velocity: Option<At<Speed>>,
    follow: Option<At<bool>>,
}

impl<'de> Deserialize<'de> for RemovalText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Form;
        impl<'de> Visitor<'de> for Form {
            type Value = RemovalText;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "true, false, \"rolling\", \"sliding\", \"lifting\" or { mode = \"rolling\", friction_velocity = \"0.5 m/s\", follow = true }",
                )
            }
            fn visit_bool<E: Error>(self, wanted: bool) -> Result<RemovalText, E> {
                Ok(RemovalText { wanted, mode: None, friction_velocity: None, follow: None })
            }
            fn visit_str<E: Error>(self, mode: &str) -> Result<RemovalText, E> {
                Ok(RemovalText {
                    wanted: true,
                    mode: Some(mode.to_owned().into()),
                    friction_velocity: None,
                    follow: None,
                })
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RemovalText, A::Error> {
                let TableText { mode, friction_velocity, follow } =
                    Deserialize::deserialize(MapAccessDeserializer::new(map))?;
                Ok(RemovalText { wanted: true, mode, friction_velocity, follow })
            }
        }
        deserializer.deserialize_any(Form)
    }
}

/// Adds a wall's removal, if it has one, to what happens there.
pub(super) fn with_removal(
    behavior: Behavior,
    text: &WallText,
    flow: &Flow,
    fluid: &Fluid,
    diameter: f64,
) -> Result<Behavior, LawError> {
    let Some(at) = text.removal.as_ref().filter(|r| r.value.wanted) else { return Ok(behavior) };
    let Behavior::Law(laws) = behavior else {
        let message = format!("removal beside law = \"{}\", which holds nothing by adhesion", text.law.value);
        return Err(wrong(at, message).help("it goes with a wall law that captures; leave it out here"));
    };
    let modes = Mode::ALL.map(|m| (m.name(), m));
    let mode = at.value.mode.as_ref().map(|m| word(m, "way to be removed", &modes)).transpose();
    let mode = mode.map_err(|e| e.at(at.span.clone()))?;
    let given = at.value.friction_velocity.as_ref();
    let friction_velocity = given.map(|u| positive(u, "friction_velocity", u.value.0)).transpose()?;
    if friction_velocity.is_none() && !flow.has_friction_velocity() {
        return Err(wrong(at, "removal needs a friction velocity, and this flow knows none").help(
            "a laminar or turbulent channel or pipe does; else give removal = { friction_velocity = \"0.5 m/s\" }",
        ));
    }
    let follow = at.value.follow.as_ref().filter(|f| f.value);
    if let Some(follow) = follow.filter(|_| mode.is_some_and(|m| m != Mode::Rolling)) {
        return Err(wrong(follow, "follow beside a mode that is not rolling")
            .help("spheres are followed as they roll: give mode = \"rolling\" or none"));
    }
    for law in &laws {
        let fluid = removal::Fluid { density: fluid.density, viscosity: fluid.viscosity };
        let held = law.removal(diameter, &fluid).ok().flatten();
        let Some(held) = held else {
            return Err(wrong(at, format!("law '{}' holds no sphere that could be removed", text.law.value))
                .help("a work of adhesion and a stiffness are wanted, from a sphere and a surface, say"));
        };
        if mode == Some(Mode::Sliding) && held.sliding.is_none() {
            return Err(wrong(at, format!("law '{}' has no friction to slide against", text.law.value))
                .help("use a tangential law with friction, or removal = \"rolling\""));
        }
    }
    let slippery = laws.iter().any(|law| law.tangential().friction().is_none_or(|f| f <= 0.0));
    if let Some(follow) = follow.filter(|_| slippery) {
        return Err(wrong(follow, format!("law '{}' has no friction to roll on", text.law.value))
            .help("use a tangential law with friction, or leave follow out"));
    }
    Ok(Behavior::Removal(laws, Reentrainment { mode, friction_velocity, follow: follow.is_some() }))
}
