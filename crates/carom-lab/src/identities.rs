//! Identities: what must hold by construction. They test the program, not the model, and are no evidence about nature.

use crate::error::LabError;
use crate::resolved::Forms;
use carom::material::Library;
use carom::normal::{plastic, thornton_ning};
use carom::spec::parse_law;
use carom::{Impact, Outcome, WallLaw};
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
        identity("rolling from rest keeps 5/7 of the tangential speed", rolling(library)?, 1e-14),
        identity(
            "what the ledger says is kept = the energy of the rebound's own motion, oblique and spinning",
            energy(library)?,
            1e-14,
        ),
    ])
}

fn wall(normal: &str, library: &Library) -> Result<WallLaw, LabError> {
    let text = format!("sphere = \"copper\"\nsurface = \"aluminium\"\nfriction = 0.3\n{normal}");
    parse_law(&text).and_then(|l| l.compile(library)).map_err(|error| LabError::Experiment {
        name: "identities".into(),
        text,
        error,
    })
}

fn hit(wall: &WallLaw, impact: &Impact) -> Result<Outcome, LabError> {
    wall.impact(impact).map_err(|e| LabError::Model(format!("identities: {e}")))
}

fn rolling(library: &Library) -> Result<f64, LabError> {
    let wall = wall("normal = \"constant\"\nrestitution = 0.8\n", library)?;
    let out = hit(&wall, &Impact::new(90e-6, [0.1, -2.0, 0.0], [0.0, 1.0, 0.0]))?;
    Ok((out.tangential_restitution - 5.0 / 7.0).abs())
}

fn energy(library: &Library) -> Result<f64, LabError> {
    let wall = wall("normal = \"ea\"\n", library)?;
    let mut impact = Impact::new(90e-6, [5.0, -2.0, 1.0], [0.0, 1.0, 0.0]);
    impact.spin = [1e4, -2e4, 3e4];
    let out = hit(&wall, &impact)?;
    let square = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
    let motion = |v: &[f64; 3], spin: &[f64; 3]| square(v) + 0.4 * 45e-6 * 45e-6 * square(spin);
    Ok((motion(&out.velocity, &out.spin) / motion(&impact.velocity, &impact.spin) - out.energy.kept).abs())
}
