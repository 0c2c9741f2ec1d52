//! Measured points over the curves of a prediction: nothing is fitted.

use super::{Args, Shown};
use crate::failure::Failure;
use crate::grid::{Grid, Swept};
use crate::output;
use crate::text::plotted;
use carom::study::Given;
use carom_lab::fit::{Data, Measurement};
use carom_report::{Plot, Series};
use std::path::Path;

/// The points of a file as series, one for each diameter.
pub fn read(path: &Path, args: &Args, grid: &Grid) -> Result<Vec<Series>, Failure> {
    let of: fn(&Measurement) -> Option<f64> = match args.quantity {
        Shown::Restitution => |m| m.restitution,
        Shown::TangentialRestitution => |m| m.tangential_restitution,
        _ => {
            let message = "--data: measured are restitution and tangential restitution; --quantity shows neither";
            return Err(Failure::input(message));
        }
    };
    let along: fn(&Measurement) -> f64 = match grid.quantity() {
        Swept::Speed => |m| m.speed,
        Swept::Diameter => |m| m.diameter,
        Swept::Angle => |m| m.angle_deg,
        other => {
            let message = format!(
                "--data: points have a speed, a diameter and an angle, but no {}; no --over of it",
                other.flag()
            );
            return Err(Failure::input(message));
        }
    };
    let usual = args.case.motion.diameter.as_ref().and_then(Given::one);
    let data = Data::from_csv(&path.display().to_string(), &output::read_points(path)?, usual)?;
    crate::validate::tell_left_out(&data.name, &data.left_out);
    let groups = if grid.quantity() == Swept::Diameter { vec![f64::NAN] } else { data.diameters() };
    let several = groups.len() > 1;
    let series: Vec<Series> = groups
        .iter()
        .filter_map(|diameter| {
            let near = |m: &&Measurement| diameter.is_nan() || (m.diameter / diameter - 1.0).abs() <= 0.03;
            let told: Vec<_> =
                data.points.iter().filter(near).filter_map(|m| Some((along(m), of(m)?, m.sigma))).collect();
            let label = if several { format!("measured, {}", plotted(*diameter, "m")) } else { "measured".to_owned() };
            let points = Series::points(label, told.iter().map(|t| t.0), told.iter().map(|t| t.1));
            let sigma: Option<Vec<f64>> = told.iter().map(|t| t.2).collect();
            (!told.is_empty()).then(|| match sigma {
                Some(sigma) => points.deviation(sigma),
                None => points,
            })
        })
        .collect();
    if series.is_empty() {
        return Err(Failure::input(format!("--data {}: no point has what --quantity shows", path.display())));
    }
    Ok(series)
}

/// Draws them over a plot.
pub fn over(plot: Plot, measured: &[Series]) -> Plot {
    measured.iter().cloned().fold(plot, Plot::with)
}
