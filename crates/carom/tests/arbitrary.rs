//! Arbitrary text and arbitrary bytes never panic the readers, and what compiles answers within its invariants.

use carom::material::{Library, Material};
use carom::spec::{parse_law, parse_named_law};
use carom::{Impact, units};
use proptest::prelude::*;

/// Fragments that make interesting laws when shuffled.
fn fragments() -> impl Strategy<Value = String> {
    let keys = prop::sample::select(vec![
        "sphere",
        "surface",
        "normal",
        "adhesion",
        "tangential",
        "friction",
        "walton_beta",
        "roughness_factor",
        "roughness",
        "roughness_model",
        "asperity_radius",
        "adhesion_damping",
        "hertz_damping",
        "surface_curvature",
        "restitution",
        "tangential_restitution",
        "yield_velocity",
        "meyer_index",
        "limiting_pressure",
        "work_of_adhesion",
        "stiffness",
        "plastic_constant",
    ]);
    let values = prop::sample::select(vec![
        "\"copper\"",
        "\"silicon\"",
        "\"ea\"",
        "\"eap\"",
        "\"resolved\"",
        "\"tabor\"",
        "\"constant\"",
        "\"by-angle\"",
        "\"rolling\"",
        "\"walton\"",
        "\"micro-slip\"",
        "0",
        "1",
        "0.5",
        "-1",
        "1e308",
        "5e-324",
        "nan",
        "inf",
        "\"1 nm\"",
        "\"1 GPa\"",
        "\"0.3 J/m2\"",
        "\"2 m/s\"",
        "[\"adhesion-work\", \"plastic-tabor\"]",
        "[\"adhesion-work\", \"plastic-bons\"]",
        "\"fuller-tabor\"",
        "[]",
        "{ polynomial = [0.5] }",
        "\"grant-tabakoff\"",
        "{ rho = 1000, E = 1e9, nu = 0.3, gamma = 0.1 }",
        "\"reversible\"",
        "\"inf\"",
        "\"-5 um\"",
        "\"rho=8000,E=1e11,nu=0.3,gamma=1\"",
    ]);
    prop::collection::vec((keys, values), 1..12).prop_map(|lines| {
        let mut seen = std::collections::BTreeMap::new();
        seen.extend(lines);
        seen.iter().map(|(k, v)| format!("{k} = {v}\n")).collect()
    })
}

proptest! {
    #[test]
    fn bytes_never_panic_a_reader(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let text = String::from_utf8_lossy(&bytes);
        let _ = parse_law(&text).map(|law| law.compile(Library::builtin()));
        let _ = parse_named_law(&text, "x");
        let _ = Library::default().extend_from_toml(&text);
        let _ = Material::from_inline(&text);
        let _ = text.parse::<units::Length>();
    }

    #[test]
    fn units_of_any_shape_never_panic(text in "[-+]?[0-9]{0,3}[.eE]?[0-9]{0,4} ?[a-zA-Zµ°/*^0-9 -]{0,20}") {
        let _ = text.parse::<units::Pressure>();
        let _ = text.parse::<units::Temperature>();
        let _ = text.parse::<units::Number>();
    }

    #[test]
    fn laws_of_any_shape_answer_or_say_why(text in fragments(), v in -12.0..6.0f64, d in -9.5..0.5f64) {
        if let Ok(law) = parse_law(&text).and_then(|l| l.compile(Library::builtin())) {
            let (v, d) = (10f64.powf(v), 10f64.powf(d));
            if let Ok(out) = law.impact(&Impact::new(d, [0.3 * v, -v, 0.0], [0.0, 1.0, 0.0])) {
                prop_assert!((0.0..=1.0).contains(&out.restitution), "{text}: {out:?}");
                let sum: f64 = out.energy.named().iter().map(|f| f.1).sum();
                prop_assert!((sum - 1.0).abs() < 1e-9, "{text}: {out:?}");
            }
            let _ = law.window(d, None);
            let _ = law.critical_angle(d, None, v);
        }
    }
}
