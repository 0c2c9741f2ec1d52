use super::library::EMBEDDED;
use super::*;

#[test]
fn every_embedded_file_reads_and_every_file_is_embedded() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/materials");
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("data/materials")
        .map(|f| f.expect("entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let mut embedded: Vec<&str> = EMBEDDED.iter().map(|b| b.0).collect();
    embedded.sort_unstable();
    assert_eq!(names, embedded);
    for (name, text) in EMBEDDED {
        if let Err(e) = Library::default().extend_from_toml(text) {
            panic!("{}", e.located(name, text));
        }
    }
}

#[test]
fn an_embedded_file_that_cannot_be_read_is_reported() {
    let good = "[material.x]\ndensity = 8000\n";
    let library = Library::embedded(&[("bad.toml", "[material.y]\ndensty = 3\n"), ("good.toml", good)]);
    assert!(library.get("x").is_ok());
    let e = library.get("y").expect_err("its file is refused").to_string();
    assert!(e.contains("bad.toml:2:1: ") && e.contains("densty"), "{e}");
}

#[test]
fn the_library_is_read_once() {
    assert!(std::ptr::eq(Library::builtin(), Library::builtin()));
}

#[test]
fn every_library_value_has_a_source_and_every_alias_one_owner() {
    let library = Library::builtin();
    let mut owners = std::collections::BTreeMap::new();
    for m in library.iter() {
        assert!(!m.description.is_empty(), "{} has no description", m.name);
        for (kind, p) in &m.properties {
            assert!(
                p.source.as_ref().xor(p.typical.as_ref()).is_some_and(|s| s.len() > 5),
                "{} {} has no source, nor is it marked as typical",
                m.name,
                kind.key()
            );
            assert!(
                p.alternatives.iter().all(|a| a.source.is_some() && (a.value.is_some() || a.low.is_some())),
                "{}: {}",
                m.name,
                kind.key()
            );
        }
        for name in m.aliases.iter().chain([&m.name]) {
            if let Some(other) = owners.insert(name.to_lowercase(), m.name.clone()) {
                panic!("{name} names both {other} and {}", m.name);
            }
        }
    }
    assert_eq!(library.get("Stainless Steel").expect("there").name, "stainless-steel");
}

#[test]
fn hardness_is_some_three_times_the_yield_strength_and_a_brittle_body_has_no_yield_strength() {
    let library = Library::builtin();
    let mut brittle = Vec::new();
    for m in library.iter() {
        if let (Some(hardness), Some(sigma)) = (m.hardness, m.yield_strength) {
            let ratio = hardness / sigma;
            // 2.8 without work hardening; annealed metals harden under the indenter
            assert!((2.5..9.0).contains(&ratio), "{}: H is {ratio} sigma", m.name);
        }
        if let Some(tensile) = m.tensile_strength {
            assert!(m.yield_strength.is_none(), "{} both yields and breaks", m.name);
            assert!(m.hardness.is_some_and(|h| h > 20.0 * tensile), "{}: no hardness far above what breaks it", m.name);
            brittle.push(m.name.as_str());
        }
        // a hardness is a pressure that the elastic half-space can bear: below a fifth of the modulus
        assert!(m.hardness.zip(m.young_modulus).is_none_or(|(h, e)| h < 0.2 * e), "{}", m.name);
    }
    assert_eq!(
        brittle,
        [
            "aluminium-oxide",
            "aluminium-oxide-kharaz",
            "borosilicate-glass",
            "fused-silica",
            "quartz",
            "silicon",
            "soda-lime-glass",
            "soda-lime-glass-kharaz"
        ]
    );
}

fn refusal(text: &str) -> String {
    Library::default().extend_from_toml(text).expect_err("should be refused").located("my.toml", text)
}

#[test]
fn wrong_materials_are_refused_at_their_place() {
    let e = refusal("[material.x]\ndensity = \"8000 kg/m2\"\n");
    assert!(e.starts_with("my.toml:2:11:") && e.contains("kg/m3"), "{e}");
    let e = refusal("[material.x]\npoisson_ratio = { value = 0.5 }\n");
    assert!(e.starts_with("my.toml:2:") && e.contains("0.5"), "{e}");
    for (text, place) in [
        ("[material.x]\ndensity = 8000\npoisson_ratio = 0.5\n", "my.toml:3:17: poisson_ratio = 0.5 is out of range; "),
        ("[material.x]\nE = \"-3 GPa\"\n", "my.toml:2:5: young_modulus = -3000000000 Pa is out of range; "),
    ] {
        let e = refusal(text);
        assert!(e.starts_with(place), "{e}");
    }
    let law = "normal = \"ea\"\nsphere = { rho = 8000, nu = 0.7 }\n";
    let e = crate::spec::parse_law(law).expect_err("an impossible material").located("law.toml", law);
    assert!(e.starts_with("law.toml:2:29: poisson_ratio = 0.7 is out of range; "), "{e}");
    let e = refusal("[material.x]\ndensty = 3\n");
    assert!(e.starts_with("my.toml:2:1:") && e.contains("densty"), "{e}");
    let e = refusal("[material.x]\nyoung_modulus = { value = \"3 GPa\", low = \"4 GPa\" }\n");
    assert!(e.contains("outside its range"), "{e}");
    let e = refusal("[material.x]\nyoung_modulus = -1\n");
    assert!(e.contains("young_modulus = -1"), "{e}");
}

#[test]
fn inline_text_says_what_is_wrong() {
    for (text, part) in [
        ("rho=8000,E=190GPa,nu=0.6", "nu"),
        ("roh=8000", "did you mean rho?"),
        ("rho=8000,rho=3", "twice"),
        ("rho=8000 J", "kg/m3"),
        ("rho=-3", "-3"),
        ("rho", "key=value"),
    ] {
        let e = Material::from_inline(text).map(|m| format!("{m:?}")).unwrap_or_else(|e| e.to_string());
        assert!(e.contains(if part == "nu" { "poisson_ratio = 0.6" } else { part }), "{text}: {e}");
    }
}

#[test]
fn another_material_is_no_misspelling() {
    let said = |name: &str| Library::builtin().get(name).expect_err("unknown").to_string();
    for (wrong, right) in [
        ("coper", "copper"),
        ("silcon", "silicon"),
        ("polystirene", "polystyrene"),
        ("sand", "quartz"),
        ("Silica", "fused-silica"),
    ] {
        assert!(said(wrong).contains(&format!("did you mean {right}?")), "{}", said(wrong));
    }
    for word in ["wood", "soot", "PET", "PVF2", "zinc", "ash", "clay", "lime", "bronze", "cork", "chalk", "mannitol"] {
        assert!(!said(word).contains("did you mean"), "{}", said(word));
    }
}
