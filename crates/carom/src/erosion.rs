//! Erosion: how much of the wall an impact takes away.
//!
//! A law says the mass of wall lost over the mass of the sphere that hits it, E (kg/kg), by the speed U (m/s) and the angle α from the
//! surface (rad) of the impact, for some also by the diameter d (m). One file a law: [`finnie`], [`dnv`], [`e_crc`], [`oka`]; one line of
//! the registry below. All were measured with many sharp grains on one metal: they are empirical, good within a factor of two or so where they were
//! fitted, and know neither the surface that earlier impacts left nor a threshold below which nothing is lost.
//!
//! ```
//! use carom::erosion::{Erosion, Hit};
//! let steel = Erosion::new("dnv", Some("steel"), &[])?;
//! // 1 kg of sand at 20 m/s and 30°: 2e-9 · 20^2.6 · 0.9925 kg of steel
//! let lost = steel.mass(&Hit::new(1.0, 200e-6, 20.0, 30f64.to_radians()));
//! assert!((lost / 4.790e-6 - 1.0).abs() < 1e-3);
//! # Ok::<(), carom::erosion::ErosionError>(())
//! ```

pub mod dnv;
pub mod e_crc;
pub mod finnie;
pub mod oka;

use crate::math::{angle, sin_cos, sqrt};
use core::fmt;
use dnv::Dnv;
use e_crc::ECrc;
use finnie::Finnie;
use oka::Oka;

/// An impact as erosion sees it, relative to the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Mass of what hits, kg.
    pub mass: f64,
    /// Its diameter, m.
    pub diameter: f64,
    /// Speed towards the wall, m/s.
    pub normal: f64,
    /// Speed along the wall, m/s.
    pub tangential: f64,
}

impl Hit {
    /// By speed (m/s) and angle from the surface (rad).
    pub fn new(mass: f64, diameter: f64, speed: f64, angle: f64) -> Self {
        let (sin, cos) = sin_cos(angle);
        Self { mass, diameter, normal: speed * sin, tangential: speed * cos }
    }
}

/// What a law is asked of an impact.
#[derive(Clone, Copy, Debug)]
pub struct Blow {
    /// U, m/s; positive.
    pub speed: f64,
    /// α from the surface, rad, 0 to π/2.
    pub angle: f64,
    /// sin α.
    pub sine: f64,
    /// cos α.
    pub cosine: f64,
    /// d, m.
    pub diameter: f64,
}

/// What a key's values are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A pure number.
    Number,
    /// Pa.
    Pressure,
    /// kg/m³.
    Density,
    /// m/s.
    Speed,
    /// m.
    Length,
}

/// A number that a law reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// What holds where it is not given, SI; none where it must be.
    pub default: Option<f64>,
    /// Least and greatest value, SI.
    pub range: [f64; 2],
    /// One line for the documentation.
    pub about: &'static str,
    /// An example, as it is written.
    pub example: &'static str,
}

/// A material, or a pair of them, whose numbers a law's source gives.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Its name.
    pub name: &'static str,
    /// The values of the law's keys, by their names, SI.
    pub values: &'static [(&'static str, f64)],
}

/// What each law answers.
pub trait Law: Sized {
    /// Its name.
    const NAME: &'static str;
    /// One line for the documentation.
    const ABOUT: &'static str;
    /// The numbers it reads.
    const KEYS: &'static [Key];
    /// Materials of its source.
    const KNOWN: &'static [Known];

    /// Of values in the order of [`Law::KEYS`], SI.
    fn of(values: &[f64]) -> Self;

    /// Mass of wall over mass of what hits.
    fn ratio(&self, blow: &Blow) -> f64;
}

macro_rules! laws {
    ($($law:ident,)*) => {
        /// A law with its numbers.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Erosion {
            $(#[doc = concat!("See [`", stringify!($law), "`].")] $law($law),)*
        }

        /// Every law: name, one line, keys, materials.
        pub const ALL: &[About] = &[$(About {
            name: $law::NAME, about: $law::ABOUT, keys: $law::KEYS, known: $law::KNOWN,
        },)*];

        impl Erosion {
            /// A law by its name, with a material of its source, if any, and numbers by the names of its keys (SI); a number given stands
            /// before the material's.
            ///
            /// # Errors
            /// A name that is none, a number that is missing, out of its range or of another law.
            pub fn new(law: &str, material: Option<&str>, numbers: &[(&'static str, f64)]) -> Result<Self, ErosionError> {
                $(if law == $law::NAME {
                    let mut values = [0.0; $law::KEYS.len()];
                    read($law::NAME, $law::KEYS, $law::KNOWN, material, numbers, &mut values)?;
                    return Ok(Self::$law($law::of(&values)));
                })*
                Err(ErosionError::Law)
            }

            fn ratio(&self, blow: &Blow) -> f64 {
                match self { $(Self::$law(law) => law.ratio(blow),)* }
            }
        }
    };
}

laws! {
    Finnie,
    Dnv,
    ECrc,
    Oka,
}

/// What there is to say of a law.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Its name.
    pub name: &'static str,
    /// One line.
    pub about: &'static str,
    /// The numbers it reads.
    pub keys: &'static [Key],
    /// Materials of its source.
    pub known: &'static [Known],
}

impl Erosion {
    /// Mass of wall that an impact takes away, kg; 0 for what is no impact.
    pub fn mass(&self, hit: &Hit) -> f64 {
        let (up, along) = (hit.normal, hit.tangential.abs());
        let speed = sqrt(up * up + along * along);
        // what is not a number is no impact
        if !(up >= 0.0 && speed > 0.0 && speed.is_finite() && hit.mass > 0.0) {
            return 0.0;
        }
        let blow =
            Blow { speed, angle: angle(along, up), sine: up / speed, cosine: along / speed, diameter: hit.diameter };
        let lost = hit.mass * self.ratio(&blow);
        if lost > 0.0 { lost } else { 0.0 }
    }
}

/// Finds the values of a law's keys.
fn read(
    law: &'static str,
    keys: &'static [Key],
    known: &'static [Known],
    material: Option<&str>,
    numbers: &[(&'static str, f64)],
    values: &mut [f64],
) -> Result<(), ErosionError> {
    let of = match material {
        None => None,
        Some(name) => Some(known.iter().find(|k| k.name == name).ok_or(ErosionError::Material { law, known })?),
    };
    if let Some((key, _)) = numbers.iter().find(|(name, _)| keys.iter().all(|k| k.name != *name)) {
        return Err(ErosionError::Idle { law, key, keys });
    }
    for (key, value) in keys.iter().zip(values) {
        let named = |list: &[(&'static str, f64)]| list.iter().find(|(name, _)| *name == key.name).map(|(_, v)| *v);
        let found = named(numbers).or_else(|| of.and_then(|m| named(m.values))).or(key.default);
        let Some(number) = found else { return Err(ErosionError::Missing { law, key, known }) };
        if !(number >= key.range[0] && number <= key.range[1]) {
            return Err(ErosionError::Range { law, key, value: number });
        }
        *value = number;
    }
    Ok(())
}

/// What is wrong with a law's numbers.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum ErosionError {
    /// A law that there is not.
    Law,
    /// A material that the law's source does not have.
    Material {
        /// The law.
        law: &'static str,
        /// What it has.
        known: &'static [Known],
    },
    /// A number that is needed.
    Missing {
        /// The law.
        law: &'static str,
        /// Of which key.
        key: &'static Key,
        /// Materials that have it.
        known: &'static [Known],
    },
    /// A number out of its range.
    Range {
        /// The law.
        law: &'static str,
        /// Of which key.
        key: &'static Key,
        /// The number.
        value: f64,
    },
    /// A number that the law does not read.
    Idle {
        /// The law.
        law: &'static str,
        /// Of which key.
        key: &'static str,
        /// What it reads.
        keys: &'static [Key],
    },
}

impl ErosionError {
    /// The key that it is about, if it is about a number.
    pub fn key(&self) -> Option<&'static str> {
        match self {
            Self::Range { key, .. } => Some(key.name),
            Self::Idle { key, .. } => Some(key),
            Self::Law | Self::Material { .. } | Self::Missing { .. } => None,
        }
    }
}

fn list(f: &mut fmt::Formatter<'_>, names: impl Iterator<Item = &'static str>) -> fmt::Result {
    names.enumerate().try_for_each(|(i, name)| write!(f, "{}{name}", if i > 0 { ", " } else { "" }))
}

impl fmt::Display for ErosionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Law => {
                f.write_str("unknown erosion law; known are ")?;
                list(f, ALL.iter().map(|l| l.name))
            }
            Self::Material { law, known: [] } => write!(f, "erosion by {law} knows no materials: give its numbers"),
            Self::Material { law, known } => {
                write!(f, "erosion by {law} does not know this material; it knows ")?;
                list(f, known.iter().map(|k| k.name))
            }
            Self::Missing { law, key, known } => {
                write!(f, "erosion by {law} needs {}, {}: {} = {}", key.name, key.about, key.name, key.example)?;
                match known.first() {
                    Some(known) => write!(f, ", or material = \"{}\"", known.name),
                    None => Ok(()),
                }
            }
            Self::Range { law, key, value } => {
                let [least, most] = key.range;
                write!(
                    f,
                    "{} of erosion by {law} is {value:e}; it lies between {least:e} and {most:e} (SI units)",
                    key.name
                )
            }
            Self::Idle { law, key, keys } => {
                write!(f, "erosion by {law} has no {key}; its keys are ")?;
                list(f, keys.iter().map(|k| k.name))
            }
        }
    }
}

impl core::error::Error for ErosionError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> [Erosion; 5] {
        [
            Erosion::new("finnie", None, &[("density", 7800.0), ("flow_stress", 1e9)]).unwrap(),
            Erosion::new("dnv", Some("steel"), &[]).unwrap(),
            Erosion::new("dnv", Some("epoxy-laminate"), &[]).unwrap(),
            Erosion::new("e-crc", None, &[("brinell", 160.0)]).unwrap(),
            Erosion::new("oka", Some("sand-on-steel"), &[]).unwrap(),
        ]
    }

    #[test]
    fn nothing_is_lost_along_the_wall_and_never_a_negative_mass() {
        for law in all() {
            assert_eq!(law.mass(&Hit { mass: 1.0, diameter: 1e-4, normal: 0.0, tangential: 10.0 }), 0.0, "{law:?}");
            assert_eq!(law.mass(&Hit { mass: 1.0, diameter: 1e-4, normal: 0.0, tangential: 0.0 }), 0.0, "{law:?}");
            assert_eq!(law.mass(&Hit { mass: 1.0, diameter: 1e-4, normal: f64::NAN, tangential: 1.0 }), 0.0);
            let mut before = 0.0;
            for degrees in 0..=90 {
                let at = |speed| law.mass(&Hit::new(2.0, 1e-4, speed, f64::from(degrees).to_radians()));
                let lost = at(10.0);
                assert!(lost >= 0.0 && lost.is_finite(), "{law:?} {degrees}");
                // no jumps from degree to degree, more at twice the speed
                assert!(
                    (lost - before).abs() < 0.2 * at(10.0).max(law.mass(&Hit::new(2.0, 1e-4, 10.0, 0.6))),
                    "{law:?} {degrees}"
                );
                assert!(lost == 0.0 || at(20.0) > 3.9 * lost, "{law:?} {degrees}");
                before = lost;
            }
        }
    }

    #[test]
    fn mistakes_are_told() {
        let said = |law, material, numbers: &[(&'static str, f64)]| {
            Erosion::new(law, material, numbers).expect_err("a mistake").to_string()
        };
        assert!(said("dvn", None, &[]).contains("known are finnie, dnv, e-crc, oka"));
        assert!(said("dnv", Some("lead"), &[]).contains("it knows steel, titanium"));
        assert!(
            said("dnv", None, &[]).contains("needs constant")
                && said("dnv", None, &[]).contains("material = \"steel\"")
        );
        assert!(said("e-crc", None, &[("brinell", -3.0)]).contains("brinell of erosion by e-crc is -3e0"));
        assert!(said("e-crc", Some("steel"), &[]).contains("knows no materials"));
        let idle = Erosion::new("finnie", None, &[("brinell", 100.0)]).unwrap_err();
        assert!(idle.key() == Some("brinell") && idle.to_string().contains("its keys are density, flow_stress"));
    }

    #[test]
    fn numbers_stand_before_the_materials() {
        let softer = Erosion::new("dnv", Some("steel"), &[("constant", 4e-9)]).unwrap();
        let hit = Hit::new(1.0, 1e-4, 15.0, 0.5);
        let steel = Erosion::new("dnv", Some("steel"), &[]).unwrap();
        assert!((softer.mass(&hit) / steel.mass(&hit) - 2.0).abs() < 1e-14);
    }
}
