//! Materials by name and alias.

use super::Material;
use crate::error::{LawError, Problem, nearest, nearest_within};
use alloc::borrow::ToOwned;
use alloc::collections::BTreeMap;
use alloc::string::String;

/// The embedded files of the crate's `data/materials`; a test keeps this list complete.
#[cfg(feature = "toml")]
pub(super) const EMBEDDED: &[(&str, &str)] = &[
    ("glasses.toml", include_str!("../../data/materials/glasses.toml")),
    ("kim-dunn-2007.toml", include_str!("../../data/materials/kim-dunn-2007.toml")),
    ("metals.toml", include_str!("../../data/materials/metals.toml")),
    ("polymers.toml", include_str!("../../data/materials/polymers.toml")),
    ("powders.toml", include_str!("../../data/materials/powders.toml")),
];

/// Words for a material of the library that are too loose to stand for it: they are suggested.
const SYNONYMS: [(&str, &str); 16] = [
    ("sand", "quartz"),
    ("silica", "fused-silica"),
    ("silica-glass", "fused-silica"),
    ("silicon-dioxide", "quartz"),
    ("sio2", "quartz"),
    ("corundum", "aluminium-oxide"),
    ("table-salt", "sodium-chloride"),
    ("rock-salt", "sodium-chloride"),
    ("plexiglass", "pmma"),
    ("perspex", "pmma"),
    ("polymethyl-methacrylate", "pmma"),
    ("psl", "polystyrene"),
    ("latex", "polystyrene"),
    ("pe", "polyethylene"),
    ("ldpe", "polyethylene"),
    ("316l", "stainless-steel-316"),
];

/// A set of materials. Names and aliases are matched without regard to case; `_` and a space count as `-`.
#[derive(Clone, Debug, Default)]
pub struct Library {
    materials: BTreeMap<String, Material>,
    aliases: BTreeMap<String, String>,
    /// What an embedded file was refused for: none in a build that passed its tests.
    unread: Option<String>,
}

fn key(name: &str) -> String {
    name.trim().to_lowercase().replace(['_', ' '], "-")
}

impl Library {
    /// The materials that come with carom, each value with its source (see `docs/materials.md`), read once per process.
    ///
    /// Clone it to add materials to it.
    #[cfg(feature = "toml")]
    pub fn builtin() -> &'static Self {
        static BUILTIN: std::sync::LazyLock<Library> = std::sync::LazyLock::new(|| Library::embedded(EMBEDDED));
        &BUILTIN
    }

    /// A library of embedded files. One that cannot be read is not passed over: [`Library::get`] reports it for every
    /// name that is missing.
    #[cfg(feature = "toml")]
    pub(super) fn embedded(files: &[(&str, &str)]) -> Self {
        let mut library = Self::default();
        for (name, text) in files {
            if let Err(e) = library.extend_from_toml(text) {
                library.unread.get_or_insert_with(|| e.located(name, text));
            }
        }
        library
    }

    /// Adds the `[material.NAME]` tables of a TOML text; a name already there is replaced.
    ///
    /// # Errors
    /// What is wrong in the text, with its place.
    #[cfg(feature = "toml")]
    pub fn extend_from_toml(&mut self, text: &str) -> Result<(), LawError> {
        use crate::spec::{Value, document};
        for (key, at) in document(text)? {
            if key.value != "material" {
                let unknown = Problem::UnknownKey { what: "key", key: key.value, known: vec!["material"] };
                return Err(LawError::from(unknown).at(key.span));
            }
            let wanted = "tables [material.NAME]";
            let Value::Table(materials) = &at.value else { return Err(at.value.unfit("material", wanted).at(at.span)) };
            for (name, at) in materials {
                let Value::Table(entries) = &at.value else {
                    return Err(at.value.unfit(&name.value, wanted).at(at.span.clone()));
                };
                let material = Material::from_entries(&name.value, entries);
                self.insert(material.map_err(|e| e.at(at.span.clone()))?);
            }
        }
        Ok(())
    }

    /// Adds one material under its name and aliases.
    pub fn insert(&mut self, material: Material) {
        let name = key(&material.name);
        for alias in &material.aliases {
            self.aliases.insert(key(alias), name.clone());
        }
        self.aliases.remove(&name);
        self.materials.insert(name, material);
    }

    /// The material of that name or alias.
    ///
    /// # Errors
    /// An unknown name, with the nearest known one.
    pub fn get(&self, name: &str) -> Result<&Material, LawError> {
        let wanted = key(name);
        let canonical = self.aliases.get(&wanted).unwrap_or(&wanted);
        self.materials.get(canonical).ok_or_else(|| {
            if let Some(unread) = &self.unread {
                return LawError::new(format!("the materials that come with carom cannot be read: {unread}"));
            }
            let same = SYNONYMS.iter().find(|(word, _)| *word == wanted).map(|(_, name)| *name);
            let same = same.filter(|name| self.materials.contains_key(*name));
            let near = same.or_else(|| self.misspelt(&wanted)).map(str::to_owned);
            Problem::UnknownMaterial { name: name.to_owned(), near }.into()
        })
    }

    /// The name that was misspelt. A short word a letter away is another material (PVC is not PVF, silica not silicon), so one slip
    /// is allowed from four letters on, two from eight.
    fn misspelt(&self, wanted: &str) -> Option<&str> {
        let known = self.materials.keys().chain(self.aliases.keys()).map(String::as_str);
        let length = |word: &str| word.chars().filter(|c| c.is_alphabetic()).count();
        let near = nearest(wanted, known.filter(|k| length(k) >= 4))?;
        let distant = || nearest_within(wanted, near, 1).is_none();
        if length(wanted) < 4 || (length(wanted).min(length(near)) < 8 && distant()) { None } else { Some(near) }
    }

    /// All materials, by name.
    pub fn iter(&self) -> impl Iterator<Item = &Material> {
        self.materials.values()
    }
}
