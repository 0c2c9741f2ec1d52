use super::*;
use crate::force::wall_drag;
use crate::record::{End, Event, ImpactRecord, Sink};

/// First impact's time and the ends.
#[derive(Default)]
struct Told(Vec<f64>, Vec<[f64; 3]>);

impl Sink for Told {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, i: &ImpactRecord) {
        assert_eq!(i.event, Event::Trap);
        self.0.push(i.time);
    }
    fn point(&mut self, _: u64, _: f64, _: [f64; 3], _: [f64; 3], _: [f64; 3]) {}
    fn end(&mut self, end: &End) {
        self.1.push(end.position);
    }
    fn stalled(&mut self) {}
}

fn told(text: &str) -> Told {
    let case = read(text).unwrap_or_else(|e| panic!("{}", e.located("case.toml", text)));
    let mut told = Told::default();
    case.tracker().run(&mut (0..case.count()).filter_map(|n| case.particle(n)), &mut told).unwrap();
    told
}

fn falling(forces: &str, law: &str) -> String {
    format!(
        r#"
[forces]
gravity = [0, -9.81, 0]
drag = "stokes"
{forces}
[[wall]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = [0, 1, 0] }}
law = "{law}"
[[injection]]
density = 1000
diameter = "5 um"
position = [0, "52.5 um", 0]
velocity = [0, 0, 0]
[run]
until = "1 s"
"#
    )
}

#[test]
fn a_sphere_settles_on_a_plate_through_its_lubrication() {
    let air = crate::flow::Fluid::default();
    let slip = crate::force::Slip::Davies.factor(5e-6, air.mean_free_path);
    let speed = (1000.0 - air.density) * 9.81 * 25e-12 * slip / (18.0 * air.viscosity);
    // t = (R/v_s) ∫ λ dε from 20 to 0, λ held below the least gap; the inertia of 5 µm is a thousandth of that
    let time = |least: f64| {
        let n = 20_000;
        let middle = |i: i32| carom::math::pow(f64::from(i) / f64::from(n), 3.0);
        let part = |i| {
            let (a, b) = (20.0 * middle(i), 20.0 * middle(i + 1));
            (b - a) * wall_drag::normal((0.5 * (a + b)).max(least))
        };
        2.5e-6 / speed * (0..n).map(part).sum::<f64>()
    };
    let free = told(&falling("", "trap")).0[0];
    assert!((free / (50e-6 / speed) - 1.0).abs() < 3e-3, "{free}");
    for (words, least) in [("wall_drag = true", air.mean_free_path), ("wall_drag = { least_gap = \"10 nm\" }", 1e-8)] {
        let slowed = told(&falling(words, "trap")).0[0];
        let want = time(least / 2.5e-6);
        assert!((slowed / want - 1.0).abs() < 3e-3 && slowed > 1.3 * free, "{words} {slowed} {want} {free}");
    }
    // an opening drags nothing
    let case = read(&falling("wall_drag = true", "escape")).unwrap();
    assert!(case.domain.geometry().nearest([0.0, 1e-5, 0.0]).is_none());
}

#[test]
fn a_sphere_drifts_to_the_cold() {
    let text = falling("thermophoresis = { thermal_conductivity = \"0.2 W/m/K\" }", "trap");
    let text = text.replace("[0, -9.81, 0]", "[0, 0, 0]").replace("5 um", "1 um").replace("1 s", "10 ms");
    let text = format!("[fluid]\ntemperature_gradient = [\"1e4 K/m\", 0, 0]\n{text}");
    // Talbot's drift with Davies' slip, 1 µm, 0.2 W/(m K), worked out apart
    let end = told(&text).1[0];
    assert!((end[0] / (-DRIFT * 10e-3) - 1.0).abs() < 1e-3 && end[2] == 0.0, "{end:?}");
}

/// m/s at 1e4 K/m.
const DRIFT: f64 = 2.12955569e-04;

#[test]
fn forces_that_have_nothing_to_act_on_are_refused() {
    let drag = "drag = \"schiller-naumann\"";
    refused(
        drag,
        &format!("{drag}\nthermophoresis = {{ thermal_conductivity = \"0.2 W/m/K\" }}"),
        &["thermophoresis without a temperature gradient", "temperature_gradient ="],
    );
    refused(
        drag,
        &format!("{drag}\nthermophoresis = {{ thermal_conductivity = \"0.2 W\" }}"),
        &["thermal conductivity"],
    );
    refused("density = \"1.19", "temperature_gradient = [0, 1e4, 0]\ndensity = \"1.19", &["acts on nothing"]);
    refused(drag, &format!("{drag}\nbrownian = true\nwall_drag = true"), &["wall_drag with brownian"]);
    refused(drag, "drag = \"none\"\nwall_drag = true", &["wall_drag without drag"]);
    refused(
        drag,
        &format!("{drag}\nwall_drag = {{ least_gap = \"-1 nm\" }}"),
        &["least_gap is -0.000000001", "positive"],
    );
    refused(drag, &format!("{drag}\nwall_drag = 3"), &["true, false or"]);
    let thermo = format!("{drag}\nthermophoresis = {{ thermal_conductivity = 0.2 }}");
    let liquid = "density = 998\nviscosity = 1e-3\nliquid = true\ntemperature_gradient = [0, 1, 0]";
    let state = "density = \"1.19 kg/m3\"\nviscosity = \"1.83e-5 Pa s\"";
    let error = read(&GOOD.replacen(drag, &thermo, 1).replacen(state, liquid, 1)).unwrap_err().to_string();
    assert!(error.contains("thermophoresis in a liquid"), "{error}");
}
