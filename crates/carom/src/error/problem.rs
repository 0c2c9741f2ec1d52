//! What can be wrong, as data, and its words.

use super::wording::Wording;
use super::{ErrorKind, nearest};
use crate::material::PropertyKind;
use crate::normal::Loss;
use crate::spec::{Choice, Key, NormalKind, TangentialKind};
use crate::units::UnitError;
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::string::ToString;
use alloc::vec::Vec;

/// One mistake with its data. What words need beyond kind, key and value stands here too.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Problem {
    /// In a reader's own words.
    Text {
        message: String,
        help: Option<String>,
    },
    UnknownKey {
        what: &'static str,
        key: String,
        known: Vec<&'static str>,
    },
    UnknownName {
        what: &'static str,
        name: String,
        known: Vec<String>,
    },
    /// A loss where the name of a law is wanted.
    LossAlone {
        loss: Loss,
    },
    UnknownMaterial {
        name: String,
        near: Option<String>,
    },
    /// `reader` needs it.
    MissingKey {
        key: Key,
        reader: Option<Choice>,
    },
    MissingMaterial {
        sphere: bool,
        surface: bool,
        reader: Option<Choice>,
    },
    MissingProperty {
        material: String,
        property: PropertyKind,
        instead: Option<Key>,
    },
    /// One of two materials must have it.
    MissingInBoth {
        sphere: String,
        surface: String,
        properties: [PropertyKind; 2],
        instead: Key,
    },
    OutOfRange {
        key: String,
        value: String,
        unit: &'static str,
        right: String,
    },
    /// A nominal value outside its own printed range.
    OutsideItsRange {
        key: &'static str,
        value: f64,
        low: f64,
        high: f64,
    },
    /// A curve's form or values.
    Curve {
        key: Key,
        message: String,
        help: Option<String>,
    },
    WrongUnit {
        key: String,
        error: UnitError,
    },
    WrongType {
        key: String,
        found: &'static str,
        wanted: String,
    },
    /// The law does not read `key`; `beside` is what it has in place of a reader.
    IdleKey {
        key: Key,
        beside: Option<Choice>,
        readers: Vec<Choice>,
    },
    /// Either key says what the other says.
    OneOf {
        given: Key,
        other: Key,
    },
    GivenTwice {
        what: &'static str,
        key: String,
    },
    LossesOverlap {
        first: Loss,
        second: Loss,
    },
    NoLosses,
    /// A number for `by-angle`, or a curve for `constant`.
    CurveForm {
        law: Key,
        curve: Key,
        reader: Choice,
    },
}

impl Problem {
    pub fn kind(&self) -> ErrorKind {
        use ErrorKind as K;
        match self {
            Self::Text { .. } => K::Text,
            Self::UnknownKey { .. } => K::UnknownKey,
            Self::UnknownName { .. } | Self::LossAlone { .. } => K::UnknownName,
            Self::UnknownMaterial { .. } => K::UnknownMaterial,
            Self::MissingKey { .. } => K::MissingKey,
            Self::MissingMaterial { .. } => K::MissingMaterial,
            Self::MissingProperty { .. } | Self::MissingInBoth { .. } => K::MissingProperty,
            Self::OutOfRange { .. } | Self::OutsideItsRange { .. } | Self::Curve { .. } | Self::NoLosses => {
                K::OutOfRange
            }
            Self::WrongUnit { .. } => K::WrongUnit,
            Self::WrongType { .. } => K::WrongType,
            Self::IdleKey { .. } => K::IdleKey,
            Self::OneOf { .. } | Self::GivenTwice { .. } | Self::LossesOverlap { .. } | Self::CurveForm { .. } => {
                K::Conflict
            }
        }
    }

    pub fn key(&self) -> Option<&str> {
        match self {
            Self::UnknownKey { key, .. }
            | Self::OutOfRange { key, .. }
            | Self::WrongUnit { key, .. }
            | Self::WrongType { key, .. }
            | Self::GivenTwice { key, .. } => Some(key),
            Self::MissingKey { key, .. } | Self::IdleKey { key, .. } => Some(key.name()),
            Self::OneOf { given, .. } => Some(given.name()),
            Self::MissingMaterial { sphere: true, .. } => Some(Key::Sphere.name()),
            Self::MissingMaterial { .. } => Some(Key::Surface.name()),
            Self::MissingProperty { property, .. } | Self::MissingInBoth { properties: [property, _], .. } => {
                Some(property.key())
            }
            Self::OutsideItsRange { key, .. } => Some(key),
            Self::Curve { key, .. } => Some(key.name()),
            Self::CurveForm { law, .. } => Some(law.name()),
            Self::LossAlone { .. } | Self::LossesOverlap { .. } | Self::NoLosses => Some(Key::Normal.name()),
            Self::Text { .. } | Self::UnknownName { .. } | Self::UnknownMaterial { .. } => None,
        }
    }

    pub fn value(&self) -> Option<&str> {
        match self {
            Self::UnknownName { name, .. } | Self::UnknownMaterial { name, .. } => Some(name),
            Self::LossAlone { loss } => Some(loss.name()),
            Self::OutOfRange { value, .. } => Some(value),
            Self::WrongUnit { error, .. } => Some(&error.text),
            _ => None,
        }
    }

    /// The key whose place in a text is the error's.
    pub fn blames(&self) -> Option<Key> {
        match self {
            Self::MissingKey { reader, .. } | Self::MissingMaterial { reader, .. } => reader.map(Choice::key),
            Self::MissingProperty { .. } | Self::MissingInBoth { .. } => None,
            Self::CurveForm { curve, .. } => Some(*curve),
            Self::OneOf { given, .. } => Some(*given),
            other => other.key().and_then(Key::by_name),
        }
    }

    pub fn message(&self, words: &dyn Wording) -> String {
        match self {
            Self::Text { message, .. } | Self::Curve { message, .. } => message.clone(),
            Self::UnknownKey { what, key, .. } => format!("unknown {what} '{key}'"),
            Self::UnknownName { what: "law", name, .. } => format!("no law '{name}'"),
            Self::UnknownName { what, name, .. } => format!("unknown {what} '{name}'"),
            Self::LossAlone { loss } => format!("'{}' is a loss, not a law", loss.name()),
            Self::UnknownMaterial { name, .. } => format!("unknown material '{name}'"),
            Self::MissingKey { key: Key::Friction, .. } => {
                "the law needs a friction coefficient for impacts that slip along the wall".to_owned()
            }
            Self::MissingKey { key, reader } => format!("{} needs {}", reading(*reader, words), key.noun()),
            Self::MissingMaterial { sphere, surface, reader } => {
                let what = match (sphere, surface) {
                    (true, true) => "a sphere and a surface",
                    (true, false) => "a sphere",
                    _ => "a surface",
                };
                format!("{} needs {what}", reading(*reader, words))
            }
            Self::MissingProperty { material, property, .. } => format!("{material} has no {}", property.noun()),
            Self::MissingInBoth { sphere, surface, properties: [a, b], .. } => {
                format!("neither {sphere} nor {surface} has a {} or a {}", a.noun(), b.noun())
            }
            Self::OutOfRange { key, value, unit, .. } => {
                let space = if unit.is_empty() { "" } else { " " };
                format!("{}{space}{unit} is out of range", words.setting(key, value))
            }
            Self::OutsideItsRange { key, value, low, high } => {
                format!("{key}: {value} is outside its range {low} to {high}")
            }
            Self::WrongUnit { error, .. } => error.to_string(),
            Self::WrongType { key, found, wanted } => format!("{}: {found}; {wanted} is wanted", words.key(key)),
            Self::IdleKey { key, readers, beside } => match (readers.as_slice(), beside) {
                ([Choice::Given(other)], _) => {
                    format!("{} has no effect without {}", words.key(key.name()), words.key(other.name()))
                }
                (_, Some(choice)) => format!("{} has no effect with {}", words.key(key.name()), choice.setting(words)),
                _ => format!("{} has no effect on this law", words.key(key.name())),
            },
            Self::OneOf { given, other } => {
                format!("both {} and {}", words.key(other.name()), words.key(given.name()))
            }
            Self::GivenTwice { what, key } => format!("the {what} '{key}' is given twice"),
            Self::LossesOverlap { first, second } if first == second => {
                format!("'{}' twice: the same energy would be counted twice", first.name())
            }
            Self::LossesOverlap { first, second } => {
                format!("both '{}' and '{}': the same energy would be counted twice", first.name(), second.name())
            }
            Self::NoLosses => "an empty list of losses".to_owned(),
            Self::CurveForm { reader, .. } => format!("{} does not fit its restitution", reader.setting(words)),
        }
    }

    pub fn help(&self, words: &dyn Wording) -> Option<String> {
        Some(match self {
            Self::Text { help, .. } | Self::Curve { help, .. } => return help.clone(),
            Self::UnknownKey { key, known, .. } => {
                format!("{}known are {}", meant(nearest(key, known.iter().copied())), known.join(", "))
            }
            Self::UnknownName { name, known, .. } => {
                format!("{}known are {}", meant(nearest(name, known.iter().map(String::as_str))), known.join(", "))
            }
            Self::LossAlone { loss } => format!("a list of losses is a law: {}", words.loss(loss.name())),
            Self::UnknownMaterial { near, .. } => {
                let list = words.materials().map_or(String::new(), |m| format!("{m}; "));
                format!("{}{list}properties may be given in place as rho=...,E=...,nu=...", meant(near.as_deref()))
            }
            Self::MissingKey { key, .. } => format!("give {}", words.setting(key.name(), key.example())),
            Self::MissingMaterial { sphere, surface, .. } => {
                let bodies: Vec<String> = [(*sphere, Key::Sphere), (*surface, Key::Surface)]
                    .into_iter()
                    .filter(|(missing, _)| *missing)
                    .map(|(_, key)| words.key(key.name()))
                    .collect();
                let its = if bodies.len() > 1 { "their" } else { "its" };
                format!("give {}, by name or with {its} properties", bodies.join(" and "))
            }
            Self::MissingProperty { property, instead, .. } => {
                let own = format!("give its {} ({})", property.key(), property.symbol());
                match instead {
                    Some(key) => format!("{own}, or the pair's {}", words.key(key.name())),
                    None => own,
                }
            }
            Self::MissingInBoth { properties, instead, .. } => {
                let [a, b] = properties.map(|p| format!("{} ({})", p.key(), p.symbol()));
                format!("give {a} or {b} of the softer one, or the pair's {}", words.key(instead.name()))
            }
            Self::OutOfRange { right, .. } => right.clone(),
            Self::OutsideItsRange { .. } => "the nominal value lies between both ends".to_owned(),
            Self::WrongUnit { .. } | Self::WrongType { .. } => return None,
            Self::IdleKey { readers, .. } => match readers.as_slice() {
                [] => "leave it out".to_owned(),
                [Choice::Given(other)] => {
                    format!("give {}, or leave it out", words.setting(other.name(), other.example()))
                }
                readers => format!("leave it out; it is read with {}", read_with(readers, words)),
            },
            Self::OneOf { .. } => "each says what the other says: keep one".to_owned(),
            Self::GivenTwice { .. } => "keep one of them".to_owned(),
            Self::LossesOverlap { first, .. } => format!("keep one {}", first.kind()),
            Self::NoLosses => format!(
                "for a lossless wall give {} and {}",
                words.setting(Key::Normal.name(), "constant"),
                words.setting(Key::Restitution.name(), "1")
            ),
            Self::CurveForm { law, reader: Choice::Normal(NormalKind::ByAngle), .. }
            | Self::CurveForm { law, reader: Choice::Tangential(TangentialKind::ByAngle), .. } => {
                format!("a number needs {}", words.setting(law.name(), "constant"))
            }
            Self::CurveForm { law, .. } => format!("a curve needs {}", words.setting(law.name(), "by-angle")),
        })
    }
}

/// What needs something.
fn reading(reader: Option<Choice>, words: &dyn Wording) -> String {
    reader.map_or_else(|| "the law".to_owned(), |r| r.setting(words))
}

fn meant(near: Option<&str>) -> String {
    near.map_or(String::new(), |n| format!("did you mean {n}? "))
}

/// `normal = "ea" or "eap", or with the loss adhesion-work`
pub(crate) fn read_with(readers: &[Choice], words: &dyn Wording) -> String {
    let (losses, others): (Vec<Choice>, Vec<Choice>) = readers.iter().partition(|r| matches!(r, Choice::Loss(_)));
    let mut groups: Vec<String> = Vec::new();
    for group in others.chunk_by(|a, b| a.key() == b.key()) {
        if let [first, rest @ ..] = group {
            let rest = rest.iter().map(|r| words.value(r.name()));
            groups.push(either(&core::iter::once(first.setting(words)).chain(rest).collect::<Vec<_>>()));
        }
    }
    if !losses.is_empty() {
        let names: Vec<String> = losses.iter().map(|l| l.name().to_owned()).collect();
        groups.push(format!("the loss {}", either(&names)));
    }
    groups.join(", or with ")
}

/// `a, b or c`
fn either(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} or {last}", rest.join(", ")),
    }
}
