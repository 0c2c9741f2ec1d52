//! `carom run` as a program: its folder, its summary, going on, and silence in a pipe.

use std::path::Path;
use std::process::{Command, Output};

const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cmd/run.in/bounce.toml");

/// Spheres of many sizes over several blocks, walls that keep, rebound and let go, weights that differ.
const MANY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cmd/run.in/many.toml");

fn carom(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    command.args(arguments.split_whitespace()).current_dir(folder).output().expect("it runs")
}

/// The names of a folder's files, and what is in them.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<_> = entries
        .map(|e| e.expect("an entry"))
        .map(|e| (e.file_name().to_string_lossy().into_owned(), std::fs::read(e.path()).expect("a file")))
        .map(|(name, bytes)| if name == "report.html" { (name, unmade(&bytes).into_bytes()) } else { (name, bytes) })
        .collect();
    files.sort();
    files
}

/// A report without the line that says when and how it was made.
fn unmade(report: &[u8]) -> String {
    let text = String::from_utf8_lossy(report);
    text.lines().filter(|l| !l.starts_with("<p class=\"made\">")).collect::<Vec<_>>().join("\n")
}

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

/// Files that differ, and those that only one folder has.
fn differences(a: &Path, b: &Path) -> Vec<String> {
    let (a, b) = (files(a), files(b));
    let only = |these: &[(String, Vec<u8>)], those: &[(String, Vec<u8>)]| {
        these.iter().filter(|f| !those.contains(f)).map(|f| f.0.clone()).collect::<Vec<_>>()
    };
    [only(&a, &b), only(&b, &a)].concat()
}

#[test]
fn merged_shards_leave_the_folder_of_one_run_report_and_all() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(carom(folder.path(), &format!("run {MANY} --out whole --threads 2")).status.success());
    for i in 1..=3 {
        let out = carom(folder.path(), &format!("run {MANY} --out part{i} --shard {i}/3"));
        assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
        assert!(!folder.path().join(format!("part{i}/report.html")).exists());
    }
    let merged = carom(folder.path(), "merge part3 part1 part2 --out merged --json");
    assert!(merged.status.success(), "{}", String::from_utf8_lossy(&merged.stderr));
    let at = |name: &str| folder.path().join(name);
    assert_eq!(differences(&at("whole"), &at("merged")), Vec::<String>::new());
    assert_eq!(String::from_utf8_lossy(&merged.stdout), text(&at("whole/summary.json")));
    let names: Vec<String> = files(&at("whole")).into_iter().map(|f| f.0).collect();
    assert_eq!(
        names,
        [
            "checkpoint.json",
            "deposit.vtp",
            "deposition.csv",
            "fates.parquet",
            "impacts.csv",
            "report.html",
            "summary.json",
            "trajectories.csv",
            "trajectories.svg",
            "trajectories.vtp"
        ]
    );
    // the parts that are there do not make a whole, nor do parts of something else
    for (arguments, why) in [
        ("part1 part3", "shard 2/3 is missing"),
        ("part1 part2 part2", "shard 2/3 a second time"),
        ("part1 whole", "a whole run"),
        ("nowhere", "no checkpoint.json"),
    ] {
        let refused = carom(folder.path(), &format!("merge {arguments} --out never"));
        assert_eq!(refused.status.code(), Some(2), "{arguments}");
        let said = String::from_utf8_lossy(&refused.stderr);
        assert!(said.contains(why) && said.lines().count() <= 2, "{said}");
        assert!(!at("never").exists());
    }
}

#[test]
fn the_report_shows_what_happened_and_asks_for_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(carom(folder.path(), &format!("run {MANY} --out out")).status.success());
    let path = folder.path().join("out/report.html");
    let html = text(&path);
    for part in [
        "<h1>Spheres of many sizes &lt;between&gt; plates</h1>",
        "<p class=\"made\">carom ",
        " UTC, run in ",
        ": carom run ",
        " --out out</p>",
        "<h2>What ran</h2>",
        "<h2>Fates</h2>",
        "<h2>Paths</h2>",
        "<h2>Deposit</h2>",
        "<h3>floor</h3>",
        "Mass kept by floor along x",
        "<h3>By size</h3>",
        "normal impact speed (m/s)",
        "impact angle (°)",
        "restitution",
        "<h2>Energy</h2>",
        "<td class=\"text\">adhesion</td>",
        "carom's case file, kept whole",
    ] {
        assert!(html.contains(part), "{part}");
    }
    for outside in ["<script", "<link", " src=", "@import", "url("] {
        assert!(!html.contains(outside), "{outside}");
    }
    assert!(!html.contains("NaN"));
    // none when it is not wanted, and no old one is left
    assert!(carom(folder.path(), &format!("run {MANY} --out out --force --no-report")).status.success());
    assert!(!path.exists());
    assert!(carom(folder.path(), &format!("run {MANY} --out out --resume")).status.success());
    assert_eq!(unmade(text(&path).as_bytes()), unmade(html.as_bytes()));
}

#[test]
fn a_report_without_tables_says_what_is_missing() {
    let folder = tempfile::tempdir().expect("a folder");
    let case = text(Path::new(CASE)) + "\n[output]\nimpacts = false\nfates = false\ntrajectories = 0\n";
    std::fs::write(folder.path().join("case.toml"), case).expect("a file");
    let out = carom(folder.path(), "run case.toml --out out");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let html = text(&folder.path().join("out/report.html"));
    assert!(html.contains("the case has impacts = false") && html.contains("the case has fates = false"));
    assert!(!folder.path().join("out/trajectories.svg").exists());
}

#[test]
fn many_paths_are_all_recorded_and_a_hundred_of_them_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let case = text(Path::new(MANY)).replace("[output]\n", "[output]\ntrajectories = 450\nimpacts = false\n");
    std::fs::write(folder.path().join("case.toml"), case).expect("a file");
    assert!(carom(folder.path(), "run case.toml --out out").status.success());
    let at = |name: &str| text(&folder.path().join("out").join(name));
    let paths = at("trajectories.csv");
    let mut recorded: Vec<&str> = paths.lines().skip(1).filter_map(|l| l.split(',').next()).collect();
    recorded.dedup();
    // 3000 of one injection and 2000 of the other
    assert_eq!((recorded.len(), recorded[269], recorded[270], recorded[449]), (450, "269", "3000", "3179"));
    for injection in ["fine", "coarse"] {
        assert!(at("trajectories.svg").contains(&format!("\n{injection}\n")), "{injection}");
    }
    let note = "100 of 450 recorded paths";
    assert!(at("trajectories.svg").contains(note));
    assert!(at("report.html").contains(&format!("{note}, chosen evenly by particle number")));
    assert!(at("trajectories.svg").matches("<polyline").count() < 200);
}

#[test]
fn doubts_about_impacts_are_told_and_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let case = text(Path::new(MANY)).replace("friction = 0.2", "friction = 0.2\nroughness = \"1 nm\"");
    std::fs::write(folder.path().join("case.toml"), case).expect("a file");
    let out = carom(folder.path(), "run case.toml --out out");
    let said = String::from_utf8_lossy(&out.stdout);
    assert!(said.contains("impacts beyond what their law is good for: roughness-extrapolated "), "{said}");
    let html = text(&folder.path().join("out/report.html"));
    assert!(html.contains("roughness-extrapolated</td>") && html.contains("Doubts: "));
}

#[test]
fn a_case_without_gravity_is_told_so_once() {
    let folder = tempfile::tempdir().expect("a folder");
    for (gravity, note) in [("", "note: no gravity: [forces] gives none\n"), ("gravity = [0, 0, 0]\n", "")] {
        let case = text(Path::new(CASE)).replace("gravity = [\"0 m/s2\", \"-9.81 m/s2\", \"0 m/s2\"]\n", gravity);
        std::fs::write(folder.path().join("case.toml"), case).expect("a file");
        let out = carom(folder.path(), "run case.toml");
        assert!(out.status.success());
        assert_eq!(String::from_utf8_lossy(&out.stderr), note);
    }
}

#[test]
fn a_folder_with_a_run_in_it_is_left_alone_unless_told() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(run(folder.path(), "--out out").status.success());
    let before = files(&folder.path().join("out"));
    let refused = run(folder.path(), "--out out");
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(said.contains("holds a finished run") && said.contains("--force") && said.lines().count() == 1, "{said}");
    assert_eq!(files(&folder.path().join("out")), before);
    assert_eq!(run(folder.path(), "--out out --force --resume").status.code(), Some(2));
    assert!(run(folder.path(), "--out out --force").status.success());
    assert_eq!(files(&folder.path().join("out")), before);
    let new = run(folder.path(), "--out fresh --resume");
    assert!(new.status.success());
    assert!(String::from_utf8_lossy(&new.stderr).contains("nothing to go on with yet: starting from the beginning"));
    assert_eq!(files(&folder.path().join("fresh")), before);
}

#[test]
fn more_particles_than_can_be_counted_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let half = 1u64 << 52;
    for (counts, code) in [([half, half + 1], 2), ([u64::MAX / 2 + 1, u64::MAX / 2 + 1], 2), ([3, 4], 0)] {
        let injections = counts.map(|count| {
            format!("[[injection]]\ndensity = 2500\ndiameter = \"50 um\"\nposition = [0, 1, 0]\nvelocity = [0, 0, 0]\ncount = {count}\n")
        });
        let case = format!("{}[run]\nuntil = \"1 ms\"\n", injections.concat());
        std::fs::write(folder.path().join("case.toml"), case).expect("a file");
        let out = carom(folder.path(), "run case.toml");
        assert_eq!(out.status.code(), Some(code), "{counts:?}: {}", String::from_utf8_lossy(&out.stderr));
    }
}

/// A tube from its end, and a block; spheres of two sizes end on them.
const ROUND: &str = r#"
title = "A tube and a block"
[forces]
gravity = [0, 0, 0]
drag = "none"
[[wall]]
name = "tube"
cylinder = { point = [0, 0, 0], axis = [0, 0, 1], radius = "2 mm", fluid = "inside" }
law = "trap"
[[wall]]
name = "block"
block = [["0.5 mm", "-0.5 mm", "-1 mm"], ["1 mm", "0.5 mm", "1 mm"]]
law = "stick"
[law.stick]
sphere = "copper"
surface = "glass"
normal = "ea"
friction = 0.2
[[injection]]
name = "right"
material = "copper"
diameter = "10 um"
count = 200
position = [0, 0, 0]
velocity = ["0.1 m/s", 0, 0]
[[injection]]
name = "left"
material = "copper"
diameter = "10 um"
count = 2
position = [0, 0, 0]
velocity = ["-0.1 m/s", 0, 0]
[run]
until = "0.1 s"
"#;

#[test]
fn the_picture_shows_round_walls_every_injection_and_how_each_path_ended() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("round.toml"), ROUND).expect("a file");
    let out = carom(folder.path(), "run round.toml --out out");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let svg = text(&folder.path().join("out/trajectories.svg"));
    // the circle's chords and what is seen of the block
    assert_eq!(svg.matches("stroke-width=\"30\"").count(), 180 + 8);
    for label in ["right", "left", "captured", "trapped"] {
        assert!(svg.contains(&format!("\n{label}\n")), "{label}");
    }
    let paths = text(&folder.path().join("out/trajectories.csv"));
    let mut particles: Vec<u64> = paths.lines().skip(1).filter_map(|l| l.split(',').next()?.parse().ok()).collect();
    particles.dedup();
    // a disc for each captured sphere and one in the legend
    let captured = particles.iter().filter(|n| **n < 200).count();
    assert!(captured < particles.len(), "{particles:?}");
    assert_eq!(svg.matches("<circle").count(), captured + 1);
    let html = text(&folder.path().join("out/report.html"));
    assert!(html.contains("Paths of the first particles of each injection"));
}
