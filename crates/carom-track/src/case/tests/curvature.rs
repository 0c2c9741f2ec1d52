//! A cylinder's wall gives its contacts its curvature.

use super::*;

const BORE: &str = r#"
[forces]
gravity = [0, 0, 0]
drag = "none"
[[wall]]
name = "tube"
cylinder = { point = [0, 0, 0], axis = [0, 0, 1], radius = "0.2 mm", fluid = "inside" }
law = "g"
[law.g]
sphere = "copper"
surface = "glass"
normal = "ea"
friction = 0.2
[[injection]]
material = "copper"
diameter = "100 um"
position = [0, 0, 0]
velocity = [0.3, 0, 0]
[run]
until = "1 ms"
"#;

/// e at 0.3 m/s, head-on.
fn restitution(text: &str) -> f64 {
    let case = read(text).unwrap_or_else(|e| panic!("{}", e.located("case.toml", text)));
    let law = &case.behaviors[0].laws().expect("a wall law")[0];
    law.impact(&Impact::new(100e-6, [0.3, 0.0, 0.0], [-1.0, 0.0, 0.0])).expect("an impact").restitution
}

/// What is lost to the work of adhesion goes as r^(8/15) (Kim & Dunn 2007, Eqs 16, 21); 0.741042 is the flat wall's e.
fn expected(relative_radius: f64) -> f64 {
    (1.0 - (1.0 - 0.741_042f64 * 0.741_042) * relative_radius.powf(8.0 / 15.0)).sqrt()
}

#[test]
fn a_bore_and_a_rod_give_their_curvature_to_the_contact() {
    let with = |from: &str, to: &str| {
        assert!(BORE.contains(from), "{from}");
        BORE.replacen(from, to, 1)
    };
    let rod = with("\"inside\"", "\"outside\"").replacen("position = [0, 0, 0]", "position = [\"-0.4 mm\", 0, 0]", 1);
    let plane = with(
        "cylinder = { point = [0, 0, 0], axis = [0, 0, 1], radius = \"0.2 mm\", fluid = \"inside\" }",
        "plane = { point = [1, 0, 0], normal = [-1, 0, 0] }",
    );
    for (what, text, relative_radius) in [
        ("plane", plane, 1.0),
        // R/R_w = 1/4
        ("bore", BORE.to_owned(), 1.0 / 0.75f64.sqrt()),
        ("rod", rod, 1.0 / 1.25f64.sqrt()),
        // the law's own counts; that of a sphere: 0.68875
        ("own", with("friction = 0.2", "friction = 0.2\nsurface_curvature = \"-0.2 mm\""), 4.0 / 3.0),
        ("own, flat", with("friction = 0.2", "friction = 0.2\nsurface_curvature = \"inf\""), 1.0),
        ("met by the centre", with("law = \"g\"", "law = \"g\"\ncontact_at = \"center\""), 1.0),
    ] {
        let (got, wanted) = (restitution(&text), expected(relative_radius));
        assert!((got - wanted).abs() < 1e-6, "{what}: {got}, {wanted}");
    }
    assert!((expected(4.0 / 3.0) - 0.68875).abs() < 1e-5);
}

#[test]
fn a_sphere_that_fills_a_bore_is_refused_and_one_that_nearly_does_is_told() {
    let wide = |diameter: &str| BORE.replacen("100 um", diameter, 1);
    assert!(read(&wide("400 um")).is_err_and(|e| e.to_string().contains("too narrow")));
    assert!(read(&wide("399.999 um")).is_err_and(|e| e.to_string().contains("too narrow")));
    for (diameter, told) in [("399 um", true), ("210 um", true), ("200 um", false)] {
        let case = read(&wide(diameter)).unwrap();
        assert_eq!(case.notes.iter().any(|n| n.contains("twice as wide")), told, "{diameter}: {:?}", case.notes);
    }
}
