use super::*;
use crate::force::{NearWall, RandomWalk};
use crate::record::{End, ImpactRecord, Sink};
use crate::tracker::Particle;

mod cells;
mod curvature;
mod erosion;
mod flat;
mod fluid;
mod flux;
mod forces;
mod gas;
mod particles;
mod stl;

/// How particles end, in the order in which they do.
#[derive(Default)]
struct Ends(Vec<End>);

impl Sink for Ends {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, _: &ImpactRecord) {}
    fn point(&mut self, _: u64, _: f64, _: [f64; 3], _: [f64; 3], _: [f64; 3]) {}
    fn end(&mut self, end: &End) {
        self.0.push(*end);
    }
    fn stalled(&mut self) {}
}

const GOOD: &str = r#"
title = "Copper in a channel"
seed = 7
[fluid]
density = "1.19 kg/m3"
viscosity = "1.83e-5 Pa s"
[flow]
kind = "channel"
profile = "laminar"
height = "30 mm"
mean_speed = "2 m/s"
[forces]
gravity = ["0 m/s2", "-9.81 m/s2", "0 m/s2"]
drag = "schiller-naumann"
[[wall]]
name = "floor"
plane = { point = ["0 m", "0 m", "0 m"], normal = [0, 1, 0] }
law = "plate"
[[wall]]
name = "ceiling"
plane = { point = ["0 m", "30 mm", "0 m"], normal = [0, -1, 0] }
law = "reflect"
restitution = 0.9
tangential_restitution = 0.8
[[wall]]
name = "outlet"
plane = { point = ["1 m", "0 m", "0 m"], normal = [-1, 0, 0] }
law = "escape"
contact_at = "center"
[law.plate]
sphere = "copper"
surface = "silicon"
normal = "ea"
friction = 0.2
roughness_factor = 0.8
[[injection]]
name = "dispenser"
material = "copper"
diameter = "90 um"
count = 10
position = ["0 m", "25 mm", "0 m"]
velocity = ["2 m/s", "0 m/s", "0 m/s"]
[run]
until = "2 s"
"#;

fn read(text: &str) -> Result<Case, CaseError> {
    Case::from_toml(text, Path::new("case.toml"), Library::builtin())
}

#[test]
fn a_good_case_reads_whole() {
    let case = read(GOOD).unwrap();
    assert_eq!(case.count(), 10);
    let thousand = GOOD.replacen("count = 10\n", "count = 1e3\n", 1);
    assert_eq!(read(&thousand).unwrap().count(), 1000);
    assert_eq!(case.title, "Copper in a channel");
    assert_eq!(case.domain.walls().len(), 3);
    assert_eq!((case.settings.until, case.settings.seed), (2.0, 7));
    let p = case.particle(9).unwrap();
    assert_eq!((p.number, p.diameter, p.density), (9, 90e-6, 8940.0));
    assert_eq!(p.position, [0.0, 0.025, 0.0]);
    assert!(case.particle(10).is_none());
}

/// The case with one line changed is refused, at that line, with these words.
fn refused(from: &str, to: &str, words: &[&str]) {
    assert!(GOOD.contains(from), "{from}");
    let text = GOOD.replacen(from, to, 1);
    let error = read(&text).expect_err(to);
    let shown = error.located("case.toml", &text);
    for word in words {
        assert!(shown.contains(word), "'{word}' not in: {shown}");
    }
    let line = 1 + GOOD[..GOOD.find(from).unwrap()].matches('\n').count();
    let lines = to.trim_end().matches('\n').count();
    let at = error.line_column(&text).unwrap_or_else(|| panic!("no place: {shown}")).0;
    assert!((line..=line + lines).contains(&at), "line {at}, not {line}: {shown}");
}

#[test]
fn mistakes_are_refused_at_their_line() {
    refused("seed = 7", "sead = 7", &["sead"]);
    refused("height = \"30 mm\"", "height = \"30 m/s\"", &["30 m/s", "length"]);
    refused("height = \"30 mm\"", "heigth = \"30 mm\"", &["heigth"]);
    refused("kind = \"channel\"", "kind = \"chanel\"", &["chanel", "did you mean channel?"]);
    refused("mean_speed = \"2 m/s\"", "mean_speed = \"2 m/s\"\nradius = \"1 m\"", &["no radius"]);
    refused("drag = \"schiller-naumann\"", "drag = \"shiller-naumann\"", &["did you mean schiller-naumann?"]);
    refused("material = \"copper\"", "material = \"coper\"", &["coper", "did you mean copper?"]);
    refused("surface = \"silicon\"", "surface = \"silcon\"", &["did you mean silicon?"]);
    refused("law = \"plate\"", "law = \"plat\"", &["did you mean plate?"]);
    refused("law = \"escape\"", "law = \"escpe\"", &["did you mean escape?"]);
    refused("contact_at = \"center\"", "contact_at = \"centre\"", &["did you mean center?"]);
    refused("restitution = 0.9", "restitution = 1.9", &["1.9"]);
    refused("name = \"ceiling\"", "name = \"floor\"", &["two walls are called 'floor'"]);
    refused("normal = [0, 1, 0]", "normal = [0, 0, 0]", &["no direction"]);
    refused("diameter = \"90 um\"", "diameter = \"-90 um\"", &["diameter", "positive"]);
    refused(
        "diameter = \"90 um\"",
        "diameter = { lognormal = { median = \"70 um\", gsd = 0.5 } }",
        &["standard deviation"],
    );
    refused("count = 10", "count = 10\nparcels = 3", &["parcels"]);
    refused(
        "count = 10",
        "count = 1.5",
        &["1.5 stands here", "a whole number, zero or more, such as 1000 or 1e3, is wanted"],
    );
    refused("count = 10", "count = -1", &["-1 stands here"]);
    refused("until = \"2 s\"", "until = \"-2 s\"", &["until"]);
    refused("until = \"2 s\"", "until = \"2 s\"\ntolerance = 0.5", &["tolerance"]);
    refused("until = \"2 s\"", "until = \"inf\"", &["inf"]);
}

#[test]
fn injections_inside_a_wall_are_refused() {
    let at = |y: &str| format!("position = [\"0 m\", \"{y}\", \"0 m\"]");
    refused(&at("25 mm"), &at("0.04 mm"), &["dispenser", "inside wall 'floor'"]);
    refused(&at("25 mm"), &at("31 mm"), &["inside wall 'ceiling'"]);
    let text = "position = { box = [[\"0 m\", \"1 mm\", \"0 m\"], [\"2 m\", \"2 mm\", \"0 m\"]] }";
    refused(&at("25 mm"), text, &["beyond wall 'outlet'"]);
    let rod = "law = \"plate\"\n[[wall]]\nname = \"rod\"\ncylinder = { point = [0.5, 0.012, 0], axis = [0, 0, 1], radius = 0.002, fluid = \"outside\" }\nlaw = \"trap\"";
    let around = "position = { box = [[\"0.4 m\", \"5 mm\", \"0 m\"], [\"0.6 m\", \"20 mm\", \"0 m\"]] }\ncount = 5000";
    let text = GOOD.replacen("law = \"plate\"", rod, 1).replace(&at("25 mm"), around).replacen("count = 10\n", "", 1);
    assert!(read(&text).unwrap_err().to_string().contains("inside wall 'rod'"));
    // touching is not inside
    assert!(read(&GOOD.replace("25 mm\"", "45 um\"")).is_ok());
}

#[test]
fn walls_that_contradict_each_other_are_refused() {
    let error = read(&GOOD.replacen("normal = [0, -1, 0]", "normal = [0, 1, 0]", 1)).unwrap_err();
    assert!(error.to_string().contains("inside wall 'ceiling'"), "{error}");
    let swapped = GOOD.replacen("[\"0 m\", \"30 mm\", \"0 m\"], normal", "[\"0 m\", \"-30 mm\", \"0 m\"], normal", 1);
    let error = read(&swapped).unwrap_err();
    assert!(error.to_string().contains("walls 'floor' and 'ceiling' contradict"), "{error}");
    let narrow = GOOD.replacen("[\"0 m\", \"30 mm\", \"0 m\"], normal", "[\"0 m\", \"80 um\", \"0 m\"], normal", 1);
    assert!(read(&narrow).unwrap_err().to_string().contains("no room for a sphere"));
}

#[test]
fn a_run_that_nothing_ends_is_refused() {
    let closed = GOOD.replace("until = \"2 s\"", "");
    assert!(read(&closed).is_ok(), "the outlet is a way out");
    let closed = closed.replace("law = \"escape\"", "law = \"plate\"");
    let error = read(&closed).unwrap_err();
    assert!(error.to_string().contains("neither until nor a wall"), "{error}");
}

#[test]
fn a_wall_may_slide_but_not_leave() {
    let moving = |v: &str| read(&GOOD.replacen("law = \"plate\"", &format!("law = \"plate\"\nvelocity = [{v}]"), 1));
    assert!(moving("1, 0, 0").is_ok());
    assert!(moving("1, 0.1, 0").unwrap_err().to_string().contains("moves off itself"));
}

#[test]
fn a_law_for_another_sphere_is_refused_and_one_for_none_takes_the_injections() {
    let silver = GOOD.replacen("material = \"copper\"", "material = \"aluminium\"", 1);
    let error = read(&silver).unwrap_err();
    assert!(error.to_string().contains("law 'plate' is for spheres of copper"), "{error}");
    assert!(read(&silver.replacen("sphere = \"copper\"\n", "", 1)).is_ok());
}

#[test]
fn spheres_a_law_cannot_take_are_refused() {
    let error = read(&GOOD.replace("material = \"copper\"", "density = \"1 kg/m3\"")).unwrap_err();
    assert!(error.to_string().contains("does not fit the law of wall 'floor'"), "{error}");
}

#[test]
fn any_bytes_are_answered_not_suffered() {
    use proptest::prelude::*;
    proptest!(|(cut in 0usize..GOOD.len(), noise in "[\\[\\]{}=\"a-z0-9 .\n-]{0,12}")| {
        if GOOD.is_char_boundary(cut) {
            let _ = read(&format!("{}{noise}{}", &GOOD[..cut], &GOOD[cut..]));
        }
    });
}

#[test]
fn removal_is_a_wall_option() {
    let with = |removal: &str| GOOD.replacen("law = \"plate\"", &format!("law = \"plate\"\nremoval = {removal}"), 1);
    let of = |removal: &str| match &read(&with(removal)).unwrap_or_else(|e| panic!("{removal}: {e}")).behaviors[0] {
        Behavior::Removal(_, r) => Some(*r),
        _ => None,
    };
    use carom::removal::Mode;
    let removal =
        |mode, friction_velocity| Some(crate::tracker::Reentrainment { mode, friction_velocity, follow: false });
    assert_eq!(of("false"), None);
    assert_eq!(of("true"), removal(None, None));
    assert_eq!(of("\"lifting\""), removal(Some(Mode::Lifting), None));
    assert_eq!(of("{ friction_velocity = \"0.5 m/s\" }"), removal(None, Some(0.5)));
    assert_eq!(of("{ mode = \"sliding\", friction_velocity = 2 }"), removal(Some(Mode::Sliding), Some(2.0)));
    assert!(of("{ follow = true }").is_some_and(|r| r.follow) && of("{ follow = false }") == removal(None, None));
    let lifted = "law = \"plate\"\nremoval = { mode = \"lifting\", follow = true }";
    refused("law = \"plate\"", lifted, &["follow beside a mode that is not rolling"]);
    refused("law = \"plate\"", "law = \"plate\"\nremoval = \"roling\"", &["did you mean rolling?"]);
    refused("law = \"plate\"", "law = \"plate\"\nremoval = 3", &["true, false"]);
    refused("law = \"plate\"", "law = \"plate\"\nremoval = { speed = 3 }", &["unknown key 'speed'"]);
    refused("law = \"plate\"", "law = \"plate\"\nremoval = { friction_velocity = -1 }", &["must be positive"]);
    refused("law = \"escape\"", "law = \"escape\"\nremoval = true", &["holds nothing by adhesion"]);
    refused("law = \"reflect\"", "law = \"reflect\"\nremoval = true", &["holds no sphere"]);
    let still = with("true").replacen("profile = \"laminar\"", "profile = \"plug\"", 1);
    let error = read(&still).expect_err("a plug has no wall shear").to_string();
    assert!(error.contains("this flow knows none") && error.contains("friction_velocity = "), "{error}");
}

#[test]
fn the_random_walk_is_well_mixed_unless_told_otherwise() {
    let walk = |keys: &str| {
        let text = GOOD.replace("drag = ", &format!("random_walk = {{ {keys} }}\ndrag = "));
        read(&text).unwrap().dynamics.random_walk.unwrap()
    };
    assert!(walk("").drift && walk("drift = true").drift && !walk("drift = false").drift);
    assert_eq!(walk("model = \"eddies\""), walk(""));
    assert_eq!(walk("model = \"langevin\""), RandomWalk::langevin());
    let mixed = walk("model = \"langevin\", near_wall = \"kallio-reeks\", time_scale = 0.2");
    assert_eq!(mixed, RandomWalk { near_wall: NearWall::KallioReeks, time_scale: 0.2, ..RandomWalk::langevin() });
    let wrong = GOOD.replace("drag = ", "random_walk = { model = \"langevin\", life = \"random\" }\ndrag = ");
    let error = read(&wrong).expect_err("no eddies").to_string();
    assert!(error.contains("no eddies"), "{error}");
}

/// A file of two solids, each a wall of its own; what no wall takes, and a wall in the wrong unit, are told.
#[test]
fn solids_are_walls_of_their_own_and_what_is_left_out_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let facet = |x: i32| {
        format!(
            "facet normal 0 1 0\nouter loop\nvertex {x} 0 0\nvertex {x} 0 1\nvertex {} 0 0\nendloop\nendfacet\n",
            x + 1
        )
    };
    let stl = format!("solid left\n{}endsolid left\nSOLID Right\n{}ENDSOLID\n", facet(-1), facet(0));
    std::fs::write(folder.path().join("w.stl"), stl).unwrap();
    let wall = |name: &str, keys: &str| {
        format!("[[wall]]\nname = \"{name}\"\nstl = {{ file = \"w.stl\"{keys} }}\nlaw = \"trap\"\n")
    };
    let read = |walls: &str| {
        let rest =
            "[[injection]]\ndensity = 1000\ndiameter = \"10 um\"\nposition = [0, 0.5, 0]\nvelocity = [0, -1, 0]\n";
        let name = folder.path().join("case.toml");
        Case::from_toml(&format!("{walls}{rest}[run]\nuntil = 1\n"), &name, Library::builtin()).map(|case| case.notes)
    };
    let told = |notes: &[String], what: &str| notes.iter().any(|n| n.contains(what));
    let both = wall("a", ", solid = \"left\"") + &wall("b", ", solid = \"Right\"");
    let notes = read(&both).unwrap();
    assert!(told(&notes, "wall 'a': 1 triangle of w.stl, 2 solids in the file, 1 m x 0 m x 1 m"), "{notes:?}");
    assert!(!told(&notes, "no wall takes"), "{notes:?}");
    let notes = read(&wall("a", ", solid = \"left\"")).unwrap();
    assert!(told(&notes, "w.stl: no wall takes its solids 'Right'"), "{notes:?}");
    let notes = read(&wall("a", ", unit = \"1 um\"")).unwrap();
    assert!(told(&notes, "wall 'a' is 2.000e-6 m large, less than a sphere"), "{notes:?}");
    let error = read(&wall("a", ", solid = \"top\"")).unwrap_err().to_string();
    assert!(error.contains("no triangles in a solid 'top'; the file has 'left', 'Right'"), "{error}");
}

#[test]
fn columns_of_a_table_are_named_in_the_case() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("f.csv"), "Lage [mm];UMean_0;p\n0;1;0\n1000;3;0\n").unwrap();
    let read = |columns: &str| {
        let rest =
            "[[injection]]\ndensity = 1000\ndiameter = \"10 um\"\nposition = [0.5, 0, 0]\nvelocity = \"fluid\"\n";
        let flow = format!("[flow]\nkind = \"table\"\nfile = \"f.csv\"\n{columns}\n");
        Case::from_toml(&format!("{flow}{rest}[run]\nuntil = 1\n"), &folder.path().join("c.toml"), Library::builtin())
    };
    let case = read("columns = { x = \"Lage [mm]\", u = \"UMean_0\" }").unwrap();
    assert_eq!(case.particle(0).unwrap().velocity, [2.0, 0.0, 0.0]);
    assert!(case.notes.contains(&"flow table: not used: p".to_owned()), "{:?}", case.notes);
    for (columns, wanted) in [
        ("", "no column of u, the velocity along x, among"),
        (
            "columns = { q = \"p\" }",
            "columns has no \"q\"; it names the columns of x, y, z, u, v, w, k, epsilon, omega, T, rho",
        ),
        ("columns = { u = \"nothing\" }", "no column \"nothing\"; there are \"Lage [mm]\""),
        ("columns = { u = \"UMean_0\", k = \"p\" }", "k needs epsilon"),
        ("columns = { u = \"UMean_0\", v = \"UMean_0\" }", "both"),
    ] {
        let error = read(columns).unwrap_err().to_string();
        assert!(error.contains(wanted), "{error}");
    }
}

#[test]
fn an_aerodynamic_diameter_has_the_slip_of_its_run() {
    // 2 µm of 2000 kg/m3: √2 smaller without slip, 1.391 µm with Davies'
    let text = |slip: &str| {
        let sphere = "density = \"2000 kg/m3\"\ndiameter_kind = \"aerodynamic\"\ndiameter = \"2 um\"\n";
        let line = |key: &str| GOOD.lines().find(|l| l.starts_with(key)).unwrap().to_owned() + "\n";
        let text =
            GOOD.replacen(&line("material = \"copper\""), sphere, 1).replacen(&line("diameter = \"90 um\""), "", 1);
        text.replacen("[forces]\n", &format!("[forces]\nslip = \"{slip}\"\n"), 1)
    };
    let diameter = |slip: &str| read(&text(slip)).unwrap().particle(0).unwrap().diameter * 1e6;
    assert!((diameter("none") - 2f64.sqrt()).abs() < 1e-9, "{}", diameter("none"));
    assert!((diameter("davies") - 1.391).abs() < 1e-3, "{}", diameter("davies"));
}
