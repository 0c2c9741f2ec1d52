//! The finished flows of `examples/cfd`: spheres through them against what others measured or computed.

#[path = "../examples/study/mod.rs"]
mod study;

use carom_track::record::{Event, ParticleFate};
use study::{CaseFile, Paths, Result, meters, track};

/// Every case file beside a finished flow runs with a few spheres, and none gets stuck.
#[test]
fn every_case_runs_with_a_few_spheres() -> Result<()> {
    for name in ["pitz-daily", "bend-90", "chamber", "wind-tunnel", "impactor"] {
        let mut file = CaseFile::read(&format!("cfd/{name}/{name}.toml"))?;
        for injection in file.list("injection") {
            if injection.contains_key("count") {
                injection.insert("count".into(), 4.into());
            }
        }
        let case = if name == "chamber" { file.set("run.until", "1 s") } else { file }.case()?;
        let tracks = track(&case, Paths::Dropped);
        assert_eq!(tracks.len() as u64, case.count(), "{name}");
        assert!(tracks.iter().all(|t| t.end.fate != ParticleFate::Stuck), "{name}");
    }
    Ok(())
}

/// The share of 100 drops of a Stokes number ρ d² U/(18 μ R) that the bend keeps.
fn bend(case: &CaseFile, stokes: f64) -> Result<f64> {
    let diameter = (18.0 * 18e-6 * 5e-3 * stokes / (1000.0 * 1.5)).sqrt();
    let case =
        case.clone().set_each("injection", "diameter", meters(diameter)).set_each("injection", "count", 100).case()?;
    let bend = case.domain.walls().iter().position(|w| w.name == "bend");
    let tracks = track(&case, Paths::Dropped);
    Ok(tracks.iter().filter(|t| t.end.fate == ParticleFate::Trapped && t.end.wall == bend).count() as f64
        / tracks.len() as f64)
}

/// Pui, Romay-Novas & Liu 1987 measured 37.7 and 74.6 %: between what a parabolic and what a flat profile at the inlet give.
#[test]
fn the_bend_keeps_what_was_measured_between_a_parabola_and_a_flat_profile() -> Result<()> {
    let parabola = CaseFile::read("cfd/bend-90/bend-90.toml")?;
    let flat = parabola.clone().set("flow.fields.velocity", "UPlug");
    for (stokes, measured) in [(0.33, 0.377), (0.44, 0.746)] {
        let (most, least) = (bend(&parabola, stokes)?, bend(&flat, stokes)?);
        assert!(least < measured && measured < most, "{stokes}: {least} {measured} {most}");
    }
    Ok(())
}

/// The bounces that the OpenFOAM plug-in's parcels make in the same air (plugins/openfoam/README.md): with OpenFOAM's drag law the same ones.
#[test]
fn spheres_bounce_in_the_tunnel_where_the_plug_in_has_them() -> Result<()> {
    let case =
        CaseFile::read("cfd/wind-tunnel/wind-tunnel.toml")?.set("forces.drag", "putnam").set("forces.slip", "none");
    let tracks = track(&case.case()?, Paths::Dropped);
    let theirs: [&[f64]; 2] = [&[72.1, 229.3, 353.2, 442.2, 501.4, 536.4, 551.7], &[142.3, 269.4, 337.4, 367.3]];
    for (track, theirs) in tracks.iter().zip(theirs) {
        assert_eq!(track.end.fate, ParticleFate::Captured);
        let impacts: Vec<_> =
            track.impacts.iter().filter(|i| matches!(i.event, Event::Rebound | Event::Capture)).collect();
        assert_eq!(impacts.len(), theirs.len());
        for (impact, theirs) in impacts.iter().zip(theirs) {
            assert!((impact.position[0] * 1e3 - theirs).abs() < 1.0, "{:?} {theirs}", impact.position);
        }
    }
    Ok(())
}

/// Half is collected at √Stk = 0.49 in round impactors (Hinds 1999, Aerosol Technology, table 5.4), a tenth either way among designs.
#[test]
fn half_is_collected_where_round_impactors_do() -> Result<()> {
    let case =
        CaseFile::read("cfd/impactor/impactor.toml")?.without("output.size_bins").set_each("injection", "count", 100);
    let share = |diameter: f64| -> Result<f64> {
        let tracks = track(&case.clone().set_each("injection", "diameter", meters(diameter)).case()?, Paths::Dropped);
        Ok(tracks.iter().filter(|t| t.end.fate == ParticleFate::Trapped).count() as f64 / tracks.len() as f64)
    };
    // √Stk = 0.44 and 0.54
    let (below, above) = (share(0.734e-6)?, share(0.918e-6)?);
    assert!(below < 0.5 && above > 0.5, "{below} {above}");
    Ok(())
}
