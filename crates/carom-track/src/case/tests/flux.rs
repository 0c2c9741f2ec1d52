use super::*;
use crate::record::ParticleFate;
use crate::run::{RunOptions, Silent, run};

const POINT: &str = "position = [\"0 m\", \"25 mm\", \"0 m\"]";
const DISC: &str = "position = { disc = { center = [0, 0.015, 0], normal = [1, 0, 0], radius = 0.01 } }";

#[test]
fn an_injection_by_flux_starts_with_the_fluid() {
    let text = GOOD.replacen(POINT, &format!("{DISC}\ndistribution = \"flux\""), 1);
    let text = text.replacen("velocity = [\"2 m/s\", \"0 m/s\", \"0 m/s\"]\n[run]", "[run]", 1);
    let case = read(&text).unwrap();
    for i in 0..10 {
        let p = case.particle(i).unwrap();
        let y = p.position[1] / 0.03;
        assert!((p.velocity[0] - 12.0 * y * (1.0 - y)).abs() < 1e-12, "{p:?}");
    }
    assert!(!case.notes.iter().any(|n| n.contains("inflow")));
    // a velocity that is given is kept
    let given = text.replacen("[run]", "velocity = [1, 0, 0]\n[run]", 1);
    assert_eq!(read(&given).unwrap().particle(3).unwrap().velocity, [1.0, 0.0, 0.0]);
}

#[test]
fn flux_where_nothing_flows_in_is_refused() {
    refused(POINT, &format!("{POINT}\ndistribution = \"flux\""), &["needs an area, and a point has none"]);
    refused(POINT, &format!("{POINT}\ndistribution = \"flow\""), &["unknown distribution 'flow'", "uniform, flux"]);
    let turned = DISC.replace("[1, 0, 0]", "[-1, 0, 0]");
    refused(POINT, &format!("{turned}\ndistribution = \"flux\""), &["against the disc's normal", "turn the normal"]);
    let side = DISC.replace("[1, 0, 0]", "[0, 1, 0]");
    refused(POINT, &format!("{side}\ndistribution = \"flux\""), &["no fluid flows in there"]);
    let without = "[[injection]]\nname = \"dispenser\"";
    let text = GOOD.replacen("velocity = [\"2 m/s\", \"0 m/s\", \"0 m/s\"]\n[run]", "[run]", 1);
    assert!(text.contains(without) && read(&text).unwrap_err().to_string().contains("needs velocity"));
}

#[test]
fn where_part_of_the_area_lets_fluid_out_it_is_told() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("flow.csv"), "y,u\n0,-1\n0.01,0\n0.03,2\n").unwrap();
    let flow = "kind = \"channel\"\nprofile = \"laminar\"\nheight = \"30 mm\"\nmean_speed = \"2 m/s\"";
    let text = GOOD.replacen(flow, "kind = \"table\"\nfile = \"flow.csv\"", 1);
    let patch = "position = { patch = { corner = [0, 0.001, 0], sides = [[0, 0.028, 0], [0, 0, 0.01]] } }";
    let text = text.replacen(POINT, &format!("{patch}\ndistribution = \"flux\""), 1);
    let case = Case::from_toml(&text, &folder.path().join("case.toml"), Library::builtin()).unwrap();
    // ∫u dy: 0.0405 m²/s of 1e-3 in below, 19²/200 above
    assert!(
        case.notes.iter().any(|n| n.contains("through part of dispenser fluid flows out, 22.")),
        "{:?}",
        case.notes
    );
    assert!((0..10).all(|i| case.particle(i).unwrap().position[1] > 0.01));
}

/// The share that settles between two plates: laminar, 20 mm apart, 20 µm spheres at Stokes' law.
fn settled(distribution: &str, length: f64) -> f64 {
    let text = format!(
        r#"
[flow]
kind = "channel"
profile = "laminar"
height = 0.02
mean_speed = 0.5
[forces]
gravity = [0, -9.81, 0]
drag = "stokes"
[[wall]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = [0, 1, 0] }}
law = "trap"
contact_at = "center"
[[wall]]
name = "end"
plane = {{ point = [{length}, 0, 0], normal = [-1, 0, 0] }}
law = "escape"
contact_at = "center"
[[injection]]
density = 1000
diameter = "20 um"
count = 1000
position = {{ patch = {{ corner = [0, 0, 0], sides = [[0, 0.02, 0], [0, 0, 0.01]] }} }}
distribution = "{distribution}"
velocity = "fluid"
[output]
trajectories = 0
"#
    );
    let case = read(&text).unwrap_or_else(|e| panic!("{}", e.located("case.toml", &text)));
    let summary = run(&case, &RunOptions::default(), &Silent).unwrap();
    assert_eq!(summary.count(ParticleFate::Trapped) + summary.count(ParticleFate::Escaped), 1000, "seed 1");
    summary.count(ParticleFate::Trapped) as f64 / 1000.0
}

#[test]
fn settling_between_plates_is_that_of_an_aerosol() {
    // Pich 1972 (J. Aerosol Sci. 3, 351–361, doi:10.1016/0021-8502(72)90090-0), Natanson: v_s L/(U h), for any profile
    let air = crate::flow::Fluid::default();
    let slip = crate::force::Slip::Davies.factor(2e-5, air.mean_free_path);
    let speed = (1000.0 - air.density) * 9.81 * 4e-10 * slip / (18.0 * air.viscosity);
    let length = 0.2 * 0.5 * 0.02 / speed;
    let spread = (0.2f64 * 0.8 / 1000.0).sqrt();
    let flux = settled("flux", length);
    assert!((flux - 0.2).abs() < 3.0 * spread, "seed 1: {flux}");
    // evenly by number: 3y² − 2y³ = 0.2 at the height from which spheres land at the end
    let uniform = settled("uniform", length);
    assert!((uniform - 0.287).abs() < 3.0 * spread * 1.13, "seed 1: {uniform}");
}

#[test]
fn a_disc_that_fills_its_pipe_is_told_how_large_it_may_be() {
    let text = |radius: &str| {
        format!(
            "[flow]\nkind = \"pipe\"\nprofile = \"laminar\"\npoint = [0, 0, 0]\naxis = [1, 0, 0]\nradius = \"10 mm\"\nmean_speed = 1\n\
             [[wall]]\nname = \"pipe\"\ncylinder = {{ point = [0, 0, 0], axis = [1, 0, 0], radius = \"10 mm\" }}\nlaw = \"trap\"\n\
             [[injection]]\ndensity = 1000\ndiameter = \"100 um\"\ndistribution = \"flux\"\n\
             position = {{ disc = {{ center = [0, 0, 0], normal = [1, 0, 0], radius = {radius} }} }}\n[run]\nuntil = 1\n"
        )
    };
    let error = read(&text("\"10 mm\"")).unwrap_err();
    let shown = error.located("case.toml", &text("\"10 mm\""));
    assert!(shown.contains("a radius of 9.949990e-3 m, smaller by 5.00e-5 m"), "{shown}");
    assert!(read(&text("9.949990e-3")).is_ok());
}
