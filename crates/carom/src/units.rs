//! Quantities with units: `"90 um"`, `"1.2 J/m2"`, `"24 degC"`, or a bare SI number.
//!
//! One type per dimension, each a wrapped `f64` in SI units. A text is a number followed by a product of units
//! (`kg/m3`, `Pa s`, `m s-1`, `m/s^2`) with SI prefixes; errors name the character where the text goes wrong and say
//! what would be right. Every type reads from TOML (string or number) and from a command line (`FromStr`), and is written as a bare SI number.

mod parse;

pub use parse::UnitError;

/// Exponents of metre, kilogram, second and kelvin. Angles count as pure numbers.
pub type Dimension = [i8; 4];

/// A quantity of one dimension, in SI units.
pub trait Quantity: core::str::FromStr<Err = UnitError> + Copy {
    /// What it is, in a word.
    const WHAT: &'static str;
    /// The SI unit, empty for a pure number.
    const SI: &'static str;
    /// A text that states one.
    const EXAMPLE: &'static str;
    /// From a number in SI units.
    fn from_si(value: f64) -> Self;
    /// The number in SI units.
    fn si(self) -> f64;
}

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident, $what:literal, $dim:expr, $si:literal, $example:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
        pub struct $name(pub f64);

        impl $name {
            /// Exponents of m, kg, s, K.
            pub const DIMENSION: Dimension = $dim;
            /// The SI unit, as written on an axis.
            pub const SI: &'static str = $si;
        }

        impl Quantity for $name {
            const WHAT: &'static str = $what;
            const SI: &'static str = $si;
            const EXAMPLE: &'static str = $example;
            fn from_si(value: f64) -> Self {
                Self(value)
            }
            fn si(self) -> f64 {
                self.0
            }
        }

        impl From<$name> for f64 {
            fn from(quantity: $name) -> Self {
                quantity.0
            }
        }

        impl core::str::FromStr for $name {
            type Err = UnitError;
            fn from_str(text: &str) -> Result<Self, UnitError> {
                parse::parse(text, &parse::Wanted { what: $what, dimension: $dim, si: $si, example: $example }).map($name)
            }
        }

        #[cfg(feature = "serde")]
        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_f64(self.0)
            }
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(serde_form::Form(core::marker::PhantomData))
            }
        }
    )*};
}

quantities! {
    /// A length, m.
    Length, "length", [1, 0, 0, 0], "m", "90 um";
    /// A time, s.
    Time, "time", [0, 0, 1, 0], "s", "10 ms";
    /// A speed, m/s.
    Speed, "speed", [1, 0, -1, 0], "m/s", "2 m/s";
    /// An acceleration, m/s².
    Acceleration, "acceleration", [1, 0, -2, 0], "m/s2", "9.81 m/s2";
    /// A mass density, kg/m³.
    Density, "density", [-3, 1, 0, 0], "kg/m3", "8000 kg/m3";
    /// A pressure, stress or elastic modulus, Pa.
    Pressure, "pressure", [-1, 1, -2, 0], "Pa", "190 GPa";
    /// An energy per area, J/m² (the same dimension as N/m).
    SurfaceEnergy, "surface energy", [0, 1, -2, 0], "J/m2", "1.2 J/m2";
    /// A dynamic viscosity, Pa s.
    Viscosity, "dynamic viscosity", [-1, 1, -1, 0], "Pa s", "1.83e-5 Pa s";
    /// A kinematic viscosity, m²/s.
    KinematicViscosity, "kinematic viscosity", [2, 0, -1, 0], "m2/s", "1.5e-5 m2/s";
    /// A temperature, K (degC and degF are converted).
    Temperature, "temperature", [0, 0, 0, 1], "K", "24 degC";
    /// A temperature gradient, K/m.
    TemperatureGradient, "temperature gradient", [-1, 0, 0, 1], "K/m", "1e4 K/m";
    /// A thermal conductivity, W/(m K).
    ThermalConductivity, "thermal conductivity", [1, 1, -3, -1], "W/m/K", "0.2 W/m/K";
    /// An angle, rad.
    Angle, "angle", [0, 0, 0, 0], "rad", "30 deg";
    /// An angular velocity, rad/s.
    AngularVelocity, "angular velocity", [0, 0, -1, 0], "rad/s", "100 rad/s";
    /// A mass, kg.
    Mass, "mass", [0, 1, 0, 0], "kg", "1 mg";
    /// A mass flow, kg/s.
    MassFlow, "mass flow", [0, 1, -1, 0], "kg/s", "1 g/s";
    /// The damping coefficients C_A and C_H, s/m.
    InverseSpeed, "damping coefficient", [-1, 0, 1, 0], "s/m", "1.3 s/m";
    /// An energy, J.
    Energy, "energy", [2, 1, -2, 0], "J", "1e-15 J";
    /// A frequency, 1/s.
    Frequency, "frequency", [0, 0, -1, 0], "1/s", "100 Hz";
    /// Turbulent kinetic energy per mass, m²/s².
    SpecificEnergy, "specific energy", [2, 0, -2, 0], "m2/s2", "0.1 m2/s2";
    /// Dissipation of turbulent kinetic energy per mass, m²/s³.
    Dissipation, "dissipation rate", [2, 0, -3, 0], "m2/s3", "0.1 m2/s3";
    /// A pure number.
    Number, "number", [0, 0, 0, 0], "", "0.8";
}

/// A quantity in a serde format: a text with a unit, or a number.
#[cfg(feature = "serde")]
mod serde_form {
    use super::{Quantity, parse};
    use core::fmt;
    use core::marker::PhantomData;
    use serde::de::{Error, Visitor};

    pub(super) struct Form<Q>(pub PhantomData<Q>);

    impl<Q: Quantity> Visitor<'_> for Form<Q> {
        type Value = Q;
        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            let unit = if Q::SI.is_empty() { "no unit" } else { Q::SI };
            let article = parse::article(Q::WHAT);
            write!(f, "{article} {} such as \"{}\", or a number in {unit}", Q::WHAT, Q::EXAMPLE)
        }
        fn visit_f64<E: Error>(self, v: f64) -> Result<Q, E> {
            if v.is_finite() { Ok(Q::from_si(v)) } else { Err(E::custom(format!("{v} is not a finite {}", Q::WHAT))) }
        }
        fn visit_i64<E: Error>(self, v: i64) -> Result<Q, E> {
            Ok(Q::from_si(v as f64))
        }
        fn visit_u64<E: Error>(self, v: u64) -> Result<Q, E> {
            Ok(Q::from_si(v as f64))
        }
        fn visit_str<E: Error>(self, v: &str) -> Result<Q, E> {
            v.parse().map_err(E::custom)
        }
    }
}

#[cfg(test)]
mod tests;
