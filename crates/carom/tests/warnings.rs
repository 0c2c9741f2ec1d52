//! Warnings about materials at the scale of the contact: `above-yield`, `adhesive-contact-large`, `grazing-capture`.

mod common;

use carom::material::{Library, Material};
use carom::pair::{Body, StrengthSource};
use carom::{Fate, Impact, Outcome, Validity, WallLaw};
use common::law;
use std::f64::consts::PI;

fn meet(wall: &WallLaw, diameter: f64, normal: f64, along: f64) -> Outcome {
    wall.impact(&Impact::new(diameter, [along, -normal, 0.0], [0.0, 1.0, 0.0])).expect("an impact")
}

fn warned(wall: &WallLaw, diameter: f64, normal: f64, along: f64, code: Validity) -> bool {
    meet(wall, diameter, normal, along).validity.contains(code)
}

#[test]
fn an_elastic_law_far_above_the_yield_velocity_says_so_and_what_eap_would_give() {
    let pair = "sphere = \"quartz\"\nsurface = \"steel\"\nfriction = 0.4\n";
    let wall = law(&format!("{pair}normal = \"ea\"\n"));
    let eap = law(&format!("{pair}normal = \"eap\"\n"));
    assert!((meet(&wall, 200e-6, 100.0, 173.2).restitution - 0.9965).abs() < 1e-4);
    assert!(warned(&wall, 200e-6, 100.0, 173.2, Validity::ABOVE_YIELD));
    let told = wall.above_yield(100.0, 200e-6, None).expect("in range").expect("above");
    assert_eq!(Some(told.yield_velocity), eap.yield_velocity(200e-6, None).expect("in range"));
    assert_eq!(told.restitution, meet(&eap, 200e-6, 100.0, 0.0).restitution);
    assert!((told.restitution - 0.3259).abs() < 1e-4 && (told.yield_velocity - 0.3825).abs() < 1e-4, "{told:?}");
    assert_eq!((told.strength.source, told.strength.body), (StrengthSource::YieldStrength, Some(Body::Surface)));
    assert!(!warned(&eap, 200e-6, 100.0, 0.0, Validity::ABOVE_YIELD));
    assert_eq!(eap.above_yield(100.0, 200e-6, None), Ok(None));
}

/// Every pair of the library, with adhesion left out so that nothing but the strength decides: the warning begins where `eap`'s plastic loss
/// does, whatever the size, the density and the curvature of the wall.
#[test]
fn the_warning_begins_at_eaps_own_yield_velocity_for_every_pair() {
    let usable = |m: &&Material| m.density.is_some() && m.young_modulus.is_some() && m.poisson_ratio.is_some();
    let materials: Vec<&Material> = Library::builtin().iter().filter(usable).collect();
    let mut judged = 0;
    for sphere in &materials {
        for surface in &materials {
            let (a, b) = (&sphere.name, &surface.name);
            let rest = "work_of_adhesion = 0\nfriction = 0\nsurface_curvature = \"2 mm\"\n";
            let pair = format!("sphere = \"{a}\"\nsurface = \"{b}\"\n{rest}");
            let elastic = law(&format!("{pair}normal = [\"adhesion-jkr\"]\n"));
            let strong = |m: &Material| m.yield_strength.is_some() || m.hardness.is_some();
            if !strong(sphere) && !strong(surface) {
                assert!(!warned(&elastic, 1e-5, 1e3, 0.0, Validity::ABOVE_YIELD), "{a} on {b}: strength unknown");
                continue;
            }
            let eap = law(&format!("{pair}normal = \"eap\"\n"));
            for diameter in [1e-7, 3e-5, 1e-3] {
                let v_y = eap.yield_velocity(diameter, Some(1234.0)).expect("in range").expect("plastic");
                if v_y > 1e5 {
                    continue; // rubber against metal: faster than any impact
                }
                for (v, above) in [(v_y * (1.0 - 1e-12), false), (v_y * (1.0 + 1e-12), true)] {
                    let mut impact = Impact::new(diameter, [0.0, -v, 0.0], [0.0, 1.0, 0.0]);
                    impact.density = Some(1234.0);
                    let out = elastic.impact(&impact).expect("an impact");
                    assert_eq!(
                        out.validity.contains(Validity::ABOVE_YIELD),
                        above,
                        "{a} on {b}, {diameter} m, {v} m/s"
                    );
                    let told = elastic.above_yield(v, diameter, Some(1234.0)).expect("in range");
                    assert_eq!(told.map(|t| t.yield_velocity), above.then_some(v_y), "{a} on {b}");
                    judged += 1;
                }
            }
        }
    }
    assert!(judged > 3000, "{judged}");
}

#[test]
fn what_eap_would_give_is_what_eap_gives() {
    let damping = "hertz_damping = 0.001\nadhesion_damping = 0.2\n";
    for (elastic, plastic, keys) in [
        ("\"ea\"", "\"eap\"", ""),
        ("\"ea\"", "\"eap\"", damping),
        ("[\"adhesion-work\"]", "[\"adhesion-work\", \"plastic-kadomtsev\"]", ""),
        ("[\"adhesion-jkr\"]", "[\"adhesion-jkr\", \"plastic-kadomtsev\"]", ""),
        ("\"resolved\"", "\"eap\"", damping),
        ("\"resolved\"", "\"eap\"", ""),
    ] {
        let pair = "sphere = \"copper\"\nsurface = \"glass\"\nfriction = 0\n";
        let [elastic, plastic] = [elastic, plastic].map(|n| law(&format!("{pair}{keys}normal = {n}\n")));
        for (diameter, v) in [(10e-6, 0.5), (90e-6, 0.2), (90e-6, 1.0), (90e-6, 30.0), (2e-3, 5.0)] {
            assert!(warned(&elastic, diameter, v, 0.0, Validity::ABOVE_YIELD));
            let told = elastic.above_yield(v, diameter, None).expect("in range").expect("above");
            assert_eq!(told.restitution, meet(&plastic, diameter, v, 0.0).restitution, "{keys} {diameter} {v}");
            let window = plastic.window(diameter, None).expect("in range");
            assert_eq!(told.capture_velocity, window.map(|w| w.capture_velocity));
        }
    }
}

#[test]
fn a_given_restitution_and_an_unknown_strength_are_not_judged() {
    let steel = "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nfriction = 0\n";
    let dahneke = "normal = [\"given-restitution\", \"adhesion-well\"]\nrestitution = 0.9\nwell_depth = 1e-16\n";
    let constant = "normal = \"constant\"\nrestitution = 0.9\n";
    let unknown = "sphere = \"rho=8000,E=190GPa,nu=0.27,gamma=1.62,sigma_t=310MPa\"\nsurface = \"mica\"\nfriction = 0\nnormal = \"ea\"\n";
    for text in [format!("{steel}{dahneke}"), format!("{steel}{constant}"), unknown.to_owned()] {
        let wall = law(&text);
        assert!(!warned(&wall, 70e-6, 100.0, 0.0, Validity::ABOVE_YIELD), "{text}");
        assert_eq!(wall.above_yield(100.0, 70e-6, None), Ok(None), "{text}");
    }
}

/// JKR without load written out: a³ = 6πw r²/K with K = (4/3)E*.
fn at_rest(e: f64, nu: f64, w: f64, radius: f64, effective: f64) -> f64 {
    let e_star = e / (2.0 * (1.0 - nu * nu));
    (6.0 * PI * w * effective * effective / (4.0 / 3.0 * e_star)).cbrt() / radius
}

#[test]
fn spheres_so_small_that_adhesion_alone_flattens_them_are_told() {
    let polystyrene = "sphere = \"polystyrene\"\nsurface = \"polystyrene\"\nfriction = 0\n";
    let steel = law("sphere = \"polystyrene\"\nsurface = \"stainless-steel\"\nnormal = \"ea\"\nfriction = 0\n");
    let slow = |diameter| meet(&steel, diameter, 0.5, 0.0).validity.codes().collect::<Vec<_>>();
    assert_eq!(slow(10e-9), ["adhesive-contact-large"]); // 0.69 R, and a capture velocity of 700 m/s
    assert_eq!(slow(100e-9), ["adhesive-contact-large"]); // 0.32 R, and 103 m/s
    let ratio = |diameter: f64| at_rest(3.25e9, 0.33, 0.055, 0.5 * diameter, 0.5 * diameter);
    assert!((ratio(10e-9) - 0.44).abs() < 0.01);
    for normal in ["\"ea\"", "\"eap\"", "[\"adhesion-jkr\"]", "\"thornton-ning\"", "\"resolved\""] {
        let wall = law(&format!("{polystyrene}normal = {normal}\n"));
        // as fast or slow as may be, captured or not
        for v in [1e-6, 0.1, 10.0, 500.0] {
            for diameter in [1e-9, 10e-9, 30e-9, 31e-9, 32e-9, 33e-9, 50e-9, 200e-9, 1e-6, 1e-4] {
                let code = Validity::ADHESIVE_CONTACT_LARGE;
                assert_eq!(warned(&wall, diameter, v, 0.0, code), ratio(diameter) > 0.3, "{normal} {diameter} {v}");
            }
        }
    }
    // a curved wall through r, a rough one through C_R
    let curved =
        law(&format!("{polystyrene}normal = \"ea\"\nsurface_curvature = \"-200 nm\"\nroughness_factor = 0.4\n"));
    for diameter in [40e-9, 60e-9, 80e-9, 100e-9, 150e-9, 250e-9, 300e-9] {
        let radius = 0.5 * diameter;
        let effective = 1.0 / (1.0 / radius - 1.0 / 200e-9);
        let wide = at_rest(3.25e9, 0.33, 0.4 * 0.055, radius, effective) > 0.3;
        assert_eq!(warned(&curved, diameter, 1.0, 0.0, Validity::ADHESIVE_CONTACT_LARGE), wide, "{diameter}");
    }
    for none in ["\"tabor\"\nyield_velocity = 0.1\nmeyer_index = 2.3", "\"constant\"\nrestitution = 0.9"] {
        let wall = law(&format!("{polystyrene}normal = {none}\n"));
        assert!(!warned(&wall, 10e-9, 1.0, 0.0, Validity::ADHESIVE_CONTACT_LARGE), "{none}");
    }
}

#[test]
fn a_capture_with_far_more_energy_along_the_wall_than_adhesion_holds_is_told() {
    let sand = law("sphere = \"quartz\"\nsurface = \"steel\"\nfriction = 0.3\nnormal = \"eap\"\n");
    let out = meet(&sand, 79e-6, 0.1, 165.0);
    assert_eq!((out.fate, out.validity.codes().collect::<Vec<_>>()), (Fate::Capture, vec!["grazing-capture"]));
    for normal in ["\"ea\"", "\"eap\"", "[\"adhesion-jkr\"]", "\"thornton-ning\"", "\"resolved\""] {
        let wall = law(&format!("sphere = \"copper\"\nsurface = \"glass\"\nfriction = 0.3\nnormal = {normal}\n"));
        let jkr = normal.contains("jkr") || normal.contains("ning");
        for diameter in [1e-6, 10e-6, 80e-6] {
            // what adhesion holds: the energy of the fastest head-on approach that it alone captures
            let alone = if jkr { "[\"adhesion-jkr\"]" } else { "\"ea\"" };
            let alone = law(&format!("sphere = \"copper\"\nsurface = \"glass\"\nfriction = 0.3\nnormal = {alone}\n"));
            let v_c = alone.window(diameter, None).expect("in range").expect("it rebounds").capture_velocity;
            for part in [0.01, 0.5, 0.9] {
                for (along, wanted) in [(0.0, false), (3.1, false), (3.2, true), (1e3, true)] {
                    let out = meet(&wall, diameter, part * v_c, along * v_c);
                    assert_eq!(out.fate, Fate::Capture);
                    let said = out.validity.contains(Validity::GRAZING_CAPTURE);
                    assert_eq!(said, wanted, "{normal} {diameter} {part} {along}");
                }
            }
            // a rebound is never called a capture
            for v in [30.0, 1e3] {
                let out = meet(&wall, diameter, v * v_c, 1e4 * v_c);
                assert!(out.fate == Fate::Capture || !out.validity.contains(Validity::GRAZING_CAPTURE), "{normal} {v}");
            }
        }
    }
}

#[test]
fn a_well_holds_its_depth_and_a_trap_that_was_asked_for_is_not_questioned() {
    let depth = 1e-14;
    let dahneke = law(&format!(
        "sphere = \"polystyrene\"\nsurface = \"quartz\"\nfriction = 0.3\nnormal = [\"given-restitution\", \"adhesion-well\"]\nrestitution = 0.9\nwell_depth = {depth}\n"
    ));
    let mass = 1055.0 * PI / 6.0 * 1e-18f64;
    let hold = (2.0 * depth / mass).sqrt();
    for (along, wanted) in [(3.1, false), (3.2, true)] {
        let out = meet(&dahneke, 1e-6, 0.1 * hold, along * hold);
        assert_eq!((out.fate, out.validity.contains(Validity::GRAZING_CAPTURE)), (Fate::Capture, wanted), "{along}");
    }
    let trap = law("normal = \"constant\"\nrestitution = 0\nfriction = 0.3\n");
    assert!(meet(&trap, 1e-6, 0.1, 100.0).validity.is_empty());
}

#[test]
fn the_dynamic_strength_factor_multiplies_the_plastic_constant_wherever_it_comes_from() {
    let steel = "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nroughness_factor = 0.15\nfriction = 0\n";
    let quartz = "sphere = \"quartz\"\nsurface = \"silicon\"\nroughness_factor = 0.15\nfriction = 0\n";
    let given = format!("{steel}plastic_constant = \"100 MPa\"\n");
    for pair in [steel, quartz, &given] {
        for (normal, power) in [("\"eap\"", 2.5), ("[\"plastic-thornton-ning\"]", 2.5), ("[\"plastic-bons\"]", 1.0)] {
            let pair =
                if normal.contains("eap") { pair.to_owned() } else { pair.replace("roughness_factor = 0.15\n", "") };
            let v_y = |factor: &str| {
                let wall = law(&format!("{pair}normal = {normal}\n{factor}"));
                wall.yield_velocity(70e-6, None).expect("in range").expect("plastic")
            };
            let ratio = v_y("dynamic_strength_factor = 3\n") / v_y("");
            assert!((ratio / 3f64.powf(power) - 1.0).abs() < 1e-12, "{pair}{normal}: {ratio}");
            assert_eq!(v_y("dynamic_strength_factor = 1\n"), v_y(""), "1 is the default");
        }
    }
    // what the paper's fit to measurements needs of the steel: 3.5 times its bulk yield strength
    let fit = law(&format!("{steel}normal = \"eap\"\ndynamic_strength_factor = 3.535\n"));
    assert!((meet(&fit, 70e-6, 5.0, 0.0).restitution - 0.926).abs() < 1e-3);
    for refused in [
        format!("{steel}normal = \"ea\"\ndynamic_strength_factor = 2\n"),
        format!("{steel}normal = \"eap\"\ndynamic_strength_factor = 0\n"),
        format!("{steel}normal = \"eap\"\ndynamic_strength_factor = -1\n"),
        "sphere = \"copper\"\nsurface = \"glass\"\nfriction = 0\nnormal = \"thornton-ning\"\nlimiting_pressure = 1e9\ndynamic_strength_factor = 2\n".to_owned(),
    ] {
        let compiled = carom::spec::parse_law(&refused).and_then(|l| l.compile(Library::builtin()));
        let error = compiled.expect_err(&refused).to_string();
        assert!(error.contains("dynamic_strength_factor"), "{error}");
    }
}

#[test]
fn no_law_reads_the_tensile_strength_of_a_brittle_body() {
    let with = |tensile: &str, normal: &str| {
        law(&format!(
            "sphere = \"rho=2650,E=94GPa,nu=0.1,gamma=0.7,H=8GPa{tensile}\"\nsurface = \"rho=2330,E=166GPa,nu=0.28,gamma=1.42,H=9.8GPa{tensile}\"\nfriction = 0\nnormal = {normal}\n"
        ))
    };
    for normal in ["\"eap\"", "\"thornton-ning\"", "[\"plastic-bons\"]", "\"ea\""] {
        let (bare, brittle) = (with("", normal), with(",sigma_t=50MPa", normal));
        let told = with(",sigma=50MPa", normal);
        for v in [0.01, 1.0, 30.0] {
            let answer = |wall: &WallLaw| {
                let out = meet(wall, 50e-6, v, 0.0);
                (out.velocity, out.energy, out.validity)
            };
            assert_eq!(answer(&bare), answer(&brittle), "{normal} {v}");
            // written as a yield strength it is used: told to
            assert!(v < 10.0 || answer(&told) != answer(&bare), "{normal} {v}");
        }
    }
}
