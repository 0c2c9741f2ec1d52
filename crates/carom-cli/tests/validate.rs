//! `carom validate`: the report's files, other experiments, and what is wrong with them.

use std::path::Path;
use std::process::{Command, Output};

const EXPERIMENTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/experiments");

fn carom(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_carom")).args(arguments).current_dir(folder).output().expect("it runs")
}

#[test]
fn the_report_stands_alone_and_has_every_figure() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = carom(folder.path(), &["validate", "--out", "report"]);
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let html = std::fs::read_to_string(folder.path().join("report/report.html")).expect("a report");
    for figure in [2, 3, 4, 5, 6, 7, 8, 9, 11, 12] {
        assert!(html.contains(&format!("<h2>Figure {figure}")), "figure {figure}");
    }
    for heading in ["Algebraic against resolved", "Identities", "Where it is weak", "Inputs"] {
        assert!(html.contains(&format!("<h2>{heading}")), "{heading}");
    }
    assert!(!html.contains("<script") && !html.contains("src=") && !html.contains("<link"));
    let json = std::fs::read_to_string(folder.path().join("report/report.json")).expect("JSON");
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    for key in ["panels", "comparisons", "claims", "table_2", "tunnel", "identities"] {
        assert!(json[key].as_array().is_some_and(|a| !a.is_empty()), "{key}");
    }
    for comparison in json["comparisons"].as_array().expect("an array") {
        for key in ["experiment", "law", "curve", "tier", "diameter", "greatest", "points"] {
            assert!(!comparison[key].is_null(), "{key}: {comparison}");
        }
    }
}

#[test]
fn a_folder_of_experiments_gives_the_same_as_those_that_come_along() {
    let folder = tempfile::tempdir().expect("a folder");
    let [own, given] = [&["validate", "--json"][..], &["validate", "--json", "--experiments", EXPERIMENTS]]
        .map(|a| carom(folder.path(), a))
        .map(|out| serde_json::from_slice::<serde_json::Value>(&out.stdout).expect("JSON"));
    let sorted = |v: &serde_json::Value, key: &str| {
        let mut all: Vec<String> = v[key].as_array().expect("an array").iter().map(ToString::to_string).collect();
        all.sort();
        all
    };
    for key in ["panels", "comparisons", "claims"] {
        assert_eq!(sorted(&own, key), sorted(&given, key), "{key}");
    }
}

#[test]
fn mistakes_name_file_and_line_and_write_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let fails = |arguments: &[&str], wanted: &str| {
        let out = carom(folder.path(), arguments);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(2), "{said}");
        assert!(said.contains(wanted), "{said}");
        assert!(!folder.path().join("report").exists());
    };
    let run = ["validate", "--out", "report", "--experiments", "lab"];
    fails(&run, "lab: ");
    std::fs::create_dir(folder.path().join("lab")).expect("a folder");
    fails(&run, "no experiment");
    let from = Path::new(EXPERIMENTS).join("dahneke-1975.toml");
    let text = std::fs::read_to_string(from).expect("an experiment");
    let toml = folder.path().join("lab/dahneke-1975.toml");
    std::fs::write(&toml, text.replace("polystyrene", "polystirene")).expect("a file");
    fails(&run, "lab/dahneke-1975.toml:");
    std::fs::write(&toml, text).expect("a file");
    std::fs::write(folder.path().join("lab/dahneke-1975.csv"), "speed,restitution\n2,0.5\n0,0.5\n").expect("a file");
    fails(&run, "dahneke-1975.csv:3:1: ");
    std::fs::write(folder.path().join("taken"), "").expect("a file");
    fails(&["validate", "--out", "taken"], "--out taken: a file is there");
}

#[test]
fn points_find_their_experiment_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let csv = "# made up, to test the reading\nspeed,restitution\n20,0.75\n";
    for name in ["dahneke-1975.csv", "dahneke-1973.csv"] {
        std::fs::write(folder.path().join(name), csv).expect("a file");
    }
    let out = carom(folder.path(), &["validate", "--points", "dahneke-1975.csv"]);
    let text = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(text.lines().any(|l| l.contains("dahneke-1975") && l.contains("measured data")), "{text}");
    let out = carom(folder.path(), &["validate", "--points", "dahneke-1973.csv"]);
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    assert_eq!(out.status.code(), Some(2), "{said}");
    assert!(said.contains("no experiment 'dahneke-1973'; did you mean dahneke-1975?"), "{said}");
}
