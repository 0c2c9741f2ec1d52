//! What an impact came to as numbers and words: NaN, and a fate that says why, where it was none.

use carom::{Contact, Energy, Fate, ImpactError, Outcome};

/// An outcome, or why there was no impact.
pub type Met = Result<Outcome, ImpactError>;

/// The columns of a batch.
pub const COLUMNS: [&str; 5] = ["normal", "tangential", "spin", "restitution", "impulse_ratio"];

/// Every word that [`fate`] may give.
pub const FATES: [&str; 9] = [
    "rebound",
    "capture",
    "not-approaching",
    "bad-diameter",
    "bad-density",
    "not-finite",
    "friction-not-given",
    "bad-curvature",
    "no-impact",
];

/// How it went.
pub fn fate(met: &Met) -> &'static str {
    match met {
        Ok(out) => out.fate.name(),
        Err(ImpactError::NotApproaching) => "not-approaching",
        Err(ImpactError::Diameter) => "bad-diameter",
        Err(ImpactError::Density) => "bad-density",
        Err(ImpactError::NotFinite) => "not-finite",
        Err(ImpactError::FrictionNotGiven) => "friction-not-given",
        Err(ImpactError::Curvature) => "bad-curvature",
        Err(_) => "no-impact",
    }
}

/// An outcome as a batch writes it, in the order of [`COLUMNS`]. Zeros have no sign, which says nothing here and need not be the same in both.
#[inline]
pub fn as_row(out: &Outcome) -> [f64; 5] {
    match out.fate {
        Fate::Capture => [0.0, 0.0, 0.0, 0.0, f64::NAN],
        Fate::Rebound => {
            [out.velocity[1] + 0.0, out.velocity[0] + 0.0, 0.0 - out.spin[2], out.restitution, out.impulse_ratio]
        }
    }
}

/// The numbers of [`COLUMNS`].
#[inline]
pub fn row(met: &Met) -> [f64; 5] {
    met.as_ref().map_or([f64::NAN; 5], as_row)
}

/// e_t; NaN for a capture.
pub fn tangential_restitution(met: &Met) -> f64 {
    met.as_ref().map_or(f64::NAN, |out| out.tangential_restitution)
}

/// How the contact ended.
pub fn contact(met: &Met) -> Contact {
    met.as_ref().map_or(Contact::None, |out| out.contact)
}

/// Shares of the incident energy by name.
pub fn energy(met: &Met) -> [(&'static str, f64); 8] {
    match met {
        Ok(out) => out.energy.named(),
        Err(_) => Energy::default().named().map(|(name, _)| (name, f64::NAN)),
    }
}
