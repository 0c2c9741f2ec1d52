//! Which keys a law reads is declared; here the declarations are held against what the laws answer. A key that is declared changes
//! some answer or figure of the law, and one that is not is refused.

use carom::error::ErrorKind;
use carom::material::Library;
use carom::normal::Loss;
use carom::spec::{Choice, Key, LawSpec, NormalKind, NormalSpec, TangentialKind, parse_law};
use carom::{Impact, WallLaw};
use std::sync::LazyLock;

static LIBRARY: LazyLock<Library> = LazyLock::new(|| Library::builtin().clone());

/// Every normal law and every loss alone with every tangential law, without the keys that only some of them read.
fn laws() -> Vec<LawSpec> {
    let named = NormalKind::ALL.iter().map(|k| NormalSpec::from(*k));
    // a well as deep on both ways takes nothing by itself; it is tried in `dahneke`
    let losses = Loss::ALL.iter().filter(|l| **l != Loss::AdhesionWell);
    let listed = losses.map(|l| NormalSpec::from([*l]));
    let normals: Vec<NormalSpec> = named.chain(listed).collect();
    let base = "sphere = \"copper\"\nsurface = \"inconel-718\"\nnormal = \"ea\"\n";
    let mut laws = Vec::new();
    for normal in &normals {
        for tangential in TangentialKind::ALL {
            let mut law = parse_law(base).expect("a law");
            law.normal = Some(normal.clone().into());
            law.tangential = Some((*tangential).into());
            laws.push(law);
        }
    }
    laws
}

/// Two values of a key, as they are written.
fn values(key: Key, law: &LawSpec) -> [&'static str; 2] {
    let curve = |constant: bool| if constant { ["0.7", "0.6"] } else { ["{ polynomial = [0.7] }", "grant-tabakoff"] };
    match key {
        Key::Friction => ["0.2", "0.3"],
        Key::WaltonBeta => ["0.4", "0.5"],
        Key::RoughnessFactor => ["0.8", "0.7"],
        Key::Roughness => ["0.3 nm", "0.4 nm"],
        Key::RoughnessModel => ["rabinovich", "fuller-tabor"],
        Key::AsperityRadius => ["100 nm", "50 nm"],
        Key::RoughnessAngle => ["0", "5 deg"],
        Key::AdhesionDamping => ["1.3 s/m", "1.5 s/m"],
        Key::HertzDamping => ["0.007 s/m", "0.008 s/m"],
        Key::SurfaceCurvature => ["inf", "-30 um"],
        Key::Restitution => curve(law.normal.as_ref().is_none_or(|n| n.value != NormalKind::ByAngle.into())),
        Key::TangentialRestitution => {
            curve(law.tangential.as_ref().is_none_or(|t| t.value == TangentialKind::Constant))
        }
        Key::YieldVelocity => ["0.09 m/s", "0.1 m/s"],
        Key::MeyerIndex => ["2.29", "2.3"],
        Key::LimitingPressure => ["500 MPa", "600 MPa"],
        Key::InterfacialParameter => ["1", "1.1"],
        Key::EquilibriumSpacing => ["0.2 nm", "0.3 nm"],
        Key::WorkOfAdhesion => ["0.5 J/m2", "0.6 J/m2"],
        // far enough apart that even laws which only judge the contact's size by it differ at some speed
        Key::Stiffness => ["60 GPa", "0.6 GPa"],
        Key::PlasticConstant => ["145 MPa", "150 MPa"],
        Key::WellDepth => ["1 fJ", "2 fJ"],
        Key::WellDepthOut => ["2 fJ", "3 fJ"],
        Key::HamakerConstant => ["300 zJ", "3 aJ"],
        Key::DynamicStrengthFactor => ["1", "2"],
        Key::Adhesion => ["separation-only", "reversible"],
        other => panic!("no values for {other}: add two"),
    }
}

/// The law with what it cannot do without, all but `key` itself.
fn completed(law: &LawSpec, key: Key) -> LawSpec {
    let mut law = law.clone();
    for needed in [
        Key::Restitution,
        Key::TangentialRestitution,
        Key::Friction,
        Key::WaltonBeta,
        Key::YieldVelocity,
        Key::MeyerIndex,
        Key::AdhesionDamping,
        Key::HertzDamping,
        // inconel has no surface energy here
        Key::WorkOfAdhesion,
    ] {
        let excluded = key == Key::InterfacialParameter && needed == Key::WorkOfAdhesion;
        if needed != key && law.reads(needed) && !excluded {
            let value = values(needed, &law)[0];
            law.set_text(needed, value).unwrap_or_else(|e| panic!("{needed} = {value}: {e}"));
        }
    }
    if law.reads(Key::WellDepth) {
        let by_constant = matches!(key, Key::HamakerConstant | Key::EquilibriumSpacing);
        let well =
            if by_constant { [Key::HamakerConstant, Key::EquilibriumSpacing].as_slice() } else { &[Key::WellDepth] };
        for needed in well.iter().filter(|k| **k != key) {
            law.set_text(*needed, values(*needed, &law)[0]).expect("a number");
        }
    }
    if key == Key::InterfacialParameter {
        law.set_text(Key::Surface, "silicon").expect("a material");
    }
    if matches!(key, Key::RoughnessModel | Key::AsperityRadius) && law.reads(Key::Roughness) {
        law.set_text(Key::Roughness, "0.3 nm").expect("a length");
    }
    if key == Key::AsperityRadius && law.reads(Key::Roughness) {
        law.set_text(Key::RoughnessModel, "fuller-tabor").expect("a model");
    }
    law
}

fn with(law: &LawSpec, key: Key, value: &str) -> Result<WallLaw, carom::LawError> {
    let mut law = law.clone();
    law.set_text(key, value)?;
    if key == Key::RoughnessModel && value == "fuller-tabor" {
        law.set_text(Key::AsperityRadius, "100 nm")?;
    }
    law.compile(&LIBRARY)
}

/// Everything the law says at several speeds, as text.
fn answers(wall: &WallLaw) -> String {
    let mut said = String::new();
    for speed in [0.02, 0.3, 3.0, 30.0, 300.0] {
        // one rolls at the end, one slides, and one is small enough for adhesion to matter
        for (along, diameter) in [(0.3, 50e-6), (5.0, 50e-6), (0.3, 0.3e-6)] {
            let mut impact = Impact::new(diameter, [along * speed, -speed, 0.0], [0.0, 1.0, 0.0]);
            impact.draws = [0.3, 0.6, 0.2, 0.8];
            said += &format!("{:?}", wall.impact(&impact).map(|o| (o.velocity, o.spin, o.validity)));
        }
    }
    said + &format!("{:?} {:?}", wall.window(50e-6, None), wall.adhesion_numbers(50e-6))
}

#[test]
fn a_declared_key_acts_and_any_other_is_refused() {
    for law in laws() {
        for key in Key::ALL.iter().copied() {
            if matches!(key, Key::Sphere | Key::Surface | Key::Normal | Key::Tangential) {
                continue;
            }
            let law = completed(&law, key);
            let name = format!("{:?} {:?} {key}", law.normal, law.tangential);
            let [a, b] = values(key, &law).map(|v| with(&law, key, v));
            if law.reads(key) {
                let [a, b] = [a, b].map(|l| answers(&l.unwrap_or_else(|e| panic!("{name}: {e}"))));
                assert_ne!(a, b, "{name} is declared and does nothing");
            } else {
                for refused in [a, b] {
                    let e = refused.expect_err(&name);
                    assert_eq!((e.kind(), e.key()), (ErrorKind::IdleKey, Some(key.name())), "{name}: {e}");
                }
            }
        }
    }
}

#[test]
fn every_key_has_a_reader_and_every_entry_is_whole() {
    let mut draws = std::collections::BTreeSet::new();
    for key in Key::ALL.iter().copied() {
        let info = key.info();
        let always = matches!(key, Key::Sphere | Key::Surface | Key::Normal | Key::Tangential | Key::RoughnessAngle);
        assert!(always || !Choice::readers(key).is_empty(), "nothing reads {key}");
        assert!(!info.meaning.trim().is_empty() && !info.noun.is_empty() && !info.group.is_empty(), "{key}");
        let mut law = LawSpec::default();
        law.set_text(key, info.example).unwrap_or_else(|e| panic!("{key} = {}: {e}", info.example));
        if let Some(number) = law.number(key) {
            assert!(info.range.contains(number), "{key}: its example is out of its range");
        }
        if let Some(draw) = info.draw {
            assert!(draws.insert(draw) && draw > 0, "{key}: draw {draw} twice");
        }
    }
    // published numbers: a seed gives the same samples in every version
    let fixed = [(Key::RoughnessFactor, 1), (Key::Roughness, 2), (Key::WorkOfAdhesion, 3), (Key::Friction, 4)];
    for (key, draw) in fixed.into_iter().chain([(Key::AdhesionDamping, 5), (Key::HertzDamping, 6)]) {
        assert_eq!(key.info().draw, Some(draw), "{key}");
    }
}

/// The rows of the table in the documentation.
fn table() -> String {
    let mut rows = String::from("| key | symbol | unit | meaning | default | read with |\n|---|---|---|---|---|---|\n");
    for key in Key::ALL {
        let info = key.info();
        let unit = info.unit;
        let reading = key.read_with(&carom::error::Keys).replace('|', "\\|");
        let meaning = info.meaning.trim();
        rows += &format!("| `{}` | {} | {unit} | {meaning} | {} | {reading} |\n", info.name, info.symbol, info.default);
    }
    rows
}

/// Likewise, of the losses.
fn losses() -> String {
    let mut rows = String::from("| name | kind | takes |\n|---|---|---|\n");
    for loss in Loss::ALL {
        rows += &format!("| `{}` | {} | {} |\n", loss.name(), loss.kind(), loss.about());
    }
    rows
}

#[test]
fn the_documentation_lists_keys_and_losses() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/wall-law.md");
    let mut text = std::fs::read_to_string(path).expect("docs/wall-law.md");
    for (what, wanted) in [("keys", table()), ("losses", losses())] {
        let (begin, end) = (format!("<!-- {what}: from the registry -->\n"), format!("<!-- end of {what} -->\n"));
        let start = text.find(&begin).expect("the table's beginning") + begin.len();
        let stop = text.find(&end).expect("the table's end");
        if std::env::var_os("CAROM_WRITE_DOCS").is_some() {
            text.replace_range(start..stop, &wanted);
        } else {
            assert_eq!(&text[start..stop], wanted, "run with CAROM_WRITE_DOCS=1 to write it");
        }
    }
    if std::env::var_os("CAROM_WRITE_DOCS").is_some() {
        std::fs::write(path, text).expect("written");
    }
}
