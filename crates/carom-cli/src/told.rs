//! What other fronts show as the command does.

use crate::failure::Failure;
use crate::impact;
use crate::law::Law;
use crate::motion::{Motion, refused};
use crate::report::{self, Made};
use carom::WallLaw;
use carom::spec::LawSpec;
use carom_track::{About, Summary};
use std::path::Path;
use std::time::Duration;

/// What `carom impact` prints of one impact: a sphere of a diameter (m) at a speed (m/s) and an angle (degrees from the surface) with a
/// spin (rad/s), on the law `wall` that was compiled from `spec`.
///
/// # Errors
/// No impact: what is wrong with it.
pub fn told(spec: &LawSpec, wall: &WallLaw, diameter: f64, [speed, angle, spin]: [f64; 3]) -> Result<String, String> {
    let motion = Motion { diameter, speed, angle, spin };
    let law = Law::of(spec.clone(), wall.clone());
    let met = motion.meet(&law.wall).map_err(|e| refused(e, &motion)).map_err(said)?;
    impact::printed(&law, &motion, &met).map_err(said)
}

/// Adds to the folder of a finished run what the command does: the picture of its paths and the report.
///
/// # Errors
/// What cannot be read or written.
pub fn write_report(about: &About, summary: &Summary, folder: &Path, took: Option<Duration>) -> Result<(), String> {
    report::write(about, summary, folder, Some(&Made::now(took))).map_err(said)
}

fn said(failure: Failure) -> String {
    match failure {
        Failure::Input(message) | Failure::Other(message) => message,
        Failure::InFile(report) => report.to_string(),
        Failure::BrokenPipe => "the output was closed".to_owned(),
    }
}
