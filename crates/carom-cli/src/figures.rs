//! The figures of a wall law for one diameter, shared by `impact` and `capture`.

use crate::failure::Failure;
use crate::text::{Lines, number, quantity, scaled};
use carom::WallLaw;
use carom::normal::NormalLaw;

/// Window of rebound, yield velocity, adhesion numbers, contact constants. Keys as in the JSON.
#[derive(serde::Serialize)]
pub struct Figures {
    /// At and below it the sphere is captured, m/s; none where it never rebounds.
    pub capture_velocity: Option<f64>,
    /// Above it damping alone takes everything, m/s; none without such an end.
    pub exhausted_velocity: Option<f64>,
    /// Is there a speed of rebound at all?
    pub rebounds: bool,
    pub yield_velocity: Option<f64>,
    /// For comparison: what user-defined functions of flow solvers compute, m/s.
    pub el_batsh_capture_velocity: Option<f64>,
    #[serde(skip)]
    plastic_ends_it: bool,
    pub roughness_factor: f64,
    pub adhesion_numbers: Option<AdhesionNumbers>,
    pub pair: Option<Pair>,
}

#[derive(serde::Serialize)]
pub struct AdhesionNumbers {
    tabor: f64,
    regime: &'static str,
    adhesion_parameter: Option<f64>,
    #[serde(skip)]
    asperities: bool,
    equilibrium_spacing: f64,
}

/// Contact constants, each `None` where the materials do not give it.
#[derive(serde::Serialize)]
pub struct Pair {
    sphere: String,
    surface: String,
    density: Option<f64>,
    stiffness: Option<f64>,
    work_of_adhesion: Option<f64>,
    plastic_constant: Option<f64>,
}

impl Figures {
    /// The figures for a diameter in m.
    pub fn new(wall: &WallLaw, diameter: f64) -> Result<Self, Failure> {
        let refused = |e: carom::ImpactError| Failure::input(format!("--diameter {}: {e}", scaled(diameter, "m")));
        let window = wall.window(diameter, None).map_err(refused)?;
        let numbers = wall.adhesion_numbers(diameter).map_err(refused)?;
        Ok(Self {
            capture_velocity: window.map(|w| w.capture_velocity),
            exhausted_velocity: window.map(|w| w.exhausted_velocity).filter(|v| v.is_finite()),
            rebounds: window.is_some(),
            yield_velocity: wall.yield_velocity(diameter, None).map_err(refused)?,
            el_batsh_capture_velocity: wall.el_batsh_capture_velocity(diameter),
            plastic_ends_it: matches!(wall.normal(), NormalLaw::Ledger(l) if l.terms().any(|t| t.loss() == carom::normal::Loss::PlasticBons)),
            roughness_factor: wall.roughness_factor(),
            adhesion_numbers: numbers.map(|n| AdhesionNumbers {
                tabor: n.tabor,
                regime: n.regime.name(),
                adhesion_parameter: n.adhesion_parameter,
                asperities: n.asperities,
                equilibrium_spacing: n.spacing,
            }),
            pair: wall.pair().map(|p| Pair {
                sphere: p.sphere().name.clone(),
                surface: p.surface().name.clone(),
                density: p.density().ok(),
                stiffness: p.stiffness().ok(),
                work_of_adhesion: p.work_of_adhesion().ok(),
                plastic_constant: p.plastic_constant().ok(),
            }),
        })
    }

    /// Tabor's parameter, if there is one.
    pub fn tabor(&self) -> Option<f64> {
        self.adhesion_numbers.as_ref().map(|n| n.tabor)
    }

    /// Its verdict: JKR, transition or DMT.
    pub fn regime(&self) -> Option<&'static str> {
        self.adhesion_numbers.as_ref().map(|n| n.regime)
    }

    /// Adds the comparison with what user-defined functions compute.
    pub fn compare(&self, lines: &mut Lines) {
        if let Some(v) = self.el_batsh_capture_velocity {
            lines.add(
                "El-Batsh form",
                format!(
                    "as in UDFs: {} (its 0.51 is one material's adhesion, whatever the pair: for comparison only)",
                    quantity(v, "m/s")
                ),
            );
        }
    }

    /// Adds them as lines.
    pub fn tell(&self, lines: &mut Lines) {
        match self.capture_velocity {
            None => lines.add("capture velocity", "none: it is captured at every speed"),
            Some(0.0) => lines.add("capture velocity", "0: this law captures nothing"),
            Some(v) => lines.add("capture velocity", quantity(v, "m/s")),
        }
        if let Some(v) = self.exhausted_velocity {
            let why = if self.plastic_ends_it && self.yield_velocity.is_some_and(|y| v > y) {
                "the plastic loss leaves less than adhesion or damping takes"
            } else {
                "damping takes everything: the end of the model"
            };
            lines.add("exhausted above", format!("{} ({why})", quantity(v, "m/s")));
        }
        if let Some(v) = self.yield_velocity {
            lines.add("yield velocity", quantity(v, "m/s"));
        }
        if let Some(pair) = &self.pair {
            let constants = [
                pair.stiffness.map(|k| format!("stiffness {}", scaled(k, "Pa"))),
                pair.work_of_adhesion.map(|w| format!("work of adhesion {}", quantity(w, "J/m2"))),
            ];
            let mut shown: Vec<String> = constants.into_iter().flatten().collect();
            if self.roughness_factor != 1.0 {
                shown.push(format!("C_R {}", number(self.roughness_factor)));
            }
            if !shown.is_empty() {
                lines.add("pair", shown.join(", "));
            }
        }
        if let Some(n) = &self.adhesion_numbers {
            let mut text = format!("Tabor's parameter {} ({})", number(n.tabor), n.regime);
            if let Some(theta) = n.adhesion_parameter {
                let of = if n.asperities { " of the asperities" } else { "" };
                text += &format!(", adhesion parameter{of} {}", number(theta));
            }
            lines.add("adhesion", text);
        }
    }
}
