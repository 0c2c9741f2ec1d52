//! The JSON of `--json` is a contract: its keys, its units, null where a value does not apply.

use serde_json::Value;
use std::process::Command;

fn json(arguments: &str) -> Value {
    let out = Command::new(env!("CARGO_BIN_EXE_carom")).args(arguments.split_whitespace()).output().expect("it runs");
    assert!(out.status.success(), "{arguments}: {}", String::from_utf8_lossy(&out.stderr));
    serde_json::from_slice(&out.stdout).unwrap_or_else(|e| panic!("{arguments}: {e}"))
}

const STEEL: &str =
    "--sphere stainless-steel --surface silicon --work-of-adhesion 3.03 --roughness-factor 0.15 --diameter 70um";

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn energy_sum(answer: &Value) -> f64 {
    answer["energy"].as_object().expect("energy").values().map(number).sum()
}

#[test]
fn an_impact_has_the_contracts_keys() {
    let answer = json(&format!("impact {STEEL} --speed 1 --angle 40 --friction 0.1 --json"));
    let wanted = [
        "fate",
        "restitution",
        "impulse_ratio",
        "tangential_restitution",
        "contact",
        "rebound",
        "capture_velocity",
        "yield_velocity",
        "critical_angle_deg",
        "energy",
        "validity",
        "adhesion_numbers",
    ];
    for key in wanted {
        assert!(keys(&answer).contains(&key), "{key} is missing");
    }
    let mut rebound = keys(&answer["rebound"]);
    rebound.sort_unstable();
    assert_eq!(rebound, ["angle_deg", "normal", "spin", "tangential"]);
    let mut energy = keys(&answer["energy"]);
    energy.sort_unstable();
    assert_eq!(
        energy,
        ["adhesion", "adhesion_damping", "captured", "friction", "hertz_damping", "kept", "other", "plastic"]
    );
    assert_eq!(answer["fate"], "rebound");
    assert_eq!(answer["contact"], "sliding");
    assert_eq!(answer["validity"], serde_json::json!(["above-yield"]));
    assert!(answer["yield_velocity"].is_null());
    let warned = &answer["above_yield"];
    assert_eq!(warned["material"], "stainless-steel");
    let plastic = json(&format!("impact {STEEL} --speed 1 --angle 40 --friction 0.1 --law eap --json"));
    assert_eq!(plastic["validity"], serde_json::json!([]));
    assert!(!keys(&plastic).contains(&"above_yield"));
    for key in ["yield_velocity", "restitution", "capture_velocity"] {
        assert_eq!(warned[key], plastic[key], "{key}");
    }
    assert!((energy_sum(&answer) - 1.0).abs() < 1e-14);
}

#[test]
fn the_reference_pair_gives_the_reference_restitution() {
    // Kim & Dunn 2007, the closed forms of the pair of Fig. 8
    for (speed, damping, e) in [
        ("0.3", "", 0.927_135_005_995_553_2),
        ("20", "", 0.997_557_667_687_832_6),
        ("1", "--adhesion-damping 1.3 --hertz-damping 0.007", 0.932_941_526_454_541_8),
    ] {
        let answer = json(&format!("impact {STEEL} --speed {speed} {damping} --json"));
        assert!((number(&answer["restitution"]) / e - 1.0).abs() < 1e-12, "{answer}");
        assert!(
            (number(&answer["rebound"]["normal"]) / (e * speed.parse::<f64>().expect("a speed")) - 1.0).abs() < 1e-12
        );
    }
}

#[test]
fn numbers_fit_together_for_an_oblique_impact() {
    let answer = json(&format!("impact {STEEL} --speed 3 --angle 30 --friction 0.2 --spin 800 --json"));
    let (normal, tangential) = (3.0 * 0.5, 3.0 * 0.75f64.sqrt());
    let rebound = &answer["rebound"];
    let e = number(&answer["restitution"]);
    assert!((number(&rebound["normal"]) - e * normal).abs() < 1e-12);
    let loss = tangential - number(&rebound["tangential"]);
    assert!((number(&answer["impulse_ratio"]) - loss / ((1.0 + e) * normal)).abs() < 1e-12);
    assert!((number(&answer["tangential_restitution"]) - number(&rebound["tangential"]) / tangential).abs() < 1e-12);
    // a solid sphere: the impulse P per mass changes the spin by 5P/(2R)
    assert!((number(&rebound["spin"]) - 800.0 - 2.5 * loss / 35e-6).abs() < 1e-6);
    let angle = number(&rebound["normal"]).atan2(number(&rebound["tangential"])).to_degrees();
    assert!((number(&rebound["angle_deg"]) - angle).abs() < 1e-12);
    // energy kept, of translation and spin
    let kinetic = |n: f64, t: f64, w: f64| n * n + t * t + 0.4 * 35e-6f64.powi(2) * w * w;
    let kept = kinetic(number(&rebound["normal"]), number(&rebound["tangential"]), number(&rebound["spin"]))
        / kinetic(normal, tangential, 800.0);
    assert!((number(&answer["energy"]["kept"]) - kept).abs() < 1e-12);
    assert!((energy_sum(&answer) - 1.0).abs() < 1e-14);
}

#[test]
fn a_capture_has_zeros_and_nulls() {
    let answer = json(&format!("impact {STEEL} --speed 0.01 --angle 50 --friction 0.2 --json"));
    assert_eq!(answer["fate"], "capture");
    assert_eq!(answer["restitution"], 0.0);
    assert_eq!(answer["contact"], "none");
    assert!(answer["impulse_ratio"].is_null() && answer["tangential_restitution"].is_null());
    assert!(answer["rebound"]["angle_deg"].is_null());
    assert!((energy_sum(&answer) - 1.0).abs() < 1e-14);
    assert!((number(&answer["capture_velocity"]) / 0.025_787_550_830_454_4 - 1.0).abs() < 1e-12);
}

#[test]
fn energy_sums_to_one_for_every_law() {
    let materials = "--sphere copper --surface steel --diameter 50um --speed 2 --angle 55 --spin 300 --json";
    for law in [
        "--law ea",
        "--law eap",
        "--law eap --adhesion-damping 0.1 --hertz-damping 0.01",
        "--law thornton-ning",
        "--law tabor --yield-velocity 0.1 --meyer-index 2.3",
        "--law constant --restitution 0.6",
        "--law by-angle --restitution grant-tabakoff",
        "--law resolved --adhesion-damping 0.1",
        "--law resolved --adhesion reversible --hertz-damping 0.01",
        "--law adhesion-work,plastic-kadomtsev,hertz-damping --hertz-damping 0.01",
        "--tangential walton --walton-beta 0.5",
        "--tangential constant --tangential-restitution 0.8",
    ] {
        let friction = if law.contains("tangential-restitution") { "" } else { "--friction 0.15" };
        let answer = json(&format!("impact {materials} {law} {friction}"));
        assert!((energy_sum(&answer) - 1.0).abs() < 1e-12, "{law}: {answer}");
        assert!((0.0..=1.0).contains(&number(&answer["restitution"])), "{law}");
    }
}

#[test]
fn removal_is_an_object_of_its_own() {
    let answer =
        json(&format!("capture {STEEL} --friction 0.3 --removal --fluid-density 1.2 --fluid-viscosity 1.8e-5 --json"));
    let removal = &answer["removal"];
    // (3/2)πw r C_R with w = 3.03 J/m², C_R = 0.15
    let force = 1.5 * std::f64::consts::PI * 3.03 * 0.15 * 35e-6;
    assert!((number(&removal["pull_off_force"]) / force - 1.0).abs() < 1e-12);
    assert_eq!((number(&removal["fluid_density"]), number(&removal["fluid_viscosity"])), (1.2, 1.8e-5));
    let speeds = ["rolling", "sliding", "lifting"].map(|m| number(&removal[m]["friction_velocity"]));
    assert!(0.0 < speeds[0] && speeds[0] < speeds[1] && speeds[1] < speeds[2], "{removal}");
    let d_plus = speeds[0] * 70e-6 * 1.2 / 1.8e-5;
    assert!((number(&removal["rolling"]["wall_units"]) / d_plus - 1.0).abs() < 1e-12);
    let without = json(&format!("capture {STEEL} --removal --json"));
    assert!(without["removal"]["sliding"].is_null());
    assert!(json(&format!("capture {STEEL} --json"))["removal"].is_null());
    assert!(number(&answer["el_batsh_capture_velocity"]) > 0.0);
}

#[test]
fn doubts_are_codes() {
    let answer = json(&format!("impact {STEEL} --speed 200 --adhesion-damping 1.3 --hertz-damping 0.007 --json"));
    assert_eq!(answer["validity"], serde_json::json!(["damping-exhausted", "large-contact", "above-yield"]));
}

#[test]
fn materials_are_objects_with_sources() {
    let all = json("materials --json");
    let copper = json("materials copper --json");
    assert!(all.as_array().expect("a list").contains(&copper));
    assert_eq!(copper["density"], 8940.0);
    assert_eq!(copper["young_modulus"], 130e9);
    assert!(copper["properties"].as_array().expect("values").iter().all(|p| p["source"].is_string()));
}

#[test]
fn a_sweep_is_a_list_of_rows_with_exact_ends() {
    let rows = json(&format!("sweep {STEEL} --over speed=0.1m/s..30m/s --points 5 --json"));
    let rows = rows.as_array().expect("a list");
    assert_eq!(rows.len(), 5);
    assert_eq!((number(&rows[0]["speed"]), number(&rows[4]["speed"])), (0.1, 30.0));
    for row in rows {
        let one = json(&format!("impact {STEEL} --speed {} --json", row["speed"]));
        assert_eq!(one["restitution"], row["restitution"]);
    }
}
