//! What a loss may ask of a law while it is compiled.

use crate::error::SpecError;
use crate::pair::Pair;

/// A law's materials and the numbers of its keys, SI units, each already within its range.
pub struct Inputs<'a> {
    pair: Option<&'a Pair>,
    roughness_factor: f64,
    numbers: &'a dyn Fn(&str) -> Option<f64>,
}

impl<'a> Inputs<'a> {
    /// The materials, C_R, and the numbers by key.
    pub(crate) fn new(pair: Option<&'a Pair>, roughness_factor: f64, numbers: &'a dyn Fn(&str) -> Option<f64>) -> Self {
        Self { pair, roughness_factor, numbers }
    }

    /// The two materials.
    ///
    /// # Errors
    /// The law has none.
    pub fn pair(&self) -> Result<&'a Pair, SpecError> {
        self.pair.ok_or_else(|| need("a sphere and a surface", "sphere and surface, by name or with their properties"))
    }

    /// C_R, 1 where nothing is said of the roughness.
    pub fn roughness_factor(&self) -> f64 {
        self.roughness_factor
    }

    /// The number of a key, if it is given.
    pub fn number(&self, key: &str) -> Option<f64> {
        (self.numbers)(key)
    }

    /// The number of a key that the loss cannot do without; `what` it is, and an example.
    ///
    /// # Errors
    /// It is not given.
    pub fn needed(&self, key: &str, what: &str, example: &str) -> Result<f64, SpecError> {
        self.number(key).ok_or_else(|| need(what, example))
    }
}

fn need(what: &str, key: &str) -> SpecError {
    SpecError::new(format!("the law needs {what}")).help(format!("give {key}"))
}
