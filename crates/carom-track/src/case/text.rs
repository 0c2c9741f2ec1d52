//! The case file as written: what serde reads, with places, before anything is checked.

use super::erosion::ErosionText;
use super::removal::RemovalText;
use super::whole::Whole;
use crate::tables::TableFormat;
use carom::material::MaterialRef;
use carom::spec::{At, CurveSpec};
use carom::units::{
    Acceleration, AngularVelocity, Density, Frequency, Length, Mass, MassFlow, Number, Pressure, Speed, Temperature,
    TemperatureGradient, ThermalConductivity, Time, Viscosity,
};

/// A case file.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CaseText {
    pub title: Option<String>,
    pub seed: Option<Whole>,
    pub fluid: Option<At<FluidText>>,
    pub flow: Option<At<FlowText>>,
    #[serde(default)]
    pub forces: ForcesText,
    #[serde(default)]
    pub wall: Vec<At<WallText>>,
    /// Read apart, by [`carom::spec::parse_laws`], which says more of its mistakes.
    #[serde(default, rename = "law")]
    _law: serde::de::IgnoredAny,
    #[serde(default)]
    pub injection: Vec<At<InjectionText>>,
    #[serde(default)]
    pub run: Option<At<RunText>>,
    #[serde(default)]
    pub output: OutputText,
}

#[derive(Debug, Default, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FluidText {
    pub density: Option<At<Density>>,
    pub viscosity: Option<At<Viscosity>>,
    pub temperature: Option<At<Temperature>>,
    pub pressure: Option<At<Pressure>>,
    pub humidity: Option<At<Number>>,
    pub gas: Option<At<String>>,
    pub liquid: Option<At<bool>>,
    pub mean_free_path: Option<At<Length>>,
    pub temperature_gradient: Option<At<[TemperatureGradient; 3]>>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FlowText {
    pub kind: At<String>,
    pub velocity: Option<At<[Speed; 3]>>,
    pub profile: Option<At<String>>,
    pub height: Option<At<Length>>,
    pub mean_speed: Option<At<Speed>>,
    pub point: Option<At<[Length; 3]>>,
    pub axis: Option<At<[f64; 3]>>,
    pub radius: Option<At<Length>>,
    pub normal: Option<At<[f64; 3]>>,
    pub line: Option<At<[f64; 3]>>,
    pub strain_rate: Option<At<Frequency>>,
    pub width: Option<At<Length>>,
    pub diameter: Option<At<Length>>,
    pub speed: Option<At<Speed>>,
    pub file: Option<At<String>>,
    pub columns: Option<At<crate::flow::Named>>,
    pub case: Option<At<String>>,
    pub time: Option<At<TimeName>>,
    pub fields: Option<At<FieldsText>>,
    pub patches: Option<At<String>>,
    pub axisymmetric: Option<At<String>>,
}

/// The name of a time, written as text or as a number.
#[derive(Debug, Clone, serde::Deserialize)]
#[serde(untagged, expecting = "the name of a time such as \"500\", or \"latest\", is wanted")]
pub(super) enum TimeName {
    Name(String),
    Whole(u64),
    Number(f64),
}

/// Names of the fields of a finished result, where they are not the usual ones.
#[derive(Debug, Default, Clone, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FieldsText {
    pub velocity: Option<String>,
    pub k: Option<String>,
    pub epsilon: Option<String>,
    pub omega: Option<String>,
    pub density: Option<String>,
    pub temperature: Option<String>,
    pub pressure: Option<String>,
}

#[derive(Debug, Default, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ForcesText {
    pub gravity: Option<At<[Acceleration; 3]>>,
    pub buoyancy: Option<bool>,
    pub drag: Option<At<String>>,
    pub slip: Option<At<String>>,
    pub saffman: Option<bool>,
    pub magnus: Option<bool>,
    pub rotational_drag: Option<bool>,
    pub pressure_gradient: Option<bool>,
    pub added_mass: Option<bool>,
    pub thermophoresis: Option<At<ThermophoresisText>>,
    pub wall_drag: Option<At<WallDragText>>,
    pub brownian: Option<At<bool>>,
    pub random_walk: Option<At<RandomWalkText>>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ThermophoresisText {
    pub thermal_conductivity: At<ThermalConductivity>,
}

/// `true` or `false`, or a table.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged, expecting = "true, false or { least_gap = \"10 nm\" } is wanted")]
pub(super) enum WallDragText {
    Switch(bool),
    Gap(LeastGapText),
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LeastGapText {
    pub least_gap: Length,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RandomWalkText {
    pub model: Option<At<String>>,
    pub near_wall: Option<At<String>>,
    pub life: Option<At<String>>,
    pub drift: Option<bool>,
    pub time_scale: Option<At<Number>>,
}

#[derive(Debug, Clone, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WallText {
    #[serde(default = "unnamed")]
    pub name: At<String>,
    pub patch: Option<At<String>>,
    pub plane: Option<At<PlaneText>>,
    pub cylinder: Option<At<CylinderText>>,
    #[serde(rename = "box")]
    pub room: Option<At<[[Length; 3]; 2]>>,
    pub block: Option<At<[[Length; 3]; 2]>>,
    pub stl: Option<At<StlText>>,
    pub law: At<String>,
    pub restitution: Option<At<CurveSpec>>,
    pub tangential_restitution: Option<At<CurveSpec>>,
    pub contact_at: Option<At<String>>,
    pub removal: Option<At<RemovalText>>,
    pub erosion: Option<At<ErosionText>>,
    pub velocity: Option<At<[Speed; 3]>>,
}

/// The name of a wall that has none yet: patches bring their own.
fn unnamed() -> At<String> {
    At::from(String::new())
}

#[derive(Debug, Clone, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneText {
    pub point: [Length; 3],
    pub normal: At<[f64; 3]>,
}

#[derive(Debug, Clone, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CylinderText {
    pub point: [Length; 3],
    pub axis: At<[f64; 3]>,
    pub radius: At<Length>,
    pub fluid: Option<At<String>>,
}

#[derive(Debug, Clone, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StlText {
    pub file: At<String>,
    pub unit: Option<At<Length>>,
    pub solid: Option<At<String>>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct InjectionText {
    pub name: Option<At<String>>,
    pub material: Option<At<MaterialRef>>,
    pub density: Option<At<Density>>,
    pub diameter: Option<At<SizeText>>,
    pub diameter_kind: Option<At<String>>,
    pub count: Option<At<Whole>>,
    pub mass: Option<At<Mass>>,
    pub mass_flow: Option<At<MassFlow>>,
    pub parcels: Option<At<Whole>>,
    pub position: Option<At<PlaceText>>,
    /// A file of particles, in place of the position.
    pub particles: Option<At<String>>,
    pub distribution: Option<At<String>>,
    pub velocity: Option<At<VelocityText>>,
    pub spin: Option<At<[AngularVelocity; 3]>>,
    pub start: Option<At<Time>>,
    pub stop: Option<At<Time>>,
}

/// A diameter, or a distribution of diameters.
#[derive(Debug)]
pub(super) enum SizeText {
    One(f64),
    Distribution(Box<SizesText>),
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SizesText {
    pub lognormal: Option<LognormalText>,
    pub rosin_rammler: Option<RosinRammlerText>,
    pub table: Option<TableText>,
    pub by: Option<At<String>>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LognormalText {
    pub median: Length,
    pub gsd: f64,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RosinRammlerText {
    pub mean: Length,
    pub spread: f64,
    pub min: Length,
    pub max: Length,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TableText {
    pub diameter: Vec<Length>,
    pub amount: Vec<f64>,
}

/// A point, or a place to fill at random.
#[derive(Debug)]
pub(super) enum PlaceText {
    Point([f64; 3]),
    Place(Box<PlacesText>),
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlacesText {
    #[serde(rename = "box")]
    pub room: Option<[[Length; 3]; 2]>,
    pub disc: Option<DiscText>,
    pub patch: Option<PatchText>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DiscText {
    pub center: [Length; 3],
    pub normal: [f64; 3],
    pub radius: Length,
}

/// A patch of a mesh by its name, or a parallelogram.
#[derive(Debug, serde::Deserialize)]
#[serde(
    untagged,
    expecting = "the name of a patch of the mesh, or { corner = [...], sides = [[...], [...]] } is wanted"
)]
pub(super) enum PatchText {
    Named(String),
    Given(SidesText),
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SidesText {
    pub corner: [Length; 3],
    pub sides: [[Length; 3]; 2],
}

/// A velocity, or `"fluid"`.
#[derive(Debug)]
pub(super) enum VelocityText {
    Given([f64; 3]),
    Fluid,
}

#[derive(Debug, Default, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RunText {
    pub until: Option<At<Time>>,
    pub tolerance: Option<At<Number>>,
    pub settle_height: Option<At<Length>>,
    pub max_steps: Option<At<Whole>>,
}

#[derive(Debug, Default, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OutputText {
    pub trajectories: Option<At<Whole>>,
    pub impacts: Option<RowsText>,
    pub fates: Option<RowsText>,
    pub vtk: Option<bool>,
    pub size_bins: Option<At<Vec<Length>>>,
    pub face_sizes: Option<At<bool>>,
    #[serde(default)]
    pub region: Vec<At<RegionText>>,
}

/// `"csv"`, `"parquet"`, or `false` for no table; `true` is CSV.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowsText(pub Option<TableFormat>);

impl Default for RowsText {
    fn default() -> Self {
        Self(Some(TableFormat::Csv))
    }
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RegionText {
    pub name: At<String>,
    #[serde(rename = "box")]
    pub room: [[Length; 3]; 2],
}

/// The numbers in SI units.
pub(super) trait Si {
    fn si(&self) -> [f64; 3];
}

macro_rules! si {
    ($($unit:ty),*) => {$(
        impl Si for [$unit; 3] {
            fn si(&self) -> [f64; 3] {
                [self[0].0, self[1].0, self[2].0]
            }
        }
    )*};
}
si!(Length, Speed, Acceleration, AngularVelocity, TemperatureGradient);

mod forms {
    //! Values that may be written in more than one form: a visitor each, so that the errors inside keep their words.

    use super::{PlaceText, PlacesText, RowsText, Si, SizeText, SizesText, TableFormat, VelocityText};
    use carom::error::did_you_mean;
    use carom::units::{Length, Speed};
    use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
    use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
    use std::fmt;

    impl<'de> Deserialize<'de> for SizeText {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            struct Size;
            impl<'de> Visitor<'de> for Size {
                type Value = SizeText;
                fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                    f.write_str("a diameter such as \"90 um\", or { lognormal = { median = \"70 um\", gsd = 1.3 } }, { rosin_rammler = ... } or { table = ... }")
                }
                fn visit_str<E: de::Error>(self, v: &str) -> Result<SizeText, E> {
                    v.parse::<Length>().map(|l| SizeText::One(l.0)).map_err(E::custom)
                }
                fn visit_f64<E: de::Error>(self, v: f64) -> Result<SizeText, E> {
                    Ok(SizeText::One(v))
                }
                fn visit_i64<E: de::Error>(self, v: i64) -> Result<SizeText, E> {
                    Ok(SizeText::One(v as f64))
                }
                fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<SizeText, A::Error> {
                    SizesText::deserialize(MapAccessDeserializer::new(map)).map(|s| SizeText::Distribution(Box::new(s)))
                }
            }
            deserializer.deserialize_any(Size)
        }
    }

    impl<'de> Deserialize<'de> for PlaceText {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            struct Place;
            impl<'de> Visitor<'de> for Place {
                type Value = PlaceText;
                fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                    f.write_str("a point such as [\"0 m\", \"25 mm\", \"0 m\"], or { box = [corner, corner] }, { disc = ... } or { patch = ... }")
                }
                fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<PlaceText, A::Error> {
                    <[Length; 3]>::deserialize(SeqAccessDeserializer::new(seq)).map(|p| PlaceText::Point(p.si()))
                }
                fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PlaceText, A::Error> {
                    PlacesText::deserialize(MapAccessDeserializer::new(map)).map(|p| PlaceText::Place(Box::new(p)))
                }
            }
            deserializer.deserialize_any(Place)
        }
    }

    impl<'de> Deserialize<'de> for RowsText {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            struct Table;
            impl Visitor<'_> for Table {
                type Value = RowsText;
                fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                    f.write_str("\"csv\", \"parquet\" or false")
                }
                fn visit_bool<E: de::Error>(self, v: bool) -> Result<RowsText, E> {
                    Ok(if v { RowsText::default() } else { RowsText(None) })
                }
                fn visit_str<E: de::Error>(self, v: &str) -> Result<RowsText, E> {
                    match v {
                        "csv" => Ok(RowsText(Some(TableFormat::Csv))),
                        "parquet" if carom_table::Format::Parquet.is_built() => {
                            Ok(RowsText(Some(TableFormat::Parquet)))
                        }
                        "parquet" => Err(E::custom(
                            "this build writes no Parquet; build it with the feature `parquet`, or write \"csv\"",
                        )),
                        _ => {
                            let near = did_you_mean(v, ["csv", "parquet"]).map_or(String::new(), |n| format!("{n} "));
                            Err(E::custom(format!(
                                "unknown format of a table '{v}'; {near}known are csv, parquet and false"
                            )))
                        }
                    }
                }
            }
            deserializer.deserialize_any(Table)
        }
    }

    impl<'de> Deserialize<'de> for VelocityText {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            struct Velocity;
            impl<'de> Visitor<'de> for Velocity {
                type Value = VelocityText;
                fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                    f.write_str("a velocity such as [\"2 m/s\", \"0 m/s\", \"0 m/s\"], or \"fluid\"")
                }
                fn visit_str<E: de::Error>(self, v: &str) -> Result<VelocityText, E> {
                    if v == "fluid" {
                        Ok(VelocityText::Fluid)
                    } else {
                        Err(E::invalid_value(de::Unexpected::Str(v), &self))
                    }
                }
                fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<VelocityText, A::Error> {
                    <[Speed; 3]>::deserialize(SeqAccessDeserializer::new(seq)).map(|p| VelocityText::Given(p.si()))
                }
            }
            deserializer.deserialize_any(Velocity)
        }
    }
}
