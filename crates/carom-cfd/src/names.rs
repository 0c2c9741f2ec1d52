//! Names of fields in files.

/// Names of fields where they are not the usual ones. One that is named must be there; one that is not is taken by its usual name, if it is
/// there, and [`Names::NONE`] leaves it out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Velocity; usually `U`.
    pub velocity: Option<String>,
    /// Turbulent kinetic energy; `k`.
    pub k: Option<String>,
    /// Its dissipation rate; `epsilon`.
    pub epsilon: Option<String>,
    /// Its specific dissipation rate; `omega`.
    pub omega: Option<String>,
    /// Density; `rho`.
    pub density: Option<String>,
    /// Temperature; `T`.
    pub temperature: Option<String>,
    /// Pressure; `p`.
    pub pressure: Option<String>,
}

/// What is wanted of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted<'a> {
    /// The field of its usual name, if there is one.
    Usual,
    /// The field of this name.
    Named(&'a str),
    /// None.
    None,
}

impl Names {
    /// The name of a field that is not to be read: of a `T` that is no temperature, say.
    pub const NONE: &'static str = "none";

    /// All of them, in the order above.
    pub fn all(&self) -> [Wanted<'_>; 7] {
        let Self { velocity, k, epsilon, omega, density, temperature, pressure } = self;
        [velocity, k, epsilon, omega, density, temperature, pressure].map(|name| match name.as_deref() {
            None => Wanted::Usual,
            Some(Self::NONE) => Wanted::None,
            Some(name) => Wanted::Named(name),
        })
    }
}
