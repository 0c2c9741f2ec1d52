//! What is exported, read back from its text: it is as far from the law as it says.

mod evaluator;

use carom::WallLaw;
use carom::material::Library;
use carom::spec::parse_law;
use carom_lab::export::fluent::AngleUnit;
use carom_lab::export::{Range, Request, Sample, Span, Target, export, formula};
use carom_report::significant;
use evaluator::{Variables, evaluate};

fn law(text: &str) -> WallLaw {
    parse_law(text).expect("a law").compile(Library::builtin()).expect("it compiles")
}

const COPPER: &str = "sphere = \"copper\"\nsurface = \"glass\"\nfriction = 0.2\nroughness_factor = 0.8\n";

/// Every kind of normal and tangential law.
fn laws() -> Vec<(&'static str, WallLaw)> {
    let copper = |rest: &str| law(&format!("{COPPER}{rest}"));
    vec![
        ("ea", copper("normal = \"ea\"")),
        (
            "damped",
            copper("normal = \"ea\"\nadhesion_damping = 0.4\nhertz_damping = 0.02\ntangential = \"micro-slip\""),
        ),
        ("eap", copper("normal = \"eap\"\ntangential = \"walton\"\nwalton_beta = 0.4")),
        ("bons", copper("normal = [\"adhesion-work\", \"plastic-bons\"]")),
        (
            "hertz",
            law(
                "sphere = \"copper\"\nsurface = \"glass\"\nfriction = 0.2\nnormal = [\"hertz-damping\"]\nhertz_damping = 0.01",
            ),
        ),
        ("tabor", law("normal = \"tabor\"\nyield_velocity = 0.1\nmeyer_index = 2.3\nfriction = 0.3")),
        ("grant-tabakoff", law(GRANT_TABAKOFF)),
        ("backwards", law("normal = \"constant\"\nrestitution = 0.5\ntangential_restitution = -0.4")),
    ]
}

const GRANT_TABAKOFF: &str =
    "normal = \"by-angle\"\nrestitution = \"grant-tabakoff\"\ntangential_restitution = \"grant-tabakoff\"";

fn range(diameters: (f64, f64), speeds: (f64, f64)) -> Range {
    let [diameters, speeds] = [diameters, speeds].map(|(a, b)| Span::new(a, b));
    Range { diameters, speeds, angles: Span::new(5.0, 90.0) }
}

fn request(law: &WallLaw, range: Range, bins: usize, speed_bins: usize) -> Request<'_> {
    Request { law, title: "a law", range, bins, speed_bins }
}

/// Two bins of sizes for the law whose polynomials differ most with size, one size for the others.
fn sizes<'a>(name: &str, law: &'a WallLaw) -> Request<'a> {
    let two = name == "eap";
    request(law, range(if two { (1e-5, 1e-4) } else { (3e-5, 3e-5) }, (0.05, 30.0)), if two { 2 } else { 1 }, 1)
}

/// The lines with errors of each cell, without the sign of a comment.
fn told(text: &str) -> Vec<[String; 3]> {
    let lines: Vec<&str> = text.lines().map(|l| l.trim_start_matches(['#', '/', '%', ' '])).collect();
    let starts = lines.iter().enumerate().filter(|(_, l)| l.starts_with("largest error:"));
    starts.map(|(i, _)| [lines[i], lines[i + 1], lines[i + 2]].map(str::to_owned)).collect()
}

/// The same lines, computed here from e and e_t as read back.
fn computed(samples: &[Sample], read: impl Fn(&Sample) -> Option<(f64, f64)>) -> [String; 3] {
    let (mut largest, mut squares, mut weights) = ([0.0f64; 3], [0.0; 3], [0.0; 3]);
    let (mut wrong, mut captured) = (0.0, 0.0);
    for sample in samples {
        let (a, b) = (sample.rebound, read(sample));
        let (s, c) = if sample.angle == 90.0 { (1.0, 0.0) } else { sample.angle.to_radians().sin_cos() };
        wrong += if a.is_some() == b.is_some() { 0.0 } else { sample.weight };
        captured += if a.is_none() { sample.weight } else { 0.0 };
        let normal = a.map_or(0.0, |r| r.0) - b.map_or(0.0, |r| r.0);
        let along = |r: Option<(f64, f64)>| if c == 0.0 { 0.0 } else { r.map_or(0.0, |r| r.1 * c) };
        let tangential = if let (Some(a), Some(b), true) = (a, b, c != 0.0) { a.1 - b.1 } else { f64::NAN };
        for (i, difference) in [normal, tangential, (normal * s).hypot(along(a) - along(b))].into_iter().enumerate() {
            if !difference.is_nan() {
                largest[i] = largest[i].max(difference.abs());
                squares[i] += sample.weight * difference * difference;
                weights[i] += sample.weight;
            }
        }
    }
    let three = |v: [f64; 3]| {
        let [e, e_t, velocity] = v.map(|v| significant(v, 3));
        format!("e {e}, e_t {e_t}, outgoing velocity {velocity} of the speed")
    };
    let rms = [0, 1, 2].map(|i| if weights[i] > 0.0 { (squares[i] / weights[i]).sqrt() } else { 0.0 });
    [
        format!("largest error: {}", three(largest)),
        format!("rms error: {}", three(rms)),
        format!(
            "wrong fate: {} % of the impacts; the law captures {} %",
            significant(100.0 * wrong, 3),
            significant(100.0 * captured, 3)
        ),
    ]
}

/// Equal but for numbers that are nothing but rounding.
fn assert_same(told: &[String; 3], computed: &[String; 3], of: &str) {
    let split = |l: &String| l.replace("below ", "").split([' ', ',']).map(str::to_owned).collect::<Vec<_>>();
    for (a, b) in told.iter().zip(computed) {
        let (a, b) = (split(a), split(b));
        assert_eq!(a.len(), b.len(), "{of}");
        for (a, b) in a.iter().zip(&b) {
            let tiny = |t: &String| t.parse::<f64>().is_ok_and(|v| v.abs() <= 1e-7);
            assert!(a == b || (tiny(a) && tiny(b)), "{of}: told {told:?}, computed {computed:?}");
        }
    }
}

fn polynomial(line: Option<&str>, name: &str) -> Vec<f64> {
    let mut words = line.expect("a line").split_whitespace();
    assert_eq!(words.next(), Some(name));
    assert!(["polynomial", "constant"].contains(&words.next().expect("a kind")));
    words.map(|w| w.parse().expect("a number")).collect()
}

fn at(c: &[f64], x: f64) -> f64 {
    c.iter().enumerate().map(|(i, c)| c * x.powi(i32::try_from(i).expect("few"))).sum()
}

/// The conditions of a Fluent file, `None` for a trap.
fn fluent(text: &str) -> Vec<Option<[Vec<f64>; 2]>> {
    let mut lines = text.lines();
    let mut found = Vec::new();
    while let Some(line) = lines.next() {
        match line.strip_prefix("type") {
            Some(kind) if kind.trim() == "trap" => found.push(None),
            Some(kind) if kind.trim() == "reflect" => {
                found.push(Some([polynomial(lines.next(), "normal"), polynomial(lines.next(), "tangent")]));
            }
            Some(kind) => panic!("type '{kind}'"),
            None => {}
        }
    }
    found
}

#[test]
fn fluent_polynomials_are_as_far_off_as_they_say_and_within_bounds() {
    for (name, law) in laws() {
        for (speeds, degree) in [((0.1, 30.0), 5), ((0.05, 0.5), 7), ((2.0, 2.0), 2)] {
            let request = request(&law, range((1e-5, 1e-4), speeds), 2, if speeds.0 < speeds.1 { 2 } else { 1 });
            let text = export(&request, &Target::Fluent { degree, unit: AngleUnit::Degrees }).expect("it answers");
            let (conditions, told) = (fluent(&text), told(&text));
            let cells = request.cells();
            assert_eq!((conditions.len(), told.len()), (cells.len(), cells.len()));
            for ((cell, condition), told) in cells.iter().zip(&conditions).zip(&told) {
                let read = |s: &Sample| condition.as_ref().map(|[n, t]| (at(n, s.angle), at(t, s.angle)));
                assert_same(told, &computed(&cell.samples(&law).expect("samples"), read), name);
                let low = if name == "backwards" { -0.4 } else { 0.0 };
                for (c, low) in condition.iter().flat_map(|[n, t]| [(n, 0.0), (t, low)]) {
                    assert!(c.len() <= degree + 1);
                    let inside = |v: f64| (low - 1e-8..=1.0 + 1e-8).contains(&v);
                    assert!((0..=900).all(|i| inside(at(c, f64::from(i) / 10.0))), "{name}: {c:?}");
                }
            }
        }
    }
}

#[test]
fn grant_and_tabakoffs_curves_are_exported_as_they_are() {
    let law = law(GRANT_TABAKOFF);
    let request = request(&law, range((1e-5, 1e-4), (0.1, 30.0)), 1, 1);
    let printed = [[0.993, -1.76, 1.56, -0.49], [0.988, -1.66, 2.11, -0.67]];
    for (unit, scale) in [(AngleUnit::Radians, 1.0), (AngleUnit::Degrees, 1f64.to_radians())] {
        let text = export(&request, &Target::Fluent { degree: 7, unit }).expect("it answers");
        let conditions = fluent(&text);
        let [Some(found)] = &conditions[..] else { panic!("{text}") };
        for (found, printed) in found.iter().zip(printed) {
            assert_eq!(found.len(), 4, "{found:?}");
            for (i, (found, printed)) in found.iter().zip(printed).enumerate() {
                let wanted = printed * scale.powi(i32::try_from(i).expect("few"));
                assert!((found / wanted - 1.0).abs() < 1e-8, "{found} is not {wanted}");
            }
        }
        let largest: f64 = told(&text)[0][0].split([' ', ',']).filter_map(|w| w.parse().ok()).fold(0.0, f64::max);
        assert!(largest <= 1e-7, "{text}");
    }
}

/// The entries of an OpenFOAM file: `None` for stick.
fn openfoam(text: &str, patch: &str) -> Vec<Option<(f64, f64)>> {
    let bare: String = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect::<Vec<_>>().join(" ");
    let mut found = Vec::new();
    for part in bare.split("localInteractionCoeffs").skip(1) {
        let words: Vec<&str> = part.split_whitespace().collect();
        assert_eq!(words[..5], ["{", "patches", "(", patch, "{"]);
        let entry: Vec<&str> = words[5..].split(|w| *w == "}").next().expect("an end").to_vec();
        found.push(match entry[..] {
            ["type", "stick;"] => None,
            ["type", "rebound;", "e", e, "mu", mu] => {
                let number = |w: &str| w.trim_end_matches(';').parse::<f64>().expect("a number");
                Some((number(e), 1.0 - number(mu)))
            }
            _ => panic!("{entry:?}"),
        });
        assert!(words.join(" ").contains("\".*\" { type escape; } ); }"), "every patch must have an entry");
    }
    assert_eq!(bare.matches('{').count(), bare.matches('}').count());
    found
}

#[test]
fn openfoam_constants_are_as_far_off_as_they_say() {
    for (name, law) in laws() {
        let request = request(&law, range((1e-5, 1e-4), (0.05, 30.0)), 3, 2);
        let text = export(&request, &Target::OpenFoam { patch: "floor" }).expect("it answers");
        let (entries, told) = (openfoam(&text, "floor"), told(&text));
        assert_eq!((entries.len(), told.len()), (6, 6));
        for ((cell, entry), told) in request.cells().iter().zip(&entries).zip(&told) {
            assert_same(told, &computed(&cell.samples(&law).expect("samples"), |_| *entry), name);
        }
    }
}

#[test]
fn a_constant_law_is_exact_in_openfoam_and_fluent() {
    let law = law("normal = \"constant\"\nrestitution = 0.7\ntangential_restitution = 0.9");
    let request = request(&law, range((1e-5, 1e-4), (0.1, 30.0)), 1, 1);
    let text = export(&request, &Target::OpenFoam { patch: "walls" }).expect("it answers");
    assert_eq!(openfoam(&text, "walls"), [Some((0.7, 0.9))]);
    let fluent =
        fluent(&export(&request, &Target::Fluent { degree: 5, unit: AngleUnit::Degrees }).expect("it answers"));
    assert_eq!(fluent, [Some([vec![0.7], vec![0.9]])]);
}

/// Name and expression of each variable, in order.
fn star(text: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = text.lines().filter(|l| !l.starts_with('#') && !l.is_empty()).collect();
    lines.chunks(2).map(|pair| (format!("${}", pair[0]), pair[1].trim().to_owned())).collect()
}

fn comsol(text: &str) -> Vec<(String, String)> {
    let lines = text.lines().filter(|l| !l.starts_with('%') && !l.is_empty());
    let words = lines.map(|l| l.splitn(3, ' ').collect::<Vec<_>>());
    words.map(|w| (w[0].to_owned(), w[1].to_owned())).collect()
}

/// Values of all variables, from those that the program has.
fn all(definitions: &[(String, String)], mut variables: Variables) -> Variables {
    for (name, expression) in definitions {
        let value = evaluate(expression, &variables);
        variables.insert(name.clone(), value);
    }
    variables
}

#[test]
fn star_ccm_field_functions_are_as_far_off_as_they_say() {
    for (name, law) in laws() {
        let request = sizes(name, &law);
        let text = export(&request, &Target::StarCcm { degree: 4 }).expect("it answers");
        let definitions = star(&text);
        for ((n, cell), told) in request.cells().iter().enumerate().zip(told(&text)) {
            let read = |s: &Sample| {
                let values = all(
                    &definitions,
                    Variables::from([
                        ("$$ParticleVelocity".to_owned(), s.speed),
                        ("$ParticleIncidenceAngle".to_owned(), s.angle.to_radians()),
                        // the edge between two bins belongs to the upper one
                        ("$ParticleDiameter".to_owned(), if n == 0 { s.diameter * (1.0 - 1e-12) } else { s.diameter }),
                    ]),
                );
                let stick = values["$CaromStick"];
                assert!(stick == 0.0 || stick == 1.0);
                (stick == 0.0).then_some((values["$CaromNormalRestitution"], values["$CaromTangentialRestitution"]))
            };
            assert_same(&told, &computed(&cell.samples(&law).expect("samples"), read), name);
        }
    }
}

#[test]
fn comsol_variables_give_the_outgoing_velocity_for_either_normal() {
    for (name, law) in laws() {
        let request = sizes(name, &law);
        let text = export(&request, &Target::Comsol { degree: 4 }).expect("it answers");
        let definitions = comsol(&text);
        let told = told(&text);
        let largest = told.iter().map(|t| {
            let velocity = t[0].split("outgoing velocity ").nth(1).and_then(|r| r.split(' ').next());
            velocity.and_then(|v| v.parse::<f64>().ok()).unwrap_or(0.0)
        });
        let largest = 1.01 * largest.fold(0.0, f64::max) + 1e-7;
        let normal = [0.48, 0.6, 0.64];
        let along = [0.8, 0.0, -0.6];
        for (i, cell) in request.cells().iter().enumerate() {
            for sample in cell.samples(&law).expect("samples").iter().step_by(29) {
                let (s, c) = if sample.angle == 90.0 { (1.0, 0.0) } else { sample.angle.to_radians().sin_cos() };
                let given = |sign: f64| {
                    let mut v = Variables::new();
                    v.insert(
                        "fpt.dp".to_owned(),
                        if i == 0 { sample.diameter * (1.0 - 1e-12) } else { sample.diameter },
                    );
                    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                        v.insert(format!("fpt.v{axis}"), sample.speed * (c * along[k] - s * normal[k]));
                        v.insert(format!("n{axis}"), sign * normal[k]);
                    }
                    all(&definitions, v)
                };
                let (e, e_t) = sample.rebound.unwrap_or((0.0, 0.0));
                for values in [given(1.0), given(-1.0)] {
                    let bounces = values["carom_bounces"] != 0.0;
                    let apart = ["x", "y", "z"].into_iter().enumerate().map(|(k, axis)| {
                        let law = e * s * normal[k] + if c == 0.0 { 0.0 } else { e_t * c * along[k] };
                        let got = if bounces { values[&format!("carom_vp{axis}")] / sample.speed } else { 0.0 };
                        (got - law).powi(2)
                    });
                    let apart = apart.sum::<f64>().sqrt();
                    assert!(apart <= largest, "{name}, {sample:?}: {apart} is beyond {largest}");
                }
            }
        }
    }
}

#[test]
fn what_depends_on_speed_needs_the_speed() {
    // adhesion: the program that knows speed and size has the law exactly, the one that knows neither has the wrong fate for many
    let law = law(&format!("{COPPER}normal = \"ea\""));
    let request = request(&law, range((1e-5, 1e-4), (0.1, 30.0)), 1, 1);
    let wrong = |target: &Target| {
        let text = export(&request, target).expect("it answers");
        let line = told(&text)[0][2].clone();
        line.split(' ').nth(2).and_then(|w| w.parse::<f64>().ok()).expect("a percentage")
    };
    assert_eq!(wrong(&Target::StarCcm { degree: 1 }), 0.0);
    assert!(wrong(&Target::Fluent { degree: 7, unit: AngleUnit::Degrees }) > 15.0);
    // and what always sticks is told so
    let request = Request { range: range((1e-6, 2e-6), (0.01, 0.1)), ..request };
    let text = export(&request, &Target::Fluent { degree: 5, unit: AngleUnit::Degrees }).expect("it answers");
    assert_eq!(fluent(&text), [None]);
    let text = export(&request, &Target::OpenFoam { patch: "walls" }).expect("it answers");
    assert_eq!(openfoam(&text, "walls"), [None]);
    assert!(text.contains("wrong fate: 0 % of the impacts; the law captures 100 %"));
}

#[test]
fn one_diameter_is_as_good_as_a_narrow_range() {
    for normal in ["ea", "eap", "thornton-ning"] {
        let law = law(&format!("sphere = \"quartz\"\nsurface = \"steel\"\nnormal = \"{normal}\"\nfriction = 0.3\n"));
        for diameter in [5e-5, 1e-4, 2e-4] {
            for degree in [3, 5, 7] {
                let of = |to: f64| {
                    let cell = request(&law, range((diameter, to), (10.0, 200.0)), 1, 1).cells()[0];
                    formula::fit(&law, &cell, degree).expect("it answers").2
                };
                let (one, narrow) = (of(diameter), of(1.001 * diameter));
                assert_eq!(one.wrong_fate, 0.0, "{normal} {diameter} {degree}");
                assert!((one.velocity.rms - narrow.velocity.rms).abs() < 1e-4, "{one:?} {narrow:?}");
            }
            for target in [Target::StarCcm { degree: 5 }, Target::Comsol { degree: 5 }] {
                let request = request(&law, range((diameter, diameter), (10.0, 200.0)), 1, 1);
                assert!(export(&request, &target).expect("it answers").contains("wrong fate: 0 % of the impacts"));
            }
        }
    }
}

#[test]
fn smaller_bins_are_closer() {
    let damped = "normal = \"ea\"\nadhesion_damping = 0.4\nhertz_damping = 0.02";
    for (rest, four, one) in [("normal = \"eap\"", 0.009, 0.038), (damped, 0.022, 0.13)] {
        let law = law(&format!("{COPPER}{rest}").replace("roughness_factor = 0.8\n", ""));
        let rms = |bins| {
            let cells = request(&law, range((1e-5, 1e-4), (0.1, 30.0)), bins, 1).cells();
            let rms = cells.iter().map(|c| formula::fit(&law, c, 5).expect("it answers").2.restitution.rms);
            rms.fold(0.0, f64::max)
        };
        let (of_four, of_one) = (rms(4), rms(1));
        assert!(of_four < four && of_one > one, "{rest}: {of_four}, {of_one}");
    }
}

#[test]
fn a_range_that_the_law_refuses_is_an_error() {
    let law = law(&format!("{COPPER}normal = \"ea\"\nsurface_curvature = \"-1 mm\""));
    let request = request(&law, range((1e-3, 3e-3), (0.1, 30.0)), 1, 1);
    let error = export(&request, &Target::OpenFoam { patch: "walls" }).expect_err("too large for the hollow");
    assert!(error.to_string().contains("concave"), "{error}");
}
