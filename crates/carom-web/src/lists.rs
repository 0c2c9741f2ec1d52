//! What the page shows whatever its inputs are: materials with their sources, keys, laws, codes.

use crate::json::{list, number, object, text};
use carom::material::{Library, Material, PropertyKind};
use carom::normal::Loss;
use carom::spec::{Key, NormalKind, TangentialKind};
use carom::validity::CODES;

/// All of it.
pub fn all() -> String {
    let names = |names: &[&str]| list(names.iter().map(|n| text(n)));
    let losses: Vec<&str> = Loss::ALL.iter().map(|l| l.name()).collect();
    object([
        ("version", text(env!("CARGO_PKG_VERSION"))),
        ("materials", list(Library::builtin().iter().map(material))),
        ("keys", list(Key::ALL.iter().map(|k| key(*k)))),
        ("laws", names(NormalKind::NAMES)),
        ("tangential", names(TangentialKind::NAMES)),
        ("losses", names(&losses)),
        (
            "validity",
            list(CODES.iter().map(|(code, bit, meaning)| {
                let bits = number(Some(f64::from(bit.bits())));
                object([("code", text(code)), ("bit", bits), ("words", text(meaning))])
            })),
        ),
        ("energy", list(carom::Energy::default().named().map(|(name, _)| text(name)))),
    ])
}

fn material(material: &Material) -> String {
    let properties = PropertyKind::ALL.iter().filter_map(|kind| {
        let p = material.property(*kind)?;
        let optional = |t: &Option<String>| text(t.as_deref().unwrap_or_default());
        let entry = object([
            ("noun", text(kind.noun())),
            ("unit", text(kind.unit())),
            ("value", number(Some(p.value))),
            ("low", number(p.low)),
            ("high", number(p.high)),
            ("source", optional(&p.source)),
            ("typical", optional(&p.typical)),
            ("note", optional(&p.note)),
        ]);
        Some((kind.symbol(), entry))
    });
    object([
        ("name", text(&material.name)),
        ("aliases", list(material.aliases.iter().map(|a| text(a)))),
        ("has", object(properties)),
    ])
}

fn key(key: Key) -> String {
    let info = key.info();
    object([
        ("name", text(info.name)),
        ("symbol", text(info.symbol)),
        ("unit", text(info.unit)),
        ("meaning", text(info.meaning.trim())),
        ("example", text(info.example)),
        ("default", text(info.default)),
        ("group", text(info.group)),
    ])
}
