//! What happened on the faces of walls made of triangles: the body seen from aside, and what impacts took away of each wall.

use crate::failure::Failure;
use carom_report::{Axis, Body, Column, Report, Table};
use carom_track::{DepositFace, Summary, deposit_faces};
use std::path::Path;

/// Values that differ by more are shown on a logarithmic scale.
const WIDE: f64 = 300.0;
/// Decades of it: what is smaller has the colour of its lower end.
const DECADES: f64 = 1e-5;

pub fn section(page: &mut Report, summary: &Summary, folder: &Path) -> Result<(), Failure> {
    let eroding: Vec<_> = summary.walls.iter().filter_map(|w| Some((w, w.eroded.as_ref()?.value()))).collect();
    let faces = deposit_faces(folder).map_err(crate::run::failed)?;
    let kept = picture(&faces, "mass kept per area", |f| f.mass);
    if eroding.is_empty() && kept.is_none() {
        return Ok(());
    }
    page.section("Faces and erosion");
    if let Some(body) = kept {
        page.figure(
            &body.svg()?,
            "What the faces of walls made of triangles kept, per area. Grey faces kept nothing. deposit.vtp has them all, for ParaView.",
        );
    }
    if eroding.is_empty() {
        return Ok(());
    }
    if let Some(body) = picture(&faces, "mass lost per area", |f| f.eroded) {
        page.figure(
            &body.svg()?,
            "What impacts took away of these faces, per area. Grey faces lost nothing or have no law of erosion.",
        );
    }
    let table = Table::new([
        Column::text("wall", eroding.iter().map(|(w, _)| w.name.as_str())),
        Column::count("impacts", eroding.iter().map(|(w, _)| w.impacts)),
        Column::float("mass lost", "kg", eroding.iter().map(|(_, lost)| *lost)),
        Column::float(
            "over the mass injected",
            "kg/kg",
            eroding.iter().map(|(_, lost)| lost / summary.injected.mass.value()),
        ),
    ])?;
    page.table(&table, "What impacts took away of each wall with a law of erosion.");
    Ok(())
}

/// The body, coloured by a mass per area; none where no face has any.
fn picture(faces: &[DepositFace], name: &str, mass: impl Fn(&DepositFace) -> f64) -> Option<Body> {
    let values = faces.iter().map(|f| {
        let per_area = mass(f) / area(&f.corners);
        (f.corners, if per_area > 0.0 && per_area.is_finite() { per_area } else { f64::NAN })
    });
    let triangles: Vec<_> = values.collect();
    let known = || triangles.iter().map(|t| t.1).filter(|v| !v.is_nan());
    let (low, high) = known().fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
    if high <= 0.0 {
        return None;
    }
    let axis = Axis::new(name, "kg/m²");
    let axis = if high > WIDE * low { axis.log().range(low.max(high * DECADES), high) } else { axis.range(0.0, high) };
    Some(Body::new(axis, triangles))
}

fn area(corners: &[[f64; 3]; 3]) -> f64 {
    let edge = |i: usize| [0, 1, 2].map(|c| corners[i][c] - corners[0][c]);
    let (a, b) = (edge(1), edge(2));
    let n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()
}
