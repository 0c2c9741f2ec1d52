//! What may be fitted: the keys of a law for which the registry says where to look.

use carom::error::{Keys, did_you_mean};
use carom::material::Library;
use carom::pair::Pair;
use carom::spec::{Key, LawSpec, Search};
use carom::{LawError, WallLaw};
use std::ops::RangeInclusive;

/// All keys that may be fitted.
pub fn parameters() -> impl Iterator<Item = Key> {
    Key::ALL.iter().copied().filter(|k| k.info().search.is_some())
}

/// The parameter of that name or symbol.
///
/// # Errors
/// A name that is not one, with those there are.
pub fn parameter(text: &str) -> Result<Key, LawError> {
    let found = text.parse::<Key>().ok().filter(|k| k.info().search.is_some());
    found.ok_or_else(|| {
        let names: Vec<&str> = parameters().map(Key::name).collect();
        let near = did_you_mean(&text.trim().replace('-', "_"), names.iter().copied());
        let near = near.map_or(String::new(), |n| format!("{n} "));
        LawError::new(format!("unknown parameter '{text}'")).help(format!("{near}known are {}", names.join(", ")))
    })
}

/// A key as a fit sees it.
pub trait Parameter: Copy {
    /// Where it may lie by its nature.
    fn natural_bounds(self) -> RangeInclusive<f64>;

    /// Puts a value into a law.
    fn set(self, law: &mut LawSpec, value: f64);

    /// Reads a value with a unit, or a bare SI number.
    ///
    /// # Errors
    /// Where the text goes wrong.
    fn read(self, text: &str) -> Result<f64, LawError>;

    /// What the law says of it: its own key, or what its materials and roughness give; else a usual value.
    fn start(self, law: &LawSpec, library: &Library) -> f64;

    /// Does it change what `law` answers?
    ///
    /// # Errors
    /// The law does not take it, or lacks something else.
    fn acts(self, law: &LawSpec, library: &Library) -> Result<bool, LawError>;
}

impl Parameter for Key {
    fn natural_bounds(self) -> RangeInclusive<f64> {
        let range = &self.info().range;
        range.low..=range.high
    }

    fn set(self, law: &mut LawSpec, value: f64) {
        law.make_room(self);
        law.set_number(self, value.max(search(self).least));
    }

    fn read(self, text: &str) -> Result<f64, LawError> {
        let mut law = LawSpec::default();
        law.set_text(self, text)?;
        law.number(self).ok_or_else(|| LawError::new(format!("{self} takes no number")))
    }

    fn start(self, law: &LawSpec, library: &Library) -> f64 {
        let usual = search(self).start;
        match law.number(self) {
            // no friction at all is no place to begin
            Some(value) if self != Key::Friction || value > 0.0 => value,
            _ => law.compile(library).ok().and_then(|wall| implied(self, law, &wall)).unwrap_or(usual),
        }
    }

    fn acts(self, law: &LawSpec, library: &Library) -> Result<bool, LawError> {
        let start = self.start(law, library).max(scale(self, 1.0).min(0.1));
        let [one, other]: [WallLaw; 2] = {
            let with = |value: f64| {
                let mut law = law.clone();
                self.set(&mut law, value);
                law.compile(library)
            };
            [with(start)?, with(0.5 * start)?]
        };
        Ok(one.normal() != other.normal() || one.tangential() != other.tangential())
    }
}

/// What materials and roughness give where the key itself is absent.
fn implied(key: Key, law: &LawSpec, wall: &WallLaw) -> Option<f64> {
    match key {
        Key::RoughnessFactor => law.is_given(Key::Roughness).then(|| wall.roughness_factor()),
        Key::WorkOfAdhesion => wall.pair().map(Pair::work_of_adhesion)?.ok(),
        Key::PlasticConstant => wall.pair().map(Pair::plastic_constant)?.ok(),
        _ => None,
    }
}

/// Where to look; a key for which nothing is said is refused when the problem is set up.
fn search(key: Key) -> Search {
    key.info().search.unwrap_or(Search { start: 1.0, scale: 1.0, grid: &[], relative: true, least: 0.0 })
}

/// Where a search begins besides `start`.
pub(super) fn grid(key: Key, start: f64) -> Vec<f64> {
    let search = search(key);
    search.grid.iter().map(|s| if search.relative { s * start } else { *s }).collect()
}

/// A size by which steps and differences are measured.
pub(super) fn scale(key: Key, start: f64) -> f64 {
    let search = search(key);
    if search.relative { start.max(search.scale) } else { search.scale }
}

/// What reads it.
pub(super) fn readers(key: Key) -> String {
    format!("it is read with {}; or leave it out", key.read_with(&Keys))
}
