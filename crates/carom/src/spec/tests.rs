use super::*;
use crate::material::Library;
use crate::normal::NormalLaw;

const PAIR: &str = "sphere = \"copper\"\nsurface = \"aluminium\"\nfriction = 0.2\n";

/// The complaint about a law text, with its place.
fn complaint(text: &str) -> String {
    match parse_law(text).and_then(|law| law.compile(Library::builtin())) {
        Ok(_) => panic!("accepted: {text}"),
        Err(e) => e.located("law.toml", text),
    }
}

fn refuses(text: &str, place: &str, parts: &[&str]) {
    let message = complaint(text);
    assert!(message.starts_with(&format!("law.toml{place}")), "{text}\n{message}");
    for part in parts {
        assert!(message.contains(part), "{text}\n{message}\nlacks {part}");
    }
}

#[test]
fn mistakes_are_refused_where_they_stand() {
    for (text, place, parts) in [
        ("normal = \"ae\"\n", ":1:10", &["unknown normal law 'ae'", "ea"][..]),
        ("normal = \"adhesion-work\"\n", ":1:10", &["normal = [\"adhesion-work\"]"]),
        ("normal = []\n", ":1:10", &["empty list"]),
        ("normal = [\"adhesion-wrok\"]\n", ":1:11", &["did you mean adhesion-work?"]),
        ("normal = [\"adhesion-work\", \"adhesion-jkr\"]\n", ":1:10", &["counted twice", "adhesion work"]),
        ("normal = [\"hertz-damping\", \"hertz-damping\"]\n", ":1:10", &["twice"]),
        ("normal = \"ea\"\nhertz_dampng = 3\n", ":2:1", &["hertz_dampng"]),
        ("normal = \"ea\"\nroughness = \"1 s\"\n", ":2:13", &["no unit of length", "90 um"]),
        ("normal = \"constant\"\nrestitution = 1.2\nfriction = 0\n", ":2:15", &["1.2", "between 0 and 1"]),
        ("normal = \"constant\"\nfriction = 0\n", ":1:10", &["restitution = 0.7"]),
        ("normal = \"by-angle\"\nrestitution = 0.7\nfriction = 0\n", ":2:15", &["constant"]),
        (
            "normal = \"by-angle\"\nrestitution = \"grant\"\nfriction = 0\n",
            ":2:15",
            &["unknown curve", "grant-tabakoff"],
        ),
        ("normal = \"by-angle\"\nrestitution = { polynomial = [2.0] }\nfriction = 0\n", ":2:15", &["gives 2.0000 at"]),
        ("normal = \"by-angle\"\nrestitution = { angle_deg = [10, 45] }\n", ":2:15", &["one form"]),
        (
            "normal = \"constant\"\nrestitution = 0.5\ntangential = \"micro-slop\"\n",
            ":3:14",
            &["did you mean micro-slip?"],
        ),
        ("normal = \"constant\"\nrestitution = 0.5\nfriction = -0.1\n", ":3:12", &["friction = -0.1", "zero or more"]),
        ("normal = \"constant\"\nrestitution = 0.5\nfriction = nan\n", ":3:12", &["NaN"]),
        (
            "normal = \"constant\"\nrestitution = 0.5\nfriction = 0.1\ntangential = \"walton\"\n",
            ":4:14",
            &["walton_beta"],
        ),
        (
            "normal = \"constant\"\nrestitution = 0.5\nfriction = 0.1\ntangential_restitution = 0.9\ntangential = \"rolling\"\n",
            ":4:26",
            &["no effect"],
        ),
    ] {
        refuses(text, place, parts);
    }
}

#[test]
fn what_a_pair_lacks_is_named() {
    for (text, place, parts) in [
        ("sphere = \"coper\"\nsurface = \"aluminium\"\nnormal = \"ea\"\n", ":1:10", &["did you mean copper?"][..]),
        ("sphere = { rho = 8000, E = \"190 GPa\", nu = 0.5 }\n", ":1:44", &["poisson_ratio = 0.5"]),
        (
            "sphere = \"E=190GPa,nu=0.27\"\nsurface = \"silicon\"\nnormal = \"ea\"\nfriction = 0\n",
            ":3:10",
            &["no surface energy", "work_of_adhesion"],
        ),
        (
            "sphere = \"mica\"\nsurface = \"tedlar\"\nnormal = \"eap\"\nfriction = 0\n",
            ":3:10",
            &["yield strength", "plastic_constant"],
        ),
        ("normal = \"ea\"\nfriction = 0\n", ":1:10", &["sphere and surface"]),
        (
            "normal = \"constant\"\nrestitution = 0.9\nfriction = 0.1\ntangential = \"micro-slip\"\n",
            ":4:14",
            &["tangential = \"micro-slip\" needs a sphere and a surface"],
        ),
        (
            "sphere = \"E=190GPa\"\nsurface = \"silicon\"\nnormal = \"constant\"\nrestitution = 0.9\nfriction = 0.1\ntangential = \"micro-slip\"\n",
            ":6:14",
            &["no Poisson's ratio", "poisson_ratio (nu)"],
        ),
        ("surface = \"silicon\"\nnormal = \"ea\"\nfriction = 0\n", ":2:10", &["the law needs a sphere;"]),
    ] {
        refuses(text, place, parts);
    }
}

#[test]
fn contradictions_are_refused() {
    for (rest, place, parts) in [
        (
            "normal = \"ea\"\nroughness_factor = 0.5\nroughness = \"1 nm\"\n",
            ":6:13",
            &["both roughness_factor and roughness"][..],
        ),
        ("normal = \"ea\"\nroughness_model = \"fuller-tabor\"\n", ":5:19", &["without roughness"]),
        (
            "normal = \"ea\"\nroughness = \"1 nm\"\nroughness_model = \"fuler-tabor\"\n",
            ":6:19",
            &["did you mean fuller-tabor?"],
        ),
        (
            "normal = \"ea\"\nroughness = \"1 nm\"\nroughness_model = \"fuller-tabor\"\n",
            ":6:19",
            &["asperity_radius = \"100 nm\""],
        ),
        ("normal = \"ea\"\nroughness = \"1 nm\"\nasperity_radius = \"1 um\"\n", ":6:19", &["fuller-tabor"]),
        ("normal = \"ea\"\nroughness_factor = 0\n", ":5:20", &["C_R lies above 0"]),
        ("normal = \"ea\"\nrestitution = 0.5\n", ":5:15", &["no effect"]),
        ("normal = \"ea\"\nadhesion = \"reversible\"\n", ":5:12", &["resolved"]),
        (
            "normal = \"thornton-ning\"\nroughness_factor = 0.5\n",
            ":5:20",
            &["no effect with normal = \"thornton-ning\""],
        ),
        ("normal = \"thornton-ning\"\nhertz_damping = 0.5\n", ":5:17", &["no effect", "hertz-damping"]),
        ("normal = [\"adhesion-work\"]\nadhesion_damping = 1\n", ":5:20", &["adhesion-damping"]),
        ("normal = [\"hertz-damping\"]\n", ":4:10", &["hertz_damping"]),
        ("normal = \"tabor\"\n", ":4:10", &["yield_velocity"]),
        ("normal = \"tabor\"\nyield_velocity = 0.1\nmeyer_index = 3\n", ":6:15", &["meyer_index = 3"]),
        ("normal = \"ea\"\nsurface_curvature = 0\n", ":5:21", &["surface_curvature = 0"]),
        ("normal = \"ea\"\nhertz_damping = -1\n", ":5:17", &["zero or more"]),
        ("normal = \"ea\"\nstiffness = \"0 GPa\"\n", ":5:13", &["positive"]),
        (
            "normal = \"ea\"\ntangential = \"micro-slip\"\ntangential_restitution = 0.9\n",
            ":6:26",
            &["no effect", "micro-slip"],
        ),
    ] {
        refuses(&format!("{PAIR}{rest}"), place, parts);
    }
}

#[test]
fn named_laws_and_their_lists_are_the_same() {
    let library = Library::builtin();
    let compile = |rest: &str| {
        let text = format!("{PAIR}{rest}");
        let law = parse_law(&text).and_then(|l| l.compile(library));
        *law.unwrap_or_else(|e| panic!("{}", e.located("law", &text))).normal()
    };
    assert_eq!(compile("normal = \"ea\"\n"), compile("normal = [\"adhesion-work\"]\n"));
    assert_eq!(
        compile("normal = \"ea\"\nadhesion_damping = 1\nhertz_damping = 2\n"),
        compile(
            "normal = [\"adhesion-work\", \"adhesion-damping\", \"hertz-damping\"]\nadhesion_damping = 1\nhertz_damping = 2\n"
        )
    );
    assert_eq!(compile("normal = \"eap\"\n"), compile("normal = [\"plastic-kadomtsev\", \"adhesion-work\"]\n"));
    assert_eq!(
        compile("normal = \"thornton-ning\"\n"),
        compile("normal = [\"plastic-thornton-ning\", \"adhesion-jkr\"]\n")
    );
    assert!(matches!(compile("normal = \"resolved\"\n"), NormalLaw::Resolved(_)));
}

#[test]
fn laws_are_found_by_name_among_other_tables() {
    let text = "title = \"x\"\n[fluid]\ndensity = 1.2\n[law.glass]\nnormal = \"constant\"\nrestitution = 0.9\nfriction = 0.1\n[[wall]]\nname = \"floor\"\n";
    assert!(parse_named_law(text, "glass").is_ok());
    let broken = text.replace("restitution = 0.9", "restitution = 1 nm");
    assert!(parse_named_law(&broken, "glass").is_err_and(|e| e.line_column(&broken).map(|p| p.0) == Some(6)));
    let other = text.replace("[[wall]]", "[law.other]\nfrictoin = \"1 kg\"\n[law.none]\n[[wall]]");
    assert_eq!(parse_named_law(&other, "glass").map(|l| l.restitution.is_some()), Ok(true), "another law is broken");
    let e = parse_named_law(&other, "other").expect_err("a misspelt key");
    assert!(e.line_column(&other).map(|p| p.0) == Some(9) && e.to_string().contains("did you mean friction?"), "{e}");
    assert!(parse_named_law(&text.replace("law.glass", "law"), "friction").is_err_and(|e| e.span.is_some()));
    assert!(parse_named_law("x = 1\n", "glass").is_err_and(|e| e.to_string().contains("no [law.NAME] table")));
}

#[test]
fn roughness_above_its_calibration_is_flagged() {
    let library = Library::builtin();
    let flags = |rest: &str| {
        let law = parse_law(&format!("{PAIR}{rest}")).and_then(|l| l.compile(library)).expect("a good law");
        law.kernel().validity.codes().collect::<Vec<_>>()
    };
    assert_eq!(flags("normal = \"ea\"\nroughness = \"1 nm\"\n"), ["roughness-extrapolated"]);
    assert!(flags("normal = \"ea\"\nroughness = \"0.5 nm\"\n").is_empty());
    assert!(flags("normal = \"ea\"\nroughness_factor = 0.15\n").is_empty());
    let fuller = "roughness_model = \"fuller-tabor\"\nasperity_radius = \"100 nm\"\n";
    assert!(flags(&format!("normal = \"ea\"\nroughness = \"1 nm\"\n{fuller}")).is_empty());
}

#[test]
fn fuller_and_tabors_factor_is_that_of_the_pair() {
    let library = Library::builtin();
    let factor = |rest: &str| {
        let text =
            format!("{PAIR}normal = \"ea\"\nroughness_model = \"fuller-tabor\"\nasperity_radius = \"100 nm\"\n{rest}");
        let law =
            parse_law(&text).and_then(|l| l.compile(library)).unwrap_or_else(|e| panic!("{}", e.located("law", &text)));
        (law.roughness_factor(), law.pair().expect("a pair").clone())
    };
    assert_eq!(factor("roughness = 0\n").0, 1.0);
    let (c_r, pair) = factor("roughness = \"0.8 nm\"\n");
    let (w, e_star) = (pair.work_of_adhesion().expect("given"), pair.effective_modulus().expect("given"));
    let theta = e_star * 0.8e-9f64.powf(1.5) / (100e-9f64.sqrt() * w);
    assert!((c_r - crate::roughness::fuller_tabor::factor(theta)).abs() < 1e-12 && c_r > 0.01 && c_r < 0.99, "{c_r}");
    assert!(factor("roughness = \"1.6 nm\"\n").0 < c_r);
    assert_eq!(factor("roughness = \"100 nm\"\n").0, 0.0);
    assert_eq!(factor("roughness = \"1 nm\"\nwork_of_adhesion = 0\n").0, 1.0);
}

#[test]
fn every_key_survives_being_written() {
    let text = r#"
        sphere = { density = "2 g/cm3", young_modulus = "70 GPa", poisson_ratio = 0.3, surface_energy = 0.5 }
        surface = "glass"
        normal = ["adhesion-work", "hertz-damping", "plastic-tabor"]
        tangential = "walton"
        walton_beta = 0.4
        friction = 0.2
        roughness = "1 nm"
        roughness_model = "fuller-tabor"
        asperity_radius = "100 nm"
        hertz_damping = "7 ms/m"
        surface_curvature = "inf"
        yield_velocity = 0.09
        meyer_index = 2.29
        interfacial_parameter = 1.1
        equilibrium_spacing = "0.3 nm"
        stiffness = "65 GPa"
    "#;
    // the rest of the keys, which exclude some of those
    let other = r#"
        sphere = "copper"
        surface = "glass"
        normal = "resolved"
        adhesion = "reversible"
        tangential_restitution = 0.9
        roughness_factor = 0.4
        roughness_angle = "5 deg"
        adhesion_damping = 0.1
        surface_curvature = "-2 m"
        work_of_adhesion = "1.1 J/m2"
    "#;
    let third = "sphere = \"copper\"\nsurface = \"glass\"\nnormal = \"eap\"\nplastic_constant = 1e8\nfriction = 0\n";
    let fourth =
        "sphere = \"copper\"\nsurface = \"glass\"\nnormal = \"thornton-ning\"\nlimiting_pressure = 1e8\nfriction = 0\n";
    let well = "sphere = \"copper\"\nnormal = \"dahneke\"\nrestitution = 0.9\n";
    let sixth = format!("{well}well_depth = \"1 fJ\"\nwell_depth_out = \"2 fJ\"\nfriction = 0\n");
    let seventh = format!("{well}hamaker_constant = \"300 zJ\"\nequilibrium_spacing = \"0.4 nm\"\nfriction = 0\n");
    let eighth = format!("{third}dynamic_strength_factor = 2\n");
    let fifth = "normal = \"constant\"\nrestitution = 0.5\nfriction = 0\n";
    let texts = [text, other, third, fourth, fifth, &sixth, &seventh, &eighth];
    let given = |key: &Key| texts.iter().any(|t| parse_law(t).expect("a law").is_given(*key));
    assert!(Key::ALL.iter().all(given), "{:?}", Key::ALL.iter().filter(|k| !given(k)).collect::<Vec<_>>());
    for text in texts {
        survives(text);
    }
    let density = parse_law(text).and_then(|l| l.compile(Library::builtin())).expect("a law").density();
    assert_eq!(density, 2000.0);
}

/// A law is written and read again, as TOML and as JSON.
fn survives(text: &str) {
    let library = Library::builtin();
    let law = parse_law(text).expect("a law");
    let written = law.to_toml("wall").expect("text");
    let again = parse_named_law(&written, "wall").expect("it reads");
    assert_eq!(again.to_toml("wall").expect("text"), written);
    let json = serde_json::to_string(&law).expect("JSON");
    let from_json: LawSpec = serde_json::from_str(&json).unwrap_or_else(|e| panic!("{json}: {e}"));
    assert_eq!(from_json.to_toml("wall").expect("text"), written);
    let [law, again, from_json] = [law, again, from_json].map(|l| l.compile(library).unwrap_or_else(|e| panic!("{e}")));
    assert_eq!((law.normal(), law.tangential()), (again.normal(), again.tangential()));
    assert_eq!((law.normal(), law.tangential()), (from_json.normal(), from_json.tangential()));
}

#[test]
fn curves_survive_being_written() {
    for curve in [
        "0.7",
        "\"grant-tabakoff\"",
        "{ polynomial = [0.993, -1.76, 1.56, -0.49] }",
        "{ angle_deg = [10, 45, 90], value = [0.9, 0.7, 0.6] }",
        "{ pieces = [{ from_deg = 0, to_deg = 30, polynomial = [0.5] }, { from_deg = 30, to_deg = 90, polynomial = [0.4, 0.1] }] }",
    ] {
        let kind = if curve == "0.7" { "constant" } else { "by-angle" };
        let law = parse_law(&format!("normal = \"{kind}\"\nrestitution = {curve}\nfriction = 0.1\n")).expect("a law");
        let again = parse_named_law(&law.to_toml("wall").expect("text"), "wall").expect("it reads");
        let [law, again] = [law, again].map(|l| l.compile(Library::builtin()).expect("a law"));
        for degrees in 1..=90 {
            let (s, c) = f64::from(degrees).to_radians().sin_cos();
            let impact = crate::Impact::new(1e-4, [c, -s, 0.0], [0.0, 1.0, 0.0]);
            let [a, b] = [&law, &again].map(|l| l.impact(&impact).expect("it approaches").restitution);
            assert_eq!(a.to_bits(), b.to_bits(), "{curve} at {degrees} degrees: {a} {b}");
        }
    }
}

#[test]
fn a_well_says_what_it_lacks_and_what_it_does_not_read() {
    let well = "sphere = \"copper\"\nnormal = \"dahneke\"\n";
    for (rest, place, parts) in [
        ("well_depth = 1e-15\n", ":2:10", &["normal = \"dahneke\" needs a restitution"][..]),
        ("restitution = 0.9\n", ":2:10", &["needs the depth of the adhesion well", "well_depth = \"1e-15 J\""]),
        ("restitution = 0.9\nwell_depth = \"1 nm\"\n", ":4:14", &["energy"]),
        (
            "restitution = 0.9\nwell_depth = 1e-15\nhamaker_constant = 1e-19\n",
            ":5:20",
            &["both well_depth and hamaker"],
        ),
        ("restitution = 0.9\nwell_depth = 2e-15\nwell_depth_out = 1e-15\n", ":5:18", &["at least well_depth"]),
        ("restitution = 0.9\nhamaker_constant = 1e-19\n", ":2:10", &["equilibrium_spacing = \"0.2 nm\""]),
        (
            "restitution = 0.9\nhamaker_constant = 1e-19\nequilibrium_spacing = 4e-10\nwell_depth_out = 1e-15\n",
            ":6:18",
            &["well_depth_out has no effect without well_depth"],
        ),
        ("restitution = \"grant-tabakoff\"\nwell_depth = 1e-15\n", ":3:15", &["does not fit"]),
        (
            "restitution = 0.9\nwell_depth = 1e-15\nroughness_factor = 0.5\n",
            ":5:20",
            &["no effect with normal = \"dahneke\""],
        ),
    ] {
        refuses(&format!("{well}{rest}"), place, parts);
    }
}

#[test]
fn implausible_inputs_are_refused_with_what_may_be_meant() {
    let copper = "surface = \"copper\"\nnormal = \"ea\"\n";
    for (text, parts) in [
        // GPa and g/cm3 left out
        (format!("sphere = {{ E = 70, rho = 2500 }}\n{copper}"), &["young_modulus = 70 Pa", "70 GPa is written"][..]),
        (format!("sphere = {{ rho = 2.5 }}\n{copper}"), &["density = 2.5 kg/m3", "2.5 g/cm3"]),
        (format!("sphere = {{ gamma = 40 }}\n{copper}"), &["surface_energy = 40 J/m2", "40 mJ/m2"]),
        // the Ra of a machined surface
        (format!("sphere = \"copper\"\n{copper}roughness = \"1.6 um\"\n"), &["roughness = 0.0000016 m", "not the Ra"]),
        (format!("sphere = \"copper\"\n{copper}roughness = \"0.2 um\"\n"), &["roughness = 0.0000002 m", "not the Ra"]),
        (format!("sphere = \"copper\"\n{copper}equilibrium_spacing = 0.2\n"), &["distance between atoms"]),
    ] {
        let message = complaint(&text);
        for part in parts {
            assert!(message.contains(part), "{text}\n{message}");
        }
    }
    let dry = crate::material::Material::new("foam").with(crate::material::PropertyKind::Density, 30.0);
    let error =
        crate::WallLaw::builder().sphere(dry).normal(NormalKind::Tabor).yield_velocity(0.1).meyer_index(2.2).build();
    assert!(error.is_err_and(|e| (e.kind(), e.key()) == (crate::error::ErrorKind::OutOfRange, Some("density"))));
}

#[test]
fn without_friction_only_what_slips_is_refused() {
    use crate::{Impact, ImpactError};
    for rest in ["", "tangential = \"micro-slip\"\n", "tangential = \"walton\"\nwalton_beta = 0.5\n"] {
        let text = format!("sphere = \"copper\"\nsurface = \"aluminium\"\nnormal = \"ea\"\n{rest}");
        let wall = parse_law(&text).and_then(|l| l.compile(Library::builtin())).expect("a law");
        let with =
            parse_law(&format!("{text}friction = 0.3\n")).and_then(|l| l.compile(Library::builtin())).expect("a law");
        let head_on = Impact::new(50e-6, [0.0, -2.0, 0.0], [0.0, 1.0, 0.0]);
        let [a, b] = [&wall, &with].map(|w| w.impact(&head_on).expect("it approaches"));
        assert_eq!((a.velocity, a.restitution, a.validity), (b.velocity, b.restitution, b.validity), "{rest}");
        let oblique = Impact { velocity: [0.1, -2.0, 0.0], ..head_on };
        let spinning = Impact { spin: [0.0, 0.0, 1.0], ..head_on };
        for impact in [oblique, spinning] {
            assert_eq!(wall.impact(&impact), Err(ImpactError::FrictionNotGiven), "{rest}");
        }
        let error = wall.require_friction().expect_err("it has none");
        assert_eq!((error.kind(), error.key()), (crate::error::ErrorKind::MissingKey, Some("friction")));
        assert!(with.require_friction().is_ok());
    }
}

#[test]
fn outcomes_are_written_in_any_format() {
    let text = "sphere = \"copper\"\nsurface = \"aluminium\"\nnormal = \"ea\"\nfriction = 0.2\nroughness = \"1 nm\"\n";
    let wall = parse_law(text).and_then(|l| l.compile(Library::builtin())).expect("a law");
    let out = wall.impact(&crate::Impact::new(90e-6, [2.0, -0.5, 0.0], [0.0, 1.0, 0.0])).expect("it approaches");
    let json: serde_json::Value = serde_json::to_value(out).expect("JSON");
    assert_eq!((json["fate"].as_str(), json["contact"].as_str()), (Some(out.fate.name()), Some(out.contact.name())));
    assert_eq!(json["restitution"].as_f64(), Some(out.restitution));
    assert_eq!(json["energy"]["kept"].as_f64(), Some(out.energy.kept));
    let codes: Vec<&str> = json["validity"].as_array().expect("a list").iter().filter_map(|c| c.as_str()).collect();
    assert!(codes.contains(&"roughness-extrapolated") && codes == out.validity.codes().collect::<Vec<_>>());
}
