//! `carom run` as a program: its folder, its summary, going on, and silence in a pipe.

use std::path::Path;
use std::process::{Command, Output};

const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cmd/run.in/bounce.toml");

fn run(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    command.arg("run").arg(CASE).args(arguments.split_whitespace()).current_dir(folder).output().expect("it runs")
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn the_folder_holds_the_contracts_files_and_fates_add_up() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = run(folder.path(), "--out out --json");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    // no progress bar in a pipe
    assert_eq!(String::from_utf8_lossy(&out.stderr), "wrote out\n");
    let at = |name: &str| folder.path().join("out").join(name);
    let summary: serde_json::Value = serde_json::from_str(&text(&at("summary.json"))).expect("JSON");
    assert_eq!(summary, serde_json::from_slice::<serde_json::Value>(&out.stdout).expect("JSON"));
    let fates = summary["fates"].as_object().expect("fates").values().filter_map(serde_json::Value::as_u64);
    assert_eq!(Some(fates.sum()), summary["injected"].as_u64());
    assert_eq!(summary["injected"], 3);
    let impacts = text(&at("impacts.csv"));
    assert!(impacts.starts_with(
        "particle,time,x,y,z,wall,diameter,normal_speed_in,tangential_speed_in,spin_in,restitution,impulse_ratio,fate,\
         normal_speed_out,tangential_speed_out,spin_out"
    ));
    assert_eq!(summary["walls"]["plate"]["impacts"].as_u64(), Some(impacts.lines().count() as u64 - 1));
    let svg = text(&at("trajectories.svg"));
    assert!(svg.contains("Glass balls fall on steel") && svg.contains("y (mm)") && svg.contains("ball"));
}

#[test]
fn threads_and_resuming_change_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(run(folder.path(), "--out one --threads 1").status.success());
    assert!(run(folder.path(), "--out two --threads 3").status.success());
    assert!(run(folder.path(), "--out two --resume").status.success());
    for name in ["summary.json", "impacts.csv", "trajectories.csv", "trajectories.svg"] {
        let [one, two] = ["one", "two"].map(|f| text(&folder.path().join(f).join(name)));
        assert!(one == two, "{name} differs");
    }
}
