//! Identities: what must hold by construction. They test the program, not the model, and are no evidence about nature.

use crate::error::LabError;
use crate::resolved::Forms;
use carom::material::Library;
use carom::normal::{plastic, thornton_ning};
use carom::spec::parse_law;
use carom::{Impact, WallLaw};
use serde::Serialize;

/// An identity and by how much the program misses it.
#[derive(Clone, Debug, Serialize)]
pub struct Identity {
    /// What must be equal.
    pub says: String,
    /// By how much it is not.
    pub off: f64,
    /// What rounding or the integrator allows.
    pub allowed: f64,
}

/// Checks them all.
///
/// # Errors
/// Materials that the library lacks.
pub fn identities(forms: &Forms, library: &Library) -> Result<Vec<Identity>, LabError> {
    let identity = |says: &str, off: f64, allowed: f64| Identity { says: says.to_owned(), off, allowed };
    let wall = oblique(library)?;
    Ok(vec![
        identity(
            "resolved contact, adhesion while separating, undamped = algebraic form (Kim & Dunn 2007, Eq. 24 with C_A = C_H = 0), 0.03 to 100 m/s",
            forms.undamped,
            1e-9,
        ),
        identity(
            "e = 1 at the yield velocity, Kadomtsev's plastic loss",
            (plastic::universal(1.0, 0.33) - 1.0).abs(),
            1e-14,
        ),
        identity(
            "e = 1 at the yield velocity, Thornton & Ning's plastic loss (Eq. 44)",
            (thornton_ning::restitution_squared(1.0).sqrt() - 1.0).abs(),
            1e-14,
        ),
        identity("rolling from rest keeps 5/7 of the tangential speed", rolling(&wall)?, 1e-14),
        identity("the energy fractions of an oblique impact sum to 1", energy(&wall)?, 1e-14),
    ])
}

fn oblique(library: &Library) -> Result<WallLaw, LabError> {
    let text = "sphere = \"copper\"\nsurface = \"aluminium\"\nnormal = \"eap\"\nfriction = 0.3\n".to_owned();
    parse_law(&text).and_then(|l| l.compile(library)).map_err(|error| LabError::Experiment {
        name: "identities".into(),
        text,
        error,
    })
}

fn hit(wall: &WallLaw, tangential: f64) -> Result<carom::Outcome, LabError> {
    let impact = Impact::new(90e-6, [tangential, -2.0, 0.0], [0.0, 1.0, 0.0]);
    wall.impact(&impact).map_err(|e| LabError::Model(format!("identities: {e}")))
}

fn rolling(wall: &WallLaw) -> Result<f64, LabError> {
    Ok((hit(wall, 0.1)?.tangential_restitution - 5.0 / 7.0).abs())
}

fn energy(wall: &WallLaw) -> Result<f64, LabError> {
    let sum: f64 = hit(wall, 5.0)?.energy.named().iter().map(|(_, share)| share).sum();
    Ok((sum - 1.0).abs())
}
