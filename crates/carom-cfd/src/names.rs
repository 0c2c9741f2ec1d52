//! Names of fields in files.

/// Names of fields where they are not the usual ones. One that is named must be there; one that is not is taken by its usual name, if it is
/// there.
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

impl Names {
    /// All of them, in the order above.
    pub fn all(&self) -> [Option<&str>; 7] {
        let Self { velocity, k, epsilon, omega, density, temperature, pressure } = self;
        [velocity, k, epsilon, omega, density, temperature, pressure].map(Option::as_deref)
    }
}
