//! Small value types of the text form.

use serde::de::{self, Deserialize, Deserializer, Visitor};
use std::fmt;
use std::ops::{Deref, Range};

/// A value and where it was written (bytes of the text), if it came from one.
#[derive(Clone, Debug, PartialEq)]
pub struct At<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Option<Range<usize>>,
}

impl<T> From<T> for At<T> {
    fn from(value: T) -> Self {
        Self { value, span: None }
    }
}

impl<T> Deref for At<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.value
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for At<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let spanned = toml::Spanned::<T>::deserialize(deserializer)?;
        let span = Some(spanned.span());
        Ok(Self { value: spanned.into_inner(), span })
    }
}

/// A radius of curvature, m: infinite (flat) is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureRadius(pub f64);

impl std::str::FromStr for CurvatureRadius {
    type Err = crate::units::UnitError;
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.trim() {
            "inf" | "+inf" | "flat" => Ok(Self(f64::INFINITY)),
            other => other.parse::<crate::units::Length>().map(|l| Self(l.0)),
        }
    }
}

impl<'de> Deserialize<'de> for CurvatureRadius {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Radius;
        impl Visitor<'_> for Radius {
            type Value = CurvatureRadius;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a radius of curvature such as \"5 mm\", or \"inf\" for a flat surface")
            }
            fn visit_str<E: de::Error>(self, v: &str) -> Result<CurvatureRadius, E> {
                v.parse().map_err(E::custom)
            }
            fn visit_f64<E: de::Error>(self, v: f64) -> Result<CurvatureRadius, E> {
                if v.is_nan() { Err(E::custom("NaN is no radius of curvature")) } else { Ok(CurvatureRadius(v)) }
            }
            fn visit_i64<E: de::Error>(self, v: i64) -> Result<CurvatureRadius, E> {
                Ok(CurvatureRadius(v as f64))
            }
        }
        deserializer.deserialize_any(Radius)
    }
}

/// Makes an enum readable by name, from TOML and from a command line, with "did you mean".
macro_rules! names {
    ($type:ty, $what:literal, $($name:literal => $variant:ident),* $(,)?) => {
        impl $type {
            /// All names, in the order of the documentation.
            pub const NAMES: &'static [&'static str] = &[$($name),*];

            /// Its name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),* }
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::error::SpecError;
            fn from_str(text: &str) -> Result<Self, $crate::error::SpecError> {
                match text {
                    $($name => Ok(Self::$variant),)*
                    other => Err($crate::spec::values::unknown_name($what, other, Self::NAMES)),
                }
            }
        }

        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }

        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let text = <std::borrow::Cow<'de, str>>::deserialize(deserializer)?;
                text.parse().map_err(serde::de::Error::custom)
            }
        }
    };
}
pub(crate) use names;

pub(crate) fn unknown_name(what: &str, wrong: &str, names: &[&str]) -> crate::error::SpecError {
    let near = crate::error::did_you_mean(wrong, names.iter().copied()).map_or(String::new(), |s| format!("{s} "));
    crate::error::SpecError::new(format!("unknown {what} '{wrong}'"))
        .help(format!("{near}known are {}", names.join(", ")))
}
