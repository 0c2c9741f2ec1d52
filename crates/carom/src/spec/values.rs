//! Small value types of the text form.

use alloc::borrow::ToOwned;
use core::ops::{Deref, Range};

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

/// From TOML, with the place. (A law itself reads from any format: [`super::LawSpec`].)
#[cfg(feature = "toml")]
impl<'de, T: serde::Deserialize<'de>> serde::Deserialize<'de> for At<T> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let spanned = toml::Spanned::<T>::deserialize(deserializer)?;
        let span = Some(spanned.span());
        Ok(Self { value: spanned.into_inner(), span })
    }
}

/// A radius of curvature, m: infinite (flat) is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvatureRadius(pub f64);

impl core::str::FromStr for CurvatureRadius {
    type Err = crate::units::UnitError;
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.trim() {
            "inf" | "+inf" | "flat" => Ok(Self(f64::INFINITY)),
            other => other.parse::<crate::units::Length>().map(|l| Self(l.0)),
        }
    }
}

/// Makes an enum readable by name, from texts and from a command line, with "did you mean".
macro_rules! names {
    ($type:ty, $what:literal, $($name:literal => $variant:ident),* $(,)?) => {
        impl $type {
            /// All of them, in the order of the documentation.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];
            /// All names, likewise.
            pub const NAMES: &'static [&'static str] = &[$($name),*];

            /// Its name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),* }
            }
        }

        impl core::str::FromStr for $type {
            type Err = $crate::error::LawError;
            fn from_str(text: &str) -> Result<Self, $crate::error::LawError> {
                // EAP is eap
                let known = Self::ALL.iter().zip(Self::NAMES).find(|(_, name)| name.eq_ignore_ascii_case(text));
                known.map(|(variant, _)| *variant).ok_or_else(|| {
                    $crate::spec::values::unknown_name($what, text, Self::NAMES)
                })
            }
        }

        #[cfg(feature = "serde")]
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let text = <alloc::borrow::Cow<'de, str>>::deserialize(deserializer)?;
                text.parse().map_err(serde::de::Error::custom)
            }
        }
    };
}
pub(crate) use names;

pub(crate) fn unknown_name(what: &'static str, wrong: &str, names: &[&str]) -> crate::error::LawError {
    let known = names.iter().map(|n| (*n).to_owned()).collect();
    crate::error::Problem::UnknownName { what, name: wrong.to_owned(), known }.into()
}
