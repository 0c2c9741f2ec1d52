//! Runs whose walls are files of triangles.

use super::*;
use crate::record::{End, ImpactRecord, ParticleFate, Sink};
use crate::tracker::Particle;

/// What happened to each particle.
#[derive(Default)]
struct Log {
    impacts: Vec<ImpactRecord>,
    ends: Vec<End>,
}

impl Sink for Log {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, impact: &ImpactRecord) {
        self.impacts.push(*impact);
    }
    fn point(&mut self, _: u64, _: f64, _: [f64; 3], _: [f64; 3], _: [f64; 3]) {}
    fn end(&mut self, end: &End) {
        self.ends.push(*end);
    }
}

/// A wall of that shape and what happens at it, in a void without weight.
fn case(wall: &str, injections: &str, until: &str) -> String {
    format!(
        "[flow]\nkind = \"still\"\n[forces]\ndrag = \"none\"\ngravity = [0, 0, 0]\n[[wall]]\nname = \"w\"\n{wall}\n\
         {injections}\n[run]\nuntil = \"{until}\"\n"
    )
}

fn injection(diameter: &str, position: [f64; 3], velocity: [f64; 3]) -> String {
    format!(
        "[[injection]]\ndensity = 1000\ndiameter = \"{diameter}\"\nposition = {position:?}\nvelocity = {velocity:?}\n"
    )
}

/// Reads a case beside a file `w.stl`.
fn with_file(text: &str, stl: &[u8]) -> Result<Case, CaseError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("w.stl"), stl).unwrap();
    Case::from_toml(text, &folder.path().join("case.toml"), Library::builtin())
}

fn run(case: &Case) -> Log {
    let mut log = Log::default();
    case.tracker().run(&mut (0..case.count()).filter_map(|n| case.particle(n)), &mut log).unwrap();
    log.ends.sort_by_key(|e| e.particle.number);
    log
}

fn count(log: &Log, fate: ParticleFate) -> usize {
    log.ends.iter().filter(|e| e.fate == fate).count()
}

/// A square of the floor, 1 mm to either side in z, from x to x + 1 mm, as text in mm.
fn square(name: &str, x: f64) -> String {
    let y = x + 1.0;
    let facet = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        let vertex = |[x, z]: [f64; 2]| format!("   vertex {x} 0 {z}\n");
        format!(" facet normal 0 1 0\n  outer loop\n{}{}{}  endloop\n endfacet\n", vertex(a), vertex(b), vertex(c))
    };
    let facets = facet([x, -1.0], [x, 1.0], [y, 1.0]) + &facet([x, -1.0], [y, 1.0], [y, -1.0]);
    format!("solid {name}\n{facets}endsolid {name}\n")
}

const TRAP: &str = "stl = { file = \"w.stl\", unit = \"1 mm\" }\nlaw = \"trap\"";

fn two_above() -> String {
    let above = |x: f64| injection("10 um", [x, 1e-3, 1e-4], [0.0, -1.0, 0.0]);
    above(-0.5e-3) + &above(0.5e-3)
}

#[test]
fn every_solid_of_a_file_is_a_wall_or_one_by_name() {
    let stl = square("left", -1.0) + &square("right", 0.0);
    let all = with_file(&case(TRAP, &two_above(), "10 ms"), stl.as_bytes()).unwrap();
    assert_eq!(all.notes[0], "wall 'w': 4 triangles of w.stl, 2 solids in the file, 2 mm x 0 m x 2 mm");
    let log = run(&all);
    assert_eq!(count(&log, ParticleFate::Trapped), 2);
    // faces are numbered as in the file
    let mut faces: Vec<_> = log.impacts.iter().map(|i| (i.particle, i.face.unwrap())).collect();
    faces.sort_unstable();
    assert!(faces[0].1 < 2 && (2..4).contains(&faces[1].1), "{faces:?}");
    let of = |solid: &str| TRAP.replace("file =", &format!("solid = \"{solid}\", file ="));
    let right = with_file(&case(&of("right"), &two_above(), "10 ms"), stl.as_bytes()).unwrap();
    assert_eq!(count(&run(&right), ParticleFate::Trapped), 1);
    let error = with_file(&case(&of("rigth"), &two_above(), "10 ms"), stl.as_bytes()).unwrap_err();
    assert!(error.to_string().contains("no triangles in a solid 'rigth'"), "{error}");
}

#[test]
fn what_is_missing_in_a_file_is_refused_or_told() {
    let text = case(TRAP, &two_above(), "10 ms");
    let nan = square("", -1.0).replacen("vertex -1", "vertex nan", 1);
    let error = with_file(&text, nan.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("w.stl: line 4: a corner that is not finite"), "{error}");
    let mut short = vec![0; 80];
    short.extend(2u32.to_le_bytes());
    short.extend([0; 200]);
    let error = with_file(&text, &short).unwrap_err().to_string();
    assert!(error.contains("its header counts 2 triangles, 184 bytes, but it has 284 bytes"), "{error}");
    let needle = " facet normal 0 1 0\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 2 0 0\n  endloop\n endfacet\nendsolid";
    let told = with_file(&text, square("", -1.0).replace("endsolid", needle).as_bytes()).unwrap();
    assert!(told.notes[0].ends_with("; left out: 1 triangle without area"), "{:?}", told.notes);
    assert_eq!(count(&run(&told), ParticleFate::Trapped), 1);
}

#[test]
fn points_aimed_at_a_diagonal_are_all_trapped() {
    // a flat quadrilateral in single precision, its diagonal from the first corner to the third
    let corners: [[f32; 3]; 4] = [[0.0; 3], [3.0, 0.7, 1.0], [2.5, 0.9, 3.1], [-0.5, 0.2, 2.1]];
    let mut stl = vec![0; 80];
    stl.extend(2u32.to_le_bytes());
    for t in [[0, 1, 2], [0, 2, 3]] {
        stl.extend([0; 12]);
        t.iter().flat_map(|i| corners[*i]).for_each(|c| stl.extend(c.to_le_bytes()));
        stl.extend([0; 2]);
    }
    let injections: String = (1..100)
        .map(|i| {
            let s = f64::from(i) * 1e-5;
            let aim = corners[2].map(|c| s * f64::from(c));
            let v = [0.3 * (f64::from(i) * 1.7).sin(), -2.0, 0.3 * (f64::from(i) * 2.9).sin()];
            injection("10 um", [0, 1, 2].map(|c| aim[c] - 1e-3 * v[c]), v)
        })
        .collect();
    let wall = format!("{TRAP}\ncontact_at = \"center\"");
    let log = run(&with_file(&case(&wall, &injections, "10 ms"), &stl).unwrap());
    assert_eq!(count(&log, ParticleFate::Trapped), 99);
}

#[test]
fn a_sphere_glides_over_the_seams_of_flat_walls() {
    let reflect = "law = \"reflect\"\nrestitution = 1\ntangential_restitution = 1";
    let strips: String = (0..10).map(|i| square("", f64::from(i))).collect();
    let one = strips.replace("endsolid \nsolid \n", "");
    for (shape, start, until, end) in [
        ("stl = { file = \"w.stl\", unit = \"1 mm\" }", 1.1e-3, "5 ms", 6.1e-3),
        ("block = [[\"0 mm\", \"-1 mm\", \"-5 mm\"], [\"20 mm\", \"0 mm\", \"5 mm\"]]", 1e-3, "15 ms", 16e-3),
    ] {
        for z in [-0.2e-3, 0.0, 0.1e-3] {
            let sphere = injection("100 um", [start, 50e-6, z], [1.0, 0.0, 0.0]);
            let log = run(&with_file(&case(&format!("{shape}\n{reflect}"), &sphere, until), one.as_bytes()).unwrap());
            let [x, y, _] = log.ends[0].position;
            assert!((x - end).abs() < 1e-12 && (y - 50e-6).abs() < 1e-15, "{shape} {z}: {:?}", log.ends[0]);
            assert!(log.impacts.iter().all(|i| i.normal_speed_in < 1e-12), "{:?}", log.impacts);
        }
    }
}
