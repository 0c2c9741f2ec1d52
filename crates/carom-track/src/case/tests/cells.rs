//! Cases through a stored result of OpenFOAM: a block of 3 × 2 × 2 cells with every kind of patch.

use super::*;
use crate::record::ParticleFate;
use crate::run::{RunOptions, Silent, run};
use std::path::PathBuf;

const CASE: &str = r#"
[flow]
kind = "openfoam"
case = "block"
[forces]
gravity = [0, 0, -9.81]
[[wall]]
patch = "inlet|outlet"
law = "escape"
[[wall]]
patch = "lower"
law = "trap"
[[injection]]
name = "dust"
density = "2000 kg/m3"
diameter = "20 um"
count = 200
position = { patch = "inlet" }
distribution = "flux"
[run]
until = "20 s"
"#;

fn at() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../carom-cfd/tests/cases/case.toml")
}

fn read(text: &str) -> Result<Case, CaseError> {
    Case::from_toml(text, &at(), Library::builtin())
}

fn refused(from: &str, to: &str, words: &[&str]) {
    assert!(CASE.contains(from), "{from}");
    let error = read(&CASE.replacen(from, to, 1)).unwrap_err();
    let said = error.to_string() + &error.remedy().unwrap_or_default();
    for word in words {
        assert!(said.contains(word), "{word}: {said}");
    }
}

#[test]
fn spheres_go_through_it_and_have_a_fate() {
    let case = read(CASE).unwrap();
    let names: Vec<&str> = case.domain.walls().iter().map(|w| w.name.as_str()).collect();
    assert_eq!(names, ["inlet", "outlet", "lower"]);
    let summary = run(&case, &RunOptions::default(), &Silent).unwrap();
    assert_eq!(summary.injected.count, 200);
    let count = |fate| summary.count(fate);
    assert_eq!(count(ParticleFate::Trapped) + count(ParticleFate::Escaped), 200, "{summary:?}");
    // the wind blows off the lower wall: what starts within a radius of it alone is kept
    assert!(count(ParticleFate::Escaped) > 150, "{summary:?}");
}

#[test]
fn what_the_mesh_does_not_have_is_refused_with_what_it_has() {
    refused("patch = \"lower\"", "patch = \"floor\"", &["no patch \"floor\"", "lower (wall)", "upper (symmetry)"]);
    refused("[[wall]]\npatch = \"lower\"\nlaw = \"trap\"\n", "", &["no [[wall]] says what happens at 'lower'"]);
    refused("patch = \"lower\"", "patch = \"left\"", &["is a side of the space (cyclic)"]);
    refused("patch = \"lower\"", "patch = \"lower|inlet\"", &["patch 'inlet' has two walls"]);
    refused("patch = \"lower\"", "patch = \"(\"", &["no regular expression"]);
    refused("position = { patch = \"inlet\" }", "position = { patch = \"inlett\" }", &["no patch \"inlett\"", "inlet"]);
    refused(
        "position = { patch = \"inlet\" }\ndistribution = \"flux\"",
        "position = [9, 9, 9]\nvelocity = \"fluid\"",
        &["outside the mesh"],
    );
    refused("case = \"block\"", "case = \"nothing\"", &["nothing"]);
    refused("case = \"block\"", "case = \"block\"\ntime = 7", &["7", "1", "2"]);
    refused("case = \"block\"", "case = \"block\"\nfields = { k = \"kk\" }", &["kk"]);
    refused(
        "case = \"block\"",
        "case = \"block\"\nradius = \"1 m\"",
        &["an openfoam flow has no radius", "case, time, fields"],
    );
    refused("kind = \"openfoam\"\ncase = \"block\"", "kind = \"still\"", &["patch"]);
}

#[test]
fn fields_that_are_not_meant_are_left_out() {
    refused(
        "case = \"block\"",
        "case = \"block\"\nfields = { velocity = \"none\" }",
        &["no velocity", "fields = { velocity = \"NAME\" }", "C, U, V"],
    );
    let folder = tempfile::tempdir().unwrap();
    let block = at().with_file_name("block");
    for part in ["constant/polyMesh", "2"] {
        std::fs::create_dir_all(folder.path().join("block").join(part)).unwrap();
        for file in std::fs::read_dir(block.join(part)).unwrap().map(Result::unwrap) {
            std::fs::copy(file.path(), folder.path().join("block").join(part).join(file.file_name())).unwrap();
        }
    }
    let case = |text: &str| Case::from_toml(text, &folder.path().join("case.toml"), Library::builtin());
    let with = |name: &str, dimensions: &str, value: f64| {
        let head = "FoamFile { format ascii; class volScalarField; } dimensions";
        let patches = "boundaryField { \".*\" { type calculated; value $internalField; } }";
        let text = format!("{head} {dimensions}; internalField uniform {value}; {patches}");
        std::fs::write(folder.path().join("block/2").join(name), text).unwrap();
    };
    let fails = |text: &str, words: &[&str]| {
        let error = case(text).unwrap_err();
        let said = error.to_string() + &error.remedy().unwrap_or_default();
        assert!(words.iter().all(|word| said.contains(word)), "{words:?}: {said}");
    };
    // a scalar between 0 and 1 with the dimensions of a temperature
    with("T", "[0 0 0 1 0 0 0]", 0.5);
    fails(CASE, &["temperatures are from 0.50 K", "fields = { temperature = \"none\" }"]);
    let left_out = CASE.replacen("case = \"block\"", "case = \"block\"\nfields = { temperature = \"none\" }", 1);
    case(&left_out).unwrap();
    let liquid = "[fluid]\nliquid = true\ndensity = 998\nviscosity = 1e-3\n";
    fails(&format!("{liquid}{CASE}"), &["[fluid] is a liquid", "fields = { temperature = \"none\" }"]);
    case(&format!("{liquid}{left_out}")).unwrap();
    with("rho", "[1 -3 0 0 0 0 0]", 0.0);
    with("T", "[0 0 0 1 0 0 0]", 300.0);
    fails(CASE, &["density goes down to 0", "fields = { density = \"none\" }"]);
    // with other dimensions it is another quantity, and a note says so
    with("rho", "[0 0 0 0 0 0 0]", 0.0);
    let read = case(CASE).unwrap();
    assert!(
        read.notes.iter().any(|n| n.contains("rho has the dimensions") && n.contains("left out")),
        "{:?}",
        read.notes
    );
}

#[test]
fn names_and_mirrors() {
    let named = CASE.replacen("patch = \"lower\"", "name = \"floor\"\npatch = \"lower\"", 1);
    assert_eq!(read(&named).unwrap().domain.walls()[2].name, "floor");
    let mirror = CASE.replacen("patch = \"lower\"\nlaw = \"trap\"", "patch = \"lower\"\nlaw = \"symmetry\"", 1);
    let error = read(&mirror.replacen("[0, 0, -9.81]", "[0, -9.81, 0]", 1)).unwrap_err().to_string();
    assert!(error.contains("gravity points across"), "{error}");
    let case = read(&mirror).unwrap();
    assert_eq!(case.domain.walls().len(), 2);
    let summary = run(&case, &RunOptions::default(), &Silent).unwrap();
    assert_eq!(summary.count(ParticleFate::Trapped), 0);
}

/// In a wedge of a pipe along x.
const WEDGE: &str = r#"
[fluid]
temperature = "300 K"
temperature_gradient = [100, 0, 0]
[flow]
kind = "openfoam"
case = "wedge"
[forces]
gravity = [9.81, 0, 0]
thermophoresis = { thermal_conductivity = "0.2 W/m/K" }
[[wall]]
patch = "inlet|outlet|pipe"
law = "escape"
[[injection]]
density = "2000 kg/m3"
diameter = "20 um"
count = 3
position = [0.1, 0, 0.5]
velocity = "fluid"
[run]
until = "1 s"
"#;

#[test]
fn in_a_wedge_what_acts_is_along_its_axis() {
    read(WEDGE).unwrap();
    for (from, to, says) in [
        (
            "gravity = [9.81, 0, 0]",
            "gravity = [0, 0, -9.81]",
            "gravity is not along the axis that 'front' goes on round",
        ),
        ("gradient = [100, 0, 0]", "gradient = [100, 5, 0]", "temperature_gradient is not along the axis"),
    ] {
        assert!(WEDGE.contains(from));
        let error = read(&WEDGE.replacen(from, to, 1)).unwrap_err();
        assert!(error.to_string().contains(says), "{error}");
        assert!(error.remedy().unwrap().contains("the whole body"));
    }
}

#[test]
fn cells_much_wider_than_the_spheres_at_a_wall_are_told() {
    let told = |text: &str| {
        let notes = read(text).unwrap().notes;
        notes.into_iter().find(|note| note.starts_with("cells at wall"))
    };
    // two cells in 0.11 to 0.13 m above the lower wall
    let note = told(CASE).unwrap();
    assert!(note.starts_with("cells at wall 'lower' are 58.9 mm high, 5888 radii of a sphere of 20 um: "), "{note}");
    // by the centre no last radius counts
    let centre = CASE.replace("law = \"trap\"", "law = \"trap\"\ncontact_at = \"center\"");
    assert_eq!(told(&centre), None);
    // cells of less than four radii; spheres so heavy that they fly through the block
    let large = CASE.replace("20 um", "40 mm").replace("count = 200", "count = 1").replace("2000 kg/m3", "1.2 kg/m3");
    assert_eq!(told(&large), None);
    assert_eq!(told(&CASE.replace("2000 kg/m3", "200000000 kg/m3")), None);
}

/// Boxes as a legacy file of VTK, each with points of its own unless `joined`; the flow is even.
fn boxes(boxes: &[[[f64; 3]; 2]], joined: bool) -> String {
    let (mut points, mut cells): (Vec<[f64; 3]>, String) = (Vec::new(), String::new());
    for [low, high] in boxes {
        cells += "8";
        for (i, j, k) in [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)] {
            let x = [[low, high][i][0], [low, high][j][1], [low, high][k][2]];
            let known = points.iter().position(|p| *p == x).filter(|_| joined);
            cells += &format!(" {}", known.unwrap_or(points.len()));
            points.extend(known.is_none().then_some(x));
        }
        cells += "\n";
    }
    let list = |x: &[[f64; 3]]| x.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect::<String>();
    let (n, m) = (points.len(), boxes.len());
    let types = "12\n".repeat(m);
    format!(
        "# vtk DataFile Version 3.0\nboxes\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {n} double\n{}CELLS {m} {}\n{cells}CELL_TYPES {m}\n{types}POINT_DATA {n}\nVECTORS U double\n{}",
        list(&points),
        9 * m,
        list(&vec![[1.0, 0.0, 0.0]; n]),
    )
}

#[test]
fn cells_that_do_not_hang_together_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let told = |mesh: &str| {
        std::fs::write(folder.path().join("mesh.vtk"), mesh).unwrap();
        let case = "[flow]\nkind = \"vtk\"\nfile = \"mesh.vtk\"\n[[wall]]\npatch = \"boundary\"\nlaw = \"trap\"\n\
            [[injection]]\ndensity = 1000\ndiameter = 1e-5\nposition = [0.5, 0.3, 0.5]\nvelocity = \"fluid\"\n[run]\nuntil = 1\n";
        let case = Case::from_toml(case, &folder.path().join("case.toml"), Library::builtin()).unwrap();
        case.notes.into_iter().find(|note| note.contains("right behind"))
    };
    let beside = |gap: f64| [[[0.0; 3], [1.0; 3]], [[1.0 + gap, 0.0, 0.0], [2.0, 1.0, 1.0]]];
    assert_eq!(told(&boxes(&beside(0.0), true)), None);
    // each with points of its own, and with a gap of rounding
    for gap in [0.0, 1e-7] {
        let note = told(&boxes(&beside(gap), false)).unwrap();
        assert!(note.starts_with("mesh.vtk: 2 faces of the boundary have other cells right behind them"), "{note}");
    }
    // hanging nodes: one face before two
    let hanging = [[[0.0; 3], [1.0; 3]], [[1.0, 0.0, 0.0], [2.0, 0.5, 1.0]], [[1.0, 0.5, 0.0], [2.0, 1.0, 1.0]]];
    assert!(told(&boxes(&hanging, true)).unwrap().starts_with("mesh.vtk: 3 faces"));
    // one in the other
    let within = [[[0.0; 3], [1.0; 3]], [[0.4; 3], [0.6; 3]]];
    assert!(told(&boxes(&within, false)).unwrap().starts_with("mesh.vtk: 6 faces"));
}
