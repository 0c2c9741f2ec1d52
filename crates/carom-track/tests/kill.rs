//! A run that is killed (SIGKILL) again and again and resumed ends with the bits of one that was not.

use carom::material::Library;
use carom_track::{Case, RunOptions, Silent, run};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

const CHILD: &str = "CAROM_TRACK_CHILD";
const WHICH: &str = "CAROM_TRACK_CASE";

const CASE: &str = r#"
seed = 9
[flow]
kind = "uniform"
velocity = ["1 m/s", "0 m/s", "0 m/s"]
[forces]
gravity = ["0 m/s2", "-9.81 m/s2", "0 m/s2"]
[[wall]]
name = "room"
box = [["0 m", "0 m", "0 m"], ["50 mm", "20 mm", "20 mm"]]
law = "plate"
[law.plate]
surface = "silicon"
normal = "ea"
friction = 0.2
[[injection]]
name = "cloud"
material = "stainless-steel"
diameter = { lognormal = { median = "40 um", gsd = 1.4 } }
count = 12000
position = { box = [["5 mm", "5 mm", "5 mm"], ["45 mm", "15 mm", "15 mm"]] }
velocity = ["1 m/s", "-1 m/s", "0.5 m/s"]
[run]
until = "50 ms"
"#;

/// Through the cells of a finished CFD result, with chance.
const MESHED: &str = r#"
seed = 9
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
[[wall]]
patch = "upper"
law = "plate"
[law.plate]
surface = "silicon"
normal = "ea"
friction = 0.2
[[injection]]
material = "copper"
diameter = { lognormal = { median = "40 um", gsd = 1.4 } }
count = 12000
position = { box = [["20 mm", "1 mm", "10 mm"], ["250 mm", "15 mm", "90 mm"]] }
velocity = [0.5, -3, 0.4]
[run]
until = "4 ms"
"#;

const KILLED: [(&str, &str); 2] = [("room", CASE), ("meshed", MESHED)];

fn case(name: &str) -> Case {
    let at = Path::new(env!("CARGO_MANIFEST_DIR")).join("../carom-cfd/tests/cases/kill.toml");
    let text = KILLED.iter().find(|(n, _)| *n == name).expect("a name").1;
    Case::from_toml(text, &at, Library::builtin()).expect("a good case")
}

fn options(out: PathBuf, resume: bool) -> RunOptions {
    RunOptions { threads: 2, out: Some(out), resume, checkpoint_every: Duration::ZERO, ..RunOptions::default() }
}

/// The first particle not yet on disk, from the checkpoint of a run under way; 0 where there is none.
fn next_particle(folder: &Path) -> u64 {
    let text = std::fs::read_to_string(folder.join("checkpoint.json")).unwrap_or_default();
    serde_json::from_str::<serde_json::Value>(&text).ok().and_then(|v| v["next"].as_u64()).unwrap_or(0)
}

/// Not a test of its own: what the killed process runs.
#[test]
fn child() {
    if let Some(folder) = std::env::var_os(CHILD) {
        let which = std::env::var(WHICH).expect("a case");
        run(&case(&which), &options(folder.into(), true), &Silent).expect("the run");
    }
}

#[test]
fn killed_and_resumed_is_as_never_killed() {
    killed_and_resumed("room");
}

#[test]
fn killed_and_resumed_in_a_mesh_is_as_never_killed() {
    killed_and_resumed("meshed");
}

fn killed_and_resumed(which: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let (whole, killed) = (folder.path().join("whole"), folder.path().join("killed"));
    run(&case(which), &options(whole.clone(), false), &Silent).expect("the run");
    let this = std::env::current_exe().expect("the test's own path");
    let start = || {
        Command::new(&this)
            .args(["child", "--exact"])
            .env(CHILD, &killed)
            .env(WHICH, which)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("a child")
    };
    let mut kills = 0;
    for wanted in [1000, 3000, 4000, 7000, 9000] {
        let mut child = start();
        // as soon as that many particles are on disk, at whatever point the process then is
        while next_particle(&killed) < wanted && child.try_wait().expect("a state").is_none() {
            std::thread::yield_now();
        }
        kills += u32::from(child.try_wait().expect("a state").is_none());
        child.kill().expect("a kill");
        child.wait().expect("an end");
    }
    assert!(kills >= 3, "only {kills} kills came in time");
    assert!(start().wait().expect("an end").success());
    for name in ["summary.json", "impacts.csv", "trajectories.csv", "deposition.csv", "deposit.vtp"] {
        let read = |folder: &Path| std::fs::read(folder.join(name)).expect(name);
        assert!(read(&whole) == read(&killed), "{name} differs");
    }
}
