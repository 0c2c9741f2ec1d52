//! Runs through a finished CFD result: a block of 3 × 2 × 2 cells, with a floor of six faces.

use super::shards::whole_threads_and_shards;
use super::*;
use crate::deposit_faces;
use crate::record::Event;
use crate::vector::{cross, dot, sub};
use carom::erosion::{Erosion, Hit};

const MESHED: &str = r#"
seed = 5
[flow]
kind = "openfoam"
case = "block"
[forces]
gravity = [0, -9.81, 0]
random_walk = { model = "eddies" }
[[wall]]
patch = "inlet|outlet"
law = "escape"
[[wall]]
patch = "lower"
law = "plate"
erosion = { law = "e-crc", brinell = 160 }
[[wall]]
patch = "upper"
law = "plate"
[law.plate]
surface = "silicon"
normal = "ea"
friction = 0.2
[[injection]]
material = "copper"
diameter = { lognormal = { median = "40 um", gsd = 1.5 } }
count = 1100
position = { box = [["20 mm", "1 mm", "10 mm"], ["250 mm", "15 mm", "90 mm"]] }
velocity = [0.5, -3, 0.4]
[run]
until = "10 ms"
"#;

fn meshed() -> Case {
    let at = Path::new(env!("CARGO_MANIFEST_DIR")).join("../carom-cfd/tests/cases/case.toml");
    Case::from_toml(MESHED, &at, Library::builtin()).unwrap()
}

#[test]
fn threads_shards_and_stops_leave_no_trace() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let case = meshed();
    let whole = whole_threads_and_shards(&case, folder.path(), 2);
    assert_eq!(whole.fates.iter().map(|f| f.count).sum::<u64>(), 1100);
    assert!(whole.walls.iter().map(|w| w.impacts).sum::<u64>() > 1000);
    let stops = StopsAt(500, AtomicU64::new(0));
    run(&case, &options(&at("stopped"), 2), &stops).unwrap_err();
    run(&case, &RunOptions { resume: true, ..options(&at("stopped"), 2) }, &Silent).unwrap();
    assert!(files(&at("whole")) == files(&at("stopped")));
}

/// What each face of the floor lost is the sum over the impacts of the table that lie on it.
#[test]
fn each_face_of_a_patch_loses_what_its_impacts_take() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&meshed(), &options(folder.path(), 2), &Silent).unwrap();
    let mut faces = deposit_faces(folder.path()).unwrap();
    faces.retain(|face| summary.walls[face.wall].name == "lower");
    assert_eq!(faces.len(), 12, "six quadrangles");
    let law = Erosion::new("e-crc", None, &[("brinell", 160.0)]).unwrap();
    let density = Library::builtin().get("copper").unwrap().density.unwrap();
    let (mut eroded, mut impacts) = ([0.0; 12], [0; 12]);
    let mut rows = csv::Reader::from_path(folder.path().join("impacts.csv")).unwrap();
    let header = rows.headers().unwrap().clone();
    let place = |name: &str| header.iter().position(|h| h == name).unwrap();
    let columns = ["x", "y", "z", "diameter", "normal_speed_in", "tangential_speed_in", "weight"].map(place);
    for row in rows.records() {
        let row = row.unwrap();
        if &row[place("wall")] != "lower"
            || ![Event::Rebound.name(), Event::Capture.name()].contains(&&row[place("fate")])
        {
            continue;
        }
        let [x, y, z, diameter, normal, tangential, weight] = columns.map(|c| row[c].parse::<f64>().unwrap());
        let inside = |corners: &[[f64; 3]; 3]| {
            let side = |i: usize| {
                let (a, b) = (corners[i], corners[(i + 1) % 3]);
                cross(sub(b, a), sub([x, y, z], a))
            };
            let sides = [side(0), side(1), side(2)];
            dot(sides[0], sides[1]) > 0.0 && dot(sides[1], sides[2]) > 0.0
        };
        let face = faces.iter().position(|f| inside(&f.corners.map(|c| [c[0], y, c[2]]))).unwrap();
        let mass = density * std::f64::consts::PI / 6.0 * diameter.powi(3) * weight;
        eroded[face] += law.mass(&Hit { mass, diameter, normal, tangential });
        impacts[face] += 1;
    }
    assert!(impacts.iter().filter(|n| **n > 20).count() >= 6, "{impacts:?}");
    for (face, (want, count)) in faces.iter().zip(eroded.into_iter().zip(impacts)) {
        assert_eq!(face.impacts, count);
        assert!((face.eroded - want).abs() <= 1e-12 * want, "{} {want}", face.eroded);
    }
    let lower = summary
        .walls
        .iter()
        .find(|wall| wall.name == "lower")
        .unwrap()
        .eroded
        .as_ref()
        .map(crate::exact_sum::ExactSum::value)
        .unwrap();
    assert!((lower - eroded.iter().sum::<f64>()).abs() <= 1e-12 * lower);
}
