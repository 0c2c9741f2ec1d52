//! What a fit finds, holds, refuses and doubts.

use carom::material::Library;
use carom::spec::{LawSpec, parse_law, parse_named_law};
use carom::units::Number;
use carom::{Impact, WallLaw};
use carom_lab::fit::{BootstrapOptions, Data, Fit, Free, Key, Options, Parameter as _, Resampling, fit};

const STEEL: &str = "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nfriction = 0.2\n";

fn law(keys: &str) -> LawSpec {
    parse_law(&format!("{STEEL}{keys}")).expect("a law")
}

fn wall(keys: &str) -> WallLaw {
    law(keys).compile(Library::builtin()).expect("a law")
}

/// Points of a law without noise, 70 um, head-on.
fn exact(keys: &str, speeds: &[f64]) -> Data {
    let wall = wall(keys);
    let mut csv = "speed,restitution\n".to_owned();
    for speed in speeds {
        let out = wall.impact(&Impact::new(70e-6, [0.0, -speed, 0.0], [0.0, 1.0, 0.0])).expect("it approaches");
        csv += &format!("{speed},{}\n", out.restitution);
    }
    data(&csv)
}

fn data(csv: &str) -> Data {
    Data::from_csv("d.csv", csv, Some(70e-6)).expect("points")
}

fn free(names: &[Key]) -> Vec<Free> {
    names.iter().copied().map(Free::new).collect()
}

fn found(keys: &str, names: &[Key], data: &Data, resamples: u32) -> Fit {
    let options = Options { bootstrap: BootstrapOptions { resamples, ..Default::default() } };
    fit(&law(keys), &free(names), data, Library::builtin(), &options).expect("it fits")
}

fn refused(keys: &str, names: &[Key], data: &Data) -> String {
    fit(&law(keys), &free(names), data, Library::builtin(), &Options::default()).expect_err("refused").to_string()
}

const SPEEDS: [f64; 12] = [0.01, 0.03, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 40.0];
use Key::{AdhesionDamping, Friction, HertzDamping, PlasticConstant, RoughnessFactor, WorkOfAdhesion};

#[test]
fn exact_data_give_the_law_back_from_far_starts() {
    let truth = "normal = \"ea\"\nroughness_factor = 0.15\nadhesion_damping = 1.3\nhertz_damping = 0.007\n";
    let data = exact(truth, &SPEEDS);
    for start in ["", "roughness_factor = 1\n", "roughness_factor = 1\nadhesion_damping = 50\nhertz_damping = 1\n"] {
        let fit =
            found(&format!("normal = \"ea\"\n{start}"), &[RoughnessFactor, AdhesionDamping, HertzDamping], &data, 0);
        for (parameter, truth) in fit.parameters.iter().zip([0.15, 1.3, 0.007]) {
            assert!((parameter.value / truth - 1.0).abs() < 1e-6, "from '{start}': {parameter:?}");
        }
    }
}

#[test]
fn every_law_that_bounces_can_be_fitted() {
    for (normal, truth, names) in [
        ("normal = \"resolved\"\n", "roughness_factor = 0.3\nhertz_damping = 0.01\n", [RoughnessFactor, HertzDamping]),
        ("normal = \"eap\"\n", "work_of_adhesion = 0.5\nplastic_constant = 2.4e8\n", [WorkOfAdhesion, PlasticConstant]),
        (
            "normal = \"thornton-ning\"\n",
            "work_of_adhesion = 1\nplastic_constant = 2e8\n",
            [WorkOfAdhesion, PlasticConstant],
        ),
        (
            "normal = [\"adhesion-work\", \"plastic-bons\"]\n",
            "work_of_adhesion = 0.5\nplastic_constant = 2e8\n",
            [WorkOfAdhesion, PlasticConstant],
        ),
    ] {
        let truth = format!("{normal}{truth}");
        let fit = found(normal, &names, &exact(&truth, &SPEEDS), 0);
        for parameter in &fit.parameters {
            let wanted = parameter.parameter.start(&law(&truth), Library::builtin());
            assert!((parameter.value / wanted - 1.0).abs() < 1e-4, "{truth}: {parameter:?}, {:?}", fit.warnings);
        }
    }
}

#[test]
fn a_parameter_at_its_bound_has_no_error_and_lets_go_again() {
    // no damping in the truth, and data that would like it negative
    let mut data = exact("normal = \"ea\"\nroughness_factor = 0.15\n", &SPEEDS);
    for (n, point) in data.points.iter_mut().enumerate() {
        let raised = 0.002 * (n as f64 - 6.0) / 6.0 + if n % 2 == 0 { 0.001 } else { -0.001 };
        point.restitution = point.restitution.map(|e| if e > 0.0 { e + raised } else { 0.0 });
    }
    let fit = found("normal = \"ea\"\n", &[RoughnessFactor, HertzDamping], &data, 99);
    let [roughness, damping] = &fit.parameters[..] else { panic!("two") };
    assert!(damping.at_bound && damping.value == 0.0 && damping.standard_error.is_none());
    assert!(!roughness.at_bound && roughness.standard_error.is_some_and(|e| e < 0.01));
    assert!(fit.warnings.iter().any(|w| w.starts_with("hertz_damping is at its bound 0")), "{:?}", fit.warnings);
    assert!(damping.bootstrap.is_some_and(|(low, high)| low == 0.0 && high < 0.002));
    // held away from the best value by the user's own bounds
    let free = [Free { parameter: RoughnessFactor, bounds: 0.2..=0.5 }];
    let library = Library::builtin();
    let fit = carom_lab::fit::fit(&law("normal = \"ea\"\n"), &free, &data, library, &Options::default()).expect("fits");
    assert!(fit.parameters[0].at_bound && fit.parameters[0].value == 0.2);
}

#[test]
fn what_the_data_cannot_tell_apart_is_named() {
    let data = exact("normal = \"ea\"\nroughness_factor = 0.15\n", &SPEEDS);
    let fit = found("normal = \"ea\"\n", &[RoughnessFactor, WorkOfAdhesion], &data, 0);
    let said = fit.warnings.join("\n");
    assert!(said.contains("only a combination of roughness_factor and work_of_adhesion is known"), "{said}");
    assert!(said.contains("C_R w^(2/3)"), "{said}");
    assert!(fit.parameters.iter().all(|p| p.standard_error.is_none() && p.interval.is_none()));
    // a narrow range of high speeds: damping by adhesion and by the Hertz force look alike
    let mut csv = "speed,restitution,sigma\n".to_owned();
    let wall = wall("normal = \"ea\"\nroughness_factor = 0.15\nadhesion_damping = 1.3\nhertz_damping = 0.007\n");
    for n in 0..12 {
        let speed = 8.0 + 0.5 * f64::from(n);
        let out = wall.impact(&Impact::new(70e-6, [0.0, -speed, 0.0], [0.0, 1.0, 0.0])).expect("it approaches");
        csv += &format!("{speed},{},0.01\n", out.restitution);
    }
    let fit =
        found("normal = \"ea\"\nroughness_factor = 0.15\n", &[AdhesionDamping, HertzDamping], &self::data(&csv), 0);
    let said = fit.warnings.join("\n");
    assert!(said.contains("hardly tell adhesion_damping from hertz_damping"), "{said}");
    assert!(said.contains("second diameter"), "{said}");
}

#[test]
fn a_parameter_that_nothing_calls_on_is_named() {
    let slow = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8];
    let fit = found(
        "normal = \"eap\"\nplastic_constant = 9e8\n",
        &[WorkOfAdhesion, PlasticConstant],
        &exact("normal = \"eap\"\nwork_of_adhesion = 0.5\nplastic_constant = 9e8\n", &slow),
        0,
    );
    let said = fit.warnings.join("\n");
    assert!(said.contains("plastic_constant changes nothing at any of the points"), "{said}");
    assert!(said.contains("faster than the yield velocity"), "{said}");
    assert!((fit.parameters[0].value - 0.5).abs() < 1e-6 && fit.parameters[0].standard_error.is_some());
}

#[test]
fn scatter_beyond_sigma_and_wrong_fates_are_told() {
    let fit = found(
        "normal = \"ea\"\n",
        &[RoughnessFactor],
        &data("speed,restitution,sigma\n0.5,0,0.001\n1,0.5,0.001\n2,0.95,0.001\n4,0.9,0.001\n"),
        0,
    );
    let said = fit.warnings.join("\n");
    assert!(said.contains("scatter more than their sigma"), "{said}");
    assert!(fit.goodness.probability.is_some_and(|p| p < 1e-6));
    assert!(said.contains("stayed and the law lets them rebound (lines 2)"), "{said}");
}

#[test]
fn a_law_that_cannot_describe_the_points_is_told() {
    let said = |names: &[Key], csv: &str| found("normal = \"ea\"\n", names, &data(csv), 0).warnings.join("\n");
    // far more adhesion than the materials have, and plastic loss
    let sticky = said(&[RoughnessFactor], "speed,restitution\n0.5,0.35\n1,0.68\n2,0.81\n4,0.87\n");
    let plastic = said(&[RoughnessFactor], "speed,restitution\n0.5,0.8\n1,0.7\n2,0.6\n4,0.5\n8,0.42\n16,0.35\n");
    for said in [sticky, plastic] {
        assert!(said.contains("the law does not describe these points"), "{said}");
        assert!(said.contains("free work_of_adhesion") && said.contains("eap"), "{said}");
    }
    // what is only scatter is not
    let law = wall("normal = \"ea\"\nroughness_factor = 0.5\n");
    let csv = [(0.5, 0.01), (1.0, -0.02), (2.0, 0.015), (4.0, -0.01), (8.0, 0.02), (16.0, -0.015)].iter().fold(
        "speed,restitution\n".to_owned(),
        |text, (speed, off)| {
            let impact = Impact::new(70e-6, [0.0, -speed, 0.0], [0.0, 1.0, 0.0]);
            text + &format!("{speed},{}\n", law.impact(&impact).unwrap().restitution + off)
        },
    );
    assert!(!said(&[RoughnessFactor], &csv).contains("does not describe"), "{csv}");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let ea = "normal = \"ea\"\n";
    let points = data("speed,restitution\n1,0.9\n2,0.95\n3,0.9\n");
    for (keys, names, data, wanted) in [
        (ea, vec![Friction], &points, "friction does not act on the normal restitution; add a column"),
        (
            ea,
            vec![PlasticConstant],
            &points,
            "plastic_constant changes nothing in this law; it is read with normal = \"eap\"",
        ),
        (
            "normal = \"tabor\"\nyield_velocity = 0.09\nmeyer_index = 2.29\n",
            vec![HertzDamping],
            &points,
            "hertz_damping changes nothing in this law; it is read with",
        ),
        (ea, vec![HertzDamping, HertzDamping], &points, "hertz_damping is free twice"),
        (
            ea,
            vec![AdhesionDamping, HertzDamping, RoughnessFactor],
            &points,
            "3 measured values for 3 free parameters; at least 4",
        ),
        (
            ea,
            vec![RoughnessFactor],
            &data("speed,restitution\n1,0\n2,0\n"),
            "capture velocity is above 2 m/s; add points that",
        ),
    ] {
        let said = refused(keys, &names, data);
        assert!(said.contains(wanted), "{said}");
    }
}

#[test]
fn both_ways_of_drawing_again_agree_and_depend_on_the_seed_alone() {
    let speeds: Vec<f64> = (0..40).map(|n| 0.05 * 1.15f64.powi(n)).collect();
    let mut data = exact("normal = \"ea\"\nroughness_factor = 0.15\n", &speeds);
    for (n, point) in data.points.iter_mut().enumerate() {
        // evenly spread, in no order of speed
        let noise = 0.03 * (((37 * n) % 41) as f64 / 40.0 - 0.5);
        point.restitution = point.restitution.map(|e| e + noise);
    }
    let width = |resampling, seed| {
        let options = Options { bootstrap: BootstrapOptions { resamples: 199, seed, resampling } };
        let fit = fit(&law("normal = \"ea\"\n"), &free(&[RoughnessFactor]), &data, Library::builtin(), &options);
        fit.expect("it fits").parameters[0].bootstrap.expect("an interval")
    };
    let (a, b) = (width(Resampling::Residuals, 1), width(Resampling::Residuals, 1));
    assert_eq!(a, b);
    assert_ne!(a, width(Resampling::Residuals, 2));
    let pairs = width(Resampling::Pairs, 1);
    let ratio = (pairs.1 - pairs.0) / (a.1 - a.0);
    assert!((0.5..2.0).contains(&ratio), "{a:?} {pairs:?}");
}

#[test]
fn the_law_file_is_ready_to_use() {
    let data = exact("normal = \"ea\"\nroughness_factor = 0.15\nhertz_damping = 0.007\n", &SPEEDS);
    let library = Library::builtin();
    let mut fit = found("normal = \"ea\"\n", &[RoughnessFactor, HertzDamping], &data, 0);
    let text = fit.law_file("wall", library).expect("a law");
    assert!(text.starts_with("# Fitted by carom fit to d.csv, 12 points.\n# roughness_factor = 0.15"), "{text}");
    let again = parse_named_law(&text, "wall").and_then(|l| l.compile(library)).expect("it reads");
    assert_eq!(again.normal(), fit.law.compile(library).expect("a law").normal());
    fit.law.friction = None;
    assert!(fit.law_file("wall", library).expect("a law").contains("# Friction was not measured"));
    fit.law.friction = Some(Number(0.3).into());
    assert!(fit.law_file("wall", library).expect("a law").contains("friction = 0.3"));
}
