//! What a loss may ask of a law while it is compiled.

use crate::error::{LawError, Problem};
use crate::pair::Pair;
use crate::spec::{Choice, Key, LawBuilder};

/// A law's materials and the numbers of its keys, SI units, each already within its range.
pub struct Inputs<'a> {
    pair: Option<&'a Pair>,
    roughness_factor: f64,
    law: &'a LawBuilder,
    /// Who asks.
    reader: Choice,
}

impl<'a> Inputs<'a> {
    /// The materials, C_R, and the law with its keys; `reader` is what needs them.
    pub(crate) fn new(pair: Option<&'a Pair>, roughness_factor: f64, law: &'a LawBuilder, reader: Choice) -> Self {
        Self { pair, roughness_factor, law, reader }
    }

    /// The two materials.
    ///
    /// # Errors
    /// The law has none.
    pub fn pair(&self) -> Result<&'a Pair, LawError> {
        let missing = || Problem::MissingMaterial { sphere: true, surface: true, reader: Some(self.reader) };
        self.pair.ok_or_else(|| missing().into())
    }

    /// C_R, 1 where nothing is said of the roughness.
    pub fn roughness_factor(&self) -> f64 {
        self.roughness_factor
    }

    /// The number of a key, if it is given.
    pub fn number(&self, key: Key) -> Option<f64> {
        self.law.number(key)
    }

    /// The number of a key that the loss cannot do without.
    ///
    /// # Errors
    /// It is not given.
    pub fn needed(&self, key: Key) -> Result<f64, LawError> {
        self.law.needed(key, self.reader)
    }
}
