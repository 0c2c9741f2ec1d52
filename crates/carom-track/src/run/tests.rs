use super::*;
use crate::tables::LAYOUTS;
use carom::material::Library;
use std::fs;
use std::sync::atomic::{AtomicU64, Ordering};

/// 5 000 spheres of all sizes between a floor they stick or bounce on and a ceiling, and an outlet.
pub(super) const CASE: &str = r#"
seed = 3
[flow]
kind = "uniform"
velocity = ["1 m/s", "0 m/s", "0 m/s"]
[forces]
gravity = ["0 m/s2", "-9.81 m/s2", "0 m/s2"]
[[wall]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 1, 0] }
law = "plate"
erosion = { law = "oka", material = "sand-on-steel" }
[[wall]]
name = "ceiling"
plane = { point = [0, 0.02, 0], normal = [0, -1, 0] }
law = "trap"
[[wall]]
name = "outlet"
plane = { point = [0.2, 0, 0], normal = [-1, 0, 0] }
law = "escape"
[law.plate]
surface = "silicon"
normal = "ea"
friction = 0.2
[[injection]]
name = "fine"
material = "copper"
diameter = { lognormal = { median = "40 um", gsd = 1.5 } }
count = 3000
position = { box = [["0 m", "5 mm", "0 m"], ["0 m", "15 mm", "10 mm"]] }
velocity = ["1 m/s", "-1 m/s", "0 m/s"]
[[injection]]
name = "coarse"
material = "stainless-steel"
diameter = { table = { diameter = ["50 um", "100 um"], amount = [1, 2] } }
mass = "1 mg"
parcels = 2000
position = ["0 m", "10 mm", "0 m"]
velocity = ["1 m/s", "1 m/s", "0 m/s"]
[run]
until = "0.1 s"
[output]
size_bins = ["30 um", "60 um"]
[[output.region]]
name = "first half"
box = [["0 m", "-1 m", "-1 m"], ["100 mm", "1 m", "1 m"]]
"#;

fn case() -> Case {
    Case::from_toml(CASE, Path::new("case.toml"), Library::builtin()).unwrap()
}

fn files(folder: &Path) -> Vec<Vec<u8>> {
    let mut names: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    names
        .into_iter()
        .map(|name| [name.to_str().unwrap().into(), fs::read(folder.join(&name)).unwrap()].concat())
        .collect()
}

fn options(out: &Path, threads: usize) -> RunOptions {
    RunOptions { threads, out: Some(out.to_owned()), ..RunOptions::default() }
}

#[test]
fn nothing_is_lost_and_nothing_invented() {
    let folder = tempfile::tempdir().unwrap();
    let case = case();
    let s = run(&case, &options(folder.path(), 2), &Silent).unwrap();
    assert_eq!(s.injected.count, 5000);
    assert_eq!(s.fates.iter().map(|f| f.count).sum::<u64>(), 5000);
    assert_eq!(s.lost(), 0);
    assert_eq!(s.stalled, 0);
    let mut sum = crate::exact_sum::ExactSum::default();
    s.fates.iter().for_each(|f| sum.merge(&f.mass));
    assert_eq!(sum, s.injected.mass);
    let coarse = case.injections[1].injection.total_mass().unwrap();
    assert!((coarse - 1e-6).abs() < 1e-20);
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("summary.json")).unwrap()).unwrap();
    assert_eq!(json["injected"], 5000);
    assert_eq!(json["fates"]["lost"], 0);
    let named: u64 = ["captured", "settled", "trapped", "escaped", "airborne"]
        .iter()
        .map(|f| json["fates"][f].as_u64().unwrap())
        .sum();
    assert_eq!(named, 5000);
    let kept: u64 = s.deposition.kept().map(|(_, a)| a.count).sum();
    assert_eq!(kept, s.count(crate::record::ParticleFate::Captured) + s.count(crate::record::ParticleFate::Trapped));
    assert_eq!(s.deposition.injected.iter().map(|a| a.count).sum::<u64>(), 5000);
    let mut rows = csv::Reader::from_path(folder.path().join("impacts.csv")).unwrap();
    let mut last = (0u64, 0.0f64);
    let mut impacts = 0;
    for row in rows.records() {
        let row = row.unwrap();
        let key = (row[0].parse().unwrap(), row[1].parse().unwrap());
        assert!(key >= last, "{key:?} after {last:?}");
        last = key;
        impacts += 1;
    }
    assert_eq!(impacts, s.walls.iter().map(|w| w.impacts).sum::<u64>());
}

/// Stops a run after some blocks by an error at its own hands: the checkpoint must carry it over.
struct StopAfter<'a>(&'a AtomicU64);

impl Progress for StopAfter<'_> {
    fn particles(&self, done: u64, _: u64) {
        self.0.store(done, Ordering::Relaxed);
    }
}

#[test]
fn resuming_drops_torn_rows_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, torn) = (folder.path().join("whole"), folder.path().join("torn"));
    let case = case();
    run(&case, &options(&whole, 1), &Silent).unwrap();
    let often = RunOptions { checkpoint_every: Duration::ZERO, ..options(&torn, 1) };
    run_on(&case, &often, &Silent, &power::Unplugged::after(60, &torn), HELD).unwrap_err();
    let state = State::read(&torn).unwrap().unwrap();
    assert!(state.next > 0 && state.next < 5000, "{}", state.next);
    // half a row more than the checkpoint knows of
    for name in state.files.keys() {
        let mut file = fs::OpenOptions::new().append(true).open(torn.join(name)).unwrap();
        std::io::Write::write_all(&mut file, b"12,0.5,\"half").unwrap();
    }
    let done = AtomicU64::new(0);
    run(&case, &RunOptions { resume: true, ..options(&torn, 2) }, &StopAfter(&done)).unwrap();
    assert_eq!(files(&whole), files(&torn));
    assert_eq!(done.load(Ordering::Relaxed), 5000);
    // once more: nothing left to do, nothing changed
    run(&case, &RunOptions { resume: true, ..options(&torn, 2) }, &Silent).unwrap();
    assert_eq!(files(&whole), files(&torn));
}

#[test]
fn resuming_something_else_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    run(&case(), &options(folder.path(), 2), &Silent).unwrap();
    let other =
        Case::from_toml(&CASE.replace("seed = 3", "seed = 4"), Path::new("case.toml"), Library::builtin()).unwrap();
    let resume = RunOptions { resume: true, ..options(folder.path(), 2) };
    assert!(
        run(&other, &resume, &Silent)
            .unwrap_err()
            .to_string()
            .contains("the case, its materials or a file it names was changed")
    );
    let shard = RunOptions { shard: Some(Shard { index: 1, of: 2 }), ..resume };
    assert!(run(&case(), &shard, &Silent).unwrap_err().to_string().contains("another shard"));
    let nowhere = RunOptions { resume: true, ..RunOptions::default() };
    assert!(matches!(run(&case(), &nowhere, &Silent), Err(RunError::NoFolder)));
}

#[test]
fn shards_are_read_with_care() {
    assert_eq!("2/8".parse(), Ok(Shard { index: 2, of: 8 }));
    for bad in ["0/8", "9/8", "2", "a/b", "1/0", ""] {
        assert!(bad.parse::<Shard>().is_err(), "{bad}");
    }
    let parts: Vec<_> = (1..=3).map(|index| Shard { index, of: 3 }.blocks(10)).collect();
    assert_eq!(parts, [0..3, 3..6, 6..10]);
}

fn case_with(output: &str) -> Case {
    let text = CASE.replace("[output]", &format!("[output]\n{output}"));
    Case::from_toml(&text, Path::new("case.toml"), Library::builtin()).unwrap()
}

fn table(path: &Path, layout: usize) -> String {
    let mut reader = carom_table::TableReader::open(path, LAYOUTS[layout].schema()).unwrap();
    let mut all = carom_table::Table::with_schema(&LAYOUTS[layout].schema()).unwrap();
    while let Some(batch) = reader.next_batch().unwrap() {
        all.append(batch).unwrap();
    }
    all.to_csv().unwrap()
}

#[test]
fn parquet_holds_what_csv_would_whole_merged_and_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    run(&case(), &options(&at("csv"), 2), &Silent).unwrap();
    let case = case_with("impacts = \"parquet\"\nfates = \"parquet\"");
    run(&case, &options(&at("parquet"), 1), &Silent).unwrap();
    for (layout, stem) in [(crate::tables::IMPACTS, "impacts"), (crate::tables::FATES, "fates")] {
        let csv = table(&at("csv").join(format!("{stem}.csv")), layout);
        assert!(csv.lines().count() > 5000);
        assert!(csv == table(&at("parquet").join(format!("{stem}.parquet")), layout));
        assert!(!at("parquet").join(format!("{stem}.csv")).exists());
    }
    let whole = files(&at("parquet"));
    let folders: Vec<PathBuf> = (1..=3).map(|i| at(&format!("{i}-3"))).collect();
    for (i, out) in (1..).zip(&folders) {
        run(&case, &RunOptions { shard: Some(Shard { index: i, of: 3 }), ..options(out, 2) }, &Silent).unwrap();
        assert!(out.join("impacts.parquet").exists());
    }
    merge(&folders, &at("merged"), false).unwrap();
    assert!(whole == files(&at("merged")));
    let only = RunOptions { shard: Some(Shard { index: 1, of: 1 }), ..options(&at("only"), 2) };
    run(&case, &only, &Silent).unwrap();
    merge(&[at("only")], &at("again"), false).unwrap();
    assert!(whole == files(&at("again")));
    assert!(merge(&[at("parquet")], &at("never"), false).unwrap_err().to_string().contains("whole run"));
    // resumed when done: nothing changes, and what was damaged since is told
    let resume = RunOptions { resume: true, ..options(&at("parquet"), 2) };
    run(&case, &resume, &Silent).unwrap();
    assert!(whole == files(&at("parquet")));
    fs::write(at("parquet").join("impacts.parquet"), "torn").unwrap();
    let error = run(&case, &resume, &Silent).unwrap_err().to_string();
    assert!(error.contains("impacts.parquet: 4 bytes where the checkpoint says"), "{error}");
}

#[test]
fn fates_are_told_particle_by_particle() {
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&case(), &options(folder.path(), 2), &Silent).unwrap();
    let mut rows = csv::Reader::from_path(folder.path().join("fates.csv")).unwrap();
    let mut mass = crate::exact_sum::ExactSum::default();
    let (mut particle, mut impacts, mut captured) = (0, 0, 0);
    for row in rows.records().map(Result::unwrap) {
        assert_eq!(row[0].parse(), Ok(particle));
        assert_eq!(&row[1], if particle < 3000 { "fine" } else { "coarse" });
        assert_eq!(row[3].is_empty(), &row[2] == "airborne");
        mass.add(row[13].parse().unwrap());
        impacts += row[14].parse::<u64>().unwrap();
        captured += u64::from(&row[2] == "captured");
        particle += 1;
    }
    assert_eq!(particle, 5000);
    assert_eq!(mass.value(), summary.injected.mass.value());
    assert_eq!(impacts, summary.walls.iter().map(|w| w.impacts).sum::<u64>());
    assert_eq!(captured, summary.count(crate::record::ParticleFate::Captured));
}

#[test]
fn tables_that_are_not_wanted_are_not_there() {
    let folder = tempfile::tempdir().unwrap();
    run(&case(), &options(folder.path(), 2), &Silent).unwrap();
    let none = case_with("impacts = false\nfates = false\ntrajectories = 0");
    run(&none, &RunOptions { force: true, ..options(folder.path(), 2) }, &Silent).unwrap();
    for stem in ["impacts", "fates", "trajectories"] {
        assert!(!folder.path().join(format!("{stem}.csv")).exists(), "{stem}");
    }
    let text = CASE.replace("[output]", "[output]\nimpacts = \"parkett\"");
    let error = Case::from_toml(&text, Path::new("case.toml"), Library::builtin()).unwrap_err();
    assert!(error.to_string().contains("parkett") && error.to_string().contains("parquet"), "{error}");
    let line = text[..error.span.unwrap().start].lines().last().unwrap();
    assert_eq!(line.trim(), "impacts =");
}

#[test]
fn what_is_no_set_of_shards_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let part = |name: &str, case: &Case, index, of| {
        run(case, &RunOptions { shard: Some(Shard { index, of }), ..options(&at(name), 2) }, &Silent).unwrap();
    };
    part("a", &case(), 1, 2);
    part("b", &case(), 2, 2);
    part("third", &case(), 2, 3);
    part("other", &case_with("impacts = false"), 2, 2);
    let refused = |names: &[&str], why: &str| {
        let folders: Vec<PathBuf> = names.iter().map(|n| at(n)).collect();
        let error = merge(&folders, &at("out"), false).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
        assert!(!at("out").exists());
    };
    refused(&["a"], "shard 2/2 is missing");
    refused(&["b"], "shard 1/2 is missing");
    refused(&["a", "b", "a"], "shard 1/2 a second time");
    refused(&["a", "third"], "one of 3 shards");
    refused(&["a", "other"], "another case");
    refused(&["a", "nowhere"], "no checkpoint.json");
    refused(&[], "nothing to merge");
    assert!(merge(&[at("a"), at("b")], &at("b"), false).unwrap_err().to_string().contains("into itself"));
    let state = State { finished: false, ..State::read(&at("b")).unwrap().unwrap() };
    state.write(&Machine, &at("b")).unwrap();
    refused(&["a", "b"], "not finished");
}

/// A box as an STL text in millimetres.
fn stl_box(size: [f64; 3]) -> String {
    let v = |i: usize| [0, 1, 2].map(|c| if i >> c & 1 == 0 { 0.0 } else { size[c] });
    let quads = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let mut text = String::from("solid box\n");
    for q in quads {
        for t in [[q[0], q[1], q[2]], [q[0], q[2], q[3]]] {
            text += "facet normal 0 0 0\nouter loop\n";
            t.map(v).iter().for_each(|[x, y, z]| text += &format!("vertex {x} {y} {z}\n"));
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid box\n"
}

#[test]
fn a_box_from_stl_is_the_box() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("box.stl"), stl_box([50.0, 20.0, 30.0])).unwrap();
    let text = |shape: &str| {
        format!(
            r#"
            [forces]
            gravity = ["0 m/s2", "-9.81 m/s2", "0 m/s2"]
            [[wall]]
            name = "box"
            {shape}
            law = "reflect"
            restitution = 0.8
            tangential_restitution = 0.9
            [[injection]]
            density = "2500 kg/m3"
            diameter = "200 um"
            count = 200
            position = {{ box = [["10 mm", "5 mm", "5 mm"], ["40 mm", "15 mm", "25 mm"]] }}
            velocity = ["2 m/s", "1 m/s", "-3 m/s"]
            [run]
            until = "40 ms"
            "#
        )
    };
    let made = |shape: &str| {
        let case = Case::from_toml(&text(shape), &folder.path().join("case.toml"), Library::builtin()).unwrap();
        let out = folder.path().join(if shape.starts_with("stl") { "stl" } else { "box" });
        let summary = run(&case, &options(&out, 1), &Silent).unwrap();
        let mut rows = csv::Reader::from_path(out.join("impacts.csv")).unwrap();
        let times: Vec<(u64, f64)> =
            rows.records().map(|r| r.unwrap()).map(|r| (r[0].parse().unwrap(), r[1].parse().unwrap())).collect();
        (summary, times)
    };
    let (stl, stl_times) = made("stl = { file = \"box.stl\", unit = \"1 mm\" }");
    let (room, room_times) = made("box = [[\"0 m\", \"0 m\", \"0 m\"], [\"50 mm\", \"20 mm\", \"30 mm\"]]");
    assert_eq!(stl.walls[0].impacts, room.walls[0].impacts);
    assert!(room.walls[0].impacts > 800);
    for (a, b) in stl_times.iter().zip(&room_times) {
        // the file's corners are single precision: 20 mm is off by 4e-10 of itself
        assert!(a.0 == b.0 && (a.1 - b.1).abs() < 1e-8, "{a:?} {b:?}");
    }
    let lost =
        Case::from_toml(&text("stl = { file = \"bix.stl\" }"), &folder.path().join("case.toml"), Library::builtin());
    assert!(lost.unwrap_err().to_string().contains("bix.stl"));
}

mod brownian;
mod folder;
mod meshed;
mod power;
mod results;
mod shards;

/// Stops when so many particles have ended.
struct StopsAt(u64, AtomicU64);

impl Progress for StopsAt {
    fn particles(&self, done: u64, _: u64) {
        self.1.store(done, Ordering::Relaxed);
    }
    fn stops(&self) -> bool {
        self.1.load(Ordering::Relaxed) >= self.0
    }
}

#[test]
fn a_run_that_was_stopped_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, stopped) = (folder.path().join("whole"), folder.path().join("stopped"));
    let case = case();
    run(&case, &options(&whole, 2), &Silent).unwrap();
    let stops = StopsAt(1000, AtomicU64::new(0));
    let error = run(&case, &options(&stopped, 2), &stops).unwrap_err();
    assert!(matches!(error, RunError::Stopped), "{error}");
    assert!(stops.1.load(Ordering::Relaxed) < 5000, "it ran on");
    run(&case, &RunOptions { resume: true, ..options(&stopped, 2) }, &Silent).unwrap();
    assert_eq!(files(&whole), files(&stopped));
}
