//! `carom fit`: its files, its JSON, and surveys of law files and experiments.

use std::path::Path;
use std::process::{Command, Output};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn carom(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    command.args(arguments.split_whitespace()).current_dir(folder).output().expect("it runs")
}

fn succeeds(folder: &Path, arguments: &str) -> String {
    let out = carom(folder, arguments);
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    String::from_utf8_lossy(&out.stdout).into_owned()
}

fn text(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect("text")
}

fn with(files: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for file in files {
        let name = Path::new(file).file_name().expect("a name");
        std::fs::copy(Path::new(ROOT).join(file), folder.path().join(name)).expect("a file");
    }
    folder
}

const SILICON: &str = "fit silicon.csv --wall-law walls.toml:silicon --free adhesion_damping,roughness_factor";

#[test]
fn the_law_written_is_the_law_found() {
    let folder = with(&["examples/fit/silicon.csv", "examples/fit/walls.toml"]);
    let out = succeeds(
        folder.path(),
        &format!("{SILICON} --bootstrap 20 --out law.toml --plot fit.svg --residuals r.png --json"),
    );
    let json: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    let fit = &json["fit"];
    let [damping, roughness] = [0, 1].map(|n| &fit["parameters"][n]);
    assert_eq!((damping["parameter"].as_str(), roughness["unit"].as_str()), (Some("adhesion_damping"), Some("")));
    for parameter in [damping, roughness] {
        for key in ["value", "standard_error", "interval", "bootstrap", "bounds", "at_bound"] {
            assert!(!parameter[key].is_null(), "{key}: {parameter}");
        }
    }
    // C_A has no upper bound, and JSON no infinity
    assert!(damping["bounds"][1].is_null() && roughness["bounds"][1] == 1.0);
    assert_eq!(fit["residuals"].as_array().map(Vec::len), Some(24));
    assert_eq!(fit["correlation"][0][0], 1.0);
    assert!(fit["goodness"]["reduced_chi_square"].is_f64() && fit["warnings"].is_array());

    let law = text(folder.path(), "law.toml");
    assert!(law.contains("# It says of itself: Not measured") && law.contains("[law.silicon]"), "{law}");
    let json = succeeds(folder.path(), "impact --wall-law law.toml:silicon --diameter 70um --speed 1m/s --json");
    let impact: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let model = fit["residuals"].as_array().expect("an array").iter().find(|r| r["normal_speed"] == 0.908);
    let [fitted, again] =
        [&model.expect("a point")["model"], &impact["restitution"]].map(|v| v.as_f64().expect("a number"));
    assert!((fitted - again).abs() < 0.002, "{fitted} {again}");

    let plot = text(folder.path(), "fit.svg");
    for label in ["restitution", "fitted", "measured", "95 % of resampled fits", "stainless-steel on silicon, ea"] {
        assert!(plot.contains(label), "{label}");
    }
    assert!(std::fs::read(folder.path().join("r.png")).expect("bytes").starts_with(b"\x89PNG"));
}

#[test]
fn friction_is_found_from_oblique_points() {
    let folder = with(&["examples/fit/kharaz-2001.csv", "data/experiments/kharaz-2001.toml"]);
    let out = succeeds(
        folder.path(),
        "fit kharaz-2001.csv --diameter 5mm --wall-law kharaz-2001.toml:micro-slip --free friction --bootstrap 0 --plot t.svg \
         --out law.toml --json",
    );
    let json: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    let interval = &json["fit"]["parameters"][0]["interval"];
    let [low, high] = [0, 1].map(|n| interval[n].as_f64().expect("a number"));
    // measured by its authors: 0.092
    assert!(low < 0.092 && 0.092 < high && high - low < 0.02, "{low} {high}");
    assert!(text(folder.path(), "t.svg").contains("tangential restitution"));
    assert!(text(folder.path(), "law.toml").contains("friction = 0."));
}

#[test]
fn a_survey_has_a_row_for_each_surface_in_the_order_of_stiffness() {
    let folder = with(&["examples/fit/silicon.csv", "examples/fit/tedlar.csv", "examples/fit/walls.toml"]);
    let out = succeeds(folder.path(), "fit --survey walls.toml --out t.csv --plot t.svg");
    let table = text(folder.path(), "t.csv");
    let names: Vec<&str> = table.lines().skip(1).filter_map(|l| l.split(',').next()).collect();
    assert_eq!(names, ["tedlar", "silicon"]); // aluminium has no points here
    let head = "name,surface,young_modulus (Pa),points,adhesion_damping (s/m),adhesion_damping_error (s/m),";
    assert!(table.starts_with(head), "{table}");
    assert!(text(folder.path(), "t.svg").contains("C_H, Hertzian damping"));
    assert!(out.contains("In brackets: 95 % intervals"), "{out}");
    let json = succeeds(folder.path(), "fit --survey walls.toml --free hertz_damping --json");
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!((json[0]["surface"].as_str(), json[0]["young_modulus"].as_f64()), (Some("tedlar"), Some(2.1e9)));
}

#[test]
fn an_experiment_with_its_points_is_surveyed() {
    let folder = with(&["data/experiments/wall-1990.toml", "data/experiments/dahneke-1975.toml"]);
    let out = carom(folder.path(), "fit --survey .");
    assert_eq!(out.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&out.stderr).contains("no data; put NAME.csv beside"));
    let mut csv = "# made up, to test the reading\nspeed,restitution,diameter,panel\n".to_owned();
    for (speed, e) in [(5.0, 0.3), (7.0, 0.55), (10.0, 0.7), (15.0, 0.78), (25.0, 0.8), (40.0, 0.78), (80.0, 0.6)] {
        csv += &format!("{speed},{e},3.44e-6,mica\n");
    }
    std::fs::write(folder.path().join("wall-1990.csv"), csv).expect("a file");
    for what in [".", "wall-1990.toml"] {
        let out = succeeds(folder.path(), &format!("fit --survey {what}"));
        assert!(out.contains("wall-1990 mica  mica"), "{out}");
    }
}
