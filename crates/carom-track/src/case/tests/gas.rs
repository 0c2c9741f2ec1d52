//! A gas whose state the flow gives place by place.

use super::*;
use crate::flow::Fluid;
use crate::force::{Drag, Forces, Slip, Sphere, relaxation_time, thermophoresis};
use crate::record::End;

const DENSITY: f64 = 1000.0;

/// A case in still gas with that table along y, or along x.
fn case(
    folder: &Path,
    table: &str,
    fluid: &str,
    forces: &str,
    injection: &str,
    until: &str,
) -> Result<Case, CaseError> {
    std::fs::write(folder.join("gas.csv"), table).expect("a file");
    let text = format!(
        "[fluid]\n{fluid}\n[flow]\nkind = \"table\"\nfile = \"gas.csv\"\n[forces]\n{forces}\n[[injection]]\ndensity = {DENSITY}\n{injection}\n[run]\nuntil = \"{until}\"\ntolerance = 1e-8\n"
    );
    Case::from_toml(&text, &folder.join("case.toml"), Library::builtin())
}

fn end(case: &Case) -> End {
    let mut ends = Ends::default();
    case.tracker().run(&mut case.particle(0).into_iter(), &mut ends).expect("a run");
    ends.0[0]
}

const STILL: &str = "velocity = [0, 0, 0]";

#[test]
fn spheres_settle_in_the_gas_that_is_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    // (ρ_p − ρ) g d² C_c/(18 μ) of 2 µm at 1 atm, worked out apart: in the run's gas it is 1.28e-4 m/s
    for (temperature, density, want) in [
        (250.0, 1.411_949_137_780_874_2, 1.452_172_709_881_912_5e-4),
        (600.0, 0.588_312_140_742_031, 8.632_055_372_263_097e-5),
    ] {
        for rho in [format!(",{density}"), String::new()] {
            let head = if rho.is_empty() { "y,u,T" } else { "y,u,T,rho" };
            let table = format!("{head}\n-1,0,{temperature}{rho}\n1,0,{temperature}{rho}\n");
            let at = format!("diameter = \"2 um\"\nposition = [0, 0, 0]\n{STILL}");
            let forces = "gravity = [0, -9.81, 0]\ndrag = \"stokes\"";
            let speed = -end(&case(folder, &table, "", forces, &at, "10 ms").unwrap()).velocity[1];
            assert!((speed / want - 1.0).abs() < 1e-7, "{temperature} {speed} {want}");
        }
    }
}

#[test]
fn drag_follows_the_temperature_on_the_way() {
    // no slip, no weight: v falls by 18 ∫ μ(T(x)) dx/(ρ_p d²), whatever the step's method
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let table = "x,u,T\n-1e-3,0,1000\n1e-3,0,200\n9e-3,0,1800\n";
    let temperature = |x: f64| if x < 1e-3 { 600.0 - 4e5 * x } else { 200.0 + 2e5 * (x - 1e-3) };
    let air = |t: f64| Fluid::air(t, 101_325.0).unwrap();
    for (d, speed, until) in [(5e-5, 0.3, "60 ms"), (1e-5, 5.0, "3 ms"), (3e-5, 1.0, "25 ms")] {
        let at = format!("diameter = {d}\nposition = [0, 0, 0]\nvelocity = [{speed}, 0, 0]");
        let forces = "drag = \"stokes\"\nslip = \"none\"\nbuoyancy = false";
        let stopped = end(&case(folder, table, "", forces, &at, until).unwrap());
        let mut v = speed;
        let x = stopped.position[0];
        // Simpson on either side of the kink
        for (a, b) in [(0.0, x.min(1e-3)), (1e-3, x.max(1e-3))] {
            let mu = |s: f64| air(temperature(a + (b - a) * s)).viscosity;
            let sum: f64 =
                (0..100).map(|i| f64::from(i) / 100.0).map(|s| mu(s) + 4.0 * mu(s + 0.005) + mu(s + 0.01)).sum();
            v -= 18.0 / (DENSITY * d * d) * (b - a) * sum / 600.0;
        }
        let last = stopped.velocity[0];
        assert!((v - last).abs() < 1e-6 * speed && last < 0.1 * speed && x > 1.2e-4, "{d} {x} {v} {last}");
    }
}

#[test]
fn the_runs_own_state_only_sets_the_scale() {
    // the table has the whole state; at 250 K the sphere counts as one that takes explicit steps, at 500 K as one that follows the gas
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let table = "x,y,u,v,T,rho\n0,0,1,0,300,1.1\n1e-2,0,0.5,0.5,400,0.9\n0,1e-2,0.2,-1,350,1\n1e-2,1e-2,0,1,280,1.2\n";
    let forces = "gravity = [0, -9.81, 0]\nsaffman = true\nmagnus = true\nadded_mass = true\npressure_gradient = true";
    let at = "diameter = \"5.6 um\"\nposition = [2e-3, 5e-3, 0]\nvelocity = [0, 3, 0]\nspin = [0, 0, 1e4]";
    let ends = [250.0, 500.0].map(|t| {
        let case = case(folder, table, &format!("temperature = {t}"), forces, at, "5 ms").unwrap();
        (end(&case), case.dynamics.follows(&Sphere { diameter: 5.6e-6, density: DENSITY }))
    });
    assert!(!ends[0].1 && ends[1].1, "one of each");
    for c in 0..2 {
        let (a, b) = (ends[0].0, ends[1].0);
        assert!((a.position[c] - b.position[c]).abs() < 1e-6 * 5e-3, "{a:?} {b:?}");
        assert!((a.velocity[c] - b.velocity[c]).abs() < 1e-6, "{a:?} {b:?}");
    }
}

#[test]
fn thermophoresis_takes_the_tables_gradient() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let table = "x,u,T\n-1e-2,0,250\n1e-2,0,450\n";
    let forces = "thermophoresis = { thermal_conductivity = \"0.2 W/m/K\" }\ndrag = \"stokes\"";
    let sphere = Sphere { diameter: 1e-6, density: DENSITY };
    for (x, temperature) in [(-5e-3, 300.0), (5e-3, 400.0)] {
        let at = format!("diameter = 1e-6\nposition = [{x}, 0, 0]\n{STILL}");
        let v = end(&case(folder, table, "", forces, &at, "1 ms").unwrap()).velocity[0];
        // Talbot's drift in the state of that place
        let gas = Fluid::air(temperature, 101_325.0).unwrap();
        let a = thermophoresis::acceleration(&gas, &sphere, 0.2, temperature, [1e4, 0.0, 0.0])[0];
        let want = a * relaxation_time(&gas, &sphere, Slip::Davies.factor(1e-6, gas.mean_free_path));
        // within a millisecond it goes 0.2 µm, 2 mK
        assert!((v / want - 1.0).abs() < 3e-5 && v < 0.0, "{v} {want}");
        // and against the run with one gradient in one gas
        let constant = format!(
            "[fluid]\ntemperature = {temperature}\ntemperature_gradient = [1e4, 0, 0]\n[forces]\n{forces}\n[[injection]]\ndensity = {DENSITY}\n{at}\n[run]\nuntil = 1e-3\ntolerance = 1e-8\n"
        );
        let other = end(&read(&constant).unwrap()).velocity[0];
        assert!((v / other - 1.0).abs() < 3e-5, "{v} {other}");
    }
    let at = format!("diameter = 1e-6\nposition = [0, 0, 0]\n{STILL}");
    let error = case(folder, table, "temperature_gradient = [1, 0, 0]", forces, &at, "1 s").unwrap_err().to_string();
    assert!(error.contains("two temperature gradients"), "{error}");
}

#[test]
fn what_cannot_be_in_such_a_gas_is_refused_or_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let at = format!("diameter = 1e-6\nposition = [0, 0, 0]\n{STILL}");
    let warm = "x,u,T\n0,0,300\n1,0,400\n";
    let error = case(folder, warm, "", "brownian = true", &at, "1 s").unwrap_err().to_string();
    assert!(error.contains("Brownian motion in a gas whose temperature"), "{error}");
    let celsius = "x,u,T\n0,0,20\n1,0,40\n";
    let error = case(folder, celsius, "", "", &at, "1 s").unwrap_err();
    assert!(error.to_string().contains("from 20.00 K to 40.00 K"), "{error}");
    let water = case(folder, warm, "density = 998\nviscosity = 1e-3\nliquid = true", "", &at, "1 s").unwrap();
    assert!(
        water.domain.fluid(0.0, [0.0; 3]).gas.is_none()
            && water.notes.iter().any(|n| n.contains("temperature is left out"))
    );
    let named = "x,u,Te,D\n0,0,300,1\n1,0,400,1\n";
    std::fs::write(folder.join("named.csv"), named).unwrap();
    let text = format!(
        "[flow]\nkind = \"table\"\nfile = \"named.csv\"\ncolumns = {{ T = \"Te\", rho = \"D\" }}\n[[injection]]\ndensity = 1000\n{at}\n[run]\nuntil = 1\n"
    );
    let case = Case::from_toml(&text, &folder.join("case.toml"), Library::builtin()).unwrap();
    assert!(case.domain.fluid(0.0, [0.0; 3]).gas.is_some());
    let alone = text.replace("T = \"Te\", ", "");
    let error = Case::from_toml(&alone, &folder.join("case.toml"), Library::builtin()).unwrap_err().to_string();
    assert!(error.contains("rho needs T"), "{error}");
}

#[test]
fn every_force_takes_the_local_state() {
    // forces of a local state are those of a run in that state
    let forces = Forces {
        saffman: true,
        magnus: true,
        rotational_drag: true,
        pressure_gradient: true,
        added_mass: true,
        slip: Slip::Davies,
        drag: Drag::SchillerNaumann,
        ..Forces::default()
    };
    let local = crate::flow::Local {
        gradient: [[1.0, 200.0, -3.0], [0.0, -2.0, 40.0], [7.0, 0.0, 1.0]],
        acceleration: [1.0, -2.0, 3.0],
        gas: Some(crate::flow::LocalGas { temperature: 500.0, density: Some(2.0), temperature_gradient: [0.0; 3] }),
        ..crate::flow::Local::uniform([2.0, 0.5, -0.3])
    };
    let dynamics = Dynamics { forces, ..Dynamics::default() };
    let state = crate::flow::GasState { temperature: Some(500.0), density: Some(2.0), ..Default::default() };
    let want = state.fluid().unwrap();
    let sphere = Sphere { diameter: 5e-5, density: 2000.0 };
    let at = |fluid: &Fluid| forces.rates(fluid, &sphere, &local, [1.0, -0.2, 0.1], [100.0, -300.0, 20.0]);
    let (a, b) = (at(&dynamics.fluid_at(&local)), at(&want));
    for (a, b) in a.acceleration.iter().chain(&a.spin).zip(b.acceleration.iter().chain(&b.spin)) {
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    }
}
