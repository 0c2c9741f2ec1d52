//! Which column of a table is what, by the names that programs write.

use super::{DENSITY, Given, TEMPERATURE, TableError};
use carom::units::{Density, Dissipation, Frequency, Length, SpecificEnergy, Speed, Temperature, UnitError};
use carom_table::{Heading, Sheet, clipped};
use std::collections::BTreeMap;

/// Columns as a case names them: `x`, `y`, `z`, `u`, `v`, `w`, `k`, `epsilon` or `omega`, `T`, `rho` to what stands in the header.
pub type Named = BTreeMap<String, String>;

/// What may be named, the names that programs write for it, and the dimension.
const KNOWN: [(&str, &[&str]); 11] = [
    (
        "x",
        &[
            "points_0",
            "x_coordinate",
            "coordinate_x",
            "coordinates_0",
            "coordinates_x",
            "position_x",
            "position_i",
            "position_0",
            "cx",
            "c_0",
            "c_x",
            "ccx",
            "centroid_x",
            "centroid_i",
        ],
    ),
    (
        "y",
        &[
            "points_1",
            "y_coordinate",
            "coordinate_y",
            "coordinates_1",
            "coordinates_y",
            "position_y",
            "position_j",
            "position_1",
            "cy",
            "c_1",
            "c_y",
            "ccy",
            "centroid_y",
            "centroid_j",
        ],
    ),
    (
        "z",
        &[
            "points_2",
            "z_coordinate",
            "coordinate_z",
            "coordinates_2",
            "coordinates_z",
            "position_z",
            "position_k",
            "position_2",
            "cz",
            "c_2",
            "c_z",
            "ccz",
            "centroid_z",
            "centroid_k",
        ],
    ),
    (
        "u",
        &[
            "u_0",
            "u_x",
            "ux",
            "velocity_0",
            "velocity_x",
            "velocity_i",
            "velocity_u",
            "x_velocity",
            "vx",
            "vel_x",
            "velocity_field_x_component",
            "velocity_x_component",
        ],
    ),
    (
        "v",
        &[
            "u_1",
            "u_y",
            "uy",
            "velocity_1",
            "velocity_y",
            "velocity_j",
            "velocity_v",
            "y_velocity",
            "vy",
            "vel_y",
            "velocity_field_y_component",
            "velocity_y_component",
        ],
    ),
    (
        "w",
        &[
            "u_2",
            "u_z",
            "uz",
            "velocity_2",
            "velocity_z",
            "velocity_k",
            "velocity_w",
            "z_velocity",
            "vz",
            "vel_z",
            "velocity_field_z_component",
            "velocity_z_component",
        ],
    ),
    ("k", &["tke", "turb_kinetic_energy", "turbulent_kinetic_energy", "turbulence_kinetic_energy"]),
    ("epsilon", &["eps", "ep", "turb_diss_rate", "turbulent_dissipation_rate", "turbulence_eddy_dissipation"]),
    ("omega", &["om", "specific_diss_rate", "specific_dissipation_rate", "turbulence_eddy_frequency"]),
    ("T", &["temperature", "static_temperature", "temp"]),
    ("rho", &["density"]),
];

/// What an array or a column of that name is.
pub(super) fn alias(name: &str) -> Option<&'static str> {
    let heading = Heading::of(name);
    KNOWN.iter().find(|(key, others)| is(&heading, key, others)).map(|(key, _)| *key)
}

/// Whether a heading is a quantity's. A small t is the time.
fn is(heading: &Heading, key: &str, others: &[&str]) -> bool {
    let own = if key == "T" { heading.name == "t" && heading.written.starts_with('T') } else { heading.name == key };
    own || others.contains(&heading.name.as_str())
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    /// A coordinate.
    Place(usize),
    /// u, v, w, k or ε (ω in its place), T, ρ.
    Value(usize),
}

/// A column that is used.
#[derive(Debug)]
pub(super) struct Found {
    pub column: usize,
    pub written: String,
    pub quantity: Quantity,
    /// What brings its values to SI units: times the first, plus the second.
    pub factor: f64,
    pub offset: f64,
}

impl Found {
    pub fn is_place(&self) -> bool {
        matches!(self.quantity, Quantity::Place(_))
    }
}

/// A column that says where the others hold.
#[derive(Debug)]
pub(super) struct Mask {
    pub column: usize,
    kind: Validity,
}

/// How an array says what is valid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Validity {
    /// Where it is not zero.
    Mask,
    /// Where the bit of hidden points (2) is not set.
    GhostPoints,
    /// Where the bit of hidden cells (32) is not set.
    GhostCells,
}

impl Validity {
    /// By the name of an array.
    pub fn of(name: &str, cells: bool) -> Option<Self> {
        let ghost = if cells { Self::GhostCells } else { Self::GhostPoints };
        match name.to_ascii_lowercase().as_str() {
            "vtkvalidpointmask" | "vtkvalidcellmask" => Some(Self::Mask),
            "vtkghosttype" => Some(ghost),
            _ => None,
        }
    }

    /// Whether data hold where the array has that value.
    pub fn holds(self, value: f64) -> bool {
        let bit = |b: u32| (value as u32) & b == 0;
        match self {
            Self::Mask => value != 0.0,
            Self::GhostPoints => bit(2),
            Self::GhostCells => bit(32),
        }
    }
}

impl Mask {
    pub fn holds(&self, value: f64) -> bool {
        self.kind.holds(value)
    }
}

/// The columns of a table.
#[derive(Debug)]
pub(super) struct Columns {
    pub found: Vec<Found>,
    pub masks: Vec<Mask>,
    pub given: Given,
    /// Whether ω stands in ε's place.
    pub by_frequency: bool,
    /// What is left out.
    pub notes: Vec<String>,
}

impl Columns {
    /// Whether a name is one of a table's columns.
    pub fn knows(name: &str, named: &Named) -> bool {
        let alias = KNOWN.iter().any(|(key, others)| key.eq_ignore_ascii_case(name) || others.contains(&name));
        alias || named.values().any(|written| Heading::of(written).name == name)
    }

    pub fn find(sheet: &Sheet, named: &Named) -> Result<Self, TableError> {
        let headings = sheet.headings();
        let mut places = [None; KNOWN.len()];
        for (place, (key, aliases)) in places.iter_mut().zip(KNOWN) {
            *place = match named.get(key) {
                Some(written) => Some(as_named(headings, key, written)?),
                None => {
                    let taken = |i: usize| named.values().any(|w| same(&headings[i], w));
                    let fits = |i: &usize| is(&headings[*i], key, aliases) && !taken(*i);
                    let mut all = (0..headings.len()).filter(fits);
                    let first = all.next();
                    if let (Some(a), Some(b)) = (first, all.next()) {
                        let (a, b) = (headings[a].written.clone(), headings[b].written.clone());
                        return Err(TableError::TwoColumns { key, a, b });
                    }
                    first
                }
            };
        }
        for (i, (key, _)) in KNOWN.iter().enumerate() {
            if let Some(other) = (0..i).find(|j| places[*j].is_some() && places[*j] == places[i]) {
                return Err(TableError::OneColumn { keys: [KNOWN[other].0, key] });
            }
        }
        let [.., u, _, _, k, epsilon, omega, temperature, density] = places;
        if u.is_none() {
            let all: Vec<String> = headings.iter().map(|h| format!("\"{}\"", clipped(&h.written))).take(20).collect();
            return Err(TableError::NoVelocity { line: sheet.line(), columns: all.join(", ") });
        }
        let rate = epsilon.or(omega);
        let turbulent = k.is_some() && rate.is_some();
        let (mut notes, by_frequency) = (Vec::new(), turbulent && epsilon.is_none());
        let told = |key: &str| named.contains_key(key);
        if !turbulent && (told("k") || told("epsilon") || told("omega")) {
            return Err(TableError::HalfTurbulent);
        }
        if told("rho") && temperature.is_none() {
            return Err(TableError::DensityAlone);
        }
        let given = Given {
            turbulence: turbulent,
            temperature: temperature.is_some(),
            density: temperature.is_some() && density.is_some(),
        };
        let mut columns = Self { found: Vec::new(), masks: Vec::new(), given, by_frequency, notes: Vec::new() };
        let mut used = vec![false; headings.len()];
        for (index, place) in places.into_iter().enumerate() {
            let Some(column) = place else { continue };
            let quantity = match index {
                0..3 => Quantity::Place(index),
                3..6 => Quantity::Value(index - 3),
                6 if turbulent => Quantity::Value(3),
                7 if turbulent => Quantity::Value(4),
                8 if by_frequency => Quantity::Value(4),
                9 => Quantity::Value(TEMPERATURE),
                10 if given.density => Quantity::Value(DENSITY),
                _ => continue,
            };
            let heading = &headings[column];
            let told = named.get(KNOWN[index].0).and_then(|written| Heading::of(written).unit);
            if let (Some(a), Some(b)) = (&heading.unit, &told)
                && a != b
            {
                return Err(TableError::TwoUnits { a: heading.written.clone(), b: b.clone() });
            }
            let remark = if index < 3 { sheet.remark("length unit") } else { None };
            let unit = told.as_deref().or(heading.unit.as_deref()).or(remark);
            let (factor, offset) = to_si(index, unit)
                .map_err(|e| TableError::Unit { column: heading.written.clone(), what: e.to_string() })?;
            columns.found.push(Found { column, written: heading.written.clone(), quantity, factor, offset });
            used[column] = true;
        }
        for (column, heading) in headings.iter().enumerate() {
            if let Some(kind) = Validity::of(&heading.written, false) {
                columns.masks.push(Mask { column, kind });
                used[column] = true;
            }
        }
        if (k.is_some() || rate.is_some()) && !turbulent {
            notes.push("turbulence is left out: k and epsilon (or omega) are wanted together".to_owned());
        }
        if density.is_some() && !given.density {
            notes.push(DENSITY_ALONE.to_owned());
        }
        notes.extend(left_out(headings, &used));
        columns.notes = notes;
        Ok(columns)
    }
}

/// What to say of a density without a temperature.
pub(super) const DENSITY_ALONE: &str = "density is left out: it is wanted together with the temperature";

/// Whether a heading is what a case calls it.
fn same(heading: &Heading, written: &str) -> bool {
    heading.written == written.trim() || heading.name == Heading::of(written).name
}

/// The column that a case names.
fn as_named(headings: &[Heading], key: &'static str, written: &str) -> Result<usize, TableError> {
    let exact = headings.iter().position(|h| h.written == written.trim());
    let mut alike = (0..headings.len()).filter(|i| same(&headings[*i], written));
    match (exact, alike.next(), alike.next()) {
        (Some(i), ..) | (None, Some(i), None) => Ok(i),
        (None, Some(a), Some(b)) => {
            let (a, b) = (headings[a].written.clone(), headings[b].written.clone());
            Err(TableError::TwoColumns { key, a, b })
        }
        (None, None, _) => {
            let all: Vec<String> = headings.iter().map(|h| format!("\"{}\"", clipped(&h.written))).take(20).collect();
            Err(TableError::NotThere { written: written.to_owned(), columns: all.join(", ") })
        }
    }
}

/// The names of columns that nothing reads.
fn left_out(headings: &[Heading], used: &[bool]) -> Option<String> {
    let idle = headings.iter().zip(used).enumerate().filter(|(_, (_, used))| !**used);
    let name = |i: usize, h: &Heading| {
        if h.written.is_empty() { format!("column {} (no name)", i + 1) } else { clipped(&h.written).into_owned() }
    };
    let mut names: Vec<String> = idle.map(|(i, (h, _))| name(i, h)).collect();
    let more = names.len().saturating_sub(8);
    names.truncate(8);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    (!names.is_empty()).then(|| format!("not used: {}{rest}", names.join(", ")))
}

/// What brings values in a unit to SI: a factor, and what is then added.
fn to_si(index: usize, unit: Option<&str>) -> Result<(f64, f64), UnitError> {
    let Some(unit) = unit else { return Ok((1.0, 0.0)) };
    // STAR-CCM+ writes J/kg-s for J/(kg s)
    let of = |n: &str| format!("{n} {}", unit.replace("kg-s", "kg/s"));
    let one = of("1");
    let factor = match index {
        0..3 => one.parse::<Length>()?.0,
        3..6 => one.parse::<Speed>()?.0,
        6 => one.parse::<SpecificEnergy>()?.0,
        7 => one.parse::<Dissipation>()?.0,
        8 => one.parse::<Frequency>()?.0,
        9 => return temperature(unit),
        _ => one.parse::<Density>()?.0,
    };
    Ok((factor, 0.0))
}

/// A scale of temperature that may begin elsewhere than the absolute one; C and F stand for degrees.
fn temperature(unit: &str) -> Result<(f64, f64), UnitError> {
    let scale = match unit {
        "C" => "degC",
        "F" => "degF",
        other => other,
    };
    let zero = format!("0 {scale}").parse::<Temperature>()?.0;
    let hundred = format!("100 {scale}").parse::<Temperature>()?.0;
    Ok(((hundred - zero) / 100.0, zero))
}
